// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_number.h"

#include <stdlib.h>

CwStatus cw_region_numbers(int32_t region_count, int32_t pair_count, const int32_t (*pair)[2], int32_t *number,
                           int32_t *colour_out, int32_t *colours) {
  CwStatus status = CW_OK;
  int32_t *degree = NULL, *order = NULL, *colour = NULL;
  uint8_t *taken = NULL;
  CW_NEW(degree, region_count);
  CW_NEW(order, region_count);
  CW_NEW(colour, region_count);
  CW_NEW(taken, region_count + 1);
  for (int32_t p = 0; p < pair_count; p++) {
    degree[pair[p][0]]++;
    degree[pair[p][1]]++;
  }
  // Largest degree first (Welsh and Powell); insertion sort keeps ties in index order.
  for (int32_t r = 0; r < region_count; r++) {
    int32_t place = r;
    while (place > 0 && degree[order[place - 1]] < degree[r]) {
      order[place] = order[place - 1];
      place--;
    }
    order[place] = r;
    colour[r] = -1;
  }
  *colours = 0;
  for (int32_t k = 0; k < region_count; k++) {
    int32_t r = order[k];
    for (int32_t c = 0; c <= region_count; c++) taken[c] = 0;
    for (int32_t p = 0; p < pair_count; p++) {
      for (int end = 0; end < 2; end++) {
        if (pair[p][end] == r && colour[pair[p][!end]] >= 0) taken[colour[pair[p][!end]]] = 1;
      }
    }
    int32_t c = 0;
    while (taken[c]) c++;
    colour[r] = c;
    if (c + 1 > *colours) *colours = c + 1;
  }
  int32_t next = 1;
  for (int32_t c = 0; c < *colours; c++) {
    for (int32_t r = 0; r < region_count; r++) {
      if (colour[r] == c) number[r] = next++;
    }
  }
  if (colour_out) {
    for (int32_t r = 0; r < region_count; r++) colour_out[r] = colour[r];
  }
done:
  free(degree);
  free(order);
  free(colour);
  free(taken);
  return status;
}
