// SPDX-License-Identifier: AGPL-3.0-or-later
// How far the line from cell to cell leans to the face between them, as OpenFOAM's checkMesh measures it.
#ifndef CUTWATER_EXPORT_ORTHOGONALITY_H
#define CUTWATER_EXPORT_ORTHOGONALITY_H

#include "pipeline/mesh/region_faces.h"

// Cosines of the angles between the area vector of a face and the line from the centroid of its cell to that of the
// other.
typedef struct {
  double least, sum;
  int64_t count;
} CwOrthogonality;

void cw_orthogonality_start(CwOrthogonality *o);

// Adds a face whose area vector, or a multiple, is `area`, from the cell with centroid `from` to that with centroid
// `to`.
void cw_orthogonality_face(const double area[3], const double from[3], const double to[3], CwOrthogonality *o);
void cw_orthogonality_add(const CwOrthogonality *more, CwOrthogonality *sum);

// Adds the faces between two cells of a region. CW_ERR_MEMORY.
CwStatus cw_orthogonality_region(const CwRegionData *data, const CwRegionFaces *faces, CwOrthogonality *o);

// In degrees; 0 without faces. The mean is the angle of the mean cosine.
double cw_non_orthogonality_greatest(const CwOrthogonality *o);
double cw_non_orthogonality_mean(const CwOrthogonality *o);

#endif
