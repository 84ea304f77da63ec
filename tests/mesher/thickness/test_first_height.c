// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>

#include "mesher/thickness/first_height.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/case_schema.h"
#include "tests/unit_test.h"

#define NEAR(value, wanted) assert_true(fabs((value) - (wanted)) <= 1e-5 * fabs(wanted))

// Water at 10 m/s: Re = 1e6 over the length, Cf = 0.026 / 7.19686, u_tau = 0.425012 m/s, y+ 1 at 2.35287 um. The
// passage has Re = 1e5.
static const CwWallFlow FLOW = {.speed = 10, .length = 0.1, .diameter = 0.01, .width = 0.008};
static const double UNIT = 1e-6 / 0.425012;

static CwCase water(void) {
  CwCase table;
  cw_case_defaults(&table);
  table.fluid.kinematic_viscosity = 1e-6;
  table.walls.y_plus_at = CW_Y_PLUS_AT_NODE;
  return table;
}

// Of as many layers as the case gives, or six.
static CwFirstHeight choose(const CwCase *table, double y_plus_auto) {
  int given = table->walls.layer_count;
  return cw_first_height_choose(table, &table->walls.blade, &FLOW, y_plus_auto, given > 0 ? given : 6);
}

static void asked_by_y_plus_or_height(void **state) {
  CwCase table = water();
  table.walls.blade.y_plus = 5;
  CwFirstHeight first = choose(&table, 300);
  NEAR(first.height, 5 * UNIT);
  NEAR(first.y_plus, 5.0);
  NEAR(first.reynolds, 1e5);
  assert_int_equal(first.source, CW_FIRST_ASKED);
  table.walls.y_plus_at = CW_Y_PLUS_AT_CELL_CENTRE;
  NEAR(choose(&table, 30).height, 10 * UNIT);
  table.walls.blade.first_height = 1e-5;
  NEAR(choose(&table, 30).height, 1e-5);
  NEAR(choose(&table, 30).y_plus, 1e-5 / (2 * UNIT));
}

static void open_ones_lie_in_the_log_layer(void **state) {
  CwCase table = water();
  NEAR(choose(&table, 30).height, 30 * UNIT);
  assert_int_equal(choose(&table, 30).source, CW_FIRST_AUTO);
  NEAR(choose(&table, 60).y_plus, 60.0);
  // Six layers that grow by 1.3 are 12.756 times the first. They fit 0.35 of 8 mm from a first of 0.2195 mm on.
  NEAR(choose(&table, 300).height, 0.35 * 0.008 / ((pow(1.3, 6) - 1) / 0.3));
}

static void what_does_not_fit_becomes_what_fits(void **state) {
  CwCase table = water();
  table.walls.layer_count = 5;
  table.walls.blade.y_plus = 1000; // 2.35 mm, of which five would be more than the passage
  CwFirstHeight first = choose(&table, 30);
  assert_int_equal(first.source, CW_FIRST_FITTED);
  NEAR(first.asked, 1000 * UNIT);
  NEAR(first.height, 0.2 * 0.008 / 5);
  NEAR(first.y_plus, first.height / UNIT);
  table.walls.layer_count = 0; // at least three
  NEAR(choose(&table, 30).height, 0.2 * 0.008 / 3);
  // What is asked again as it was made is taken.
  table.walls.blade.y_plus = choose(&table, 30).y_plus * (1 - 1e-9);
  assert_int_equal(choose(&table, 30).source, CW_FIRST_ASKED);
}

// A trailing edge before the interface: six even layers in 0.6 of the way where the height is open; a given one stays
// as long as layers that fall by 0.6 fit there.
// Columns of 0.2 mm have the first height that is left of them, and none greater. That of a group goes before that of
// all walls; where all layers have room it changes nothing.
static void all_layers_together_leave_no_more(void **state) {
  double fraction[6];
  CwCase table = water();
  table.walls.layer_count = 5;
  table.walls.blade.y_plus = 100;
  table.walls.total_thickness = 2e-4;
  CwFirstHeight first = choose(&table, 30);
  assert_int_equal(first.source, CW_FIRST_FITTED);
  NEAR(first.asked, 100 * UNIT);
  NEAR(first.total, 2e-4);
  assert_true(first.height < 0.9 * first.asked);
  NEAR(first.y_plus, first.height / UNIT);
  NEAR(cw_layer_fractions(2e-4, first.height, 5, 1.3, fraction), first.height);
  assert_true(cw_layer_fractions(2e-4, 1.01 * first.height, 5, 1.3, fraction) < 1.001 * first.height);
  table.walls.blade.total_thickness = 4e-5;
  NEAR(choose(&table, 30).height, first.height / 5);
  NEAR(choose(&table, 30).total, 4e-5);
  table.walls.blade.total_thickness = 2e-3;
  NEAR(choose(&table, 30).height, 100 * UNIT);
  assert_true(choose(&table, 30).total == 0);
}

