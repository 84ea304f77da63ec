// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/vertex_heap.h"

#include <stdlib.h>
#include <string.h>

static int before(CwHeapItem a, CwHeapItem b) {
  return a.key < b.key || (a.key == b.key && a.v < b.v);
}

CwStatus cw_heap_push(CwHeap *heap, double key, int32_t v) {
  CwStatus status = CW_OK;
  CW_GROW(heap->item, heap->capacity, heap->count + 1);
  CwHeapItem new = {key, v};
  size_t i = heap->count++;
  for (; i > 0 && before(new, heap->item[(i - 1) / 2]); i = (i - 1) / 2) heap->item[i] = heap->item[(i - 1) / 2];
  heap->item[i] = new;
done:
  return status;
}

CwHeapItem cw_heap_pop(CwHeap *heap) {
  CwHeapItem top = heap->item[0], last = heap->item[--heap->count];
  size_t i = 0;
  for (;;) {
    size_t child = 2 * i + 1;
    if (child >= heap->count) break;
    if (child + 1 < heap->count && before(heap->item[child + 1], heap->item[child])) child++;
    if (!before(heap->item[child], last)) break;
    heap->item[i] = heap->item[child];
    i = child;
  }
  heap->item[i] = last;
  return top;
}

void cw_heap_free(CwHeap *heap) {
  free(heap->item);
  memset(heap, 0, sizeof *heap);
}
