// SPDX-License-Identifier: AGPL-3.0-or-later
// The paper's case and cases of a duty alone, and designs and rotors made of them, for tests; each fails the test where
// the program would.
#ifndef CUTWATER_TESTS_GEOMETRY_PAPER_ROTOR_H
#define CUTWATER_TESTS_GEOMETRY_PAPER_ROTOR_H

#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "pipeline/case.h"
#include "tests/geometry/near_to.h"

CwCase paper(void);
CwCase duty_point(double cubic_metres_per_hour, double head, double rpm); // all else left open
CwDesign design_of(const CwCase *table);

// Builds the rotor, turned to its hand, and measures it: valid, closed, and of a tolerance under 0.001 mm.
void measure(const CwDesign *design, CwMeasuredSolid *solid, CwMeasuredRotor *measured);

#endif
