// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/simplify.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/order.h"
#include "pipeline/report/exact_sum.h"
#include "pipeline/vec.h"

// While triangles come there may be SLACK times as many as wanted; from then on the lattice grows.
enum { SLACK = 4, REACH = 8192 }; // REACH: first cells along the lengths that sums are exact for
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
  double area_unit, moment_unit; // of the sums of areas, and of areas times lengths
  Cluster *cluster;
  int32_t (*place)[3]; // of each cluster, in cells
  int32_t *table;      // clusters by their place, open addressing; -1: free
  int64_t table_size;  // a power of two
  int64_t cluster_count, cluster_capacity, place_capacity;
  Triangle *triangle;
  int64_t triangle_count, triangle_capacity;
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
  s->area_unit = cw_exact_unit(pow(REACH * cell, 2));
  s->moment_unit = cw_exact_unit(pow(REACH * cell, 3));
  CW_TRY(rehash(s, 1024));
  *simplifier = s;
  s = NULL;
done:
  cw_simplify_free(s);
  return status;
}

static void place_of(double cell, const double x[3], int32_t place[3]) {
  for (int i = 0; i < 3; i++) place[i] = (int32_t)floor(x[i] / cell);
}

// The cluster of a cube, made where it is new.
static CwStatus cluster_at(CwSimplifier *s, const int32_t place[3], int32_t *index) {
  CwStatus status = CW_OK;
  int64_t slot = slot_of(s, place);
  if (s->table[slot] < 0) {
    CW_GROW(s->cluster, s->cluster_capacity, s->cluster_count + 1);
    CW_GROW(s->place, s->place_capacity, s->cluster_count + 1);
    s->cluster[s->cluster_count] = (Cluster){0};
    memcpy(s->place[s->cluster_count], place, sizeof s->place[0]);
    s->table[slot] = (int32_t)s->cluster_count++;
    if (2 * s->cluster_count > s->table_size) CW_TRY(rehash(s, 2 * s->table_size));
    slot = slot_of(s, place);
  }
  *index = s->table[slot];
done:
  return status;
}

