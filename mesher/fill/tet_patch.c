// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_patch.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/fill/tet_topology.h"

typedef struct {
  int32_t key, value;
} Pair;

static int compare_pairs(const void *left, const void *right) {
  const Pair *a = left, *b = right;
  return a->key < b->key ? -1 : a->key > b->key;
}

// The value that stands with a key in an ascending list, -1 where there is none.
static int32_t find(const Pair *list, int32_t count, int32_t key) {
  Pair wanted = {key, 0};
  const Pair *found = bsearch(&wanted, list, (size_t)count, sizeof *list, compare_pairs);
  return found ? found->value : -1;
}

// The tetrahedra, and their places in the patch by number.
static CwStatus gather(const CwTetMesh *whole, int32_t t, int32_t count, CwTetPatch *patch, Pair **number) {
  CwStatus status = CW_OK;
  Pair *list = NULL;
  CW_NEW(list, count);
  CW_NEW(patch->tet, count);
  list[0] = (Pair){t, 0};
  patch->tet[patch->tet_count++] = t;
  for (int32_t head = 0; head < patch->tet_count; head++) {
    for (int i = 0; i < 4 && patch->tet_count < count; i++) {
      int32_t next = whole->tet[patch->tet[head]].neighbour[i], at = patch->tet_count;
      if (next < 0 || find(list, patch->tet_count, next / 4) >= 0) continue;
      patch->tet[patch->tet_count++] = next / 4;
      for (; at > 0 && list[at - 1].key > next / 4; at--) list[at] = list[at - 1];
      list[at] = (Pair){next / 4, patch->tet_count - 1};
    }
  }
  *number = list;
  list = NULL;
done:
  free(list);
  return status;
}

// The points in ascending order, each once.
static CwStatus gather_points(const CwTetMesh *whole, CwTetPatch *patch, Pair **number) {
  CwStatus status = CW_OK;
  Pair *list = NULL;
  CW_NEW(list, 4 * patch->tet_count);
  for (int32_t k = 0; k < 4 * patch->tet_count; k++) list[k].key = whole->tet[patch->tet[k / 4]].corner[k % 4];
  qsort(list, 4 * (size_t)patch->tet_count, sizeof *list, compare_pairs);
  CW_NEW(patch->point, 4 * patch->tet_count);
  for (int32_t k = 0; k < 4 * patch->tet_count; k++) {
    if (k > 0 && list[k].key == patch->point[patch->point_count - 1]) continue;
    patch->point[patch->point_count] = list[k].key;
    list[patch->point_count] = (Pair){list[k].key, patch->point_count};
    patch->point_count++;
  }
  *number = list;
  list = NULL;
done:
  free(list);
  return status;
}

CwStatus cw_tet_patch_take(const CwTetMesh *whole, int32_t t, int32_t count, int32_t fixed_count, CwTetPatch *patch) {
  CwStatus status = CW_OK;
  Pair *tet_number = NULL, *point_number = NULL;
  CwTetMesh *mesh = &patch->mesh;
  memset(patch, 0, sizeof *patch);
  CW_TRY(gather(whole, t, count, patch, &tet_number));
  CW_TRY(gather_points(whole, patch, &point_number));
  CW_NEW(mesh->point, patch->point_count);
  CW_NEW(mesh->source, patch->point_count);
  CW_NEW(mesh->tet, patch->tet_count);
  mesh->point_count = mesh->point_capacity = patch->point_count;
  mesh->tet_count = mesh->tet_capacity = patch->tet_count;
  for (int32_t p = 0; p < patch->point_count; p++) {
    memcpy(mesh->point[p].x, whole->point[patch->point[p]].x, sizeof mesh->point->x);
    mesh->source[p] = whole->source[patch->point[p]] >= fixed_count;
  }
  for (int32_t k = 0; k < patch->tet_count; k++) {
    const CwTet *old = &whole->tet[patch->tet[k]];
    for (int i = 0; i < 4; i++) {
      int32_t beside = old->neighbour[i], next = beside < 0 ? -1 : find(tet_number, patch->tet_count, beside / 4);
      mesh->tet[k].corner[i] = find(point_number, patch->point_count, old->corner[i]);
      mesh->tet[k].neighbour[i] = beside < 0 ? beside : next < 0 ? CW_BESIDE_OTHERS : 4 * next + beside % 4;
    }
    for (int i = 0; i < 12; i++) {
      if (mesh->tet[k].neighbour[i / 3] < 0) mesh->source[mesh->tet[k].corner[cw_tet_face[i / 3][i % 3]]] = 0;
    }
  }
done:
  free(tet_number);
  free(point_number);
  if (status != CW_OK) cw_tet_patch_free(patch);
  return status;
}

