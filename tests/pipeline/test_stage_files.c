// SPDX-License-Identifier: AGPL-3.0-or-later
// Files, records and digests of a run of three stages, each damaged in turn; also sealed_json.h and file_digest.h.
#include "pipeline/stage_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/file_digest.h"
#include "pipeline/record.h"
#include "pipeline/sealed_json.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// A stage that has written one file, from those of other stages.
static void write_stage(const char *stage, const char *const *reads, const char *text) {
  CwRecord *record;
  char name[40];
  const char *folder = in_test_folder(stage);
  snprintf(name, sizeof name, "%s/made.txt", stage);
  assert_int_equal(cw_make_directory(folder), CW_OK);
  write_text(in_test_folder(name), text);
  assert_int_equal(cw_record_start(stage, NULL, &record), CW_OK);
  assert_int_equal(cw_record_made_from(record, test_folder, reads), CW_OK);
  assert_int_equal(cw_record_file(record, folder, "made.txt"), CW_OK);
  snprintf(name, sizeof name, "%s/record.json", stage);
  assert_int_equal(cw_record_write(record, in_test_folder(name)), CW_OK);
  cw_record_free(record);
}

static int make_run(void **state) {
  if (make_test_folder(state)) return -1;
  write_stage("geometry", (const char *const[]){NULL}, "a solid\n");
  write_stage("mesh", (const char *const[]){"geometry", NULL}, "a mesh\n");
  write_stage("export", (const char *const[]){"geometry", "mesh", NULL}, "a case\n");
  return 0;
}

static void refuses(const char *stage, CwStatus code, const char *words) {
  assert_int_equal(cw_stage_files_check(test_folder, stage), code);
  if (!strstr(cw_fail_message(), words)) fail_msg("%s", cw_fail_message());
}

static void all_as_written_is_taken(void **state) {
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
  assert_int_equal(cw_stage_files_check(test_folder, "mesh"), CW_OK);
  assert_int_equal(cw_stage_files_check(test_folder, "export"), CW_OK);
}

static void a_changed_file_is_told_by_its_name(void **state) {
  write_text(in_test_folder("geometry/made.txt"), "a solit\n");
  refuses("geometry", CW_ERR_IO, "geometry/made.txt: is not as cutwater-geometry wrote it: damaged or replaced; run");
  write_text(in_test_folder("geometry/made.txt"), "a solid\n");
  assert_int_equal(unlink(in_test_folder("mesh/made.txt")), 0);
  refuses("mesh", CW_ERR_IO, "mesh/made.txt: cannot be read: No such file");
  assert_int_equal(cw_make_directory(in_test_folder("mesh/made.txt")), CW_OK);
  refuses("mesh", CW_ERR_IO, "mesh/made.txt: cannot be read: it is no plain file");
}

// The same stage again with the same result is no other geometry, whatever its record says of time and memory.
static void what_was_made_from_others_is_told(void **state) {
  write_stage("geometry", (const char *const[]){NULL}, "a solid\n");
  assert_int_equal(cw_stage_files_check(test_folder, "mesh"), CW_OK);
  write_stage("geometry", (const char *const[]){NULL}, "another solid\n");
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
  refuses("mesh", CW_ERR_INPUT, "mesh: was made from other files than lie in ");
  write_stage("mesh", (const char *const[]){"geometry", NULL}, "a mesh\n");
  assert_int_equal(cw_stage_files_check(test_folder, "mesh"), CW_OK);
  refuses("export", CW_ERR_INPUT, "/geometry; run cutwater-export again");
}

// A file of the user's: changed it is told, missing it is not.
static void a_changed_input_is_told(void **state) {
  CwRecord *record;
  write_text(in_test_folder("pump.Step"), "a drawing\n");
  assert_int_equal(cw_record_start("geometry", NULL, &record), CW_OK);
  assert_int_equal(cw_record_input(record, in_test_folder("none")), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/none: cannot be read: No such file"));
  assert_int_equal(cw_record_input(record, in_test_folder("pump.Step")), CW_OK);
  assert_int_equal(cw_record_write(record, in_test_folder("geometry/record.json")), CW_OK);
  cw_record_free(record);
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
  write_text(in_test_folder("pump.Step"), "a drawinh\n");
  refuses("geometry", CW_ERR_INPUT, "/pump.Step: has changed since ");
  refuses("geometry", CW_ERR_INPUT, "/geometry was made from it; run cutwater-geometry again");
  assert_int_equal(unlink(in_test_folder("pump.Step")), 0);
  assert_int_equal(cw_stage_files_check(test_folder, "geometry"), CW_OK);
}

static void no_bit_of_a_record_may_change(void **state) {
  json_t *object;
  size_t size;
  const char *path = in_test_folder("mesh/record.json");
  char *bytes = read_whole(path, &size);
  assert_true(size > 200);
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
    assert_string_not_equal(digest, before);
    strcpy(before, digest);
  }
  assert_int_equal(truncate(path, 3 * CW_FILE_BLOCK / 2), 0);
  CwFileSum sum = {0};
  assert_int_equal(cw_file_sum_blocks(path, sizeof bytes, 0, 1, &sum), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "blocks: cannot be read: it has become shorter"));
}

static void digest_of_pieces(const char *bytes, int64_t size, const int64_t *cut, int count, char *digest) {
  CwFileSum sums[2] = {{{0}}, {{0}}};
  for (int i = count; i >= 0; i--) {
    const int64_t from = i ? cut[i - 1] : 0, to = i < count ? cut[i] : size;
    cw_file_sum_add(&sums[i % 2], from, bytes + from, to - from);
  }
  for (int k = 0; k < CW_SUM_PARTS; k++) sums[0].part[k] += sums[1].part[k]; // as MPI adds them
  cw_file_sum_digest(&sums[0], size, digest);
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(all_as_written_is_taken, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(a_changed_file_is_told_by_its_name, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(what_was_made_from_others_is_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(a_changed_input_is_told, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(no_bit_of_a_record_may_change, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(any_object_comes_back, make_run, clear_test_folder),
      cmocka_unit_test_setup_teardown(shared_blocks_give_the_same_digest, make_run, clear_test_folder),
      cmocka_unit_test(any_pieces_give_the_same_digest),
      cmocka_unit_test(holes_add_nothing),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
