// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/nose.h"

// Grows an array to `capacity` items; the old one stays valid when memory is out.
#define GROW(pointer, capacity)                                                                                        \
  do {                                                                                                                 \
    void *grown = realloc((pointer), (size_t)(capacity) * sizeof *(pointer));                                          \
    CW_REQUIRE(grown, CW_ERR_MEMORY, "patch %s: out of memory for %d items", work->input->name, (int)(capacity));      \
    (pointer) = grown;                                                                                                 \
  } while (0)

static CwStatus grow_points(CwPatchWork *work, int32_t capacity) {
  CwStatus status = CW_OK;
  if (capacity <= work->point_capacity) goto done;
  if (capacity < 2 * work->point_capacity) capacity = 2 * work->point_capacity;
  GROW(work->uv, capacity);
  GROW(work->x, capacity);
  GROW(work->xu, capacity);
  GROW(work->xv, capacity);
  GROW(work->metric, capacity);
  GROW(work->size, capacity);
  GROW(work->point_triangle, capacity);
  GROW(work->point_fresh, capacity);
  work->point_capacity = capacity;
done:
  return status;
}

static CwStatus grow_triangles(CwPatchWork *work, int32_t capacity) {
  CwStatus status = CW_OK;
  if (capacity <= work->triangle_capacity) goto done;
  if (capacity < 2 * work->triangle_capacity) capacity = 2 * work->triangle_capacity;
  GROW(work->corner, capacity);
  GROW(work->neighbour, capacity);
  GROW(work->given, capacity);
  GROW(work->component, capacity);
  GROW(work->mark, capacity);
  memset(work->mark + work->triangle_capacity, 0, (size_t)(capacity - work->triangle_capacity) * sizeof *work->mark);
  work->triangle_capacity = capacity;
done:
  return status;
}

static CwStatus grow_cavity(CwPatchWork *work, int32_t capacity) {
  CwStatus status = CW_OK;
  if (capacity <= work->cavity_capacity) goto done;
  capacity *= 2;
  GROW(work->cavity, capacity);
  GROW(work->border, capacity);
  GROW(work->border_given, capacity);
  GROW(work->fresh, capacity);
  work->cavity_capacity = capacity;
done:
  return status;
}

CwStatus cw_patch_work_open(const CwPatchInput *input, const CwCdt *cdt, CwPatchWork *work) {
  CwStatus status = CW_OK;
  int32_t *edges = NULL;
  *work = (CwPatchWork){
      .input = input, .given_count = input->point_count, .point_count = input->point_count, .free_slot = -1};
  CW_TRY(grow_points(work, 4 * input->point_count + 64));
  CW_TRY(grow_triangles(work, 8 * input->point_count + 128));
  CW_TRY(grow_cavity(work, 64));
  CW_NEW(edges, input->point_count);
  for (int32_t p = 0; p < input->point_count; p++) {
    memcpy(work->uv[p], input->uv[p], sizeof work->uv[p]);
    input->surface(input->surface_context, work->uv[p], work->x[p], work->xu[p], work->xv[p]);
    memcpy(work->x[p], input->x[p], sizeof work->x[p]);
    cw_patch_set_metric(work, p);
    work->size[p] = 0;
    work->point_triangle[p] = -1;
  }
  // The spacing of the given edges is what the mesh beside them must meet.
  for (int32_t e = 0; e < input->edge_count; e++)
    for (int k = 0; k < 2; k++) {
      work->size[input->edge[e][k]] +=
          sqrt(cw_patch_distance2(input->x[input->edge[e][0]], input->x[input->edge[e][1]]));
      edges[input->edge[e][k]]++;
    }
  for (int32_t p = 0; p < input->point_count; p++)
    work->size[p] = edges[p] ? work->size[p] / edges[p] : input->size(input->size_context, work->x[p]);
  work->triangle_count = cdt->triangle_count;
  for (int32_t t = 0; t < cdt->triangle_count; t++) {
    memcpy(work->corner[t], cdt->triangle[t], sizeof work->corner[t]);
    memcpy(work->neighbour[t], cdt->neighbour[t], sizeof work->neighbour[t]);
    work->given[t] = cdt->given[t];
    work->component[t] = cdt->component[t];
    for (int i = 0; i < 3; i++) work->point_triangle[work->corner[t][i]] = t;
  }
done:
  free(edges);
  if (status != CW_OK) cw_patch_work_close(work);
  return status;
}

