// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/sealed_json.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/hash.h"
#include "tests/draw.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static void no_bit_of_a_file_may_change(void **state) {
  json_t *object;
  size_t size;
  const char *path = in_test_folder("sealed.json");
  json_t *given = json_pack("{s:s, s:[i, f, b], s:{s:s}}", "stage", "mesh", "list", 12, 0.1, 1, "files", "a", "b c");
  assert_int_equal(cw_sealed_json_write(given, path), CW_OK);
  json_decref(given);
  char *bytes = read_whole(path, &size);
  assert_true(size > 100);
  for (size_t bit = 0; bit < 8 * size; bit++) {
    bytes[bit / 8] ^= (char)(1 << bit % 8);
    write_whole(path, bytes, size);
    assert_int_equal(cw_sealed_json_read(path, &object), CW_ERR_IO);
    assert_null(object);
    bytes[bit / 8] ^= (char)(1 << bit % 8);
  }
  for (size_t cut = 0; cut < size; cut++) {
    write_whole(path, bytes, cut);
    assert_int_equal(cw_sealed_json_read(path, &object), CW_ERR_IO);
  }
  free(bytes);
  assert_int_equal(unlink(path), 0);
}

static void any_object_comes_back(void **state) {
  json_t *object = json_pack("{s:i, s:s, s:[f, n]}", "one", 1, "digest of", "\"}\n", "list", 0.1), *got;
  assert_int_equal(cw_sealed_json_write(object, in_test_folder("sealed.json")), CW_OK);
  assert_int_equal(cw_sealed_json_read(in_test_folder("sealed.json"), &got), CW_OK);
  assert_int_equal(json_object_size(got), 4);
  json_object_del(got, "digest");
  assert_true(json_equal(got, object));
  json_decref(object);
  json_decref(got);
  assert_int_equal(unlink(in_test_folder("sealed.json")), 0);
}

// Numbers come back to the last bit, and keys in the order they were set.
static void every_bit_of_a_number_comes_back(void **state) {
  enum { COUNT = 500 };
  const char *path = in_test_folder("numbers.json"), *key;
  uint64_t seed = 14;
  double number[COUNT];
  json_t *object = json_object(), *got, *value;
  int at = 0;
  for (int i = 0; i < COUNT; i++) {
    char name[20];
    number[i] = (draw(&seed) - 0.5) * pow(10, 600 * draw(&seed) - 300);
    snprintf(name, sizeof name, "n%d", (37 * i) % COUNT);
    json_object_set_new(object, name, json_real(number[i]));
  }
  assert_int_equal(cw_sealed_json_write(object, path), CW_OK);
  assert_int_equal(cw_sealed_json_read(path, &got), CW_OK);
  json_object_foreach(got, key, value) {
    if (at == COUNT) {
      assert_string_equal(key, "digest");
      continue;
    }
    assert_int_equal(atoi(key + 1), (37 * at) % COUNT);
    assert_true(json_real_value(value) == number[at++]);
  }
  json_decref(object);
  json_decref(got);
  assert_int_equal(unlink(path), 0);
}

// The seal is of all bytes before the comma; a right one round what is no JSON does not make it such.
static void a_seal_round_no_json_is_told(void **state) {
  static const char *const content[] = {"{\n  \"a\": 1", "{\n  \"a\": ", "{\n  \"a\": 1,\n  \"a\": 2"};
  static const CwStatus wanted[] = {CW_OK, CW_ERR_INPUT, CW_ERR_INPUT};
  const char *path = in_test_folder("by_hand.json");
  for (int i = 0; i < 3; i++) {
    char digest[CW_HASH_TEXT], text[200];
    json_t *object;
    CwHash hash = cw_hash_start();
    cw_hash_bytes(&hash, content[i], strlen(content[i]));
    cw_hash_hex(&hash, digest);
    snprintf(text, sizeof text, "%s,\n  \"digest\": \"%s\"\n}\n", content[i], digest);
    write_text(path, text);
    assert_int_equal(cw_sealed_json_read(path, &object), wanted[i]);
    if (wanted[i] != CW_OK) {
      assert_null(object);
      assert_non_null(strstr(cw_fail_message(), i == 1 ? "by_hand.json:2:8: not valid JSON" : "not valid JSON"));
    }
    json_decref(object);
  }
  assert_int_equal(unlink(path), 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_bit_of_a_file_may_change),
      cmocka_unit_test(any_object_comes_back),
      cmocka_unit_test(every_bit_of_a_number_comes_back),
      cmocka_unit_test(a_seal_round_no_json_is_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
