// SPDX-License-Identifier: AGPL-3.0-or-later
#include <signal.h>

#include "launch.h"
#include "mesher/parallel/groups.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static CwLog *test_log;

enum { DOMAINS = 3, MOST = 20000 };

typedef struct {
  const char *mode;
  int ran[DOMAINS];
  int64_t made[DOMAINS][MOST];
} Work;

static int32_t count_of(int32_t domain) {
  return MOST - 7000 * domain;
}

static int64_t value_of(int32_t domain, int32_t item) {
  return 1000003 * (int64_t)(domain + 1) + 17 * (int64_t)item;
}

static CwStatus fill(void *context, int32_t item, void *out) {
  *(int64_t *)out = value_of(*(const int32_t *)context, item);
  return CW_OK;
}

static CwStatus work_on(void *given, const CwContext *context, int32_t domain, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Work *work = given;
  int failing = domain == 1;
  work->ran[domain]++;
  cw_log_debug(context->log, "work on domain %d", domain);
  cw_profiler_part(context, domain == 1 ? "of the second" : "of the others");
  CW_TRY(cw_parallel_for(context, "items", count_of(domain), sizeof(int64_t), fill, &domain, work->made[domain]));
  const double place[3] = {0.001, 0.002, domain};
  CW_END_UNLESS(!failing || strcmp(work->mode, "retry"), outcome, CW_OUTCOME_REPLAN, place, "no column on domain %d",
                domain);
  CW_REQUIRE(!failing || strcmp(work->mode, "fail"), CW_ERR_MESH, "domain %d is too thin at (1, 2, 3) mm", domain);
  if (failing && !strcmp(work->mode, "killed")) raise(SIGKILL);
done:
  return status;
}

static CwStatus hand_over(void *context, const CwGroupHand *hand) {
  Work *work = context;
  cw_group_give(hand, work->made[hand->item], count_of(hand->item) * (int64_t)sizeof(int64_t));
  return CW_OK;
}

// A product: values, and rows that point to values of their own. Row r of domain d has r + d of them.
typedef struct {
  int32_t *value;
} Row;
typedef struct {
  int32_t domain, count, row_count;
  double *x, *none;
  Row *row;
  CwHostMemory *memory;
} Product;
static Product product[DOMAINS];

static void show(void *of, CwArrayVisit visit, void *given) {
  Product *p = of;
  CW_SHOW(visit, given, p->x, p->count);
  CW_SHOW(visit, given, p->none, p->count);
  CW_SHOW_POINTERS(visit, given, p->row, p->row_count);
  for (int32_t r = 0; p->row && r < p->row_count; r++) CW_SHOW(visit, given, p->row[r].value, r + p->domain);
}

static CwStatus halve(void *context, int32_t item, void *out) {
  *(double *)out = 0.5 * item;
  return CW_OK;
}

static CwStatus make_product(void *given, const CwContext *context, int32_t domain, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Product *p = &product[domain];
  ((Work *)given)->ran[domain]++;
  *p = (Product){.domain = domain, .count = count_of(domain), .row_count = 5};
  CW_NEW(p->x, p->count);
  CW_NEW(p->row, p->row_count);
  CW_TRY(cw_parallel_for(context, "halves", p->count, sizeof *p->x, halve, NULL, p->x));
  for (int32_t r = 0; r < p->row_count; r++) {
    CW_NEW(p->row[r].value, r + domain);
    for (int32_t i = 0; i < r + domain; i++) p->row[r].value[i] = 100 * domain + 10 * r + i;
  }
  if (domain == 1) cw_outcome_set(outcome, CW_OUTCOME_THIN, NULL, "thin, with what shows where");
done:
  return status;
}

static CwStatus hold_product(void *given, const CwGroupHand *hand) {
  Product *p = &product[hand->item];
  return cw_group_hold(hand, p, sizeof *p, show, &p->memory);
}

static int product_wrong(int32_t domain) {
  const Product *p = &product[domain];
  int wrong = p->count != count_of(domain) || p->row_count != 5 || p->domain != domain || p->none != NULL;
  for (int32_t i = 0; !wrong && i < p->count; i++) wrong += p->x[i] != 0.5 * i;
  for (int32_t r = 0; !wrong && r < 5; r++) {
    for (int32_t i = 0; i < r + domain; i++) wrong += p->row[r].value[i] != 100 * domain + 10 * r + i;
  }
  return wrong;
}

