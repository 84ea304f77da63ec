// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "geometry/standard_bore.h"
#include "tests/unit_test.h"

// From ISO 6708 and, outside it, R10 of ISO 3.
static void bores_of_the_standards(void **state) {
  static const double pairs[][2] = {{48, 50},     {50, 50},       {50.01, 65}, {412, 450}, {3999, 4000},
                                    {4001, 5000}, {5100, 6300},   {8.1, 10},   {8, 8},     {6.4, 8},
                                    {0.13, 0.16}, {1000.1, 1200}, {12, 12.5},  {12.6, 15}};
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    assert_near(cw_standard_bore(pairs[i][0] / 1e3), pairs[i][1] / 1e3, 1e-12);
}

// Every bore is its own next one, none is less than asked, and a step multiplies the area by at most 1.78.
static void no_size_without_a_bore(void **state) {
  for (double least = 1e-5; least < 100; least *= 1.0137) {
    const double bore = cw_standard_bore(least);
    assert_true(bore >= least * (1 - 1e-9) && bore <= least * sqrt(1.78) * (1 + 1e-9));
    assert_near(cw_standard_bore(bore), bore, 1e-12 * bore);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(bores_of_the_standards),
      cmocka_unit_test(no_size_without_a_bore),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
