// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/cad/rays.h"
#include "mesher/common/box.h"
#include "mesher/common/cubes.h"
#include "mesher/common/incident.h"
#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "mesher/size/size_sources.h"

static const double spacing_share = 0.6; // of the base size
static const int64_t node_limit = 6000000;

enum { PIECE_STACK = 128 };

typedef struct {
  double x[3][3];
  double curvature[3]; // at the corners, 1/m
} Piece;

struct CwSizeSurface {
  CwSizeInput input;
  CwSizeGrid grid;     // of the face in hand; unset in between
  float *curvature;    // of each background point on that face, 1/m; below 0: not known yet
  int32_t *face_start; // triangles of face f: face_triangle[face_start[f] .. face_start[f + 1])
  int32_t *face_triangle;
  double (*crease)[3]; // points along creases where walls meet at less than 160 degrees of fluid
  int32_t crease_count, crease_capacity;
  CwCubes cubes; // of these
};

typedef struct {
  int32_t node;
  float value;
} Seed;

typedef struct CwSizeSurface Surface;

// Exact outward normal at the middle of edge (k, k+1) of a triangle: facets would show creases on every
// coarse curve.
static void edge_normal(const CwSizeInput *input, int32_t t, int k, double n[3]) {
  const CwBackground *b = input->background;
  const double *p = b->uv[t][k], *q = b->uv[t][(k + 1) % 3];
  const double uv[2] = {0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])};
  cw_cad_face_normal(input->cad, b->face[t], uv, n);
}

static CwStatus add_crease(Surface *surface, const double a[3], const double b[3]) {
  CwStatus status = CW_OK;
  int count = (int)ceil(cw_distance(a, b) / surface->grid.spacing) + 1;
  CW_GROW(surface->crease, surface->crease_capacity, surface->crease_count + count + 1);
  for (int i = 0; i <= count; i++) cw_lerp(a, b, (double)i / count, surface->crease[surface->crease_count++]);
done:
  return status;
}

static CwStatus find_creases(Surface *surface) {
  CwStatus status = CW_OK;
  const CwBackground *b = surface->input.background;
  const int32_t(*neighbour)[3] = (const int32_t(*)[3])b->neighbour;
  for (int32_t t = 0; t < b->triangle_count; t++) {
    for (int k = 0; k < 3; k++) {
      int32_t other = neighbour[t][k];
      if (other < t || b->face[other] == b->face[t]) continue;
      int side = 0;
      while (neighbour[other][side] != t) side++;
      double n[3], m[3], facet[3], away[3];
      edge_normal(&surface->input, t, k, n);
      edge_normal(&surface->input, other, side, m);
      if (cw_dot(n, m) > cw_policy.crease_cosine) continue;
      cw_background_normal(b, t, facet);
      const double *from = b->x[b->triangle[t][k]], *apex = b->x[b->triangle[other][(side + 2) % 3]];
      cw_sub(apex, from, away);
      if (cw_dot(facet, away) >= 0) continue; // the walls turn away from each other: no wedge of fluid
      CW_TRY(add_crease(surface, from, b->x[b->triangle[t][(k + 1) % 3]]));
    }
  }
  CW_TRY(cw_cubes_make(surface->crease_count, (const double(*)[3])surface->crease, 4 * surface->grid.spacing,
                       &surface->cubes));
done:
  return status;
}

static int crease_within(const Surface *surface, const double x[3], double radius) {
  const CwCubes *cubes = &surface->cubes;
  int32_t from[3], to[3];
  cw_cubes_near(cubes, x, radius, from, to);
  if (from[0] > to[0]) return 0;
  for (int32_t c = from[2]; c <= to[2]; c++) {
    for (int32_t b = from[1]; b <= to[1]; b++) {
      int32_t end = cubes->start[cw_cube(cubes, to[0], b, c) + 1];
      for (int32_t i = cubes->start[cw_cube(cubes, from[0], b, c)]; i < end; i++) {
        const double *p = surface->crease[cubes->member[i]];
        double d[3] = {p[0] - x[0], p[1] - x[1], p[2] - x[2]};
        if (cw_dot(d, d) < radius * radius) return 1;
      }
    }
  }
  return 0;
}

