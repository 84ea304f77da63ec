// SPDX-License-Identifier: AGPL-3.0-or-later
// The curves of a box under four planes at random, against the polygons that each plane has in its cell: its edges on
// the faces of the box are cut curves, those on other planes are lines.
#include <array>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "divided_solid.h"

enum { PLANES = 4 };
static const double SIZE[3] = {0.04, 0.03, 0.025}, SIDE = 1; // m; of a square that holds every section

// What bounds a polygon's edge: a side of the box (0 to 5), or 6 + the number of a plane.
struct Polygon {
  std::vector<std::array<double, 3>> corner;
  std::vector<int> bound; // of the edge that begins at each corner
};

static CwPlane bound_plane(const std::vector<DividingPlane> &planes, int bound) {
  if (bound >= 6) return planes[bound - 6].plane;
  CwPlane plane = {{0, 0, 0}, bound % 2 ? SIZE[bound / 2] : 0};
  plane.normal[bound / 2] = bound % 2 ? 1 : -1;
  return plane;
}

// Cuts away what lies beyond the plane, on its positive side, or with `sign` -1 on its negative one.
static void cut(Polygon *polygon, const CwPlane &plane, double sign, int bound) {
  Polygon made;
  size_t n = polygon->corner.size();
  for (size_t i = 0; i < n; i++) {
    const double *a = polygon->corner[i].data(), *b = polygon->corner[(i + 1) % n].data();
    double da = sign * cw_plane_distance(&plane, a), db = sign * cw_plane_distance(&plane, b);
    if (da <= 0) {
      made.corner.push_back(polygon->corner[i]);
      made.bound.push_back(polygon->bound[i]);
    }
    if ((da <= 0) == (db <= 0)) continue;
    std::array<double, 3> x;
    cw_lerp(a, b, da / (da - db), x.data());
    made.corner.push_back(x);
    made.bound.push_back(da <= 0 ? bound : polygon->bound[i]);
  }
  *polygon = made;
}

// The part of a plane in the box and in the cell that it divides.
static Polygon polygon_of(const std::vector<DividingPlane> &planes, int number) {
  const CwPlane &plane = planes[number].plane;
  double u[3] = {0, 0, 0}, v[3];
  u[std::fabs(plane.normal[0]) < 0.6 ? 0 : 1] = 1;
  cw_flatten(u, plane.normal);
  cw_unit(u);
  cw_cross(plane.normal, u, v);
  Polygon polygon;
  for (int i = 0; i < 4; i++) {
    std::array<double, 3> x;
    for (int k = 0; k < 3; k++)
      x[k] = plane.offset * plane.normal[k] + SIDE * ((i == 1 || i == 2 ? 1 : -1) * u[k] + (i > 1 ? 1 : -1) * v[k]);
    polygon.corner.push_back(x);
    polygon.bound.push_back(-1);
  }
  for (int side = 0; side < 6; side++) {
    CwPlane outer = bound_plane(planes, side);
    if (!(side % 2)) outer.offset = 0;
    cut(&polygon, outer, 1, side);
  }
  for (int low = number; low > 0; low = planes[low].above)
    cut(&polygon, planes[planes[low].above].plane, planes[low].side ? -1 : 1, 6 + planes[low].above);
  return polygon;
}

static double edge_length(const Polygon &polygon, size_t i) {
  return cw_distance(polygon.corner[i].data(), polygon.corner[(i + 1) % polygon.corner.size()].data());
}

// The side of the box that a CAD face is.
static int side_of(const CwCad *cad, int face) {
  double uv[2] = {0, 0}, n[3];
  cw_cad_face_normal(cad, face, uv, n);
  for (int side = 0; side < 6; side++)
    if ((side % 2 ? 1 : -1) * n[side / 2] > 0.5) return side;
  return -1;
}

// What there is of curves and corners.
struct Tally {
  double cut[PLANES][6] = {}, line[PLANES][PLANES] = {},
         edge = 0; // lengths: by plane and side, by plane and plane above, m
  int cuts = 0, lines = 0, edges = 12, on_edges = 0, on_faces = 0, triple = 0;
};

// Of the polygons; 0 where they have an edge so short that planes may be refused, or nothing is left of one.
static int tally_polygons(const std::vector<DividingPlane> &planes, Tally *tally) {
  for (int p = 0; p < (int)planes.size(); p++) {
    Polygon polygon = polygon_of(planes, p);
    size_t n = polygon.corner.size();
    if (n < 3) return 0;
    for (size_t i = 0; i < n; i++) {
      int bound = polygon.bound[i], before = polygon.bound[(i + n - 1) % n];
      if (edge_length(polygon, i) < 1e-3) return 0;
      (bound < 6 ? tally->cut[p][bound] : tally->line[p][bound - 6]) += edge_length(polygon, i);
      (bound < 6 ? tally->cuts : tally->lines)++;
      if (bound < 6 && before < 6) { // it crosses an edge of the box
        tally->on_edges++;
        tally->edges++;
      } else if (bound < 6 || before < 6) { // it divides the cut of the plane above
        tally->on_faces++;
        tally->cuts++;
      } else { // it divides the line of the two planes above
        tally->triple++;
        tally->lines++;
      }
    }
  }
  return 1;
}

