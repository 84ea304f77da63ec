// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

#define GAP "\342\200\257"
#define MINUS "\342\210\222"

static void numbers_read_well(void **state) {
  char text[CW_FORMAT_SIZE];
  assert_string_equal(cw_format_count(0, text), "0");
  assert_string_equal(cw_format_count(9999, text), "9999");
  assert_string_equal(cw_format_count(145000000, text), "145" GAP "000" GAP "000");
  assert_string_equal(cw_format_count(-12345, text), MINUS "12" GAP "345");
  assert_string_equal(cw_format_number(12.8692, 4, text), "12.87");
  assert_string_equal(cw_format_number(74, 5, text), "74");
  assert_string_equal(cw_format_number(0.00218, 2, text), "0.0022");
  assert_string_equal(cw_format_number(-0.5, 3, text), MINUS "0.5");
  assert_string_equal(cw_format_number(123456.7, 3, text),
                      "123" GAP "457"); // no digit before the point is lost
  assert_string_equal(cw_format_number(1.004e-6, 5, text), "1.004" GAP "\303\227" GAP "10\342\201\273\342\201\266");
  assert_string_equal(cw_format_number(1e14, 3, text), "100" GAP "000" GAP "000" GAP "000" GAP "000");
  assert_string_equal(cw_format_number(1e15, 3, text), "1" GAP "\303\227" GAP "10\302\271\342\201\265");
  assert_string_equal(cw_format_number(1e-4, 3, text), "0.0001");
  assert_string_equal(cw_format_number(9.9996, 4, text), "10");
  assert_string_equal(cw_format_number(NAN, 4, text), "\342\200\223");
  assert_string_equal(cw_format_si(301551, 3, text), "302" GAP "k");
  assert_string_equal(cw_format_si(999700, 3, text), "1" GAP "M");
  assert_string_equal(cw_format_si(42, 3, text), "42");
  assert_string_equal(cw_format_si(2.2e-4, 3, text), "220" GAP "\302\265");
  assert_string_equal(cw_format_seconds(0.0123, text), "0.012 s");
  assert_string_equal(cw_format_seconds(58.42, text), "58.4 s");
  assert_string_equal(cw_format_seconds(245, text), "4 min 05 s");
  assert_string_equal(cw_format_seconds(11220, text), "3 h 07 min");
  assert_string_equal(cw_format_bytes(107495424, text), "107 MB");
  assert_string_equal(cw_format_bytes(1e9, text), "1 GB");
  assert_string_equal(cw_format_bytes(999.4e6, text), "999 MB");
  assert_string_equal(cw_format_percent(1, text), "100 %");
  assert_string_equal(cw_format_percent(0.999999, text), "99.99 %"); // not all
  assert_string_equal(cw_format_percent(0.316, text), "31.6 %");
  assert_string_equal(cw_format_percent(0, text), "0 %");
  assert_string_equal(cw_format_percent(NAN, text), "\342\200\223");
}

// The number that a text says, with the end of it: groups, minus and raised digits undone.
static double value_of(const char *text, const char **end) {
  static const char *const raised[] = {"\342\201\260", "\302\271",     "\302\262",     "\302\263",     "\342\201\264",
                                       "\342\201\265", "\342\201\266", "\342\201\267", "\342\201\270", "\342\201\271"};
  char plain[2 * CW_FORMAT_SIZE] = "";
  size_t used = 0;
  while (*text) {
    int digit = 0;
    while (digit < 10 && strncmp(text, raised[digit], strlen(raised[digit]))) digit++;
    if (digit < 10) {
      plain[used++] = (char)('0' + digit);
      text += strlen(raised[digit]);
    } else if (!strncmp(text, MINUS, 3) || !strncmp(text, "\342\201\273", 3)) {
      plain[used++] = '-';
      text += 3;
    } else if (!strncmp(text, GAP "\303\227" GAP "10", 10)) {
      plain[used++] = 'e';
      text += 10;
    } else if (!strncmp(text, GAP, 3) && text[3] >= '0' && text[3] <= '9') {
      text += 3;
    } else if (strchr("0123456789.", *text)) {
      plain[used++] = *text++;
    } else {
      break;
    }
  }
  *end = text;
  return atof(plain);
}

static double draw_number(uint64_t *seed, double least, double most) {
  return (draw(seed) < 0.5 ? -1 : 1) * pow(10, least + (most - least) * draw(seed));
}

