// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_origin.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "pipeline/case_cad.h"
#include "pipeline/case_schema.h"
#include "pipeline/sealed_json.h"

// Records hold 15 digits.
static const double TOLERANCE = 1e-12;

static json_t *value_json(const CwCaseKey *key, const CwCase *table) {
  if (key->type == CW_KEY_NAME) return json_string((const char *)table + key->offset);
  double value = cw_case_key_value(key, table);
  return key->type == CW_KEY_CHOICE ? json_string(key->choices[(int)value]) : json_real(value);
}

// A key without a default that the case leaves out: NAN, or 0 of a count.
static int left_out(const CwCaseKey *key, const CwCase *table) {
  if (key->presence != CW_KEY_COMPUTED && key->presence != CW_KEY_OPTIONAL) return 0;
  double value = cw_case_key_value(key, table);
  return isnan(value) || (key->type != CW_KEY_REAL && value == 0);
}

json_t *cw_case_origin(const CwCase *table) {
  json_t *origin = json_object();
  int broken = !origin;
  char path[CW_KEY_PATH_SIZE];
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    if (!cw_case_key_shapes_pump(key) || left_out(key, table)) continue;
    cw_case_key_path(key, path);
    broken |= json_object_set_new(origin, path, value_json(key, table)) != 0;
  }
  if (table->cad) broken |= json_object_set_new(origin, "cad", json_string(table->cad->digest)) != 0;
  if (!broken) return origin;
  json_decref(origin);
  return NULL;
}

static int same(const json_t *a, const json_t *b) {
  if (!json_is_number(a) || !json_is_number(b)) return json_equal(a, b) || a == b; // both missing: the same
  double x = json_number_value(a), y = json_number_value(b);
  return fabs(x - y) <= TOLERANCE * fmax(fabs(x), fabs(y));
}

static void show(const json_t *value, char shown[CW_NAME_SIZE]) {
  if (json_is_number(value))
    snprintf(shown, CW_NAME_SIZE, "%.10g", json_number_value(value));
  else
    snprintf(shown, CW_NAME_SIZE, "%s", json_is_string(value) ? json_string_value(value) : "(left out)");
}

CwStatus cw_case_origin_check(const CwCase *table, const char *run, const char *stage) {
  CwStatus status = CW_OK;
  char path[4096], key_path[CW_KEY_PATH_SIZE], made[CW_NAME_SIZE], asked[CW_NAME_SIZE];
  json_t *record = NULL, *of, *origin = cw_case_origin(table);
  CW_REQUIRE(origin, CW_ERR_MEMORY, "out of memory: the origin of %s", stage);
  snprintf(path, sizeof path, "%s/%s/record.json", run, stage);
  CW_REQUIRE(!access(path, F_OK), CW_ERR_IO, "%s: it is missing; cutwater-%s writes it when all of its files are there",
             path, stage);
  CW_TRY(cw_sealed_json_read(path, &record));
  of = json_object_get(record, "case");
  CW_REQUIRE(json_is_object(of), CW_ERR_INPUT,
             "%s: does not say of which case; run cutwater-%s on this case file first", path, stage);
  CW_REQUIRE(same(json_object_get(of, "cad"), json_object_get(origin, "cad")), CW_ERR_INPUT,
             "%s/%s: made with another section cad than that of the case file; allowed: the same pump, run cutwater-%s "
             "on this case file first",
             run, stage, stage);
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    cw_case_key_path(&cw_case_keys[i], key_path);
    const json_t *theirs = json_object_get(of, key_path), *ours = json_object_get(origin, key_path);
    if (!cw_case_key_shapes_pump(&cw_case_keys[i]) || same(theirs, ours)) continue;
    show(theirs, made);
    show(ours, asked);
    CW_REQUIRE(
        0, CW_ERR_INPUT,
        "%s/%s: made with %s: %s, the case file has %s; allowed: the same pump, run cutwater-%s on this case file "
        "first",
        run, stage, key_path, made, asked, stage);
  }
done:
  json_decref(record);
  json_decref(origin);
  return status;
}
