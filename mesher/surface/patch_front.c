// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_front.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/policy.h"

// Edges of the front: triangle t, not done, lies to the left of a -> b; on the right is a given edge or a
// done triangle. They wait in queues by the sum of the rows of a and b, given points being row 0, so that a
// row is whole before the next one starts: out of order, slanted sides of a half-made row would start fronts
// of their own.
typedef struct {
  int32_t t, a, b;
  int32_t next; // in the same queue; -1: the last
} Entry;

typedef struct {
  Entry *entry;
  int32_t count, capacity;
  int32_t (*queue)[2]; // first and last entry; first -1: empty
  int32_t queue_count, queue_capacity, current;
  int32_t *row; // of each point
  int32_t row_capacity;
} Front;

static CwStatus push(Front *front, int32_t t, int32_t a, int32_t b) {
  CwStatus status = CW_OK;
  int32_t rows = front->row[a] + front->row[b], n = front->count;
  CW_GROW(front->queue, front->queue_capacity, rows + 1);
  for (; front->queue_count <= rows; front->queue_count++) front->queue[front->queue_count][0] = -1;
  CW_GROW(front->entry, front->capacity, n + 1);
  front->entry[n] = (Entry){t, a, b, -1};
  front->count++;
  int32_t *queue = front->queue[rows];
  if (queue[0] < 0)
    queue[0] = n;
  else
    front->entry[queue[1]].next = n;
  queue[1] = n;
  if (rows < front->current) front->current = rows;
done:
  return status;
}

// The next edge; 0 when none is left.
static int pop(Front *front, Entry *entry) {
  while (front->current < front->queue_count && front->queue[front->current][0] < 0) front->current++;
  if (front->current == front->queue_count) return 0;
  int32_t *queue = front->queue[front->current];
  *entry = front->entry[queue[0]];
  queue[0] = entry->next;
  return 1;
}

static CwStatus set_row(Front *front, int32_t p, int32_t row) {
  CwStatus status = CW_OK;
  CW_GROW(front->row, front->row_capacity, p + 1);
  front->row[p] = row;
done:
  return status;
}

typedef struct {
  double length;  // of edge a b
  double apex[2]; // c, from the middle of a b: along it, and square to it
  double centre;  // of the circle, square to the edge
  double radius2;
  double along[2]; // per unit length on the surface, in (u,v)
  double square[2];
} Shape;

// The triangle in the mean metric of its corners, seen from its edge i. Returns 0 where the metric is
// degenerate.
static int shape_of(const CwPatchWork *work, int32_t t, int i, Shape *shape) {
  const int32_t *corner = work->corner[t];
  int32_t c = corner[i], a = corner[(i + 1) % 3], b = corner[(i + 2) % 3];
  double m[3];
  for (int k = 0; k < 3; k++) m[k] = (work->metric[a][k] + work->metric[b][k] + work->metric[c][k]) / 3;
  double det = m[0] * m[2] - m[1] * m[1];
  if (!(det > 1e-12 * m[0] * m[2])) return 0;
  double root = sqrt(det), e[2], f[2];
  for (int k = 0; k < 2; k++) {
    e[k] = work->uv[b][k] - work->uv[a][k];
    f[k] = work->uv[c][k] - work->uv[a][k];
  }
  double length = sqrt(m[0] * e[0] * e[0] + 2 * m[1] * e[0] * e[1] + m[2] * e[1] * e[1]);
  double dot = m[0] * e[0] * f[0] + m[1] * (e[0] * f[1] + e[1] * f[0]) + m[2] * e[1] * f[1];
  shape->length = length;
  shape->along[0] = e[0] / length;
  shape->along[1] = e[1] / length;
  shape->square[0] = -(m[1] * e[0] + m[2] * e[1]) / (root * length);
  shape->square[1] = (m[0] * e[0] + m[1] * e[1]) / (root * length);
  double x = dot / length, y = root * (e[0] * f[1] - e[1] * f[0]) / length;
  shape->apex[0] = x - 0.5 * length;
  shape->apex[1] = y;
  if (!(y > 1e-12 * length)) return 0;
  shape->centre = (x * x + y * y - length * x) / (2 * y);
  shape->radius2 = shape->centre * shape->centre + 0.25 * length * length;
  return 1;
}

static double mean_size(const CwPatchWork *work, int32_t t) {
  const int32_t *c = work->corner[t];
  return (work->size[c[0]] + work->size[c[1]] + work->size[c[2]]) / 3;
}

static int is_done(const CwPatchWork *work, int32_t t) {
  Shape shape;
  if (!shape_of(work, t, 0, &shape)) return 1;
  double limit = cw_policy.front_done_radius * mean_size(work, t);
  return shape.radius2 <= limit * limit;
}

