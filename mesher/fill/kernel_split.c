// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/kernel_split.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/predicates.h"
#include "mesher/common/quality.h"
#include "mesher/common/vec.h"
#include "mesher/fill/kernel_clear.h"
#include "pipeline/log.h"

static const int8_t tet_face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
static const int8_t tet_edge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// Places kept where the mesh crosses what is missing; searches by flips before a division; divisions of a
// boundary at most, for each missing triangle and at all; layers searched for a point.
enum { PLACES = 48, TRIES = 4, MOST_EACH = 5, MOST = 200, LAYERS = 3 };

// A place where the mesh crosses a missing edge or triangle: on an edge of two points, in a face of three, or in
// a tetrahedron.
typedef struct {
  int count;
  int32_t point[4], tet; // that has them
  double x[3], worth;
} Place;

typedef struct {
  CwRecovery recovery;
  CwFacets *facets;
  CwSplits *splits;
  int32_t *source_count;
  int32_t *crossed, crossed_count, crossed_space; // tetrahedra
  Place place[PLACES];                            // worthiest first
  int place_count;
} Splitter;

static const double *at(const CwDelaunay *mesh, int32_t p) {
  return mesh->point[p].x;
}

static int has(const int32_t *list, int count, int32_t item) {
  for (int k = 0; k < count; k++) {
    if (list[k] == item) return 1;
  }
  return 0;
}

static void note_place(Splitter *s, const Place *place) {
  if (s->place_count == PLACES && s->place[PLACES - 1].worth >= place->worth) return;
  int k = s->place_count < PLACES ? s->place_count++ : PLACES - 1;
  for (; k > 0 && s->place[k - 1].worth < place->worth; k--) s->place[k] = s->place[k - 1];
  s->place[k] = *place;
}

// Six times the volume of (a, b, c, d).
static double six(const CwDelaunay *mesh, int32_t a, int32_t b, int32_t c, int32_t d) {
  return cw_tet_volume6(at(mesh, a), at(mesh, b), at(mesh, c), at(mesh, d));
}

// Where the segment a-b crosses the triangle, at which share of the way; how many of its edges it meets.
static int crossing(const CwDelaunay *mesh, int32_t a, int32_t b, const int32_t t[3], double *share, int *on_edge) {
  int zeros = 0;
  for (int k = 0; k < 3; k++) {
    if (cw_orient3d(at(mesh, a), at(mesh, b), at(mesh, t[k]), at(mesh, t[(k + 1) % 3])) != 0) continue;
    zeros++;
    *on_edge = k;
  }
  double from = fabs(six(mesh, t[0], t[1], t[2], a)), to = fabs(six(mesh, t[0], t[1], t[2], b));
  *share = from + to > 0.0 ? from / (from + to) : 0.5;
  return zeros;
}

static CwStatus push(Splitter *s, int32_t t) {
  CwStatus status = CW_OK;
  CwFlips *flips = &s->recovery.flips;
  CW_GROW(s->crossed, s->crossed_space, s->crossed_count + 1);
  s->crossed[s->crossed_count++] = t;
  flips->mesh->tet[t].stamp = flips->stamp;
done:
  return status;
}

// The worth of a place that is less likely to be valid, or gives a flatter tetrahedron, than one on a face.
static const double less_on_edge = 0.2, less_inside = 0.4;

// Places in the faces of the tetrahedron that the missing edge crosses, on their edges next to that, and between.
static int look_along_edge(Splitter *s, const int32_t *goal, int32_t t) {
  const CwDelaunay *mesh = s->recovery.flips.mesh;
  const CwDelaunayTet *tet = &mesh->tet[t];
  int found = 0;
  double low = has(tet->corner, 4, goal[0]) ? 0.0 : INFINITY, high = has(tet->corner, 4, goal[1]) ? 1.0 : -INFINITY;
  for (int i = 0; i < 4; i++) {
    Place place = {.count = 3, .tet = t};
    double share;
    int on_edge = 0;
    for (int k = 0; k < 3; k++) place.point[k] = tet->corner[tet_face[i][k]];
    if (has(place.point, 3, goal[0]) || has(place.point, 3, goal[1]) ||
        !cw_kernel_meet(mesh, goal[0], goal[1], place.point))
      continue;
    found = 1;
    int zeros = crossing(mesh, goal[0], goal[1], place.point, &share, &on_edge);
    low = fmin(low, share);
    high = fmax(high, share);
    if (zeros > 1) continue; // through a point
    cw_lerp(at(mesh, goal[0]), at(mesh, goal[1]), share, place.x);
    place.worth = -fabs(share - 0.5);
    if (zeros == 0) note_place(s, &place);
    place.count = 2;
    place.worth -= zeros ? 0.0 : less_on_edge;
    for (int k = 0; k < 3; k++) {
      const int32_t end[2] = {tet->corner[tet_face[i][k]], tet->corner[tet_face[i][(k + 1) % 3]]};
      memcpy(place.point, end, sizeof end);
      if (zeros == 0 || k == on_edge) note_place(s, &place);
    }
  }
  if (found && high > low) {
    Place place = {.count = 4, .tet = t, .worth = -fabs(0.5 * (low + high) - 0.5) - less_inside};
    cw_lerp(at(mesh, goal[0]), at(mesh, goal[1]), 0.5 * (low + high), place.x);
    note_place(s, &place);
  }
  return found;
}

