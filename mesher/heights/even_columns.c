// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/heights/even_columns.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/heights/layer_heights.h"
#include "mesher/layers/thin_prism.h"
#include "mesher/parallel/share.h"

static const double LEAST = 1.05 * CW_SMALL_DETERMINANT; // asked for
static const double STEP = 0.05;                         // of a first height, in a round

// First height of the column as divided, m; fraction: of its layers.
static double divide(const CwColumnHeights *heights, const CwSkeleton *skeleton, int32_t v, double first,
                     double *fraction) {
  return cw_layer_fractions(skeleton->height[v], first, heights->layer_count, heights->growth[v], fraction);
}

void cw_column_determinants(const CwColumnHeights *heights, const CwSkeleton *skeleton, int32_t t,
                            const double first[3], double *determinant) {
  double fraction[3][CW_LAYERS_MOST + 1], x[2][3][3];
  for (int k = 0; k < 3; k++) divide(heights, skeleton, skeleton->wall_triangle[t][k], first[k], fraction[k]);
  for (int level = 0; level <= heights->layer_count; level++) {
    double(*base)[3] = x[(level + 1) % 2], (*top)[3] = x[level % 2];
    for (int k = 0; k < 3; k++) {
      int32_t v = skeleton->wall_triangle[t][k];
      cw_lerp(skeleton->wall_x[v], skeleton->front[v], fraction[k][level], top[k]);
    }
    if (level > 0)
      determinant[level - 1] = cw_prism_determinant((const double(*)[3])base, (const double(*)[3])top, level == 1);
  }
}

// Over columns that stay as they are; not small, or small whatever the division; small, and not so in even columns.
typedef enum { FIXED, LEFT, SMALL } Judgement;

typedef struct {
  const CwSkeleton *skeleton;
  const CwColumnHeights *heights;
  const int32_t *triangle; // to judge; NULL: all
} Columns;

// First height of the column as even as it may become: one whose layers grow stays as it is.
static double even_first(const Columns *columns, int32_t v) {
  const CwColumnHeights *heights = columns->heights;
  return fmin(columns->skeleton->height[v] / heights->layer_count, heights->first_height[v]);
}

// Least determinant of the prisms over a wall triangle whose columns have these first heights.
static double least_determinant(const Columns *columns, int32_t t, const double first[3]) {
  double determinant[CW_LAYERS_MOST], least = INFINITY;
  cw_column_determinants(columns->heights, columns->skeleton, t, first, determinant);
  for (int k = 0; k < columns->heights->layer_count; k++) least = fmin(least, determinant[k]);
  return least;
}

static int is_short(const Columns *columns, int32_t v) {
  const CwColumnHeights *heights = columns->heights;
  return columns->skeleton->height[v] < heights->layer_count * heights->first_height[v];
}

// Copies are as their first.
static CwStatus judge(void *context, int32_t i, void *out) {
  const Columns *columns = context;
  const CwSkeleton *skeleton = columns->skeleton;
  uint8_t *made = out;
  int32_t t = columns->triangle ? columns->triangle[i] : i;
  const int32_t *corner = skeleton->wall_triangle[t];
  double first[3];
  if (skeleton->wall_source[t] != t) return CW_OK;
  if (!is_short(columns, corner[0]) && !is_short(columns, corner[1]) && !is_short(columns, corner[2])) return CW_OK;
  *made = LEFT;
  for (int k = 0; k < 3; k++) first[k] = columns->heights->first_made[corner[k]];
  if (least_determinant(columns, t, first) >= LEAST) return CW_OK;
  for (int k = 0; k < 3; k++) first[k] = even_first(columns, corner[k]);
  if (least_determinant(columns, t, first) >= LEAST) *made = SMALL;
  return CW_OK;
}

// Evens the columns at the corners of small ones out, alike in all copies.
static void even_marked(const Columns *columns, const uint8_t *mark, double *first_made) {
  double fraction[CW_LAYERS_MOST + 1];
  const CwSkeletonOrbits *orbits = &columns->skeleton->orbits;
  for (int32_t v = 0; v < columns->skeleton->wall_count; v++) {
    if (cw_orbit_node_turns(orbits, v) > 0) continue;
    int marked = mark[v];
    for (int32_t at = cw_orbit_node(orbits, v, 1); at >= 0 && at != v; at = cw_orbit_node(orbits, at, 1))
      marked |= mark[at];
    if (!marked) continue;
    first_made[v] = fmax((1 - STEP) * divide(columns->heights, columns->skeleton, v, first_made[v], fraction),
                         even_first(columns, v));
    for (int32_t at = cw_orbit_node(orbits, v, 1); at >= 0 && at != v; at = cw_orbit_node(orbits, at, 1))
      first_made[at] = first_made[v];
  }
}

CwStatus cw_column_heights_even(CwColumnHeights *heights, const CwSkeleton *skeleton) {
  CwStatus status = CW_OK;
  Columns columns = {skeleton, heights, NULL};
  int32_t *list = NULL, count = skeleton->wall_triangle_count, kept = 0;
  uint8_t *judgement = NULL, *mark = NULL;
  CW_NEW_UNSET(heights->first_made, skeleton->wall_count);
  memcpy(heights->first_made, heights->first_height, (size_t)skeleton->wall_count * sizeof *heights->first_made);
  CW_NEW(judgement, count);
  CW_NEW(mark, skeleton->wall_count);
  CW_NEW_UNSET(list, count);
  CW_TRY(cw_share("heights: small prisms", count, sizeof *judgement, judge, &columns, judgement));
  for (int32_t t = 0; t < count; t++) {
    if (judgement[t] == FIXED) continue;
    judgement[kept] = judgement[t];
    list[kept++] = t;
  }
  columns.triangle = list;
  for (;;) {
    int small = 0;
    memset(mark, 0, (size_t)skeleton->wall_count);
    for (int32_t i = 0; i < kept; i++) {
      if (judgement[i] != SMALL) continue;
      for (int k = 0; k < 3; k++) mark[skeleton->wall_triangle[list[i]][k]] = 1;
      small = 1;
    }
    if (!small) break;
    even_marked(&columns, mark, heights->first_made);
    CW_TRY(cw_share("heights: small prisms", kept, sizeof *judgement, judge, &columns, judgement));
  }
done:
  free(list);
  free(judgement);
  free(mark);
  return status;
}
