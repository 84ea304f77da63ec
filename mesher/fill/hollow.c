// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/hollow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/predicates.h"
#include "mesher/common/quality.h"
#include "mesher/common/vec.h"

enum { HALVINGS = 48 }; // of a step: down to rounding

static const double *at(const CwDelaunay *mesh, int32_t p) {
  return mesh->point[p].x;
}

CwStatus cw_hollow_add(CwHollow *hollow, const CwDelaunay *mesh, const int32_t face[3]) {
  CwStatus status = CW_OK;
  if (hollow->count == hollow->space) {
    int32_t space = 2 * hollow->space + 64;
    int32_t(*faces)[3] = realloc(hollow->face, (size_t)space * sizeof *faces);
    CW_REQUIRE(faces, CW_ERR_MEMORY, "out of memory: %d faces round a hollow", space);
    hollow->face = faces;
    double(*normals)[3] = realloc(hollow->normal, (size_t)space * sizeof *normals);
    CW_REQUIRE(normals, CW_ERR_MEMORY, "out of memory: %d faces round a hollow", space);
    hollow->normal = normals;
    hollow->space = space;
  }
  double u[3], v[3], *normal = hollow->normal[hollow->count];
  cw_sub(at(mesh, face[1]), at(mesh, face[0]), u);
  cw_sub(at(mesh, face[2]), at(mesh, face[0]), v);
  cw_cross(u, v, normal);
  cw_unit(normal);
  memcpy(hollow->face[hollow->count++], face, sizeof *hollow->face);
done:
  return status;
}

void cw_hollow_free(CwHollow *hollow) {
  free(hollow->face);
  free(hollow->normal);
  memset(hollow, 0, sizeof *hollow);
}

double cw_hollow_worth(const CwHollow *hollow, const CwDelaunay *mesh, const double p[3], int32_t *worst) {
  double least = INFINITY;
  for (int32_t k = 0; k < hollow->count; k++) {
    const double *x[3];
    double square = 0.0, d[3];
    for (int i = 0; i < 3; i++) x[i] = at(mesh, hollow->face[k][i]);
    for (int i = 0; i < 3; i++) {
      cw_sub(x[i], p, d);
      square = fmax(square, cw_dot(d, d));
      cw_sub(x[i], x[(i + 1) % 3], d);
      square = fmax(square, cw_dot(d, d));
    }
    double worth = cw_tet_volume6(x[0], x[1], x[2], p) / (square * sqrt(square));
    if (cw_orient3d(x[0], x[1], x[2], p) <= 0) worth = fmin(worth, 0.0);
    if (worth >= least) continue;
    least = worth;
    *worst = k;
  }
  return least;
}

// Steps away from the nearest of all planes, shorter and shorter; keeps the best place in p and *best.
static void climb(const CwHollow *h, const CwDelaunay *mesh, const double start[3], double size, double p[3],
                  double *best) {
  double now[3];
  cw_copy(start, now);
  for (double step = 0.2 * size; step > 1e-3 * size; step *= 0.93) {
    double least = INFINITY;
    int32_t lowest = 0, worst;
    double worth = cw_hollow_worth(h, mesh, now, &worst);
    if (worth > *best) {
      *best = worth;
      cw_copy(now, p);
    }
    for (int32_t k = 0; k < h->count; k++) {
      double d[3];
      cw_sub(now, at(mesh, h->face[k][0]), d);
      double height = cw_dot(d, h->normal[k]);
      if (height >= least) continue;
      least = height;
      lowest = k;
    }
    for (int i = 0; i < 3; i++) now[i] += step * h->normal[lowest][i];
  }
}

double cw_hollow_place(const CwHollow *hollow, const CwDelaunay *mesh, const double start[3], const double inward[3],
                       double p[3]) {
  double best = 0.0, size = 0.0, middle[3] = {0, 0, 0};
  int32_t worst;
  for (int32_t k = 0; k < 3 * hollow->count; k++) {
    const double *x = at(mesh, hollow->face[k / 3][k % 3]);
    size = fmax(size, cw_distance(x, start ? start : at(mesh, hollow->face[0][0])));
    for (int i = 0; i < 3; i++) middle[i] += x[i] / (3.0 * hollow->count);
  }
  cw_copy(middle, p);
  double step = size;
  for (int k = 0; k < HALVINGS && start; k++, step *= 0.5) {
    double now[3];
    for (int i = 0; i < 3; i++) now[i] = start[i] + step * inward[i];
    double worth = cw_hollow_worth(hollow, mesh, now, &worst);
    if (worth > best) {
      best = worth;
      cw_copy(now, p);
    }
  }
  if (start) climb(hollow, mesh, start, size, p, &best);
  climb(hollow, mesh, middle, size, p, &best);
  return best;
}
