// SPDX-License-Identifier: AGPL-3.0-or-later
// The solution of the smoothing in one block and the rows around it.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/common/vertex_heap.h"
#include "mesher/common/vertex_map.h"
#include "mesher/layers/direction_smoothing_work.h"
#include "mesher/layers/layers_normal.h"
#include "mesher/layers/layers_topology.h"
#include "mesher/layers/prism_quality.h"
#include "mesher/policy.h"

enum { SWEEPS = 60, MORE_SWEEPS = 30, WIDENINGS = 6, HALO = 6 };
static const double SETTLED = 3e-4; // change in one sweep, in thicknesses, that is none

// The source that reaches v; NULL where none does.
static const CwSmoothingSource *source_of(const CwSmoothing *smoothing, int32_t v) {
  int32_t source = smoothing->reach[v].source;
  return source < 0 ? NULL : &smoothing->source[source];
}

static int is_source(const CwSmoothing *smoothing, int32_t v) {
  const CwSmoothingSource *source = source_of(smoothing, v);
  return source && source->vertex == v;
}

static double range(const CwSmoothing *smoothing, int32_t v) {
  const CwSmoothingSource *source = source_of(smoothing, v);
  if (!source) return 0;
  double fade = fmax(0, 1 - smoothing->reach[v].distance / (cw_policy.smoothing_reach * source->thickness));
  return 1.5 * smoothing->work->t[v] * fmax(0.7, source->opening * fade);
}

// Which displacements a column may have: those across a line, or what is given of it and those along the line.
typedef struct {
  int is_across;
  double line[3], given[3]; // unit, or zero where nothing but the given one is left; m
} Allowed;

// Without changing the normal thickness of v or leaving its constraints; of a source what is left of its own.
static Allowed allowed_at(const CwSmoothing *smoothing, int32_t v) {
  const CwLayerWork *work = smoothing->work;
  const CwLayerInput *in = work->in;
  int constraints = cw_layer_constraints(in, v);
  Allowed allowed = {.is_across = work->crease[v] == CW_CREASE_NONE && constraints == 0};
  if (is_source(smoothing, v)) {
    const CwSmoothingSource *source = source_of(smoothing, v);
    allowed.is_across = 0;
    memcpy(allowed.line, source->line, sizeof allowed.line);
    memcpy(allowed.given, source->u, sizeof allowed.given);
    return allowed;
  }
  if (constraints == 2) return allowed;
  if (allowed.is_across) {
    memcpy(allowed.line, work->normal[v], sizeof allowed.line);
    return allowed;
  }
  if (work->crease[v] == CW_CREASE_NONE) {
    cw_cross(work->normal[v], in->constraint_normal[v][0], allowed.line);
  } else {
    memcpy(allowed.line, work->along[v], sizeof allowed.line);
    if (constraints && fabs(cw_dot(allowed.line, in->constraint_normal[v][0])) > 0.1)
      memset(allowed.line, 0, sizeof allowed.line);
    if (constraints) cw_flatten(allowed.line, in->constraint_normal[v][0]);
  }
  cw_unit(allowed.line);
  return allowed;
}

// Projects u onto what is allowed.
static inline void allow(const Allowed *allowed, double u[3]) {
  double h = cw_dot(u, allowed->line);
  for (int k = 0; k < 3; k++) {
    double along = h * allowed->line[k];
    u[k] = allowed->is_across ? u[k] - along : allowed->given[k] + along;
  }
}

// One block: local numbers are those of its members and the halo, in order of distance, then of the vertices around
// them, whose displacement stays. The fields are arrays over these, made together for a block and freed with it.
typedef struct {
  const CwLayerWork *work;
  int32_t count, all;
  int32_t *member;
  int32_t *outer;             // vertices around: all - count
  int32_t *near_start, *near; // local numbers of the neighbours of members
  uint8_t *across;            // neighbour is a convex edge that leans along itself only
  double *weight, *weights;   // of neighbours; their sum
  double *area;               // of members
  double *reach;              // of all, where nothing is widened
  double *share;              // of members: of the weighted sum of their neighbours that they take, at their reach
  uint8_t *stirred, *changed; // members to relax; those whose displacement changed since the columns were set
  uint8_t *touched;           // whose displacement changed at all
  uint8_t *spread;            // members beside whom the widening has changed since theirs was made from it
  double *widen;              // of all: factor on L where the usual one leaves prisms overrun
  Allowed *allowed;           // of all
  double (*u)[3];             // of all: displacement relative to an undisturbed neighbour on the wall, m
  double (*column)[3], (*top)[3];
  int32_t triangle_count, (*corner)[3]; // of the wall, with a member; their local numbers
  double *quality;                      // of the prisms over them
  CwVertexMap local;                    // their local numbers, from 1
} Part;

