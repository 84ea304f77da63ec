// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_columns.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/number.h"

struct CwColumns {
  const double (*x)[3];
  const int32_t (*triangle)[3];
  double low[2], per_bin[2]; // bins per length
  int32_t bins[2];
  int64_t *start;  // of each bin; bins + 1
  int32_t *member; // triangles whose box meets the bin
  double *z;
  int32_t *chosen; // members of a bin that are looked at closely
  int32_t z_space, chosen_space;
};

static int32_t bin_of(const CwColumns *columns, int axis, double value) {
  double place = (value - columns->low[axis]) * columns->per_bin[axis];
  return place < 0.0 ? 0 : place >= columns->bins[axis] ? columns->bins[axis] - 1 : (int32_t)place;
}

// Lists the triangles of each bin: counts them, then fills from behind.
static void sort_triangles(CwColumns *columns, int32_t triangle_count, int store) {
  for (int32_t t = triangle_count - 1; t >= 0; t--) {
    int32_t from[2], to[2];
    for (int i = 0; i < 2; i++) {
      double a = columns->x[columns->triangle[t][0]][i], b = columns->x[columns->triangle[t][1]][i];
      double c = columns->x[columns->triangle[t][2]][i];
      from[i] = bin_of(columns, i, fmin(fmin(a, b), c));
      to[i] = bin_of(columns, i, fmax(fmax(a, b), c));
    }
    for (int32_t j = from[1]; j <= to[1]; j++) {
      for (int32_t i = from[0]; i <= to[0]; i++) {
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
  double high[2] = {-INFINITY, -INFINITY};
  CW_NEW(columns, 1);
  columns->x = input->x;
  columns->triangle = input->triangle;
  columns->low[0] = columns->low[1] = INFINITY;
  for (int32_t p = 0; p < input->point_count; p++) {
    for (int i = 0; i < 2; i++) {
      columns->low[i] = fmin(columns->low[i], input->x[p][i]);
      high[i] = fmax(high[i], input->x[p][i]);
    }
  }
  for (int i = 0; i < 2; i++) {
    columns->bins[i] = (int32_t)ceil(sqrt((double)input->triangle_count)) + 1;
    columns->per_bin[i] = high[i] > columns->low[i] ? columns->bins[i] / (high[i] - columns->low[i]) : 0.0;
  }
  int64_t bins = (int64_t)columns->bins[0] * columns->bins[1], total = 0;
  CW_NEW(columns->start, bins + 1);
  sort_triangles(columns, input->triangle_count, 0);
  for (int64_t b = 0; b <= bins; b++) {
    total += columns->start[b];
    columns->start[b] = total;
  }
  CW_NEW(columns->member, total);
  sort_triangles(columns, input->triangle_count, 1);
  *result = columns;
  columns = NULL;
done:
  cw_columns_free(&columns);
  return status;
}

void cw_columns_free(CwColumns **columns) {
  if (!*columns) return;
  free((*columns)->start);
  free((*columns)->member);
  free((*columns)->z);
  free((*columns)->chosen);
  free(*columns);
  *columns = NULL;
}

// The edge from a to b crosses the line x = px of the plane above py: half-open in x, and always computed
// from the left end, so that the two triangles at an edge agree to the bit. Above or below is also what lies so with
// both ends. Of an edge that does not cross, the quotient is of no use.
static inline unsigned edge_above(const double a[3], const double b[3], double px, double py) {
  unsigned of_a = cw_number(a[0] <= px), of_b = cw_number(b[0] <= px), up_a = cw_number(a[1] > py);
  unsigned up_b = cw_number(b[1] > py);
  const double *end[2] = {b, a}, *left = end[of_a], *right = end[1 - of_a];
  unsigned up = cw_number(left[1] + (right[1] - left[1]) * ((px - left[0]) / (right[0] - left[0])) > py);
  return (of_a ^ of_b) & ((up_a & up_b) | ((up_a | up_b) & up));
}

// The members of a bin that may be cut: the others have all corners on one side in x or in y, so that none or two of
// their edges cross above.
static int32_t choose_members(const CwColumns *columns, int64_t bin, double x, double y) {
  int32_t chosen = 0;
  for (int64_t k = columns->start[bin]; k < columns->start[bin + 1]; k++) {
    const int32_t *t = columns->triangle[columns->member[k]];
    const double *a = columns->x[t[0]], *b = columns->x[t[1]], *c = columns->x[t[2]];
    unsigned left = cw_number(a[0] <= x) + cw_number(b[0] <= x) + cw_number(c[0] <= x);
    unsigned above = cw_number(a[1] > y) + cw_number(b[1] > y) + cw_number(c[1] > y);
    columns->chosen[chosen] = columns->member[k];
    chosen += (int32_t)(cw_number(left - 1 < 2) & cw_number(above - 1 < 2));
  }
  return chosen;
}

CwStatus cw_columns_cut(CwColumns *columns, double x, double y, int32_t *count, const double **z) {
  CwStatus status = CW_OK;
  int64_t bin = (int64_t)bin_of(columns, 1, y) * columns->bins[0] + bin_of(columns, 0, x);
  int64_t members = columns->start[bin + 1] - columns->start[bin];
  *count = 0;
  CW_GROW(columns->z, columns->z_space, members);
  CW_GROW(columns->chosen, columns->chosen_space, members);
  int32_t chosen = choose_members(columns, bin, x, y);
  for (int32_t k = 0; k < chosen; k++) {
    const int32_t *t = columns->triangle[columns->chosen[k]];
    const double *a = columns->x[t[0]], *b = columns->x[t[1]], *c = columns->x[t[2]];
    if (!(edge_above(a, b, x, y) ^ edge_above(b, c, x, y) ^ edge_above(c, a, x, y))) continue;
    double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    double nz = ux * vy - uy * vx, nx = uy * vz - uz * vy, ny = uz * vx - ux * vz;
    double height = a[2] - (nx * (x - a[0]) + ny * (y - a[1])) / nz;
    // An upright triangle is crossed somewhere on its height.
    double low = fmin(fmin(a[2], b[2]), c[2]), high = fmax(fmax(a[2], b[2]), c[2]);
    columns->z[(*count)++] = height >= low && height <= high ? height : 0.5 * (low + high);
  }
  *z = columns->z;
done:
  return status;
}
