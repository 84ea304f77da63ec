// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_group.h"

#include <string.h>

#include "mesher/common/eight.h"
#include "mesher/fill/tet_quality.h"

enum { GROUP = CW_TET_GROUP, HALF = GROUP / 2 };
enum { AHEAD = 128 }; // places ahead of which the memory is asked

// The ways from the first corners of eight tetrahedra to the others, by corner and coordinate.
typedef struct {
  CwEight arm[3][4];
} Group;

CW_INLINE void take_group(const CwDelaunay *mesh, const int32_t *list, const CwFour *place, Group *g) {
  for (int k = 0; k < HALF; k++) {
    const CwDelaunayTet *low = &mesh->tet[list[k]], *high = &mesh->tet[list[k + HALF]];
    cw_delaunay_ask(low, AHEAD);
    cw_delaunay_ask(high, AHEAD);
    CwFour from[2] = {place[low->corner[0]], place[high->corner[0]]};
    for (int c = 0; c < 3; c++)
      g->arm[c][k] = cw_eight_of(place[low->corner[c + 1]] - from[0], place[high->corner[c + 1]] - from[1]);
  }
  for (int c = 0; c < 3; c++) cw_eight_turn(g->arm[c]);
}

// The edges and their squares in the order of cw_tet_edge.
CW_INLINE void find_edges(const Group *g, CwEight edge[6][3], CwEight square[6]) {
  const CwEight *a = g->arm[0], *b = g->arm[1], *c = g->arm[2];
  for (int i = 0; i < 3; i++) {
    edge[0][i] = a[i], edge[1][i] = b[i], edge[2][i] = c[i];
    edge[3][i] = b[i] - a[i], edge[4][i] = c[i] - a[i], edge[5][i] = c[i] - b[i];
  }
  for (int e = 0; e < 6; e++) square[e] = cw_eight_dot(edge[e], edge[e]);
}

CW_INLINE void find_extremes(const CwEight square[6], CwEight *least, CwEight *most) {
  *least = *most = square[0];
  for (int e = 1; e < 6; e++) {
    *least = cw_eight_less(*least, square[e]);
    *most = cw_eight_more(*most, square[e]);
  }
}

// What each corner is to have, by corner and coordinate: the weighted way and the weight.
CW_INLINE void find_centres(const Group *g, const CwEight *own, CwEight part[4][4]) {
  CwEight edge[6][3], l[6], bc[3], ca[3], ab[3];
  (void)own;
  find_edges(g, edge, l);
  cw_eight_cross(g->arm[1], g->arm[2], bc);
  cw_eight_cross(g->arm[2], g->arm[0], ca);
  cw_eight_cross(g->arm[0], g->arm[1], ab);
  CwEight squares = l[0] + l[1] + l[2] + l[3] + l[4] + l[5];
  CwEight scale = 1.0f / (squares * cw_eight_sqrt(squares)), weight = scale * cw_eight_dot(g->arm[0], bc);
  for (int i = 0; i < 3; i++) {
    CwEight way = 0.5f * scale * (l[0] * bc[i] + l[1] * ca[i] + l[2] * ab[i]);
    part[0][i] = way;
    for (int m = 0; m < 3; m++) part[m + 1][i] = way - weight * g->arm[m][i];
  }
  for (int m = 0; m < 4; m++) part[m][3] = weight;
}

CW_INLINE void find_pulls(const Group *g, const CwEight *own, CwEight part[4][4]) {
  CwEight edge[6][3], square[6], step[6], way[6], least, most;
  find_edges(g, edge, square);
  find_extremes(square, &least, &most);
  CwEightMask sound = least > (float)CW_TET_FLAT * most;
  CwEight in = cw_eight_if(sound, *own / cw_eight_sqrt(least * most));
  CwEight out = cw_eight_if(sound, in * most / least);
  for (int e = 0; e < 6; e++) step[e] = cw_eight_if(square[e] == most, in) - cw_eight_if(square[e] == least, out);
  for (int i = 0; i < 3; i++) {
    for (int e = 0; e < 6; e++) way[e] = step[e] * edge[e][i];
    part[0][i] = way[0] + way[1] + way[2];
    part[1][i] = way[3] + way[4] - way[0];
    part[2][i] = way[5] - way[1] - way[3];
    part[3][i] = -way[2] - way[4] - way[5];
  }
  part[0][3] = part[1][3] = part[2][3] = part[3][3] = 0.5f * (in + out);
}

typedef void Find(const Group *g, const CwEight *own, CwEight part[4][4]);

