// SPDX-License-Identifier: AGPL-3.0-or-later
// The surfaces where two domains meet: whether both sides are the same surface, and which face of the other side lies
// over the centre of each face.
#pragma once

#include "export/assembly.h"

typedef struct {
  double least[2], most[2]; // of the nodes in the surface's own coordinates, see CwInterface
} CwInterfaceSide;

// The surface's own coordinates: angle (rad) and z (m) on a cylinder about the axis; lengths (m) along two axes of a
// plane; none on another surface.
typedef struct {
  int is_flat;
  double radius;                // of the cylinder, m
  double centre[3], axis[3][3]; // of the flat surface: two axes in it, and its normal
  CwInterfaceSide sides[2];
  // By side and face of that side (place in its patch): the face of the other side, and where in it the
  // centre lies (r, s of the CGNS triangle or bilinear quadrilateral, each in 0 to 1).
  int64_t count[2];
  int64_t *donor[2];
  double (*place[2])[2];
} CwInterface;

// Works on interface `number` of the mesh. On a cylinder, unrolled, or a plane, fails with CW_ERR_INPUT where a node is
// off it by more than cw_interface_tolerance, or where the sides have different ends; on another surface, where a face
// has no other one near. The gap that these checks exclude is one that no solver's interface weights show. For rank 0,
// which holds the faces.
CwStatus cw_interface_make(const CwAssembly *assembly, int number, CwInterface *interface);
void cw_interface_free(CwInterface *interface);

// Interfaces before interface `number` from the domain of its side to the other one: two domains may meet in several
// surfaces.
int cw_interfaces_before(const CwMesh *mesh, int number, int side);
