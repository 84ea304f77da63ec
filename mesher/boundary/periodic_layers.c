// SPDX-License-Identifier: AGPL-3.0-or-later
// Layers over the first of each image set of a symmetric wall, and their copies: all ranks grow and check them
// together, and each turns them for itself.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/boundary/periodic_boundary.h"
#include "mesher/boundary/wall_part.h"
#include "mesher/common/box_tree.h"
#include "mesher/common/incident.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/layers/layers.h"
#include "mesher/layers/layers_crossing.h"
#include "mesher/layers/layers_turn.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/parallel/profiler.h"
#include "mesher/policy.h"
#include "pipeline/log.h"

enum { ROUNDS = 20, SWEEPS = 2 }; // of thinning; over the seams, to choose their columns
static const double REACH = 4;    // thicknesses: how far the layers feel one another through gaps and gradation
static const double SAME = 1e-9;  // of the model's unit: layer tops that differ less are the same

// The part of the wall that the first ones and what stands near them make up.
typedef struct {
  const CwPeriodicImages *images;
  const CwSurfaceMesh *surface;
  uint8_t *is_first; // of each point of the whole: on a face that is the first of its image set
  CwWallPart wall;
} Part;

static void part_free(Part *part) {
  free(part->is_first);
  cw_wall_part_free(&part->wall);
}

// A point, and whether one of the first ones was met within reach of it.
typedef struct {
  const double (*x)[3], *p;
  const int32_t *vertex; // of each item of the tree
  double reach;
  int met;
} Near;

static CwBox box_of(const void *context, int32_t item) {
  const Near *near = context;
  return cw_box_of_point(near->x[near->vertex[item]]);
}

static int meet(void *context, int32_t item) {
  Near *near = context;
  near->met = cw_distance(near->x[near->vertex[item]], near->p) < near->reach;
  return near->met;
}

typedef struct {
  const CwBoxTree *tree; // of the first ones
  Near near;
  const uint8_t *is_first;
} Reach;

static CwStatus find_near(void *context, int32_t v, void *out) {
  const Reach *reach = context;
  Near near = reach->near;
  near.p = near.x[v];
  near.met = reach->is_first[v];
  if (!near.met) cw_box_tree_near(reach->tree, near.p, &near.reach, meet, &near);
  *(uint8_t *)out = (uint8_t)near.met;
  return CW_OK;
}

// Marks the points within reach of the first ones. Collective.
static CwStatus mark_near(const CwSurfaceMesh *surface, const CwLayerInput *whole, uint8_t *is_first, uint8_t *near) {
  CwStatus status = CW_OK;
  CwBoxTree tree = {0};
  CwBox within = cw_box_empty();
  int32_t *vertex = NULL, firsts = 0;
  double longest = 0, thickest = 0;
  for (int32_t t = 0; t < whole->triangle_count; t++) {
    const int32_t *corner = whole->triangle[t];
    if (surface->source[t] != t) continue;
    for (int k = 0; k < 3; k++) {
      is_first[corner[k]] = 1;
      longest = fmax(longest, cw_distance(whole->x[corner[k]], whole->x[corner[(k + 1) % 3]]));
      thickest = fmax(thickest, whole->target[corner[k]]);
    }
  }
  CW_NEW_UNSET(vertex, whole->point_count);
  for (int32_t v = 0; v < whole->point_count; v++) {
    if (!is_first[v]) continue;
    cw_box_add_point(&within, whole->x[v]);
    vertex[firsts++] = v;
  }
  Reach reach = {&tree, {.x = whole->x, .vertex = vertex, .reach = REACH * thickest + longest}, is_first};
  CW_TRY(cw_box_tree_make(whole->context, firsts, &within, box_of, &reach.near, &tree));
  CW_TRY(cw_parallel_for(whole->context, "layers: reach", whole->point_count, sizeof *near, find_near, &reach, near));
done:
  cw_box_tree_free(&tree);
  free(vertex);
  return status;
}

static CwStatus part_make(const CwPeriodicImages *images, const CwSurfaceMesh *surface, const CwLayerInput *whole,
                          Part *part) {
  CwStatus status = CW_OK;
  uint8_t *near = NULL;
  part->images = images;
  part->surface = surface;
  CW_NEW(near, whole->point_count);
  CW_NEW(part->is_first, whole->point_count);
  CW_TRY(mark_near(surface, whole, part->is_first, near));
  CW_TRY(cw_wall_part_make(whole, near, &part->wall));
done:
  free(near);
  return status;
}

