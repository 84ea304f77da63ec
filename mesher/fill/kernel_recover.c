// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_recover.h"

#include <string.h>

#include "mesher/common/predicates.h"
#include "mesher/common/tet.h"
#include "mesher/fill/kernel_flips.h"
#include "pipeline/log.h"

// What is to be recovered: the edge of the first two points, or the face of all three.
typedef struct {
  const CwTetMesh *mesh;
  int32_t point[3];
} Goal;

typedef struct {
  CwFlips flips;
  const CwFacets *facets;
  Goal goal;
  uint32_t random;
  int32_t *source_count;
} Recovery;

static int side(const CwTetMesh *mesh, int32_t a, int32_t b, int32_t c, int32_t d) {
  const CwTetPoint *p = mesh->point;
  return cw_orient3d(p[a].x, p[b].x, p[c].x, p[d].x);
}

static int shares(const int32_t *p, int m, const int32_t *q, int n) {
  for (int i = 0; i < m; i++) {
    for (int k = 0; k < n; k++) {
      if (p[i] == q[k]) return 1;
    }
  }
  return 0;
}

// Does the segment a-b meet the triangle (touching counts)? They share no point.
static int meet(const CwTetMesh *mesh, int32_t a, int32_t b, const int32_t t[3]) {
  int below = side(mesh, t[0], t[1], t[2], a), above = side(mesh, t[0], t[1], t[2], b), low = 0, high = 0;
  if (below * above > 0 || (below == 0 && above == 0)) return 0;
  for (int k = 0; k < 3; k++) {
    int s = side(mesh, a, b, t[k], t[(k + 1) % 3]);
    low |= s < 0;
    high |= s > 0;
  }
  return !(low && high);
}

static int face_crosses_edge(const void *context, int count, const int32_t *point) {
  const Goal *goal = context;
  if (count != 3 || shares(point, 3, goal->point, 2)) return 0;
  return meet(goal->mesh, goal->point[0], goal->point[1], point);
}

static int edge_crosses_face(const void *context, int count, const int32_t *point) {
  const Goal *goal = context;
  if (count != 2 || shares(point, 2, goal->point, 3)) return 0;
  return meet(goal->mesh, point[0], point[1], goal->point);
}

static int draw(Recovery *r, int below) {
  r->random = r->random * 1664525u + 1013904223u;
  return (int)((r->random >> 16) % (uint32_t)below);
}

// Takes the edge p-q away: at once (*moved = 2), or in steps: a flip of a face or edge next to it that adds no
// crossings (*moved = 1), found by chance, for there may be circles.
static CwStatus clear_edge(Recovery *r, int32_t t, int32_t p, int32_t q, int depth, int *moved) {
  CwStatus status = CW_OK;
  CwFlips *flips = &r->flips;
  int32_t tet[CW_RING], ring[CW_RING];
  *moved = 0;
  if (cw_facets_has_edge(r->facets, p, q)) goto done;
  CW_TRY(cw_flips_edge(flips, t, p, q, moved));
  *moved *= 2;
  if (*moved || depth == 0) goto done;
  int n = cw_tet_ring(flips->mesh, t, p, q, CW_RING, tet, ring), slack = flips->slack, first = n ? draw(r, n) : 0;
  flips->slack = 1; // no more crossings than before
  for (int step = 0; step < n && !*moved; step++) {
    int k = (first + step) % n;
    const CwTet *now = &flips->mesh->tet[tet[k]];
    int32_t far = ring[(k + 1) % n];
    const int32_t face[3] = {p, q, ring[k]};
    if (cw_facets_find(r->facets, face) >= 0) continue;
    for (int i = 0; i < 4 && !*moved; i++) { // the face p, q, ring[k]
      if (now->corner[i] == far) CW_TRY(cw_flips_face(flips, tet[k], i, moved));
    }
    for (int end = 0; end < 2 && !*moved; end++) CW_TRY(clear_edge(r, tet[k], end ? p : q, ring[k], depth - 1, moved));
  }
  flips->slack = slack;
  *moved = *moved > 0;
done:
  return status;
}

// What lies on the way from a to b beside a, in tetrahedron t: an edge (count = 2) or a face (3) opposite its corner
// `at`; count = 0: another point, or nothing, as the edge is there.
typedef struct {
  int count, at;
  int32_t t, point[3];
} Obstacle;

