// SPDX-License-Identifier: AGPL-3.0-or-later
// Counts the cells of a finished run across its narrow places. From the middle of every so many wall triangles of the
// background a ray goes straight to the wall or open patch across; where that is near and faces it, the cells on the
// way are counted. Prints for each pair of patches: rays, least number of cells across.
// Use: cells_across GEOMETRY_DIR MESH_DIR GREATEST_GAP_MM
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/background_make.h"
#include "mesher/cad/rays.h"
#include "mesher/common/vec.h"
#include "tests/measure/domain_mesh.h"

static const double FACING = 0.9; // cosine between the ray and the wall it meets
enum { RAYS = 1200 };             // a domain, about

typedef struct {
  int from, to; // patches
  double a[3], b[3];
  int cells;
} Probe;

// Whether the segment a b runs through the tetrahedron: it is cut by the planes of its four faces.
static int crosses(const double *const x[4], const double a[3], const double b[3]) {
  static const int face[4][4] = {{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}};
  double from = 0, to = 1;
  for (int f = 0; f < 4; f++) {
    double n[3], w[3];
    cw_normal(x[face[f][0]], x[face[f][1]], x[face[f][2]], n);
    cw_sub(x[face[f][3]], x[face[f][0]], w);
    double side = cw_dot(n, w) > 0 ? 1 : -1, at[2];
    cw_sub(a, x[face[f][0]], w);
    at[0] = side * cw_dot(n, w);
    cw_sub(b, x[face[f][0]], w);
    at[1] = side * cw_dot(n, w);
    if (at[0] < 0 && at[1] < 0) return 0;
    if (at[0] < 0) from = fmax(from, at[0] / (at[0] - at[1]));
    if (at[1] < 0) to = fmin(to, at[0] / (at[0] - at[1]));
  }
  return to - from > 1e-9;
}

static int box_misses(const double *const *x, int corners, const Probe *probe) {
  for (int k = 0; k < 3; k++) {
    double low = INFINITY, high = -INFINITY;
    for (int c = 0; c < corners; c++) {
      low = fmin(low, x[c][k]);
      high = fmax(high, x[c][k]);
    }
    if (fmax(probe->a[k], probe->b[k]) < low || fmin(probe->a[k], probe->b[k]) > high) return 1;
  }
  return 0;
}

static void count_cell(const double *const *x, int corners, Probe *probe, int probes) {
  for (int p = 0; p < probes; p++) {
    if (box_misses(x, corners, &probe[p])) continue;
    int hit;
    if (corners == 4) {
      hit = crosses(x, probe[p].a, probe[p].b);
    } else { // a prism as three tetrahedra
      const double *const part[3][4] = {{x[0], x[1], x[2], x[3]}, {x[1], x[2], x[3], x[4]}, {x[2], x[3], x[4], x[5]}};
      hit = crosses(part[0], probe[p].a, probe[p].b) || crosses(part[1], probe[p].a, probe[p].b) ||
            crosses(part[2], probe[p].a, probe[p].b);
    }
    probe[p].cells += hit;
  }
}

static int find_probes(const CwCad *cad, const CwBackground *background, double greatest, Probe *probe) {
  int32_t step = background->triangle_count / RAYS + 1;
  int count = 0;
  for (int32_t t = 0; t < background->triangle_count; t += step) {
    double centre[3], n[3], away[3], gap;
    if (cw_cad_patch_kind(cad, cw_cad_face_patch(cad, background->face[t])) != CW_PATCH_WALL) continue;
    const double *corner_x[3];
    for (int k = 0; k < 3; k++) corner_x[k] = background->x[background->triangle[t][k]];
    cw_normal(corner_x[0], corner_x[1], corner_x[2], n);
    cw_unit(n);
    for (int k = 0; k < 3; k++) {
      centre[k] = (corner_x[0][k] + corner_x[1][k] + corner_x[2][k]) / 3;
      away[k] = -n[k];
    }
    int32_t hit = cw_rays_exit(background->rays, centre, away, 1e-5, greatest, &gap);
    if (hit < 0) continue;
    const int32_t *corner = background->triangle[hit];
    cw_normal(background->x[corner[0]], background->x[corner[1]], background->x[corner[2]], n);
    cw_unit(n);
    if (cw_dot(n, away) < FACING) continue;
    Probe *made = &probe[count++];
    *made = (Probe){.from = cw_cad_face_patch(cad, background->face[t]),
                    .to = cw_cad_face_patch(cad, background->face[hit])};
    for (int k = 0; k < 3; k++) { // a little beyond both walls: the mesh has its own chords
      made->a[k] = centre[k] - 0.02 * gap * away[k];
      made->b[k] = centre[k] + 1.02 * gap * away[k];
    }
  }
  return count;
}

static int compare_probes(const void *p, const void *q) {
  const Probe *a = p, *b = q;
  if (a->from != b->from) return a->from - b->from;
  if (a->to != b->to) return a->to - b->to;
  return a->cells - b->cells;
}

static void print_pairs(const CwCad *cad, const char *name, Probe *probe, int count) {
  qsort(probe, (size_t)count, sizeof *probe, compare_probes);
  for (int first = 0, next; first < count; first = next) {
    for (next = first; next < count && probe[next].from == probe[first].from && probe[next].to == probe[first].to;)
      next++;
    printf("%-7s %-22s %-22s %5d %6d\n", name, cw_cad_patch_name(cad, probe[first].from),
           cw_cad_patch_name(cad, probe[first].to), next - first, probe[first].cells);
  }
}

static CwStatus measure(const char *geometry, const char *folder, const char *name, double greatest) {
  CwStatus status = CW_OK;
  CwCad *cad = NULL;
  CwBackground background = {0};
  CwDomainMesh mesh = {0};
  Probe *probe = NULL;
  CW_TRY(cw_cad_open(geometry, name, &cad));
  CW_TRY(cw_background_make(cad, 4e-5, 0.2, &background));
  CW_TRY(cw_domain_mesh_read(folder, name, &mesh));
  CW_NEW(probe, 2 * RAYS);
  int count = find_probes(cad, &background, greatest, probe);
  for (int32_t r = 0; r < mesh.region_count; r++) {
    const CwRegionMesh *region = &mesh.region[r];
    const double *x[6];
    for (int32_t t = 0; t < region->cells.tetrahedron_count; t++) {
      for (int k = 0; k < 4; k++) x[k] = region->cells.points[region->cells.tetrahedra[t][k]];
      count_cell(x, 4, probe, count);
    }
    for (int32_t t = 0; t < region->cells.prism_count; t++) {
      for (int k = 0; k < 6; k++) x[k] = region->cells.points[region->cells.prisms[t][k]];
      count_cell(x, 6, probe, count);
    }
  }
  print_pairs(cad, name, probe, count);
done:
  free(probe);
  cw_domain_mesh_free(&mesh);
  cw_background_free(&background);
  cw_cad_close(&cad);
  return status;
}

int main(int argc, char **argv) {
  double greatest = argc == 4 ? 1e-3 * strtod(argv[3], NULL) : 0;
  if (!(greatest > 0)) {
    fprintf(stderr, "use: cells_across GEOMETRY_DIR MESH_DIR GREATEST_GAP_MM\n");
    return CW_ERR_USAGE;
  }
  printf("%-7s %-22s %-22s %5s %6s\n", "domain", "from", "to", "rays", "cells");
  CwStatus status = measure(argv[1], argv[2], "rotor", greatest);
  if (status == CW_OK) status = measure(argv[1], argv[2], "stator", greatest);
  if (status != CW_OK) fprintf(stderr, "%s\n", cw_fail_message());
  return (int)status;
}
