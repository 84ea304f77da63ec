// SPDX-License-Identifier: AGPL-3.0-or-later
// What short and near creases ask for, on prisms at random, and what open edges allow: by hand.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <gp_Pln.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

extern "C" {
#include "mesher/common/vec.h"
#include "mesher/size/size_sources.h"
}

#include "solids.h"
#include "tests/draw.h"

// A convex outline (mm) extruded to a height, as segments of its own: 0 .. n - 1 at the bottom, then the top, then the
// upright ones. Face n is the bottom, n + 1 the top.
struct Prism {
  int n;
  double corner[5][2], height;

  void ends(int edge, double a[3], double b[3]) const {
    const int i = edge % n, j = edge < 2 * n ? (i + 1) % n : i;
    const double low = edge >= n && edge < 2 * n ? height : 0, high = edge < n ? 0 : height;
    for (int k = 0; k < 2; k++) a[k] = corner[i][k] * 1e-3, b[k] = corner[j][k] * 1e-3;
    a[2] = low * 1e-3, b[2] = high * 1e-3;
  }
  void faces(int edge, int face[2]) const {
    face[0] = edge % n;
    face[1] = edge < n ? n : edge < 2 * n ? n + 1 : (edge + n - 1) % n;
  }
  void normal(int face, double out[3]) const {
    const int next = (face + 1) % n;
    out[0] = out[1] = 0, out[2] = face == n ? -1 : 1;
    if (face >= n) return;
    out[0] = corner[next][1] - corner[face][1], out[1] = corner[face][0] - corner[next][0], out[2] = 0;
    cw_unit(out);
  }
  bool is_crease(int edge) const {
    int face[2];
    double p[3], q[3];
    faces(edge, face);
    normal(face[0], p);
    normal(face[1], q);
    return cw_dot(p, q) < 0.94;
  }
  TopoDS_Shape shape() const {
    BRepBuilderAPI_MakePolygon polygon;
    for (int i = 0; i < n; i++) polygon.Add(gp_Pnt(corner[i][0], corner[i][1], 0));
    polygon.Close();
    return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()), gp_Vec(0, 0, height)).Shape();
  }
};

// The length of the edge, or the distance from x, on it, to another crease of one of its faces that has no end of it.
static double asked_at(const Prism &prism, int edge, const double x[3], double floor_size) {
  double a[3], b[3];
  int face[2];
  prism.ends(edge, a, b);
  prism.faces(edge, face);
  double size = cw_distance(a, b);
  for (int other = 0; other < 3 * prism.n; other++) {
    double p[3], q[3], nearest[3];
    int of[2];
    prism.ends(other, p, q);
    prism.faces(other, of);
    int common = face[0] == of[0] || face[0] == of[1] || face[1] == of[0] || face[1] == of[1];
    int joined = cw_distance(a, p) == 0 || cw_distance(a, q) == 0 || cw_distance(b, p) == 0 || cw_distance(b, q) == 0;
    if (!common || joined || !prism.is_crease(other)) continue;
    cw_lerp(p, q, cw_nearest_share(p, q, x), nearest);
    size = std::fmin(size, cw_distance(x, nearest));
  }
  return std::fmax(size, floor_size);
}

// Whether x lies within `reach` of a crease along each axis; the least that is asked for there.
static double least_about(const Prism &prism, const double x[3], double reach, double floor_size) {
  double least = INFINITY;
  for (int edge = 0; edge < 3 * prism.n; edge++) {
    double a[3], b[3], y[3];
    prism.ends(edge, a, b);
    for (int i = 0; i <= 400 && prism.is_crease(edge); i++) {
      cw_lerp(a, b, i / 400.0, y);
      double off = 0;
      for (int k = 0; k < 3; k++) off = std::fmax(off, std::fabs(x[k] - y[k]));
      if (off <= reach) least = std::fmin(least, asked_at(prism, edge, y, floor_size));
    }
  }
  return least;
}

// The least value of the nodes about x: a crease that cuts the corner of a cell may leave some of them as they were.
static double value_about(const CwSizeGrid &grid, const double x[3]) {
  int64_t place[3];
  double least = INFINITY;
  for (int k = 0; k < 3; k++) place[k] = (int64_t)std::floor((x[k] - grid.low[k]) / grid.spacing);
  for (int c = 0; c < 8; c++) {
    int64_t node = ((place[2] + c / 4) * grid.count[1] + place[1] + c / 2 % 2) * grid.count[0] + place[0] + c % 2;
    least = std::fmin(least, grid.value[node]);
  }
  return least;
}

