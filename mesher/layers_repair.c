// SPDX-License-Identifier: AGPL-3.0-or-later
#include <stdlib.h>

#include "mesher/intersect.h"
#include "mesher/layers_inner.h"

enum { ROUNDS = 40, TURNS = 4, REFAN = 3 };
static const double GOOD = 0.12, FAIR = 0.05;         // least prism quality
static const double THIN = 0.8;          // what a thinned column keeps
static const double LEAST_COSINE = 0.3;  // of a direction that the search may choose
static const double LEAST_SHARE = 0.01;  // of its target: a column this thin that still crosses will not get clear

double cw_layers_prism_quality(const CwLayerWork *work, int32_t f, const double (*front)[3]) {
  const int32_t *v = work->in->triangle[f];
  const double (*x)[3] = work->in->x;
  double least = INFINITY, d[3][3], e[3][3], de[3][3], sine[3];
  for (int i = 0; i < 3; i++) sub3(front[v[i]], x[v[i]], d[i]);
  for (int i = 0; i < 3; i++) {
    sub3(x[v[(i + 1) % 3]], x[v[i]], e[i]); // edge from corner i to the next
    sub3(d[(i + 1) % 3], d[i], de[i]);      // how it changes from wall to front
  }
  for (int i = 0; i < 3; i++) {
    double c[3];
    int last = (i + 2) % 3;
    cross3(e[last], e[i], c);
    sine[i] = length3(c) / (length3(e[i]) * length3(e[last]));
  }
  for (int level = 0; level <= 4; level++) {
    double edge[3][3], length[3];
    for (int i = 0; i < 3; i++) {
      for (int k = 0; k < 3; k++) edge[i][k] = e[i][k] + 0.25 * level * de[i][k];
      length[i] = length3(edge[i]);
    }
    for (int i = 0; i < 3; i++) {
      int last = (i + 2) % 3;
      double c[3], scale = length[i] * length[last] * length3(d[i]) * sine[i];
      cross3(edge[i], edge[last], c); // with the minus of edge[last]: into the fluid
      double q = scale > 0 ? dot3(c, d[i]) / scale : -1;
      if (q < least) least = q;
    }
  }
  return least;
}

static double around(const CwLayerWork *work, int32_t v, const double (*front)[3]) {
  double least = INFINITY;
  for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++)
    least = fmin(least, cw_layers_prism_quality(work, work->face[k], front));
  return least;
}

// Tries directions near the present one; keeps the one whose worst prism is best.
static void turn(CwLayerWork *work, int32_t v, double (*front)[3]) {
  const CwLayerInput *in = work->in;
  const double step[2] = {0.25, 0.1};
  int guides = in->guide_count ? in->guide_count[v] : 0;
  double best = around(work, v, (const double (*)[3])front), kept[3], column[3];
  if (guides == 2) return;
  memcpy(kept, front[v], sizeof kept);
  memcpy(column, work->column[v], sizeof column);
  for (int s = 0; s < 2; s++) {
    double g[3] = {column[0], column[1], column[2]}, side[3], up[3];
    unit3(g);
    if (guides == 1) {
      cross3(g, in->guide_normal[v][0], side);
      memset(up, 0, sizeof up);
    } else {
      int axis = fabs(g[0]) < 0.6 ? 0 : 1;
      double e[3] = {0};
      e[axis] = 1;
      cross3(g, e, side);
    }
    unit3(side);
    if (guides == 0) cross3(g, side, up);
    for (int i = 0; i < 8; i++) {
      if (guides == 1 && i % 4) continue;
      double angle = i * acos(-1) / 4, trial[3];
      for (int k = 0; k < 3; k++)
        trial[k] = g[k] + tan(step[s]) * (cos(angle) * side[k] + sin(angle) * up[k]);
      unit3(trial);
      if (cw_layers_least_cosine(work, v, trial) < fmin(LEAST_COSINE, 0.9 * work->base_cos[v])) continue;
      cw_layers_set_column(work, v, trial, 0.3);
      cw_layers_place(work, v, front[v]);
      double quality = around(work, v, (const double (*)[3])front);
      if (quality > best) {
        best = quality;
        memcpy(kept, front[v], sizeof kept);
        memcpy(column, work->column[v], sizeof column);
      }
    }
  }
  memcpy(front[v], kept, sizeof kept);
  memcpy(work->column[v], column, sizeof column);
}

