// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstring>

#include <BRepPrimAPI_MakeBox.hxx>

#include "pipeline/case_schema.h"
#include "solids.h"

extern "C" {
#include "mesher/thickness/wall_targets.h"
}

static CwCase water() {
  CwCase table;
  cw_case_defaults(&table);
  table.fluid.kinematic_viscosity = 1e-6;
  table.walls.growth_ratio = 2;
  return table;
}

static void what_a_group_gives_goes_first(void **state) {
  CwCase table = water();
  CwWallGroup *blade = &table.walls.blade;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).growth, 2, 0);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 7e-5, 1e-18);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).last, 1, 0);
  blade->growth_ratio = 1;
  table.walls.total_thickness = 2e-5;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).first_height, 1e-5, 0);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 2e-5, 0);
  blade->total_thickness = 2.5e-5;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 2.5e-5, 0);
  blade->total_thickness = 1; // more than three layers of 1e-5 give
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).thickness, 3e-5, 1e-18);
  blade->growth_ratio = table.walls.growth_ratio = NAN;
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).growth, 1.3, 0);
  assert_near(cw_layer_target(&table, blade, 1e-5, 3).last, 1.0 / 6, 0);
}

// A box of which each face is another kind of wall.
static std::string patch_of_side(const TopoDS_Face &face) {
  static const char *const name[] = {"blade_suction,wall", "hub,wall",         "step,wall",
                                     "inlet_pipe,wall",    "outlet_pipe,wall", "inlet,inlet"};
  static int next = 0;
  return name[next++ % 6];
}

static void each_patch_has_its_group(void **state) {
  CwCase table = water();
  table.mesh.size_blade = 0.1, table.mesh.size_hub_shroud = 0.2, table.mesh.size_volute = 0.3;
  table.mesh.size_pipe = 0.4, table.mesh.size_interface = 0.5;
  CwFlowScales scales = {};
  scales.blade.speed = 1, scales.neck.speed = 2, scales.suction.speed = 4, scales.discharge.speed = 5;
  const struct {
    const char *patch;
    double size, speed;
  } wanted[] = {{"blade_suction", 0.1, 1}, {"hub", 0.2, 1},         {"step", 0.5, 2},
                {"inlet_pipe", 0.4, 4},    {"outlet_pipe", 0.4, 5}, {"inlet", 0.4, 4}};
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape(), patch_of_side);
  CwPatchTarget target[6];
  assert_int_equal(cw_cad_patch_count(cad), 6);
  cw_patch_targets(cad, &table, &scales, target);
  for (int p = 0; p < 6; p++) {
    for (const auto &of : wanted) {
      if (std::strcmp(of.patch, cw_cad_patch_name(cad, p)) != 0) continue;
      assert_near(target[p].relative_size, of.size, 0);
      assert_near(target[p].flow.speed, of.speed, 0);
    }
  }
  cw_cad_close(&cad);
}

static std::string volute_or_diffuser(const TopoDS_Face &face) {
  static int next = 0;
  return next++ % 2 ? "diffuser,wall" : "volute,wall";
}

static std::string blade_or_its_end(const TopoDS_Face &face) {
  static int next = 0;
  return next++ % 2 ? "blade_trailing_edge,wall" : "blade_pressure,wall";
}

// It alone looks at the interface.
static void the_trailing_edge_of_a_blade(void **state) {
  CwCase table = water();
  CwFlowScales scales = {};
  scales.blade.speed = 1, scales.trailing_edge.speed = 1, scales.trailing_edge.before = 3;
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape(), blade_or_its_end);
  CwPatchTarget target[2];
  assert_int_equal(cw_cad_patch_count(cad), 2);
  cw_patch_targets(cad, &table, &scales, target);
  int end = std::strcmp(cw_cad_patch_name(cad, 1), "blade_trailing_edge") == 0;
  assert_near(target[end].flow.before, 3, 0);
  assert_near(target[!end].flow.before, 0, 0);
  assert_near(target[end].relative_size, target[!end].relative_size, 0);
  cw_cad_close(&cad);
}

