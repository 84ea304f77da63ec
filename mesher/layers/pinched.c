// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/layers/pinched.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

// Whether a column can stand there: where there is no wall it need not.
static int can_stand(const CwCad *cad, const Place *place) {
  double inward[FACES_MOST][3], constraint[FACES_MOST][3], g[3];
  int walls = 0, constraints = 0, open = 0;
  int32_t seen[FACES_MOST];
  for (int32_t i = 0; i < place->count; i++) {
    const double *n = place->normal[i];
    if (cw_cad_face_is_wall(cad, place->face[i])) {
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
    if (!cw_cad_face_is_wall(cad, place->face[i])) return place->face[i];
  return -1;
}

static Place place_on(const CwCad *cad, int32_t edge, double t) {
  Place place = {.count = 0};
  int face[2];
  cw_cad_edge_faces(cad, edge, face);
  cw_cad_edge_point(cad, edge, t, place.x, NULL);
  for (int k = 0; k < 2; k++) add_face(cad, edge, face[k], t, &place);
  return place;
}

// Notes what there is about the first of all.
static void note(const CwCad *cad, const Place *place, CwPinched *pinched) {
  if (pinched->edges + pinched->corners > 0) return;
  pinched->open = open_face(cad, place);
  cw_copy(place->x, pinched->at);
}

static void find_edges(const CwCad *cad, CwPinched *pinched) {
  for (int32_t e = 0; e < cw_cad_edge_count(cad); e++) {
    for (int i = 0; i < SAMPLES && !pinched->on_edge[e]; i++) {
      const Place place = place_on(cad, e, parameter_at(cad, e, (i + 0.5) / SAMPLES));
      if (can_stand(cad, &place)) continue;
      note(cad, &place, pinched);
      pinched->on_edge[e] = 1;
      pinched->edges++;
    }
  }
}

static CwStatus find_corners(const CwCad *cad, CwPinched *pinched) {
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
    if (can_stand(cad, &place[v])) continue;
    note(cad, &place[v], pinched);
    pinched->on_corner[v] = 1;
    pinched->corners++;
  }
done:
  free(place);
  return status;
}

CwStatus cw_pinched_find(const CwCad *cad, CwPinched *pinched) {
  CwStatus status = CW_OK;
  free(pinched->on_edge);
  free(pinched->on_corner);
  pinched->on_edge = pinched->on_corner = NULL;
  pinched->edges = pinched->corners = 0;
  CW_NEW(pinched->on_edge, cw_cad_edge_count(cad));
  CW_NEW(pinched->on_corner, cw_cad_vertex_count(cad));
  find_edges(cad, pinched);
  CW_TRY(find_corners(cad, pinched));
done:
  return status;
}

int cw_pinched_at(const CwCad *cad, int32_t edge, double t) {
  const Place place = place_on(cad, edge, t);
  return !can_stand(cad, &place);
}

CwStatus cw_pinched_add(const CwPinchedPlace *place, CwPinched *pinched) {
  CwStatus status = CW_OK;
  CW_GROW(pinched->place, pinched->capacity, pinched->place_count + 1);
  pinched->place[pinched->place_count++] = *place;
done:
  return status;
}

void cw_pinched_free(CwPinched *pinched) {
  free(pinched->on_edge);
  free(pinched->on_corner);
  free(pinched->place);
  memset(pinched, 0, sizeof *pinched);
}
