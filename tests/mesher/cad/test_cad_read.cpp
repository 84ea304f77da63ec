// SPDX-License-Identifier: AGPL-3.0-or-later
// What is read of solids whose parts are known, and which of them are refused.
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Poly_Triangulation.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>

#include "mesher/cad/cad_shape.h"
#include "solids.h"

static TopoDS_Shape box() {
  return BRepPrimAPI_MakeBox(10, 20, 30).Shape();
}

// Three quarters of a cylinder: as splines its bent face has inner knots.
static TopoDS_Shape three_quarters() {
  return BRepPrimAPI_MakeCylinder(5, 12, 1.5 * M_PI).Shape();
}

// A solid in mm, not read from a file, with a table that names its faces.
struct HandMade {
  CwFacePatch patch = {"hub", CW_PATCH_WALL};
  std::vector<CwFaceRow> row;
  CwCad cad = {};

  explicit HandMade(const TopoDS_Shape &solid) {
    cad.unit = cad.metres = 1e-3;
    cad.path = "some.brep";
    cad.solid = solid;
    cw_cad_map_parts(&cad);
    row.resize(cad.face_map.Extent());
    for (size_t f = 0; f < row.size(); f++) {
      row[f].patch = 0;
      std::snprintf(row[f].name, sizeof row[f].name, "face_%zu", f + 1);
    }
    cad.table = {(int)row.size(), 1, row.data(), &patch};
  }
};

static void expect_parts(const CwCad *cad, int faces, int edges, int vertices) {
  assert_int_equal(cad->face_map.Extent(), faces);
  assert_int_equal(cad->edge_map.Extent(), edges);
  assert_int_equal(cad->vertex_map.Extent(), vertices);
}

static TopoDS_Compound compound_of(const std::vector<TopoDS_Shape> &shapes) {
  TopoDS_Compound compound;
  BRep_Builder().MakeCompound(compound);
  for (const TopoDS_Shape &shape : shapes) BRep_Builder().Add(compound, shape);
  return compound;
}

static void write_file(const std::string &path, const char *text) {
  std::ofstream(path) << text;
}

// Text or binary, alone or in a compound; a triangulation in the file is none of ours.
static void one_solid_is_read(void **) {
  TemporaryFolder folder;
  const std::string path = folder.path + "/part.brep";
  for (int way = 0; way < 3; way++) {
    const TopoDS_Shape solid = box();
    BRepMesh_IncrementalMesh(solid, 1);
    if (way == 0) assert_true(BRepTools::Write(solid, path.c_str()));
    if (way == 1) assert_true(BinTools::Write(solid, path.c_str()));
    if (way == 2) {
      const TopoDS_Shape face = TopExp_Explorer(three_quarters(), TopAbs_FACE).Current();
      assert_true(BRepTools::Write(compound_of({face, solid}), path.c_str()));
    }
    CwCad cad = {};
    check(cw_cad_read_shape(path.c_str(), &cad));
    expect_parts(&cad, 6, 12, 8);
    assert_string_equal(cad.path.c_str(), path.c_str());
    assert_int_equal(cad.solid.ShapeType(), TopAbs_SOLID);
    for (int f = 1; f <= 6; f++) {
      TopLoc_Location location;
      assert_true(BRep_Tool::Triangulation(TopoDS::Face(cad.face_map(f)), location).IsNull());
    }
  }
}

static void refuse(const std::string &path, CwStatus code, const char *text) {
  CwCad cad = {};
  assert_int_equal(cw_cad_read_shape(path.c_str(), &cad), code);
  const std::string wanted = path + ": " + text;
  assert_string_equal(cw_fail_message(), wanted.c_str());
}

// With the message of the program, and without a word of the library's reader.
static void other_files_are_refused(void **) {
  TemporaryFolder folder;
  const std::string path = folder.path + "/part.brep";
  std::ostringstream told;
  std::streambuf *out = std::cout.rdbuf(told.rdbuf());
  refuse(path, CW_ERR_IO, "cannot be read");
  for (const char *text :
       {"", "solid part\n", "Open CASCADE Topology V4\nand no more", "\nCASCADE Topology V1, (c)\n"}) {
    write_file(path, text);
    refuse(path, CW_ERR_INPUT, "is not a B-rep file of OpenCASCADE");
  }
  assert_true(BRepTools::Write(compound_of({box(), three_quarters()}), path.c_str()));
  refuse(path, CW_ERR_INPUT, "holds 2 solids; it must hold one");
  assert_true(BRepTools::Write(TopExp_Explorer(box(), TopAbs_FACE).Current(), path.c_str()));
  refuse(path, CW_ERR_INPUT, "holds 0 solids; it must hold one");
  const bool restored = std::cout.rdbuf() == told.rdbuf();
  std::cout.rdbuf(out);
  assert_true(restored);
  assert_string_equal(told.str().c_str(), "");
}

