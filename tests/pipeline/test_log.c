// SPDX-License-Identifier: AGPL-3.0-or-later
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "pipeline/log.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static CwLog *test_log;

enum { TEXT_SIZE = 16384 };

static char copy_path[sizeof test_folder + 32];
static int kept_stderr = -1;

static int make_folder(void **state) {
  if (make_test_folder(state)) return -1;
  snprintf(copy_path, sizeof copy_path, "%s/mesh.log", test_folder);
  return 0;
}

static int remove_files(void **state) {
  unlink(copy_path);
  return remove_test_folder(state);
}

// Sends standard error to `file` until capture_end.
static void capture_start(int file) {
  fflush(stderr);
  kept_stderr = dup(STDERR_FILENO);
  assert_true(kept_stderr >= 0);
  assert_true(dup2(file, STDERR_FILENO) >= 0);
}

static void capture_end(void) {
  fflush(stderr);
  dup2(kept_stderr, STDERR_FILENO);
  close(kept_stderr);
  kept_stderr = -1;
}

static int open_capture(void) {
  const char *name = in_test_folder("stderr");
  int file = open(name, O_RDWR | O_CREAT | O_TRUNC, 0600);
  assert_true(file >= 0);
  unlink(name);
  return file;
}

static void read_capture(int file, char text[TEXT_SIZE]) {
  ssize_t length = pread(file, text, TEXT_SIZE - 1, 0);
  text[length > 0 ? length : 0] = '\0';
  close(file);
}

static int count(const char *text, const char *piece) {
  int found = 0;
  for (const char *c = text; (c = strstr(c, piece)); ++c) ++found;
  return found;
}

static void read_copy(char text[TEXT_SIZE]) {
  FILE *file = fopen(copy_path, "r");
  assert_non_null(file);
  text[fread(text, 1, TEXT_SIZE - 1, file)] = '\0';
  fclose(file);
}

static void lines_go_to_standard_error_and_to_the_copy(void **state) {
  char seen[TEXT_SIZE], copy[TEXT_SIZE];
  int file = open_capture();
  capture_start(file);
  CwStatus status = cw_log_open("mesh", copy_path, 1, 0, &test_log);
  cw_log(test_log, "reading %d regions", 12);
  cw_log_debug(test_log, "not shown");
  cw_log_warn(test_log, "the gap is narrow: %g mm", 0.5);
  cw_log(test_log, "two\nlines\tin one");
  CW_FAIL(CW_ERR_MESH, "region 3: no layers");
  int code = cw_log_error(test_log, CW_ERR_MESH);
  capture_end();
  read_capture(file, seen);
  assert_int_equal(status, CW_OK);
  assert_int_equal(code, CW_ERR_MESH);
  assert_string_equal(seen, "cutwater-mesh: reading 12 regions\n"
                            "cutwater-mesh: warning: the gap is narrow: 0.5 mm\n"
                            "cutwater-mesh: two lines in one\n"
                            "cutwater-mesh: error: region 3: no layers\n");
  read_copy(copy); // whole before the log is closed: a killed run leaves its lines
  assert_string_equal(copy, seen);
  assert_int_equal(cw_log_warning_count(test_log), 1);
  assert_string_equal(cw_log_warning(test_log, 0), "the gap is narrow: 0.5 mm");
  assert_string_equal(cw_log_warning(test_log, 1), "");
  cw_log_close(&test_log);
  assert_int_equal(cw_log_warning_count(test_log), 0);
}

// Who runs into one knows that nothing of his is wrong.
static void a_fault_of_the_program_is_called_so(void **state) {
  char seen[TEXT_SIZE];
  int file = open_capture();
  capture_start(file);
  cw_log_open("mesh", NULL, 1, 0, &test_log);
  CW_FAIL(CW_ERR_FAULT, "a face has three cells");
  int code = cw_log_error(test_log, CW_ERR_FAULT);
  capture_end();
  cw_log_close(&test_log);
  read_capture(file, seen);
  assert_int_equal(code, 12);
  assert_string_equal(seen,
                      "cutwater-mesh: error: a face has three cells; this is a fault of the program: please report "
                      "it, with the case\n");
}

static void verbose_adds_debug_lines_and_the_trace(void **state) {
  char seen[TEXT_SIZE];
  int file = open_capture();
  capture_start(file);
  cw_log_open("mesh", NULL, 1, 1, &test_log);
  cw_log_debug(test_log, "shown");
  CW_FAIL(CW_ERR_MESH, "broken");
  cw_log_error(test_log, CW_ERR_MESH);
  capture_end();
  cw_log_close(&test_log);
  read_capture(file, seen);
  assert_non_null(strstr(seen, "cutwater-mesh: shown\ncutwater-mesh: error: broken\n"));
  assert_non_null(strstr(seen, "test_log.c:"));
}

