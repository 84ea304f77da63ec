// SPDX-License-Identifier: AGPL-3.0-or-later
// Which walls turn, whether layers resolve the viscous sublayer, and the model of turbulence that follows.
#include <math.h>

#include "export/patch_role.h"
#include "tests/unit_test.h"

// Whether a wall turns is its own matter, and so is whether its zone rotates.
static void walls_turn_in_zones_that_rotate_or_not(void **state) {
  enum { STATOR, ROTOR };
  const CwMesh mesh = {.domain_count = 2, .domains = {{.name = "stator"}, {.name = "rotor", .rotating = 1}}};
  const CwModelPatch hub = {.kind = CW_PATCH_WALL, .domain = ROTOR, .turns = 1},
                     pipe = {.kind = CW_PATCH_WALL, .domain = ROTOR},
                     inlet = {.kind = CW_PATCH_INLET, .domain = ROTOR, .turns = 1},
                     volute = {.kind = CW_PATCH_WALL, .domain = STATOR},
                     shaft = {.kind = CW_PATCH_WALL, .domain = STATOR, .turns = 1};
  assert_true(cw_patch_turns(&mesh, &hub) && cw_patch_rotates(&mesh, &hub) && !cw_patch_is_shaft(&mesh, &hub));
  assert_true(cw_patch_turns(&mesh, &shaft) && !cw_patch_rotates(&mesh, &shaft) && cw_patch_is_shaft(&mesh, &shaft));
  assert_false(cw_patch_turns(&mesh, &pipe) || cw_patch_turns(&mesh, &inlet) || cw_patch_turns(&mesh, &volute));
  assert_true(cw_patch_stands(&mesh, &pipe) && cw_patch_stands(&mesh, &volute));
  assert_false(cw_patch_stands(&mesh, &hub) || cw_patch_stands(&mesh, &inlet));
}

static void the_model_follows_from_all_walls(void **state) {
  CwModelPatch patches[] = {{.kind = CW_PATCH_INLET, .y_plus = NAN},
                            {.kind = CW_PATCH_WALL, .y_plus = 30},
                            {.kind = CW_PATCH_WALL, .y_plus = 30}};
  const CwMesh mesh = {.patches = patches, .patch_count = 3};
  assert_int_equal(cw_turbulence_model(&mesh), CW_K_EPSILON);
  patches[2].y_plus = 1;
  assert_int_equal(cw_turbulence_model(&mesh), CW_SST);
  assert_false(cw_patch_resolved(&patches[1]));
  patches[2].y_plus = NAN; // laminar
  assert_int_equal(cw_turbulence_model(&mesh), CW_SST);
  patches[1].y_plus = NAN;
  assert_int_equal(cw_turbulence_model(&mesh), CW_LAMINAR);
  const CwMesh open = {.patches = patches, .patch_count = 1};
  assert_int_equal(cw_turbulence_model(&open), CW_K_EPSILON);
  assert_string_equal(cw_turbulence_model_name(CW_SST), "k-omega SST");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walls_turn_in_zones_that_rotate_or_not),
      cmocka_unit_test(the_model_follows_from_all_walls),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
