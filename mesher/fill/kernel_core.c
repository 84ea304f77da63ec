// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_core.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/tet.h"
#include "mesher/fill/lattice_core.h"

// Numbers inner points: the skin after the boundary; deep points after the skin; others, which the core does
// not name, after the skin in *x.
static CwStatus order_points(const CwFillInput *input, int32_t inner_count, const double (*inner)[3],
                             CwKernelCore *core, int32_t *number, double (*x)[3]) {
  CwStatus status = CW_OK;
  int32_t skin = input->point_count, deep = 0, shell = core->fixed_count;
  CW_NEW(core->deep, core->lattice.deep_count);
  memcpy(x, input->x, (size_t)input->point_count * sizeof *x);
  for (int32_t p = 0; p < inner_count; p++) {
    int role = core->lattice.role ? core->lattice.role[p] : CW_LATTICE_SHELL;
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
  CwLatticeCore *lattice = &core->lattice;
  int32_t *number = NULL;
  memset(core, 0, sizeof *core);
  *x = NULL;
  if (site) CW_TRY(cw_lattice_core_make(inner_count, site, lattice));
  core->fixed_count = input->point_count + lattice->skin_count;
  *count = input->point_count + inner_count - lattice->deep_count;
  CW_NEW(*x, *count);
  CW_NEW(number, inner_count);
  CW_TRY(order_points(input, inner_count, inner, core, number, *x));
  for (int32_t t = 0; t < lattice->tet_count; t++) {
    for (int i = 0; i < 4; i++) lattice->tet[t][i] = number[lattice->tet[t][i]];
  }
  for (int32_t f = 0; f < lattice->face_count; f++) {
    for (int i = 0; i < 3; i++) lattice->face[f][i] = number[lattice->face[f][i]];
  }
  free(lattice->role); // it has told which points lie where
  lattice->role = NULL;
done:
  free(number);
  if (status != CW_OK) {
    cw_kernel_core_free(core);
    free(*x);
    *x = NULL;
  }
  return status;
}

// Frees a tetrahedron, once, and puts it into the chain of those whose neighbours are to be looked at: its
// neighbours and corner[2] stay readable.
static void take_out(CwTetMesh *mesh, int32_t t, int32_t *waiting) {
  if (mesh->tet[t].corner[0] < 0) return;
  cw_tet_mesh_free_tet(mesh, t);
  mesh->tet[t].corner[2] = *waiting;
  *waiting = t;
}

// The skin's faces by their least point in the mesh, which has its neighbours near it in memory.
typedef struct {
  int32_t *start;     // of each point's; one more at the end
  int32_t (*rest)[2]; // the other two points, as the face turns
} Skin;

// The face with its least point first.
static void turned(const int32_t corner[3], int32_t face[3]) {
  int least = corner[0] < corner[1] ? (corner[0] < corner[2] ? 0 : 2) : corner[1] < corner[2] ? 1 : 2;
  for (int i = 0; i < 3; i++) face[i] = corner[(least + i) % 3];
}

static CwStatus sort_skin(const CwKernelCore *core, const CwTetMesh *mesh, Skin *skin) {
  CwStatus status = CW_OK;
  int32_t *number = NULL, first = core->fixed_count - core->lattice.skin_count, corner[3], face[3];
  CW_NEW(number, core->lattice.skin_count);
  CW_NEW(skin->start, mesh->point_count + 1);
  CW_NEW(skin->rest, core->lattice.face_count);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    if (mesh->source[p] >= first && mesh->source[p] < core->fixed_count) number[mesh->source[p] - first] = p;
  }
  for (int store = 0; store < 2; store++) { // counts, then fills from behind
    for (int32_t f = 0; f < core->lattice.face_count; f++) {
      for (int i = 0; i < 3; i++) corner[i] = number[core->lattice.face[f][i] - first];
      turned(corner, face);
      if (store)
        memcpy(skin->rest[--skin->start[face[0]]], face + 1, sizeof *skin->rest);
      else
        skin->start[face[0]]++;
    }
    for (int32_t p = 0; p < mesh->point_count && !store; p++) skin->start[p + 1] += skin->start[p];
  }
done:
  free(number);
  return status;
}

