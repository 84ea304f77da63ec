// SPDX-License-Identifier: AGPL-3.0-or-later
// What a stage is handed beside its products: the ranks that it runs on, and where it says what it does. A function
// that takes a context is collective: all ranks of its team call it, in the same order. It keeps none of it; who made
// team, profiler and log frees them.
#pragma once

#include <stddef.h>

#include "pipeline/log.h"

typedef struct CwTeam CwTeam;         // ranks.h
typedef struct CwProfiler CwProfiler; // profiler.h

// [in] everywhere. A context of NULL, or zeroed: this rank alone, nothing is said or measured.
typedef struct {
  const CwTeam *team;   // the ranks that work together: all, or those of a group (groups.h)
  CwProfiler *profiler; // of this rank
  CwLog *log;           // of this rank
} CwContext;

static inline CwLog *cw_log_of(const CwContext *context) {
  return context ? context->log : NULL;
}
