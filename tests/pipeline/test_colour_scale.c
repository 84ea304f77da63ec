// SPDX-License-Identifier: AGPL-3.0-or-later
// The scale of colours: its ends, its brightness, its logarithm, its ticks.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/colour_scale.h"
#include "tests/unit_test.h"

static double brightness(uint32_t colour) {
  return 0.2126 * (colour >> 16) + 0.7152 * (colour >> 8 & 255) + 0.0722 * (colour & 255); // ITU-R BT.709
}

static void colours_grow_brighter(void **state) {
  assert_int_equal(cw_colour_scale(-1), cw_colour_scale(0));
  assert_int_equal(cw_colour_scale(2), cw_colour_scale(1));
  assert_int_equal(cw_colour_scale(0), 0x440154); // the ends of viridis
  assert_int_equal(cw_colour_scale(1), 0xfde725);
  for (int k = 1; k <= 50; k++)
    assert_true(brightness(cw_colour_scale(k / 50.0)) > brightness(cw_colour_scale((k - 1) / 50.0)));
}

static void shares_lie_between_the_ends(void **state) {
  const CwColourSpan even = {.least = -2, .most = 6}, decades = {.least = 0.1, .most = 1000, .logarithmic = 1};
  assert_true(fabs(cw_colour_share(&even, 0) - 0.25) < 1e-12);
  assert_true(cw_colour_share(&even, -5) == 0 && cw_colour_share(&even, 7) == 1);
  assert_true(fabs(cw_colour_share(&decades, 1) - 0.25) < 1e-12);
  assert_true(cw_colour_share(&decades, 0) == 0 && cw_colour_share(&decades, 1e4) == 1);
  assert_true(cw_colour_share(&(CwColourSpan){.least = 3, .most = 3}, 3) == 0);
}

static void bars_have_round_numbers(void **state) {
  char *text = NULL;
  size_t size = 0;
  FILE *page = open_memstream(&text, &size);
  cw_colour_bar(page, &(CwColourSpan){.least = 0, .most = 10}, "speed, m/s");
  cw_colour_bar(page, &(CwColourSpan){.least = 1, .most = 100, .logarithmic = 1}, "y<sup>+</sup>");
  fclose(page);
  assert_non_null(strstr(text, "speed, m/s"));
  assert_non_null(strstr(text, ">10</text>"));
  assert_non_null(strstr(text, ">20</text>"));
  assert_non_null(strstr(text, "#440"));
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(colours_grow_brighter),
      cmocka_unit_test(shares_lie_between_the_ends),
      cmocka_unit_test(bars_have_round_numbers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
