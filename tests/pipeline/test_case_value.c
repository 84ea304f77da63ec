// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_value.h"

#include <inttypes.h>
#include <math.h>
#include <regex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

// What is a number is a regular language: of random words of its letters those that belong to it are taken, and no
// others.
static void numbers_are_those_of_the_grammar(void **state) {
  static const char letters[] = "+-.0123456789012eE, xn";
  regex_t grammar;
  uint64_t seed = 21;
  int taken = 0;
  assert_int_equal(
      regcomp(&grammar, "^[+-]?((0|[1-9][0-9]*)([.][0-9]*)?|[.][0-9]+)([eE][+-]?[0-9]+)?$", REG_EXTENDED | REG_NOSUB),
      0);
  for (int i = 0; i < 200000; i++) {
    char text[10] = "";
    const int length = 1 + draw_below(&seed, 8);
    for (int k = 0; k < length; k++) text[k] = letters[draw_below(&seed, sizeof letters - 1)];
    double number = NAN;
    const char *wrong = cw_number_text_read(text, &number);
    const int fine = !regexec(&grammar, text, 0, NULL, 0) && isfinite(strtod(text, NULL));
    if (fine != !wrong) fail_msg("%s: %s", text, wrong ? wrong : "taken");
    if (!wrong) assert_true(number == strtod(text, NULL));
    taken += !wrong;
  }
  assert_true(taken > 10000);
  regfree(&grammar);
}

static void what_is_wrong_is_told(void **state) {
  static const char *const wrong[][2] = {{"1,5", "has a comma (decimals follow a point)"},
                                         {"5 mm", "has text behind the number (the unit stands in the key)"},
                                         {"-.inf", "is not a finite number"},
                                         {"NaN", "is not a finite number"},
                                         {"1e999", "is not a finite number"},
                                         {"0x10", "is not a decimal number"},
                                         {"-0b1", "is not a decimal number"},
                                         {"007", "has a leading zero"},
                                         {"six", "is not a number"},
                                         {"", "is not a number"}};
  double number;
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
    assert_string_equal(cw_number_text_read(wrong[i][0], &number), wrong[i][1]);
}

// Counts written with decimals and a suffix, by the decimal point's place among their digits: whole where all behind it
// are zeros.
static void counts_are_whole(void **state) {
  static const struct {
    const char *text;
    int power;
  } suffix[] = {{"", 0}, {"k", 3}, {"K", 3}, {"M", 6}, {"G", 9}};
  uint64_t seed = 17;
  int whole[2] = {0};
  for (int i = 0; i < 100000; i++) {
    char text[60], digits[40] = "";
    const int s = draw_below(&seed, 5), places = draw_below(&seed, 11);
    const int64_t before = draw_below(&seed, 1000);
    int64_t wanted = before, beyond = 0;
    for (int k = 0; k < places; k++) digits[k] = (char)('0' + (draw(&seed) < 0.6 ? 0 : draw_below(&seed, 10)));
    for (int k = 0; k < suffix[s].power; k++) wanted = 10 * wanted + (k < places ? digits[k] - '0' : 0);
    for (int k = suffix[s].power; k < places; k++) beyond += digits[k] - '0';
    snprintf(text, sizeof text, "%" PRId64 "%s%s%s", before, places ? "." : "", digits, suffix[s].text);
    double count = NAN;
    const char *wrong = cw_count_text_read(text, &count);
    if (!wrong != !beyond) fail_msg("%s: %s", text, wrong ? wrong : "taken");
    if (!wrong) assert_near(count, (double)wanted, 0);
    whole[!wrong]++;
  }
  assert_true(whole[0] > 1000 && whole[1] > 1000);
  static const char *const none[] = {"", "k", "-5", "+5", ".5M", "5T", "5 k", "5kk", "1e400", "0x5", "05"};
  double count;
  for (size_t i = 0; i < sizeof none / sizeof *none; i++)
    assert_string_equal(cw_count_text_read(none[i], &count), "is not a whole number");
}

// Whatever is shown has no control character and ends between two characters of UTF-8.
static void texts_are_shown_safely(void **state) {
  static const char *const character[] = {"a", " ", "\t", "\n", "\177", "\303\244", "\342\202\254", "\360\235\204\236"};
  uint64_t seed = 5;
  char shown[CW_SHOWN_SIZE];
  for (int i = 0; i < 5000; i++) {
    char text[300] = "", plain[300] = "";
    size_t fits = 0;
    for (int k = draw_below(&seed, 60); k >= 0; k--) {
      const int c = draw_below(&seed, 8);
      strcat(text, character[c]);
      strcat(plain, c > 1 && c < 5 ? " " : character[c]);
      if (strlen(text) <= 48) fits = strlen(text);
    }
    cw_show(text, shown);
    const int cut = strlen(text) > 48;
    assert_memory_equal(shown, plain, cut ? fits : strlen(plain));
    assert_string_equal(shown + (cut ? fits : strlen(plain)), cut ? "..." : "");
  }
  cw_show("", shown);
  assert_string_equal(shown, "(nothing)");
}

