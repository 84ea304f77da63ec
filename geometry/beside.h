// SPDX-License-Identifier: AGPL-3.0-or-later
// Work in a process of its own, beside what the caller does meanwhile: files that a library writes on one core.
#pragma once

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwBeside CwBeside;

// Starts run(given), which only reads what the caller has and leaves nothing but files. Where no process can be had it
// has run when this returns. The process dies with the caller's, which must be the only thread of its own. [out]
// beside: to be ended or dropped.
CwStatus cw_beside_start(CwStatus (*run)(const void *given), const void *given, CwBeside **beside);

// Waits for it: its status with its message. CW_ERR_LIBRARY, told with `what`, where a signal ended it. CW_OK for NULL.
CwStatus cw_beside_end(CwBeside **beside, const char *what);

// Waits for it where something else has failed: the message stays that of the caller.
void cw_beside_drop(CwBeside **beside);

#ifdef __cplusplus
}
#endif
