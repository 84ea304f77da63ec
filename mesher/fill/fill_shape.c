// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_shape.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/tet.h"
#include "mesher/fill/tet_topology.h"

// By the least point, the middle one, the greatest and the owner: messages name the first face in this order.
static int compare(const void *p, const void *q) {
  const CwTetSide *a = p, *b = q;
  if (a->ends >> 32 != b->ends >> 32) return a->ends < b->ends ? -1 : 1;
  if (a->middle != b->middle) return a->middle < b->middle ? -1 : 1;
  if (a->ends != b->ends) return a->ends < b->ends ? -1 : 1;
  return (a->owner > b->owner) - (a->owner < b->owner);
}

static int same(const CwTetSide *a, const CwTetSide *b) {
  return a->ends == b->ends && a->middle == b->middle;
}

// The faces of tetrahedra, and triangles with the owners -1 - triangle, in that order.
static CwStatus sort_faces(int32_t tetrahedron_count, const int32_t (*tetrahedron)[4], int32_t triangle_count,
                           const int32_t (*triangle)[3], int64_t *count, CwTetSide **face) {
  CwStatus status = CW_OK;
  *count = 4 * (int64_t)tetrahedron_count + triangle_count;
  CW_NEW_UNSET(*face, *count);
  CwTetSide *to = *face;
  for (int32_t t = 0; t < triangle_count; t++)
    *to++ = cw_side_of(triangle[t][0], triangle[t][1], triangle[t][2], -1 - t);
  for (int64_t k = 0; k < 4 * (int64_t)tetrahedron_count; k++)
    *to++ = cw_tet_side(tetrahedron[k / 4], (int)(k % 4), (int32_t)k);
  qsort(*face, (size_t)*count, sizeof **face, compare);
done:
  return status;
}

CwStatus cw_tet_neighbours(int32_t tetrahedron_count, const int32_t (*tetrahedron)[4], int32_t (*neighbour)[4]) {
  CwStatus status = CW_OK;
  int64_t faces;
  CwTetSide *face = NULL;
  CW_REQUIRE(tetrahedron_count < INT32_MAX / 4, CW_ERR_MESH,
             "%d tetrahedra in one region; allowed: below %d; lower mesh.cells_per_region", tetrahedron_count,
             INT32_MAX / 4);
  CW_TRY(sort_faces(tetrahedron_count, tetrahedron, 0, NULL, &faces, &face));
  for (int64_t k = 0, next; k < faces; k = next) {
    for (next = k + 1; next < faces && same(&face[k], &face[next]);) next++;
    CW_REQUIRE(next - k <= 2, CW_ERR_FAULT, "a face of tetrahedron %d belongs to more than two", face[k].owner / 4);
    int32_t a = face[k].owner, b = next - k == 2 ? face[k + 1].owner : -1;
    neighbour[a / 4][a % 4] = b;
    if (b >= 0) neighbour[b / 4][b % 4] = a;
  }
done:
  free(face);
  return status;
}

// True where p is an even permutation of q (of the same three points).
static int same_turn(const int32_t p[3], const int32_t q[3]) {
  int at = p[0] == q[0] ? 0 : p[0] == q[1] ? 1 : 2;
  return p[1] == q[(at + 1) % 3];
}

static CwStatus fail_triangle(const CwFillInput *input, int32_t t, const char *fault) {
  double mean[3] = {0, 0, 0};
  for (int k = 0; k < 3; k++) {
    for (int i = 0; i < 3; i++) mean[i] += cw_mm(input->x[input->triangle[t][k]][i]) / 3.0;
  }
  return CW_FAIL(CW_ERR_MESH, "%s: boundary triangle at (%.6g, %.6g, %.6g) mm %s", input->name, mean[0], mean[1],
                 mean[2], fault);
}

