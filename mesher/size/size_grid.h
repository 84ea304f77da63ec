// SPDX-License-Identifier: AGPL-3.0-or-later
// A scalar field on a Cartesian grid that spreads from seeds with a limited slope: f(x) = min (f_p + slope |x
// - p|).
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "pipeline/status.h"

typedef struct {
  double low[3]; // node (0, 0, 0)
  double spacing;
  int32_t count[3]; // nodes along x, y, z
  float *value;     // x fastest
} CwSizeGrid;

static const float cw_size_unset = 1e30f; // of a node without a value: any that it has is less

static inline size_t cw_size_grid_nodes(const CwSizeGrid *grid) {
  return (size_t)grid->count[0] * (size_t)grid->count[1] * (size_t)grid->count[2];
}

// Covers the box low..high and one spacing around it. Where that takes more than `node_limit` nodes, the
// spacing becomes as coarse as needed. All values begin at cw_size_unset.
CwStatus cw_size_grid_make(const double low[3], const double high[3], double spacing, int64_t node_limit,
                           CwSizeGrid *grid);
// The same grid without values, for those that have a place of their own.
void cw_size_grid_shape(const double low[3], const double high[3], double spacing, int64_t node_limit,
                        CwSizeGrid *grid);
void cw_size_grid_clear(CwSizeGrid *grid); // no value anywhere
void cw_size_grid_free(CwSizeGrid *grid);

// Lowers the eight nodes around x to `value`, so that the field at x is at most that.
void cw_size_grid_seed(CwSizeGrid *grid, const double x[3], double value);

// Whether any of these nodes has a value yet.
int cw_size_grid_any_set(const CwSizeGrid *grid, int64_t first, int64_t last);

// Sets a byte of `mark` (one for each node) where a node has a value; leaves the others as they are.
void cw_size_grid_mark_set(const CwSizeGrid *grid, uint8_t *mark);

// Lowers every node to the greatest field of gradient `slope` under the seeds: |grad f| = slope by fast
// sweeping (H. Zhao, Math. Comp. 74, 2005), to convergence. With `within` (a byte for each node) it spreads
// through these nodes alone; the others then only go on from their neighbours, step by step along the axes.
CwStatus cw_size_grid_spread(CwSizeGrid *grid, double slope, const uint8_t *within);

// Trilinear; outside of the grid the value of its nearest point.
double cw_size_grid_at(const CwSizeGrid *grid, const double x[3]);