// What is read is what was written, but for half of the last digit that was asked; of digits before the point all are.
static void texts_say_the_number(void **state) {
  uint64_t seed = 2;
  const char *end;
  for (int i = 0; i < 20000; i++) {
    char text[CW_FORMAT_SIZE];
    const int digits = 2 + i % 5;
    const double value = draw_number(&seed, -12, 18), read = value_of(cw_format_number(value, digits, text), &end);
    const double half = 0.5000001 * pow(10, floor(log10(fabs(value)) + 1e-9) - digits + 1);
    assert_string_equal(end, "");
    assert_near(read, value, half);
    if (fabs(value) >= 1 && fabs(value) < 9e14) assert_near(read, value, 0.5000001);
    assert_null(strstr(text, ".0" GAP));
    const int64_t count = (int64_t)draw_number(&seed, 0, 17);
    assert_near(value_of(cw_format_count(count, text), &end), (double)count, 0);
    assert_string_equal(end, "");
  }
}

// A prefix leaves one to three digits before the point.
static void prefixes_leave_three_digits(void **state) {
  static const char *const prefix[] = {"n", "\302\265", "m", "", "k", "M", "G"};
  uint64_t seed = 6;
  for (int i = 0; i < 5000; i++) {
    char text[CW_FORMAT_SIZE];
    const char *end;
    const double value = draw_number(&seed, -8.999, 11.999), read = value_of(cw_format_si(value, 3, text), &end);
    int power = 0;
    if (!strncmp(end, GAP, 3)) end += 3;
    while (power < 7 && strcmp(end, prefix[power])) power++;
    assert_true(power < 7);
    assert_true(fabs(read) >= 1 && fabs(read) < 1000);
    assert_near(read * pow(1e3, power - 3) / value, 1, 0.00500001);
  }
}

// Times are told to the second below a hundred minutes, then to the minute, and never as 60 of what is the smaller
// unit.
static void times_say_how_long(void **state) {
  for (double seconds = 0.5; seconds < 1e6; seconds *= 1.0003) {
    char text[CW_FORMAT_SIZE];
    long large, small;
    double read;
    cw_format_seconds(seconds, text);
    if (sscanf(text, "%ld min %ld s", &large, &small) == 2) {
      assert_true(small < 60 && large < 100);
      assert_near(60.0 * (double)large + (double)small, seconds, 0.5);
    } else if (sscanf(text, "%ld h %ld min", &large, &small) == 2) {
      assert_true(small < 60);
      assert_near(3600.0 * (double)large + 60.0 * (double)small, seconds, 30);
    } else {
      assert_int_equal(sscanf(text, "%lf s", &read), 1);
      assert_near(read / seconds, 1, 0.00500001);
    }
  }
}

// A part is never told as nothing or all, and a greater one as no less.
static void shares_are_told_as_parts(void **state) {
  double before = 0;
  for (double share = 1e-9; share < 1; share = share < 0.5 ? 1.01 * share : 1 - (1 - share) / 1.01 + 1e-12) {
    char text[CW_FORMAT_SIZE];
    const double read = atof(cw_format_percent(share, text));
    assert_true(read > 0 && read < 100);
    assert_true(read >= before);
    assert_near(read, 100 * share, share < 0.01 || share > 0.995 ? 0.0100001 : 0.0500001);
    before = read;
  }
  char text[CW_FORMAT_SIZE];
  assert_string_equal(cw_format_percent(nextafter(1, 0), text), "99.99 %");
}

static void bytes_leave_three_digits(void **state) {
  static const char *const unit[] = {"B", "kB", "MB", "GB", "TB"};
  for (double bytes = 1; bytes < 9e14; bytes = floor(1 + bytes * 1.01)) {
    char text[CW_FORMAT_SIZE];
    const char *end;
    const double read = value_of(cw_format_bytes(bytes, text), &end);
    int power = 0;
    while (power < 5 && strcmp(end + 1, unit[power])) power++;
    assert_true(power < 5 && read < 1000);
    assert_near(read * pow(1e3, power) / bytes, 1, 0.00500001);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(numbers_read_well),           cmocka_unit_test(texts_say_the_number),
      cmocka_unit_test(prefixes_leave_three_digits), cmocka_unit_test(times_say_how_long),
      cmocka_unit_test(shares_are_told_as_parts),    cmocka_unit_test(bytes_leave_three_digits),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