CW_INLINE void add_sums(const CwDelaunay *mesh, const int32_t *list, int32_t count, const CwFour *place, Find *find,
                        CwFour *sum) {
  for (int32_t from = 0; from < count; from += GROUP) {
    const int32_t *its = list + from;
    int some = count - from < GROUP ? count - from : GROUP;
    Group group;
    CwEight own, part[4][4];
    for (int k = 0; k < GROUP; k++) own[k] = (float)mesh->tet[its[k]].weight;
    take_group(mesh, its, place, &group);
    find(&group, &own, part);
    for (int c = 0; c < 4; c++) cw_eight_turn(part[c]);
    for (int k = 0; k < HALF && k < some; k++) {
      for (int c = 0; c < 4; c++) sum[mesh->tet[its[k]].corner[c]] += cw_eight_low(part[c][k]);
    }
    for (int k = HALF; k < some; k++) {
      for (int c = 0; c < 4; c++) sum[mesh->tet[its[k]].corner[c]] += cw_eight_high(part[c][k - HALF]);
    }
  }
}

CW_INLINE void add_any(const CwDelaunay *mesh, const int32_t *list, int32_t count, const CwFour *place, int pulls,
                       CwFour *sum) {
  if (pulls)
    add_sums(mesh, list, count, place, find_pulls, sum);
  else
    add_sums(mesh, list, count, place, find_centres, sum);
}

CW_WIDE static void add_wide(const CwDelaunay *mesh, const int32_t *list, int32_t count, const CwFour *place, int pulls,
                             CwFour *sum) {
  add_any(mesh, list, count, place, pulls, sum);
}

static void add(const CwDelaunay *mesh, const int32_t *list, int32_t count, const CwFour *place, int pulls,
                CwFour *sum) {
  if (CW_HAS_WIDE)
    add_wide(mesh, list, count, place, pulls, sum);
  else
    add_any(mesh, list, count, place, pulls, sum);
}

void cw_tet_add_centres(const CwDelaunay *mesh, const int32_t *list, int32_t count, const CwFour *place, CwFour *sum) {
  add(mesh, list, count, place, 0, sum);
}

void cw_tet_add_pulls(const CwDelaunay *mesh, const int32_t *list, int32_t count, const CwFour *place, CwFour *sum) {
  add(mesh, list, count, place, 1, sum);
}

CW_INLINE void find_qualities(const CwDelaunay *mesh, const int32_t *list, const CwFour *place, float too_short,
                              float slender_square, float *quality, int32_t *slender) {
  Group group, *g = &group;
  CwEight edge[6][3], l[6], face[4][3], n[4], shortest, longest;
  take_group(mesh, list, place, g);
  find_edges(g, edge, l);
  find_extremes(l, &shortest, &longest);
  cw_eight_cross(g->arm[1], g->arm[2], face[1]);
  cw_eight_cross(g->arm[2], g->arm[0], face[2]);
  cw_eight_cross(g->arm[0], g->arm[1], face[3]);
  for (int i = 0; i < 3; i++) face[0][i] = face[1][i] + face[2][i] + face[3][i];
  CwEight scale = 1.0f / longest, six = scale * cw_eight_dot(g->arm[2], face[3]);
  for (int f = 0; f < 4; f++) n[f] = scale * scale * cw_eight_dot(face[f], face[f]);
  CwEight least = cw_eight_less(cw_eight_less(l[0] * (n[0] * n[1]), l[1] * (n[0] * n[2])),
                                cw_eight_less(l[2] * (n[0] * n[3]), l[3] * (n[1] * n[2])));
  least = cw_eight_less(least, cw_eight_less(l[4] * (n[1] * n[3]), l[5] * (n[2] * n[3])));
  least = six * six * scale * (scale * least) / (n[0] * n[1] * n[2] * n[3]);
  CwEight aspect = (float)CW_TET_ASPECT * shortest * scale;
  CwEight counted = cw_eight_more(aspect, cw_eight_sqrt((float)CW_TET_SLENDER * aspect)); // the root, below that
  CwEightMask is_slender = longest > slender_square * shortest;
  CwEight all = cw_eight_if((six > 0.0f) & (shortest > too_short), cw_eight_sqrt(cw_eight_less(least, counted)));
  memcpy(quality, &all, sizeof all);
  memcpy(slender, &is_slender, sizeof is_slender);
}

CW_WIDE static void find_qualities_wide(const CwDelaunay *mesh, const int32_t *list, const CwFour *place,
                                        float too_short, float slender_square, float *quality, int32_t *slender) {
  find_qualities(mesh, list, place, too_short, slender_square, quality, slender);
}

void cw_tet_group_qualities(const CwDelaunay *mesh, const int32_t list[CW_TET_GROUP], const CwFour *place,
                            float too_short, float slender_square, float quality[CW_TET_GROUP],
                            int32_t slender[CW_TET_GROUP]) {
  if (CW_HAS_WIDE)
    find_qualities_wide(mesh, list, place, too_short, slender_square, quality, slender);
  else
    find_qualities(mesh, list, place, too_short, slender_square, quality, slender);
}
