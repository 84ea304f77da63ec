// SPDX-License-Identifier: AGPL-3.0-or-later
// What OpenFOAM's checkMesh says of faces: how far the line from cell to cell leans to the face between them, how far
// from its centre it meets it (skewness), and how unevenly the face parts it (interpolation weight); and of prisms that
// are long for their height. As in primitiveMeshTools and polyMeshTools of OpenFOAM v1912.
#pragma once

#include "pipeline/mesh/cell.h"
#include "pipeline/mesh/region_faces.h"
#include "pipeline/status.h"

// What checkMesh tells of, beside a small determinant and a small weight (pipeline/mesh/cell.h): more skewness or
// aspect ratio, a smaller ratio of the volumes of two cells.
#define CW_SKEWNESS_MOST 4.0
#define CW_VOLUME_RATIO_LEAST 0.01
#define CW_ASPECT_MOST 1000.0

// Layers that are thin for the bend of their wall have skew sides; those of other faces are faults of the tetrahedra.
typedef enum { CW_FACE_OF_PRISM, CW_FACE_OTHER, CW_FACE_KINDS } CwFaceKind;

typedef struct {
  // Cosines of the angles between the area vector of a face and the line from the centroid of its cell to that of the
  // other.
  double least, sum;
  int64_t count;
  // Beyond the limits above: faces by skewness, weight and volume ratio, prisms and other cells by determinant, prisms
  // by aspect ratio.
  int64_t skew[CW_FACE_KINDS], light[CW_FACE_KINDS], uneven[CW_FACE_KINDS], open[CW_FACE_KINDS], slender;
  // Quadrilaterals that no diagonal divides so that the tetrahedra on the parts are sound in all their cells.
  int64_t twisted;
} CwFaceQuality;

// Centroid (m) and volume (m3) of a cell.
typedef struct {
  double at[3], volume;
} CwMiddle;

CwMiddle cw_cell_middle(const CwRegionData *data, int32_t cell);

void cw_face_quality_start(CwFaceQuality *q);

// Adds a face with `count` (3 or 4) nodes at `x`, whose normal points out of the cell `from`, to `to`.
void cw_face_quality_face(int count, const double *const *x, const CwMiddle *from, const CwMiddle *to, CwFaceKind kind,
                          CwFaceQuality *q);

// Adds one on a patch, which is measured for skewness alone.
void cw_face_quality_patch(int count, const double *const *x, const double from[3], CwFaceKind kind, CwFaceQuality *q);

void cw_face_quality_add(const CwFaceQuality *more, CwFaceQuality *sum);

// Prisms of a region that have a great aspect ratio where they lie so to the axes: checkMesh's is of the components of
// area vectors, and not the same once a region is turned.
typedef struct {
  int32_t *cell, count, capacity;
} CwFlatPrisms;

// Adds the faces between two cells of a region, those on patches, and the cells by determinant, and lists the flat
// prisms, as cells of the region, in *flat, which the caller frees. `middle`: of each cell. CW_ERR_MEMORY.
CwStatus cw_face_quality_region(const CwRegionData *data, const CwRegionFaces *faces, const CwMiddle *middle,
                                CwFaceQuality *q, CwFlatPrisms *flat);

// How many of them have a great aspect ratio in this region.
int64_t cw_flat_prisms_slender(const CwFlatPrisms *flat, const CwRegionData *data);
void cw_flat_prisms_free(CwFlatPrisms *flat);

// In degrees; 0 without faces. The mean is the angle of the mean cosine.
double cw_non_orthogonality_greatest(const CwFaceQuality *q);
double cw_non_orthogonality_mean(const CwFaceQuality *q);
