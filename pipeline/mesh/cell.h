// SPDX-License-Identifier: AGPL-3.0-or-later
// The cells of a region seen alike: nodes, faces and volume of the cell with a given number.
#pragma once

#include "pipeline/mesh/region_items.h"
#include "pipeline/vec.h"

enum { CW_CELL_FACES = 5 }; // the most a cell has

// Below these checkMesh calls the determinant of a cell, and the interpolation weight of a face, small.
#define CW_SMALL_DETERMINANT 1e-3
#define CW_SMALL_WEIGHT 0.05

// The nodes of cell `cell` (tetrahedra first, then pyramids, then prisms); their number in `count`: 4, 5
// or 6.
static inline const int32_t *cw_cell_nodes(const CwRegionData *region, int32_t cell, int *count) {
  *count = 4;
  if (cell < region->tetrahedron_count) return region->tetrahedra[cell];
  cell -= region->tetrahedron_count;
  *count = 5;
  if (cell < region->pyramid_count) return region->pyramids[cell];
  *count = 6;
  return region->prisms[cell - region->pyramid_count];
}

// The corners of each face, as cw_cell_face() has them; -1 at the end of a triangle.
const signed char (*cw_cell_face_table(int node_count))[4];

// The nodes of one face, normal out of the cell (face numbering of the CGNS standard). Returns 3 or 4.
int cw_cell_face(const CwRegionData *region, int32_t cell, int face, int32_t nodes[4]);

// Area vector of a face in m2. A quadrilateral is taken as four triangles about the mean of its nodes, so
// that both cells at a face and both sides of a sum see the same surface.
void cw_face_area(const double (*points)[3], const int32_t *nodes, int count, double area[3]);

// Centre (m) of a face with `count` (3 or 4) nodes at `x` as OpenFOAM reckons it, the mean of its triangles weighed by
// their areas, and twice its area vector (m2). The triangles of a quadrilateral are four about the mean of its nodes.
void cw_face_centre(int count, const double *const *x, double centre[3], double twice[3]);

// The distance from the exact surface of an interface, in the unit of the coordinates, that is allowed to the `count`
// (3 or 4) nodes of a face on it, when the mesher makes them and when the exporter reads them: a hundredth of its
// shortest edge. The gap is then little beside that of the chords, which any two meshes of a curved surface have
// between them, and no fold of a face.
double cw_interface_tolerance(int count, const double *const nodes[4]);

// Signed volume in m3 of a cell with so many nodes at `x`, by the divergence theorem over its faces as cw_face_area()
// takes them: volumes of cells add up to the volume enclosed, without gaps.
double cw_cell_volume(int count, const double *const *x);

// Centroid of such a cell of positive volume, m, as OpenFOAM reckons it (primitiveMesh::makeCellCentresAndVols), so
// that what is measured with it is what checkMesh says: pyramids from the mean of the face centres to the faces,
// weighed by volume. That is the true centroid where the faces are flat.
void cw_cell_centroid(int count, const double *const *x, double centroid[3]);

// The aspect ratio that checkMesh tells of (primitiveMeshTools::cellClosedness): of the sums over the faces of the
// components of the area vectors without their signs the greatest over the least, or a sixth of all three over the
// volume to the power 2/3, whichever is more. Of a cell of positive volume.
double cw_cell_aspect(int count, const double *const *x);

// The determinant that checkMesh tells of (primitiveMeshTools::cellDeterminant): an eighth of that of the sum of the
// area vectors' squares over the square of their mean, of the faces with a bit in `inner`, those to another cell. 1 of
// a cube, near 0 of a cell whose faces leave a direction open.
double cw_cell_determinant(int count, const double *const *x, unsigned inner);

// Of a quadrilateral seen from a point, six times the volume over the triangle of each corner and its two neighbours:
// above 0 where the corners run anticlockwise about an outward normal. Those of corners 0 and 2 are what one diagonal
// leaves, those of 1 and 3 the other.
static inline void cw_quad_halves(const double *const *x, const double from[3], double half[4]) {
  double to[4][3], c[3];
  for (int k = 0; k < 4; k++) cw_sub(x[k], from, to[k]);
  for (int k = 0; k < 4; k++) {
    cw_cross(to[k], to[(k + 1) % 4], c);
    half[k] = cw_dot(to[(k + 3) % 4], c);
  }
}

// The places of the nodes of a cell; returns their number.
static inline int cw_cell_points(const CwRegionData *region, int32_t cell, const double *x[6]) {
  int count;
  const int32_t *nodes = cw_cell_nodes(region, cell, &count);
  for (int i = 0; i < count; ++i) x[i] = region->points[nodes[i]];
  return count;
}

// Mean of the nodes, m.
void cw_cell_centre(const CwRegionData *region, int32_t cell, double centre[3]);
