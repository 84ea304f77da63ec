// SPDX-License-Identifier: AGPL-3.0-or-later
#include <string.h>

#include "launch.h"
#include "mesher/parallel/outcome.h"
#include "mesher/parallel/ranks.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static CwLog *test_log;

enum { COUNT = 7 };

// What the rank `of` finds out about item i.
static CwOutcome found_by(int of, int32_t i) {
  const double place[3] = {i, of, 0.5};
  CwOutcome outcome = {0};
  if (i % 2) cw_outcome_set(&outcome, i % 3 ? CW_OUTCOME_REPLAN : CW_OUTCOME_THIN, place, "item %d of rank %d", i, of);
  return outcome;
}

// Each rank knows the outcomes of its own items alone, and something wrong of the others.
static int be_a_rank(int argc, char **argv) {
  CwOutcome outcome[COUNT];
  int owner[COUNT], wrong = 0;
  CwTeam *all;
  begin_as_rank(&argc, &argv, &all);
  int rank = cw_team_rank(all), ranks = cw_team_ranks(all);
  cw_log_open("test", NULL, rank == 0, 0, &test_log);
  for (int32_t i = 0; i < COUNT; i++) {
    owner[i] = (3 * i + 1) % ranks;
    outcome[i] = found_by(owner[i] == rank ? rank : rank + 100, i + (owner[i] != rank));
  }
  cw_outcomes_agree(all, COUNT, outcome, owner);
  for (int32_t i = 0; i < COUNT; i++) {
    CwOutcome wanted = found_by(owner[i], i);
    wrong += outcome[i].kind != wanted.kind || strcmp(outcome[i].reason, wanted.reason) != 0;
    wrong += memcmp(outcome[i].place, wanted.place, sizeof wanted.place) != 0;
  }
  printf("RANK %d WRONG %d\n", rank, wrong);
  cw_log_close(&test_log);
  return end_as_rank(all, wrong != 0);
}

static void ranks_agree(void **state) {
  for (int ranks = 1; ranks <= 3; ranks++) {
    launch_and_find_right(ranks, "agree", 1);
  }
}

// Those near one that is there are left out, and those beyond the sixteenth; the first is told.
static void places_stand_apart(void **state) {
  CwOutcome outcome = {0};
  char text[CW_OUTCOME_TEXT_SIZE];
  cw_outcome_set(&outcome, CW_OUTCOME_PINCH, NULL, "no layers");
  assert_int_equal(outcome.places, 0);
  for (int i = 0; i < 40; i++) cw_outcome_add_place(&outcome, (const double[3]){0.5 * i, 0, 1}, 0.9);
  assert_int_equal(outcome.places, CW_OUTCOME_PLACES);
  for (int i = 0; i < outcome.places; i++) assert_true(outcome.place[i][0] == i);
  assert_string_equal(cw_outcome_text(&outcome, 1, text), "no layers at (0.000, 0.000, 1.000) mm");
  cw_outcome_set(&outcome, CW_OUTCOME_PINCH, outcome.place[3], "no layers");
  assert_int_equal(outcome.places, 1);
}

static void text_ends_with_the_place(void **state) {
  char text[CW_OUTCOME_TEXT_SIZE], many[2 * CW_REASON_SIZE];
  const double place[3] = {0.0012, -0.1, 0};
  CwOutcome outcome = {0};
  cw_outcome_set(&outcome, CW_OUTCOME_REPLAN, place, "plane %d grazes %s", 3, "shroud");
  assert_string_equal(cw_outcome_text(&outcome, 1e3, text), "plane 3 grazes shroud at (1.200, -100.000, 0.000) mm");
  cw_outcome_set(&outcome, CW_OUTCOME_ASYMMETRIC, NULL, "no half-planes fit"); // the place is forgotten
  assert_string_equal(cw_outcome_text(&outcome, 1e3, text), "no half-planes fit");
  memset(many, 'x', sizeof many);
  many[sizeof many - 1] = '\0';
  cw_outcome_set(&outcome, CW_OUTCOME_THIN, place, "%s", many); // as long as it may be
  assert_int_equal(strlen(outcome.reason), CW_REASON_SIZE - 1);
  assert_string_equal(cw_outcome_text(&outcome, 1e3, text) + CW_REASON_SIZE - 1, " at (1.200, -100.000, 0.000) mm");
}

static void first_that_is_not_done_counts(void **state) {
  CwOutcome outcome[3] = {{0}};
  assert_int_equal(cw_outcomes_first(3, outcome).kind, CW_OUTCOME_DONE);
  cw_outcome_set(&outcome[2], CW_OUTCOME_THIN, NULL, "second");
  cw_outcome_set(&outcome[1], CW_OUTCOME_REPLAN, NULL, "first");
  CwOutcome first = cw_outcomes_first(3, outcome);
  assert_int_equal(first.kind, CW_OUTCOME_REPLAN);
  assert_int_equal(first.domain, 1);
  assert_string_equal(first.reason, "first");
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(places_stand_apart),
      cmocka_unit_test(text_ends_with_the_place),
      cmocka_unit_test(first_that_is_not_done_counts),
      cmocka_unit_test(ranks_agree),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
