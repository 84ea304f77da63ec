// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <math.h>
#include <string.h>

static const double step_gain = 2e-3; // least gain of a move: smaller ones cost much and give little

#define D 0.57735026918962573
const double cw_tet_way[14][3] = {{1, 0, 0},  {-1, 0, 0},  {0, 1, 0},   {0, -1, 0},  {0, 0, 1},
                                  {0, 0, -1}, {D, D, D},   {-D, D, D},  {D, -D, D},  {-D, -D, D},
                                  {D, D, -D}, {-D, D, -D}, {D, -D, -D}, {-D, -D, -D}};
#undef D

// Least quality of the hollow's tetrahedra for the point at p; stops at `enough` and moves that face forward,
// so that the next trial finds it first.
double cw_hollow_quality(CwHollow *hollow, const double p[3], double enough) {
  double least = INFINITY;
  for (int k = 0; k < hollow->count; k++) {
    const double **f = hollow->face[k];
    double q = cw_tet_quality(f[0], f[1], f[2], p);
    if (q >= least) continue;
    least = q;
    if (least > enough) continue;
    if (k > 0) {
      const double *kept[3];
      int to = k / 2;
      memcpy(kept, f, sizeof kept);
      memcpy(f, hollow->face[to], sizeof kept);
      memcpy(hollow->face[to], kept, sizeof kept);
    }
    break;
  }
  return least;
}

// Pattern search for the point of best least quality from p, which it moves; returns that quality.
double cw_hollow_best(CwHollow *hollow, double p[3], double start) {
  double best = start, mean[3] = {0, 0, 0}, square = 0.0;
  for (int k = 0; k < hollow->count; k++) {
    for (int c = 0; c < 3; c++) {
      for (int i = 0; i < 3; i++) mean[i] += hollow->face[k][c][i] / (3.0 * hollow->count);
    }
  }
  for (int i = 0; i < 3; i++) square += (hollow->face[0][0][i] - p[i]) * (hollow->face[0][0][i] - p[i]);
  double q = cw_hollow_quality(hollow, mean, best);
  if (q > best) {
    best = q;
    memcpy(p, mean, sizeof mean);
  }
  int last = 0;
  for (double step = 0.2 * sqrt(square), end = 0.2 * step; step > end; step *= 0.5) {
    for (int tries = 0, k = last; tries < 14; tries++, k = (k + 1) % 14) {
      double there[3];
      for (int i = 0; i < 3; i++) there[i] = p[i] + step * cw_tet_way[k][i];
      q = cw_hollow_quality(hollow, there, best + step_gain);
      if (q <= best + step_gain) continue;
      best = q;
      memcpy(p, there, sizeof there);
      last = k;
      tries = -1; // on in the same direction
      k = (k + 13) % 14;
    }
  }
  return best;
}

int cw_tet_star(CwTetWork *w, int32_t t, int32_t point, int32_t star[CW_TET_STAR]) {
  CwDelaunay *mesh = w->mesh;
  int count = 1;
  w->stamp++;
  star[0] = t;
  mesh->tet[t].star = w->stamp;
  for (int head = 0; head < count; head++) {
    const CwDelaunayTet *tet = &mesh->tet[star[head]];
    for (int i = 0; i < 4; i++) {
      if (tet->corner[i] == point || tet->neighbour[i] < 0) continue;
      CwDelaunayTet *next = &mesh->tet[tet->neighbour[i] / 4];
      if (next->star == w->stamp) continue;
      if (count == CW_TET_STAR) return 0;
      next->star = w->stamp;
      star[count++] = tet->neighbour[i] / 4;
    }
  }
  return count;
}

CwStatus cw_tet_smooth(CwTetWork *w, int32_t t, int32_t point, int *done_it) {
  CwStatus status = CW_OK;
  int32_t star[CW_TET_STAR];
  CwHollow hollow;
  double p[3], least = INFINITY;
  *done_it = 0;
  if (w->mesh->source[point] < w->fixed_count) goto done;
  int n = cw_tet_star(w, t, point, star);
  hollow.count = n;
  for (int k = 0; k < n; k++) {
    const CwDelaunayTet *tet = &w->mesh->tet[star[k]];
    int corner = 0;
    while (tet->corner[corner] != point) corner++;
    // Inward: (face, point) positive.
    for (int i = 0; i < 3; i++) hollow.face[k][i] = cw_tet_at(w, tet->corner[cw_tet_face[corner][2 - i]]);
    if (tet->quality < least) least = tet->quality;
  }
  if (n == 0) goto done;
  memcpy(p, cw_tet_at(w, point), sizeof p);
  if (!(cw_hollow_best(&hollow, p, least) > least + step_gain)) goto done;
  memcpy(w->mesh->point[point].x, p, sizeof p);
  for (int k = 0; k < n; k++) {
    const int32_t *c = w->mesh->tet[star[k]].corner;
    CW_TRY(cw_tet_set_quality(w, star[k], cw_tet_quality_of(w, c[0], c[1], c[2], c[3])));
  }
  w->count.points_moved++;
  *done_it = 1;
done:
  return status;
}