static bool is_above(const std::vector<DividingPlane> &planes, int high, int low) {
  while (low > high) low = planes[low].above;
  return low == high;
}

// Adds the points where the lines of two planes on a third one cross, whose cells lie on both sides of that. 0 where
// one ends so near to the other that planes may be refused.
static int tally_crossings(const std::vector<DividingPlane> &planes, int b, int c, Tally *tally) {
  const Polygon polygon[2] = {polygon_of(planes, b), polygon_of(planes, c)};
  for (int above = 0; above < b; above++) {
    int sides = 0, lines = 0;
    for (int p = 0; p < 2; p++) {
      const CwPlane &other = planes[p ? b : c].plane;
      for (size_t i = 0; i < polygon[p].corner.size(); i++) {
        if (polygon[p].bound[i] != 6 + above) continue;
        double from = cw_plane_distance(&other, polygon[p].corner[i].data());
        double to = cw_plane_distance(&other, polygon[p].corner[(i + 1) % polygon[p].corner.size()].data());
        if (std::fmin(std::fabs(from), std::fabs(to)) < 2e-4) return 0;
        lines++;
        sides += (from > 0) != (to > 0);
      }
    }
    if (lines == 2 && sides == 2) tally->triple++, tally->lines += 2;
  }
  return 1;
}

static Tally tally_network(const DividedSolid &solid) {
  Tally tally;
  tally.edges = 0;
  for (int i = 0; i < solid.network.curve_count; i++) {
    const CwCurve &curve = solid.network.curve[i];
    double length = curve.fine_length[curve.fine_count - 1];
    int is_wall = 0;
    for (int k = 0; k < 2; k++) is_wall |= curve.face[k] >= 0 && cw_cad_face_is_wall(solid.cad, curve.face[k]);
    assert_int_equal(curve.wall, is_wall);
    if (curve.kind == CW_CURVE_EDGE) tally.edges++, tally.edge += length;
    if (curve.kind == CW_CURVE_CUT)
      tally.cuts++, tally.cut[curve.plane[0]][side_of(solid.cad, curve.face[0])] += length;
    if (curve.kind == CW_CURVE_LINE) tally.lines++, tally.line[curve.plane[1]][curve.plane[0]] += length;
    for (int p = 0; p < curve.fine_count; p++) {
      for (int k = 0; k < 2; k++) {
        if (curve.plane[k] >= 0)
          assert_near(cw_plane_distance(&solid.node[curve.plane[k]].plane, curve.fine_x[p]), 0, 1e-9);
        if (curve.face[k] < 0) continue;
        int side = side_of(solid.cad, curve.face[k]);
        assert_near(curve.fine_x[p][side / 2], side % 2 ? SIZE[side / 2] : 0, 1e-9);
      }
    }
    for (int end = 0; end < 2; end++) {
      const double *x = curve.fine_x[end ? curve.fine_count - 1 : 0];
      assert_near(cw_distance(x, solid.network.corner[curve.corner[end]].x), 0, 1e-8);
    }
  }
  return tally;
}

static std::string open_top(const TopoDS_Face &face) {
  gp_Pln plane = BRepAdaptor_Surface(face).Plane();
  int top = std::fabs(plane.Axis().Direction().Z()) > 0.5 && plane.Location().Z() > 1;
  return top ? "top,inlet" : "rest,wall";
}

// Layers start at the corners that lie on a wall: on any side of the box but the top.
static void check_corners(const CwNetwork &network) {
  for (int i = 0; i < network.corner_count; i++) {
    const double *x = network.corner[i].x;
    int on_wall = std::fabs(x[2]) < 1e-9;
    for (int k = 0; k < 2; k++) on_wall |= std::fabs(x[k]) < 1e-9 || std::fabs(x[k] - SIZE[k]) < 1e-9;
    assert_int_equal(network.corner[i].on_wall, on_wall);
  }
}

// Each plane below another one at random, on a side that no other has yet.
static std::vector<DividingPlane> random_planes(uint64_t *seed) {
  std::vector<DividingPlane> planes;
  int taken[PLANES][2] = {};
  for (int p = 0; p < PLANES; p++) {
    double x[3];
    for (int k = 0; k < 3; k++) x[k] = SIZE[k] * (0.2 + 0.6 * draw(seed));
    int above = p ? draw_below(seed, p) : -1, side = draw_below(seed, 2);
    if (p && taken[above][side]) side = !side;
    if (p && taken[above][side]) above = p - 1;
    if (p) taken[above][side] = 1;
    planes.push_back({random_plane(x, seed), above, side});
  }
  return planes;
}

