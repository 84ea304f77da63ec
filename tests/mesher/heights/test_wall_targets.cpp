// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstring>

#include <BRepPrimAPI_MakeBox.hxx>

#include "mesher/heights/layer_heights.h"
#include "solids.h"

extern "C" {
#include "mesher/heights/wall_targets.h"
}

// Re = 1e6, Cf = 0.026 / 7.19686 = 3.6127e-3, u_tau = 10 sqrt(Cf / 2) = 0.425012 m/s.
static const double SPEED = 10, LENGTH = 0.1, UNIT = 1e-6 / 0.425012;

static CwCase water() {
  CwCase table;
  cw_case_defaults(&table);
  table.fluid.kinematic_viscosity = 1e-6;
  table.walls.y_plus_at = CW_Y_PLUS_AT_NODE;
  table.walls.layer_count = 3;
  table.walls.growth_ratio = 2;
  table.walls.blade.y_plus = 5;
  return table;
}

static void first_height_by_hand(void **state) {
  CwCase table = water();
  CwLayerTarget target = cw_layer_target(&table, &table.walls.blade, SPEED, LENGTH);
  assert_near(target.first_height, 5 * UNIT, 1e-10);
  assert_near(target.growth, 2, 0);
  assert_near(target.thickness, 7 * target.first_height, 1e-15);
  table.walls.y_plus_at = CW_Y_PLUS_AT_CELL_CENTRE;
  assert_near(cw_layer_target(&table, &table.walls.blade, SPEED, LENGTH).first_height, 10 * UNIT, 1e-10);
  table.walls.blade.velocity = SPEED; // goes before that of the design
  assert_near(cw_layer_target(&table, &table.walls.blade, 3, LENGTH).first_height, 10 * UNIT, 1e-10);
}

static void what_a_group_gives_goes_first(void **state) {
  CwCase table = water();
  CwWallGroup *blade = &table.walls.blade;
  blade->first_height = 1e-5;
  blade->growth_ratio = 1;
  table.walls.total_thickness = 2e-5;
  assert_near(cw_layer_target(&table, blade, SPEED, LENGTH).first_height, 1e-5, 0);
  assert_near(cw_layer_target(&table, blade, SPEED, LENGTH).thickness, 2e-5, 0);
  blade->total_thickness = 2.5e-5;
  assert_near(cw_layer_target(&table, blade, SPEED, LENGTH).thickness, 2.5e-5, 0);
  blade->total_thickness = 1; // more than three layers of 1e-5 give
  assert_near(cw_layer_target(&table, blade, SPEED, LENGTH).thickness, 3e-5, 1e-18);
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
  table.walls.hub_shroud.y_plus = 4, table.walls.volute.y_plus = 3, table.walls.pipe.y_plus = 2;
  table.mesh.size_blade = 0.1, table.mesh.size_hub_shroud = 0.2, table.mesh.size_volute = 0.3;
  table.mesh.size_pipe = 0.4, table.mesh.size_interface = 0.5;
  const CwFlowScales scales = {.relative_speed = SPEED,
                               .volute_speed = 3,
                               .suction_speed = 4,
                               .diffuser_speed = 6,
                               .discharge_speed = 5,
                               .blade_length = LENGTH,
                               .volute_length = 0.2,
                               .pipe_length = 0.3};
  const struct {
    const char *patch;
    double size, y_plus, speed, length;
  } wanted[] = {{"blade_suction", 0.1, 5, SPEED, LENGTH}, {"hub", 0.2, 4, SPEED, LENGTH},  {"step", 0.5, 3, 3, 0.2},
                {"inlet_pipe", 0.4, 2, 4, 0.3},           {"outlet_pipe", 0.4, 2, 5, 0.3}, {"inlet", 0.4, 0, 1, 1}};
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape(), patch_of_side);
  double size[6];
  CwLayerTarget layers[6];
  assert_int_equal(cw_cad_patch_count(cad), 6);
  cw_wall_targets(cad, &table, &scales, size, layers);
  for (int p = 0; p < 6; p++) {
    for (const auto &of : wanted) {
      if (std::strcmp(of.patch, cw_cad_patch_name(cad, p)) != 0) continue;
      assert_near(size[p], of.size, 0);
      double first = of.y_plus > 0 ? cw_first_height(of.y_plus, of.speed, of.length, 1e-6, 0) : 0;
      assert_near(layers[p].first_height, first, 1e-18);
    }
  }
  cw_cad_close(&cad);
}

static std::string all_diffuser(const TopoDS_Face &face) {
  return "diffuser,wall";
}

static void a_diffuser_has_the_mean_speed_along_it(void **state) {
  CwCase table = water();
  table.walls.pipe.y_plus = 2, table.mesh.size_pipe = 0.4;
  CwFlowScales scales = {};
  scales.diffuser_speed = 6, scales.discharge_speed = 3, scales.pipe_length = 0.3;
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(10, 20, 30).Shape(), all_diffuser);
  double size;
  CwLayerTarget layers;
  assert_int_equal(cw_cad_patch_count(cad), 1);
  cw_wall_targets(cad, &table, &scales, &size, &layers);
  assert_near(size, 0.4, 0);
  assert_near(layers.first_height, cw_first_height(2, 6, 0.3, 1e-6, 0), 1e-18);
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

static void scales_of_the_design(void **state) {
  CwFlowScales scales;
  assert_int_equal(
      read_scales("{\"relative_speed_m_per_s\": 7, \"volute_speed_m_per_s\": 6,"
                  "\"suction_speed_m_per_s\": 2, \"throat_speed_m_per_s\": 12, \"discharge_speed_m_per_s\": 3,"
                  "\"interface_radius_m\": 0.1}",
                  &scales),
      CW_OK);
  assert_near(scales.relative_speed, 7, 0);
  assert_near(scales.volute_speed, 6, 0);
  assert_near(scales.suction_speed, 2, 0);
  assert_near(scales.discharge_speed, 3, 0);
  // Of 12 at the throat and 3 at the end of a cone: its radius doubles, and the mean of 12 / (1 + s)^2 over s is 6.
  assert_near(scales.diffuser_speed, 6, 1e-14);
  assert_near(scales.blade_length, 0.12, 1e-15);
  assert_near(scales.volute_length, 0.3, 1e-15);
  assert_near(scales.pipe_length, 0.3, 1e-15);
  assert_int_equal(read_scales("{\"relative_speed_m_per_s\": 7}", &scales), CW_ERR_INPUT);
  assert_non_null(std::strstr(cw_fail_message(), "'volute_speed_m_per_s' must be there"));
  assert_int_equal(read_scales("{", &scales), CW_ERR_INPUT);
  assert_int_equal(cw_flow_scales_read("no/such/design.json", &scales), CW_ERR_IO);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(first_height_by_hand), cmocka_unit_test(what_a_group_gives_goes_first),
      cmocka_unit_test(each_patch_has_its_group), cmocka_unit_test(a_diffuser_has_the_mean_speed_along_it),
      cmocka_unit_test(scales_of_the_design)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