void cw_patch_work_close(CwPatchWork *work) {
  free(work->uv);
  free(work->x);
  free(work->xu);
  free(work->xv);
  free(work->metric);
  free(work->size);
  free(work->point_triangle);
  free(work->point_fresh);
  free(work->corner);
  free(work->neighbour);
  free(work->given);
  free(work->component);
  free(work->mark);
  free(work->cavity);
  free(work->border);
  free(work->border_given);
  free(work->fresh);
  *work = (CwPatchWork){0};
}

double cw_patch_quality_at(const double a[3], const double b[3], const double c[3], const double normal[3]) {
  double n[3], l = 0;
  for (int k = 0; k < 3; k++) {
    double e = b[k] - a[k], f = c[k] - a[k], g = c[k] - b[k];
    l += e * e + f * f + g * g;
  }
  cw_normal(a, b, c, n);
  double area = cw_norm(n);
  if (cw_dot(n, normal) < 0) area = -area;
  return l > 0 ? 2 * sqrt(3) * area / l : 0;
}

double cw_patch_quality(const CwPatchWork *work, int32_t a, int32_t b, int32_t c) {
  double n[3], m[3];
  cw_patch_normal(work, a, n);
  cw_patch_normal(work, b, m);
  for (int k = 0; k < 3; k++) n[k] += m[k];
  cw_patch_normal(work, c, m);
  for (int k = 0; k < 3; k++) n[k] += m[k];
  return cw_patch_quality_at(work->x[a], work->x[b], work->x[c], n);
}

// Writes triangle t; edge 0 (opposite to the first corner) and so on get their neighbours from the caller.
static void set_triangle(CwPatchWork *work, int32_t t, int32_t a, int32_t b, int32_t c, int32_t component) {
  work->corner[t][0] = a;
  work->corner[t][1] = b;
  work->corner[t][2] = c;
  work->component[t] = component;
  work->point_triangle[a] = work->point_triangle[b] = work->point_triangle[c] = t;
}

static void join(CwPatchWork *work, int32_t t, int i, int32_t n, int given) {
  work->neighbour[t][i] = n;
  work->given[t] = (uint8_t)((work->given[t] & ~(1 << i)) | given << i);
}

int32_t cw_patch_find(const CwPatchWork *work, const double uv[2], int32_t t) {
  int32_t from = -1;
  for (int step = 0; step < 1000; step++) {
    const int32_t *c = work->corner[t];
    int out = -1;
    double worst = 0;
    for (int i = 0; i < 3; i++) {
      if (work->neighbour[t][i] == from && from >= 0) continue;
      double cross = cw_twice_area(work->uv[c[(i + 1) % 3]], work->uv[c[(i + 2) % 3]], uv);
      if (cross < worst) {
        worst = cross;
        out = i;
      }
    }
    if (out < 0) return t;
    if (work->given[t] >> out & 1) return -1;
    from = t;
    t = work->neighbour[t][out];
  }
  return -1;
}