// The eighth of a sphere has 3 arcs and 3 radii, but the degenerate edge at its pole is none. Nothing is left of the
// solid before.
static void parts_are_listed_once(void **) {
  CwCad cad = {};
  cad.solid = box();
  cw_cad_map_parts(&cad);
  expect_parts(&cad, 6, 12, 8);
  cad.solid = BRepPrimAPI_MakeSphere(5, 0, M_PI / 2, M_PI / 2).Shape();
  for (int again = 0; again < 2; again++) {
    cw_cad_map_parts(&cad);
    expect_parts(&cad, 4, 6, 4);
  }
}

// Ends of an edge are its vertices, and its curves in (u,v) lie on both its faces under it.
static void check_edges(const CwCad *cad) {
  for (const CwCadEdge &edge : cad->edge) {
    assert_int_not_equal(edge.face[0], edge.face[1]);
    assert_true(edge.range[0] < edge.range[1]);
    for (int i = 0; i <= 4; i++) {
      const double t = edge.range[0] + (edge.range[1] - edge.range[0]) * i / 4;
      const gp_Pnt on = edge.curve.Value(t);
      if (i % 4 == 0) assert_near(on.Distance(cad->vertex[edge.vertex[i / 4]]), 0, 1e-9);
      for (int side = 0; side < 2; side++) {
        const gp_Pnt2d uv = edge.pcurve[side].Value(t);
        assert_near(cad->face[edge.face[side]].surface.Value(uv.X(), uv.Y()).Distance(on), 0, 1e-7);
      }
    }
  }
}

// Of the cylinder u is periodic and v unbounded; no parameter of it, or of a plane, has knots. Forward faces have their
// normal out of the solid.
static void parts_of_a_cylinder_are_read(void **) {
  HandMade made(three_quarters());
  for (int again = 0; again < 2; again++) {
    check(cw_cad_read_parts(&made.cad));
    assert_int_equal(made.cad.face.size(), 5);
    assert_int_equal(made.cad.edge.size(), 9);
    assert_int_equal(made.cad.vertex.size(), 6);
  }
  check_edges(&made.cad);
  int bent = 0;
  for (int f = 0; f < 5; f++) {
    const CwCadFace &face = made.cad.face[f];
    assert_true(face.u_knots.knot.empty() && face.v_knots.knot.empty() && !face.pole.is);
    assert_int_equal(face.reversed, made.cad.face_map(f + 1).Orientation() == TopAbs_REVERSED);
    if (face.surface.GetType() == GeomAbs_Plane) continue;
    assert_true(face.u_range[0] == -INFINITY && face.u_range[1] == INFINITY);
    assert_true(face.v_range[0] < -1e99 && face.v_range[1] > 1e99);
    bent++;
  }
  for (const CwCadEdge &edge : made.cad.edge) assert_true(edge.knots.knot.empty() && edge.pcurve_knots[1].knot.empty());
  assert_int_equal(bent, 1);
}

static void expect_knots(const CwCadKnots &knots, int count, const std::function<double(int)> &wanted) {
  assert_int_equal(knots.knot.size(), count);
  for (int i = 0; i < count; i++) assert_near(knots.knot[i], wanted(i + 1), 0);
}

// Solids as splines: parameters have the knots and ranges of the splines.
static void splines_have_their_knots(void **) {
  int most[3] = {0, 0, 0};
  for (const TopoDS_Shape &solid : {three_quarters(), BRepPrimAPI_MakeSphere(5, -1.4, 1.4, 4).Shape()}) {
    HandMade made(BRepBuilderAPI_NurbsConvert(solid).Shape());
    check(cw_cad_read_parts(&made.cad));
    check_edges(&made.cad);
    for (const CwCadFace &face : made.cad.face) {
      const Handle(Geom_BSplineSurface) spline = face.surface.BSpline();
      expect_knots(face.u_knots, spline->NbUKnots(), [&](int i) { return spline->UKnot(i); });
      expect_knots(face.v_knots, spline->NbVKnots(), [&](int i) { return spline->VKnot(i); });
      double range[4];
      spline->Bounds(range[0], range[1], range[2], range[3]);
      for (int k = 0; k < 2; k++) {
        assert_near(face.u_range[k], range[k], 0);
        assert_near(face.v_range[k], range[2 + k], 0);
      }
      most[0] = std::max(most[0], spline->NbUKnots());
      most[1] = std::max(most[1], spline->NbVKnots());
    }
    for (const CwCadEdge &edge : made.cad.edge) {
      const Handle(Geom_BSplineCurve) spline = edge.curve.BSpline();
      expect_knots(edge.knots, spline->NbKnots(), [&](int i) { return spline->Knot(i); });
      most[2] = std::max(most[2], spline->NbKnots());
    }
  }
  assert_true(most[0] > 2 && most[2] > 2); // with inner ones; v has them where a spline is turned
}

