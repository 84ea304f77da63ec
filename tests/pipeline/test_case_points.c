// SPDX-License-Identifier: AGPL-3.0-or-later
// The operating points of the characteristic curve: lists in the case file, and the flows, shares and names that
// follow.
#include <stdlib.h>
#include <string.h>

#include "given_case.h"
#include "pipeline/case_points.h"
#include "tests/unit_test.h"

// Reads a good case of 25 m3/h with these lines behind it.
static CwStatus read_with(const char *lines, CwCase *table) {
  return read_given("name: test\noperating_point:\n  flow_rate_m3_per_h: 25\n  head_m: 10\n  speed_rpm: 1450\n", lines,
                    table);
}

static void expect_flows(const char *lines, int count, const double *m3_per_h, const char *const *names) {
  CwCase table;
  CwCasePoint points[CW_LIST_MOST];
  if (read_with(lines, &table) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_int_equal(cw_case_points(&table, points), count);
  for (int k = 0; k < count; ++k) {
    assert_true(fabs(3600 * points[k].flow - m3_per_h[k]) < 1e-9);
    assert_true(fabs(points[k].share - m3_per_h[k] / 25) < 1e-12);
    assert_string_equal(points[k].name, names[k]);
  }
}

static void shares_and_flow_rates_give_flows(void **state) {
  expect_flows("", 4, (double[]){15, 20, 25, 30}, (const char *[]){"q0600", "q0800", "q1000", "q1200"});
  expect_flows("operating_points:\n  flow_shares: [0.5, 1, 1.25]", 3, (double[]){12.5, 25, 31.25},
               (const char *[]){"q0500", "q1000", "q1250"});
  expect_flows("operating_points:\n  flow_shares:\n    - 0.9\n    - 1.1", 2, (double[]){22.5, 27.5},
               (const char *[]){"q0900", "q1100"});
  expect_flows("operating_points:\n  flow_shares: 0.8", 1, (double[]){20}, (const char *[]){"q0800"});
  // In any unit of the quantity: 5 and 7.5 l/s are 18 and 27 m3/h.
  expect_flows("operating_points:\n  flow_rates_l_per_s: [5, 7.5]", 2, (double[]){18, 27},
               (const char *[]){"q0720", "q1080"});
}

// Wherever a thousandth begins and whatever rounding does to it, and the operating point keeps its name.
static void points_a_thousandth_apart_have_names_of_their_own(void **state) {
  CwCase table;
  CwCasePoint points[CW_LIST_MOST];
  expect_flows("operating_points:\n  flow_shares: [0.7935, 0.7945]", 2, (double[]){19.8375, 19.8625},
               (const char *[]){"q0794", "q0795"});
  expect_flows("operating_points:\n  flow_shares: [0.9989, 0.9999, 1.001]", 3, (double[]){24.9725, 24.9975, 25.025},
               (const char *[]){"q0999", "q1000", "q1001"});
  assert_int_equal(read_with("", &table), CW_OK);
  for (int i = 10; i < 2900; ++i) {
    table.operating_points.flow_shares.count = CW_LIST_MOST;
    for (int k = 0; k < CW_LIST_MOST; ++k)
      table.operating_points.flow_shares.value[k] = (i + k + 0.5 + 1e-13 * ((i * 7 + k * 5) % 3 - 1)) / 1000;
    assert_int_equal(cw_case_points(&table, points), CW_LIST_MOST);
    for (int k = 1; k < CW_LIST_MOST; ++k) {
      assert_true(strcmp(points[k - 1].name, points[k].name) < 0);
      assert_true(fabs(atof(points[k].name + 1) - 1000 * points[k].share) < 0.5 + 1e-9);
    }
  }
}

static void bad_points_are_refused_with_their_place(void **state) {
#define ALLOWED "a list [..., ...] of 1 to 12 ascending values, each 0.01 to 3"
  static const struct {
    const char *lines, *message;
  } bad[] = {
      {"operating_points:\n  flow_shares: [0.5, 0]",
       ":7:22: operating_points.flow_shares: 0 is out of range; allowed: " ALLOWED},
      {"operating_points:\n  flow_shares: [0.5, half]",
       ":7:22: operating_points.flow_shares: half is not a number; allowed: " ALLOWED},
      {"operating_points:\n  flow_shares: []",
       ":7:17: operating_points.flow_shares: the list has no value; allowed: " ALLOWED},
      {"operating_points:\n  flow_shares: [1, [2]]",
       ":7:20: operating_points.flow_shares: it is a list, not one value; allowed: " ALLOWED},
      {"operating_points:\n  flow_shares: {a: 1}",
       ":7:16: operating_points.flow_shares: it is a mapping, not one value; allowed: " ALLOWED},
      {"operating_points:\n  flow_shares: [.1, .2, .3, .4, .5, .6, .7, .8, .9, 1, 1.1, 1.2, 1.3]",
       ":7:66: operating_points.flow_shares: the list has too many values; allowed: " ALLOWED},
      {"operating_points:\n  flow_shares: [1, 0.5]",
       ":7:16: operating_points.flow_shares: value 2 is not above the one before it by a thousandth of the operating "
       "point's flow rate; allowed: ascending values"},
      {"operating_points:\n  flow_shares: [1]\n  flow_rates_m3_per_h: [25]",
       ":8:24: operating_points.flow_rates_m3_per_h: contradicts operating_points.flow_shares; allowed: one of them"},
      {"operating_points:\n  flow_rates_m3_per_h: [5, 250]",
       ":7:24: operating_points.flow_rates_m3_per_h: value 2 is 10 times the operating point's flow rate; allowed: "
       "0.001 to 10 times"},
  };
  int wrong = 0;
  for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
    CwCase table;
    CwStatus status = read_with(bad[i].lines, &table);
    const char *said = strchr(cw_fail_message(), ':'); // behind the path
    if (status == CW_ERR_INPUT && said && !strcmp(said, bad[i].message)) continue;
    print_error("%s\nexpected %s\ngot %d %s\n", bad[i].lines, bad[i].message, status, cw_fail_message());
    ++wrong;
  }
  assert_int_equal(wrong, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(shares_and_flow_rates_give_flows),
                                     cmocka_unit_test(points_a_thousandth_apart_have_names_of_their_own),
                                     cmocka_unit_test(bad_points_are_refused_with_their_place)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
