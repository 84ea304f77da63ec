// SPDX-License-Identifier: AGPL-3.0-or-later
// Whether both sides of each interface of a finished domain are one, by its region files alone. The open faces of a
// region, those in one of its cells and on no patch, have the same nodes in one other region, which has another region
// number and sees them from the other side; a shared point has the same bits in all regions. Prints for each domain its
// regions and the triangles between them; returns 1 where something differs.
// Use: interface_sides MESH_DIR DOMAIN...
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "pipeline/mesh/region_faces.h"
#include "tests/measure/domain_mesh.h"

// A face from one side: its nodes in the order of cw_face_loop, -1 behind those of a triangle, and whether they run
// against the face of its cell.
typedef struct {
  int64_t node[4];
  int32_t region;
  int reversed;
} Side;

typedef struct {
  int64_t id;
  double x[3];
} Point;

static int compare_sides(const void *left, const void *right) {
  const Side *a = left, *b = right;
  for (int k = 0; k < 4; k++) {
    if (a->node[k] != b->node[k]) return a->node[k] < b->node[k] ? -1 : 1;
  }
  return 0;
}

static int compare_points(const void *left, const void *right) {
  const Point *a = left, *b = right;
  return (a->id > b->id) - (a->id < b->id);
}

// Appends the open faces of a region to *side, which has `*count`.
static CwStatus add_sides(const CwRegionMesh *region, int32_t place, Side **side, int32_t *count) {
  CwStatus status = CW_OK;
  int32_t *open = NULL, opens = 0;
  CW_TRY(cw_region_open_faces(region->domain, CW_ERR_MESH, &region->cells, 0, NULL, NULL, &open, &opens));
  Side *grown = realloc(*side, (size_t)(*count + opens + 1) * sizeof **side);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory");
  *side = grown;
  for (int32_t i = 0; i < opens; i++) {
    int32_t local[4];
    int64_t node[4];
    int order[4], corners = cw_cell_face(&region->cells, open[i] / CW_CELL_FACES, open[i] % CW_CELL_FACES, local);
    for (int k = 0; k < corners; k++) node[k] = region->cells.shared_id[local[k]];
    Side *made = &(*side)[(*count)++];
    *made = (Side){.node[3] = -1, .region = place, .reversed = cw_face_loop(node, corners, order)};
    for (int k = 0; k < corners; k++) made->node[k] = node[order[k]];
  }
done:
  free(open);
  return status;
}

static CwStatus match_sides(const char *domain, const CwDomainMesh *mesh, int32_t count, Side *side) {
  CwStatus status = CW_OK;
  qsort(side, (size_t)count, sizeof *side, compare_sides);
  for (int32_t i = 0; i < count; i += 2) {
    const Side *a = &side[i], *b = a + 1;
    int pair = i + 1 < count && !compare_sides(a, b) && (i + 2 == count || compare_sides(b, b + 1));
    CW_REQUIRE(pair && a->reversed != b->reversed && mesh->region[a->region].number != mesh->region[b->region].number,
               CW_ERR_MESH,
               "%s: the face of the nodes %lld %lld %lld %lld in region %d is not that of one other region", domain,
               (long long)a->node[0], (long long)a->node[1], (long long)a->node[2], (long long)a->node[3],
               a->region + 1);
  }
done:
  return status;
}

// Holds the places of shared points against one another.
static CwStatus match_points(const char *domain, const CwDomainMesh *mesh) {
  CwStatus status = CW_OK;
  Point *point = NULL;
  int32_t count = 0;
  for (int32_t r = 0; r < mesh->region_count; r++) count += mesh->region[r].cells.shared_count;
  CW_NEW(point, count);
  count = 0;
  for (int32_t r = 0; r < mesh->region_count; r++) {
    const CwRegionData *cells = &mesh->region[r].cells;
    for (int32_t p = 0; p < cells->shared_count; p++) {
      point[count].id = cells->shared_id[p];
      memcpy(point[count++].x, cells->points[p], sizeof point->x);
    }
  }
  qsort(point, (size_t)count, sizeof *point, compare_points);
  for (int32_t i = 1; i < count; i++) {
    int same = point[i].id == point[i - 1].id;
    CW_REQUIRE(!same || !memcmp(point[i].x, point[i - 1].x, sizeof point->x), CW_ERR_MESH,
               "%s: shared point %lld has two places", domain, (long long)point[i].id);
  }
done:
  free(point);
  return status;
}

static CwStatus judge(const char *folder, const char *domain) {
  CwStatus status = CW_OK;
  CwDomainMesh mesh = {0};
  Side *side = NULL;
  int32_t count = 0, triangles = 0;
  CW_TRY(cw_domain_mesh_read(folder, domain, &mesh));
  for (int32_t r = 0; r < mesh.region_count; r++) CW_TRY(add_sides(&mesh.region[r], r, &side, &count));
  CW_TRY(match_sides(domain, &mesh, count, side));
  CW_TRY(match_points(domain, &mesh));
  for (int32_t i = 0; i < count; i += 2) triangles += side[i].node[3] < 0;
  printf("%s %d %d\n", domain, mesh.region_count, triangles);
done:
  free(side);
  cw_domain_mesh_free(&mesh);
  return status;
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CW_REQUIRE(argc > 2, CW_ERR_USAGE, "use: interface_sides MESH_DIR DOMAIN...");
  for (int k = 2; k < argc; k++) CW_TRY(judge(argv[1], argv[k]));
done:
  if (status != CW_OK) fprintf(stderr, "interface_sides: %s\n", cw_fail_message());
  return status != CW_OK;
}
