// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/rays.h"

#include <stdlib.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/vec.h"

struct CwRays {
  const double (*x)[3]; // the background's
  const int32_t (*triangle)[3];
  CwBoxTree triangles, normals;
};

static CwBox box_of(const void *context, int32_t t) {
  const CwRays *rays = context;
  const int32_t *corner = rays->triangle[t];
  return cw_box_of_triangle(rays->x[corner[0]], rays->x[corner[1]], rays->x[corner[2]]);
}

static CwBox normal_of(const void *context, int32_t t) {
  const CwRays *rays = context;
  const int32_t *corner = rays->triangle[t];
  return cw_box_of_normal(rays->x[corner[0]], rays->x[corner[1]], rays->x[corner[2]]);
}

CwStatus cw_rays_make(const CwContext *context, int32_t point_count, const double (*x)[3], int32_t triangle_count,
                      const int32_t (*triangle)[3], CwRays **rays) {
  CwStatus status = CW_OK;
  CwRays *made = NULL;
  CwBox within = cw_box_of_points(point_count, x);
  CW_NEW(made, 1);
  made->x = x;
  made->triangle = triangle;
  CW_TRY(cw_box_tree_make(context, triangle_count, &within, box_of, made, &made->triangles));
  CW_TRY(cw_box_tree_alike(context, &made->triangles, normal_of, made, &made->normals));
  *rays = made;
  made = NULL;
done:
  cw_rays_free(&made);
  return status;
}

void cw_rays_free(CwRays **rays) {
  if (!*rays) return;
  cw_box_tree_free(&(*rays)->triangles);
  cw_box_tree_free(&(*rays)->normals);
  free(*rays);
  *rays = NULL;
}

// T. Moller, B. Trumbore, Fast, minimum storage ray/triangle intersection, 1997: whether the ray goes through the
// triangle, outwards (1), inwards (-1), or not (0).
static int goes_through(const CwRays *rays, int32_t t, const double x[3], const double d[3], double *s) {
  const int32_t *corner = rays->triangle[t];
  const double *a = rays->x[corner[0]];
  double e[3], f[3], o[3], normal[3], q[3];
  cw_sub(rays->x[corner[1]], a, e);
  cw_sub(rays->x[corner[2]], a, f);
  cw_sub(x, a, o);
  cw_cross(e, f, normal);
  cw_cross(o, d, q);
  double det = cw_dot(normal, d), out = det > 0 ? 1 : -1, u = -out * cw_dot(f, q), v = out * cw_dot(e, q);
  if (det == 0 || u < 0 || v < 0 || u + v > out * det) return 0;
  *s = -cw_dot(normal, o) / det;
  return (int)out;
}

// A ray, and what it has met.
typedef struct {
  const CwRays *rays;
  const double *x, *direction;
  double from, to;
  int32_t nearest;
} Ray;

static int meet(void *context, int32_t t) {
  Ray *ray = context;
  double s;
  if (goes_through(ray->rays, t, ray->x, ray->direction, &s) <= 0 || s <= ray->from || s >= ray->to) return 0;
  ray->to = s;
  ray->nearest = t;
  return 0;
}

int32_t cw_rays_exit(const CwRays *rays, const double x[3], const double direction[3], double from, double to,
                     double *distance) {
  Ray ray = {rays, x, direction, from, to, -1};
  cw_box_tree_ray(&rays->triangles, &rays->normals, x, direction, &ray.to, meet, &ray);
  if (ray.nearest >= 0) *distance = ray.to;
  return ray.nearest;
}

typedef struct {
  const CwRays *rays;
  const double *direction;
  double start[3], to;
  int32_t count, most;
  CwRayHit *hit;
} Hits;

static int add_hit(void *context, int32_t t) {
  Hits *hits = context;
  double s;
  if (!goes_through(hits->rays, t, hits->start, hits->direction, &s) || s < 0 || s > hits->to) return 0;
  hits->hit[hits->count++] = (CwRayHit){s, t};
  return hits->count == hits->most;
}

static int by_place(const void *a, const void *b) {
  const CwRayHit *p = a, *q = b;
  if (p->place != q->place) return p->place < q->place ? -1 : 1;
  return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

int32_t cw_rays_hits(const CwRays *rays, const double x[3], const double direction[3], double from, double to,
                     int32_t most, CwRayHit *hit) {
  Hits hits = {.rays = rays, .direction = direction, .to = to - from, .most = most, .hit = hit};
  for (int k = 0; k < 3; k++) hits.start[k] = x[k] + from * direction[k];
  cw_box_tree_ray(&rays->triangles, NULL, hits.start, direction, &hits.to, add_hit, &hits);
  for (int32_t i = 0; i < hits.count; i++) hit[i].place += from;
  qsort(hit, (size_t)hits.count, sizeof *hit, by_place);
  return hits.count;
}
