// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/render.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

CwStatus cw_render_start(int width, int height, uint32_t background, int depth_buffer, CwCanvas *canvas) {
  CwStatus status = CW_OK;
  *canvas = (CwCanvas){.width = width,
                       .height = height,
                       .columns = width * CW_RENDER_SAMPLES,
                       .rows = height * CW_RENDER_SAMPLES,
                       .background = background};
  canvas->top = canvas->rows;
  size_t samples = (size_t)canvas->columns * (size_t)canvas->rows;
  CW_NEW(canvas->colour, samples);
  CW_NEW(canvas->group, samples);
  if (depth_buffer) CW_NEW(canvas->depth, samples);
done:
  if (status != CW_OK) cw_render_free(canvas);
  return status;
}

CwStatus cw_render_keep_velocity(CwCanvas *canvas) {
  CwStatus status = CW_OK;
  CW_NEW(canvas->velocity, (size_t)canvas->width * (size_t)canvas->height);
done:
  return status;
}

void cw_render_free(CwCanvas *canvas) {
  free(canvas->velocity);
  free(canvas->colour);
  free(canvas->depth);
  free(canvas->group);
  *canvas = (CwCanvas){0};
}

static uint32_t mix(uint32_t a, uint32_t b, double share) {
  uint32_t mixed = 0;
  for (int shift = 0; shift < 24; shift += 8) {
    double from = (a >> shift) & 255, to = (b >> shift) & 255;
    mixed |= (uint32_t)(from + (to - from) * share + 0.5) << shift;
  }
  return mixed;
}

uint32_t cw_render_shade(uint32_t colour, double factor) {
  uint32_t shaded = 0;
  for (int shift = 0; shift < 24; shift += 8) {
    double value = ((colour >> shift) & 255) * factor + 0.5;
    shaded |= (uint32_t)fmin(fmax(value, 0), 255) << shift;
  }
  return shaded;
}

enum { POLYGON_MOST = 16 };

static void touch(CwCanvas *canvas, int up, int down) {
  if (up > down) return;
  if (up < canvas->top) canvas->top = up;
  if (down >= canvas->bottom) canvas->bottom = down + 1;
}

// The velocity of the pixel of a sample: of the first of its samples; NULL of others.
static float *velocity_at(const CwCanvas *canvas, size_t place) {
  if (!canvas->velocity) return NULL;
  const size_t columns = (size_t)canvas->columns, i = place % columns, j = place / columns;
  if (i % CW_RENDER_SAMPLES || j % CW_RENDER_SAMPLES) return NULL;
  return canvas->velocity[j / CW_RENDER_SAMPLES * (size_t)canvas->width + i / CW_RENDER_SAMPLES];
}

// Paints one sample; `line` is how far it lies within a line, 1 and more: wholly.
static void put(CwCanvas *canvas, size_t place, double line, const CwPaint *paint) {
  line = fmin(fmax(line, 0), 1) * paint->edge_strength;
  canvas->colour[place] = line > 0 ? mix(paint->colour, paint->edge_colour, line) : paint->colour;
  canvas->group[place] = paint->group;
  float *velocity = velocity_at(canvas, place);
  if (velocity) memcpy(velocity, paint->velocity, sizeof paint->velocity);
}

typedef struct {
  int first, last, up, down; // columns and rows, all within
} Samples;

// The samples of the canvas within the box of a polygon; false where there are none, or a corner is not finite.
static int samples_within(const CwCanvas *canvas, const double (*p)[3], int count, Samples *box) {
  double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
  for (int k = 0; k < count; k++) {
    const double x = p[k][0] * CW_RENDER_SAMPLES, y = p[k][1] * CW_RENDER_SAMPLES;
    if (!isfinite(x) || !isfinite(y)) return 0;
    left = x < left ? x : left;
    right = x > right ? x : right;
    top = y < top ? y : top;
    bottom = y > bottom ? y : bottom;
  }
  if (!(right >= 0 && bottom >= 0 && left <= canvas->columns && top <= canvas->rows)) return 0;
  // Sample (i, j) has its centre at (i + 0.5, j + 0.5).
  *box = (Samples){(int)fmax(ceil(left - 0.5), 0), (int)fmin(floor(right - 0.5), canvas->columns - 1),
                   (int)fmax(ceil(top - 0.5), 0), (int)fmin(floor(bottom - 0.5), canvas->rows - 1)};
  return box->first <= box->last && box->up <= box->down;
}