static void curves_are_the_edges_of_the_polygons(void **) {
  DividedSolid solid(BRepPrimAPI_MakeBox(40, 30, 25).Shape(), open_top);
  uint64_t seed = 1;
  int tried = 0, divided = 0, triple = 0, free_corners = 0;
  while (divided < 60) {
    const std::vector<DividingPlane> planes = random_planes(&seed);
    Tally wanted;
    assert_true(++tried < 5000);
    int is_plain = tally_polygons(planes, &wanted);
    for (int b = 0; b < PLANES; b++)
      for (int c = b + 1; c < PLANES && is_plain; c++)
        is_plain = is_above(planes, b, c) || tally_crossings(planes, b, c, &wanted);
    if (!is_plain) continue;
    solid.divide(planes);
    check(
        cw_network_make(NULL, solid.cad, &solid.background, solid.inside, &solid.plan, &solid.network, &solid.outcome));
    if (solid.outcome.kind != CW_OUTCOME_DONE) fail_msg("seed at %d: %s", tried, solid.outcome.reason);
    Tally made = tally_network(solid);
    for (int p = 0; p < PLANES; p++) {
      for (int side = 0; side < 6; side++) assert_near(made.cut[p][side], wanted.cut[p][side], 1e-8);
      for (int q = 0; q < PLANES; q++) assert_near(made.line[p][q], wanted.line[p][q], 1e-8);
    }
    assert_near(made.edge, 4 * (SIZE[0] + SIZE[1] + SIZE[2]), 1e-8);
    assert_int_equal(made.cuts, wanted.cuts);
    assert_int_equal(made.lines, wanted.lines);
    assert_int_equal(made.edges, wanted.edges);
    assert_int_equal(solid.network.corner_count, 8 + wanted.on_edges + wanted.on_faces + wanted.triple);
    check_corners(solid.network);
    for (int i = 0; i < solid.network.corner_count; i++) free_corners += !solid.network.corner[i].on_wall;
    divided++;
    triple += wanted.triple;
  }
  print_message("  %d of %d divisions, %d points of three planes, %d corners off the walls\n", divided, tried, triple,
                free_corners);
  assert_true(triple > 20 && free_corners > 20);
}

// The corners that come first are the vertices of the solid, in their order.
static void vertices_come_first(void **) {
  DividedSolid solid(BRepPrimAPI_MakeBox(40, 30, 25).Shape());
  solid.divide({{{{0, 0, 1}, 0.01}, -1, 0}});
  solid.make_network();
  assert_int_equal(solid.network.corner_count, 12);
  assert_int_equal(cw_cad_vertex_count(solid.cad), 8);
  for (int v = 0; v < 8; v++) {
    double x[3];
    cw_cad_vertex_point(solid.cad, v, x);
    assert_int_equal(solid.network.corner[v].vertex, v);
    assert_near(cw_distance(solid.network.corner[v].x, x), 0, 0);
  }
  for (int i = 8; i < 12; i++) {
    const CwCorner &corner = solid.network.corner[i];
    double x[3];
    cw_cad_edge_point(solid.cad, corner.edge, corner.t, x, NULL);
    assert_near(cw_distance(corner.x, x), 0, 1e-12);
    assert_near(x[2], 0.01, 1e-9);
    assert_int_equal(corner.plane[0], 0);
  }
}

// Two planes meet in a line through both arms of a U, of 10 and 12 mm: nothing of it is left in the air between.
static void a_line_leaves_the_solid(void **) {
  const double outline[8][2] = {{0, 0}, {40, 0}, {40, 30}, {28, 30}, {28, 10}, {10, 10}, {10, 30}, {0, 30}};
  BRepBuilderAPI_MakePolygon polygon;
  for (const auto &p : outline) polygon.Add(gp_Pnt(p[0], p[1], 0));
  polygon.Close();
  DividedSolid solid(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(polygon.Wire()), gp_Vec(0, 0, 25)).Shape());
  solid.divide({{{{0, 0, 1}, 0.012}, -1, 0}, {{{0, 1, 0}, 0.02}, 0, 0}});
  solid.make_network();
  double least = 1, sum = 0;
  int lines = 0;
  for (int i = 0; i < solid.network.curve_count; i++) {
    const CwCurve &curve = solid.network.curve[i];
    if (curve.kind != CW_CURVE_LINE) continue;
    least = std::fmin(least, curve.fine_length[curve.fine_count - 1]);
    sum += curve.fine_length[curve.fine_count - 1];
    lines++;
  }
  assert_int_equal(lines, 2);
  assert_near(least, 0.010, 1e-9);
  assert_near(sum, 0.022, 1e-9);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(curves_are_the_edges_of_the_polygons),
                              cmocka_unit_test(vertices_come_first), cmocka_unit_test(a_line_leaves_the_solid)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