static void the_volute_and_its_diffuser(void **state) {
  CwCase table = water();
  CwFlowScales scales = {};
  scales.volute.speed = 7, scales.diffuser.speed = 6;
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape(), volute_or_diffuser);
  CwPatchTarget target[2];
  assert_int_equal(cw_cad_patch_count(cad), 2);
  cw_patch_targets(cad, &table, &scales, target);
  int diffuser = std::strcmp(cw_cad_patch_name(cad, 1), "diffuser") == 0;
  assert_near(target[diffuser].flow.speed, 6, 0);
  assert_near(target[!diffuser].flow.speed, 7, 0);
  cw_cad_close(&cad);
}

static CwStatus read_scales(const char *text, CwFlowScales *scales) {
  char path[] = "cutwater-design-XXXXXX";
  int file = mkstemp(path);
  assert_true(file >= 0);
  FILE *stream = fdopen(file, "w");
  std::fputs(text, stream);
  std::fclose(stream);
  CwStatus status = cw_flow_scales_read(path, scales);
  std::remove(path);
  return status;
}

#define DESIGN(shaft)                                                                                                  \
  "{\"relative_speed_m_per_s\": 7, \"volute_speed_m_per_s\": 6, \"suction_speed_m_per_s\": 2,"                         \
  "\"throat_speed_m_per_s\": 12, \"discharge_speed_m_per_s\": 3, \"interface_radius_m\": 0.1,"                         \
  "\"outlet_width_m\": 0.01, \"outlet_throat_width_m\": 0.03, \"inlet_passage_width_m\": 0.02,"                        \
  "\"inlet_throat_width_m\": 0.008, \"inlet_width_m\": 0.015, \"throat_area_m2\": 3.14159265358979e-4,"                \
  "\"inlet_diameter_m\": 0.07, \"outlet_diameter_m\": 0.196, \"discharge_diameter_m\": 0.04, "                         \
  "\"through_shaft_diameter_m\": " shaft "}"

static void scales_of_the_design(void **state) {
  CwFlowScales scales;
  assert_int_equal(read_scales(DESIGN("0"), &scales), CW_OK);
  assert_near(scales.blade.speed, 7, 0);
  assert_near(scales.blade.length, 0.12, 1e-15);
  assert_near(scales.blade.diameter, 0.015, 1e-15); // four times 10 x 30 over 80
  assert_near(scales.blade.width, 0.008, 0);
  assert_near(scales.blade.before, 0, 0);
  assert_near(scales.trailing_edge.width, 0.008, 0);
  assert_near(scales.trailing_edge.before, 0.002, 1e-15); // from 98 to 100 mm
  assert_near(scales.volute.speed, 6, 0);
  assert_near(scales.volute.length, 0.3, 1e-15);
  assert_near(scales.volute.diameter, 0.02, 1e-15); // a throat as large as a circle of 20 mm
  assert_near(scales.volute.width, 0.015, 1e-15);
  assert_near(scales.neck.width, 0.01, 1e-15);
  assert_near(scales.suction.speed, 2, 0);
  assert_near(scales.suction.width, 0.07, 1e-15);
  assert_near(scales.discharge.speed, 3, 0);
  // Of 12 at the throat and 3 at the end of a cone: its radius doubles, and the mean of 12 / (1 + s)^2 over s is 6.
  assert_near(scales.diffuser.speed, 6, 1e-14);
  assert_near(scales.diffuser.length, 0.3, 1e-15);
  assert_int_equal(read_scales(DESIGN("0.03"), &scales), CW_OK); // a ring from 30 to 70 mm
  assert_near(scales.suction.diameter, 0.04, 1e-15);
  assert_near(scales.suction.width, 0.02, 1e-15);
  assert_int_equal(read_scales("{\"relative_speed_m_per_s\": 7}", &scales), CW_ERR_INPUT);
  assert_non_null(std::strstr(cw_fail_message(), "'volute_speed_m_per_s' must be there"));
  assert_int_equal(read_scales("{", &scales), CW_ERR_INPUT);
  assert_int_equal(cw_flow_scales_read("no/such/design.json", &scales), CW_ERR_IO);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_a_group_gives_goes_first), cmocka_unit_test(each_patch_has_its_group),
      cmocka_unit_test(the_volute_and_its_diffuser), cmocka_unit_test(the_trailing_edge_of_a_blade),
      cmocka_unit_test(scales_of_the_design)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
