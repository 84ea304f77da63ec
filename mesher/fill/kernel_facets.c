// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_facets.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/mix.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/tet.h"

enum { EMPTY = -1 };                                             // place of a table
enum { THREE = 1 << 7 | 1 << 11 | 1 << 13 | 1 << 14 | 1 << 15 }; // bit k: k has three bits or four

static uint32_t scatter(uint64_t z) {
  return (uint32_t)(cw_mix(z) >> 32);
}

// Sum and product are the same in any order.
static uint32_t scatter_three(const int32_t p[3]) {
  uint64_t a = (uint64_t)p[0], b = (uint64_t)p[1], c = (uint64_t)p[2];
  return scatter((a + b + c) * CW_MIX_STEP + (a + 1) * (b + 1) * (c + 1));
}

static int same_points(const int32_t p[3], const int32_t q[3]) {
  for (int k = 0; k < 3; k++) {
    if (p[k] != q[0] && p[k] != q[1] && p[k] != q[2]) return 0;
  }
  return 1;
}

// The place of a hash in a table of `capacity` places, and the one after another.
static uint32_t place_of(uint32_t hash, uint32_t capacity) {
  return (uint32_t)((uint64_t)hash * capacity >> 32);
}

static uint32_t after(uint32_t place, uint32_t capacity) {
  return place + 1 < capacity ? place + 1 : 0;
}

int32_t cw_facets_find(const CwFacets *facets, const int32_t corner[3]) {
  for (uint32_t k = place_of(scatter_three(corner), facets->table_capacity);; k = after(k, facets->table_capacity)) {
    int32_t f = facets->table[k];
    if (f == EMPTY) return -1;
    if (same_points(facets->corner[f], corner)) return f;
  }
}

static int is_edge(const CwFacets *facets, int32_t side, int32_t a, int32_t b) {
  const int32_t *p = facets->corner[side / 3];
  int32_t from = p[side % 3], to = p[(side + 1) % 3];
  return (from == a && to == b) || (from == b && to == a);
}

// The place of an edge in the table, or the empty one where it belongs.
static uint32_t edge_place(const CwFacets *facets, int32_t a, int32_t b) {
  int32_t low = a < b ? a : b, high = a < b ? b : a;
  uint32_t k = place_of(scatter((uint64_t)low << 32 | (uint64_t)high), facets->edge_capacity);
  while (facets->edge[k] != EMPTY && !is_edge(facets, facets->edge[k], a, b)) k = after(k, facets->edge_capacity);
  return k;
}

int cw_facets_has_edge(const CwFacets *facets, int32_t a, int32_t b) {
  return facets->edge[edge_place(facets, a, b)] >= 0;
}

static void note_facet(CwFacets *facets, int32_t f) {
  const int32_t *p = facets->corner[f];
  uint32_t place = place_of(scatter_three(p), facets->table_capacity);
  while (facets->table[place] >= 0) place = after(place, facets->table_capacity);
  facets->table[place] = f;
  for (int k = 0; k < 3; k++) {
    if (p[k] > p[(k + 1) % 3]) continue; // the boundary is closed: another facet has the edge in the opposite direction
    facets->edge[edge_place(facets, p[k], p[(k + 1) % 3])] = 3 * f + k;
  }
}

// Empty tables with room for `count` facets.
static CwStatus make_tables(CwFacets *facets, int32_t count) {
  CwStatus status = CW_OK;
  facets->table_capacity = 4 * (uint32_t)count + 16; // most faces that are looked for are no facets
  facets->edge_capacity = 2 * (uint32_t)count + 16;  // 1.5 edges a triangle, seldom asked for
  CW_NEW(facets->table, facets->table_capacity);
  CW_NEW(facets->edge, facets->edge_capacity);
  memset(facets->table, EMPTY, facets->table_capacity * sizeof *facets->table);
  memset(facets->edge, EMPTY, facets->edge_capacity * sizeof *facets->edge);
done:
  return status;
}

CwStatus cw_facets_make(const CwFillInput *input, const CwTetMesh *mesh, CwFacets *facets) {
  CwStatus status = CW_OK;
  int32_t *number = NULL;
  memset(facets, 0, sizeof *facets);
  CW_NEW(number, input->point_count);
  CW_NEW(facets->corner, input->triangle_count);
  CW_NEW(facets->inner, input->triangle_count);
  CW_TRY(make_tables(facets, input->triangle_count));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    int32_t given = mesh->source[p];
    if (given >= 0 && given < input->point_count) number[given] = p;
  }
  for (; facets->count < input->triangle_count; facets->count++) {
    int32_t *p = facets->corner[facets->count];
    for (int k = 0; k < 3; k++) p[k] = number[input->triangle[facets->count][k]];
    const double *x = mesh->point[p[0]].x;
    CW_REQUIRE(cw_facets_find(facets, p) < 0, CW_ERR_MESH,
               "%s: boundary triangle at (%.6g, %.6g, %.6g) mm is listed twice", input->name, CW_MM(x));
    note_facet(facets, facets->count);
  }
done:
  free(number);
  return status;
}

void cw_facets_free(CwFacets *facets) {
  free(facets->corner);
  free(facets->inner);
  free(facets->table);
  free(facets->edge);
  memset(facets, 0, sizeof *facets);
}

CwStatus cw_facets_locate(const CwTetMesh *mesh, int32_t boundary_points, CwFacets *facets) {
  CwStatus status = CW_OK;
  uint8_t *on_boundary = NULL; // of each point
  CW_NEW(on_boundary, mesh->point_count);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    on_boundary[p] = (uint32_t)mesh->source[p] < (uint32_t)boundary_points;
  }
  facets->missing_count = facets->count;
  memset(facets->inner, -1, (size_t)facets->count * sizeof *facets->inner);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwTet *tet = &mesh->tet[t];
    const int32_t *c = tet->corner;
    cw_tet_prefetch_ahead(tet);
    if (c[0] < 0) continue;
    int corners = on_boundary[c[0]] | on_boundary[c[1]] << 1 | on_boundary[c[2]] << 2 | on_boundary[c[3]] << 3;
    if (!(1 << corners & THREE)) continue;
    for (int i = 0; i < 4; i++) {
      int32_t p[3], beyond = tet->neighbour[i];
      if ((corners | 1 << i) != 15 || (beyond >= 0 && beyond < 4 * t)) continue; // each face once
      for (int k = 0; k < 3; k++) p[k] = c[cw_tet_face[i][k]];
      int32_t f = cw_facets_find(facets, p);
      if (f < 0) continue;
      // Where outward for the tetrahedron is outward for the region, it lies inside, else the one beyond.
      const int32_t *q = facets->corner[f];
      int k = q[0] == p[0] ? 0 : q[1] == p[0] ? 1 : 2;
      facets->inner[f] = q[(k + 1) % 3] == p[1] ? 4 * t + i : beyond;
      facets->missing_count -= facets->inner[f] >= 0;
    }
  }
done:
  free(on_boundary);
  return status;
}
