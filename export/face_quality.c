// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/face_quality.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/vec.h"

// Of the distance of the centroids, or of that of the centroid to its foot on a patch, that skewness is measured by
// where the face itself is smaller.
static const double LEAST_EXTENT = 0.2, LEAST_EXTENT_ON_PATCH = 0.4;

enum { AHEAD = 8 }; // cells

CwMiddle cw_cell_middle(const CwRegionData *data, int32_t cell) {
  const double *x[6];
  const int count = cw_cell_points(data, cell, x);
  CwMiddle middle = {.volume = cw_cell_volume(count, x)};
  cw_cell_centroid(count, x, middle.at);
  return middle;
}

void cw_face_quality_start(CwFaceQuality *q) {
  *q = (CwFaceQuality){.least = 1};
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
  line.own = cw_dot(area, c);
  line.squares = cw_dot(area, area);
  if (to) {
    for (int k = 0; k < 3; ++k) d[k] = to[k] - from[k];
  } else {
    for (int k = 0; k < 3; ++k) d[k] = line.squares > 0 ? line.own / line.squares * area[k] : 0;
  }
  line.along = cw_dot(area, d);
  double share = line.along != 0 ? line.own / line.along : 0;
  for (int k = 0; k < 3; ++k) line.off[k] = c[k] - share * d[k];
  line.off_squares = cw_dot(line.off, line.off);
  line.line_squares = cw_dot(d, d);
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
    most = fmax(most, fabs(cw_dot(line->off, to)) / length);
  }
  return length > CW_SKEWNESS_MOST * most;
}

// Whether neither diagonal divides a quadrilateral into triangles that both cells see from the side on which they are.
// On the patch of one cell `to` is NULL.
static int is_twisted(const double *const *x, const double from[3], const double *to) {
  double half[4], other[4];
  cw_quad_halves(x, from, half);
  if (to) cw_quad_halves(x, to, other);
  for (int k = 0; to && k < 4; ++k) half[k] = fmin(half[k], -other[k]);
  return (fmin(half[0], half[2]) <= 0) & (fmin(half[1], half[3]) <= 0);
}

// Counts a face that may be skew or light, measured as checkMesh does.
static void measure(int count, const double *const *x, const double from[3], const double *to, CwFaceKind kind,
                    CwFaceQuality *q) {
  double area[3], centre[3], extent = to ? LEAST_EXTENT : LEAST_EXTENT_ON_PATCH, limit = CW_SKEWNESS_MOST * extent;
  cw_face_centre(count, x, centre, area);
  Line line = line_of(area, centre, from, to);
  if (line.off_squares > limit * limit * line.line_squares) q->skew[kind] += is_skew(count, x, centre, &line, extent);
  if (to) q->light[kind] += is_light(&line, CW_SMALL_WEIGHT);
}

// Of |a - b + c - d| times the longer diagonal, over the area vector: below it all corners of a quadrilateral have
// nearly one normal, and cells that see any of its triangles from the right side see all.
static const double NEARLY_FLAT = 0.05;

