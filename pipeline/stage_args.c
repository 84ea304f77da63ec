// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/stage_args.h"

#include <errno.h>
#include <getopt.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"
#include "pipeline/case_check.h"
#include "pipeline/case_origin.h"
#include "pipeline/case_read.h"
#include "pipeline/case_schema.h"
#include "pipeline/case_sweep.h"
#include "pipeline/case_value.h"
#include "pipeline/stage_files.h"

// Codes past all characters, so that getopt's code of an unknown short option is never one of them.
enum { CASE = 256, RUN, CELLS, VERBOSE, VERSION, HELP, OPTION, SHARED_COUNT = OPTION - CASE };

static const struct option shared[SHARED_COUNT] = {
    {"case", required_argument, NULL, CASE},   {"run", required_argument, NULL, RUN},
    {"cells", required_argument, NULL, CELLS}, {"verbose", no_argument, NULL, VERBOSE},
    {"version", no_argument, NULL, VERSION},   {"help", no_argument, NULL, HELP},
};

static void print_help(const CwStageUsage *usage, FILE *out) {
  fprintf(out, "usage: cutwater-%s --case FILE --run DIR [OPTIONS]\n%s\n", usage->stage, usage->summary);
  fputs("  --case FILE     the case file, in YAML; docs/case-reference.md lists its keys with units, ranges and "
        "defaults\n"
        "  --run DIR       folder of the run; its files are read and written there, and RUN/log keeps what is said\n"
        "  --cells N       asked number of cells, as 500000, 500k or 2M; left out: mesh.cells of the case file\n",
        out);
  for (int i = 0; i < usage->option_count; ++i) {
    const CwStageOption *option = &usage->options[i];
    char left[64];
    snprintf(left, sizeof left, "--%s %s", option->name, option->argument ? option->argument : "");
    fprintf(out, "  %-15s %s\n", left, option->help);
  }
  fputs("  --verbose       more lines, and where in the program an error arose\n"
        "  --version       print the version and end\n"
        "  --help          print this and end\n",
        out);
}

CwStatus cw_count_read(const char *name, const char *text, int64_t least, int64_t most, int64_t *count) {
  CwStatus status = CW_OK;
  double number = NAN;
  char shown[CW_SHOWN_SIZE];
  const char *wrong = cw_count_text_read(text, &number);
  cw_show(text, shown);
  if (!wrong && (number < (double)least || number > (double)most)) wrong = "is out of range";
  CW_REQUIRE(!wrong, CW_ERR_USAGE, "%s: %s %s; allowed: %lld to %lld, as 500000, 500k or 2M", name, shown, wrong,
             (long long)least, (long long)most);
  *count = (int64_t)number;
done:
  return status;
}

static CwStatus read_cells(const char *text, int64_t *cells) {
  const CwCaseKey *key = &cw_case_keys[cw_case_key_find("mesh", "cells")];
  return cw_count_read("--cells", text, (int64_t)key->least, (int64_t)key->most, cells);
}

CwStatus cw_stage_args_read(int argc, char **argv, const CwStageUsage *usage, FILE *out, CwStageArgs *args) {
  CwStatus status = CW_OK;
  struct option options[SHARED_COUNT + CW_STAGE_OPTION_LIMIT + 1] = {{0}};
  memset(args, 0, sizeof *args);
  memcpy(options, shared, sizeof shared);
  for (int i = 0; i < usage->option_count && i < CW_STAGE_OPTION_LIMIT; ++i)
    options[SHARED_COUNT + i] = (struct option){
        usage->options[i].name, usage->options[i].argument ? required_argument : no_argument, NULL, OPTION + i};
  optind = 0; // begins anew, also when called twice
  opterr = 0;
  for (;;) {
    int code = getopt_long(argc, argv, ":", options, NULL);
    if (code == -1) break;
    switch (code) {
    case CASE:
      args->case_path = optarg;
      break;
    case RUN:
      args->run_path = optarg;
      break;
    case CELLS:
      CW_TRY(read_cells(optarg, &args->cells));
      break;
    case VERBOSE:
      args->verbose = 1;
      break;
    case VERSION:
      if (out) fprintf(out, "cutwater-%s %s\n", usage->stage, usage->version);
      args->finished = 1;
      goto done;
    case HELP:
      if (out) print_help(usage, out);
      args->finished = 1;
      goto done;
    case ':':
      status =
          CW_FAIL(CW_ERR_USAGE, "%s: its value is missing; see cutwater-%s --help", argv[optind - 1], usage->stage);
      goto done;
    case '?':
      // Of short options in one word getopt moves on only behind the last: the word is not always argv[optind
      // - 1].
      if (optopt > 0 && optopt < CASE)
        status = CW_FAIL(CW_ERR_USAGE, "-%c: no such option; see cutwater-%s --help", optopt, usage->stage);
      else
        status = CW_FAIL(CW_ERR_USAGE, "%s: no such option, or not so; see cutwater-%s --help", argv[optind - 1],
                         usage->stage);
      goto done;
    default:
      args->options[code - OPTION] = optarg ? optarg : "";
    }
  }
  CW_REQUIRE(optind == argc, CW_ERR_USAGE, "%s: an argument without an option; see cutwater-%s --help", argv[optind],
             usage->stage);
  CW_REQUIRE(args->case_path && args->case_path[0], CW_ERR_USAGE, "--case FILE is missing; see cutwater-%s --help",
             usage->stage);
  CW_REQUIRE(args->run_path && args->run_path[0], CW_ERR_USAGE, "--run DIR is missing; see cutwater-%s --help",
             usage->stage);
done:
  return status;
}

