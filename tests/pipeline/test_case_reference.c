// SPDX-License-Identifier: AGPL-3.0-or-later
// The page docs/case-reference.md and the schema agree. `test_case_reference --print` prints the tables for
// the page.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/case_schema.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static char *tables_text(void) {
  char *text = NULL;
  size_t size = 0;
  FILE *stream = open_memstream(&text, &size);
  assert_non_null(stream);
  cw_case_schema_markdown(stream);
  assert_int_equal(fclose(stream), 0);
  return text;
}

static void page_holds_exactly_the_tables(void **state) {
  char *page = read_whole(CUTWATER_SOURCE_DIR "/docs/case-reference.md", NULL), *tables = tables_text();
  const char *begin = strstr(page, "### Top of the file\n");
  assert_non_null(begin);
  assert_string_equal(begin, tables); // they are the end of the page
  free(tables);
  free(page);
}

static void rows_are_sound(void **state) {
  CwCase table;
  cw_case_defaults(&table);
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    char path[CW_KEY_PATH_SIZE];
    size_t stem;
    cw_case_key_path(key, path);
    // No key twice, no two keys of one field.
    assert_int_equal(cw_case_key_find(key->section, key->key), (int)i);
    for (size_t j = 0; j < i; ++j)
      if (cw_case_keys[j].offset == key->offset) fail_msg("%s shares its field with another key", path);
    assert_true(key->offset < sizeof(CwCase));
    assert_true(strlen(key->meaning) > 3);
    assert_null(strchr(key->meaning, '|'));
    // The unit column and the end of the key say the same.
    const CwUnit *unit = cw_unit_of_key(key->key, &stem);
    if (unit != cw_unit_find(key->unit)) fail_msg("%s does not end in its unit", path);
    if (key->type == CW_KEY_CHOICE || key->type == CW_KEY_CHOICES || key->type == CW_KEY_NAME ||
        key->type == CW_KEY_LIST)
      continue;
    assert_true(key->least < key->most);
    if (key->presence == CW_KEY_DEFAULT) {
      if (!(key->fallback >= key->least && key->fallback <= key->most)) fail_msg("%s: default out of range", path);
      assert_true(fabs(cw_case_key_value(key, &table) - key->fallback) <= 1e-12 * key->fallback);
    } else if (key->type == CW_KEY_REAL) {
      assert_true(isnan(cw_case_key_value(key, &table)));
    }
  }
}

// The column of the default says "none", and no meaning says it again.
static void what_has_no_default_is_not_computed(void **state) {
  char *tables = tables_text();
  assert_non_null(strstr(tables, "| `test_head_m` | m | 0.01 to 5000 m | none | head that was measured"));
  assert_non_null(strstr(tables, "| `splitter_start` | - | 0.15 to 0.8 | none | "));
  assert_null(strstr(tables, "computed: none"));
  free(tables);
}

static void every_field_of_the_case_has_a_key(void **state) {
  // Bytes that no key sets would be a field without a key; paddings are listed by their fields' sizes.
  CwCase table;
  unsigned char covered[sizeof(CwCase)] = {0};
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    const int narrow = key->type == CW_KEY_INT || key->type == CW_KEY_CHOICE || key->type == CW_KEY_CHOICES;
    size_t size = key->type == CW_KEY_NAME   ? CW_NAME_SIZE
                  : key->type == CW_KEY_LIST ? sizeof(CwList)
                  : narrow                   ? sizeof(int)
                                             : sizeof(double);
    memset(covered + key->offset, 1, size);
  }
  memset(covered + offsetof(CwCase, cad), 1, sizeof table.cad);     // a section with names of its own: docs/own-cad.md
  memset(covered + offsetof(CwCase, given), 1, sizeof table.given); // which keys there are
  size_t bare = 0;
  for (size_t i = 0; i < sizeof table; ++i) {
    bare = covered[i] ? 0 : bare + 1;
    if (bare == sizeof(double)) fail_msg("no key for the field that ends at byte %zu of CwCase", i);
  }
}

int main(int argc, char **argv) {
  if (argc == 2 && !strcmp(argv[1], "--print")) {
    cw_case_schema_markdown(stdout);
    return 0;
  }
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(page_holds_exactly_the_tables),
      cmocka_unit_test(rows_are_sound),
      cmocka_unit_test(what_has_no_default_is_not_computed),
      cmocka_unit_test(every_field_of_the_case_has_a_key),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
