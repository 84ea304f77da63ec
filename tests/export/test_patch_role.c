// SPDX-License-Identifier: AGPL-3.0-or-later
// Which walls turn, and with which y+ target they are meshed.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "export/patch_role.h"

enum { SUCTION = CW_MESH_STATOR + 1 };

static void walls_of_the_rotor_turn(void **state) {
  (void)state;
  const CwMeshPatch hub = {"hub", CW_KIND_WALL, CW_MESH_ROTOR}, pipe = {"suction_pipe", CW_KIND_WALL, CW_MESH_ROTOR},
                    inlet = {"inlet", CW_KIND_INLET, CW_MESH_ROTOR}, volute = {"volute", CW_KIND_WALL, CW_MESH_STATOR};
  assert_true(cw_patch_rotates(&hub));
  assert_false(cw_patch_rotates(&pipe) || cw_patch_rotates(&inlet) || cw_patch_rotates(&volute));
}

// The shaft turns in the suction zone, whose frame stands still; within the rotor it turns with the frame.
static void a_shaft_is_a_wall_of_a_pipe_zone(void **state) {
  (void)state;
  const CwMeshPatch shaft = {"hub_shaft_pipe", CW_KIND_WALL, SUCTION}, pipe = {"inlet_pipe", CW_KIND_WALL, SUCTION},
                    within = {"hub_shaft", CW_KIND_WALL, CW_MESH_ROTOR};
  assert_true(cw_patch_is_shaft(&shaft) && !cw_patch_rotates(&shaft));
  assert_false(cw_patch_is_shaft(&pipe) || cw_patch_rotates(&pipe));
  assert_true(cw_patch_rotates(&within) && !cw_patch_is_shaft(&within));
}

static void y_plus_goes_by_the_role(void **state) {
  (void)state;
  const CwWalls walls = {.blade.y_plus = 1, .hub_shroud.y_plus = 2, .volute.y_plus = 3, .pipe.y_plus = 4};
  const struct {
    CwMeshPatch patch;
    double y_plus;
  } rows[] = {{{"blade_pressure", CW_KIND_WALL, CW_MESH_ROTOR}, 1}, {{"shroud", CW_KIND_WALL, CW_MESH_ROTOR}, 2},
              {{"hub_shaft_pipe", CW_KIND_WALL, SUCTION}, 2},       {{"volute", CW_KIND_WALL, CW_MESH_STATOR}, 3},
              {{"suction_pipe", CW_KIND_WALL, CW_MESH_ROTOR}, 4},   {{"inlet_pipe", CW_KIND_WALL, SUCTION}, 4}};
  for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
    assert_true(cw_patch_y_plus(&rows[i].patch, &walls) == rows[i].y_plus);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walls_of_the_rotor_turn),
      cmocka_unit_test(a_shaft_is_a_wall_of_a_pipe_zone),
      cmocka_unit_test(y_plus_goes_by_the_role),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
