// SPDX-License-Identifier: AGPL-3.0-or-later
// The order in which a run makes its stages, and when it makes them again (stages_by_hand.h).
#include "stages_by_hand.h"

static int make_run(void **state) {
  static const char *const FILES[] = {"rotor.brep", "stator.brep", "faces.csv", "model.json"};
  char name[64];
  if (make_test_folder(state) || mkdir(in_test_folder("geometry"), 0777)) return -1;
  for (int i = 0; i < 4; i++) {
    snprintf(name, sizeof name, "geometry/%s", FILES[i]);
    write_text(in_test_folder(name), FILES[i]);
  }
  return 0;
}

static CwStatus begin(int count, const Attempt *attempts, CwStage stop_after, int rank) {
  memset(&run, 0, sizeof run);
  cw_case_defaults(&table);
  table.mesh.cells = asked;
  run.table = &table;
  run.run_path = test_folder;
  run.rank = rank;
  run.stop_after = stop_after;
  run.context.team = cw_team_of(NULL);
  assert_int_equal(cw_log_open("test", NULL, 0, 0, &run.context.log), CW_OK);
  script = attempts;
  script_count = count;
  at = -1;
  other_plans = 2;
  trace[0] = '\0';
  return cw_mesh_run(&run);
}

static void end(void) {
  cw_log_close(&run.context.log);
  cw_mesh_run_free(&run);
  cw_fail_clear();
}

// Spaces are for the reader.
static void expect(const char *wanted) {
  char text[sizeof trace];
  size_t used = 0;
  for (; *wanted; wanted++)
    if (*wanted != ' ') text[used++] = *wanted;
  text[used] = '\0';
  assert_string_equal(trace, text);
}

#define BEGIN(stop_after, ...)                                                                                         \
  begin((int)(sizeof((Attempt[]){__VA_ARGS__}) / sizeof(Attempt)), (Attempt[]){__VA_ARGS__}, stop_after, 0)

// A run to its end, with this trace.
#define MAKE(wanted, ...)                                                                                              \
  do {                                                                                                                 \
    if (BEGIN(CW_STAGE_NONE, __VA_ARGS__) != CW_OK) fail_msg("%s", cw_fail_message());                                 \
    expect(wanted);                                                                                                    \
  } while (0)

static int kept(void) {
  return access(in_test_folder("mesh/pass.json"), F_OK) == 0;
}

static int32_t retries_and_passes(void) {
  return 10 * run.retries + run.passes;
}

static void a_mesh_of_enough_cells_is_the_last(void **state) {
  for (int i = 0; i < 4; i++) {
    static const double CELLS[] = {0.9801, 1.0199, 0.9799, 1.0201}; // met within 2 %
    if (i < 2)
      MAKE("of p00 h00w WLIUGe N m", {.cells = CELLS[i]});
    else
      MAKE("of p00 h00w WLIUGe NS WLIUGe N m", {.cells = CELLS[i]}, {.cells = 1});
    assert_int_equal(retries_and_passes(), i < 2 ? 1 : 2);
    assert_int_equal(kept(), i >= 2);
    assert_int_equal(cw_log_warning_count(run.context.log), 0);
    end();
    unlink(in_test_folder("mesh/pass.json"));
  }
}

// The next pass follows from what was learnt to twelve digits, as the file keeps it. Ten passes, and the rest is told.
static void passes_have_an_end(void **state) {
  char wanted[sizeof trace] = "of p00 h00w WLIUGeN";
  for (int pass = 2; pass <= 10; pass++) strcat(wanted, " S WLIUGeN");
  strcat(wanted, " m");
  MAKE(wanted, {.cells = 1.5});
  assert_int_equal(retries_and_passes(), 10);
  assert_true(factor_at_scale == 0.333333333333);
  assert_true(run.domain[1].layer_share == CW_LAYER_SHARE);
  assert_int_equal(cw_log_warning_count(run.context.log), 1);
  assert_non_null(
      strstr(cw_log_warning(run.context.log, 0), "150000 cells made, 50.0 % off the asked 100000 after 10"));
  end();
}