// The faces of the hull in their order; the owner is what lies outside of each, below 0 on the boundary.
static CwStatus find_hull(const CwTetPatch *patch, const CwTetMesh *whole, int32_t *count, CwTetSide **hull) {
  CwStatus status = CW_OK;
  Pair *list = NULL;
  *count = 0;
  *hull = NULL;
  CW_NEW(list, patch->tet_count);
  CW_NEW(*hull, 4 * patch->tet_count);
  for (int32_t k = 0; k < patch->tet_count; k++) list[k] = (Pair){patch->tet[k], k};
  qsort(list, (size_t)patch->tet_count, sizeof *list, compare_pairs);
  for (int32_t k = 0; k < 4 * patch->tet_count; k++) {
    const CwTet *tet = &whole->tet[patch->tet[k / 4]];
    int32_t next = tet->neighbour[k % 4];
    if (next < 0 || find(list, patch->tet_count, next / 4) < 0)
      (*hull)[(*count)++] = cw_tet_side(tet->corner, k % 4, next);
  }
  qsort(*hull, (size_t)*count, sizeof **hull, cw_tet_sides_compare);
done:
  free(list);
  return status;
}

CwStatus cw_tet_patch_put(const CwTetPatch *patch, CwTetMesh *whole, int32_t *source_count, int32_t **place) {
  CwStatus status = CW_OK;
  const CwTetMesh *mesh = &patch->mesh;
  CwTetSide *hull = NULL;
  int32_t *point = NULL, sides;
  *place = NULL;
  CW_TRY(find_hull(patch, whole, &sides, &hull));
  CW_NEW(*place, mesh->tet_count);
  CW_NEW(point, mesh->point_count);
  for (int32_t k = 0; k < patch->tet_count; k++) cw_tet_mesh_free_tet(whole, patch->tet[k]);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    point[p] = p < patch->point_count ? patch->point[p] : -1; // new ones where a tetrahedron has them
    if (point[p] >= 0) memcpy(whole->point[point[p]].x, mesh->point[p].x, sizeof mesh->point->x);
  }
  for (int32_t k = 0; k < mesh->tet_count; k++) {
    const int32_t *corner = mesh->tet[k].corner;
    (*place)[k] = -1;
    if (corner[0] < 0) continue;
    CW_TRY(cw_tet_mesh_new_tet(whole, &(*place)[k]));
    for (int i = 0; i < 4; i++) {
      if (point[corner[i]] < 0)
        CW_TRY(cw_tet_mesh_add_point(whole, mesh->point[corner[i]].x, (*source_count)++, &point[corner[i]]));
      whole->tet[(*place)[k]].corner[i] = point[corner[i]];
    }
  }
  for (int32_t k = 0; k < mesh->tet_count; k++) {
    if ((*place)[k] < 0) continue;
    CwTet *tet = &whole->tet[(*place)[k]];
    for (int i = 0; i < 4; i++) {
      int32_t next = mesh->tet[k].neighbour[i];
      if (next >= 0) {
        tet->neighbour[i] = 4 * (*place)[next / 4] + next % 4;
        continue;
      }
      CwTetSide wanted = cw_tet_side(tet->corner, i, -1);
      const CwTetSide *side = bsearch(&wanted, hull, (size_t)sides, sizeof *hull, cw_tet_sides_compare);
      CW_REQUIRE(side, CW_ERR_FAULT, "a patch of %d tetrahedra came back with another hull", patch->tet_count);
      tet->neighbour[i] = side->owner;
      if (side->owner >= 0) whole->tet[side->owner / 4].neighbour[side->owner % 4] = 4 * (*place)[k] + i;
    }
  }
done:
  free(hull);
  free(point);
  return status;
}

void cw_tet_patch_free(CwTetPatch *patch) {
  cw_tet_mesh_free(&patch->mesh);
  free(patch->tet);
  free(patch->point);
  memset(patch, 0, sizeof *patch);
}

CwStatus cw_tet_patch_copy_mesh(const CwTetMesh *from, CwTetMesh *to) {
  CwStatus status = CW_OK;
  if (to->point_capacity < from->point_count || to->tet_capacity < from->tet_count) {
    cw_tet_mesh_free(to);
    CW_NEW(to->point, 2 * from->point_count);
    CW_NEW(to->source, 2 * from->point_count);
    CW_NEW(to->tet, 2 * from->tet_count);
    to->point_capacity = 2 * from->point_count;
    to->tet_capacity = 2 * from->tet_count;
  }
  memcpy(to->point, from->point, (size_t)from->point_count * sizeof *from->point);
  memcpy(to->source, from->source, (size_t)from->point_count * sizeof *from->source);
  memcpy(to->tet, from->tet, (size_t)from->tet_count * sizeof *from->tet);
  to->point_count = from->point_count;
  to->tet_count = from->tet_count;
  to->spare = from->spare;
  to->stars = from->stars;
done:
  return status;
}
