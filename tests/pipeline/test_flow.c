// SPDX-License-Identifier: AGPL-3.0-or-later
// Fields of a solved case on a mesh of two zones: which are taken, where they lie, and what their scales span.
#include "pipeline/report/flow.h"

#include <math.h>
#include <sys/stat.h>

#include "pipeline/atomic_file.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// Two regions of the rotor, of 150 and 51 tetrahedra, and one of the stator, of 200: their corners are all the same.
enum { FIRST = 150, SECOND = 51, THIRD = 200, CELLS = FIRST + SECOND + THIRD };
static CwMeshRegion regions[] = {{.domain = 0, .tetrahedra = FIRST},
                                 {.domain = 0, .tetrahedra = SECOND - 20, .prisms = 20},
                                 {.domain = 1, .tetrahedra = THIRD}};
static CwModelPatch patches[] = {{.name = "hub", .kind = CW_PATCH_WALL},
                                 {.name = "inlet", .kind = CW_PATCH_INLET},
                                 {.name = "volute", .kind = CW_PATCH_WALL}};
static const CwMesh mesh = {.domain_count = 2,
                            .domains = {{.rotating = 1, .patch_count = 2}, {.first_patch = 2, .patch_count = 1}},
                            .patch_count = 3,
                            .patches = patches,
                            .region_count = 3,
                            .regions = regions};
static const CwCase table = {.fluid.density = 800, .operating_point.speed = 10};

static FILE *begin(int iteration, const char *name, const char *class) {
  char path[60];
  snprintf(path, sizeof path, "solve/steady/%d", iteration);
  assert_int_equal(cw_make_directory(in_test_folder(path)), CW_OK);
  snprintf(path, sizeof path, "solve/steady/%d/%s", iteration, name);
  FILE *file = fopen(in_test_folder(path), "wb");
  assert_non_null(file);
  fprintf(file,
          "FoamFile\n{\n    version 2.0;\n    format binary;\n    class %s;\n    arch \"LSB;label=32;scalar=64\";\n}\n",
          class);
  return file;
}

static void put_list(FILE *file, const char *before, int components, const double *value, int count) {
  fprintf(file, "%s nonuniform List<%s> \n%d\n(", before, components == 1 ? "scalar" : "vector", count);
  fwrite(value, sizeof *value, (size_t)(components * count), file);
  fputs(");\n", file);
}

// Fields of an iteration: the pressure of cell k is k / 100 m2/s2, its velocity k / 50 (0.6, 0, 0.8) m/s; y+ by face.
static void write_fields(int iteration, const double *hub, int hub_count) {
  static double p[CELLS], u[CELLS][3];
  const double inlet[] = {7, 7, 7, 7};
  for (int k = 0; k < CELLS; k++) {
    p[k] = 0.01 * k;
    u[k][0] = 0.012 * k;
    u[k][2] = 0.016 * k;
  }
  FILE *file = begin(iteration, "p", "volScalarField");
  put_list(file, "internalField", 1, p, CELLS);
  fputs("boundaryField\n{\n}\n", file);
  fclose(file);
  file = begin(iteration, "U", "volVectorField");
  put_list(file, "internalField", 3, *u, CELLS);
  fputs("boundaryField\n{\n}\n", file);
  fclose(file);
  file = begin(iteration, "yPlus", "volScalarField");
  fputs("internalField uniform 0;\nboundaryField\n{\n    hub\n    {\n", file);
  put_list(file, "        value", 1, hub, hub_count);
  fputs("    }\n    inlet\n    {\n", file);
  put_list(file, "        value", 1, inlet, 4);
  fputs("    }\n    volute\n    {\n        value uniform 9;\n    }\n}\n", file);
  fclose(file);
}

static void remove_fields(void) {
  assert_int_equal(remove_folder(in_test_folder("solve")), 0);
}

static void open_flow(CwFlow *flow) {
  memset(flow, 0, sizeof *flow);
  if (cw_flow_open(test_folder, &mesh, &table, flow) != CW_OK) fail_msg("%s", cw_fail_message());
}

// The greatest number among the folders; others are no iterations, and 0 is the start.
static void the_latest_iteration_is_taken(void **state) {
  const double hub[] = {30};
  CwFlow flow;
  open_flow(&flow);
  assert_false(flow.present); // nothing there
  for (const char *const *name = (const char *const[]){"0", "constant", "300.orig", "1e4", NULL}; *name; name++) {
    char path[60];
    snprintf(path, sizeof path, "solve/steady/%s", *name);
    assert_int_equal(cw_make_directory(in_test_folder(path)), CW_OK);
  }
  open_flow(&flow);
  assert_false(flow.present);
  write_fields(90, hub, 1);
  write_fields(200, hub, 1);
  write_text(in_test_folder("solve/steady/90/p"), "no field");
  open_flow(&flow);
  assert_true(flow.present);
  cw_flow_close(&flow);
  assert_false(flow.present);
  remove_fields();
}

