// SPDX-License-Identifier: AGPL-3.0-or-later
// A box cut into four regions, and a wheel of three wedges on a slice: sound as they are; each way of spoiling them is
// told. The picture names the region of each triangle.
#include <stdio.h>
#include <string.h>

#include "mesher/plan/plan_audit.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

typedef struct {
  CwPlan plan;
  CwPlanNode node[5];
} Made;

// x = 0; before it y = 0, behind it z = 0.
static void make_box(Made *made) {
  memset(made, 0, sizeof *made);
  made->node[0] = (CwPlanNode){{{1, 0, 0}, 0}, -1, {1, 2}, 0};
  made->node[1] = (CwPlanNode){{{0, 1, 0}, 0}, 0, {-1, -2}, 0};
  made->node[2] = (CwPlanNode){{{0, 0, 1}, 0}, 0, {-3, -4}, 0};
  made->plan = (CwPlan){.node_count = 3, .region_count = 4, .node = made->node};
}

// Node 0 across the axis, half-planes 1 to 3, and a plane that divides the wedge behind the second.
static void make_wheel(Made *made) {
  memset(made, 0, sizeof *made);
  made->node[0] = (CwPlanNode){{{0, 0, -1}, 0}, -1, {-1, 1}, 0};
  made->node[1] = (CwPlanNode){{{0, 1, 0}, 0}, 0, {-3, -2}, 0};
  made->node[2] = (CwPlanNode){{{-0.6, -0.8, 0}, 0}, 0, {-2, 4}, 0};
  made->node[3] = (CwPlanNode){{{0.8, -0.6, 0}, 0}, 0, {4, -3}, 0};
  made->node[4] = (CwPlanNode){{{1, 0, 0}, 0.2}, 2, {-4, -5}, 0};
  made->plan = (CwPlan){.node_count = 5,
                        .region_count = 5,
                        .node = made->node,
                        .sector_first = 1,
                        .sector_count = 3,
                        .sector_region = 1,
                        .sector_turns = 1};
}

static void sound_ones_pass(void **state) {
  Made made;
  make_box(&made);
  assert_int_equal(cw_plan_audit(&made.plan), CW_OK);
  make_wheel(&made);
  assert_int_equal(cw_plan_audit(&made.plan), CW_OK);
  const CwPlan undivided = {.region_count = 1};
  assert_int_equal(cw_plan_audit(&undivided), CW_OK);
}

static void told(Made *made, const char *message) {
  assert_int_equal(cw_plan_audit(&made->plan), CW_ERR_FAULT);
  if (!strstr(cw_fail_message(), message)) fail_msg("%s", cw_fail_message());
  make_box(made);
}

static void spoiled_ones_are_told(void **state) {
  Made made;
  make_box(&made);
  made.plan.region_count = 5;
  told(&made, "3 nodes divide a domain into 5 regions");
  made.node[1].plane.normal[1] = 1 + 1e-9;
  told(&made, "the normal of node 1 is 1.000000001");
  made.node[2].child[1] = -5;
  told(&made, "node 2 has the child -5; there are 3 nodes and 4 regions");
  made.node[2].child[1] = 3;
  told(&made, "node 2 has the child 3");
  made.node[2].parent = 1;
  told(&made, "node 0 has the child 2, whose parent is 1");
  made.node[2].child[1] = 1; // a ring
  told(&made, "node 2 has the child 1, whose parent is 0");
  made.node[2].child[1] = -3;
  told(&made, "region 2 is the child of 2 nodes; 1 is allowed");
  made.node[0].child[1] = -4;
  told(&made, "node 2 is the child of 0 nodes; 1 is allowed");
  make_wheel(&made);
  made.node[3].child[1] = -2; // one wedge twice
  told(&made, "region 1 is the child of 2 nodes; 1 is allowed");
}

// Four triangles, one in each region.
static void pictures_name_the_regions(void **state) {
  static double x[12][3];
  static int32_t triangle[4][3];
  const double at[4][3] = {{-2, -2, 0.5}, {-2, 2, 0.5}, {2, 0.5, -2}, {2, 0.5, 2}};
  Made made;
  FILE *file;
  char line[100];
  const char *path = in_test_folder("plan.vtk");
  make_box(&made);
  for (int i = 0; i < 12; i++) {
    memcpy(x[i], at[i / 3], sizeof x[i]);
    x[i][i % 3] += 0.3;
    triangle[i / 3][i % 3] = i;
  }
  const CwBackground background = {.point_count = 12, .triangle_count = 4, .x = x, .triangle = triangle};
  assert_int_equal(cw_plan_vtk(&made.plan, &background, path), CW_OK);
  assert_non_null(file = fopen(path, "r"));
  while (fgets(line, sizeof line, file) && strcmp(line, "LOOKUP_TABLE default\n") != 0) continue;
  for (int t = 0, region; t < 4; t++) {
    assert_int_equal(fscanf(file, "%d", &region), 1);
    assert_int_equal(region, t);
  }
  fclose(file);
  remove(path);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sound_ones_pass),
      cmocka_unit_test(spoiled_ones_are_told),
      cmocka_unit_test(pictures_name_the_regions),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
