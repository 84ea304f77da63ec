// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_mesh.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { LARGE_PAGE = 1 << 21, CACHE_LINE = 64 }; // bytes

// Aligned to large pages, which realloc is not. Pages not yet touched cost nothing.
CwStatus cw_tet_mesh_make_room(CwTetMesh *mesh, int64_t capacity, int64_t sure) {
  CwStatus status = CW_OK;
  CW_REQUIRE(capacity < INT32_MAX / 4, CW_ERR_MESH,
             "more than %d tetrahedra in one region; lower mesh.cells_per_region", INT32_MAX / 4);
  size_t large = sure * (int64_t)sizeof *mesh->tet >= LARGE_PAGE ? LARGE_PAGE : CACHE_LINE;
  size_t size = ((size_t)capacity * sizeof *mesh->tet + large - 1) / large * large;
  CwTet *pool = aligned_alloc(large, size);
  CW_REQUIRE(pool, CW_ERR_MEMORY, "out of memory: %lld tetrahedra", (long long)capacity);
#ifdef MADV_HUGEPAGE
  if (large == LARGE_PAGE)
    (void)madvise(pool, (size_t)sure * sizeof *pool / large * large, MADV_HUGEPAGE); // else small
#endif
  if (mesh->tet_count) memcpy(pool, mesh->tet, (size_t)mesh->tet_count * sizeof *pool);
  free(mesh->tet);
  mesh->tet = pool;
  mesh->tet_capacity = (int32_t)capacity;
done:
  return status;
}

CwStatus cw_tet_mesh_new_tet(CwTetMesh *mesh, int32_t *tet) {
  CwStatus status = CW_OK;
  if (mesh->spare) {
    *tet = mesh->spare - 1;
    mesh->spare = mesh->tet[*tet].corner[1];
    goto done;
  }
  if (mesh->tet_count == mesh->tet_capacity)
    CW_TRY(cw_tet_mesh_make_room(mesh, (int64_t)mesh->tet_capacity + mesh->tet_capacity / 4 + 64, 0));
  *tet = mesh->tet_count++;
  mesh->tet[*tet] = (CwTet){.quality = 0.0};
done:
  return status;
}

void cw_tet_mesh_free_tet(CwTetMesh *mesh, int32_t tet) {
  mesh->tet[tet].corner[0] = -1;
  mesh->tet[tet].corner[1] = mesh->spare;
  mesh->spare = tet + 1;
}

void cw_tet_mesh_pack(CwTetMesh *mesh) {
  int32_t kept = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    cw_tet_prefetch_ahead(&mesh->tet[t]);
    if (mesh->tet[t].corner[0] < 0) continue;
    const CwTet *from = &mesh->tet[t];
    CwTet *to = &mesh->tet[kept];
    if (kept != t) {
      memcpy(to->corner, from->corner, sizeof to->corner);
      for (int i = 0; i < 4; i++) {
        int32_t next = to->neighbour[i] = from->neighbour[i];
        if (next >= 0) mesh->tet[next >> 2].neighbour[next & 3] = 4 * kept + i;
      }
    }
    kept++;
  }
  mesh->tet_count = kept;
  mesh->spare = 0;
  // Some room is left for those to come, since a larger pool stands beside this one for a moment.
  int32_t capacity = kept + kept / 32 + 64;
  CwTet *pool = capacity < mesh->tet_capacity ? realloc(mesh->tet, (size_t)capacity * sizeof *pool) : NULL;
  if (pool) { // as a rule in its place, and so aligned as before
    mesh->tet = pool;
    mesh->tet_capacity = capacity;
  }
}

CwStatus cw_tet_mesh_add_point(CwTetMesh *mesh, const double x[3], int32_t source, int32_t *point) {
  CwStatus status = CW_OK;
  if (mesh->point_count == mesh->point_capacity) {
    int32_t capacity = mesh->point_capacity + mesh->point_capacity / 8 + 64;
    CwTetPoint *points = realloc(mesh->point, (size_t)capacity * sizeof *points);
    CW_REQUIRE(points, CW_ERR_MEMORY, "out of memory: %d points", capacity);
    mesh->point = points;
    int32_t *sources = realloc(mesh->source, (size_t)capacity * sizeof *sources);
    CW_REQUIRE(sources, CW_ERR_MEMORY, "out of memory: %d points", capacity);
    mesh->source = sources;
    mesh->point_capacity = capacity;
  }
  *point = mesh->point_count++;
  memcpy(mesh->point[*point].x, x, sizeof mesh->point->x);
  mesh->point[*point].mark = 0;
  mesh->source[*point] = source;
done:
  return status;
}

void cw_tet_mesh_free(CwTetMesh *mesh) {
  free(mesh->point);
  free(mesh->source);
  free(mesh->tet);
  free(mesh->duplicate);
  memset(mesh, 0, sizeof *mesh);
}
