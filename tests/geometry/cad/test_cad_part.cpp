// SPDX-License-Identifier: AGPL-3.0-or-later
// What all steps do with solids, on boxes, discs and flat faces of known corners.
#include "cad/small_parts.hpp"

#include <stdexcept>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepClass_FaceClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom_Plane.hxx>
#include <Standard_Failure.hxx>
#include <gp_Circ.hxx>

// A flat face in z = 0 of these corners.
static TopoDS_Face flat(const std::initializer_list<gp_Pnt> &corners) {
  BRepBuilderAPI_MakePolygon outline;
  for (const gp_Pnt &corner : corners) outline.Add(corner);
  outline.Close();
  return BRepBuilderAPI_MakeFace(gp_Pln(gp::XOY()), outline.Wire()).Face();
}

// Across everything at x = `level`.
static TopoDS_Face wall_at(double level) {
  return BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(level, 0, 0), gp::DX()), -100, 100, -100, 100).Face();
}

static void exceptions_become_failures(void **) {
  assert_int_equal(cw_cad_guard("domain a", [] { return CW_OK; }), CW_OK);
  assert_int_equal(cw_cad_guard("domain a", [] { return CW_ERR_INPUT; }), CW_ERR_INPUT);
  assert_int_equal(cw_cad_guard("domain a", []() -> CwStatus { throw Standard_Failure("no wire"); }), CW_ERR_GEOMETRY);
  assert_string_equal(cw_fail_message(), "domain a: OpenCASCADE: no wire");
  cw_fail_clear();
  assert_int_equal(cw_cad_guard("domain a", []() -> CwStatus { throw std::runtime_error("no room"); }),
                   CW_ERR_GEOMETRY);
  assert_string_equal(cw_fail_message(), "domain a: no room");
  cw_fail_clear();
}

// A quarter of a circle of radius 2 about the origin from the angle 0.5 on: equal angles, both ends.
static void points_of_an_edge(void **) {
  const TopoDS_Edge arc = BRepBuilderAPI_MakeEdge(gp_Circ(gp::XOY(), 2), 0.5, 0.5 + M_PI / 2).Edge();
  const std::vector<gp_Pnt> points = cw_cad_edge_points(arc, 6);
  assert_int_equal(points.size(), 7);
  for (int i = 0; i <= 6; i++) {
    const double angle = 0.5 + M_PI / 2 * i / 6;
    assert_near(points[i].Distance(gp_Pnt(2 * cos(angle), 2 * sin(angle), 0)), 0, 1e-12);
  }
}

// Of a right-angled triangle with legs of 4 the lattice of fourths has three points inside; those at the long side are
// not, nor those in the hole of a square.
static void a_lattice_inside_of_faces(void **) {
  const std::vector<gp_Pnt> three =
      cw_cad_inner_points(flat({gp_Pnt(0, 0, 0), gp_Pnt(4, 0, 0), gp_Pnt(0, 4, 0)}), 4, 100);
  assert_int_equal(three.size(), 3);
  for (const gp_Pnt &wanted : {gp_Pnt(1, 1, 0), gp_Pnt(1, 2, 0), gp_Pnt(2, 1, 0)}) {
    int found = 0;
    for (const gp_Pnt &point : three) found += point.Distance(wanted) < 1e-12;
    assert_int_equal(found, 1);
  }
  BRepBuilderAPI_MakePolygon hole;
  for (const gp_Pnt &corner : {gp_Pnt(1.5, 1.5, 0), gp_Pnt(1.5, 2.5, 0), gp_Pnt(2.5, 2.5, 0), gp_Pnt(2.5, 1.5, 0)})
    hole.Add(corner);
  hole.Close();
  const TopoDS_Face square = flat({gp_Pnt(0, 0, 0), gp_Pnt(4, 0, 0), gp_Pnt(4, 4, 0), gp_Pnt(0, 4, 0)});
  assert_int_equal(cw_cad_inner_points(square, 4, 100).size(), 9);
  assert_int_equal(cw_cad_inner_points(square, 4, 5).size(), 5);
  const TopoDS_Face frame = BRepBuilderAPI_MakeFace(square, hole.Wire()).Face();
  const std::vector<gp_Pnt> eight = cw_cad_inner_points(frame, 4, 100);
  assert_int_equal(eight.size(), 8);
  for (const gp_Pnt &point : eight) assert_true(point.Distance(gp_Pnt(2, 2, 0)) > 0.9);
}

static bool is_inside(const TopoDS_Face &face, const gp_Pnt &point) {
  return BRepClass_FaceClassifier(face, point, 1e-9).State() == TopAbs_IN;
}

