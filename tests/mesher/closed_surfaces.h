// SPDX-License-Identifier: AGPL-3.0-or-later
// Closed triangulations for tests: boxes and spheres, appended to one surface, with their normals out or in.
#pragma once

#include "mesher/fill/fill.h"
#include "surfaces.h"

// The surface as a boundary to fill, with `size` at every place; NULL for steps that need none.
static inline CwFillInput surface_fill_input(const Surface *s, CwSizeAt size, const void *context) {
  return (CwFillInput){.point_count = s->point_count,
                       .x = (const double(*)[3])s->x,
                       .triangle_count = s->triangle_count,
                       .triangle = (const int32_t(*)[3])s->triangle,
                       .size = size,
                       .size_context = context,
                       .name = "rotor region 3"};
}

// The point from `search_from` on that is there already, or a new one.
static inline int32_t surface_point_from(Surface *s, const double p[3], int32_t search_from) {
  for (int32_t i = search_from; i < s->point_count; i++) {
    if (fabs(s->x[i][0] - p[0]) + fabs(s->x[i][1] - p[1]) + fabs(s->x[i][2] - p[2]) < 1e-9) return i;
  }
  return surface_point(s, p);
}

static inline void surface_facing(Surface *s, int32_t a, int32_t b, int32_t c, int outward) {
  surface_triangle(s, a, outward ? b : c, outward ? c : b);
}

// A box with n[i] edges along axis i; each square has the same diagonal (cocircular points everywhere).
static inline void surface_add_box(Surface *s, const double low[3], const double high[3], const int n[3], int outward) {
  int32_t from = s->point_count;
  for (int axis = 0; axis < 3; axis++) {
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side = 0; side < 2; side++) {
      for (int j = 0; j < n[v]; j++) {
        for (int i = 0; i < n[u]; i++) {
          int32_t corner[4];
          for (int k = 0; k < 4; k++) {
            double p[3];
            p[axis] = side ? high[axis] : low[axis];
            p[u] = low[u] + (high[u] - low[u]) * (i + (k == 1 || k == 2)) / n[u];
            p[v] = low[v] + (high[v] - low[v]) * (j + (k >= 2)) / n[v];
            corner[k] = surface_point_from(s, p, from);
          }
          surface_facing(s, corner[0], corner[1], corner[2], side == outward);
          surface_facing(s, corner[0], corner[2], corner[3], side == outward);
        }
      }
    }
  }
}

// An icosahedron, each face cut into 4^level.
static inline void surface_add_sphere(Surface *s, const double centre[3], double radius, int level, int outward) {
  static const int face[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                  {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                  {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  const double g = 0.5 * (1.0 + sqrt(5.0));
  const double corner[12][3] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  int n = 1 << level;
  int32_t from = s->point_count;
  for (int f = 0; f < 20; f++) {
    for (int i = 0; i < n; i++) {
      for (int j = 0; j < n - i; j++) {
        int32_t at[4];
        for (int k = 0; k < 4; k++) { // (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)
          double a = (double)(i + (k & 1)) / n, b = (double)(j + (k >> 1)) / n, p[3], length = 0.0;
          if (a + b > 1.0 + 1e-12) continue;
          for (int c = 0; c < 3; c++) {
            p[c] = (1.0 - a - b) * corner[face[f][0]][c] + a * corner[face[f][1]][c] + b * corner[face[f][2]][c];
            length += p[c] * p[c];
          }
          for (int c = 0; c < 3; c++) p[c] = centre[c] + radius * p[c] / sqrt(length);
          at[k] = surface_point_from(s, p, from);
        }
        surface_facing(s, at[0], at[1], at[2], outward);
        if (i + j < n - 1) surface_facing(s, at[1], at[3], at[2], outward);
      }
    }
  }
}

// Enclosed volume.
static inline double surface_volume(const Surface *s) {
  long double six = 0.0;
  for (int32_t t = 0; t < s->triangle_count; t++) {
    const double *a = s->x[s->triangle[t][0]], *b = s->x[s->triangle[t][1]], *c = s->x[s->triangle[t][2]];
    six += (long double)a[0] * (b[1] * c[2] - b[2] * c[1]) + (long double)a[1] * (b[2] * c[0] - b[0] * c[2]) +
           (long double)a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return (double)(six / 6.0);
}
