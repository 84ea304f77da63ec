// SPDX-License-Identifier: AGPL-3.0-or-later
// A box with partition planes placed by hand, and its surfaces, for tests that fill its regions.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/region/region_build.h"
}

#include "domain_surfaces.h"
#include "solids.h"
#include "wall_surface.h"

static inline double even_size(const void *, const double *) {
  return 2.5e-3;
}

// A box of 40 x 30 x 20 mm with inlet at x = 0 and outlet at x = 40. Plane 0: x = 21. Plane 1, behind it: y = 14, a
// little askew. Plane 2, before it: z = 9, or as given.
struct Box {
  CwCad *cad;
  CwBackground background;
  CwVerticals *inside = nullptr;
  CwPlanNode node[3];
  double none[4] = {0, 0, 0, 0};
  CwPlan plan;
  DomainSurfaces boundary;
  CwOutcome outcome = {};

  explicit Box(int nodes, double across = 0.009, const TopoDS_Shape &solid = BRepPrimAPI_MakeBox(40, 30, 20).Shape())
      : cad(open_solid(solid, [](const TopoDS_Face &face) -> std::string {
          BRepAdaptor_Surface surface(face);
          double x = surface.Value(0.5, 0.5).X(), y = surface.Value(0.6, 0.7).X();
          if (std::fabs(x - y) > 1e-9 || (x > 1e-9 && x < 40 - 1e-9)) return "side,wall";
          if (std::fabs(x) < 1e-9) return "in,inlet";
          return "out,outlet";
        })) {
    double tilt = 0.1, c = std::cos(tilt), s = std::sin(tilt);
    node[0] = {{{1, 0, 0}, 0.021}, -1, {-1, -2}, 0};
    node[1] = {{{s, c, 0}, 0.014 * c + 0.030 * s}, 0, {-2, -3}, 0};
    node[2] = {{{0, 0, 1}, across}, 0, {-1, -4}, 0};
    if (nodes >= 2) node[0].child[1] = 1;
    if (nodes >= 3) node[0].child[0] = 2;
    plan = {nodes, nodes + 1, node, none, 0, 0, 0, 0};
    assert_int_equal(cw_background_make(cad, 1e-4, 0.2, &background), CW_OK);
    assert_int_equal(cw_verticals_make(background.x, background.triangle_count, background.triangle, &inside), CW_OK);
    boundary.input.cad = cad;
    boundary.input.plan = &plan;
    boundary.input.size_at = even_size;
    check(cw_network_make(NULL, cad, &background, inside, &plan, &boundary.network, &outcome));
    assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
  }
  ~Box() {
    boundary.free();
    cw_verticals_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
  int count(CwCurveKind kind) const {
    int found = 0;
    for (int i = 0; i < boundary.network.curve_count; i++) found += boundary.network.curve[i].kind == kind;
    return found;
  }
};

static inline void make_walls(Box &box) {
  make_wall_surface(box.boundary, &box.outcome);
}

// Walls, and layers of 1.5 mm on them.
static inline void make_layers(Box &box) {
  DomainSurfaces &boundary = box.boundary;
  make_walls(box);
  std::vector<double> target(boundary.surface.vertex_count, 1.5e-3);
  check(cw_boundary_grow(NULL, &boundary.input, &boundary.wall_curves, &boundary.surface, &box.background,
                         target.data(), nullptr, nullptr, &boundary.layers, &box.outcome));
  assert_int_equal(box.outcome.kind, CW_OUTCOME_DONE);
  check(cw_layers_audit(&boundary.layers, boundary.surface.x));
}

// All surfaces of the box, as far as the inner ones.
static inline void make_surfaces(Box &box) {
  DomainSurfaces &boundary = box.boundary;
  int faces = cw_cad_face_count(box.cad);
  std::vector<void *> open_patches(faces, nullptr), interfaces;
  int64_t size;
  make_layers(box);
  for (int v = 0; !boundary.input.pinched && v < boundary.surface.vertex_count;
       v++) { // corners and edges keep the asked thickness to the walls
    for (int k = 1; k < 3; k++) {
      double side = k == 1 ? 0.030 : 0.020, x = boundary.layers.top[v][k];
      assert_true(x > 1.5e-3 - 1e-9 && x < side - 1.5e-3 + 1e-9);
    }
  }
  check(cw_free_curves_make(&boundary.input, &boundary.wall_curves, &boundary.surface, &boundary.layers,
                            &boundary.free_curves, &box.outcome));
  assert_int_equal(box.outcome.kind, CW_OUTCOME_DONE);
  for (int f = 0; f < faces; f++) {
    if (!cw_cad_face_is_wall(box.cad, f))
      check(cw_interfaces_open_patch(&boundary.input, &boundary.wall_curves, &boundary.free_curves, f, &open_patches[f],
                                     &size));
  }
  interfaces.resize(boundary.free_curves.outline_count);
  for (int i = 0; i < boundary.free_curves.outline_count; i++)
    check(cw_interfaces_polygon(&boundary.input, &boundary.free_curves, i, &interfaces[i], &size));
  check(cw_interfaces_make(&boundary.input, &boundary.free_curves, open_patches.data(), interfaces.data(),
                           &boundary.interfaces, &box.outcome));
  assert_int_equal(box.outcome.kind, CW_OUTCOME_DONE);
  check(cw_interfaces_audit(&boundary.interfaces, box.plan.region_count));
  for (void *bytes : open_patches) free(bytes);
  for (void *bytes : interfaces) free(bytes);
}

// What regions of the box are made from: four layers, the first 0.2 mm.
struct Regions {
  std::vector<double> first, growth;
  CwSharedNodes shared;
  CwRegionContext context = {};

  explicit Regions(const DomainSurfaces &boundary)
      : first(boundary.surface.vertex_count, 2e-4), growth(boundary.surface.vertex_count, 1.5) {
    context.from = boundary.regions();
    context.domain = "box";
    context.layer_count = 4;
    context.growth = growth.data();
    context.first_height = first.data();
    check(cw_shared_nodes_make(&context.from, context.layer_count, &shared));
    context.shared = &shared;
    check(cw_open_edge_places_make(&context.from, &context.open_edge_places));
  }
  ~Regions() {
    cw_open_edge_places_free(&context.open_edge_places);
    cw_shared_nodes_free(&shared);
  }
};
