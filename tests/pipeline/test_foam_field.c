// SPDX-License-Identifier: AGPL-3.0-or-later
// Fields of OpenFOAM: values by cell and by patch whatever bytes they hold, and one line where a file is wrong. What
// the pictures take from them (flow): the order of regions, cells and faces, the frame that turns, the scale.
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "pipeline/report/flow.h"
#include "pipeline/report/foam_field.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static FILE *begin(const char *name, const char *class) {
  FILE *file = fopen(in_test_folder(name), "w");
  assert_non_null(file);
  fprintf(file, "/* a comment */\nFoamFile\n{\n    version 2.0;\n    format binary;\n    class %s;\n", class);
  fprintf(file, "    arch \"LSB;label=32;scalar=64\";\n}\n// * //\ndimensions [0 2 -2 0 0 0 0];\n");
  return file;
}

static void put_list(FILE *file, const char *type, int components, const double *value, int count) {
  fprintf(file, "nonuniform List<%s> \n%d\n(", type, count);
  fwrite(value, sizeof *value, (size_t)(components * count), file);
  fputs(");\n", file);
}

// A number whose eight bytes are all the same character.
static double of_character(char character) {
  char bytes[8];
  double value;
  memset(bytes, character, sizeof bytes);
  memcpy(&value, bytes, sizeof value);
  return value;
}

static void values_are_those_of_the_file(void **state) {
  const double cell[] = {1, of_character('}'), of_character(';'), -4}, face[] = {of_character('{'), 7};
  const char *path = in_test_folder("p");
  double value;
  CwFoamField field = {0};
  FILE *file = begin("p", "volScalarField");
  fputs("internalField ", file);
  put_list(file, "scalar", 1, cell, 4);
  fputs("boundaryField\n{\n    hub { type zeroGradient; }\n    inlet\n    {\n        type fixed;\n        p0 ", file);
  put_list(file, "scalar", 1, face, 2);
  fputs("        value uniform 3;\n    }\n    wall\n    {\n        nested { value 9; }\n        value ", file);
  put_list(file, "scalar", 1, face, 2);
  fputs("    }\n    none { type a; value nonuniform List<scalar> 0(); }\n}\n", file);
  fclose(file);
  assert_int_equal(cw_foam_field_open(path, &field), CW_OK);
  assert_int_equal(field.cells.count, 4);
  cw_foam_field_value(&field, &field.cells, 3, &value);
  assert_true(value == -4);
  assert_null(cw_foam_field_patch(&field, "hub"));
  cw_foam_field_value(&field, cw_foam_field_patch(&field, "inlet"), 5, &value);
  assert_true(value == 3);
  cw_foam_field_value(&field, cw_foam_field_patch(&field, "wall"), 1, &value);
  assert_true(value == 7);
  assert_int_equal(cw_foam_field_patch(&field, "none")->count, 0);
  cw_foam_field_close(&field);
  // Cut short at every byte: never read past the end, always one line.
  struct stat about;
  assert_int_equal(stat(path, &about), 0);
  for (off_t size = about.st_size - 3; size >= 0; size--) {
    assert_int_equal(truncate(path, size), 0);
    assert_int_not_equal(cw_foam_field_open(path, &field), CW_OK);
    assert_non_null(strstr(cw_fail_message(), path));
    cw_foam_field_close(&field);
  }
}

// Two regions of a tetrahedron each, in a zone that turns and one that stands; their boundary on one patch each.
static void make_mesh(CwMesh *mesh, CwRegionData cells[2]) {
  static double x[][3] = {{1, 0, 0}, {2, 0, 0}, {1, 4, 0}, {0, 0, 4}}; // middle (1, 1, 1)
  static int32_t tetrahedron[][4] = {{0, 1, 2, 3}}, triangle[][3] = {{0, 2, 1}, {0, 1, 3}}, patch[] = {0, 0}, cell[2];
  static CwMeshRegion regions[] = {{.domain = 0, .tetrahedra = 1}, {.domain = 1, .tetrahedra = 1}};
  static CwModelPatch patches[] = {{.name = "hub", .kind = CW_PATCH_WALL}, {.name = "volute", .kind = CW_PATCH_WALL}};
  *mesh = (CwMesh){.domain_count = 2, .patch_count = 2, .region_count = 2, .patches = patches, .regions = regions};
  mesh->domains[0] = (CwMeshDomain){.rotating = 1, .patch_count = 1};
  mesh->domains[1] = (CwMeshDomain){.first_patch = 1, .patch_count = 1};
  for (int r = 0; r < 2; r++)
    cells[r] = (CwRegionData){.domain = r,
                              .point_count = 4,
                              .tetrahedron_count = 1,
                              .triangle_count = 2,
                              .points = x,
                              .tetrahedra = tetrahedron,
                              .triangles = triangle,
                              .triangle_patch = patch,
                              .triangle_cell = cell};
}

