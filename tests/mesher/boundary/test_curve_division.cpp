// SPDX-License-Identifier: AGPL-3.0-or-later
// Prisms over figures with arcs: which edges have to be halved follows from the figure.
#include <functional>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/boundary/curve_division.h"
#include "mesher/cad/symmetry.h"
}

#include "arc_prism.h"
#include "divided_solid.h"

static const double RADIUS = 10, HEIGHT = 20; // mm

// The curves of a solid without planes, the first of each image set in one edge each.
struct Divided {
  DividedSolid solid;
  CwPeriodicImages images = {};
  CwSymmetry *symmetry = nullptr;
  CwBoundaryInput in = {};
  std::vector<CwCurveDivision> division;

  explicit Divided(const TopoDS_Shape &shape, const PatchOfFace &patch_of = all_wall, bool periodic = false)
      : solid(shape, patch_of) {
    solid.make_network();
    if (periodic) {
      check(cw_symmetry_find(solid.cad, &solid.background, &symmetry));
      assert_non_null(symmetry);
      images.symmetry = symmetry;
      check(cw_periodic_images_make(&solid.network, &images, &solid.outcome));
    }
    in.cad = solid.cad;
    in.plan = &solid.plan;
    in.network = &solid.network;
    in.images = &images;
    division.resize(solid.network.curve_count);
    for (int i = 0; i < solid.network.curve_count; i++)
      if (solid.network.curve[i].wall && cw_image_turns(&images, &images.curve, i) == 0) divide(i, 1);
  }
  ~Divided() {
    for (CwCurveDivision &one : division) free(one.point);
    cw_periodic_images_free(&images);
    cw_symmetry_free(&symmetry);
  }
  const CwCurve &curve(int i) const {
    return solid.network.curve[i];
  }
  double length(int i) const {
    return curve(i).fine_length[curve(i).fine_count - 1];
  }
  void divide(int i, int edges) {
    CwCurveDivision &of = division[i];
    free(of.point);
    of.count = edges + 1;
    of.point = (CwCurvePoint *)calloc(edges + 1, sizeof *of.point);
    for (int k = 0; k <= edges; k++) {
      of.point[k].place = length(i) * k / edges;
      cw_curve_point(&solid.network, &curve(i), of.point[k].place, of.point[k].x, of.point[k].parameter);
    }
  }
  bool is_arc(int i) const {
    return length(i) > cw_distance(curve(i).fine_x[0], curve(i).fine_x[curve(i).fine_count - 1]) * (1 + 1e-6);
  }
  bool is_at(int i, double z) const { // mm
    return std::fabs(curve(i).fine_x[0][2] - 1e-3 * z) < 1e-9 &&
           std::fabs(curve(i).fine_x[curve(i).fine_count - 1][2] - 1e-3 * z) < 1e-9;
  }
  void refine() {
    check(cw_curve_divisions_refine(NULL, &in, division.data()));
  }
  // Places ascend, and points lie there with their parameters.
  void check_places() const {
    for (int i = 0; i < solid.network.curve_count; i++) {
      const CwCurveDivision &of = division[i];
      for (int k = 0; k < of.count; k++) {
        double x[3], parameter[2];
        cw_curve_point(&solid.network, &curve(i), of.point[k].place, x, parameter);
        assert_near(cw_distance(x, of.point[k].x), 0, 0);
        assert_near(parameter[0], of.point[k].parameter[0], 0);
        if (k > 0) assert_true(of.point[k].place > of.point[k - 1].place);
      }
      if (of.count == 0) continue;
      assert_near(of.point[0].place, 0, 0);
      assert_near(of.point[of.count - 1].place, length(i), 0);
    }
  }
};