static int is_of_skin(const Skin *skin, const int32_t corner[3]) {
  int32_t face[3];
  turned(corner, face);
  for (int32_t k = skin->start[face[0]]; k < skin->start[face[0] + 1]; k++) {
    if (skin->rest[k][0] == face[1] && skin->rest[k][1] == face[2]) return 1;
  }
  return 0;
}

// Parts the mesh along the skin, and takes out the tetrahedra inside it, which see its faces as the core does.
static int32_t part(const CwKernelCore *core, const Skin *skin, CwTetMesh *mesh, int32_t *waiting) {
  int32_t found = 0, first = core->fixed_count - core->lattice.skin_count;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    CwTet *tet = &mesh->tet[t];
    int on_skin = 0, count = 0, inside = 0;
    cw_tet_prefetch_ahead(tet);
    if (tet->corner[0] < 0) continue;
    for (int i = 0; i < 4 && count + 2 > i; i++) {
      int32_t given = mesh->source[tet->corner[i]];
      int is = given >= first && given < core->fixed_count;
      on_skin |= is << i;
      count += is;
    }
    for (int i = 0; i < 4 && count >= 3; i++) {
      int32_t beyond = tet->neighbour[i], corner[3];
      if (beyond < 0 || (on_skin | 1 << i) != 15) continue;
      for (int k = 0; k < 3; k++) corner[k] = tet->corner[cw_tet_face[i][k]];
      if (!is_of_skin(skin, corner)) continue;
      mesh->tet[beyond / 4].neighbour[beyond % 4] = -1;
      tet->neighbour[i] = -1;
      inside = 1;
      found++;
    }
    if (inside) take_out(mesh, t, waiting);
  }
  return found;
}

CwStatus cw_kernel_core_carve(const CwKernelCore *core, CwTetMesh *mesh) {
  CwStatus status = CW_OK;
  Skin skin = {0};
  int32_t waiting = -1;
  if (!core->lattice.face_count) goto done;
  CW_TRY(sort_skin(core, mesh, &skin));
  int32_t found = part(core, &skin, mesh, &waiting);
  CW_REQUIRE(found == core->lattice.face_count, CW_ERR_FAULT,
             "the Delaunay mesh has %d of the %d faces of the lattice's core", found, core->lattice.face_count);
  while (waiting >= 0) {
    const CwTet *tet = &mesh->tet[waiting];
    waiting = tet->corner[2];
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] >= 0) take_out(mesh, tet->neighbour[i] / 4, &waiting);
    }
  }
done:
  free(skin.start);
  free(skin.rest);
  return status;
}

CwStatus cw_kernel_core_append(const CwKernelCore *core, CwFill *fill) {
  CwStatus status = CW_OK;
  const CwLatticeCore *lattice = &core->lattice;
  if (!lattice->tet_count) goto done;
  int64_t tets = (int64_t)fill->tetrahedron_count + lattice->tet_count;
  int32_t more = fill->point_count - core->fixed_count;
  CW_REQUIRE(tets < INT32_MAX, CW_ERR_MESH,
             "%lld tetrahedra in one region; allowed: below %d; lower mesh.cells_per_region", (long long)tets,
             INT32_MAX);
  double(*x)[3] = realloc(fill->x, ((size_t)fill->point_count + (size_t)lattice->deep_count) * sizeof *x);
  CW_REQUIRE(x, CW_ERR_MEMORY, "out of memory: %d points", lattice->deep_count);
  fill->x = x;
  int32_t(*tet)[4] = realloc(fill->tetrahedron, (size_t)tets * sizeof *tet);
  CW_REQUIRE(tet, CW_ERR_MEMORY, "out of memory: %lld tetrahedra", (long long)tets);
  fill->tetrahedron = tet;
  memcpy(fill->x + fill->point_count, core->deep, (size_t)lattice->deep_count * sizeof *x);
  fill->point_count += lattice->deep_count;
  for (int32_t t = 0; t < lattice->tet_count; t++) {
    for (int i = 0; i < 4; i++) {
      int32_t p = lattice->tet[t][i];
      tet[fill->tetrahedron_count][i] = p < core->fixed_count ? p : p + more;
    }
    fill->tetrahedron_count++;
  }
done:
  return status;
}

void cw_kernel_core_free(CwKernelCore *core) {
  free(core->deep);
  cw_lattice_core_free(&core->lattice);
  memset(core, 0, sizeof *core);
}