// One rank makes a domain and all have it, in one place; who wants to change it makes it its own.
static int hold(const CwContext *context, int *ran) {
  static Work work;
  const double cost[DOMAINS] = {3, 2, 1};
  const CwGroupWork domains = {.step = "held",
                               .count = DOMAINS,
                               .cost = cost,
                               .own = 0.1,
                               .by_threads = 1,
                               .run = make_product,
                               .hand = hold_product,
                               .given = &work};
  CwOutcome outcome[DOMAINS];
  int wrong = cw_groups_run(context, &domains, outcome) != CW_OK;
  for (int32_t d = 0; d < DOMAINS; d++) {
    Product *p = &product[d];
    wrong += outcome[d].kind != (d == 1 ? CW_OUTCOME_THIN : CW_OUTCOME_DONE);
    wrong += product_wrong(d);
    wrong += (p->memory != NULL) != (cw_team_ranks(context->team) > 1);
    wrong += p->memory && !cw_host_memory_is_shared(p->memory);
    wrong += cw_arrays_own(p, show, &p->memory) != CW_OK || p->memory || product_wrong(d);
    p->x[0] = p->row[4].value[0] = cw_team_rank(context->team);
    *ran += work.ran[d];
    cw_arrays_free(p, show, &p->memory);
    wrong += p->x || p->row;
  }
  return wrong;
}

static int items_wrong(const Work *work, int32_t domain) {
  int wrong = 0;
  for (int32_t i = 0; i < count_of(domain); i++) wrong += work->made[domain][i] != value_of(domain, i);
  return wrong;
}

// The profiler of all ranks knows all domains: their parts and lists of tasks.
static int profiler_wrong(const CwContext *context, int steps) {
  json_t *account = NULL, *domains = NULL;
  int wrong = cw_profiler_json(context, &account, &domains) != CW_OK || (int)json_array_size(domains) != steps;
  for (size_t i = 0; i < json_array_size(domains); i++) {
    const json_t *domain = json_object_get(json_array_get(domains, i), "side");
    wrong += json_array_size(domain) != DOMAINS;
    for (size_t s = 0; s < json_array_size(domain); s++) {
      const json_t *of = json_array_get(domain, s), *parts = json_object_get(of, "every_rank"),
                   *tasks = json_object_get(of, "tasks");
      const json_t *last = json_array_get(parts, json_array_size(parts) - 1);
      const char *name = json_string_value(json_object_get(json_array_get(parts, 1), "part"));
      wrong += strcmp(name, s == 1 ? "of the second" : "of the others") != 0;
      wrong += !(json_number_value(json_object_get(last, "most")) > 0);
      wrong += json_array_size(tasks) != 1;
      wrong += json_array_size(json_object_get(json_array_get(tasks, 0), "task_seconds")) < 2;
    }
  }
  json_decref(account);
  json_decref(domains);
  return wrong;
}

static int be_a_rank(int argc, char **argv) {
  static Work work;
  const double cost[DOMAINS] = {3, 2, 1};
  int wrong = 0, retry = !strcmp(argv[1], "retry"), ran = 0;
  CwTeam *all;
  begin_as_rank(&argc, &argv, &all);
  CwContext context = {.team = all};
  int rank = cw_team_rank(all);
  wrong += cw_profiler_make(&context.profiler) != CW_OK;
  cw_log_open("test", NULL, rank == 0, !strcmp(argv[1], "work"), &test_log);
  context.log = test_log;
  CwGroupWork domains = {
      .step = "domains", .count = DOMAINS, .cost = cost, .own = 0.5, .run = work_on, .hand = hand_over, .given = &work};
  for (int repeat = 0; repeat < 2; repeat++) {
    CwOutcome outcome[DOMAINS];
    CwStatus status;
    memset(&work, 0, sizeof work);
    work.mode = argv[1];
    status = cw_groups_run(&context, &domains, outcome);
    if (status != CW_OK) return cw_mpi_fail(test_log, status);
    for (int32_t s = 0; s < DOMAINS; s++) {
      wrong += outcome[s].kind != (retry && s == 1 ? CW_OUTCOME_REPLAN : CW_OUTCOME_DONE);
      if (outcome[s].kind == CW_OUTCOME_DONE) wrong += items_wrong(&work, s);
      ran += work.ran[s];
    }
    const CwOutcome first = cw_outcomes_first(DOMAINS, outcome);
    wrong += strcmp(first.reason, retry ? "no column on domain 1" : "") != 0;
    wrong += retry && !(first.domain == 1 && first.places == 1 && first.place[0][2] == 1);
    // The ranks are together again.
    int32_t domain = 0;
    wrong += cw_parallel_for(&context, "after", count_of(0), sizeof(int64_t), fill, &domain, work.made[1]) != CW_OK;
    for (int32_t i = 0; i < count_of(0); i++) wrong += work.made[1][i] != value_of(0, i);
  }
  wrong += profiler_wrong(&context, 2);
  int held_ran = 0;
  wrong += hold(&context, &held_ran);
  cw_profiler_free(&context.profiler);
  printf("RANK %d RAN %d HELD %d WRONG %d\n", rank, ran, held_ran, wrong);
  cw_log_close(&test_log);
  return end_as_rank(all, wrong != 0);
}

