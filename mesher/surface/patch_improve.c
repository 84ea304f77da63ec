// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/surface/patch_improve.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/vec.h"
#include "mesher/policy.h"
#include "mesher/surface/patch_cuts.h"
#include "mesher/surface/patch_delaunay.h"

static double edge_size(const CwPatchWork *work, int32_t a, int32_t b) {
  return 0.5 * (work->size[a] + work->size[b]);
}

// The free point's ring and what it allows.
typedef struct {
  int count;
  int32_t triangle[CW_PATCH_RING], ring[CW_PATCH_RING];
} Ring;

// The worst quality of the ring with p at uv, x. Negative where a triangle would be turned in (u,v). Where p would come
// nearer to a given edge than boundary_distance of its size, no more than half the share of that distance that is left.
static double ring_quality(const CwPatchWork *work, const Ring *r, int32_t p, const double uv[2], const double x[3],
                           const double normal[3]) {
  double worst = 1;
  for (int k = 0; k < r->count; k++) {
    int32_t a = r->ring[k], b = r->ring[(k + 1) % r->count], t = r->triangle[k];
    if (!(cw_twice_area(work->uv[a], work->uv[b], uv) > 0)) return -1;
    double quality = cw_patch_quality_at(x, work->x[a], work->x[b], normal);
    if (quality < worst) worst = quality;
    if (work->given[t] >> cw_patch_corner_of(work->corner[t], p) & 1) {
      // Height over the edge from the area, which the quality holds.
      double l = cw_patch_distance2(work->x[a], work->x[b]);
      double sum = l + cw_patch_distance2(x, work->x[a]) + cw_patch_distance2(x, work->x[b]);
      double height = quality * sum / (2 * sqrt(3) * sqrt(l)), limit = cw_policy.boundary_distance * work->size[p];
      if (height < limit && quality > 0) worst = fmin(worst, 0.5 * height / limit);
    }
  }
  return worst;
}

// Tries p moved by `step` (in space, tangential); keeps the move if the worst triangle of the ring stays
// above `least`.
static int try_move(CwPatchWork *work, const Ring *r, int32_t p, const double step[3], double least) {
  const double *m = work->metric[p];
  double det = m[0] * m[2] - m[1] * m[1], f[2] = {0, 0}, uv[2], x[3], xu[3], xv[3], n[3];
  if (!(det > 1e-12 * m[0] * m[2])) return 0;
  for (int k = 0; k < 3; k++) {
    f[0] += step[k] * work->xu[p][k];
    f[1] += step[k] * work->xv[p][k];
  }
  uv[0] = work->uv[p][0] + (m[2] * f[0] - m[1] * f[1]) / det;
  uv[1] = work->uv[p][1] + (m[0] * f[1] - m[1] * f[0]) / det;
  for (int k = 0; k < r->count; k++)
    if (!(cw_twice_area(work->uv[r->ring[k]], work->uv[r->ring[(k + 1) % r->count]], uv) > 0)) return 0;
  work->input->surface(work->input->surface_context, uv, x, xu, xv);
  cw_cross(xu, xv, n);
  if (ring_quality(work, r, p, uv, x, n) <= least) return 0;
  memcpy(work->uv[p], uv, sizeof uv);
  memcpy(work->x[p], x, sizeof x);
  memcpy(work->xu[p], xu, sizeof xu);
  memcpy(work->xv[p], xv, sizeof xv);
  cw_patch_set_metric(work, p);
  double size = work->input->size(work->input->size_context, x);
  for (int k = 0; k < r->count; k++)
    size = fmin(size, work->size[r->ring[k]] + cw_policy.slope * sqrt(cw_patch_distance2(x, work->x[r->ring[k]])));
  work->size[p] = size;
  return 1;
}

// Moves p to the middle of its neighbours, or part of the way there.
static void smooth_point(CwPatchWork *work, int32_t p) {
  Ring r;
  double step[3] = {0, 0, 0}, n[3];
  r.count = cw_patch_ring(work, p, r.triangle, r.ring);
  if (!r.count) return;
  for (int k = 0; k < r.count; k++)
    for (int c = 0; c < 3; c++) step[c] += (work->x[r.ring[k]][c] - work->x[p][c]) / r.count;
  // A point that stands well is left alone: most do, and evaluating the surface is what costs.
  double still = 0.01 * work->size[p];
  if (cw_dot(step, step) < still * still) return;
  cw_patch_normal(work, p, n);
  // A loss of the worst triangle is allowed where it stays good.
  double least = fmin(ring_quality(work, &r, p, work->uv[p], work->x[p], n), 0.7);
  for (int attempt = 0; attempt < 2; attempt++) {
    if (try_move(work, &r, p, step, least)) return;
    for (int c = 0; c < 3; c++) step[c] *= 0.4;
  }
}

