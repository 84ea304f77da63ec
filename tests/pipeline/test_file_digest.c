// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/file_digest.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/draw.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static void digest_of_pieces(const char *bytes, int64_t size, const int64_t *cut, int count, char *digest) {
  CwFileSum sums[2] = {{{0}}, {{0}}};
  for (int i = count; i >= 0; i--) {
    const int64_t from = i ? cut[i - 1] : 0, to = i < count ? cut[i] : size;
    cw_file_sum_add(&sums[i % 2], from, bytes + from, to - from);
  }
  for (int k = 0; k < CW_SUM_PARTS; k++) sums[0].part[k] += sums[1].part[k]; // as MPI adds them
  cw_file_sum_digest(&sums[0], size, digest);
}

// Ranks that share the blocks come to the digest that one alone finds; sizes about that of a block.
static void shared_blocks_give_the_same_digest(void **state) {
  static char bytes[2 * CW_FILE_BLOCK + 5];
  static const size_t sizes[] = {0, 1, CW_FILE_BLOCK - 1, CW_FILE_BLOCK, CW_FILE_BLOCK + 1, sizeof bytes};
  const char *path = in_test_folder("blocks");
  char before[CW_HASH_TEXT] = "", digest[CW_HASH_TEXT], shared[CW_HASH_TEXT];
  for (size_t i = 0; i < sizeof bytes; i++) bytes[i] = (char)(i * 7 >> 3);
  for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
    CwFileSum sum = {0};
    int64_t size = -1;
    write_whole(path, bytes, sizes[s]);
    assert_int_equal(cw_file_digest(path, digest), CW_OK);
    assert_int_equal(cw_file_size(path, &size), CW_OK);
    assert_int_equal(size, sizes[s]);
    for (int rank = 1; rank >= 0; rank--) assert_int_equal(cw_file_sum_blocks(path, size, rank, 2, &sum), CW_OK);
    cw_file_sum_digest(&sum, size, shared);
    assert_string_equal(shared, digest);
    digest_of_pieces(bytes, size, NULL, 0, shared); // as they stand in memory
    assert_string_equal(shared, digest);
    assert_string_not_equal(digest, before);
    strcpy(before, digest);
  }
  assert_int_equal(truncate(path, 3 * CW_FILE_BLOCK / 2), 0);
  CwFileSum sum = {0};
  assert_int_equal(cw_file_sum_blocks(path, sizeof bytes, 0, 1, &sum), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "blocks: cannot be read: it has become shorter"));
  assert_int_equal(unlink(path), 0);
}

static int compare_cuts(const void *a, const void *b) {
  return (int)(*(const int64_t *)a - *(const int64_t *)b);
}

// Whoever sums which bytes, in pieces of any length and order; and any bit that is another shows.
static void any_pieces_give_the_same_digest(void **state) {
  enum { SIZE = 1000, CUTS = 20 };
  char bytes[SIZE], whole[CW_HASH_TEXT], parts[CW_HASH_TEXT];
  srand(5);
  for (int i = 0; i < SIZE; i++) bytes[i] = (char)(rand() >> 7);
  digest_of_pieces(bytes, SIZE, NULL, 0, whole);
  for (int round = 0; round < 200; round++) {
    int64_t cut[CUTS];
    for (int i = 0; i < CUTS; i++) cut[i] = rand() % (SIZE + 1);
    qsort(cut, CUTS, sizeof *cut, compare_cuts);
    digest_of_pieces(bytes, SIZE, cut, CUTS, parts);
    assert_string_equal(parts, whole);
    const int at = rand() % SIZE;
    const char was = bytes[at];
    bytes[at] ^= (char)(1 << round % 8);
    digest_of_pieces(bytes, SIZE, cut, CUTS, parts);
    assert_string_not_equal(parts, whole);
    bytes[at] = was;
  }
}

// A hole adds nothing, wherever it stands; the size counts.
static void holes_add_nothing(void **state) {
  static const char zeros[100];
  CwFileSum sum = {0};
  char shorter[CW_HASH_TEXT], longer[CW_HASH_TEXT];
  for (int64_t at = 0; at < 20; at++) cw_file_sum_add(&sum, at, zeros, (int64_t)sizeof zeros);
  for (int k = 0; k < CW_SUM_PARTS; k++) assert_int_equal(sum.part[k], 0);
  cw_file_sum_digest(&sum, 100, shorter);
  cw_file_sum_digest(&sum, 101, longer);
  assert_string_not_equal(shorter, longer);
}

