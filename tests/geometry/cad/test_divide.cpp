// SPDX-License-Identifier: AGPL-3.0-or-later
// Solids of revolution with seams, poles and tips, divided: valid, of the volume that formulas give them, without a
// seam, and with one pole a face at the most.

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <gp_Circ.hxx>

#include "cad/small_pump.hpp"
#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/divide.h"

#include "tests/unit_test.h"

static const CwCadFrame frame = {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1};

static CwCadParts part_of(const TopoDS_Shape &solid) {
  CwCadPart part = {"water", small_solid_of(solid), {}};
  part.origin.resize(cw_cad_faces(part.solid).Extent());
  part.origin[0].name = "first";
  return {1e-3, {part}};
}

static void check(const TopoDS_Shape &solid, int pieces, int faces, double volume) {
  CwCadParts parts = part_of(solid);
  if (cw_cad_divide(&pieces, &frame, nullptr, &parts)) fail_msg("%s", cw_fail_message());
  const TopoDS_Shape &made = parts.part[0].solid;
  assert_true(BRepCheck_Analyzer(made).IsValid());
  assert_near(small_volume(made) / volume, 1, 1e-6);
  const TopTools_IndexedMapOfShape map = cw_cad_faces(made);
  assert_int_equal(map.Extent(), faces);
  assert_int_equal(parts.part[0].origin.size(), faces);
  for (int f = 1; f <= faces; f++) {
    int poles = 0;
    for (TopExp_Explorer at(map(f), TopAbs_EDGE); at.More(); at.Next()) {
      const TopoDS_Edge &edge = TopoDS::Edge(at.Current());
      poles += BRep_Tool::Degenerated(edge);
      assert_true(BRep_Tool::Degenerated(edge) || !BRep_Tool::IsClosed(edge, TopoDS::Face(map(f))));
    }
    assert_true(poles <= 1);
    double u[2], v[2], end[4];
    BRepTools::UVBounds(TopoDS::Face(map(f)), u[0], u[1], v[0], v[1]);
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(map(f)));
    surface->Bounds(end[0], end[1], end[2], end[3]);
    assert_true(surface->IsUPeriodic() || (u[0] > end[0] - 1e-6 && u[1] < end[1] + 1e-6));
    assert_true(surface->IsVPeriodic() || (v[0] > end[2] - 1e-6 && v[1] < end[3] + 1e-6));
  }
}

static void spheres_get_eighths_and_the_like(void **) {
  check(BRepPrimAPI_MakeSphere(7).Shape(), 4, 8, 4 * M_PI / 3 * 343);
  check(BRepPrimAPI_MakeSphere(7).Shape(), 5, 10, 4 * M_PI / 3 * 343);
}

// Lets the parameters of a periodic spline begin at a share of what they were.
static void begin_elsewhere(Geom_BSplineSurface &surface, double share) {
  double end[4];
  surface.Bounds(end[0], end[1], end[2], end[3]);
  const double u = end[0] + share * (end[1] - end[0]), v = end[2] + share * (end[3] - end[2]);
  int knot, next;
  surface.InsertUKnot(u, 1, 1e-9, Standard_False);
  surface.LocateU(u, 1e-8, knot, next);
  surface.SetUOrigin(knot);
  surface.InsertVKnot(v, 1, 1e-9, Standard_False);
  surface.LocateV(v, 1e-8, knot, next);
  surface.SetVOrigin(knot);
}

// A ring that is one periodic spline, whose parameters begin elsewhere than its face, an eighth of a turn before or
// after: of the thirds of the face one lies on either side of the end.
static void faces_over_the_end_of_their_surface(void **) {
  for (int eighth = 1; eighth < 8; eighth += 6) {
    const TopoDS_Shape ring = BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeTorus(9, 2).Shape()).Shape();
    const TopoDS_Face face = TopoDS::Face(cw_cad_faces(ring)(1));
    TopLoc_Location location;
    const auto surface = Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face, location));
    surface->SetUPeriodic();
    surface->SetVPeriodic();
    begin_elsewhere(*surface, eighth / 8.0);
    double range[4], end[4];
    BRepTools::UVBounds(face, range[0], range[1], range[2], range[3]);
    surface->Bounds(end[0], end[1], end[2], end[3]);
    assert_true(range[0] < end[0] - 0.1 && range[2] < end[2] - 0.1);
    check(ring, 3, 9, 2 * M_PI * 9 * M_PI * 4);
  }
}

static void tips_of_cones_stay(void **) {
  check(BRepPrimAPI_MakeCone(3, 0, 7).Shape(), 6, 7, M_PI * 9 * 7 / 3);
}

