// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/face_quality.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/mesh/cell.h"

// Of the distance of the centroids, or of that of the centroid to its foot on a patch, that skewness is measured by
// where the face itself is smaller.
static const double LEAST_EXTENT = 0.2, LEAST_EXTENT_ON_PATCH = 0.4;

void cw_face_quality_start(CwFaceQuality *q) {
  *q = (CwFaceQuality){.least = 1};
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Whether a face is skew whose centre lies `off` from where the line meets it, of which `extent` is free.
static int is_skew(int count, const double *const *x, const double centre[3], const double off[3], double extent) {
  double length = sqrt(dot(off, off)), most = extent;
  if (length <= CW_SKEWNESS_MOST * extent) return 0;
  for (int i = 0; i < count; ++i) {
    const double to[3] = {x[i][0] - centre[0], x[i][1] - centre[1], x[i][2] - centre[2]};
    most = fmax(most, fabs(dot(off, to)) / length);
  }
  return length > CW_SKEWNESS_MOST * most;
}

void cw_face_quality_face(int count, const double *const *x, const double from[3], const double *to, CwFaceKind kind,
                          CwFaceQuality *q) {
  double centre[3], area[3], d[3], off[3];
  cw_face_centre(count, x, centre, area);
  const double c[3] = {centre[0] - from[0], centre[1] - from[1], centre[2] - from[2]};
  double own = dot(area, c), squares = dot(area, area);
  for (int k = 0; k < 3; ++k) d[k] = to ? to[k] - from[k] : squares > 0 ? own / squares * area[k] : 0;
  double along = dot(area, d), share = along != 0 ? own / along : 0;
  for (int k = 0; k < 3; ++k) off[k] = c[k] - share * d[k];
  double distance = sqrt(dot(d, d));
  q->skew[kind] += is_skew(count, x, centre, off, (to ? LEAST_EXTENT : LEAST_EXTENT_ON_PATCH) * distance);
  if (!to) return;
  double near = fabs(own), far = fabs(along - own);
  q->light[kind] += fmin(near, far) < CW_WEIGHT_LEAST * (near + far);
  double cosine = squares > 0 && distance > 0 ? along / (sqrt(squares) * distance) : 0;
  q->least = cosine < q->least ? cosine : q->least;
  q->sum += cosine;
  ++q->count;
}

void cw_face_quality_add(const CwFaceQuality *more, CwFaceQuality *sum) {
  sum->least = fmin(sum->least, more->least);
  sum->sum += more->sum;
  sum->count += more->count;
  for (int kind = 0; kind < CW_FACE_KINDS; ++kind) {
    sum->skew[kind] += more->skew[kind];
    sum->light[kind] += more->light[kind];
  }
}

CwStatus cw_face_quality_region(const CwRegionData *data, const CwRegionFaces *faces, CwFaceQuality *q) {
  CwStatus status = CW_OK;
  double(*centroid)[3] = NULL;
  const double *x[6], *corner[4];
  int32_t cells = cw_region_cell_count(data), first_prism = data->tetrahedron_count + data->pyramid_count;
  CW_NEW_UNSET(centroid, cells);
  for (int32_t cell = 0; cell < cells; ++cell) {
    int count = cw_cell_points(data, cell, x);
    cw_cell_centroid(count, x, centroid[cell]);
  }
  for (int32_t cell = 0; cell < cells; ++cell) {
    const signed char(*face)[4] = cw_cell_face_table(cw_cell_points(data, cell, x));
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      int32_t across = faces->across[CW_CELL_FACES * cell + f];
      if (across <= cell && across != CW_ACROSS_PATCH) // each face once; the values that are no cell lie below 0
        continue;
      int count = face[f][3] < 0 ? 3 : 4;
      for (int i = 0; i < count; ++i) corner[i] = x[face[f][i]];
      cw_face_quality_face(count, corner, centroid[cell], across < 0 ? NULL : centroid[across],
                           cell >= first_prism || across >= first_prism ? CW_FACE_OF_PRISM : CW_FACE_OTHER, q);
    }
  }
done:
  free(centroid);
  return status;
}

static double degrees(double cosine) {
  return acos(fmax(-1, fmin(1, cosine))) * 180 / M_PI;
}

double cw_non_orthogonality_greatest(const CwFaceQuality *q) {
  return degrees(q->least);
}

double cw_non_orthogonality_mean(const CwFaceQuality *q) {
  return q->count ? degrees(q->sum / (double)q->count) : 0;
}
