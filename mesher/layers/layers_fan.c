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

#include "mesher/layers/layers_fan.h"
#include "mesher/parallel/schedule.h"

// Displacement of v without any fan, m.
static void plain(const CwLayerWork *work, int32_t v, const double direction[3], double cosine, double d[3]) {
  double c = fmax(cosine, cw_layers_floor(work, v));
  for (int k = 0; k < 3; k++) d[k] = work->t[v] * direction[k] / c;
}

static int is_source(const CwLayerWork *work, int32_t v) {
  int guided = work->in->guide_count && work->in->guide_count[v] > 0;
  return work->crease[v] == CW_CREASE_CONCAVE || (guided && cw_dot(work->base[v], work->normal[v]) < 0.985);
}

// Sets the height of a source and its displacement relative to an undisturbed neighbour.
static void raise_source(const CwLayerWork *work, CwFanSource *source) {
  int32_t v = source->vertex;
  source->height = work->t[v];
  plain(work, v, work->base[v], work->base_cos[v], source->u);
  if (work->crease[v] == CW_CREASE_CONCAVE) return;
  double undisturbed[3];
  plain(work, v, work->normal[v], work->normal_cos[v], undisturbed);
  cw_sub(source->u, undisturbed, source->u);
}

// The one direction in which the column of a source may still lean: along its concave edge, or along the
// line that wall and
// guide share; zero where its column is wholly given.
static void sliding_direction(const CwLayerWork *work, int32_t v, double line[3]) {
  int guides = work->in->guide_count ? work->in->guide_count[v] : 0;
  memset(line, 0, 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_CONCAVE && guides == 0) memcpy(line, work->along[v], 3 * sizeof *line);
  if (work->crease[v] == CW_CREASE_NONE && guides == 1) cw_cross(work->normal[v], work->in->guide_normal[v][0], line);
  cw_unit(line);
}

static CwStatus find_sources(CwFans *fans) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = fans->work;
  for (int32_t v = 0; v < work->n; v++) fans->source_count += is_source(work, v);
  CW_NEW(fans->source, fans->source_count);
  fans->source_count = 0;
  for (int32_t v = 0; v < work->n; v++) {
    if (!is_source(work, v)) continue;
    CwFanSource *source = &fans->source[fans->source_count++];
    double cosine = work->crease[v] == CW_CREASE_CONCAVE ? work->base_cos[v] : cw_dot(work->base[v], work->normal[v]);
    cosine = fmin(fmax(cosine, CW_FAN_LEAST_COSINE), 1);
    source->vertex = v;
    source->opening = sqrt(1 - cosine * cosine) / cosine;
    sliding_direction(work, v, source->line);
    raise_source(work, source);
  }
done:
  return status;
}

static CwStatus fans_make(CwLayerWork *work) {
  CwStatus status = CW_OK;
  CwFans *fans = NULL;
  CW_NEW(work->fans, 1);
  fans = work->fans;
  fans->work = work;
  CW_NEW(fans->reach, work->n);
  CW_NEW(fans->local, work->n);
  CW_NEW(fans->member, work->n);
  CW_NEW(fans->place, work->n);
  CW_NEW(fans->lean_t, work->n);
  CW_TRY(find_sources(fans));
  CW_TRY(cw_fan_find_reach(fans));
  for (int32_t i = 0; i < work->n; i++) {
    int32_t v = work->curve[i], source = fans->reach[v].source;
    int leans = source >= 0 && (fans->source[source].vertex != v || cw_norm(fans->source[source].line) > 0);
    fans->place[v] = leans ? fans->count : -1;
    if (leans) fans->member[fans->count++] = v;
  }
  fans->block_count = (fans->count + CW_FAN_BLOCK - 1) / CW_FAN_BLOCK;
done:
  return status;
}

static void leans_free(int32_t blocks, void **lean) {
  for (int32_t b = 0; lean && b < blocks; b++) free(lean[b]);
  free(lean);
}

void cw_fans_free(CwFans **fans) {
  if (!*fans) return;
  leans_free((*fans)->block_count, (*fans)->lean);
  free((*fans)->source);
  free((*fans)->reach);
  free((*fans)->local);
  free((*fans)->member);
  free((*fans)->place);
  free((*fans)->lean_t);
  free(*fans);
  *fans = NULL;
}

CwStatus cw_layers_fan(CwLayerWork *work) {
  CwStatus status = CW_OK;
  int64_t *size = NULL;
  void **bytes = NULL;
  if (!work->fans) CW_TRY(fans_make(work));
  CwFans *fans = work->fans;
  for (int32_t i = 0; i < fans->source_count; i++) raise_source(work, &fans->source[i]);
  CW_NEW(bytes, fans->block_count);
  CW_NEW(size, fans->block_count);
  CwSchedule schedule = {
      .step = "layers: fans", .count = fans->block_count, .run = cw_fan_solve_block, .context = fans, .gather = 1};
  CW_TRY(cw_schedule_run(&schedule, bytes, size, NULL));
  for (int32_t v = 0; v < work->n; v++) fans->lean_t[v] = fans->reach[v].source >= 0 ? work->t[v] : -1;
  for (int32_t i = 0; i < fans->count; i++) {
    const CwLean *lean = (const CwLean *)bytes[i / CW_FAN_BLOCK] + i % CW_FAN_BLOCK;
    if (lean->changed) memcpy(work->column[fans->member[i]], lean->column, sizeof lean->column);
  }
  leans_free(fans->block_count, fans->lean);
  fans->lean = bytes;
  bytes = NULL;
done:
  if (bytes) leans_free(fans->block_count, bytes);
  free(size);
  return status;
}
