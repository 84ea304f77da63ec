// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/region/region_build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/hilbert.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/radix.h"
#include "mesher/common/vec.h"
#include "mesher/fill/fill_with_fallback.h"
#include "mesher/policy.h"
#include "mesher/region/interface_rule.h"
#include "mesher/region/region_boundary.h"
#include "mesher/region/tets_on.h"
#include "mesher/region/top_moves.h"
#include "mesher/thickness/layer_thickness.h"
#include "pipeline/hash.h"
#include "pipeline/mesh/cell.h"

// Whether a node of the boundary is the end of a column that has a height.
static int has_column(const CwRegionInput *from, int32_t node) {
  return node < from->surface->vertex_count && from->layers->thickness[node] > 0;
}

CwStatus cw_shared_nodes_make(const CwRegionInput *from, int layer_count, CwSharedNodes *shared) {
  CwStatus status = CW_OK;
  const CwNodeTable *nodes = &from->interfaces->nodes;
  *shared = (CwSharedNodes){.node_count = nodes->count};
  for (int32_t i = 0; i < nodes->count; i++) shared->shared_node_count += nodes->on_plane[i];
  CW_NEW_UNSET(shared->base, nodes->count);
  CW_NEW_UNSET(shared->node, shared->shared_node_count);
  for (int32_t i = 0, found = 0; i < nodes->count; i++) {
    shared->base[i] = nodes->on_plane[i] ? shared->count : -1;
    if (!nodes->on_plane[i]) continue;
    shared->node[found++] = i;
    shared->count += has_column(from, i) ? layer_count + 1 : 1;
  }
done:
  return status;
}

void cw_shared_nodes_arrays(void *product, CwArrayVisit visit, void *given) {
  CwSharedNodes *shared = product;
  CW_SHOW(visit, given, shared->base, shared->node_count);
  CW_SHOW(visit, given, shared->node, shared->shared_node_count);
}

void cw_shared_nodes_free(CwSharedNodes *shared) {
  cw_arrays_free(shared, cw_shared_nodes_arrays, &shared->memory);
  *shared = (CwSharedNodes){0};
}

void cw_region_fingerprint(const CwRegionContext *context, int32_t region, char fingerprint[CW_HASH_TEXT]) {
  const CwRegionInput *from = &context->from;
  const CwCad *cad = from->in->cad;
  CwHash hash = cw_hash_start();
  double numbers[] = {context->layer_count, (double)context->shared->count, context->fill, cw_model_unit()};
  cw_policy_hash(&hash);
  cw_hash_bytes(&hash, numbers, sizeof numbers);
  cw_hash_bytes(&hash, context->domain, strlen(context->domain));
  for (int f = 0; f < cw_cad_face_count(cad); f++) { // the file knows patches by their numbers
    int32_t patch = cw_cad_face_patch(cad, f);
    cw_hash_bytes(&hash, &patch, sizeof patch);
  }
  for (int32_t i = from->surface->region_start[region]; i < from->surface->region_start[region + 1]; i++) {
    int32_t t = from->surface->region_triangle[i];
    cw_hash_bytes(&hash, &from->surface->face[t], sizeof(int32_t));
    for (int k = 0; k < 3; k++) {
      int32_t v = from->layers->triangle[t][k];
      cw_hash_bytes(&hash, from->surface->x[v], sizeof(double[3]));
      cw_hash_bytes(&hash, from->layers->top[v], sizeof(double[3]));
      cw_hash_bytes(&hash, &context->first_height[v], sizeof(double));
      cw_hash_bytes(&hash, &context->growth[v], sizeof(double));
      cw_hash_bytes(&hash, &context->shared->base[v], sizeof(int64_t));
    }
  }
  for (int32_t t = 0; t < from->interfaces->open_patch.count; t++) {
    if (from->interfaces->open_patch.region[t] != region) continue;
    cw_hash_bytes(&hash, &from->interfaces->open_patch.face[t], sizeof(int32_t));
    for (int k = 0; k < 3; k++)
      cw_hash_bytes(&hash, from->interfaces->nodes.x[from->interfaces->open_patch.triangle[t][k]], sizeof(double[3]));
  }
  for (int32_t t = 0; t < from->interfaces->planned.count; t++) { // candidates follow from these
    if (from->interfaces->planned.region[t][0] != region && from->interfaces->planned.region[t][1] != region) continue;
    for (int k = 0; k < 3; k++)
      cw_hash_bytes(&hash, from->interfaces->nodes.x[from->interfaces->planned.triangle[t][k]], sizeof(double[3]));
  }
  for (int32_t t = 0; t < from->interfaces->refined.count; t++) {
    if (from->interfaces->refined.region[t][0] != region && from->interfaces->refined.region[t][1] != region) continue;
    for (int k = 0; k < 3; k++) {
      int32_t node = from->interfaces->refined.triangle[t][k];
      cw_hash_bytes(&hash, from->interfaces->nodes.x[node], sizeof(double[3]));
      cw_hash_bytes(&hash, &context->shared->base[node], sizeof(int64_t));
    }
    double centre =
        from->in->size_at(from->in->size, from->interfaces->nodes.x[from->interfaces->refined.triangle[t][0]]);
    cw_hash_bytes(&hash, &centre, sizeof centre);
  }
  cw_hash_hex(&hash, fingerprint);
}