static void an_open_face_before_the_wall_leaves_less_room(void **state) {
  CwCase table = water();
  CwWallFlow flow = FLOW;
  flow.before = 0.0002;
  NEAR(cw_column_room(&FLOW), 0.35 * 0.008);
  NEAR(cw_column_room(&flow), 0.6 * 0.0002);
  CwFirstHeight first = cw_first_height_choose(&table, &table.walls.blade, &flow, 300, 6);
  NEAR(first.height, 0.6 * 0.0002 / 6);
  assert_int_equal(first.source, CW_FIRST_AUTO);
  table.walls.layer_count = 4;
  table.walls.blade.y_plus = 30; // 0.07 mm
  first = cw_first_height_choose(&table, &table.walls.blade, &flow, 300, 4);
  double falling = 1 + 0.6 + 0.36 + 0.216;
  flow.before = 1.001 * 30 * UNIT * falling / 0.6;
  first = cw_first_height_choose(&table, &table.walls.blade, &flow, 300, 4);
  NEAR(first.height, 30 * UNIT);
  assert_int_equal(first.source, CW_FIRST_ASKED);
  flow.before = 0.5 * 30 * UNIT * falling / 0.6;
  first = cw_first_height_choose(&table, &table.walls.blade, &flow, 300, 4);
  NEAR(first.height, 0.5 * 30 * UNIT);
  assert_int_equal(first.source, CW_FIRST_FITTED);
  table.walls.layer_count = 0; // and as many as the domain has
  assert_int_equal(cw_first_height_choose(&table, &table.walls.blade, &flow, 300, 1).source, CW_FIRST_ASKED);
  NEAR(cw_first_height_choose(&table, &table.walls.blade, &flow, 300, 4).height, 0.5 * 30 * UNIT);
  flow.before = 0.01; // farther than the other wall
  NEAR(cw_first_height_choose(&table, &table.walls.blade, &flow, 300, 4).height, 30 * UNIT);
}

static void laminar_flow_takes_a_share_of_the_passage(void **state) {
  CwCase table = water();
  table.fluid.kinematic_viscosity = 0.1 / 2299; // Re 2299
  table.walls.blade.y_plus = 1;
  CwFirstHeight first = choose(&table, 30);
  assert_int_equal(first.source, CW_FIRST_LAMINAR);
  NEAR(first.height, 0.008 / 50);
  assert_true(isnan(first.y_plus));
  // A cell from the wall to there, its speed that of the parabola at its centre: the shear at the wall is 1 % too
  // small.
  double s = first.height / FLOW.width, centre = s / 2, shear = centre * (1 - centre) / centre;
  NEAR(1 - shear, 0.01);
  CwWallFlow end = FLOW;
  end.before = 0.0008; // a trailing edge: four even layers fit before the interface
  NEAR(cw_first_height_choose(&table, &table.walls.blade, &end, 30, 4).height, 0.6 * 0.0008 / 4);
  table.walls.blade.first_height = 2e-4; // is taken
  assert_int_equal(choose(&table, 30).source, CW_FIRST_ASKED);
  table.walls.blade.first_height = NAN;
  table.walls.layer_count = 40; // even ones of that would not fit
  NEAR(choose(&table, 30).height, 0.2 * 0.008 / 40);
  table.fluid.kinematic_viscosity = 0.1 / 2301;
  assert_int_not_equal(choose(&table, 30).source, CW_FIRST_LAMINAR);
}

// Whatever is asked, even layers of what is chosen fit both sides of the passage and leave room between them.
static void random_passages(void **state) {
  srand(3);
  for (int i = 0; i < 10000; i++) {
    CwCase table = water();
    double width = pow(10, 4.0 * rand() / RAND_MAX - 4);
    CwWallFlow flow = {0.1 + 30.0 * rand() / RAND_MAX, 10 * width, 1.5 * width, width, 0};
    table.fluid.kinematic_viscosity = pow(10, 4.0 * rand() / RAND_MAX - 7);
    table.walls.layer_count = rand() % 41;
    if (rand() % 2) table.walls.blade.y_plus = pow(10, 4.0 * rand() / RAND_MAX - 1);
    int given = table.walls.layer_count, layers = given > 0 ? given : CW_LAYERS_LEAST;
    double y_plus = 30 + 270.0 * rand() / RAND_MAX;
    CwFirstHeight first = cw_first_height_choose(&table, &table.walls.blade, &flow, y_plus, given > 0 ? given : 6);
    assert_true(first.height > 0 && first.height <= first.asked * (first.source == CW_FIRST_LAMINAR ? 1e9 : 1));
    assert_true(2 * layers * first.height <= 0.4 * width * (1 + 1e-12));
    assert_int_equal(isnan(first.y_plus), first.reynolds < CW_LAMINAR_REYNOLDS);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(asked_by_y_plus_or_height),
                                     cmocka_unit_test(open_ones_lie_in_the_log_layer),
                                     cmocka_unit_test(what_does_not_fit_becomes_what_fits),
                                     cmocka_unit_test(all_layers_together_leave_no_more),
                                     cmocka_unit_test(an_open_face_before_the_wall_leaves_less_room),
                                     cmocka_unit_test(laminar_flow_takes_a_share_of_the_passage),
                                     cmocka_unit_test(random_passages)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
