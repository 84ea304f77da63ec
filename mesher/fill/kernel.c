// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/give_back.h"
#include "mesher/common/model_unit.h"
#include "mesher/fill/boundary_check.h"
#include "mesher/fill/delaunay.h"
#include "mesher/fill/fill_mesh.h"
#include "mesher/fill/fill_points.h"
#include "mesher/fill/kernel_core.h"
#include "mesher/fill/kernel_facets.h"
#include "mesher/fill/kernel_recover.h"
#include "mesher/fill/tet_improve.h"
#include "mesher/policy.h"
#include "pipeline/log.h"

// Boundary points, then inner candidates, in the mesh but not yet connected; the deep ones of the lattice in the
// core.
static CwStatus all_points(const CwFillInput *input, CwKernelCore *core, int32_t *count, CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  double(*made)[3] = NULL, (*x)[3] = NULL;
  CwLatticeSite *made_site = NULL;
  const double(*inner)[3] = input->inner;
  const CwLatticeSite *site = input->inner_site;
  int32_t inner_count = input->inner_count;
  if (!inner) {
    CW_TRY(cw_fill_points(input, 1.0, &inner_count, &made, &made_site));
    inner = (const double(*)[3])made;
    site = made_site;
  }
  CW_TRY(cw_kernel_core_make(input, inner_count, inner, site, core, count, &x));
  CW_TRY(cw_delaunay_order(*count, (const double(*)[3])x, mesh));
done:
  free(made);
  free(made_site);
  free(x);
  return status;
}

enum { INNER = 16, OUTSIDE = 32 }; // of a tetrahedron, and bit i: its face i is a facet
#define MARKED (UINT32_C(1) << 31) // and any of these
enum { SOON = 8, LATER = 16 };     // facets ahead of which is prefetched, for the outer and the inner tetrahedron

// Stands where the square of the sphere's radius stood, and has its sign set, which no square has: whether a
// tetrahedron has one is as good as random, and this takes no branch.
static uint32_t place_of(const CwTet *tet) {
  return tet->mark & -(tet->mark >> 31);
}

static void add_place(CwTet *tet, uint32_t place) {
  tet->mark = place_of(tet) | place | MARKED;
}

// A point that hangs together with a corner of the tetrahedron that encloses all.
static const double *find_enclosed(const CwTetMesh *mesh) {
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    int own = -1, corners = 0;
    for (int i = 0; i < 4; i++) {
      corners += c[i] < CW_ENCLOSING_POINTS;
      own = c[i] < CW_ENCLOSING_POINTS ? own : i;
    }
    if (c[0] >= 0 && corners && own >= 0) return mesh->point[c[own]].x;
  }
  return mesh->point[0].x;
}

// Marks a tetrahedron as outside and puts it into the chain of those that wait. 1 where it has a corner of the one that
// encloses all.
static int add_outside(CwTetMesh *mesh, int32_t t, int32_t *waiting) {
  CwTet *tet = &mesh->tet[t];
  int enclosing = 0;
  for (int i = 0; i < 4; i++) {
    enclosing |= tet->corner[i] < CW_ENCLOSING_POINTS;
    cw_tet_prefetch(mesh->tet, tet->neighbour[i] >> 2); // looked at soon
  }
  add_place(tet, OUTSIDE);
  tet->corner[1] = *waiting;
  *waiting = t;
  return enclosing;
}

// Floods from the outer sides of all facets and frees what it reaches. All that it does not reach lies
// between inner sides, and is cut off at them. What waits is chained through corner[1], of no use outside. Where
// much lay outside its memory is given back, since the improvement needs some; to move the others costs more
// than it saves where that was little.
static CwStatus keep_inside(const CwFillInput *input, const CwFacets *facets, CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  int enclosing = 0;
  int32_t waiting = -1, freed = 0;
  for (int32_t f = 0; f < facets->count; f++) {
    int32_t soon = facets->inner[f + SOON < facets->count ? f + SOON : f];
    int32_t later = facets->inner[f + LATER < facets->count ? f + LATER : f];
    __builtin_prefetch(&mesh->tet[later / 4]);
    __builtin_prefetch(&mesh->tet[mesh->tet[soon / 4].neighbour[soon % 4] / 4]);
    int32_t inner = facets->inner[f], outer = mesh->tet[inner / 4].neighbour[inner % 4];
    CwTet *inside = &mesh->tet[inner / 4], *outside = &mesh->tet[outer / 4];
    const double *y = mesh->point[facets->corner[f][0]].x;
    if (!(place_of(outside) & OUTSIDE)) enclosing |= add_outside(mesh, outer / 4, &waiting);
    add_place(inside, INNER | 1u << inner % 4);
    add_place(outside, 1u << outer % 4);
    CW_REQUIRE((place_of(inside) & OUTSIDE) == 0 && (place_of(outside) & INNER) == 0, CW_ERR_MESH,
               "%s: boundary triangle at (%.6g, %.6g, %.6g) mm has its normal turned against its neighbours",
               input->name, CW_MM(y));
    int bare = f >= input->bare_first && f < input->bare_first + input->bare_count;
    mesh->tet[inner / 4].neighbour[inner % 4] = bare ? CW_BESIDE_NOTHING : CW_BESIDE_OTHERS;
  }
  while (waiting >= 0) {
    int32_t t = waiting;
    const CwTet *tet = &mesh->tet[t];
    waiting = tet->corner[1];
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] < 0 || place_of(tet) & 1u << i) continue;
      CwTet *next = &mesh->tet[tet->neighbour[i] / 4];
      const double *y = mesh->point[tet->corner[0]].x;
      CW_REQUIRE((place_of(next) & INNER) == 0, CW_ERR_MESH,
                 "%s: inside and outside of the boundary meet near (%.6g, %.6g, %.6g) mm: normals disagree",
                 input->name, CW_MM(y));
      if (!(place_of(next) & OUTSIDE)) enclosing |= add_outside(mesh, tet->neighbour[i] / 4, &waiting);
    }
    cw_tet_mesh_free_tet(mesh, t); // its place stays
    freed++;
  }
  if (!enclosing) { // it lies inside, with all that hangs together with it
    const double *x = find_enclosed(mesh);
    status = CW_FAIL(CW_ERR_MESH,
                     "%s: the boundary encloses all that lies outside it: its normals point inward near "
                     "(%.6g, %.6g, %.6g) mm",
                     input->name, CW_MM(x));
    goto done;
  }
  if (freed > mesh->tet_count / 4) cw_tet_mesh_pack(mesh);
