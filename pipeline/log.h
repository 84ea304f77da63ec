// SPDX-License-Identifier: AGPL-3.0-or-later
// What a person sees of a run: one line an event, one line that moves for long work, one line for an error.
// On a terminal progress rewrites its line; elsewhere it prints a plain line now and then. Only the rank that
// cw_log_open() was told to speak prints lines and progress; errors print from any rank. All goes to standard
// error. A stage opens one log and hands it on; NULL as a log is one that says nothing. One thread of a process uses
// it.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwLog CwLog;

// Starts the log of `stage` ("geometry", "mesh", ...). `log_path` (may be NULL) gets a copy of each line; its folder is
// there. `speaks` is false on all ranks but one. `verbose` adds the trace to errors and shows cw_log_debug lines.
// [in,out] log: NULL, or a log that is closed first, for a stage opens the log before it reads its command line, so
// that an error there bears the stage's name, and again when it knows the run's folder. The caller closes it, also
// after a failure.
CwStatus cw_log_open(const char *stage, const char *log_path, int speaks, int verbose, CwLog **log);
void cw_log_close(CwLog **log);

void cw_log(CwLog *log, const char *format, ...) __attribute__((format(printf, 2, 3)));
void cw_log_debug(CwLog *log, const char *format, ...) __attribute__((format(printf, 2, 3)));
void cw_log_warn(CwLog *log, const char *format, ...) __attribute__((format(printf, 2, 3)));

// On a rank that does not speak: whether cw_log_debug lines are kept from here on, for another rank to print; those
// kept, each with its newline; and forgets them.
void cw_log_keep(CwLog *log, int keeps);
const char *cw_log_kept(const CwLog *log);
void cw_log_drop_kept(CwLog *log);

// The warnings since cw_log_open (at most the first 1000, those of ranks that do not speak too), oldest
// first; "" past the last. They stand until cw_log_close. record.h writes them down.
size_t cw_log_warning_count(const CwLog *log);
const char *cw_log_warning(const CwLog *log, size_t index);

// Prints "cutwater-STAGE: error: MESSAGE" from the last failure, "cutwater: ..." where log is NULL; returns the exit
// status for main(). A rank that does not speak prints nothing for CW_ERR_RANK: the rank that failed has told.
int cw_log_error(CwLog *log, CwStatus status);

// Progress of a step: `done` of `total` in `unit`s ("regions", "faces"), with rate and time left.
// Start with cw_progress_start (a total of 0: not known), report as often as you like (it limits what it
// prints), end with cw_progress_end, which prints the last count and the rate.
void cw_progress_start(CwLog *log, const char *step, int64_t total, const char *unit);
void cw_progress(CwLog *log, int64_t done);
void cw_progress_end(CwLog *log);

// Seconds of a monotonic clock.
double cw_seconds(void);
// Seconds that this process has had of processors, in all its threads.
double cw_processor_seconds(void);

// Peak resident memory of this process in bytes.
int64_t cw_peak_memory_bytes(void);

#ifdef __cplusplus
}
#endif
