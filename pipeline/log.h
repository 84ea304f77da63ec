// SPDX-License-Identifier: AGPL-3.0-or-later
// What a person sees of a run: one line an event, one line that moves for long work, one line for an error.
// On a terminal progress rewrites its line; elsewhere it prints a plain line now and then. Only the rank that
// cw_log_open() was told to speak prints lines and progress; errors print from any rank.
#ifndef CUTWATER_PIPELINE_LOG_H
#define CUTWATER_PIPELINE_LOG_H

#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Starts the log of `stage` ("geometry", "mesh", ...). `log_path` (may be NULL) gets a copy of each line.
// `speaks` is false on all ranks but one. `verbose` adds the trace to errors and shows cw_log_debug lines.
CwStatus cw_log_open(const char *stage, const char *log_path, int speaks, int verbose);
void cw_log_close(void);

void cw_log(const char *format, ...) __attribute__((format(printf, 1, 2)));
void cw_log_debug(const char *format, ...) __attribute__((format(printf, 1, 2)));
void cw_log_warn(const char *format, ...) __attribute__((format(printf, 1, 2)));

// Prints "cutwater-STAGE: error: MESSAGE" from the last failure; returns the exit status for main().
int cw_log_error(CwStatus status);

// Progress of a step: `done` of `total` in `unit`s ("regions", "faces"), with rate and time left.
// Start with cw_progress_start, report as often as you like (it limits what it prints), end with cw_progress_end.
void cw_progress_start(const char *step, int64_t total, const char *unit);
void cw_progress(int64_t done);
void cw_progress_end(void);

// Seconds of a monotonic clock.
double cw_seconds(void);

// Peak resident memory of this process in bytes.
int64_t cw_peak_memory_bytes(void);

#ifdef __cplusplus
}
#endif
#endif