done:
  return status;
}

// Brings all boundary triangles into the mesh by flips, and new points where these are stuck. Where some are still
// missing the boundary does not cross itself.
static CwStatus recover(const CwFillInput *input, CwTetMesh *mesh, CwFacets *facets, int32_t *source_count,
                        CwFillRecovery *recovery) {
  CwStatus status = CW_OK;
  int64_t flips = 0;
  CW_TRY(cw_facets_locate(mesh, input->point_count, facets));
  recovery->missing = facets->missing_count;
  for (int round = 0; round < CW_RECOVER_TRIES && facets->missing_count; round++)
    CW_TRY(cw_kernel_recover(mesh, facets, round, input->log, source_count, &flips));
  recovery->flips = (int32_t)(flips < INT32_MAX ? flips : INT32_MAX);
  if (facets->missing_count) {
    CW_TRY(cw_boundary_check_crossing(input));
    cw_log_debug(input->log, "%s: %d of %d boundary triangles are missing", input->name, facets->missing_count,
                 facets->count);
  }
done:
  return status;
}

// From the Delaunay mesh of all points, without the core's tetrahedra, to the fill.
static CwStatus finish(const CwFillInput *input, const CwKernelCore *core, CwTetMesh *mesh, int32_t count, CwFill *fill,
                       CwKernelOutcome *outcome) {
  CwStatus status = CW_OK;
  CwFacets facets = {0};
  CwTetChanges changes;
  CwFillRecovery recovery = {0};
  CW_TRY(cw_facets_make(input, mesh, &facets));
  CW_TRY(recover(input, mesh, &facets, &count, &recovery));
  if (facets.missing_count) goto done;
  CW_TRY(keep_inside(input, &facets, mesh));
  cw_facets_free(&facets);
  cw_give_back();
  CW_TRY(cw_tet_improve_mesh(mesh, core->fixed_count, &count, &changes));
  CW_TRY(cw_fill_from_mesh(mesh, core->fixed_count, count, fill));
  CW_TRY(cw_kernel_core_append(core, fill));
  *outcome = CW_KERNEL_FILLED;
  cw_log_debug(input->log,
               "%s: %d tetrahedra, %d of them by the lattice, %d edges and %d faces removed, %d points moved, %d "
               "added, least sine %.3g to %.3g",
               input->name, fill->tetrahedron_count, core->lattice.tet_count, changes.edges_removed,
               changes.faces_removed, changes.points_moved, changes.points_added, changes.least_before,
               changes.least_after);
done:
  cw_facets_free(&facets);
  fill->recovery = recovery;
  return status;
}

CwStatus cw_kernel_fill(const CwFillInput *input, CwFill *fill, CwKernelOutcome *outcome) {
  CwStatus status = CW_OK;
  CwTetMesh mesh = {0};
  CwKernelCore core = {0};
  CwFillRecovery recovery;
  int32_t count = 0;
  memset(fill, 0, sizeof *fill);
  *outcome = CW_KERNEL_NOT_RECOVERED;
  CW_TRY(cw_boundary_check(input));
  CW_TRY(all_points(input, &core, &count, &mesh));
  cw_give_back();
  CW_TRY(cw_delaunay_connect(&mesh));
  CW_TRY(cw_kernel_core_carve(&core, &mesh));
  CW_TRY(finish(input, &core, &mesh, count, fill, outcome));
done:
  cw_kernel_core_free(&core);
  cw_tet_mesh_free(&mesh);
  recovery = fill->recovery;
  if (status != CW_OK) cw_fill_free(fill);
  fill->recovery = recovery;
  return status;
}

CwStatus cw_kernel_finish(const CwFillInput *input, CwTetMesh *mesh, int32_t source_count, CwFill *fill,
                          CwKernelOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwKernelCore core = {.fixed_count = input->point_count};
  memset(fill, 0, sizeof *fill);
  *outcome = CW_KERNEL_NOT_RECOVERED;
  CW_TRY(cw_boundary_check(input));
  CW_TRY(finish(input, &core, mesh, source_count, fill, outcome));
done:
  cw_tet_mesh_free(mesh);
  if (status != CW_OK) cw_fill_free(fill);
  return status;
}
