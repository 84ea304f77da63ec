// SPDX-License-Identifier: AGPL-3.0-or-later
#include <malloc.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include <mpi.h>

#include "launch.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/schedule.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static CwLog *test_log;

enum { TASKS = 40 };

typedef struct {
  const char *mode;
  int slow; // 1: the rank that serves
  int ran[TASKS], order[TASKS], count;
} Work;

// Words by file, in the folder of the launch: that the task has begun for which all other ranks wait, and that a rank
// has slept meanwhile.
enum { SLEEPS = 5 };
static const char *const BEGUN = "begun";
static int slept = SLEEPS; // of this rank, since the task has begun; SLEEPS: it has said so, or need not

static void path_of_word(const char *word, char path[4300]) {
  snprintf(path, 4300, "%s/%s", getenv("CUTWATER_LAUNCHED"), word);
}

static void say(const char *word) {
  char path[4300];
  path_of_word(word, path);
  FILE *file = fopen(path, "w");
  if (file) fclose(file);
}

static int is_said(const char *word) {
  char path[4300];
  path_of_word(word, path);
  return access(path, F_OK) == 0;
}

// In the place of the system's, by which the ranks that wait fall asleep between two looks.
int nanosleep(const struct timespec *pause, struct timespec *left) {
  if (slept < SLEEPS && is_said(BEGUN) && ++slept == SLEEPS) {
    char word[30];
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    snprintf(word, sizeof word, "slept-%d", rank);
    say(word);
  }
  return clock_nanosleep(CLOCK_MONOTONIC, 0, pause, left);
}

// Ends once all other ranks have slept; with ranks that look on without a sleep the test does not end.
static void wait_for_sleepers(void) {
  int rank, ranks;
  char word[30];
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  slept = SLEEPS;
  say(BEGUN);
  for (int other = 0; other < ranks; other++) {
    snprintf(word, sizeof word, "slept-%d", other);
    while (other != rank && !is_said(word)) usleep(1000);
  }
  printf("ASLEEP %d\n", ranks - 1);
}

static int64_t result_size(const Work *work, int32_t task) {
  if (!strcmp(work->mode, "large")) return task == 3 ? 150000001 : 0; // more than two broadcasts
  return task % 5 == 4 ? 0 : 100 + 13 * task;
}

static unsigned char result_byte(int32_t task, int64_t at) {
  return (unsigned char)(task * 31 + at * 7 + at / 251);
}

static CwStatus run(void *context, int32_t task, void **bytes, int64_t *size) {
  Work *work = context;
  CwStatus status = CW_OK;
  work->ran[task]++;
  work->order[work->count++] = task;
  CW_REQUIRE((strcmp(work->mode, "fail") && strcmp(work->mode, "slow-fails")) || task != 17, CW_ERR_MESH,
             "region 17 is too thin at (1, 2, 3) mm");
  CW_REQUIRE(strcmp(work->mode, "all-fail"), CW_ERR_MESH, "every task fails");
  if (!strcmp(work->mode, "killed") && task == 5) raise(SIGKILL);
  if (!strcmp(work->mode, "slow") && work->slow && work->count == 1)
    sleep(1);
  else if (!strcmp(work->mode, "slow-fails") && work->slow && sleep(120) == 0)
    printf("SLEPT\n");
  else if (!strcmp(work->mode, "idle") && task == 0)
    wait_for_sleepers();
  else if (strcmp(work->mode, "alone") && strcmp(work->mode, "idle"))
    usleep(2000);
  *size = result_size(work, task);
  if (*size) {
    unsigned char *result = malloc((size_t)*size);
    for (int64_t at = 0; at < *size; at++) result[at] = result_byte(task, at);
    *bytes = result;
  }
done:
  return status;
}

static CwSchedule schedule_of(Work *work, const double *cost) {
  return (CwSchedule){
      .step = "tasks", .unit = "tasks", .count = TASKS, .cost = cost, .run = run, .context = work, .gather = 1};
}

