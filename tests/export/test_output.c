// SPDX-License-Identifier: AGPL-3.0-or-later
// Each format alone, and one that cannot hold the mesh beside those that can.
#include "export/output.h"

#include <stdio.h>
#include <string.h>
#include <hdf5.h>

#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static char run[sizeof test_folder + 10];
static char output[STAGE_OUTPUT_SIZE];

static int make_run(void **state) {
  SyntheticPump pump = synthetic_pump();
  if (make_test_folder(state) || stage_run_make(test_folder, &pump)) return -1;
  snprintf(run, sizeof run, "%s/run", test_folder);
  return 0;
}

static void each_format_alone(void **state) {
  static const char *const formats[][2] = {{"cgns", "pump.cgns\nrecord.json\n"},
                                           {"openfoam", "openfoam\nrecord.json\n"},
                                           {"cfx", "cfx\npump.cgns\nrecord.json\n"},
                                           {"fluent", "fluent\nrecord.json\n"},
                                           {"code_saturne", "code_saturne\npump.cgns\nrecord.json\n"},
                                           {"[fluent, openfoam]", "fluent\nopenfoam\nrecord.json\n"}};
  for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
    char more[100];
    snprintf(more, sizeof more, "export: {formats: %s}", formats[i][0]);
    if (stage_export_with(run, 2, more, output)) fail_msg("%s", output);
    stage_shell(output, "ls -A '%s/export'", run); // and nothing of the format before
    assert_string_equal(output, formats[i][1]);
  }
}

// 1.5e9 cells of one kind and as many points: beyond 2^31 faces and face corners, though not elements.
static void a_format_that_cannot_hold_the_mesh_is_left_out(void **state) {
  CwModelPatch patches[] = {{.name = "hub", .kind = CW_PATCH_WALL}};
  CwMeshRegion region = {.path = "r", .tetrahedra = 1500000000};
  CwMesh mesh = {.domain_count = 1,
                 .domains = {{.name = "rotor", .zone = "ROTOR", .patch_count = 1, .region_count = 1}},
                 .patches = patches,
                 .patch_count = 1,
                 .regions = &region,
                 .region_count = 1};
  CwRegionPlace place = {.inner.triangles = 3000000000};
  CwPatchPart part = {.faces.triangles = 10};
  CwAssembly assembly = {.mesh = &mesh,
                         .places = &place,
                         .parts = &part,
                         .patches = &part,
                         .totals = {{.points = 300000000, .cells = 1500000000}}};
  CwCase table = {.output = {.formats = 1 << CW_FORMAT_CFX | 1 << CW_FORMAT_FLUENT | 1 << CW_FORMAT_OPENFOAM,
                             .foam_processors = 1}};
  CwOutput o = {0};
  assert_int_equal(cw_output_plan(&table, &assembly, "/nowhere", &o), CW_OK);
  assert_false(cw_output_has(&o, CW_FORMAT_FLUENT));
  assert_string_equal(o.left_out[CW_FORMAT_FLUENT],
                      "fluent is left out: 3000000010 faces and 300000000 points; "
                      "Fluent's mesh file allows 2147483647 of each, which fewer mesh.cells "
                      "keep to");
  assert_true(cw_output_has(&o, CW_FORMAT_CFX));
  assert_true(cw_output_has(&o, CW_FORMAT_CGNS)); // which CFX reads
  assert_false(o.cgns.wide);
  assert_true(cw_output_has(&o, CW_FORMAT_OPENFOAM));
  assert_int_equal(o.foam.label_size, 8);
  cw_output_free(&o);
  table.output.foam_labels = CW_INTEGERS_32;
  assert_int_equal(cw_output_plan(&table, &assembly, "/nowhere", &o), CW_OK);
  assert_false(cw_output_has(&o, CW_FORMAT_OPENFOAM));
  assert_non_null(strstr(o.left_out[CW_FORMAT_OPENFOAM], "(openfoam.labels: 64 holds them)"));
  cw_output_free(&o);
  // With none left that is an error; 3e9 points want 64-bit integers of CGNS.
  table.output.formats = 1 << CW_FORMAT_FLUENT;
  assert_int_equal(cw_output_plan(&table, &assembly, "/nowhere", &o), CW_ERR_EXPORT);
  cw_output_free(&o);
  assembly.totals[0].points = 3000000000;
  table.output.formats = 1 << CW_FORMAT_CFX;
  assert_int_equal(cw_output_plan(&table, &assembly, "/nowhere", &o), CW_OK);
  assert_true(o.cgns.wide);
  cw_output_free(&o);
  table.output.cgns_integers = CW_INTEGERS_32;
  assert_int_equal(cw_output_plan(&table, &assembly, "/nowhere", &o), CW_ERR_EXPORT); // CFX goes with CGNS
  cw_output_free(&o);
}

static void cgns_of_64_bits_is_sound(void **state) {
  stage_need_program("cgnscheck");
  if (stage_export_with(run, 2, "export: {formats: cgns}\ncgns: {integers: 64}", output)) fail_msg("%s", output);
  stage_shell(output, "cd '%s' && cgnscheck export/pump.cgns", run);
  if (strstr(output, "ERROR") || strstr(output, "WARNING")) fail_msg("%s", output);
  assert_non_null(strstr(output, "rotor_to_stator"));
  char path[STAGE_PATH_SIZE + 40];
  snprintf(path, sizeof path, "%s/export/pump.cgns", run);
  hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  hid_t set = H5Dopen2(file, "pump/ROTOR/tetrahedra/ElementConnectivity/ data", H5P_DEFAULT), type = H5Dget_type(set);
  assert_true(H5Tequal(type, H5T_STD_I64LE) > 0);
  H5Tclose(type);
  H5Dclose(set);
  H5Fclose(file);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_format_alone),
      cmocka_unit_test(a_format_that_cannot_hold_the_mesh_is_left_out),
      cmocka_unit_test(cgns_of_64_bits_is_sound),
  };
  return cmocka_run_group_tests(tests, make_run, clear_test_folder);
}