static int32_t vertex_of(const Part *part, int32_t i) {
  return i < part->count ? part->member[i] : part->outer[i - part->count];
}

static void part_free(Part *part) {
  cw_vertex_map_free(&part->local);
  free(part->member);
  free(part->outer);
  free(part->near_start);
  free(part->near);
  free(part->across);
  free(part->weight);
  free(part->weights);
  free(part->area);
  free(part->reach);
  free(part->share);
  free(part->allowed);
  free(part->u);
  free(part->stirred);
  free(part->changed);
  free(part->touched);
  free(part->spread);
  free(part->widen);
  free(part->corner);
  free(part->quality);
  free(part->column);
  free(part->top);
}

static int by_distance(const void *p, const void *q) {
  const CwHeapItem *a = p, *b = q;
  return a->key != b->key ? (a->key > b->key) - (a->key < b->key) : (a->v > b->v) - (a->v < b->v);
}

// Members of a block.
static int32_t block_size(const CwSmoothing *smoothing, int32_t block) {
  int32_t left = smoothing->count - block * CW_SMOOTHING_BLOCK;
  return left < CW_SMOOTHING_BLOCK ? left : CW_SMOOTHING_BLOCK;
}

// The members of a block and its halo, in order of distance.
static CwStatus gather_members(const CwSmoothing *smoothing, int32_t block, Part *part) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = smoothing->work;
  int32_t capacity = 2 * block_size(smoothing, block), ring = 0;
  CwHeapItem *order = NULL;
  CW_NEW(part->member, capacity);
  for (int32_t i = 0; i < block_size(smoothing, block); i++) {
    int32_t v = smoothing->member[block * CW_SMOOTHING_BLOCK + i];
    CW_TRY(cw_vertex_map_set(&part->local, v, 1));
    part->member[part->count++] = v;
  }
  part->all = part->count;
  for (int hop = 0; hop < HALO; hop++) {
    int32_t end = part->count;
    for (; ring < end; ring++) {
      int32_t v = part->member[ring];
      for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
        int32_t w = work->near[k];
        if (smoothing->place[w] < 0 || cw_vertex_map_get(&part->local, w)) continue;
        CW_GROW(part->member, capacity, part->count + 1);
        CW_TRY(cw_vertex_map_set(&part->local, w, 1));
        part->member[part->count++] = w;
        part->all++;
      }
    }
  }
  CW_NEW(order, part->count);
  for (int32_t i = 0; i < part->count; i++) {
    order[i] = (CwHeapItem){smoothing->reach[part->member[i]].distance, part->member[i]};
  }
  qsort(order, (size_t)part->count, sizeof *order, by_distance);
  for (int32_t i = 0; i < part->count; i++) part->member[i] = order[i].v;
done:
  free(order);
  return status;
}

// Lists the wall triangles at member i that no member before it has listed.
static void list_triangles(Part *part, int32_t i) {
  const CwLayerWork *work = part->work;
  int32_t v = part->member[i];
  for (int32_t k = work->face_start[v]; k < work->face_start[v + 1]; k++) {
    const int32_t *corner = work->in->triangle[work->face[k]];
    int32_t *made = part->corner[part->triangle_count];
    int is_first = 1;
    for (int c = 0; c < 3; c++) {
      made[c] = cw_vertex_map_get(&part->local, corner[c]) - 1;
      is_first &= made[c] >= i;
    }
    part->triangle_count += is_first;
  }
}