// A region in the making.
typedef struct {
  const CwRegionContext *context;
  int32_t region;
  CwRegionBoundary inner;
  CwFill fill;
  int32_t *place;  // point of the region file for each fill point
  int32_t *column; // first point of the layers below each local node that stands on the layer top, by level
} Build;

// A point of the fill and, on the layer top, its column: from number `*next` of the region file on.
static void place_point(Build *build, int32_t i, int32_t *next, CwRegionMesh *mesh) {
  const CwRegionContext *context = build->context;
  const CwRegionInput *from = &context->from;
  const int32_t levels = context->layer_count, node = i < build->inner.node_count ? build->inner.node[i] : -1;
  const int64_t base = node >= 0 ? context->shared->base[node] : -1;
  const int on_top = node >= 0 && has_column(from, node);
  double fraction[CW_LAYERS_MOST + 1];
  if (on_top) {
    build->column[i] = *next;
    cw_layer_fractions(from->layers->thickness[node], context->first_height[node], levels, context->growth[node],
                       fraction);
    for (int k = 0; k < levels; k++) {
      if (base >= 0) mesh->cells.shared_id[*next] = base + k;
      cw_column_place(from, &context->open_edge_places, node, fraction[k], mesh->cells.points[(*next)++]);
    }
  }
  if (base >= 0) mesh->cells.shared_id[*next] = base + (on_top ? levels : 0);
  build->place[i] = *next;
  cw_copy(build->fill.x[i], mesh->cells.points[(*next)++]);
}

// Numbers the points of the region file and places them: shared ones first, then the region's own along Hilbert's
// curve, so that what is near in space is near in memory, for all who read the mesh.
static CwStatus place_points(Build *build, CwRegionMesh *mesh) {
  CwStatus status = CW_OK;
  const CwRegionContext *context = build->context;
  const CwRegionInput *from = &context->from;
  int32_t levels = context->layer_count, total = build->fill.point_count, shared = 0, next = 0, *order = NULL;
  for (int32_t i = 0; i < build->inner.node_count; i++) {
    int on_top = has_column(from, build->inner.node[i]), is_shared = context->shared->base[build->inner.node[i]] >= 0;
    if (on_top) total += levels;
    if (is_shared) shared += on_top ? levels + 1 : 1;
  }
  mesh->cells.point_count = total;
  mesh->cells.shared_count = shared;
  CW_NEW(mesh->cells.points, total);
  CW_NEW(mesh->cells.shared_id, shared);
  CW_NEW(build->place, build->fill.point_count);
  CW_NEW(build->column, build->inner.node_count);
  for (int32_t i = 0; i < build->inner.node_count; i++) {
    if (context->shared->base[build->inner.node[i]] >= 0) place_point(build, i, &next, mesh);
  }
  CW_NEW_UNSET(order, build->fill.point_count);
  CW_TRY(cw_hilbert_order(build->fill.point_count, (const double(*)[3])build->fill.x, order));
  for (int32_t k = 0; k < build->fill.point_count; k++) {
    int32_t i = order[k];
    if (i >= build->inner.node_count || context->shared->base[build->inner.node[i]] < 0)
      place_point(build, i, &next, mesh);
  }
done:
  free(order);
  return status;
}