// Marks seeds on both sides of the boundary: side[t] is 1 inside, 2 outside; wall[t] has bit i where face i
// is boundary.
static CwStatus mark_boundary(const CwFillInput *input, const CwFill *fill, int32_t (*neighbour)[4], uint8_t *side,
                              uint8_t *wall) {
  CwStatus status = CW_OK;
  int64_t faces;
  CwTetSide *face = NULL;
  const int32_t(*tet)[4] = (const int32_t(*)[4])fill->tetrahedron;
  CW_TRY(sort_faces(fill->tetrahedron_count, tet, input->triangle_count, input->triangle, &faces, &face));
  for (int64_t k = 0, next; k < faces; k = next) {
    int64_t listed = 0;
    for (next = k; next < faces && same(&face[k], &face[next]); next++) listed += face[next].owner < 0;
    int64_t cells = next - k - listed;
    if (cells == 2) {
      int32_t a = face[k + listed].owner, b = face[k + listed + 1].owner;
      neighbour[a / 4][a % 4] = b;
      neighbour[b / 4][b % 4] = a;
    }
    if (listed == 0) continue;
    int32_t t = -1 - face[k].owner;
    if (listed > 1)
      status = fail_triangle(input, t, "is listed twice");
    else if (cells == 0)
      status = fail_triangle(input, t, "was lost by TetGen");
    if (status != CW_OK) goto done;
    for (int64_t c = k + 1; c < next; c++) {
      int32_t owner = face[c].owner, q[3];
      for (int i = 0; i < 3; i++) q[i] = tet[owner / 4][cw_tet_face[owner % 4][i]];
      uint8_t here = same_turn(input->triangle[t], q) ? 1 : 2;
      if (side[owner / 4] && side[owner / 4] != here) {
        status = fail_triangle(input, t, "has its normal turned against its neighbours");
        goto done;
      }
      side[owner / 4] = here;
      wall[owner / 4] |= (uint8_t)(1 << owner % 4);
    }
  }
done:
  free(face);
  return status;
}

CwStatus cw_fill_keep_inside(const CwFillInput *input, CwFill *fill) {
  CwStatus status = CW_OK;
  int32_t(*neighbour)[4] = NULL, *queue = NULL, *renumber = NULL;
  uint8_t *side = NULL, *wall = NULL;
  int32_t head = 0, tail = 0, count = fill->tetrahedron_count;
  CW_NEW(neighbour, count);
  CW_NEW(queue, count);
  CW_NEW(side, count);
  CW_NEW(wall, count);
  CW_NEW(renumber, fill->point_count);
  memset(neighbour, -1, (size_t)count * sizeof *neighbour);
  CW_TRY(mark_boundary(input, fill, neighbour, side, wall));
  for (int32_t t = 0; t < count; t++) {
    if (side[t]) queue[tail++] = t;
  }
  while (head < tail) {
    int32_t t = queue[head++];
    for (int i = 0; i < 4; i++) {
      if (neighbour[t][i] < 0 || wall[t] >> i & 1) continue;
      int32_t other = neighbour[t][i] / 4;
      if (!side[other]) {
        side[other] = side[t];
        queue[tail++] = other;
      }
      const double *at = fill->x[fill->tetrahedron[t][0]];
      CW_REQUIRE(side[other] == side[t], CW_ERR_MESH,
                 "%s: inside and outside of the boundary meet near (%.6g, %.6g, %.6g) mm: normals disagree",
                 input->name, CW_MM(at));
    }
  }
  int32_t kept = 0, points = input->point_count;
  for (int32_t t = 0; t < count; t++) {
    if (side[t] != 1) continue;
    memmove(fill->tetrahedron[kept++], fill->tetrahedron[t], sizeof *fill->tetrahedron);
  }
  CW_REQUIRE(kept > 0, CW_ERR_MESH, "%s: nothing lies inside the boundary: its normals point inward", input->name);
  fill->tetrahedron_count = kept;
  for (int32_t t = 0; t < kept; t++) {
    for (int i = 0; i < 4; i++) renumber[fill->tetrahedron[t][i]] = 1;
  }
  for (int32_t p = 0; p < fill->point_count; p++) {
    if (p >= input->point_count && !renumber[p]) continue;
    int32_t to = p < input->point_count ? p : points++;
    renumber[p] = to;
    memmove(fill->x[to], fill->x[p], sizeof *fill->x);
  }
  fill->point_count = points;
  for (int32_t t = 0; t < kept; t++) {
    for (int i = 0; i < 4; i++) fill->tetrahedron[t][i] = renumber[fill->tetrahedron[t][i]];
  }
done:
  free(renumber);
  free(wall);
  free(side);
  free(queue);
  free(neighbour);
  return status;
}
