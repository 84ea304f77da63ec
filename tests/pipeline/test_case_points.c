// SPDX-License-Identifier: AGPL-3.0-or-later
// The operating points of the characteristic curve: lists in the case file, and the flows, shares and names that
// follow.
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
                                     cmocka_unit_test(bad_points_are_refused_with_their_place)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
