// SPDX-License-Identifier: AGPL-3.0-or-later
// The tuned numbers of the mesher: each room lists its own as X(type, name, value, unit, meaning) in ROOM_policy.h. In
// normal builds they are constants that the compiler folds. With -DCUTWATER_EXPERIMENT=ON they are variables, and a
// file named by $CUTWATER_POLICY changes some: lines `name value`, # begins a comment. Another policy gives regions
// another fingerprint.
#ifndef CUTWATER_MESHER_POLICY_H
#define CUTWATER_MESHER_POLICY_H

#include <stdint.h>
#include <stdio.h>

#include "pipeline/status.h"

#include "mesher/fill/fill_policy.h"

#ifdef __cplusplus
extern "C" {
#endif

#define CW_POLICY_FIELD(type, name, value, unit, meaning) type name;
#define CW_POLICY_VALUE(type, name, value, unit, meaning) .name = (value),

// One field for each number of the list, whose meaning stands there.
typedef struct {
  CW_FILL_POLICY(CW_POLICY_FIELD)
} CwFillPolicy;

#ifdef CUTWATER_EXPERIMENT
extern CwFillPolicy cw_fill_policy;
#else
static const CwFillPolicy cw_fill_policy = {CW_FILL_POLICY(CW_POLICY_VALUE)};
#endif

// Reads the file of $CUTWATER_POLICY, before any number is used; nothing where that is not set. CW_ERR_INPUT names the
// line of an unknown name or a value that is no number, or the build that cannot read any.
CwStatus cw_policy_start(void);

// Changes numbers by the lines of an open file; `path` is for messages.
CwStatus cw_policy_read(FILE *file, const char *path, CwFillPolicy *policy);

#ifdef __cplusplus
}
#endif
#endif
