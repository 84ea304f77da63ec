// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/kernel.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/boundary_check.h"
#include "mesher/delaunay.h"
#include "mesher/fill_points.h"
#include "mesher/fill_shape.h"
#include "mesher/kernel_facets.h"
#include "mesher/kernel_flat.h"
#include "mesher/kernel_recover.h"
#include "mesher/kernel_split.h"
#include "mesher/tet_improve.h"
#include "mesher/tet_mesh.h"
#include "pipeline/log.h"

// Boundary points, then inner candidates.
static CwStatus all_points(const CwFillInput *input, int32_t *count, double (**x)[3]) {
  CwStatus status = CW_OK;
  double(*inner)[3] = NULL;
  int32_t inner_count = 0;
  CW_TRY(cw_fill_points(input, 1.0, &inner_count, &inner));
  CW_NEW(*x, input->point_count + inner_count);
  memcpy(*x, input->x, (size_t)input->point_count * sizeof **x);
  memcpy(*x + input->point_count, inner, (size_t)inner_count * sizeof **x);
  *count = input->point_count + inner_count;
done:
  free(inner);
  return status;
}

enum { ROUNDS = 4 }; // of recovery: what one facet could not have may be free after others have theirs
static const double NEARLY_FLAT = 1e-3; // quality of which some are as flat as rounding
enum { AHEAD = 12 }; // places of the queue whose tetrahedra are on their way from memory
enum { OPEN = 0, INSIDE = 1, OUTSIDE = 2, SIDE = 3 }; // and bit 2 + i: face i is a facet

// Floods from both sides of all facets; place[t] holds the side and the facets of each tetrahedron.
static CwStatus classify(const CwFillInput *input, const CwDelaunay *mesh, const CwFacets *facets,
                         uint8_t *place) {
  CwStatus status = CW_OK;
  int32_t *queue = NULL, head = 0, count = 0;
  CW_NEW(queue, mesh->tet_count);
  for (int32_t f = 0; f < facets->count; f++) {
    int32_t face[2] = {facets->inner[f], mesh->tet[facets->inner[f] / 4].neighbour[facets->inner[f] % 4]};
    for (int k = 0; k < 2; k++) {
      uint8_t *here = &place[face[k] / 4], side = k == 0 ? INSIDE : OUTSIDE;
      const double *x = mesh->point[facets->corner[f][0]].x;
      CW_REQUIRE(
          (*here & SIDE) == OPEN || (*here & SIDE) == side, CW_ERR_MESH,
          "%s: boundary triangle at (%.6g, %.6g, %.6g) mm has its normal turned against its neighbours",
          input->name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
      if ((*here & SIDE) == OPEN)
        queue[count++] = face[k] / 4;
      *here |= (uint8_t)(side | 4 << face[k] % 4);
    }
  }
  while (head < count) {
    if (head + AHEAD < count)
      __builtin_prefetch(&mesh->tet[queue[head + AHEAD]]);
    int32_t t = queue[head++];
    const CwDelaunayTet *tet = &mesh->tet[t];
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] < 0 || place[t] & 4 << i)
        continue;
      uint8_t *next = &place[tet->neighbour[i] / 4];
      if ((*next & SIDE) == OPEN) {
        *next |= place[t] & SIDE;
        queue[count++] = tet->neighbour[i] / 4;
        continue;
      }
      const double *x = mesh->point[tet->corner[0]].x;
      CW_REQUIRE(((*next ^ place[t]) & SIDE) == 0, CW_ERR_MESH,
                 "%s: inside and outside of the boundary meet near (%.6g, %.6g, %.6g) mm: normals disagree",
                 input->name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
    }
  }
done:
  free(queue);
  return status;
}

