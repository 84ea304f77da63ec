// SPDX-License-Identifier: AGPL-3.0-or-later
// Walls and layers of two boxes side by side, against those that are made one by one.
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

extern "C" {
#include "mesher/run/run_layers.h"
#include "mesher/surface/patch_task.h"
#include "mesher/thickness/even_columns.h"
#include "mesher/thickness/layer_thickness.h"
}

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakePrism.hxx>

#include "divided_box.h"
#include "run_domains.h"

enum { LAYERS = 4 };
static const double first_height = 2e-4, growth = 1.5, thickness = 1e-3; // less than four such layers have

static TopoDS_Shape plain() {
  return BRepPrimAPI_MakeBox(40, 30, 20).Shape();
}

// With a blade from floor to lid, whose edge of 60 degrees points along x: columns there lean by as much to its sides.
static TopoDS_Shape with_blade() {
  BRepBuilderAPI_MakePolygon wire(gp_Pnt(10, 13, 0), gp_Pnt(10 + 2 * std::sqrt(3), 15, 0), gp_Pnt(10, 17, 0), true);
  const TopoDS_Shape blade = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0, 0, 20)).Shape();
  return BRepAlgoAPI_Cut(plain(), blade).Shape();
}

// Boxes of two regions with their wall curves, and the faces of their walls.
struct Walls {
  Box box[2];
  DomainRun made;
  std::vector<CwLayerTarget> asked;
  std::array<double, CW_BENDS> flat[10];
  CwResults results = {};
  CwOutcome outcome = {};

  explicit Walls(double scale = 1, const TopoDS_Shape &solid = plain())
      : box{Box(1, 0.009, solid), Box(1, 0.009, solid)},
        asked(3, CwLayerTarget{scale * first_height, growth, scale * thickness, 100}) {
    for (auto &radius : flat) radius = {INFINITY, INFINITY};
    const int32_t faces[2] = {cw_cad_face_count(box[0].cad), cw_cad_face_count(box[1].cad)};
    assert_true(faces[0] <= 10);
    results.shared = 1;
    check(cw_results_make(&results, 2, faces));
    for (int d = 0; d < 2; d++) {
      DomainSurfaces &boundary = box[d].boundary;
      check(cw_wall_curves_make(NULL, &boundary.input, &boundary.open_edges, &boundary.wall_curves));
      made.add(d ? "stator" : "rotor", box[d].cad, box[d].background, box[d].plan, boundary);
      CwDomain &domain = made.domain(d);
      domain.patch_layers = asked.data();
      domain.face_radius = (double(*)[CW_BENDS])flat;
      domain.layer_count = LAYERS;
      domain.layer_share = 0.5;
      int64_t size;
      for (int f = 0; f < faces[d]; f++)
        if (cw_cad_face_is_wall(box[d].cad, f))
          check(cw_surface_mesh_face(&boundary.input, &boundary.wall_curves, f, 0, &results.bytes[d][f], &size));
    }
  }
  ~Walls() {
    cw_results_free(&results);
    for (int d = 0; d < 2; d++) {
      CwDomain &domain = made.domain(d);
      cw_surface_mesh_free(&domain.surface);
      cw_column_targets_free(&domain.targets);
      cw_layers_free(&domain.layers);
    }
  }
  void merge() {
    check(cw_run_merge_walls(made.run.get(), &results, &outcome));
  }
  // The block of a face says that it has no mesh: behind its counts.
  void spoil(int d, CwOutcomeKind kind) {
    CwPatchBlock block;
    CwOutcome none = {};
    int face = 0;
    while (!results.bytes[d][face]) face++;
    cw_outcome_set(&none, kind, nullptr, "no mesh of domain %d", d);
    std::memcpy((char *)results.bytes[d][face] + 16, &none, sizeof none);
    cw_patch_block(results.bytes[d][face], &block);
    assert_memory_equal(&block.outcome, &none, sizeof none);
  }
};

static void expect_surface(const CwSurfaceMesh &made, const CwSurfaceMesh &wanted) {
  const size_t triangles = (size_t)wanted.triangle_count;
  assert_int_equal(made.vertex_count, wanted.vertex_count);
  assert_int_equal(made.triangle_count, wanted.triangle_count);
  assert_memory_equal(made.x, wanted.x, (size_t)wanted.vertex_count * sizeof *wanted.x);
  assert_memory_equal(made.triangle, wanted.triangle, triangles * sizeof *wanted.triangle);
  assert_memory_equal(made.face, wanted.face, triangles * sizeof *wanted.face);
  assert_memory_equal(made.region, wanted.region, triangles * sizeof *wanted.region);
}

// Walls, each of which is asked for 1 mm: less than what its layers and its tetrahedra allow. So all columns are flat
// ones, and take what flat ones do.
static void walls_are_merged_and_have_targets(void **) {
  Walls walls;
  Box by_hand(1);
  make_walls(by_hand);
  walls.merge();
  assert_int_equal(walls.outcome.kind, CW_OUTCOME_DONE);
  for (int d = 0; d < 2; d++) {
    const CwDomain &domain = walls.made.domain(d);
    const CwColumnTargets &targets = domain.targets;
    expect_surface(domain.surface, by_hand.boundary.surface);
    check(cw_surface_mesh_audit(&domain.surface, 2));
    assert_int_equal(targets.layer_count, LAYERS);
    assert_int_equal(targets.vertex_count, domain.surface.vertex_count);
    for (int v = 0; v < targets.vertex_count; v++) {
      assert_near(targets.first_height[v], first_height, 1e-15);
      assert_near(targets.growth[v], growth, 1e-15);
      assert_near(targets.target[v], thickness, 1e-15);
    }
    assert_near(domain.layer_share, 1, 1e-9);
  }
}

