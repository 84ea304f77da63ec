// SPDX-License-Identifier: AGPL-3.0-or-later
// Text that grows, for blocks of which a case has as many as its mesh has domains, patches and interfaces.
#ifndef CUTWATER_EXPORT_BLOCKS_H
#define CUTWATER_EXPORT_BLOCKS_H

#include <stdio.h>

#include "export/template.h"

// Zeroed: nothing open.
typedef struct {
  char *text;
  size_t size;
  FILE *out; // anything may be printed here
} CwBlocks;

CwStatus cw_blocks_open(CwBlocks *blocks);
// Adds the built-in file `name`, without its first line (the licence), filled with the values.
CwStatus cw_blocks_add(CwBlocks *blocks, const char *name, const CwValues *values);
// Sets `key` to the text, unless it is NULL, and frees it. Fine where nothing is open.
CwStatus cw_blocks_close(CwBlocks *blocks, const char *key, CwValues *values);

#endif
