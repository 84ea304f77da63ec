// SPDX-License-Identifier: AGPL-3.0-or-later
// The command line that all stages share, and how each of them begins:
//
//   int main(int argc, char **argv) {
//     CwStatus status = CW_OK;
//     CwStageArgs args;
//     CwCase table;
//     CW_TRY(cw_stage_begin(argc, argv, &usage, 1, &args, &table));
//     if (!args.finished) CW_TRY(make_everything(&table, args.run_path));
//   done:;
//     int code = cw_log_error(args.log, status);
//     cw_log_close(&args.log);
//     return code;
//   }
#pragma once

#include <stdint.h>
#include <stdio.h>

#include "pipeline/case.h"
#include "pipeline/log.h"
#include "pipeline/run_lock.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_STAGE_OPTION_LIMIT = 8 };

// An option of one stage beside the shared ones.
typedef struct {
  const char *name;     // without the dashes
  const char *argument; // how the help calls its argument ("FORMAT"); NULL: a switch without one
  const char *help;
} CwStageOption;

// What a stage says of itself in its help.
typedef struct {
  const char *stage;            // "mesh": the program is cutwater-mesh
  const char *version;          // cw_version of version.h
  const char *summary;          // lines that follow the usage line, each ended by a newline
  const CwStageOption *options; // may be NULL
  int option_count;             // at most CW_STAGE_OPTION_LIMIT
  const char *reads[3];         // stages whose files it reads, NULL behind the last
} CwStageUsage;

// Strings point into argv.
typedef struct {
  const char *case_path;
  const char *run_path;
  int64_t cells; // 0: not given, the case file's number holds
  int verbose;
  int finished;   // --help or --version was asked and answered: nothing is left to do
  CwLog *log;     // [out] of cw_stage_begin, also where it fails; the caller closes it
  CwRunLock lock; // [out] of cw_stage_begin: that of the run folder, until the process ends
  // The value of each option of the stage, "" of a switch; NULL: not given.
  const char *options[CW_STAGE_OPTION_LIMIT];
} CwStageArgs;

// Reads `--case FILE --run DIR [--cells N] [--verbose] [--version] [--help]` and the stage's own options.
// Help and version go to `out` (NULL: nowhere, for the ranks that do not speak). Fails with CW_ERR_USAGE and
// one line.
CwStatus cw_stage_args_read(int argc, char **argv, const CwStageUsage *usage, FILE *out, CwStageArgs *args);

// Reads a count as people write it: 500000, 500k, 2M, 1.5M. Fails with CW_ERR_USAGE unless it is whole and
// from `least` to `most`; `name` stands in the message.
CwStatus cw_count_read(const char *name, const char *text, int64_t least, int64_t most, int64_t *count);

// Begins a stage: opens the log, reads the command line, takes the run folder (run_lock.h), lets the log copy its lines
// to RUN/log/STAGE.log, reads the case and puts --cells in its place, refuses files of earlier stages that were made of
// another case or are not as they were written (stage_files.h), makes RUN/STAGE, which must be writable, and removes
// the record of an earlier run of the stage itself, which must not vouch for the files of this one. Call with `speaks`
// false on all ranks but one, which waits for that one before it writes to the run.
CwStatus cw_stage_begin(int argc, char **argv, const CwStageUsage *usage, int speaks, CwStageArgs *args, CwCase *table);

// "RUN/NAME" in a new string to be freed, such as "RUN/mesh/manifest.json".
CwStatus cw_stage_path(const CwStageArgs *args, const char *name, char **path);

#ifdef __cplusplus
}
#endif
