// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/size/size_grid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double node_count(const double extent[3], double spacing, int32_t count[3]) {
  double nodes = 1;
  for (int k = 0; k < 3; k++) {
    double along = ceil(extent[k] / spacing) + 3;
    count[k] = (int32_t)fmin(along, 1e9);
    nodes *= along;
  }
  return nodes;
}

void cw_size_grid_shape(const double low[3], const double high[3], double spacing, int64_t node_limit,
                        CwSizeGrid *grid) {
  memset(grid, 0, sizeof *grid);
  double extent[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  while (node_count(extent, spacing, grid->count) > (double)node_limit) spacing *= 1.02;
  grid->spacing = spacing;
  for (int k = 0; k < 3; k++) grid->low[k] = low[k] - spacing;
}

CwStatus cw_size_grid_make(const double low[3], const double high[3], double spacing, int64_t node_limit,
                           CwSizeGrid *grid) {
  CwStatus status = CW_OK;
  cw_size_grid_shape(low, high, spacing, node_limit, grid);
  CW_NEW_UNSET(grid->value, cw_size_grid_nodes(grid));
  cw_size_grid_clear(grid);
done:
  return status;
}

void cw_size_grid_clear(CwSizeGrid *grid) {
  size_t nodes = cw_size_grid_nodes(grid);
  for (size_t i = 0; i < nodes; i++) grid->value[i] = cw_size_unset;
}

void cw_size_grid_free(CwSizeGrid *grid) {
  free(grid->value);
  memset(grid, 0, sizeof *grid);
}

int cw_size_grid_any_set(const CwSizeGrid *grid, int64_t first, int64_t last) {
  int any = 0;
  for (int64_t i = first; i <= last; i++) any |= grid->value[i] < cw_size_unset;
  return any;
}

void cw_size_grid_mark_set(const CwSizeGrid *grid, uint8_t *mark) {
  const float *restrict value = grid->value;
  uint8_t *restrict to = mark;
  size_t nodes = cw_size_grid_nodes(grid);
  for (size_t i = 0; i < nodes; i++) to[i] |= value[i] < cw_size_unset;
}

// Cell of x and the place in it, 0..1.
static size_t locate(const CwSizeGrid *grid, const double x[3], double part[3]) {
  size_t index = 0;
  for (int k = 2; k >= 0; k--) {
    double place = (x[k] - grid->low[k]) / grid->spacing;
    int32_t last = grid->count[k] - 2;
    int32_t i = place > 0 ? (place < last ? (int32_t)place : last) : 0;
    double beyond = place - i;
    part[k] = beyond > 0.0 ? (beyond < 1.0 ? beyond : 1.0) : 0.0;
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
    if (value < node[corner[c]]) node[corner[c]] = (float)value;
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

static float least(float a, float b) {
  return a < b ? a : b;
}

static float most(float a, float b) {
  return a < b ? b : a;
}

// The root f of sum over x, y and z of max(0, f - value)^2 = step^2, with the values in any order.
static double upwind(float x, float y, float z, double step) {
  float lower = least(x, y), higher = most(x, y);
  double a = least(lower, z), b = least(higher, most(lower, z)), c = most(higher, z), square = step * step;
  if (a + step <= b) return a + step;
  if ((c - a) * (c - a) + (c - b) * (c - b) >= square) return 0.5 * (a + b + sqrt(2 * square - (a - b) * (a - b)));
  double sum = a + b + c;
  return (sum + sqrt(fmax(0.0, sum * sum - 3 * (a * a + b * b + c * c - square)))) / 3;
}

static float twice_positive(float a) {
  return a + fabsf(a);
}

// Whether that root is under f, by the sum, which grows with f; square: of two steps. Without a branch.
static int is_under(float f, float x, float y, float z, float square) {
  float p = twice_positive(f - x), q = twice_positive(f - y), r = twice_positive(f - z);
  return p * p + q * q + r * r > square;
}

// The nodes that take part, as runs along x: run r of line l covers begin[r] .. end[r], start[l] <= r < start[l + 1].
typedef struct {
  int32_t *start, *begin, *end;
} Runs;

static void runs_free(Runs *runs) {
  free(runs->start);
  free(runs->begin);
  free(runs->end);
}

// The next node of a line, from i on, that takes part (wanted 1) or does not (0); `along` where there is none.
static int32_t next_node(const uint8_t *in, int32_t i, int32_t along, int wanted) {
  if (!in) return wanted ? i : along;
  const uint8_t *found = memchr(in + i, wanted, (size_t)(along - i));
  return found ? (int32_t)(found - in) : along;
}

// within: 1 for nodes that take part, else 0; NULL: all do.
static CwStatus runs_make(const CwSizeGrid *grid, const uint8_t *within, Runs *runs) {
  CwStatus status = CW_OK;
  int32_t along = grid->count[0], lines = grid->count[1] * grid->count[2];
  CW_NEW(runs->start, lines + 1);
  for (int store = 0; store < 2; store++) {
    int32_t count = 0;
    for (int32_t line = 0; line < lines; line++) {
      const uint8_t *in = within ? within + (size_t)line * (size_t)along : NULL;
      for (int32_t i = next_node(in, 0, along, 1), end; i < along; i = next_node(in, end, along, 1)) {
        end = next_node(in, i, along, 0);
        if (store) runs->begin[count] = i, runs->end[count] = end - 1;
        count++;
      }
      runs->start[line + 1] = count;
    }
    if (store) break;
    CW_NEW(runs->begin, count);
    CW_NEW(runs->end, count);
  }
done:
  return status;
}

// When each line along x was looked at last, and when a node on it was lowered last.
typedef struct {
  int32_t now, *seen, *lowered;
} Clock;

// Whether nothing on the line or beside it was lowered since it was looked at: then another look, either way, lowers
// nothing.
static int is_settled(const Clock *clock, const int32_t n[3], int32_t j, int32_t k) {
  int32_t line = k * n[1] + j, seen = clock->seen[line];
  return seen > clock->lowered[line] && (j == 0 || seen > clock->lowered[line - 1]) &&
         (j + 1 == n[1] || seen > clock->lowered[line + 1]) && (k == 0 || seen > clock->lowered[line - n[1]]) &&
         (k + 1 == n[2] || seen > clock->lowered[line + n[1]]);
}

// What a line along x is held against, while a sweep is on it: for each node the lower of the values beside it along y
// and along z, and whether the values around, as they are, may lower it.
typedef struct {
  float *y, *z;
  int32_t *low;
} Beside;

// A node changes by more than `least`, which with the rounding of float numbers is not less than `sure`.
typedef struct {
  double step;
  float square, least, sure;
} Slope;

// For a run. Lines that are not there are full of unset values. In a loop of its own, which the compiler makes vectors
// of.
static void look_beside(const float *restrict line, const float *const around[4], int32_t along, int32_t begin,
                        int32_t end, const Slope *slope, const Beside *beside) {
  const float *restrict p = around[0], *restrict q = around[1], *restrict r = around[2], *restrict s = around[3];
  float *restrict y = beside->y, *restrict z = beside->z, square = slope->square, sure = slope->sure;
  int32_t *restrict low = beside->low;
  for (int32_t i = begin; i <= end; i++) {
    y[i] = least(p[i], q[i]);
    z[i] = least(r[i], s[i]);
  }
  int32_t from = begin > 0 ? begin : 1, to = end + 1 < along ? end : along - 2;
  low[begin] = low[end] = 1; // these may lack a neighbour
  for (int32_t i = from; i <= to; i++) {
    low[i] = is_under(line[i] - sure, least(line[i - 1], line[i + 1]), y[i], z[i], square);
  }
}

// Lowers the nodes of a run, forwards or back along x; returns how many went lower.
static int64_t sweep_run(float *line, int32_t along, int32_t begin, int32_t end, int back, const Slope *slope,
                         const Beside *beside) {
  int64_t lowered = 0;
  int lowered_last = 0; // then the next may be lowered too
  for (int32_t ii = begin; ii <= end; ii++) {
    int32_t i = back ? begin + end - ii : ii;
    if (!beside->low[i] && !lowered_last) continue;
    lowered_last = 0;
    float before = i > 0 ? line[i - 1] : cw_size_unset, after = i + 1 < along ? line[i + 1] : cw_size_unset;
    float x = least(before, after), y = beside->y[i], z = beside->z[i];
    if (!is_under(line[i] - slope->sure, x, y, z, slope->square)) continue;
    double f = upwind(x, y, z, slope->step);
    if (f < line[i] - slope->least) {
      line[i] = (float)f;
      lowered++;
      lowered_last = 1;
    }
  }
  return lowered;
}

// One sweep in the direction of bits of `sweep`; returns how many nodes went lower. `nothing`: a line of unset values.
static int64_t sweep_once(CwSizeGrid *grid, const Runs *runs, int sweep, const Slope *slope, Clock *clock,
                          const Beside *beside, const float *nothing) {
  const int32_t *n = grid->count;
  size_t row = (size_t)n[0], slab = row * (size_t)n[1];
  int64_t lowered = 0;
  for (int32_t kk = 0; kk < n[2]; kk++) {
    int32_t k = sweep & 4 ? n[2] - 1 - kk : kk;
    for (int32_t jj = 0; jj < n[1]; jj++) {
      int32_t j = sweep & 2 ? n[1] - 1 - jj : jj;
      float *line = grid->value + (size_t)k * slab + (size_t)j * row;
      if (is_settled(clock, n, j, k)) continue;
      int64_t before = lowered;
      clock->seen[k * n[1] + j] = ++clock->now;
      int32_t first = runs->start[k * n[1] + j], last = runs->start[k * n[1] + j + 1] - 1;
      const float *const around[4] = {j > 0 ? line - row : nothing, j + 1 < n[1] ? line + row : nothing,
                                      k > 0 ? line - slab : nothing, k + 1 < n[2] ? line + slab : nothing};
      for (int32_t rr = first; rr <= last; rr++) {
        int32_t r = sweep & 1 ? first + last - rr : rr;
        look_beside(line, around, n[0], runs->begin[r], runs->end[r], slope, beside);
        lowered += sweep_run(line, n[0], runs->begin[r], runs->end[r], sweep & 1, slope, beside);
      }
      if (lowered > before) clock->lowered[k * n[1] + j] = clock->now;
    }
  }
  return lowered;
}

// Lowers the nodes of a line that are not `within` to `step` over those of another.
static void go_on_across(float *restrict line, const float *restrict from, const uint8_t *restrict within,
                         int32_t along, float step) {
  for (int32_t i = 0; i < along; i++) {
    float next = from[i] + step;
    next = next < line[i] ? next : line[i];
    line[i] = within[i] ? line[i] : next;
  }
}

// The nodes outside of `within`, from those before them along each axis, then from those behind.
static void go_on_outside(CwSizeGrid *grid, const uint8_t *within, float step) {
  const int32_t *n = grid->count;
  size_t row = (size_t)n[0], slab = row * (size_t)n[1];
  for (int32_t k = 0; k < n[2]; k++) {
    for (int32_t j = 0; j < n[1]; j++) {
      size_t start = (size_t)k * slab + (size_t)j * row;
      float *line = grid->value + start;
      const uint8_t *in = within + start;
      if (j > 0) go_on_across(line, line - row, in, n[0], step);
      if (k > 0) go_on_across(line, line - slab, in, n[0], step);
      for (int32_t i = 1; i < n[0]; i++) {
        if (line[i - 1] + step < line[i] && !in[i]) line[i] = line[i - 1] + step;
      }
    }
  }
  for (int32_t k = n[2] - 1; k >= 0; k--) {
    for (int32_t j = n[1] - 1; j >= 0; j--) {
      size_t start = (size_t)k * slab + (size_t)j * row;
      float *line = grid->value + start;
      const uint8_t *in = within + start;
      if (j + 1 < n[1]) go_on_across(line, line + row, in, n[0], step);
      if (k + 1 < n[2]) go_on_across(line, line + slab, in, n[0], step);
      for (int32_t i = n[0] - 2; i >= 0; i--) {
        if (line[i + 1] + step < line[i] && !in[i]) line[i] = line[i + 1] + step;
      }
    }
  }
}

CwStatus cw_size_grid_spread(CwSizeGrid *grid, double slope, const uint8_t *within) {
  CwStatus status = CW_OK;
  Runs runs = {0};
  Clock clock = {0};
  Beside beside = {0};
  float *nothing = NULL;
  double step = slope * grid->spacing;
  const Slope steep = {step, (float)(4 * step * step), (float)(1e-3 * step), (float)(0.99e-3 * step)};
  CW_NEW(beside.y, grid->count[0]);
  CW_NEW(beside.z, grid->count[0]);
  CW_NEW(beside.low, grid->count[0]);
  CW_NEW(nothing, grid->count[0]);
  for (int32_t i = 0; i < grid->count[0]; i++) nothing[i] = cw_size_unset;
  CW_TRY(runs_make(grid, within, &runs));
  CW_NEW(clock.seen, (size_t)grid->count[1] * (size_t)grid->count[2]);
  CW_NEW(clock.lowered, (size_t)grid->count[1] * (size_t)grid->count[2]);
  for (int quiet = 0, sweep = 0; quiet < 8; sweep = (sweep + 1) % 8) {
    quiet = sweep_once(grid, &runs, sweep, &steep, &clock, &beside, nothing) > 0 ? 0 : quiet + 1;
  }
  if (within) go_on_outside(grid, within, (float)step);
done:
  free(beside.y);
  free(beside.z);
  free(beside.low);
  free(nothing);
  runs_free(&runs);
  free(clock.seen);
  free(clock.lowered);
  return status;
}
