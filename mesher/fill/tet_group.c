// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_group.h"

#include <string.h>

#include "mesher/common/simd_8f.h"
#include "mesher/fill/tet_quality.h"

enum { GROUP = CW_TET_GROUP, HALF = GROUP / 2 };
enum { AHEAD = 128 }; // places ahead that are prefetched

// The vectors from the first corners of eight tetrahedra to the others, by corner and coordinate.
typedef struct {
  Cw8f arm[3][4];
} Group;

CW_INLINE void take_group(const CwTetMesh *mesh, const int32_t *list, const Cw4f *place, Group *g) {
  for (int k = 0; k < HALF; k++) {
    const CwTet *low = &mesh->tet[list[k]], *high = &mesh->tet[list[k + HALF]];
    cw_tet_prefetch(low, AHEAD);
    cw_tet_prefetch(high, AHEAD);
    Cw4f from[2] = {place[low->corner[0]], place[high->corner[0]]};
    for (int c = 0; c < 3; c++)
      g->arm[c][k] = cw_8f_join(place[low->corner[c + 1]] - from[0], place[high->corner[c + 1]] - from[1]);
  }
  for (int c = 0; c < 3; c++) cw_8f_transpose(g->arm[c]);
}

// The edges and their squares in the order of cw_tet_edge.
CW_INLINE void find_edges(const Group *g, Cw8f edge[6][3], Cw8f square[6]) {
  const Cw8f *a = g->arm[0], *b = g->arm[1], *c = g->arm[2];
  for (int i = 0; i < 3; i++) {
    edge[0][i] = a[i], edge[1][i] = b[i], edge[2][i] = c[i];
    edge[3][i] = b[i] - a[i], edge[4][i] = c[i] - a[i], edge[5][i] = c[i] - b[i];
  }
  for (int e = 0; e < 6; e++) square[e] = cw_8f_dot(edge[e], edge[e]);
}

CW_INLINE void find_extremes(const Cw8f square[6], Cw8f *least, Cw8f *most) {
  *least = *most = square[0];
  for (int e = 1; e < 6; e++) {
    *least = cw_8f_min(*least, square[e]);
    *most = cw_8f_max(*most, square[e]);
  }
}

// What each corner is to have, by corner and coordinate: the weighted displacement and the weight.
CW_INLINE void find_centres(const Group *g, Cw8f part[4][4]) {
  Cw8f edge[6][3], l[6], bc[3], ca[3], ab[3];
  find_edges(g, edge, l);
  cw_8f_cross(g->arm[1], g->arm[2], bc);
  cw_8f_cross(g->arm[2], g->arm[0], ca);
  cw_8f_cross(g->arm[0], g->arm[1], ab);
  Cw8f squares = l[0] + l[1] + l[2] + l[3] + l[4] + l[5];
  Cw8f scale = 1.0f / (squares * cw_8f_sqrt(squares)), weight = scale * cw_8f_dot(g->arm[0], bc);
  for (int i = 0; i < 3; i++) {
    Cw8f centre = 0.5f * scale * (l[0] * bc[i] + l[1] * ca[i] + l[2] * ab[i]);
    part[0][i] = centre;
    for (int m = 0; m < 3; m++) part[m + 1][i] = centre - weight * g->arm[m][i];
  }
  for (int m = 0; m < 4; m++) part[m][3] = weight;
}

CW_INLINE void find_pulls(const Group *g, Cw8f part[4][4]) {
  Cw8f edge[6][3], square[6], step[6], pull[6], least, most;
  find_edges(g, edge, square);
  find_extremes(square, &least, &most);
  Cw8fMask sound = least > (float)CW_TET_FLAT * most;
  Cw8f in = cw_8f_if(sound, 1.0f / cw_8f_sqrt(least * most));
  Cw8f out = cw_8f_if(sound, in * most / least);
  for (int e = 0; e < 6; e++) step[e] = cw_8f_if(square[e] == most, in) - cw_8f_if(square[e] == least, out);
  for (int i = 0; i < 3; i++) {
    for (int e = 0; e < 6; e++) pull[e] = step[e] * edge[e][i];
    part[0][i] = pull[0] + pull[1] + pull[2];
    part[1][i] = pull[3] + pull[4] - pull[0];
    part[2][i] = pull[5] - pull[1] - pull[3];
    part[3][i] = -pull[2] - pull[4] - pull[5];
  }
  part[0][3] = part[1][3] = part[2][3] = part[3][3] = 0.5f * (in + out);
}

typedef void Find(const Group *g, Cw8f part[4][4]);

