// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/json_read.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static void files_that_are_no_object_are_told(void **state) {
  static const struct {
    const char *text;
    CwStatus status;
    const char *words;
  } files[] = {{"{\"a\": 1}", CW_OK, ""},
               {"[1]", CW_ERR_INPUT, "read.json: the top must be a JSON object"},
               {"", CW_ERR_INPUT, "read.json:1:0: not valid JSON: "},
               {"{\"a\": 1", CW_ERR_INPUT, "read.json:1:7: not valid JSON: "},
               {"{\"a\": 1,\n\"a\": 2}", CW_ERR_INPUT, "read.json:2:3: not valid JSON: duplicate object key"},
               {"{\"a\": 1} 2", CW_ERR_INPUT, "read.json:1:10: not valid JSON: "}};
  const char *path = in_test_folder("read.json");
  json_t *root;
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    write_text(path, files[i].text);
    cw_fail_clear();
    assert_int_equal(cw_json_read(path, &root), files[i].status);
    if (files[i].status == CW_OK) {
      assert_int_equal(json_integer_value(json_object_get(root, "a")), 1);
      json_decref(root);
      continue;
    }
    assert_null(root);
    if (!strstr(cw_fail_message(), files[i].words)) fail_msg("%s", cw_fail_message());
  }
  assert_int_equal(unlink(path), 0);
  assert_int_equal(cw_json_read(path, &root), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "read.json: cannot be read: No such file"));
}

typedef CwStatus (*Fetch)(json_t *object, const char *where, const char *key);

static CwStatus object_of(json_t *object, const char *where, const char *key) {
  json_t *value;
  return cw_json_object(object, where, key, &value);
}

static CwStatus array_of(json_t *object, const char *where, const char *key) {
  json_t *value;
  return cw_json_array(object, where, key, &value);
}

static CwStatus text_of(json_t *object, const char *where, const char *key) {
  const char *value;
  return cw_json_text(object, where, key, &value);
}

static CwStatus count_of(json_t *object, const char *where, const char *key) {
  int64_t value;
  return cw_json_count(object, where, key, &value);
}

static CwStatus positive_of(json_t *object, const char *where, const char *key) {
  double value;
  return cw_json_positive(object, where, key, &value);
}

// Each way to fetch takes the members of its type, and tells of all others what there must be.
static void only_the_right_type_is_taken(void **state) {
  static const struct {
    Fetch fetch;
    const char *takes[3], *must;
  } ways[] = {{object_of, {"object"}, "an object"},
              {array_of, {"array"}, "an array"},
              {text_of, {"text"}, "a string"},
              {count_of, {"five", "zero"}, "a whole number from 0"},
              {positive_of, {"five", "half"}, "a number above 0"}};
  json_t *all = json_pack("{s:{}, s:[], s:s, s:i, s:i, s:i, s:f, s:f, s:n, s:b}", "object", "array", "text", "five",
                          "five", 5, "zero", 0, "minus", -1, "half", 0.5, "below", -0.5, "null", "true", 1);
  const char *key;
  json_t *value;
  for (size_t w = 0; w < sizeof ways / sizeof *ways; w++) {
    char message[100];
    json_object_set_new(all, "missing", json_null());
    json_object_foreach(all, key, value) {
      int takes = 0;
      for (int k = 0; k < 3 && ways[w].takes[k]; k++) takes |= !strcmp(ways[w].takes[k], key);
      cw_fail_clear();
      assert_int_equal(ways[w].fetch(all, "record.json: results", key), takes ? CW_OK : CW_ERR_INPUT);
      if (takes) continue;
      snprintf(message, sizeof message, "record.json: results: '%s' must be there and %s", key, ways[w].must);
      assert_string_equal(cw_fail_message(), message);
    }
    json_object_del(all, "missing");
    assert_int_equal(ways[w].fetch(all, "record.json: results", "missing"), CW_ERR_INPUT);
  }
  json_decref(all);
}

static void values_come_as_they_stand(void **state) {
  json_t *all = json_pack("{s:[i, i], s:s, s:I, s:f, s:n}", "list", 1, 2, "name", "pump", "cells",
                          (json_int_t)5000000000, "head", 12.5, "none"),
         *list;
  const char *name;
  int64_t cells;
  double head;
  assert_int_equal(cw_json_array(all, "", "list", &list), CW_OK);
  assert_int_equal(json_array_size(list), 2);
  assert_int_equal(cw_json_text(all, "", "name", &name), CW_OK);
  assert_string_equal(name, "pump");
  assert_int_equal(cw_json_count(all, "", "cells", &cells), CW_OK);
  assert_true(cells == 5000000000);
  assert_int_equal(cw_json_positive(all, "", "head", &head), CW_OK);
  assert_near(head, 12.5, 0);
  assert_near(cw_json_real(all, "cells"), 5e9, 0);
  assert_true(isnan(cw_json_real(all, "none")));
  assert_true(isnan(cw_json_real(all, "name")));
  assert_true(isnan(cw_json_real(all, "missing")));
  json_decref(all);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(files_that_are_no_object_are_told),
      cmocka_unit_test(only_the_right_type_is_taken),
      cmocka_unit_test(values_come_as_they_stand),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