// The cosine of the angle between the face and the line; only what may be skew or light is measured. The centre of a
// quadrilateral is off the mean of its nodes by a third of what that is off where its diagonals cross: less than a
// sixth of the longer one.
static inline double cosine_between(int count, const double *const *x, const double from[3], const double to[3],
                                    CwFaceKind kind, CwFaceQuality *q) {
  const double *a = x[0], *b = x[1], *c = x[2], *d = count == 3 ? a : x[3];
  const double u[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, v[3] = {d[0] - b[0], d[1] - b[1], d[2] - b[2]};
  const double area[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  double way[3], line[3];
  for (int k = 0; k < 3; ++k) {
    way[k] = (count == 3 ? (a[k] + b[k] + c[k]) * (1.0 / 3) : (a[k] + b[k] + c[k] + d[k]) * 0.25) - from[k];
    line[k] = to[k] - from[k];
  }
  // The way from where the line meets the face to the centre is way - own / along * line.
  const double own = cw_dot(area, way), along = cw_dot(area, line), length = cw_dot(line, line);
  const double off = along * (along * cw_dot(way, way) - 2 * own * cw_dot(way, line)) + own * own * length;
  const double limit = CW_SKEWNESS_MOST * LEAST_EXTENT * (count == 3 ? 0.99 : 0.5);
  const double near = fabs(own), far = fabs(along - own), light = 2 * CW_SMALL_WEIGHT * (near + far);
  if (off > limit * limit * length * along * along || near < light || far < light) measure(count, x, from, to, kind, q);
  const double squares = cw_dot(area, area), product = squares * length;
  if (count == 4) {
    const double e[3] = {a[0] - b[0] + c[0] - d[0], a[1] - b[1] + c[1] - d[1], a[2] - b[2] + c[2] - d[2]};
    const double diagonal = fmax(cw_dot(u, u), cw_dot(v, v));
    if (cw_dot(e, e) * diagonal > NEARLY_FLAT * NEARLY_FLAT * squares) q->twisted += is_twisted(x, from, to);
  }
  return product > 0 ? along / sqrt(product) : 0;
}

static inline int is_uneven(const CwMiddle *a, const CwMiddle *b) {
  return (a->volume < CW_VOLUME_RATIO_LEAST * b->volume) | (b->volume < CW_VOLUME_RATIO_LEAST * a->volume);
}

void cw_face_quality_face(int count, const double *const *x, const CwMiddle *from, const CwMiddle *to, CwFaceKind kind,
                          CwFaceQuality *q) {
  const double cosine =
      count == 3 ? cosine_between(3, x, from->at, to->at, kind, q) : cosine_between(4, x, from->at, to->at, kind, q);
  q->uneven[kind] += is_uneven(from, to);
  q->least = fmin(q->least, cosine);
  q->sum += cosine;
  ++q->count;
}

void cw_face_quality_patch(int count, const double *const *x, const double from[3], CwFaceKind kind, CwFaceQuality *q) {
  measure(count, x, from, NULL, kind, q);
  if (count == 4) q->twisted += is_twisted(x, from, NULL);
}

void cw_face_quality_add(const CwFaceQuality *more, CwFaceQuality *sum) {
  sum->least = fmin(sum->least, more->least);
  sum->sum += more->sum;
  sum->count += more->count;
  for (int kind = 0; kind < CW_FACE_KINDS; ++kind) {
    sum->skew[kind] += more->skew[kind];
    sum->light[kind] += more->light[kind];
    sum->uneven[kind] += more->uneven[kind];
    sum->open[kind] += more->open[kind];
  }
  sum->slender += more->slender;
  sum->twisted += more->twisted;
}

static void face_on_patch(const CwRegionData *data, int32_t ref, const CwMiddle *middle, int32_t first_prism,
                          CwFaceQuality *q) {
  const int32_t cell = ref / CW_CELL_FACES;
  const double *corner[4];
  int32_t nodes[4];
  const int count = cw_cell_face(data, cell, ref % CW_CELL_FACES, nodes);
  for (int i = 0; i < count; ++i) corner[i] = data->points[nodes[i]];
  cw_face_quality_patch(count, corner, middle[cell].at, cell >= first_prism ? CW_FACE_OF_PRISM : CW_FACE_OTHER, q);
}

static inline double squared_distance(const double a[3], const double b[3]) {
  double d[3];
  cw_sub(b, a, d);
  return cw_dot(d, d);
}

// Counts a cell of a small determinant; whether it is a prism that may have a great aspect ratio. These are about the
// fourth power of its height over the length of its edges and the inverse: few cells are flat enough to be measured, or
// have a face on a patch beside the wall at the base of a prism, without which the determinant is less.
static inline int judge_cell(int count, const double *const *x, double volume, const int32_t *across,
                             CwFaceQuality *q) {
  static const double FLAT = 20; // cube of the longest edge over the volume; 8.5 of a regular tetrahedron
  const CwFaceKind kind = count == 6 ? CW_FACE_OF_PRISM : CW_FACE_OTHER;
  const int base = count == 6 ? 3 : count;
  double squares = 0;
  unsigned inner = 0;
  int on_patches = 0;
  for (int i = 0; i < base; ++i)
    for (int k = 0; k < i; ++k) squares = fmax(squares, squared_distance(x[i], x[k]));
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    inner |= (unsigned)(across[f] != CW_ACROSS_PATCH) << f;
    on_patches += across[f] == CW_ACROSS_PATCH && (count < 6 || f < 3);
  }
  const double cube = squares * sqrt(squares);
  if (cube > FLAT * volume || on_patches >= (count == 6 ? 1 : 2))
    q->open[kind] += cw_cell_determinant(count, x, inner) < CW_SMALL_DETERMINANT;
  // The sums of components are twice the cell's projections along the axes. None is less than its volume over its
  // diameter, nor more than that of a sphere, so that no ratio is above pi / 4 of the diameter's cube over the volume;
  // and that diameter is less than twice the longest edge of the base.
  return count == 6 && 8 * cube > CW_ASPECT_MOST * volume;
}

CwStatus cw_face_quality_region(const CwRegionData *data, const CwRegionFaces *faces, const CwMiddle *middle,
                                CwFaceQuality *q, CwFlatPrisms *flat) {
  CwStatus status = CW_OK;
  const double *x[6], *corner[4];
  double least = 1, sum = 0;
  const int32_t cells = cw_region_cell_count(data), first_prism = data->tetrahedron_count + data->pyramid_count;
  for (int32_t cell = 0; cell < cells; ++cell) {
    const int32_t ahead = cell + AHEAD < cells ? cell + AHEAD : cell, *across = faces->across + CW_CELL_FACES * cell;
    int face[CW_CELL_FACES], count = 0;
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      // The cells across stand anywhere in memory: they are asked for before their turn.
      const int32_t next = faces->across[CW_CELL_FACES * ahead + f];
      __builtin_prefetch(&middle[next < 0 ? ahead : next]);
      // Each face once; which of them those are no processor can foresee.
      face[count] = f;
      count += across[f] > cell;
    }
    const signed char(*corners)[4] = cw_cell_face_table(cw_cell_points(data, cell, x));
    for (int i = 0; i < count; ++i) {
      const signed char *of = corners[face[i]];
      const CwMiddle *here = &middle[cell], *there = &middle[across[face[i]]];
      const CwFaceKind kind = cell >= first_prism || across[face[i]] >= first_prism ? CW_FACE_OF_PRISM : CW_FACE_OTHER;
      for (int k = 0; k < 3; ++k) corner[k] = x[of[k]];
      corner[3] = x[of[3] < 0 ? 0 : of[3]];
      const double cosine = of[3] < 0 ? cosine_between(3, corner, here->at, there->at, kind, q)
                                      : cosine_between(4, corner, here->at, there->at, kind, q);
      q->uneven[kind] += is_uneven(here, there);
      least = cosine < least ? cosine : least;
      sum += cosine;
    }
    q->count += count;
    if (judge_cell(cell >= first_prism               ? 6
                   : cell >= data->tetrahedron_count ? 5
                                                     : 4,
                   x, middle[cell].volume, across, q)) {
      CW_GROW(flat->cell, flat->capacity, flat->count + 1);
      flat->cell[flat->count++] = cell;
    }
  }
  q->least = fmin(q->least, least);
  q->sum += sum;
  for (int32_t i = 0; i < data->triangle_count; ++i)
    face_on_patch(data, faces->triangle_face[i], middle, first_prism, q);
  for (int32_t i = 0; i < data->quad_count; ++i) face_on_patch(data, faces->quad_face[i], middle, first_prism, q);
done:
  return status;
}

int64_t cw_flat_prisms_slender(const CwFlatPrisms *flat, const CwRegionData *data) {
  const double *x[6];
  int64_t slender = 0;
  for (int32_t i = 0; i < flat->count; ++i) {
    cw_cell_points(data, flat->cell[i], x);
    slender += cw_cell_aspect(6, x) > CW_ASPECT_MOST;
  }
  return slender;
}

void cw_flat_prisms_free(CwFlatPrisms *flat) {
  free(flat->cell);
  *flat = (CwFlatPrisms){0};
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
