// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/rays.h"
#include "mesher/size_sources.h"

static const double least_curvature_share = 0.4; // of the patch size
static const double least_facing = 0.7;           // cosine of the angle between a ray and the wall it meets
static const double parallel_facing = 0.95;       // from here on no crease can be the cause
static const double crease_angle_cosine = 0.94;   // 20 degrees between normals

enum { PIECE_STACK = 128 };

typedef struct {
  double x[3][3];
  double curvature[3]; // at the corners, 1/m
} Piece;

typedef struct {
  const CwSizeInput *input;
  CwSizeGrid *grid;
  CwRays *rays;
  CwSizeGrid crease_distance; // to the nearest crease where walls meet at less than 160 degrees of fluid
} Surface;

static double length(const double a[3]) {
  return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit_cross(const double a[3], const double b[3], double n[3]) {
  for (int k = 0; k < 3; k++)
    n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
  double size = length(n);
  for (int k = 0; k < 3; k++)
    n[k] = size > 0 ? n[k] / size : 0;
}

static void triangle_normal(const CwBackground *background, int32_t t, double n[3]) {
  const int32_t *p = background->triangle[t];
  double e[3], f[3];
  for (int k = 0; k < 3; k++) {
    e[k] = background->x[p[1]][k] - background->x[p[0]][k];
    f[k] = background->x[p[2]][k] - background->x[p[0]][k];
  }
  unit_cross(e, f, n);
}

// Exact outward normal at the middle of edge (k, k+1) of a triangle: facets would show creases on every
// coarse curve.
static void edge_normal(const CwSizeInput *input, int32_t t, int k, double n[3]) {
  const CwBackground *b = input->background;
  const double *p = b->uv[t][k], *q = b->uv[t][(k + 1) % 3];
  const double uv[2] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
  double x[3], xu[3], xv[3];
  cw_cad_face_point(input->cad, b->face[t], uv, x, xu, xv);
  unit_cross(xu, xv, n);
  if (cw_cad_face_reversed(input->cad, b->face[t])) {
    for (int i = 0; i < 3; i++)
      n[i] = -n[i];
  }
}

static void seed_along(CwSizeGrid *grid, const double a[3], const double b[3], double value) {
  double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  int count = (int)ceil(length(d) / grid->spacing) + 1;
  for (int i = 0; i <= count; i++) {
    double s = (double)i / count, x[3] = {a[0] + s * d[0], a[1] + s * d[1], a[2] + s * d[2]};
    cw_size_grid_seed(grid, x, value);
  }
}

static CwStatus measure_creases(Surface *surface) {
  CwStatus status = CW_OK;
  const CwBackground *b = surface->input->background;
  int32_t(*neighbour)[3] = NULL;
  CW_TRY(cw_background_neighbours(surface->input->cad, b, &neighbour));
  for (int32_t t = 0; t < b->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t other = neighbour[t][k];
      if (other < t || b->face[other] == b->face[t])
        continue;
      int side = 0;
      while (neighbour[other][side] != t)
        side++;
      double n[3], m[3], facet[3], away[3];
      edge_normal(surface->input, t, k, n);
      edge_normal(surface->input, other, side, m);
      if (dot(n, m) > crease_angle_cosine)
        continue;
      triangle_normal(b, t, facet);
      const double *from = b->x[b->triangle[t][k]], *apex = b->x[b->triangle[other][(side + 2) % 3]];
      for (int i = 0; i < 3; i++)
        away[i] = apex[i] - from[i];
      if (dot(facet, away) >= 0)
        continue; // the walls turn away from each other: no wedge of fluid
      seed_along(&surface->crease_distance, from, b->x[b->triangle[t][(k + 1) % 3]], 0);
    }
  }
  cw_size_grid_spread(&surface->crease_distance, 1);
done:
  free(neighbour);
  return status;
}

// Size that the gap before x asks for, or infinity.
static double gap_size(const Surface *surface, int32_t t, const double x[3], const double outward[3],
                       double patch_size) {
  const CwSizeInput *input = surface->input;
  const CwBackground *b = input->background;
  const double inward[3] = {-outward[0], -outward[1], -outward[2]};
  double cells = fmax(input->table->cells_across_gap, 1), distance;
  int32_t hit = cw_rays_exit(surface->rays, x, inward, 1e-3 * patch_size, cells * patch_size, &distance);
  if (hit < 0)
    return INFINITY;
  int patch = cw_cad_face_patch(input->cad, b->face[t]),
      hit_patch = cw_cad_face_patch(input->cad, b->face[hit]);
  // Before an open face there are no layers and no velocity profile: two cells do.
  if (cw_cad_patch_kind(input->cad, patch) != CW_PATCH_WALL ||
      cw_cad_patch_kind(input->cad, hit_patch) != CW_PATCH_WALL) {
    cells = fmin(cells, 2);
  }
  double met[3];
  triangle_normal(b, hit, met);
  double facing = dot(inward, met);
  if (facing < least_facing)
    return INFINITY;
  if (facing < parallel_facing) {
    // Walls that meet at the angle of x and its hit meet at distance / tan(angle) from x.
    double meeting = distance * facing / sqrt(1 - facing * facing);
    double crease = cw_size_grid_at(&surface->crease_distance, x);
    if (crease < fmax(2 * patch_size, 1.2 * meeting))
      return INFINITY;
  }
  return fmax(distance / cells, cw_size_least_share * input->base_size);
}