static void smooth(CwPatchWork *work) {
  for (int32_t p = work->given_count; p < work->point_count; p++)
    if (work->point_triangle[p] >= 0) smooth_point(work, p);
}

static CwStatus split_long(CwPatchWork *work) {
  CwStatus status = CW_OK;
  int32_t count = work->triangle_count;
  int inserted;
  for (int32_t t = 0; t < count; t++) {
    if (work->corner[t][0] < 0) continue;
    // The longest edge only: splitting the others would make needles.
    int longest = -1;
    double most = 0;
    for (int i = 0; i < 3; i++) {
      double d = cw_patch_distance2(work->x[work->corner[t][(i + 1) % 3]], work->x[work->corner[t][(i + 2) % 3]]);
      if (d > most) {
        most = d;
        longest = i;
      }
    }
    if (longest < 0 || work->given[t] >> longest & 1) continue;
    int32_t a = work->corner[t][(longest + 1) % 3], b = work->corner[t][(longest + 2) % 3];
    if (!cw_patch_is_long(work, a, b)) continue;
    double uv[2] = {0.5 * (work->uv[a][0] + work->uv[b][0]), 0.5 * (work->uv[a][1] + work->uv[b][1])};
    CW_TRY(cw_patch_insert(work, uv, t, 0.55, edge_size(work, a, b) * 1.1, &inserted));
  }
done:
  return status;
}

// Height of the corner opposite to edge a b of a triangle with the corner at p.
static double height_over(const CwPatchWork *work, int32_t p, int32_t a, int32_t b) {
  double ab = cw_patch_distance2(work->x[a], work->x[b]), ap = cw_patch_distance2(work->x[a], work->x[p]);
  double dot = 0.5 * (ab + ap - cw_patch_distance2(work->x[b], work->x[p]));
  return sqrt(fmax(ap - dot * dot / ab, 0));
}

// Free points too near to another point or a given edge, and those with so few triangles that these are wide.
static void remove_too_close(CwPatchWork *work) {
  for (int32_t p = work->given_count; p < work->point_count; p++) {
    if (work->point_triangle[p] < 0) continue;
    Ring r;
    r.count = cw_patch_ring(work, p, r.triangle, r.ring);
    int too_close = r.count <= 4;
    for (int k = 0; k < r.count && !too_close; k++) {
      int32_t a = r.ring[k], b = r.ring[(k + 1) % r.count], t = r.triangle[k];
      double limit = cw_policy.surface_least_distance * edge_size(work, p, a);
      too_close = cw_patch_distance2(work->x[p], work->x[a]) < limit * limit;
      if (work->given[t] >> cw_patch_corner_of(work->corner[t], p) & 1)
        too_close |= height_over(work, p, a, b) < cw_policy.boundary_distance * work->size[p];
    }
    if (too_close && r.count) cw_patch_remove(work, p, 0.45, 1.5);
  }
}

// What the number of triangles at a point lacks to six, or to as many as fit into the angle at a given point.
static void find_excess(const CwPatchWork *work, double *turn, int32_t *excess) {
  for (int32_t p = 0; p < work->point_count; p++) {
    excess[p] = cw_patch_is_free(work, p) ? -6 : 0;
    turn[p] = 0;
  }
  for (int32_t t = 0; t < work->triangle_count; t++) {
    const int32_t *c = work->corner[t];
    if (c[0] < 0) continue;
    for (int i = 0; i < 3; i++) {
      excess[c[i]]++;
      if (cw_patch_is_free(work, c[i])) continue;
      const double *x = work->x[c[i]], *y = work->x[c[(i + 1) % 3]], *z = work->x[c[(i + 2) % 3]];
      double b = cw_patch_distance2(x, y), d = cw_patch_distance2(x, z), a = cw_patch_distance2(y, z);
      turn[c[i]] += acos(fmax(-1, fmin(1, (b + d - a) / (2 * sqrt(b * d)))));
    }
  }
  for (int32_t p = 0; p < work->given_count; p++) excess[p] -= (int32_t)fmax(1, round(turn[p] / (M_PI / 3)));
}

