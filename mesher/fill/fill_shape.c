// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_shape.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/mix.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/tet.h"

// An edge of a triangle at its end of the smaller number.
typedef struct {
  int32_t high; // the other end
  int32_t sign; // +1: towards it
} Directed;

static int same_place(const double a[3], const double b[3]) {
  return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static uint64_t scatter(const double x[3]) {
  uint64_t hash = 0;
  for (int i = 0; i < 3; i++) {
    double value = x[i] + 0.0; // -0 is 0
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    hash = cw_mix(hash + CW_MIX_STEP + bits);
  }
  return hash;
}

// Fails where two points are at one place: they meet in a hash table.
static CwStatus check_points(const CwFillInput *input) {
  CwStatus status = CW_OK;
  int32_t *table = NULL; // 1 + point
  uint64_t space = 2 * (uint64_t)input->point_count + 1;
  CW_NEW(table, space);
  for (int32_t p = 0; p < input->point_count; p++) {
    const double *x = input->x[p];
    uint64_t k = (scatter(x) >> 32) * space >> 32;
    for (; table[k]; k = k + 1 < space ? k + 1 : 0)
      CW_REQUIRE(!same_place(input->x[table[k] - 1], x), CW_ERR_MESH,
                 "%s: two points of the boundary coincide at (%.6g, %.6g, %.6g) mm", input->name, CW_MM(x));
    table[k] = 1 + p;
  }
done:
  free(table);
  return status;
}

CwStatus cw_fill_check_closed(const CwFillInput *input) {
  CwStatus status = CW_OK;
  Directed *edge = NULL;
  int64_t *start = NULL, count = 3 * (int64_t)input->triangle_count;
  int32_t *sum = NULL; // of the signs of the edges from one point to each other
  CW_TRY(check_points(input));
  CW_NEW(edge, count);
  CW_NEW(sum, input->point_count);
  CW_NEW(start, (int64_t)input->point_count + 2);
  CW_REQUIRE(input->triangle_count >= 4, CW_ERR_MESH, "%s: the boundary has %d triangles; at least 4 are needed",
             input->name, input->triangle_count);
  for (int64_t k = 0; k < count; k++) {
    const int32_t *p = input->triangle[k / 3];
    int32_t a = p[k % 3], b = p[(k + 1) % 3];
    CW_REQUIRE(a >= 0 && a < input->point_count && b >= 0 && b < input->point_count && a != b, CW_ERR_MESH,
               "%s: boundary triangle %lld has points %d, %d, %d; three different ones from 0 to %d are allowed",
               input->name, (long long)(k / 3), p[0], p[1], p[2], input->point_count - 1);
    start[(a < b ? a : b) + 2]++;
  }
  for (int32_t p = 0; p < input->point_count; p++) start[p + 2] += start[p + 1];
  for (int64_t k = 0; k < count; k++) { // leaves start[p + 1] at the end of the list of p
    const int32_t *p = input->triangle[k / 3];
    int32_t a = p[k % 3], b = p[(k + 1) % 3];
    edge[start[(a < b ? a : b) + 1]++] = a < b ? (Directed){b, 1} : (Directed){a, -1};
  }
  for (int32_t p = 0; p < input->point_count; p++) {
    for (int64_t k = start[p]; k < start[p + 1]; k++) sum[edge[k].high] += edge[k].sign;
    for (int64_t k = start[p]; k < start[p + 1]; k++) { // all sums are 0 again, or it fails
      const double *a = input->x[p], *b = input->x[edge[k].high];
      CW_REQUIRE(sum[edge[k].high] == 0, CW_ERR_MESH,
                 "%s: the boundary is open or turned over at the edge from (%.6g, %.6g, %.6g) to (%.6g, %.6g, "
                 "%.6g) mm",
                 input->name, CW_MM(a), CW_MM(b));
    }
  }
done:
  free(edge);
  free(start);
  free(sum);
  return status;
}

// A face by its points, for matching: bucket by the least point, the other two in ascending order.
typedef struct {
  int32_t middle, high;
  int32_t owner; // 4 * tetrahedron + face; or -1 - triangle of the boundary
} Face;

static int32_t face_of(const int32_t p[3], int32_t owner, Face *face) {
  int32_t a = p[0], b = p[1], c = p[2], swap;
  if (a > b) swap = a, a = b, b = swap;
  if (b > c) swap = b, b = c, c = swap;
  if (a > b) swap = a, a = b, b = swap;
  *face = (Face){b, c, owner};
  return a;
}

// Faces in buckets of their least points; within a bucket in the order (middle, high, owner).
static CwStatus sort_faces(int32_t point_count, int32_t tetrahedron_count, const int32_t (*tetrahedron)[4],
                           int32_t triangle_count, const int32_t (*triangle)[3], int64_t **start, Face **face) {
  CwStatus status = CW_OK;
  CW_NEW(*start, (int64_t)point_count + 1);
  CW_NEW(*face, 4 * (int64_t)tetrahedron_count + triangle_count);
  for (int pass = 0; pass < 2; pass++) {
    for (int64_t k = 4 * (int64_t)tetrahedron_count - 1; k >= -(int64_t)triangle_count; k--) {
      int32_t p[3];
      Face one;
      for (int i = 0; i < 3; i++) p[i] = k < 0 ? triangle[-1 - k][i] : tetrahedron[k / 4][cw_tet_face[k % 4][i]];
      int32_t least = face_of(p, (int32_t)k, &one);
      if (pass == 0)
        ++(*start)[least];
      else
        (*face)[--(*start)[least]] = one;
    }
    int64_t total = 0;
    for (int32_t p = 0; pass == 0 && p <= point_count; p++) {
      total += (*start)[p];
      (*start)[p] = total;
    }
  }
  for (int32_t p = 0; p < point_count; p++) {
    Face *f = *face + (*start)[p];
    int64_t n = (*start)[p + 1] - (*start)[p];
    for (int64_t i = 1; i < n; i++) { // short lists: insertion; equal faces keep the order of their owners
      Face one = f[i];
      int64_t j = i;
      for (; j > 0 && (f[j - 1].middle > one.middle || (f[j - 1].middle == one.middle && f[j - 1].high > one.high));
           j--)
        f[j] = f[j - 1];
      f[j] = one;
    }
  }
done:
  return status;
}

static int same(const Face *a, const Face *b) {
  return a->middle == b->middle && a->high == b->high;
}

CwStatus cw_tet_neighbours(int32_t point_count, int32_t tetrahedron_count, const int32_t (*tetrahedron)[4],
                           int32_t (*neighbour)[4]) {
  CwStatus status = CW_OK;
  int64_t *start = NULL;
  Face *face = NULL;
  CW_REQUIRE(tetrahedron_count < INT32_MAX / 4, CW_ERR_MESH, "%d tetrahedra in one region; at most %d are allowed",
             tetrahedron_count, INT32_MAX / 4);
  CW_TRY(sort_faces(point_count, tetrahedron_count, tetrahedron, 0, NULL, &start, &face));
  for (int32_t p = 0; p < point_count; p++) {
    for (int64_t k = start[p], next; k < start[p + 1]; k = next) {
      for (next = k + 1; next < start[p + 1] && same(&face[k], &face[next]);) next++;
      CW_REQUIRE(next - k <= 2, CW_ERR_MESH, "a face of tetrahedron %d belongs to more than two", face[k].owner / 4);
      int32_t a = face[k].owner, b = next - k == 2 ? face[k + 1].owner : -1;
      neighbour[a / 4][a % 4] = b;
      if (b >= 0) neighbour[b / 4][b % 4] = a;
    }
  }
done:
  free(face);
  free(start);
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
  int64_t *start = NULL;
  Face *face = NULL;
  const int32_t(*tet)[4] = (const int32_t(*)[4])fill->tetrahedron;
  CW_TRY(sort_faces(fill->point_count, fill->tetrahedron_count, tet, input->triangle_count, input->triangle, &start,
                    &face));
  for (int32_t p = 0; p < fill->point_count; p++) {
    for (int64_t k = start[p], next; k < start[p + 1]; k = next) {
      int64_t listed = 0;
      for (next = k; next < start[p + 1] && same(&face[k], &face[next]); next++) listed += face[next].owner < 0;
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
  }
done:
  free(face);
  free(start);
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