static void centre_of(const Piece *piece, double x[3], double *curvature) {
  for (int k = 0; k < 3; k++)
    x[k] = (piece->x[0][k] + piece->x[1][k] + piece->x[2][k]) / 3;
  *curvature = (piece->curvature[0] + piece->curvature[1] + piece->curvature[2]) / 3;
}

// Halves the longest edge where it is longer than `limit`; the second half goes to *other. Returns whether it
// did.
static int halve(Piece *piece, double limit, Piece *other) {
  int longest = 0;
  double most = -1;
  for (int k = 0; k < 3; k++) {
    const double *p = piece->x[k], *q = piece->x[(k + 1) % 3];
    double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, size = length(d);
    if (size > most) {
      most = size;
      longest = k;
    }
  }
  if (most <= limit)
    return 0;
  int next = (longest + 1) % 3;
  *other = *piece;
  for (int k = 0; k < 3; k++) {
    double mid = 0.5 * (piece->x[longest][k] + piece->x[next][k]);
    piece->x[next][k] = mid;
    other->x[longest][k] = mid;
  }
  double mid = 0.5 * (piece->curvature[longest] + piece->curvature[next]);
  piece->curvature[next] = mid;
  other->curvature[longest] = mid;
  return 1;
}

static void seed_piece(Surface *surface, const Piece *whole, double size, double patch_size) {
  Piece stack[PIECE_STACK];
  int top = 0;
  stack[top++] = *whole;
  while (top > 0) {
    Piece piece = stack[--top], other;
    if (top + 2 <= PIECE_STACK && halve(&piece, 0.7 * surface->grid->spacing, &other)) {
      stack[top++] = other;
      stack[top++] = piece;
      continue;
    }
    double x[3], curvature;
    centre_of(&piece, x, &curvature);
    double turn = surface->input->table->curvature_angle / fmax(curvature, 1e-9);
    cw_size_grid_seed(surface->grid, x, fmin(size, fmax(turn, least_curvature_share * patch_size)));
  }
}

static void seed_triangle(Surface *surface, int32_t t) {
  const CwSizeInput *input = surface->input;
  const CwBackground *b = input->background;
  double patch_size = input->base_size * input->patch_size[cw_cad_face_patch(input->cad, b->face[t])];
  double outward[3];
  Piece stack[PIECE_STACK];
  int top = 1;
  triangle_normal(b, t, outward);
  for (int k = 0; k < 3; k++) {
    memcpy(stack[0].x[k], b->x[b->triangle[t][k]], sizeof stack[0].x[k]);
    stack[0].curvature[k] = cw_cad_face_curvature(input->cad, b->face[t], b->uv[t][k]);
  }
  while (top > 0) {
    Piece piece = stack[--top], other;
    // A ray sees a gap for a place of about two spacings: distances vary slowly along the walls of a gap.
    if (top + 2 <= PIECE_STACK && halve(&piece, 2 * surface->grid->spacing, &other)) {
      stack[top++] = other;
      stack[top++] = piece;
      continue;
    }
    double x[3], curvature;
    centre_of(&piece, x, &curvature);
    seed_piece(surface, &piece, fmin(patch_size, gap_size(surface, t, x, outward, patch_size)), patch_size);
  }
}

CwStatus cw_size_seed_surface(const CwSizeInput *input, CwSizeGrid *grid) {
  CwStatus status = CW_OK;
  Surface surface = {.input = input, .grid = grid};
  double high[3];
  for (int k = 0; k < 3; k++)
    high[k] = grid->low[k] + grid->spacing * (grid->count[k] - 1);
  CW_TRY(cw_rays_make(input->background, &surface.rays));
  CW_TRY(cw_size_grid_make(grid->low, high, 2 * grid->spacing, INT32_MAX, &surface.crease_distance));
  CW_TRY(measure_creases(&surface));
  for (int32_t t = 0; t < input->background->triangle_count; t++)
    seed_triangle(&surface, t);
done:
  cw_rays_free(&surface.rays);
  cw_size_grid_free(&surface.crease_distance);
  return status;
}
