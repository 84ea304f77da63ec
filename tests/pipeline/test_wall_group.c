// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "pipeline/wall_group.h"

static void every_wall_has_its_group(void **state) {
  const CwWalls walls = {0};
  const struct {
    const char *patch;
    const CwWallGroup *group;
  } rows[] = {
      {"blade_pressure", &walls.blade}, {"blade_leading_edge", &walls.blade},
      {"hub", &walls.hub_shroud},       {"hub_nut", &walls.hub_shroud},
      {"hub_shaft", &walls.hub_shroud}, {"hub_shaft_pipe", &walls.hub_shroud},
      {"shroud", &walls.hub_shroud},    {"suction_pipe", &walls.pipe},
      {"inlet_pipe", &walls.pipe},      {"diffuser", &walls.pipe},
      {"discharge", &walls.pipe},       {"outlet_pipe", &walls.pipe},
      {"volute", &walls.volute},        {"tongue", &walls.volute},
      {"neck", &walls.volute},          {"step", &walls.volute},
  };
  for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
    if (cw_wall_group(&walls, rows[i].patch) != rows[i].group) fail_msg("%s", rows[i].patch);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_wall_has_its_group)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