// Puts the edges of t that belong to the front into it, and those of its neighbours when t itself is done.
static CwStatus push_edges(const CwPatchWork *work, Front *front, int32_t t) {
  CwStatus status = CW_OK;
  int done = is_done(work, t);
  for (int i = 0; i < 3; i++) {
    int32_t a = work->corner[t][(i + 1) % 3], b = work->corner[t][(i + 2) % 3], n = work->neighbour[t][i];
    int given = work->given[t] >> i & 1;
    if (!done && (given || is_done(work, n))) CW_TRY(push(front, t, a, b));
    if (done && !given && !is_done(work, n)) CW_TRY(push(front, n, b, a));
  }
done:
  return status;
}

// Where the next point on edge i of t belongs; 0 where there is no room for one.
static int place_point(const CwPatchWork *work, int32_t t, int i, double uv[2]) {
  Shape shape;
  if (!shape_of(work, t, i, &shape) || shape.centre <= 0) return 0;
  int32_t a = work->corner[t][(i + 1) % 3], b = work->corner[t][(i + 2) % 3];
  double size = 0.5 * (work->size[a] + work->size[b]);
  double half = 0.5 * shape.length, q = shape.centre;
  // Rebay's height grows when the edge shrinks, which amplifies rounding errors 1.7 times a row until the
  // rows break up; a height that does not depend on the length of the edge damps them.
  double height = fmax(0.5 * sqrt(3) * size, half);
  // Not far past the centre of the circle, which is where the room is. In a row of equilateral triangles the
  // height is the centre's: a limit without slack would let errors in again.
  height = fmin(height, 1.2 * fmax(q, half * half / q));
  double middle[2], x[3], foot[3];
  for (int k = 0; k < 2; k++) {
    middle[k] = 0.5 * (work->uv[a][k] + work->uv[b][k]);
    uv[k] = middle[k] + height * shape.square[k];
  }
  // The metric may change over the triangle: measure once, and step again. The surface is not asked outside.
  if (cw_patch_find(work, uv, t) < 0) return 0;
  work->input->surface(work->input->surface_context, uv, x, NULL, NULL);
  for (int k = 0; k < 3; k++) foot[k] = 0.5 * (work->x[a][k] + work->x[b][k]);
  double reached = sqrt(cw_patch_distance2(x, foot)), ratio = reached > 0 ? height / reached : 1;
  ratio = fmin(fmax(ratio, 0.5), 2);
  if (fabs(ratio - 1) > 0.05)
    for (int k = 0; k < 2; k++) uv[k] = middle[k] + ratio * height * shape.square[k];
  return 1;
}

static double size_cap(const CwPatchWork *work, int32_t t) {
  double cap = INFINITY;
  for (int i = 0; i < 3; i++) cap = fmin(cap, work->size[work->corner[t][i]]);
  return cap;
}

CwStatus cw_patch_front(CwPatchWork *work) {
  CwStatus status = CW_OK;
  Front front = {0};
  Entry entry;
  double uv[2];
  int inserted;
  for (int32_t p = 0; p < work->point_count; p++) CW_TRY(set_row(&front, p, 0));
  for (int32_t t = 0; t < work->triangle_count; t++) CW_TRY(push_edges(work, &front, t));
  while (pop(&front, &entry)) {
    int32_t t = entry.t, a = entry.a, b = entry.b;
    int i = 0;
    // The triangle may have changed since.
    while (i < 3 && !(work->corner[t][(i + 1) % 3] == a && work->corner[t][(i + 2) % 3] == b)) i++;
    if (i == 3 || is_done(work, t) || !place_point(work, t, i, uv)) continue;
    double cap = fmin(work->size[a], work->size[b]);
    cap += cw_policy.slope * cap;
    CW_TRY(cw_patch_insert(work, uv, t, cw_policy.least_distance, cap, &inserted));
    if (!inserted) continue;
    CW_TRY(set_row(&front, work->point_count - 1, 1 + (front.row[a] > front.row[b] ? front.row[a] : front.row[b])));
    for (int32_t k = 0; k < work->border_count; k++) CW_TRY(push_edges(work, &front, work->fresh[k]));
  }
  // What the fronts left open between them: the centres of circles.
  for (int32_t t = 0; t < work->triangle_count; t++) {
    Shape shape;
    if (is_done(work, t) || !shape_of(work, t, 0, &shape)) continue;
    int32_t a = work->corner[t][1], b = work->corner[t][2];
    for (int k = 0; k < 2; k++) uv[k] = 0.5 * (work->uv[a][k] + work->uv[b][k]) + shape.centre * shape.square[k];
    CW_TRY(cw_patch_insert(work, uv, t, cw_policy.least_distance, size_cap(work, t) * (1 + 2 * cw_policy.slope),
                           &inserted));
  }
done:
  free(front.entry);
  free(front.queue);
  free(front.row);
  return status;
}