int cw_render_meets(const CwCanvas *canvas, const double (*p)[3], int count) {
  Samples box;
  return samples_within(canvas, p, count, &box);
}

void cw_render_triangle(CwCanvas *canvas, const double p[3][3], const CwPaint *paint) {
  double x[3], y[3];
  Samples box;
  if (!samples_within(canvas, p, 3, &box)) return;
  const int first = box.first, last = box.last, up = box.up, down = box.down;
  for (int k = 0; k < 3; k++) {
    x[k] = p[k][0] * CW_RENDER_SAMPLES;
    y[k] = p[k][1] * CW_RENDER_SAMPLES;
  }
  double area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return;
  touch(canvas, up, down);
  // weight[k] is 1 at corner k and 0 on the edge k+1, k+2 opposite to it; reach[k] is the height over that
  // edge.
  double gx[3], gy[3], at[3], reach[3];
  for (int k = 0; k < 3; k++) {
    int a = (k + 1) % 3, b = (k + 2) % 3;
    double dx = x[b] - x[a], dy = y[b] - y[a];
    gx[k] = -dy / area;
    gy[k] = dx / area;
    at[k] = (dx * (up + 0.5 - y[a]) - dy * (first + 0.5 - x[a])) / area;
    reach[k] = paint->edge_strength > 0 ? fabs(area) / fmax(hypot(dx, dy), 1e-30) : 0;
  }
  double half = 0.5 * paint->edge_width * CW_RENDER_SAMPLES;
  for (int j = up; j <= down; j++) {
    double w[3];
    for (int k = 0; k < 3; k++) w[k] = at[k] + gy[k] * (j - up);
    size_t place = (size_t)j * (size_t)canvas->columns + (size_t)first;
    for (int i = first; i <= last; i++, place++, w[0] += gx[0], w[1] += gx[1], w[2] += gx[2]) {
      if (w[0] < -1e-9 || w[1] < -1e-9 || w[2] < -1e-9) continue;
      if (canvas->depth) {
        float depth = (float)(w[0] * p[0][2] + w[1] * p[1][2] + w[2] * p[2][2]);
        if (canvas->group[place] && depth < canvas->depth[place]) continue;
        canvas->depth[place] = depth;
      }
      double line = 0;
      for (int k = 0; k < 3; k++) {
        if (paint->edges & (1u << ((k + 1) % 3))) line = fmax(line, half + 0.5 - w[k] * reach[k]);
      }
      put(canvas, place, line, paint);
    }
  }
}

// Without depth: each sample by its distances from all edges, so that an edge has its line however short its
// neighbours are. Corners that coincide have no edge between them.
static void flat_polygon(CwCanvas *canvas, const double (*p)[3], int count, const CwPaint *paint) {
  double x[POLYGON_MOST], y[POLYGON_MOST], nx[POLYGON_MOST], ny[POLYGON_MOST], area = 0;
  int edges = 0;
  Samples box;
  if (!samples_within(canvas, p, count, &box)) return;
  for (int k = 0; k < count; k++) {
    const double *a = p[k], *b = p[(k + 1) % count];
    area += (a[0] - p[0][0]) * (b[1] - p[0][1]) - (b[0] - p[0][0]) * (a[1] - p[0][1]);
  }
  for (int k = 0; k < count; k++) {
    const double *a = p[k], *b = p[(k + 1) % count];
    double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy) * (area < 0 ? -1 : 1);
    if (fabs(length) < 1e-4) continue;
    x[edges] = a[0] * CW_RENDER_SAMPLES;
    y[edges] = a[1] * CW_RENDER_SAMPLES;
    nx[edges] = -dy / length;
    ny[edges++] = dx / length;
  }
  if (area == 0) return;
  touch(canvas, box.up, box.down);
  double half = 0.5 * paint->edge_width * CW_RENDER_SAMPLES;
  for (int j = box.up; j <= box.down; j++) {
    for (int i = box.first; i <= box.last; i++) {
      double nearest = INFINITY;
      for (int k = 0; k < edges && nearest >= -1e-6; k++)
        nearest = fmin(nearest, nx[k] * (i + 0.5 - x[k]) + ny[k] * (j + 0.5 - y[k]));
      if (nearest >= -1e-6) put(canvas, (size_t)j * (size_t)canvas->columns + (size_t)i, half + 0.5 - nearest, paint);
    }
  }
}

