// SPDX-License-Identifier: AGPL-3.0-or-later
// The surface mesh of a domain from its network on: the first wall of each image set is meshed, the others are copied.
#pragma once

#include <vector>

#include "domain_surfaces.h"
#include "solids.h"

inline void make_wall_surface(DomainSurfaces &boundary, CwOutcome *outcome) {
  const CwBoundaryInput &in = boundary.input;
  const CwSymmetry *symmetry = in.images->symmetry;
  const int faces = cw_cad_face_count(in.cad);
  std::vector<void *> walls(faces, nullptr);
  int64_t size;
  check(cw_wall_curves_make(NULL, &in, &boundary.open_edges, &boundary.wall_curves));
  check(cw_wall_curves_audit(&boundary.wall_curves, &boundary.network));
  for (int f = 0; f < faces; f++) {
    if (symmetry && symmetry->face.first[f] != f) continue;
    if (cw_cad_face_is_wall(in.cad, f)) check(cw_surface_mesh_face(&in, &boundary.wall_curves, f, 0, &walls[f], &size));
  }
  check(cw_surface_mesh_make(NULL, &in, &boundary.wall_curves, walls.data(), &boundary.surface, outcome));
  assert_int_equal(outcome->kind, CW_OUTCOME_DONE);
  check(cw_surface_mesh_audit(&boundary.surface, in.plan->region_count));
  for (void *bytes : walls) free(bytes);
}
