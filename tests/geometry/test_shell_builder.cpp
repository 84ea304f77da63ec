// SPDX-License-Identifier: AGPL-3.0-or-later
// Shells of blocks and a cone made by hand, edge by edge: volumes by hand, tolerances by the gaps that are left.
#include "geometry/shell_builder.hpp"

#include <array>
#include <functional>

#include <BRep_Tool.hxx>
#include <ElCLib.hxx>
#include <ElSLib.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Line.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_Plane.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>

#include "tests/geometry/hand_solids.hpp"
#include "tests/unit_test.h"

static Handle(Geom2d_Curve) straight(const gp_Pnt2d &from, const gp_Pnt2d &to) {
  return new Geom2d_Line(from, gp_Dir2d(gp_Vec2d(from, to)));
}

// A builder of flat faces from vertices alone.
struct Flat {
  CwShellBuilder shell;
  std::vector<gp_Pnt> corner;
  std::vector<std::array<int, 2>> ends; // of each edge

  int vertex(const gp_Pnt &point) {
    corner.push_back(point);
    return shell.vertex(point);
  }
  int edge(int begin, int end) {
    ends.push_back({begin, end});
    const gp_Vec along(corner[begin], corner[end]);
    return shell.edge(new Geom_Line(corner[begin], gp_Dir(along)), 0, along.Magnitude(), begin, end);
  }
  // A loop of vertices as edges of a plane; an edge that is not there yet is made.
  std::vector<CwEdgeUse> loop(const Handle(Geom_Plane) & plane, const std::vector<int> &vertices) {
    std::vector<CwEdgeUse> uses;
    for (size_t i = 0; i < vertices.size(); i++) {
      const int a = vertices[i], b = vertices[(i + 1) % vertices.size()];
      int e = 0;
      while (e < (int)ends.size() && ends[e] != std::array<int, 2>{a, b} && ends[e] != std::array<int, 2>{b, a}) e++;
      if (e == (int)ends.size()) edge(a, b);
      uses.push_back({e, ends[e][0] == a, on(plane, corner[ends[e][0]], corner[ends[e][1]])});
    }
    return uses;
  }
  static Handle(Geom2d_Curve) on(const Handle(Geom_Plane) & plane, const gp_Pnt &from, const gp_Pnt &to) {
    double u[2], v[2];
    ElSLib::Parameters(plane->Pln(), from, u[0], v[0]);
    ElSLib::Parameters(plane->Pln(), to, u[1], v[1]);
    return straight(gp_Pnt2d(u[0], v[0]), gp_Pnt2d(u[1], v[1]));
  }
};

// How one face of a block is given: `place` shifts its plane along its normal.
struct Given {
  bool outward, turned;
  int first;
  double place;
};

// A block of 2 x 3 x 4, corner k with bits x, y, z. Faces are named by the axis and side: "x0" on.
static CwSolid *block(const std::function<void(int, Given &)> &change, double corner_off = 0, bool open = false) {
  Flat flat;
  for (int k = 0; k < 8; k++)
    flat.vertex(gp_Pnt(k & 1 ? 2 + (k == 7 ? corner_off : 0) : 0, k & 2 ? 3 : 0, k & 4 ? 4 : 0));
  if (corner_off) flat.corner[7] = gp_Pnt(2, 3, 4); // the edges end where they should
  for (int f = 0; f < 6; f++) {
    const int axis = f / 2, side = f % 2, x = 1 << (axis + 1) % 3, y = 1 << (axis + 2) % 3, at = side << axis;
    Given given = {side == 1, false, 0, 0};
    if (change) change(f, given);
    double normal[3] = {0, 0, 0}, along[3] = {0, 0, 0};
    normal[axis] = 1;
    along[(axis + 1) % 3] = 1;
    const gp_Dir n(normal[0], normal[1], normal[2]);
    const Handle(Geom_Plane) plane = new Geom_Plane(
        gp_Ax3(flat.corner[at].Translated(gp_Vec(n) * given.place), n, gp_Dir(along[0], along[1], along[2])));
    std::vector<int> corners = {at, at | x, at | x | y, at | y};
    if (given.turned) std::reverse(corners.begin(), corners.end());
    std::rotate(corners.begin(), corners.begin() + given.first, corners.end());
    std::vector<CwEdgeUse> loop = flat.loop(plane, corners);
    if (open && f == 5) std::swap(loop[1], loop[2]);
    flat.shell.face(plane, loop, given.outward, f == 3 ? "inlet" : "wall", f == 3 ? CW_PATCH_INLET : CW_PATCH_WALL,
                    std::string(1, "xyz"[axis]) + char('0' + side));
  }
  return flat.shell.finish("block", 5e-4);
}

