// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/picture_list.h"
#include "pipeline/report/surface.h"

// Triangles of all turning zones together, of the others, and cubes of the first lattice along the pump's size.
enum { TURNING_MOST = 80000, STANDING_MOST = 60000, FINEST = 8192 };

CwStatus cw_view_start(const CwMesh *mesh, double size, CwView *view) {
  CwStatus status = CW_OK;
  int turning = 0;
  for (int d = 0; d < mesh->domain_count; d++) turning += mesh->domains[d].rotating != 0;
  for (int d = 0; d < mesh->domain_count; d++) {
    int64_t most = mesh->domains[d].rotating ? TURNING_MOST / turning : STANDING_MOST / (mesh->domain_count - turning);
    CW_TRY(cw_simplify_start(most, size / FINEST, &view->simplifier[d]));
  }
done:
  return status;
}

// Interfaces are no part, but without them the rims of the walls at them would recede.
static int taken(const CwMesh *mesh, int patch) {
  return mesh->patches[patch].kind != CW_PATCH_INTERFACE;
}

CwStatus cw_view_add(CwView *view, const CwMesh *mesh, const CwRegionData *cells,
                     double *const share[CW_VIEW_QUANTITIES]) {
  CwStatus status = CW_OK;
  double value[CW_VIEW_QUANTITIES];
  CwSimplifier *simplifier = view->simplifier[cells->domain];
  int first = mesh->domains[cells->domain].first_patch;
  for (int32_t f = 0; f < cw_surface_face_count(cells); f++) {
    const CwSurfaceFace face = cw_surface_face(cells, f);
    for (int k = 0; k < CW_VIEW_QUANTITIES; k++) value[k] = share[k] ? share[k][f] : NAN;
    CW_TRY(cw_simplify_add(simplifier, face.x, first + face.patch, value));
    if (face.count == 4)
      CW_TRY(cw_simplify_add(simplifier, (const double *const[3]){face.x[0], face.x[2], face.x[3]}, first + face.patch,
                             value));
  }
done:
  return status;
}

// Hands the faces of a domain from one rank to another, for several such pairs at once. Collective.
static CwStatus pass_faces(const CwRanks *ranks, int from, int to, CwSimplifier *simplifier) {
  CwStatus status = CW_OK;
  void *bytes = NULL;
  int64_t size = 0;
  if (ranks->rank == from) status = cw_simplify_pack(simplifier, &bytes, &size);
  CW_TRY(cw_ranks_agree(ranks, status));
  cw_ranks_pass(ranks, &size, 1, sizeof size, from, to);
  if (ranks->rank == to) {
    bytes = malloc((size_t)size);
    if (!bytes) status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %lld bytes", (long long)size);
  }
  CW_TRY(cw_ranks_agree(ranks, status));
  cw_ranks_pass(ranks, bytes, size, 1, from, to);
  if (ranks->rank == to) status = cw_simplify_absorb(simplifier, bytes);
  CW_TRY(cw_ranks_agree(ranks, status));
done:
  free(bytes);
  return status;
}

// By pairs of ranks, then of pairs, and so on.
CwStatus cw_view_join(CwView *view, const CwMesh *mesh, const CwRanks *ranks) {
  CwStatus status = CW_OK;
  for (int step = 1; step < ranks->size; step *= 2) {
    const int first = ranks->rank / (2 * step) * (2 * step), second = first + step;
    const int to = second < ranks->size ? first : -1, from = second < ranks->size ? second : -1;
    for (int d = 0; d < mesh->domain_count; d++) CW_TRY(pass_faces(ranks, from, to, view->simplifier[d]));
  }
done:
  return status;
}

int cw_view_shown(const CwMesh *mesh, const CwViewPart *part) {
  const CwModelPatch *patch = &mesh->patches[part->patch];
  return patch->kind == CW_PATCH_WALL && !cw_picture_hides(&cw_picture_list[0], patch->name);
}

// The shares of a quantity at the points of a part, where it has them all.
static CwStatus make_values(const CwSimpleSurface *surface, const int32_t *own, int quantity, CwViewPart *part) {
  CwStatus status = CW_OK;
  CW_NEW(part->values[quantity], part->point_count);
  for (int32_t point = 0; point < surface->point_count; point++) {
    double share = surface->values[point][quantity];
    if (own[point] < 0) continue;
    if (!isfinite(share)) {
      free(part->values[quantity]);
      part->values[quantity] = NULL;
      break;
    }
    part->values[quantity][own[point]] = (unsigned char)(255 * fmin(fmax(share, 0), 1) + 0.5);
  }
done:
  return status;
}

// The triangles of `patch` with points of their own. `own`: room for a number of each point of the surface.
static CwStatus make_part(const CwSimpleSurface *surface, int patch, int32_t *own, CwViewPart *part) {
  CwStatus status = CW_OK;
  part->patch = patch;
  memset(own, -1, (size_t)surface->point_count * sizeof *own);
  for (int32_t t = 0; t < surface->triangle_count; t++) part->triangle_count += surface->mark[t] == patch;
  CW_NEW(part->corners, part->triangle_count);
  CW_NEW(part->points, 3 * part->triangle_count);
  for (int32_t t = 0, made = 0; t < surface->triangle_count; t++) {
    if (surface->mark[t] != patch) continue;
    for (int k = 0; k < 3; k++) {
      int32_t point = surface->triangles[t][k];
      if (own[point] < 0) {
        own[point] = part->point_count++;
        memcpy(part->points[own[point]], surface->points[point], sizeof part->points[0]);
      }
      part->corners[made][k] = own[point];
    }
    made++;
  }
  for (int q = 0; q < CW_VIEW_QUANTITIES && part->point_count; q++) CW_TRY(make_values(surface, own, q, part));
done:
  return status;
}

CwStatus cw_view_finish(CwView *view, const CwMesh *mesh) {
  CwStatus status = CW_OK;
  CwSimpleSurface surface = {0};
  int32_t *own = NULL;
  CW_NEW(view->part, mesh->patch_count);
  for (int d = 0; d < mesh->domain_count; d++) {
    CW_TRY(cw_simplify_finish(view->simplifier[d], &surface));
    view->decimated |= cw_simplify_coarsened(view->simplifier[d]);
    CW_NEW_UNSET(own, surface.point_count);
    for (int p = 0; p < mesh->domains[d].patch_count; p++) {
      CwViewPart *part = &view->part[view->part_count];
      if (!taken(mesh, mesh->domains[d].first_patch + p)) continue;
      view->part_count++;
      CW_TRY(make_part(&surface, mesh->domains[d].first_patch + p, own, part));
    }
    free(own);
    own = NULL;
    cw_simple_surface_free(&surface);
    cw_simplify_free(view->simplifier[d]);
    view->simplifier[d] = NULL;
  }
done:
  free(own);
  cw_simple_surface_free(&surface);
  return status;
}

void cw_view_free(CwView *view) {
  for (int d = 0; d < CW_DOMAINS_MOST; d++) cw_simplify_free(view->simplifier[d]);
  for (int k = 0; k < view->part_count; k++) {
    free(view->part[k].points);
    free(view->part[k].corners);
    for (int q = 0; q < CW_VIEW_QUANTITIES; q++) free(view->part[k].values[q]);
  }
  free(view->part);
  *view = (CwView){0};
}
