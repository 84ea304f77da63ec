// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/boundary/surface_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/model_unit.h"
#include "mesher/common/vtk.h"

// A directed edge of a triangle.
typedef struct {
  int32_t low, high, backwards, triangle;
} Edge;

static int by_ends(const void *p, const void *q) {
  const Edge *a = p, *b = q;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  if (a->high != b->high) return a->high < b->high ? -1 : 1;
  if (a->backwards != b->backwards) return a->backwards < b->backwards ? -1 : 1;
  return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static CwStatus audit_corners(const CwSurfaceMesh *surface) {
  CwStatus status = CW_OK;
  uint8_t *used = NULL;
  CW_NEW(used, surface->vertex_count);
  for (int32_t t = 0; t < surface->triangle_count; t++) {
    const int32_t *corner = surface->triangle[t];
    for (int k = 0; k < 3; k++) {
      CW_REQUIRE(corner[k] >= 0 && corner[k] < surface->vertex_count && corner[k] != corner[(k + 1) % 3], CW_ERR_FAULT,
                 "surface mesh: triangle %d has the corners %d, %d, %d of %d vertices", t, corner[0], corner[1],
                 corner[2], surface->vertex_count);
      used[corner[k]] = 1;
    }
  }
  for (int32_t v = 0; v < surface->vertex_count; v++) {
    CW_REQUIRE(used[v], CW_ERR_FAULT, "surface mesh: vertex %d at (%.3f, %.3f, %.3f) mm has no triangle", v,
               CW_MM(surface->x[v]));
  }
done:
  free(used);
  return status;
}

static CwStatus audit_edges(const CwSurfaceMesh *surface) {
  CwStatus status = CW_OK;
  Edge *edge = NULL;
  size_t count = 3 * (size_t)surface->triangle_count;
  CW_NEW(edge, count);
  for (size_t i = 0; i < count; i++) {
    int32_t t = (int32_t)(i / 3), a = surface->triangle[t][i % 3], b = surface->triangle[t][(i + 1) % 3];
    edge[i] = (Edge){a < b ? a : b, a < b ? b : a, a > b, t};
  }
  qsort(edge, count, sizeof *edge, by_ends);
  for (size_t i = 1; i < count; i++) {
    const Edge *a = &edge[i - 1], *b = &edge[i];
    CW_REQUIRE(a->low != b->low || a->high != b->high || a->backwards != b->backwards, CW_ERR_FAULT,
               "surface mesh: triangles %d and %d run the same way along the edge from (%.3f, %.3f, %.3f) to (%.3f, "
               "%.3f, %.3f) mm",
               a->triangle, b->triangle, CW_MM(surface->x[a->low]), CW_MM(surface->x[a->high]));
  }
done:
  free(edge);
  return status;
}

static CwStatus audit_regions(const CwSurfaceMesh *surface, int32_t regions) {
  CwStatus status = CW_OK;
  CW_REQUIRE(surface->region_start[0] == 0 && surface->region_start[regions] == surface->triangle_count, CW_ERR_FAULT,
             "surface mesh: regions list %d of %d triangles", surface->region_start[regions], surface->triangle_count);
  for (int32_t r = 0; r < regions; r++) {
    int32_t before = -1;
    for (int32_t i = surface->region_start[r]; i < surface->region_start[r + 1]; i++) {
      int32_t t = surface->region_triangle[i];
      CW_REQUIRE(t > before && t < surface->triangle_count && surface->region[t] == r, CW_ERR_FAULT,
                 "surface mesh: region %d lists triangle %d after %d", r, t, before);
      before = t;
    }
  }
  for (int32_t t = 0; t < surface->triangle_count; t++) {
    int32_t source = surface->source[t];
    CW_REQUIRE(source >= 0 && source < surface->triangle_count && surface->source[source] == source, CW_ERR_FAULT,
               "surface mesh: triangle %d is a copy of %d, which is one itself", t, source);
  }
done:
  return status;
}

CwStatus cw_surface_mesh_audit(const CwSurfaceMesh *surface, int32_t regions) {
  CwStatus status = CW_OK;
  CW_TRY(audit_corners(surface));
  CW_TRY(audit_edges(surface));
  CW_TRY(audit_regions(surface, regions));
done:
  return status;
}

CwStatus cw_surface_mesh_vtk(const CwSurfaceMesh *surface, const char *path) {
  const CwVtkField field[2] = {{"face", surface->face, NULL}, {"region", surface->region, NULL}};
  const CwVtkTriangles triangles = {.title = "surface mesh",
                                    .point_count = surface->vertex_count,
                                    .x = (const double(*)[3])surface->x,
                                    .triangle_count = surface->triangle_count,
                                    .triangle = (const int32_t(*)[3])surface->triangle,
                                    .field_count = 2,
                                    .field = field};
  return cw_vtk_write(path, &triangles);
}

void cw_surface_mesh_arrays(void *product, CwArrayVisit visit, void *given) {
  CwSurfaceMesh *surface = product;
  const int64_t vertices = surface->vertex_count, triangles = surface->triangle_count;
  CW_SHOW(visit, given, surface->x, vertices);
  CW_SHOW(visit, given, surface->constraint, vertices);
  cw_node_images_arrays(&surface->images, visit, given);
  CW_SHOW(visit, given, surface->triangle, triangles);
  CW_SHOW(visit, given, surface->face, triangles);
  CW_SHOW(visit, given, surface->region, triangles);
  CW_SHOW(visit, given, surface->region_start, surface->region_count + 1);
  CW_SHOW(visit, given, surface->region_triangle, triangles);
  CW_SHOW(visit, given, surface->source, triangles);
}

void cw_surface_mesh_free(CwSurfaceMesh *surface) {
  cw_arrays_free(surface, cw_surface_mesh_arrays, &surface->memory);
  memset(surface, 0, sizeof *surface);
}
