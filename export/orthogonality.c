// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/orthogonality.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/mesh/cell.h"

void cw_orthogonality_start(CwOrthogonality *o) {
  *o = (CwOrthogonality){.least = 1};
}

void cw_orthogonality_face(const double area[3], const double from[3], const double to[3], CwOrthogonality *o) {
  const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  double along = d[0] * area[0] + d[1] * area[1] + d[2] * area[2];
  double squares =
      (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * (area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
  double cosine = squares > 0 ? along / sqrt(squares) : 0;
  o->least = cosine < o->least ? cosine : o->least;
  o->sum += cosine;
  ++o->count;
}

void cw_orthogonality_add(const CwOrthogonality *more, CwOrthogonality *sum) {
  sum->least = fmin(sum->least, more->least);
  sum->sum += more->sum;
  sum->count += more->count;
}

CwStatus cw_orthogonality_region(const CwRegionData *data, const CwRegionFaces *faces, CwOrthogonality *o) {
  CwStatus status = CW_OK;
  double(*centroid)[3] = NULL;
  const double *x[6];
  int32_t cells = cw_region_cell_count(data);
  CW_NEW_UNSET(centroid, cells);
  for (int32_t cell = 0; cell < cells; ++cell) {
    int count = cw_cell_points(data, cell, x);
    cw_cell_centroid(count, x, centroid[cell]);
  }
  for (int32_t cell = 0; cell < cells; ++cell) {
    const signed char(*face)[4] = cw_cell_face_table(cw_cell_points(data, cell, x));
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      int32_t across = faces->across[CW_CELL_FACES * cell + f];
      if (across <= cell) // each face once; the values that are no cell lie below 0
        continue;
      const double *a = x[face[f][0]], *b = x[face[f][1]], *c = x[face[f][2]], *d = face[f][3] < 0 ? a : x[face[f][3]];
      const double u[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, v[3] = {d[0] - b[0], d[1] - b[1], d[2] - b[2]};
      const double twice[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      cw_orthogonality_face(twice, centroid[cell], centroid[across], o);
    }
  }
done:
  free(centroid);
  return status;
}

static double degrees(double cosine) {
  return acos(fmax(-1, fmin(1, cosine))) * 180 / M_PI;
}

double cw_non_orthogonality_greatest(const CwOrthogonality *o) {
  return degrees(o->least);
}

double cw_non_orthogonality_mean(const CwOrthogonality *o) {
  return o->count ? degrees(o->sum / (double)o->count) : 0;
}
