// SPDX-License-Identifier: AGPL-3.0-or-later
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "tests/sync_order.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static char whole[sizeof test_folder + 32];

static int make_folder(void **state) {
  if (make_test_folder(state)) return -1;
  snprintf(whole, sizeof whole, "%s/mesh.txt", test_folder);
  return 0;
}

static int remove_files(void **state) {
  unlink(whole);
  return remove_test_folder(state);
}

static void assert_content(const char *path, const char *expected) {
  char *text = read_whole(path, NULL);
  assert_string_equal(text, expected);
  free(text);
}

static int exists(const char *path) {
  return !access(path, F_OK);
}

// Files in the folder, the final one among them.
static int files(void) {
  int count = 0;
  DIR *list = opendir(test_folder);
  assert_non_null(list);
  for (struct dirent *entry; (entry = readdir(list));) count += entry->d_type == DT_REG;
  closedir(list);
  return count;
}

static void file_appears_at_the_commit(void **state) {
  CwAtomicFile file = {0};
  assert_int_equal(cw_atomic_file_open(whole, &file), CW_OK);
  const size_t length = strlen(file.temporary_path), end = strlen("-mesh.txt");
  assert_string_equal(file.temporary_path + length - end, "-mesh.txt");
  fputs("new", file.stream);
  assert_false(exists(whole));
  assert_true(exists(file.temporary_path));
  assert_int_equal(cw_atomic_file_commit(&file), CW_OK);
  assert_content(whole, "new");
  assert_int_equal(files(), 1);
  cw_atomic_file_abandon(&file); // nothing after a commit
  assert_content(whole, "new");
}

static void abandoned_file_leaves_the_old_one(void **state) {
  CwAtomicFile file = {0};
  assert_int_equal(cw_atomic_file_open(whole, &file), CW_OK);
  fputs("half", file.stream);
  cw_atomic_file_abandon(&file);
  cw_atomic_file_abandon(&file);
  assert_content(whole, "new");
  assert_int_equal(files(), 1);
}

// Another process may write the same file: who commits last has it, and neither gets bytes of the other.
static void two_writers_do_not_meet(void **state) {
  CwAtomicFile one = {0}, two = {0};
  assert_int_equal(cw_atomic_file_open(whole, &one), CW_OK);
  assert_int_equal(cw_atomic_file_open(whole, &two), CW_OK);
  assert_string_not_equal(one.temporary_path, two.temporary_path);
  fputs("one", one.stream);
  fputs("the other", two.stream);
  assert_int_equal(cw_atomic_file_commit(&two), CW_OK);
  assert_content(whole, "the other");
  assert_int_equal(cw_atomic_file_commit(&one), CW_OK);
  assert_content(whole, "one");
  assert_int_equal(files(), 1);
}

static void what_killed_runs_left_is_cleared(void **state) {
  CwAtomicFile file = {0};
  assert_int_equal(cw_atomic_file_open(whole, &file), CW_OK);
  assert_int_equal(files(), 2);
  assert_int_equal(cw_atomic_file_clear(test_folder), CW_OK);
  assert_int_equal(files(), 1);
  assert_content(whole, "one");
  assert_int_equal(cw_atomic_file_commit(&file), CW_ERR_IO);
  assert_content(whole, "one");
  assert_int_equal(cw_atomic_file_clear(whole), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "mesh.txt: cannot be read"));
}

// By the umask, as any file that a program makes, not for the owner alone.
static void others_may_read_it(void **state) {
  struct stat about;
  mode_t before = umask(022);
  CwAtomicFile file = {0};
  assert_int_equal(cw_atomic_file_open(whole, &file), CW_OK);
  fputs("open", file.stream);
  assert_int_equal(cw_atomic_file_commit(&file), CW_OK);
  umask(before);
  assert_int_equal(stat(whole, &about), 0);
  assert_int_equal(about.st_mode & 0777, 0644);
}

static void library_writes_by_name(void **state) {
  CwAtomicFile file = {0};
  assert_int_equal(cw_atomic_file_name(whole, &file), CW_OK);
  assert_null(file.stream);
  FILE *library = fopen(file.temporary_path, "w");
  assert_non_null(library);
  fputs("by name", library);
  fclose(library);
  assert_int_equal(cw_atomic_file_commit(&file), CW_OK);
  assert_content(whole, "by name");
  // A library that wrote nothing is found out.
  assert_int_equal(cw_atomic_file_name(whole, &file), CW_OK);
  assert_int_equal(cw_atomic_file_commit(&file), CW_ERR_IO);
  assert_content(whole, "by name");
}

static int renames, renames_on_disk, syncs_when_renamed;

