// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_profile.h"

#include <math.h>
#include <string.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "pipeline/order.h"

int cw_profile_bin(const CwPlanProfile *profile, double place) {
  double bin = (place - profile->low) / profile->width;
  return bin <= 0 ? 0 : bin >= CW_PROFILE_BINS ? CW_PROFILE_BINS - 1 : (int)bin;
}

double cw_profile_below(const CwPlanProfile *profile, double place) {
  int bin = cw_profile_bin(profile, place);
  double part = fmin(fmax((place - profile->low) / profile->width - bin, 0), 1);
  return profile->below[bin] + part * (profile->below[bin + 1] - profile->below[bin]);
}

double cw_profile_place(const CwPlanProfile *profile, double cells) {
  int low = cw_interval_of(CW_PROFILE_BINS + 1, profile->below, cells);
  double step = profile->below[low + 1] - profile->below[low];
  double part = step > 0 ? fmin(fmax((cells - profile->below[low]) / step, 0), 1) : 0.5;
  return profile->low + (low + part) * profile->width;
}

typedef struct {
  double low, high;
} Extent;

// Of a piece along n.
static Extent extent_of(const CwPieces *pieces, int32_t i, const double n[3]) {
  Extent extent = {INFINITY, -INFINITY};
  for (int32_t c = pieces->start[i]; c < pieces->start[i + 1]; c++) {
    double place = cw_dot(n, pieces->corner[c]);
    extent.low = place < extent.low ? place : extent.low;
    extent.high = place > extent.high ? place : extent.high;
  }
  return extent;
}

// Spreads an amount evenly over the bins from..to, given in bins.
static void spread(double *bins, double from, double to, double amount) {
  int first = (int)from, last = (int)to;
  double each = amount / (to - from);
  bins[first] += each * (first + 1 - from);
  for (int b = first + 1; b < last; b++) bins[b] += each;
  bins[last] += each * (to - last);
}

static void add_pieces(const CwPlanModel *model, const CwPlanPart *part, const double n[3], double *work,
                       CwPlanProfile *profile) {
  const CwPieces *pieces = &part->pieces;
  const double scale = 1 / profile->width, origin = profile->low, end = CW_PROFILE_BINS - 1e-6;
  double steepest[CW_PROFILE_BINS] = {0}; // greatest (n.m)^2
  for (int32_t i = 0; i < pieces->count; i++) {
    Extent extent = extent_of(pieces, i, n);
    double low = (extent.low - origin) * scale, high = (extent.high - origin) * scale;
    low = low < 0 ? 0 : low > end ? end : low;
    high = high < 0 ? 0 : high > end ? end : high;
    if ((int)low == (int)high) {
      work[(int)low] += pieces->work[i];
    } else {
      spread(work, low, high, pieces->work[i]);
    }
    const CwPlanTriangle *wall = &model->triangle[pieces->triangle[i]];
    double dot = cw_dot(n, wall->normal), square = dot * dot;
    double layers = wall->thickness * dot * scale; // the layer top lies behind the wall by so much
    low = layers > 0 ? fmax(low - layers, 0) : low;
    high = layers < 0 ? fmin(high - layers, end) : high;
    for (int b = (int)low; b <= (int)high; b++) {
      if (square > steepest[b]) steepest[b] = square;
    }
  }
  for (int b = 0; b < CW_PROFILE_BINS; b++) profile->worst[b] = sqrt(fmax(0, 1 - steepest[b]));
}

// Whether a plane with normal n runs along the edge at one of its points, or comes near its end.
static int may_graze(const CwPlanModel *model, int32_t e, const double n[3]) {
  return model->edge[e].end || fabs(cw_dot(n, model->edge[e].tangent)) < sin(cw_policy.wanted_angle * CW_DEGREE);
}

// Full weight within half of the room, then less and less.
static double nearness(double off, double room) {
  return fmin(fmax(2 * (1 - off / room), 0), 1);
}

