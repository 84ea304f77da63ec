// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/simplify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// While triangles come there may be SLACK times as many as wanted; from then on the lattice grows.
enum { SLACK = 4 };
// Pull to the middle of the corners, over that of the planes: it chooses where planes leave a direction open.
static const double pull = 1e-3;

// The corners in one cube: their weights (areas) and sum, and the quadric of their planes about the origin.
typedef struct {
  double weight, sum[3], a[6], b[3]; // a: xx, yy, zz, xy, yz, zx
  double value_weight[CW_SIMPLIFY_VALUES], value_sum[CW_SIMPLIFY_VALUES];
} Cluster;

typedef struct {
  int32_t corner[3], mark;
} Triangle;

struct CwSimplifier {
  int64_t most;
  double cell, first_cell;
  Cluster *cluster;
  int32_t (*place)[3]; // of each cluster, in cells
  int32_t *table;      // clusters by their place, open addressing; -1: free
  int64_t table_size;  // a power of two
  int64_t cluster_count, cluster_space, place_space;
  Triangle *triangle;
  int64_t triangle_count, triangle_space;
};

void cw_simplify_free(CwSimplifier *s) {
  if (!s) return;
  free(s->cluster);
  free(s->place);
  free(s->table);
  free(s->triangle);
  free(s);
}

static int64_t slot_of(const CwSimplifier *s, const int32_t place[3]) {
  uint64_t hash = 0;
  for (int i = 0; i < 3; i++) hash = (hash ^ (uint32_t)place[i]) * 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
  int64_t at = (int64_t)(hash >> 20) & (s->table_size - 1);
  while (s->table[at] >= 0 && memcmp(s->place[s->table[at]], place, sizeof s->place[0]) != 0)
    at = (at + 1) & (s->table_size - 1);
  return at;
}

static CwStatus rehash(CwSimplifier *s, int64_t size) {
  CwStatus status = CW_OK;
  free(s->table);
  CW_NEW_UNSET(s->table, size);
  s->table_size = size;
  memset(s->table, -1, (size_t)size * sizeof *s->table);
  for (int64_t k = 0; k < s->cluster_count; k++) s->table[slot_of(s, s->place[k])] = (int32_t)k;
done:
  return status;
}

CwStatus cw_simplify_start(int64_t most, double cell, CwSimplifier **simplifier) {
  CwStatus status = CW_OK;
  CwSimplifier *s = NULL;
  CW_NEW(s, 1);
  s->most = most;
  s->cell = s->first_cell = cell;
  CW_TRY(rehash(s, 1024));
  *simplifier = s;
  s = NULL;
done:
  cw_simplify_free(s);
  return status;
}

// The cluster of the cube that holds x, made where it is new.
static CwStatus cluster_at(CwSimplifier *s, const double x[3], int32_t *index) {
  CwStatus status = CW_OK;
  int32_t place[3];
  for (int i = 0; i < 3; i++) place[i] = (int32_t)floor(x[i] / s->cell);
  int64_t slot = slot_of(s, place);
  if (s->table[slot] < 0) {
    CW_GROW(s->cluster, s->cluster_space, s->cluster_count + 1);
    CW_GROW(s->place, s->place_space, s->cluster_count + 1);
    s->cluster[s->cluster_count] = (Cluster){0};
    memcpy(s->place[s->cluster_count], place, sizeof place);
    s->table[slot] = (int32_t)s->cluster_count++;
    if (2 * s->cluster_count > s->table_size) CW_TRY(rehash(s, 2 * s->table_size));
    slot = slot_of(s, place);
  }
  *index = s->table[slot];
done:
  return status;
}

