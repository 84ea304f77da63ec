// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump_model.h"

#include <math.h>
#include <string.h>

#include "geometry/hydraulic_design.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

// The pump of cases/zones, with figures from which the flows follow by hand.
static CwModel model_of(const char *name, double shaft) {
  const CwCase table = case_of(name);
  CwDesign design;
  CwPump pump = pump_of(&table, &design);
  CwModel model = {0};
  design.relative_speed = 7, design.volute_speed = 6, design.suction_speed = 2;
  design.throat_speed = 12, design.discharge_speed = 3;
  design.interface_radius = 0.1, design.outlet_diameter = 0.196, design.inlet_diameter = 0.07;
  design.outlet_width = 0.01, design.outlet_throat_width = 0.03;
  design.inlet_passage_width = 0.02, design.inlet_throat_width = 0.008;
  design.inlet_width = 0.015, design.throat_area = M_PI * 1e-4, design.discharge_diameter = 0.04;
  design.through_shaft_diameter = shaft;
  if (cw_pump_model(&design, &pump, &model) != CW_OK) fail_msg("%s", cw_fail_message());
  cw_pump_free(&pump);
  return model;
}

static const CwModelPatch *patch_of(const CwModel *model, const char *name) {
  int patch = cw_model_patch_find(model, name);
  if (patch < 0) fail_msg("no patch %s", name);
  return &model->patch[patch];
}

static void flows_follow_from_the_design(void **state) {
  CwModel model = model_of("zones", 0);
  const CwWallFlow blade = patch_of(&model, "blade_pressure")->flow;
  assert_near(blade.speed, 7, 0);
  assert_near(blade.length, 0.12, 1e-15);
  assert_near(blade.diameter, 0.015, 1e-15); // four times 10 x 30 over 80
  assert_near(blade.width, 0.008, 0);
  assert_near(blade.before, 0, 0);
  assert_memory_equal(&patch_of(&model, "shroud")->flow, &blade, sizeof blade);
  assert_near(patch_of(&model, "blade_trailing_edge")->flow.before, 0.002, 1e-15); // from 98 to 100 mm
  const CwWallFlow volute = patch_of(&model, "volute")->flow;
  assert_near(volute.speed, 6, 0);
  assert_near(volute.length, 0.3, 1e-15);
  assert_near(volute.diameter, 0.02, 1e-15); // a throat as large as a circle of 20 mm
  assert_near(volute.width, 0.015, 1e-15);
  assert_near(patch_of(&model, "neck")->flow.width, 0.01, 1e-15);
  assert_near(patch_of(&model, "inlet_pipe")->flow.speed, 2, 0);
  assert_near(patch_of(&model, "inlet_pipe")->flow.width, 0.07, 1e-15);
  assert_near(patch_of(&model, "outlet_pipe")->flow.speed, 3, 0);
  // Of 12 at the throat and 3 at the end of a cone: its radius doubles, and the mean of 12 / (1 + s)^2 over s is 6.
  assert_near(patch_of(&model, "diffuser")->flow.speed, 6, 1e-14);
  assert_near(patch_of(&model, "diffuser")->flow.length, 0.3, 1e-15);
  assert_near(model.flow.inlet_speed, 2, 0);
  assert_near(model.flow.passage_speed, 7, 0);
  assert_near(model.flow.passage_width, 0.01, 0);
  assert_near(model.flow.inlet_diameter, 0.07, 0);
  assert_near(model.flow.reference_length, 0.196, 0);
  cw_model_free(&model);
  model = model_of("zones", 0.03); // a ring from 30 to 70 mm
  assert_near(patch_of(&model, "suction_pipe")->flow.diameter, 0.04, 1e-15);
  assert_near(patch_of(&model, "suction_pipe")->flow.width, 0.02, 1e-15);
  assert_near(model.flow.inlet_diameter, 0.04, 1e-15); // hydraulic: four times its area over both circumferences
  cw_model_free(&model);
}

static void patches_have_groups_and_turn_or_not(void **state) {
  CwModel model = model_of("zones", 0);
  const struct {
    const char *patch;
    CwPatchKind kind;
    CwPatchGroup size, group;
    int turns;
  } wanted[] = {{"inlet", CW_PATCH_INLET, CW_GROUP_PIPE, CW_GROUP_VOLUTE, 0},
                {"suction_pipe", CW_PATCH_WALL, CW_GROUP_PIPE, CW_GROUP_PIPE, 0},
                {"inlet_pipe", CW_PATCH_WALL, CW_GROUP_PIPE, CW_GROUP_PIPE, 0},
                {"hub_nut", CW_PATCH_WALL, CW_GROUP_HUB_SHROUD, CW_GROUP_HUB_SHROUD, 1},
                {"blade_leading_edge", CW_PATCH_WALL, CW_GROUP_BLADE, CW_GROUP_BLADE, 1},
                {"rotor_interface", CW_PATCH_INTERFACE, CW_GROUP_INTERFACE, CW_GROUP_VOLUTE, 0},
                {"rotor_to_suction", CW_PATCH_INTERFACE, CW_GROUP_PIPE, CW_GROUP_VOLUTE, 0},
                {"step", CW_PATCH_WALL, CW_GROUP_INTERFACE, CW_GROUP_VOLUTE, 0},
                {"tongue", CW_PATCH_WALL, CW_GROUP_VOLUTE, CW_GROUP_VOLUTE, 0},
                {"diffuser", CW_PATCH_WALL, CW_GROUP_PIPE, CW_GROUP_PIPE, 0},
                {"outlet", CW_PATCH_OUTLET, CW_GROUP_PIPE, CW_GROUP_VOLUTE, 0}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    const CwModelPatch *patch = patch_of(&model, wanted[i].patch);
    assert_int_equal(patch->kind, wanted[i].kind);
    assert_int_equal(patch->size, wanted[i].size);
    assert_int_equal(patch->group, wanted[i].group);
    assert_int_equal(patch->turns, wanted[i].turns);
    assert_int_equal(patch->monitored, !strcmp(patch->name, "tongue"));
  }
  assert_int_equal(model.domain_count, 4);
  for (int d = 0; d < 4; d++) assert_int_equal(model.domain[d].rotating, !strcmp(model.domain[d].name, "rotor"));
  assert_int_equal(model.interface_count, 3);
  for (int i = 0; i < 3; i++)
    assert_int_equal(model.interface[i].surface, i == 0 ? CW_SURFACE_CYLINDER : CW_SURFACE_PLANE);
  assert_near(model.interface[0].radius, 0.1, 0);
  cw_model_free(&model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(flows_follow_from_the_design),
                                     cmocka_unit_test(patches_have_groups_and_turn_or_not)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
