// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_copy.h"

#include <stdio.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vec.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/hash.h"

static const double SAME_POINT = 1e-9; // of the model's unit

static int32_t copied_region(const CwRegionContext *context, int32_t first, int32_t turns) {
  return cw_image_region(context->from.in->images, context->from.in->plan, first, turns);
}

void cw_region_copy_fingerprint(const CwRegionContext *context, const CwRegionMesh *first, int32_t turns,
                                char fingerprint[CW_HASH_TEXT]) {
  char own[33];
  CwHash hash = cw_hash_start();
  cw_region_fingerprint(context, copied_region(context, first->region - 1, turns), own);
  cw_hash_bytes(&hash, first->fingerprint, sizeof own - 1);
  cw_hash_bytes(&hash, own, sizeof own - 1);
  cw_hash_hex(&hash, fingerprint);
}

// The boundary node under a shared number: the last whose base is not greater.
static int32_t node_of(const CwRegionContext *context, int64_t id) {
  int32_t low = 0, high = context->shared->shared_node_count;
  while (high - low > 1) {
    int32_t middle = low + (high - low) / 2;
    if (context->shared->base[context->shared->node[middle]] <= id) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return context->shared->node[low];
}

// Number and place of the shared point that `turns` turns make of `id`, which may be *turned.
static CwStatus turned_point(const CwRegionContext *context, int64_t id, int32_t turns, int64_t *turned, double x[3]) {
  CwStatus status = CW_OK;
  const CwRegionInput *from = &context->from;
  int32_t first = node_of(context, id), node = cw_image_node(&from->interfaces->images, first, turns);
  int64_t level = id - context->shared->base[first];
  CW_REQUIRE(node >= 0, CW_ERR_FAULT, "%s: a shared point at (%.3f, %.3f, %.3f) mm has no periodic image",
             context->domain, CW_MM(from->interfaces->nodes.x[first]));
  *turned = context->shared->base[node] + level;
  if (node < from->surface->vertex_count && level < context->layer_count) {
    double fraction[CW_LAYERS_MOST + 1];
    cw_layer_fractions(from->layers->thickness[node], context->first_height[node], context->layer_count,
                       context->growth[node], fraction);
    cw_column_place(from, &context->open_edge_places, node, fraction[level], x);
  } else {
    cw_copy(from->interfaces->nodes.x[node], x);
  }
done:
  return status;
}

CwStatus cw_region_turn(const CwRegionContext *context, int32_t turns, int32_t number, const char *fingerprint,
                        CwRegionMesh *mesh) {
  CwStatus status = CW_OK;
  CwRegionData *cells = &mesh->cells;
  mesh->region = copied_region(context, mesh->region - 1, turns) + 1;
  mesh->number = number;
  snprintf(mesh->fingerprint, sizeof mesh->fingerprint, "%s", fingerprint);
  for (int32_t i = 0; i < cells->point_count; i++) {
    double turned[3];
    cw_image_point(context->from.in->images, turns, cells->points[i], turned);
    cw_copy(turned, cells->points[i]);
    if (i >= cells->shared_count) continue;
    CW_TRY(turned_point(context, cells->shared_id[i], turns, &cells->shared_id[i], cells->points[i]));
    CW_REQUIRE(cw_distance(turned, cells->points[i]) < SAME_POINT, CW_ERR_FAULT,
               "%s region %d: a shared point at (%.3f, %.3f, %.3f) mm lies %.3g mm off its periodic image",
               context->domain, mesh->region, CW_MM(turned), cw_mm(cw_distance(turned, cells->points[i])));
  }
done:
  return status;
}
