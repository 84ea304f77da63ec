// SPDX-License-Identifier: AGPL-3.0-or-later
// One stage at a time works in a run folder. The lock is the kernel's, on RUN/log/run.lock, so that it dies with its
// process, however that ends; the file stays and names the last one that held it. Of the kinds of locks it is that of
// POSIX (fcntl): a process that the holder starts does not inherit it, and NFS keeps it on the server, where other
// hosts see it. Where a file system has no locks the stage goes on with a warning.
#pragma once

#include "pipeline/log.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Zeroed: none is held. A process loses the lock when it closes the lock's file anywhere.
typedef struct {
  int held, file;
} CwRunLock;

// Takes the run folder for `stage` until this process ends or cw_run_unlock; RUN and RUN/log are made where they are
// missing. Of a stage of several ranks one calls it. CW_ERR_IO, naming stage, host and process, where another one has
// it. [in,out] lock: one that it holds is given back first. log: for a warning.
CwStatus cw_run_lock(const char *run, const char *stage, CwLog *log, CwRunLock *lock);
void cw_run_unlock(CwRunLock *lock);

#ifdef __cplusplus
}
#endif