// They are counted from where edges became shorter.
static void passes_begin_anew_with_other_sizes(void **state) {
  Attempt attempts[10];
  char wanted[sizeof trace] = "of p00 h00w";
  for (int i = 0; i < 10; i++) attempts[i] = (Attempt){.cells = 1.5};
  attempts[8] = (Attempt){.stage = 'L', .kind = CW_OUTCOME_FINER};
  for (int pass = 1; pass <= 8; pass++) strcat(wanted, "WLIUGeN S ");
  strcat(wanted, "WLe F0 zf p00 S h00 ");
  for (int pass = 9; pass <= 17; pass++) strcat(wanted, "WLIUGeN S ");
  strcat(wanted, "WLIUGeN m");
  assert_int_equal(begin(10, attempts, CW_STAGE_NONE, 0), CW_OK);
  expect(wanted);
  assert_int_equal(retries_and_passes(), 10 + 18);
  end();
}

static void a_run_ends_after_the_stage_that_is_asked(void **state) {
  static const char *const TRACES[CW_STAGE_COUNT] = {
      "", "o", "of p00", "of p00 h00w We", "of p00 h00w We", "of p00 h00w WLe", "of p00 h00w WLIUe"};
  for (int asked = CW_STAGE_NONE + 1; asked < CW_STAGE_COUNT; asked++) {
    assert_int_equal(BEGIN((CwStage)asked, {.cells = 1}), CW_OK);
    expect(TRACES[asked]);
    assert_int_equal(run.stopped, 1);
    assert_int_equal(kept(), 0);
    end();
  }
}

static void an_error_ends_the_run(void **state) {
  static const char STAGES[] = "WLIUG";
  for (int i = 0; i < 5; i++) {
    char wanted[100];
    snprintf(wanted, sizeof wanted, "of p00 h00w %.*se", i + 1, STAGES);
    assert_int_equal(BEGIN(CW_STAGE_NONE, {.stage = STAGES[i], .error = CW_ERR_IO}), CW_ERR_IO);
    expect(wanted);
    end();
  }
}

// Thinner layers, from planes or regions, three times on a plan; on another one from the beginning.
static void thinner_layers_are_tried_before_other_planes(void **state) {
  MAKE("of p00 h00w WLIUG T0 WLI T1 WLIUGe N m", {.stage = 'G', .kind = CW_OUTCOME_THIN},
       {.stage = 'I', .kind = CW_OUTCOME_THIN}, {.cells = 1});
  assert_int_equal(run.passes, 1);
  end();
#define THIN {.stage = 'G', .kind = CW_OUTCOME_THIN}
  MAKE("of p00 h00w WLIUG T0 WLIUG T1 WLIUG T2 WLIUG T3 e A1 WLIUG T0 WLIUGe N m", THIN, THIN, THIN, THIN, THIN,
       {.cells = 1});
#undef THIN
  end();
}

static void planes_that_do_not_fit_are_others(void **state) {
  MAKE("of p00 h00w W eA1 WL eA0 WLIUGe N m", {.stage = 'W', .kind = CW_OUTCOME_REPLAN, .domain = 1},
       {.stage = 'L', .kind = CW_OUTCOME_ASYMMETRIC}, {.cells = 1});
  end();
  assert_int_equal(BEGIN(CW_STAGE_NONE, {.stage = 'W', .kind = CW_OUTCOME_REPLAN}), CW_ERR_MESH);
  expect("of p00 h00w W eA0 W eA0 W eA0 e");
  assert_string_equal(cw_fail_message(), "no plan fits");
  end();
}

#define NO_LAYERS                                                                                                      \
  { .stage = 'L', .kind = CW_OUTCOME_PINCH, .domain = 1 }