void cw_render_polygon(CwCanvas *canvas, const double (*p)[3], int count, const CwPaint *paint) {
  CwPaint part = *paint;
  if (!canvas->depth && count <= POLYGON_MOST) {
    flat_polygon(canvas, p, count, paint);
    return;
  }
  for (int k = 1; k + 1 < count; k++) {
    double corner[3][3];
    memcpy(corner[0], p[0], sizeof corner[0]);
    memcpy(corner[1], p[k], sizeof corner[1]);
    memcpy(corner[2], p[k + 1], sizeof corner[2]);
    part.edges = 2u | (k == 1 ? 1u : 0u) | (k + 2 == count ? 4u : 0u);
    cw_render_triangle(canvas, corner, &part);
  }
}

void cw_render_merge(CwCanvas *canvas, const CwCanvas *other, int later) {
  const size_t columns = (size_t)canvas->columns;
  touch(canvas, other->top, other->bottom - 1);
  for (size_t i = (size_t)other->top * columns; i < (size_t)other->bottom * columns; i++) {
    if (!other->group[i]) continue;
    if (canvas->group[i]) {
      double nearer = canvas->depth ? other->depth[i] - canvas->depth[i] : 0;
      if (nearer < 0 || (nearer == 0 && !later)) continue;
    }
    canvas->group[i] = other->group[i];
    canvas->colour[i] = other->colour[i];
    if (canvas->depth) canvas->depth[i] = other->depth[i];
    float *velocity = velocity_at(canvas, i);
    if (velocity) memcpy(velocity, velocity_at(other, i), sizeof other->velocity[0]);
  }
}

// Where nothing is drawn, the depth is -INFINITY from here on.
static void clear_depth(CwCanvas *canvas) {
  size_t samples = (size_t)canvas->columns * (size_t)canvas->rows;
  for (size_t i = 0; canvas->depth && i < samples; i++)
    if (!canvas->group[i]) canvas->depth[i] = -INFINITY;
}

// A step in depth is a bend of the depth along a line of samples, so that slanted faces have none.
static int steps(const float *depth, size_t place, size_t stride, double step) {
  double before = depth[place - stride], here = depth[place], behind = depth[place + stride];
  if (isinf(here)) return 0;
  if (isinf(before) || isinf(behind)) return 1;
  return 2 * here - before - behind > step;
}

void cw_render_outline(CwCanvas *canvas, uint32_t colour, double step) {
  size_t columns = (size_t)canvas->columns, rows = (size_t)canvas->rows;
  clear_depth(canvas);
  for (size_t j = 1; j + 1 < rows; j++) {
    for (size_t i = 1; i + 1 < columns; i++) {
      size_t place = j * columns + i;
      uint16_t group = canvas->group[place];
      int border = group && (group != canvas->group[place + 1] || group != canvas->group[place + columns] ||
                             group != canvas->group[place - 1] || group != canvas->group[place - columns]);
      if (canvas->depth && !border)
        border = steps(canvas->depth, place, 1, step) || steps(canvas->depth, place, columns, step);
      if (border) canvas->colour[place] = mix(canvas->colour[place], colour, 0.75);
    }
  }
}

// Pairs of opposite samples round a pixel, on rings.
enum { DIRECTIONS = 12, RINGS = 5, PAIRS = RINGS * DIRECTIONS };

typedef struct {
  long du, dv;   // from the pixel to one of the two, in samples
  double length; // px
  double weight;
} Pair;

static void place_pairs(double radius, Pair pairs[PAIRS]) {
  static const double turn[RINGS] = {0, 0.4, 0.8, 0.2, 0.6};
  for (int ring = 0; ring < RINGS; ring++) {
    double share = (ring + 1.0) / RINGS, length = radius * share;
    for (int k = 0; k < DIRECTIONS; k++) {
      double angle = M_PI * (k + turn[ring]) / DIRECTIONS;
      pairs[ring * DIRECTIONS + k] = (Pair){.du = lround(length * CW_RENDER_SAMPLES * cos(angle)),
                                            .dv = lround(length * CW_RENDER_SAMPLES * sin(angle)),
                                            .length = length,
                                            .weight = 1.2 - share};
    }
  }
}