// Of the surface that a spline with a knot at 1 of 0 to 3 sweeps one parameter is that of the spline: u of an
// extrusion, whose v has no end and no knots, v of one that was turned.
static void swept_splines_have_their_knots(void **) {
  TColgp_Array1OfPnt pole(1, 4);
  TColStd_Array1OfReal knot(1, 3);
  TColStd_Array1OfInteger times(1, 3);
  const double place[4][2] = {{6, 0}, {9, 2}, {5, 4}, {7, 8}}, parameter[3] = {0, 1, 3};
  for (int i = 0; i < 4; i++) pole(i + 1) = gp_Pnt(place[i][0], 0, place[i][1]);
  for (int i = 0; i < 3; i++) knot(i + 1) = parameter[i];
  for (int i = 1; i <= 3; i++) times(i) = i == 2 ? 1 : 3;
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(new Geom_BSplineCurve(pole, knot, times, 2)));
  wire.Add(BRepBuilderAPI_MakeEdge(pole(4), gp_Pnt(3, 0, 8)));
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(3, 0, 8), gp_Pnt(3, 0, 0)));
  wire.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(3, 0, 0), pole(1)));
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(wire.Wire());
  for (bool turned : {false, true}) {
    const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
    HandMade made(turned ? BRepPrimAPI_MakeRevol(face, axis, 2.0).Shape()
                         : BRepPrimAPI_MakePrism(face, gp_Vec(0, 9, 0)).Shape());
    check(cw_cad_read_parts(&made.cad));
    check_edges(&made.cad);
    int swept = 0;
    for (const CwCadFace &one : made.cad.face) {
      if (one.surface.GetType() != (turned ? GeomAbs_SurfaceOfRevolution : GeomAbs_SurfaceOfExtrusion)) continue;
      expect_knots(turned ? one.v_knots : one.u_knots, 3, [&](int i) { return parameter[i - 1]; });
      if (!turned) assert_true(one.v_knots.knot.empty());
      swept++;
    }
    assert_int_equal(swept, 1);
  }
}

static void refuse_parts(CwCad *cad, const std::string &text) {
  assert_int_equal(cw_cad_read_parts(cad), CW_ERR_INPUT);
  if (std::string(cw_fail_message()).find(text) == std::string::npos)
    fail_msg("'%s' is not in '%s'", text.c_str(), cw_fail_message());
}

// The message names the file, a face and the first end of the edge, in mm: here of a unit of 2 mm.
static std::string message_of(const CwCad *cad, int edge, int face, const char *what) {
  char text[300];
  const gp_Pnt p = BRep_Tool::Pnt(TopExp::FirstVertex(TopoDS::Edge(cad->edge_map(edge))));
  std::snprintf(text, sizeof text, "some.brep: face 'face_%d': the edge at (%.3f, %.3f, %.3f) mm %s", face, 2 * p.X(),
                2 * p.Y(), 2 * p.Z(), what);
  return text;
}

// A box without its lid: four edges of its sides have one face. The first of the list is told of.
static void an_edge_needs_two_faces(void **) {
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  BRep_Builder builder;
  builder.MakeShell(shell);
  for (TopExp_Explorer face(box(), TopAbs_FACE); face.More(); face.Next()) {
    const gp_Pnt middle = BRepAdaptor_Surface(TopoDS::Face(face.Current())).Value(1, 1);
    if (middle.Z() < 29) builder.Add(shell, face.Current());
  }
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  HandMade made(solid);
  made.cad.unit = 2e-3;
  int lone = 1;
  while (lone <= 12) {
    TopoDS_Vertex end[2];
    TopExp::Vertices(TopoDS::Edge(made.cad.edge_map(lone)), end[0], end[1]);
    if (BRep_Tool::Pnt(end[0]).Z() > 29 && BRep_Tool::Pnt(end[1]).Z() > 29) break;
    lone++;
  }
  int owner = 0;
  for (int f = 1; f <= 5; f++)
    for (TopExp_Explorer edge(made.cad.face_map(f), TopAbs_EDGE); edge.More(); edge.Next())
      if (edge.Current().IsSame(made.cad.edge_map(lone))) owner = f;
  refuse_parts(&made.cad, message_of(&made.cad, lone, owner, "does not have two faces; each edge needs two"));
}

