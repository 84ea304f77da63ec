// SPDX-License-Identifier: AGPL-3.0-or-later
// Edges that two boxes have in common along an interface get the same points on both sides.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>
#include <gp_Pnt.hxx>

extern "C" {
#include "mesher/thickness/coupled_edges.h"
}

#include "solids.h"

static double size_of(const void *size, const double *) {
  return *static_cast<const double *>(size);
}

// A box of 30 x 20 mm beside x = 40 mm, on which its interface lies.
struct Side {
  CwCad *cad;
  double size;
  CwNetwork network = {};
  CwBoundaryInput in = {};
  CwOpenEdges edges = {};

  Side(double from, double to, double wanted)
      : cad(open_solid(BRepPrimAPI_MakeBox(gp_Pnt(from, 0, 0), gp_Pnt(to, 30, 20)).Shape(),
                       [](const TopoDS_Face &face) -> std::string {
                         BRepAdaptor_Surface surface(face);
                         const double x = surface.Value(0.5, 0.5).X(), y = surface.Value(0.6, 0.7).X();
                         return std::fabs(x - 40) < 1e-9 && std::fabs(y - 40) < 1e-9 ? "shared,interface" : "side,wall";
                       })),
        size(wanted) {
    in.cad = cad;
    in.network = &network;
    in.size_at = size_of;
    in.size = &size;
  }
  ~Side() {
    cw_open_edges_free(&edges);
    cw_cad_close(&cad);
  }
  // Points of a divided edge, m, by y and z.
  std::vector<std::vector<double>> points(int i) const {
    std::vector<std::vector<double>> all;
    for (int k = 0; k < edges.edge[i].count; k++) {
      double x[3];
      cw_cad_edge_point(cad, edges.edge[i].edge, edges.edge[i].t[k], x, nullptr);
      assert_near(x[0], 0.040, 1e-12);
      if (k > 0) assert_true(edges.edge[i].t[k] > edges.edge[i].t[k - 1]);
      all.push_back({x[1], x[2]});
    }
    std::sort(all.begin(), all.end());
    return all;
  }
};

// Each edge of 30 mm gets 15 mesh edges, each of 20 mm 10: by the finer size, of 2 mm, whichever side has it.
static void both_sides_have_the_points_of_the_finer(void **) {
  for (int finer = 0; finer < 2; finer++) {
    Side a(0, 40, finer ? 5e-3 : 2e-3), b(40, 60, finer ? 2e-3 : 5e-3);
    check(cw_couple_open_edges(&a.in, "shared", &a.edges, &b.in, "shared", &b.edges));
    assert_int_equal(a.edges.count, 4);
    assert_int_equal(b.edges.count, 4);
    int points = 0;
    for (int i = 0; i < 4; i++) {
      const auto here = a.points(i), there = b.points(i);
      assert_int_equal(here.size(), there.size());
      for (size_t k = 0; k < here.size(); k++) {
        assert_near(here[k][0], there[k][0], 1e-12);
        assert_near(here[k][1], there[k][1], 1e-12);
      }
      points += (int)here.size();
    }
    assert_int_equal(points, 2 * 14 + 2 * 9);
  }
}

// A plane of one side cuts an edge in its middle: that side has a corner there, the other one a point.
static void a_corner_of_one_side_is_a_point_of_the_other(void **) {
  Side a(0, 40, 5e-3), b(40, 60, 5e-3);
  check(cw_couple_open_edges(&a.in, "shared", &a.edges, &b.in, "shared", &b.edges));
  const int edge = a.edges.edge[0].edge, before[2] = {a.edges.edge[0].count, b.edges.edge[0].count};
  double range[2], middle[3];
  assert_int_equal(before[0], before[1]);
  cw_open_edges_free(&a.edges);
  cw_open_edges_free(&b.edges);
  cw_cad_edge_range(a.cad, edge, range);
  CwCorner corner = {};
  corner.edge = edge;
  corner.t = 0.6 * range[0] + 0.4 * range[1]; // where no point of before lies
  cw_cad_edge_point(a.cad, edge, corner.t, middle, nullptr);
  a.network.corner = &corner;
  a.network.corner_count = 1;
  check(cw_couple_open_edges(&a.in, "shared", &a.edges, &b.in, "shared", &b.edges));
  const auto here = a.points(0), there = b.points(0);
  assert_int_equal(here.size() + 1, there.size());
  int at_the_corner = 0;
  for (const auto &place : there) {
    const bool same = std::hypot(place[0] - middle[1], place[1] - middle[2]) < 1e-12;
    at_the_corner += same;
    assert_true(same || std::any_of(here.begin(), here.end(), [&](const std::vector<double> &own) {
                  return std::hypot(own[0] - place[0], own[1] - place[1]) < 1e-12;
                }));
  }
  assert_int_equal(at_the_corner, 1);
}

// Patches that a side does not have.
static void edges_without_a_partner_are_left_alone(void **) {
  Side a(0, 40, 5e-3), b(40, 60, 5e-3);
  check(cw_couple_open_edges(&a.in, "nowhere", &a.edges, &b.in, "shared", &b.edges));
  assert_int_equal(a.edges.count, 0);
  check(cw_couple_open_edges(&a.in, "shared", &a.edges, &b.in, "nowhere", &b.edges));
  assert_int_equal(a.edges.count, 0);
  assert_int_equal(b.edges.count, 0);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(both_sides_have_the_points_of_the_finer),
      cmocka_unit_test(a_corner_of_one_side_is_a_point_of_the_other),
      cmocka_unit_test(edges_without_a_partner_are_left_alone),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