static void all_ranks_get_all(void **state) {
  const int ranks[4] = {1, 2, 3, 5}, ran[4] = {6, 12, 18, 14}; // domains that all ranks ran, in two steps
  for (int i = 0; i < 4; i++) {
    int lines;
    launch_and_find_right(ranks[i], "work", 1);
    assert_int_equal(count_lines_with("cutwater-test: work on domain "), 2 * DOMAINS); // whichever rank it was
    assert_int_equal(sum_of(" HELD ", &lines), DOMAINS);
    assert_int_equal(sum_of(" RAN ", &lines), ran[i]); // 5: three of them on one domain, two on the others
  }
}

static void a_domain_that_wants_another_try_is_known_to_all(void **state) {
  for (int ranks = 1; ranks <= 5; ranks += 2) {
    launch_and_find_right(ranks, "retry", 1);
  }
}

static void a_failing_domain_ends_the_run_with_one_line(void **state) {
  for (int ranks = 1; ranks <= 5; ranks += 2) {
    assert_int_equal(launch(ranks, "fail"), CW_ERR_MESH);
    assert_int_equal(count_lines_with("error:"), 1);
    assert_non_null(strstr(output, "cutwater-test: error: domain 1 is too thin at (1, 2, 3) mm"));
  }
}

static void a_killed_rank_ends_the_run(void **state) {
  assert_int_equal(launch(5, "killed"), 128 + SIGKILL);
}

static void check_groups(int count, const double *cost, double own, int ranks, int least, int groups,
                         const int *group_of, const int *ranks_of) {
  int found_of[CW_GROUPS_MOST], found_ranks[CW_GROUPS_MOST];
  assert_int_equal(cw_groups_divide(count, cost, own, ranks, least, found_of, found_ranks), groups);
  for (int s = 0; s < count; s++) assert_int_equal(found_of[s], group_of[s]);
  for (int g = 0; g < groups; g++) assert_int_equal(found_ranks[g], ranks_of[g]);
}

static void groups_follow_the_costs(void **state) {
  const double even[2] = {1, 1}, uneven[2] = {1, 3}, pump[4] = {10, 12, 1, 2};
  const int none[4] = {0}, both[2] = {0, 1}, turned[2] = {1, 0}, pipes[4] = {1, 0, 0, 1};
  check_groups(1, even, 0.5, 24, 2, 1, none, (int[]){24});
  check_groups(2, even, 0.5, 3, 2, 1, none, (int[]){3});
  check_groups(2, even, 0.1, 4, 2, 2, both, (int[]){2, 2});
  check_groups(2, even, 0.1, 7, 2, 2, both, (int[]){4, 3});
  check_groups(2, uneven, 0.1, 24, 2, 2, turned, (int[]){18, 6});
  check_groups(2, uneven, 0, 4, 2, 1, none, (int[]){4}); // 3 / 2 against 4 / 4
  check_groups(4, pump, 0.1, 4, 2, 2, pipes, (int[]){2, 2});
  check_groups(2, even, 0.1, 2, 1, 2, both, (int[]){1, 1});
  check_groups(2, uneven, 0, 2, 1, 1, none, (int[]){2}); // 4 / 2 against 3
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(groups_follow_the_costs),
      cmocka_unit_test(all_ranks_get_all),
      cmocka_unit_test(a_domain_that_wants_another_try_is_known_to_all),
      cmocka_unit_test(a_failing_domain_ends_the_run_with_one_line),
      cmocka_unit_test(a_killed_rank_ends_the_run),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
