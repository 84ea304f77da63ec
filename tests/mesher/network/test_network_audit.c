// SPDX-License-Identifier: AGPL-3.0-or-later
// An edge of a wall and a cut that starts at its end: sound as they are; each way of spoiling them is told. The picture
// has both lines with their kinds.
#include <stdio.h>
#include <string.h>

#include "mesher/network/network_audit.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

enum { POINTS = 3 };

// The edge runs along x to x = 0.4, the cut from there along y in the plane x = 0.4, to a corner off the walls.
typedef struct {
  CwNetwork network;
  CwPlan plan;
  CwPlanNode node;
  CwCorner corner[3];
  CwCurve curve[2];
  double x[2][POINTS][3], length[2][POINTS];
} Lines;

static void make(Lines *made) {
  static const Lines plain = {.node = {{{1, 0, 0}, 0.4}, -1, {-1, -2}, 0},
                              .corner = {{.on_wall = 1}, {.x = {0.4, 0, 0}, .on_wall = 1}, {.x = {0.4, 0.3, 0}}},
                              .x = {{{0, 0, 0}, {0.1, 0, 0}, {0.4, 0, 0}}, {{0.4, 0, 0}, {0.4, 0.1, 0}, {0.4, 0.3, 0}}},
                              .length = {{0, 0.1, 0.4}, {0, 0.1, 0.3}}};
  *made = plain;
  made->plan = (CwPlan){.node_count = 1, .region_count = 2, .node = &made->node};
  for (int i = 0; i < 2; i++) {
    made->curve[i] = (CwCurve){.kind = i ? CW_CURVE_CUT : CW_CURVE_EDGE,
                               .corner = {i, i + 1},
                               .plane = {i ? 0 : -1, -1},
                               .wall = !i,
                               .fine_count = POINTS,
                               .fine_x = made->x[i],
                               .fine_length = made->length[i]};
  }
  made->network = (CwNetwork){
      .plan = &made->plan, .corner_count = 3, .corner = made->corner, .curve_count = 2, .curve = made->curve};
}

static void sound_ones_pass(void **state) {
  Lines lines;
  make(&lines);
  assert_int_equal(cw_network_audit(&lines.network), CW_OK);
}

static void told(Lines *lines, const char *message) {
  assert_int_equal(cw_network_audit(&lines->network), CW_ERR_FAULT);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  make(lines);
}

static void spoiled_ones_are_told(void **state) {
  Lines lines;
  make(&lines);
  lines.curve[0].fine_count = 1;
  told(&lines, "curve 0 has 1 points");
  lines.length[1][0] = 0.01;
  told(&lines, "curve 1 has 3 points and begins at 0.01");
  lines.curve[1].corner[1] = 3;
  told(&lines, "curve 1 has the corner 3 of 3");
  lines.x[0][2][1] = 2e-6;
  told(&lines, "curve 0 ends 0.002 mm off its corner");
  lines.length[0][1] = 0.11;
  told(&lines, "curve 0: its length rises by 0.11 over a way of 0.1");
  lines.x[0][1][0] = lines.length[0][1] = 0; // a point twice
  told(&lines, "curve 0: its length rises by 0 over a way of 0");
  lines.x[1][1][0] += 2e-6;
  told(&lines, "curve 1 lies 0.002 mm off plane 0");
  lines.corner[2].on_wall = 1;
  told(&lines, "corner 2 at (400.000, 300.000, 0.000) mm is on a wall, and no wall curve ends there");
  lines.corner[0].on_wall = 0;
  told(&lines, "corner 0 at (0.000, 0.000, 0.000) mm is off a wall, and a wall curve ends there");
}

static void pictures_have_the_lines(void **state) {
  const char *path = in_test_folder("network.vtk");
  Lines lines;
  make(&lines);
  assert_int_equal(cw_network_vtk(&lines.network, path), CW_OK);
  char *text = read_whole(path, NULL);
  remove(path);
  const char *parts = strstr(text, "LINES");
  assert_non_null(parts);
  assert_string_equal(parts, "LINES 2 8\n3 0 1 2\n3 3 4 5\nCELL_DATA 2\nSCALARS kind int 1\nLOOKUP_TABLE default\n"
                             "0\n1\nSCALARS wall int 1\nLOOKUP_TABLE default\n1\n0\n");
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sound_ones_pass),
      cmocka_unit_test(spoiled_ones_are_told),
      cmocka_unit_test(pictures_have_the_lines),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
