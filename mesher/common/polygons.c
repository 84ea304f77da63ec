// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/polygons.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"

// Half-edges: 2e runs along edge e, 2e + 1 against it.
typedef struct {
  int32_t point_count, edge_count;
  const double (*point)[2];
  const int32_t (*edge)[2];
  int32_t *start, *out; // half-edges that leave each point, counter-clockwise
  int32_t *next;        // of each half-edge round the face on its left
} Graph;

static int32_t origin(const Graph *graph, int32_t half) {
  return graph->edge[half / 2][half & 1];
}

static int32_t target(const Graph *graph, int32_t half) {
  return graph->edge[half / 2][!(half & 1)];
}

static double heading(const Graph *graph, int32_t half) {
  const double *a = graph->point[origin(graph, half)], *b = graph->point[target(graph, half)];
  return atan2(b[1] - a[1], b[0] - a[0]);
}

static CwStatus link_half_edges(Graph *graph) {
  CwStatus status = CW_OK;
  int32_t halves = 2 * graph->edge_count;
  int32_t *place = NULL;
  CW_NEW(graph->start, graph->point_count + 1);
  CW_NEW(graph->out, halves);
  CW_NEW(graph->next, halves);
  for (int32_t h = 0; h < halves; h++) graph->start[origin(graph, h) + 1]++;
  for (int32_t i = 0; i < graph->point_count; i++) graph->start[i + 1] += graph->start[i];
  CW_NEW(place, graph->point_count);
  for (int32_t h = 0; h < halves; h++) {
    int32_t from = origin(graph, h), base = graph->start[from], k = place[from]++;
    double angle = heading(graph, h);
    while (k > 0 && heading(graph, graph->out[base + k - 1]) > angle) {
      graph->out[base + k] = graph->out[base + k - 1];
      k--;
    }
    graph->out[base + k] = h;
  }
  // Round a face with the face on the left: at the target, turn to the half-edge clockwise next to the way back.
  for (int32_t i = 0; i < graph->point_count; i++) {
    int32_t degree = graph->start[i + 1] - graph->start[i];
    for (int32_t k = 0; k < degree; k++) {
      int32_t leaving = graph->out[graph->start[i] + k];
      graph->next[leaving ^ 1] = graph->out[graph->start[i] + (k + degree - 1) % degree];
    }
  }
done:
  free(place);
  return status;
}

// Whether the ray from `at` to the right crosses the edge from a to b.
static int crosses(const double a[2], const double b[2], const double at[2]) {
  if ((a[1] > at[1]) == (b[1] > at[1])) return 0;
  return a[0] + (at[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]) > at[0];
}

// In the domain: within an odd number of boundary edges.
static int in_domain(const Graph *graph, const uint8_t *boundary, const double at[2]) {
  int inside = 0;
  for (int32_t e = 0; e < graph->edge_count; e++) {
    inside ^= boundary[e] && crosses(graph->point[graph->edge[e][0]], graph->point[graph->edge[e][1]], at);
  }
  return inside;
}

