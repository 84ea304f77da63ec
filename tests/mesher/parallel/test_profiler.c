// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/parallel/schedule.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static volatile double sink;

static void work(double seconds) {
  for (double end = cw_processor_seconds() + seconds; cw_processor_seconds() < end;) sink += 1;
}

static CwStatus task(void *context, int32_t index, void **bytes, int64_t *size) {
  work(index == 1 ? 0.06 : 0.02);
  return CW_OK;
}

static CwProfiler *profiler;

// Each test has a profiler of its own; the context lasts.
static const CwContext *new_context(void) {
  static CwContext context;
  assert_int_equal(cw_profiler_make(&profiler), CW_OK);
  context.profiler = profiler;
  return &context;
}

static double number(const json_t *object, const char *key) {
  return json_number_value(json_object_get(object, key));
}

static const json_t *find(const json_t *array, const char *key, const char *name) {
  size_t i;
  json_t *item;
  json_array_foreach(array, i, item) {
    if (!strcmp(json_string_value(json_object_get(item, key)), name)) return item;
  }
  return NULL;
}

// What a task spends is the task's; what is spent before and after it is the part's that was called.
static void time_goes_to_tasks_and_parts(void **state) {
  const CwContext *context = new_context();
  double begun = cw_processor_seconds(), sum = 0;
  json_t *account, *group_work, *part;
  cw_profiler_part(context, "before");
  const double cost[3] = {1, 3, 2};
  CwSchedule schedule = {.step = "step", .count = 3, .cost = cost, .run = task};
  assert_int_equal(cw_schedule_run(context, &schedule, NULL, NULL, NULL), CW_OK);
  work(0.03); // schedules leave the part as it was
  assert_string_equal(cw_profiler_part(context, "after"), "before");
  work(0.01);
  assert_int_equal(cw_profiler_json(context, &account, &group_work), CW_OK);
  const json_t *parts = json_object_get(account, "every_rank"), *tasks = json_object_get(account, "tasks");
  assert_int_equal(json_array_size(group_work), 0);
  double all = cw_processor_seconds() - begun;
  assert_int_equal(json_array_size(tasks), 1);
  const json_t *step = find(tasks, "step", "step"), *seconds = json_object_get(step, "task_seconds");
  assert_int_equal(json_array_size(seconds), 3);
  assert_true(json_number_value(json_array_get(seconds, 1)) >= 0.06);
  assert_near(json_number_value(json_array_get(json_object_get(step, "task_cost"), 2)), 2, 0);
  assert_true(number(step, "most") >= 0.1 - 1e-5);
  assert_true(number(find(parts, "part", "before"), "seconds") >= 0.03 - 1e-5);
  assert_true(number(find(parts, "part", "after"), "seconds") >= 0.01 - 1e-5);
  size_t i;
  json_array_foreach(parts, i, part) {
    if (strcmp(json_string_value(json_object_get(part, "part")), "start")) sum += number(part, "seconds");
  }
  assert_true(sum + number(step, "most") <= all + 1e-4); // nothing counts twice
  json_decref(account);
  json_decref(group_work);
  cw_profiler_free(&profiler);
}

static const double COST[2] = {5, 7};

// What is spent on an item is the item's alone; its account can be packed and taken up by a process that was on
// another.
static void items_have_their_own_accounts(void **state) {
  const CwContext *context = new_context();
  json_t *account, *group_work;
  char *bytes;
  int64_t size;
  const double cost[2] = {7, 5};
  const int32_t after[2] = {-1, 0};
  CwSchedule schedule = {.step = "step", .count = 2, .cost = cost, .after = after, .run = task};
  cw_profiler_part(context, "together");
  assert_int_equal(cw_profiler_groups(context, "items", 2, COST, 0.25, 2), CW_OK);
  cw_profiler_item(context, 1);
  cw_profiler_part(context, "alone");
  work(0.03);
  assert_int_equal(cw_schedule_run(context, &schedule, NULL, NULL, NULL), CW_OK);
  cw_profiler_item(context, -1);
  assert_int_equal(cw_profiler_pack(context, 1, &bytes, &size), CW_OK);
  assert_int_equal(cw_profiler_take(context, 0, bytes, size), CW_OK);
  free(bytes);
  assert_string_equal(cw_profiler_part(context, "after"), "together");
  assert_int_equal(cw_profiler_json(context, &account, &group_work), CW_OK);
  assert_null(find(json_object_get(account, "every_rank"), "part", "alone"));
  assert_int_equal(json_array_size(json_object_get(account, "tasks")), 0);
  const json_t *step = find(group_work, "step", "items"), *item = json_object_get(step, "side");
  assert_near(number(step, "own"), 0.25, 0);
  assert_int_equal(json_array_size(item), 2);
  for (size_t s = 0; s < 2; s++) {
    const json_t *of = json_array_get(item, s), *alone = find(json_object_get(of, "every_rank"), "part", "alone"),
                 *list = find(json_object_get(of, "tasks"), "step", "step");
    assert_near(number(of, "cost"), COST[s], 0);
    assert_int_equal(json_array_size(json_object_get(list, "task_seconds")), 2);
    assert_near(json_number_value(json_array_get(json_object_get(list, "task_cost"), 1)), 5, 0);
    assert_near(json_number_value(json_array_get(json_object_get(list, "task_after"), 0)), -1, 0);
    assert_true(json_number_value(json_array_get(json_object_get(list, "task_seconds"), 1)) >= 0.06 - 1e-5);
    assert_true(number(alone, "most") >= (s ? 0.03 - 1e-5 : 0));
    assert_true(number(list, "most") >= (s ? 0.08 - 1e-5 : 0)); // who takes an account has spent nothing on it
    assert_true(s || number(alone, "most") + number(list, "most") == 0);
  }
  json_decref(account);
  json_decref(group_work);
  cw_profiler_free(&profiler);
}

// Where nothing is measured schedules run all the same.
static void a_context_may_have_none(void **state) {
  const double cost[1] = {1};
  CwSchedule schedule = {.step = "step", .count = 1, .cost = cost, .run = task};
  assert_string_equal(cw_profiler_part(NULL, "part"), "");
  assert_int_equal(cw_schedule_run(&(CwContext){0}, &schedule, NULL, NULL, NULL), CW_OK);
  assert_int_equal(cw_schedule_run(NULL, &schedule, NULL, NULL, NULL), CW_OK);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(time_goes_to_tasks_and_parts),
                                     cmocka_unit_test(items_have_their_own_accounts),
                                     cmocka_unit_test(a_context_may_have_none)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
