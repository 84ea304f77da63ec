// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/remedy.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "geometry/design_value.h"
#include "pipeline/case_check.h"
#include "pipeline/case_schema.h"

enum { KEYS_MOST = 100, TRIALS_MOST = 60, PATH_SIZE = CW_KEY_PATH_SIZE };
enum { OPEN_MOST = 6 }; // with both directions of each step and the speed's they stay within the trials

static const double SAME = 1e-3;       // a value of the case and the design's, which went through other units
static const double HEAD_SLACK = 0.03; // of the head: a value of an open key must not give it up

// What an open key is changed by, the least first.
static const double open_steps[] = {0.95, 1.05, 0.9, 1.1, 0.8, 1.25, 0.65, 1.5};

typedef struct {
  CwRemedyTrial trial;
  int trials;
} Search;

// Whether the key is one of the pump's shape, no part of the duty point or the fluid.
static int is_of_shape(const CwCaseKey *key) {
  return !strcmp(key->section, "impeller") || !strcmp(key->section, "volute");
}

static int is_given(const CwCaseKey *key, const CwCase *table) {
  const double value = cw_case_key_value(key, table);
  return !isnan(value) && value != key->fallback;
}

// The keys in the order in which they are tried: those that the message names first.
static int list_keys(const CwCase *table, const char *message, int keys[KEYS_MOST]) {
  int count = 0;
  for (int named = 1; named >= 0; named--)
    for (size_t i = 0; i < cw_case_key_count && count < KEYS_MOST; i++) {
      const CwCaseKey *key = &cw_case_keys[i];
      if (is_of_shape(key) && is_given(key, table) && (strstr(message, key->key) != NULL) == named)
        keys[count++] = (int)i;
    }
  return count;
}

static int works(Search *search, const CwCase *table, CwDesign *design) {
  static const CwCasePlace places[512];
  int fine = search->trials++ < TRIALS_MOST && cw_case_check("", table, places) == CW_OK;
  fine = fine && search->trial(table, design) == CW_OK;
  cw_fail_clear();
  return fine;
}

static double in_unit_of(const CwCaseKey *key, double si) {
  size_t stem;
  const CwUnit *unit = cw_unit_of_key(key->key, &stem);
  return unit ? si * unit->denominator / unit->numerator : si;
}

// What the design made of a key, given or left out, in the key's unit; NAN: no quantity of the same name.
static double computed_value(const CwCaseKey *key, const CwDesign *design) {
  static const char *const other_names[][2] = {{"impeller.hub_nut_length_mm", "nut_length"},
                                               {"impeller.lean_deg", "lean_angle"},
                                               {"volute.outlet_diameter_mm", "discharge_diameter"}};
  char path[PATH_SIZE], name[PATH_SIZE];
  size_t stem;
  cw_case_key_path(key, path);
  if (key->type == CW_KEY_INT) return strcmp(key->key, "blade_count") ? NAN : design->blade_count;
  if (key->type != CW_KEY_REAL || (key->presence != CW_KEY_COMPUTED && key->presence != CW_KEY_DEFAULT)) return NAN;
  if (!strcmp(key->key, "tongue_gap_mm")) return in_unit_of(key, design->tongue_tip_radius - design->base_diameter / 2);
  cw_unit_of_key(key->key, &stem);
  snprintf(name, sizeof name, "%.*s", (int)stem, key->key);
  for (size_t i = 0; i < sizeof other_names / sizeof *other_names; i++)
    if (!strcmp(other_names[i][0], path)) snprintf(name, sizeof name, "%s", other_names[i][1]);
  for (int i = 0; i < CW_DESIGN_COUNT; i++) {
    const CwDesignValue value = cw_hydraulic_design_value(design, i);
    if (strncmp(value.key, name, strlen(name))) continue;
    const char *suffix = value.key + strlen(name);
    const int degrees = !strcmp(suffix, "_deg");
    if (*suffix && !degrees && strcmp(suffix, "_m") && strcmp(suffix, "_m2")) continue;
    return in_unit_of(key, degrees ? value.stored * M_PI / 180 : value.stored);
  }
  return NAN;
}

// Three digits, of a count none behind the point.
static double rounded(const CwCaseKey *key, double value) {
  if (key->type == CW_KEY_INT) return round(value);
  char text[40];
  double number = value;
  snprintf(text, sizeof text, "%.3g", value);
  sscanf(text, "%lf", &number);
  return fmin(key->most, fmax(key->least, number));
}

// Whether the case with this value of the key works, and the design takes the value, which gives way to no other.
static int value_works(Search *search, const CwCase *table, const CwCaseKey *key, double value, CwDesign *design) {
  CwCase changed = *table;
  cw_case_key_set(key, value, &changed);
  return works(search, &changed, design) && !(fabs(computed_value(key, design) - value) > SAME * fabs(value));
}

// The value nearest to the given one that works, of some between it and the computed one. Returns whether there is one.
static int nearest_value(Search *search, const CwCase *table, const CwCaseKey *key, double computed, double *found) {
  static const double shares[] = {0.1, 0.25, 0.5, 0.75, 1};
  const double given = cw_case_key_value(key, table);
  double before = given;
  CwDesign design;
  if (isnan(computed)) return 0;
  for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
    *found = rounded(key, given + shares[i] * (computed - given));
    if (*found == before) continue;
    before = *found;
    if (value_works(search, table, key, *found, &design)) return 1;
  }
  return 0;
}

