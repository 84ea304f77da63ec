// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/verticals.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/branchless.h"
#include "mesher/common/vec.h"

// Of a triangle, seen along z. Rounding keeps the order of numbers, so that a place in the triangle is in its box, too.
typedef struct {
  float low[2], high[2];
} Box;

struct CwVerticals {
  const double (*x)[3];
  const int32_t (*triangle)[3];
  Box *box;                 // of each triangle
  float low[2], per_bin[2]; // bins per length
  int32_t bins[2];
  int64_t *start;  // of each bin; bins + 1
  int32_t *member; // triangles whose box meets the bin
  double *z;
  int32_t *chosen; // members of a bin that are looked at closely
  int32_t z_capacity, chosen_capacity;
};

static int32_t bin_of(const CwVerticals *verticals, int axis, float value) {
  float place = (value - verticals->low[axis]) * verticals->per_bin[axis];
  return place < 0.0f ? 0 : place >= verticals->bins[axis] ? verticals->bins[axis] - 1 : (int32_t)place;
}

static Box box_of(const CwVerticals *verticals, int32_t t) {
  Box box;
  for (int i = 0; i < 2; i++) {
    float a = (float)verticals->x[verticals->triangle[t][0]][i], b = (float)verticals->x[verticals->triangle[t][1]][i];
    float c = (float)verticals->x[verticals->triangle[t][2]][i], low = a < b ? a : b, high = a < b ? b : a;
    box.low[i] = c < low ? c : low;
    box.high[i] = c > high ? c : high;
  }
  return box;
}

// Lists the triangles of each bin: counts them, then fills from behind.
static void sort_triangles(CwVerticals *verticals, int32_t triangle_count, int store) {
  for (int32_t t = triangle_count - 1; t >= 0; t--) {
    const Box *box = &verticals->box[t];
    int32_t left = bin_of(verticals, 0, box->low[0]), right = bin_of(verticals, 0, box->high[0]);
    int32_t last = bin_of(verticals, 1, box->high[1]);
    for (int32_t j = bin_of(verticals, 1, box->low[1]); j <= last; j++) {
      for (int32_t i = left; i <= right; i++) {
        int64_t *at = &verticals->start[(int64_t)j * verticals->bins[0] + i];
        if (store)
          verticals->member[--*at] = t;
        else
          ++*at;
      }
    }
  }
}

CwStatus cw_verticals_make(const double (*x)[3], int32_t triangle_count, const int32_t (*triangle)[3],
                           CwVerticals **result) {
  CwStatus status = CW_OK;
  CwVerticals *verticals = NULL;
  float high[2] = {-INFINITY, -INFINITY};
  CW_NEW(verticals, 1);
  verticals->x = x;
  verticals->triangle = triangle;
  verticals->low[0] = verticals->low[1] = INFINITY;
  CW_NEW_UNSET(verticals->box, triangle_count);
  for (int32_t t = 0; t < triangle_count; t++) {
    verticals->box[t] = box_of(verticals, t);
    for (int i = 0; i < 2; i++) {
      float low = verticals->box[t].low[i], up = verticals->box[t].high[i];
      verticals->low[i] = low < verticals->low[i] ? low : verticals->low[i];
      high[i] = up > high[i] ? up : high[i];
    }
  }
  for (int i = 0; i < 2; i++) {
    verticals->bins[i] = (int32_t)ceil(sqrt((double)triangle_count)) + 1;
    verticals->per_bin[i] =
        high[i] > verticals->low[i] ? (float)verticals->bins[i] / (high[i] - verticals->low[i]) : 0.0f;
  }
  int64_t bins = (int64_t)verticals->bins[0] * verticals->bins[1], total = 0;
  CW_NEW(verticals->start, bins + 1);
  sort_triangles(verticals, triangle_count, 0);
  for (int64_t b = 0; b <= bins; b++) {
    total += verticals->start[b];
    verticals->start[b] = total;
  }
  CW_NEW_UNSET(verticals->member, total);
  sort_triangles(verticals, triangle_count, 1);
  *result = verticals;
  verticals = NULL;
done:
  cw_verticals_free(&verticals);
  return status;
}

void cw_verticals_free(CwVerticals **verticals) {
  if (!*verticals) return;
  free((*verticals)->box);
  free((*verticals)->start);
  free((*verticals)->member);
  free((*verticals)->z);
  free((*verticals)->chosen);
  free(*verticals);
  *verticals = NULL;
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
static int32_t choose_members(const CwVerticals *verticals, int64_t bin, float x, float y) {
  int32_t chosen = 0;
  for (int64_t k = verticals->start[bin]; k < verticals->start[bin + 1]; k++) {
    const Box *box = &verticals->box[verticals->member[k]];
    verticals->chosen[chosen] = verticals->member[k];
    chosen += (int32_t)(cw_branchless(box->low[0] <= x) & cw_branchless(box->high[0] >= x) &
                        cw_branchless(box->low[1] <= y) & cw_branchless(box->high[1] >= y));
  }
  return chosen;
}

static inline unsigned is_cut(const CwVerticals *verticals, int32_t t, double x, double y) {
  const int32_t *p = verticals->triangle[t];
  const double *a = verticals->x[p[0]], *b = verticals->x[p[1]], *c = verticals->x[p[2]];
  return edge_above(a, b, x, y) ^ edge_above(b, c, x, y) ^ edge_above(c, a, x, y);
}

static double height_of(const CwVerticals *verticals, int32_t t, double x, double y) {
  const int32_t *p = verticals->triangle[t];
  const double *a = verticals->x[p[0]], *b = verticals->x[p[1]], *c = verticals->x[p[2]];
  double n[3];
  cw_normal(a, b, c, n);
  double height = a[2] - (n[0] * (x - a[0]) + n[1] * (y - a[1])) / n[2];
  // An upright triangle is crossed somewhere on its height.
  double low = cw_lesser(cw_lesser(a[2], b[2]), c[2]), high = cw_greater(cw_greater(a[2], b[2]), c[2]);
  return height >= low && height <= high ? height : 0.5 * (low + high);
}

static int64_t bin_at(const CwVerticals *verticals, double x, double y) {
  return (int64_t)bin_of(verticals, 1, (float)y) * verticals->bins[0] + bin_of(verticals, 0, (float)x);
}

CwStatus cw_verticals_cut(CwVerticals *verticals, double x, double y, int32_t *count, const double **z) {
  CwStatus status = CW_OK;
  int64_t bin = bin_at(verticals, x, y), members = verticals->start[bin + 1] - verticals->start[bin];
  *count = 0;
  CW_GROW(verticals->z, verticals->z_capacity, members + 1);
  CW_GROW(verticals->chosen, verticals->chosen_capacity, members);
  int32_t chosen = choose_members(verticals, bin, (float)x, (float)y);
  for (int32_t k = 0; k < chosen; k++) {
    verticals->chosen[*count] = verticals->chosen[k];
    *count += (int32_t)is_cut(verticals, verticals->chosen[k], x, y);
  }
  for (int32_t k = 0; k < *count; k++) verticals->z[k] = height_of(verticals, verticals->chosen[k], x, y);
  *z = verticals->z;
done:
  return status;
}

int cw_verticals_inside(const CwVerticals *verticals, const double p[3]) {
  int64_t bin = bin_at(verticals, p[0], p[1]);
  int parity = 0;
  for (int64_t k = verticals->start[bin]; k < verticals->start[bin + 1]; k++) {
    int32_t t = verticals->member[k];
    if (is_cut(verticals, t, p[0], p[1])) parity ^= height_of(verticals, t, p[0], p[1]) > p[2];
  }
  return parity;
}