// An arc and a straight edge between the same two points coincide: the arc gets a point in its middle.
static void of_two_edges_the_bent_one_is_halved(void **) {
  Divided of(segment_prism(RADIUS, 2.5, HEIGHT));
  of.refine();
  of.check_places();
  int arcs = 0;
  for (int i = 0; i < of.solid.network.curve_count; i++) {
    arcs += of.is_arc(i);
    assert_int_equal(of.division[i].count, of.is_arc(i) ? 3 : 2);
    if (!of.is_arc(i)) continue;
    const double *x = of.division[i].point[1].x;
    assert_near(x[0], 1e-3 * RADIUS * cos(1.25), 1e-12);
    assert_near(x[1], 1e-3 * RADIUS * sin(1.25), 1e-12);
    assert_near(of.division[i].point[1].place, 1e-3 * RADIUS * 1.25, 1e-6);
  }
  assert_int_equal(arcs, 2);
}

// Curves that lie on one another, as those of a plane along an edge of a face do: no halving parts them, and few are.
static void curves_that_coincide_come_to_an_end(void **) {
  Divided of(BRepPrimAPI_MakeBox(40, 30, 20).Shape());
  CwNetwork &network = of.solid.network;
  int edges = 0, made = 0;
  for (int i = 0; i < network.curve_count; i++) of.divide(i, 10), edges += 10;
  CwCurve copy = network.curve[0], *last = &network.curve[network.curve_count - 1];
  check(cw_curve_fine_make(network.curve[0].fine_count, &copy));
  for (int k = 0; k < copy.fine_count; k++) {
    cw_copy(network.curve[0].fine_x[k], copy.fine_x[k]);
    memcpy(copy.fine_parameter[k], network.curve[0].fine_parameter[k], sizeof copy.fine_parameter[k]);
    copy.fine_length[k] = network.curve[0].fine_length[k];
  }
  cw_curve_fine_free(last);
  *last = copy;
  of.divide(network.curve_count - 1, 7);
  of.refine();
  of.check_places();
  for (int i = 0; i < network.curve_count; i++) made += of.division[i].count - 1;
  assert_true(made > edges && made < 5 * edges);
}

// Of two arcs the higher one, whichever comes first.
static void of_two_arcs_the_more_bent_is_halved(void **) {
  for (int first = 0; first < 2; first++) {
    Divided of(lens_prism(first ? 0.5 : 0.3, first ? -0.3 : -0.5, HEIGHT));
    int halved = 0;
    of.refine();
    of.check_places();
    for (int i = 0; i < of.solid.network.curve_count; i++) {
      const bool high = of.is_arc(i) && std::fabs(of.curve(i).fine_x[of.curve(i).fine_count / 2][1]) > 0.4e-3;
      assert_int_equal(of.division[i].count, high ? 3 : 2);
      halved += high;
    }
    assert_int_equal(halved, 2);
  }
}

// Where the points of the arc are given the straight edge gets one.
static void given_points_stay(void **) {
  Divided of(segment_prism(RADIUS, 2.5, HEIGHT));
  for (int i = 0; i < of.solid.network.curve_count; i++) of.division[i].given = of.is_arc(i);
  of.refine();
  of.check_places();
  int halved = 0;
  for (int i = 0; i < of.solid.network.curve_count; i++) {
    const bool beside = !of.is_arc(i) && (of.is_at(i, 0) || of.is_at(i, HEIGHT));
    assert_int_equal(of.division[i].count, beside ? 3 : 2);
    halved += beside;
  }
  assert_int_equal(halved, 2);
}

// The face above is open: only the arc below is halved.
static void open_faces_ask_for_nothing(void **) {
  Divided of(segment_prism(RADIUS, 2.5, HEIGHT), [](const TopoDS_Face &face) -> std::string {
    BRepAdaptor_Surface surface(face);
    const bool above = surface.GetType() == GeomAbs_Plane && surface.Plane().Position().Location().Z() > 0.9 * HEIGHT;
    return above ? "above,inlet" : "else,wall";
  });
  int halved = 0;
  of.refine();
  of.check_places();
  for (int i = 0; i < of.solid.network.curve_count; i++) {
    const bool below = of.is_arc(i) && of.is_at(i, 0);
    assert_int_equal(of.division[i].count, below ? 3 : 2);
    halved += below;
  }
  assert_int_equal(halved, 1);
}