#define SIX(of) of, of, of, of, of, of
// Where six rounds of shorter edges have not done columns there have no height. A run that was killed has the same ones
// pinched.
static void columns_are_pinched_where_no_layers_stand(void **state) {
  char wanted[sizeof trace] = "of p00 h00w";
  const Attempt killed = {.stage = 'G', .error = CW_ERR_IO};
  for (int i = 0; i < 6; i++) strcat(wanted, " WLe F1 zf p00 S h00");
  assert_int_equal(BEGIN(CW_STAGE_NONE, SIX(NO_LAYERS), NO_LAYERS, NO_LAYERS, killed), CW_ERR_IO);
  expect(strcat(wanted, " WLe P6 zf p00 S h00 WLe P7 zf p00 S h00 WLIUGe"));
  assert_int_equal(run.finer.count, 8);
  assert_int_equal(retries_and_passes(), 81);
  assert_non_null(strstr(cw_log_warning(run.context.log, 7), "made again with no layers there"));
  end();
  MAKE("o P6 P7 zf p00 S h00w WLIUGe N m", {.cells = 1});
  end();
}
#undef SIX
#undef NO_LAYERS

// All begins anew, with the laws as they are; a pass does not count. Six times, each with edges half as long.
static void shorter_edges_make_room_for_layers(void **state) {
  MAKE("of p00 h00w WLe F1 zf p00 S h00 WLIUGe N m", {.stage = 'L', .kind = CW_OUTCOME_FINER, .domain = 1},
       {.cells = 1});
  assert_int_equal(retries_and_passes(), 11);
  assert_int_equal(run.finer.count, 1);
  assert_int_equal(cw_log_warning_count(run.context.log), 1);
  end();
  unlink(in_test_folder("mesh/pass.json"));
  char wanted[sizeof trace] = "of p00 h00w WLe";
  for (int i = 0; i < 6; i++) strcat(wanted, " F1 zf p00 S h00 WLe");
  assert_int_equal(BEGIN(CW_STAGE_NONE, {.stage = 'L', .kind = CW_OUTCOME_FINER, .domain = 1}), CW_ERR_MESH);
  expect(wanted);
  assert_non_null(strstr(cw_fail_message(), "stator: as the script says at ("));
  assert_non_null(strstr(cw_fail_message(), "also with edges 64 times shorter there"));
  end();
}

#define POOR(of)                                                                                                       \
  { .cells = 1, .poor = 1, .deficit = of }
#define BEFORE "of p00 h00w WLIUGeN "

// Four times where each is better than the one before; then the stator, which lacks angles, gets other planes: of one,
// two and three regions more than the best had, at last of no symmetry. They are no better: the fifth is made again.
static void shorter_edges_come_before_other_planes(void **state) {
  MAKE(BEFORE "Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN "
              "zf p01 S h00 WLIUGeN zf p02 S h00 WLIUGeN zf p03 S h01 WLIUGeN zf p00 S h00 WLIUGeN m",
       POOR(9), POOR(8), POOR(7), POOR(6), POOR(5), POOR(5), POOR(6), POOR(7), POOR(5));
  assert_int_equal(run.finer.count, 4);
  assert_int_equal(retries_and_passes(), 81);
  end();
}

// Twice where the first has not helped. Planes that help are those from which the next ones are counted, and which are
// made again at the end, without the places of before; from the first factors, for so was the best mesh before them.
// Also twice after a round that has helped.
static void what_helps_is_kept(void **state) {
  MAKE(BEFORE "Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN "
              "zf p01 h00 WLIUGeN zf p03 h00 WLIUGeN zf p04 h01 WLIUGeN zf p01 h00 WLIUGeN m",
       POOR(5), POOR(6), POOR(5), POOR(4), POOR(5), POOR(4.5), POOR(4));
  assert_int_equal(run.finer.count, 0);
  end();
  unlink(in_test_folder("mesh/pass.json"));
  MAKE(BEFORE "Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN zf p01 S h00 WLIUGeN m", POOR(5),
       POOR(4), POOR(6), POOR(6), {.cells = 1});
  assert_int_equal(run.finer.count, 1);
  end();
}