static CwStatus part_make(const CwSmoothing *smoothing, int32_t block, Part *part) {
  CwStatus status = CW_OK;
  const CwLayerWork *work = smoothing->work;
  int32_t links = 0, faces = 0;
  *part = (Part){.work = work};
  CW_TRY(gather_members(smoothing, block, part));
  int32_t count = part->count;
  for (int32_t i = 0; i < count; i++) {
    int32_t v = part->member[i];
    CW_TRY(cw_vertex_map_set(&part->local, v, i + 1));
    links += work->near_start[v + 1] - work->near_start[v];
    faces += work->face_start[v + 1] - work->face_start[v];
  }
  CW_NEW(part->outer, links);
  CW_NEW(part->near_start, count + 1);
  CW_NEW(part->near, links);
  CW_NEW(part->across, links);
  CW_NEW(part->weight, links);
  CW_NEW(part->weights, count);
  CW_NEW(part->area, count);
  CW_NEW_UNSET(part->corner, faces);
  CW_NEW(part->quality, faces);
  CW_NEW(part->stirred, count);
  CW_NEW(part->changed, count);
  CW_NEW(part->touched, count);
  CW_NEW(part->spread, count);
  memset(part->spread, 1, (size_t)count);
  memset(part->stirred, 1, (size_t)count);
  memset(part->changed, 1, (size_t)count);
  links = 0;
  for (int32_t i = 0; i < count; i++) {
    int32_t v = part->member[i];
    cw_layers_weights(work, v, part->weight + links, &part->area[i]);
    for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++, links++) {
      int32_t w = work->near[k];
      if (!cw_vertex_map_get(&part->local, w)) {
        part->outer[part->all - count] = w;
        CW_TRY(cw_vertex_map_set(&part->local, w, ++part->all));
      }
      part->near[links] = cw_vertex_map_get(&part->local, w) - 1;
      part->across[links] = work->crease[w] == CW_CREASE_CONVEX && !is_source(smoothing, w);
      part->weights[i] += part->weight[links];
    }
    part->near_start[i + 1] = links;
    list_triangles(part, i);
  }
  CW_NEW(part->reach, part->all);
  CW_NEW(part->share, count);
  CW_NEW(part->allowed, part->all);
  CW_NEW(part->u, part->all);
  CW_NEW(part->widen, part->all);
  CW_NEW(part->column, part->all);
  CW_NEW(part->top, part->all);
  for (int32_t f = 0; f < part->triangle_count; f++) part->quality[f] = INFINITY; // of those that do not change
  for (int32_t i = 0; i < part->all; i++) {
    part->widen[i] = 1;
    part->reach[i] = range(smoothing, vertex_of(part, i));
    part->allowed[i] = allowed_at(smoothing, vertex_of(part, i));
    memcpy(part->u[i], part->allowed[i].given, sizeof part->u[i]);
  }
done:
  return status;
}

static void set_share(Part *part, int32_t i) {
  double reach = part->reach[i] * part->widen[i], l2 = reach * reach;
  part->share[i] = l2 / (part->area[i] + l2 * part->weights[i]);
}

// One step of the solution at member i; returns how far its displacement moved, in thicknesses.
static double relax(Part *part, int32_t i) {
  const CwLayerWork *work = part->work;
  double *own = part->u[i], sum[3] = {0}, u[3];
  for (int32_t k = part->near_start[i]; k < part->near_start[i + 1]; k++) {
    const double *near = part->u[part->near[k]];
    double weight = part->weight[k];
    if (part->across[k]) {
      // A convex edge may lean along itself only; across it the lean of v goes on undisturbed.
      const double *along = work->along[vertex_of(part, part->near[k])];
      double h = cw_dot(along, near) - cw_dot(along, own);
      for (int c = 0; c < 3; c++) sum[c] += weight * (own[c] + h * along[c]);
    } else {
      for (int c = 0; c < 3; c++) sum[c] += weight * near[c];
    }
  }
  for (int c = 0; c < 3; c++) u[c] = part->share[i] * sum[c];
  allow(&part->allowed[i], u);
  double moved = cw_distance(own, u) / work->t[part->member[i]];
  memcpy(own, u, sizeof u);
  return moved;
}

static int is_wide(const Part *part, int32_t i) {
  return part->widen[i] > 1.05;
}