// Gives when it began and ended. The first takes long, so that whoever is free reaches the tasks that wait for it.
static CwStatus run_timed(void *context, int32_t task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  double *time = NULL;
  CW_NEW(time, 2);
  time[0] = cw_seconds();
  usleep(task == 0 ? 300000 : 1000);
  CW_REQUIRE(strcmp(context, "first-fails") || task != 0, CW_ERR_MESH, "the first task fails");
  time[1] = cw_seconds();
  *bytes = time;
  *size = sizeof(double[2]);
  time = NULL;
done:
  free(time);
  return status;
}

// Of four tasks three wait for the first. How many began before it had ended, or -1 where the schedule failed.
static int began_too_early(const CwContext *context, char *mode) {
  int early = 0;
  double cost[TASKS];
  int32_t after[TASKS];
  void *bytes[TASKS] = {0};
  int64_t size[TASKS] = {0};
  for (int k = 0; k < TASKS; k++) {
    cost[k] = k % 4 == 0 ? 2 : 1;
    after[k] = k % 4 == 0 ? -1 : k - k % 4;
  }
  CwSchedule schedule = {.step = "tasks",
                         .unit = "tasks",
                         .count = TASKS,
                         .cost = cost,
                         .after = after,
                         .run = run_timed,
                         .context = mode,
                         .gather = 1};
  if (cw_schedule_run(context, &schedule, bytes, size, NULL) != CW_OK) early = -1;
  for (int k = 0; k < TASKS && early >= 0; k++) {
    early += after[k] >= 0 && ((double *)bytes[k])[0] < ((double *)bytes[after[k]])[1];
  }
  for (int k = 0; k < TASKS; k++) free(bytes[k]);
  return early;
}

static CwStatus give_number(void *context, int32_t task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  int32_t *number = NULL;
  CW_NEW(number, 1);
  *number = task;
  *bytes = number;
  *size = sizeof *number;
done:
  return status;
}

static int in_vain(const void *bytes) {
  int32_t task = *(const int32_t *)bytes;
  return task % 8 == 0 || task % 8 == 5;
}

// Of four tasks each waits for the one before it; the first of every other four ends in vain, and the second of the
// others: what waits for it, and for that, is left out.
static int left_out_wrong(const CwContext *context) {
  int32_t after[TASKS];
  double seconds[TASKS];
  void *bytes[TASKS] = {0};
  int64_t size[TASKS] = {0};
  for (int32_t k = 0; k < TASKS; k++) after[k] = k % 4 ? k - 1 : -1;
  CwSchedule schedule = {
      .step = "tasks", .count = TASKS, .after = after, .in_vain = in_vain, .run = give_number, .gather = 1};
  int wrong = cw_schedule_run(context, &schedule, bytes, size, seconds) != CW_OK;
  for (int32_t k = 0; k < TASKS; k++) {
    int ran = k % 8 == 0 || k % 8 == 4 || k % 8 == 5;
    wrong += size[k] != (ran ? (int64_t)sizeof k : 0) || (bytes[k] != NULL) != ran || (!ran && seconds[k] != 0);
    wrong += ran && bytes[k] && *(int32_t *)bytes[k] != k;
    free(bytes[k]);
  }
  return wrong;
}

static int results_wrong(const Work *work, void **bytes, const int64_t *size) {
  int wrong = 0;
  for (int32_t task = 0; task < TASKS; task++) {
    wrong += size[task] != result_size(work, task);
    for (int64_t at = 0; at < size[task]; at++) {
      wrong += ((unsigned char *)bytes[task])[at] != result_byte(task, at);
    }
    free(bytes[task]);
    bytes[task] = NULL;
  }
  return wrong;
}

static CwStatus fail_on_first_rank(void *context, int32_t task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CW_REQUIRE(*(const int *)context > 0, CW_ERR_MESH, "the rank that serves fails");
done:
  return status;
}