static CwStatus look_towards(Recovery *r, int32_t a, int32_t b, int *found, Obstacle *obstacle) {
  CwStatus status = CW_OK;
  CwFlips *flips = &r->flips;
  const CwTetMesh *mesh = flips->mesh;
  int32_t t;
  *obstacle = (Obstacle){.count = 0};
  CW_TRY(cw_flips_find_edge(flips, a, b, &t));
  *found = t >= 0;
  for (int32_t k = 0; k < flips->star_count && !*found; k++) {
    const CwTet *tet = &mesh->tet[flips->star[k]];
    int at = cw_tet_corner_of(tet, a), zeros = 0, zero = -1, within = 1, count = 0;
    for (int i = 0; i < 4 && within; i++) {
      if (i == at) continue;
      int32_t p[4];
      memcpy(p, tet->corner, sizeof p);
      p[i] = b;
      int s = side(mesh, p[0], p[1], p[2], p[3]);
      within = s >= 0;
      if (s == 0) {
        zeros++;
        zero = i;
      }
    }
    if (!within) continue;
    if (zeros > 1) goto done;
    *obstacle = (Obstacle){.count = 3 - zeros, .at = at, .t = flips->star[k]};
    for (int i = 0; i < 3; i++) {
      int corner = cw_tet_face[at][i];
      if (corner != zero) obstacle->point[count++] = tet->corner[corner];
    }
    goto done;
  }
done:
  return status;
}

// A flip that takes away what is on the way from a to b. *found: the edge is there.
static CwStatus clear_towards(Recovery *r, int32_t a, int32_t b, int depth, int *found, int *moved) {
  CwStatus status = CW_OK;
  Obstacle on;
  *moved = 0;
  CW_TRY(look_towards(r, a, b, found, &on));
  if (on.count == 2) CW_TRY(clear_edge(r, on.t, on.point[0], on.point[1], depth, moved));
  if (on.count < 3 || cw_facets_find(r->facets, on.point) >= 0) goto done;
  CW_TRY(cw_flips_face(&r->flips, on.t, on.at, moved));
  *moved *= 2;
  for (int level = 0; level <= depth && !*moved; level++) {
    int first = level ? draw(r, 3) : 0;
    for (int i = first; i < first + 3 && !*moved; i++)
      CW_TRY(clear_edge(r, on.t, on.point[i % 3], on.point[(i + 1) % 3], level, moved));
  }
done:
  return status;
}

// From both ends in turn; deeper searches only where simple flips are stuck.
static CwStatus recover_edge(Recovery *r, int32_t a, int32_t b, int *found) {
  CwStatus status = CW_OK;
  r->goal.point[0] = a;
  r->goal.point[1] = b;
  r->flips.crossing = face_crosses_edge;
  r->flips.slack = 0;
  for (int stuck = 0; stuck < CW_RECOVER_TRIES; stuck++) {
    for (int held = 0, moved = 1; held < 2 * CW_RECOVER_TRIES && moved; held += moved == 1) {
      CW_TRY(clear_towards(r, stuck % 2 ? b : a, stuck % 2 ? a : b, stuck / 2, found, &moved));
      if (*found) goto done;
    }
  }
done:
  return status;
}

// The face, once its edges are there: takes away the edges through it, seen from each of its own edges.
static CwStatus recover_face(Recovery *r, const int32_t corner[3], int *found) {
  CwStatus status = CW_OK;
  CwFlips *flips = &r->flips;
  memcpy(r->goal.point, corner, sizeof r->goal.point);
  flips->crossing = edge_crosses_face;
  flips->slack = 0;
  *found = 0;
  for (int stuck = 0; stuck < CW_RECOVER_TRIES; stuck++) {
    int32_t a = corner[stuck % 3], b = corner[(stuck + 1) % 3], c = corner[(stuck + 2) % 3], t;
    int32_t tet[CW_RING], ring[CW_RING];
    for (int held = 0, moved = 1; held < 2 * CW_RECOVER_TRIES && moved; held += moved == 1) {
      moved = 0;
      CW_TRY(cw_flips_find_edge(flips, a, b, &t));
      int n = t < 0 ? 0 : cw_tet_ring(flips->mesh, t, a, b, CW_RING, tet, ring);
      for (int k = 0; k < n && !*found; k++) *found = ring[k] == c;
      if (*found) goto done;
      for (int k = 0; k < n && !moved; k++) {
        int32_t end[2] = {ring[k], ring[(k + 1) % n]};
        if (edge_crosses_face(&r->goal, 2, end)) CW_TRY(clear_edge(r, tet[k], end[0], end[1], stuck / 3, &moved));
      }
    }
  }
done:
  return status;
}

