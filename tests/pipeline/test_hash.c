// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/hash.h"

#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

static CwHash of(const void *data, size_t size) {
  CwHash hash = cw_hash_start();
  cw_hash_bytes(&hash, data, size);
  return hash;
}

static int same(CwHash a, CwHash b) {
  return a.sum[0] == b.sum[0] && a.sum[1] == b.sum[1];
}

static void random_bytes(unsigned char *bytes, size_t size) {
  for (size_t i = 0; i < size; i++) bytes[i] = (unsigned char)(rand() >> 8);
}

static void every_bit_counts(void **state) {
  unsigned char bytes[70];
  srand(1);
  for (size_t size = 1; size <= sizeof bytes; size++) {
    random_bytes(bytes, size);
    CwHash whole = of(bytes, size);
    for (size_t bit = 0; bit < 8 * size; bit++) {
      bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
      assert_false(same(of(bytes, size), whole));
      bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    assert_true(same(of(bytes, size), whole));
  }
}

// A step can be undone: no word but the right one gives the same sum.
static void another_word_always_shows(void **state) {
  unsigned char bytes[64];
  srand(2);
  random_bytes(bytes, sizeof bytes);
  CwHash whole = of(bytes, sizeof bytes);
  for (int i = 0; i < 100000; i++) {
    unsigned char kept[8], *word = bytes + 8 * (i % 8);
    memcpy(kept, word, 8);
    random_bytes(word, 8);
    assert_true(same(of(bytes, sizeof bytes), whole) == !memcmp(kept, word, 8));
    memcpy(word, kept, 8);
  }
}

// Blocks of zeros, and pieces that have changed their places.
static void larger_damage_shows(void **state) {
  enum { SIZE = 4096, BLOCK = 64 };
  static unsigned char bytes[SIZE], kept[SIZE];
  srand(3);
  random_bytes(kept, SIZE);
  CwHash whole = of(kept, SIZE);
  for (int i = 0; i < SIZE / BLOCK; i++) {
    memcpy(bytes, kept, SIZE);
    memset(bytes + BLOCK * i, 0, BLOCK);
    assert_false(same(of(bytes, SIZE), whole));
    for (int j = 0; j < i; j++) {
      memcpy(bytes, kept, SIZE);
      memcpy(bytes + BLOCK * i, kept + BLOCK * j, BLOCK);
      memcpy(bytes + BLOCK * j, kept + BLOCK * i, BLOCK);
      assert_false(same(of(bytes, SIZE), whole));
    }
  }
}

static void zeros_are_told_by_their_number(void **state) {
  static const unsigned char zeros[200];
  for (size_t a = 0; a <= sizeof zeros; a++)
    for (size_t b = 0; b < a; b++) assert_false(same(of(zeros, a), of(zeros, b)));
}

// Values one at a time reach both sums.
static void short_pieces_reach_both_sums(void **state) {
  CwHash one = cw_hash_start(), other = cw_hash_start();
  for (int i = 0; i < 3; i++) {
    double value = i;
    cw_hash_bytes(&one, &value, sizeof value);
    value += i == 1;
    cw_hash_bytes(&other, &value, sizeof value);
  }
  assert_true(one.sum[0] != other.sum[0] && one.sum[1] != other.sum[1]);
}

static void the_text_is_hex(void **state) {
  char text[CW_HASH_TEXT];
  CwHash hash = {{UINT64_C(0x123456789abcdef0), 1}};
  cw_hash_hex(&hash, text);
  assert_string_equal(text, "123456789abcdef00000000000000001");
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_bit_counts),
      cmocka_unit_test(another_word_always_shows),
      cmocka_unit_test(larger_damage_shows),
      cmocka_unit_test(zeros_are_told_by_their_number),
      cmocka_unit_test(short_pieces_reach_both_sums),
      cmocka_unit_test(the_text_is_hex),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