// An edge b c to be turned into a d: corner a of its triangle and d of the one across.
typedef struct {
  int32_t a, b, c, d;
} Flip;

static Flip flip_of(const CwPatchWork *work, int32_t t, int i) {
  const int32_t *across = work->corner[work->neighbour[t][i]];
  int32_t b = work->corner[t][(i + 1) % 3], c = work->corner[t][(i + 2) % 3];
  return (Flip){work->corner[t][i], b, c, across[0] + across[1] + across[2] - b - c};
}

// The worse of the two triangles after the flip.
static double flipped_quality(const CwPatchWork *work, const Flip *flip) {
  return fmin(cw_patch_quality(work, flip->a, flip->b, flip->d), cw_patch_quality(work, flip->a, flip->d, flip->c));
}

// Flips that even out the number of triangles at the points: smoothing can make only such rings equilateral.
static CwStatus even_out(CwPatchWork *work) {
  CwStatus status = CW_OK;
  int32_t *excess = NULL;
  double *turn = NULL;
  CW_NEW(excess, work->point_count);
  CW_NEW(turn, work->point_count);
  find_excess(work, turn, excess);
  for (int32_t t = 0; t < work->triangle_count; t++) {
    if (work->corner[t][0] < 0) continue;
    for (int i = 0; i < 3; i++) {
      if (work->given[t] >> i & 1) continue;
      Flip flip = flip_of(work, t, i);
      // Half the change of the sum of squares.
      if (excess[flip.a] + excess[flip.d] - excess[flip.b] - excess[flip.c] + 2 >= 0) continue;
      if (flipped_quality(work, &flip) < 0.5 || !cw_patch_flip(work, t, i)) continue;
      excess[flip.a]++;
      excess[flip.d]++;
      excess[flip.b]--;
      excess[flip.c]--;
    }
  }
done:
  free(excess);
  free(turn);
  return status;
}

static double triangle_quality(const CwPatchWork *work, int32_t t) {
  return cw_patch_quality(work, work->corner[t][0], work->corner[t][1], work->corner[t][2]);
}

// Flips the edge of t that betters the worse one of its two triangles most.
static int flip_best(CwPatchWork *work, int32_t t) {
  int best = -1;
  double gain = 1e-3, own = triangle_quality(work, t);
  for (int i = 0; i < 3; i++) {
    if (work->given[t] >> i & 1) continue;
    Flip flip = flip_of(work, t, i);
    double then = flipped_quality(work, &flip);
    double now = fmin(own, triangle_quality(work, work->neighbour[t][i]));
    if (then - now > gain) {
      gain = then - now;
      best = i;
    }
  }
  return best >= 0 && cw_patch_flip(work, t, best);
}

// Moves p by shorter and shorter steps in six directions of the tangent plane while its worst triangle gets
// better.
static int climb(CwPatchWork *work, int32_t p) {
  static const double direction[6][2] = {{1, 0},  {0.5, 0.8660254037844386},   {-0.5, 0.8660254037844386},
                                         {-1, 0}, {-0.5, -0.8660254037844386}, {0.5, -0.8660254037844386}};
  Ring r;
  int moved = 0;
  r.count = cw_patch_ring(work, p, r.triangle, r.ring);
  if (!r.count) return 0;
  for (double step = 0.2 * work->size[p]; step > 0.02 * work->size[p]; step *= 0.5)
    for (int k = 0; k < 6; k++) {
      double n[3], first[3], second[3], move[3];
      cw_patch_normal(work, p, n);
      cw_copy(work->xu[p], first);
      if (!(cw_unit(n) > 0 && cw_unit(first) > 0)) return moved;
      cw_cross(n, first, second);
      for (int c = 0; c < 3; c++) move[c] = step * (direction[k][0] * first[c] + direction[k][1] * second[c]);
      cw_patch_normal(work, p, n);
      moved += try_move(work, &r, p, move, ring_quality(work, &r, p, work->uv[p], work->x[p], n) + 1e-3);
    }
  return moved;
}