static void add_edges(const CwPlanModel *model, const CwPlanPart *part, const double n[3], CwPlanProfile *profile) {
  for (int32_t i = 0; i < part->edge_count; i++) {
    int32_t e = part->edge[i];
    if (!may_graze(model, e, n)) continue;
    double place = cw_dot(n, model->edge[e].x), room = model->edge[e].room;
    if (place + room < profile->low || place - room > profile->low + CW_PROFILE_BINS * profile->width) continue;
    int last = cw_profile_bin(profile, place + room);
    for (int b = cw_profile_bin(profile, place - room); b <= last; b++) {
      double near = nearness(fabs(profile->low + (b + 0.5) * profile->width - place), room);
      profile->cut[b] = fmax(profile->cut[b], near);
    }
  }
}

// Each sample stands for what is `width` bins about it: a running mean does for all of them at once.
static void smooth(double *bins, int width) {
  double sum[CW_PROFILE_BINS + 1] = {0};
  for (int b = 0; b < CW_PROFILE_BINS; b++) sum[b + 1] = sum[b] + bins[b];
  for (int b = 0; b < CW_PROFILE_BINS; b++) {
    int first = b - width / 2 > 0 ? b - width / 2 : 0;
    int last = b + width / 2 < CW_PROFILE_BINS - 1 ? b + width / 2 : CW_PROFILE_BINS - 1;
    bins[b] = (sum[last + 1] - sum[first]) / (2 * (width / 2) + 1);
  }
}

static void add_samples(const CwPlanModel *model, const CwPlanPart *part, const double n[3], int32_t most, double *work,
                        CwPlanProfile *profile) {
  int32_t stride = part->sample_count / most + 1;
  double volume = 0, cells = 0, all = part->work, scale = 1 / profile->width;
  for (int32_t i = 0; i < part->sample_count; i += stride) {
    int32_t s = part->sample[i];
    int bin = (int)((cw_dot(n, model->sample[s].x) - profile->low) * scale); // the margin keeps it within the bins
    work[bin] += model->sample[s].work;
    profile->area[bin] += model->sample[s].volume;
  }
  int width = (int)(model->sample_spacing * cbrt(stride) / profile->width);
  smooth(profile->area, width);
  for (int b = 0; b < CW_PROFILE_BINS; b++) cells += work[b], volume += profile->area[b];
  // What is left out counts like what is seen.
  for (int32_t i = 0; i < part->pieces.count; i++) all -= part->pieces.work[i];
  for (int b = 0; b < CW_PROFILE_BINS; b++) {
    work[b] *= cells > 0 ? all / cells : 0;
    profile->area[b] *= volume > 0 ? part->volume / volume / profile->width : 0;
  }
}

void cw_plan_profile(const CwPlanModel *model, const CwPlanPart *part, const double direction[3], int32_t samples_most,
                     CwPlanProfile *profile) {
  double low = INFINITY, high = -INFINITY, work[CW_PROFILE_BINS] = {0}, margin = model->sample_spacing;
  memset(profile, 0, sizeof *profile);
  for (int32_t i = 0; i < part->sample_count; i++) {
    double place = cw_dot(direction, model->sample[part->sample[i]].x);
    low = place < low ? place : low;
    high = place > high ? place : high;
  }
  if (!(high > low)) return;
  profile->low = low - margin;
  profile->width = (high - low + 2 * margin) / CW_PROFILE_BINS;
  add_samples(model, part, direction, samples_most, work, profile);
  add_pieces(model, part, direction, work, profile);
  add_edges(model, part, direction, profile);
  for (int b = 0; b < CW_PROFILE_BINS; b++) profile->below[b + 1] = profile->below[b] + fmax(work[b], 0);
}

CwPlanPlace cw_profile_at(const CwPlanProfile *profile, int bin) {
  return (CwPlanPlace){profile->worst[bin], profile->cut[bin]};
}