// Puts a point on edge p-q of t, if it is none of the boundary's, not far from the middle, and by chance, lest it come
// to lie in line with others.
static CwStatus put_point(Recovery *r, int32_t t, int32_t p, int32_t q, int *put) {
  if (cw_facets_has_edge(r->facets, p, q)) return CW_OK;
  return cw_flips_split(&r->flips, t, p, q, (96 + draw(r, 64)) / 256.0, r->source_count, put);
}

// On one that is on the way from a to b.
static CwStatus put_point_between(Recovery *r, int32_t a, int32_t b, int *put) {
  CwStatus status = CW_OK;
  Obstacle on;
  int found;
  *put = 0;
  CW_TRY(look_towards(r, a, b, &found, &on));
  for (int i = 0; i < on.count && !*put; i++)
    CW_TRY(put_point(r, on.t, on.point[i], on.point[(i + 1) % on.count], put));
done:
  return status;
}

// Where flips alone are stuck (P. L. George, F. Hecht, E. Saltel, Automatic mesh generator with specified boundary,
// 1991, whose points are moved from there later): the improvement moves these, too, or takes them away.
static CwStatus recover_edge_by_points(Recovery *r, int32_t a, int32_t b, int *found) {
  CwStatus status = CW_OK;
  for (int put = 1, points = 0; put && !*found && points < CW_RECOVER_TRIES; points++) {
    CW_TRY(put_point_between(r, points % 2 ? b : a, points % 2 ? a : b, &put));
    if (put) CW_TRY(recover_edge(r, a, b, found));
  }
done:
  return status;
}

// Whether face i of a tetrahedron is the facet, seen from inside.
static int is_inner(const CwTet *tet, int i, const int32_t facet[3]) {
  const int8_t *face = cw_tet_face[i];
  if (tet->corner[0] < 0) return 0;
  int k = tet->corner[face[0]] == facet[0] ? 0 : tet->corner[face[1]] == facet[0] ? 1 : 2;
  for (int m = 0; m < 3; m++) {
    if (tet->corner[face[(k + m) % 3]] != facet[m]) return 0;
  }
  return 1;
}

// Looks for the facets that flips may have moved, round a point of each: few are, beside all faces of the mesh.
static CwStatus locate_again(CwFlips *flips, CwFacets *facets) {
  CwStatus status = CW_OK;
  const CwTetMesh *mesh = flips->mesh;
  facets->missing_count = 0;
  for (int32_t f = 0; f < facets->count; f++) {
    const int32_t *corner = facets->corner[f];
    int32_t *inner = &facets->inner[f];
    if (*inner >= 0 && is_inner(&mesh->tet[*inner / 4], *inner % 4, corner)) continue;
    *inner = -1;
    CW_TRY(cw_flips_star(flips, corner[0]));
    for (int32_t k = 0; k < 4 * flips->star_count && *inner < 0; k++) {
      int32_t t = flips->star[k / 4];
      if (is_inner(&mesh->tet[t], k % 4, corner)) *inner = 4 * t + k % 4;
    }
    facets->missing_count += *inner < 0;
  }
done:
  return status;
}

CwStatus cw_kernel_recover(CwTetMesh *mesh, CwFacets *facets, int round, CwLog *log, int32_t *source_count,
                           int64_t *flips) {
  CwStatus status = CW_OK;
  Recovery r = {
      .facets = facets, .goal = {.mesh = mesh}, .random = 20240611u + (uint32_t)round, .source_count = source_count};
  int lost_edges = 0, lost_faces = 0, found;
  CW_TRY(cw_flips_make(mesh, &r.flips));
  r.flips.context = &r.goal;
  for (int32_t f = 0; f < facets->count; f++) {
    if (facets->inner[f] >= 0) continue;
    for (int k = 0; k < 3; k++) {
      int32_t a = facets->corner[f][k], b = facets->corner[f][(k + 1) % 3];
      CW_TRY(recover_edge(&r, a, b, &found));
      if (!found && round > 0) CW_TRY(recover_edge_by_points(&r, a, b, &found));
      lost_edges += !found;
    }
  }
  for (int32_t f = 0; f < facets->count; f++) {
    if (facets->inner[f] >= 0) continue;
    CW_TRY(recover_face(&r, facets->corner[f], &found));
    lost_faces += !found;
  }
  *flips += r.flips.done;
  cw_log_debug(log, "%d missing triangles: %lld flips, %d edges and %d triangles not recovered", facets->missing_count,
               (long long)r.flips.done, lost_edges, lost_faces);
  CW_TRY(locate_again(&r.flips, facets));
done:
  cw_flips_free(&r.flips);
  return status;
}
