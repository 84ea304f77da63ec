// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/flip_mesh.h"

#include <stdlib.h>

#include "mesher/common/incident.h"
#include "mesher/parallel/parallel_for.h"

int cw_flip_corner(const CwFlipMesh *mesh, int32_t t, int32_t vertex) {
  for (int k = 0; k < 3; k++) {
    if (mesh->triangle[t][k] == vertex) return k;
  }
  return -1;
}

// What the tasks below read.
typedef struct {
  const CwFlipMesh *mesh;
  const CwIncident *around;
  const uint8_t *wanted; // vertices
} Edges;

// The triangle across the edge from a to b of t.
static int32_t find_across(const Edges *edges, int32_t t, int32_t a, int32_t b) {
  int32_t across = -1, others = 0;
  for (int32_t i = edges->around->start[a]; i < edges->around->start[a + 1]; i++) {
    int32_t u = edges->around->triangle[i];
    const int32_t *corner = edges->mesh->triangle[u];
    int k = corner[0] == a ? 0 : corner[1] == a ? 1 : 2;
    if (u == t || (corner[(k + 1) % 3] != b && corner[(k + 2) % 3] != b)) continue;
    others++;
    if (corner[(k + 2) % 3] == b) across = u; // it runs from b to a
  }
  return others == 1 ? across : -1;
}

static CwStatus find_near(void *context, int32_t t, void *out) {
  const Edges *edges = context;
  const int32_t *corner = edges->mesh->triangle[t];
  int32_t *near = out;
  for (int k = 0; k < 3; k++) {
    int32_t a = corner[k], b = corner[(k + 1) % 3];
    near[k] = edges->wanted[a] || edges->wanted[b] ? find_across(edges, t, a, b) : -1;
  }
  return CW_OK;
}

CwStatus cw_flip_neighbours(const CwContext *context, int32_t point_count, int32_t triangle_count, const int64_t *group,
                            CwFlipMesh *mesh) {
  CwStatus status = CW_OK;
  CwIncident around = {0};
  uint8_t *wanted = NULL;
  if (!mesh->near) CW_NEW_UNSET(mesh->near, triangle_count);
  CW_NEW(wanted, point_count);
  for (int32_t t = 0; t < triangle_count; t++) {
    for (int k = 0; k < 3; k++) wanted[mesh->triangle[t][k]] |= !group || group[t] >= 0;
  }
  CW_TRY(cw_incident_make(point_count, triangle_count, (const int32_t(*)[3])mesh->triangle, &around));
  Edges edges = {mesh, &around, wanted};
  CW_TRY(cw_parallel_for(context, "triangles across edges", triangle_count, sizeof *mesh->near, find_near, &edges,
                         mesh->near));
done:
  cw_incident_free(&around);
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
