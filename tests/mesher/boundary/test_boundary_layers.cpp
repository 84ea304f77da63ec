// SPDX-License-Identifier: AGPL-3.0-or-later
// What holds columns, and which edges may be flipped; on a box, on a tank of equal passages, and on plates by hand.
#include <algorithm>
#include <array>

#include "arc_prism.h"
#include "divided_box.h"
#include "divided_solid.h"
#include "tank_surfaces.h"

static void hold(const Box &box, CwConstraintKind kind, int32_t index, const double from[3], double x[3]) {
  cw_copy(from, x);
  cw_boundary_hold(&box.boundary.input, {kind, index}, nullptr, x);
}

// On a plane the foot of the perpendicular counts; on a line the nearest place, its ends where that lies beyond.
static void columns_are_brought_to_planes_and_lines(void **) {
  Box box(2);
  const double from[3] = {0.024, 0.011, 0.005}, beyond[3] = {0.02, 0.01, 0.03};
  double x[3];
  hold(box, CW_CONSTRAINT_NONE, -1, from, x);
  assert_near(cw_distance(x, from), 0, 0);
  for (int p = 0; p < 2; p++) {
    const CwPlane &plane = box.node[p].plane;
    hold(box, CW_CONSTRAINT_PLANE, p, from, x);
    for (int k = 0; k < 3; k++) assert_near(x[k], from[k] - cw_plane_distance(&plane, from) * plane.normal[k], 1e-15);
    assert_near(cw_plane_distance(&plane, x), 0, 1e-15);
  }
  // The line of both planes, x = 21 mm, runs along z.
  const double tilt = 0.1, y = 0.014 + (0.030 - 0.021) * std::tan(tilt);
  int lines = 0;
  for (int i = 0; i < box.boundary.network.curve_count; i++) {
    if (box.boundary.network.curve[i].kind != CW_CURVE_LINE) continue;
    lines++;
    hold(box, CW_CONSTRAINT_CURVE, i, from, x);
    const double foot[3] = {0.021, y, from[2]}, end[3] = {0.021, y, 0.020};
    assert_near(cw_distance(x, foot), 0, 1e-12);
    hold(box, CW_CONSTRAINT_CURVE, i, beyond, x);
    assert_near(cw_distance(x, end), 0, 1e-12);
  }
  assert_int_equal(lines, 1);
}

// The nearest point of a cylinder lies on the ray from its axis.
static void columns_are_brought_to_open_patches(void **) {
  DividedSolid solid(segment_prism(10, 2, 20), by_shape);
  const CwBoundaryInput in = {solid.cad, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr};
  const int face = curved_face(solid.cad);
  const double uv[2] = {0.8, 0.01};
  for (int i = 0; i < 5; i++) {
    const double angle = 0.2 + 0.4 * i, radius = 0.008 + 0.001 * i;
    double x[3] = {radius * std::cos(angle), radius * std::sin(angle), 0.004 * i};
    const double wanted[3] = {0.010 * std::cos(angle), 0.010 * std::sin(angle), 0.004 * i};
    cw_boundary_hold(&in, {CW_CONSTRAINT_PATCH, face}, uv, x);
    assert_near(cw_distance(x, wanted), 0, 1e-12);
  }
}

// Each column ends on what holds it, within `off` (m). The least of its thicknesses over the flat walls around is what
// is told, and where something holds it the asked one, within `share` of it.
static void check_columns(const DomainSurfaces &boundary, double share, double off) {
  const CwSurfaceMesh &surface = boundary.surface;
  const double asked = 1.5e-3, uv[2] = {1e-3, 1e-3};
  std::vector<double> thickness(surface.vertex_count, INFINITY);
  int of_kind[4] = {};
  for (int t = 0; t < surface.triangle_count; t++)
    for (int v : surface.triangle[t]) {
      double n[3], down[3];
      cw_cad_face_normal(boundary.input.cad, surface.face[t], uv, n);
      cw_sub(surface.x[v], boundary.layers.top[v], down);
      thickness[v] = std::fmin(thickness[v], cw_dot(n, down));
    }
  for (int v = 0; v < surface.vertex_count; v++) {
    const CwConstraint held = surface.constraint[v];
    double x[3], near[2] = {0.6, 0.01};
    of_kind[held.kind]++;
    assert_near(thickness[v], boundary.layers.thickness[v], share * asked);
    if (held.kind != CW_CONSTRAINT_NONE) assert_near(thickness[v] / asked, 1, share);
    cw_copy(boundary.layers.top[v], x);
    cw_boundary_hold(&boundary.input, held, near, x);
    assert_near(cw_distance(x, boundary.layers.top[v]), 0, off);
  }
  for (int count : of_kind) assert_true(count >= 4);
}

