// SPDX-License-Identifier: AGPL-3.0-or-later
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

#include "mesher/ledger.h"
#include "mesher/schedule.h"
#include "pipeline/log.h"

static volatile double sink;

static void work(double seconds) {
  for (double end = cw_processor_seconds() + seconds; cw_processor_seconds() < end;) sink += 1;
}

static CwStatus task(void *context, int32_t index, void **bytes, int64_t *size) {
  (void)context, (void)bytes, (void)size;
  work(index == 1 ? 0.06 : 0.02);
  return CW_OK;
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
  (void)state;
  double begun = cw_processor_seconds(), sum = 0;
  json_t *parts, *tasks, *part;
  cw_ledger_part("before");
  const double cost[3] = {1, 3, 2};
  CwSchedule schedule = {.step = "step", .count = 3, .cost = cost, .run = task};
  assert_int_equal(cw_schedule_run(&schedule, NULL, NULL, NULL), CW_OK);
  work(0.03); // schedules leave the part as it was
  assert_string_equal(cw_ledger_part("after"), "before");
  work(0.01);
  assert_int_equal(cw_ledger_json(&parts, &tasks), CW_OK);
  double all = cw_processor_seconds() - begun;
  assert_int_equal(json_array_size(tasks), 1);
  const json_t *step = find(tasks, "step", "step"), *seconds = json_object_get(step, "task_seconds");
  assert_int_equal(json_array_size(seconds), 3);
  assert_true(json_number_value(json_array_get(seconds, 1)) >= 0.06);
  assert_float_equal(json_number_value(json_array_get(json_object_get(step, "task_cost"), 2)), 2, 0);
  assert_true(number(step, "most") >= 0.1 - 1e-5);
  assert_true(number(find(parts, "part", "before"), "seconds") >= 0.03 - 1e-5);
  assert_true(number(find(parts, "part", "after"), "seconds") >= 0.01 - 1e-5);
  size_t i;
  json_array_foreach(parts, i, part) {
    if (strcmp(json_string_value(json_object_get(part, "part")), "start")) sum += number(part, "seconds");
  }
  assert_true(sum + number(step, "most") <= all + 1e-4); // nothing counts twice
  json_decref(parts);
  json_decref(tasks);
  cw_ledger_free();
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(time_goes_to_tasks_and_parts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
