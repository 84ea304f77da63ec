// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh/cell.h"

#include <math.h>
#include <string.h>

#include "pipeline/vec.h"

// Faces by the CGNS standard (SIDS 3.3), outward, ended by -1.
static const signed char tetrahedron_faces[4][4] = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
static const signed char pyramid_faces[5][4] = {
    {0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
static const signed char prism_faces[5][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}, {0, 2, 1, -1}, {3, 4, 5, -1}};

const signed char (*cw_cell_face_table(int node_count))[4] {
  return node_count == 4 ? tetrahedron_faces : node_count == 5 ? pyramid_faces : prism_faces;
}

int cw_cell_face(const CwRegionData *region, int32_t cell, int face, int32_t nodes[4]) {
  int count;
  const int32_t *n = cw_cell_nodes(region, cell, &count);
  const signed char *f = cw_cell_face_table(count)[face];
  int i = 0;
  for (; i < 4 && f[i] >= 0; ++i) nodes[i] = n[f[i]];
  return i;
}

static inline void add_triangle(const double a[3], const double b[3], const double c[3], double area[3]) {
  double twice[3];
  cw_normal(a, b, c, twice);
  for (int k = 0; k < 3; ++k) area[k] += 0.5 * twice[k];
}

static void face_mean(const double (*points)[3], const int32_t *nodes, int count, double mean[3]) {
  for (int k = 0; k < 3; ++k) {
    mean[k] = 0;
    for (int i = 0; i < count; ++i) mean[k] += points[nodes[i]][k];
    mean[k] /= count;
  }
}

void cw_face_area(const double (*points)[3], const int32_t *nodes, int count, double area[3]) {
  memset(area, 0, 3 * sizeof *area);
  if (count == 3) {
    add_triangle(points[nodes[0]], points[nodes[1]], points[nodes[2]], area);
    return;
  }
  double mean[3];
  face_mean(points, nodes, count, mean);
  for (int i = 0; i < count; ++i) add_triangle(points[nodes[i]], points[nodes[(i + 1) % count]], mean, area);
}

void cw_cell_centre(const CwRegionData *region, int32_t cell, double centre[3]) {
  int count;
  const int32_t *nodes = cw_cell_nodes(region, cell, &count);
  face_mean((const double(*)[3])region->points, nodes, count, centre);
}

// Six times the volume of the tetrahedron that a triangle makes with `o`.
static inline double six_volumes(const double o[3], const double a[3], const double b[3], const double c[3]) {
  double w[3], n[3];
  cw_normal(o, a, b, n);
  cw_sub(c, o, w);
  return cw_dot(n, w);
}

double cw_cell_volume(int count, const double *const *x) {
  const double *o = x[0];
  double six = 0;
  if (count == 4) return six_volumes(o, x[1], x[2], x[3]) / 6;
  const signed char(*face)[4] = cw_cell_face_table(count);
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    const double *a = x[face[f][0]], *b = x[face[f][1]], *c = x[face[f][2]];
    if (face[f][3] < 0) {
      six += six_volumes(o, a, b, c);
      continue;
    }
    // The four triangles about the mean m have a x b + b x c + c x d + d x a = (c - a) x (d - b) in common.
    const double *d = x[face[f][3]];
    double u[3], v[3], n[3], m[3];
    cw_sub(c, a, u);
    cw_sub(d, b, v);
    cw_cross(u, v, n);
    for (int k = 0; k < 3; ++k) m[k] = (a[k] + b[k] + c[k] + d[k]) / 4 - o[k];
    six += cw_dot(n, m);
  }
  return six / 6;
}

