// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/inside.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/box.h"
#include "mesher/common/vec.h"

struct CwInside {
  const double (*x)[3];
  const int32_t (*triangle)[3];
  double low[2], cell[2];
  int32_t cells[2];
  int64_t *start;  // of each bin in the plane z = 0; bins + 1
  int32_t *member; // triangles whose box meets the bin
};

static int32_t bin_of(const CwInside *inside, int axis, double value) {
  double place = (value - inside->low[axis]) / inside->cell[axis];
  return place < 0.0 ? 0 : place >= inside->cells[axis] ? inside->cells[axis] - 1 : (int32_t)place;
}

static void bins_of(const CwInside *inside, int32_t t, int32_t from[2], int32_t to[2]) {
  const int32_t *p = inside->triangle[t];
  for (int i = 0; i < 2; i++) {
    double a = inside->x[p[0]][i], b = inside->x[p[1]][i], c = inside->x[p[2]][i];
    from[i] = bin_of(inside, i, cw_lesser(cw_lesser(a, b), c));
    to[i] = bin_of(inside, i, cw_greater(cw_greater(a, b), c));
  }
}

CwStatus cw_inside_make(int32_t point_count, const double (*x)[3], int32_t triangle_count, const int32_t (*triangle)[3],
                        CwInside **result) {
  CwStatus status = CW_OK;
  CwInside *inside = NULL;
  CW_NEW(inside, 1);
  inside->x = x;
  inside->triangle = triangle;
  int32_t side = (int32_t)ceil(sqrt(0.5 * triangle_count)) + 1;
  CwBox box = cw_box_of_points(point_count, x);
  for (int i = 0; i < 2; i++) {
    inside->low[i] = point_count ? box.low[i] : 0.0;
    inside->cells[i] = side;
    inside->cell[i] = box.high[i] > box.low[i] ? (box.high[i] - box.low[i]) / side : 1.0;
  }
  CW_NEW(inside->start, (int64_t)side * side + 1);
  for (int pass = 0; pass < 2; pass++) {
    for (int32_t t = triangle_count - 1; t >= 0; t--) {
      int32_t from[2], to[2];
      bins_of(inside, t, from, to);
      for (int32_t j = from[1]; j <= to[1]; j++) {
        for (int32_t i = from[0]; i <= to[0]; i++) {
          int64_t *at = &inside->start[(int64_t)j * side + i];
          if (pass == 0)
            ++*at;
          else
            inside->member[--*at] = t;
        }
      }
    }
    if (pass == 1) break;
    int64_t total = 0;
    for (int64_t b = 0; b <= (int64_t)side * side; b++) { // ends of the bins, filled from behind
      total += inside->start[b];
      inside->start[b] = total;
    }
    CW_NEW(inside->member, total);
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
  free((*inside)->member);
  free(*inside);
  *inside = NULL;
}

// The edge from a to b crosses the line through p along y, at a y above p's: half-open in x, and always
// computed from the left end, so that the two triangles at an edge agree to the bit.
static int edge_above(const double a[3], const double b[3], const double p[3]) {
  if ((a[0] <= p[0]) == (b[0] <= p[0])) return 0;
  const double *left = a[0] <= p[0] ? a : b, *right = left == a ? b : a;
  double y = left[1] + (right[1] - left[1]) * ((p[0] - left[0]) / (right[0] - left[0]));
  return y > p[1];
}

int cw_inside_test(const CwInside *inside, const double p[3]) {
  for (int i = 0; i < 2; i++) {
    double place = p[i] - inside->low[i];
    if (place < 0.0 || place > inside->cell[i] * inside->cells[i]) return 0;
  }
  int64_t bin = (int64_t)bin_of(inside, 1, p[1]) * inside->cells[0] + bin_of(inside, 0, p[0]);
  int parity = 0;
  for (int64_t k = inside->start[bin]; k < inside->start[bin + 1]; k++) {
    const int32_t *t = inside->triangle[inside->member[k]];
    const double *a = inside->x[t[0]], *b = inside->x[t[1]], *c = inside->x[t[2]];
    if (!(edge_above(a, b, p) ^ edge_above(b, c, p) ^ edge_above(c, a, p))) continue;
    // Over the triangle: z of its plane at p.
    double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2], vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    double nz = ux * vy - uy * vx, nx = uy * vz - uz * vy, ny = uz * vx - ux * vz;
    double above = nx * (p[0] - a[0]) + ny * (p[1] - a[1]) + nz * (p[2] - a[2]); // > 0: p on the side of the normal
    if (nz > 0.0 ? above < 0.0 : above > 0.0) parity ^= 1;
  }
  return parity;
}