// Places on the edges of the tetrahedron that cross the missing triangle, and between.
static int look_in_face(Splitter *s, const int32_t *goal, int32_t t) {
  const CwDelaunay *mesh = s->recovery.flips.mesh;
  const CwDelaunayTet *tet = &mesh->tet[t];
  int found = 0, inner = 0;
  Place between = {.count = 4, .tet = t, .worth = INFINITY};
  for (int e = 0; e < 6; e++) {
    Place place = {.count = 2, .tet = t, .point = {tet->corner[tet_edge[e][0]], tet->corner[tet_edge[e][1]]}};
    double share, part[3], sum = 0.0;
    int on_edge;
    if (has(goal, 3, place.point[0]) || has(goal, 3, place.point[1]) ||
        !cw_kernel_meet(mesh, place.point[0], place.point[1], goal))
      continue;
    found = 1;
    if (crossing(mesh, place.point[0], place.point[1], goal, &share, &on_edge) > 0) continue;
    cw_lerp(at(mesh, place.point[0]), at(mesh, place.point[1]), share, place.x);
    for (int k = 0; k < 3; k++)
      sum += part[k] = fabs(six(mesh, place.point[0], place.point[1], goal[k], goal[(k + 1) % 3]));
    place.worth = fmin(part[0], fmin(part[1], part[2])) / sum;
    for (int i = 0; i < 3; i++) between.x[i] += place.x[i];
    between.worth = fmin(between.worth, place.worth - less_inside);
    inner++;
    int seen = 0;
    for (int k = 0; k < s->place_count && !seen; k++)
      seen = s->place[k].count == 2 && has(s->place[k].point, 2, place.point[0]) &&
             has(s->place[k].point, 2, place.point[1]);
    if (!seen) note_place(s, &place);
  }
  for (int i = 0; i < 3 && inner; i++) between.x[i] /= inner;
  if (inner >= 2) note_place(s, &between);
  return found;
}

// What the tetrahedron has across the missing edge (count = 2) or triangle (3); false where there is nothing.
static int look(Splitter *s, int count, const int32_t *goal, int32_t t) {
  return count == 2 ? look_along_edge(s, goal, t) : look_in_face(s, goal, t);
}

// All that crosses it, from the stars of its points on.
static CwStatus find_places(Splitter *s, int count, const int32_t *goal) {
  CwStatus status = CW_OK;
  CwFlips *flips = &s->recovery.flips;
  const CwDelaunay *mesh = flips->mesh;
  s->crossed_count = s->place_count = 0;
  for (int k = 0; k < count; k++) {
    CW_TRY(cw_flips_star(flips, goal[k]));
    for (int32_t i = 0; i < flips->star_count; i++) {
      int32_t t = flips->star[i];
      s->place_count = 0;
      if (look(s, count, goal, t) && !has(s->crossed, s->crossed_count, t)) CW_TRY(push(s, t));
    }
  }
  flips->stamp++;
  for (int32_t k = 0; k < s->crossed_count; k++) mesh->tet[s->crossed[k]].stamp = flips->stamp;
  s->place_count = 0;
  for (int32_t head = 0; head < s->crossed_count; head++) {
    const CwDelaunayTet *tet = &mesh->tet[s->crossed[head]];
    if (!look(s, count, goal, s->crossed[head])) continue;
    for (int i = 0; i < 4; i++) {
      if (tet->neighbour[i] >= 0 && mesh->tet[tet->neighbour[i] / 4].stamp != flips->stamp)
        CW_TRY(push(s, tet->neighbour[i] / 4));
    }
  }
done:
  return status;
}

