// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/kernel.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/delaunay.h"
#include "mesher/fill_shape.h"
#include "mesher/kernel_facets.h"
#include "mesher/kernel_improve.h"
#include "mesher/kernel_points.h"
#include "mesher/kernel_recover.h"
#include "pipeline/log.h"

// Boundary points, then inner candidates.
static CwStatus all_points(const CwFillInput *input, int32_t *count, double (**x)[3]) {
  CwStatus status = CW_OK;
  double(*made)[3] = NULL;
  const double(*inner)[3] = input->inner;
  int32_t inner_count = input->inner_count;
  if (!inner) {
    CW_TRY(cw_kernel_points(input, &inner_count, &made));
    inner = (const double(*)[3])made;
  }
  CW_NEW(*x, input->point_count + inner_count);
  memcpy(*x, input->x, (size_t)input->point_count * sizeof **x);
  memcpy(*x + input->point_count, inner, (size_t)inner_count * sizeof **x);
  *count = input->point_count + inner_count;
done:
  free(made);
  return status;
}

enum { ROUNDS = 6 }; // of recovery: what one facet could not have may be free after others have theirs
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
    for (int i = 0; i < 4; i++) {
      if (place[t] & 4 << i)
        tet->neighbour[i] = -1;
      CW_REQUIRE(tet->corner[i] >= CW_DELAUNAY_CORNERS, CW_ERR_MESH,
                 "%s: nothing lies inside the boundary: its normals point inward", input->name);
    }
  }
done:
  return status;
}

// All tetrahedra; the given boundary points first, then the inner points that are used, in the order of their
// sources. The corners are moved together in the mesh's own memory, which goes over to the fill: no second
// copy at the peak.
static CwStatus take(const CwFillInput *input, CwDelaunay *mesh, int32_t source_count, CwFill *fill) {
  CwStatus status = CW_OK;
  int32_t *number = NULL, kept = 0, points = input->point_count;
  int32_t(*made)[4] = (int32_t(*)[4])(void *)mesh->tet;
  CW_NEW(number, source_count);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    int32_t corner[4];
    memcpy(corner, mesh->tet[t].corner, sizeof corner);
    if (corner[0] < 0)
      continue;
    for (int i = 0; i < 4; i++) {
      corner[i] = mesh->source[corner[i]];
      number[corner[i]] = 1;
    }
    memcpy(made[kept++], corner, sizeof corner);
  }
  mesh->tet = NULL;
  fill->tetrahedron = realloc(made, (size_t)kept * sizeof *made);
  if (!fill->tetrahedron)
    fill->tetrahedron = made;
  fill->tetrahedron_count = kept;
  for (int32_t p = 0; p < source_count; p++) {
    if (p < input->point_count)
      number[p] = p;
    else
      number[p] = number[p] ? points++ : -1;
  }
  for (int32_t t = 0; t < kept; t++) {
    for (int i = 0; i < 4; i++)
      fill->tetrahedron[t][i] = number[fill->tetrahedron[t][i]];
  }
  fill->x = malloc((size_t)points * sizeof *fill->x);
  CW_REQUIRE(fill->x, CW_ERR_MEMORY, "%s: out of memory: %d points", input->name, points);
  for (int32_t p = CW_DELAUNAY_CORNERS; p < mesh->point_count; p++) {
    int32_t to = number[mesh->source[p]];
    if (to >= 0)
      memcpy(fill->x[to], mesh->point[p].x, sizeof *fill->x);
  }
  fill->point_count = points;
done:
  free(number);
  return status;
}

CwStatus cw_kernel_fill(const CwFillInput *input, CwFill *fill) {
  CwStatus status = CW_OK;
  CwDelaunay mesh = {0};
  CwFacets facets = {0};
  CwTetImproved improved;
  double(*x)[3] = NULL;
  uint8_t *place = NULL;
  int32_t count = 0;
  memset(fill, 0, sizeof *fill);
  CW_TRY(cw_fill_check_closed(input));
  CW_TRY(all_points(input, &count, &x));
  CW_TRY(cw_delaunay_make(count, (const double(*)[3])x, &mesh));
  free(x);
  x = NULL;
  CW_TRY(cw_facets_make(input, &mesh, &facets));
  cw_facets_locate(&mesh, input->point_count, &facets);
  for (int round = 0; round < ROUNDS && facets.missing_count; round++) {
    CW_TRY(cw_kernel_recover(&mesh, &facets, round, &count));
    cw_facets_locate(&mesh, input->point_count, &facets);
  }
  if (facets.missing_count) {
    cw_log_debug("%s: %d of %d boundary triangles are missing", input->name, facets.missing_count,
                 facets.count);
    status = CW_RETRY;
    goto done;
  }
  CW_NEW(place, mesh.tet_count);
  CW_TRY(classify(input, &mesh, &facets, place));
  cw_facets_free(&facets);
  CW_TRY(keep_inside(input, &mesh, place));
  free(place);
  place = NULL;
  CW_TRY(cw_kernel_improve(&mesh, input->point_count, &count, &improved));
  CW_TRY(take(input, &mesh, count, fill));
  cw_log_debug(
      "%s: %d tetrahedra, %d edges and %d faces removed, %d points moved, %d added, least sine %.3g to %.3g",
      input->name, fill->tetrahedron_count, improved.edges_removed, improved.faces_removed,
      improved.points_moved, improved.points_added, improved.least_before, improved.least_after);
done:
  free(place);
  free(x);
  cw_facets_free(&facets);
  cw_delaunay_free(&mesh);
  if (status != CW_OK)
    cw_fill_free(fill);
  return status;
}