static double loop_area(const double (*point)[2], const int32_t *corner, int32_t count) {
  double twice = 0;
  for (int32_t i = 0; i < count; i++) {
    const double *a = point[corner[i]], *b = point[corner[(i + 1) % count]];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

// A point just left of the middle of the loop's longest edge: inside the face that the loop bounds.
static void point_left_of_loop(const double (*point)[2], const int32_t *corner, int32_t count, double at[2]) {
  int32_t longest = 0;
  double length = -1;
  for (int32_t i = 0; i < count; i++) {
    const double *a = point[corner[i]], *b = point[corner[(i + 1) % count]];
    double l = hypot(b[0] - a[0], b[1] - a[1]);
    if (l > length) length = l, longest = i;
  }
  const double *a = point[corner[longest]], *b = point[corner[(longest + 1) % count]];
  at[0] = (a[0] + b[0]) / 2 - 1e-6 * (b[1] - a[1]);
  at[1] = (a[1] + b[1]) / 2 + 1e-6 * (b[0] - a[0]);
}

static int in_loop(const double (*point)[2], const int32_t *corner, int32_t count, const double at[2]) {
  int inside = 0;
  for (int32_t i = 0; i < count; i++) inside ^= crosses(point[corner[i]], point[corner[(i + 1) % count]], at);
  return inside;
}

void cw_polygons_free(CwPolygons *polygons) {
  free(polygons->polygon_start);
  free(polygons->loop_start);
  free(polygons->corner);
  memset(polygons, 0, sizeof *polygons);
}

// All simple loops: the walks round the faces.
typedef struct {
  int32_t count;
  int32_t *start, *corner; // corners of loop l: corner[start[l]] .. corner[start[l + 1] - 1]
  double *area;            // counter-clockwise above 0
  int32_t *outer;          // the loop whose polygon it bounds: itself, or that round it; -1: none
} Loops;

static void loops_free(Loops *loops) {
  free(loops->start);
  free(loops->corner);
  free(loops->area);
  free(loops->outer);
}

static CwStatus check_closed(const Graph *graph, const uint8_t *boundary) {
  CwStatus status = CW_OK;
  uint8_t *odd_degree = NULL;
  CW_NEW(odd_degree, graph->point_count);
  for (int32_t e = 0; e < graph->edge_count; e++) {
    for (int k = 0; k < 2 && boundary[e]; k++) odd_degree[graph->edge[e][k]] ^= 1;
  }
  for (int32_t i = 0; i < graph->point_count; i++) {
    CW_REQUIRE(!odd_degree[i], CW_ERR_MESH,
               "the outline of an interface is open at (%.4f, %.4f) mm of its plane; every loop must close",
               cw_mm(graph->point[i][0]), cw_mm(graph->point[i][1]));
  }
done:
  free(odd_degree);
  return status;
}

// Walks every half-edge once.
static CwStatus find_loops(Graph *graph, Loops *loops) {
  CwStatus status = CW_OK;
  int32_t halves = 2 * graph->edge_count, filled = 0;
  uint8_t *seen = NULL;
  CW_TRY(link_half_edges(graph));
  CW_NEW(seen, halves);
  CW_NEW(loops->start, halves + 1);
  CW_NEW(loops->corner, halves);
  CW_NEW(loops->area, halves);
  for (int32_t first = 0; first < halves; first++) {
    if (seen[first]) continue;
    int32_t start = filled;
    for (int32_t h = first; !seen[h]; h = graph->next[h]) {
      seen[h] = 1;
      loops->corner[filled++] = origin(graph, h);
    }
    loops->area[loops->count++] = loop_area(graph->point, loops->corner + start, filled - start);
    loops->start[loops->count] = filled;
  }
done:
  free(seen);
  return status;
}

// Minimal polygons: the counter-clockwise loops whose inside is in the domain. Each clockwise loop is the outline of a
// connected piece of the graph; where it lies in a polygon it is a hole of the smallest one around it. Sets `outer`;
// *count: polygons.
static CwStatus find_outer_loops(const Graph *graph, const uint8_t *boundary, Loops *loops, int32_t *count) {
  CwStatus status = CW_OK;
  const double *area = loops->area;
  double(*at)[2] = NULL; // just left of each loop
  uint8_t *inside = NULL;
  CW_NEW(at, loops->count);
  CW_NEW(inside, loops->count);
  CW_NEW(loops->outer, loops->count);
  *count = 0;
  for (int32_t l = 0; l < loops->count; l++) {
    point_left_of_loop(graph->point, loops->corner + loops->start[l], loops->start[l + 1] - loops->start[l], at[l]);
    inside[l] = in_domain(graph, boundary, at[l]);
    loops->outer[l] = area[l] > 0 && inside[l] ? l : -1;
    *count += loops->outer[l] == l;
  }
  for (int32_t l = 0; l < loops->count; l++) {
    if (area[l] > 0 || !inside[l]) continue; // outside, a clockwise one is the outline of the whole, or of a solid
    double least = INFINITY;
    for (int32_t m = 0; m < loops->count; m++) {
      if (loops->outer[m] != m || area[m] >= least || area[m] <= -area[l]) continue;
      if (!in_loop(graph->point, loops->corner + loops->start[m], loops->start[m + 1] - loops->start[m], at[l]))
        continue;
      least = area[m];
      loops->outer[l] = m;
    }
  }
done:
  free(at);
  free(inside);
  return status;
}

static CwStatus gather(const Loops *loops, int32_t count, CwPolygons *polygons) {
  CwStatus status = CW_OK;
  int32_t used = 0;
  CW_NEW(polygons->polygon_start, count + 1);
  CW_NEW(polygons->loop_start, loops->count + 1);
  CW_NEW(polygons->corner, loops->start[loops->count]);
  for (int32_t outer = 0; outer < loops->count; outer++) {
    if (loops->outer[outer] != outer) continue;
    polygons->polygon_start[polygons->polygon_count++] = polygons->loop_count;
    for (int pass = 0; pass < 2; pass++) { // the outer loop first, then its holes
      for (int32_t l = 0; l < loops->count; l++) {
        if (loops->outer[l] != outer || (l == outer) != (pass == 0)) continue;
        int32_t size = loops->start[l + 1] - loops->start[l];
        polygons->loop_start[polygons->loop_count++] = used;
        memcpy(polygons->corner + used, loops->corner + loops->start[l], (size_t)size * sizeof *loops->corner);
        used += size;
      }
    }
  }
  polygons->polygon_start[polygons->polygon_count] = polygons->loop_count;
  polygons->loop_start[polygons->loop_count] = used;
done:
  return status;
}

CwStatus cw_polygons_find(int32_t point_count, const double (*point)[2], int32_t edge_count, const int32_t (*edge)[2],
                          const uint8_t *boundary, CwPolygons *polygons) {
  CwStatus status = CW_OK;
  Graph graph = {point_count, edge_count, point, edge, NULL, NULL, NULL};
  Loops loops = {0};
  int32_t count = 0;
  memset(polygons, 0, sizeof *polygons);
  CW_TRY(check_closed(&graph, boundary));
  CW_TRY(find_loops(&graph, &loops));
  CW_TRY(find_outer_loops(&graph, boundary, &loops, &count));
  CW_TRY(gather(&loops, count, polygons));
done:
  if (status != CW_OK) cw_polygons_free(polygons);
  free(graph.start);
  free(graph.out);
  free(graph.next);
  loops_free(&loops);
  return status;
}

typedef struct {
  double low, high; // along the longer side of all points
  int32_t edge;
} Span;

static int by_low(const void *p, const void *q) {
  const Span *a = p, *b = q;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  return (a->edge > b->edge) - (a->edge < b->edge);
}

static int cross(const double (*point)[2], const int32_t e[2], const int32_t f[2]) {
  if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return 0;
  const double *a = point[e[0]], *b = point[e[1]], *c = point[f[0]], *d = point[f[1]];
  return cw_twice_area(a, b, c) * cw_twice_area(a, b, d) < 0 && cw_twice_area(c, d, a) * cw_twice_area(c, d, b) < 0;
}

CwStatus cw_polygons_crossings(int32_t point_count, const double (*point)[2], int32_t edge_count,
                               const int32_t (*edge)[2], int32_t *crossing_count, int32_t (**crossing)[4]) {
  CwStatus status = CW_OK;
  Span *span = NULL;
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  int32_t capacity = 16;
  *crossing_count = 0;
  CW_NEW(*crossing, capacity);
  CW_NEW(span, edge_count);
  for (int32_t i = 0; i < point_count; i++) {
    for (int k = 0; k < 2; k++) low[k] = fmin(low[k], point[i][k]), high[k] = fmax(high[k], point[i][k]);
  }
  int along = high[1] - low[1] > high[0] - low[0];
  for (int32_t e = 0; e < edge_count; e++) {
    double a = point[edge[e][0]][along], b = point[edge[e][1]][along];
    span[e] = (Span){fmin(a, b), fmax(a, b), e};
  }
  qsort(span, (size_t)edge_count, sizeof *span, by_low);
  for (int32_t i = 0; i < edge_count; i++) {
    for (int32_t j = i + 1; j < edge_count && span[j].low <= span[i].high; j++) {
      const int32_t *e = edge[span[i].edge], *f = edge[span[j].edge];
      if (!cross(point, e, f)) continue;
      CW_GROW(*crossing, capacity, *crossing_count + 1);
      memcpy((*crossing)[(*crossing_count)++], (int32_t[4]){e[0], e[1], f[0], f[1]}, sizeof **crossing);
    }
  }
done:
  free(span);
  return status;
}
