// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/curve_division.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/vec.h"
#include "mesher/parallel/schedule.h"
#include "mesher/surface/chords.h"
#include "pipeline/log.h"

// Halvings of one edge: then curves touch, and the surface mesh names the place. So it is once more edges are halved
// than there were points: where curves lie on one another each round halves all of them.
enum { ROUNDS = 16 };

// An edge of a division.
typedef struct {
  int32_t curve, edge;
} Edge;

typedef struct {
  const CwBoundaryInput *in;
  const CwCurveDivision *division;
  int32_t face_count, *face; // those to be looked at
} Faces;

static int32_t first_of(const CwBoundaryInput *in, int32_t curve) {
  return in->images->symmetry ? in->images->curve.first[curve] : curve;
}

// Whether the face is meshed, and not a copy.
static int is_meshed(const CwBoundaryInput *in, int32_t face) {
  const CwSymmetry *symmetry = in->images->symmetry;
  return cw_cad_face_is_meshed_wall(in->cad, face) && (!symmetry || !symmetry->face.turns[face]);
}

// The piece of `curve`, a copy of `first`, from point k of the division on.
static void make_chord(const CwBoundaryInput *in, int32_t face, const CwCurve *curve, const CwCurve *first,
                       const CwCurveDivision *division, int32_t k, CwChord *chord) {
  const CwCurvePoint *a = &division->point[k], *b = &division->point[k + 1];
  double along[3], from[3], beside[3], gap = 0;
  if (k == 0) gap += cw_curve_end_gap(in->network, first, 0);
  if (k + 2 == division->count) gap += cw_curve_end_gap(in->network, first, 1);
  cw_sub(b->x, a->x, along);
  double length = cw_norm(along);
  chord->deviation = 0;
  chord->given = division->given;
  for (int i = 0; i < CW_CHORD_SAMPLES; i++) {
    double s = (double)i / (CW_CHORD_SAMPLES - 1), x[3], parameter[2];
    if (i == 0 || i == CW_CHORD_SAMPLES - 1) {
      memcpy(parameter, i ? b->parameter : a->parameter, sizeof parameter);
      cw_copy(i ? b->x : a->x, x);
    } else {
      cw_curve_point(in->network, first, a->place + s * (b->place - a->place), x, parameter);
    }
    cw_curve_uv(in->cad, curve, parameter, face, chord->uv[i]);
    cw_sub(x, a->x, from);
    cw_cross(along, from, beside);
    if (length > 0) chord->deviation = fmax(chord->deviation, cw_norm(beside) / length - gap);
  }
}

// The edges of a face that have to be halved, packed: a task.
static CwStatus judge_face(void *context, int32_t task, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Faces *faces = context;
  const CwBoundaryInput *in = faces->in;
  const CwNetwork *network = in->network;
  int32_t face = faces->face[task], count = 0, found = 0, points = network->corner_count;
  CwChord *chord = NULL;
  Edge *edge = NULL;
  uint8_t *halve = NULL;
  for (int32_t i = 0; i < network->curve_count; i++) {
    if (cw_curve_bounds(&network->curve[i], face)) count += faces->division[first_of(in, i)].count - 1;
  }
  CW_NEW(chord, count);
  CW_NEW(edge, count);
  CW_NEW(halve, count);
  count = 0;
  for (int32_t i = 0; i < network->curve_count; i++) {
    const CwCurve *curve = &network->curve[i];
    if (!cw_curve_bounds(curve, face)) continue;
    int32_t first = first_of(in, i);
    const CwCurveDivision *division = &faces->division[first];
    for (int32_t k = 0; k + 1 < division->count; k++) {
      make_chord(in, face, curve, &network->curve[first], division, k, &chord[count]);
      chord[count].point[0] = k > 0 ? points - 1 : curve->corner[0];
      chord[count].point[1] = k + 2 < division->count ? points++ : curve->corner[1];
      edge[count++] = (Edge){first, k};
    }
  }
  CW_TRY(cw_chords_to_halve(count, chord, halve));
  for (int32_t i = 0; i < count; i++) {
    if (halve[i]) edge[found++] = edge[i];
  }
  if (found) {
    *bytes = edge;
    *size = found * (int64_t)sizeof *edge;
    edge = NULL;
  }
done:
  free(chord);
  free(edge);
  free(halve);
  return status;
}

