// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_flips.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/predicates.h"
#include "mesher/common/ring.h"
#include "mesher/common/tet.h"

CwStatus cw_flips_make(CwTetMesh *mesh, CwFlips *flips) {
  CwStatus status = CW_OK;
  memset(flips, 0, sizeof *flips);
  flips->mesh = mesh;
  CW_NEW(flips->tet_at, mesh->point_count);
  flips->tet_at_capacity = mesh->point_count;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    CwTet *tet = &mesh->tet[t];
    cw_tet_prefetch_ahead(tet);
    tet->star = 0;
    for (int i = 0; i < 4 && tet->corner[0] >= 0; i++) flips->tet_at[tet->corner[i]] = t;
  }
done:
  return status;
}

void cw_flips_free(CwFlips *flips) {
  free(flips->tet_at);
  free(flips->star);
  memset(flips, 0, sizeof *flips);
}

CwStatus cw_flips_star(CwFlips *flips, int32_t point) {
  CwStatus status = CW_OK;
  for (;;) {
    flips->star_count = cw_tet_star(flips->mesh, flips->tet_at[point], point, flips->star_capacity, flips->star);
    if (flips->star_count > 0) break;
    CW_GROW(flips->star, flips->star_capacity, flips->star_capacity + 1);
  }
done:
  return status;
}

CwStatus cw_flips_find_edge(CwFlips *flips, int32_t a, int32_t b, int32_t *tet) {
  CwStatus status = CW_OK;
  *tet = -1;
  CW_TRY(cw_flips_star(flips, a));
  for (int32_t k = 0; k < flips->star_count && *tet < 0; k++) {
    if (cw_tet_corner_of(&flips->mesh->tet[flips->star[k]], b) >= 0) *tet = flips->star[k];
  }
done:
  return status;
}

static CwStatus replace(CwFlips *flips, int old_count, const int32_t *old, int count, const int32_t (*corner)[4]) {
  CwStatus status = CW_OK;
  int32_t slot[CW_CAVITY];
  CW_TRY(cw_tet_exchange(flips->mesh, old_count, old, count, corner, slot));
  for (int k = 0; k < count; k++) {
    for (int i = 0; i < 4; i++) flips->tet_at[corner[k][i]] = slot[k];
  }
  flips->done++;
done:
  return status;
}

static int is_positive(const CwFlips *flips, int32_t a, int32_t b, int32_t c, int32_t d) {
  const CwTetPoint *p = flips->mesh->point;
  return cw_orient3d(p[a].x, p[b].x, p[c].x, p[d].x) > 0;
}

static int crossings(const CwFlips *flips, int count, int32_t a, int32_t b, int32_t c) {
  const int32_t point[3] = {a, b, c};
  return flips->crossing(flips->context, count, point);
}

CwStatus cw_flips_face(CwFlips *flips, int32_t t, int i, int *flipped) {
  CwStatus status = CW_OK;
  const CwTet *tet = &flips->mesh->tet[t];
  int32_t other = tet->neighbour[i], made[3][4];
  *flipped = 0;
  if (other < 0) goto done;
  const int32_t old[2] = {t, other / 4};
  int32_t below = tet->corner[i], above = flips->mesh->tet[old[1]].corner[other % 4];
  const int32_t f[3] = {tet->corner[cw_tet_face[i][0]], tet->corner[cw_tet_face[i][1]], tet->corner[cw_tet_face[i][2]]};
  for (int k = 0; k < 3; k++) {
    const int32_t one[4] = {f[k], f[(k + 1) % 3], below, above};
    if (!is_positive(flips, one[0], one[1], one[2], one[3])) goto done;
    memcpy(made[k], one, sizeof one);
  }
  int before = crossings(flips, 3, f[0], f[1], f[2]), after = crossings(flips, 2, below, above, -1);
  for (int k = 0; k < 3; k++) after += crossings(flips, 3, below, above, f[k]);
  if (after >= before + flips->slack) goto done;
  CW_TRY(replace(flips, 2, old, 3, (const int32_t(*)[4])made));
  *flipped = 1;
done:
  return status;
}

