// SPDX-License-Identifier: AGPL-3.0-or-later
// Columns on a flat wall: how good they are, and which way they are turned.
#include <string.h>

#include "hexagon.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/layers/layers_turn.h"
#include "mesher/policy.h"

static const double upright[3] = {0, 0, 1};

// All columns stand upright, of thickness 1, but for that of point 0.
static void begin(Hexagon *wall, const double centre[3], CwLayerWork *work, double top[7][3]) {
  assert_int_equal(cw_layers_topology(&wall->in, work), CW_OK);
  for (int v = 0; v < 7; v++) {
    work->base_cos[v] = work->t[v] = 1;
    cw_copy(v == 0 ? centre : upright, work->column[v]);
    for (int k = 0; k < 3; k++) top[v][k] = wall->x[v][k] + work->column[v][k];
  }
}

static void right_prisms_are_whole(void **state) {
  Hexagon wall;
  CwLayerWork work = {0};
  double top[7][3];
  const double(*ends)[3] = (const double(*)[3])top;
  int32_t first = 0;
  hexagon_make(&wall);
  begin(&wall, upright, &work, top);
  for (int f = 0; f < 6; f++) {
    assert_near(cw_layers_prism_quality(&work, f, ends), 1, 1e-14);
    assert_near(cw_layers_top_quality(&work, f, ends), cw_policy.turn_top, 1e-14);
    assert_near(cw_layers_lean_quality(&work, f, ends), cw_policy.prism_good, 0);
  }
  assert_near(cw_layers_around(&work, 0, ends, -INFINITY, &first), cw_policy.turn_top, 1e-14);
  cw_layers_work_free(&work);
}

// A column out of the fluid turns all prisms about it over; one prism that is no good counts below all that are.
static void a_column_out_of_the_fluid_is_the_worst(void **state) {
  Hexagon wall;
  CwLayerWork work = {0};
  double top[7][3];
  const double(*ends)[3] = (const double(*)[3])top, out[3] = {0, 0, -1};
  int32_t first = 0;
  hexagon_make(&wall);
  begin(&wall, out, &work, top);
  for (int f = 0; f < 6; f++) assert_true(cw_layers_prism_quality(&work, f, ends) < 0);
  assert_true(cw_layers_around(&work, 0, ends, -INFINITY, &first) < -10);
  assert_true(cw_layers_around(&work, 1, ends, -INFINITY, &first) < -10);
  // Not looked at further than to see that it is no better than `floor`.
  first = 0;
  assert_true(cw_layers_around(&work, 0, ends, 0, &first) <= 0);
  cw_layers_work_free(&work);
}

// A column that leans over its neighbour comes back, at its normal thickness; one that is held stays in its plane, and
// one on a line as it is.
static void a_leaning_column_is_turned_back(void **state) {
  const double leaning[3] = {1.9, 0, 1}, slanted[3] = {1.9, 0.4, 1};
  const double across[7][2][3] = {{{0, 1, 0}, {1, 0, 0}}};
  for (int constraints = 0; constraints < 3; constraints++) {
    Hexagon wall;
    CwLayerWork work = {0};
    double top[7][3], before;
    int32_t first = 0, held[7] = {constraints};
    hexagon_make(&wall);
    wall.in.constraint_count = held;
    wall.in.constraint_normal = across;
    begin(&wall, constraints ? leaning : slanted, &work, top);
    before = cw_layers_around(&work, 0, (const double(*)[3])top, -INFINITY, &first);
    cw_layers_turn(&work, 0, top, cw_layers_around, 1);
    double after = cw_layers_around(&work, 0, (const double(*)[3])top, -INFINITY, &first);
    for (int k = 0; k < 3; k++) assert_near(top[0][k], work.column[0][k], 1e-14); // its thickness is 1
    if (constraints == 2) {
      assert_near(after, before, 0);
      assert_memory_equal(work.column[0], leaning, sizeof leaning);
    } else {
      assert_true(after > before + 0.05);
      assert_true(top[0][0] < 1.5);
      assert_near(top[0][2], 1, 1e-14);
      if (constraints == 1) assert_near(top[0][1], 0, 1e-14);
    }
    cw_layers_work_free(&work);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(right_prisms_are_whole),
      cmocka_unit_test(a_column_out_of_the_fluid_is_the_worst),
      cmocka_unit_test(a_leaning_column_is_turned_back),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
