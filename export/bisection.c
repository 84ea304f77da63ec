// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/bisection.h"

#include <math.h>

typedef struct {
  const double (*points)[3];
  const int64_t *sizes;
  int32_t *order, *group;
} Bisection;

static int longest_axis(const Bisection *b, int64_t begin, int64_t end) {
  double least[3] = {INFINITY, INFINITY, INFINITY}, most[3] = {-INFINITY, -INFINITY, -INFINITY};
  int axis = 0;
  for (int64_t i = begin; i < end; ++i)
    for (int k = 0; k < 3; ++k) {
      least[k] = fmin(least[k], b->points[b->order[i]][k]);
      most[k] = fmax(most[k], b->points[b->order[i]][k]);
    }
  for (int k = 1; k < 3; ++k)
    if (most[k] - least[k] > most[axis] - least[axis]) axis = k;
  return axis;
}

static int before(const Bisection *b, int axis, int32_t x, int32_t y) {
  const double difference = b->points[x][axis] - b->points[y][axis];
  return difference != 0 ? difference < 0 : x < y;
}

// Brings the points that are first along the axis to the places before `middle` (quickselect: C. A. R. Hoare, 1961).
static void split(const Bisection *b, int axis, int64_t begin, int64_t middle, int64_t end) {
  int32_t *order = b->order;
  while (end - begin > 1) {
    const int32_t pivot = order[begin + (end - begin) / 2];
    int64_t low = begin, high = end - 1;
    while (low <= high) {
      while (before(b, axis, order[low], pivot)) ++low;
      while (before(b, axis, pivot, order[high])) --high;
      if (low > high) break;
      const int32_t kept = order[low];
      order[low++] = order[high];
      order[high--] = kept;
    }
    if (middle <= high)
      end = high + 1;
    else if (middle > low)
      begin = low;
    else
      return;
  }
}

static void bisect(const Bisection *b, int64_t begin, int64_t end, int first, int last) {
  if (last - first == 1) {
    for (int64_t i = begin; i < end; ++i) b->group[b->order[i]] = first;
    return;
  }
  const int half = first + (last - first) / 2;
  int64_t middle = begin;
  for (int g = first; g < half; ++g) middle += b->sizes[g];
  split(b, longest_axis(b, begin, end), begin, middle, end);
  bisect(b, begin, middle, first, half);
  bisect(b, middle, end, half, last);
}

void cw_bisection(const double (*points)[3], int32_t count, const int64_t *sizes, int groups, int32_t *order,
                  int32_t *group) {
  const Bisection b = {points, sizes, order, group};
  for (int32_t i = 0; i < count; ++i) order[i] = i;
  bisect(&b, 0, count, 0, groups);
}
