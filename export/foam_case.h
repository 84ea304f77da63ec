// SPDX-License-Identifier: AGPL-3.0-or-later
// The OpenFOAM case around the mesh: dictionaries, fields at the start, scripts.
#ifndef CUTWATER_EXPORT_FOAM_CASE_H
#define CUTWATER_EXPORT_FOAM_CASE_H

#include "export/assembly.h"
#include "export/patch_role.h"
#include "pipeline/case.h"

// Writes the case (but for constant/polyMesh) into `folder`. One rank calls it. CW_ERR_IO.
CwStatus cw_foam_case_write(const char *folder, const CwCase *table, const CwAssembly *assembly);

// How many ranks the case's scripts take of themselves for a whole mesh of so many cells, in words of a shell: one, or
// on large meshes as many as the machine has cores.
const char *cw_foam_usual_ranks(int64_t cells);

// Turbulence at the inlet and inside at the start.
typedef struct {
  double k, epsilon, omega; // m2/s2, m2/s3, 1/s
} CwTurbulence;

// From a speed (m/s), an intensity and a mixing length (m): k = 3/2 (I U)^2, epsilon = Cmu^(3/4) k^(3/2) / l,
// omega = epsilon / (Cmu k), with Cmu = 0.09.
CwTurbulence cw_turbulence(double speed, double intensity, double mixing_length);

#endif
