// SPDX-License-Identifier: AGPL-3.0-or-later
// The tuned numbers of the mesher, which policy_table.h lists. In normal builds they are constants that the compiler
// folds. With -DCUTWATER_EXPERIMENT=ON they are variables, and a file named by $CUTWATER_POLICY changes some: lines
// `name value`, # begins a comment.
#pragma once

#include <stdint.h>
#include <stdio.h>

#include "pipeline/hash.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// One field for each number of the table, where its meaning stands.
typedef struct {
#define NUMBER(type, name, value, off, unit, meaning) type name;
#include "mesher/policy_table.h"
#undef NUMBER
} CwPolicy;

#ifdef CUTWATER_EXPERIMENT
extern CwPolicy cw_policy;
#else
#define NUMBER(type, name, value, off, unit, meaning) .name = (value),
static const CwPolicy cw_policy = {
#include "mesher/policy_table.h"
};
#undef NUMBER
#endif

// Reads the file of $CUTWATER_POLICY, before any number is used; nothing where that is not set. CW_ERR_INPUT names the
// line of an unknown name or a value that is no number, or the build that cannot read any.
CwStatus cw_policy_start(void);

// Changes numbers by the lines of an open file; `path` is for messages.
CwStatus cw_policy_read(FILE *file, const char *path, CwPolicy *policy);

// Adds to a fingerprint what the program makes differ: its sources and, where they are variables, these numbers.
void cw_policy_hash(CwHash *hash);

#ifdef __cplusplus
}
#endif
