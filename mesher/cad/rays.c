// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/rays.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/box.h"
#include "mesher/common/vec.h"

enum { LEAF_SIZE = 4, STACK_SIZE = 64 };

// Triangles stand in the order of a space-filling curve; node n of the tree covers a half of its parent's
// run, its children are nodes 2n + 1 and 2n + 2.
struct CwRays {
  const CwBackground *background;
  int32_t *order;
  CwBox *box;
};

typedef struct {
  uint64_t key;
  int32_t triangle;
} Place;

static int by_key(const void *a, const void *b) {
  const Place *p = a, *q = b;
  if (p->key != q->key) return p->key < q->key ? -1 : 1;
  return p->triangle < q->triangle ? -1 : p->triangle > q->triangle;
}

static uint64_t morton(const CwBox *all, const double x[3]) {
  uint64_t key = 0;
  uint32_t place[3];
  for (int k = 0; k < 3; k++) {
    place[k] = (uint32_t)((x[k] - all->low[k]) / (all->high[k] - all->low[k] + 1e-30) * 1048575.0);
  }
  for (int bit = 19; bit >= 0; bit--) {
    for (int k = 0; k < 3; k++) key = key << 1 | (place[k] >> bit & 1);
  }
  return key;
}

static CwStatus sort_triangles(const CwBackground *background, int32_t *order) {
  CwStatus status = CW_OK;
  Place *place = NULL;
  CwBox all = cw_box_empty();
  CW_NEW(place, background->triangle_count);
  for (int32_t i = 0; i < background->point_count; i++) cw_box_add_point(&all, background->x[i]);
  for (int32_t t = 0; t < background->triangle_count; t++) {
    const int32_t *n = background->triangle[t];
    double centre[3];
    for (int k = 0; k < 3; k++) {
      centre[k] = (background->x[n[0]][k] + background->x[n[1]][k] + background->x[n[2]][k]) / 3;
    }
    place[t] = (Place){morton(&all, centre), t};
  }
  qsort(place, (size_t)background->triangle_count, sizeof *place, by_key);
  for (int32_t t = 0; t < background->triangle_count; t++) order[t] = place[t].triangle;
done:
  free(place);
  return status;
}

static void build(CwRays *rays, size_t node, int32_t first, int32_t last) {
  CwBox box = cw_box_empty();
  if (last - first <= LEAF_SIZE) {
    for (int32_t i = first; i < last; i++) {
      const int32_t *n = rays->background->triangle[rays->order[i]];
      for (int k = 0; k < 3; k++) cw_box_add_point(&box, rays->background->x[n[k]]);
    }
  } else {
    int32_t mid = first + (last - first) / 2;
    build(rays, 2 * node + 1, first, mid);
    build(rays, 2 * node + 2, mid, last);
    for (size_t child = 2 * node + 1; child <= 2 * node + 2; child++) {
      cw_box_add_point(&box, rays->box[child].low);
      cw_box_add_point(&box, rays->box[child].high);
    }
  }
  rays->box[node] = box;
}

CwStatus cw_rays_make(const CwBackground *background, CwRays **rays) {
  CwStatus status = CW_OK;
  CwRays *made = NULL;
  size_t nodes = 1;
  for (int32_t run = background->triangle_count; run > LEAF_SIZE; run = (run + 1) / 2) nodes = 2 * nodes + 1;
  CW_NEW(made, 1);
  made->background = background;
  CW_NEW(made->order, background->triangle_count);
  CW_NEW(made->box, nodes);
  CW_TRY(sort_triangles(background, made->order));
  build(made, 0, 0, background->triangle_count);
  *rays = made;
  made = NULL;
done:
  cw_rays_free(&made);
  return status;
}

void cw_rays_free(CwRays **rays) {
  if (!*rays) return;
  free((*rays)->order);
  free((*rays)->box);
  free(*rays);
  *rays = NULL;
}

static int meets_box(const CwBox *box, const double x[3], const double inverse[3], double from, double to) {
  for (int k = 0; k < 3; k++) {
    double a = (box->low[k] - x[k]) * inverse[k], b = (box->high[k] - x[k]) * inverse[k];
    double enters = a < b ? a : b, leaves = a < b ? b : a;
    from = enters > from ? enters : from;
    to = leaves < to ? leaves : to;
  }
  return from <= to;
}

// T. Moller, B. Trumbore, Fast, minimum storage ray/triangle intersection, 1997; exits only.
static int leaves_through(const CwBackground *background, int32_t t, const double x[3], const double d[3], double *s) {
  const int32_t *n = background->triangle[t];
  const double *a = background->x[n[0]], *b = background->x[n[1]], *c = background->x[n[2]];
  double e[3], f[3], o[3];
  for (int k = 0; k < 3; k++) {
    e[k] = b[k] - a[k];
    f[k] = c[k] - a[k];
    o[k] = x[k] - a[k];
  }
  double normal[3] = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
  double det = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
  if (!(det > 0)) return 0;
  double q[3] = {o[1] * d[2] - o[2] * d[1], o[2] * d[0] - o[0] * d[2], o[0] * d[1] - o[1] * d[0]};
  double u = -(f[0] * q[0] + f[1] * q[1] + f[2] * q[2]), v = e[0] * q[0] + e[1] * q[1] + e[2] * q[2];
  if (u < 0 || v < 0 || u + v > det) return 0;
  *s = -(normal[0] * o[0] + normal[1] * o[1] + normal[2] * o[2]) / det;
  return 1;
}

int32_t cw_rays_exit(const CwRays *rays, const double x[3], const double direction[3], double from, double to,
                     double *distance) {
  struct {
    size_t node;
    int32_t first, last;
  } stack[STACK_SIZE];
  double inverse[3];
  int32_t nearest = -1;
  int top = 0;
  // Large and not infinite where the ray is parallel to a side, so that no 0 * infinity comes up.
  for (int k = 0; k < 3; k++) inverse[k] = fabs(direction[k]) > 1e-30 ? 1 / direction[k] : 1e30;
  stack[top].node = 0;
  stack[top].first = 0;
  stack[top++].last = rays->background->triangle_count;
  while (top > 0) {
    size_t node = stack[--top].node;
    int32_t first = stack[top].first, last = stack[top].last;
    if (!meets_box(&rays->box[node], x, inverse, from, to)) continue;
    if (last - first > LEAF_SIZE) {
      int32_t mid = first + (last - first) / 2;
      stack[top].node = 2 * node + 2;
      stack[top].first = mid;
      stack[top++].last = last;
      stack[top].node = 2 * node + 1;
      stack[top].first = first;
      stack[top++].last = mid;
      continue;
    }
    for (int32_t i = first; i < last; i++) {
      double s;
      if (!leaves_through(rays->background, rays->order[i], x, direction, &s) || s <= from || s >= to) continue;
      to = s;
      nearest = rays->order[i];
    }
  }
  if (nearest >= 0) *distance = to;
  return nearest;
}