CwStatus cw_stage_path(const CwStageArgs *args, const char *name, char **path) {
  CwStatus status = CW_OK;
  size_t size = strlen(args->run_path) + strlen(name) + 2;
  CW_NEW(*path, size);
  snprintf(*path, size, "%s/%s", args->run_path, name);
done:
  return status;
}

// Makes RUN/STAGE, which must be writable, and removes the record of an earlier run and what killed ones have left.
static CwStatus claim_folder(const CwStageArgs *args, const char *stage) {
  CwStatus status = CW_OK;
  char *folder = NULL, *record = NULL, name[64];
  snprintf(name, sizeof name, "%s/record.json", stage);
  CW_TRY(cw_stage_path(args, stage, &folder));
  CW_TRY(cw_stage_path(args, name, &record));
  CW_TRY(cw_make_directory(folder));
  CW_REQUIRE(!access(folder, W_OK | X_OK), CW_ERR_IO, "%s: cannot be written: %s", folder, strerror(errno));
  CW_REQUIRE(!remove(record) || errno == ENOENT, CW_ERR_IO, "%s: cannot be removed: %s", record, strerror(errno));
  CW_TRY(cw_atomic_file_clear(folder));
done:
  free(folder);
  free(record);
  return status;
}

CwStatus cw_stage_begin(int argc, char **argv, const CwStageUsage *usage, int speaks, CwStageArgs *args,
                        CwCase *table) {
  CwStatus status = CW_OK;
  CwLog *log = NULL;
  char *log_path = NULL, name[64];
  signal(SIGXFSZ, SIG_IGN); // a write past the largest size of a file fails, and its one line says why
  memset(args, 0, sizeof *args);
  CW_TRY(cw_log_open(usage->stage, NULL, speaks, 0, &log));
  status = cw_stage_args_read(argc, argv, usage, speaks ? stdout : NULL, args);
  args->log = log;
  CW_TRY(status);
  if (args->finished) goto done;
  if (speaks)
    CW_TRY(cw_run_lock(args->run_path, usage->stage, args->log,
                       &args->lock)); // before the log of the stage that may have it
  snprintf(name, sizeof name, "log/%s.log", usage->stage);
  CW_TRY(cw_stage_path(args, name, &log_path));
  CW_TRY(cw_log_open(usage->stage, log_path, speaks, args->verbose, &args->log));
  CW_TRY(cw_case_read(args->case_path, table));
  if (args->cells) CW_TRY(cw_case_sweep(args->case_path, args->cells, table));
  CW_TRY(cw_case_check_parts(args->case_path, table));
  for (const char *const *stage = usage->reads; *stage; ++stage) {
    CW_TRY(cw_case_origin_check(table, args->run_path, *stage));
    if (speaks) CW_TRY(cw_stage_files_check(args->run_path, *stage));
  }
  if (speaks) CW_TRY(claim_folder(args, usage->stage));
  errno = 0; // what a library did without as it started is not what a later failure comes from (status.h)
done:
  free(log_path);
  return status;
}
