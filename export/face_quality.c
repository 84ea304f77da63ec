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

static inline double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The line of a face from centroid to centroid, on a patch to the foot of the centroid.
typedef struct {
  double squares, along, own; // of the area vector with itself, with the line, with the way to the centre
  double off[3], off_squares; // the centre from where the line meets the face
  double line_squares;
} Line;

static inline Line line_of(const double area[3], const double centre[3], const double from[3], const double *to) {
  Line line;
  double d[3];
  const double c[3] = {centre[0] - from[0], centre[1] - from[1], centre[2] - from[2]};
  line.own = dot(area, c);
  line.squares = dot(area, area);
  if (to) {
    for (int k = 0; k < 3; ++k) d[k] = to[k] - from[k];
  } else {
    for (int k = 0; k < 3; ++k) d[k] = line.squares > 0 ? line.own / line.squares * area[k] : 0;
  }
  line.along = dot(area, d);
  double share = line.along != 0 ? line.own / line.along : 0;
  for (int k = 0; k < 3; ++k) line.off[k] = c[k] - share * d[k];
  line.off_squares = dot(line.off, line.off);
  line.line_squares = dot(d, d);
  return line;
}

// Whether the face parts the line as unevenly as `least`.
static inline int is_light(const Line *line, double least) {
  double near = fabs(line->own), far = fabs(line->along - line->own), least_part = least * (near + far);
  return near < least_part || far < least_part;
}

// Whether a face is skew, of which `extent` of the line is free.
static int is_skew(int count, const double *const *x, const double centre[3], const Line *line, double extent) {
  double length = sqrt(line->off_squares), most = extent * sqrt(line->line_squares);
  for (int i = 0; i < count; ++i) {
    const double to[3] = {x[i][0] - centre[0], x[i][1] - centre[1], x[i][2] - centre[2]};
    most = fmax(most, fabs(dot(line->off, to)) / length);
  }
  return length > CW_SKEWNESS_MOST * most;
}

void cw_face_quality_face(int count, const double *const *x, const double from[3], const double *to, CwFaceKind kind,
                          CwFaceQuality *q) {
  const double *a = x[0], *b = x[1], *c = x[2], *d = count == 3 ? a : x[3];
  const double u[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, v[3] = {d[0] - b[0], d[1] - b[1], d[2] - b[2]};
  double area[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]}, centre[3];
  double extent = to ? LEAST_EXTENT : LEAST_EXTENT_ON_PATCH, limit = CW_SKEWNESS_MOST * extent;
  for (int k = 0; k < 3; ++k) centre[k] = count == 3 ? (a[k] + b[k] + c[k]) / 3 : (a[k] + b[k] + c[k] + d[k]) / 4;
  Line line = line_of(area, centre, from, to);
  // The centre of a quadrilateral is off the mean of its nodes by a third of what that is off where its diagonals
  // cross: less than a sixth of the longer one. Only what may matter is measured so.
  double near_limit = count == 3 ? limit : limit / 2;
  int may_matter =
      line.off_squares > near_limit * near_limit * line.line_squares || (to && is_light(&line, 2 * CW_WEIGHT_LEAST));
  if (may_matter && count == 4) {
    cw_face_centre(count, x, centre, area);
    line = line_of(area, centre, from, to);
  }
  if (may_matter && line.off_squares > limit * limit * line.line_squares)
    q->skew[kind] += is_skew(count, x, centre, &line, extent);
  if (!to) return;
  if (may_matter) q->light[kind] += is_light(&line, CW_WEIGHT_LEAST);
  double product = line.squares * line.line_squares;
  double cosine = product > 0 ? line.along / sqrt(product) : 0;
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
