// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/inside.h"

#include <math.h>
#include <stdlib.h>

struct CwInside {
  const CwBackground *background;
  double low[2], cell; // corner and edge length of the columns, m
  int32_t columns[2];
  int32_t *start, *item; // triangles of each column
};

static int32_t column_of(const CwInside *inside, int axis, double value) {
  double place = floor((value - inside->low[axis]) / inside->cell);
  if (place < 0) return 0;
  if (place > inside->columns[axis] - 1) return inside->columns[axis] - 1;
  return (int32_t)place;
}

// The columns under the bounding rectangle of triangle t.
static void column_range(const CwInside *inside, int32_t t, int32_t low[2], int32_t high[2]) {
  const CwBackground *background = inside->background;
  for (int axis = 0; axis < 2; axis++) {
    double least = INFINITY, greatest = -INFINITY;
    for (int k = 0; k < 3; k++) {
      double value = background->x[background->triangle[t][k]][axis];
      least = fmin(least, value);
      greatest = fmax(greatest, value);
    }
    low[axis] = column_of(inside, axis, least);
    high[axis] = column_of(inside, axis, greatest);
  }
}

CwStatus cw_inside_make(const CwBackground *background, CwInside **result) {
  CwStatus status = CW_OK;
  CwInside *inside;
  CW_NEW(inside, 1);
  inside->background = background;
  double high[2] = {-INFINITY, -INFINITY};
  inside->low[0] = inside->low[1] = INFINITY;
  for (int32_t i = 0; i < background->point_count; i++) {
    for (int axis = 0; axis < 2; axis++) {
      inside->low[axis] = fmin(inside->low[axis], background->x[i][axis]);
      high[axis] = fmax(high[axis], background->x[i][axis]);
    }
  }
  double widest = fmax(high[0] - inside->low[0], high[1] - inside->low[1]);
  inside->cell = fmax(widest / 256, 1e-12);
  for (int axis = 0; axis < 2; axis++) {
    inside->columns[axis] = (int32_t)ceil((high[axis] - inside->low[axis]) / inside->cell) + 1;
  }
  size_t columns = (size_t)inside->columns[0] * (size_t)inside->columns[1];
  CW_NEW(inside->start, columns + 1);
  // Counting sort in two passes: sizes first, then places.
  for (int pass = 0; pass < 2; pass++) {
    for (int32_t t = 0; t < background->triangle_count; t++) {
      int32_t low[2], top[2];
      column_range(inside, t, low, top);
      for (int32_t j = low[1]; j <= top[1]; j++) {
        for (int32_t i = low[0]; i <= top[0]; i++) {
          size_t column = (size_t)j * (size_t)inside->columns[0] + (size_t)i;
          if (pass == 0) {
            inside->start[column + 1]++;
          } else {
            inside->item[inside->start[column]++] = t;
          }
        }
      }
    }
    if (pass == 0) {
      for (size_t c = 0; c < columns; c++) inside->start[c + 1] += inside->start[c];
      CW_NEW(inside->item, inside->start[columns]);
    } else {
      for (size_t c = columns; c > 0; c--) inside->start[c] = inside->start[c - 1];
      inside->start[0] = 0;
    }
  }
  *result = inside;
  inside = NULL;
done:
  cw_inside_free(&inside);
  return status;
}

void cw_inside_free(CwInside **inside) {
  if (!*inside) return;
  free((*inside)->start);
  free((*inside)->item);
  free(*inside);
  *inside = NULL;
}

// Sign of the area of (a, b, p) seen from above, reckoned from the lower-numbered end of the edge, so that the two
// triangles at an edge always agree on which side p lies; a point on the edge counts as left of a -> b for a < b.
static int left_of(const CwBackground *background, int32_t a, int32_t b, const double p[3]) {
  int swapped = a > b;
  const double *first = background->x[swapped ? b : a], *second = background->x[swapped ? a : b];
  double area = (second[0] - first[0]) * (p[1] - first[1]) - (second[1] - first[1]) * (p[0] - first[0]);
  int left = area >= 0;
  return swapped ? !left : left;
}

int cw_inside(const CwInside *inside, const double x[3]) {
  const CwBackground *background = inside->background;
  int32_t i = column_of(inside, 0, x[0]), j = column_of(inside, 1, x[1]);
  size_t column = (size_t)j * (size_t)inside->columns[0] + (size_t)i;
  int crossings = 0;
  for (int32_t k = inside->start[column]; k < inside->start[column + 1]; k++) {
    const int32_t *corner = background->triangle[inside->item[k]];
    int side = left_of(background, corner[0], corner[1], x);
    if (left_of(background, corner[1], corner[2], x) != side || left_of(background, corner[2], corner[0], x) != side) {
      continue;
    }
    const double *a = background->x[corner[0]], *b = background->x[corner[1]], *c = background->x[corner[2]];
    double u[3], v[3], n[3];
    for (int m = 0; m < 3; m++) u[m] = b[m] - a[m], v[m] = c[m] - a[m];
    for (int m = 0; m < 3; m++) n[m] = u[(m + 1) % 3] * v[(m + 2) % 3] - u[(m + 2) % 3] * v[(m + 1) % 3];
    if (n[2] == 0) continue;
    double z = a[2] - (n[0] * (x[0] - a[0]) + n[1] * (x[1] - a[1])) / n[2];
    crossings += z > x[2];
  }
  return crossings & 1;
}