static void quiet_ranks_keep_lines_for_others(void **state) {
  cw_log_open("mesh", NULL, 0, 1, &test_log);
  cw_log_keep(test_log, 1);
  cw_log_debug(test_log, "one");
  cw_log_debug(test_log, "two\nlines");
  cw_log_keep(test_log, 0);
  cw_log_debug(test_log, "not kept");
  assert_string_equal(cw_log_kept(test_log), "one\ntwo lines\n");
  cw_log_drop_kept(test_log);
  assert_string_equal(cw_log_kept(test_log), "");
  cw_log_open("mesh", NULL, 0, 0, &test_log);
  cw_log_keep(test_log, 1);
  cw_log_debug(test_log, "nobody asked");
  assert_string_equal(cw_log_kept(test_log), "");
  cw_log_close(&test_log);
}

static void quiet_ranks_print_errors_only(void **state) {
  char seen[TEXT_SIZE];
  int file = open_capture();
  unlink(copy_path);
  capture_start(file);
  cw_log_open("mesh", copy_path, 0, 1, &test_log);
  cw_log(test_log, "line");
  cw_log_debug(test_log, "line");
  cw_log_warn(test_log, "kept");
  cw_progress_start(test_log, "fill", 3, "regions");
  cw_progress(test_log, 3);
  cw_progress_end(test_log);
  cw_fail_clear();
  int code = cw_log_error(test_log, CW_ERR_MEMORY);
  capture_end();
  read_capture(file, seen);
  assert_string_equal(seen, "cutwater-mesh: error: out of memory\n"); // without a message: the code's text
  assert_int_equal(code, CW_ERR_MEMORY);
  assert_int_equal(cw_log_warning_count(test_log), 1);
  assert_int_not_equal(access(copy_path, F_OK), 0);
  assert_int_equal(cw_log_error(test_log, CW_OK), 0);
  file = open_capture();
  capture_start(file);
  code = cw_log_error(test_log, CW_ERR_RANK);
  capture_end();
  read_capture(file, seen);
  assert_string_equal(seen, ""); // the rank that failed has told
  assert_int_equal(code, CW_ERR_RANK);
  cw_log_close(&test_log);
}

static void copy_that_cannot_be_written_is_an_error(void **state) {
  assert_int_equal(cw_log_open("mesh", "/proc/none/mesh.log", 1, 0, &test_log), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "/proc/none"));
  cw_log_close(&test_log);
}

static void progress_off_a_terminal_prints_few_plain_lines(void **state) {
  char seen[TEXT_SIZE], copy[TEXT_SIZE];
  int file = open_capture();
  capture_start(file);
  cw_log_open("mesh", copy_path, 1, 0, &test_log);
  cw_progress_start(test_log, "fill", 2000, "regions");
  for (int i = 0; i <= 1000; ++i) cw_progress(test_log, i);
  usleep(5100 * 1000); // past the interval of plain lines
  for (int i = 1000; i <= 2000; ++i) cw_progress(test_log, i);
  cw_progress_end(test_log);
  cw_progress_end(test_log); // nothing more
  cw_progress(test_log, 5);
  capture_end();
  cw_log_close(&test_log);
  read_capture(file, seen);
  read_copy(copy);
  assert_null(strchr(seen, '\r'));
  assert_null(strchr(seen, '\033'));
  assert_int_equal(count(seen, "\n"), 2);
  // Half is done: the rate is 1000 a time spent, and as long again is left. The times depend on the machine.
  double spent = 0, rate = 0, left = 0;
  assert_int_equal(sscanf(seen,
                          "cutwater-mesh: fill: 1000 of 2000 regions in %lf s, %lf regions/s, 50 %%, %lf s left\n",
                          &spent, &rate, &left),
                   3);
  assert_true(spent >= 5.1 && fabs(left - spent) < 0.11);
  assert_true(fabs(rate - 1000 / spent) < 0.02 * rate);
  const char *last = strchr(seen, '\n') + 1;
  assert_int_equal(sscanf(last, "cutwater-mesh: fill: 2000 of 2000 regions in %lf s, %lf regions/s", &spent, &rate), 2);
  assert_true(spent >= 5.1 && fabs(rate - 2000 / spent) < 0.02 * rate);
  assert_null(strstr(last, "left"));
  assert_string_equal(copy, seen);
}