// Frees all tetrahedra outside and cuts the others off them.
static CwStatus keep_inside(const CwFillInput *input, CwDelaunay *mesh, const uint8_t *place) {
  CwStatus status = CW_OK;
  int32_t count = mesh->tet_count;
  for (int32_t t = 0; t < count; t++) {
    CwDelaunayTet *tet = &mesh->tet[t];
    if (tet->corner[0] < 0)
      continue;
    if ((place[t] & SIDE) != INSIDE) {
      CW_TRY(cw_delaunay_free_tet(mesh, t));
      continue;
    }
    int own = 0;
    while (own < 3 && tet->corner[own] < CW_DELAUNAY_CORNERS)
      own++;
    const double *x = mesh->point[tet->corner[own]].x;
    for (int i = 0; i < 4; i++) {
      if (place[t] & 4 << i)
        tet->neighbour[i] = -1;
      CW_REQUIRE(tet->corner[i] >= CW_DELAUNAY_CORNERS, CW_ERR_MESH,
                 "%s: the boundary encloses all that lies outside it: its normals point inward near "
                 "(%.6g, %.6g, %.6g) mm",
                 input->name, 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
    }
  }
done:
  return status;
}

// Brings all boundary triangles into the mesh: by flips and cleared hollows, and at last by divisions of the
// boundary. CW_RETRY where some are still missing.
static CwStatus recover(const CwFillInput *input, CwDelaunay *mesh, CwFacets *facets, int32_t *source_count,
                        CwSplits *splits, CwFillWay *way) {
  CwStatus status = CW_OK;
  CwRecovered recovered = {0};
  cw_facets_locate(mesh, input->point_count, facets);
  way->missing = facets->missing_count;
  for (int round = 0; round < ROUNDS && facets->missing_count; round++) {
    CW_TRY(cw_kernel_recover(mesh, facets, round, source_count, &recovered));
    cw_facets_locate(mesh, input->point_count, facets);
  }
  if (facets->missing_count) {
    CW_TRY(cw_boundary_check_crossing(input));
    CW_TRY(cw_kernel_split(mesh, facets, source_count, splits, &recovered));
    cw_facets_locate(mesh, input->point_count, facets);
  }
  if (facets->missing_count) {
    cw_log_debug("%s: %d of %d boundary triangles are missing", input->name, facets->missing_count,
                 facets->count);
    status = CW_RETRY;
  }
done:
  way->flips = (int32_t)(recovered.flips < INT32_MAX ? recovered.flips : INT32_MAX);
  way->cleared = recovered.cleared;
  way->divided = splits->count;
  return status;
}

// Where the improvement left tetrahedra that may be flat.
static CwStatus raise_flat(const CwFillInput *input, CwDelaunay *mesh, int32_t *source_count,
                           const CwTetImproved *improved, int32_t *raised) {
  CwStatus status = CW_OK;
  int32_t left;
  *raised = 0;
  if (improved->least_after > NEARLY_FLAT)
    goto done;
  CW_TRY(cw_kernel_flat(mesh, source_count, raised, &left));
  cw_log_debug("%s: %d flat tetrahedra raised, %d not", input->name, *raised, left);
done:
  return status;
}

CwStatus cw_kernel_fill(const CwFillInput *input, CwFill *fill) {
  CwStatus status = CW_OK;
  CwDelaunay mesh = {0};
  CwFacets facets = {0};
  CwSplits splits = {0};
  CwTetImproved improved;
  CwFillWay way = {0};
  double(*x)[3] = NULL;
  uint8_t *place = NULL;
  int32_t count = 0, raised = 0;
  int good = 1;
  memset(fill, 0, sizeof *fill);
  CW_TRY(cw_boundary_check(input));
  CW_TRY(all_points(input, &count, &x));
  CW_TRY(cw_delaunay_make(count, (const double(*)[3])x, &mesh));
  free(x);
  x = NULL;
  CW_TRY(cw_facets_make(input, &mesh, &facets));
  CW_TRY(recover(input, &mesh, &facets, &count, &splits, &way));
  CW_NEW(place, mesh.tet_count);
  CW_TRY(classify(input, &mesh, &facets, place));
  cw_facets_free(&facets);
  CW_TRY(keep_inside(input, &mesh, place));
  free(place);
  place = NULL;
  if (splits.count) {
    // Flat tetrahedra leave the points no room to move; all others are held meanwhile.
    CW_TRY(cw_tet_improve_mesh(&mesh, count, &count, &improved));
    CW_TRY(raise_flat(input, &mesh, &count, &improved, &raised));
    CW_TRY(cw_kernel_unsplit(&mesh, &splits, &good));
  }
  if (!good) {
    cw_log_debug("%s: no room to take %d points off the boundary", input->name, splits.count);
    status = CW_RETRY;
    goto done;
  }
  CW_TRY(cw_tet_improve_mesh(&mesh, input->point_count, &count, &improved));
  CW_TRY(raise_flat(input, &mesh, &count, &improved, &raised));
  if (raised)
    CW_TRY(cw_tet_improve_mesh(&mesh, input->point_count, &count, &improved));
  CW_TRY(cw_tet_mesh_take(&mesh, input->point_count, count, fill));
  cw_log_debug(
      "%s: %d tetrahedra, %d edges and %d faces removed, %d points moved, %d added, least sine %.3g to %.3g",
      input->name, fill->tetrahedron_count, improved.edges_removed, improved.faces_removed,
      improved.points_moved, improved.points_added, improved.least_before, improved.least_after);
done:
  free(place);
  free(x);
  cw_splits_free(&splits);
  cw_facets_free(&facets);
  cw_delaunay_free(&mesh);
  if (status != CW_OK)
    cw_fill_free(fill);
  fill->way = way;
  return status;
}