// Triangulations of the ring (Klincsek): least crossings of the part i..j, beyond `never` for none that is
// valid.
typedef struct {
  int least[CW_RING][CW_RING];
  int8_t cut[CW_RING][CW_RING];
} RingTable;

static const int never = 1000000;

CwStatus cw_flips_edge(CwFlips *flips, int32_t t, int32_t a, int32_t b, int *flipped) {
  CwStatus status = CW_OK;
  int32_t old[CW_RING], ring[CW_RING], tet[CW_CAVITY][4];
  RingTable table;
  *flipped = 0;
  int n = cw_tet_ring(flips->mesh, t, a, b, CW_RING, old, ring);
  if (n < 3) goto done;
  int before = crossings(flips, 2, a, b, -1);
  for (int k = 0; k < n; k++) {
    before += crossings(flips, 3, a, b, ring[k]);
    if (k + 1 < n) table.least[k][k + 1] = 0;
  }
  for (int span = 2; span < n; span++) {
    for (int from = 0; from + span < n; from++) {
      int to = from + span, least = never;
      // The faces at the chord, unless it is a side of the ring.
      int chord = span == n - 1
                      ? 0
                      : crossings(flips, 2, ring[from], ring[to], -1) + crossings(flips, 3, ring[from], ring[to], a) +
                            crossings(flips, 3, ring[from], ring[to], b);
      for (int k = from + 1; k < to; k++) {
        int sum = chord + table.least[from][k] + table.least[k][to];
        if (sum >= least || !is_positive(flips, ring[from], ring[k], ring[to], b) ||
            !is_positive(flips, ring[from], ring[to], ring[k], a))
          continue;
        sum += crossings(flips, 3, ring[from], ring[k], ring[to]);
        if (sum >= least) continue;
        least = sum;
        table.cut[from][to] = (int8_t)k;
      }
      table.least[from][to] = least;
    }
  }
  if (table.least[0][n - 1] >= never || table.least[0][n - 1] >= before + flips->slack) goto done;
  int count = cw_ring_tets(&table.cut[0][0], CW_RING, ring, a, b, 0, n - 1, tet, 0);
  CW_TRY(replace(flips, n, old, count, (const int32_t(*)[4])tet));
  *flipped = 1;
done:
  return status;
}

CwStatus cw_flips_split(CwFlips *flips, int32_t t, int32_t a, int32_t b, double part, int32_t *source_count,
                        int *split) {
  CwStatus status = CW_OK;
  CwTetMesh *mesh = flips->mesh;
  int32_t old[CW_RING], ring[CW_RING], tet[CW_CAVITY][4], middle;
  double x[3];
  *split = 0;
  int n = cw_tet_ring(mesh, t, a, b, CW_RING, old, ring);
  for (int k = 0; k < 3; k++) x[k] = (1 - part) * mesh->point[a].x[k] + part * mesh->point[b].x[k];
  for (int k = 0; k < n; k++) {
    const double *p = mesh->point[ring[k]].x, *q = mesh->point[ring[(k + 1) % n]].x;
    if (cw_orient3d(mesh->point[a].x, x, p, q) <= 0 || cw_orient3d(x, mesh->point[b].x, p, q) <= 0) goto done;
  }
  if (n == 0) goto done;
  CW_TRY(cw_tet_mesh_add_point(mesh, x, (*source_count)++, &middle));
  CW_GROW(flips->tet_at, flips->tet_at_capacity, mesh->point_count);
  for (int k = 0; k < n; k++) {
    memcpy(tet[2 * k], (int32_t[4]){a, middle, ring[k], ring[(k + 1) % n]}, sizeof *tet);
    memcpy(tet[2 * k + 1], (int32_t[4]){middle, b, ring[k], ring[(k + 1) % n]}, sizeof *tet);
  }
  CW_TRY(replace(flips, n, old, 2 * n, (const int32_t(*)[4])tet));
  *split = 1;
done:
  return status;
}
