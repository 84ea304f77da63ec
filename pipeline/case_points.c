// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_points.h"

#include <math.h>
#include <stdio.h>

int cw_case_points(const CwCase *table, CwCasePoint points[CW_LIST_MOST]) {
  static const CwList shares_unless_given = {4, {0.6, 0.8, 1, 1.2}};
  const CwOperatingPoints *given = &table->operating_points;
  const CwList *shares = given->flow_shares.count ? &given->flow_shares : &shares_unless_given;
  const CwList *list = given->flow_rates.count ? &given->flow_rates : shares;
  const double unit = given->flow_rates.count ? 1 : table->operating_point.flow_rate;
  double number = -1; // thousandths of the flow, in the name
  for (int k = 0; k < list->count; ++k) {
    CwCasePoint *point = &points[k];
    point->flow = list->value[k] * unit;
    point->share = point->flow / table->operating_point.flow_rate;
    number = fmax(round(1000 * point->share), number + 1); // shares half a thousandth off may be rounded to one
    snprintf(point->name, sizeof point->name, "q%04.0f", number);
  }
  return list->count;
}