int32_t cw_image_first_member(const CwNodeImages *nodes, const uint8_t *is_first, int32_t v) {
  int32_t first = -1;
  for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) {
    if (is_first[at] && (first < 0 || at < first)) first = at;
  }
  return first;
}

// Gives all members of the image set of v the thickness of the column of `from`, and its end, which lies at `end` for
// v.
static void turn_from(const Part *part, const CwLayers *made, int32_t from, int32_t v, const double end[3],
                      CwLayers *layers) {
  const CwPeriodicImages *images = part->images;
  const CwNodeImages *nodes = &part->surface->images;
  for (int32_t at = v, turns = 0; at >= 0; at = cw_image_after(nodes, at, v), turns++) {
    cw_image_point(images, turns, end, layers->top[at]);
    layers->thickness[at] = made->thickness[part->wall.local[from]];
    layers->reason[at] = made->reason[part->wall.local[from]];
  }
}

// Takes the columns of the first ones from the part and turns them for the copies. Of two members of an image set that
// both are on first faces (on a seam) that with the smaller number counts, until one is chosen.
static CwStatus spread(const Part *part, const CwLayers *made, CwLayers *layers) {
  CwStatus status = CW_OK;
  const CwNodeImages *nodes = &part->surface->images;
  uint8_t *placed = NULL;
  CW_NEW(placed, part->wall.whole->point_count);
  for (int32_t v = 0; v < part->wall.whole->point_count; v++) {
    if (!part->is_first[v] || placed[v]) continue;
    turn_from(part, made, v, v, made->top[part->wall.local[v]], layers);
    for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) placed[at] = 1;
  }
done:
  free(placed);
  return status;
}

// How sound the prisms around the members of the image set of v are, which all get the column that ends at `end` for v.
static double place_image(const Part *part, const CwLayerWork *work, int32_t v, const double end[3], double (*top)[3]) {
  const CwPeriodicImages *images = part->images;
  const CwNodeImages *nodes = &part->surface->images;
  double least = INFINITY;
  for (int around = 0; around < 2; around++) { // all are placed before prisms are looked at
    for (int32_t at = v, turns = 0; at >= 0; at = cw_image_after(nodes, at, v), turns++) {
      int32_t local = part->wall.local[at], first = 0;
      if (!around && local >= 0) cw_image_point(images, turns, end, top[local]);
      if (around && part->is_first[at])
        least = fmin(least, cw_layers_around(work, local, (const double(*)[3])top, -INFINITY, &first));
    }
  }
  return least;
}

// On a seam repair may have turned or thinned one member of an image set and not the others. Gives all of them the
// column with which the prisms around them are soundest.
static CwStatus choose(const Part *part, const CwLayers *made, CwLayers *layers) {
  CwStatus status = CW_OK;
  const CwPeriodicImages *images = part->images;
  const CwNodeImages *nodes = &part->surface->images;
  int32_t count = images->symmetry->count;
  CwIncident incident = {0};
  double(*top)[3] = NULL;
  CW_TRY(cw_incident_make(part->wall.in.point_count, part->wall.in.triangle_count, part->wall.in.triangle, &incident));
  CwLayerWork work = {
      .in = &part->wall.in, .n = part->wall.in.point_count, .face_start = incident.start, .face = incident.triangle};
  CW_NEW_UNSET(top, part->wall.in.point_count);
  for (int32_t i = 0; i < part->wall.in.point_count; i++)
    memcpy(top[i], layers->top[part->wall.global[i]], sizeof *top);
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    for (int32_t v = 0; v < part->wall.whole->point_count; v++) {
      if (!part->is_first[v] || cw_image_first_member(nodes, part->is_first, v) != v) continue;
      const double *own = made->top[part->wall.local[v]];
      double best = -INFINITY, kept[3], end[3];
      int32_t from = v, turns = 1;
      memcpy(kept, layers->top[v], sizeof kept);
      for (int32_t at = cw_image_after(nodes, v, v); at >= 0; at = cw_image_after(nodes, at, v), turns++) {
        if (!part->is_first[at]) continue;
        cw_image_point(images, count - turns, made->top[part->wall.local[at]], end);
        if (cw_distance(end, own) < SAME) continue;
        if (best == -INFINITY) best = place_image(part, &work, v, kept, top);
        for (int k = 0; k < 2; k++) {
          const double *tried = k ? end : own;
          if (cw_distance(tried, kept) < SAME) continue;
          double quality = place_image(part, &work, v, tried, top);
          if (quality <= best) continue;
          best = quality;
          from = k ? at : v;
          memcpy(kept, tried, sizeof kept);
        }
      }
      if (best == -INFINITY) continue;
      place_image(part, &work, v, kept, top);
      if (cw_distance(kept, layers->top[v]) >= SAME) turn_from(part, made, from, v, kept, layers);
    }
  }
