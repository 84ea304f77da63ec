// SPDX-License-Identifier: AGPL-3.0-or-later
// Domains from bodies by name, pattern, number and point.
#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/solid_choice.h"
}

static CwCadBodies bodies() {
  CwCadBodies made;
  const char *names[][2] = {{"wheel", "wheel_1"}, {"casing", "casing_1"}, {"casing", "wheel[_]1"}};
  for (int i = 0; i < 3; i++)
    made.body.push_back({"pump.step", names[i][0], names[i][1], small_solid_of(small_box(10 * i, 0, 0, 9, 9, 9)), {}});
  return made;
}

// Two domains: the first by `word` or `point`, m, the second takes body 2.
static CwStatus choose(const char *word, const double *point, int domain[3]) {
  const CwCadBodies made = bodies();
  CwCadDomain domains[2] = {};
  char first[40] = "", second[] = "2", *words[] = {first}, *others[] = {second};
  double at[1][3];
  if (word) {
    snprintf(first, sizeof first, "%s", word);
    domains[0].solids = {1, words};
  } else {
    memcpy(at[0], point, sizeof at[0]);
    domains[0].inside = {1, at};
  }
  domains[1].solids = {1, others};
  strcpy(domains[0].name, "rotor");
  strcpy(domains[1].name, "stator");
  CwCaseCad cad = {};
  cad.domain = domains;
  cad.domain_count = 2;
  return cw_cad_solid_choice(&cad, &made, domain);
}

static void words_choose(void **) {
  int domain[3];
  for (const char *word : {"wheel", "wheel_1", "wh*l", "1"}) {
    if (choose(word, nullptr, domain)) fail_msg("%s: %s", word, cw_fail_message());
    assert_int_equal(domain[0], 0);
    assert_int_equal(domain[1], 1);
    assert_int_equal(domain[2], -1);
  }
}

// What is called so to the letter goes before what the pattern takes.
static void names_with_brackets_match_themselves(void **) {
  int domain[3];
  if (choose("wheel[_]1", nullptr, domain)) fail_msg("%s", cw_fail_message());
  assert_int_equal(domain[0], -1);
  assert_int_equal(domain[2], 0);
  if (choose("whee[l]", nullptr, domain)) fail_msg("%s", cw_fail_message());
  assert_int_equal(domain[0], 0);
}

static void points_choose(void **) {
  int domain[3];
  const double inside[] = {0.025, 0.004, 0.004}, outside[] = {0.5, 0, 0};
  assert_int_equal(choose(nullptr, inside, domain), CW_OK);
  assert_int_equal(domain[2], 0);
  assert_int_equal(choose(nullptr, outside, domain), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "cad.domains.rotor.inside_mm: (500, 0, 0) lies in 0 solids"));
}

static void wrong_words_are_told(void **) {
  static const struct {
    const char *word, *message;
  } wrong[] = {{"pump", "'pump' matches no solid of cad.files; allowed: 1 'wheel', 2 'casing', 3 'casing'"},
               {"casing", "'casing' matches 2 solids"},
               {"casing*", "cad.domains.stator: solid 2 'casing' belongs to cad.domains.rotor already"},
               {"4", "'4' matches no solid"}};
  int domain[3];
  for (const auto &of : wrong) {
    assert_int_equal(choose(of.word, nullptr, domain), CW_ERR_INPUT);
    if (!strstr(cw_fail_message(), of.message)) fail_msg("'%s' is not in '%s'", of.message, cw_fail_message());
  }
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(words_choose),
                                     cmocka_unit_test(names_with_brackets_match_themselves),
                                     cmocka_unit_test(points_choose), cmocka_unit_test(wrong_words_are_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