typedef struct {
  CwLayerWork *work;
  double (*front)[3];
  int32_t *bad, bad_count;
  uint8_t *mark;        // vertices to turn or to thin
  double limit;         // prism quality asked for
  int32_t point_count;  // walls, front, obstacles: the surfaces that must not cross
  double (*x)[3];
  int32_t triangle_count, (*triangle)[3];
} Repair;

static void find_bad(Repair *repair) {
  const CwLayerWork *work = repair->work;
  memset(repair->mark, 0, work->n);
  repair->bad_count = 0;
  for (int32_t f = 0; f < work->in->triangle_count; f++) {
    if (cw_layers_prism_quality(work, f, (const double (*)[3])repair->front) >= repair->limit) continue;
    repair->bad[repair->bad_count++] = f;
    for (int i = 0; i < 3; i++) repair->mark[work->in->triangle[f][i]] = 1;
  }
}

static CwStatus thin_marked(Repair *repair) {
  CwStatus status = CW_OK;
  CwLayerWork *work = repair->work;
  for (int32_t v = 0; v < work->n; v++)
    if (repair->mark[v]) {
      work->t[v] *= THIN;
      work->reason[v] = CW_LAYER_REPAIR;
    }
  CW_TRY(cw_layers_grade(work));
  for (int32_t v = 0; v < work->n; v++) cw_layers_place(work, v, repair->front[v]);
done:
  return status;
}

static CwStatus collect_surfaces(Repair *repair) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = repair->work->in;
  int32_t n = in->point_count, walls = in->triangle_count;
  repair->point_count = 2 * n + in->obstacle_point_count;
  repair->triangle_count = 2 * walls + in->obstacle_triangle_count;
  CW_NEW(repair->x, repair->point_count);
  CW_NEW(repair->triangle, repair->triangle_count);
  memcpy(repair->x + n, in->x, n * sizeof *in->x);
  for (int32_t f = 0; f < walls; f++)
    for (int i = 0; i < 3; i++) {
      repair->triangle[f][i] = in->triangle[f][i];
      repair->triangle[walls + f][i] = n + in->triangle[f][i];
    }
  for (int32_t v = 0; v < in->obstacle_point_count; v++)
    memcpy(repair->x[2 * n + v], in->obstacle_x[v], sizeof *repair->x);
  for (int32_t f = 0; f < in->obstacle_triangle_count; f++)
    for (int i = 0; i < 3; i++) repair->triangle[2 * walls + f][i] = 2 * n + in->obstacle_triangle[f][i];
done:
  return status;
}

// Whether a column of front triangle f runs in a guide: there it touches its cap, as it should, and the two
// triangulations of a curved cap differ by their chords.
static int is_guided(const Repair *repair, int32_t f) {
  const CwLayerInput *in = repair->work->in;
  if (!in->guide_count) return 0;
  for (int i = 0; i < 3; i++) {
    if (in->guide_count[in->triangle[f][i]]) return 1;
  }
  return 0;
}

