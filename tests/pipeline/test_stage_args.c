// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/log.h"
#include "pipeline/run_lock.h"
#include "pipeline/stage_args.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static const CwStageOption own_options[] = {
    {"format", "NAME", "cgns or openfoam"},
    {"whole", NULL, "all passages"},
};
static const CwStageUsage usage = {
    .stage = "export",
    .version = "1.2+3",
    .summary = "Writes the solver's files.\n",
    .options = own_options,
    .option_count = 2,
};

// Splits a command line at its blanks and reads it.
static CwStatus read_line(const char *line, FILE *out, CwStageArgs *args) {
  static char words[500];
  char *argv[32];
  int argc = 0;
  snprintf(words, sizeof words, "cutwater-export %s", line);
  for (char *word = strtok(words, " "); word; word = strtok(NULL, " ")) argv[argc++] = word;
  argv[argc] = NULL;
  return cw_stage_args_read(argc, argv, &usage, out, args);
}

static void options_are_read(void **state) {
  CwStageArgs args;
  assert_int_equal(read_line("--case c.yaml --run=r", NULL, &args), CW_OK);
  assert_string_equal(args.case_path, "c.yaml");
  assert_string_equal(args.run_path, "r");
  assert_int_equal(args.cells, 0);
  assert_false(args.verbose);
  assert_false(args.finished);
  assert_null(args.options[0]);
  assert_null(args.options[1]);
  assert_int_equal(read_line("--whole --verbose --cells 2M --run r --format cgns --case c", NULL, &args), CW_OK);
  assert_int_equal(args.cells, 2000000);
  assert_true(args.verbose);
  assert_string_equal(args.options[0], "cgns");
  assert_string_equal(args.options[1], "");
  char *path = NULL;
  assert_int_equal(cw_stage_path(&args, "mesh/manifest.json", &path), CW_OK);
  assert_string_equal(path, "r/mesh/manifest.json");
  free(path);
}

static void counts_are_read(void **state) {
  static const struct {
    const char *text;
    int64_t count; // 0: refused
  } counts[] = {
      {"500000", 500000},
      {"500k", 500000},
      {"500K", 500000},
      {"2M", 2000000},
      {"145M", 145000000},
      {"1.1M", 1100000},
      {"2.3k", 2300},
      {"2G", 2000000000},
      {"1e6", 1000000},
      {"", 0},
      {"k", 0},
      {"5kk", 0},
      {"-5k", 0},
      {"+5k", 0},
      {"2m", 0},
      {"0x5000", 0},
      {"1000.5", 0},
      {"1.0001k", 0},
      {"nan", 0},
      {"inf", 0},
      {"1e99", 0},
      {"999", 0},
      {"2000000001", 0},
      {" 5k", 0},
      {"5 k", 0},
      {"99999999999999999999999999999999999999999", 0},
  };
  for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
    int64_t count = 0;
    CwStatus status = cw_count_read("--cells", counts[i].text, 1000, 2000000000, &count);
    if (count != counts[i].count) fail_msg("%s is read as %lld", counts[i].text, (long long)count);
    assert_int_equal(status, counts[i].count ? CW_OK : CW_ERR_USAGE);
  }
}

