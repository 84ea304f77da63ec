// SPDX-License-Identifier: AGPL-3.0-or-later
// The correlations from which the hydraulic design works out what a table leaves open, in two families: those
// of Guelich's and of Guan's books. Formulas and sources are on the page docs/geometry.md.
#pragma once

#include "geometry/design.h"

enum { CW_CORRELATION_FAMILIES = 2 };

#define CW_GUELICH_LEAST_FLOW 0.005     // m3/s, to which the efficiencies of his table 3.9 reach, as commonly quoted
#define CW_GUAN_LEAST_FLOW (5 / 3600.0) // m3/s, at which the efficiencies of GB/T 13007 begin, as commonly quoted
#define CW_LARGEST_HUB_SHARE 0.35       // of D2, of a hub that is left open

// Quantities that are correlated. Each reads members of the design that come before it in this order, besides
// the duty point with water; lengths in m, angles in rad.
typedef enum {
  CW_CORRELATED_EFFICIENCY, // overall
  CW_CORRELATED_HYDRAULIC_EFFICIENCY,
  CW_CORRELATED_SHAFT_DIAMETER, // reads shaft_power
  CW_CORRELATED_OUTLET_DIAMETER,
  CW_CORRELATED_HUB_DIAMETER,   // reads shaft_diameter, D2
  CW_CORRELATED_OUTLET_WIDTH,   // reads D2
  CW_CORRELATED_INLET_DIAMETER, // reads D2, hub diameter
  CW_CORRELATED_BLADE_COUNT,
  CW_CORRELATED_BLADE_THICKNESS, // reads D2, blade count
  CW_CORRELATED_INCIDENCE,
  CW_CORRELATED_BASE_DIAMETER, // reads D2
  CW_CORRELATED_INLET_WIDTH,   // of the volute; reads b2, D2
  CW_CORRELATED_COUNT
} CwCorrelated;

// The value by one family; `*source` (NULL: not wanted) becomes a static text that names the formula.
double cw_correlation(CwCorrelations family, CwCorrelated quantity, const CwDesign *design, const char **source);

// The quantity of a design that is correlated, or -1 for the blade number.
int cw_correlated_quantity(CwCorrelated quantity);
