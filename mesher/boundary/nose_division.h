// SPDX-License-Identifier: AGPL-3.0-or-later
// Shorter edges of wall curves at noses (nose.h) that are far narrower than the wanted edges are long, as leading edges
// of blades are in coarse meshes. The layer top has the triangles of the wall, and narrow ones bound flat tetrahedra.
#pragma once

#include "mesher/boundary/curve_division.h"

// Divides edges of one curve further. Over the tip of a nose those from which the curve turns away by more than columns
// may lean are halved, for where two of them meet no column stands upright on both; along its sides those become two or
// three that are so long for its width that tetrahedra over it had less than the wanted angle. *count and *point [in,
// out]: malloc'd, ends included. CW_ERR_MEMORY.
CwStatus cw_curve_divide_at_noses(const CwNetwork *network, const CwCurve *curve, int32_t *count, CwCurvePoint **point);
