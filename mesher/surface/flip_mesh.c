// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/flip_mesh.h"

#include <stdlib.h>

int cw_flip_corner(const CwFlipMesh *mesh, int32_t t, int32_t vertex) {
  for (int k = 0; k < 3; k++) {
    if (mesh->triangle[t][k] == vertex) return k;
  }
  return -1;
}

// An edge, listed with the lesser of its two vertices.
typedef struct {
  int32_t other, next;   // its greater vertex; the next edge of the list, or -1
  int32_t first, second; // its sides: 2 * (3 * triangle + side), and 1 more where it runs from lesser to greater
} Edge;

enum { NONE = -1, MANY = -2 }; // in place of a second side

static void set_across(CwFlipMesh *mesh, int32_t side, int32_t triangle) {
  mesh->near[side / 6][side / 2 % 3] = triangle;
}

// Another side of an edge.
static void add_side(CwFlipMesh *mesh, Edge *edge, int32_t side) {
  if (edge->second == NONE) {
    edge->second = side;
    if (!((edge->first ^ side) & 1)) return; // the same way twice
    set_across(mesh, edge->first, side / 6);
    set_across(mesh, side, edge->first / 6);
  } else if (edge->second != MANY) {
    set_across(mesh, edge->first, -1);
    set_across(mesh, edge->second, -1);
    edge->second = MANY;
  }
}

CwStatus cw_flip_neighbours(int32_t point_count, int32_t triangle_count, const int64_t *group, CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  int32_t *list = NULL, count = 0; // first edge of each vertex
  uint8_t *wanted = NULL;          // vertices
  Edge *edge = NULL;
  if (!mesh->near) CW_NEW_UNSET(mesh->near, triangle_count);
  CW_NEW_UNSET(list, point_count);
  CW_NEW_UNSET(edge, 3 * (size_t)triangle_count); // as a rule half as many
  CW_NEW(wanted, point_count);
  for (int32_t t = 0; t < triangle_count; t++) {
    for (int k = 0; k < 3; k++) wanted[mesh->triangle[t][k]] |= !group || group[t] >= 0;
  }
  for (int32_t v = 0; v < point_count; v++) list[v] = -1;
  for (int32_t t = 0; t < triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t a = mesh->triangle[t][k], b = mesh->triangle[t][(k + 1) % 3];
      int32_t low = a < b ? a : b, high = a < b ? b : a, side = 2 * (3 * t + k) + (a < b), at;
      mesh->near[t][k] = -1;
      if (!wanted[a] && !wanted[b]) continue;
      for (at = list[low]; at >= 0 && edge[at].other != high; at = edge[at].next) continue;
      if (at >= 0) {
        add_side(mesh, &edge[at], side);
      } else {
        edge[count] = (Edge){high, list[low], side, NONE};
        list[low] = count++;
      }
    }
  }
done:
  free(list);
  free(edge);
  free(wanted);
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