CW_INLINE void add_sums(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, Find *find,
                        Cw4f *sum) {
  for (int32_t from = 0; from < count; from += GROUP) {
    const int32_t *its = list + from;
    int some = count - from < GROUP ? count - from : GROUP;
    Group group;
    Cw8f part[4][4];
    take_group(mesh, its, place, &group);
    find(&group, part);
    for (int c = 0; c < 4; c++) cw_8f_transpose(part[c]);
    for (int k = 0; k < HALF && k < some; k++) {
      for (int c = 0; c < 4; c++) sum[mesh->tet[its[k]].corner[c]] += cw_8f_low(part[c][k]);
    }
    for (int k = HALF; k < some; k++) {
      for (int c = 0; c < 4; c++) sum[mesh->tet[its[k]].corner[c]] += cw_8f_high(part[c][k - HALF]);
    }
  }
}

CW_INLINE void add_any(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, int pulls,
                       Cw4f *sum) {
  if (pulls)
    add_sums(mesh, list, count, place, find_pulls, sum);
  else
    add_sums(mesh, list, count, place, find_centres, sum);
}

CW_AVX2 static void add_avx2(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, int pulls,
                             Cw4f *sum) {
  add_any(mesh, list, count, place, pulls, sum);
}

static void add(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, int pulls, Cw4f *sum) {
  if (CW_HAS_AVX2)
    add_avx2(mesh, list, count, place, pulls, sum);
  else
    add_any(mesh, list, count, place, pulls, sum);
}

void cw_tet_add_centres(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, Cw4f *sum) {
  add(mesh, list, count, place, 0, sum);
}

void cw_tet_add_pulls(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, Cw4f *sum) {
  add(mesh, list, count, place, 1, sum);
}

CW_INLINE void find_qualities(const CwTetMesh *mesh, const int32_t *list, const Cw4f *place, float too_short,
                              float slender_square, float *quality, int32_t *slender) {
  Group group, *g = &group;
  Cw8f edge[6][3], l[6], face[4][3], n[4], shortest, longest;
  take_group(mesh, list, place, g);
  find_edges(g, edge, l);
  find_extremes(l, &shortest, &longest);
  cw_8f_cross(g->arm[1], g->arm[2], face[1]);
  cw_8f_cross(g->arm[2], g->arm[0], face[2]);
  cw_8f_cross(g->arm[0], g->arm[1], face[3]);
  for (int i = 0; i < 3; i++) face[0][i] = face[1][i] + face[2][i] + face[3][i];
  Cw8f scale = 1.0f / longest, six = scale * cw_8f_dot(g->arm[2], face[3]);
  for (int f = 0; f < 4; f++) n[f] = scale * scale * cw_8f_dot(face[f], face[f]);
  Cw8f least = cw_8f_min(cw_8f_min(l[0] * (n[0] * n[1]), l[1] * (n[0] * n[2])),
                         cw_8f_min(l[2] * (n[0] * n[3]), l[3] * (n[1] * n[2])));
  least = cw_8f_min(least, cw_8f_min(l[4] * (n[1] * n[3]), l[5] * (n[2] * n[3])));
  least = six * six * scale * (scale * least) / (n[0] * n[1] * n[2] * n[3]);
  Cw8f aspect = (float)CW_TET_ASPECT * shortest * scale;
  Cw8f counted = cw_8f_max(aspect, cw_8f_sqrt((float)CW_TET_SLENDER * aspect)); // the root, below that
  Cw8fMask is_slender = longest > slender_square * shortest;
  Cw8f all = cw_8f_if((six > 0.0f) & (shortest > too_short), cw_8f_sqrt(cw_8f_min(least, counted)));
  memcpy(quality, &all, sizeof all);
  memcpy(slender, &is_slender, sizeof is_slender);
}

CW_AVX2 static void find_qualities_avx2(const CwTetMesh *mesh, const int32_t *list, const Cw4f *place, float too_short,
                                        float slender_square, float *quality, int32_t *slender) {
  find_qualities(mesh, list, place, too_short, slender_square, quality, slender);
}

void cw_tet_group_qualities(const CwTetMesh *mesh, const int32_t list[CW_TET_GROUP], const Cw4f *place, float too_short,
                            float slender_square, float quality[CW_TET_GROUP], int32_t slender[CW_TET_GROUP]) {
  if (CW_HAS_AVX2)
    find_qualities_avx2(mesh, list, place, too_short, slender_square, quality, slender);
  else
    find_qualities(mesh, list, place, too_short, slender_square, quality, slender);
}