// The tetrahedra of the fill by the greatest number of their points, which brings them along the curve too.
static CwStatus order_tetrahedra(Build *build) {
  CwStatus status = CW_OK;
  const int32_t count = build->fill.tetrahedron_count, *place = build->place;
  int32_t(*corner)[4] = build->fill.tetrahedron, (*ordered)[4] = NULL;
  CwRadix *record = NULL;
  CW_NEW_UNSET(record, count);
  CW_NEW_UNSET(ordered, count);
  for (int32_t t = 0; t < count; t++) {
    int32_t greatest = place[corner[t][0]];
    for (int k = 1; k < 4; k++) greatest = place[corner[t][k]] > greatest ? place[corner[t][k]] : greatest;
    record[t] = (CwRadix){(uint64_t)greatest, t, 0};
  }
  CW_TRY(cw_radix_sort(count, record));
  for (int32_t t = 0; t < count; t++) memcpy(ordered[t], corner[record[t].item], sizeof *ordered);
  build->fill.tetrahedron = ordered;
  ordered = corner;
done:
  free(record);
  free(ordered);
  return status;
}

static int is_pinched(const Build *build, int32_t local) {
  return !has_column(&build->context->from, build->inner.node[local]);
}

// Point at `level` of the column of a local layer top node: 0 on the wall, layer_count on the layer top.
static int32_t column_point(const Build *build, int32_t local, int level) {
  return level == build->context->layer_count || is_pinched(build, local) ? build->place[local]
                                                                          : build->column[local] + level;
}

// Nodes of a face of an interface lie on its exact surface: solvers couple the two sides there.
static void check_on_open_patch(const Build *build, const CwRegionMesh *mesh, int32_t face, const int32_t *corner,
                                int count, CwOutcome *outcome) {
  const CwCad *cad = build->context->from.in->cad;
  const double *x[4];
  int patch = cw_cad_face_patch(cad, face);
  if (cw_cad_patch_kind(cad, patch) != CW_PATCH_INTERFACE) return;
  for (int c = 0; c < count; c++) x[c] = mesh->cells.points[corner[c]];
  double allowed = cw_interface_tolerance(count, x);
  for (int c = 0; c < count; c++) {
    double off = cw_cad_face_distance(cad, face, x[c]);
    CW_END_UNLESS(off <= allowed, outcome, CW_OUTCOME_THIN, x[c],
                  "%s region %d: a node is %.3g mm off patch %s; allowed: %.3g mm", build->context->domain,
                  build->region + 1, cw_mm(off), cw_cad_patch_name(cad, patch), cw_mm(allowed));
  }
done:
  return;
}

// The cells over a wall triangle: prisms; where layers taper, pyramids or tetrahedra with a point at each pinched
// corner. `k`: their layer. Base and top look into the fluid.
static void add_cell(const Build *build, const int32_t corner[3], int k, int pinched, int32_t cell,
                     CwRegionData *cells) {
  int32_t base[3], end[3];
  int first = 0; // the corner that is pinched alone, or alone is not
  for (int c = 0; c < 3; c++) {
    base[c] = column_point(build, corner[(3 - c) % 3], k);
    end[c] = column_point(build, corner[(3 - c) % 3], k + 1);
    if (is_pinched(build, corner[(3 - c) % 3]) == (pinched == 1)) first = c;
  }
  int b = (first + 1) % 3, c = (first + 2) % 3;
  if (pinched == 0)
    memcpy(cells->prisms[cell - cells->tetrahedron_count - cells->pyramid_count],
           (int32_t[6]){base[0], base[1], base[2], end[0], end[1], end[2]}, sizeof *cells->prisms);
  else if (pinched == 1)
    memcpy(cells->pyramids[cell - cells->tetrahedron_count],
           (int32_t[5]){base[b], end[b], end[c], base[c], base[first]}, sizeof *cells->pyramids);
  else
    memcpy(cells->tetrahedra[cell], (int32_t[4]){base[first], base[b], base[c], end[first]}, sizeof *cells->tetrahedra);
}

// The sides of a wall triangle's cells along its edge from a to b, which lies on an open patch: quads, or triangles
// beside a pinched end.
static void add_sides(Build *build, int32_t a, int32_t b, int32_t open_patch, int32_t first_cell, CwRegionMesh *mesh,
                      CwOutcome *outcome) {
  CwRegionData *cells = &mesh->cells;
  const int patch = cw_cad_face_patch(build->context->from.in->cad, open_patch);
  const int pinched_a = is_pinched(build, a), pinched_b = is_pinched(build, b);
  for (int k = 0; k < build->context->layer_count && !(pinched_a && pinched_b); k++) {
    const int32_t quad[4] = {column_point(build, b, k), column_point(build, a, k), column_point(build, a, k + 1),
                             column_point(build, b, k + 1)};
    if (pinched_a || pinched_b) {
      int32_t t = cells->triangle_count++, *corner = cells->triangles[t];
      for (int c = 0; c < 3; c++) corner[c] = quad[c < 2 ? c : pinched_a ? 3 : 2];
      cells->triangle_patch[t] = patch;
      cells->triangle_cell[t] = first_cell + k;
      check_on_open_patch(build, mesh, open_patch, corner, 3, outcome);
    } else {
      int32_t q = cells->quad_count++;
      memcpy(cells->quads[q], quad, sizeof quad);
      cells->quad_patch[q] = patch;
      cells->quad_cell[q] = first_cell + k;
      check_on_open_patch(build, mesh, open_patch, quad, 4, outcome);
    }
    if (outcome->kind != CW_OUTCOME_DONE) return;
  }
}

