// SPDX-License-Identifier: AGPL-3.0-or-later
// Distances from faces of a box and a cylinder, by hand, and from all faces of a wheel as
// BRepExtrema_DistShapeShape has them.
#include "cad/small_parts.hpp"

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRep_Tool.hxx>

#include "geometry/cad/face_distance.hpp"

static const double far = 1e3;

// The face of a box that lies in a plane x = `level`.
static int face_at(const TopoDS_Shape &box, double level) {
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(box);
  for (int f = 1; f <= faces.Extent(); f++) {
    bool all = true;
    for (TopExp_Explorer at(faces(f), TopAbs_VERTEX); at.More(); at.Next())
      all &= BRep_Tool::Pnt(TopoDS::Vertex(at.Current())).X() == level;
    if (all) return f - 1;
  }
  fail_msg("no such face");
  return -1;
}

static void a_box(void **) {
  const TopoDS_Shape box = small_box(0, 0, 0, 2, 3, 4);
  const int face = face_at(box, 2);
  CwFaceDistance distance(box);
  assert_near(distance.at(face, gp_Pnt(5, 1, 1), far), 3, 1e-12);         // over the face
  assert_near(distance.at(face, gp_Pnt(5, 3 + 4, 1), far), 5, 1e-12);     // beside an edge
  assert_near(distance.at(face, gp_Pnt(3, 3 + 2, 4 + 2), far), 3, 1e-12); // beside a corner
  assert_near(distance.at(face, gp_Pnt(2, 1, 1), far), 0, 1e-12);
  assert_near(distance.at(face, gp_Pnt(5, 1, 1), 2), 2, 0); // beyond the reach
}

static void a_wheel(void **) {
  const TopoDS_Shape wheel = small_rotor();
  const TopTools_IndexedMapOfShape faces = cw_cad_faces(wheel);
  CwFaceDistance distance(wheel);
  for (int i = 0; i < 40; i++) { // places all through the box of the wheel
    const gp_Pnt at(60 * std::sin(2.1 * i), 60 * std::sin(1.3 * i + 1), -30 + 40 * std::sin(3.7 * i));
    for (int f = 0; f < faces.Extent(); f++) {
      BRepExtrema_DistShapeShape wanted(BRepBuilderAPI_MakeVertex(at).Vertex(), faces(f + 1));
      assert_near(distance.at(f, at, far), wanted.Value(), 1e-9);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_box), cmocka_unit_test(a_wheel)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