// A bent strip a ten-thousandth of its length wide, which no lattice meets, has an inside nevertheless.
static void every_face_has_an_inside(void **) {
  const double wide = 1e-4;
  const TopoDS_Face square = flat({gp_Pnt(0, 0, 0), gp_Pnt(4, 0, 0), gp_Pnt(4, 4, 0), gp_Pnt(0, 4, 0)});
  const TopoDS_Face strip = flat({gp_Pnt(0, 0, 0), gp_Pnt(0.37, 1, 0), gp_Pnt(1, 0.21, 0), gp_Pnt(1, 0.21 + wide, 0),
                                  gp_Pnt(0.37, 1 + 3 * wide, 0), gp_Pnt(0, 3 * wide, 0)});
  gp_Pnt point;
  for (int n = 2; n <= 32; n *= 2) assert_true(cw_cad_inner_points(strip, n, 1).empty());
  assert_true(cw_cad_inner_point(strip, point));
  assert_true(is_inside(strip, point));
  assert_true(cw_cad_inner_point(square, point));
  assert_near(point.Distance(gp_Pnt(2, 2, 0)), 0, 1e-12);
}

// Six sides of a box as a part of which the file says a name and a number of each.
static CwCadPart named(const TopoDS_Shape &shape, const char *name) {
  CwCadPart part = {"domain", small_solid_of(shape), {}};
  part.origin.resize(cw_cad_faces(part.solid).Extent());
  for (size_t i = 0; i < part.origin.size(); i++) {
    part.origin[i].name = name;
    part.origin[i].number = (int)i;
  }
  return part;
}

// The number of the box's face that lies in x, y or z = `level`, or of a piece of it.
static int face_at(const TopoDS_Shape &solid, int axis, double level) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(solid);
  for (int f = 1; f <= faces.Extent(); f++) {
    const std::array<double, 6> box = cw_cad_box(faces(f));
    if (std::fabs(box[axis] - level) < 1e-5 && std::fabs(box[axis + 3] - level) < 1e-5) return f - 1;
  }
  return -1;
}

// Both halves of a cut box keep what the file says of five faces. The cut lies 4 from the next one: it has that face's,
// but nothing where that is too far.
static void pieces_keep_what_the_file_says(void **) {
  const CwCadPart whole = named(small_box(0, 0, 0, 8, 20, 30), "box");
  TopTools_ListOfShape tools;
  tools.Append(wall_at(4));
  const std::vector<TopoDS_Shape> halves = cw_cad_split(whole.solid, tools);
  assert_int_equal(halves.size(), 2);
  for (const double within : {1e100, 3.0})
    for (const TopoDS_Shape &half : halves) {
      CwCadPart piece = {"domain", half, {}};
      cw_cad_carry({whole}, piece, within);
      assert_int_equal(piece.origin.size(), 6);
      int kept = 0;
      for (const auto &[axis, level] :
           std::initializer_list<std::pair<int, double>>{{0, 0}, {0, 8}, {1, 0}, {1, 20}, {2, 0}, {2, 30}}) {
        const int now = face_at(half, axis, level);
        if (now < 0) continue;
        assert_int_equal(piece.origin[now].number, face_at(whole.solid, axis, level));
        assert_string_equal(piece.origin[now].name.c_str(), "box");
        kept++;
      }
      assert_int_equal(kept, 5);
      const CwCadFaceOrigin &cut = piece.origin[face_at(half, 0, 4)];
      assert_int_equal(cut.number >= 0, within > 4);
      assert_string_equal(cut.name.c_str(), within > 4 ? "box" : "");
    }
}

// Of several parts the nearest face says it; where two lie on one another, a face that is one of theirs has its own.
static void faces_go_by_their_own_part(void **) {
  const CwCadPart a = named(small_box(0, 0, 0, 10, 10, 10), "a"), b = named(small_box(10, 0, 0, 10, 10, 10), "b");
  for (const auto &from : {std::vector<CwCadPart>{a, b}, std::vector<CwCadPart>{b, a}}) {
    CwCadPart same = {"domain", a.solid, {}}, other = {"domain", small_solid_of(small_box(14, 1, 1, 5, 8, 8)), {}};
    cw_cad_carry(from, same);
    for (size_t f = 0; f < same.origin.size(); f++) {
      assert_string_equal(same.origin[f].name.c_str(), "a");
      assert_int_equal(same.origin[f].number, f);
    }
    cw_cad_carry(from, other);
    const CwCadFaceOrigin &near = other.origin[face_at(other.solid, 0, 19)]; // 1 before the face of b in x = 20
    assert_string_equal(near.name.c_str(), "b");
    assert_int_equal(near.number, face_at(b.solid, 0, 20));
  }
}