// Memory for the cells of the layers and for all boundary faces. first: the first cell over a wall triangle by the
// number of its pinched corners.
static CwStatus make_room(const Build *build, CwRegionMesh *mesh, int32_t first[3]) {
  CwStatus status = CW_OK;
  const CwRegionContext *context = build->context;
  const CwRegionBoundary *inner = &build->inner;
  CwRegionData *cells = &mesh->cells;
  int32_t of[3] = {0}, sides = 0;
  for (int32_t t = 0; t < inner->wall_count; t++) {
    const int32_t *corner = inner->triangle[t];
    of[cw_layers_pinched(context->from.layers, inner->source[t])] += context->layer_count;
    for (int e = 0; e < 3; e++)
      sides +=
          cw_open_edge_face(&context->open_edge_places, inner->node[corner[e]], inner->node[corner[(e + 1) % 3]]) >= 0;
  }
  first[2] = build->fill.tetrahedron_count;
  mesh->layer_tetrahedra = of[2];
  cells->tetrahedron_count = first[1] = first[2] + of[2];
  cells->pyramid_count = of[1];
  first[0] = first[1] + of[1];
  cells->prism_count = of[0];
  CW_NEW(cells->tetrahedra, cells->tetrahedron_count);
  CW_NEW(cells->pyramids, of[1]);
  CW_NEW(cells->prisms, of[0]);
  const size_t quads = (size_t)sides * (size_t)context->layer_count;
  const size_t triangles =
      (size_t)(inner->wall_count + inner->bare_count + inner->open_patch_count) + (of[1] + of[2] > 0 ? quads : 0);
  CW_NEW(cells->quads, quads);
  CW_NEW(cells->quad_patch, quads);
  CW_NEW(cells->quad_cell, quads);
  CW_NEW(cells->triangles, triangles);
  CW_NEW(cells->triangle_patch, triangles);
  CW_NEW(cells->triangle_cell, triangles);
done:
  return status;
}

// Cells of all columns, wall triangles under them, and the sides on open patches.
static CwStatus add_layers(Build *build, const int32_t of_kind[3], CwRegionMesh *mesh, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwRegionContext *context = build->context;
  const CwRegionInput *from = &context->from;
  CwRegionData *cells = &mesh->cells;
  int32_t next[3] = {of_kind[0], of_kind[1], of_kind[2]}, *first = NULL;
  CW_NEW_UNSET(first, build->inner.wall_count);
  for (int32_t t = 0; t < build->inner.wall_count; t++) {
    const int32_t *corner = build->inner.triangle[t];
    const int pinched = cw_layers_pinched(from->layers, build->inner.source[t]);
    first[t] = next[pinched];
    for (int k = 0; k < context->layer_count; k++) add_cell(build, corner, k, pinched, next[pinched]++, cells);
    int32_t w = cells->triangle_count++;
    for (int c = 0; c < 3; c++) cells->triangles[w][c] = column_point(build, corner[c], 0);
    cells->triangle_patch[w] = cw_cad_face_patch(from->in->cad, from->surface->face[build->inner.source[t]]);
    cells->triangle_cell[w] = first[t];
  }
  for (int32_t t = 0; t < build->inner.wall_count; t++) {
    for (int e = 0; e < 3; e++) {
      int32_t a = build->inner.triangle[t][e], b = build->inner.triangle[t][(e + 1) % 3],
              open_patch = cw_open_edge_face(&context->open_edge_places, build->inner.node[a], build->inner.node[b]);
      if (open_patch < 0) continue;
      add_sides(build, a, b, open_patch, first[t], mesh, outcome);
      if (outcome->kind != CW_OUTCOME_DONE) goto done;
    }
  }
done:
  free(first);
  return status;
}