// Size that the gap before x asks for, or infinity.
static double gap_size(const Surface *surface, int32_t t, const double x[3], const double outward[3],
                       double patch_size) {
  const CwSizeInput *input = &surface->input;
  const CwBackground *b = input->background;
  const double inward[3] = {-outward[0], -outward[1], -outward[2]};
  double cells = fmax(input->table->cells_across_gap, 1), distance;
  int32_t hit = cw_rays_exit(b->rays, x, inward, 1e-3 * patch_size, cells * patch_size, &distance);
  if (hit < 0) return INFINITY;
  // Before an open face there are no layers and no velocity profile: two cells do.
  if (!cw_cad_face_is_wall(input->cad, b->face[t]) || !cw_cad_face_is_wall(input->cad, b->face[hit]))
    cells = fmin(cells, 2);
  double met[3];
  cw_background_normal(b, hit, met);
  double facing = cw_dot(inward, met);
  if (facing < cw_policy.size_facing) return INFINITY;
  if (facing < cw_policy.crease_cosine) {
    // Walls that meet at the angle of x and its hit meet at distance / tan(angle) from x.
    double meeting = distance * facing / sqrt(1 - facing * facing);
    if (crease_within(surface, x, fmax(2 * patch_size, 1.2 * meeting))) return INFINITY;
  }
  return fmax(distance / cells, cw_policy.size_least_share * input->base_size);
}

static void centre_of(const Piece *piece, double x[3], double *curvature) {
  for (int k = 0; k < 3; k++) x[k] = (piece->x[0][k] + piece->x[1][k] + piece->x[2][k]) / 3;
  *curvature = (piece->curvature[0] + piece->curvature[1] + piece->curvature[2]) / 3;
}

// Halves the longest edge where it is longer than `limit`; the second half goes to *other. Returns whether it
// did.
static int halve(Piece *piece, double limit, Piece *other) {
  int longest = 0;
  double most = -1;
  for (int k = 0; k < 3; k++) {
    double size = cw_distance(piece->x[k], piece->x[(k + 1) % 3]);
    if (size > most) {
      most = size;
      longest = k;
    }
  }
  if (most <= limit) return 0;
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
    if (top + 2 <= PIECE_STACK && halve(&piece, 0.7 * surface->grid.spacing, &other)) {
      stack[top++] = other;
      stack[top++] = piece;
      continue;
    }
    double x[3], curvature;
    centre_of(&piece, x, &curvature);
    double turn = curvature > 0 ? surface->input.table->curvature_angle / curvature : INFINITY;
    cw_size_grid_seed(&surface->grid, x, fmin(size, fmax(turn, cw_policy.size_least * patch_size)));
  }
}

static void seed_triangle(Surface *surface, int32_t t) {
  const CwSizeInput *input = &surface->input;
  const CwBackground *b = input->background;
  double patch_size = input->base_size * input->patch_size[cw_cad_face_patch(input->cad, b->face[t])];
  double outward[3];
  Piece stack[PIECE_STACK];
  int top = 1;
  cw_background_normal(b, t, outward);
  for (int k = 0; k < 3; k++) {
    memcpy(stack[0].x[k], b->x[b->triangle[t][k]], sizeof stack[0].x[k]);
    float *curvature = &surface->curvature[b->triangle[t][k]];
    if (*curvature < 0) *curvature = (float)fabs(cw_cad_face_curvature(input->cad, b->face[t], b->uv[t][k], NULL));
    stack[0].curvature[k] = *curvature;
  }
  while (top > 0) {
    Piece piece = stack[--top], other;
    // A ray sees a gap for a place of about two spacings: distances vary slowly along the walls of a gap.
    if (top + 2 <= PIECE_STACK && halve(&piece, 2 * surface->grid.spacing, &other)) {
      stack[top++] = other;
      stack[top++] = piece;
      continue;
    }
    double x[3], curvature;
    centre_of(&piece, x, &curvature);
    seed_piece(surface, &piece, fmin(patch_size, gap_size(surface, t, x, outward, patch_size)), patch_size);
  }
}

static CwBox domain_box(const CwBackground *background) {
  return cw_box_of_points(background->point_count, (const double(*)[3])background->x);
}

void cw_size_surface_grid(const CwSizeInput *input, CwSizeGrid *grid) {
  CwBox box = domain_box(input->background);
  cw_size_grid_shape(box.low, box.high, spacing_share * input->base_size, node_limit, grid);
}

CwStatus cw_size_surface_make(const CwSizeInput *input, CwSizeSurface **result) {
  CwStatus status = CW_OK;
  Surface *surface = NULL;
  const CwBackground *b = input->background;
  int faces = cw_cad_face_count(input->cad);
  CW_NEW(surface, 1);
  surface->input = *input;
  cw_size_surface_grid(input, &surface->grid);
  CW_NEW_UNSET(surface->grid.value, cw_size_grid_nodes(&surface->grid));
  cw_size_grid_clear(&surface->grid);
  CW_NEW(surface->curvature, b->point_count);
  CW_NEW(surface->face_start, faces + 1);
  CW_NEW(surface->face_triangle, b->triangle_count);
  cw_list_by_group(b->triangle_count, b->face, faces, surface->face_start, surface->face_triangle);
  CW_TRY(find_creases(surface));
  *result = surface;
  surface = NULL;
done:
  cw_size_surface_free(&surface);
  return status;
}