// The mean of the triangles of a face, weighed by their areas.
static inline void face_centre(int count, const double *const *x, double centre[3], double twice[3]) {
  const double *a = x[0], *b = x[1], *c = x[2], *d = count == 3 ? a : x[3];
  const double u[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, v[3] = {d[0] - b[0], d[1] - b[1], d[2] - b[2]};
  cw_cross(u, v, twice);
  if (count == 3) {
    for (int k = 0; k < 3; ++k) centre[k] = (a[k] + b[k] + c[k]) / 3;
    return;
  }
  // By coordinate first, so that four triangles go through the processor together.
  double area = 0, to[3][5], normal[3][4], one[4];
  for (int k = 0; k < 3; ++k) {
    centre[k] = (a[k] + b[k] + c[k] + d[k]) / 4;
    for (int i = 0; i < 4; ++i) to[k][i] = x[i][k] - centre[k];
    to[k][4] = to[k][0];
  }
  for (int k = 0; k < 3; ++k) {
    const double *p = to[(k + 1) % 3], *q = to[(k + 2) % 3];
    for (int i = 0; i < 4; ++i) normal[k][i] = p[i] * q[i + 1] - q[i] * p[i + 1];
  }
  for (int i = 0; i < 4; ++i)
    one[i] = sqrt(normal[0][i] * normal[0][i] + normal[1][i] * normal[1][i] + normal[2][i] * normal[2][i]);
  for (int i = 0; i < 4; ++i) area += one[i];
  const double share = 1 / (3 * area);
  for (int k = 0; k < 3; ++k) {
    double moment = 0;
    for (int i = 0; i < 4; ++i) moment += one[i] * (to[k][i] + to[k][i + 1]);
    centre[k] += share * moment;
  }
}

void cw_face_centre(int count, const double *const *x, double centre[3], double twice[3]) {
  face_centre(count, x, centre, twice);
}

double cw_interface_tolerance(int count, const double *const nodes[4]) {
  static const double SHARE = 0.01; // of the shortest edge
  double shortest = INFINITY;
  for (int i = 0; i < count; ++i) {
    const double *a = nodes[i], *b = nodes[(i + 1) % count];
    shortest = fmin(shortest, hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]));
  }
  return SHARE * shortest;
}

void cw_cell_centroid(int count, const double *const *x, double centroid[3]) {
  double centre[CW_CELL_FACES][3], twice[CW_CELL_FACES][3], apex[3] = {0}, volume = 0, moment[3] = {0};
  if (count == 4) {
    for (int k = 0; k < 3; ++k) centroid[k] = (x[0][k] + x[1][k] + x[2][k] + x[3][k]) / 4;
    return;
  }
  const signed char(*face)[4] = cw_cell_face_table(count);
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    const double *corner[4] = {x[face[f][0]], x[face[f][1]], x[face[f][2]], x[face[f][3] < 0 ? 0 : face[f][3]]};
    if (face[f][3] < 0)
      face_centre(3, corner, centre[f], twice[f]);
    else
      face_centre(4, corner, centre[f], twice[f]);
    for (int k = 0; k < 3; ++k) apex[k] += centre[f][k] * (1.0 / CW_CELL_FACES);
  }
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    double one = 0;
    for (int k = 0; k < 3; ++k) one += twice[f][k] * (centre[f][k] - apex[k]);
    volume += one;
    for (int k = 0; k < 3; ++k) moment[k] += one * (centre[f][k] - apex[k]);
  }
  const double share = 0.75 / volume;
  for (int k = 0; k < 3; ++k) centroid[k] = apex[k] + share * moment[k];
}

// The area vector of face `f`, m2; 0 of the fifth of a tetrahedron.
static void face_vector(int count, const double *const *x, int f, double area[3]) {
  memset(area, 0, 3 * sizeof *area);
  if (count == 4 && f == 4) return;
  const signed char *n = cw_cell_face_table(count)[f];
  const double *a = x[n[0]], *b = x[n[1]], *c = x[n[2]], *d = n[3] < 0 ? a : x[n[3]];
  const double u[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]}, v[3] = {d[0] - b[0], d[1] - b[1], d[2] - b[2]};
  cw_cross(u, v, area);
  for (int k = 0; k < 3; ++k) area[k] /= 2;
}

double cw_cell_aspect(int count, const double *const *x) {
  double sum[3] = {0}, area[3];
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    face_vector(count, x, f, area);
    for (int k = 0; k < 3; ++k) sum[k] += fabs(area[k]);
  }
  const double most = fmax(fmax(sum[0], sum[1]), sum[2]), least = fmin(fmin(sum[0], sum[1]), sum[2]);
  return fmax(most / least, (sum[0] + sum[1] + sum[2]) / 6 / pow(cw_cell_volume(count, x), 2.0 / 3));
}

double cw_cell_determinant(int count, const double *const *x, unsigned inner) {
  double sum[3][3] = {{0}}, area[3], minor[3], mean = 0;
  int faces = 0;
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    if (!(inner >> f & 1)) continue;
    face_vector(count, x, f, area);
    mean += cw_norm(area);
    faces += f < 4 || count > 4;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum[i][j] += area[i] * area[j];
  }
  if (mean == 0) return 0;
  mean /= faces;
  cw_cross(sum[1], sum[2], minor);
  return fabs(cw_dot(sum[0], minor)) / 8 / pow(mean, 6);
}