// Of 401 cells four at each end are cut off (a hundredth): pressures from 0.04 to 3.96 m2/s2 times 800 kg/m3, speeds
// from 0 to 396 / 50 m/s. y+ has three decades at the most below its greatest.
static void scales_leave_out_single_values(void **state) {
  double hub[300];
  CwFlow flow;
  for (int k = 0; k < 300; k++) hub[k] = k < 2 ? 1e9 : 10 + 0.1 * k; // with the 4 of the inlet and volute's 305 values
  write_fields(10, hub, 300);
  open_flow(&flow);
  assert_near(flow.span[CW_FLOW_PRESSURE].least, 0.04 * 0.8, 1e-12);
  assert_near(flow.span[CW_FLOW_PRESSURE].most, 3.96 * 0.8, 1e-12);
  assert_false(flow.span[CW_FLOW_PRESSURE].logarithmic);
  assert_near(flow.span[CW_FLOW_SPEED].least, 0, 0);
  assert_near(flow.span[CW_FLOW_SPEED].most, 7.92, 1e-12);
  assert_true(flow.span[CW_FLOW_Y_PLUS].logarithmic);
  // 304 values: three smallest (7, 7, 7) and three greatest (two of 1e9, 39.9) are left out.
  assert_near(flow.span[CW_FLOW_Y_PLUS].least, 7, 1e-12);
  assert_near(flow.span[CW_FLOW_Y_PLUS].most, 39.8, 1e-9);
  assert_near(cw_flow_speed_share(&flow, (double[]){0, 3, 4}), 5 / 7.92, 1e-12);
  cw_flow_close(&flow);
  for (int k = 0; k < 300; k++) hub[k] = k < 100 ? 1e-6 : 50;
  write_fields(10, hub, 300);
  open_flow(&flow);
  assert_near(flow.span[CW_FLOW_Y_PLUS].least, 0.05, 1e-12);
  assert_near(flow.span[CW_FLOW_Y_PLUS].most, 50, 1e-12);
  cw_flow_close(&flow);
  remove_fields();
}

// A region with two triangles and a quadrilateral, on cells of its own, patches of its domain.
static CwRegionData region_data(int domain, int32_t *triangle_cell, int32_t *triangle_patch, int32_t *quad_cell,
                                int32_t *quad_patch) {
  static double x[][3] = {{1, 0, 0}, {2, 0, 0}, {1, 4, 0}, {0, 0, 4}, {2, 2, 2}, {3, 0, 0}};
  static int32_t tetrahedra[FIRST + THIRD][4], prisms[20][6];
  for (int k = 0; k < FIRST + THIRD; k++) memcpy(tetrahedra[k], (int32_t[]){0, 1, 2, 3}, sizeof *tetrahedra);
  for (int k = 0; k < 20; k++) memcpy(prisms[k], (int32_t[]){0, 1, 2, 3, 4, 5}, sizeof *prisms);
  return (CwRegionData){.domain = domain,
                        .points = x,
                        .point_count = 6,
                        .tetrahedron_count = FIRST,
                        .prism_count = 20,
                        .tetrahedra = tetrahedra,
                        .prisms = prisms,
                        .triangle_count = 2,
                        .quad_count = 1,
                        .triangle_cell = triangle_cell,
                        .triangle_patch = triangle_patch,
                        .quad_cell = quad_cell,
                        .quad_patch = quad_patch};
}

static double share_of_pressure(const CwFlow *flow, double kpa) {
  const CwColourSpan *span = &flow->span[CW_FLOW_PRESSURE];
  return fmin(fmax((kpa - span->least) / (span->most - span->least), 0), 1);
}

static double share_of_y_plus(const CwFlow *flow, double y_plus) {
  const CwColourSpan *span = &flow->span[CW_FLOW_Y_PLUS];
  return log(y_plus / span->least) / log(span->most / span->least);
}

