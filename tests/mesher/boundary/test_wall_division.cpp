// SPDX-License-Identifier: AGPL-3.0-or-later
// Numbers and places of the mesh edges along wall curves, and what holds the columns at their vertices.
#include <algorithm>
#include <memory>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/boundary/boundary.h"
}

#include "arc_prism.h"
#include "divided_solid.h"
#include "tank.h"

static double wanted_size = 1; // m

static double size_anywhere(const void *, const double *) {
  return wanted_size;
}

// The wall curves of a solid, divided by `planes`.
struct Walls {
  DividedSolid solid;
  CwPeriodicImages images = {};
  CwBoundaryInput in = {};
  CwOpenEdges given = {};
  CwWallCurves curves = {};

  explicit Walls(const TopoDS_Shape &shape, const PatchOfFace &patch_of = all_wall,
                 const std::vector<DividingPlane> &planes = {})
      : solid(shape, patch_of) {
    if (!planes.empty()) solid.divide(planes);
    solid.make_network();
    in = {solid.cad, &solid.plan, &solid.network, &images, size_anywhere, nullptr, nullptr};
  }
  ~Walls() {
    cw_wall_curves_free(&curves);
  }
  void make() {
    check(cw_wall_curves_make(NULL, &in, &given, &curves));
    check(cw_wall_curves_audit(&curves, &solid.network));
  }
  const CwCurve &curve(int i) const {
    return solid.network.curve[i];
  }
  double length(int i) const {
    return curve(i).fine_length[curve(i).fine_count - 1];
  }
  bool is_arc(int i) const {
    return length(i) > cw_distance(curve(i).fine_x[0], curve(i).fine_x[curve(i).fine_count - 1]) * (1 + 1e-6);
  }
};

// An edge over an angle of a circle has its bow beside it: tan(angle / 4) / 2 of its length, 0.14 at 62.6 degrees. An
// arc gets edges enough for that, however long ones are wanted.
static void arcs_get_edges_for_their_bend(void **) {
  const struct {
    double degrees;
    int edges;
  } wanted[] = {{61, 1}, {64, 2}, {124, 2}, {127, 3}, {186, 3}, {189, 4}, {249, 4}, {252, 5}};
  const double most = 4 * std::atan(2 * 0.14) * 180 / M_PI;
  wanted_size = 1;
  for (const auto &one : wanted) {
    Walls walls(sector_prism(10, one.degrees * M_PI / 180, 20));
    int arcs = 0;
    assert_int_equal(one.edges, (int)std::ceil(one.degrees / most));
    walls.make();
    for (int i = 0; i < walls.curves.curve_count; i++) {
      arcs += walls.is_arc(i);
      assert_int_equal(walls.curves.curve[i].count, 1 + (walls.is_arc(i) ? one.edges : 1));
    }
    assert_int_equal(arcs, 2);
  }
}

// How far the arc of an ellipse with the half axes a and b, a quarter of it, lies beside edges between even places, the
// most, over their length: by many small steps.
static double most_beside(double a, double b, int edges) {
  enum { STEPS = 20000 };
  static double length[STEPS + 1];
  const auto x = [=](int i) { return a * std::cos(M_PI / 2 * i / STEPS); };
  const auto y = [=](int i) { return b * std::sin(M_PI / 2 * i / STEPS); };
  double most = 0;
  for (int i = 0; i < STEPS; i++) length[i + 1] = length[i] + std::hypot(x(i + 1) - x(i), y(i + 1) - y(i));
  for (int k = 0; k < edges; k++) {
    const int from = (int)(std::lower_bound(length, length + STEPS, length[STEPS] * k / edges) - length);
    const int to = (int)(std::lower_bound(length, length + STEPS, length[STEPS] * (k + 1) / edges) - length);
    const double p[2] = {x(from), y(from)}, q[2] = {x(to), y(to)};
    for (int i = from; i <= to; i++) {
      const double r[2] = {x(i), y(i)}, d = std::hypot(q[0] - p[0], q[1] - p[1]);
      most = std::fmax(most, std::fabs(cw_twice_area(p, q, r)) / (d * d));
    }
  }
  return most;
}

// An ellipse bends at the end of its longer axis most: there two even edges would not do, while the other one would.
static void edges_follow_the_sharpest_bend(void **) {
  wanted_size = 1;
  assert_true(most_beside(10, 5, 2) > 0.145 && most_beside(10, 5, 3) < 0.135);
  for (int back = 0; back < 2; back++) {
    Walls walls(quarter_prism(10, 5, back, 20));
    int arcs = 0;
    walls.make();
    for (int i = 0; i < walls.curves.curve_count; i++) {
      arcs += walls.is_arc(i);
      assert_int_equal(walls.curves.curve[i].count, walls.is_arc(i) ? 4 : 2);
    }
    assert_int_equal(arcs, 2);
  }
}

