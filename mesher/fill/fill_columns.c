// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_columns.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/branchless.h"
#include "mesher/common/vec.h"

// Of a triangle, seen along z. Rounding keeps the order of numbers, so that a place in the triangle is in its box, too.
typedef struct {
  float low[2], high[2];
} Box;

struct CwColumns {
  const double (*x)[3];
  const int32_t (*triangle)[3];
  Box *box;                 // of each triangle
  float low[2], per_bin[2]; // bins per length
  int32_t bins[2];
  int64_t *start;  // of each bin; bins + 1
  int32_t *member; // triangles whose box meets the bin
  double *z;
  int32_t *chosen; // members of a bin that are looked at closely
  int32_t z_space, chosen_space;
};

static int32_t bin_of(const CwColumns *columns, int axis, float value) {
  float place = (value - columns->low[axis]) * columns->per_bin[axis];
  return place < 0.0f ? 0 : place >= columns->bins[axis] ? columns->bins[axis] - 1 : (int32_t)place;
}

static Box box_of(const CwColumns *columns, int32_t t) {
  Box box;
  for (int i = 0; i < 2; i++) {
    float a = (float)columns->x[columns->triangle[t][0]][i], b = (float)columns->x[columns->triangle[t][1]][i];
    float c = (float)columns->x[columns->triangle[t][2]][i], low = a < b ? a : b, high = a < b ? b : a;
    box.low[i] = c < low ? c : low;
    box.high[i] = c > high ? c : high;
  }
  return box;
}

// Lists the triangles of each bin: counts them, then fills from behind.
static void sort_triangles(CwColumns *columns, int32_t triangle_count, int store) {
  for (int32_t t = triangle_count - 1; t >= 0; t--) {
    const Box *box = &columns->box[t];
    int32_t left = bin_of(columns, 0, box->low[0]), right = bin_of(columns, 0, box->high[0]);
    int32_t last = bin_of(columns, 1, box->high[1]);
    for (int32_t j = bin_of(columns, 1, box->low[1]); j <= last; j++) {
      for (int32_t i = left; i <= right; i++) {
        int64_t *at = &columns->start[(int64_t)j * columns->bins[0] + i];
        if (store)
          columns->member[--*at] = t;
        else
          ++*at;
      }
    }
  }
}

CwStatus cw_columns_make(const CwFillInput *input, CwColumns **result) {
  CwStatus status = CW_OK;
  CwColumns *columns = NULL;
  float high[2] = {-INFINITY, -INFINITY};
  CW_NEW(columns, 1);
  columns->x = input->x;
  columns->triangle = input->triangle;
  columns->low[0] = columns->low[1] = INFINITY;
  CW_NEW_UNSET(columns->box, input->triangle_count);
  for (int32_t t = 0; t < input->triangle_count; t++) {
    columns->box[t] = box_of(columns, t);
    for (int i = 0; i < 2; i++) {
      float low = columns->box[t].low[i], up = columns->box[t].high[i];
      columns->low[i] = low < columns->low[i] ? low : columns->low[i];
      high[i] = up > high[i] ? up : high[i];
    }
  }
  for (int i = 0; i < 2; i++) {
    columns->bins[i] = (int32_t)ceil(sqrt((double)input->triangle_count)) + 1;
    columns->per_bin[i] = high[i] > columns->low[i] ? (float)columns->bins[i] / (high[i] - columns->low[i]) : 0.0f;
  }
  int64_t bins = (int64_t)columns->bins[0] * columns->bins[1], total = 0;
  CW_NEW(columns->start, bins + 1);
  sort_triangles(columns, input->triangle_count, 0);
  for (int64_t b = 0; b <= bins; b++) {
    total += columns->start[b];
    columns->start[b] = total;
  }
  CW_NEW_UNSET(columns->member, total);
  sort_triangles(columns, input->triangle_count, 1);
  *result = columns;
  columns = NULL;
done:
  cw_columns_free(&columns);
  return status;
}

void cw_columns_free(CwColumns **columns) {
  if (!*columns) return;
  free((*columns)->box);
  free((*columns)->start);
  free((*columns)->member);
  free((*columns)->z);
  free((*columns)->chosen);
  free(*columns);
  *columns = NULL;
}

// The edge from a to b crosses the line x = px of the plane above py: half-open in x, and always computed
// from the left end, so that the two triangles at an edge agree to the bit. Above or below is also what lies so with
// both ends.
static inline unsigned edge_above(const double a[3], const double b[3], double px, double py) {
  unsigned of_a = cw_branchless(a[0] <= px), of_b = cw_branchless(b[0] <= px), up_a = cw_branchless(a[1] > py);
  unsigned up_b = cw_branchless(b[1] > py);
  const double *end[2] = {b, a}, *left = end[of_a], *right = end[1 - of_a];
  unsigned up = cw_branchless((right[1] - left[1]) * (px - left[0]) > (py - left[1]) * (right[0] - left[0]));
  return (of_a ^ of_b) & ((up_a & up_b) | ((up_a | up_b) & up));
}

// The members of a bin that may be cut.
static int32_t choose_members(const CwColumns *columns, int64_t bin, float x, float y) {
  int32_t chosen = 0;
  for (int64_t k = columns->start[bin]; k < columns->start[bin + 1]; k++) {
    const Box *box = &columns->box[columns->member[k]];
    columns->chosen[chosen] = columns->member[k];
    chosen += (int32_t)(cw_branchless(box->low[0] <= x) & cw_branchless(box->high[0] >= x) &
                        cw_branchless(box->low[1] <= y) & cw_branchless(box->high[1] >= y));
  }
  return chosen;
}

CwStatus cw_columns_cut(CwColumns *columns, double x, double y, int32_t *count, const double **z) {
  CwStatus status = CW_OK;
  int64_t bin = (int64_t)bin_of(columns, 1, (float)y) * columns->bins[0] + bin_of(columns, 0, (float)x);
  int64_t members = columns->start[bin + 1] - columns->start[bin];
  *count = 0;
  CW_GROW(columns->z, columns->z_space, members + 1);
  CW_GROW(columns->chosen, columns->chosen_space, members);
  int32_t chosen = choose_members(columns, bin, (float)x, (float)y);
  for (int32_t k = 0; k < chosen; k++) {
    const int32_t *t = columns->triangle[columns->chosen[k]];
    const double *a = columns->x[t[0]], *b = columns->x[t[1]], *c = columns->x[t[2]];
    columns->chosen[*count] = columns->chosen[k];
    *count += (int32_t)(edge_above(a, b, x, y) ^ edge_above(b, c, x, y) ^ edge_above(c, a, x, y));
  }
  for (int32_t k = 0; k < *count; k++) {
    const int32_t *t = columns->triangle[columns->chosen[k]];
    const double *a = columns->x[t[0]], *b = columns->x[t[1]], *c = columns->x[t[2]];
    double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    double nz = ux * vy - uy * vx, nx = uy * vz - uz * vy, ny = uz * vx - ux * vz;
    double height = a[2] - (nx * (x - a[0]) + ny * (y - a[1])) / nz;
    // An upright triangle is crossed somewhere on its height.
    double low = cw_lesser(cw_lesser(a[2], b[2]), c[2]), high = cw_greater(cw_greater(a[2], b[2]), c[2]);
    columns->z[k] = height >= low && height <= high ? height : 0.5 * (low + high);
  }
  *z = columns->z;
done:
  return status;
}
