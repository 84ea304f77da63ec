// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/layer_count.h"

#include <math.h>

#include "mesher/policy.h"
#include "mesher/thickness/layer_thickness.h"

int cw_layer_count(double first, double growth, double size) {
  double last = CW_LAST_LAYER_ENOUGH * CW_REGULAR_HEIGHT * size;
  if (last <= first) return 1;
  return (int)fmin(1 + ceil(log(last / first) / log(growth) - 1e-9), CW_LAYERS_MOST);
}

int cw_layer_count_fitting(double first, double growth, double thickness) {
  int count = 1;
  while (count < CW_LAYERS_MOST && cw_layer_thickness(first, count + 1, growth) <= thickness) count++;
  return count;
}

int cw_layer_count_for(const double needing[CW_LAYERS_MOST + 1]) {
  double all = 0, enough = 0;
  for (int n = 1; n <= CW_LAYERS_MOST; n++) all += needing[n];
  for (int n = 1; n < CW_LAYERS_MOST; n++) {
    enough += needing[n];
    if (enough >= cw_policy.layer_count_share * all) return n;
  }
  return CW_LAYERS_MOST;
}