static int one_key(Search *search, const CwCase *table, const int *keys, int count, char *text, size_t size) {
  CwDesign design;
  for (int i = 0; i < count; i++) {
    const CwCaseKey *key = &cw_case_keys[keys[i]];
    CwCase without = *table;
    char path[PATH_SIZE];
    double value;
    cw_case_key_set(key, key->fallback, &without);
    if (!works(search, &without, &design)) continue;
    cw_case_key_path(key, path);
    if (key->type == CW_KEY_CHOICE)
      snprintf(text, size, "%s: %s works", path, key->choices[(int)key->fallback]);
    else if (nearest_value(search, table, key, computed_value(key, &design), &value))
      snprintf(text, size, "%s: %.6g works", path, value);
    else if (!isnan(computed_value(key, &design)))
      snprintf(text, size, "it works without %s (then %.4g)", path, computed_value(key, &design));
    else
      snprintf(text, size, "it works without %s", path);
    return 1;
  }
  return 0;
}

static int several_keys(Search *search, const CwCase *table, const int *keys, int count, char *text, size_t size) {
  CwCase without = *table;
  CwDesign design;
  int out = 0, kept[KEYS_MOST] = {0};
  while (out < count) {
    const CwCaseKey *key = &cw_case_keys[keys[out++]];
    cw_case_key_set(key, key->fallback, &without);
    if (out > 1 && works(search, &without, &design)) break;
    if (out == count) return 0;
  }
  for (int i = 0; i < out - 1; i++) {
    const CwCaseKey *key = &cw_case_keys[keys[i]];
    CwCase with = without;
    cw_case_key_set(key, cw_case_key_value(key, table), &with);
    kept[i] = works(search, &with, &design);
    if (kept[i]) without = with;
  }
  if (!works(search, &without, &design)) return 0; // the design of what is left, for its values
  size_t used = (size_t)snprintf(text, size, "it works without");
  for (int i = 0, named = 0; i < out; i++) {
    const CwCaseKey *key = &cw_case_keys[keys[i]];
    char path[PATH_SIZE], then[40] = "";
    if (kept[i] || used >= size) continue;
    const double value = computed_value(key, &design);
    if (!isnan(value)) snprintf(then, sizeof then, " (then %.4g)", value);
    cw_case_key_path(key, path);
    used += (size_t)snprintf(text + used, size - used, "%s %s%s", named++ ? " and" : "", path, then);
  }
  return 1;
}

// The keys to try that the case leaves open and the design has a value of: those that the message names, then the main
// dimensions. Returns how many.
static int list_open_keys(const CwCase *table, const CwDesign *design, const char *message,
                          const CwCaseKey *keys[OPEN_MOST]) {
  static const char *const main_dimensions[] = {"impeller.outlet_diameter_mm", "volute.inlet_width_mm",
                                                "impeller.blade_count", "impeller.inlet_diameter_mm"};
  enum { MAIN_COUNT = sizeof main_dimensions / sizeof *main_dimensions };
  int count = 0;
  for (int rank = 0; rank <= MAIN_COUNT; rank++) // 0: named
    for (size_t i = 0; i < cw_case_key_count && count < OPEN_MOST; i++) {
      const CwCaseKey *key = &cw_case_keys[i];
      char path[PATH_SIZE];
      int listed = 0;
      cw_case_key_path(key, path);
      if (rank > 0 ? strcmp(path, main_dimensions[rank - 1]) != 0 : !strstr(message, key->key)) continue;
      if (!is_of_shape(key) || is_given(key, table) || !(computed_value(key, design) > 0)) continue;
      for (int k = 0; k < count; k++) listed = listed || keys[k] == key;
      if (!listed) keys[count++] = key;
    }
  return count;
}

// Changes one of the keys, from `base` in its unit on, by the least step that works and keeps the head.
static int step_by_step(Search *search, const CwCase *table, const CwCaseKey *const *keys, const double *base,
                        int count, char *text, size_t size) {
  for (size_t i = 0; i < sizeof open_steps / sizeof *open_steps; i++)
    for (int k = 0; k < count; k++) {
      CwDesign design;
      char path[PATH_SIZE];
      const double value = rounded(keys[k], base[k] * open_steps[i]);
      if (value == rounded(keys[k], base[k] * (i < 2 ? 1 : open_steps[i - 2]))) continue;
      if (!value_works(search, table, keys[k], value, &design)) continue;
      if (fabs(design.head_residual) > HEAD_SLACK * design.head) continue;
      cw_case_key_path(keys[k], path);
      snprintf(text, size, "%s: %.6g works", path, value);
      return 1;
    }
  return 0;
}

// Keys that the case leaves open, around the values that the refused design has chosen; at last the speed.
static int open_key(Search *search, const CwCase *table, const char *message, char *text, size_t size) {
  const CwCaseKey *keys[OPEN_MOST], *speed = &cw_case_keys[cw_case_key_find("operating_point", "speed_rpm")];
  double base[OPEN_MOST];
  const double speed_given = cw_case_key_value(speed, table);
  CwDesign refused = {0};
  works(search, table, &refused);
  const int count = list_open_keys(table, &refused, message, keys);
  for (int k = 0; k < count; k++) base[k] = computed_value(keys[k], &refused);
  return step_by_step(search, table, keys, base, count, text, size) ||
         step_by_step(search, table, &speed, &speed_given, 1, text, size);
}

int cw_remedy_find(const CwCase *table, const char *message, CwRemedyTrial trial, char *text, size_t size) {
  Search search = {.trial = trial};
  int keys[KEYS_MOST];
  const int count = list_keys(table, message, keys);
  return one_key(&search, table, keys, count, text, size) || several_keys(&search, table, keys, count, text, size) ||
         open_key(&search, table, message, text, size);
}