static void columns_end_on_what_holds_them(void **) {
  Box box(3);
  make_layers(box);
  check_columns(box.boundary, 1e-9, 1e-12);
}

static std::string round_inlet(const TopoDS_Face &face) {
  return BRepAdaptor_Surface(face).GetType() == GeomAbs_Plane ? "flat,wall" : "round,inlet";
}

// Layers of 1.5 mm, from the plan on.
static void make_layers(DividedSolid &solid, DomainSurfaces &boundary) {
  boundary.input.cad = solid.cad;
  boundary.input.plan = &solid.plan;
  boundary.input.size_at = even_size;
  check(cw_network_make(NULL, solid.cad, &solid.background, solid.inside, &solid.plan, &boundary.network,
                        &solid.outcome));
  assert_int_equal(solid.outcome.kind, CW_OUTCOME_DONE);
  make_wall_surface(boundary, &solid.outcome);
  std::vector<double> target(boundary.surface.vertex_count, 1.5e-3);
  check(cw_boundary_grow(NULL, &boundary.input, &boundary.wall_curves, &boundary.surface, &solid.background,
                         target.data(), nullptr, nullptr, &boundary.layers, &solid.outcome));
  assert_int_equal(solid.outcome.kind, CW_OUTCOME_DONE);
}

// A sector of a cylinder, its round side open, under two planes that lean: the columns of their cuts run in them, those
// of their line along it, those at the round side round the axis. The bend of that takes a little of their thickness:
// (1.5 / 20)^2 / 2 for a step of 1.5 mm at a radius of 20 mm; and curves are followed by their fine polylines.
static void columns_lean_with_what_holds_them(void **) {
  DividedSolid solid(sector_prism(20, 1.2, 20), round_inlet);
  std::vector<DividingPlane> planes = {{{{0.25, -0.1, 0.96}, 0}, -1, 0}, {{{-1, 0.6, 0.3}, 0}, 0, 1}};
  const double through[2][3] = {{0.010, 0.005, 0.010}, {0.010, 0.004, 0.015}};
  for (int p = 0; p < 2; p++) {
    cw_unit(planes[p].plane.normal);
    planes[p].plane.offset = cw_dot(planes[p].plane.normal, through[p]);
  }
  solid.divide(planes);
  DomainSurfaces boundary;
  make_layers(solid, boundary);
  check_columns(boundary, 0.004, 1e-7);
  boundary.free();
}

// On a round side of 275 degrees each column finds the place of its own.
static void columns_at_a_wide_open_patch_stay_near(void **) {
  DividedSolid solid(sector_prism(20, 4.8, 20), round_inlet);
  DomainSurfaces boundary;
  int held = 0;
  solid.plan.region_count = 1;
  make_layers(solid, boundary);
  for (int v = 0; v < boundary.surface.vertex_count; v++) {
    const double *top = boundary.layers.top[v];
    if (boundary.surface.constraint[v].kind != CW_CONSTRAINT_PATCH) continue;
    held++;
    assert_near(std::hypot(top[0], top[1]), 0.020, 1e-9);
    assert_true(cw_distance(top, boundary.surface.x[v]) < 3e-3);
  }
  assert_true(held > 80);
  boundary.free();
}

// A wall by hand across x inside of the box, with the fluid on the side of the greater x.
struct Plate {
  int n = 0;
  std::vector<std::array<double, 3>> x;
  std::vector<std::array<int32_t, 3>> triangle;
  std::vector<int32_t> face, region, source;
  std::vector<CwConstraint> constraint;
  CwSurfaceMesh surface = {};
  CwLayers layers = {};
  CwOutcome outcome = {};

