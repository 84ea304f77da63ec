// SPDX-License-Identifier: AGPL-3.0-or-later
// One line where a run under mpirun is stopped: when a rank is killed, or mpirun itself is told to stop, all ranks get
// SIGTERM and would end without a word. A signal belongs to the process and hands its handler nothing: what is watched
// is kept once a process, unlike the rest of a stage's state.
#pragma once

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// From here on SIGTERM ends this process with exit status 143, and one of the ranks says so: the first to remove
// RUN/log/STAGE.running, which the rank that `makes` it makes here. Where it cannot be made the run goes on without.
// A rank on another host than that one speaks only where none of that host does: its own may be cut off, its line lost.
// CW_ERR_MEMORY.
CwStatus cw_stop_watch(const char *run, const char *stage, int makes);

// Whether this process is the one to say why the run ends: 1 for one of all ranks, and where nobody watches.
int cw_stop_claim(void);

// The end of the run: the rank that made the file removes it; SIGTERM does what it did before.
void cw_stop_end(void);

#ifdef __cplusplus
}
#endif