// Triangles of walls without layers and of the open patches with the tetrahedron behind each.
static CwStatus add_open_patches(Build *build, CwRegionMesh *mesh, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwRegionInput *from = &build->context->from;
  const int32_t first = build->inner.wall_count, made = mesh->cells.triangle_count;
  const int32_t count = build->inner.bare_count + build->inner.open_patch_count;
  const int32_t(*corner)[3] = (const int32_t(*)[3])build->inner.triangle + first;
  CW_TRY(cw_tets_on(build->fill.point_count, count, corner, build->fill.tetrahedron_count,
                    (const int32_t(*)[4])build->fill.tetrahedron, mesh->cells.triangle_cell + made));
  for (int32_t t = 0; t < count; t++) {
    const int32_t source = build->inner.source[first + t];
    const int32_t face =
        t < build->inner.bare_count ? from->surface->face[source] : from->interfaces->open_patch.face[source];
    const int patch = cw_cad_face_patch(from->in->cad, face);
    for (int c = 0; c < 3; c++) mesh->cells.triangles[made + t][c] = build->place[corner[t][c]];
    mesh->cells.triangle_patch[made + t] = patch;
    check_on_open_patch(build, mesh, face, mesh->cells.triangles[made + t], 3, outcome);
    if (outcome->kind != CW_OUTCOME_DONE) goto done;
    const double *x = mesh->cells.points[mesh->cells.triangles[made + t][0]];
    CW_REQUIRE(mesh->cells.triangle_cell[made + t] >= 0, CW_ERR_FAULT,
               "%s region %d: a face of patch %s at (%.3f, %.3f, %.3f) mm has no tetrahedron", build->context->domain,
               build->region + 1, cw_cad_patch_name(from->in->cad, patch), CW_MM(x));
  }
  mesh->cells.triangle_count += count;
done:
  return status;
}

// A boundary that cannot be filled has layers that leave no room.
static CwStatus thin_unless_filled(CwStatus filled, CwOutcome *outcome) {
  if (filled != CW_ERR_MESH) return filled;
  cw_outcome_set(outcome, CW_OUTCOME_THIN, NULL, "%s", cw_fail_message());
  return CW_OK;
}

CwStatus cw_region_build(const CwRegionContext *context, int32_t region, int32_t number, CwRegionMesh *mesh,
                         CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Build build = {.context = context, .region = region};
  double(*inner)[3] = NULL;
  CwLatticeSite *site = NULL;
  char name[64];
  int32_t moved, first[3];
  memset(mesh, 0, sizeof *mesh);
  snprintf(name, sizeof name, "%s region %d", context->domain, region + 1);
  snprintf(mesh->domain, sizeof mesh->domain, "%s", context->domain);
  mesh->region = region + 1;
  mesh->number = number;
  cw_region_fingerprint(context, region, mesh->fingerprint);
  CW_TRY(cw_region_boundary_make(&context->from, region, 0, &build.inner));
  CwFillInput input = cw_region_fill_input(&context->from, &build.inner, name);
  if (context->from.interfaces->planned.triangle) {
    CwStatus found = cw_interface_rule_points(&context->from, region, name, &input.inner_count, &inner, &site);
    CW_TRY_STAGE(thin_unless_filled(found, outcome), outcome);
    input.inner = (const double(*)[3])inner;
    input.inner_site = site;
  }
  CW_TRY_STAGE(thin_unless_filled(cw_fill_with_fallback(&input, context->fill, &build.fill), outcome), outcome);
  mesh->recovery = build.fill.recovery;
  CW_TRY(place_points(&build, mesh));
  CW_TRY(order_tetrahedra(&build));
  CW_TRY(make_room(&build, mesh, first));
  for (int32_t t = 0; t < build.fill.tetrahedron_count; t++) {
    for (int k = 0; k < 4; k++) mesh->cells.tetrahedra[t][k] = build.place[build.fill.tetrahedron[t][k]];
  }
  CW_TRY_STAGE(add_layers(&build, first, mesh, outcome), outcome);
  CW_TRY_STAGE(add_open_patches(&build, mesh, outcome), outcome);
  CW_TRY(cw_top_moves(context->layer_count, mesh, &moved));
  cw_log_debug(context->from.log, "%s: %d points at flat tetrahedra on the layer top moved", name, moved);
done:
  if (status != CW_OK || outcome->kind != CW_OUTCOME_DONE) cw_region_free(mesh);
  cw_fill_free(&build.fill);
  cw_region_boundary_free(&build.inner);
  free(inner);
  free(site);
  free(build.place);
  free(build.column);
  return status;
}