// Whichever corner a loop begins at and whichever way it runs.
static void a_block_of_six_faces(void **) {
  for (int way = 0; way < 8; way++) {
    CwSolid *solid = block([&](int f, Given &given) {
      given.turned = way >> f % 3 & 1;
      given.first = (way + f) % 4;
    });
    assert_string_equal(cw_solid_fault(*solid).c_str(), "");
    assert_near(hand_volume(solid->solid), 24, 1e-9);
    assert_string_equal(solid->domain.c_str(), "block");
    assert_near(solid->unit, 5e-4, 0);
    assert_int_equal(solid->faces.size(), 6);
    assert_true(hand_faces_in_order(*solid));
    for (const CwSolidFace &face : solid->faces) {
      const gp_Pnt at = hand_centre(face.face);
      const double place[3] = {at.X() / 2, at.Y() / 3, at.Z() / 4};
      assert_near(place[face.name[0] - 'x'], face.name[1] - '0', 1e-12);
      assert_string_equal(face.patch.c_str(), face.name == "y1" ? "inlet" : "wall");
      assert_int_equal(face.kind, face.name == "y1" ? CW_PATCH_INLET : CW_PATCH_WALL);
    }
    for (TopExp_Explorer at(solid->solid, TopAbs_EDGE); at.More(); at.Next())
      assert_near(BRep_Tool::Tolerance(TopoDS::Edge(at.Current())), 1e-5, 0);
    cw_solid_free(&solid);
  }
}

static std::string failure_of(const std::function<void()> &run) {
  try {
    run();
  } catch (const Standard_Failure &failure) {
    return failure.GetMessageString();
  }
  return "";
}

// All faces the other way round make the solid inside out; one alone cannot be.
static void outward_turns_a_face(void **) {
  CwSolid *solid = block([](int, Given &given) { given.outward = !given.outward; });
  assert_near(hand_volume(solid->solid), -24, 1e-9);
  cw_solid_free(&solid);
  const std::string text = failure_of([] {
    block([](int f, Given &given) {
      if (f == 0) given.outward = !given.outward;
    });
  });
  assert_non_null(strstr(text.c_str(), "edge 0 is not shared by two faces in opposite senses"));
}

static void what_is_open_is_told(void **) {
  const std::string text = failure_of([] { block(nullptr, 0, true); });
  assert_string_equal(text.c_str(), "open loop on face z1 after edge 0");
  CwShellBuilder alone;
  const int a = alone.vertex(gp_Pnt(0, 0, 0)), b = alone.vertex(gp_Pnt(1, 0, 0));
  alone.edge(new Geom_Line(gp_Pnt(0, 0, 0), gp::DX()), 0, 1, a, b);
  assert_string_equal(failure_of([&] { alone.finish("none", 1); }).c_str(),
                      "edge 0 is not shared by two faces in opposite senses");
  CwShellBuilder tip;
  tip.pole(0, 1, tip.vertex(gp_Pnt(0, 0, 0)));
  assert_string_equal(failure_of([&] { tip.finish("none", 1); }).c_str(),
                      "edge 0 is not shared by two faces in opposite senses");
}

static double largest_tolerance(const TopoDS_Shape &solid, TopAbs_ShapeEnum kind, int *loose) {
  double most = 0;
  TopTools_IndexedMapOfShape all;
  TopExp::MapShapes(solid, kind, all);
  *loose = 0;
  for (int i = 1; i <= all.Extent(); i++) {
    const double tolerance =
        kind == TopAbs_EDGE ? BRep_Tool::Tolerance(TopoDS::Edge(all(i))) : BRep_Tool::Tolerance(TopoDS::Vertex(all(i)));
    most = std::max(most, tolerance);
    *loose += tolerance > 1e-5;
  }
  return most;
}