// Product of two words as people multiply, in digits of 16 bits.
static void multiply(uint64_t a, uint64_t b, uint64_t product[CW_SUM_PARTS]) {
  uint64_t digit[9] = {0};
  for (int i = 0; i < 4; i++)
    for (int j = 0; j < 4; j++) {
      const uint64_t two = (a >> 16 * i & 0xffff) * (b >> 16 * j & 0xffff);
      digit[i + j] += two & 0xffff;
      digit[i + j + 1] += two >> 16;
    }
  for (int i = 0; i < 8; i++) {
    digit[i + 1] += digit[i] >> 16;
    digit[i] &= 0xffff;
  }
  for (int k = 0; k < CW_SUM_PARTS; k++) product[k] = digit[2 * k] | digit[2 * k + 1] << 16;
}

// The factor of a place is the sum of a word of 1 there.
static uint64_t factor_at(int64_t number) {
  const uint64_t one = 1;
  CwFileSum sum = {{0}};
  cw_file_sum_add(&sum, 8 * number, &one, sizeof one);
  assert_int_equal(sum.part[2] | sum.part[3], 0);
  return sum.part[0] | sum.part[1] << 32;
}

// All 128 bits of the sum of words, each times the factor of its place, and no two factors alike.
static void the_sum_is_of_products(void **state) {
  enum { WORDS = 40 };
  uint64_t seed = 12;
  for (int round = 0; round < 300; round++) {
    const int64_t first = draw_below(&seed, 3) ? draw_below(&seed, 1000) : (int64_t)(draw(&seed) * 0x1p50);
    uint64_t words[WORDS], factors[WORDS], wanted[CW_SUM_PARTS] = {0};
    CwFileSum sum = {{0}};
    for (int i = 0; i < WORDS; i++) {
      uint64_t product[CW_SUM_PARTS], carry = 0;
      words[i] = i % 5 ? (uint64_t)(draw(&seed) * 0x1p32) << 32 | (uint64_t)(draw(&seed) * 0x1p32) : UINT64_MAX;
      factors[i] = factor_at(first + i);
      assert_true(factors[i] != 0);
      for (int j = 0; j < i; j++) assert_true(factors[j] != factors[i]);
      multiply(words[i], factors[i], product);
      for (int k = 0; k < CW_SUM_PARTS; k++) {
        carry += wanted[k] + product[k];
        wanted[k] = carry & UINT32_MAX;
        carry >>= 32;
      }
    }
    cw_file_sum_add(&sum, 8 * first, words, sizeof words);
    for (int k = 0; k < CW_SUM_PARTS; k++) assert_true(sum.part[k] == wanted[k]);
  }
}

// What was never written reads as zeros: a sparse file and one of zeros that were written have one digest.
static void sparse_files_have_the_digest_of_zeros(void **state) {
  enum { SIZE = 7 * CW_FILE_BLOCK / 2 }; // the last block begins with a hole
  const char *path = in_test_folder("sparse");
  char sparse[CW_HASH_TEXT], full[CW_HASH_TEXT], *bytes = calloc(1, SIZE);
  const int file = open(path, O_CREAT | O_RDWR, 0600);
  assert_int_equal(ftruncate(file, SIZE), 0);
  assert_int_equal(pwrite(file, "end", 3, SIZE - 3), 3);
  close(file);
  memcpy(bytes + SIZE - 3, "end", 3);
  assert_int_equal(cw_file_digest(path, sparse), CW_OK);
  write_whole(path, bytes, SIZE);
  assert_int_equal(cw_file_digest(path, full), CW_OK);
  assert_string_equal(sparse, full);
  digest_of_pieces(bytes, SIZE, NULL, 0, full);
  assert_string_equal(sparse, full);
  free(bytes);
  assert_int_equal(unlink(path), 0);
}

static void texts_are_read_whole(void **state) {
  static const char bytes[] = "one\0two\n";
  const char *path = in_test_folder("text");
  for (size_t size = 0; size < sizeof bytes; size++) {
    char *text = NULL;
    size_t got = 99;
    write_whole(path, bytes, size);
    assert_int_equal(cw_file_text(path, &text, &got), CW_OK);
    assert_int_equal(got, size);
    assert_memory_equal(text, bytes, size);
    assert_int_equal(text[size], '\0');
    free(text);
  }
  assert_int_equal(unlink(path), 0);
}

static void what_is_no_file_is_told(void **state) {
  char digest[CW_HASH_TEXT], *text = NULL;
  size_t size;
  int64_t bytes;
  assert_int_equal(cw_file_digest(in_test_folder("none"), digest), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/none: cannot be read: No such file"));
  assert_int_equal(cw_file_text(test_folder, &text, &size), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), ": cannot be read: it is no plain file"));
  assert_int_equal(cw_file_size(test_folder, &bytes), CW_ERR_IO);
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(shared_blocks_give_the_same_digest),
      cmocka_unit_test(any_pieces_give_the_same_digest),
      cmocka_unit_test(holes_add_nothing),
      cmocka_unit_test(the_sum_is_of_products),
      cmocka_unit_test(sparse_files_have_the_digest_of_zeros),
      cmocka_unit_test(texts_are_read_whole),
      cmocka_unit_test(what_is_no_file_is_told),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