static void count_rename(const char *to, int is_on_disk) {
  assert_string_equal(to, whole);
  renames++;
  renames_on_disk += is_on_disk;
  syncs_when_renamed = synced_count;
}

// All of a file is on the disk before it takes its name, and its folder with the name before the commit returns.
static void names_are_given_to_what_is_on_the_disk(void **state) {
  struct stat about;
  tell_rename = count_rename;
  for (int by_name = 0; by_name < 2; ++by_name) {
    CwAtomicFile file = {0};
    assert_int_equal(by_name ? cw_atomic_file_name(whole, &file) : cw_atomic_file_open(whole, &file), CW_OK);
    FILE *stream = by_name ? fopen(file.temporary_path, "w") : file.stream;
    assert_non_null(stream);
    fputs("by name", stream);
    if (by_name) fclose(stream);
    assert_int_equal(cw_atomic_file_commit(&file), CW_OK);
    assert_int_equal(renames, by_name + 1);
    assert_int_equal(renames_on_disk, renames);
    assert_int_equal(stat(test_folder, &about), 0);
    assert_int_equal(synced_count, syncs_when_renamed + 1);
    assert_int_equal(synced[synced_count - 1].st_ino, about.st_ino);
  }
  tell_rename = NULL;
  // The judge itself: what is written after fsync is not on the disk.
  FILE *late = fopen(whole, "a");
  assert_non_null(late);
  fputs("more", late);
  fflush(late);
  assert_int_equal(stat(whole, &about), 0);
  assert_false(was_synced(&about));
  assert_int_equal(fsync(fileno(late)), 0);
  assert_true(was_synced(&about));
  fclose(late);
  assert_int_equal(truncate(whole, strlen("by name")), 0);
}

static void full_disk_is_an_error(void **state) {
  if (access("/dev/full", W_OK)) skip();
  CwAtomicFile file = {0};
  assert_int_equal(cw_atomic_file_open(whole, &file), CW_OK);
  assert_non_null(freopen("/dev/full", "w", file.stream));
  fputs("lost", file.stream);
  assert_int_equal(cw_atomic_file_commit(&file), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "mesh.txt: cannot be written: No space left on device"));
  assert_content(whole, "by name");
  assert_int_equal(files(), 1);
  assert_null(file.temporary_path);
}

static void bad_places_are_errors(void **state) {
  CwAtomicFile file = {0};
  char path[sizeof test_folder + 64];
  snprintf(path, sizeof path, "%s/missing/file", test_folder);
  assert_int_equal(cw_atomic_file_open(path, &file), CW_ERR_IO);
  assert_null(file.temporary_path);
  snprintf(path, sizeof path, "%s/", test_folder);
  assert_int_equal(cw_atomic_file_open(path, &file), CW_ERR_IO);
  assert_int_equal(cw_atomic_file_open(test_folder, &file), CW_OK); // a folder stands under the final name
  assert_int_equal(cw_atomic_file_commit(&file), CW_ERR_IO);
  assert_null(file.temporary_path);
}

static void directories_are_made_with_parents(void **state) {
  char path[sizeof test_folder + 64];
  struct stat about;
  snprintf(path, sizeof path, "%s/a//b/c/", test_folder);
  assert_int_equal(cw_make_directory(path), CW_OK);
  assert_int_equal(cw_make_directory(path), CW_OK);
  assert_int_equal(stat(path, &about), 0);
  assert_true(S_ISDIR(about.st_mode));
  assert_int_equal(cw_make_directory("/"), CW_OK);
  assert_int_equal(cw_make_directory("."), CW_OK);
  assert_int_equal(cw_make_directory(""), CW_ERR_IO);
  assert_int_equal(cw_make_directory(whole), CW_ERR_IO); // a file
  assert_non_null(strstr(cw_fail_message(), "mesh.txt: is not a folder"));
  snprintf(path, sizeof path, "%s/below", whole);
  assert_int_equal(cw_make_directory(path), CW_ERR_IO);
  const char *const made[] = {"a/b/c", "a/b", "a"};
  for (int i = 0; i < 3; ++i) {
    snprintf(path, sizeof path, "%s/%s", test_folder, made[i]);
    assert_int_equal(rmdir(path), 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(file_appears_at_the_commit),
      cmocka_unit_test(abandoned_file_leaves_the_old_one),
      cmocka_unit_test(two_writers_do_not_meet),
      cmocka_unit_test(what_killed_runs_left_is_cleared),
      cmocka_unit_test(others_may_read_it),
      cmocka_unit_test(library_writes_by_name),
      cmocka_unit_test(names_are_given_to_what_is_on_the_disk),
      cmocka_unit_test(full_disk_is_an_error),
      cmocka_unit_test(bad_places_are_errors),
      cmocka_unit_test(directories_are_made_with_parents),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_files);
}
