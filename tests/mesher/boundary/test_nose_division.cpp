// SPDX-License-Identifier: AGPL-3.0-or-later
// Edges of wall curves over the tips of noses and along their sides.
#include <cmath>
#include <vector>

extern "C" {
#include "mesher/boundary/nose_division.h"
}

#include "arc_prism.h"
#include "divided_solid.h"

// The curves of a solid whose faces are walls, each divided once more from one edge.
struct Noses {
  DividedSolid solid;
  std::vector<std::vector<CwCurvePoint>> curve;

  explicit Noses(const TopoDS_Shape &shape) : solid(shape, all_wall) {
    solid.make_network();
    for (int32_t i = 0; i < solid.network.curve_count; i++) {
      int32_t count = 2;
      CwCurvePoint *point = (CwCurvePoint *)calloc(2, sizeof *point);
      for (int k = 0; k < 2; k++) point[k] = cw_curve_point_at(&solid.network, &solid.network.curve[i], k * length(i));
      check(cw_curve_divide_at_noses(&solid.network, &solid.network.curve[i], &count, &point));
      curve.push_back(std::vector<CwCurvePoint>(point, point + count));
      free(point);
      check_points(i);
    }
  }
  double length(int i) const {
    const CwCurve &of = solid.network.curve[i];
    return of.fine_length[of.fine_count - 1];
  }
  bool is_arc(int i) const {
    const CwCurve &of = solid.network.curve[i];
    return length(i) > cw_distance(of.fine_x[0], of.fine_x[of.fine_count - 1]) * (1 + 1e-6);
  }
  bool is_upright(int i) const {
    const CwCurve &of = solid.network.curve[i];
    return std::fabs(of.fine_x[0][2] - of.fine_x[of.fine_count - 1][2]) > 0.999 * length(i);
  }
  // From end to end, each at its place.
  void check_points(int i) const {
    assert_near(curve[i].front().place, 0, 0);
    assert_near(curve[i].back().place, length(i), 0);
    for (size_t k = 0; k < curve[i].size(); k++) {
      double x[3], parameter[2];
      if (k) assert_true(curve[i][k].place > curve[i][k - 1].place);
      cw_curve_point(&solid.network, &solid.network.curve[i], curve[i][k].place, x, parameter);
      assert_near(cw_distance(x, curve[i][k].x), 0, 0);
      assert_near(parameter[0], curve[i][k].parameter[0], 0);
    }
  }
};

// A plate of the thickness w with a half-round front at x = 0, 30 mm deep and 100 mm high.
static TopoDS_Shape round_front(double w) {
  const gp_Pnt a(0, -w / 2, 0), b(0, w / 2, 0), c(-30, w / 2, 0), d(-30, -w / 2, 0);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(a, gp_Pnt(w / 2, 0, 0), b).Value()));
  wire.Add(BRepBuilderAPI_MakeEdge(b, c));
  wire.Add(BRepBuilderAPI_MakeEdge(c, d));
  wire.Add(BRepBuilderAPI_MakeEdge(d, a));
  return prism_over(wire.Wire(), 100);
}

// One edge of 100 mm along each side of the front: no longer than 5 / tan(20 degrees), or 13.74 widths, but three at
// most. The flat back is as narrow and no nose. Over the front a half circle becomes two edges: its tangent leans by 90
// degrees from one, by 45 from two.
static void edges_along_a_nose_are_no_longer_than_it_is_wide(void **) {
  const struct {
    double width;
    int edges;
  } wanted[] = {{1, 3}, {2.4, 3}, {3.6, 3}, {3.7, 2}, {7.2, 2}, {7.3, 1}, {20, 1}};
  for (const auto &one : wanted) {
    const Noses noses(round_front(one.width));
    int sides = 0, arcs = 0;
    for (size_t i = 0; i < noses.curve.size(); i++) {
      const CwCurve &of = noses.solid.network.curve[i];
      const bool side = noses.is_upright((int)i) && of.fine_x[0][0] > -1e-3;
      const int edges = side ? one.edges : noses.is_arc((int)i) ? 2 : 1;
      assert_int_equal(noses.curve[i].size(), 1 + edges);
      for (int k = 0; k <= edges; k++)
        assert_near(noses.curve[i][k].place, noses.length((int)i) * k / edges, 1e-9 * noses.length((int)i));
      sides += side;
      arcs += noses.is_arc((int)i);
    }
    assert_int_equal(sides, 2);
    assert_int_equal(arcs, 2);
  }
}

// Halves the arc of an ellipse between two angles, by length, until its tangent lies within 60 degrees of the edge, or
// turns by no more than these from end to end, or halves are shorter than `least`.
static int edges_at_tip(double a, double b, double from, double to, double least) {
  enum { STEPS = 20000 };
  const double step = (to - from) / STEPS;
  const double along[2] = {a * (std::cos(to) - std::cos(from)), b * (std::sin(to) - std::sin(from))};
  const auto tangent = [=](double s) { return std::atan2(b * std::cos(s), -a * std::sin(s)); };
  double length = 0, half = 0, middle = from;
  bool turns = false;
  for (int i = 0; i < STEPS; i++) {
    const double s = from + (i + 0.5) * step, t[2] = {-a * std::sin(s), b * std::cos(s)};
    const double size = std::hypot(t[0], t[1]);
    length += size * step;
    turns |= t[0] * along[0] + t[1] * along[1] < 0.5 * size * std::hypot(along[0], along[1]);
  }
  if (!turns || std::fabs(tangent(to) - tangent(from)) < M_PI / 3 || length / 2 < least) return 1;
  for (; half < length / 2; middle += step) half += step * std::hypot(a * std::sin(middle), b * std::cos(middle));
  return edges_at_tip(a, b, from, middle, least) + edges_at_tip(a, b, middle, to, least);
}

// Long ellipses lie near one edge, but turn away from it at their tip: there the edges become shorter, down to those of
// twelve even ones.
static void edges_turn_with_a_tip(void **) {
  for (double b : {0.5, 1.0, 5.0, 10.0}) {
    const Noses noses(quarter_prism(10, b, false, 20));
    int arcs = 0;
    for (size_t i = 0; i < noses.curve.size(); i++) {
      if (!noses.is_arc((int)i)) continue;
      const double length = 1e3 * noses.length((int)i);
      const int edges = edges_at_tip(10, b, 0, M_PI / 2, length / 12);
      assert_true(b < 2 ? edges > 3 : edges < 3);
      assert_int_equal(noses.curve[i].size(), 1 + edges);
      arcs++;
    }
    assert_int_equal(arcs, 2);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(edges_along_a_nose_are_no_longer_than_it_is_wide),
      cmocka_unit_test(edges_turn_with_a_tip),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
