// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/box.h"

void cw_box_add(CwBox *sum, const CwBox *box) {
  for (int k = 0; k < 3; k++) {
    if (box->low[k] < sum->low[k]) sum->low[k] = box->low[k];
    if (box->high[k] > sum->high[k]) sum->high[k] = box->high[k];
  }
}

CwBox cw_box_of_points(int32_t count, const double (*x)[3]) {
  CwBox box = cw_box_empty();
  for (int32_t p = 0; p < count; p++) cw_box_add_point(&box, x[p]);
  return box;
}

double cw_box_longest(const CwBox *box) {
  double longest = 0.0;
  for (int k = 0; k < 3; k++) longest = fmax(longest, box->high[k] - box->low[k]);
  return longest;
}
