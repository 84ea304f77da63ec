// SPDX-License-Identifier: AGPL-3.0-or-later
// Trees of free names: what stands where, and what is refused.
#include <string.h>

#include "pipeline/case_tree.h"
#include "tests/unit_test.h"

// The tree of a document's root.
static CwStatus read_tree(const char *text, CwCaseNode *root) {
  CwStatus status = CW_OK;
  CwEventStream stream = {0};
  CwEvent event;
  CW_TRY(cw_event_stream_open("x.yaml", text, strlen(text), &stream));
  do {
    CW_TRY(cw_event_next(&stream, &event));
  } while (event.type == FYET_STREAM_START || event.type == FYET_DOCUMENT_START);
  status = cw_case_tree_read(&stream, "cad", &event, root);
done:
  cw_event_stream_close(&stream);
  return status;
}

static void maps_lists_and_scalars(void **state) {
  CwCaseNode root = {0};
  if (read_tree("b: [1, [2, three]]\na: {c: x y}\n", &root)) fail_msg("%s", cw_fail_message());
  assert_int_equal(root.type, CW_NODE_MAP);
  assert_int_equal(root.count, 2);
  assert_string_equal(root.item[0].key, "b"); // in the order of the file
  const CwCaseNode *list = &root.item[0].item[1];
  assert_int_equal(list->type, CW_NODE_LIST);
  assert_string_equal(list->item[1].text, "three");
  assert_null(list->item[1].key);
  const CwCaseNode *scalar = cw_case_tree_find(cw_case_tree_find(&root, "a"), "c");
  assert_string_equal(scalar->text, "x y");
  assert_string_equal(scalar->path, "cad.a.c");
  assert_int_equal(scalar->place.line, 2);
  assert_null(cw_case_tree_find(&root, "c"));
  cw_case_tree_free(&root);
}

static void wrong_trees_are_refused(void **state) {
  static char longest[300] = "a: ";
  memset(longest + 3, 'x', 280);
  static const struct {
    const char *text, *message;
  } wrong[] = {{"a: 1\na: 2\n", "x.yaml:2:1: cad.a"},
               {"[[[[[[[[1]]]]]]]]\n", "x.yaml:1:"},
               {"a: !!float 1\n", "x.yaml:1:"},
               {longest, "x.yaml:1:4"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    CwCaseNode root = {0};
    assert_int_equal(read_tree(wrong[i].text, &root), CW_ERR_INPUT);
    if (!strstr(cw_fail_message(), wrong[i].message))
      fail_msg("'%s' is not in '%s'", wrong[i].message, cw_fail_message());
    cw_case_tree_free(&root);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(maps_lists_and_scalars),
                                     cmocka_unit_test(wrong_trees_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