static int reads(const CwCaseKey *key, double value, CwCase *table) {
  char text[40], wrong[CW_WRONG_SIZE];
  snprintf(text, sizeof text, "%.17g", value);
  return cw_case_value_read(key, cw_unit_find(key->unit), text, 1, table, wrong);
}

// Of every key with a range both ends are taken, and nothing beyond.
static void ranges_hold_their_ends(void **state) {
  int seen = 0;
  for (size_t i = 0; i < cw_case_key_count; i++) {
    const CwCaseKey *key = &cw_case_keys[i];
    const int whole = key->type == CW_KEY_INT || key->type == CW_KEY_INT64;
    if (key->type != CW_KEY_REAL && !whole) continue;
    const double below = whole ? key->least - 1 : nextafter(key->least, -INFINITY);
    const double above = whole ? key->most + 1 : nextafter(key->most, INFINITY);
    CwCase table = {0};
    assert_true(reads(key, key->least, &table));
    assert_near(cw_case_key_value(key, &table), key->least, 1e-14 * fabs(key->least));
    assert_true(reads(key, key->most, &table));
    assert_near(cw_case_key_value(key, &table), key->most, 1e-14 * fabs(key->most));
    if (whole && key->least == 0) continue; // a count below has another fault
    assert_false(reads(key, below, &table));
    assert_false(reads(key, above, &table));
    seen++;
  }
  assert_true(seen > 50);
}

// 5 in are 127 mm; 0.1 in, 2.54 mm, are less than an impeller may have.
static void ranges_hold_in_other_units(void **state) {
  const CwUnit *unit;
  const int at = cw_case_key_find_in("impeller", "outlet_diameter_in", &unit);
  CwCase table = {0};
  char wrong[CW_WRONG_SIZE];
  assert_true(at >= 0);
  assert_int_equal(cw_case_value_read(&cw_case_keys[at], unit, "5", 1, &table, wrong), 1);
  assert_near(table.impeller.outlet_diameter, 0.127, 1e-15);
  assert_int_equal(cw_case_value_read(&cw_case_keys[at], unit, "0.1", 1, &table, wrong), 0);
  assert_string_equal(wrong, "0.1 is out of range (it is 2.54 mm); allowed: 10 to 10000 mm");
  assert_int_equal(cw_case_value_read(&cw_case_keys[at], unit, "5", 0, &table, wrong), 0);
  assert_non_null(strstr(wrong, "it stands in quotes"));
}

static int leaves_out_one(const char *longer, const char *text) {
  while (*text && *longer == *text) longer++, text++;
  return *longer && !strcmp(longer + 1, text);
}

// Where a letter of a key is left out, the key that is named has it.
static void a_shortened_key_is_found(void **state) {
  int seen = 0;
  for (size_t i = 0; i < cw_case_key_count; i++) {
    const CwCaseKey *key = &cw_case_keys[i];
    for (size_t out = 0; key->section[0] && out < strlen(key->key); out++) {
      static const char told[] = "unknown key; allowed: the keys of docs/case-reference.md, the nearest is ";
      char name[100], wrong[CW_WRONG_SIZE];
      snprintf(name, sizeof name, "%.*s%s", (int)out, key->key, key->key + out + 1);
      cw_case_key_unknown(key->section, name, NULL, wrong);
      if (strncmp(wrong, told, strlen(told))) continue; // a key of its own, or without its unit
      const char *found = wrong + strlen(told);
      assert_true(cw_case_key_find(key->section, found) >= 0);
      if (!leaves_out_one(found, name)) fail_msg("%s: %s", name, wrong);
      seen++;
    }
  }
  assert_true(seen > 500);
}

static void other_places_and_units_are_told(void **state) {
  static const struct {
    const char *section, *name, *text, *wrong;
  } wanted[] = {
      {"mesh", "layer_count", NULL, "unknown key here; allowed: the key layer_count in section walls"},
      {"", "cells", NULL, "unknown key here; allowed: the key cells in section mesh"},
      {"impeller", "wrap_angle", "71", "the key lacks its unit, degrees; allowed: wrap_angle_deg, 20 to 300 degrees"},
      {"operating_point", "head_ft", "30",
       "wrong unit in the key, ft instead of m; allowed: head_m, 0.01 to 5000 m (30 ft is 9.144 m)"},
      {"operating_point", "head_bar", "1", "wrong unit in the key, bar instead of m; allowed: head_m, 0.01 to 5000 m"},
      {"impeller", "blade_count_mm", "6",
       "wrong unit in the key, mm; allowed: blade_count without unit, a whole number from 2 to 12"},
      {"mesh", "", NULL, "the key is empty; allowed: the keys of docs/case-reference.md"}};
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    char wrong[CW_WRONG_SIZE];
    cw_case_key_unknown(wanted[i].section, wanted[i].name, wanted[i].text, wrong);
    assert_string_equal(wrong, wanted[i].wrong);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(numbers_are_those_of_the_grammar),
      cmocka_unit_test(what_is_wrong_is_told),
      cmocka_unit_test(counts_are_whole),
      cmocka_unit_test(texts_are_shown_safely),
      cmocka_unit_test(ranges_hold_their_ends),
      cmocka_unit_test(ranges_hold_in_other_units),
      cmocka_unit_test(a_shortened_key_is_found),
      cmocka_unit_test(other_places_and_units_are_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
