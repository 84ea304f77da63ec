// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cell.h"

#include <string.h>

// Faces by the CGNS standard (SIDS 3.3), outward, ended by -1.
static const signed char tetrahedron_faces[4][4] = {
    {0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
static const signed char pyramid_faces[5][4] = {
    {0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
static const signed char prism_faces[5][4] = {
    {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}, {0, 2, 1, -1}, {3, 4, 5, -1}};

const signed char (*cw_cell_face_table(int node_count))[4] {
  return node_count == 4 ? tetrahedron_faces : node_count == 5 ? pyramid_faces : prism_faces;
}

int cw_cell_face(const CwRegionData *region, int32_t cell, int face, int32_t nodes[4]) {
  int count;
  const int32_t *n = cw_cell_nodes(region, cell, &count);
  const signed char *f = cw_cell_face_table(count)[face];
  int i = 0;
  for (; i < 4 && f[i] >= 0; ++i)
    nodes[i] = n[f[i]];
  return i;
}

static inline void add_triangle(const double a[3], const double b[3], const double c[3], double area[3]) {
  double u[3], v[3];
  for (int k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
  }
  area[0] += 0.5 * (u[1] * v[2] - u[2] * v[1]);
  area[1] += 0.5 * (u[2] * v[0] - u[0] * v[2]);
  area[2] += 0.5 * (u[0] * v[1] - u[1] * v[0]);
}

static void face_mean(const double (*points)[3], const int32_t *nodes, int count, double mean[3]) {
  for (int k = 0; k < 3; ++k) {
    mean[k] = 0;
    for (int i = 0; i < count; ++i)
      mean[k] += points[nodes[i]][k];
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
  for (int i = 0; i < count; ++i)
    add_triangle(points[nodes[i]], points[nodes[(i + 1) % count]], mean, area);
}

void cw_cell_centre(const CwRegionData *region, int32_t cell, double centre[3]) {
  int count;
  const int32_t *nodes = cw_cell_nodes(region, cell, &count);
  face_mean((const double(*)[3])region->points, nodes, count, centre);
}

static inline double tetrahedron_volume(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double area[3] = {0};
  add_triangle(a, b, c, area);
  return (area[0] * (d[0] - a[0]) + area[1] * (d[1] - a[1]) + area[2] * (d[2] - a[2])) / 3;
}

double cw_cell_volume(const CwRegionData *region, int32_t cell) {
  const double(*points)[3] = (const double(*)[3])region->points;
  int count;
  double centre[3], volume = 0;
  const int32_t *corner = cw_cell_nodes(region, cell, &count);
  if (count == 4)
    return tetrahedron_volume(points[corner[0]], points[corner[1]], points[corner[2]], points[corner[3]]);
  cw_cell_centre(region, cell, centre);
  const signed char(*face)[4] = cw_cell_face_table(count);
  for (int f = 0; f < CW_CELL_FACES; ++f) {
    const double *a = points[corner[face[f][0]]], *b = points[corner[face[f][1]]], *c = points[corner[face[f][2]]];
    if (face[f][3] < 0) {
      volume -= tetrahedron_volume(a, b, c, centre);
      continue;
    }
    const double *d = points[corner[face[f][3]]];
    double mean[3];
    for (int k = 0; k < 3; ++k)
      mean[k] = (a[k] + b[k] + c[k] + d[k]) / 4;
    volume -= tetrahedron_volume(a, b, mean, centre) + tetrahedron_volume(b, c, mean, centre) +
              tetrahedron_volume(c, d, mean, centre) + tetrahedron_volume(d, a, mean, centre);
  }
  return volume;
}