// Marks the columns of crossing front triangles; *crossing: pairs that matter.
static CwStatus find_crossings(Repair *repair, int32_t *crossing) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = repair->work;
  const CwLayerInput *in = work->in;
  int32_t walls = in->triangle_count, pair_count = 0, (*pair)[2] = NULL;
  *crossing = 0;
  memset(repair->mark, 0, work->n);
  memcpy(repair->x, repair->front, work->n * sizeof *repair->front);
  CW_TRY(cw_self_intersections(repair->point_count, (const double (*)[3])repair->x, repair->triangle_count,
                               (const int32_t (*)[3])repair->triangle, &pair_count, &pair));
  for (int32_t i = 0; i < pair_count; i++) {
    int32_t f = pair[i][0], g = pair[i][1];
    if (f >= walls) {
      const double *x = repair->x[repair->triangle[f][0]];
      CW_REQUIRE(g >= 2 * walls, CW_ERR_MESH, "layers: the wall itself crosses or touches itself near "
                 "(%.4f, %.4f, %.4f) mm (wall triangles %d and %d)", x[0] * 1e3, x[1] * 1e3, x[2] * 1e3, f - walls,
                 g - walls);
      continue; // caps are not ours to judge
    }
    if (g >= 2 * walls && is_guided(repair, f)) continue;
    (*crossing)++;
    double share = 0;
    for (int k = 0; k < 3; k++) {
      int32_t v = in->triangle[f][k];
      repair->mark[v] = 1;
      share = fmax(share, work->t[v] / in->target[v]);
      if (g < walls) {
        v = in->triangle[g][k];
        repair->mark[v] = 1;
        share = fmax(share, work->t[v] / in->target[v]);
      }
    }
    const double *x = in->x[in->triangle[f][0]];
    CW_REQUIRE(share > LEAST_SHARE, CW_ERR_MESH,
               "layers: near (%.4f, %.4f, %.4f) mm the front crosses %s however thin the layers are made", x[0] * 1e3,
               x[1] * 1e3, x[2] * 1e3, g < walls ? "itself" : g < 2 * walls ? "the wall" : "a cap");
  }
done:
  free(pair);
  return status;
}

CwStatus cw_layers_repair(CwLayerWork *work, double (*front)[3], int32_t *rounds) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = work->in;
  Repair repair = {.work = work, .front = front};
  int32_t crossing = 0;
  CW_NEW(repair.bad, in->triangle_count);
  CW_NEW(repair.mark, work->n);
  CW_TRY(collect_surfaces(&repair));
  for (int32_t v = 0; v < work->n; v++) cw_layers_place(work, v, front[v]);
  for (*rounds = 0; *rounds < ROUNDS; (*rounds)++) {
    // Round prisms where they can be had; where half the rounds did not bring them, sound ones.
    repair.limit = *rounds < ROUNDS / 2 ? GOOD : FAIR;
    find_bad(&repair);
    if (repair.bad_count) {
      for (int pass = 0; pass < TURNS && repair.bad_count; pass++) {
        for (int32_t v = 0; v < work->n; v++)
          if (repair.mark[v]) turn(work, v, front);
        find_bad(&repair);
      }
      if (!repair.bad_count) continue;
    } else {
      CW_TRY(find_crossings(&repair, &crossing));
      if (crossing == 0) goto done;
    }
    CW_TRY(thin_marked(&repair));
    // What is bad still leans as the old heights asked; less height needs less lean. Once only: the turned columns are
    // lost by it, and only thinning is sure to come to an end.
    if (*rounds != REFAN) continue;
    CW_TRY(cw_layers_fan(work));
    for (int32_t v = 0; v < work->n; v++) cw_layers_place(work, v, front[v]);
  }
  find_bad(&repair);
  int32_t first = repair.bad_count ? in->triangle[repair.bad[0]][0] : 0;
  for (int32_t v = 0; v < work->n && !repair.bad_count; v++)
    if (repair.mark[v]) first = v;
  const double *x = in->x[first];
  status = CW_FAIL(CW_ERR_MESH,
                   "layers: no valid front after %d rounds: %d prisms without positive volume, %d pairs crossing, near "
                   "(%.4f, %.4f, %.4f) mm",
                   ROUNDS, repair.bad_count, crossing, x[0] * 1e3, x[1] * 1e3, x[2] * 1e3);
done:
  free(repair.bad);
  free(repair.mark);
  free(repair.x);
  free(repair.triangle);
  return status;
}
