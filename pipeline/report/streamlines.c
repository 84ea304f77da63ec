// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/streamlines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/status.h"

static const double NEAREST = 0.5; // of the distance between lines: a line ends there
static const double SHORTEST = 2;  // of that distance: shorter lines are left out
static const double OWN = 3;       // of that distance, along a line, until it may come near to itself no more
static const double STILL = 1e-4;  // of the greatest speed: water that stands

// What the lines so far leave free: pixels within some distance of them.
typedef struct {
  const CwPixelFlow *flow;
  double apart, still;
  uint8_t *near, *beside; // within NEAREST and within the whole of `apart`
  double (*way)[2];       // the line in the making: upstream from the middle, then downstream
  int behind, ahead, most;
} Work;

static int pixel_at(const CwPixelFlow *flow, const double x[2]) {
  const double i = floor(x[0]), j = floor(x[1]);
  if (!(i >= 0 && j >= 0 && i < flow->width && j < flow->height)) return -1;
  return (int)j * flow->width + (int)i;
}

// The direction of the flow between the middles of the pixels, of those of this group alone; 0 where it stands.
static int direction_at(const Work *work, const double x[2], int group, double direction[2]) {
  const CwPixelFlow *flow = work->flow;
  const double i = floor(x[0] - 0.5), j = floor(x[1] - 0.5), right = x[0] - 0.5 - i, down = x[1] - 0.5 - j;
  direction[0] = direction[1] = 0;
  double weights = 0;
  for (int k = 0; k < 4; k++) {
    const int pixel = pixel_at(flow, (const double[]){i + k % 2, j + k / 2}); // NOLINT(bugprone-integer-division)
    if (pixel < 0 || flow->group[pixel] != group) continue;
    const double weight = (k % 2 ? right : 1 - right) * (k / 2 ? down : 1 - down);
    weights += weight;
    for (int c = 0; c < 2; c++) direction[c] += weight * (double)flow->velocity[pixel][c];
  }
  const double speed = hypot(direction[0], direction[1]);
  if (!(speed > work->still * weights)) return 0;
  for (int c = 0; c < 2; c++) direction[c] /= speed;
  return 1;
}

// A step of one pixel with the flow (way 1) or against it (-1), by the midpoint rule; 0 where the line ends.
static int step(const Work *work, int group, int way, const double from[2], double to[2]) {
  double direction[2], middle[2];
  if (!direction_at(work, from, group, direction)) return 0;
  for (int c = 0; c < 2; c++) middle[c] = from[c] + 0.5 * way * direction[c];
  if (!direction_at(work, middle, group, direction)) return 0;
  for (int c = 0; c < 2; c++) to[c] = from[c] + way * direction[c];
  const int pixel = pixel_at(work->flow, to);
  return pixel >= 0 && work->flow->group[pixel] == group && !work->near[pixel];
}

// Point `number` of the line in the making: 0 in its middle, less upstream.
static double *way_point(const Work *work, int number) {
  return work->way[work->most + number];
}

// Whether point `number`, a new end, comes near to what the line has been through long before.
static int meets_itself(const Work *work, int number) {
  const double *end = way_point(work, number), near = NEAREST * work->apart;
  const int own = (int)(OWN * work->apart);
  for (int k = -work->behind; k <= work->ahead; k += 2) {
    const double *other = way_point(work, k);
    if (abs(k - number) > own && hypot(other[0] - end[0], other[1] - end[1]) < near) return 1;
  }
  return 0;
}

// The line through a point, to both sides.
static void trace(Work *work, const double start[2]) {
  const int group = work->flow->group[pixel_at(work->flow, start)];
  work->behind = work->ahead = 0;
  memcpy(way_point(work, 0), start, 2 * sizeof *start);
  for (int way = 1; way >= -1; way -= 2) {
    int *count = way > 0 ? &work->ahead : &work->behind;
    while (*count < work->most) {
      const int next = way * (*count + 1);
      if (!step(work, group, way, way_point(work, way * *count), way_point(work, next))) break;
      if (meets_itself(work, next)) break;
      ++*count;
    }
  }
}