// After other planes come fewer layers, where edges are too long for so many: a quarter less each time than the best
// mesh has, in what falls short, and no fewer than three, nor as few twice.
static void fewer_layers_come_last(void **state) {
#define PLANES POOR(9), POOR(9), POOR(9), POOR(9), POOR(9), POOR(9)
  const char *before = "of p00 h00w WLIUGeN Q zf p00 k13 S h00 WLIUGeN Q zf p00 k13 S h00 WLIUGeN "
                       "zf p01 h00 WLIUGeN zf p02 h00 WLIUGeN zf p03 h01 WLIUGeN";
  char wanted[sizeof trace];
  crowded_layers = 13;
  snprintf(wanted, sizeof wanted, "%s zf p00 k10 h00 WLIUGeN zf p00 k7 h00 WLIUGeN zf p00 k4 h00 WLIUGeN", before);
  MAKE(strcat(wanted, " zf p00 h00 WLIUGeN m"), PLANES, POOR(9), POOR(9), POOR(9), POOR(9));
  end();
  unlink(in_test_folder("mesh/pass.json"));
  snprintf(wanted, sizeof wanted, "%s zf p00 k10 h00 WLIUGeN zf p00 k6 h00 WLIUGeN m", before); // from the best
  MAKE(wanted, PLANES, POOR(8), {.cells = 1});
  end();
  unlink(in_test_folder("mesh/pass.json"));
  crowded_layers = 4;
  MAKE("of p00 h00w WLIUGeN Q zf p00 k4 S h00 WLIUGeN Q zf p00 k4 S h00 WLIUGeN zf p01 h00 WLIUGeN zf p02 h00 WLIUGeN "
       "zf p03 h01 WLIUGeN zf p00 k3 h00 WLIUGeN zf p00 h00 WLIUGeN m",
       PLANES, POOR(9), POOR(9));
  end();
  unlink(in_test_folder("mesh/pass.json"));
  crowded_layers = 3;
  MAKE("of p00 h00w WLIUGeN Q zf p00 k3 S h00 WLIUGeN Q zf p00 k3 S h00 WLIUGeN zf p01 h00 WLIUGeN zf p02 h00 WLIUGeN "
       "zf p03 h01 WLIUGeN zf p00 h00 WLIUGeN m",
       PLANES, POOR(9));
  end();
  crowded_layers = 0;
#undef PLANES
}

// A round for quality has the planes that were found before it, and is as whole.
static void planes_are_kept_with_shorter_edges(void **state) {
  MAKE("of p00 h00w W eA1 W eA0 WLIUGeN Q zf p01 S h10 WLIUGeN m",
       {.stage = 'W', .kind = CW_OUTCOME_REPLAN, .domain = 1}, {.stage = 'W', .kind = CW_OUTCOME_ASYMMETRIC}, POOR(5),
       {.cells = 1});
  end();
}

// Where nothing is poor any more, or what is poor is rare for so many cells, all is well.
static void a_good_mesh_is_the_last(void **state) {
  MAKE(BEFORE "Q zf p00 S h00 WLIUGeN m", POOR(5), {.cells = 1});
  assert_int_equal(run.finer.count, 1);
  end();
  unlink(in_test_folder("mesh/pass.json"));
  MAKE(BEFORE "Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN zf p01 h00 WLIUGeN m", POOR(5), POOR(6), POOR(7),
       {.cells = 1});
  end();
  unlink(in_test_folder("mesh/pass.json"));
  asked = (int64_t)(1.5 * cw_policy.poor_rare);
  MAKE(BEFORE "m", POOR(5));
  end();
  MAKE(BEFORE "Q zf p00 S h00 WLIUGeN m", {.cells = 1, .poor = 2, .deficit = 5}, {.cells = 1});
  end();
  asked = 100000;
}