// Goes through the triangles below `bound` and takes the first change that betters the worst triangle it
// touches.
static int64_t mend_worst(CwPatchWork *work, double bound) {
  int64_t changes = 0;
  for (int32_t t = 0; t < work->triangle_count; t++) {
    if (work->corner[t][0] < 0 || triangle_quality(work, t) >= bound) continue;
    int done = flip_best(work, t);
    for (int i = 0; i < 3 && !done; i++) {
      int32_t p = work->corner[t][i];
      if (!cw_patch_is_free(work, p)) continue;
      Ring r;
      double n[3];
      r.count = cw_patch_ring(work, p, r.triangle, r.ring);
      cw_patch_normal(work, p, n);
      double now = ring_quality(work, &r, p, work->uv[p], work->x[p], n);
      // Its own triangle counts too: the gain must be there.
      done = r.count && cw_patch_remove(work, p, fmax(now, 0) + 0.05, 1.5);
      if (!done) done = climb(work, p);
    }
    changes += done;
  }
  return changes;
}

// The least cosine between the normal of a triangle and those of the surface at its corners.
static double cosine_of(const CwPatchWork *work, int32_t a, int32_t b, int32_t c) {
  const int32_t corner[3] = {a, b, c};
  double n[3], least = 1;
  cw_normal(work->x[a], work->x[b], work->x[c], n);
  cw_unit(n);
  for (int i = 0; i < 3; i++) {
    double m[3];
    cw_patch_normal(work, corner[i], m);
    if (cw_unit(m) > 0) least = fmin(least, cw_dot(n, m)); // no normal at a pole of the map
  }
  return least;
}

// How well a triangle fits the surface: its least cosine; below all of them where it lies in a cut.
static double fit_of(const CwPatchWork *work, const CwPatchCuts *cuts, int32_t a, int32_t b, int32_t c) {
  return cw_patch_cuts_hold(cuts, (const int32_t[3]){a, b, c}) ? -2 : cosine_of(work, a, b, c);
}

// Flips the edge of an unfit triangle after which the worse of the two fits best, and better than it does; none for a
// needle.
static int flip_unfit(CwPatchWork *work, const CwPatchCuts *cuts, int32_t t) {
  int best = -1;
  const int32_t *c = work->corner[t];
  double own = triangle_quality(work, t);
  double least = fit_of(work, cuts, c[0], c[1], c[2]) + 1e-3;
  for (int i = 0; i < 3; i++) {
    if (work->given[t] >> i & 1) continue;
    Flip flip = flip_of(work, t, i);
    double then = fmin(fit_of(work, cuts, flip.a, flip.b, flip.d), fit_of(work, cuts, flip.a, flip.d, flip.c));
    if (then <= least || flipped_quality(work, &flip) < 0.5 * fmin(own, triangle_quality(work, work->neighbour[t][i])))
      continue;
    least = then;
    best = i;
  }
  return best >= 0 && cw_patch_flip(work, t, best);
}

// Whether a triangle is larger than it may be where smaller ones are wanted.
static int is_too_large(const CwPatchWork *work, int32_t t) {
  const int32_t *c = work->corner[t];
  double most = work->input->largest, n[3];
  if (most == 0 ||
      (work->size[c[0]] + work->size[c[1]] + work->size[c[2]]) / 3 >= cw_policy.surface_clearly_less * most)
    return 0;
  cw_normal(work->x[c[0]], work->x[c[1]], work->x[c[2]], n);
  return cw_norm(n) > 0.5 * sqrt(3) * most * most;
}

// What the free edge from a to b is halved before others for: its length or, for a steep triangle, how far the surface
// turns along it for its length, so that new points on a narrow nose stand beside those of its sides.
static double halving_worth(const CwPatchWork *work, int steep, int32_t a, int32_t b) {
  double n[3], m[3], length = sqrt(cw_patch_distance2(work->x[a], work->x[b]));
  cw_patch_normal(work, a, n);
  cw_patch_normal(work, b, m);
  return steep && cw_unit(n) > 0 && cw_unit(m) > 0 ? (1 - cw_dot(n, m)) / length : length;
}

// Halves edge i of t.
static CwStatus halve_edge(CwPatchWork *work, int32_t t, int i, int *halved) {
  int32_t a = work->corner[t][(i + 1) % 3], b = work->corner[t][(i + 2) % 3];
  const double *from = work->uv[a], *to = work->uv[b], uv[2] = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])};
  return cw_patch_insert(work, uv, t, 0, 0.5 * sqrt(cw_patch_distance2(work->x[a], work->x[b])), halved);
}

// The free edge of t that is worth most; -1: none.
static int edge_to_halve(const CwPatchWork *work, int32_t t, int steep) {
  int best = -1;
  double most = 0;
  for (int i = 0; i < 3; i++) {
    double worth = halving_worth(work, steep, work->corner[t][(i + 1) % 3], work->corner[t][(i + 2) % 3]);
    if (work->given[t] >> i & 1 || worth <= most) continue;
    most = worth;
    best = i;
  }
  return best;
}

