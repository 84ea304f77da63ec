// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_cuts.h"

#include <stdlib.h>
#include <string.h>

enum { OTHER = -1, MANY = -2 };

// The two neighbours of each point along cuts; MANY in the first where more meet.
static CwStatus join_edges(const CwPatchInput *input, int32_t (**next)[2]) {
  CwStatus status = CW_OK;
  CW_NEW(*next, input->point_count);
  memset(*next, 0xff, (size_t)input->point_count * sizeof **next); // OTHER
  for (int32_t e = 0; e < input->edge_count; e++) {
    if (input->boundary[e]) continue;
    for (int k = 0; k < 2; k++) {
      int32_t *of = (*next)[input->edge[e][k]];
      int32_t far = input->edge[e][1 - k];
      if (of[0] == OTHER)
        of[0] = far;
      else if (of[1] == OTHER && of[0] != MANY)
        of[1] = far;
      else
        of[0] = MANY;
    }
  }
done:
  return status;
}

static int is_inside(const int32_t next[2]) {
  return next[0] >= 0 && next[1] >= 0;
}

CwStatus cw_patch_cuts_make(const CwPatchInput *input, CwPatchCuts *cuts) {
  CwStatus status = CW_OK;
  int32_t(*next)[2] = NULL;
  *cuts = (CwPatchCuts){.point_count = input->point_count};
  CW_NEW(cuts->cut, input->point_count);
  CW_NEW(cuts->end, input->point_count);
  memset(cuts->cut, 0xff, (size_t)input->point_count * sizeof *cuts->cut);
  CW_TRY(join_edges(input, &next));
  for (int32_t p = 0; p < input->point_count; p++) {
    if (cuts->cut[p] >= 0 || !is_inside(next[p])) continue;
    int32_t number = cuts->cut_count++;
    cuts->cut[p] = number;
    for (int side = 0; side < 2; side++) {
      int32_t from = p, at = next[p][side];
      while (is_inside(next[at]) && cuts->cut[at] < 0) {
        cuts->cut[at] = number;
        int32_t on = next[at][0] == from ? next[at][1] : next[at][0];
        from = at;
        at = on;
      }
      cuts->end[number][side] = is_inside(next[at]) ? -1 : at;
    }
  }
done:
  free(next);
  if (status != CW_OK) cw_patch_cuts_free(cuts);
  return status;
}

void cw_patch_cuts_free(CwPatchCuts *cuts) {
  free(cuts->cut);
  free(cuts->end);
  *cuts = (CwPatchCuts){0};
}

int cw_patch_cuts_hold(const CwPatchCuts *cuts, const int32_t point[3]) {
  int32_t number = -1;
  for (int k = 0; k < 3; k++) {
    if (point[k] >= cuts->point_count) return 0;
    if (cuts->cut[point[k]] >= 0) number = cuts->cut[point[k]];
  }
  if (number < 0) return 0;
  for (int k = 0; k < 3; k++) {
    const int32_t *end = cuts->end[number];
    if (cuts->cut[point[k]] != number && point[k] != end[0] && point[k] != end[1]) return 0;
  }
  return 1;
}