// Relaxes the members outward and inward by turns: news of a source crosses the whole reach in one sweep. Only those
// are looked at that are stirred: told to, widened, or beside one that moved. `wide`: those alone where the smoothing
// was ever widened; elsewhere the solution stands.
static void solve(Part *part, int wide, int sweeps) {
  for (int32_t i = 0; wide && i < part->count; i++) part->stirred[i] &= is_wide(part, i);
  for (int s = 0; s < sweeps; s++) {
    int32_t stirred = 0;
    for (int32_t k = 0; k < part->count; k++) {
      int32_t i = s % 2 ? part->count - 1 - k : k;
      if (!part->stirred[i]) continue;
      stirred++;
      part->stirred[i] = 0;
      part->changed[i] = 1;
      if (relax(part, i) < SETTLED) continue;
      part->stirred[i] = 1;
      for (int32_t l = part->near_start[i]; l < part->near_start[i + 1]; l++) {
        int32_t j = part->near[l];
        if (j < part->count && (!wide || is_wide(part, j))) part->stirred[j] = 1;
      }
    }
    if (stirred == 0) break;
  }
}

// Sets where the column of i ends; the snap changes too little to matter here.
static void set_end(Part *part, int32_t i) {
  const CwLayerWork *work = part->work;
  int32_t v = vertex_of(part, i);
  for (int k = 0; k < 3; k++) part->top[i][k] = work->in->x[v][k] + work->t[v] * part->column[i][k];
}

// Leans the column of i as the smoothing asks, but no further than column_least_cosine allows, and keeps its
// normal thickness.
static void lean(Part *part, int32_t i) {
  const CwLayerWork *work = part->work;
  int32_t v = vertex_of(part, i);
  double least = fmin(cw_policy.column_least_cosine, cw_policy.lean_share * work->base_cos[v]), scale = 1, upright[3];
  cw_layers_upright(work, v, upright);
  memcpy(part->column[i], upright, sizeof upright);
  double thickness = cw_layers_least_cosine(work, v, upright);
  for (int halving = 0; halving < 6; halving++, scale *= 0.5) {
    double column[3];
    for (int k = 0; k < 3; k++) {
      double u = part->u[i][k] - part->allowed[i].given[k];
      column[k] = upright[k] + scale * u / work->t[v];
    }
    double now = cw_layers_least_cosine(work, v, column);
    if (now < least * cw_norm(column)) continue;
    for (int k = 0; k < 3; k++) part->column[i][k] = column[k] * fmin(thickness / now, 1.5);
    break;
  }
  set_end(part, i);
}

// Widens the smoothing at i to `widen` at least, and has the neighbours follow; of a vertex around the members they are
// not listed, so that all are looked at.
static void widen_at(Part *part, int32_t i, double widen) {
  if (widen <= part->widen[i]) return;
  part->widen[i] = widen;
  if (i >= part->count) {
    memset(part->spread, 1, (size_t)part->count);
    return;
  }
  set_share(part, i);
  part->stirred[i] = 1;
  for (int32_t l = part->near_start[i]; l < part->near_start[i + 1]; l++) {
    if (part->near[l] < part->count) part->spread[part->near[l]] = 1;
  }
}

// Widens the smoothing around poor prisms; returns how many there are. At a corner that juts into the wall (a blade's
// bevel on the hub) the solution falls off faster than beside a straight crease, and more so the finer the mesh.
static int32_t widen(Part *part) {
  const CwLayerWork *work = part->work;
  const CwLayerInput *in = work->in;
  int32_t poor = 0;
  for (int32_t f = 0; f < part->triangle_count; f++) {
    const int32_t *local = part->corner[f];
    int changed = 0;
    for (int k = 0; k < 3; k++) changed |= local[k] < part->count && part->changed[local[k]];
    if (changed) {
      const double *wall[3], *top[3];
      for (int k = 0; k < 3; k++) wall[k] = in->x[vertex_of(part, local[k])], top[k] = part->top[local[k]];
      part->quality[f] = cw_prism_quality(wall, top);
    }
    if (part->quality[f] >= cw_policy.smoothing_poor) continue;
    poor++;
    for (int k = 0; k < 3; k++) widen_at(part, local[k], fmin(part->widen[local[k]] * 1.4, cw_policy.smoothing_widest));
  }
  memset(part->changed, 0, (size_t)part->count);
  // Over about a thickness around, so that the lean stays smooth.
  for (int pass = 0; pass < 2 && poor; pass++)
    for (int32_t k = 0; k < part->count; k++) {
      int32_t i = pass ? part->count - 1 - k : k, v = part->member[i];
      if (!part->spread[i]) continue;
      part->spread[i] = 0;
      for (int32_t l = part->near_start[i]; l < part->near_start[i + 1]; l++) {
        double there = part->widen[part->near[l]];
        if (there <= part->widen[i]) continue;
        double away = cw_distance(in->x[v], in->x[vertex_of(part, part->near[l])]) / work->t[v];
        widen_at(part, i, there * exp(-0.5 * away));
      }
    }
  return poor;
}