static void add_cluster(Cluster *to, const Cluster *from) {
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

// Keeps a triangle unless two of its corners are one.
static CwStatus add_triangle(CwSimplifier *s, const Triangle *triangle) {
  CwStatus status = CW_OK;
  const int32_t *corner = triangle->corner;
  if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) goto done;
  CW_GROW(s->triangle, s->triangle_capacity, s->triangle_count + 1);
  s->triangle[s->triangle_count++] = *triangle;
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

// Adds the clusters of one lattice to those of another, which is as fine or coarser, and the triangles: of twice the
// cells by the cubes themselves, of others by the points that the clusters stand for.
static CwStatus move_all(const CwSimplifier *from, CwSimplifier *to) {
  CwStatus status = CW_OK;
  int32_t *moved = NULL;
  CW_NEW_UNSET(moved, from->cluster_count);
  for (int64_t k = 0; k < from->cluster_count; k++) {
    double x[3];
    int32_t place[3];
    const int32_t *at = from->place[k];
    point_of(from, &from->cluster[k], x);
    place_of(to->cell, x, place);
    if (to->cell == from->cell) memcpy(place, at, sizeof place);
    if (to->cell == 2 * from->cell)
      for (int i = 0; i < 3; i++) place[i] = (at[i] - (at[i] & 1)) / 2;
    CW_TRY(cluster_at(to, place, &moved[k]));
    add_cluster(&to->cluster[moved[k]], &from->cluster[k]);
  }
  for (int64_t t = 0; t < from->triangle_count; t++) {
    Triangle triangle = from->triangle[t];
    for (int i = 0; i < 3; i++) triangle.corner[i] = moved[triangle.corner[i]];
    CW_TRY(add_triangle(to, &triangle));
  }
done:
  free(moved);
  return status;
}

static CwStatus coarsen(CwSimplifier *s, double cell) {
  CwStatus status = CW_OK;
  CwSimplifier *next = NULL;
  CW_TRY(cw_simplify_start(s->most, s->first_cell, &next));
  next->cell = cell;
  CW_TRY(move_all(s, next));
  CwSimplifier swap = *s;
  *s = *next;
  *next = swap;
done:
  cw_simplify_free(next);
  return status;
}

static CwStatus coarsen_to_slack(CwSimplifier *s) {
  CwStatus status = CW_OK;
  while (s->triangle_count > SLACK * s->most) CW_TRY(coarsen(s, 2 * s->cell));
done:
  return status;
}

CwStatus cw_simplify_add(CwSimplifier *s, const double *const corner[3], int mark, const double *value) {
  CwStatus status = CW_OK;
  double n[3], distance = 0;
  Triangle triangle = {.mark = mark};
  cw_normal(corner[0], corner[1], corner[2], n);
  const double area = cw_norm(n);
  if (!(area > 0)) goto done;
  for (int i = 0; i < 3; i++) distance += n[i] / area * corner[0][i];
  const double weight = cw_exact_term(area, s->area_unit);
  for (int k = 0; k < 3; k++) {
    int32_t place[3];
    place_of(s->cell, corner[k], place);
    CW_TRY(cluster_at(s, place, &triangle.corner[k]));
    Cluster *c = &s->cluster[triangle.corner[k]];
    c->weight += weight;
    for (int i = 0; i < 3; i++) {
      c->sum[i] += cw_exact_term(area * corner[k][i], s->moment_unit);
      c->a[i] += cw_exact_term(n[i] * n[i] / area, s->area_unit);
      c->a[3 + i] += cw_exact_term(n[i] * n[(i + 1) % 3] / area, s->area_unit);
      c->b[i] += cw_exact_term(n[i] * distance, s->moment_unit);
    }
    for (int i = 0; value && i < CW_SIMPLIFY_VALUES; i++) {
      if (!isfinite(value[i])) continue;
      c->value_weight[i] += weight;
      c->value_sum[i] += cw_exact_term(area * value[i], s->area_unit);
    }
  }
  CW_TRY(add_triangle(s, &triangle));
  CW_TRY(coarsen_to_slack(s));
done:
  return status;
}

// What a packed simplifier begins with; its clusters, their places and the triangles follow.
typedef struct {
  double cell;
  int64_t cluster_count, triangle_count;
} Packed;

CwStatus cw_simplify_pack(const CwSimplifier *s, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const size_t clusters = (size_t)s->cluster_count, triangles = (size_t)s->triangle_count;
  const Packed head = {s->cell, s->cluster_count, s->triangle_count};
  char *pack = NULL;
  *size = (int64_t)(sizeof head + clusters * (sizeof *s->cluster + sizeof *s->place) + triangles * sizeof *s->triangle);
  CW_NEW_UNSET(pack, *size);
  *bytes = pack;
  memcpy(pack, &head, sizeof head);
  pack += sizeof head;
  if (clusters) memcpy(pack, s->cluster, clusters * sizeof *s->cluster);
  pack += clusters * sizeof *s->cluster;
  if (clusters) memcpy(pack, s->place, clusters * sizeof *s->place);
  pack += clusters * sizeof *s->place;
  if (triangles) memcpy(pack, s->triangle, triangles * sizeof *s->triangle);
done:
  return status;
}

CwStatus cw_simplify_absorb(CwSimplifier *s, const void *bytes) {
  CwStatus status = CW_OK;
  const char *pack = bytes;
  Packed head;
  CwSimplifier *from = NULL;
  memcpy(&head, pack, sizeof head);
  pack += sizeof head;
  CW_TRY(cw_simplify_start(s->most, s->first_cell, &from));
  from->cell = head.cell;
  CW_GROW(from->cluster, from->cluster_capacity, head.cluster_count);
  CW_GROW(from->place, from->place_capacity, head.cluster_count);
  CW_GROW(from->triangle, from->triangle_capacity, head.triangle_count);
  from->cluster_count = head.cluster_count;
  from->triangle_count = head.triangle_count;
  if (from->cluster) memcpy(from->cluster, pack, (size_t)head.cluster_count * sizeof *from->cluster);
  pack += (size_t)head.cluster_count * sizeof *from->cluster;
  if (from->place) memcpy(from->place, pack, (size_t)head.cluster_count * sizeof *from->place);
  pack += (size_t)head.cluster_count * sizeof *from->place;
  if (from->triangle) memcpy(from->triangle, pack, (size_t)head.triangle_count * sizeof *from->triangle);
  while (s->cell < from->cell) CW_TRY(coarsen(s, 2 * s->cell));
  while (from->cell < s->cell) CW_TRY(coarsen(from, 2 * from->cell));
  CW_TRY(move_all(from, s));
  CW_TRY(coarsen_to_slack(s));
done:
  cw_simplify_free(from);
  return status;
}

int cw_simplify_coarsened(const CwSimplifier *s) {
  return s->cell > s->first_cell;
}

// A triangle, or a cube with its index, by which it is put in order. No order is left open.
typedef struct {
  int32_t key[7];
} Sorted;

static int by_key(const void *left, const void *right) {
  const Sorted *a = left, *b = right;
  for (int i = 0; i < 7; i++)
    if (a->key[i] != b->key[i]) return a->key[i] < b->key[i] ? -1 : 1;
  return 0;
}

// Numbers the clusters by their places, whatever came first.
static CwStatus put_in_order(CwSimplifier *s) {
  CwStatus status = CW_OK;
  Sorted *sorted = NULL;
  Cluster *cluster = NULL;
  int32_t(*place)[3] = NULL, *moved = NULL;
  CW_NEW(sorted, s->cluster_count);
  CW_NEW_UNSET(cluster, s->cluster_count);
  CW_NEW_UNSET(place, s->cluster_count);
  CW_NEW_UNSET(moved, s->cluster_count);
  for (int64_t k = 0; k < s->cluster_count; k++) {
    memcpy(sorted[k].key, s->place[k], sizeof s->place[k]);
    sorted[k].key[3] = (int32_t)k;
  }
  qsort(sorted, (size_t)s->cluster_count, sizeof *sorted, by_key);
  for (int64_t k = 0; k < s->cluster_count; k++) {
    const int32_t from = sorted[k].key[3];
    cluster[k] = s->cluster[from];
    memcpy(place[k], s->place[from], sizeof place[k]);
    moved[from] = (int32_t)k;
  }
  for (int64_t t = 0; t < s->triangle_count; t++)
    for (int i = 0; i < 3; i++) s->triangle[t].corner[i] = moved[s->triangle[t].corner[i]];
  if (s->cluster_count) memcpy(s->cluster, cluster, (size_t)s->cluster_count * sizeof *cluster);
  if (s->cluster_count) memcpy(s->place, place, (size_t)s->cluster_count * sizeof *place);
done:
  free(sorted);
  free(cluster);
  free(place);
  free(moved);
  return status;
}

// Puts the triangles in order and leaves one of each three corners.
static CwStatus drop_twins(CwSimplifier *s) {
  CwStatus status = CW_OK;
  Sorted *sorted = NULL;
  int64_t left = 0;
  CW_NEW_UNSET(sorted, s->triangle_count);
  for (int64_t t = 0; t < s->triangle_count; t++) {
    memcpy(sorted[t].key, s->triangle[t].corner, sizeof s->triangle[t].corner);
    qsort(sorted[t].key, 3, sizeof *sorted[t].key, cw_order_int32s);
    memcpy(sorted[t].key + 3, &s->triangle[t], sizeof s->triangle[t]);
  }
  qsort(sorted, (size_t)s->triangle_count, sizeof *sorted, by_key);
  for (int64_t t = 0; t < s->triangle_count; t++)
    if (t == 0 || memcmp(sorted[t].key, sorted[t - 1].key, 3 * sizeof sorted[t].key[0]) != 0)
      memcpy(&s->triangle[left++], sorted[t].key + 3, sizeof s->triangle[t]);
  s->triangle_count = left;
done:
  free(sorted);
  return status;
}

CwStatus cw_simplify_finish(CwSimplifier *s, CwSimpleSurface *surface) {
  CwStatus status = CW_OK;
  CW_TRY(put_in_order(s));
  CW_TRY(drop_twins(s));
  while (s->triangle_count > s->most) { // triangles go with the square of the cell; 2 % closer than needed
    CW_TRY(coarsen(s, 1.02 * s->cell * sqrt((double)s->triangle_count / (double)s->most)));
    CW_TRY(drop_twins(s));
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
  CW_TRY(rehash(s, s->table_size)); // for triangles that may yet come
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