  Plate() = default;
  // A rhombus of equilateral triangles with edges of 2 mm, n edges a side.
  Plate(int edges, double at) : n(edges) {
    const double h = 2e-3;
    for (int i = 0; i <= n; i++)
      for (int j = 0; j <= n; j++) x.push_back({at, 0.004 + h * (i + 0.5 * j), 0.003 + h * std::sqrt(0.75) * j});
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++) {
        triangle.push_back({point(i, j), point(i, j + 1), point(i + 1, j)});
        triangle.push_back({point(i + 1, j + 1), point(i + 1, j), point(i, j + 1)});
      }
    label();
  }
  ~Plate() {
    cw_layers_free(&layers);
  }
  void label() {
    face.assign(triangle.size(), 0);
    region.assign(triangle.size(), 0);
  }
  int32_t point(int i, int j) const {
    return i * (n + 1) + j;
  }
  // The numbers of the two triangles of a rhombus.
  int rhombus(int i, int j) const {
    return 2 * (i * n + j);
  }
  // Divides it by its longer diagonal: angles of 30 degrees, where 60 can be had.
  void spoil(int i, int j) {
    triangle[rhombus(i, j)] = {point(i, j), point(i, j + 1), point(i + 1, j + 1)};
    triangle[rhombus(i, j) + 1] = {point(i, j), point(i + 1, j + 1), point(i + 1, j)};
  }
  bool is_spoiled(int i, int j) const {
    bool both = true;
    for (int t = rhombus(i, j); t < rhombus(i, j) + 2; t++) {
      const int32_t *c = layers.triangle[t];
      both &= std::find(c, c + 3, point(i, j)) < c + 3 && std::find(c, c + 3, point(i + 1, j + 1)) < c + 3;
    }
    return both;
  }
  void grow(const Box &box) {
    std::vector<double> target(x.size(), 1.5e-3);
    for (size_t t = 0; t < triangle.size(); t++) source.push_back((int32_t)t);
    constraint.assign(x.size(), {CW_CONSTRAINT_NONE, -1});
    surface.vertex_count = (int32_t)x.size();
    surface.x = (double(*)[3])x.data();
    surface.constraint = constraint.data();
    surface.triangle_count = (int32_t)triangle.size();
    surface.triangle = (int32_t(*)[3])triangle.data();
    surface.face = face.data();
    surface.region = region.data();
    surface.source = source.data();
    check(cw_boundary_grow(NULL, &box.boundary.input, NULL, &surface, &box.background, target.data(), nullptr, nullptr,
                           &layers, &outcome));
  }
};

// A wrong diagonal is flipped between two triangles of one face and one region, and between no others.
static void flips_stay_in_a_face_and_a_region(void **) {
  Box box(1);
  Plate plate(8, 0.02);
  const int at[4][2] = {{1, 1}, {1, 5}, {5, 1}, {5, 5}};
  for (const auto &one : at) plate.spoil(one[0], one[1]);
  plate.region[plate.rhombus(1, 5)] = 1;   // of one face
  plate.face[plate.rhombus(5, 1)] = 1;     // of one region
  plate.region[plate.rhombus(5, 5)] = 1;   // face 0 of region 1,
  plate.face[plate.rhombus(5, 5) + 1] = 1; // face 1 of region 0
  plate.grow(box);
  assert_int_equal(plate.outcome.kind, CW_OUTCOME_DONE);
  assert_false(plate.is_spoiled(1, 1));
  for (int i = 1; i < 4; i++) assert_true(plate.is_spoiled(at[i][0], at[i][1]));
  for (int t = 0; t < plate.surface.triangle_count; t++) { // the wall itself is as it was
    if (t / 2 == plate.rhombus(1, 1) / 2) continue;
    assert_memory_equal(plate.layers.triangle[t], plate.triangle[t].data(), sizeof plate.triangle[t]);
  }
  assert_int_equal(plate.layers.triangle_count, plate.surface.triangle_count);
}

// Before an open patch columns leave 0.65 of their edges, of 2 mm, to the tetrahedra: of 2.5 mm they take 1.2 and of
// 2 mm 0.7; walls of the box are none.
static void columns_keep_off_open_patches(void **) {
  Box box(1);
  const struct { double at, thickness; } wanted[] = {{0.020, 1.5e-3}, {0.0375, 1.2e-3}, {0.038, 0.7e-3}};
  for (const auto &one : wanted) {
    Plate plate(6, one.at);
    plate.grow(box);
    assert_int_equal(plate.outcome.kind, CW_OUTCOME_DONE);
    const int middle = plate.point(3, 3);
    assert_near(plate.layers.thickness[middle], one.thickness, 1e-6);
    assert_near(plate.layers.top[middle][0], one.at + one.thickness, 1e-6);
  }
}

// A wall that crosses itself bears no layers, and leaves none.
static void a_wall_that_crosses_itself_is_told(void **) {
  Box box(1);
  Plate plate(6, 0.02);
  const int32_t first = (int32_t)plate.x.size();
  plate.x.push_back({0.019, 0.010, 0.008});
  plate.x.push_back({0.021, 0.0105, 0.008});
  plate.x.push_back({0.021, 0.011, 0.009});
  plate.triangle.push_back({first, first + 1, first + 2});
  plate.face.push_back(0);
  plate.region.push_back(0);
  plate.grow(box);
  assert_int_equal(plate.outcome.kind, CW_OUTCOME_FINER);
  assert_null(plate.layers.top);
  assert_null(plate.layers.triangle);
}