// A box for another one, 0.01 shorter and made lying: its faces keep what the file says, in the order of the new one's.
static void another_solid_for_a_part(void **) {
  CwCadPart part = named(small_box(0, 0, 0, 8, 20, 30), "box");
  const CwCadPart before = part;
  gp_Trsf turn;
  turn.SetRotation(gp::OZ(), M_PI / 2);
  const TopoDS_Shape lying = small_box(0, -7.99, 0, 20, 7.99, 30);
  const TopoDS_Shape turned = small_solid_of(BRepBuilderAPI_Transform(lying, turn, Standard_True).Shape());
  cw_cad_replace(turned, part);
  assert_true(part.solid.IsSame(turned));
  assert_string_equal(part.domain.c_str(), "domain");
  for (int axis = 0; axis < 3; axis++)
    for (const bool far : {false, true}) {
      const double level = far ? (axis == 0 ? 8 : axis == 1 ? 20 : 30) : 0;
      const int now = face_at(turned, axis, axis == 0 && far ? 7.99 : level);
      assert_int_equal(part.origin[now].number, before.origin[face_at(before.solid, axis, level)].number);
    }
}

// A wall beside a box parts nothing. One 0.0005 inside it parts a slice, but not where 0.001 counts as on its side. The
// box itself stays as it was.
static void tools_part_a_solid(void **) {
  const TopoDS_Shape box = small_solid_of(small_box(0, 0, 0, 8, 20, 30));
  const struct {
    double level, fuzzy;
    int count;
    double least;
  } cases[] = {{9, 0, 1, 4800}, {2, 0, 2, 1200}, {0.0005, 0, 2, 0.3}, {0.0005, 0.001, 1, 4800}};
  for (const auto &of : cases) {
    TopTools_ListOfShape tools;
    double sum = 0, least = 1e9;
    tools.Append(wall_at(of.level));
    const std::vector<TopoDS_Shape> solids = cw_cad_split(box, tools, of.fuzzy);
    assert_int_equal(solids.size(), of.count);
    for (const TopoDS_Shape &solid : solids) {
      sum += small_volume(solid);
      least = std::min(least, small_volume(solid));
    }
    assert_near(sum, 4800, 1e-6);
    assert_near(least, of.least, 1e-6);
    assert_int_equal(cw_cad_faces(box).Extent(), 6);
    for (TopExp_Explorer at(box, TopAbs_VERTEX); at.More(); at.Next())
      assert_near(BRep_Tool::Tolerance(TopoDS::Vertex(at.Current())), 1e-7, 1e-12);
  }
}

// Triangles that stay up to 3 within a sphere of radius 10 do not count.
static void boxes_are_those_of_the_exact_shape(void **) {
  const TopoDS_Shape sphere = BRepPrimAPI_MakeSphere(gp_Pnt(1, 2, 3), 10).Shape();
  BRepMesh_IncrementalMesh(sphere, 3);
  const std::array<double, 6> box = cw_cad_box(sphere);
  const double centre[3] = {1, 2, 3};
  for (int k = 0; k < 3; k++) {
    assert_near(box[k], centre[k] - 10, 1e-5);
    assert_near(box[k + 3], centre[k] + 10, 1e-5);
  }
}

// A pump whose axis lies along the file's x through (1, 2, 3) mm, in units of half a millimetre: 20 along the axis are
// 10 mm in x. Its own x is the file's y.
static void places_are_those_of_the_file(void **) {
  CwCadFrame frame;
  CwCaseCad cad = {};
  cad.axis[0] = 1;
  for (int k = 0; k < 3; k++) cad.point[k] = (k + 1) * 1e-3;
  cw_cad_frame_make(&cad, &frame);
  assert_string_equal(cw_cad_place(gp_Pnt(2, 4, 20), 0.5e-3, frame).c_str(), "at (11.000, 3.000, 5.000) mm");
  assert_string_equal(cw_cad_place(gp_Pnt(1.5, -2, 0.25), 1e-3, small_frame).c_str(), "at (1.500, -2.000, 0.250) mm");
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(exceptions_become_failures),         cmocka_unit_test(points_of_an_edge),
      cmocka_unit_test(a_lattice_inside_of_faces),          cmocka_unit_test(every_face_has_an_inside),
      cmocka_unit_test(pieces_keep_what_the_file_says),     cmocka_unit_test(faces_go_by_their_own_part),
      cmocka_unit_test(another_solid_for_a_part),           cmocka_unit_test(tools_part_a_solid),
      cmocka_unit_test(boxes_are_those_of_the_exact_shape), cmocka_unit_test(places_are_those_of_the_file),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
