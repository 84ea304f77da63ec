// SPDX-License-Identifier: AGPL-3.0-or-later
// The field of a box passes; one scaled to nothing or to infinity is told with its place. The picture has the field's
// values at the centres of the triangles.
#include <cmath>
#include <fstream>
#include <string>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/size/size_audit.h"
}

#include "planned_solid.h"
#include "tests/test_folder.h"

static void fields_are_positive(void **) {
  PlannedSolid box(BRepPrimAPI_MakeBox(40, 30, 20).Shape());
  assert_int_equal(cw_size_audit(box.size, &box.background), CW_OK);
  for (double scale : {0.0, -1.0, (double)INFINITY, (double)NAN}) {
    cw_size_set_scale(box.size, scale);
    assert_int_equal(cw_size_audit(box.size, &box.background), CW_ERR_FAULT);
    assert_non_null(strstr(cw_fail_message(), "mm are wanted at ("));
  }
}

static void pictures_have_the_sizes(void **) {
  PlannedSolid box(BRepPrimAPI_MakeBox(40, 30, 20).Shape());
  const char *path = in_test_folder("size.vtk");
  assert_int_equal(cw_size_vtk(box.size, &box.background, path), CW_OK);
  std::ifstream file(path);
  std::string word;
  while (file >> word && word != "size_m") {
  }
  while (file >> word && word != "default") {
  }
  for (int t = 0; t < box.background.triangle_count; t++) {
    double value, centre[3];
    cw_background_area(&box.background, t, centre);
    assert_true(bool(file >> value));
    assert_true(value == cw_size_at(box.size, centre));
  }
  assert_false(bool(file >> word));
  std::remove(path);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(fields_are_positive),
      cmocka_unit_test(pictures_have_the_sizes),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