// Edges of the wanted length, as nearly as whole numbers allow, and evenly: 10, 15 and 20 mm by 2.4 mm.
static void edges_have_the_wanted_length(void **) {
  wanted_size = 2.4e-3;
  Walls walls(BRepPrimAPI_MakeBox(10, 15, 20).Shape());
  walls.make();
  int vertices = 8;
  for (int i = 0; i < walls.curves.curve_count; i++) {
    const CwCurveNodes &nodes = walls.curves.curve[i];
    const double length = walls.length(i);
    const int edges = length < 0.012 ? 4 : length < 0.017 ? 6 : 8; // 4.17, 6.25, 8.33
    assert_int_equal(nodes.count, edges + 1);
    for (int k = 0; k < edges; k++)
      assert_near(cw_distance(walls.curves.x[nodes.node[k]], walls.curves.x[nodes.node[k + 1]]), length / edges, 1e-12);
    vertices += edges - 1;
  }
  assert_int_equal(walls.curves.vertex_count, vertices);
}

// A curve that ends where it begins gets three edges, even ones.
static void a_closed_curve_gets_three_edges(void **) {
  wanted_size = 1;
  Walls walls(BRepPrimAPI_MakeBox(10, 15, 20).Shape());
  walls.solid.network.curve[5].corner[1] = walls.solid.network.curve[5].corner[0]; // as if it did
  check(cw_wall_curves_make(NULL, &walls.in, &walls.given, &walls.curves));
  for (int i = 0; i < walls.curves.curve_count; i++) assert_int_equal(walls.curves.curve[i].count, i == 5 ? 4 : 2);
  const int32_t *node = walls.curves.curve[5].node;
  assert_near(cw_distance(walls.curves.x[node[1]], walls.curves.x[node[2]]), walls.length(5) / 3, 1e-12);
}

// Points given on an arc, one of them where a plane cuts it: each piece has those inside of it, at their places. The
// other arc is divided by size.
static void given_points_are_taken(void **) {
  Walls walls(sector_prism(10, 2, 20), all_wall, {{{{1, 0, 0}, 0.004}, -1, 0}});
  wanted_size = 2e-3;
  int edge = -1, pieces = 0;
  for (int i = 0; i < walls.solid.network.curve_count && edge < 0; i++)
    if (walls.curve(i).kind == CW_CURVE_EDGE && walls.is_arc(i)) edge = walls.curve(i).edge;
  double range[2];
  cw_cad_edge_range(walls.solid.cad, edge, range);
  std::vector<double> cut;
  for (int i = 0; i < walls.solid.network.curve_count; i++)
    for (int end = 0; end < 2; end++)
      if (walls.curve(i).edge == edge) {
        const double t = walls.curve(i).fine_parameter[end ? walls.curve(i).fine_count - 1 : 0][0];
        if (t > range[0] && t < range[1]) cut.push_back(t);
      }
  assert_int_equal(cut.size(), 2);
  assert_near(cut[0], cut[1], 0);
  // The arc runs from 0 to 2, or back.
  std::vector<double> t = {
      range[0], range[0] + 0.13, range[0] + 0.3, cut[0], cut[0] + 0.111, cut[0] + 0.7 * (range[1] - cut[0]), range[1]};
  CwDividedEdge one = {edge, (int)t.size(), t.data()};
  walls.given.count = 1;
  walls.given.edge = &one;
  walls.make();
  for (int i = 0; i < walls.curves.curve_count; i++) {
    const CwCurve &curve = walls.curve(i);
    const CwCurveNodes &nodes = walls.curves.curve[i];
    if (curve.edge != edge) {
      assert_int_equal(nodes.count, 1 + (int)std::floor(walls.length(i) / wanted_size + 0.5));
      continue;
    }
    const bool lower = curve.fine_parameter[0][0] < cut[0];
    assert_int_equal(nodes.count, 4);
    for (int k = 1; k < 3; k++) {
      double x[3];
      assert_near(nodes.parameter[k][0], t[(lower ? 0 : 3) + k], 1e-12);
      cw_cad_edge_point(walls.solid.cad, edge, t[(lower ? 0 : 3) + k], x, NULL);
      assert_near(cw_distance(walls.curves.x[nodes.node[k]], x), 0, 1e-12);
    }
    pieces++;
  }
  assert_int_equal(pieces, 2);
}

