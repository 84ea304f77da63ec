// SPDX-License-Identifier: AGPL-3.0-or-later
// The surfaces of a tank that is divided into sectors.
#pragma once

#include "tank.h"
#include "wall_surface.h"

// Walls: those of the first of each image set are meshed, the others copied.
inline void make_walls(Tank &tank) {
  check(cw_periodic_images_make(&tank.boundary.network, &tank.boundary.images, &tank.outcome));
  make_wall_surface(tank.boundary, &tank.outcome);
}

// Walls, and layers of 1.5 mm on them, likewise.
inline void make_layers(Tank &tank) {
  DomainSurfaces &boundary = tank.boundary;
  make_walls(tank);
  std::vector<double> target(boundary.surface.vertex_count, 1.5e-3);
  check(cw_boundary_grow(NULL, &boundary.input, &boundary.wall_curves, &boundary.surface, &tank.background,
                         target.data(), nullptr, nullptr, &boundary.layers, &tank.outcome));
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
}

// All surfaces of a tank, likewise. The layers are periodic.
inline void make_surfaces(Tank &tank, bool divided) {
  make_layers(tank);
  DomainSurfaces &boundary = tank.boundary;
  const CwPeriodicImages &images = boundary.images;
  const int faces = cw_cad_face_count(tank.cad);
  std::vector<void *> open_patches(faces, nullptr), interfaces;
  int64_t size;
  check(cw_free_curves_make(&boundary.input, &boundary.wall_curves, &boundary.surface, &boundary.layers,
                            &boundary.free_curves, &tank.outcome));
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
  check(cw_free_curves_audit(&boundary.free_curves, &boundary.network));
  for (int f = 0; f < faces; f++) {
    if (images.symmetry->face.first[f] != f) continue;
    if (!cw_cad_face_is_wall(tank.cad, f))
      check(cw_interfaces_open_patch(&boundary.input, &boundary.wall_curves, &boundary.free_curves, f, &open_patches[f],
                                     &size));
  }
  assert_int_equal(boundary.free_curves.outline_count, (divided ? 6 : 2) * tank.n);
  interfaces.resize(boundary.free_curves.outline_count, nullptr);
  for (int i = 0; i < boundary.free_curves.outline_count; i++) {
    if (boundary.free_curves.outline_images.first[i] == i)
      check(cw_interfaces_polygon(&boundary.input, &boundary.free_curves, i, &interfaces[i], &size));
  }
  check(cw_interfaces_make(&boundary.input, &boundary.free_curves, open_patches.data(), interfaces.data(),
                           &boundary.interfaces, &tank.outcome));
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
  check(cw_interfaces_audit(&boundary.interfaces, tank.plan.region_count));
  for (int v = 0; v < boundary.surface.vertex_count; v++) {
    const int next = cw_image_node(&boundary.surface.images, v, 1);
    if (next < 0) continue;
    double turned[3];
    cw_symmetry_turn(tank.n, 1, boundary.layers.top[v], turned);
    for (int k = 0; k < 3; k++) assert_near(turned[k], boundary.layers.top[next][k], 1e-15);
    assert_int_equal(cw_image_node(&boundary.surface.images, v, tank.n), v);
  }
  for (void *bytes : open_patches) free(bytes);
  for (void *bytes : interfaces) free(bytes);
}

// Walls and interfaces are meshed for a size of which this is the half.
inline double half_size(const void *context, const double x[3]) {
  return tank_size(context, x) / 2;
}
