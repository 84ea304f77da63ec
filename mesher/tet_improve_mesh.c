// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/tet_improve_mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fill_shape.h"

static const int tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

static void difference(const double a[3], const double b[3], double d[3]) {
  d[0] = a[0] - b[0], d[1] = a[1] - b[1], d[2] = a[2] - b[2];
}

static void cross(const double a[3], const double b[3], double c[3]) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double cw_tet_quality(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double ab[3], ac[3], ad[3], bc[3], bd[3], cd[3], na[3], nb[3], nc[3], nd[3];
  difference(b, a, ab);
  difference(c, a, ac);
  difference(d, a, ad);
  cross(ab, ac, nd);
  double six = dot(nd, ad);
  if (!(six > 0.0))
    return -1.0;
  difference(c, b, bc);
  difference(d, b, bd);
  difference(d, c, cd);
  cross(ac, ad, nb);
  cross(ad, ab, nc);
  cross(bc, bd, na);
  double aa = dot(na, na), bb = dot(nb, nb), cc = dot(nc, nc), dd = dot(nd, nd);
  double l[6] = {dot(ab, ab), dot(ac, ac), dot(ad, ad), dot(bc, bc), dot(bd, bd), dot(cd, cd)};
  // sin of the angle at an edge = 6 V times the edge over the (doubled) areas of its two faces; squares here.
  double least = fmin(fmin(l[0] / (cc * dd), l[1] / (bb * dd)), fmin(l[2] / (bb * cc), l[3] / (aa * dd)));
  least = six * six * fmin(least, fmin(l[4] / (aa * cc), l[5] / (aa * bb)));
  double shortest = fmin(fmin(fmin(l[0], l[1]), fmin(l[2], l[3])), fmin(l[4], l[5]));
  double longest = fmax(fmax(fmax(l[0], l[1]), fmax(l[2], l[3])), fmax(l[4], l[5]));
  return sqrt(fmin(least, 1.8225 * shortest / longest));
}

static double quality_of(const CwTetMesh *mesh, const int32_t p[4]) {
  return cw_tet_quality(mesh->x[p[0]], mesh->x[p[1]], mesh->x[p[2]], mesh->x[p[3]]);
}

CwStatus cw_tet_mesh_make(int32_t fixed_count, int32_t point_count, double (*x)[3], int32_t tet_count,
                          int32_t (*corner)[4], CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  *mesh = (CwTetMesh){.fixed_count = fixed_count,
                      .point_count = point_count,
                      .point_space = point_count,
                      .x = x,
                      .tet_count = tet_count,
                      .tet_space = tet_count,
                      .corner = corner};
  CW_NEW(mesh->neighbour, tet_count);
  CW_NEW(mesh->quality, tet_count);
  CW_NEW(mesh->tet_at, point_count);
  CW_TRY(cw_tet_neighbours(point_count, tet_count, (const int32_t(*)[4])corner, mesh->neighbour));
  for (int32_t p = 0; p < point_count; p++)
    mesh->tet_at[p] = -1;
  for (int32_t t = 0; t < tet_count; t++) {
    mesh->quality[t] = quality_of(mesh, corner[t]);
    for (int i = 0; i < 4; i++)
      mesh->tet_at[corner[t][i]] = t;
  }
done:
  return status;
}

void cw_tet_mesh_free(CwTetMesh *mesh) {
  free(mesh->neighbour);
  free(mesh->quality);
  free(mesh->tet_at);
  free(mesh->dead);
  mesh->neighbour = NULL;
  mesh->quality = NULL;
  mesh->tet_at = mesh->dead = NULL;
}

CwStatus cw_tet_mesh_squeeze(CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t *number = NULL, tets = 0, points = mesh->fixed_count;
  CW_NEW(number, mesh->point_count);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    if (mesh->corner[t][0] < 0)
      continue;
    for (int i = 0; i < 4; i++)
      number[mesh->corner[t][i]] = 1;
    memmove(mesh->corner[tets], mesh->corner[t], sizeof *mesh->corner);
    mesh->quality[tets++] = mesh->quality[t];
  }
  for (int32_t p = 0; p < mesh->point_count; p++) {
    if (p >= mesh->fixed_count && !number[p])
      continue;
    int32_t to = p < mesh->fixed_count ? p : points++;
    number[p] = to;
    memmove(mesh->x[to], mesh->x[p], sizeof *mesh->x);
  }
  for (int32_t t = 0; t < tets; t++) {
    for (int i = 0; i < 4; i++)
      mesh->corner[t][i] = number[mesh->corner[t][i]];
  }
  mesh->tet_count = tets;
  mesh->point_count = points;
  mesh->dead_count = 0;
done:
  free(number);
  return status;
}

