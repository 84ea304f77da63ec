// SPDX-License-Identifier: AGPL-3.0-or-later
// Which walls turn, and whether layers resolve the viscous sublayer.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "export/patch_role.h"

enum { SUCTION = CW_MESH_STATOR + 1 };

static void walls_of_the_rotor_turn(void **state) {
  (void)state;
  const CwMeshPatch hub = {"hub", CW_KIND_WALL, CW_MESH_ROTOR, 30},
                    pipe = {"suction_pipe", CW_KIND_WALL, CW_MESH_ROTOR, 30},
                    inlet = {"inlet", CW_KIND_INLET, CW_MESH_ROTOR, 30},
                    volute = {"volute", CW_KIND_WALL, CW_MESH_STATOR, 30};
  assert_true(cw_patch_rotates(&hub));
  assert_false(cw_patch_rotates(&pipe) || cw_patch_rotates(&inlet) || cw_patch_rotates(&volute));
}

// The shaft turns in the suction zone, whose frame stands still; within the rotor it turns with the frame.
static void a_shaft_is_a_wall_of_a_pipe_zone(void **state) {
  (void)state;
  const CwMeshPatch shaft = {"hub_shaft_pipe", CW_KIND_WALL, SUCTION, 30},
                    pipe = {"inlet_pipe", CW_KIND_WALL, SUCTION, 30},
                    within = {"hub_shaft", CW_KIND_WALL, CW_MESH_ROTOR, 30};
  assert_true(cw_patch_is_shaft(&shaft) && !cw_patch_rotates(&shaft));
  assert_false(cw_patch_is_shaft(&pipe) || cw_patch_rotates(&pipe));
  assert_true(cw_patch_rotates(&within) && !cw_patch_is_shaft(&within));
}

static void walls_are_resolved_where_one_is(void **state) {
  (void)state;
  CwMeshPatch patches[] = {{"inlet", CW_KIND_INLET, CW_MESH_ROTOR, NAN},
                           {"hub", CW_KIND_WALL, CW_MESH_ROTOR, 30},
                           {"diffuser", CW_KIND_WALL, CW_MESH_STATOR, 30}};
  const CwMesh mesh = {.patches = patches, .patch_count = 3};
  assert_false(cw_walls_resolved(&mesh));
  patches[2].y_plus = 1;
  assert_true(cw_walls_resolved(&mesh));
  assert_false(cw_patch_resolved(&patches[1]));
  patches[2].y_plus = NAN; // laminar
  assert_true(cw_walls_resolved(&mesh));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walls_of_the_rotor_turn),
      cmocka_unit_test(a_shaft_is_a_wall_of_a_pipe_zone),
      cmocka_unit_test(walls_are_resolved_where_one_is),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