done:
  cw_incident_free(&incident);
  free(top);
  return status;
}

static void mark(const Part *part, int32_t triangle, uint8_t *bad) {
  for (int k = 0; k < 3; k++) bad[part->wall.global[part->wall.in.triangle[triangle][k]]] = 1;
}

// The part with the columns as they were spread.
typedef struct {
  const Part *part;
  CwLayerWork work;
  double (*top)[3];
  double *off;    // of each point: how far from where it was made, m
  uint8_t *moved; // more than rounding
} Spread;

// Of a triangle with a first point, how far its columns are off; whether it is no sound prism any more.
typedef struct {
  double off;
  int32_t bad;
} Checked;

static CwStatus check_triangle(void *context, int32_t f, void *out) {
  const Spread *spread = context;
  const int32_t *corner = spread->part->wall.in.triangle[f];
  Checked *made = out;
  int beside = 0, changed = 0;
  for (int k = 0; k < 3; k++) {
    beside |= spread->part->is_first[spread->part->wall.global[corner[k]]];
    changed |= spread->moved[corner[k]];
  }
  for (int k = 0; k < 3 && beside; k++) made->off = fmax(made->off, spread->off[corner[k]]);
  const double(*top)[3] = (const double(*)[3])spread->top;
  made->bad = changed && !(cw_layers_prism_quality(&spread->work, f, top) >= cw_policy.sound_quality);
  return CW_OK;
}

// Checks what the columns as they were spread have changed in the part; marks the points whose columns do not fit. What
// has not moved was checked as it was made. Collective.
static CwStatus check(const Part *part, const CwLayers *made, const CwLayers *layers, uint8_t *bad,
                      int32_t *bad_count) {
  CwStatus status = CW_OK;
  const CwLayerInput *in = &part->wall.in;
  Spread spread = {.part = part, .work = {.in = in, .n = in->point_count}};
  CwLayerCrossing crossing = {0};
  Checked *checked = NULL;
  double most = 0;
  *bad_count = 0;
  memset(bad, 0, (size_t)part->wall.whole->point_count);
  CW_NEW_UNSET(spread.top, in->point_count);
  CW_NEW_UNSET(spread.off, in->point_count);
  CW_NEW_UNSET(spread.moved, in->point_count);
  CW_NEW_UNSET(checked, in->triangle_count);
  for (int32_t i = 0; i < in->point_count; i++) {
    memcpy(spread.top[i], layers->top[part->wall.global[i]], sizeof *spread.top);
    spread.off[i] = cw_distance(spread.top[i], made->top[i]);
    spread.moved[i] = spread.off[i] >= SAME;
  }
  CW_TRY(cw_parallel_for(in->context, "layers: copies", in->triangle_count, sizeof *checked, check_triangle, &spread,
                         checked));
  for (int32_t f = 0; f < in->triangle_count; f++) {
    if (checked[f].off > most) most = checked[f].off;
    if (!checked[f].bad) continue;
    ++*bad_count;
    mark(part, f, bad);
  }
  cw_log_debug(cw_log_of(in->context),
               "layers of one passage: %d of %d wall triangles, columns within %.2g mm of their periodic images",
               in->triangle_count, part->wall.whole->triangle_count, cw_mm(most));
  if (*bad_count || most < SAME) goto done; // crossings only between sound prisms
  CW_TRY(cw_layers_crossing_make(&spread.work, &crossing));
  CW_TRY(cw_layers_crossing_find(&crossing, (const double(*)[3])spread.top, spread.moved));
  for (int32_t i = 0; i < crossing.pair_count; i++) {
    const CwLayerPair *pair = &crossing.pair[i];
    if (pair->kind_f == 1 && pair->kind_g == 1) continue; // the wall is as it is
    ++*bad_count;
    mark(part, pair->f, bad);
    if (pair->kind_g < 2) mark(part, pair->g, bad);
  }
done:
  cw_layers_crossing_free(&crossing);
  free(spread.top);
  free(spread.off);
  free(spread.moved);
  free(checked);
  return status;
}

