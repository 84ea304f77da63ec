// SPDX-License-Identifier: AGPL-3.0-or-later
// Distances from the sources of the smoothing along edges, with the source that is nearest: Dijkstra's algorithm in
// blocks along the curve, each with as much around it as can matter. A wave ends REACH thicknesses of its source from
// there, and every vertex belongs to the wave that comes first. Let R be the longest way of the waves that can come to
// a block. A place at the distance D from the block, which some wave has come to after a way d, matters to none that
// comes to the block where d + D > R: neither that wave nor one that comes there later has way left to go on to the
// block. So a block without those places has the same bits as if all were one.
#include <math.h>
#include <stdlib.h>

#include "mesher/common/box.h"
#include "mesher/common/vec.h"
#include "mesher/common/vertex_heap.h"
#include "mesher/common/vertex_map.h"
#include "mesher/layers/direction_smoothing_work.h"
#include "mesher/policy.h"

enum { BLOCKS = 256, LEAST_BLOCK = 2048 }; // blocks at most; vertices of one at least
static const double ROUNDING = 1e-9;       // of a length summed along edges

typedef struct {
  const CwSmoothing *smoothing;
  int32_t block; // vertices of each but the last
} Blocks;

// A vertex and the wave that it belongs to.
typedef struct {
  double distance;
  int32_t vertex, source; // of the wave, its place in the list
} Reached;

// The layer top of the distances in a block.
typedef struct {
  const CwSmoothing *smoothing;
  int32_t count, capacity;
  Reached *reached;  // those that a wave has come to
  CwVertexMap place; // among these, from 1
  CwBox box;         // of the block
  double most;       // longest way of a wave that can come to it
  CwHeap heap;
} Spread;

static double distance_to(const CwBox *box, const double x[3]) {
  double d[3];
  for (int k = 0; k < 3; k++) {
    d[k] = x[k] < box->low[k] ? box->low[k] - x[k] : x[k] > box->high[k] ? x[k] - box->high[k] : 0;
  }
  return cw_norm(d);
}

static CwStatus reach(Spread *spread, Reached made) {
  CwStatus status = CW_OK;
  int32_t place = cw_vertex_map_get(&spread->place, made.vertex);
  if (!place) {
    CW_GROW(spread->reached, spread->capacity, spread->count + 1);
    place = ++spread->count;
    CW_TRY(cw_vertex_map_set(&spread->place, made.vertex, place));
  }
  spread->reached[place - 1] = made;
done:
  return status;
}

static double distance_of(const Spread *spread, int32_t v) {
  int32_t place = cw_vertex_map_get(&spread->place, v);
  return place ? spread->reached[place - 1].distance : INFINITY;
}

// A vertex has its distance: offers its neighbours a way through it.
static CwStatus settle(Spread *spread, Reached at) {
  CwStatus status = CW_OK;
  const CwSmoothing *smoothing = spread->smoothing;
  const CwLayerWork *work = smoothing->work;
  int32_t v = at.vertex;
  double most = cw_policy.smoothing_reach * smoothing->source[at.source].thickness;
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    int32_t w = work->near[k];
    double before = distance_of(spread, w);
    if (before <= at.distance) continue;
    double distance = at.distance + cw_distance(work->in->x[v], work->in->x[w]);
    if (distance >= before || distance > most) continue;
    if (distance + distance_to(&spread->box, work->in->x[w]) > spread->most) continue;
    CW_TRY(reach(spread, (Reached){distance, w, at.source}));
    CW_TRY(cw_heap_push(&spread->heap, distance, w));
  }
done:
  return status;
}

// Sets the box of a block's vertices and the longest way of a wave that can come to it: 0 where none can.
static void measure(Spread *spread, int32_t first, int32_t last) {
  const CwSmoothing *smoothing = spread->smoothing;
  const CwLayerWork *work = smoothing->work;
  CwBox *box = &spread->box;
  *box = cw_box_empty();
  for (int32_t i = first; i < last; i++) cw_box_add_point(box, work->in->x[work->curve[i]]);
  for (int32_t i = 0; i < smoothing->source_count; i++) {
    double way = (1 + ROUNDING) * cw_policy.smoothing_reach * smoothing->source[i].thickness;
    if (way > spread->most && distance_to(box, work->in->x[smoothing->source[i].vertex]) <= way) spread->most = way;
  }
}

static CwStatus find_block(void *context, int32_t block, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Blocks *blocks = context;
  const CwSmoothing *smoothing = blocks->smoothing;
  const CwLayerWork *work = smoothing->work;
  int32_t first = block * blocks->block, left = work->n - first;
  int32_t last = left < blocks->block ? work->n : first + blocks->block;
  Spread spread = {.smoothing = smoothing};
  CwSmoothingReach *made = NULL;
  CW_NEW(made, last - first);
  measure(&spread, first, last);
  for (int32_t i = 0; spread.most > 0 && i < smoothing->source_count; i++) {
    int32_t v = smoothing->source[i].vertex;
    if (distance_to(&spread.box, work->in->x[v]) > spread.most) continue;
    CW_TRY(reach(&spread, (Reached){0, v, i}));
  }
  int32_t sources = spread.count;
  for (int32_t i = 0; i < sources; i++) CW_TRY(settle(&spread, spread.reached[i])); // nothing is nearer
  while (spread.heap.count) {
    CwHeapItem least = cw_heap_pop(&spread.heap);
    const Reached at = spread.reached[cw_vertex_map_get(&spread.place, least.v) - 1];
    if (least.key == at.distance) CW_TRY(settle(&spread, at)); // else a nearer way was found
  }
  for (int32_t i = first; i < last; i++) {
    int32_t place = cw_vertex_map_get(&spread.place, work->curve[i]);
    made[i - first] = (CwSmoothingReach){INFINITY, -1};
    if (place)
      made[i - first] = (CwSmoothingReach){spread.reached[place - 1].distance, spread.reached[place - 1].source};
  }
  *size = (int64_t)(last - first) * (int64_t)sizeof *made;
  *bytes = made;
  made = NULL;
done:
  free(spread.reached);
  cw_vertex_map_free(&spread.place);
  cw_heap_free(&spread.heap);
  free(made);
  return status;
}

CwStatus cw_smoothing_find_reach(CwSmoothing *smoothing) {
  CwStatus status = CW_OK;
  int32_t n = smoothing->work->n, block = n / BLOCKS + 1 > LEAST_BLOCK ? n / BLOCKS + 1 : LEAST_BLOCK;
  int32_t count = (n + block - 1) / block;
  Blocks blocks = {.smoothing = smoothing, .block = block};
  CwTaskResults results = {0};
  CwSchedule schedule = {.step = "layers: reach of smoothing", .count = count, .run = find_block, .context = &blocks};
  CW_TRY(cw_schedule_gather(smoothing->work->in->context, &schedule, &results));
  for (int32_t b = 0; b < count; b++) {
    const CwSmoothingReach *made = results.bytes[b];
    int32_t first = b * block, last = n - first < block ? n : first + block;
    for (int32_t i = first; i < last; i++) smoothing->reach[smoothing->work->curve[i]] = made[i - first];
  }
done:
  cw_task_results_free(&results);
  return status;
}