static int compare_edges(const void *p, const void *q) {
  const Edge *a = p, *b = q;
  if (a->curve != b->curve) return a->curve < b->curve ? -1 : 1;
  return (a->edge > b->edge) - (a->edge < b->edge);
}

// Puts a point into the middle of each of the edges, which are in order and all of one curve.
static CwStatus halve_edges(const CwNetwork *network, int32_t count, const Edge *edge, CwCurveDivision *division) {
  CwStatus status = CW_OK;
  const CwCurve *curve = &network->curve[edge[0].curve];
  CwCurvePoint *point = NULL;
  int32_t made = 0, next = 0;
  CW_NEW(point, division->count + count);
  for (int32_t k = 0; k < division->count; k++) {
    point[made++] = division->point[k];
    if (next == count || edge[next].edge != k) continue;
    double middle = 0.5 * (division->point[k].place + division->point[k + 1].place);
    point[made++] = cw_curve_point_at(network, curve, middle);
    next++;
  }
  free(division->point);
  division->point = point;
  division->count = made;
done:
  return status;
}

// Gathers what all faces found, each edge once, and halves it. The faces of the curves concerned are left for the next
// round.
static CwStatus halve_found(Faces *faces, const CwTaskResults *found, CwCurveDivision *division, int32_t *halved) {
  CwStatus status = CW_OK;
  const CwBoundaryInput *in = faces->in;
  const CwNetwork *network = in->network;
  Edge *edge = NULL;
  uint8_t *changed = NULL;
  size_t count = (size_t)cw_task_results_join(found, NULL) / sizeof *edge, kept = 0;
  CW_NEW(edge, count);
  CW_NEW(changed, network->curve_count);
  cw_task_results_join(found, edge);
  qsort(edge, count, sizeof *edge, compare_edges);
  for (size_t i = 0; i < count; i++) {
    if (!kept || compare_edges(&edge[i], &edge[kept - 1])) edge[kept++] = edge[i];
  }
  for (size_t from = 0, to; from < kept; from = to) {
    for (to = from; to < kept && edge[to].curve == edge[from].curve;) to++;
    CW_TRY(halve_edges(network, (int32_t)(to - from), edge + from, &division[edge[from].curve]));
    changed[edge[from].curve] = 1;
  }
  int32_t left = 0;
  for (int32_t f = 0; f < cw_cad_face_count(in->cad); f++) {
    int concerned = 0;
    if (!is_meshed(in, f)) continue;
    for (int32_t i = 0; i < network->curve_count && !concerned; i++) {
      concerned = cw_curve_bounds(&network->curve[i], f) && changed[first_of(in, i)];
    }
    if (concerned) faces->face[left++] = f;
  }
  faces->face_count = left;
  *halved = (int32_t)kept;
done:
  free(edge);
  free(changed);
  return status;
}

CwStatus cw_curve_divisions_refine(const CwContext *context, const CwBoundaryInput *in, CwCurveDivision *division) {
  CwStatus status = CW_OK;
  Faces faces = {.in = in, .division = division};
  CwTaskResults results = {0};
  int32_t all = cw_cad_face_count(in->cad), total = 0, points = 0;
  CW_NEW(faces.face, all);
  for (int32_t i = 0; i < in->network->curve_count; i++) points += division[i].count;
  for (int32_t f = 0; f < all; f++) {
    if (is_meshed(in, f)) faces.face[faces.face_count++] = f;
  }
  for (int round = 0; round < ROUNDS && faces.face_count && total <= points; round++) {
    int32_t halved = 0;
    CwSchedule schedule = {
        .step = "curves of the walls", .count = faces.face_count, .run = judge_face, .context = &faces};
    CW_TRY(cw_schedule_gather(context, &schedule, &results));
    CW_TRY(halve_found(&faces, &results, division, &halved));
    total += halved;
    cw_task_results_free(&results);
  }
  if (total) cw_log_debug(cw_log_of(context), "curves of the walls: %d edges halved to lie as their curves do", total);
done:
  cw_task_results_free(&results);
  free(faces.face);
  return status;
}