// Gives the columns of all periodic images of v the thickness `thickness`, and marks them.
static void lower(const Part *part, int32_t v, double thickness, CwLayers *layers, uint8_t *lowered) {
  const CwLayerInput *whole = part->wall.whole;
  const CwPeriodicImages *images = part->images;
  const CwNodeImages *nodes = &part->surface->images;
  int32_t first = cw_image_first_member(nodes, part->is_first, v);
  double *end = layers->top[first], share = thickness / layers->thickness[first];
  for (int k = 0; k < 3; k++) end[k] = whole->x[first][k] + share * (end[k] - whole->x[first][k]);
  if (whole->constraint_count[first]) whole->snap(whole->snap_context, first, end);
  for (int32_t at = first, turns = 0; at >= 0; at = cw_image_after(nodes, at, first), turns++) {
    if (at != first) cw_image_point(images, turns, end, layers->top[at]);
    layers->thickness[at] = thickness;
    layers->reason[at] = CW_LAYER_REPAIR;
    lowered[at] = 1;
  }
}

// Lowers the columns of all image sets with a bad one, and those around that would stand out.
static CwStatus thin(const Part *part, const uint8_t *bad, CwLayers *layers) {
  CwStatus status = CW_OK;
  const CwLayerInput *whole = part->wall.whole;
  uint8_t *lowered = NULL;
  CW_NEW(lowered, whole->point_count);
  for (int32_t v = 0; v < whole->point_count; v++) {
    if (bad[v] && !lowered[v] && layers->thickness[v] > 0)
      lower(part, v, cw_policy.column_kept * layers->thickness[v], layers, lowered);
  }
  for (int again = 1; again;) {
    again = 0;
    for (int32_t f = 0; f < part->wall.in.triangle_count; f++) {
      const int32_t *corner = part->wall.in.triangle[f];
      for (int k = 0; k < 6; k++) { // either way along each edge
        int32_t v = part->wall.global[corner[k / 2]], w = part->wall.global[corner[(k / 2 + 1 + k % 2) % 3]];
        if (!lowered[v]) continue;
        double most = layers->thickness[v] + cw_policy.slope * cw_distance(whole->x[v], whole->x[w]);
        if (layers->thickness[w] <= most) continue;
        lower(part, w, most, layers, lowered);
        again = 1;
      }
    }
  }
done:
  free(lowered);
  return status;
}

CwStatus cw_image_layers(const CwPeriodicImages *images, const CwSurfaceMesh *surface, const CwLayerInput *input,
                         CwLayers *layers, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Part part = {0};
  CwLayers made = {0};
  uint8_t *bad = NULL;
  const double *near = input->x[0];
  memset(layers, 0, sizeof *layers);
  layers->column_count = input->point_count;
  CW_NEW(layers->top, input->point_count);
  CW_NEW(layers->thickness, input->point_count);
  CW_NEW(layers->reason, input->point_count);
  CW_NEW(bad, input->point_count);
  cw_profiler_part(input->context, "layers: copies");
  CW_TRY(part_make(images, surface, input, &part));
  CW_TRY_STAGE(cw_layers_make(&part.wall.in, &made, outcome), outcome);
  cw_profiler_part(input->context, "layers: copies");
  CW_TRY(spread(&part, &made, layers));
  CW_TRY(choose(&part, &made, layers));
  layers->repair_rounds = made.repair_rounds;
  layers->thinned_count = made.thinned_count;
  int32_t bad_count = 1;
  for (int round = 0; round < ROUNDS && bad_count; round++) {
    CW_TRY(check(&part, &made, layers, bad, &bad_count));
    if (!bad_count) break;
    int32_t first = 0;
    while (!bad[first]) first++;
    near = input->x[first];
    cw_log_debug(cw_log_of(input->context),
                 "%d prisms and pairs of the layer top do not fit their periodic images, near (%.3f, %.3f, %.3f) mm",
                 bad_count, CW_MM(near));
    CW_TRY(thin(&part, bad, layers));
  }
  CW_END_UNLESS(!bad_count, outcome, CW_OUTCOME_ASYMMETRIC, near,
                "after %d rounds %d prisms and pairs of the layer top do not fit their periodic images", ROUNDS,
                bad_count);
done:
  part_free(&part);
  cw_layers_free(&made);
  free(bad);
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) cw_layers_free(layers);
  return status;
}
