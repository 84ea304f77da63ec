// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_flips.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/number.h"
#include "mesher/common/predicates.h"
#include "mesher/common/ring.h"

static const int8_t tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

CwStatus cw_flips_make(CwDelaunay *mesh, CwFlips *flips) {
  CwStatus status = CW_OK;
  memset(flips, 0, sizeof *flips);
  flips->mesh = mesh;
  CW_NEW(flips->tet_at, mesh->point_count);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    CwDelaunayTet *tet = &mesh->tet[t];
    cw_delaunay_ask_ahead(tet);
    tet->stamp = 0;
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

CwStatus cw_flips_add_point(CwFlips *flips, const double x[3], int32_t source, int32_t *point) {
  CwStatus status = CW_OK;
  CW_TRY(cw_delaunay_add_point(flips->mesh, x, source, point));
  int32_t *grown = realloc(flips->tet_at, (size_t)flips->mesh->point_space * sizeof *grown);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d points", flips->mesh->point_space);
  flips->tet_at = grown;
  flips->tet_at[*point] = -1;
done:
  return status;
}

// As cw_delaunay_corner_of where it is a corner, without branches, which would be taken at random.
static inline int sure_corner_of(const CwDelaunayTet *tet, int32_t point) {
  return (int)(cw_number(tet->corner[1] == point) + 2 * cw_number(tet->corner[2] == point) +
               3 * cw_number(tet->corner[3] == point));
}

static CwStatus push(CwFlips *flips, int32_t t) {
  CwStatus status = CW_OK;
  CW_GROW(flips->star, flips->star_space, flips->star_count + 1);
  flips->star[flips->star_count++] = t;
  flips->mesh->tet[t].stamp = flips->stamp;
done:
  return status;
}

CwStatus cw_flips_star(CwFlips *flips, int32_t point) {
  CwStatus status = CW_OK;
  flips->stamp++;
  flips->star_count = 0;
  CW_TRY(push(flips, flips->tet_at[point]));
  for (int32_t head = 0; head < flips->star_count; head++) {
    const CwDelaunayTet *tet = &flips->mesh->tet[flips->star[head]];
    for (int i = 0; i < 4; i++) {
      if (tet->corner[i] == point || tet->neighbour[i] < 0) continue;
      int32_t next = tet->neighbour[i] / 4;
      if (flips->mesh->tet[next].stamp != flips->stamp) CW_TRY(push(flips, next));
    }
  }
done:
  return status;
}

CwStatus cw_flips_find_edge(CwFlips *flips, int32_t a, int32_t b, int32_t *tet) {
  CwStatus status = CW_OK;
  *tet = -1;
  CW_TRY(cw_flips_star(flips, a));
  for (int32_t k = 0; k < flips->star_count && *tet < 0; k++) {
    if (cw_delaunay_corner_of(&flips->mesh->tet[flips->star[k]], b) >= 0) *tet = flips->star[k];
  }
done:
  return status;
}

// The other two corners in the order that makes (i, j, first, second) an even permutation.
static const int8_t first_of[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};

int cw_flips_ring(const CwFlips *flips, int32_t t, int32_t a, int32_t b, int most, int32_t *tet, int32_t *ring) {
  const CwDelaunayTet *now = &flips->mesh->tet[t];
  int i = sure_corner_of(now, a), j = sure_corner_of(now, b), first = first_of[i][j], count = 0;
  int32_t from = now->corner[first], to = now->corner[6 - i - j - first], start = t;
  do {
    if (count == most) return 0;
    tet[count] = t;
    ring[count++] = from;
    int32_t next = now->neighbour[sure_corner_of(now, from)];
    if (next < 0) return 0;
    t = next / 4;
    now = &flips->mesh->tet[t];
    from = to;
    to = now->corner[next % 4];
  } while (t != start);
  return count;
}

int cw_flips_is_short(const CwFlips *flips, int32_t t, int32_t a, int32_t b) {
  const CwDelaunayTet *now = &flips->mesh->tet[t], *tet = flips->mesh->tet;
  int i = sure_corner_of(now, a), j = sure_corner_of(now, b), k = first_of[i][j], l = 6 - i - j - k;
  int32_t one = now->neighbour[k] >> 2, other = now->neighbour[l] >> 2;
  if ((one | other) < 0) return 0;
  int32_t after_one = tet[one].neighbour[sure_corner_of(&tet[one], now->corner[l])] >> 2;
  int32_t after_other = tet[other].neighbour[sure_corner_of(&tet[other], now->corner[k])] >> 2;
  return (after_one == other) | ((after_one == after_other) & (after_one >= 0));
}

// A face by its points, the least and the greatest of which are together one number.
typedef struct {
  uint64_t ends;
  int32_t middle, owner; // 4 * tetrahedron + face
} Side;

static inline Side side_of(const int32_t corner[4], int i, int32_t owner) {
  int32_t a = corner[tet_face[i][0]], b = corner[tet_face[i][1]], c = corner[tet_face[i][2]];
  int32_t low = a < b ? a : b, high = a < b ? b : a, least = low < c ? low : c, most = high > c ? high : c;
  return (Side){(uint64_t)(uint32_t)least << 32 | (uint32_t)most, a ^ b ^ c ^ least ^ most, owner};
}

// The side with the same points, `count` where there is none. Looks at all of them, without a branch: where the search
// would end is as good as random.
static inline int find_side(const Side *side, int count, const Side *wanted) {
  int found = count;
  for (int m = 0; m < count; m++) {
    int same = (int)(cw_number(side[m].ends == wanted->ends) & cw_number(side[m].middle == wanted->middle));
    found ^= (found ^ m) & -same;
  }
  return found;
}

CwStatus cw_flips_replace(CwFlips *flips, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                          int32_t *slot) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = flips->mesh;
  Side side[8 * CW_FLIP];
  int sides = 0;
  for (int k = 0; k < old_count; k++) {
    const CwDelaunayTet *tet = &mesh->tet[old[k]];
    for (int i = 0; i < 4; i++) { // each is written, and stays where it is not within
      int32_t next = tet->neighbour[i] >> 2, within = 0;
      for (int m = 0; m < old_count; m++) within |= next == old[m];
      side[sides] = side_of(tet->corner, i, tet->neighbour[i]);
      sides += 1 - within;
    }
  }
  for (int k = 0; k < count; k++) {
    if (k < old_count)
      slot[k] = old[k];
    else
      CW_TRY(cw_delaunay_new_tet(mesh, &slot[k]));
  }
  for (int k = count; k < old_count; k++) cw_delaunay_free_tet(mesh, old[k]);
  for (int k = 0; k < count; k++) {
    CwDelaunayTet *tet = &mesh->tet[slot[k]];
    memcpy(tet->corner, corner[k], sizeof tet->corner);
    tet->stamp = 0;
    for (int i = 0; i < 4; i++) {
      if (flips->tet_at) flips->tet_at[corner[k][i]] = slot[k];
      Side one = side_of(corner[k], i, 4 * slot[k] + i);
      int m = find_side(side, sides, &one);
      if (m == sides) {
        side[sides++] = one;
        continue;
      }
      tet->neighbour[i] = side[m].owner;
      if (side[m].owner >= 0) mesh->tet[side[m].owner / 4].neighbour[side[m].owner % 4] = one.owner;
      side[m] = side[--sides];
    }
  }
  flips->done++;
  CW_REQUIRE(sides == 0, CW_ERR_MESH, "a flip of %d tetrahedra to %d left %d faces open", old_count, count, sides);
done:
  return status;
}

