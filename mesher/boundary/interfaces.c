// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/interfaces.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vtk.h"

// An edge of an outline's triangles (use 1) or of its loops (use 1 as well: so each edge has two uses).
typedef struct {
  int32_t low, high;
} Edge;

static int by_ends(const void *p, const void *q) {
  const Edge *a = p, *b = q;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  return (a->high > b->high) - (a->high < b->high);
}

static Edge edge_of(int32_t a, int32_t b) {
  return (Edge){a < b ? a : b, a < b ? b : a};
}

static CwStatus audit_corners(const CwInterfaces *interfaces, const char *what, int32_t count,
                              const int32_t (*triangle)[3]) {
  CwStatus status = CW_OK;
  for (int32_t t = 0; t < count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t v = triangle[t][k];
      CW_REQUIRE(v >= 0 && v < interfaces->nodes.count && v != triangle[t][(k + 1) % 3], CW_ERR_FAULT,
                 "%s: triangle %d has the corners %d, %d, %d of %d nodes", what, t, triangle[t][0], triangle[t][1],
                 triangle[t][2], interfaces->nodes.count);
    }
  }
done:
  return status;
}

// The triangles from .. from + count - 1 of an outline, and its loops: each edge has two uses.
static CwStatus audit_outline(const CwInterfaces *interfaces, const CwInterfaceOutline *outline,
                              const CwInterfaceTriangles *of, int32_t from, int32_t count) {
  CwStatus status = CW_OK;
  Edge *edge = NULL;
  size_t edges = 0;
  CW_REQUIRE(from >= 0 && count > 0 && from + count <= of->count, CW_ERR_FAULT,
             "interfaces: an outline on plane %d has the triangles %d to %d of %d", outline->node, from,
             from + count - 1, of->count);
  CW_NEW(edge, 3 * (size_t)count + (size_t)outline->corner_count);
  for (int32_t t = from; t < from + count; t++) {
    for (int k = 0; k < 3; k++) edge[edges++] = edge_of(of->triangle[t][k], of->triangle[t][(k + 1) % 3]);
  }
  for (int32_t l = 0; l < outline->loop_count; l++) {
    int32_t first = outline->loop_start[l], corners = outline->loop_start[l + 1] - first;
    for (int32_t k = 0; k < corners; k++)
      edge[edges++] = edge_of(outline->corner[first + k], outline->corner[first + (k + 1) % corners]);
  }
  qsort(edge, edges, sizeof *edge, by_ends);
  for (size_t i = 0, uses; i < edges; i += uses) {
    uses = 1;
    while (i + uses < edges && !by_ends(&edge[i], &edge[i + uses])) uses++;
    CW_REQUIRE(uses == 2, CW_ERR_FAULT,
               "interfaces: on plane %d the edge from (%.3f, %.3f, %.3f) to (%.3f, %.3f, %.3f) mm is used %zu times by "
               "triangles and loops; 2 are allowed",
               outline->node, CW_MM(interfaces->nodes.x[edge[i].low]), CW_MM(interfaces->nodes.x[edge[i].high]), uses);
  }
done:
  free(edge);
  return status;
}

static CwStatus audit_triangles(const CwInterfaces *interfaces, const CwInterfaceTriangles *of, int32_t regions) {
  CwStatus status = CW_OK;
  CW_TRY(audit_corners(interfaces, "interfaces", of->count, (const int32_t(*)[3])of->triangle));
  for (int32_t t = 0; t < of->count; t++) {
    const int32_t *region = of->region[t];
    CW_REQUIRE(region[0] != region[1] && region[0] >= 0 && region[1] >= 0 && region[0] < regions && region[1] < regions,
               CW_ERR_FAULT, "interfaces: triangle %d lies between the regions %d and %d of %d", t, region[0],
               region[1], regions);
  }
done:
  return status;
}