// The rank that serves fails at once, but another one is to say why: it waits for that, and its thread serves
// meanwhile. Large arrays that it frees are no memory of its own any more.
static CwStatus fail_behind_another(const CwContext *context) {
  int rank = cw_team_rank(context->team);
  CwSchedule schedule = {.step = "tasks", .count = 400000, .run = fail_on_first_rank, .context = &rank};
  mallopt(M_MMAP_THRESHOLD, 1 << 16);
  if (rank == 0) cw_stop_claim();
  return cw_schedule_run(context, &schedule, NULL, NULL, NULL);
}

static int be_a_rank(int argc, char **argv) {
  int wrong = 0;
  if (!strncmp(argv[1], "dealt", 5)) MPI_Init(&argc, &argv); // one thread: no server
  CwTeam *all;
  begin_as_rank(&argc, &argv, &all);
  CwContext context = {.team = all};
  int rank = cw_team_rank(all), ranks = cw_team_ranks(all);
  cw_log_open("test", NULL, rank == 0, 0, &test_log);
  context.log = test_log;
  if (!strcmp(argv[1], "idle")) slept = 0;
  if (!strcmp(argv[1], "server-fails")) return fail_behind_another(&context) == CW_OK; // ends inside
  if (strstr(argv[1], "after") || !strcmp(argv[1], "first-fails")) {
    printf("RANK %d EARLY %d\n", rank, began_too_early(&context, argv[1]));
    cw_log_close(&test_log);
    return end_as_rank(all, 0);
  }
  if (strstr(argv[1], "vain")) {
    printf("RANK %d WRONG %d\n", rank, left_out_wrong(&context));
    cw_log_close(&test_log);
    return end_as_rank(all, 0);
  }
  for (int repeat = 0; repeat < (strcmp(argv[1], "large") ? 3 : 1); repeat++) {
    Work work = {.mode = argv[1], .slow = rank == 0};
    double cost[TASKS], seconds[TASKS];
    void *bytes[TASKS] = {0};
    int64_t size[TASKS] = {0};
    for (int k = 0; k < TASKS; k++) cost[k] = k % 7;
    CwSchedule schedule = schedule_of(&work, cost);
    double own = 0;
    if (cw_schedule_run(&context, &schedule, bytes, size, seconds) != CW_OK) return 99; // fails inside with many ranks
    wrong += results_wrong(&work, bytes, size);
    // Seconds of the processor: some of each task, and not those that a task sleeps.
    for (int k = 0; k < TASKS; k++) wrong += seconds[k] <= 0;
    for (int k = 0; k < work.count; k++) own += seconds[work.order[k]];
    wrong += !strcmp(argv[1], "work") && work.count > 0 && own > 0.5 * 0.002 * work.count;
    wrong += !strcmp(argv[1], "slow") && rank == 0 && work.count > TASKS / (4 * ranks);
    // Each rank took its tasks largest first.
    for (int k = 1; k < work.count; k++) wrong += cost[work.order[k]] > cost[work.order[k - 1]];
    printf("RANK %d RAN %d WRONG %d\n", rank, work.count, wrong);
    if (!strcmp(argv[1], "idle")) break;
  }
  cw_log_close(&test_log);
  return end_as_rank(all, wrong != 0);
}

// Numbers of ranks that are tried: 1, 2 and 5; all from 1 to 5 with an argument.
static int all;

static int next_ranks(int ranks) {
  return ranks == 2 && !all ? 5 : ranks + 1;
}

static void check_work(const char *mode, int ranks) {
  int lines;
  launch_and_find_right(ranks, mode, 3);
  assert_int_equal(sum_of(" RAN ", &lines), 3 * TASKS);
}

static void every_task_runs_once_and_all_get_all(void **state) {
  for (int ranks = 1; ranks <= 5; ranks = next_ranks(ranks)) check_work("work", ranks);
  check_work("work", 8); // more than the cores of a small machine
}

static void tasks_are_dealt_where_no_thread_can_serve(void **state) {
  for (int ranks = 1; ranks <= 5; ranks = next_ranks(ranks)) check_work("dealt", ranks);
}

