// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/thickness_gradation.h"

#include <stdlib.h>

#include "mesher/common/vertex_heap.h"
#include "mesher/parallel/parallel_for.h"

// Whether a vertex beside v is too high.
static CwStatus find_steep(void *context, int32_t v, void *out) {
  const CwGradation *of = context;
  uint8_t *steep = out;
  for (int32_t i = of->start[v]; i < of->start[v + 1] && !*steep; i++) {
    for (int k = 0; k < 3; k++) {
      int32_t w = of->corner[of->triangle[i]][k];
      *steep |= of->thickness[w] > of->thickness[v] && of->thickness[w] > of->most(of->given, v, w);
    }
  }
  return CW_OK;
}

// Lowers what stands too high beside v.
static CwStatus settle(const CwGradation *of, int32_t v, CwHeap *heap) {
  CwStatus status = CW_OK;
  for (int32_t i = of->start[v]; i < of->start[v + 1]; i++) {
    for (int k = 0; k < 3; k++) {
      int32_t w = of->corner[of->triangle[i]][k];
      if (of->thickness[w] <= of->thickness[v]) continue;
      double most = of->most(of->given, v, w);
      if (of->thickness[w] <= most) continue;
      of->thickness[w] = most;
      if (of->graded) of->graded[w] = 1;
      CW_TRY(cw_heap_push(heap, most, w));
    }
  }
done:
  return status;
}

CwStatus cw_grade_thickness(const CwGradation *gradation, const uint8_t *lowered) {
  CwStatus status = CW_OK;
  CwHeap heap = {0};
  uint8_t *steep = NULL;
  CW_NEW(steep, gradation->count);
  if (lowered) { // few
    for (int32_t v = 0; v < gradation->count; v++) {
      if (lowered[v]) find_steep((void *)gradation, v, &steep[v]);
    }
  } else {
    CW_TRY(cw_parallel_for(gradation->context, gradation->step, gradation->count, sizeof *steep, find_steep,
                           (void *)gradation, steep));
  }
  for (int32_t v = 0; v < gradation->count; v++) {
    if (steep[v]) CW_TRY(cw_heap_push(&heap, gradation->thickness[v], v));
  }
  while (heap.count) {
    CwHeapItem lowest = cw_heap_pop(&heap);
    if (lowest.key > gradation->thickness[lowest.v]) continue; // lowered since
    CW_TRY(settle(gradation, lowest.v, &heap));
  }
done:
  cw_heap_free(&heap);
  free(steep);
  return status;
}