// Twice the gap: of a corner that lies 0.003 beside the ends of its three edges; of a plane that lies 0.004 beside its
// four edges.
static void tolerances_are_measured(void **) {
  int loose;
  CwSolid *solid = block(nullptr, 0.003);
  assert_near(largest_tolerance(solid->solid, TopAbs_EDGE, &loose), 0.006, 1e-12);
  assert_int_equal(loose, 3);
  assert_near(largest_tolerance(solid->solid, TopAbs_VERTEX, &loose), 0.006, 1e-12);
  assert_int_equal(loose, 4); // both ends of each
  cw_solid_free(&solid);
  solid = block([](int f, Given &given) { given.place = f == 1 ? 0.004 : 0; });
  assert_near(largest_tolerance(solid->solid, TopAbs_EDGE, &loose), 0.008, 1e-12);
  assert_int_equal(loose, 4);
  cw_solid_free(&solid);
}

// A spline that leaves its straight line for a thousandth of its length alone, between its knots and any hundredths: a
// quadratic hat over [0.504, 0.506] that is 3/4 of its pole high in the middle. It is seen nevertheless.
static void narrow_peaks_are_seen(void **) {
  const double knot[] = {0, 0.504, 0.504 + 0.002 / 3, 0.504 + 0.004 / 3, 0.506, 1};
  TColStd_Array1OfReal knots(1, 6);
  TColStd_Array1OfInteger times(1, 6);
  TColgp_Array1OfPnt poles(1, 7);
  for (int i = 1; i <= 6; i++) {
    knots.SetValue(i, knot[i - 1]);
    times.SetValue(i, i == 1 || i == 6 ? 3 : 1);
  }
  // A pole at the mean of its two inner knots keeps the curve on the line; the fourth has the hat.
  const double all[] = {0, 0, knot[1], knot[2], knot[3], knot[4], 1, 1};
  for (int i = 1; i <= 7; i++) poles.SetValue(i, gp_Pnt((all[i - 1] + all[i]) / 2, 0, i == 4 ? 0.04 : 0));
  const Handle(Geom_BSplineCurve) curve = new Geom_BSplineCurve(poles, knots, times, 2);
  assert_near(curve->Value(0.505).Z(), 0.03, 1e-6);
  assert_near(curve->Value(0.503).Z() + curve->Value(0.51).Z(), 0, 1e-12);
  // The edge between two half discs, or what closes like them: two faces with the same outline.
  CwShellBuilder shell;
  const int a = shell.vertex(gp_Pnt(0, 0, 0)), b = shell.vertex(gp_Pnt(1, 0, 0));
  const int hat = shell.edge(curve, 0, 1, a, b);
  const int arc = shell.edge(new Geom_Circle(gp_Ax2(gp_Pnt(0.5, 0, 0), gp::DZ()), 0.5), 0, M_PI, b, a);
  for (const bool outward : {true, false})
    shell.face(new Geom_Plane(gp_Ax3(gp::XOY())),
               {{hat, true, straight(gp_Pnt2d(0, 0), gp_Pnt2d(1, 0))},
                {arc, true, new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0.5, 0), gp_Dir2d(1, 0)), 0.5)}},
               outward, "wall", CW_PATCH_WALL, "disc");
  CwSolid *solid = shell.finish("flat", 1);
  int loose;
  assert_near(largest_tolerance(solid->solid, TopAbs_EDGE, &loose), 0.06, 2e-3);
  assert_int_equal(loose, 1);
  cw_solid_free(&solid);
}

// A block of 4 x 4 x 1 with a square hole of 2 x 2 through it: 12. Of a face with two loops the order and the common
// sense do not matter.
static void faces_may_have_holes(void **) {
  for (const bool turned : {false, true}) {
    Flat flat;
    for (const double z : {0., 1.})
      for (const double d : {0., 1.})
        for (int k = 0; k < 4; k++) flat.vertex(gp_Pnt(k == 1 || k == 2 ? 4 - d : d, k > 1 ? 4 - d : d, z));
    for (const int level : {0, 8}) {
      const Handle(Geom_Plane) plane = new Geom_Plane(gp_Ax3(flat.corner[level], gp::DZ(), gp::DX()));
      std::vector<std::vector<int>> loops = {{0, 1, 2, 3}, {7, 6, 5, 4}}; // the hole runs the other way
      std::vector<std::vector<CwEdgeUse>> uses;
      if (turned) std::swap(loops[0], loops[1]);
      for (std::vector<int> &loop : loops) {
        if (turned) std::reverse(loop.begin(), loop.end());
        for (int &v : loop) v += level;
        uses.push_back(flat.loop(plane, loop));
      }
      flat.shell.face(plane, uses, level == 8, "wall", CW_PATCH_WALL, level ? "top" : "bottom");
    }
    for (int k = 0; k < 8; k++) {
      const int next = k % 4 == 3 ? k - 3 : k + 1;
      const gp_Dir along(gp_Vec(flat.corner[k], flat.corner[next]));
      const Handle(Geom_Plane) plane = new Geom_Plane(gp_Ax3(flat.corner[k], gp::DZ().Crossed(along), along));
      flat.shell.face(plane, flat.loop(plane, {k, next, next + 8, k + 8}), k >= 4, "wall", CW_PATCH_WALL, "side");
    }
    CwSolid *solid = flat.shell.finish("frame", 1);
    assert_string_equal(cw_solid_fault(*solid).c_str(), "");
    assert_near(hand_volume(solid->solid), 12, 1e-9);
    for (const CwSolidFace &face : solid->faces)
      if (face.name != "side") assert_near(hand_area(face.face), 12, 1e-9);
    cw_solid_free(&solid);
  }
}

