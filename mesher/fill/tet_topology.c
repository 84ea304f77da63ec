// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_topology.h"

#include <string.h>

#include "mesher/common/branchless.h"

int cw_tet_star(CwTetMesh *mesh, int32_t t, int32_t point, int most, int32_t *star) {
  int count = 0;
  mesh->stars++;
  if (most > 0) star[count++] = t;
  mesh->tet[t].star = mesh->stars;
  for (int head = 0; head < count; head++) {
    const CwTet *tet = &mesh->tet[star[head]];
    for (int i = 0; i < 4; i++) {
      if (tet->corner[i] == point || tet->neighbour[i] < 0) continue;
      CwTet *next = &mesh->tet[tet->neighbour[i] / 4];
      if (next->star == mesh->stars) continue;
      if (count == most) return 0;
      next->star = mesh->stars;
      star[count++] = tet->neighbour[i] / 4;
    }
  }
  return count;
}

// As cw_tet_corner_of where it is a corner, without branches, which would be taken at random.
static inline int sure_corner_of(const CwTet *tet, int32_t point) {
  return (int)(cw_branchless(tet->corner[1] == point) + 2 * cw_branchless(tet->corner[2] == point) +
               3 * cw_branchless(tet->corner[3] == point));
}

// The other two corners in the order that makes (i, j, first, second) an even permutation.
static const int8_t first_of[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};

int cw_tet_ring(const CwTetMesh *mesh, int32_t t, int32_t a, int32_t b, int most, int32_t *tet, int32_t *ring) {
  const CwTet *now = &mesh->tet[t];
  int i = sure_corner_of(now, a), j = sure_corner_of(now, b), first = first_of[i][j], count = 0;
  int32_t from = now->corner[first], to = now->corner[6 - i - j - first], start = t;
  do {
    if (count == most) return 0;
    tet[count] = t;
    ring[count++] = from;
    int32_t next = now->neighbour[sure_corner_of(now, from)];
    if (next < 0) return 0;
    t = next / 4;
    now = &mesh->tet[t];
    from = to;
    to = now->corner[next % 4];
  } while (t != start);
  return count;
}

int cw_tet_ring_is_short(const CwTetMesh *mesh, int32_t t, int32_t a, int32_t b) {
  const CwTet *now = &mesh->tet[t], *tet = mesh->tet;
  int i = sure_corner_of(now, a), j = sure_corner_of(now, b), k = first_of[i][j], l = 6 - i - j - k;
  int32_t one = now->neighbour[k] >> 2, other = now->neighbour[l] >> 2;
  if ((one | other) < 0) return 0;
  int32_t after_one = tet[one].neighbour[sure_corner_of(&tet[one], now->corner[l])] >> 2;
  int32_t after_other = tet[other].neighbour[sure_corner_of(&tet[other], now->corner[k])] >> 2;
  return (after_one == other) | ((after_one == after_other) & (after_one >= 0));
}

int cw_tet_sides_compare(const void *left, const void *right) {
  const CwTetSide *a = left, *b = right;
  if (a->ends != b->ends) return a->ends < b->ends ? -1 : 1;
  return (a->middle > b->middle) - (a->middle < b->middle);
}

// The side with the same points, `count` where there is none. Looks at all of them, without a branch: where the search
// would end is as good as random.
static inline int find_side(const CwTetSide *side, int count, const CwTetSide *wanted) {
  int found = count;
  for (int m = 0; m < count; m++) {
    int same = (int)(cw_branchless(side[m].ends == wanted->ends) & cw_branchless(side[m].middle == wanted->middle));
    found ^= (found ^ m) & -same;
  }
  return found;
}

CwStatus cw_tet_exchange(CwTetMesh *mesh, int old_count, const int32_t *old, int count, const int32_t (*corner)[4],
                         int32_t *slot) {
  CwStatus status = CW_OK;
  CwTetSide side[8 * CW_CAVITY];
  int sides = 0;
  for (int k = 0; k < old_count; k++) {
    const CwTet *tet = &mesh->tet[old[k]];
    for (int i = 0; i < 4; i++) { // each is written, and stays where it is not within
      int32_t next = tet->neighbour[i] >> 2, within = 0;
      for (int m = 0; m < old_count; m++) within |= next == old[m];
      side[sides] = cw_tet_side(tet->corner, i, tet->neighbour[i]);
      sides += 1 - within;
    }
  }
  for (int k = 0; k < count; k++) {
    if (k < old_count)
      slot[k] = old[k];
    else
      CW_TRY(cw_tet_mesh_new_tet(mesh, &slot[k]));
  }
  for (int k = count; k < old_count; k++) cw_tet_mesh_free_tet(mesh, old[k]);
  for (int k = 0; k < count; k++) {
    CwTet *tet = &mesh->tet[slot[k]];
    memcpy(tet->corner, corner[k], sizeof tet->corner);
    for (int i = 0; i < 4; i++) {
      CwTetSide one = cw_tet_side(corner[k], i, 4 * slot[k] + i);
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
  CW_REQUIRE(sides == 0, CW_ERR_FAULT, "an exchange of %d tetrahedra for %d left %d faces open", old_count, count,
             sides);
done:
  return status;
}
