// SPDX-License-Identifier: AGPL-3.0-or-later
// The surface mesh of a domain: triangles on its CAD walls, cut at the partition planes, and what holds the columns of
// the layers on open boundary edges and planes. Of it a rank needs what bounds its regions, and what the layers there
// feel through gaps.
#pragma once

#include <stdint.h>

#include "mesher/boundary/wall_curves.h"
#include "mesher/network/periodic_images.h"
#include "mesher/parallel/host_memory.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  int32_t vertex_count;
  double (*x)[3];
  CwConstraint *constraint;                // of each vertex
  CwNodeImages images;                     // of the vertices
  int32_t triangle_count;                  //
  int32_t (*triangle)[3], *face, *region;  // normal out of the domain; the CAD face and the region of each
  int32_t region_count;                    //
  int32_t *region_start, *region_triangle; // triangles of each region, ascending
  int32_t *source;                         // the triangle that this one is a copy of, turned; or itself
  CwHostMemory *memory;                    // where its arrays lie; NULL: they are this rank's
} CwSurfaceMesh;

// Checks what every surface mesh holds: corners within the vertices and distinct, each vertex in a triangle, each edge
// in at most two triangles that run through it in opposite directions, regions that list each of their triangles once,
// sources that are their own. CW_ERR_FAULT with the first that does not hold. regions: their number.
CwStatus cw_surface_mesh_audit(const CwSurfaceMesh *surface, int32_t regions);

// Writes the triangles as VTK PolyData (cell data face, region), for a look.
CwStatus cw_surface_mesh_vtk(const CwSurfaceMesh *surface, const char *path);

// Shows its arrays (CwArrays).
void cw_surface_mesh_arrays(void *surface, CwArrayVisit visit, void *given);
void cw_surface_mesh_free(CwSurfaceMesh *surface);

#ifdef __cplusplus
}
#endif
