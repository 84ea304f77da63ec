// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/flip_mesh.h"

#include <stdlib.h>

int cw_flip_corner(const CwFlipMesh *mesh, int32_t t, int32_t vertex) {
  for (int k = 0; k < 3; k++) {
    if (mesh->triangle[t][k] == vertex) return k;
  }
  return -1;
}

// A side of a triangle, kept with the lesser of its two vertices.
typedef struct {
  int32_t other, side; // the greater vertex; 2 * (3 * triangle + side), and 1 more where it runs from lesser to greater
} Side;

CwStatus cw_flip_neighbours(int32_t point_count, int32_t triangle_count, const int64_t *group, CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t *start = NULL;
  uint8_t *wanted = NULL; // vertices
  Side *side = NULL;
  if (!mesh->near) CW_NEW_UNSET(mesh->near, triangle_count);
  CW_NEW(start, (size_t)point_count + 2);
  CW_NEW(wanted, point_count);
  for (int32_t t = 0; t < triangle_count; t++) {
    for (int k = 0; k < 3; k++) wanted[mesh->triangle[t][k]] |= !group || group[t] >= 0;
  }
  for (int store = 0; store < 2; store++) {
    for (int32_t t = 0; t < triangle_count; t++) {
      for (int k = 0; k < 3; k++) {
        int32_t a = mesh->triangle[t][k], b = mesh->triangle[t][(k + 1) % 3], low = a < b ? a : b;
        if (!store) mesh->near[t][k] = -1;
        if (!wanted[a] && !wanted[b]) continue;
        if (store) {
          side[start[low + 1]++] = (Side){a < b ? b : a, 2 * (3 * t + k) + (a < b)};
        } else {
          start[low + 2]++;
        }
      }
    }
    for (int32_t v = 0; !store && v < point_count; v++) start[v + 2] += start[v + 1];
    if (!store) CW_NEW_UNSET(side, start[point_count + 1]);
  }
  for (int32_t v = 0; v < point_count; v++) { // sides kept with v stand from start[v] to start[v + 1]
    for (int32_t s = start[v]; s < start[v + 1]; s++) {
      int32_t found = -1, others = 0;
      for (int32_t i = start[v]; i < start[v + 1]; i++) {
        if (side[i].other != side[s].other || i == s) continue;
        if ((side[i].side ^ side[s].side) & 1) found = side[i].side / 6;
        others++;
      }
      int32_t own = side[s].side / 2;
      if (others == 1) mesh->near[own / 3][own % 3] = found;
    }
  }
done:
  free(start);
  free(wanted);
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
