// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_task.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"

CwStatus cw_outline_start(CwPatchOutline *outline, int32_t node_count) {
  CwStatus status = CW_OK;
  memset(outline, 0, sizeof *outline);
  CW_NEW_UNSET(outline->local, node_count);
  for (int32_t i = 0; i < node_count; i++) outline->local[i] = -1;
done:
  return status;
}

void cw_outline_clear(CwPatchOutline *outline) {
  for (int32_t i = 0; i < outline->point_count; i++) outline->local[outline->node[i]] = -1;
  outline->point_count = outline->edge_count = 0;
}

CwStatus cw_outline_point(CwPatchOutline *outline, int32_t node, const double uv[2], const double x[3],
                          int32_t *local) {
  CwStatus status = CW_OK;
  if (outline->local[node] < 0) {
    int32_t k = outline->point_count;
    CW_GROW(outline->node, outline->node_capacity, k + 1);
    CW_GROW(outline->uv, outline->uv_capacity, k + 1);
    CW_GROW(outline->x, outline->x_capacity, k + 1);
    outline->local[node] = outline->point_count++;
    outline->node[k] = node;
    memcpy(outline->uv[k], uv, sizeof outline->uv[k]);
    cw_copy(x, outline->x[k]);
  }
  *local = outline->local[node];
done:
  return status;
}

CwStatus cw_outline_edge(CwPatchOutline *outline, int32_t a, int32_t b, int boundary) {
  CwStatus status = CW_OK;
  CW_GROW(outline->edge, outline->edge_capacity, outline->edge_count + 1);
  CW_GROW(outline->boundary, outline->boundary_capacity, outline->edge_count + 1);
  outline->edge[outline->edge_count][0] = a;
  outline->edge[outline->edge_count][1] = b;
  outline->boundary[outline->edge_count++] = (uint8_t)boundary;
done:
  return status;
}

CwStatus cw_outline_next(CwPatchOutline *outline, int32_t node, const double uv[2], const double x[3], int boundary,
                         int32_t *previous) {
  CwStatus status = CW_OK;
  int32_t local = -1;
  CW_TRY(cw_outline_point(outline, node, uv, x, &local));
  if (*previous >= 0) CW_TRY(cw_outline_edge(outline, *previous, local, boundary));
  *previous = local;
done:
  return status;
}

void cw_outline_free(CwPatchOutline *outline) {
  free(outline->node);
  free(outline->uv);
  free(outline->x);
  free(outline->edge);
  free(outline->boundary);
  free(outline->local);
  memset(outline, 0, sizeof *outline);
}

// Of the way from the middle of a flat triangle to the surface.
static const double TOWARDS_SURFACE = 0.01;

// The label of each component: that of the middle of its largest triangle. Where that triangle lies in the plane that
// cuts the component off, the side on which the surface lies decides.
static CwStatus component_labels(const CwPatchMesh *mesh, CwSurfaceAt surface, const void *surface_context,
                                 CwLabelAt label, const void *context, int32_t *result) {
  CwStatus status = CW_OK;
  double *largest = NULL;
  CW_NEW(largest, mesh->component_count);
  for (int32_t t = 0; t < mesh->triangle_count; t++) {
    const int32_t *corner = mesh->triangle[t];
    double n[3], uv[2], middle[3];
    cw_normal(mesh->x[corner[0]], mesh->x[corner[1]], mesh->x[corner[2]], n);
    double area = cw_norm(n);
    int32_t component = mesh->component[t];
    if (area <= largest[component]) continue;
    largest[component] = area;
    for (int k = 0; k < 2; k++) uv[k] = (mesh->uv[corner[0]][k] + mesh->uv[corner[1]][k] + mesh->uv[corner[2]][k]) / 3;
    surface(surface_context, uv, middle, NULL, NULL);
    for (int k = 0; k < 3; k++) {
      double flat = (mesh->x[corner[0]][k] + mesh->x[corner[1]][k] + mesh->x[corner[2]][k]) / 3;
      middle[k] = flat + TOWARDS_SURFACE * (middle[k] - flat);
    }
    result[component] = label(context, middle);
  }
done:
  free(largest);
  return status;
}

// The packed form: counts of outline points, new points and triangles, and the outcome; then coordinates, nodes of the
// outline, triangles, labels.
enum { COUNTS = 16, HEADER = COUNTS + sizeof(CwOutcome) };

CwStatus cw_patch_task(const CwPatchOutline *outline, CwSurfaceAt surface, const void *surface_context, CwSizeAt size,
                       const void *size_context, double largest, int turned, CwLabelAt label, const void *label_context,
                       const char *name, void **bytes, int64_t *size_of_bytes) {
  CwStatus status = CW_OK;
  CwPatchMesh mesh = {0};
  CwOutcome outcome = {0};
  int32_t *labels = NULL;
  char *block = NULL;
  CwPatchInput input = {.surface = surface,
                        .surface_context = surface_context,
                        .size = size,
                        .size_context = size_context,
                        .point_count = outline->point_count,
                        .uv = (const double(*)[2])outline->uv,
                        .x = (const double(*)[3])outline->x,
                        .edge_count = outline->edge_count,
                        .edge = (const int32_t(*)[2])outline->edge,
                        .boundary = outline->boundary,
                        .name = name,
                        .largest = largest};
  CW_TRY(cw_patch_mesh(&input, &mesh, &outcome));
  CW_NEW(labels, mesh.component_count);
  CW_TRY(component_labels(&mesh, surface, surface_context, label, label_context, labels));
  int32_t fresh = outcome.kind == CW_OUTCOME_DONE ? mesh.point_count - outline->point_count : 0;
  size_t nodes = (size_t)outline->point_count * sizeof *outline->node;
  size_t total = HEADER + (size_t)fresh * 24 + nodes + (size_t)mesh.triangle_count * 16;
  CW_NEW(block, total);
  int32_t header[3] = {outline->point_count, fresh, mesh.triangle_count};
  memcpy(block, header, sizeof header);
  memcpy(block + COUNTS, &outcome, sizeof outcome);
  char *at = block + HEADER;
  if (fresh > 0) memcpy(at, mesh.x + outline->point_count, (size_t)fresh * 24);
  at += (size_t)fresh * 24;
  memcpy(at, outline->node, nodes);
  at += nodes;
  for (int32_t t = 0; t < mesh.triangle_count; t++, at += 12) {
    int32_t corner[3] = {mesh.triangle[t][0], mesh.triangle[t][turned ? 2 : 1], mesh.triangle[t][turned ? 1 : 2]};
    memcpy(at, corner, sizeof corner);
  }
  for (int32_t t = 0; t < mesh.triangle_count; t++, at += 4) memcpy(at, &labels[mesh.component[t]], 4);
  *bytes = block;
  *size_of_bytes = (int64_t)total;
  block = NULL;
done:
  cw_patch_mesh_free(&mesh);
  free(labels);
  free(block);
  return status;
}

void cw_patch_block(const void *bytes, CwPatchBlock *block) {
  int32_t header[3];
  memcpy(header, bytes, sizeof header);
  memcpy(&block->outcome, (const char *)bytes + COUNTS, sizeof block->outcome);
  block->outline_points = header[0];
  block->point_count = header[1];
  block->triangle_count = header[2];
  const char *at = (const char *)bytes + HEADER;
  block->x = (const double(*)[3])at;
  at += (size_t)header[1] * 24;
  block->outline_node = (const int32_t *)at;
  at += (size_t)header[0] * sizeof *block->outline_node;
  block->triangle = (const int32_t(*)[3])at;
  at += (size_t)header[2] * 12;
  block->label = (const int32_t *)at;
}
