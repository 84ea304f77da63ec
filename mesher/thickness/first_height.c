// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/first_height.h"

#include <math.h>

#include "mesher/policy.h"
#include "mesher/thickness/layer_thickness.h"

double cw_thickness_given(const CwWalls *walls, const CwWallGroup *group) {
  return cw_case_given(group->total_thickness) ? group->total_thickness : walls->total_thickness;
}

double cw_column_room(const CwWallFlow *flow) {
  double across = cw_policy.gap_share * flow->width;
  return flow->before > 0 ? fmin(across, cw_policy.free_share * flow->before) : across;
}

// The greatest first height that fits: of as many even layers as there are at least, in fit_share of the passage;
// before an open patch, where one end of a wall is short of room, of the lowest column of all layers.
static double greatest_fitting(const CwWallFlow *flow, const CwWalls *walls, int count) {
  double across = cw_policy.fit_share * flow->width / (walls->layer_count > 0 ? count : CW_LAYERS_LEAST);
  if (flow->before == 0) return across;
  return fmin(across, cw_policy.free_share * flow->before / cw_layer_lowest(count));
}

CwFirstHeight cw_first_height_choose(const CwCase *table, const CwWallGroup *group, const CwWallFlow *flow,
                                     double y_plus_auto, int layer_count) {
  const CwWalls *walls = &table->walls;
  double viscosity = table->fluid.kinematic_viscosity;
  double speed = cw_case_given(group->velocity) ? group->velocity : flow->speed;
  double unit = cw_first_height(1, speed, flow->length, viscosity, walls->y_plus_at == CW_Y_PLUS_AT_CELL_CENTRE);
  double fitting = greatest_fitting(flow, walls, layer_count);
  double total = cw_thickness_given(walls, group),
         thin = total / cw_layer_lowest(layer_count); // NAN where that is open
  CwFirstHeight first = {.reynolds = speed * flow->diameter / viscosity, .source = CW_FIRST_ASKED};
  if (cw_case_given(group->first_height)) {
    first.asked = group->first_height;
  } else if (cw_case_given(group->y_plus)) {
    first.asked = unit * group->y_plus;
  } else {
    double roomy = cw_policy.gap_share * flow->width / cw_layer_thickness(1, CW_LAYER_COUNT_USUAL, 1 + cw_policy.slope);
    first.asked = fmin(unit * y_plus_auto, roomy);
    if (flow->before > 0) first.asked = fmin(first.asked, cw_column_room(flow) / layer_count);
    first.source = CW_FIRST_AUTO;
  }
  int laminar = first.reynolds < CW_LAMINAR_REYNOLDS;
  first.height = first.asked;
  if (laminar && !cw_case_given(group->first_height)) {
    first.height = CW_LAMINAR_SHARE * flow->width;
    if (flow->before > 0) first.height = fmin(first.height, cw_column_room(flow) / layer_count);
    first.source = CW_FIRST_LAMINAR;
  }
  // And the lowest column of so many layers is no higher than all of them may be.
  if (thin < fmin(first.height, fitting)) {
    fitting = thin;
    first.total = total;
  }
  if (first.height > fitting) {
    first.height = fitting;
    if (first.source != CW_FIRST_LAMINAR) first.source = CW_FIRST_FITTED;
  }
  first.y_plus = laminar ? NAN : first.height / unit;
  return first;
}
