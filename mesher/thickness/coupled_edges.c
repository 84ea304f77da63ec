// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/coupled_edges.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/boundary_curves.h"
#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "pipeline/order.h"

enum { LENGTH_STEPS = 400 };

// A place on the edge, as shares of its length in the sense of side 0, for either side.
typedef struct {
  double s[2];
  int own[2]; // a corner of that side's network: its place is fixed
} Break;

typedef struct {
  const CwBoundaryInput *in[2];
  CwOpenEdges *edges[2];
  int32_t edge[2];
  int reversed; // side 1 runs the other way
} Pair;

static int on_patch(const CwCad *cad, int32_t edge, const char *patch) {
  int face[2];
  cw_cad_edge_faces(cad, edge, face);
  int first = !strcmp(cw_cad_patch_name(cad, cw_cad_face_patch(cad, face[0])), patch);
  int second = !strcmp(cw_cad_patch_name(cad, cw_cad_face_patch(cad, face[1])), patch);
  return first != second;
}

static double parameter_at(const Pair *pair, int side, double s) {
  double range[2];
  cw_cad_edge_range(pair->in[side]->cad, pair->edge[side], range);
  if (side && pair->reversed) s = 1 - s;
  return range[0] + s * (range[1] - range[0]);
}

static void point_at(const Pair *pair, int side, double s, double x[3]) {
  cw_cad_edge_point(pair->in[side]->cad, pair->edge[side], parameter_at(pair, side, s), x, NULL);
}

// Whether the two edges are one curve, in the sense that pair->reversed says.
static int same_edge(const Pair *pair, double near) {
  for (int i = 0; i <= 4; i++) {
    double x[3], y[3];
    point_at(pair, 0, i / 4.0, x);
    point_at(pair, 1, i / 4.0, y);
    if (cw_distance(x, y) > near) return 0;
  }
  return 1;
}

static double size_at(const void *context, double s) {
  const Pair *pair = context;
  double x[3], size = INFINITY;
  point_at(pair, 0, s, x);
  for (int side = 0; side < 2; side++) {
    size = fmin(size, pair->in[side]->size_at(pair->in[side]->size, x));
  }
  return size;
}

static CwStatus find_breaks(const Pair *pair, double length, int *count, Break **breaks) {
  CwStatus status = CW_OK;
  int capacity = 2;
  for (int side = 0; side < 2; side++) capacity += pair->in[side]->network->corner_count;
  CW_NEW(*breaks, capacity);
  (*breaks)[(*count)++] = (Break){{0, 0}, {1, 1}};
  for (int side = 0; side < 2; side++) {
    const CwNetwork *network = pair->in[side]->network;
    double range[2];
    cw_cad_edge_range(pair->in[side]->cad, pair->edge[side], range);
    for (int32_t i = 0; i < network->corner_count; i++) {
      if (network->corner[i].edge != pair->edge[side]) continue;
      double s = (network->corner[i].t - range[0]) / (range[1] - range[0]);
      if (side && pair->reversed) s = 1 - s;
      Break *made = &(*breaks)[(*count)++];
      *made = (Break){{s, s}, {0, 0}};
      made->own[side] = 1;
    }
  }
  (*breaks)[(*count)++] = (Break){{1, 1}, {1, 1}};
  qsort(*breaks + 1, (size_t)*count - 2, sizeof **breaks, cw_order_doubles);
  // Where a plane of either domain crosses nearly at one place, each side keeps its own and leaves out the other.
  int kept = 1;
  for (int i = 1; i < *count; i++) {
    Break *last = &(*breaks)[kept - 1];
    const Break *here = &(*breaks)[i];
    int apart = (here->s[0] - last->s[0]) * length > cw_policy.size_least_share * size_at(pair, here->s[0]);
    int clash = (here->own[0] && last->own[0]) || (here->own[1] && last->own[1]);
    if (apart || (clash && i + 1 < *count && kept > 1)) {
      (*breaks)[kept++] = *here;
      continue;
    }
    for (int side = 0; side < 2; side++) {
      if (here->own[side] && !last->own[side]) last->s[side] = here->s[side], last->own[side] = 1;
    }
    if (i + 1 == *count) (*breaks)[kept++] = *here;
  }
  *count = kept;
done:
  return status;
}