static int is_positive(const CwFlips *flips, int32_t a, int32_t b, int32_t c, int32_t d) {
  const CwDelaunayPoint *p = flips->mesh->point;
  return cw_orient3d(p[a].x, p[b].x, p[c].x, p[d].x) > 0;
}

static int crossings(const CwFlips *flips, int count, int32_t a, int32_t b, int32_t c) {
  const int32_t point[3] = {a, b, c};
  return flips->crossing(flips->context, count, point);
}

CwStatus cw_flips_face(CwFlips *flips, int32_t t, int i, int *flipped) {
  CwStatus status = CW_OK;
  const CwDelaunayTet *tet = &flips->mesh->tet[t];
  int32_t other = tet->neighbour[i], made[3][4], slot[3];
  *flipped = 0;
  if (other < 0) goto done;
  const int32_t old[2] = {t, other / 4};
  int32_t below = tet->corner[i], above = flips->mesh->tet[old[1]].corner[other % 4];
  const int32_t f[3] = {tet->corner[tet_face[i][0]], tet->corner[tet_face[i][1]], tet->corner[tet_face[i][2]]};
  for (int k = 0; k < 3; k++) {
    const int32_t one[4] = {f[k], f[(k + 1) % 3], below, above};
    if (!is_positive(flips, one[0], one[1], one[2], one[3])) goto done;
    memcpy(made[k], one, sizeof one);
  }
  int before = crossings(flips, 3, f[0], f[1], f[2]), after = crossings(flips, 2, below, above, -1);
  for (int k = 0; k < 3; k++) after += crossings(flips, 3, below, above, f[k]);
  if (after >= before + flips->slack) goto done;
  CW_TRY(cw_flips_replace(flips, 2, old, 3, (const int32_t(*)[4])made, slot));
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
  int32_t old[CW_RING], ring[CW_RING], tet[CW_FLIP][4], slot[CW_FLIP];
  RingTable table;
  *flipped = 0;
  int n = cw_flips_ring(flips, t, a, b, CW_RING, old, ring);
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
  CW_TRY(cw_flips_replace(flips, n, old, count, (const int32_t(*)[4])tet, slot));
  *flipped = 1;
done:
  return status;
}