// Faces have the pressure of the cell behind them, which is counted behind those of earlier regions, and the y+ of the
// next face of their patch. Inlets have none.
static void faces_have_values_of_their_cells(void **state) {
  double hub[8], *share[2];
  int32_t triangle_cell[] = {33, 149}, triangle_patch[] = {0, 1}, quad_cell[] = {70}, quad_patch[] = {0};
  CwRegionData cells = region_data(0, triangle_cell, triangle_patch, quad_cell, quad_patch);
  CwFlow flow;
  for (int k = 0; k < 8; k++) hub[k] = 20 + k;
  write_fields(10, hub, 8);
  open_flow(&flow);
  assert_int_equal(cw_flow_faces(&flow, &mesh, 0, &cells, share), CW_OK);
  assert_near(share[0][0], share_of_pressure(&flow, 0.8 * 0.33), 1e-12);
  assert_near(share[0][1], share_of_pressure(&flow, 0.8 * 1.49), 1e-12);
  assert_near(share[0][2], share_of_pressure(&flow, 0.8 * 0.70), 1e-12);
  assert_near(share[1][0], share_of_y_plus(&flow, 20), 1e-12);
  assert_true(isnan(share[1][1]));
  assert_near(share[1][2], share_of_y_plus(&flow, 21), 1e-12);
  free(share[0]);
  free(share[1]);
  // The second region, after three faces of the hub that another process takes.
  triangle_cell[1] = quad_cell[0] = 5;
  triangle_patch[1] = 0;
  cw_flow_skip(&flow, &mesh, (const int64_t[]){3, 9, 0});
  assert_int_equal(cw_flow_faces(&flow, &mesh, 1, &cells, share), CW_OK);
  assert_near(share[0][0], share_of_pressure(&flow, 0.8 * (1.50 + 0.33)), 1e-12);
  assert_near(share[1][0], share_of_y_plus(&flow, 25), 1e-12);
  assert_near(share[1][1], share_of_y_plus(&flow, 26), 1e-12);
  assert_near(share[1][2], share_of_y_plus(&flow, 27), 1e-12);
  free(share[0]);
  free(share[1]);
  // Behind the last value of the file there is none.
  assert_int_equal(cw_flow_faces(&flow, &mesh, 1, &cells, share), CW_OK);
  for (int f = 0; f < 3; f++) assert_true(isnan(share[1][f]));
  free(share[0]);
  free(share[1]);
  // One value for a whole patch; the domain's first patch is the mesh's third.
  triangle_patch[1] = quad_patch[0] = 0;
  cells.domain = 1;
  assert_int_equal(cw_flow_faces(&flow, &mesh, 2, &cells, share), CW_OK);
  for (int f = 0; f < 3; f++) assert_near(share[1][f], share_of_y_plus(&flow, 9), 1e-12);
  assert_near(share[0][0], share_of_pressure(&flow, 0.8 * (2.01 + 0.33)), 1e-12);
  free(share[0]);
  free(share[1]);
  cw_flow_close(&flow);
  remove_fields();
}

// At the middle of the corners (1, 1, 1) of a tetrahedron and (1.5, 1, 1) of a prism the frame of the rotor moves by
// 10 (-y, x, 0) m/s; that of the stator does not.
static void velocities_are_relative_in_the_rotor(void **state) {
  const double hub[] = {30};
  int32_t none[2] = {0};
  double velocity[3];
  CwRegionData cells = region_data(0, none, none, none, none);
  CwFlow flow;
  write_fields(10, hub, 1);
  open_flow(&flow);
  cw_flow_cell_velocity(&flow, &mesh, 0, &cells, 100, velocity);
  assert_near(velocity[0], 1.2 + 10, 1e-12);
  assert_near(velocity[1], -10, 1e-12);
  assert_near(velocity[2], 1.6, 1e-12);
  cells.tetrahedron_count = SECOND - 20;
  cw_flow_cell_velocity(&flow, &mesh, 1, &cells, 40, velocity); // a prism
  assert_near(velocity[0], 2.28 + 10, 1e-12);
  assert_near(velocity[1], -15, 1e-12);
  cells.domain = 1;
  cells.tetrahedron_count = THIRD;
  cw_flow_cell_velocity(&flow, &mesh, 2, &cells, 9, velocity);
  assert_near(velocity[0], 2.52, 1e-12);
  assert_near(velocity[1], 0, 0);
  cw_flow_close(&flow);
  remove_fields();
}

static void fields_of_others_are_told(void **state) {
  static const struct {
    const char *name, *class;
    int components, cells;
    const char *message;
  } wrong[] = {
      {"p", "volScalarField", 1, CELLS - 1, "/10/p: has values of 400 cells, the mesh has 401; solve it again"},
      {"p", "volVectorField", 3, CELLS, "/10/p: has 3 components; it must have 1"},
      {"U", "volScalarField", 1, CELLS, "/10/U: has 1 components; it must have 3"},
      {"yPlus", "volVectorField", 3, CELLS, "/10/yPlus: has 3 components; it must have 1"}};
  static double zeros[3 * CELLS];
  const double hub[] = {30};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    CwFlow flow = {0};
    write_fields(10, hub, 1);
    FILE *file = begin(10, wrong[i].name, wrong[i].class);
    put_list(file, "internalField", wrong[i].components, zeros, wrong[i].cells);
    fputs("boundaryField\n{\n}\n", file);
    fclose(file);
    assert_int_equal(cw_flow_open(test_folder, &mesh, &table, &flow), CW_ERR_INPUT);
    if (!strstr(cw_fail_message(), wrong[i].message)) fail_msg("%s", cw_fail_message());
    cw_fail_clear();
    assert_false(flow.present);
    cw_flow_close(&flow);
  }
  CwFlow flow = {0};
  write_fields(10, hub, 1);
  unlink(in_test_folder("solve/steady/10/U"));
  assert_int_equal(cw_flow_open(test_folder, &mesh, &table, &flow), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/10/U"));
  cw_fail_clear();
  cw_flow_close(&flow);
  remove_fields();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_latest_iteration_is_taken),    cmocka_unit_test(scales_leave_out_single_values),
      cmocka_unit_test(faces_have_values_of_their_cells), cmocka_unit_test(velocities_are_relative_in_the_rotor),
      cmocka_unit_test(fields_of_others_are_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
