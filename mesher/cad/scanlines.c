// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/scanlines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/order.h"

// Twice the area of (a, b, p) in the plane of y and z, with the same rounding for both directions of an edge,
// so that two triangles that share it agree on which of them p lies in.
static int left_of(const CwBackground *background, int32_t a, int32_t b, const double p[2], double *area) {
  int turned = a > b;
  const double *low = background->x[turned ? b : a], *high = background->x[turned ? a : b];
  double cross = (high[1] - low[1]) * (p[1] - low[2]) - (high[2] - low[2]) * (p[0] - low[1]);
  *area = turned ? -cross : cross;
  return turned ? !(cross >= 0) : cross >= 0;
}

// Whether line p along x meets triangle t, and at which x.
static int meets(const CwBackground *background, int32_t t, const double p[2], double *x) {
  const int32_t *n = background->triangle[t];
  double area[3];
  int left[3];
  for (int k = 0; k < 3; k++) left[k] = left_of(background, n[(k + 1) % 3], n[(k + 2) % 3], p, &area[k]);
  if (left[0] != left[1] || left[1] != left[2]) return 0;
  double sum = area[0] + area[1] + area[2];
  *x = 0;
  for (int k = 0; k < 3; k++) *x += (sum != 0 ? area[k] / sum : 1.0 / 3) * background->x[n[k]][0];
  return 1;
}

// M. Roberts' R2 sequence: multiples of 1/p and 1/p^2, p^3 = p + 1.
void cw_scanlines_place(const CwScanlines *lines, int32_t j, int32_t k, double place[2]) {
  static const double step[2] = {0.7548776662466927, 0.5698402909980532};
  const int32_t cell[2] = {j, k};
  double line = (double)j + (double)lines->count[0] * k + 0.37 + 0.61 * lines->variant;
  for (int d = 0; d < 2; d++) {
    double turn = line * step[d];
    place[d] = lines->low[d] + (cell[d] + (turn - floor(turn))) * lines->spacing;
  }
}

// Lines that may meet a triangle, and its box.
typedef struct {
  int32_t first[2], last[2];
  double low[2], high[2];
} LineRange;

static LineRange lines_over(const CwBackground *background, int32_t t, const CwScanlines *lines) {
  LineRange range;
  for (int d = 0; d < 2; d++) {
    double low = INFINITY, high = -INFINITY;
    for (int k = 0; k < 3; k++) {
      double x = background->x[background->triangle[t][k]][d + 1];
      low = x < low ? x : low;
      high = x > high ? x : high;
    }
    range.low[d] = low;
    range.high[d] = high;
    range.first[d] = (int32_t)fmax(floor((low - lines->low[d]) / lines->spacing) - 1, 0);
    range.last[d] = (int32_t)fmin(ceil((high - lines->low[d]) / lines->spacing), lines->count[d] - 1);
  }
  return range;
}

typedef struct {
  size_t line;
  double x;
} Crossing;

// All crossings, triangle by triangle.
static CwStatus find_crossings(const CwBackground *background, const CwScanlines *lines, Crossing **crossing,
                               size_t *count) {
  CwStatus status = CW_OK;
  double(*place)[2] = NULL;
  size_t capacity = 0;
  CW_NEW(place, (size_t)lines->count[0] * (size_t)lines->count[1]);
  for (int32_t k = 0; k < lines->count[1]; k++) {
    for (int32_t j = 0; j < lines->count[0]; j++)
      cw_scanlines_place(lines, j, k, place[(size_t)j + (size_t)lines->count[0] * (size_t)k]);
  }
  for (int32_t t = 0; t < background->triangle_count; t++) {
    LineRange range = lines_over(background, t, lines);
    for (int32_t k = range.first[1]; k <= range.last[1]; k++) {
      for (int32_t j = range.first[0]; j <= range.last[0]; j++) {
        size_t line = (size_t)j + (size_t)lines->count[0] * (size_t)k;
        const double *p = place[line];
        double x;
        if (p[0] < range.low[0] || p[0] > range.high[0] || p[1] < range.low[1] || p[1] > range.high[1] ||
            !meets(background, t, p, &x))
          continue;
        CW_GROW(*crossing, capacity, *count + 1);
        (*crossing)[(*count)++] = (Crossing){line, x};
      }
    }
  }
done:
  free(place);
  return status;
}

// Cuts with one variant of the lines; *odd counts the lines that go in and not out.
static CwStatus cut(const CwBackground *background, const double low[2], const double high[2], double spacing,
                    int32_t variant, CwScanlines *lines, int64_t *odd) {
  CwStatus status = CW_OK;
  Crossing *crossing = NULL;
  size_t crossings = 0;
  lines->spacing = spacing;
  lines->variant = variant;
  for (int d = 0; d < 2; d++) {
    lines->low[d] = low[d];
    lines->count[d] = (int32_t)ceil((high[d] - low[d]) / spacing);
  }
  size_t count = (size_t)lines->count[0] * (size_t)lines->count[1];
  CW_NEW(lines->start, count + 1);
  CW_TRY(find_crossings(background, lines, &crossing, &crossings));
  int64_t *end = lines->start; // where the lines end, until they are filled from behind
  for (size_t i = 0; i < crossings; i++) end[crossing[i].line]++;
  for (size_t i = 0; i < count; i++) end[i + 1] += end[i];
  CW_NEW(lines->crossing, crossings);
  for (size_t i = crossings; i-- > 0;) lines->crossing[--end[crossing[i].line]] = crossing[i].x;
  *odd = 0;
  for (size_t i = 0; i < count; i++) {
    int64_t length = lines->start[i + 1] - lines->start[i];
    qsort(lines->crossing + lines->start[i], (size_t)length, sizeof *lines->crossing, cw_order_doubles);
    *odd += length & 1;
  }
done:
  free(crossing);
  return status;
}

CwStatus cw_scanlines_make(const CwBackground *background, const double low[2], const double high[2], double spacing,
                           CwScanlines *lines) {
  CwStatus status = CW_OK;
  int64_t odd = 1;
  memset(lines, 0, sizeof *lines);
  // A line through a corner of the triangulation may be counted wrong by rounding: then other lines are
  // tried.
  for (int32_t variant = 0; variant < 4 && odd > 0; variant++) {
    cw_scanlines_free(lines);
    CW_TRY(cut(background, low, high, spacing, variant, lines, &odd));
  }
  CW_REQUIRE(odd == 0, CW_ERR_GEOMETRY, "%lld lines through the domain enter it and do not leave: it is not closed",
             (long long)odd);
done:
  if (status != CW_OK) cw_scanlines_free(lines);
  return status;
}

void cw_scanlines_free(CwScanlines *lines) {
  free(lines->start);
  free(lines->crossing);
  memset(lines, 0, sizeof *lines);
}
