// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_slices.h"

#include <math.h>
#include <stdlib.h>

enum {
  STEPS = CW_SLICE_STEPS,
  LEAST = STEPS - STEPS / 2,
  WINDOW = 3, // slices to either side of its even place in which a plane is looked for
  BAND = 2 * WINDOW * STEPS + 1
};

// The band of steps in which plane i is looked for begins here.
static int32_t band_of(int32_t i) {
  return (i - WINDOW) * STEPS;
}

CwStatus cw_slices_place(int32_t slices, const double *slice_cost, const double *place_cost, int32_t *step,
                         double *cost) {
  CwStatus status = CW_OK;
  int32_t steps = slices * STEPS;
  double least[2][BAND]; // of a plane and the one before, in their bands
  int8_t(*longer)[BAND]; // of each plane, by how many steps the slice before it is longer than an even one
  CW_NEW(longer, slices + 1);
  for (int k = 0; k < BAND; k++) least[0][k] = k == -band_of(0) ? 0 : INFINITY;
  for (int32_t i = 1; i <= slices; i++) {
    double *now = least[i % 2], *before = least[(i - 1) % 2];
    int32_t first = band_of(i), last = i < slices ? first + BAND - 1 : steps, low = first - STEPS;
    for (int k = 0; k < BAND; k++) now[k] = INFINITY;
    for (int32_t s = i < slices ? (first > i ? first : i) : steps; s <= last && s <= steps; s++) {
      for (int32_t b = s - LEAST; b >= 0 && b >= s - CW_SLICE_MOST && b >= low; b--) {
        if (b >= low + BAND) continue;
        double sum = before[b - low] + slice_cost[s - b] + place_cost[s];
        if (sum < now[s - first]) now[s - first] = sum, longer[i][s - first] = (int8_t)(s - b - STEPS);
      }
    }
  }
  *cost = least[slices % 2][steps - band_of(slices)];
  step[0] = 0;
  for (int32_t i = slices, s = steps; i > 0; i--) step[i] = s, s -= STEPS + longer[i][s - band_of(i)];
done:
  free(longer);
  return status;
}
