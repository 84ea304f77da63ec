// SPDX-License-Identifier: AGPL-3.0-or-later
// One region file of a mesh in memory.
#ifndef CUTWATER_PIPELINE_MESH_REGION_READ_H
#define CUTWATER_PIPELINE_MESH_REGION_READ_H

#include "pipeline/mesh/manifest.h"

// A region in memory, as its file has it; see docs/file-formats.md for shapes and orders.
typedef struct {
  int domain, region;
  int32_t point_count, shared_count;
  int32_t tetrahedron_count, pyramid_count, prism_count, triangle_count, quad_count;
  double (*points)[3];
  int64_t *shared_id;
  int32_t (*tetrahedra)[4], (*pyramids)[5], (*prisms)[6];
  int32_t (*triangles)[3], *triangle_patch, *triangle_cell;
  int32_t (*quads)[4], *quad_patch, *quad_cell;
} CwRegionData;

typedef enum {
  CW_REGION_WHOLE,
  CW_REGION_SURFACE // points and boundary faces with their patches; the other counts stay 0
} CwRegionPart;

// Reads one region file, or a part of it, and checks it against its line of the manifest: counts, and that
// every index is in range and every coordinate finite. CW_ERR_IO or CW_ERR_INPUT. Zeroed `data` on entry;
// free it with cw_mesh_region_free, also after a failure.
CwStatus cw_mesh_region_read(const CwMesh *mesh, int region, CwRegionPart part, CwRegionData *data);
void cw_mesh_region_free(CwRegionData *data);

static inline int32_t cw_region_cell_count(const CwRegionData *data) {
  return data->tetrahedron_count + data->pyramid_count + data->prism_count;
}

#endif
