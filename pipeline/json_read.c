// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/json_read.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

CwStatus cw_json_read(const char *path, json_t **root) {
  CwStatus status = CW_OK;
  json_error_t error;
  json_t *value = NULL;
  *root = NULL;
  FILE *file = fopen(path, "r");
  CW_REQUIRE(file, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  value = json_loadf(file, JSON_REJECT_DUPLICATES, &error);
  CW_REQUIRE(value, CW_ERR_INPUT, "%s:%d:%d: not valid JSON: %s", path, error.line, error.column, error.text);
  CW_REQUIRE(json_is_object(value), CW_ERR_INPUT, "%s: the top must be a JSON object", path);
  *root = value;
  value = NULL;
done:
  if (file) fclose(file);
  json_decref(value);
  return status;
}

CwStatus cw_json_object(json_t *object, const char *where, const char *key, json_t **value) {
  *value = json_object_get(object, key);
  return json_is_object(*value) ? CW_OK : CW_FAIL(CW_ERR_INPUT, "%s: '%s' must be there and an object", where, key);
}

CwStatus cw_json_array(json_t *object, const char *where, const char *key, json_t **value) {
  *value = json_object_get(object, key);
  return json_is_array(*value) ? CW_OK : CW_FAIL(CW_ERR_INPUT, "%s: '%s' must be there and an array", where, key);
}

CwStatus cw_json_text(json_t *object, const char *where, const char *key, const char **value) {
  *value = json_string_value(json_object_get(object, key));
  return *value ? CW_OK : CW_FAIL(CW_ERR_INPUT, "%s: '%s' must be there and a string", where, key);
}

CwStatus cw_json_count(json_t *object, const char *where, const char *key, int64_t *value) {
  json_t *number = json_object_get(object, key);
  *value = json_integer_value(number);
  return json_is_integer(number) && *value >= 0
             ? CW_OK
             : CW_FAIL(CW_ERR_INPUT, "%s: '%s' must be there and a whole number from 0", where, key);
}

CwStatus cw_json_positive(json_t *object, const char *where, const char *key, double *value) {
  *value = cw_json_real(object, key);
  return *value > 0 ? CW_OK : CW_FAIL(CW_ERR_INPUT, "%s: '%s' must be there and a number above 0", where, key);
}

double cw_json_real(const json_t *object, const char *key) {
  json_t *number = json_object_get(object, key);
  return json_is_number(number) ? json_number_value(number) : NAN;
}
