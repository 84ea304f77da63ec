// SPDX-License-Identifier: AGPL-3.0-or-later
// Fills and meshes that can be changed in place: from one to the other.
#pragma once

#include <stdint.h>

#include "pipeline/status.h"

#include "mesher/fill/fill.h"
#include "mesher/fill/tet_mesh.h"

// The mesh of a fill's tetrahedra; point 4 + p comes from the fill's point p.
CwStatus cw_fill_to_mesh(const CwFill *fill, CwTetMesh *mesh);

// The fill of all tetrahedra of a mesh: the first `fixed_count` sources as points of the same numbers, then
// the inner points that are used, in the order of their sources, of which there are `source_count`. Uses the
// mesh up; *fill must be empty.
CwStatus cw_fill_from_mesh(CwTetMesh *mesh, int32_t fixed_count, int32_t source_count, CwFill *fill);