static void wrong_use_is_told(void **state) {
  static const struct {
    const char *line, *message;
  } wrong[] = {
      {"", "--case FILE is missing; see cutwater-export --help"},
      {"--case c", "--run DIR is missing; see cutwater-export --help"},
      {"--case= --run r", "--case FILE is missing; see cutwater-export --help"},
      {"--case c --run r more", "more: an argument without an option; see cutwater-export --help"},
      {"--case c --run", "--run: its value is missing; see cutwater-export --help"},
      {"--case c --ruin r", "--ruin: no such option, or not so; see cutwater-export --help"},
      {"--case c --verbose=2", "--verbose=2: no such option, or not so; see cutwater-export --help"},
      {"-x --case c --run r", "-x: no such option; see cutwater-export --help"},
      {"-vV", "-v: no such option; see cutwater-export --help"},
      {"--case c --run r --cells 5k",
       "--cells: 5k is out of range; allowed: 10000 to 2000000000, as 500000, 500k or 2M"},
      {"--case c --run r --cells many",
       "--cells: many is not a whole number; allowed: 10000 to 2000000000, as 500000, 500k or 2M"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    CwStageArgs args;
    assert_int_equal(read_line(wrong[i].line, NULL, &args), CW_ERR_USAGE);
    assert_string_equal(cw_fail_message(), wrong[i].message);
  }
}

static void help_and_version_are_answered(void **state) {
  char *text = NULL;
  size_t size = 0;
  CwStageArgs args;
  FILE *out = open_memstream(&text, &size);
  assert_int_equal(read_line("--version", out, &args), CW_OK);
  assert_true(args.finished);
  fflush(out);
  assert_string_equal(text, "cutwater-export 1.2+3\n");
  assert_int_equal(read_line("--help", out, &args), CW_OK);
  assert_true(args.finished);
  fclose(out);
  assert_non_null(strstr(text, "usage: cutwater-export --case FILE --run DIR [OPTIONS]\nWrites the solver's files.\n"));
  const char *const names[] = {"--case FILE ", "--run DIR ", "--cells N ", "--format NAME ",
                               "--whole ",     "--verbose ", "--version ", "--help "};
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) assert_non_null(strstr(text, names[i]));
  free(text);
  assert_int_equal(read_line("--help", NULL, &args), CW_OK); // a rank that does not speak
  assert_true(args.finished);
}

static void stage_begins_with_log_and_case(void **state) {
  const char *const record = in_test_folder("export/record.json");
  char *argv[] = {"cutwater-export",
                  "--case",
                  CUTWATER_SOURCE_DIR "/cases/paper/case.yaml",
                  "--run",
                  test_folder,
                  "--cells",
                  "300k",
                  NULL};
  CwStageArgs args;
  CwCase table;
  // The record of an earlier run goes; the folder is made where there is none.
  for (int run = 0; run < 2; ++run) {
    assert_int_equal(cw_stage_begin(7, argv, &usage, 1, &args, &table), CW_OK);
    cw_log_close(&args.log);
    cw_run_unlock(&args.lock);
    assert_int_equal(access(record, F_OK), -1);
    FILE *file = fopen(record, "w");
    assert_non_null(file);
    fclose(file);
  }
  assert_string_equal(table.name, "paper");
  assert_int_equal(table.mesh.cells, 300000);
  assert_int_equal(unlink(in_test_folder("log/export.log")), 0);
  // Parts are held against the command line's number of cells, not the case's million.
  const char *parts = in_test_folder("parts.yaml");
  FILE *file = fopen(parts, "w");
  assert_non_null(file);
  fprintf(file, "name: a\noperating_point: {flow_rate_m3_per_h: 25, head_m: 10, speed_rpm: 1450}\n"
                "openfoam: {processors: 99999}\n");
  assert_int_equal(fclose(file), 0);
  argv[2] = (char *)parts;
  for (int few = 0; few < 2; ++few) {
    argv[6] = few ? "50k" : "300k";
    assert_int_equal(cw_stage_begin(7, argv, &usage, 1, &args, &table), few ? CW_ERR_INPUT : CW_OK);
    cw_log_close(&args.log);
    cw_run_unlock(&args.lock);
  }
  assert_non_null(strstr(cw_fail_message(), "99999 parts of 50000 cells"));
  // A case that is not there ends the stage with the message of the reader.
  argv[2] = "/nowhere.yaml";
  assert_int_equal(cw_stage_begin(7, argv, &usage, 1, &args, &table), CW_ERR_IO);
  cw_log_close(&args.log);
  assert_int_equal(strncmp(cw_fail_message(), "/nowhere.yaml: ", 15), 0);
  assert_int_equal(unlink(in_test_folder("log/export.log")), 0);
  cw_run_unlock(&args.lock);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(options_are_read),
      cmocka_unit_test(counts_are_read),
      cmocka_unit_test(wrong_use_is_told),
      cmocka_unit_test(help_and_version_are_answered),
      cmocka_unit_test(stage_begins_with_log_and_case),
  };
  return cmocka_run_group_tests(tests, make_test_folder, clear_test_folder);
}
