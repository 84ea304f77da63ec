// SPDX-License-Identifier: AGPL-3.0-or-later
// Solids of known corners: what is found fault with, the mirror image, and the file. Its units have a test of their
// own, test_solid_unit.c.
#include "geometry/solid.hpp"

#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <sys/resource.h>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Standard_Failure.hxx>
#include <gp_Pln.hxx>

#include "tests/geometry/hand_solids.hpp"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

// A block of 2 x 3 x 4 whose base lies in z = 1, away from the axis.
static CwSolid block() {
  return hand_prism({gp_Pnt(5, 0, 1), gp_Pnt(7, 0, 1), gp_Pnt(7, 3, 1), gp_Pnt(5, 3, 1)}, gp_Vec(0, 0, 4));
}

static void what_a_solid_says(void **) {
  CwSolid *solid = new CwSolid(block());
  solid->unit = 5e-4;
  solid->faces[2] = {solid->faces[2].face, "outlet", CW_PATCH_OUTLET, "outlet_a"};
  assert_string_equal(cw_solid_domain(solid), "hand");
  assert_near(cw_solid_unit(solid), 5e-4, 0);
  assert_int_equal(cw_solid_face_count(solid), 6);
  for (int f = 0; f < 6; f++) {
    assert_string_equal(cw_solid_face_patch(solid, f), f == 2 ? "outlet" : "wall");
    assert_int_equal(cw_solid_face_kind(solid, f), f == 2 ? CW_PATCH_OUTLET : CW_PATCH_WALL);
  }
  assert_string_equal(cw_solid_face_name(solid, 2), "outlet_a");
  assert_string_equal(cw_solid_face_name(solid, 5), "wall_6");
  cw_solid_free(&solid);
  assert_null(solid);
  cw_solid_free(&solid);
}

static void failures_have_a_line(void **) {
  const auto guarded = [](const std::function<CwStatus()> &run) {
    return cw_solid_guard(CW_ERR_EXPORT, "the pump", "OpenCASCADE: ", run);
  };
  assert_int_equal(guarded([] { return CW_OK; }), CW_OK);
  assert_int_equal(guarded([] { return CW_ERR_IO; }), CW_ERR_IO);
  assert_int_equal(guarded([]() -> CwStatus { throw Standard_Failure("no curve"); }), CW_ERR_EXPORT);
  assert_string_equal(cw_fail_message(), "the pump: OpenCASCADE: no curve");
  assert_int_equal(guarded([]() -> CwStatus { throw Standard_Failure(); }), CW_ERR_EXPORT);
  assert_string_equal(cw_fail_message(), "the pump: OpenCASCADE: failed without a word");
  assert_int_equal(guarded([]() -> CwStatus { cw_solid_refuse("%d blades, %.1f mm", 7, 2.5); }), CW_ERR_EXPORT);
  assert_string_equal(cw_fail_message(), "the pump: 7 blades, 2.5 mm");
  cw_fail_clear();
  const std::string endless(1000, 'x');
  try {
    cw_solid_refuse("%s", endless.c_str());
  } catch (const std::runtime_error &failure) {
    assert_int_equal(strlen(failure.what()), 399);
  }
}

static void faults_name_the_face(void **) {
  const CwSolid whole = block();
  assert_string_equal(cw_solid_fault(whole).c_str(), "");
  assert_string_equal(cw_solid_fault(hand_of_faces(whole, 6)).c_str(), "");
  assert_string_equal(cw_solid_fault(hand_of_faces(whole, 5)).c_str(), "its faces do not bound a volume");
  CwSolid crossed = whole;
  BRepBuilderAPI_MakePolygon tie(gp_Pnt(1, 1, 3), gp_Pnt(2, 2, 3), gp_Pnt(2, 1, 3), gp_Pnt(1, 2, 3), Standard_True);
  crossed.faces[1].face = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 3), gp::DZ()), tie.Wire(), Standard_False).Face();
  crossed.faces[1].name = "bow";
  crossed = hand_of_faces(crossed, 6);
  for (CwSolidFace &face : crossed.faces)
    if (std::fabs(hand_centre(face.face).Z() - 3) < 1e-9 && hand_area(face.face) < 1) face.name = "bow";
  assert_string_equal(cw_solid_fault(crossed).c_str(), "the edges of face bow cross or do not fit");
}