// Given as one edge an arc stays one: the straight edge between its ends, with which it coincides, is halved instead.
static void given_edges_stay_whole(void **) {
  for (int is_given = 0; is_given < 2; is_given++) {
    Walls walls(segment_prism(10, 1, 20));
    std::vector<CwDividedEdge> edges;
    wanted_size = 1;
    for (int i = 0; i < walls.solid.network.curve_count; i++)
      if (walls.is_arc(i)) edges.push_back({walls.curve(i).edge, 0, nullptr});
    walls.given.count = is_given ? (int)edges.size() : 0;
    walls.given.edge = edges.data();
    walls.make();
    for (int i = 0; i < walls.curves.curve_count; i++) {
      const bool straight = !walls.is_arc(i) && walls.length(i) < 15e-3; // the others are 20 mm long
      assert_int_equal(walls.curves.curve[i].count, (is_given ? straight : walls.is_arc(i)) ? 3 : 2);
    }
  }
}

// Of a box of 40 x 30 x 20 mm with its inlet at x = 0 a plane x = 21 and one y = 14 before that; or all of it mirrored,
// the inlet at x = 40.
static Walls *box_with_inlet(bool mirrored) {
  const double first = mirrored ? 0.019 : 0.021;
  return new Walls(BRepPrimAPI_MakeBox(40, 30, 20).Shape(),
                   [=](const TopoDS_Face &face) -> std::string {
                     const gp_Ax3 axes = BRepAdaptor_Surface(face).Plane().Position();
                     const bool far = axes.Location().X() > 1;
                     return std::fabs(axes.Direction().X()) > 0.5 && far == mirrored ? "in,inlet" : "side,wall";
                   },
                   {{{{1, 0, 0}, first}, -1, 0}, {{{0, 1, 0}, 0.014}, 0, mirrored}});
}

// Of the free curves that there are one ends at the vertex: that of both planes, or of one on the inlet. Else what the
// vertex lies on holds it: a plane or the inlet.
static void check_constraint(const Walls &walls, bool mirrored, int v) {
  const double *y = walls.curves.x[v], x = mirrored ? 0.04 - y[0] : y[0];
  const CwConstraint held = walls.curves.constraint[v];
  const bool on_first = std::fabs(x - 0.021) < 1e-9, on_inlet = std::fabs(x) < 1e-9;
  const bool on_second = x < 0.022 && std::fabs(y[1] - 0.014) < 1e-9;
  if (on_second && (on_first || on_inlet)) {
    assert_int_equal(held.kind, CW_CONSTRAINT_CURVE);
    const CwCurve &curve = walls.curve(held.index);
    assert_false(curve.wall);
    assert_int_equal(curve.kind, on_first ? CW_CURVE_LINE : CW_CURVE_CUT);
    assert_true(walls.curves.corner_vertex[curve.corner[0]] == v || walls.curves.corner_vertex[curve.corner[1]] == v);
  } else if (on_first || on_second) {
    assert_int_equal(held.kind, CW_CONSTRAINT_PLANE);
    assert_int_equal(held.index, on_first ? 0 : 1);
  } else if (on_inlet) {
    assert_int_equal(held.kind, CW_CONSTRAINT_PATCH);
    assert_false(cw_cad_face_is_wall(walls.solid.cad, held.index));
  } else {
    assert_int_equal(held.kind, CW_CONSTRAINT_NONE);
    assert_int_equal(held.index, -1);
  }
}

static void columns_are_held(void **) {
  wanted_size = 2.5e-3;
  for (int mirrored = 0; mirrored < 2; mirrored++) {
    const std::unique_ptr<Walls> walls(box_with_inlet(mirrored));
    int of_kind[4] = {};
    walls->make();
    for (int v = 0; v < walls->curves.vertex_count; v++) {
      check_constraint(*walls, mirrored, v);
      of_kind[walls->curves.constraint[v].kind]++;
    }
    assert_int_equal(of_kind[CW_CONSTRAINT_CURVE], 4);
    // Edges of 2.5 mm: round the inlet and round plane 0 twice 6 + 6 over y, twice 8 over z, less two points that free
    // curves have; along plane 1, on two sides, 8 over x, less its ends.
    assert_int_equal(of_kind[CW_CONSTRAINT_PATCH], 2 * (6 + 6) + 2 * 8 - 2);
    assert_int_equal(of_kind[CW_CONSTRAINT_PLANE], of_kind[CW_CONSTRAINT_PATCH] + 2 * 7);
    for (int i = 0; i < walls->curves.curve_count; i++)
      assert_int_equal(walls->curves.curve[i].count > 0, walls->curve(i).wall);
    for (int i = 0; i < walls->solid.network.corner_count; i++)
      assert_int_equal(walls->curves.corner_vertex[i] >= 0, walls->solid.network.corner[i].on_wall);
  }
}

