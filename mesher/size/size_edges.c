// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>

#include "mesher/common/nose.h"
#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "mesher/size/size_sources.h"

enum { LEAST_PARTS = 4, MOST_PARTS = 200 };

// A CAD edge as a polyline.
typedef struct {
  int count; // points
  double (*x)[3];
  double (*normal[2])[3]; // of its two faces, by point
  char *crease;           // whether they meet at an angle there, by point
  double length;
  double *width; // least distance to an opposite side of one of the two faces, where it is narrow, by point
  int vertex[2], face[2];
} Polyline;

static void face_normal(const CwCad *cad, int edge, int face, double t, double n[3]) {
  double uv[2];
  cw_cad_edge_uv(cad, edge, face, t, uv);
  cw_cad_face_normal(cad, face, uv, n);
}

static CwStatus trace(const CwCad *cad, int edge, double step, Polyline *line) {
  CwStatus status = CW_OK;
  double t[2], before[3], x[3];
  cw_cad_edge_range(cad, edge, t);
  cw_cad_edge_vertices(cad, edge, line->vertex);
  cw_cad_edge_faces(cad, edge, line->face);
  for (int i = 0; i <= 2 * LEAST_PARTS; i++) { // rough length, for the number of parts
    cw_cad_edge_point(cad, edge, t[0] + (t[1] - t[0]) * i / (2 * LEAST_PARTS), x, NULL);
    if (i > 0) line->length += cw_distance(before, x);
    cw_copy(x, before);
  }
  int parts = (int)fmin(fmax(ceil(line->length / step), LEAST_PARTS), MOST_PARTS);
  line->count = parts + 1;
  CW_NEW(line->x, line->count);
  for (int side = 0; side < 2; side++) CW_NEW(line->normal[side], line->count);
  CW_NEW(line->crease, line->count);
  CW_NEW(line->width, line->count);
  for (int i = 0; i <= parts; i++) {
    double at = t[0] + (t[1] - t[0]) * i / parts;
    cw_cad_edge_point(cad, edge, at, line->x[i], NULL);
    for (int side = 0; side < 2; side++) face_normal(cad, edge, line->face[side], at, line->normal[side][i]);
    line->crease[i] = cw_dot(line->normal[0][i], line->normal[1][i]) < cw_policy.crease_cosine;
    line->width[i] = INFINITY;
  }
done:
  return status;
}

static double distance_to_part(const double p[3], const double a[3], const double b[3]) {
  double nearest[3];
  cw_lerp(a, b, cw_nearest_share(a, b, p), nearest);
  return cw_distance(p, nearest);
}

// Two edges of one face without a common vertex are its two sides; widths between creases, and over noses, go to
// `line`.
static void measure_between(Polyline *line, const Polyline *other) {
  for (int i = 0; i < 2; i++) {
    for (int j = 0; j < 2; j++) {
      if (line->vertex[i] == other->vertex[j]) return;
    }
  }
  for (int side = 0; side < 4; side++) {
    const int own = side / 2, across = side % 2;
    if (line->face[own] != other->face[across]) continue;
    for (int i = 0; i < line->count; i++) {
      for (int j = 0; j + 1 < other->count; j++) {
        int creases = line->crease[i] && (other->crease[j] || other->crease[j + 1]);
        if (!creases && !cw_nose_between(line->normal[own][i], other->normal[across][j])) continue;
        line->width[i] = fmin(line->width[i], distance_to_part(line->x[i], other->x[j], other->x[j + 1]));
      }
    }
  }
}

static void seed_line(const CwSizeInput *input, const Polyline *line, CwSizeGrid *grid) {
  double floor_size = cw_policy.size_least_share * input->base_size;
  for (int i = 0; i + 1 < line->count; i++) {
    double width = fmin(line->width[i], line->width[i + 1]);
    if (!line->crease[i] && !line->crease[i + 1] && isinf(width)) continue;
    double size = fmax(fmin(line->length, width), floor_size);
    int parts = (int)ceil(cw_distance(line->x[i], line->x[i + 1]) / grid->spacing) + 1;
    for (int j = 0; j <= parts; j++) {
      double x[3];
      cw_lerp(line->x[i], line->x[i + 1], (double)j / parts, x);
      cw_size_grid_seed(grid, x, size);
    }
  }
}

CwStatus cw_size_seed_edges(const CwSizeInput *input, CwSizeGrid *grid) {
  CwStatus status = CW_OK;
  int count = cw_cad_edge_count(input->cad);
  Polyline *line = NULL;
  CW_NEW(line, count);
  for (int e = 0; e < count; e++) CW_TRY(trace(input->cad, e, 0.5 * input->base_size, &line[e]));
  for (int e = 0; e < count; e++) {
    for (int o = 0; o < count; o++) {
      if (o != e) measure_between(&line[e], &line[o]);
    }
  }
  for (int e = 0; e < count; e++) seed_line(input, &line[e], grid);
done:
  for (int e = 0; line && e < count; e++) {
    free(line[e].x);
    for (int side = 0; side < 2; side++) free(line[e].normal[side]);
    free(line[e].crease);
    free(line[e].width);
  }
  free(line);
  return status;
}

// Walks along the open edges: seeds `grid`, and returns the share of what is allowed in `wanted`, its mean over their
// length; either may be NULL.
static double walk_open_edges(const CwSizeInput *input, const CwSizeGrid *wanted, CwSizeGrid *grid) {
  const CwCad *cad = input->cad;
  double shares = 0, length = 0;
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int face[2];
    double t[2], from[3], to[3];
    cw_cad_edge_faces(cad, e, face);
    if (cw_cad_face_is_wall(cad, face[0]) == cw_cad_face_is_wall(cad, face[1])) continue;
    double size = input->open_edge_size[cw_cad_face_patch(cad, cw_cad_face_is_wall(cad, face[0]) ? face[0] : face[1])];
    cw_cad_edge_range(cad, e, t);
    cw_cad_edge_point(cad, e, t[0], from, NULL);
    for (int i = 1; i <= MOST_PARTS; i++) {
      cw_cad_edge_point(cad, e, t[0] + (t[1] - t[0]) * i / MOST_PARTS, to, NULL);
      const double part = cw_distance(from, to);
      int parts = (int)ceil(part / (grid ? grid : wanted)->spacing);
      for (int j = 0; j <= parts; j++) {
        double x[3];
        cw_lerp(from, to, parts > 0 ? (double)j / parts : 0, x);
        if (grid) cw_size_grid_seed(grid, x, size);
        if (wanted) shares += size / cw_size_grid_at(wanted, x) * part / (parts + 1);
      }
      length += part;
      cw_copy(to, from);
    }
  }
  return length > 0 ? shares / length : 0;
}

void cw_size_seed_open_edges(const CwSizeInput *input, CwSizeGrid *grid) {
  walk_open_edges(input, NULL, grid);
}

double cw_size_open_edges_ask(const CwSizeInput *input, const CwSizeGrid *wanted) {
  return walk_open_edges(input, wanted, NULL);
}