// Where the quadric, with the pull to the middle, is least; not further than a cell from the middle.
static void point_of(const CwSimplifier *s, const Cluster *c, double x[3]) {
  double middle[3], m[3][3], r[3], trace = c->a[0] + c->a[1] + c->a[2], length = 0;
  for (int i = 0; i < 3; i++) middle[i] = c->weight > 0 ? c->sum[i] / c->weight : 0;
  memcpy(x, middle, sizeof middle);
  if (!(trace > 0)) return;
  const double a[3][3] = {{c->a[0], c->a[3], c->a[5]}, {c->a[3], c->a[1], c->a[4]}, {c->a[5], c->a[4], c->a[2]}};
  for (int i = 0; i < 3; i++) {
    r[i] = c->b[i];
    for (int j = 0; j < 3; j++) {
      r[i] -= a[i][j] * middle[j];
      m[i][j] = a[i][j] + (i == j ? pull * trace : 0);
    }
  }
  // Cramer's rule; the matrix is positive definite by the pull.
  double cofactor[3][3], det = 0, off[3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      cofactor[i][j] = m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] -
                       m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3];
  for (int j = 0; j < 3; j++) det += m[0][j] * cofactor[0][j];
  if (!(det > 0)) return;
  for (int i = 0; i < 3; i++) {
    off[i] = (cofactor[i][0] * r[0] + cofactor[i][1] * r[1] + cofactor[i][2] * r[2]) / det;
    length += off[i] * off[i];
  }
  double share = fmin(1, s->cell / sqrt(fmax(length, 1e-300)));
  for (int i = 0; i < 3; i++) x[i] += share * off[i];
}

// Puts the clusters into cubes of another edge, by the points that they stand for.
static CwStatus coarsen(CwSimplifier *s, double cell) {
  CwStatus status = CW_OK;
  CwSimplifier *next = NULL;
  int32_t *moved = NULL;
  CW_NEW_UNSET(moved, s->cluster_count);
  CW_TRY(cw_simplify_start(s->most, cell, &next));
  for (int64_t k = 0; k < s->cluster_count; k++) {
    const Cluster *from = &s->cluster[k];
    double x[3];
    point_of(s, from, x);
    CW_TRY(cluster_at(next, x, &moved[k]));
    Cluster *to = &next->cluster[moved[k]];
    to->weight += from->weight;
    for (int i = 0; i < 3; i++) {
      to->sum[i] += from->sum[i];
      to->b[i] += from->b[i];
    }
    for (int i = 0; i < 6; i++) to->a[i] += from->a[i];
    for (int i = 0; i < CW_SIMPLIFY_VALUES; i++) {
      to->value_weight[i] += from->value_weight[i];
      to->value_sum[i] += from->value_sum[i];
    }
  }
  next->triangle = s->triangle;
  next->triangle_space = s->triangle_space;
  for (int64_t t = 0; t < s->triangle_count; t++) {
    Triangle triangle = s->triangle[t];
    for (int i = 0; i < 3; i++) triangle.corner[i] = moved[triangle.corner[i]];
    if (triangle.corner[0] == triangle.corner[1] || triangle.corner[1] == triangle.corner[2] ||
        triangle.corner[2] == triangle.corner[0])
      continue;
    next->triangle[next->triangle_count++] = triangle;
  }
  s->triangle = NULL;
  next->first_cell = s->first_cell;
  CwSimplifier swap = *s;
  *s = *next;
  *next = swap;
done:
  free(moved);
  cw_simplify_free(next);
  return status;
}

