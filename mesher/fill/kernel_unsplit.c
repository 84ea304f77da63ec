// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_unsplit.h"

#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/fill/hollow.h"

static const int8_t tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

static int has(const int32_t *list, int count, int32_t item) {
  for (int k = 0; k < count; k++) {
    if (list[k] == item) return 1;
  }
  return 0;
}

// The faces round the point of the split: those opposite it in its star, then the triangles it divided.
static CwStatus gather_hollow(const CwFlips *flips, const CwSplit *split, CwHollow *h) {
  CwStatus status = CW_OK;
  const CwDelaunay *mesh = flips->mesh;
  h->count = 0;
  for (int32_t k = 0; k < flips->star_count; k++) {
    const CwDelaunayTet *tet = &mesh->tet[flips->star[k]];
    int i = 0;
    while (tet->corner[i] != split->point) i++;
    const int32_t face[3] = {tet->corner[tet_face[i][0]], tet->corner[tet_face[i][2]], tet->corner[tet_face[i][1]]};
    CW_TRY(cw_hollow_add(h, mesh, face));
  }
  for (int k = 0; k < split->count; k++) {
    const int32_t face[3] = {split->ends[k][1], split->ends[k][0], split->apex[k]};
    CW_TRY(cw_hollow_add(h, mesh, face));
  }
done:
  return status;
}

// A place inside from which the point sees all of the hollow. *good is 0 where there is none.
static void find_place(const CwDelaunay *mesh, const CwSplit *split, const CwHollow *h, double p[3], int *good) {
  double inward[3] = {0, 0, 0};
  for (int k = 0; k < split->count; k++) {
    for (int i = 0; i < 3; i++) inward[i] += h->normal[h->count - 1 - k][i];
  }
  cw_unit(inward);
  *good = cw_hollow_place(h, mesh, mesh->point[split->point].x, inward, p) > 0.0;
}

// The tetrahedron of the star that has the face on the boundary, as 4 * tetrahedron + face; -1: none.
static int32_t face_of(const CwFlips *flips, int32_t a, int32_t b, int32_t c) {
  const int32_t wanted[3] = {a, b, c};
  for (int32_t k = 0; k < flips->star_count; k++) {
    const CwDelaunayTet *tet = &flips->mesh->tet[flips->star[k]];
    for (int i = 0; i < 4; i++) {
      int32_t f[3] = {tet->corner[tet_face[i][0]], tet->corner[tet_face[i][1]], tet->corner[tet_face[i][2]]};
      if (tet->neighbour[i] < 0 && has(wanted, 3, f[0]) && has(wanted, 3, f[1]) && has(wanted, 3, f[2]))
        return 4 * flips->star[k] + i;
    }
  }
  return -1;
}

static void join(CwDelaunay *mesh, int32_t one, int32_t other) {
  mesh->tet[one / 4].neighbour[one % 4] = other;
  mesh->tet[other / 4].neighbour[other % 4] = one;
}

// Moves the point in and closes the boundary behind it.
static CwStatus take_off(CwFlips *flips, const CwSplit *split, CwHollow *h, int *good) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = flips->mesh;
  int32_t side[2][3] = {{-1, -1, -1}, {-1, -1, -1}}, made[2];
  double p[3];
  CW_TRY(cw_flips_star(flips, split->point));
  CW_TRY(gather_hollow(flips, split, h));
  find_place(mesh, split, h, p, good);
  for (int k = 0; k < split->count; k++) { // opposite ends[0], ends[1], apex
    const int32_t *e = split->ends[k], c = split->apex[k], s = split->point;
    side[k][0] = face_of(flips, s, e[1], c);
    side[k][1] = face_of(flips, e[0], s, c);
    if (split->count == 1) side[k][2] = face_of(flips, e[0], e[1], s);
    *good = *good && side[k][0] >= 0 && side[k][1] >= 0 && (split->count == 2 || side[k][2] >= 0);
  }
  if (!*good) goto done;
  cw_copy(p, mesh->point[split->point].x);
  for (int k = 0; k < split->count; k++) CW_TRY(cw_delaunay_new_tet(mesh, &made[k]));
  for (int k = 0; k < split->count; k++) {
    const int32_t corner[4] = {split->ends[k][1], split->ends[k][0], split->apex[k], split->point};
    CwDelaunayTet *tet = &mesh->tet[made[k]];
    memcpy(tet->corner, corner, sizeof corner);
    tet->stamp = 0;
    tet->neighbour[3] = -1;
    join(mesh, 4 * made[k] + 1, side[k][0]);
    join(mesh, 4 * made[k] + 0, side[k][1]);
    if (split->count == 1)
      join(mesh, 4 * made[k] + 2, side[k][2]);
    else
      tet->neighbour[2] = 4 * made[1 - k] + 2;
    for (int i = 0; i < 4; i++) flips->tet_at[corner[i]] = made[k];
  }
done:
  return status;
}

CwStatus cw_kernel_unsplit(CwDelaunay *mesh, const CwSplits *splits, int *good) {
  CwStatus status = CW_OK;
  CwFlips flips;
  CwHollow h = {0};
  *good = 1;
  CW_TRY(cw_flips_make(mesh, &flips));
  for (int32_t k = splits->count - 1; k >= 0 && *good; k--) CW_TRY(take_off(&flips, &splits->split[k], &h, good));
done:
  cw_flips_free(&flips);
  cw_hollow_free(&h);
  return status;
}