// Widths are taken at points no more than half the base size apart, of which the lesser counts between two.
static void check_prism(const Prism &prism, double base, uint64_t *seed) {
  CwCad *cad = open_solid(prism.shape());
  CwSizeInput input = {};
  CwSizeGrid grid;
  const double low[3] = {-0.05, -0.05, 0}, high[3] = {0.05, 0.05, prism.height * 1e-3};
  const double spacing = 1e-3, slack = 0.5 * base, floor_size = 0.15 * base;
  input.cad = cad;
  input.base_size = base;
  check(cw_size_grid_make(low, high, spacing, 4000000, &grid));
  check(cw_size_seed_edges(&input, &grid));
  for (int edge = 0; edge < 3 * prism.n; edge++) {
    double a[3], b[3], x[3];
    prism.ends(edge, a, b);
    for (int i = 0; i < 20 && prism.is_crease(edge); i++) {
      cw_lerp(a, b, draw(seed), x);
      double made = value_about(grid, x), asked = asked_at(prism, edge, x, floor_size);
      assert_true(made <= asked + std::fmin(slack, 0.25 * cw_distance(a, b)) + 1e-6);
      assert_true(made >= least_about(prism, x, 2.01 * spacing, floor_size) - slack - 1e-6);
      assert_true(made >= floor_size * (1 - 1e-6));
    }
  }
  for (int i = 0; i < 300; i++) { // nodes away from all creases are as they were
    int32_t node[3];
    double x[3];
    for (int k = 0; k < 3; k++) {
      node[k] = draw_below(seed, grid.count[k]);
      x[k] = grid.low[k] + node[k] * spacing;
    }
    float value = grid.value[((int64_t)node[2] * grid.count[1] + node[1]) * grid.count[0] + node[0]];
    if (isinf(least_about(prism, x, 1.3 * spacing, floor_size))) assert_true(value == cw_size_unset);
  }
  cw_size_grid_free(&grid);
  cw_cad_close(&cad);
}

static void creases_of_prisms(void **) {
  uint64_t seed = 1;
  for (int i = 0; i < 5; i++) {
    Prism prism = {3 + i % 3, {}, 4 + 12 * draw(&seed)};
    for (int c = 0; c < prism.n; c++) { // on an ellipse: convex
      const double angle = 2 * M_PI * (c + 0.6 * draw(&seed)) / prism.n;
      prism.corner[c][0] = 30 * std::cos(angle);
      prism.corner[c][1] = (6 + 3 * i) * std::sin(angle);
    }
    check_prism(prism, 2e-3, &seed);
    check_prism(prism, i % 2 ? 20e-3 : 4e-3, &seed);
  }
}

// A box of 30 x 20 x 10 mm asks for 10 mm along all its edges, or for 0.15 of the base size where that is more; of a
// side whose two faces meet at 170 degrees nothing is asked, and the sides beside it do not see it.
static void boxes_by_hand(void **) {
  uint64_t seed = 2;
  const Prism box = {4, {{-15, -10}, {15, -10}, {15, 10}, {-15, 10}}, 10};
  const double corner[3] = {0.015, 0.01, 0.005};
  for (double base : {2e-3, 80e-3}) {
    assert_near(asked_at(box, 8, corner, 0.15 * base), base > 0.05 ? 12e-3 : 10e-3, 1e-12); // of the oracle itself
    check_prism(box, base, &seed);
  }
  const Prism bent = {5, {{-15, -10}, {0, -11.3}, {15, -10}, {15, 10}, {-15, 10}}, 30};
  assert_false(bent.is_crease(11));
  assert_true(bent.is_crease(10));
  check_prism(bent, 2e-3, &seed);
}

// A prism with the seeds of its edges.
struct SeededPrism {
  Prism prism;
  CwCad *cad;
  CwSizeGrid grid = {};

  SeededPrism(const Prism &given, double base) : prism(given), cad(open_solid(prism.shape())) {
    const double low[3] = {-0.04, -0.04, 0}, high[3] = {0.04, 0.04, prism.height * 1e-3};
    CwSizeInput input = {};
    input.cad = cad;
    input.base_size = base;
    check(cw_size_grid_make(low, high, 1e-3, 4000000, &grid));
    check(cw_size_seed_edges(&input, &grid));
  }
  ~SeededPrism() {
    cw_size_grid_free(&grid);
    cw_cad_close(&cad);
  }
  void point(int edge, double s, double x[3]) const {
    double a[3], b[3];
    prism.ends(edge, a, b);
    cw_lerp(a, b, s, x);
  }
};