static void write_field(const char *name, const char *type, int components, const double *cell, int cells,
                        const char *patches) {
  FILE *file = begin(name, components == 3 ? "volVectorField" : "volScalarField");
  fputs("internalField ", file);
  put_list(file, type, components, cell, cells);
  fprintf(file, "boundaryField\n{\n%s}\n", patches);
  fclose(file);
}

static void the_flow_lies_on_the_mesh(void **state) {
  CwMesh mesh;
  CwRegionData cells[2];
  CwFlow flow = {0};
  CwCase table = {.fluid.density = 1000, .operating_point.speed = 2};
  double *share[2];
  const double p[] = {-5, 15}, u[] = {0, 2, 0, 0, 2, 0}, y_plus[] = {1, 100};
  make_mesh(&mesh, cells);
  assert_int_equal(cw_flow_open(test_folder, &mesh, &table, &flow), CW_OK);
  assert_false(flow.present); // nothing solved
  for (const char *const *name = (const char *const[]){"solve", "solve/steady", "solve/steady/90", "solve/steady/200",
                                                       "solve/steady/0", NULL};
       *name; name++)
    assert_int_equal(mkdir(in_test_folder(*name), 0777), 0);
  write_field("solve/steady/200/p", "scalar", 1, p, 2, "");
  write_field("solve/steady/200/U", "vector", 3, u, 2, "");
  FILE *file = begin("solve/steady/200/yPlus", "volScalarField");
  fputs("internalField uniform 0;\nboundaryField\n{\nhub { value ", file);
  put_list(file, "scalar", 1, y_plus, 2);
  fputs("}\n}\n", file);
  fclose(file);
  assert_int_equal(cw_flow_open(test_folder, &mesh, &table, &flow), CW_OK);
  assert_true(flow.present); // of 200: the other folders hold no field
  assert_true(flow.span[CW_FLOW_PRESSURE].least == -5 && flow.span[CW_FLOW_PRESSURE].most == 15); // kPa
  for (int r = 0; r < 2; r++) {
    assert_int_equal(cw_flow_faces(&flow, &mesh, r, &cells[r], share), CW_OK);
    for (int f = 0; f < 2; f++) {
      assert_true(share[0][f] == r);                                       // of the cell behind
      assert_true(r ? isnan(share[1][f]) : fabs(share[1][f] - f) < 1e-12); // face after face; the volute has none
    }
    free(share[0]);
    free(share[1]);
  }
  // (0, 2, 0) less 2 times (-1, 1, 0) in the frame that turns: (2, 0, 0) at (1, 1, 1); as it is in the other.
  flow.span[CW_FLOW_SPEED].most = 4;
  double velocity[3];
  cw_flow_cell_velocity(&flow, &mesh, 0, &cells[0], 0, velocity);
  assert_true(fabs(velocity[0] - 2) < 1e-12 && fabs(velocity[1]) < 1e-12 && velocity[2] == 0);
  cw_flow_cell_velocity(&flow, &mesh, 1, &cells[1], 0, velocity);
  assert_true(velocity[0] == 0 && velocity[1] == 2 && velocity[2] == 0);
  flow.angular_speed = 0.5; // (0.5, 1.5, 0)
  cw_flow_cell_velocity(&flow, &mesh, 0, &cells[0], 0, velocity);
  assert_true(fabs(velocity[0] - 0.5) < 1e-12 && fabs(velocity[1] - 1.5) < 1e-12);
  assert_true(fabs(cw_flow_speed_share(&flow, velocity) - sqrt(2.5) / 4) < 1e-12);
  cw_flow_close(&flow);
  // Of another mesh, or of another kind.
  write_field("solve/steady/200/p", "scalar", 1, (const double[]){1, 2, 3}, 3, "");
  assert_int_equal(cw_flow_open(test_folder, &mesh, &table, &flow), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "has values of 3 cells, the mesh has 2"));
  cw_flow_close(&flow);
  write_field("solve/steady/200/p", "vector", 3, u, 2, "");
  assert_int_equal(cw_flow_open(test_folder, &mesh, &table, &flow), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "3 components; it must have 1"));
  cw_flow_close(&flow);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(values_are_those_of_the_file),
      cmocka_unit_test(the_flow_lies_on_the_mesh),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
