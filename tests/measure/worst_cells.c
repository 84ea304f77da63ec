// SPDX-License-Identifier: AGPL-3.0-or-later
// Prints the tetrahedra of a domain with the least dihedral angles: what they are, where, and what each corner lies on:
// T layer top or bare wall, P partition plane, O open patch; - none, the mesher was free to move it. Regions are read
// one at a time.
// Use: worst_cells MESH_DIR DOMAIN COUNT
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mesher/common/quality.h"
#include "mesher/region/region_file.h"

enum { TOP = 1, PLANE = 2, OPEN = 4, WORST_MOST = 1000 };

typedef struct {
  double angle, x[4][3];
  int32_t region;
  uint8_t on[4];
} Worst;

typedef struct {
  int count, most;
  Worst cell[WORST_MOST]; // the worst first
} List;

static void put(List *list, const Worst *cell) {
  int at = list->count < list->most ? list->count++ : list->most;
  for (; at > 0 && list->cell[at - 1].angle > cell->angle; at--) {
    if (at < list->most) list->cell[at] = list->cell[at - 1];
  }
  if (at < list->most) list->cell[at] = *cell;
}

static CwStatus find_worst(const CwRegionMesh *region, List *list) {
  CwStatus status = CW_OK;
  const CwRegionData *cells = &region->cells;
  uint8_t *on = NULL;
  CW_NEW(on, cells->point_count);
  for (int32_t p = 0; p < cells->shared_count; p++) on[p] |= PLANE;
  for (int32_t t = 0; t < cells->prism_count; t++) {
    for (int k = 0; k < 6; k++) on[cells->prisms[t][k]] |= TOP;
  }
  for (int32_t t = 0; t < cells->triangle_count; t++) {
    for (int k = 0; k < 3; k++) on[cells->triangles[t][k]] |= OPEN;
  }
  for (int32_t t = 0; t < cells->tetrahedron_count; t++) {
    const double *x[4];
    CwTetShape shape;
    for (int k = 0; k < 4; k++) x[k] = cells->points[cells->tetrahedra[t][k]];
    cw_tet_shape(x, &shape);
    if (list->count == list->most && shape.dihedral_least >= list->cell[list->count - 1].angle) continue;
    Worst cell = {.angle = shape.dihedral_least, .region = region->region};
    for (int k = 0; k < 4; k++) {
      memcpy(cell.x[k], x[k], sizeof cell.x[k]);
      cell.on[k] = on[cells->tetrahedra[t][k]];
    }
    put(list, &cell);
  }
done:
  free(on);
  return status;
}

static void print_cell(const Worst *cell) {
  static const int edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  const double *x[4] = {cell->x[0], cell->x[1], cell->x[2], cell->x[3]};
  double centre[3] = {0};
  CwTetShape shape;
  cw_tet_shape(x, &shape);
  for (int k = 0; k < 12; k++) centre[k % 3] += 250 * x[k / 3][k % 3];
  printf("%7.3f %8.3f %6d %10.4f %10.4f %10.4f %9.6f %9.6f ", cell->angle, shape.dihedral_greatest, cell->region,
         centre[0], centre[1], centre[2], 1e3 * shape.edge_shortest, 1e3 * shape.edge_longest);
  for (int k = 0; k < 4; k++) {
    printf(" %s%s%s%s", cell->on[k] & TOP ? "T" : "", cell->on[k] & PLANE ? "P" : "", cell->on[k] & OPEN ? "O" : "",
           cell->on[k] ? "" : "-");
  }
  printf(" ");
  for (int e = 0; e < 6; e++) { // the edges that are given: both ends are
    if (cell->on[edge[e][0]] && cell->on[edge[e][1]]) printf(" %d-%d", edge[e][0], edge[e][1]);
  }
  printf("\n");
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  static List list;
  CwRegionMesh region;
  int regions = 0;
  memset(&region, 0, sizeof region);
  list.most = argc == 4 ? atoi(argv[3]) : 0;
  CW_REQUIRE(list.most > 0 && list.most <= WORST_MOST, CW_ERR_USAGE, "use: worst_cells MESH_DIR DOMAIN COUNT, to %d",
             WORST_MOST);
  for (;; regions++) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s-%04d.h5", argv[1], argv[2], regions + 1);
    CW_REQUIRE(regions || !access(path, R_OK), CW_ERR_INPUT, "%s: no such file", path);
    if (access(path, R_OK)) break;
    CW_TRY(cw_region_read(path, &region));
    CW_TRY(find_worst(&region, &list));
    cw_region_free(&region);
  }
  printf("least_deg greatest_deg region x_mm y_mm z_mm shortest_mm longest_mm corners given_edges\n");
  for (int i = 0; i < list.count; i++) print_cell(&list.cell[i]);
done:
  cw_region_free(&region);
  if (status != CW_OK) fprintf(stderr, "worst_cells: %s\n", cw_fail_message());
  return status != CW_OK;
}