void cw_size_surface_free(CwSizeSurface **surface) {
  if (!*surface) return;
  cw_cubes_free(&(*surface)->cubes);
  cw_size_grid_free(&(*surface)->grid);
  free((*surface)->curvature);
  free((*surface)->face_start);
  free((*surface)->face_triangle);
  free((*surface)->crease);
  free(*surface);
  *surface = NULL;
}

// Nodes of the grid that the face can have seeded; none of a face without triangles.
static void box_of_face(const Surface *surface, int face, int32_t from[3], int32_t to[3]) {
  const CwSizeGrid *grid = &surface->grid;
  const CwBackground *b = surface->input.background;
  CwBox box = cw_box_empty();
  for (int32_t i = surface->face_start[face]; i < surface->face_start[face + 1]; i++) {
    for (int c = 0; c < 3; c++) cw_box_add_point(&box, b->x[b->triangle[surface->face_triangle[i]][c]]);
  }
  for (int k = 0; k < 3; k++) {
    double first = floor((box.low[k] - grid->low[k]) / grid->spacing) - 1;
    double last = ceil((box.high[k] - grid->low[k]) / grid->spacing) + 1;
    from[k] = (int32_t)fmin(fmax(first, 0), grid->count[k]);
    to[k] = (int32_t)fmax(fmin(last, grid->count[k] - 1), -1);
  }
}

// Packs the seeds among the nodes from..to, and unsets these.
static CwStatus pack_seeds(CwSizeGrid *grid, const int32_t from[3], const int32_t to[3], void **bytes,
                           int64_t *byte_count) {
  CwStatus status = CW_OK;
  int64_t count = 0;
  char *block = NULL;
  for (int store = 0; store < 2; store++) {
    Seed *seed = store ? (Seed *)(block + sizeof count) : NULL;
    count = 0;
    for (int32_t k = from[2]; k <= to[2]; k++) {
      for (int32_t j = from[1]; j <= to[1]; j++) {
        int64_t line = ((int64_t)k * grid->count[1] + j) * grid->count[0];
        if (!cw_size_grid_any_set(grid, line + from[0], line + to[0])) continue; // most lines
        for (int64_t node = line + from[0]; node <= line + to[0]; node++) {
          if (grid->value[node] >= cw_size_unset) continue;
          if (store) {
            seed[count] = (Seed){.node = (int32_t)node, .value = grid->value[node]};
            grid->value[node] = cw_size_unset;
          }
          count++;
        }
      }
    }
    if (!store) CW_NEW(block, sizeof count + (size_t)count * sizeof(Seed));
  }
  memcpy(block, &count, sizeof count);
  *bytes = block;
  *byte_count = (int64_t)(sizeof count + (size_t)count * sizeof(Seed));
done:
  return status;
}

CwStatus cw_size_seed_face(CwSizeSurface *surface, int face, void **bytes, int64_t *byte_count) {
  int32_t from[3], to[3];
  for (int32_t i = 0; i < surface->input.background->point_count; i++) surface->curvature[i] = -1;
  int seeded = !cw_cad_face_is_left_out(surface->input.cad, face);
  for (int32_t i = surface->face_start[face]; seeded && i < surface->face_start[face + 1]; i++)
    seed_triangle(surface, surface->face_triangle[i]);
  box_of_face(surface, face, from, to);
  return pack_seeds(&surface->grid, from, to, bytes, byte_count);
}

CwStatus cw_size_seed_creases(CwSizeSurface *surface, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  const int32_t *n = surface->grid.count, from[3] = {0, 0, 0}, to[3] = {n[0] - 1, n[1] - 1, n[2] - 1};
  CW_TRY(cw_size_seed_edges(&surface->input, &surface->grid));
  CW_TRY(pack_seeds(&surface->grid, from, to, bytes, byte_count));
done:
  return status;
}

CwStatus cw_size_surface_lines(const CwSizeSurface *surface, CwScanlines *lines) {
  CwBox box = domain_box(surface->input.background);
  return cw_scanlines_make(surface->input.background, &box.low[1], &box.high[1], surface->grid.spacing, lines);
}

void cw_size_take_seeds(CwSizeGrid *grid, const void *bytes, double share, double base, double most) {
  int64_t count;
  memcpy(&count, bytes, sizeof count);
  const Seed *seed = (const Seed *)((const char *)bytes + sizeof count);
  for (int64_t i = 0; i < count; i++) {
    double size = seed[i].value, least = cw_policy.size_least * fmin(size, base);
    double value = fmin(fmin(fmax(share * size, least), size), most);
    if (value < grid->value[seed[i].node]) grid->value[seed[i].node] = (float)value;
  }
}