// Whether p lies in the circle of the triangle in the metric m (E, F, G): the lifted determinant relative to
// p.
static int in_circle(const CwPatchWork *work, const int32_t corner[3], const double p[2], const double m[3]) {
  double d[3][2], lift[3];
  for (int i = 0; i < 3; i++) {
    d[i][0] = work->uv[corner[i]][0] - p[0];
    d[i][1] = work->uv[corner[i]][1] - p[1];
    lift[i] = m[0] * d[i][0] * d[i][0] + 2 * m[1] * d[i][0] * d[i][1] + m[2] * d[i][1] * d[i][1];
  }
  double a = lift[0] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  double b = lift[1] * (d[2][0] * d[0][1] - d[2][1] * d[0][0]);
  double c = lift[2] * (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
  // The margin keeps cocircular points out, where rounding would decide.
  return a + b + c > 1e-10 * (fabs(a) + fabs(b) + fabs(c));
}

static void start_marks(CwPatchWork *work) {
  if (++work->marker == 0) {
    memset(work->mark, 0, (size_t)work->triangle_capacity * sizeof *work->mark);
    work->marker = 1;
  }
}

// Collects the cavity of p from the triangles of `seed`; with `grow` 0 it is only them.
static CwStatus collect_cavity(CwPatchWork *work, const double p[2], const double m[3], int seeds, int grow) {
  CwStatus status = CW_OK;
  start_marks(work);
  work->cavity_count = seeds;
  work->border_count = 0;
  for (int k = 0; k < seeds; k++) work->mark[work->cavity[k]] = work->marker;
  for (int32_t k = 0; k < work->cavity_count; k++) {
    int32_t t = work->cavity[k];
    CW_TRY(grow_cavity(work, work->cavity_count + work->border_count + 4));
    for (int i = 0; i < 3; i++) {
      int32_t n = work->neighbour[t][i];
      int given = work->given[t] >> i & 1;
      if (!given && work->mark[n] == work->marker) continue;
      if (grow && !given && in_circle(work, work->corner[n], p, m)) {
        work->mark[n] = work->marker;
        work->cavity[work->cavity_count++] = n;
        continue;
      }
      int32_t *border = work->border[work->border_count];
      border[0] = work->corner[t][(i + 1) % 3];
      border[1] = work->corner[t][(i + 2) % 3];
      border[2] = n;
      work->border_given[work->border_count++] = (uint8_t)given;
    }
  }
  // A triangle that came in late may have been taken for border before.
  int32_t kept = 0;
  for (int32_t k = 0; k < work->border_count; k++) {
    if (!work->border_given[k] && work->mark[work->border[k][2]] == work->marker) continue;
    memmove(work->border[kept], work->border[k], sizeof work->border[k]);
    work->border_given[kept++] = work->border_given[k];
  }
  work->border_count = kept;
done:
  return status;
}

// Whether each border edge sees p with an area that is not lost in rounding, and the cavity has no point inside.
static int cavity_is_star(const CwPatchWork *work, const double p[2], const double m[3]) {
  double root = sqrt(fmax(m[0] * m[2] - m[1] * m[1], 0));
  if (work->border_count != work->cavity_count + 2) return 0;
  for (int32_t k = 0; k < work->border_count; k++) {
    const double *a = work->uv[work->border[k][0]], *b = work->uv[work->border[k][1]];
    double u = b[0] - a[0], v = b[1] - a[1];
    if (!(root * cw_twice_area(a, b, p) > 1e-6 * (m[0] * u * u + 2 * m[1] * u * v + m[2] * v * v))) return 0;
  }
  return 1;
}

static int cavity_has_room(const CwPatchWork *work, const double uv[2], const double m[3], double size, double least) {
  double root = sqrt(fmax(m[0] * m[2] - m[1] * m[1], 0));
  for (int32_t k = 0; k < work->border_count; k++) {
    const double *a = work->uv[work->border[k][0]], *b = work->uv[work->border[k][1]];
    double u = a[0] - uv[0], v = a[1] - uv[1];
    // Beside finer given edges the spacing of these counts.
    double near = fmin(size, 0.5 * (size + work->size[work->border[k][0]]));
    if (m[0] * u * u + 2 * m[1] * u * v + m[2] * v * v < least * least * near * near) return 0;
    if (!work->border_given[k]) continue;
    u = b[0] - a[0];
    v = b[1] - a[1];
    double length = sqrt(m[0] * u * u + 2 * m[1] * u * v + m[2] * v * v);
    if (root * cw_twice_area(a, b, uv) < 0.4 * near * length) return 0;
  }
  return 1;
}

// Fills the cavity with triangles from its border to point p.
static CwStatus fill_cavity(CwPatchWork *work, int32_t p) {
  CwStatus status = CW_OK;
  int32_t component = work->component[work->cavity[0]];
  CW_TRY(grow_triangles(work, work->triangle_count + 2));
  for (int32_t k = 0; k < work->border_count; k++) {
    int32_t t;
    if (k < work->cavity_count)
      t = work->cavity[k];
    else if (work->free_slot >= 0) {
      t = work->free_slot;
      work->free_slot = work->neighbour[t][0];
    } else
      t = work->triangle_count++;
    work->fresh[k] = t;
  }
  for (int32_t k = 0; k < work->border_count; k++) {
    int32_t t = work->fresh[k], a = work->border[k][0], b = work->border[k][1], out = work->border[k][2];
    set_triangle(work, t, p, a, b, component);
    work->given[t] = work->border_given[k];
    work->neighbour[t][0] = out;
    work->point_fresh[a] = t;
    if (out >= 0) work->neighbour[out][cw_patch_edge_from(work, out, b, a)] = t;
  }
  for (int32_t k = 0; k < work->border_count; k++) {
    int32_t t = work->fresh[k], next = work->point_fresh[work->border[k][1]];
    work->neighbour[t][1] = next;
    work->neighbour[next][2] = t;
  }
done:
  return status;
}

// Where the metric turns fast the circles mislead: then only the triangle t at p, or the two where p is near
// their edge.
static CwStatus collect_least_cavity(CwPatchWork *work, const double p[2], const double m[3], int32_t t) {
  const int32_t *c = work->corner[t];
  double cross[3];
  int flat = 0, seeds = 1;
  for (int i = 0; i < 3; i++) {
    cross[i] = cw_twice_area(work->uv[c[(i + 1) % 3]], work->uv[c[(i + 2) % 3]], p);
    if (cross[i] < cross[flat]) flat = i;
  }
  work->cavity[0] = t;
  if (cross[flat] < 0.05 * (cross[0] + cross[1] + cross[2]) && !(work->given[t] >> flat & 1))
    work->cavity[seeds++] = work->neighbour[t][flat];
  return collect_cavity(work, p, m, seeds, 0);
}

CwStatus cw_patch_insert(CwPatchWork *work, const double uv[2], int32_t from, double least, double size_cap,
                         int *inserted) {
  CwStatus status = CW_OK;
  int32_t p = work->point_count, t = cw_patch_find(work, uv, from);
  *inserted = 0;
  if (t < 0) goto done;
  CW_TRY(grow_points(work, p + 1));
  memcpy(work->uv[p], uv, sizeof work->uv[p]);
  work->input->surface(work->input->surface_context, uv, work->x[p], work->xu[p], work->xv[p]);
  cw_patch_set_metric(work, p);
  work->size[p] = fmin(size_cap, work->input->size(work->input->size_context, work->x[p]));
  const double *m = work->metric[p];
  work->cavity[0] = t;
  CW_TRY(collect_cavity(work, uv, m, 1, 1));
  if (!cavity_is_star(work, uv, m)) CW_TRY(collect_least_cavity(work, uv, m, t));
  if (!cavity_is_star(work, uv, m) || !cavity_has_room(work, uv, m, work->size[p], least)) goto done;
  CW_TRY(fill_cavity(work, p));
  work->point_count++;
  *inserted = 1;
done:
  return status;
}

int cw_patch_over_nose(const CwPatchWork *work, int32_t a, int32_t b) {
  double n[3], m[3];
  cw_patch_normal(work, a, n);
  cw_patch_normal(work, b, m);
  return cw_unit(n) > 0 && cw_unit(m) > 0 && cw_nose_between(n, m);
}

int cw_patch_is_long(const CwPatchWork *work, int32_t a, int32_t b) {
  double most = cw_policy.surface_long_edge * 0.5 * (work->size[a] + work->size[b]);
  return cw_patch_distance2(work->x[a], work->x[b]) > most * most;
}

int cw_patch_flip(CwPatchWork *work, int32_t t, int i) {
  if (work->given[t] >> i & 1) return 0;
  int32_t n = work->neighbour[t][i];
  int32_t a = work->corner[t][i], b = work->corner[t][(i + 1) % 3], c = work->corner[t][(i + 2) % 3];
  int j = cw_patch_edge_from(work, n, c, b);
  int32_t d = work->corner[n][j];
  double left = cw_twice_area(work->uv[a], work->uv[b], work->uv[d]);
  double right = cw_twice_area(work->uv[a], work->uv[d], work->uv[c]);
  if (!(left > 1e-9 * (left + right)) || !(right > 1e-9 * (left + right))) return 0;
  if (cw_patch_over_nose(work, a, d)) {
    int shorter = cw_patch_distance2(work->x[a], work->x[d]) < cw_patch_distance2(work->x[b], work->x[c]);
    if (!shorter || (!cw_patch_is_long(work, b, c) && !cw_patch_over_nose(work, b, c))) return 0;
  }
  // Corners a b c and d c b become a b d and a d c.
  int32_t ab = work->neighbour[t][(i + 2) % 3], ca = work->neighbour[t][(i + 1) % 3];
  int32_t bd = work->neighbour[n][(j + 1) % 3], dc = work->neighbour[n][(j + 2) % 3];
  int ab_given = work->given[t] >> (i + 2) % 3 & 1, ca_given = work->given[t] >> (i + 1) % 3 & 1;
  int bd_given = work->given[n] >> (j + 1) % 3 & 1, dc_given = work->given[n] >> (j + 2) % 3 & 1;
  int32_t component = work->component[t];
  if (bd >= 0) work->neighbour[bd][cw_patch_edge_from(work, bd, d, b)] = t;
  if (ca >= 0) work->neighbour[ca][cw_patch_edge_from(work, ca, a, c)] = n;
  set_triangle(work, t, a, b, d, component);
  set_triangle(work, n, a, d, c, component);
  join(work, t, 0, bd, bd_given);
  join(work, t, 1, n, 0);
  join(work, t, 2, ab, ab_given);
  join(work, n, 0, dc, dc_given);
  join(work, n, 1, ca, ca_given);
  join(work, n, 2, t, 0);
  return 1;
}

int cw_patch_ring(const CwPatchWork *work, int32_t p, int32_t triangles[CW_PATCH_RING], int32_t ring[CW_PATCH_RING]) {
  int count = 0;
  int32_t t = work->point_triangle[p], first = t;
  do {
    if (count == CW_PATCH_RING) return 0;
    int i = cw_patch_corner_of(work->corner[t], p);
    triangles[count] = t;
    ring[count++] = work->corner[t][(i + 1) % 3];
    t = work->neighbour[t][(i + 1) % 3];
  } while (t != first);
  return count;
}

// The worst quality after p is drawn into ring[w]; negative where that is not allowed.
static double quality_drawn(const CwPatchWork *work, int count, const int32_t *ring, int w, double most) {
  double worst = 1;
  int32_t q = ring[w];
  for (int k = 1; k + 1 < count; k++) {
    int32_t a = ring[(w + k) % count], b = ring[(w + k + 1) % count];
    double u = work->uv[b][0] - work->uv[a][0], v = work->uv[b][1] - work->uv[a][1];
    const double *m = work->metric[q];
    double area = cw_twice_area(work->uv[q], work->uv[a], work->uv[b]);
    if (!(area * sqrt(fmax(m[0] * m[2] - m[1] * m[1], 0)) > 1e-4 * (m[0] * u * u + 2 * m[1] * u * v + m[2] * v * v)))
      return -1;
    double limit = 0.5 * most * (work->size[q] + work->size[a]);
    if (k > 1 && cw_patch_distance2(work->x[q], work->x[a]) > limit * limit) return -1;
    worst = fmin(worst, cw_patch_quality(work, q, a, b));
  }
  return worst;
}

// Whether p drawn into ring[w] makes an edge over a nose.
static int leads_over_nose(const CwPatchWork *work, int32_t p, int count, const int32_t *ring, int w) {
  for (int k = 2; k + 1 < count; k++) {
    int32_t to = ring[(w + k) % count];
    if (cw_patch_over_nose(work, ring[w], to) && !cw_patch_over_nose(work, p, to)) return 1;
  }
  return 0;
}

int cw_patch_remove(CwPatchWork *work, int32_t p, double least_quality, double most) {
  int32_t triangles[CW_PATCH_RING], ring[CW_PATCH_RING];
  int count = cw_patch_ring(work, p, triangles, ring), best = -1;
  if (count < 3) return 0;
  for (int w = 0; w < count; w++) {
    double quality = quality_drawn(work, count, ring, w, most);
    if (quality > least_quality && !leads_over_nose(work, p, count, ring, w)) {
      least_quality = quality;
      best = w;
    }
  }
  if (best < 0) return 0;
  int32_t q = ring[best];
  // Triangle `best` (p, q, r) and the one before it (p, s, q) go; what lies across their outer edges joins
  // the next ones.
  for (int side = 0; side < 2; side++) {
    int32_t gone = triangles[side ? (best + count - 1) % count : best];
    int i = cw_patch_corner_of(work->corner[gone], p), j = cw_patch_corner_of(work->corner[gone], q);
    int32_t out = work->neighbour[gone][i], in = work->neighbour[gone][j];
    int given = work->given[gone] >> i & 1;
    int32_t r = work->corner[gone][3 - i - j];
    // The edge of `in` between p and r takes over the edge between q and r.
    int e = side ? cw_patch_edge_from(work, in, r, p) : cw_patch_edge_from(work, in, p, r);
    int o = out < 0 ? 0 : side ? cw_patch_edge_from(work, out, q, r) : cw_patch_edge_from(work, out, r, q);
    if (out >= 0) work->neighbour[out][o] = in;
    join(work, in, e, out, given);
    work->point_triangle[r] = in;
    work->point_triangle[q] = in;
    work->corner[gone][0] = -1;
    work->neighbour[gone][0] = work->free_slot;
    work->free_slot = gone;
  }
  for (int k = 1; k + 1 < count; k++) {
    int32_t t = triangles[(best + k) % count];
    work->corner[t][cw_patch_corner_of(work->corner[t], p)] = q;
  }
  work->point_triangle[p] = -1;
  return 1;
}
