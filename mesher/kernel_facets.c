// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/kernel_facets.h"

#include <stdlib.h>
#include <string.h>

static const int8_t tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

static uint32_t scatter(uint64_t z) {
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ z >> 27) * 0x94d049bb133111ebull;
  return (uint32_t)(z >> 32);
}

// Sum and product are the same in any order.
static uint32_t scatter_three(const int32_t p[3]) {
  uint64_t a = (uint64_t)p[0], b = (uint64_t)p[1], c = (uint64_t)p[2];
  return scatter((a + b + c) * 0x9e3779b97f4a7c15ull + (a + 1) * (b + 1) * (c + 1));
}

static int same_points(const int32_t p[3], const int32_t q[3]) {
  for (int k = 0; k < 3; k++) {
    if (p[k] != q[0] && p[k] != q[1] && p[k] != q[2])
      return 0;
  }
  return 1;
}

int32_t cw_facets_find(const CwFacets *facets, const int32_t corner[3]) {
  for (uint32_t k = scatter_three(corner) & facets->mask;; k = (k + 1) & facets->mask) {
    int32_t f = facets->table[k];
    if (f < 0 || same_points(facets->corner[f], corner))
      return f;
  }
}

// The place of an edge in the table, or the empty one where it belongs.
static uint32_t edge_place(const CwFacets *facets, int32_t low, int32_t high) {
  uint32_t k = scatter((uint64_t)low << 32 | (uint64_t)high) & facets->edge_mask;
  while (facets->edge[k][0] >= 0 && (facets->edge[k][0] != low || facets->edge[k][1] != high))
    k = (k + 1) & facets->edge_mask;
  return k;
}

int cw_facets_has_edge(const CwFacets *facets, int32_t a, int32_t b) {
  return facets->edge[edge_place(facets, a < b ? a : b, a < b ? b : a)][0] >= 0;
}

CwStatus cw_facets_make(const CwFillInput *input, const CwDelaunay *mesh, CwFacets *facets) {
  CwStatus status = CW_OK;
  int32_t *number = NULL;
  uint32_t size = 16, edge_size = 16;
  memset(facets, 0, sizeof *facets);
  facets->count = input->triangle_count;
  while (size < 2 * (uint32_t)facets->count)
    size *= 2;
  while (edge_size < 3 * (uint32_t)facets->count)
    edge_size *= 2; // 1.5 edges a triangle
  facets->mask = size - 1;
  facets->edge_mask = edge_size - 1;
  CW_NEW(number, input->point_count);
  CW_NEW(facets->corner, facets->count);
  CW_NEW(facets->inner, facets->count);
  CW_NEW(facets->table, size);
  CW_NEW(facets->edge, edge_size);
  memset(facets->table, -1, size * sizeof *facets->table);
  memset(facets->edge, -1, edge_size * sizeof *facets->edge);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    int32_t given = mesh->source[p];
    if (given >= 0 && given < input->point_count)
      number[given] = p;
  }
  for (int32_t f = 0; f < facets->count; f++) {
    int32_t *p = facets->corner[f];
    for (int k = 0; k < 3; k++)
      p[k] = number[input->triangle[f][k]];
    uint32_t place = scatter_three(p) & facets->mask;
    for (; facets->table[place] >= 0; place = (place + 1) & facets->mask) {
      const double *x = mesh->point[p[0]].x;
      CW_REQUIRE(!same_points(facets->corner[facets->table[place]], p), CW_ERR_MESH,
                 "%s: boundary triangle at (%.6g, %.6g, %.6g) mm is listed twice", input->name, 1e3 * x[0],
                 1e3 * x[1], 1e3 * x[2]);
    }
    facets->table[place] = f;
    for (int k = 0; k < 3; k++) {
      int32_t a = p[k], b = p[(k + 1) % 3];
      int32_t *edge = facets->edge[edge_place(facets, a < b ? a : b, a < b ? b : a)];
      edge[0] = a < b ? a : b;
      edge[1] = a < b ? b : a;
    }
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

void cw_facets_locate(const CwDelaunay *mesh, int32_t boundary_points, CwFacets *facets) {
  facets->missing_count = facets->count;
  memset(facets->inner, -1, (size_t)facets->count * sizeof *facets->inner);
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const CwDelaunayTet *tet = &mesh->tet[t];
    if (tet->corner[0] < 0)
      continue;
    int on_boundary = 0, count = 0;
    for (int i = 0; i < 4; i++) {
      int32_t given = mesh->source[tet->corner[i]];
      int is = given >= 0 && given < boundary_points;
      on_boundary |= is << i;
      count += is;
    }
    if (count < 3)
      continue;
    for (int i = 0; i < 4; i++) {
      if ((on_boundary | 1 << i) != 15)
        continue;
      int32_t p[3];
      for (int k = 0; k < 3; k++)
        p[k] = tet->corner[tet_face[i][k]];
      int32_t f = cw_facets_find(facets, p);
      if (f < 0)
        continue;
      // Outward for the tetrahedron and for the region: it lies inside.
      const int32_t *q = facets->corner[f];
      int k = q[0] == p[0] ? 0 : q[1] == p[0] ? 1 : 2;
      if (q[(k + 1) % 3] != p[1])
        continue;
      facets->inner[f] = 4 * t + i;
      facets->missing_count--;
    }
  }
}
