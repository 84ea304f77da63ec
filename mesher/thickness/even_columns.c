// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/thickness/even_columns.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/network/periodic_images.h"
#include "mesher/common/vec.h"
#include "mesher/layers/thin_prism.h"
#include "mesher/parallel/parallel_for.h"
#include "mesher/thickness/layer_thickness.h"

static const double LEAST = 1.05 * CW_SMALL_DETERMINANT;   // asked for
static const double ENOUGH = 1.005 * CW_SMALL_DETERMINANT; // of columns as even as they may become
static const double STEP = 0.05;                           // of a first height, in a round
static const double LESS = 0.91, MORE = 1.09; // of the first height asked, within the tenth that counts as met
static const double SURE = 2; // times LEAST at both ends of columns: no prism between has less than that

// First height of the column as divided, m; fraction: of its layers.
static double divide(const CwColumnTargets *targets, const CwLayers *layers, int32_t v, double first,
                     double *fraction) {
  return cw_layer_fractions(layers->thickness[v], first, targets->layer_count, targets->growth[v], fraction);
}

void cw_column_determinants(const CwColumnTargets *targets, const CwSurfaceMesh *surface, const CwLayers *layers,
                            int32_t t, const double first[3], double *determinant) {
  double fraction[3][CW_LAYERS_MOST + 1], x[2][3][3];
  for (int k = 0; k < 3; k++) divide(targets, layers, layers->triangle[t][k], first[k], fraction[k]);
  for (int level = 0; level <= targets->layer_count; level++) {
    double(*base)[3] = x[(level + 1) % 2], (*top)[3] = x[level % 2];
    for (int k = 0; k < 3; k++) {
      int32_t v = layers->triangle[t][k];
      cw_lerp(surface->x[v], layers->top[v], fraction[k][level], top[k]);
    }
    if (level > 0)
      determinant[level - 1] = cw_prism_determinant((const double(*)[3])base, (const double(*)[3])top, level == 1);
  }
}

// Over columns that stay as they are; not small, or small whatever the division; small, and not so in more even
// columns.
typedef enum { FIXED, LEFT, SMALL } Judgement;

typedef struct {
  const CwSurfaceMesh *surface;
  const CwLayers *layers;
  const CwColumnTargets *targets;
  const int32_t *triangle; // to judge; NULL: all
} Columns;

// First height of the column as even as it may become: where the column has room for the one asked, within the tenth
// that counts as met.
static double even_first(const Columns *columns, int32_t v) {
  const CwColumnTargets *targets = columns->targets;
  double even = columns->layers->thickness[v] / targets->layer_count, asked = targets->first_height[v];
  double fraction[CW_LAYERS_MOST + 1], made = divide(targets, columns->layers, v, asked, fraction);
  return fmin(made < LESS * asked ? even : fmax(even, LESS * asked), MORE * asked);
}

// Least determinant of the prisms over a wall triangle whose columns have these first heights.
static double least_determinant(const Columns *columns, int32_t t, const double first[3]) {
  double determinant[CW_LAYERS_MOST], least = INFINITY;
  cw_column_determinants(columns->targets, columns->surface, columns->layers, t, first, determinant);
  for (int k = 0; k < columns->targets->layer_count; k++) least = fmin(least, determinant[k]);
  return least;
}

// Whether all layers over a wall triangle are so high that no prism can be small: one as low as the lowest is not,
// where the columns begin or where they end. Of layers that shrink the last is the lowest, and over their first at
// least the cube of what the mean is over that.
static int is_thick(const Columns *columns, int32_t t) {
  const CwLayers *layers = columns->layers;
  double wall[2][3][3], end[2][3][3];
  for (int k = 0; k < 3; k++) {
    int32_t v = layers->triangle[t][k];
    const double *x = columns->surface->x[v], *top = layers->top[v];
    double thickness = layers->thickness[v], first = columns->targets->first_height[v];
    double mean = fmin(thickness / (columns->targets->layer_count * first), 1);
    double share = first * mean * mean * mean / thickness;
    cw_copy(x, wall[0][k]);
    cw_lerp(x, top, share, wall[1][k]);
    cw_lerp(x, top, 1 - share, end[0][k]);
    cw_copy(top, end[1][k]);
  }
  return cw_prism_determinant((const double(*)[3])wall[0], (const double(*)[3])wall[1], 1) > SURE * LEAST &&
         cw_prism_determinant((const double(*)[3])end[0], (const double(*)[3])end[1], 0) > SURE * LEAST;
}

