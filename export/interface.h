// SPDX-License-Identifier: AGPL-3.0-or-later
// The cylinder where rotor and stator meet: whether both sides are the same surface, and which face of the
// other side lies over the centre of each face.
#ifndef CUTWATER_EXPORT_INTERFACE_H
#define CUTWATER_EXPORT_INTERFACE_H

#include "export/assembly.h"

typedef struct {
  double radius_least, radius_most, z_least, z_most; // of the nodes, m
  double area;                                       // m2
} CwInterfaceSide;

typedef struct {
  CwInterfaceSide sides[CW_EXPORT_DOMAINS];
  // By side and face of that side (place in its patch): the face of the other side, and where in it the
  // centre lies (r, s of the CGNS triangle or bilinear quadrilateral, each in 0 to 1).
  int64_t count[CW_EXPORT_DOMAINS];
  int64_t *donor[CW_EXPORT_DOMAINS];
  double (*place[CW_EXPORT_DOMAINS])[2];
} CwInterface;

// Works on the unrolled cylinder (angle, z). `radius` in m is that of the design. Fails with CW_ERR_INPUT
// where a node is off the cylinder by more than 1e-4 of the radius, or the sides have different ends. The
// radial gap that the first check excludes is one that no solver's interface weights show. For rank 0, which
// holds the faces.
CwStatus cw_interface_make(const CwAssembly *assembly, double radius, CwInterface *interface);
void cw_interface_free(CwInterface *interface);

#endif