static void a_seam_is_refused(void **) {
  HandMade made(BRepPrimAPI_MakeCylinder(5, 12).Shape());
  refuse_parts(&made.cad, "mm is a seam; split the face so that each edge has two different faces");
}

// Edges that lack their curve in space, in (u,v) of a bent face (that of a plane is found), or a vertex.
static void edges_need_curves_and_vertices(void **) {
  for (int lack = 0; lack < 3; lack++) {
    HandMade made(three_quarters());
    int bent = 1, damaged = 0;
    while (BRepAdaptor_Surface(TopoDS::Face(made.cad.face_map(bent))).GetType() == GeomAbs_Plane) bent++;
    for (TopExp_Explorer at(made.cad.face_map(bent), TopAbs_EDGE); at.More() && !damaged; at.Next())
      damaged = made.cad.edge_map.FindIndex(at.Current());
    TopoDS_Edge edge = TopoDS::Edge(made.cad.edge_map(damaged));
    const double tolerance = BRep_Tool::Tolerance(edge);
    if (lack == 0) BRep_Builder().UpdateEdge(edge, Handle(Geom_Curve)(), tolerance);
    if (lack == 1)
      BRep_Builder().UpdateEdge(edge, Handle(Geom2d_Curve)(), TopoDS::Face(made.cad.face_map(bent)), tolerance);
    if (lack == 2) {
      const TopoDS_Shape end = TopoDS_Iterator(edge.Oriented(TopAbs_FORWARD)).Value();
      TopoDS_Edge forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
      forward.Free(true);
      BRep_Builder().Remove(forward, end);
    }
    static const char *const WHAT[] = {"has no curve in space", "has no curve in (u,v) of that face",
                                       "has no vertex at one of its ends"};
    refuse_parts(&made.cad, WHAT[lack]);
    if (lack == 1) refuse_parts(&made.cad, "face 'face_" + std::to_string(bent) + "'");
  }
}

// All corners of a face across an axis have one coordinate alike. What the library gives no reason for has none.
static void failures_of_faces_are_placed(void **) {
  HandMade made(box());
  made.cad.unit = 2e-3;
  for (int f = 0; f < 6; f++) {
    const bool silent = f % 2;
    const CwStatus status = cw_cad_face_failure(&made.cad, f, Standard_Failure(silent ? "" : "no normal"));
    assert_int_equal(status, CW_ERR_GEOMETRY);
    const std::string name = "some.brep: face 'face_" + std::to_string(f + 1) + "' of hub, with a corner at (";
    const std::string told = cw_fail_message(), reason = silent ? "failed without a word" : "no normal";
    assert_int_equal(told.find(name), 0);
    assert_int_equal(told.rfind("; OpenCASCADE: " + reason), told.size() - 15 - reason.size());
    double x[3];
    assert_int_equal(std::sscanf(told.c_str() + name.size(), "%lf, %lf, %lf) mm", &x[0], &x[1], &x[2]), 3);
    const gp_Pln plane = BRepAdaptor_Surface(TopoDS::Face(made.cad.face_map(f + 1))).Plane();
    assert_near(plane.Distance(gp_Pnt(x[0] / 2, x[1] / 2, x[2] / 2)), 0, 1e-9);
    const double whole[3] = {20, 40, 60};
    for (int k = 0; k < 3; k++) assert_true(x[k] == 0 || x[k] == whole[k]);
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_solid_is_read),
      cmocka_unit_test(other_files_are_refused),
      cmocka_unit_test(parts_are_listed_once),
      cmocka_unit_test(parts_of_a_cylinder_are_read),
      cmocka_unit_test(splines_have_their_knots),
      cmocka_unit_test(swept_splines_have_their_knots),
      cmocka_unit_test(an_edge_needs_two_faces),
      cmocka_unit_test(a_seam_is_refused),
      cmocka_unit_test(edges_need_curves_and_vertices),
      cmocka_unit_test(failures_of_faces_are_placed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