// While the rank that serves is in a long task, the others take all that is left.
static void nobody_waits_for_a_task_of_the_rank_that_serves(void **state) {
  for (int ranks = 2; ranks <= 5; ranks = next_ranks(ranks)) check_work("slow", ranks);
}

static void a_failure_ends_the_task_of_the_rank_that_serves(void **state) {
  for (int ranks = 2; ranks <= 5; ranks = next_ranks(ranks)) {
    assert_int_equal(launch(ranks, "slow-fails"), CW_ERR_MESH);
    assert_int_equal(count_lines_with("error: region 17 is too thin"), 1);
    assert_int_equal(count_lines_with("error:"), 1);
    assert_null(strstr(output, "SLEPT"));
  }
}

static void large_results_come_whole(void **state) {
  int lines;
  launch_well(2, "large");
  assert_int_equal(sum_of(" RAN ", &lines), TASKS);
}

static void failing_task_ends_the_run_with_one_line(void **state) {
  assert_int_equal(launch(4, "fail"), CW_ERR_MESH);
  assert_null(strstr(output, " RAN "));
  assert_int_equal(count_lines_with("error:"), 1);
  assert_non_null(strstr(output, "cutwater-test: error: region 17 is too thin at (1, 2, 3) mm"));
  assert_null(strstr(output, "MPI_ABORT"));
}

static void a_rank_that_fails_serves_until_its_end(void **state) {
  assert_int_equal(launch(2, "server-fails"), CW_ERR_MESH);
  assert_int_equal(count_lines_with("error:"), 1);
  assert_non_null(strstr(output, "error: the rank that serves fails"));
}

static void many_failing_tasks_print_one_line(void **state) {
  assert_int_equal(launch(4, "all-fail"), CW_ERR_MESH);
  assert_int_equal(count_lines_with("error:"), 1);
}

static void tasks_wait_for_those_they_come_after(void **state) {
  assert_int_equal(began_too_early(NULL, "after"), 0);
  for (int ranks = 1; ranks <= 5; ranks = next_ranks(ranks)) {
    for (int dealt = 0; dealt < 2; dealt++) {
      int lines;
      launch_well(ranks, dealt ? "dealt-after" : "after");
      assert_int_equal(sum_of(" EARLY ", &lines), 0);
      assert_int_equal(lines, ranks);
    }
  }
}

static void tasks_that_wait_in_vain_are_left_out(void **state) {
  assert_int_equal(left_out_wrong(NULL), 0);
  for (int ranks = 1; ranks <= 5; ranks = next_ranks(ranks)) {
    launch_and_find_right(ranks, "vain", 1);
    launch_and_find_right(ranks, "dealt-vain", 1);
  }
}

// Those that wait do not wait for ever.
static void failing_task_ends_those_that_wait(void **state) {
  assert_int_equal(began_too_early(NULL, "first-fails"), -1);
  assert_int_equal(launch(3, "first-fails"), CW_ERR_MESH);
  assert_int_equal(count_lines_with("error: the first task fails"), 1);
}

// Tasks that would wait for one another without end are refused.
static void tasks_that_wait_for_one_another_are_refused(void **state) {
  const double cost[2] = {1, 2};
  const int32_t after[2] = {1, 0};
  CwSchedule schedule = {
      .step = "tasks", .count = 2, .cost = cost, .after = after, .run = run_timed, .context = "after"};
  assert_int_equal(cw_schedule_run(NULL, &schedule, NULL, NULL, NULL), CW_ERR_INPUT);
}

typedef struct {
  int count, task[4];
} Taken;

static CwStatus note_task(void *context, int32_t task, void **bytes, int64_t *size) {
  Taken *taken = context;
  taken->task[taken->count++] = task;
  return CW_OK;
}

