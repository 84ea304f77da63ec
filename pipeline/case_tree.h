// SPDX-License-Identifier: AGPL-3.0-or-later
// A section of the case file whose keys are free names: scalars, lists and mappings as a tree, each with its place.
#pragma once

#include "pipeline/case_event.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { CW_NODE_SCALAR, CW_NODE_LIST, CW_NODE_MAP } CwNodeType;

typedef struct CwCaseNode {
  CwNodeType type;
  CwEventPlace place;
  char *path; // "cad.domains.rotor", for messages
  char *key;  // of a member of a mapping, else NULL
  char *text; // of a scalar
  int count;
  struct CwCaseNode *item; // of a list or a mapping, in the order of the file
} CwCaseNode;

// Reads the value that begins with `first`, which has been taken from the stream. CW_ERR_INPUT with FILE:LINE:COLUMN
// where a key is given twice, a scalar is longer than 255 bytes or has a tag, or lists stand deeper than 6. Free also
// after a failure; zeroed `node` on entry.
CwStatus cw_case_tree_read(CwEventStream *stream, const char *path, const CwEvent *first, CwCaseNode *node);
void cw_case_tree_free(CwCaseNode *node);

// The member called `key` of a mapping, or NULL.
const CwCaseNode *cw_case_tree_find(const CwCaseNode *map, const char *key);

#ifdef __cplusplus
}
#endif