// Puts a point on the edge or into the face or tetrahedron. *point is -1 where that is not valid.
static CwStatus put_point(Splitter *s, const Place *place, int32_t *point) {
  CwStatus status = CW_OK;
  CwFlips *flips = &s->recovery.flips;
  const CwDelaunay *mesh = flips->mesh;
  int32_t old[CW_RING], ring[CW_RING], made[CW_FLIP][4], slot[CW_FLIP];
  int old_count = 0, count = 0;
  *point = -1;
  if (place->count == 4) {
    const int32_t *c = mesh->tet[place->tet].corner;
    old[old_count++] = place->tet;
    for (int i = 0; i < 4; i++) {
      const int32_t one[4] = {c[tet_face[i][0]], c[tet_face[i][2]], c[tet_face[i][1]], -1};
      memcpy(made[count++], one, sizeof one);
    }
  } else if (place->count == 3) {
    const CwDelaunayTet *tet = &mesh->tet[place->tet];
    int i = 0;
    while (has(place->point, 3, tet->corner[i])) i++;
    if (cw_facets_find(s->facets, place->point) >= 0 || tet->neighbour[i] < 0) goto done;
    int32_t other = tet->neighbour[i];
    old[old_count++] = place->tet;
    old[old_count++] = other / 4;
    for (int k = 0; k < 3; k++) {
      int32_t a = tet->corner[tet_face[i][k]], b = tet->corner[tet_face[i][(k + 1) % 3]];
      const int32_t below[4] = {b, a, tet->corner[i], -1},
                    above[4] = {a, b, mesh->tet[other / 4].corner[other % 4], -1};
      memcpy(made[count++], below, sizeof below);
      memcpy(made[count++], above, sizeof above);
    }
  } else {
    int32_t a = place->point[0], b = place->point[1];
    if (cw_facets_has_edge(s->facets, a, b)) goto done;
    old_count = cw_flips_ring(flips, place->tet, a, b, CW_RING, old, ring);
    for (int k = 0; k < old_count; k++) {
      int32_t from = ring[k], to = ring[(k + 1) % old_count]; // (a, b, from, to) is positive
      const int32_t low[4] = {from, to, a, -1}, high[4] = {to, from, b, -1};
      memcpy(made[count++], low, sizeof low);
      memcpy(made[count++], high, sizeof high);
    }
  }
  for (int k = 0; k < count; k++) {
    if (cw_orient3d(at(mesh, made[k][0]), at(mesh, made[k][1]), at(mesh, made[k][2]), place->x) <= 0) goto done;
  }
  if (count == 0) goto done;
  CW_TRY(cw_flips_add_point(flips, place->x, (*s->source_count)++, point));
  for (int k = 0; k < count; k++) made[k][3] = *point;
  CW_TRY(cw_flips_replace(flips, old_count, old, count, (const int32_t(*)[4])made, slot));
done:
  return status;
}

// The tetrahedron that has x inside, among those that cross what is missing and some layers round them; -1: none.
static CwStatus find_around(Splitter *s, const double x[3], int32_t *tet) {
  CwStatus status = CW_OK;
  CwFlips *flips = &s->recovery.flips;
  const CwDelaunay *mesh = flips->mesh;
  int32_t kept = s->crossed_count, last = kept;
  *tet = -1;
  flips->stamp++;
  for (int32_t k = 0; k < kept; k++) mesh->tet[s->crossed[k]].stamp = flips->stamp;
  for (int32_t k = 0, layer = 0; k < s->crossed_count && *tet < 0; k++) {
    if (k == last) {
      layer++;
      last = s->crossed_count;
    }
    const CwDelaunayTet *now = &mesh->tet[s->crossed[k]];
    int inside = 1;
    for (int i = 0; i < 4; i++) {
      inside = inside && cw_orient3d(at(mesh, now->corner[tet_face[i][0]]), at(mesh, now->corner[tet_face[i][2]]),
                                     at(mesh, now->corner[tet_face[i][1]]), x) > 0;
      int32_t next = now->neighbour[i] / 4;
      if (layer < LAYERS && now->neighbour[i] >= 0 && mesh->tet[next].stamp != flips->stamp) {
        CW_TRY(push(s, next));
        now = &mesh->tet[s->crossed[k]];
      }
    }
    if (inside) *tet = s->crossed[k];
  }
  s->crossed_count = kept;
done:
  return status;
}