// Angles that the arc from a to b has to be halved at, until no corner lies between an edge and its arc.
static void halve(double a, double b, const std::vector<gp_Pnt> &corner, std::vector<double> *angle) {
  const double middle = (a + b) / 2;
  for (const gp_Pnt &p : corner) {
    if (p.X() * std::cos(middle) + p.Y() * std::sin(middle) <= RADIUS * std::cos((b - a) / 2)) continue;
    halve(a, middle, corner, angle);
    angle->push_back(middle);
    halve(middle, b, corner, angle);
    return;
  }
}

// A post through half a cylinder, not far from its round side: the edges there run outside of it.
static void edges_run_round_what_stands_near(void **) {
  for (int place = 0; place < 4; place++) {
    static const double nearness[4] = {0.9, 0.97, 0.99, 0.999};
    const double low = -3 + place, high = low + 2 + place, near = nearness[place];
    const double top = near * std::sqrt(RADIUS * RADIUS - std::fmax(low * low, high * high));
    const std::vector<gp_Pnt> corner = {gp_Pnt(low, top, 0), gp_Pnt(high, top, 0)};
    std::vector<double> wanted;
    Divided of(BRepAlgoAPI_Cut(segment_prism(RADIUS, M_PI, HEIGHT),
                               BRepPrimAPI_MakeBox(gp_Pnt(low, 3, 0), high - low, top - 3, HEIGHT).Shape())
                   .Shape());
    // Its ends are those of the straight side, which it coincides with.
    halve(0, M_PI / 2, corner, &wanted);
    wanted.push_back(M_PI / 2);
    halve(M_PI / 2, M_PI, corner, &wanted);
    of.refine();
    of.check_places();
    int arcs = 0;
    for (int i = 0; i < of.solid.network.curve_count; i++) {
      const CwCurveDivision &division = of.division[i];
      if (!of.is_arc(i)) {
        assert_int_equal(division.count, 2);
        continue;
      }
      const bool backwards = division.point[0].x[0] < 0;
      arcs++;
      assert_int_equal(division.count, wanted.size() + 2);
      for (size_t k = 0; k < wanted.size(); k++) {
        const double *x = division.point[backwards ? wanted.size() - k : k + 1].x;
        assert_near(std::atan2(x[1], x[0]), wanted[k], 1e-6);
      }
    }
    assert_int_equal(arcs, 2);
  }
}

// A cylinder of two halves, each the other turned: on its ends, which are their own images, both arcs are one edge. The
// first of them is halved, and with it the other.
static void images_are_halved_with_their_first(void **) {
  Divided of(circle_prism(RADIUS, 2, HEIGHT), all_wall, true);
  assert_int_equal(of.symmetry->count, 2);
  of.refine();
  of.check_places();
  int halved = 0, curves = of.solid.network.curve_count;
  for (int i = 0; i < curves; i++) {
    const bool first = of.images.curve.turns[i] == 0;
    assert_int_equal(of.division[i].count, !first ? 0 : of.is_arc(i) ? 3 : 2);
    halved += of.division[i].count == 3;
  }
  assert_int_equal(curves, 6);
  assert_int_equal(halved, 2);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(of_two_edges_the_bent_one_is_halved), cmocka_unit_test(curves_that_coincide_come_to_an_end),
      cmocka_unit_test(of_two_arcs_the_more_bent_is_halved), cmocka_unit_test(given_points_stay),
      cmocka_unit_test(open_faces_ask_for_nothing),          cmocka_unit_test(edges_run_round_what_stands_near),
      cmocka_unit_test(images_are_halved_with_their_first),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