// Heights change sign, nothing else: neither the places of faces in their order nor their names, and the solid is not
// inside out. Twice gives the solid back.
static void a_mirror_image_keeps_its_faces(void **) {
  const CwSolid before = block();
  CwSolid solid = before;
  for (int times = 1; times <= 2; times++) {
    const double sense = times == 1 ? -1 : 1;
    assert_int_equal(cw_solid_mirror(&solid), CW_OK);
    assert_string_equal(cw_solid_fault(solid).c_str(), "");
    assert_near(hand_volume(solid.solid), 24, 1e-9);
    assert_true(hand_faces_in_order(solid));
    assert_int_equal(solid.faces.size(), 6);
    for (size_t f = 0; f < 6; f++) {
      const gp_Pnt old = hand_centre(before.faces[f].face), now = hand_centre(solid.faces[f].face);
      assert_near(now.Distance(gp_Pnt(old.X(), old.Y(), sense * old.Z())), 0, 1e-9);
      assert_string_equal(solid.faces[f].name.c_str(), before.faces[f].name.c_str());
    }
  }
}

// The file holds the solid in its own unit, the same bits each time.
static void files_hold_the_solid(void **) {
  const CwSolid solid = block();
  const char *path = in_test_folder("a.brep"), *again = in_test_folder("b.brep");
  BRep_Builder builder;
  TopoDS_Shape read;
  std::string text[2];
  assert_int_equal(cw_solid_write_brep(&solid, path), CW_OK);
  assert_int_equal(cw_solid_write_brep(&solid, again), CW_OK);
  assert_true(BRepTools::Read(read, path, builder));
  assert_int_equal(read.ShapeType(), TopAbs_SOLID);
  assert_near(hand_volume(read), 24, 1e-9);
  int k = 0;
  for (const char *name : {path, again}) {
    FILE *file = fopen(name, "rb");
    for (int c; (c = fgetc(file)) != EOF;) text[k] += (char)c;
    fclose(file);
    k++;
    assert_int_equal(unlink(name), 0);
  }
  assert_true(text[0].size() > 1000 && text[0] == text[1]);
  assert_true(std::filesystem::is_empty(test_folder));
}

// On a full disk, at the begin of the file or at its very end, and in no folder: no file and no temporary one is left.
static void files_that_cannot_be_written(void **) {
  const CwSolid solid = block();
  const char *nowhere = in_test_folder("no-such-folder/a.brep"), *path = in_test_folder("a.brep");
  assert_int_equal(cw_solid_write_brep(&solid, nowhere), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), nowhere));
  assert_int_equal(cw_solid_write_brep(&solid, path), CW_OK);
  const rlim_t size = std::filesystem::file_size(path);
  assert_int_equal(unlink(path), 0);
  signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t limit : {(rlim_t)1000, size - 1}) {
    struct rlimit before, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    small = before;
    small.rlim_cur = limit;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const CwStatus status = cw_solid_write_brep(&solid, path);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(status, CW_ERR_IO);
    assert_int_equal(strncmp(cw_fail_message(), path, strlen(path)), 0);
    assert_true(std::filesystem::is_empty(test_folder));
  }
  cw_fail_clear();
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_a_solid_says),    cmocka_unit_test(failures_have_a_line),
      cmocka_unit_test(faults_name_the_face), cmocka_unit_test(a_mirror_image_keeps_its_faces),
      cmocka_unit_test(files_hold_the_solid), cmocka_unit_test(files_that_cannot_be_written),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
