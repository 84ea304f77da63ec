// SPDX-License-Identifier: AGPL-3.0-or-later
// Events of a YAML text in their order and with their places; what is no YAML is refused.
#include <string.h>

#include "pipeline/case_event.h"
#include "tests/unit_test.h"

static void events_have_their_places(void **state) {
  static const char text[] = "a: 'one'\nb: [2, 3]\n";
  static const struct {
    enum fy_event_type type;
    int line, column, plain;
    const char *text;
  } wanted[] = {
      {FYET_STREAM_START, 0, 0, 0, ""},   {FYET_DOCUMENT_START, 0, 0, 0, ""}, {FYET_MAPPING_START, 1, 1, 0, ""},
      {FYET_SCALAR, 1, 1, 1, "a"},        {FYET_SCALAR, 1, 4, 0, "one"},      {FYET_SCALAR, 2, 1, 1, "b"},
      {FYET_SEQUENCE_START, 2, 4, 0, ""}, {FYET_SCALAR, 2, 5, 1, "2"},        {FYET_SCALAR, 2, 8, 1, "3"}};
  CwEventStream stream = {0};
  assert_int_equal(cw_event_stream_open("x.yaml", text, strlen(text), &stream), CW_OK);
  for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
    CwEvent event;
    if (cw_event_next(&stream, &event)) fail_msg("%s", cw_fail_message());
    assert_int_equal(event.type, wanted[i].type);
    if (wanted[i].line) assert_int_equal(event.place.line, wanted[i].line);
    if (event.type != FYET_SCALAR) continue;
    assert_string_equal(event.text, wanted[i].text);
    assert_int_equal(event.plain, wanted[i].plain);
    assert_int_equal(event.place.column, wanted[i].column);
    assert_false(event.tagged);
  }
  cw_event_stream_close(&stream);
}

static void what_is_no_yaml_is_refused(void **state) {
  static const char text[] = "a: 1\nb: [2, 3\n";
  CwEventStream stream = {0};
  CwStatus status = cw_event_stream_open("x.yaml", text, strlen(text), &stream);
  for (int i = 0; i < 20 && status == CW_OK; i++) {
    CwEvent event;
    status = cw_event_next(&stream, &event);
  }
  assert_int_equal(status, CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "x.yaml:"));
  cw_event_stream_close(&stream);
}

static void events_have_words(void **state) {
  assert_string_equal(cw_event_words(FYET_MAPPING_START), "a mapping");
  assert_string_equal(cw_event_words(FYET_SEQUENCE_START), "a list");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(events_have_their_places),
                                     cmocka_unit_test(what_is_no_yaml_is_refused), cmocka_unit_test(events_have_words)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