// Whether the thicknesses on and around v are those of the last smoothing.
static int is_settled(const CwSmoothing *smoothing, int32_t v) {
  const CwLayerWork *work = smoothing->work;
  if (smoothing->lean_t[v] != work->t[v]) return 0;
  for (int32_t k = work->near_start[v]; k < work->near_start[v + 1]; k++) {
    int32_t w = work->near[k];
    if (smoothing->lean_t[w] >= 0 && smoothing->lean_t[w] != work->t[w]) return 0;
  }
  return 1;
}

// Whether v has a neighbour in another block.
static int is_between(const CwSmoothing *smoothing, int32_t v) {
  for (int32_t k = smoothing->work->near_start[v]; k < smoothing->work->near_start[v + 1]; k++) {
    int32_t other = smoothing->place[smoothing->work->near[k]];
    if (other >= 0 && other / CW_SMOOTHING_BLOCK != smoothing->place[v] / CW_SMOOTHING_BLOCK) return 1;
  }
  return 0;
}

// Where the solution at i starts: what the last smoothing found, or what falls off from the nearest source. Around the
// members it stays so.
static void start(const CwSmoothing *smoothing, Part *part, int32_t i) {
  const CwLayerWork *work = part->work;
  int32_t v = vertex_of(part, i);
  int32_t place = smoothing->place[v];
  if (place < 0) { // out of reach, or wholly given
    cw_layers_upright(work, v, part->column[i]);
    set_end(part, i);
    return;
  }
  if (smoothing->lean.bytes) {
    const CwLean *last = (const CwLean *)smoothing->lean.bytes[place / CW_SMOOTHING_BLOCK] + place % CW_SMOOTHING_BLOCK;
    part->widen[i] = last->widen;
    for (int k = 0; k < 3; k++) part->u[i][k] = last->u[k] * work->t[v] / smoothing->lean_t[v];
    if (is_settled(smoothing, v)) {
      memcpy(part->column[i], last->column, sizeof last->column);
      if (i < part->count) part->changed[i] = 0, part->stirred[i] = (uint8_t)is_between(smoothing, v);
      set_end(part, i);
      return;
    }
  } else if (!is_source(smoothing, v)) {
    double fall = exp(-smoothing->reach[v].distance / part->reach[i]);
    for (int k = 0; k < 3; k++) part->u[i][k] = fall * source_of(smoothing, v)->u[k];
    allow(&part->allowed[i], part->u[i]);
  }
  if (i >= part->count) lean(part, i);
}

// Solves one block; gives the columns of its members.
CwStatus cw_smoothing_solve_block(void *context, int32_t block, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  CwSmoothing *smoothing = context;
  Part part = {0};
  CwLean *lean_of = NULL;
  int32_t count = block_size(smoothing, block);
  CW_TRY(part_make(smoothing, block, &part));
  for (int32_t i = 0; i < part.all; i++) start(smoothing, &part, i);
  for (int32_t i = 0; i < part.count; i++) set_share(&part, i);
  for (int round = 0; round <= WIDENINGS; round++) {
    solve(&part, round > 0, round ? MORE_SWEEPS : SWEEPS);
    for (int32_t i = 0; i < part.count; i++) {
      if (!part.changed[i]) continue;
      part.touched[i] = 1;
      lean(&part, i);
    }
    if (round == WIDENINGS || widen(&part) == 0) break;
  }
  CW_NEW(lean_of, count);
  for (int32_t k = 0; k < count; k++) {
    int32_t i = cw_vertex_map_get(&part.local, smoothing->member[block * CW_SMOOTHING_BLOCK + k]) - 1;
    memcpy(lean_of[k].column, part.column[i], sizeof part.column[i]);
    memcpy(lean_of[k].u, part.u[i], sizeof part.u[i]);
    lean_of[k].widen = part.widen[i];
    lean_of[k].changed = part.touched[i];
  }
  *size = (int64_t)count * (int64_t)sizeof *lean_of;
  *bytes = lean_of;
  lean_of = NULL;
done:
  free(lean_of);
  part_free(&part);
  return status;
}
