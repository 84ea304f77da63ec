// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/background.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/cad/rays.h"
#include "mesher/common/vec.h"

void cw_background_free(CwBackground *background) {
  free(background->x);
  free(background->triangle);
  free(background->face);
  free(background->uv);
  free(background->neighbour);
  cw_rays_free(&background->rays);
  memset(background, 0, sizeof *background);
}

void cw_background_normal(const CwBackground *background, int32_t t, double n[3]) {
  const int32_t *corner = background->triangle[t];
  cw_normal(background->x[corner[0]], background->x[corner[1]], background->x[corner[2]], n);
  cw_unit(n);
}

double cw_background_area(const CwBackground *background, int32_t t, double centre[3]) {
  const double *a = background->x[background->triangle[t][0]], *b = background->x[background->triangle[t][1]],
               *c = background->x[background->triangle[t][2]];
  double n[3];
  cw_normal(a, b, c, n);
  for (int k = 0; k < 3; k++) centre[k] = (a[k] + b[k] + c[k]) / 3;
  return cw_norm(n) / 2;
}

double cw_background_volume(const CwBackground *background) {
  double six_volumes = 0;
  for (int32_t t = 0; t < background->triangle_count; t++) {
    const int32_t *corner = background->triangle[t];
    double n[3];
    cw_cross(background->x[corner[1]], background->x[corner[2]], n);
    six_volumes += cw_dot(background->x[corner[0]], n);
  }
  return six_volumes / 6;
}

CwStatus cw_background_vtk(const CwBackground *background, const char *title, const CwVtkField *field,
                           const char *path) {
  const CwVtkTriangles triangles = {.title = title,
                                    .point_count = background->point_count,
                                    .x = (const double(*)[3])background->x,
                                    .triangle_count = background->triangle_count,
                                    .triangle = (const int32_t(*)[3])background->triangle,
                                    .field_count = 1,
                                    .field = field};
  return cw_vtk_write(path, &triangles);
}