// A round for quality needs no mesh: where it has none, and no other plan, the next is tried; planes of which there are
// others are others. The best mesh, at the end, has to be.
static void rounds_for_quality_may_fail(void **state) {
  MAKE(BEFORE "Q zf p00 S h00 WLe zf p01 h00 WLIUGeN zf p02 h00 W eA1 WLIUGeN zf p03 h01 We "
              "zf p00 h00 WLIUGeN m",
       POOR(5), {.stage = 'L', .kind = CW_OUTCOME_FINER}, POOR(6),
       {.stage = 'W', .kind = CW_OUTCOME_REPLAN, .domain = 1}, POOR(6),
       {.stage = 'W', .kind = CW_OUTCOME_ASYMMETRIC, .domain = 1}, POOR(5));
  assert_int_equal(run.finer.count, 0);
  end();
  unlink(in_test_folder("mesh/pass.json"));
#define NONE {.stage = 'L', .kind = CW_OUTCOME_FINER, .domain = 1}
  MAKE(BEFORE
       "Q zf p00 S h00 WLe zf p01 h00 WLe zf p02 h00 WLe zf p03 h01 WLe zf p00 h00 WLe F1 zf p00 S h00 WLIUGeN m",
       POOR(5), NONE, NONE, NONE, NONE, NONE, POOR(5));
#undef NONE
  end();
}

// What a killed run had learnt, its places and its planes.
static void a_killed_run_goes_on(void **state) {
  const Attempt killed = {.stage = 'G', .error = CW_ERR_IO}, good = {.cells = 1};
  assert_int_equal(BEGIN(CW_STAGE_NONE, {.cells = 1.1}, killed), CW_ERR_IO);
  expect("of p00 h00w WLIUGe NS WLIUGe");
  end();
  MAKE("of p00 S h00w WLIUGe N m", good);
  assert_int_equal(run.passes, 2);
  assert_true(factor_at_scale == 0.333333333333);
  end();
  assert_int_equal(BEGIN(CW_STAGE_NONE, POOR(5), POOR(6), POOR(6), killed), CW_ERR_IO); // from pass 2 on
  expect("of p00 S h00w WLIUGeN Q zf p00 S h00 WLIUGeN Q zf p00 S h00 WLIUGeN zf p01 S h00 WLIUGe");
  end();
  MAKE("of p01 S h00w WLIUGeN zf p02 S h00 WLIUGeN m", POOR(6), good);
  assert_int_equal(run.passes, 2);
  end();
  unlink(in_test_folder("mesh/pass.json"));
  assert_int_equal(BEGIN(CW_STAGE_NONE, {.stage = 'L', .kind = CW_OUTCOME_FINER}, killed), CW_ERR_IO);
  end();
  MAKE("oz f p00 S h00w WLIUGe N m", good);
  assert_int_equal(run.passes, 1);
  assert_int_equal(run.finer.count, 1);
  end();
}

// The first rank writes for all.
static void other_ranks_write_nothing(void **state) {
  const Attempt attempts[] = {{.cells = 2}, {.cells = 1}};
  assert_int_equal(begin(2, attempts, CW_STAGE_NONE, 1), CW_OK);
  expect("of p00 h00w WLIUGe NS WLIUGe N");
  assert_int_equal(kept(), 0);
  end();
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, make_run, clear_test_folder)
  const struct CMUnitTest tests[] = {
      TEST(a_mesh_of_enough_cells_is_the_last),
      TEST(passes_have_an_end),
      TEST(passes_begin_anew_with_other_sizes),
      TEST(a_run_ends_after_the_stage_that_is_asked),
      TEST(an_error_ends_the_run),
      TEST(thinner_layers_are_tried_before_other_planes),
      TEST(planes_that_do_not_fit_are_others),
      TEST(columns_are_pinched_where_no_layers_stand),
      TEST(shorter_edges_make_room_for_layers),
      TEST(shorter_edges_come_before_other_planes),
      TEST(what_helps_is_kept),
      TEST(fewer_layers_come_last),
      TEST(planes_are_kept_with_shorter_edges),
      TEST(a_good_mesh_is_the_last),
      TEST(rounds_for_quality_may_fail),
      TEST(a_killed_run_goes_on),
      TEST(other_ranks_write_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
