// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_flat.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/fill/hollow.h"
#include "mesher/fill/kernel_flips.h"

static const int8_t tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// Six times the volume over the cube of the longest edge: flat below the first. A hollow is filled anew where the
// least of it becomes so many times greater, and is at least as great as the last.
static const double flat = 1e-5, gain = 30.0, least_worth = 1e-9;
enum { TETS = 64, WALLS = 90, PASSES = 2 };

typedef struct {
  CwFlips flips;
  CwHollow hollow;
  int32_t tet[TETS], beyond[WALLS]; // of each face of the hollow; -1: the boundary
  int tet_count;
} Raiser;

static int has(const int32_t *list, int count, int32_t item) {
  for (int k = 0; k < count; k++) {
    if (list[k] == item) return 1;
  }
  return 0;
}

static double flatness(const CwDelaunay *mesh, int32_t t) {
  const double *x[4];
  double square = 0.0, d[3];
  for (int i = 0; i < 4; i++) x[i] = mesh->point[mesh->tet[t].corner[i]].x;
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < k; i++) {
      cw_sub(x[i], x[k], d);
      square = fmax(square, cw_dot(d, d));
    }
  }
  return cw_tet_volume6(x[0], x[1], x[2], x[3]) / (square * sqrt(square));
}

// Whether each edge of the walls has two of them: the hollow is a ball then.
static int is_ball(const CwHollow *h) {
  for (int32_t k = 0; k < 3 * h->count; k++) {
    int32_t a = h->face[k / 3][k % 3], b = h->face[k / 3][(k + 1) % 3];
    int same = 0, opposite = 0;
    for (int32_t m = 0; m < 3 * h->count; m++) {
      int32_t c = h->face[m / 3][m % 3], d = h->face[m / 3][(m + 1) % 3];
      same += a == c && b == d;
      opposite += a == d && b == c;
    }
    if (same != 1 || opposite != 1) return 0;
  }
  return 1;
}

// The faces round the tetrahedra of the hollow; false where there are too many.
static CwStatus find_walls(Raiser *r, int *good) {
  CwStatus status = CW_OK;
  const CwDelaunay *mesh = r->flips.mesh;
  r->hollow.count = 0;
  *good = 0;
  for (int k = 0; k < r->tet_count; k++) {
    const CwDelaunayTet *tet = &mesh->tet[r->tet[k]];
    for (int i = 0; i < 4; i++) {
      int32_t next = tet->neighbour[i] < 0 ? -1 : tet->neighbour[i] / 4;
      if (next >= 0 && has(r->tet, r->tet_count, next)) continue;
      if (r->hollow.count == WALLS) goto done;
      const int32_t face[3] = {tet->corner[tet_face[i][0]], tet->corner[tet_face[i][2]], tet->corner[tet_face[i][1]]};
      r->beyond[r->hollow.count] = next;
      CW_TRY(cw_hollow_add(&r->hollow, mesh, face));
    }
  }
  *good = 1;
done:
  return status;
}

// Grows a hollow round t until a point in it sees all its faces well.
static CwStatus raise_one(Raiser *r, int32_t t, int32_t *source_count, int *raised) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = r->flips.mesh;
  int32_t made[WALLS][4], slot[WALLS], point, worst = 0;
  double p[3], before = flatness(mesh, t);
  *raised = 0;
  r->tet[0] = t;
  r->tet_count = 1;
  for (;;) {
    int good;
    CW_TRY(find_walls(r, &good));
    if (!good) goto done;
    double worth = r->tet_count > 1 ? cw_hollow_place(&r->hollow, mesh, NULL, NULL, p) : 0.0;
    if (worth > least_worth && worth > gain * before && is_ball(&r->hollow)) break;
    // Take away what the worst face hides; of a single tetrahedron, all that lies at it.
    int32_t next = -1;
    if (r->tet_count > 1) {
      cw_hollow_worth(&r->hollow, mesh, p, &worst);
      next = r->beyond[worst];
      for (int32_t k = 0; k < r->hollow.count && next < 0; k++) next = r->beyond[k];
    } else {
      next = r->beyond[0];
      for (int32_t k = 1; k < r->hollow.count; k++) {
        if (r->beyond[k] >= 0 && next >= 0)
          r->tet[r->tet_count++] = r->beyond[k];
        else if (r->beyond[k] >= 0)
          next = r->beyond[k];
      }
    }
    if (next < 0 || r->tet_count == TETS) goto done;
    r->tet[r->tet_count++] = next;
    before = fmin(before, flatness(mesh, next));
  }
  CW_TRY(cw_flips_add_point(&r->flips, p, (*source_count)++, &point));
  for (int32_t k = 0; k < r->hollow.count; k++) {
    memcpy(made[k], r->hollow.face[k], sizeof *r->hollow.face);
    made[k][3] = point;
  }
  CW_TRY(cw_flips_replace(&r->flips, r->tet_count, r->tet, r->hollow.count, (const int32_t(*)[4])made, slot));
  *raised = 1;
done:
  return status;
}

CwStatus cw_kernel_flat(CwDelaunay *mesh, int32_t *source_count, int32_t *raised, int32_t *left) {
  CwStatus status = CW_OK;
  Raiser r = {.tet_count = 0};
  *raised = 0;
  CW_TRY(cw_flips_make(mesh, &r.flips));
  for (int pass = 0; pass < PASSES; pass++) {
    int32_t count = mesh->tet_count, before = *raised;
    *left = 0;
    for (int32_t t = 0; t < count; t++) {
      int good;
      if (mesh->tet[t].corner[0] < 0 || flatness(mesh, t) > flat) continue;
      CW_TRY(raise_one(&r, t, source_count, &good));
      *raised += good;
      *left += !good;
    }
    if (*left == 0 || *raised == before) break;
  }
done:
  cw_hollow_free(&r.hollow);
  cw_flips_free(&r.flips);
  return status;
}