// A point a little beside the missing edge or triangle of the facet: where all round it lies in one plane,
// rounding leaves no room on it.
static CwStatus put_beside(Splitter *s, int32_t facet, int count, const int32_t *goal, int32_t *point) {
  CwStatus status = CW_OK;
  static const double share[3][3] = {{0.5, 0.5, 0.0}, {0.3, 0.7, 0.0}, {0.7, 0.3, 0.0}};
  static const double inner[3][3] = {{0.34, 0.33, 0.33}, {0.5, 0.3, 0.2}, {0.2, 0.3, 0.5}};
  static const double off[6] = {-1e-9, 1e-9, -1e-7, 1e-7, -1e-5, 1e-5};
  const CwDelaunay *mesh = s->recovery.flips.mesh;
  const int32_t *p = s->facets->corner[facet];
  double u[3], v[3], normal[3];
  cw_sub(at(mesh, p[1]), at(mesh, p[0]), u);
  cw_sub(at(mesh, p[2]), at(mesh, p[0]), v);
  cw_cross(u, v, normal);
  cw_unit(normal);
  double length = cw_distance(at(mesh, goal[0]), at(mesh, goal[1]));
  *point = -1;
  for (int k = 0; k < 18 && *point < 0; k++) {
    const double *w = count == 2 ? share[k % 3] : inner[k % 3];
    Place place = {.count = 4};
    for (int i = 0; i < 3; i++) {
      place.x[i] = off[k / 3] * length * normal[i];
      for (int c = 0; c < count; c++) place.x[i] += w[c] * at(mesh, goal[c])[i];
    }
    CW_TRY(find_around(s, place.x, &place.tet));
    if (place.tet >= 0) CW_TRY(put_point(s, &place, point));
  }
done:
  return status;
}

static CwStatus note_split(CwSplits *splits, const CwSplit *split) {
  CwStatus status = CW_OK;
  CW_GROW(splits->split, splits->space, splits->count + 1);
  splits->split[splits->count++] = *split;
done:
  return status;
}

// Divides the missing edge, of all its triangles, or the missing triangle, at the first place that allows it.
static CwStatus divide(Splitter *s, int32_t facet, int count, const int32_t *goal, int *done_it) {
  CwStatus status = CW_OK;
  CwSplit split = {.point = -1};
  *done_it = 0;
  CW_TRY(find_places(s, count, goal));
  for (int k = 0; k < s->place_count && split.point < 0; k++) CW_TRY(put_point(s, &s->place[k], &split.point));
  if (split.point < 0) CW_TRY(put_beside(s, facet, count, goal, &split.point));
  if (split.point < 0) goto done;
  if (count == 2) {
    CW_TRY(cw_facets_divide_edge(s->facets, goal[0], goal[1], split.point, &split.count, split.ends, split.apex));
    if (split.count != 2) goto done; // bodies touch here: the point stays as one of the inside or outside
  } else {
    split.count = 1;
    split.ends[0][0] = goal[0];
    split.ends[0][1] = goal[1];
    split.apex[0] = goal[2];
    CW_TRY(cw_facets_divide_face(s->facets, facet, split.point));
  }
  CW_TRY(note_split(s->splits, &split));
  *done_it = 1;
done:
  return status;
}

CwStatus cw_kernel_split(CwDelaunay *mesh, CwFacets *facets, int32_t *source_count, CwSplits *splits,
                         CwRecovered *recovered) {
  CwStatus status = CW_OK;
  Splitter s = {.facets = facets, .splits = splits, .source_count = source_count};
  int32_t most = MOST_EACH * facets->missing_count + MOST, lost = 0;
  CW_TRY(cw_recovery_make(mesh, facets, 1000, &s.recovery));
  if (facets->divided_from > *source_count) facets->divided_from = *source_count;
  for (int32_t f = 0; f < facets->count; f++) {
    while (facets->inner[f] < 0) {
      int32_t p[3], goal[3];
      int count = 3, found = 1, good = 0;
      memcpy(p, facets->corner[f], sizeof p);
      for (int k = 0; k < 3 && found; k++) {
        CW_TRY(cw_recovery_edge(&s.recovery, p[k], p[(k + 1) % 3], TRIES, &found));
        count = found ? 3 : 2;
        goal[0] = p[k];
        goal[1] = p[(k + 1) % 3];
      }
      if (found) {
        memcpy(goal, p, sizeof goal);
        CW_TRY(cw_recovery_face(&s.recovery, p, TRIES, &found));
      }
      if (found)
        facets->inner[f] = 0; // there; its place is looked up later
      else if (splits->count < most)
        CW_TRY(divide(&s, f, count, goal, &good));
      if (!found && !good) {
        lost++;
        break;
      }
    }
  }
  recovered->flips += s.recovery.flips.done;
  cw_log_debug("%d points on the boundary, %d triangles not recovered", splits->count, lost);
done:
  cw_recovery_free(&s.recovery);
  free(s.crossed);
  return status;
}

void cw_splits_free(CwSplits *splits) {
  free(splits->split);
  memset(splits, 0, sizeof *splits);
}
