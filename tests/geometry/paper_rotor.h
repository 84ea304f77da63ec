// SPDX-License-Identifier: AGPL-3.0-or-later
// Cases of the library and cases of a duty alone, and designs, pumps and rotors made of them, for tests in C and C++;
// each fails the test where the program would.
#pragma once

#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/pump.h"
#include "pipeline/case.h"
#include "tests/unit_test.h"

#ifdef __cplusplus
extern "C" {
#endif

CwCase case_of(const char *name); // of cases/NAME
CwCase paper(void);
CwCase duty_point(double cubic_metres_per_hour, double head, double rpm); // all else left open
CwDesign design_of(const CwCase *table);

// The pump as the program builds it, and its design; to be freed by cw_pump_free.
CwPump pump_of(const CwCase *table, CwDesign *design);

// Builds the rotor, turned to its hand, and measures it: valid, closed, and of a tolerance under 0.001 mm.
void measure(const CwDesign *design, CwMeasuredSolid *solid, CwMeasuredRotor *measured);

// The volume of a rotor is that of cw_rotor_volume.
void volumes_agree(const CwDesign *design, const CwMeasuredSolid *solid, double tolerance);

#ifdef __cplusplus
}
#endif