typedef struct {
  int32_t count, capacity;
  double *s;
} Places;

// Divides between two breaks; appends the places within.
static CwStatus divide(const Pair *pair, double length, double from, double to, Places *places) {
  CwStatus status = CW_OK;
  double *place = NULL;
  int32_t made;
  CW_TRY(cw_divide_by_size(size_at, pair, from, to, (to - from) * length, 1, &made, &place));
  CW_GROW(places->s, places->capacity, places->count + made);
  for (int32_t k = 1; k + 1 < made; k++) places->s[places->count++] = place[k];
done:
  free(place);
  return status;
}

static CwStatus add_open_edge(const Pair *pair, int side, const Places *places, int break_count, const Break *breaks) {
  CwStatus status = CW_OK;
  CwOpenEdges *edges = pair->edges[side];
  CW_GROW(edges->edge, edges->capacity, edges->count + 1);
  CwDividedEdge *open_edge = &edges->edge[edges->count++];
  *open_edge = (CwDividedEdge){.edge = pair->edge[side]};
  CW_NEW(open_edge->t, places->count + break_count);
  for (int i = 0; i < places->count; i++) open_edge->t[open_edge->count++] = parameter_at(pair, side, places->s[i]);
  for (int i = 1; i + 1 < break_count; i++) {
    // The side's own breaks are corners of its network, which its curves begin and end at.
    if (!breaks[i].own[side]) open_edge->t[open_edge->count++] = parameter_at(pair, side, breaks[i].s[side]);
  }
  qsort(open_edge->t, (size_t)open_edge->count, sizeof *open_edge->t, cw_order_doubles);
done:
  return status;
}

static CwStatus couple_edge(const Pair *pair) {
  CwStatus status = CW_OK;
  Break *breaks = NULL;
  Places places = {0};
  double length = 0, x[2][3];
  int break_count = 0;
  point_at(pair, 0, 0, x[0]);
  for (int i = 1; i <= LENGTH_STEPS; i++) {
    point_at(pair, 0, (double)i / LENGTH_STEPS, x[i % 2]);
    length += cw_distance(x[0], x[1]);
  }
  CW_TRY(find_breaks(pair, length, &break_count, &breaks));
  for (int i = 0; i + 1 < break_count; i++) CW_TRY(divide(pair, length, breaks[i].s[0], breaks[i + 1].s[0], &places));
  for (int side = 0; side < 2; side++) CW_TRY(add_open_edge(pair, side, &places, break_count, breaks));
done:
  free(breaks);
  free(places.s);
  return status;
}

CwStatus cw_couple_open_edges(const CwBoundaryInput *a, const char *patch_a, CwOpenEdges *edges_a,
                              const CwBoundaryInput *b, const char *patch_b, CwOpenEdges *edges_b) {
  CwStatus status = CW_OK;
  const double near = cw_cad_tolerance(a->cad) + cw_cad_tolerance(b->cad);
  for (int32_t e = 0; e < cw_cad_edge_count(a->cad); e++) {
    if (!on_patch(a->cad, e, patch_a)) continue;
    for (int32_t f = 0; f < cw_cad_edge_count(b->cad); f++) {
      Pair pair = {{a, b}, {edges_a, edges_b}, {e, f}, 0};
      if (!on_patch(b->cad, f, patch_b)) continue;
      if (!same_edge(&pair, near)) pair.reversed = 1;
      if (same_edge(&pair, near)) CW_TRY(couple_edge(&pair));
    }
  }
done:
  return status;
}
