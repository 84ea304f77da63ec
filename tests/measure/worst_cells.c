// SPDX-License-Identifier: AGPL-3.0-or-later
// Prints the tetrahedra of a domain with the least dihedral angles: what they are, where, and what each corner lies on:
// T layer top or bare wall, P partition plane, O open patch; - none, the mesher was free to move it. Of its edges
// between two of the former: the angle that all tetrahedra of the region take up there, and how many they are (360
// degrees: an edge inside). Regions are read one at a time.
// Use: worst_cells MESH_DIR DOMAIN COUNT
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/region/region_file.h"

enum { TOP = 1, PLANE = 2, OPEN = 4, WORST_MOST = 1000 };

static const int edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

typedef struct {
  double angle, x[4][3];
  int32_t region, point[4];
  uint8_t on[4];
  double edge_angle[6];
  int edge_cells[6];
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
      cell.point[k] = cells->tetrahedra[t][k];
      cell.on[k] = on[cells->tetrahedra[t][k]];
    }
    put(list, &cell);
  }
done:
  free(on);
  return status;
}

// Angle (degrees) of a tetrahedron at the edge from a to b, with c and d across.
static double angle_at(const double *a, const double *b, const double *c, const double *d) {
  double along[3], to_c[3], to_d[3];
  cw_sub(b, a, along);
  cw_unit(along);
  cw_sub(c, a, to_c);
  cw_sub(d, a, to_d);
  cw_flatten(to_c, along);
  cw_flatten(to_d, along);
  return acos(fmax(-1, fmin(1, cw_dot(to_c, to_d) / (cw_norm(to_c) * cw_norm(to_d))))) * 180 / M_PI;
}

// Adds up what lies round the given edges of the listed cells of a region.
static void find_angles(const CwRegionMesh *region, List *list) {
  const CwRegionData *cells = &region->cells;
  for (int32_t t = 0; t < cells->tetrahedron_count; t++) {
    const int32_t *corner = cells->tetrahedra[t];
    for (int i = 0; i < list->count; i++) {
      Worst *cell = &list->cell[i];
      if (cell->region != region->region) continue;
      for (int e = 0; e < 6; e++) {
        int32_t a = cell->point[edge[e][0]], b = cell->point[edge[e][1]];
        const double *across[4];
        int ends = 0, others = 0;
        for (int k = 0; k < 4; k++) {
          if (corner[k] == a || corner[k] == b)
            ends++;
          else
            across[others++] = cells->points[corner[k]];
        }
        if (ends != 2) continue;
        cell->edge_angle[e] += angle_at(cells->points[a], cells->points[b], across[0], across[1]);
        cell->edge_cells[e]++;
      }
    }
  }
}

static void print_cell(const Worst *cell) {
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
    if (cell->on[edge[e][0]] && cell->on[edge[e][1]]) {
      printf(" %d-%d:%.1f/%d", edge[e][0], edge[e][1], cell->edge_angle[e], cell->edge_cells[e]);
    }
  }
  printf("\n");
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  static List list;
  CwRegionMesh region;
  memset(&region, 0, sizeof region);
  list.most = argc == 4 ? atoi(argv[3]) : 0;
  CW_REQUIRE(list.most > 0 && list.most <= WORST_MOST, CW_ERR_USAGE, "use: worst_cells MESH_DIR DOMAIN COUNT, to %d",
             WORST_MOST);
  for (int pass = 0; pass < 2; pass++) {
    for (int32_t number = 1;; number++) {
      char path[4096];
      int listed = pass == 0;
      snprintf(path, sizeof path, "%s/%s-%04d.h5", argv[1], argv[2], number);
      CW_REQUIRE(number > 1 || !access(path, R_OK), CW_ERR_INPUT, "%s: no such file", path);
      if (access(path, R_OK)) break;
      for (int i = 0; i < list.count; i++) listed |= list.cell[i].region == number;
      if (!listed) continue;
      CW_TRY(cw_region_read(path, &region));
      if (pass == 0) CW_TRY(find_worst(&region, &list));
      if (pass == 1) find_angles(&region, &list);
      cw_region_free(&region);
    }
  }
  printf("least_deg greatest_deg region x_mm y_mm z_mm shortest_mm longest_mm corners given_edges_deg\n");
  for (int i = 0; i < list.count; i++) print_cell(&list.cell[i]);
done:
  cw_region_free(&region);
  if (status != CW_OK) fprintf(stderr, "worst_cells: %s\n", cw_fail_message());
  return status != CW_OK;
}
