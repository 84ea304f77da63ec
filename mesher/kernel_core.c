// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/kernel_core.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/kernel_facets.h"
#include "mesher/lattice_core.h"

// Numbers inner points: the skin after the boundary; deep points after the skin; others, which the core does
// not name, after the skin in *x.
static CwStatus order_points(const CwFillInput *input, int32_t inner_count, const double (*inner)[3],
                             const CwLatticeCore *lattice, CwKernelCore *core, int32_t *number, double (*x)[3]) {
  CwStatus status = CW_OK;
  int32_t skin = input->point_count, deep = 0, shell = core->fixed_count;
  CW_NEW(core->deep, core->deep_count);
  memcpy(x, input->x, (size_t)input->point_count * sizeof *x);
  for (int32_t p = 0; p < inner_count; p++) {
    int role = lattice->role ? lattice->role[p] : CW_LATTICE_SHELL;
    if (role == CW_LATTICE_DEEP) {
      number[p] = core->fixed_count + deep;
      memcpy(core->deep[deep++], inner[p], sizeof *inner);
    } else {
      int32_t *next = role == CW_LATTICE_SKIN ? &skin : &shell;
      number[p] = *next;
      memcpy(x[(*next)++], inner[p], sizeof *inner);
    }
  }
done:
  return status;
}

CwStatus cw_kernel_core_make(const CwFillInput *input, int32_t inner_count, const double (*inner)[3],
                             const CwLatticeSite *site, CwKernelCore *core, int32_t *count, double (**x)[3]) {
  CwStatus status = CW_OK;
  CwLatticeCore lattice = {0};
  int32_t *number = NULL;
  memset(core, 0, sizeof *core);
  *x = NULL;
  if (site)
    CW_TRY(cw_lattice_core_make(inner_count, site, &lattice));
  core->fixed_count = input->point_count + lattice.skin_count;
  core->skin_count = lattice.skin_count;
  core->deep_count = lattice.deep_count;
  *count = input->point_count + inner_count - lattice.deep_count;
  CW_NEW(*x, *count);
  CW_NEW(number, inner_count);
  CW_TRY(order_points(input, inner_count, inner, &lattice, core, number, *x));
  for (int32_t t = 0; t < lattice.tet_count; t++) {
    for (int i = 0; i < 4; i++)
      lattice.tet[t][i] = number[lattice.tet[t][i]];
  }
  for (int32_t f = 0; f < lattice.face_count; f++) {
    for (int i = 0; i < 3; i++)
      lattice.face[f][i] = number[lattice.face[f][i]];
  }
  core->tet_count = lattice.tet_count;
  core->tet = lattice.tet;
  core->face_count = lattice.face_count;
  core->face = lattice.face;
  lattice.tet = NULL;
  lattice.face = NULL;
done:
  free(number);
  cw_lattice_core_free(&lattice);
  if (status != CW_OK) {
    cw_kernel_core_free(core);
    free(*x);
    *x = NULL;
  }
  return status;
}

// Frees a tetrahedron, once, and puts it into the chain of those whose neighbours are to be looked at: its
// neighbours and corner[2] stay readable.
static void take_out(CwDelaunay *mesh, int32_t t, int32_t *waiting) {
  if (mesh->tet[t].corner[0] < 0)
    return;
  cw_delaunay_free_tet(mesh, t);
  mesh->tet[t].corner[2] = *waiting;
  *waiting = t;
}

CwStatus cw_kernel_core_carve(const CwKernelCore *core, const char *name, CwDelaunay *mesh) {
  CwStatus status = CW_OK;
  CwFacets facets = {0};
  CwFillInput surface = {.name = name,
                         .point_count = core->fixed_count,
                         .triangle_count = core->face_count,
                         .triangle = (const int32_t(*)[3])core->face};
  int32_t waiting = -1;
  if (!core->face_count)
    goto done;
  CW_TRY(cw_facets_make(&surface, mesh, &facets));
  facets.corners_from = core->fixed_count - core->skin_count;
  cw_facets_locate(mesh, core->fixed_count, &facets);
  if (facets.missing_count) {
    status = CW_RETRY;
    goto done;
  }
  for (int32_t f = 0; f < facets.count; f++) {
    int32_t inner = facets.inner[f], *beyond = &mesh->tet[inner / 4].neighbour[inner % 4];
    mesh->tet[*beyond / 4].neighbour[*beyond % 4] = -1;
    *beyond = -1;
  }
  for (int32_t f = 0; f < facets.count; f++)
    take_out(mesh, facets.inner[f] / 4, &waiting);
  while (waiting >= 0) {
    const CwDelaunayTet *tet = &mesh->tet[waiting];
    waiting = tet->corner[2];
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] >= 0)
        take_out(mesh, tet->neighbour[i] / 4, &waiting);
    }
  }
done:
  cw_facets_free(&facets);
  return status;
}

CwStatus cw_kernel_core_append(const CwKernelCore *core, CwFill *fill) {
  CwStatus status = CW_OK;
  if (!core->tet_count)
    goto done;
  int64_t tets = (int64_t)fill->tetrahedron_count + core->tet_count;
  int32_t more = fill->point_count - core->fixed_count;
  CW_REQUIRE(tets < INT32_MAX, CW_ERR_MESH, "%lld tetrahedra in one region", (long long)tets);
  double(*x)[3] = realloc(fill->x, ((size_t)fill->point_count + (size_t)core->deep_count) * sizeof *x);
  CW_REQUIRE(x, CW_ERR_MEMORY, "out of memory: %d points", core->deep_count);
  fill->x = x;
  int32_t(*tet)[4] = realloc(fill->tetrahedron, (size_t)tets * sizeof *tet);
  CW_REQUIRE(tet, CW_ERR_MEMORY, "out of memory: %lld tetrahedra", (long long)tets);
  fill->tetrahedron = tet;
  memcpy(fill->x + fill->point_count, core->deep, (size_t)core->deep_count * sizeof *x);
  fill->point_count += core->deep_count;
  for (int32_t t = 0; t < core->tet_count; t++) {
    for (int i = 0; i < 4; i++) {
      int32_t p = core->tet[t][i];
      tet[fill->tetrahedron_count][i] = p < core->fixed_count ? p : p + more;
    }
    fill->tetrahedron_count++;
  }
done:
  return status;
}

void cw_kernel_core_free(CwKernelCore *core) {
  free(core->deep);
  free(core->tet);
  free(core->face);
  memset(core, 0, sizeof *core);
}
