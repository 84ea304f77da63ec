// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/face_table.h"

#include <string.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

#define HEADER "domain,face,patch,kind,name\n"

// The rows of two domains in any order, with line ends of both kinds and an empty line.
static const char good[] = HEADER "rotor,3,blade,wall,blade 1\r\n"
                                  "stator,1,outlet,outlet,end\n"
                                  "\n"
                                  "rotor,1,hub,wall,hub\n"
                                  "rotor,2,blade,wall,blade 2\n"
                                  "rotor,4,inlet,inlet,eye";

static CwStatus read_table(const char *text, const char *domain, int faces, CwFaceTable *table) {
  const char *path = in_test_folder("faces.csv");
  write_text(path, text);
  const CwStatus status = cw_face_table_read(path, domain, faces, table);
  assert_int_equal(unlink(path), 0);
  return status;
}

static void rows_of_a_domain_are_taken(void **state) {
  static const char *const names[] = {"hub", "blade 2", "blade 1", "eye"};
  static const int patches[] = {1, 0, 0, 2};
  CwFaceTable table;
  assert_int_equal(read_table(good, "rotor", 4, &table), CW_OK);
  assert_int_equal(table.face_count, 4);
  assert_int_equal(table.patch_count, 3);
  for (int f = 0; f < 4; f++) {
    assert_string_equal(table.face[f].name, names[f]);
    assert_int_equal(table.face[f].patch, patches[f]);
  }
  assert_string_equal(table.patch[0].name, "blade"); // in the order of their first rows
  assert_string_equal(table.patch[1].name, "hub");
  assert_string_equal(table.patch[2].name, "inlet");
  assert_int_equal(table.patch[1].kind, CW_PATCH_WALL);
  assert_int_equal(table.patch[2].kind, CW_PATCH_INLET);
  cw_face_table_free(&table);
  assert_null(table.face);
  assert_int_equal(read_table(good, "stator", 1, &table), CW_OK);
  assert_int_equal(table.patch_count, 1);
  assert_int_equal(table.patch[0].kind, CW_PATCH_OUTLET);
  cw_face_table_free(&table);
}

static void every_kind_has_its_word(void **state) {
  static const struct {
    const char *text;
    CwPatchKind kind;
  } kinds[] = {{HEADER "d,1,p,wall,n\n", CW_PATCH_WALL},
               {HEADER "d,1,p,inlet,n\n", CW_PATCH_INLET},
               {HEADER "d,1,p,outlet,n\n", CW_PATCH_OUTLET},
               {HEADER "d,1,p,interface,n\n", CW_PATCH_INTERFACE},
               {HEADER "d,1,p,symmetry,n\n", CW_PATCH_SYMMETRY}};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    CwFaceTable table;
    assert_int_equal(read_table(kinds[i].text, "d", 1, &table), CW_OK);
    assert_int_equal(table.patch[0].kind, kinds[i].kind);
    cw_face_table_free(&table);
  }
}

// A name of 32 characters is the longest.
static void what_is_wrong_is_told_with_its_line(void **state) {
  static const struct {
    const char *text, *words;
  } wrong[] = {
      {"", "faces.csv: face 1 of d has no row; each of its 2 faces needs one"},
      {"domain,face,patch\n",
       "faces.csv:1: the header is 'domain,face,patch'; it must be 'domain,face,patch,kind,name'"},
      {HEADER "d,1,p,wall\n", "faces.csv:2: the row has fewer than 5 columns"},
      {HEADER "d,1,p,wall,n,\n", "faces.csv:2: the row has more than 5 columns"},
      {HEADER "\nd,0,p,wall,n\n", "faces.csv:3: face '0' is wrong; d has faces 1 to 2"},
      {HEADER "d,3,p,wall,n\n", "faces.csv:2: face '3' is wrong"},
      {HEADER "d,1x,p,wall,n\n", "faces.csv:2: face '1x' is wrong"},
      {HEADER "d,,p,wall,n\n", "faces.csv:2: face '' is wrong"},
      {HEADER "d,1,p,wall,n\nd,1,p,wall,n\n", "faces.csv:3: face 1 of d is named a second time"},
      {HEADER "d,1,p,wal,n\n", "faces.csv:2: kind 'wal' is unknown; allowed are wall, inlet, outlet, interface and"},
      {HEADER "d,1,p,wall,n\nd,2,p,inlet,n\n",
       "faces.csv:3: patch 'p' is of kind 'inlet' here and 'wall' above; a patch has one kind"},
      {HEADER "d,1,,wall,n\n", "faces.csv:2: patch '' has 0 characters; allowed are 1 to 32"},
      {HEADER "d,1,p,wall,\n", "faces.csv:2: name '' has 0 characters"},
      {HEADER "d,1,p,wall,123456789 123456789 123456789 123\n", "faces.csv:2: name '123456789 123456789 123456789 123' "
                                                                "has 33 characters; allowed are 1 to 32"},
      {HEADER "d,1,p,wall,123456789 123456789 123456789 12\n", "faces.csv: face 2 of d has no row"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    CwFaceTable table;
    assert_int_equal(read_table(wrong[i].text, "d", 2, &table), CW_ERR_INPUT);
    if (!strstr(cw_fail_message(), wrong[i].words)) fail_msg("%s", cw_fail_message());
    assert_null(table.face);
    assert_null(table.patch);
  }
  CwFaceTable table;
  assert_int_equal(cw_face_table_read(in_test_folder("none"), "d", 2, &table), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/none: cannot be read: No such file"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_of_a_domain_are_taken),
      cmocka_unit_test(every_kind_has_its_word),
      cmocka_unit_test(what_is_wrong_is_told_with_its_line),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