// A fan in which one point has slipped past another, so that a triangle lies on its back: it bears layers when that is
// turned round.
static void folds_are_opened(void **) {
  Box box(1);
  Plate plate;
  const double at[6][2] = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0.6, 0.06}};
  for (const auto &one : at) plate.x.push_back({0.02, 0.015 + 4e-3 * one[1], 0.010 + 4e-3 * one[0]});
  plate.triangle = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1}};
  plate.label();
  plate.grow(box);
  assert_int_equal(plate.outcome.kind, CW_OUTCOME_DONE);
  for (int t = 0; t < 5; t++) {
    double n[3];
    const int32_t *corner = plate.layers.triangle[t];
    cw_normal(plate.x[corner[0]].data(), plate.x[corner[1]].data(), plate.x[corner[2]].data(), n);
    assert_true(n[0] < 0);
  }
}

// Turns the edge between two triangles; false where they have none in common. *longer: whether it is, by half, then.
static bool turn_edge(int32_t *a, int32_t *b, const double (*x)[3], bool *longer) {
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const int32_t p = a[(i + 1) % 3], q = a[(i + 2) % 3], r = a[i], s = b[j];
      if (b[(j + 1) % 3] != q || b[(j + 2) % 3] != p) continue;
      const int32_t first[3] = {r, p, s}, second[3] = {r, s, q};
      *longer = cw_distance(x[r], x[s]) > 1.5 * cw_distance(x[p], x[q]);
      std::copy(first, first + 3, a);
      std::copy(second, second + 3, b);
      return true;
    }
  return false;
}

// In a tank of five passages one edge is turned the wrong way, in all of them. It is flipped back in the first, and the
// others follow.
static void copies_of_flipped_edges_follow(void **) {
  Tank tank(5, 1);
  make_walls(tank);
  CwSurfaceMesh &surface = tank.boundary.surface;
  const int32_t count = surface.triangle_count;
  int32_t a = -1, b = -1;
  for (int32_t t = 0; t < count && a < 0; t++)
    for (int32_t n = t + 1; n < count && a < 0; n++) {
      int32_t one[3], other[3];
      bool longer;
      if (surface.source[t] != t || surface.source[n] != n || surface.face[n] != surface.face[t]) continue;
      if (surface.region[n] != surface.region[t]) continue;
      std::copy(surface.triangle[t], surface.triangle[t] + 3, one);
      std::copy(surface.triangle[n], surface.triangle[n] + 3, other);
      if (!turn_edge(one, other, surface.x, &longer) || !longer) continue;
      bool inner = true; // off the curves, where columns lean
      for (int32_t v : {one[0], one[1], one[2], other[0], other[1], other[2]})
        inner &= v >= tank.boundary.wall_curves.vertex_count;
      if (inner) a = t, b = n;
    }
  assert_true(a >= 0);
  for (int turns = 0; turns < 5; turns++) {
    int32_t of[2] = {-1, -1};
    bool longer;
    for (int32_t t = 0; t < count; t++)
      if (tank.symmetry->face.turns[surface.face[t]] == turns) {
        if (surface.source[t] == a) of[0] = t;
        if (surface.source[t] == b) of[1] = t;
      }
    assert_true(turn_edge(surface.triangle[of[0]], surface.triangle[of[1]], surface.x, &longer));
  }
  std::vector<double> target(surface.vertex_count, 1.5e-3);
  check(cw_boundary_grow(NULL, &tank.boundary.input, &tank.boundary.wall_curves, &surface, &tank.background,
                         target.data(), nullptr, nullptr, &tank.boundary.layers, &tank.outcome));
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
  const int32_t(*made)[3] = tank.boundary.layers.triangle;
  int changed = 0;
  for (int32_t t = 0; t < count; t++) {
    for (int k = 0; k < 3; k++)
      assert_int_equal(made[t][k], cw_image_node(&surface.images, made[surface.source[t]][k],
                                                 tank.symmetry->face.turns[surface.face[t]]));
    changed +=
        memcmp(made[t], surface.triangle[t], sizeof made[t]) != 0 && (surface.source[t] == a || surface.source[t] == b);
  }
  assert_int_equal(changed, 10);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(columns_are_brought_to_planes_and_lines), cmocka_unit_test(columns_are_brought_to_open_patches),
      cmocka_unit_test(columns_end_on_what_holds_them),          cmocka_unit_test(columns_lean_with_what_holds_them),
      cmocka_unit_test(columns_at_a_wide_open_patch_stay_near),  cmocka_unit_test(folds_are_opened),
      cmocka_unit_test(flips_stay_in_a_face_and_a_region),       cmocka_unit_test(columns_keep_off_open_patches),
      cmocka_unit_test(a_wall_that_crosses_itself_is_told),      cmocka_unit_test(copies_of_flipped_edges_follow),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