// Task 1 is not the largest, but with the two that wait for it.
static void what_others_wait_for_is_taken_first(void **state) {
  const double cost[4] = {3, 2, 1, 0.5};
  const int32_t after[4] = {-1, -1, 1, 1}, wanted[4] = {1, 0, 2, 3};
  Taken taken = {0};
  CwSchedule schedule = {
      .step = "tasks", .count = 4, .cost = cost, .after = after, .run = note_task, .context = &taken};
  assert_int_equal(cw_schedule_run(NULL, &schedule, NULL, NULL, NULL), CW_OK);
  assert_int_equal(taken.count, 4);
  for (int i = 0; i < 4; i++) assert_int_equal(taken.task[i], wanted[i]);
}

static void killed_rank_ends_the_run(void **state) {
  assert_int_equal(launch(4, "killed"), 128 + SIGKILL);
  assert_null(strstr(output, " RAN "));
}

// Four ranks wait for the task of the fifth, which waits until each of them has slept several times.
static void waiting_ranks_sleep(void **state) {
  int looks;
  launch_well(5, "idle");
  assert_int_equal(sum_of("ASLEEP ", &looks), 4);
  assert_int_equal(looks, 1);
}

static void one_rank_runs_largest_first(void **state) {
  Work work = {.mode = "alone"};
  double cost[TASKS], seconds[TASKS];
  void *bytes[TASKS] = {0};
  int64_t size[TASKS] = {0};
  for (int k = 0; k < TASKS; k++) cost[k] = k % 3;
  CwSchedule schedule = schedule_of(&work, cost);
  assert_int_equal(cw_schedule_run(NULL, &schedule, bytes, size, seconds), CW_OK);
  assert_int_equal(work.count, TASKS);
  for (int k = 0; k < TASKS; k++) assert_int_equal(work.ran[k], 1);
  assert_int_equal(work.order[0], 2); // cost 2: 2, 5, 8, ...; then 1, 4, 7, ...
  assert_int_equal(work.order[1], 5);
  assert_int_equal(work.order[13], 1);
  assert_int_equal(results_wrong(&work, bytes, size), 0);
}

static void one_rank_gives_the_failure_back(void **state) {
  Work work = {.mode = "fail"};
  void *bytes[TASKS] = {0};
  int64_t size[TASKS] = {0};
  CwSchedule schedule = schedule_of(&work, NULL);
  assert_int_equal(cw_schedule_run(NULL, &schedule, bytes, size, NULL), CW_ERR_MESH);
  assert_string_equal(cw_fail_message(), "region 17 is too thin at (1, 2, 3) mm");
  for (int k = 0; k < TASKS; k++) free(bytes[k]);
}

int main(int argc, char **argv) {
  if (launched(argc)) return be_a_rank(argc, argv);
  all = argc > 1;
  cw_log_open("test", NULL, 0, 0, &test_log);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_rank_runs_largest_first),
      cmocka_unit_test(one_rank_gives_the_failure_back),
      cmocka_unit_test(every_task_runs_once_and_all_get_all),
      cmocka_unit_test(tasks_are_dealt_where_no_thread_can_serve),
      cmocka_unit_test(nobody_waits_for_a_task_of_the_rank_that_serves),
      cmocka_unit_test(a_failure_ends_the_task_of_the_rank_that_serves),
      cmocka_unit_test(large_results_come_whole),
      cmocka_unit_test(failing_task_ends_the_run_with_one_line),
      cmocka_unit_test(a_rank_that_fails_serves_until_its_end),
      cmocka_unit_test(many_failing_tasks_print_one_line),
      cmocka_unit_test(tasks_wait_for_those_they_come_after),
      cmocka_unit_test(tasks_that_wait_in_vain_are_left_out),
      cmocka_unit_test(failing_task_ends_those_that_wait),
      cmocka_unit_test(tasks_that_wait_for_one_another_are_refused),
      cmocka_unit_test(what_others_wait_for_is_taken_first),
      cmocka_unit_test(killed_rank_ends_the_run),
      cmocka_unit_test(waiting_ranks_sleep),
  };
  int failed = cmocka_run_group_tests(tests, NULL, NULL);
  cw_log_close(&test_log);
  return failed;
}
