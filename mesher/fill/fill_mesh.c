// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/fill/fill_shape.h"

CwStatus cw_fill_to_mesh(const CwFill *fill, CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t(*neighbour)[4] = NULL, count = fill->tetrahedron_count;
  memset(mesh, 0, sizeof *mesh);
  CW_NEW(neighbour, count);
  CW_TRY(cw_tet_neighbours(count, (const int32_t(*)[4])fill->tetrahedron, neighbour));
  mesh->point_count = mesh->point_capacity = fill->point_count + CW_ENCLOSING_POINTS;
  mesh->tet_count = mesh->tet_capacity = count;
  CW_NEW(mesh->point, mesh->point_count);
  CW_NEW(mesh->source, mesh->point_count);
  CW_NEW(mesh->tet, count);
  for (int32_t p = 0; p < CW_ENCLOSING_POINTS; p++) mesh->source[p] = -1;
  for (int32_t p = 0; p < fill->point_count; p++) {
    memcpy(mesh->point[CW_ENCLOSING_POINTS + p].x, fill->x[p], sizeof *fill->x);
    mesh->source[CW_ENCLOSING_POINTS + p] = p;
  }
  for (int32_t t = 0; t < count; t++) {
    memcpy(mesh->tet[t].neighbour, neighbour[t], sizeof *neighbour);
    for (int i = 0; i < 4; i++) mesh->tet[t].corner[i] = CW_ENCLOSING_POINTS + fill->tetrahedron[t][i];
  }
done:
  free(neighbour);
  if (status != CW_OK) cw_tet_mesh_free(mesh);
  return status;
}

// The corners are moved together in the mesh's own memory, which goes over to the fill: no second copy at the
// peak.
CwStatus cw_fill_from_mesh(CwTetMesh *mesh, int32_t fixed_count, int32_t source_count, CwFill *fill) {
  CwStatus status = CW_OK;
  int32_t *number = NULL, kept = 0, points = fixed_count;
  int32_t(*made)[4] = (int32_t(*)[4])(void *)mesh->tet;
  CW_NEW(number, source_count);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    int32_t corner[4];
    cw_tet_prefetch_ahead(&mesh->tet[t]);
    memcpy(corner, mesh->tet[t].corner, sizeof corner);
    if (corner[0] < 0) continue;
    for (int i = 0; i < 4; i++) {
      corner[i] = mesh->source[corner[i]];
      number[corner[i]] = 1;
    }
    memcpy(made[kept++], corner, sizeof corner);
  }
  mesh->tet = NULL;
  fill->tetrahedron = realloc(made, (size_t)(kept ? kept : 1) * sizeof *made); // of 0 bytes it frees
  if (!fill->tetrahedron) fill->tetrahedron = made;
  fill->tetrahedron_count = kept;
  for (int32_t p = 0; p < source_count; p++) {
    if (p < fixed_count)
      number[p] = p;
    else
      number[p] = number[p] ? points++ : -1;
  }
  for (int32_t t = 0; t < kept; t++) {
    for (int i = 0; i < 4; i++) fill->tetrahedron[t][i] = number[fill->tetrahedron[t][i]];
  }
  CW_NEW_UNSET(fill->x, points);
  for (int32_t p = CW_ENCLOSING_POINTS; p < mesh->point_count; p++) {
    int32_t to = number[mesh->source[p]];
    if (to >= 0) memcpy(fill->x[to], mesh->point[p].x, sizeof *fill->x);
  }
  fill->point_count = points;
done:
  free(number);
  return status;
}
