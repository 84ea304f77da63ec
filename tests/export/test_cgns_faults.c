// SPDX-License-Identifier: AGPL-3.0-or-later
// The audit of a CGNS file by HDF5 alone (tests/measure/cgns_audit.c) passes what the exporter wrote, and finds faults
// that are put into it.
#include "export/cgns_file.h"

#include <string.h>

#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static char output[STAGE_OUTPUT_SIZE];

static int make_run(void **state) {
  char run[STAGE_PATH_SIZE + 10];
  SyntheticPump pump = synthetic_pump();
  pump.pyramids = 1;
  if (make_test_folder(state) || stage_run_make(test_folder, &pump)) return -1;
  snprintf(run, sizeof run, "%s/run", test_folder);
  return stage_export_with(run, 2, "export: {formats: cgns}", output);
}

static int audit(const char *file) {
  return stage_shell(output, "'%s/cgns_audit' '%s/%s'", CUTWATER_BIN_DIR, test_folder, file);
}

static void what_was_written_passes(void **state) {
  if (audit("run/export/pump.cgns")) fail_msg("%s", output);
  assert_non_null(strstr(output, "\"zone\": \"ROTOR\""));
  assert_non_null(strstr(output, "\"zone\": \"STATOR\""));
}

static void faults_are_found(void **state) {
  static const struct {
    const char *array;
    int at, value;       // the integer at this place becomes this,
    int other;           // or changes places with this one, where it is 0 or more
    const char *message; // part of the line
  } faults[] = {
      {"/pump/ROTOR/tetrahedra/ElementConnectivity/ data", 401, 0, 402, "has a volume of -"},
      {"/pump/ROTOR/tetrahedra/ElementConnectivity/ data", 400, 1000000, -1, "has node 1000000; allowed: 1 to"},
      {"/pump/STATOR/prisms/ElementConnectivity/ data", 60, 0, 63, "zone STATOR, prisms"},
      {"/pump/ROTOR/hub_triangles/ElementConnectivity/ data", 30, 0, 31, "hub_triangles: a face of element"},
      {"/pump/ROTOR/prisms/ElementRange/ data", 0, 7, -1, "section prisms begins at 7"},
      {"/pump/ROTOR/ data", 1, 9, -1, "its size says 9"},
      {"/pump/ROTOR/ZoneBC/hub/PointRange/ data", 1, 5, -1, "begins at element"},
      {"/pump/ROTOR/ZoneGridConnectivity/rotor_to_stator/CellListDonor/ data", 3, 1, -1, "names face 1 at"},
      {"/pump/ROTOR/ZoneGridConnectivity/rotor_to_stator/CellListDonor/ data", 0, 0, 200, "edges from face"},
  };
  for (size_t i = 0; i < sizeof faults / sizeof *faults; ++i) {
    int32_t values[1 << 17], kept;
    assert_int_equal(stage_shell(output, "cp '%s/run/export/pump.cgns' '%s/bad.cgns'", test_folder, test_folder), 0);
    const char *path = in_test_folder("bad.cgns");
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT), set = H5Dopen2(file, faults[i].array, H5P_DEFAULT);
    hid_t space = H5Dget_space(set);
    assert_true(file >= 0 && set >= 0);
    assert_in_range(H5Sget_simple_extent_npoints(space), 1, sizeof values / sizeof *values);
    assert_true(H5Dread(set, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    kept = values[faults[i].at];
    values[faults[i].at] = faults[i].other < 0 ? faults[i].value : values[faults[i].other];
    if (faults[i].other >= 0) values[faults[i].other] = kept;
    if (values[faults[i].at] == kept) fail_msg("fault %zu is none", i);
    assert_true(H5Dwrite(set, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    H5Sclose(space);
    H5Dclose(set);
    H5Fclose(file);
    assert_int_not_equal(audit("bad.cgns"), 0);
    if (!strstr(output, faults[i].message)) fail_msg("fault %zu: no '%s' in %s", i, faults[i].message, output);
  }
}

static void a_point_that_is_moved_is_found(void **state) {
  assert_int_equal(stage_shell(output, "cp '%s/run/export/pump.cgns' '%s/bad.cgns'", test_folder, test_folder), 0);
  const char *path = in_test_folder("bad.cgns");
  hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
  hid_t set = H5Dopen2(file, "/pump/STATOR/GridCoordinates/CoordinateX/ data", H5P_DEFAULT);
  hid_t there = H5Dget_space(set), here = H5Screate(H5S_SCALAR);
  const hsize_t at = 2000, one = 1;
  double x;
  H5Sselect_hyperslab(there, H5S_SELECT_SET, &at, NULL, &one, NULL);
  assert_true(H5Dread(set, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, &x) >= 0);
  x = -x - 1;
  assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, here, there, H5P_DEFAULT, &x) >= 0);
  H5Sclose(here);
  H5Sclose(there);
  H5Dclose(set);
  H5Fclose(file);
  assert_int_not_equal(audit("bad.cgns"), 0);
  if (!strstr(output, "has a volume of -")) fail_msg("%s", output);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_was_written_passes),
      cmocka_unit_test(faults_are_found),
      cmocka_unit_test(a_point_that_is_moved_is_found),
  };
  return cmocka_run_group_tests(tests, make_run, clear_test_folder);
}
