// SPDX-License-Identifier: AGPL-3.0-or-later
// Liquid water at saturation, from the triple point to near the critical one. The density of compressed water is
// greater by 0.05 % for every 10 bar at 20 degrees Celsius.
//
// Vapour pressure and density: IAPWS SR1-86(1992), Saturation properties of ordinary water substance (Wagner and
// Pruss). Viscosity: IAPWS R12-08, Viscosity of ordinary water substance, without the enhancement next to the critical
// point.
#pragma once

#define CW_WATER_COLDEST 0.01 // degrees Celsius, the triple point
#define CW_WATER_HOTTEST 370.0

// Of water at a temperature in degrees Celsius, CW_WATER_COLDEST to CW_WATER_HOTTEST.
double cw_water_vapour_pressure(double celsius);           // Pa
double cw_water_density(double celsius);                   // kg/m3
double cw_water_viscosity(double celsius, double density); // dynamic, Pa s, at a density in kg/m3
double cw_water_kinematic_viscosity(double celsius);       // m2/s