static int is_steep(const CwPatchWork *work, int32_t t) {
  const int32_t *c = work->corner[t];
  return cosine_of(work, c[0], c[1], c[2]) < cw_policy.upright_cosine;
}

// The shortest free edge of a triangle that leads over a nose, of those that are not too long or of all; -1: none.
static int edge_over_nose(const CwPatchWork *work, int32_t t, int all) {
  double shortest = INFINITY;
  int best = -1;
  for (int i = 0; i < 3; i++) {
    int32_t a = work->corner[t][(i + 1) % 3], b = work->corner[t][(i + 2) % 3];
    double square = cw_patch_distance2(work->x[a], work->x[b]);
    if (work->given[t] >> i & 1 || square >= shortest || !cw_patch_over_nose(work, a, b)) continue;
    if (!all && cw_patch_is_long(work, a, b)) continue;
    shortest = square;
    best = i;
  }
  return best;
}

// Flips an edge over a nose to one that leads over none, or that is shorter where it is too long.
static int flip_over_nose(CwPatchWork *work, int32_t t, int i) {
  Flip flip = flip_of(work, t, i);
  int over = cw_patch_over_nose(work, flip.a, flip.d);
  if (over ? !cw_patch_is_long(work, flip.b, flip.c) : cw_patch_is_long(work, flip.a, flip.d)) return 0;
  return cw_patch_flip(work, t, i);
}

CwStatus cw_patch_divide_noses(CwPatchWork *work) {
  CwStatus status = CW_OK;
  for (int flips = 0; flips < 2; flips++) { // between the new points there are edges once all are in
    for (int changes = 1, changed; changes > 0;) {
      changes = 0;
      for (int32_t t = 0; t < work->triangle_count; t++) {
        int i = work->corner[t][0] < 0 ? -1 : edge_over_nose(work, t, flips);
        if (i < 0) continue;
        if (flips)
          changed = flip_over_nose(work, t, i);
        else
          CW_TRY(halve_edge(work, t, i, &changed));
        changes += changed;
      }
    }
  }
done:
  return status;
}

// Halves a free edge of triangles that are too large, and of those that lie in a cut or stand steeply on the surface
// and that no flip lays down: their corners see no direction in common with the faces beside it.
static CwStatus mend_unfit(CwPatchWork *work, const CwPatchCuts *cuts, int64_t *changes) {
  CwStatus status = CW_OK;
  int32_t count = work->triangle_count;
  int inserted;
  for (int32_t t = 0; t < count; t++) {
    const int32_t *c = work->corner[t];
    if (c[0] < 0) continue;
    int steep = cw_patch_cuts_hold(cuts, c) || is_steep(work, t);
    if (steep && flip_unfit(work, cuts, t)) {
      ++*changes;
      continue;
    }
    if (!steep && !is_too_large(work, t)) continue;
    int i = edge_to_halve(work, t, steep);
    if (i < 0) continue;
    CW_TRY(halve_edge(work, t, i, &inserted));
    *changes += inserted;
  }
done:
  return status;
}

CwStatus cw_patch_improve(CwPatchWork *work) {
  CwStatus status = CW_OK;
  enum { SWEEPS = 4, MENDS = 4, UNFIT_ROUNDS = 3 };
  CwPatchCuts cuts = {0};
  for (int sweep = 0; sweep < SWEEPS; sweep++) {
    cw_patch_delaunay(work, 1);
    remove_too_close(work);
    CW_TRY(split_long(work));
    cw_patch_delaunay(work, 1);
    // The last sweep keeps what is best for the angles.
    if (sweep + 1 < SWEEPS) CW_TRY(even_out(work));
    smooth(work);
    smooth(work);
  }
  cw_patch_delaunay(work, 1);
  for (int mend = 0; mend < MENDS; mend++)
    if (!mend_worst(work, 0.8)) break;
  CW_TRY(cw_patch_cuts_make(work->input, &cuts));
  // Last, without flips after it: these go by the angles and would turn such triangles back.
  for (int round = 0; round < UNFIT_ROUNDS; round++) {
    int64_t changes = 0;
    CW_TRY(mend_unfit(work, &cuts, &changes));
    if (changes == 0) break;
    smooth(work);
  }
done:
  cw_patch_cuts_free(&cuts);
  return status;
}
