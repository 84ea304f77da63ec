// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/rays.h"

#include <stdlib.h>

#include "mesher/common/box_tree.h"
#include "mesher/common/vec.h"

struct CwRays {
  const CwBackground *background;
  CwBoxTree triangles, normals;
};

static CwBox box_of(const void *context, int32_t t) {
  const CwBackground *background = context;
  const int32_t *corner = background->triangle[t];
  return cw_box_of_triangle(background->x[corner[0]], background->x[corner[1]], background->x[corner[2]]);
}

static CwBox normal_of(const void *context, int32_t t) {
  const CwBackground *background = context;
  const int32_t *corner = background->triangle[t];
  return cw_box_of_normal(background->x[corner[0]], background->x[corner[1]], background->x[corner[2]]);
}

CwStatus cw_rays_make(const CwBackground *background, CwRays **rays) {
  CwStatus status = CW_OK;
  CwRays *made = NULL;
  CwBox within = cw_box_of_points(background->point_count, (const double(*)[3])background->x);
  CW_NEW(made, 1);
  made->background = background;
  CW_TRY(cw_box_tree_make(NULL, background->triangle_count, &within, box_of, background, &made->triangles));
  CW_TRY(cw_box_tree_alike(NULL, &made->triangles, normal_of, background, &made->normals));
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

// A ray, and what it has met.
typedef struct {
  const CwBackground *background;
  const double *x, *direction;
  double from, to;
  int32_t nearest;
} Ray;

static int meet(void *context, int32_t t) {
  Ray *ray = context;
  double s;
  if (!leaves_through(ray->background, t, ray->x, ray->direction, &s) || s <= ray->from || s >= ray->to) return 0;
  ray->to = s;
  ray->nearest = t;
  return 0;
}

int32_t cw_rays_exit(const CwRays *rays, const double x[3], const double direction[3], double from, double to,
                     double *distance) {
  Ray ray = {rays->background, x, direction, from, to, -1};
  cw_box_tree_ray(&rays->triangles, &rays->normals, x, direction, &ray.to, meet, &ray);
  if (ray.nearest >= 0) *distance = ray.to;
  return ray.nearest;
}