#define GROW(pointer, space)                                                                                 \
  do {                                                                                                       \
    void *grown = realloc((pointer), (size_t)(space) * sizeof *(pointer));                                   \
    CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d items of the mesh", (int)(space));                   \
    (pointer) = grown;                                                                                       \
  } while (0)

CwStatus cw_tet_mesh_add_point(CwTetMesh *mesh, const double x[3], int32_t *point) {
  CwStatus status = CW_OK;
  if (mesh->point_count == mesh->point_space) {
    int32_t space = mesh->point_space + mesh->point_space / 8 + 64;
    GROW(mesh->x, space);
    GROW(mesh->tet_at, space);
    mesh->point_space = space;
  }
  *point = mesh->point_count++;
  memcpy(mesh->x[*point], x, sizeof *mesh->x);
  mesh->tet_at[*point] = -1;
done:
  return status;
}

// A place for one more tetrahedron: a dead one's, or at the end.
static CwStatus new_slot(CwTetMesh *mesh, int32_t *slot) {
  CwStatus status = CW_OK;
  if (mesh->dead_count) {
    *slot = mesh->dead[--mesh->dead_count];
    goto done;
  }
  if (mesh->tet_count == mesh->tet_space) {
    int32_t space = mesh->tet_space + mesh->tet_space / 8 + 64;
    GROW(mesh->corner, space);
    GROW(mesh->neighbour, space);
    GROW(mesh->quality, space);
    mesh->tet_space = space;
  }
  *slot = mesh->tet_count++;
done:
  return status;
}

static CwStatus bury(CwTetMesh *mesh, int32_t t) {
  CwStatus status = CW_OK;
  if (mesh->dead_count == mesh->dead_space) {
    int32_t space = 2 * mesh->dead_space + 64;
    GROW(mesh->dead, space);
    mesh->dead_space = space;
  }
  mesh->dead[mesh->dead_count++] = t;
  mesh->corner[t][0] = -1;
done:
  return status;
}

int cw_tet_mesh_ring(const CwTetMesh *mesh, int32_t t, int i, int j, int most, int32_t *tet, int32_t *ring) {
  // The other two corners in the order that makes (i, j, first, second) an even permutation.
  static const int8_t first_of[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};
  int32_t start = t;
  int first = first_of[i][j], second = 6 - i - j - first, count = 0;
  int32_t from = mesh->corner[t][first], to = mesh->corner[t][second];
  do {
    if (count == most)
      return 0;
    tet[count] = t;
    ring[count++] = from;
    // Over the face a, b, to, which lies opposite `from`.
    int at = 0;
    while (mesh->corner[t][at] != from)
      at++;
    int32_t next = mesh->neighbour[t][at];
    if (next < 0)
      return 0;
    t = next / 4;
    from = to;
    to = mesh->corner[t][next % 4];
  } while (t != start);
  return count;
}

int cw_tet_mesh_star(const CwTetMesh *mesh, int32_t point, int32_t tet[CW_CAVITY]) {
  int count = 1;
  if (point < mesh->fixed_count)
    return 0;
  tet[0] = mesh->tet_at[point];
  for (int head = 0; head < count; head++) {
    int32_t t = tet[head];
    for (int i = 0; i < 4; i++) {
      if (mesh->corner[t][i] == point)
        continue;
      int32_t next = mesh->neighbour[t][i] / 4;
      int known = mesh->neighbour[t][i] < 0;
      for (int k = 0; k < count && !known; k++)
        known = tet[k] == next;
      if (known)
        continue;
      if (count == CW_CAVITY)
        return 0;
      tet[count++] = next;
    }
  }
  return count;
}

typedef struct {
  int32_t p[3];  // ascending
  int32_t owner; // 4 * tetrahedron + face, or what lies outside
  int32_t outer; // 1: owner lies outside of the cavity
} Side;

static void sort_three(int32_t p[3]) {
  int32_t swap;
  if (p[0] > p[1])
    swap = p[0], p[0] = p[1], p[1] = swap;
  if (p[1] > p[2])
    swap = p[1], p[1] = p[2], p[2] = swap;
  if (p[0] > p[1])
    swap = p[0], p[0] = p[1], p[1] = swap;
}

CwStatus cw_tet_mesh_replace(CwTetMesh *mesh, int old_count, const int32_t *old, int count,
                             const int32_t (*corner)[4], const double *quality) {
  CwStatus status = CW_OK;
  Side side[4 * 3 * CW_CAVITY];
  int32_t slot[2 * CW_CAVITY];
  int sides = 0;
  CW_REQUIRE(old_count <= CW_CAVITY && count <= 2 * CW_CAVITY, CW_ERR_MESH, "a cavity of %d tetrahedra",
             old_count);
  for (int k = 0; k < old_count; k++) {
    for (int i = 0; i < 4; i++) {
      int32_t other = mesh->neighbour[old[k]][i];
      int within = 0;
      for (int m = 0; m < old_count && other >= 0; m++)
        within |= other / 4 == old[m];
      if (within)
        continue;
      Side *s = &side[sides++];
      for (int n = 0; n < 3; n++)
        s->p[n] = mesh->corner[old[k]][tet_face[i][n]];
      sort_three(s->p);
      s->owner = other;
      s->outer = 1;
    }
  }
  for (int k = 0; k < count; k++) {
    if (k < old_count)
      slot[k] = old[k];
    else
      CW_TRY(new_slot(mesh, &slot[k]));
  }
  for (int k = count; k < old_count; k++)
    CW_TRY(bury(mesh, old[k]));
  for (int k = 0; k < count; k++) {
    int32_t t = slot[k];
    memcpy(mesh->corner[t], corner[k], sizeof *mesh->corner);
    mesh->quality[t] = quality[k];
    for (int i = 0; i < 4; i++) {
      mesh->tet_at[corner[k][i]] = t;
      Side one = {.owner = 4 * t + i, .outer = 0};
      for (int n = 0; n < 3; n++)
        one.p[n] = corner[k][tet_face[i][n]];
      sort_three(one.p);
      int m = 0;
      while (m < sides && memcmp(side[m].p, one.p, sizeof one.p))
        m++;
      if (m == sides) {
        side[sides++] = one;
        continue;
      }
      mesh->neighbour[t][i] = side[m].owner;
      if (side[m].owner >= 0)
        mesh->neighbour[side[m].owner / 4][side[m].owner % 4] = one.owner;
      side[m] = side[--sides];
    }
  }
  CW_REQUIRE(sides == 0, CW_ERR_MESH, "a cavity of %d tetrahedra was not filled by its %d new ones",
             old_count, count);
done:
  return status;
}
