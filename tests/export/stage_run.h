// SPDX-License-Identifier: AGPL-3.0-or-later
// Runs the exporter, and the programs that judge its files, in folders of their own.
#pragma once

#include "tests/export/synthetic_run.h"

enum { STAGE_OUTPUT_SIZE = 1 << 18, STAGE_PATH_SIZE = 400 };

// Writes the meshed toy pump into `run` of a test's folder. Returns 0, or -1.
int stage_run_make(const char *folder, const SyntheticPump *pump);

// Runs a shell command (printf style) and keeps what it prints on both streams, cut to STAGE_OUTPUT_SIZE.
// Returns its exit status.
int stage_shell(char *output, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Runs the exporter on `run` with so many ranks, on the paper's case. Returns its exit status.
int stage_export(const char *run, int ranks, char *output);

// Writes it, exports it on two ranks, and opens pump.cgns as *file. Returns 0, or another number.
int stage_cgns_open(const char *folder, const SyntheticPump *pump, char *output, int *file);

// The same as stage_export on the paper's case with `more` behind it, keys of sections that the paper's does not have.
int stage_export_with(const char *run, int ranks, const char *more, char *output);

// Makes the y+ that the layers of `run` were made for, 30 as it is written, another one on all walls, or on the one
// that is called `wall` (NULL: all); "null": the flow along it is laminar. Returns 0, or another number.
int stage_walls_set(const char *run, const char *wall, const char *y_plus, char *output);

// Fails the test where a program cannot be called: what it would have judged has not been judged.
void stage_need_program(const char *name);