// Turns the region between a profile in the half plane y = 0 and the axis.
static TopoDS_Shape turned(const Handle(Geom_Curve) & profile) {
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(profile).Edge());
  const gp_Pnt begin = profile->Value(profile->FirstParameter()), end = profile->Value(profile->LastParameter());
  const gp_Pnt foot(0, 0, begin.Z());
  if (begin.X() > 1e-9) wire.Add(BRepBuilderAPI_MakeEdge(foot, begin).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(begin.X() > 1e-9 ? foot : begin, end).Edge());
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp::OZ()).Shape();
}

// A tangent ogive of base radius a and length l, the nose of a hub nut: an arc of radius (a2 + l2) / 2a.
static void ogives_keep_their_points(void **) {
  const double a = 12, l = 30, rho = (a * a + l * l) / (2 * a);
  const gp_Circ circle(gp_Ax2(gp_Pnt(a - rho, 0, 0), -gp::DY()), rho);
  const double volume = M_PI * (l * rho * rho - l * l * l / 3 - (rho - a) * rho * rho * std::asin(l / rho));
  check(turned(GC_MakeArcOfCircle(circle, gp_Pnt(a, 0, 0), gp_Pnt(0, 0, l), Standard_True).Value()), 6, 7, volume);
}

// A ring whose section, of radius r about R, reaches over the axis: an apple, cut off there.
static void rings_through_the_axis(void **) {
  const double far = 3, r = 5, dent = std::sqrt(r * r - far * far);
  const gp_Circ circle(gp_Ax2(gp_Pnt(far, 0, 0), -gp::DY()), r);
  const double half = r * r / 2 * (M_PI / 2 + std::asin(far / r)) + far / 2 * dent;
  const double volume = 4 * M_PI * (dent * dent * dent / 3 + far * half);
  check(turned(GC_MakeArcOfCircle(circle, gp_Pnt(0, 0, -dent), gp_Pnt(0, 0, dent), Standard_True).Value()), 3, 6,
        volume);
}

static void rings_beside_the_axis(void **) {
  check(BRepPrimAPI_MakeTorus(9, 2).Shape(), 3, 9, 2 * M_PI * 9 * M_PI * 4);
}

// A prism over a square that is one spline of degree 1, rounded nowhere: its wall is one face with three kinks inside.
static void kinks_become_edges(void **) {
  TColgp_Array1OfPnt corner(1, 5);
  TColStd_Array1OfReal knots(1, 5);
  TColStd_Array1OfInteger times(1, 5);
  const double at[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}};
  for (int i = 1; i <= 5; i++) {
    corner(i) = gp_Pnt(at[i - 1][0], at[i - 1][1], 0);
    knots(i) = i;
    times(i) = i == 1 || i == 5 ? 2 : 1;
  }
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(new Geom_BSplineCurve(corner, knots, times, 1)).Edge();
  const TopoDS_Face base = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(edge).Wire()).Face();
  check(BRepPrimAPI_MakePrism(base, gp_Vec(0, 0, 3)).Shape(), 2, 6, 48);
}

static void what_needs_no_cut_stays(void **) {
  CwCadParts parts = part_of(BRepPrimAPI_MakeBox(1, 2, 3).Shape());
  const TopoDS_Shape before = parts.part[0].solid;
  const int pieces = 3;
  assert_int_equal(cw_cad_divide(&pieces, &frame, nullptr, &parts), CW_OK);
  assert_true(parts.part[0].solid.IsSame(before));
  assert_string_equal(parts.part[0].origin[0].name.c_str(), "first");
}

// Pieces have the name of the face that they are of.
static void names_go_with_the_pieces(void **) {
  CwCadParts parts = part_of(BRepPrimAPI_MakeSphere(7).Shape());
  const int pieces = 4;
  assert_int_equal(cw_cad_divide(&pieces, &frame, nullptr, &parts), CW_OK);
  for (const CwCadFaceOrigin &origin : parts.part[0].origin) assert_string_equal(origin.name.c_str(), "first");
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(spheres_get_eighths_and_the_like),
                                     cmocka_unit_test(faces_over_the_end_of_their_surface),
                                     cmocka_unit_test(tips_of_cones_stay),
                                     cmocka_unit_test(ogives_keep_their_points),
                                     cmocka_unit_test(rings_through_the_axis),
                                     cmocka_unit_test(rings_beside_the_axis),
                                     cmocka_unit_test(kinks_become_edges),
                                     cmocka_unit_test(what_needs_no_cut_stays),
                                     cmocka_unit_test(names_go_with_the_pieces)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