// Where the open face is the last one of the solid its edges have it as their second face.
static void either_face_may_be_open(void **) {
  wanted_size = 5e-3;
  Walls walls(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), [](const TopoDS_Face &face) -> std::string {
    return BRepAdaptor_Surface(face).Plane().Position().Location().Z() > 19 ? "in,inlet" : "side,wall";
  });
  walls.make();
  for (int v = 0; v < walls.curves.vertex_count; v++) {
    const bool above = walls.curves.x[v][2] > 0.0199;
    assert_int_equal(walls.curves.constraint[v].kind, above ? CW_CONSTRAINT_PATCH : CW_CONSTRAINT_NONE);
    if (above) assert_false(cw_cad_face_is_wall(walls.solid.cad, walls.curves.constraint[v].index));
  }
}

// The curve that leads away from the wall at a corner holds the column there.
static void a_free_curve_holds_its_corner(void **) {
  wanted_size = 0.01;
  Walls walls(BRepPrimAPI_MakeBox(40, 30, 20).Shape());
  CwNetwork &network = walls.solid.network;
  int corner = -1, i = 0;
  for (int c = 0; c < network.corner_count; c++)
    if (network.corner[c].x[0] > 0.03 && network.corner[c].x[1] < 0.01 && network.corner[c].x[2] > 0.01) corner = c;
  while (network.curve[i].corner[0] != corner && network.curve[i].corner[1] != corner) i++;
  network.curve[i].wall = 0;
  walls.make();
  assert_int_equal(walls.curves.constraint[walls.curves.corner_vertex[corner]].kind, CW_CONSTRAINT_CURVE);
  assert_int_equal(walls.curves.constraint[walls.curves.corner_vertex[corner]].index, i);
}

// The vertices of a tank of five equal sides: those of each side are those of the first, turned, and held by what turns
// take to one another.
static void images_are_divided_as_their_first(void **) {
  Tank tank(5, 2, true);
  DomainSurfaces &boundary = tank.boundary;
  CwWallCurves &curves = boundary.wall_curves;
  check(cw_periodic_images_make(&boundary.network, &boundary.images, &tank.outcome));
  check(cw_wall_curves_make(NULL, &boundary.input, &boundary.open_edges, &curves));
  check(cw_wall_curves_audit(&curves, &boundary.network));
  const CwImages &of = boundary.images.curve;
  for (int v = 0; v < curves.vertex_count; v++) {
    const int next = cw_image_node(&curves.images, v, 1);
    const CwConstraint a = curves.constraint[v], b = curves.constraint[next];
    double turned[3];
    cw_symmetry_turn(5, 1, curves.x[v], turned);
    assert_near(cw_distance(turned, curves.x[next]), 0, 1e-12);
    assert_int_equal(cw_image_node(&curves.images, v, 5), v);
    assert_int_equal(cw_image_node_turns(&curves.images, next), (cw_image_node_turns(&curves.images, v) + 1) % 5);
    assert_int_equal(a.kind, b.kind);
    if (a.kind == CW_CONSTRAINT_PLANE) assert_int_equal(cw_sector_turned_node(&tank.plan, 5, 1, a.index), b.index);
    if (a.kind == CW_CONSTRAINT_PATCH) assert_int_equal(tank.symmetry->face.next[a.index], b.index);
    if (a.kind == CW_CONSTRAINT_CURVE) assert_int_equal(of.next[a.index], b.index);
  }
  for (int i = 0; i < curves.curve_count; i++) {
    const CwCurveNodes &one = curves.curve[i], &next = curves.curve[of.next[i]];
    assert_int_equal(one.count, next.count);
    for (int k = 0; k < one.count; k++) {
      assert_int_equal(cw_image_node(&curves.images, one.node[k], 1), next.node[k]);
      assert_memory_equal(one.parameter[k], next.parameter[k], sizeof one.parameter[k]);
    }
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arcs_get_edges_for_their_bend),
      cmocka_unit_test(edges_follow_the_sharpest_bend),
      cmocka_unit_test(edges_have_the_wanted_length),
      cmocka_unit_test(a_closed_curve_gets_three_edges),
      cmocka_unit_test(given_points_are_taken),
      cmocka_unit_test(given_edges_stay_whole),
      cmocka_unit_test(columns_are_held),
      cmocka_unit_test(either_face_may_be_open),
      cmocka_unit_test(a_free_curve_holds_its_corner),
      cmocka_unit_test(images_are_divided_as_their_first),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
