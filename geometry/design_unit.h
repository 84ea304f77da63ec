// SPDX-License-Identifier: AGPL-3.0-or-later
// A design in the model unit of its solids, as rotor and stator are built from it: similar pumps of any size have the
// same one, bit by bit. What the shape follows from is rounded, far below OpenCASCADE's tolerance and any
// workshop's: lengths to 2^-26 units, which are 7e-11 D2, areas to 2^-20 square ones, angles (rad) and numbers to
// 2^-34. Heads, speeds, flow rates, powers and pressures stay in SI: no shape follows from them any more.
#pragma once

#include "geometry/design.h"

#ifdef __cplusplus
extern "C" {
#endif

// `unit`: m, of cw_solid_unit_of_pump().
CwDesign cw_design_in_unit(const CwDesign *design, double unit);
CwVolute cw_volute_in_unit(const CwVolute *volute, double unit);

#ifdef __cplusplus
}
#endif