// A cone of radius 3 and height 4 in two halves, whose tip is a pole of either: pi 9 4 / 3.
static void a_cone_has_a_pole(void **) {
  CwShellBuilder shell;
  const double half_angle = std::atan(0.75), slant = 5;
  const int tip = shell.vertex(gp_Pnt(0, 0, 4)), right = shell.vertex(gp_Pnt(3, 0, 0)),
            left = shell.vertex(gp_Pnt(-3, 0, 0));
  const int foot[2] = {right, left};
  int side[2], arc[2], pole[2];
  for (int k = 0; k < 2; k++) {
    const gp_Pnt begin(k ? -3 : 3, 0, 0);
    side[k] = shell.edge(new Geom_Line(begin, gp_Dir(gp_Vec(begin, gp_Pnt(0, 0, 4)))), 0, slant, foot[k], tip);
    arc[k] = shell.edge(new Geom_Circle(gp_Ax2(gp::Origin(), gp::DZ(), gp::DX()), 3), k * M_PI, (k + 1) * M_PI, foot[k],
                        foot[1 - k]);
    pole[k] = shell.pole(0, M_PI, tip);
  }
  for (int k = 0; k < 2; k++) {
    // v along the side, which narrows: the axis of the surface's frame points up, its radius 3 at v = 0.
    const Handle(Geom_Surface) cone =
        new Geom_ConicalSurface(gp_Ax3(gp::Origin(), gp::DZ(), k ? -gp::DX() : gp::DX()), -half_angle, 3);
    shell.face(cone,
               {{arc[k], true, straight(gp_Pnt2d(-k * M_PI, 0), gp_Pnt2d(1, 0))},
                {side[1 - k], true, straight(gp_Pnt2d(M_PI, 0), gp_Pnt2d(M_PI, 1))},
                {pole[k], false, straight(gp_Pnt2d(0, slant), gp_Pnt2d(1, slant))},
                {side[k], false, straight(gp_Pnt2d(0, 0), gp_Pnt2d(0, 1))}},
               true, "wall", CW_PATCH_WALL, k ? "cone_2" : "cone_1");
  }
  std::vector<CwEdgeUse> base;
  for (int k = 0; k < 2; k++)
    base.push_back({arc[k], true, new Geom2d_Circle(gp_Ax2d(gp_Pnt2d(0, 0), gp_Dir2d(1, 0)), 3)});
  shell.face(new Geom_Plane(gp_Ax3(gp::Origin(), gp::DZ(), gp::DX())), base, false, "base", CW_PATCH_WALL, "base");
  CwSolid *solid = shell.finish("cone", 1);
  assert_string_equal(cw_solid_fault(*solid).c_str(), "");
  assert_near(hand_volume(solid->solid), 12 * M_PI, 1e-6);
  assert_near(hand_patch_area(*solid, "wall"), M_PI * 3 * slant, 1e-6);
  int loose;
  assert_near(largest_tolerance(solid->solid, TopAbs_EDGE, &loose), 1e-5, 0);
  cw_solid_free(&solid);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_block_of_six_faces),  cmocka_unit_test(outward_turns_a_face),
      cmocka_unit_test(what_is_open_is_told),  cmocka_unit_test(tolerances_are_measured),
      cmocka_unit_test(narrow_peaks_are_seen), cmocka_unit_test(faces_may_have_holes),
      cmocka_unit_test(a_cone_has_a_pole),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