static void mark(const Work *work, const double x[2], double radius, uint8_t *taken) {
  const CwPixelFlow *flow = work->flow;
  for (int j = (int)fmax(ceil(x[1] - radius - 0.5), 0); j < flow->height && j + 0.5 <= x[1] + radius; j++)
    for (int i = (int)fmax(ceil(x[0] - radius - 0.5), 0); i < flow->width && i + 0.5 <= x[0] + radius; i++)
      if (hypot(i + 0.5 - x[0], j + 0.5 - x[1]) <= radius) taken[j * flow->width + i] = 1;
}

// Adds the line through a point, where one may begin there and it is long enough.
static CwStatus add_line(Work *work, const double start[2], CwStreamlines *lines) {
  CwStatus status = CW_OK;
  const int pixel = pixel_at(work->flow, start);
  if (pixel < 0 || !work->flow->group[pixel] || work->beside[pixel]) return CW_OK;
  trace(work, start);
  const int points = work->behind + 1 + work->ahead;
  if (points < SHORTEST * work->apart) {
    work->beside[pixel] = 1; // not again
    return CW_OK;
  }
  CW_GROW(lines->end, lines->capacity, lines->count + 1);
  CW_GROW(lines->point, lines->point_capacity, lines->point_count + points);
  for (int k = -work->behind; k <= work->ahead; k++) {
    const double *x = way_point(work, k);
    memcpy(lines->point[lines->point_count++], x, 2 * sizeof *x);
    mark(work, x, NEAREST * work->apart, work->near);
    mark(work, x, work->apart, work->beside);
  }
  lines->end[lines->count++] = lines->point_count;
done:
  return status;
}

// Adds lines beside line `k`, on both sides of it.
static CwStatus add_beside(Work *work, int k, CwStreamlines *lines) {
  CwStatus status = CW_OK;
  const int first = k ? lines->end[k - 1] : 0, end = lines->end[k];
  const double far = work->apart + M_SQRT1_2; // so that the pixel's middle lies beside as well
  for (int i = first; i + 1 < end; i += (int)fmax(0.5 * work->apart, 1)) {
    for (int side = -1; side <= 1; side += 2) {
      const double *x = lines->point[i], *next = lines->point[i + 1];
      const double start[2] = {x[0] - side * far * (next[1] - x[1]), x[1] + side * far * (next[0] - x[0])};
      CW_TRY(add_line(work, start, lines));
    }
  }
done:
  return status;
}

CwStatus cw_streamlines_make(const CwPixelFlow *flow, double apart, CwStreamlines *lines) {
  CwStatus status = CW_OK;
  const size_t pixels = (size_t)flow->width * (size_t)flow->height;
  Work work = {.flow = flow, .apart = apart, .most = 2 * (flow->width + flow->height)};
  CW_NEW(work.near, pixels);
  CW_NEW(work.beside, pixels);
  CW_NEW(work.way, 2 * work.most + 1);
  for (size_t k = 0; k < pixels; k++)
    if (flow->group[k])
      work.still = fmax(work.still, STILL * hypot((double)flow->velocity[k][0], (double)flow->velocity[k][1]));
  const int stride = (int)fmax(0.5 * apart, 1);
  for (int j = 0, begun = 0; j < flow->height; j += stride) {
    for (int i = 0; i < flow->width; i += stride) { // where no line leads to
      CW_TRY(add_line(&work, (const double[]){i + 0.5, j + 0.5}, lines));
      for (; begun < lines->count; begun++) CW_TRY(add_beside(&work, begun, lines));
    }
  }
done:
  free(work.near);
  free(work.beside);
  free(work.way);
  return status;
}

void cw_streamlines_free(CwStreamlines *lines) {
  free(lines->point);
  free(lines->end);
  *lines = (CwStreamlines){0};
}
