// SPDX-License-Identifier: AGPL-3.0-or-later
// pump.step as the reader of CAD files finds it: the names of products and faces, and the corners to the last bit, are
// those written.
#include <map>
#include <string>

#include <BRep_Tool.hxx>
#include <TopoDS.hxx>

#include "geometry/cad/cad_file.h"
#include "geometry/cad/cad_part.hpp"
#include "geometry/hydraulic_design.h"
#include "geometry/measure.h"
#include "geometry/rotor.h"
#include "geometry/solid.hpp"
#include "geometry/stator.h"
#include "geometry/step_file.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static void assert_same_corners(const TopoDS_Shape &before, const TopoDS_Shape &after) {
  TopTools_IndexedMapOfShape old, read;
  TopExp::MapShapes(before, TopAbs_VERTEX, old);
  TopExp::MapShapes(after, TopAbs_VERTEX, read);
  assert_int_equal(read.Extent(), old.Extent());
  for (int v = 1; v <= old.Extent(); v++)
    assert_near(BRep_Tool::Pnt(TopoDS::Vertex(read(v))).Distance(BRep_Tool::Pnt(TopoDS::Vertex(old(v)))), 0, 0);
}

static void names_and_corners_survive(void **) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  CwSolid *solids[2];
  CwCadBodies *bodies = nullptr;
  const char *path = in_test_folder("names.step");
  if (cw_rotor_build(&design, &solids[0]) || cw_stator_build(&design.volute, cw_solid_unit(solids[0]), &solids[1]) ||
      cw_step_write(solids, 2, path) || cw_cad_file_read(path, 0, 1e-5, &bodies))
    fail_msg("%s", cw_fail_message());
  remove(path);
  assert_int_equal(bodies->body.size(), 2);
  for (int i = 0; i < 2; i++) {
    const CwCadBody &body = bodies->body[i];
    const TopTools_IndexedMapOfShape faces = cw_cad_faces(body.solid);
    CwSolid again = {body.name, 1e-3, TopoDS::Solid(body.solid), {}};
    CwMeasuredSolid before, after;
    std::map<std::string, int> left; // faces of each patch
    assert_string_equal(body.name.c_str(), cw_solid_domain(solids[i]));
    assert_int_equal(faces.Extent(), solids[i]->faces.size());
    for (const CwSolidFace &face : solids[i]->faces) left[face.patch]++;
    for (int f = 0; f < faces.Extent(); f++) {
      again.faces.push_back({TopoDS::Face(faces(f + 1)), body.origin[f].name, CW_PATCH_WALL, ""});
      left[body.origin[f].name]--;
    }
    for (const auto &[patch, count] : left) assert_int_equal(count, 0);
    assert_int_equal(cw_measure_solid(solids[i], &before), CW_OK);
    assert_int_equal(cw_measure_solid(&again, &after), CW_OK);
    assert_true(after.valid);
    assert_near(after.volume / before.volume, 1, 1e-6);
    assert_same_corners(solids[i]->solid, body.solid); // the paper's model unit is 1 mm
    cw_solid_free(&solids[i]);
  }
  cw_cad_bodies_free(&bodies);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(names_and_corners_survive)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
