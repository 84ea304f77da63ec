// SPDX-License-Identifier: AGPL-3.0-or-later
// Donors on an interface of any shape: for each face of one side the nearest face of the other.
#pragma once

#include "export/assembly.h"

// [out] donor: of each of `count` faces the one of `other_count` that is nearest to its centre, and where the centre
// lies over it: r, s of the CGNS triangle or bilinear quadrilateral, each in 0 to 1. *gap: the greatest distance of a
// centre, over the longest edge of the face and its donor; *worst: the face that has it. CW_ERR_MEMORY.
CwStatus cw_interface_near(const CwInterfaceFace *faces, int64_t count, const CwInterfaceFace *others,
                           int64_t other_count, int64_t *donor, double (*place)[2], double *gap, int64_t *worst);