CwStatus cw_simplify_add(CwSimplifier *s, const double *const corner[3], int mark, const double *value) {
  CwStatus status = CW_OK;
  double u[3], v[3], n[3], area = 0, distance = 0;
  Triangle triangle = {.mark = mark};
  for (int i = 0; i < 3; i++) {
    u[i] = corner[1][i] - corner[0][i];
    v[i] = corner[2][i] - corner[0][i];
  }
  for (int i = 0; i < 3; i++) {
    n[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    area += n[i] * n[i];
  }
  area = sqrt(area);
  if (!(area > 0)) goto done;
  for (int i = 0; i < 3; i++) distance += n[i] / area * corner[0][i];
  for (int k = 0; k < 3; k++) {
    CW_TRY(cluster_at(s, corner[k], &triangle.corner[k]));
    Cluster *c = &s->cluster[triangle.corner[k]];
    c->weight += area;
    for (int i = 0; i < 3; i++) {
      c->sum[i] += area * corner[k][i];
      c->a[i] += n[i] * n[i] / area;
      c->a[3 + i] += n[i] * n[(i + 1) % 3] / area;
      c->b[i] += n[i] * distance;
    }
    for (int i = 0; value && i < CW_SIMPLIFY_VALUES; i++) {
      if (!isfinite(value[i])) continue;
      c->value_weight[i] += area;
      c->value_sum[i] += area * value[i];
    }
  }
  if (triangle.corner[0] == triangle.corner[1] || triangle.corner[1] == triangle.corner[2] ||
      triangle.corner[2] == triangle.corner[0])
    goto done;
  CW_GROW(s->triangle, s->triangle_space, s->triangle_count + 1);
  s->triangle[s->triangle_count++] = triangle;
  while (s->triangle_count > SLACK * s->most) CW_TRY(coarsen(s, 2 * s->cell));
done:
  return status;
}

int cw_simplify_coarsened(const CwSimplifier *s) {
  return s->cell > s->first_cell;
}

static int by_corners(const void *left, const void *right) {
  const Triangle *const both[2] = {left, right};
  int32_t sorted[2][3];
  for (int k = 0; k < 2; k++) {
    memcpy(sorted[k], both[k]->corner, sizeof sorted[k]);
    for (int pass = 0; pass < 3; pass++) {
      int i = pass % 2;
      if (sorted[k][i] <= sorted[k][i + 1]) continue;
      int32_t swap = sorted[k][i];
      sorted[k][i] = sorted[k][i + 1];
      sorted[k][i + 1] = swap;
    }
  }
  for (int i = 0; i < 3; i++)
    if (sorted[0][i] != sorted[1][i]) return sorted[0][i] < sorted[1][i] ? -1 : 1;
  for (int i = 0; i < 3; i++) // then by all that they hold: no order is left open
    if (both[0]->corner[i] != both[1]->corner[i]) return both[0]->corner[i] < both[1]->corner[i] ? -1 : 1;
  return (both[0]->mark > both[1]->mark) - (both[0]->mark < both[1]->mark);
}

static int same_corners(const Triangle *left, const Triangle *right) {
  int same = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) same += left->corner[i] == right->corner[j];
  return same == 3;
}

static void drop_twins(CwSimplifier *s) {
  int64_t left = 0;
  qsort(s->triangle, (size_t)s->triangle_count, sizeof *s->triangle, by_corners);
  for (int64_t t = 0; t < s->triangle_count; t++)
    if (left == 0 || !same_corners(&s->triangle[left - 1], &s->triangle[t])) s->triangle[left++] = s->triangle[t];
  s->triangle_count = left;
}

CwStatus cw_simplify_finish(CwSimplifier *s, CwSimpleSurface *surface) {
  CwStatus status = CW_OK;
  if (s->triangle) drop_twins(s);
  while (s->triangle_count > s->most) { // triangles go with the square of the cell; 2 % closer than needed
    CW_TRY(coarsen(s, 1.02 * s->cell * sqrt((double)s->triangle_count / (double)s->most)));
    drop_twins(s);
  }
  CW_NEW_UNSET(surface->points, s->cluster_count);
  CW_NEW_UNSET(surface->values, s->cluster_count);
  CW_NEW_UNSET(surface->triangles, s->triangle_count);
  CW_NEW_UNSET(surface->mark, s->triangle_count);
  surface->point_count = (int32_t)s->cluster_count;
  surface->triangle_count = (int32_t)s->triangle_count;
  for (int64_t k = 0; k < s->cluster_count; k++) {
    const Cluster *c = &s->cluster[k];
    point_of(s, c, surface->points[k]);
    for (int i = 0; i < CW_SIMPLIFY_VALUES; i++)
      surface->values[k][i] = c->value_weight[i] > 0 ? c->value_sum[i] / c->value_weight[i] : NAN;
  }
  for (int64_t t = 0; t < s->triangle_count; t++) {
    memcpy(surface->triangles[t], s->triangle[t].corner, sizeof surface->triangles[t]);
    surface->mark[t] = s->triangle[t].mark;
  }
done:
  return status;
}

void cw_simple_surface_free(CwSimpleSurface *surface) {
  free(surface->points);
  free(surface->values);
  free(surface->triangles);
  free(surface->mark);
  *surface = (CwSimpleSurface){0};
}
