// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/flip_mesh.h"

#include <stdlib.h>

int cw_flip_corner(const CwFlipMesh *mesh, int32_t t, int32_t vertex) {
  for (int k = 0; k < 3; k++) {
    if (mesh->triangle[t][k] == vertex) return k;
  }
  return -1;
}

// A side of a triangle by the vertex it starts from.
typedef struct {
  int32_t end, side; // vertex; 3 * triangle + side
} Side;

CwStatus cw_flip_neighbours(int32_t point_count, int32_t triangle_count, CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t *start = NULL;
  Side *side = NULL;
  CW_NEW(mesh->near, triangle_count);
  CW_NEW(start, (size_t)point_count + 2);
  CW_NEW(side, 3 * (size_t)triangle_count);
  for (int32_t t = 0; t < triangle_count; t++) {
    for (int k = 0; k < 3; k++) start[mesh->triangle[t][k] + 2]++;
  }
  for (int32_t v = 0; v < point_count; v++) start[v + 2] += start[v + 1];
  for (int32_t t = 0; t < triangle_count; t++) {
    const int32_t *corner = mesh->triangle[t];
    for (int k = 0; k < 3; k++) side[start[corner[k] + 1]++] = (Side){corner[(k + 1) % 3], 3 * t + k};
  }
  for (int32_t a = 0; a < point_count; a++) { // sides that start at a now stand from start[a] to start[a + 1]
    for (int32_t s = start[a]; s < start[a + 1]; s++) {
      int32_t b = side[s].end, found = -1, others = 0;
      for (int32_t i = start[b]; i < start[b + 1]; i++) {
        if (side[i].end == a) found = side[i].side / 3, others++;
      }
      for (int32_t i = start[a]; i < start[a + 1]; i++) others += i != s && side[i].end == b;
      mesh->near[side[s].side / 3][side[s].side % 3] = others == 1 ? found : -1;
    }
  }
done:
  free(start);
  free(side);
  return status;
}

int cw_flip_joined(const CwFlipMesh *mesh, int32_t t, int32_t c, int32_t d) {
  for (int way = 0; way < 2; way++) {
    int32_t at = t;
    do {
      int k = cw_flip_corner(mesh, at, c);
      if (cw_flip_corner(mesh, at, d) >= 0) return 1;
      at = mesh->near[at][way ? k : (k + 2) % 3];
    } while (at >= 0 && at != t);
    if (at == t) break;
  }
  return 0;
}

static void set_near(CwFlipMesh *mesh, int32_t t, int32_t from, int32_t to) {
  if (t < 0) return;
  for (int k = 0; k < 3; k++) {
    if (mesh->near[t][k] == from) mesh->near[t][k] = to;
  }
}

void cw_flip(CwFlipMesh *mesh, int32_t t, int k, int32_t u) {
  int32_t a = mesh->triangle[t][k], b = mesh->triangle[t][(k + 1) % 3], c = mesh->triangle[t][(k + 2) % 3];
  int j = cw_flip_corner(mesh, u, b); // u runs b, a, d
  int32_t d = mesh->triangle[u][(j + 2) % 3];
  int32_t bc = mesh->near[t][(k + 1) % 3], ca = mesh->near[t][(k + 2) % 3];
  int32_t ad = mesh->near[u][(j + 1) % 3], db = mesh->near[u][(j + 2) % 3];
  const int32_t first[3] = {c, d, b}, second[3] = {d, c, a}, at_t[3] = {u, db, bc}, at_u[3] = {t, ca, ad};
  for (int i = 0; i < 3; i++) {
    mesh->triangle[t][i] = first[i], mesh->near[t][i] = at_t[i];
    mesh->triangle[u][i] = second[i], mesh->near[u][i] = at_u[i];
  }
  set_near(mesh, db, u, t);
  set_near(mesh, ca, t, u);
}
