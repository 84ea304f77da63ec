// SPDX-License-Identifier: AGPL-3.0-or-later
// Beside a concave crease the column of the crease leans along both walls by about t cot(alpha/2); where the
// mesh is finer than
// that its neighbours would be overrun. The lean is spread over them as the solution of a screened Poisson
// problem
//   U - L^2 laplace U = 0 on the wall, U = column of the crease on the crease, U tangential elsewhere,
// which leaves the normal height as asked. Columns that a guide tilts (an oblique dividing plane) are
// treated alike.
// A column on an edge, concave or convex, leans along the edge only: so the fan of a corner runs down its
// edges too.
#include <stdlib.h>

#include "mesher/layers_fan.h"
#include "mesher/schedule.h"

static const double REACH = 6;         // the fan ends at this many heights from its crease

// Displacement of v without any fan, m.
static void plain(const CwLayerWork *work, int32_t v, const double direction[3], double cosine, double d[3]) {
  double c = fmax(cosine, cw_layers_floor(work, v));
  for (int k = 0; k < 3; k++) d[k] = work->t[v] * direction[k] / c;
}

// Whether the column of v is given, and then its displacement relative to an undisturbed neighbour.
static int is_source(const CwLayerWork *work, int32_t v, CwFanReach *reach, CwFanSource *source) {
  int guided = work->in->guide_count && work->in->guide_count[v] > 0;
  double cosine;
  if (work->crease[v] == CW_CREASE_CONCAVE) {
    plain(work, v, work->base[v], work->base_cos[v], source->u);
    cosine = work->base_cos[v];
  } else if (guided && dot3(work->base[v], work->normal[v]) < 0.985) {
    double undisturbed[3];
    plain(work, v, work->base[v], work->base_cos[v], source->u);
    plain(work, v, work->normal[v], work->normal_cos[v], undisturbed);
    sub3(source->u, undisturbed, source->u);
    cosine = dot3(work->base[v], work->normal[v]);
  } else {
    return 0;
  }
  cosine = fmin(fmax(cosine, CW_FAN_LEAST_COSINE), 1);
  source->vertex = v;
  reach->opening = sqrt(1 - cosine * cosine) / cosine;
  reach->height = work->t[v];
  reach->distance = 0;
  return 1;
}

// The one direction in which the column of a source may still lean: along its concave edge, or along the
// line that wall and
// guide share; zero where its column is wholly given.
static void sliding_direction(const CwLayerWork *work, int32_t v, double line[3]) {
  int guides = work->in->guide_count ? work->in->guide_count[v] : 0;
  memset(line, 0, 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_CONCAVE && guides == 0) memcpy(line, work->along[v], 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_NONE && guides == 1) cross3(work->normal[v], work->in->guide_normal[v][0], line);
  unit3(line);
}

// The front of the distances.
typedef struct {
  CwFans *fans;
  CwHeap heap;
} Spread;

// v has its distance: lists it and offers its neighbours a way through it.
static CwStatus settle(Spread *spread, int32_t v) {
  CwStatus status = CW_OK;
  CwFans *fans = spread->fans;
  const CwLayerWork *work = fans->work;
  const CwFanReach *at = &fans->reach[v];
  const CwFanSource *source = &fans->source[at->source];
  if (source->vertex != v || length3(source->line) > 0) fans->order[fans->count++] = v;
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    int32_t w = work->near[k];
    double distance = at->distance + distance3(work->in->x[v], work->in->x[w]);
    if (distance >= fans->reach[w].distance || distance > REACH * at->height) continue;
    fans->reach[w] = *at;
    fans->reach[w].distance = distance;
    CW_TRY(cw_heap_push(&spread->heap, distance, w));
  }
done:
  return status;
}

// Distances from the sources along edges; lists the vertices in reach in order of distance.
static CwStatus find_reach(CwFans *fans) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = fans->work;
  Spread spread = {.fans = fans};
  int32_t sources = 0;
  for (int32_t v = 0; v < work->n; v++) {
    CwFanSource *source = &fans->source[sources];
    fans->reach[v] = (CwFanReach){.distance = INFINITY, .source = -1};
    if (!is_source(work, v, &fans->reach[v], source)) continue;
    sliding_direction(work, v, source->line);
    fans->reach[v].source = sources++;
  }
  for (int32_t i = 0; i < sources; i++) CW_TRY(settle(&spread, fans->source[i].vertex)); // nothing is nearer
  while (spread.heap.count) {
    CwHeapItem least = cw_heap_pop(&spread.heap);
    if (least.key == fans->reach[least.v].distance) CW_TRY(settle(&spread, least.v)); // else a nearer way was found
  }
done:
  cw_heap_free(&spread.heap);
  return status;
}

CwStatus cw_layers_fan(CwLayerWork *work) {
  CwStatus status = CW_OK;
  CwFans fans = {.work = work};
  int32_t blocks = 0, made = 0;
  int64_t *size = NULL;
  void **bytes = NULL;
  CW_NEW(fans.reach, work->n);
  CW_NEW(fans.source, work->n);
  CW_NEW(fans.local, work->n);
  CW_NEW(fans.order, work->n);
  CW_NEW(fans.place, work->n);
  CW_NEW(fans.member, work->n);
  CW_NEW(fans.block, work->n);
  CW_TRY(find_reach(&fans));
  for (int32_t v = 0; v < work->n; v++) fans.place[v] = fans.block[v] = -1;
  for (int32_t i = 0; i < fans.count; i++) fans.place[fans.order[i]] = i;
  for (int32_t i = 0; i < work->n; i++) {
    int32_t v = work->curve[i];
    if (fans.place[v] < 0) continue;
    fans.block[v] = made / CW_FAN_BLOCK;
    fans.member[made++] = v;
  }
  blocks = (fans.count + CW_FAN_BLOCK - 1) / CW_FAN_BLOCK;
  CW_NEW(bytes, blocks);
  CW_NEW(size, blocks);
  CwSchedule schedule = {.step = "layers: fans", .count = blocks, .run = cw_fan_solve_block,
                         .context = &fans, .gather = 1};
  CW_TRY(cw_schedule_run(&schedule, bytes, size, NULL));
  if (!work->lean) {
    CW_NEW(work->lean, work->n);
    CW_NEW(work->lean_t, work->n);
  }
  for (int32_t v = 0; v < work->n; v++) {
    int was_held = work->lean_t[v] > 0;
    work->lean_t[v] = fans.reach[v].source >= 0 ? work->t[v] : -1;
    if (was_held && work->lean_t[v] < 0) cw_layers_upright(work, v, work->column[v]);
  }
  for (int32_t b = 0; b < blocks; b++) {
    const CwLean *lean_of = bytes[b];
    for (int32_t k = 0; k < cw_fan_block_size(&fans, b); k++) {
      int32_t v = fans.member[b * CW_FAN_BLOCK + k];
      work->lean[v] = lean_of[k];
      if (work->lean[v].changed) memcpy(work->column[v], work->lean[v].column, sizeof work->column[v]);
    }
  }
done:
  for (int32_t b = 0; bytes && b < blocks; b++) free(bytes[b]);
  free(bytes);
  free(size);
  free(fans.reach);
  free(fans.source);
  free(fans.local);
  free(fans.order);
  free(fans.place);
  free(fans.member);
  free(fans.block);
  return status;
}
