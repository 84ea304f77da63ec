// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/size_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const float unset = 1e30f;

static double node_count(const double extent[3], double spacing, int32_t count[3]) {
  double nodes = 1;
  for (int k = 0; k < 3; k++) {
    double along = ceil(extent[k] / spacing) + 3;
    count[k] = (int32_t)fmin(along, 1e9);
    nodes *= along;
  }
  return nodes;
}

CwStatus cw_size_grid_make(const double low[3], const double high[3], double spacing, int64_t node_limit,
                           CwSizeGrid *grid) {
  CwStatus status = CW_OK;
  memset(grid, 0, sizeof *grid);
  double extent[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  while (node_count(extent, spacing, grid->count) > (double)node_limit)
    spacing *= 1.02;
  grid->spacing = spacing;
  for (int k = 0; k < 3; k++)
    grid->low[k] = low[k] - spacing;
  size_t nodes = (size_t)grid->count[0] * grid->count[1] * grid->count[2];
  CW_NEW(grid->value, nodes);
  for (size_t i = 0; i < nodes; i++)
    grid->value[i] = unset;
done:
  return status;
}

void cw_size_grid_free(CwSizeGrid *grid) {
  free(grid->value);
  memset(grid, 0, sizeof *grid);
}

// Cell of x and the place in it, 0..1.
static size_t locate(const CwSizeGrid *grid, const double x[3], double part[3]) {
  size_t index = 0;
  for (int k = 2; k >= 0; k--) {
    double place = (x[k] - grid->low[k]) / grid->spacing;
    int32_t last = grid->count[k] - 2;
    int32_t i = place > 0 ? (place < last ? (int32_t)place : last) : 0;
    part[k] = fmin(fmax(place - i, 0.0), 1.0);
    index = index * (size_t)grid->count[k] + (size_t)i;
  }
  return index;
}

void cw_size_grid_seed(CwSizeGrid *grid, const double x[3], double value) {
  double part[3];
  float *node = grid->value + locate(grid, x, part);
  size_t row = (size_t)grid->count[0], slab = row * (size_t)grid->count[1];
  const size_t corner[8] = {0, 1, row, row + 1, slab, slab + 1, slab + row, slab + row + 1};
  for (int c = 0; c < 8; c++) {
    if (value < node[corner[c]])
      node[corner[c]] = (float)value;
  }
}

double cw_size_grid_at(const CwSizeGrid *grid, const double x[3]) {
  double p[3];
  const float *node = grid->value + locate(grid, x, p);
  size_t row = (size_t)grid->count[0], slab = row * (size_t)grid->count[1];
  double a = node[0] + p[0] * (node[1] - node[0]);
  double b = node[row] + p[0] * (node[row + 1] - node[row]);
  node += slab;
  double c = node[0] + p[0] * (node[1] - node[0]);
  double d = node[row] + p[0] * (node[row + 1] - node[row]);
  a += p[1] * (b - a);
  c += p[1] * (d - c);
  return a + p[2] * (c - a);
}

// The root of sum over the upwind directions (f - a)^2 = step^2, with as many of the three as lie under it.
static double upwind(double a, double b, double c, double step) {
  double swap;
  if (a > b)
    swap = a, a = b, b = swap;
  if (b > c)
    swap = b, b = c, c = swap;
  if (a > b)
    swap = a, a = b, b = swap;
  double f = a + step;
  if (f <= b)
    return f;
  f = 0.5 * (a + b + sqrt(2 * step * step - (a - b) * (a - b)));
  if (f <= c)
    return f;
  double sum = a + b + c;
  return (sum + sqrt(fmax(0.0, sum * sum - 3 * (a * a + b * b + c * c - step * step)))) / 3;
}

static double least_of(const float *node, int32_t i, int32_t count, size_t stride) {
  float before = i > 0 ? node[-(ptrdiff_t)stride] : unset, after = i + 1 < count ? node[stride] : unset;
  return before < after ? before : after;
}

// One sweep in the direction of bits of `sweep`; returns how many nodes went lower.
static int64_t sweep_once(CwSizeGrid *grid, int sweep, double step) {
  const int32_t *n = grid->count;
  size_t row = (size_t)n[0], slab = row * (size_t)n[1];
  double least_change = 1e-3 * step;
  int64_t lowered = 0;
  for (int32_t kk = 0; kk < n[2]; kk++) {
    int32_t k = sweep & 4 ? n[2] - 1 - kk : kk;
    for (int32_t jj = 0; jj < n[1]; jj++) {
      int32_t j = sweep & 2 ? n[1] - 1 - jj : jj;
      float *line = grid->value + (size_t)k * slab + (size_t)j * row;
      for (int32_t ii = 0; ii < n[0]; ii++) {
        int32_t i = sweep & 1 ? n[0] - 1 - ii : ii;
        float *node = line + i;
        double a = least_of(node, i, n[0], 1), b = least_of(node, j, n[1], row),
               c = least_of(node, k, n[2], slab);
        double lowest = a < b ? a : b;
        lowest = lowest < c ? lowest : c;
        if (lowest + 0.57 * step >= *node)
          continue; // no root is under lowest + step / sqrt(3)
        double f = upwind(a, b, c, step);
        if (f < *node - least_change) {
          *node = (float)f;
          lowered++;
        }
      }
    }
  }
  return lowered;
}

void cw_size_grid_spread(CwSizeGrid *grid, double slope) {
  double step = slope * grid->spacing;
  for (int quiet = 0, sweep = 0; quiet < 8; sweep = (sweep + 1) % 8) {
    quiet = sweep_once(grid, sweep, step) > 0 ? 0 : quiet + 1;
  }
}
