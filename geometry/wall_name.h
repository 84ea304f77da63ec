// SPDX-License-Identifier: AGPL-3.0-or-later
// What the names that this program gives walls mean. They mean the same where a CAD file or a case gives them.
#pragma once

#include "pipeline/model.h"

// Where the water runs along a wall.
typedef enum {
  CW_ALONG_BLADE, // blades, hub and shroud
  CW_ALONG_TRAILING_EDGE,
  CW_ALONG_NECK, // between interface and spiral
  CW_ALONG_VOLUTE,
  CW_ALONG_SUCTION,
  CW_ALONG_DIFFUSER,
  CW_ALONG_DISCHARGE,
  CW_ALONG_COUNT
} CwAlong;

typedef struct {
  const char *name;
  CwAlong along;
  CwPatchGroup group, size;
  int turns; // 0, 1; -1: as its domain
  int monitored;
} CwWallName;

// NULL: no name of these. Only whole names count: hub_seal_pipe is none of them.
const CwWallName *cw_wall_name(const char *name);