// Share of the surroundings of sample (i, j) that stands over it, 0 to 1.
static double hollow(const CwCanvas *canvas, long i, long j, const Pair pairs[PAIRS], double unit) {
  double here = canvas->depth[j * canvas->columns + i], sum = 0, weights = 0;
  for (int k = 0; k < PAIRS; k++) {
    long du = pairs[k].du, dv = pairs[k].dv;
    weights += pairs[k].weight;
    if (i < labs(du) || j < labs(dv) || i + labs(du) >= canvas->columns || j + labs(dv) >= canvas->rows) continue;
    double there = canvas->depth[(j + dv) * canvas->columns + i + du];
    double across = canvas->depth[(j - dv) * canvas->columns + i - du];
    if (isinf(there) || isinf(across)) continue;
    // The mean of two opposite samples: a slanted plane has no hollow. What stands far above is another thing.
    double rise = (0.5 * (there + across) - here) / (unit * pairs[k].length);
    if (rise > 0) sum += pairs[k].weight * fmin(rise, 1) / (1 + pow(rise / 4, 2));
  }
  return sum / weights;
}

void cw_render_occlusion(CwCanvas *canvas, double radius, double unit) {
  Pair pairs[PAIRS];
  if (!canvas->depth) return;
  clear_depth(canvas);
  place_pairs(radius, pairs);
  for (long j = 0; j < canvas->height; j++) {
    for (long i = 0; i < canvas->width; i++) {
      // One value a pixel, at the nearest of its samples that shows something.
      for (int s = 0; s < CW_RENDER_SAMPLES * CW_RENDER_SAMPLES; s++) {
        long u = i * CW_RENDER_SAMPLES + s % CW_RENDER_SAMPLES, v = j * CW_RENDER_SAMPLES + s / CW_RENDER_SAMPLES;
        if (isinf(canvas->depth[v * canvas->columns + u])) continue;
        double factor = 1 - 0.8 * hollow(canvas, u, v, pairs, unit);
        for (int t = s; t < CW_RENDER_SAMPLES * CW_RENDER_SAMPLES; t++) {
          size_t place = (size_t)(j * CW_RENDER_SAMPLES + t / CW_RENDER_SAMPLES) * (size_t)canvas->columns +
                         (size_t)(i * CW_RENDER_SAMPLES + t % CW_RENDER_SAMPLES);
          if (!isinf(canvas->depth[place])) canvas->colour[place] = cw_render_shade(canvas->colour[place], factor);
        }
        break;
      }
    }
  }
}

void cw_render_erase(CwCanvas *canvas, uint16_t group) {
  size_t samples = (size_t)canvas->columns * (size_t)canvas->rows;
  for (size_t i = 0; i < samples; i++)
    if (canvas->group[i] == group) canvas->group[i] = 0;
}

// How deep a sample lies in its group by the one `step` beside it, if there is one.
static int depth_by(const CwCanvas *canvas, const int *depth, long place, int there, long step) {
  return 1 + (there && canvas->group[place + step] == canvas->group[place] ? depth[place + step] : 0);
}

CwStatus cw_render_middles(const CwCanvas *canvas, int count, CwGroupMiddle *middle) {
  CwStatus status = CW_OK;
  const long columns = canvas->columns, samples = columns * canvas->rows;
  int *depth = NULL; // samples to the nearest of another group, in two passes (A. Rosenfeld and J. L. Pfaltz, 1966)
  CW_NEW_UNSET(depth, samples);
  for (long i = 0; i < samples; i++) {
    const int left = depth_by(canvas, depth, i, i % columns > 0, -1);
    const int up = depth_by(canvas, depth, i, i >= columns, -columns);
    depth[i] = left < up ? left : up;
  }
  for (long i = samples - 1; i >= 0; i--) {
    const int right = depth_by(canvas, depth, i, (i + 1) % columns > 0, 1);
    const int down = depth_by(canvas, depth, i, i + columns < samples, columns), group = canvas->group[i];
    if (right < depth[i]) depth[i] = right;
    if (down < depth[i]) depth[i] = down;
    if (group < 1 || group > count || depth[i] <= CW_RENDER_SAMPLES * middle[group - 1].depth) continue;
    middle[group - 1] =
        (CwGroupMiddle){((double)(i % columns) + 0.5) / CW_RENDER_SAMPLES,
                        ((double)(i / columns) + 0.5) / CW_RENDER_SAMPLES, (double)depth[i] / CW_RENDER_SAMPLES};
  }
done:
  free(depth);
  return status;
}

double cw_render_round_length(double limit) {
  double power = pow(10, floor(log10(limit)));
  double factor = limit / power * (1 + 1e-12);
  return power * (factor >= 5 ? 5 : factor >= 2 ? 2 : 1);
}