CwStatus cw_interfaces_audit(const CwInterfaces *interfaces, int32_t regions) {
  CwStatus status = CW_OK;
  const CwInterfaceTriangles *planned = cw_interfaces_of(interfaces, 1);
  CW_TRY(audit_corners(interfaces, "open patches", interfaces->open_patch.count,
                       (const int32_t(*)[3])interfaces->open_patch.triangle));
  for (int32_t t = 0; t < interfaces->open_patch.count; t++) {
    CW_REQUIRE(interfaces->open_patch.region[t] >= 0 && interfaces->open_patch.region[t] < regions, CW_ERR_FAULT,
               "open patches: triangle %d lies in region %d of %d", t, interfaces->open_patch.region[t], regions);
  }
  CW_TRY(audit_triangles(interfaces, &interfaces->refined, regions));
  if (planned != &interfaces->refined) CW_TRY(audit_triangles(interfaces, planned, regions));
  for (int32_t i = 0; i < interfaces->outline_count; i++) {
    const CwInterfaceOutline *outline = &interfaces->outline[i];
    CW_TRY(audit_outline(interfaces, outline, planned, outline->triangle_start, outline->triangle_count));
    if (planned == &interfaces->refined) continue;
    CW_TRY(audit_outline(interfaces, outline, &interfaces->refined, outline->refined_start, outline->refined_count));
  }
done:
  return status;
}

CwStatus cw_interfaces_vtk(const CwInterfaces *interfaces, const char *path) {
  CwStatus status = CW_OK;
  const CwOpenPatches *open_patch = &interfaces->open_patch;
  const CwInterfaceTriangles *refined = &interfaces->refined;
  int32_t count = open_patch->count + refined->count, (*triangle)[3] = NULL, *face = NULL, *region = NULL;
  CW_NEW(triangle, count);
  CW_NEW(face, count);
  CW_NEW(region, count);
  for (int32_t t = 0; t < count; t++) {
    int32_t on = t - open_patch->count;
    memcpy(triangle[t], on < 0 ? open_patch->triangle[t] : refined->triangle[on], sizeof triangle[t]);
    face[t] = on < 0 ? open_patch->face[t] : -1;
    if (on < 0) {
      region[t] = open_patch->region[t];
    } else {
      region[t] = refined->region[on][refined->region[on][1] < refined->region[on][0]];
    }
  }
  const CwVtkField field[2] = {{"face", face, NULL}, {"region", region, NULL}};
  const CwVtkTriangles triangles = {.title = "open patches and interfaces",
                                    .point_count = interfaces->nodes.count,
                                    .x = (const double(*)[3])interfaces->nodes.x,
                                    .triangle_count = count,
                                    .triangle = (const int32_t(*)[3])triangle,
                                    .field_count = 2,
                                    .field = field};
  CW_TRY(cw_vtk_write(path, &triangles));
done:
  free(triangle);
  free(face);
  free(region);
  return status;
}

void cw_interfaces_arrays(void *product, CwArrayVisit visit, void *given) {
  CwInterfaces *interfaces = product;
  CwOpenPatches *open_patch = &interfaces->open_patch;
  cw_node_table_arrays(&interfaces->nodes, visit, given);
  cw_node_images_arrays(&interfaces->images, visit, given);
  cw_outlines_arrays(interfaces->outline_count, &interfaces->outline, &interfaces->outline_images, visit, given);
  CW_SHOW(visit, given, open_patch->triangle, open_patch->count);
  CW_SHOW(visit, given, open_patch->face, open_patch->count);
  CW_SHOW(visit, given, open_patch->region, open_patch->count);
  for (int planned = 0; planned < 2; planned++) {
    CwInterfaceTriangles *triangles = planned ? &interfaces->planned : &interfaces->refined;
    CW_SHOW(visit, given, triangles->triangle, triangles->count);
    CW_SHOW(visit, given, triangles->region, triangles->count);
  }
}

void cw_interfaces_free(CwInterfaces *interfaces) {
  cw_arrays_free(interfaces, cw_interfaces_arrays, &interfaces->memory);
  memset(interfaces, 0, sizeof *interfaces);
}
