// SPDX-License-Identifier: AGPL-3.0-or-later
// Vertices by key, smallest first, ties by number.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "pipeline/status.h"

typedef struct {
  double key;
  int32_t v;
} CwHeapItem;

typedef struct {
  CwHeapItem *item;
  size_t count, capacity;
} CwHeap; // zeroed before

CwStatus cw_heap_push(CwHeap *heap, double key, int32_t v);
CwHeapItem cw_heap_pop(CwHeap *heap); // of one that is not empty
void cw_heap_free(CwHeap *heap);