// Where layers were thinned they are asked for no more than that; other domains are as they were, and so is what the
// layers take, by which cells are counted.
static void thinned_columns_stay_thin(void **) {
  Walls walls;
  Box by_hand(1);
  make_walls(by_hand);
  std::vector<double> most(by_hand.boundary.surface.vertex_count, INFINITY);
  for (size_t v = 0; v < most.size(); v += 3) most[v] = v % 2 ? 0.4e-3 : 1.2e-3;
  walls.made.run->most_thickness[1] = most.data();
  walls.merge();
  for (int d = 0; d < 2; d++) {
    const CwDomain &domain = walls.made.domain(d);
    for (int v = 0; v < domain.targets.vertex_count; v++)
      assert_near(domain.targets.target[v], d == 1 && most[v] < thickness ? most[v] : thickness, 1e-15);
    assert_near(domain.layer_share, 1, 1e-9);
  }
}

// Of the domains that have no walls the first is told of.
static void a_domain_without_walls_is_told(void **) {
  for (int first = 0; first < 2; first++) {
    Walls walls;
    walls.spoil(1, CW_OUTCOME_FINER);
    if (first == 0) walls.spoil(0, CW_OUTCOME_REPLAN);
    walls.merge();
    assert_int_equal(walls.outcome.kind, first == 0 ? CW_OUTCOME_REPLAN : CW_OUTCOME_FINER);
    assert_int_equal(walls.outcome.domain, first);
    assert_string_equal(walls.outcome.reason, first == 0 ? "no mesh of domain 0" : "no mesh of domain 1");
  }
}

// Of layers that grow evenly from the first height, or by less than 1 in low columns: the share of the last.
static double last_share(const void *context, int32_t, double height) {
  const double first = *(const double *)context;
  double low = cw_layer_growth_least(LAYERS), high = growth;
  const auto sum = [](double ratio) { return 1 + ratio + ratio * ratio + ratio * ratio * ratio; };
  for (int i = 0; i < 100; i++) {
    const double middle = (low + high) / 2;
    (first * sum(middle) < height ? low : high) = middle;
  }
  return low * low * low / sum(low);
}

// Layers of a box, and lower ones about a blade, where columns lean.
static void layers_are_grown_to_their_targets(void **) {
  for (double scale : {1.0, 0.4}) {
    const TopoDS_Shape solid = scale < 1 ? with_blade() : plain();
    Walls walls(scale, solid);
    Box by_hand(1, 0.009, solid);
    DomainSurfaces &boundary = by_hand.boundary;
    make_walls(by_hand);
    walls.merge();
    double asked = scale * first_height;
    std::vector<double> least(boundary.surface.vertex_count, cw_layer_lowest(LAYERS) * asked);
    std::vector<double> target(least.size(), scale * thickness), first(least.size(), asked), most(least.size(), growth);
    CwLayerDivision division = {LAYERS, last_share, &asked};
    check(cw_boundary_grow(NULL, &boundary.input, &boundary.wall_curves, &boundary.surface, &by_hand.background,
                           target.data(), least.data(), &division, &boundary.layers, &by_hand.outcome));
    const CwColumnTargets targets = {LAYERS,        (int32_t)least.size(), first.data(), most.data(),
                                     target.data(), least.data(),          nullptr};
    check(cw_columns_divide(NULL, &targets, &boundary.surface, &boundary.layers));
    check(cw_run_layers(walls.made.run.get(), &walls.outcome));
    assert_int_equal(walls.outcome.kind, CW_OUTCOME_DONE);
    for (int d = 0; d < 2; d++) {
      const CwLayers &layers = walls.made.domain(d).layers, &wanted = boundary.layers;
      int full = 0;
      check(cw_layers_audit(&layers, walls.made.domain(d).surface.x));
      assert_int_equal(layers.column_count, wanted.column_count);
      assert_memory_equal(layers.triangle, wanted.triangle, (size_t)wanted.triangle_count * sizeof *wanted.triangle);
      for (int v = 0; v < wanted.column_count; v++) {
        assert_near(cw_distance(layers.top[v], wanted.top[v]), 0, 1e-6 * scale * thickness);
        assert_near(layers.first_height[v], wanted.first_height[v], 1e-6 * asked);
        full += layers.thickness[v] > 0.99 * scale * thickness;
      }
      assert_true(full > 0.9 * wanted.column_count);
    }
    const std::string record = walls.made.record();
    assert_true(record.find("\"layers\"") != std::string::npos);
    assert_true(record.find("\"domains\"") != std::string::npos);
  }
}

// A vertex of the upper side of the second box stands 5 mm below its floor: no layers stand there. The step is not
// over.
static void a_domain_without_layers_is_told(void **) {
  Walls walls;
  walls.merge();
  CwDomain &domain = walls.made.domain(1);
  const double upper[3] = {0.010, 0.015, 0.020};
  int nearest = 0;
  for (int v = 0; v < domain.surface.vertex_count; v++)
    if (cw_distance(domain.surface.x[v], upper) < cw_distance(domain.surface.x[nearest], upper)) nearest = v;
  domain.surface.x[nearest][2] = -5e-3;
  check(cw_run_layers(walls.made.run.get(), &walls.outcome));
  assert_int_equal(walls.outcome.kind, CW_OUTCOME_FINER);
  assert_int_equal(walls.outcome.domain, 1);
  assert_true(walls.made.record().find("\"layers\"") == std::string::npos);
}

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(walls_are_merged_and_have_targets), cmocka_unit_test(thinned_columns_stay_thin),
      cmocka_unit_test(a_domain_without_walls_is_told),    cmocka_unit_test(layers_are_grown_to_their_targets),
      cmocka_unit_test(a_domain_without_layers_is_told),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