static void progress_without_total_counts(void **state) {
  char seen[TEXT_SIZE];
  int file = open_capture();
  capture_start(file);
  cw_log_open("mesh", NULL, 1, 0, &test_log);
  cw_progress_start(test_log, "walk", 0, "faces");
  cw_progress(test_log, 7);
  cw_progress_start(test_log, "next", 1, "faces"); // ends the one before
  cw_progress_end(test_log);
  capture_end();
  cw_log_close(&test_log);
  read_capture(file, seen);
  assert_int_equal(strncmp(seen, "cutwater-mesh: walk: 7 faces in ", 32), 0);
  assert_non_null(strstr(seen, "\ncutwater-mesh: next: 0 of 1 faces in "));
  assert_non_null(strstr(seen, " s, 0.00 faces/s\n"));
}

static void progress_on_a_terminal_rewrites_its_line(void **state) {
  char seen[TEXT_SIZE] = "", copy[TEXT_SIZE];
  int master = posix_openpt(O_RDWR | O_NOCTTY);
  if (master < 0 || grantpt(master) || unlockpt(master)) skip();
  int terminal = open(ptsname(master), O_RDWR | O_NOCTTY);
  assert_true(terminal >= 0);
  struct termios settings;
  tcgetattr(terminal, &settings);
  settings.c_oflag &= (tcflag_t)~OPOST; // bytes as they were written
  tcsetattr(terminal, TCSANOW, &settings);
  capture_start(terminal);
  cw_log_open("mesh", copy_path, 1, 0, &test_log);
  cw_progress_start(test_log, "fill", 10, "regions");
  double start = cw_seconds();
  cw_progress(test_log, 1);
  cw_progress(test_log, 2);
  int too_soon = cw_seconds() - start < 0.1; // for another line; a busy machine may stand still here
  cw_log(test_log, "event");
  usleep(120 * 1000);
  struct winsize window = {.ws_row = 24, .ws_col = 37};
  ioctl(terminal, TIOCSWINSZ, &window);
  cw_progress(test_log, 5);
  cw_progress_end(test_log);
  capture_end();
  cw_log_close(&test_log);
  close(terminal); // then reading ends with an error when all has been read
  size_t length = 0;
  for (ssize_t more; (more = read(master, seen + length, TEXT_SIZE - 1 - length)) > 0;) length += (size_t)more;
  assert_true(length > 0);
  seen[length] = '\0';
  close(master);
  const char *begin = "\r\033[Kcutwater-mesh: fill: 1 of 10 regions in ";
  assert_int_equal(strncmp(seen, begin, strlen(begin)), 0);
  if (too_soon) assert_null(strstr(seen, "fill: 2 of 10"));
  assert_non_null(strstr(seen, " left\r\033[Kcutwater-mesh: event\n\r\033[Kcutwater-mesh: fill: 5 of 10 "
                               "regions\r\033[Kcutwater-mesh: fill: 5 of 10"));
  assert_int_equal(count(seen, "\n"), 2); // the event and the last line
  assert_int_equal(seen[length - 1], '\n');
  read_copy(copy);
  assert_null(strchr(copy, '\r'));
  assert_int_equal(count(copy, "\n"), 2);
}

static void clock_and_memory_are_true(void **state) {
  struct timespec from, to;
  clock_gettime(CLOCK_MONOTONIC, &from);
  double start = cw_seconds();
  usleep(20000);
  double spent = cw_seconds() - start;
  clock_gettime(CLOCK_MONOTONIC, &to);
  assert_true(spent >= 0.02 && spent <= (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec));
  int64_t before = cw_peak_memory_bytes();
  size_t size = 64 << 20;
  volatile char *block = malloc(size);
  assert_non_null((void *)block);
  for (size_t i = 0; i < size; i += 4096) block[i] = 1;
  int64_t after = cw_peak_memory_bytes();
  free((void *)block);
  assert_true(before > 100 << 10);
  assert_true(after - before > 48 << 20 && after - before < 256 << 20);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lines_go_to_standard_error_and_to_the_copy),
      cmocka_unit_test(a_fault_of_the_program_is_called_so),
      cmocka_unit_test(verbose_adds_debug_lines_and_the_trace),
      cmocka_unit_test(quiet_ranks_keep_lines_for_others),
      cmocka_unit_test(quiet_ranks_print_errors_only),
      cmocka_unit_test(copy_that_cannot_be_written_is_an_error),
      cmocka_unit_test(progress_off_a_terminal_prints_few_plain_lines),
      cmocka_unit_test(progress_without_total_counts),
      cmocka_unit_test(progress_on_a_terminal_rewrites_its_line),
      cmocka_unit_test(clock_and_memory_are_true),
  };
  return cmocka_run_group_tests(tests, make_folder, remove_files);
}