CwPlanPlace cw_plan_place(const CwPlanModel *model, const CwPlanPart *part, const CwPlane *plane, const CwPlane *end) {
  const CwPieces *pieces = &part->pieces;
  CwPlanPlace place = {0};
  double steepest = 0;
  for (int32_t i = 0; i < pieces->count; i++) {
    Extent extent = extent_of(pieces, i, plane->normal);
    const CwPlanTriangle *wall = &model->triangle[pieces->triangle[i]];
    double dot = cw_dot(plane->normal, wall->normal), layers = wall->thickness * dot;
    double low = extent.low - plane->offset, high = extent.high - plane->offset;
    if (low - fmax(layers, 0) > 0 || high - fmin(layers, 0) <= 0 || dot * dot <= steepest) continue;
    int within = end == NULL;
    for (int32_t c = pieces->start[i]; c < pieces->start[i + 1] && !within; c++) {
      within = cw_plane_distance(end, pieces->corner[c]) > 0;
    }
    if (within) steepest = dot * dot;
  }
  place.worst = sqrt(fmax(0, 1 - steepest));
  for (int32_t i = 0; i < part->edge_count; i++) {
    int32_t e = part->edge[i];
    double room = model->edge[e].room, near = nearness(fabs(cw_plane_distance(plane, model->edge[e].x)), room);
    if (near == 0 || !may_graze(model, e, plane->normal)) continue;
    if (end && cw_plane_distance(end, model->edge[e].x) < -room) continue;
    place.cut = fmax(place.cut, near);
  }
  return place;
}

double cw_plan_along_edge(const CwPlanModel *model, int32_t e, const double n[3]) {
  return fmax(0, 1 - fabs(cw_dot(n, model->edge[e].tangent)) / sin(cw_policy.wanted_angle * CW_DEGREE));
}

// Whether a plane crosses the border of a left-out face at this point, but no CAD edge that stands for it, or one
// elsewhere. As corner_on_edge of the network has it, by chords.
static int has_no_corner(const CwPlanModel *model, int32_t e, const CwPlane *plane) {
  const CwPlanEdgePoint *edge = &model->edge[e];
  double off = cw_plane_distance(plane, edge->x), slope = cw_dot(plane->normal, edge->tangent);
  if (edge->half == 0 || fabs(off) > edge->half * fabs(slope)) return 0;
  double crossing[3];
  for (int k = 0; k < 3; k++) crossing[k] = edge->x[k] - (slope == 0 ? 0 : off / slope) * edge->tangent[k];
  for (int32_t i = edge->stand_start; i < edge->stand_start + edge->stand_count; i++) {
    const CwPlanStand *stand = &model->stand[i];
    double a = cw_plane_distance(plane, stand->x[0]), b = cw_plane_distance(plane, stand->x[1]), corner[3];
    if ((a > 0) == (b > 0)) continue;
    cw_lerp(stand->x[0], stand->x[1], a / (a - b), corner);
    if (cw_distance(corner, crossing) < 2 * (edge->half + stand->gap)) return 0;
  }
  return 1;
}

double cw_plan_touch(const CwPlanModel *model, const CwPlanPart *part, const CwPlane *plane, const CwPlane *end) {
  double most = 0;
  for (int32_t i = 0; i < part->edge_count; i++) {
    int32_t e = part->edge[i];
    double room = model->edge[e].touch, near = 1 - fabs(cw_plane_distance(plane, model->edge[e].x)) / room;
    if (end && cw_plane_distance(end, model->edge[e].x) < -room) continue;
    if (most < CW_PLAN_UNFIT && has_no_corner(model, e, plane)) most = CW_PLAN_UNFIT;
    if (near > most) most = fmax(most, near * cw_plan_along_edge(model, e, plane->normal));
  }
  return most;
}

void cw_plan_touches(const CwPlanModel *model, const CwPlanPart *part, const double n[3], double low, double step,
                     int32_t count, double *touch) {
  for (int32_t i = 0; i < count; i++) touch[i] = 0;
  for (int32_t i = 0; i < part->edge_count; i++) {
    int32_t e = part->edge[i];
    double place = cw_dot(n, model->edge[e].x), along = cw_plan_along_edge(model, e, n);
    double room = fmax(model->edge[e].touch, model->edge[e].half);
    if (along == 0 && model->edge[e].half == 0) continue;
    int32_t first = (int32_t)fmax(ceil((place - room - low) / step), 0);
    for (int32_t p = first; p < count && low + step * p <= place + room; p++) {
      CwPlane plane = {{n[0], n[1], n[2]}, low + step * p};
      double near = fmax(1 - fabs(plane.offset - place) / model->edge[e].touch, 0);
      touch[p] = fmax(touch[p], has_no_corner(model, e, &plane) ? CW_PLAN_UNFIT : along * near);
    }
  }
}
