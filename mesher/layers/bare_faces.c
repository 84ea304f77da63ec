// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/bare_faces.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/common/vec.h"
#include "mesher/layers/layers_normal.h"

enum { SAMPLES = 9, FACES_MOST = CW_LAYER_NORMALS };
enum { OPEN_MOST = 2 };                    // open faces that a column slides on
static const double SAME_PLANE = 1 - 1e-6; // cosine of normals that hold a column in one plane

// A place on an edge, or at a corner, and the faces about it.
typedef struct {
  double x[3];
  int32_t count, face[FACES_MOST];
  double normal[FACES_MOST][3]; // out of the fluid
} Place;

static void add_face(const CwCad *cad, int32_t edge, int32_t face, double t, Place *place) {
  double uv[2], n[3];
  if (place->count == FACES_MOST) return;
  cw_cad_edge_uv(cad, edge, face, t, uv);
  cw_cad_face_normal(cad, face, uv, n);
  if (!(fabs(cw_norm(n) - 1) < 1e-6)) return; // a pole
  place->face[place->count] = face;
  cw_copy(n, place->normal[place->count++]);
}

static double parameter_at(const CwCad *cad, int32_t edge, double share) {
  double range[2];
  cw_cad_edge_range(cad, edge, range);
  return range[0] + share * (range[1] - range[0]);
}

// Whether a column can stand there if the face `without` is bare too; -1: none.
static int can_stand(const CwCad *cad, const Place *place, int32_t without) {
  double inward[FACES_MOST][3], constraint[FACES_MOST][3], g[3];
  int walls = 0, constraints = 0, open = 0;
  int32_t seen[FACES_MOST];
  for (int32_t i = 0; i < place->count; i++) {
    const double *n = place->normal[i];
    if (cw_cad_face_is_wall(cad, place->face[i]) && place->face[i] != without) {
      for (int k = 0; k < 3; k++) inward[walls][k] = -n[k];
      walls++;
      continue;
    }
    int known = 0, same = 0;
    for (int c = 0; c < constraints && !known; c++) known = fabs(cw_dot(constraint[c], n)) > SAME_PLANE;
    if (!known) cw_copy(n, constraint[constraints++]);
    for (int c = 0; c < open && !same; c++) same = seen[c] == place->face[i];
    if (!same) seen[open++] = place->face[i];
  }
  if (walls == 0) return 1;
  if (open > OPEN_MOST) return 0;
  return cw_layers_most_normal(walls, (const double(*)[3])inward, constraints, (const double(*)[3])constraint, g) >=
         CW_LAYERS_LEAST_COSINE;
}

static int32_t open_face(const CwCad *cad, const Place *place) {
  for (int32_t i = 0; i < place->count; i++)
    if (cw_cad_patch_kind(cad, cw_cad_face_patch(cad, place->face[i])) != CW_PATCH_WALL) return place->face[i];
  return -1;
}

// What there is about the first face is told.
static void leave(CwCad *cad, int32_t face, const double *area, int32_t open, const double at[3], CwBareFaces *bare) {
  cw_cad_face_leave_bare(cad, face);
  bare->area += area[face];
  if (bare->count++ > 0) return;
  bare->first = face;
  bare->open = open;
  cw_copy(at, bare->at);
}

// Leaves faces bare until a column can stand at the place; returns their number.
static int32_t settle(CwCad *cad, const double *area, const Place *place, CwBareFaces *bare) {
  int32_t before = bare->count;
  while (!can_stand(cad, place, -1)) {
    int32_t least = -1, freeing = -1;
    for (int32_t i = 0; i < place->count; i++) {
      int32_t face = place->face[i];
      if (!cw_cad_face_is_wall(cad, face)) continue;
      if (least < 0 || area[face] < area[least]) least = face;
      if ((freeing < 0 || area[face] < area[freeing]) && can_stand(cad, place, face)) freeing = face;
    }
    int32_t chosen = freeing >= 0 ? freeing : least;
    leave(cad, chosen, area, open_face(cad, place), place->x, bare);
  }
  return bare->count - before;
}

static int32_t settle_edges(CwCad *cad, const double *area, CwBareFaces *bare) {
  int32_t made = 0;
  for (int32_t e = 0; e < cw_cad_edge_count(cad); e++) {
    int face[2];
    cw_cad_edge_faces(cad, e, face);
    for (int i = 0; i < SAMPLES; i++) {
      Place place = {.count = 0};
      double t = parameter_at(cad, e, (i + 0.5) / SAMPLES);
      cw_cad_edge_point(cad, e, t, place.x, NULL);
      for (int k = 0; k < 2; k++) add_face(cad, e, face[k], t, &place);
      made += settle(cad, area, &place, bare);
    }
  }
  return made;
}

static CwStatus settle_corners(CwCad *cad, const double *area, CwBareFaces *bare, int32_t *made) {
  CwStatus status = CW_OK;
  Place *place = NULL;
  int32_t corners = cw_cad_vertex_count(cad);
  CW_NEW(place, corners);
  for (int32_t e = 0; e < cw_cad_edge_count(cad); e++) {
    int face[2], vertex[2];
    cw_cad_edge_faces(cad, e, face);
    cw_cad_edge_vertices(cad, e, vertex);
    for (int end = 0; end < 2; end++)
      for (int k = 0; k < 2; k++) add_face(cad, e, face[k], parameter_at(cad, e, end), &place[vertex[end]]);
  }
  for (int32_t v = 0; v < corners; v++) {
    cw_cad_vertex_point(cad, v, place[v].x);
    *made += settle(cad, area, &place[v], bare);
  }
done:
  free(place);
  return status;
}

// Of those on which layers grow.
static double area_of_walls(const CwCad *cad, const double *area) {
  double sum = 0;
  for (int f = 0; f < cw_cad_face_count(cad); f++)
    if (cw_cad_face_is_wall(cad, f)) sum += area[f];
  return sum;
}

CwStatus cw_bare_faces_find(CwCad *cad, const double *area, int32_t asked, const double at[3], CwBareFaces *bare) {
  CwStatus status = CW_OK;
  if (asked >= 0) {
    if (bare->count == 0) bare->asked = 1;
    leave(cad, asked, area, -1, at, bare);
  }
  for (int32_t made = 1; made > 0;) {
    made = settle_edges(cad, area, bare);
    CW_TRY(settle_corners(cad, area, bare, &made));
  }
  if (bare->count > 0) bare->share = bare->area / (bare->area + area_of_walls(cad, area));
done:
  return status;
}