// Copies are as their first.
static CwStatus judge(void *context, int32_t i, void *out) {
  const Columns *columns = context;
  const CwSurfaceMesh *surface = columns->surface;
  const CwLayers *layers = columns->layers;
  uint8_t *made = out;
  int32_t t = columns->triangle ? columns->triangle[i] : i;
  const int32_t *corner = layers->triangle[t];
  double first[3];
  if (surface->source[t] != t) return CW_OK;
  if (cw_layers_pinched(layers, t) > 0) return CW_OK;
  if (is_thick(columns, t)) return CW_OK;
  *made = LEFT;
  for (int k = 0; k < 3; k++) first[k] = columns->layers->first_height[corner[k]];
  if (least_determinant(columns, t, first) >= LEAST) return CW_OK;
  for (int k = 0; k < 3; k++) first[k] = even_first(columns, corner[k]);
  if (least_determinant(columns, t, first) >= ENOUGH) *made = SMALL;
  return CW_OK;
}

// Evens the columns at the corners of small ones out, alike in all copies. Returns how many changed.
static int32_t even_marked(const Columns *columns, const uint8_t *mark, double *first_made) {
  double fraction[CW_LAYERS_MOST + 1];
  const CwNodeImages *nodes = &columns->surface->images;
  int32_t changed = 0;
  for (int32_t v = 0; v < columns->surface->vertex_count; v++) {
    if (cw_image_node_turns(nodes, v) > 0) continue;
    int marked = 0;
    for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) marked |= mark[at];
    if (!marked) continue;
    double even = even_first(columns, v), made = divide(columns->targets, columns->layers, v, first_made[v], fraction);
    double next = even < made ? fmax((1 - STEP) * made, even) : fmin((1 + STEP) * made, even);
    changed += next != first_made[v];
    for (int32_t at = v; at >= 0; at = cw_image_after(nodes, at, v)) first_made[at] = next;
  }
  return changed;
}

// Where layers taper their first height is lost in the end: they keep their growth instead, so that the last layer is
// the tallest of them, beside tetrahedra as tall as its edges are long.
static void keep_growth(const CwColumnTargets *targets, CwLayers *layers) {
  for (int32_t v = 0; v < targets->vertex_count; v++) {
    if (layers->reason[v] != CW_LAYER_TAPER) continue;
    double most = layers->thickness[v] / cw_layer_thickness(1, targets->layer_count, targets->growth[v]);
    layers->first_height[v] = fmin(layers->first_height[v], most);
  }
}

CwStatus cw_columns_divide(const CwContext *context, const CwColumnTargets *targets, const CwSurfaceMesh *surface,
                           CwLayers *layers) {
  CwStatus status = CW_OK;
  Columns columns = {surface, layers, targets, NULL};
  int32_t *list = NULL, count = surface->triangle_count, kept = 0, changed;
  uint8_t *judgement = NULL, *mark = NULL;
  CW_NEW_UNSET(layers->first_height, surface->vertex_count);
  memcpy(layers->first_height, targets->first_height, (size_t)surface->vertex_count * sizeof *layers->first_height);
  keep_growth(targets, layers);
  CW_NEW(judgement, count);
  CW_NEW(mark, surface->vertex_count);
  CW_NEW_UNSET(list, count);
  CW_TRY(cw_parallel_for(context, "thicknesses: small prisms", count, sizeof *judgement, judge, &columns, judgement));
  for (int32_t t = 0; t < count; t++) {
    if (judgement[t] == FIXED) continue;
    judgement[kept] = judgement[t];
    list[kept++] = t;
  }
  columns.triangle = list;
  do {
    memset(mark, 0, (size_t)surface->vertex_count);
    for (int32_t i = 0; i < kept; i++) {
      for (int k = 0; k < 3 && judgement[i] == SMALL; k++) mark[layers->triangle[list[i]][k]] = 1;
    }
    changed = even_marked(&columns, mark, layers->first_height);
    if (changed)
      CW_TRY(
          cw_parallel_for(context, "thicknesses: small prisms", kept, sizeof *judgement, judge, &columns, judgement));
  } while (changed);
done:
  free(list);
  free(judgement);
  free(mark);
  return status;
}
