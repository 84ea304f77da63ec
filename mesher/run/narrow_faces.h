// SPDX-License-Identifier: AGPL-3.0-or-later
// Narrow faces that a mesh of the asked size cannot show are left out of the solids.
#pragma once

#include "mesher/run/run_state.h"

// Leaves out the chains of narrow faces (cad_leave_out.h) that are in the mean less than half as wide as the size field
// at its present scale wants edges there: edges more than twice as long as a face is wide leave needles on it (size.c).
// Those that a turn of the domain's symmetry takes to one another have one mean. Warns of them. *left [out]: number of
// faces left out in all domains; where it is not 0, symmetries and sizes have to be found anew.
CwStatus cw_leave_out_narrow(CwMeshRun *run, int *left);
