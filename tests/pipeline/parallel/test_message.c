// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/parallel/message.h"

#include <stdlib.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

enum { MOST = 64 << 20 };

static void messages_by_hand(void **state) {
  unsetenv("CUTWATER_MESSAGE_BYTES");
  assert_int_equal(cw_message_items(10, 8), 10);
  assert_int_equal(cw_message_items(MOST, 8), MOST / 8);
  assert_int_equal(cw_message_items(MOST / 8, 8), MOST / 8);
  assert_int_equal(cw_message_items(INT64_MAX, 24), MOST / 24); // 16 bytes stay free
  assert_int_equal(cw_message_items(3, MOST), 1);
  assert_int_equal(cw_message_items(3, (size_t)5 * MOST), 1); // one that is too large goes alone
  setenv("CUTWATER_MESSAGE_BYTES", "100", 1);
  assert_int_equal(cw_message_items(20, 8), 12);
  static const char *const none[] = {"0", "-5", "", "words", "99999999999"}; // not less than usual
  for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
    setenv("CUTWATER_MESSAGE_BYTES", none[i], 1);
    assert_int_equal(cw_message_items(MOST, 8), MOST / 8);
  }
  unsetenv("CUTWATER_MESSAGE_BYTES");
}

// Whatever is left, the loop of the header brings all of it, in no more messages than the bytes ask for, each of which
// fits.
static void all_is_brought(void **state) {
  uint64_t seed = 71;
  unsetenv("CUTWATER_MESSAGE_BYTES");
  for (int i = 0; i < 2000; i++) {
    const size_t size = (size_t)(1 + draw(&seed) * (i % 2 ? 64 : 1 << 20));
    const int64_t count = 1 + (int64_t)(draw(&seed) * (i % 2 ? 1e9 : 1e5)), fit = MOST / (int64_t)size;
    int64_t messages = 0, part;
    for (int64_t at = 0; at < count; at += part, messages++) {
      part = cw_message_items(count - at, size);
      assert_true(part >= 1 && part <= count - at && part * (int64_t)size <= MOST);
    }
    assert_int_equal(messages, (count + fit - 1) / fit);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(messages_by_hand),
      cmocka_unit_test(all_is_brought),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