// Seeds lie so near to one another that the field along straight edges is what they ask for; an edge that is no crease
// has none.
static void edges_are_seeded_all_along(void **) {
  const SeededPrism box({4, {{-15, -10}, {15, -10}, {15, 10}, {-15, 10}}, 10}, 40e-3);
  const SeededPrism bent({5, {{-15, -10}, {0, -11.3}, {15, -10}, {15, 10}, {-15, 10}}, 30}, 2e-3);
  double x[3];
  for (int edge = 0; edge < 12; edge++) {
    for (double s = 0; s <= 1; s += 0.01) {
      box.point(edge, s, x);
      assert_near(cw_size_grid_at(&box.grid, x), 10e-3, 1e-6);
    }
  }
  for (double s = 0.1; s < 0.9; s += 0.01) {
    bent.point(11, s, x);
    assert_true(value_about(bent.grid, x) == cw_size_unset);
  }
}

// Along two edges that draw near one another, to the one end or the other, no place is asked for more than the width
// there.
static void widths_of_a_taper(void **) {
  for (int side = -1; side <= 1; side += 2) {
    const double wide = side > 0 ? 6 : 4, narrow = side > 0 ? 4 : 6;
    const SeededPrism taper({4, {{-30, -narrow}, {30, -wide}, {30, wide}, {-30, narrow}}, 70}, 24e-3);
    for (int edge = 0; edge < 8; edge += 2) {
      for (double s = 0.02; s < 0.98; s += 0.01) {
        double x[3];
        taper.point(edge, s, x);
        const double width = asked_at(taper.prism, edge, x, 3.6e-3);
        assert_true(value_about(taper.grid, x) <= width + 1e-6 && value_about(taper.grid, x) > width - 2e-3);
      }
    }
  }
}

// A bar of 40 x 2r x 10 mm whose ends are rounded: with half cylinders, or with two fillets of `radius` each and a flat
// between.
static TopoDS_Shape round_bar(double r, double radius) {
  const double tip = 20 + radius, bend = radius * std::sqrt(0.5), flat = r - radius;
  BRepBuilderAPI_MakeWire wire;
  auto side = [&](double sign) {
    const gp_Pnt a(sign * 20, -sign * r, 0), b(sign * tip, -sign * flat, 0), c(sign * tip, sign * flat, 0),
        d(sign * 20, sign * r, 0);
    if (flat > 0) {
      const gp_Pnt low(sign * (20 + bend), -sign * (flat + bend), 0), high(sign * (20 + bend), sign * (flat + bend), 0);
      wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(a, low, b).Value()));
      wire.Add(BRepBuilderAPI_MakeEdge(b, c));
      wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(c, high, d).Value()));
    } else {
      wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(a, gp_Pnt(sign * tip, 0, 0), d).Value()));
    }
    wire.Add(BRepBuilderAPI_MakeEdge(d, gp_Pnt(-sign * 20, sign * r, 0)));
  };
  side(1);
  side(-1);
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()), gp_Vec(0, 0, 10)).Shape();
}

// The field along the smooth edge of a rounded bar's end, between its ends.
static double asked_along_smooth_edge(double r, double radius) {
  CwCad *cad = open_solid(round_bar(r, radius));
  const double low[3] = {-0.03, -0.02, 0}, high[3] = {0.03, 0.02, 0.01}, x[3] = {0.02, 1e-3 * r, 0.005};
  CwSizeInput input = {};
  CwSizeGrid grid;
  input.cad = cad;
  input.base_size = 2e-3;
  check(cw_size_grid_make(low, high, 0.4e-3, 4000000, &grid));
  check(cw_size_seed_edges(&input, &grid));
  double value = value_about(grid, x);
  cw_size_grid_free(&grid);
  cw_cad_close(&cad);
  return value;
}

// A nose asks for its width along its smooth sides; fillets, on which triangles from side to side lie at 45 degrees,
// ask for nothing there.
static void noses_ask_for_their_width(void **) {
  for (double r : {1.0, 1.5, 3.0}) {
    assert_near(asked_along_smooth_edge(r, r), 2e-3 * r, 1e-6);
    assert_true(asked_along_smooth_edge(r, 0.6 * r) == cw_size_unset);
  }
}

// The top of a cube of 20 mm is open; the sides are two patches.
static std::string open_top(const TopoDS_Face &face) {
  gp_Pln plane = BRepAdaptor_Surface(face).Plane();
  if (std::fabs(plane.Axis().Direction().Z()) > 0.5) return plane.Location().Z() > 1 ? "top,inlet" : "floor,wall";
  return std::fabs(plane.Axis().Direction().X()) > 0.5 ? "ends,wall" : "sides,wall";
}

