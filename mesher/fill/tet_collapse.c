// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_collapse.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/fill/tet_aspect.h"
#include "mesher/policy.h"

// The shortest edges of slender tetrahedra at a point.
typedef struct {
  int32_t count, tet, to; // how many tetrahedra; one with the shortest of them, and its other end
  double square;
} Shortest;

static inline void note(Shortest *shortest, int32_t t, int32_t to, double square) {
  if (shortest->count++ && shortest->square <= square) return;
  shortest->tet = t, shortest->to = to, shortest->square = square;
}

// Whether earlier changes have left the edge.
static int has_edge(const CwTetWork *w, int32_t t, int32_t p, int32_t q) {
  const CwTet *tet = &w->mesh->tet[t];
  return tet->corner[0] >= 0 && cw_tet_corner_of(tet, p) >= 0 && cw_tet_corner_of(tet, q) >= 0;
}

// The corners with q in the place of p; 0 where q is one of them, and the tetrahedron vanishes.
static int find_made(const CwTet *tet, int32_t p, int32_t q, int32_t made[4]) {
  memcpy(made, tet->corner, sizeof tet->corner);
  made[cw_tet_corner_of(tet, p)] = q;
  return cw_tet_corner_of(tet, q) < 0;
}

// Takes the tetrahedra of the inner point p that have q out: the neighbours at the two faces of each that become one
// are joined. All others have q in the place of p then.
static void merge(CwTetMesh *mesh, const int32_t *star, int count, int32_t p, int32_t q) {
  for (int k = 0; k < count; k++) {
    CwTet *tet = &mesh->tet[star[k]];
    int i = cw_tet_corner_of(tet, p), j = cw_tet_corner_of(tet, q);
    if (j < 0) {
      tet->corner[i] = q;
      continue;
    }
    int32_t beyond = tet->neighbour[i], within = tet->neighbour[j];
    mesh->tet[within >> 2].neighbour[within & 3] = beyond;
    if (beyond >= 0) mesh->tet[beyond >> 2].neighbour[beyond & 3] = within;
    cw_tet_mesh_free_tet(mesh, star[k]);
  }
}

// The inner point p of t goes into q.
static CwStatus collapse(CwTetWork *w, double floor, int32_t t, int32_t p, int32_t q) {
  CwStatus status = CW_OK;
  int32_t star[CW_STAR], made[4];
  double quality[CW_STAR], sum = 0.0, least = floor;
  int n = cw_tet_star(w->mesh, t, p, CW_STAR, star);
  if (n == 0) goto done;
  for (int k = 0; k < n; k++) {
    const CwTet *tet = &w->mesh->tet[star[k]];
    sum -= cw_tet_excess(w, tet->corner);
    least = cw_lesser(least, tet->quality);
    if (find_made(tet, p, q, made)) sum += cw_tet_excess(w, made);
  }
  if (!(sum < cw_policy.collapse_loss)) goto done;
  for (int k = 0; k < n; k++) {
    if (!find_made(&w->mesh->tet[star[k]], p, q, made)) continue;
    quality[k] = cw_tet_quality_of(w, made[0], made[1], made[2], made[3]);
    if (!(quality[k] > 0.0 && quality[k] >= least)) goto done;
  }
  merge(w->mesh, star, n, p, q);
  for (int k = 0; k < n; k++) {
    if (w->mesh->tet[star[k]].corner[0] >= 0) CW_TRY(cw_tet_set_quality(w, star[k], quality[k]));
  }
  w->count.points_removed++;
done:
  return status;
}

CwStatus cw_tet_collapse(CwTetWork *w, const CwTetShapes *shapes) {
  CwStatus status = CW_OK;
  const double slender_square = cw_tet_slender_square(shapes);
  Shortest *shortest = NULL;
  CW_NEW(shortest, w->mesh->point_count);
  for (int32_t k = 0; k < shapes->slender.count; k++) {
    int32_t t = shapes->slender.tet[k];
    const int32_t *c = w->mesh->tet[t].corner;
    cw_tet_prefetch_list(w, shapes->slender.tet, shapes->slender.count, k);
    if (c[0] < 0) continue;
    CwTetEnds ends = cw_tet_ends(w, c);
    if (!(ends.longest > slender_square * ends.shortest)) continue;
    for (int i = 0; i < 2; i++) note(&shortest[ends.near[i]], t, ends.near[1 - i], ends.shortest);
  }
  for (int32_t p = 0; p < w->mesh->point_count; p++) {
    if (shortest[p].count < cw_policy.collapse_slender || w->mesh->source[p] < w->fixed_count) continue;
    if (has_edge(w, shortest[p].tet, p, shortest[p].to))
      CW_TRY(collapse(w, shapes->floor, shortest[p].tet, p, shortest[p].to));
  }
done:
  free(shortest);
  return status;
}