struct OpenBox {
  CwCad *cad;
  CwSizeInput input = {};
  CwSizeGrid grid = {};
  double allowed[4] = {};

  explicit OpenBox(double spacing, double length = 20, double width = 20)
      : cad(open_solid(BRepPrimAPI_MakeBox(length, width, 20).Shape(), open_top)) {
    const double low[3] = {0, 0, 0}, high[3] = {1e-3 * length, 1e-3 * width, 0.02};
    for (int p = 0; p < 4; p++) {
      const std::string name = cw_cad_patch_name(cad, p);
      allowed[p] = name == "ends" ? 1e-3 : name == "sides" ? 3e-3 : 1e-6; // those of floor and top do not count
    }
    input.cad = cad;
    input.base_size = 2e-3;
    input.open_edge_size = allowed;
    check(cw_size_grid_make(low, high, spacing, 4000000, &grid));
  }
  ~OpenBox() {
    cw_size_grid_free(&grid);
    cw_cad_close(&cad);
  }
};

static void open_edges_seed_what_they_allow(void **) {
  OpenBox cube(0.7e-3);
  cw_size_seed_open_edges(&cube.input, &cube.grid);
  for (double s = 0; s <= 1; s += 0.01) {
    const double end[3] = {0.02, 0.02 * s, 0.02}, side[3] = {0.02 * s, 0, 0.02};
    assert_near(cw_size_grid_at(&cube.grid, end), 1e-3, 1e-9);
    if (s > 0.1 && s < 0.9) assert_near(cw_size_grid_at(&cube.grid, side), 3e-3, 1e-9);
  }
  for (int64_t node = 0; node < (int64_t)cw_size_grid_nodes(&cube.grid); node++) {
    const int64_t nx = cube.grid.count[0], ny = cube.grid.count[1];
    const int64_t place[3] = {node % nx, node / nx % ny, node / nx / ny};
    double x[3], off = INFINITY;
    for (int k = 0; k < 3; k++) x[k] = cube.grid.low[k] + cube.grid.spacing * (double)place[k];
    for (int k = 0; k < 2; k++) off = std::fmin(off, std::fmin(std::fabs(x[k]), std::fabs(x[k] - 0.02)));
    off = std::fmax(off, std::fabs(x[2] - 0.02));
    if (off > 1.001 * cube.grid.spacing) assert_true(cube.grid.value[node] == cw_size_unset);
  }
}

// The mean of what is allowed over what is wanted: of even sizes, and of sizes that rise along x.
static void open_edges_ask_for_their_mean(void **) {
  for (double spacing : {0.7e-3, 0.4e-3}) {
    OpenBox cube(spacing);
    for (double rise : {0.0, 0.2}) {
      for (int64_t node = 0; node < (int64_t)cw_size_grid_nodes(&cube.grid); node++) {
        double x = cube.grid.low[0] + cube.grid.spacing * (double)(node % cube.grid.count[0]);
        cube.grid.value[node] = (float)(4e-3 + rise * x);
      }
      double last = 4e-3 + rise * 0.02, along = rise > 0 ? std::log(last / 4e-3) / (rise * 0.02) : 1 / 4e-3;
      double wanted = (2 * 3e-3 * along + 1e-3 / 4e-3 + 1e-3 / last) / 4;
      assert_near(cw_size_open_edges_ask(&cube.input, &cube.grid), wanted, 1e-4);
    }
  }
  for (double spacing : {1.8e-3, 0.2e-3}) { // long edges count by their length, however finely they are looked at
    OpenBox bar(spacing, 60, 6);
    for (int64_t node = 0; node < (int64_t)cw_size_grid_nodes(&bar.grid); node++) bar.grid.value[node] = 4e-3F;
    assert_near(cw_size_open_edges_ask(&bar.input, &bar.grid), (60 * 3.0 / 4 + 6 * 1.0 / 4) / 66, 1e-6);
  }
  OpenBox closed(0.7e-3);
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(20, 20, 20).Shape());
  closed.input.cad = cad;
  assert_near(cw_size_open_edges_ask(&closed.input, &closed.grid), 0, 0);
  cw_cad_close(&cad);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(creases_of_prisms),
                              cmocka_unit_test(boxes_by_hand),
                              cmocka_unit_test(edges_are_seeded_all_along),
                              cmocka_unit_test(widths_of_a_taper),
                              cmocka_unit_test(noses_ask_for_their_width),
                              cmocka_unit_test(open_edges_seed_what_they_allow),
                              cmocka_unit_test(open_edges_ask_for_their_mean)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
