// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box.h"
#include "mesher/common/four.h"
#include "mesher/common/number.h"
#include "mesher/fill/tet_group.h"

static const float regular = 0.8f;      // a point stays where all round it are above; 0.866 in a lattice
static const double unsure = 1e-3;      // of a quality in single precision, by far
static const double blurred = 1e-4;     // of the extent of all: edges for which single precision will not do
static const float decay = 0.7f;        // of each step towards even edges over the one before
static const uint32_t beside_plane = 2; // weight of tetrahedra beside dividing planes, when edges are made even
enum { MOVED = 1, RETURNED = 2 };       // a point that is free to move
enum { ON_PLANE = 4, BESIDE = 8 };      // a fixed point on a dividing plane; a free one of its tetrahedra
enum { BLOCK = 128 };                   // tetrahedra that are looked for together
enum { PAD = CW_TET_GROUP - 1 };        // room behind a list

static inline CwFour place_of(const CwTetWork *w, const double x[3]) {
  return cw_four_way(w->middle, x);
}

static CwStatus set_places(CwTetWork *w) {
  CwStatus status = CW_OK;
  const CwDelaunay *mesh = w->mesh;
  CwBox box = cw_box_empty();
  CW_GROW(w->place, w->place_space, mesh->point_count);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    if (mesh->source[p] >= 0) cw_box_add_point(&box, mesh->point[p].x);
  }
  for (int i = 0; i < 3; i++) w->middle[i] = 0.5 * (box.low[i] + box.high[i]);
  double extent = cw_box_longest(&box);
  w->blurred = blurred * blurred * extent * extent;
  for (int32_t p = 0; p < mesh->point_count; p++) w->place[p] = place_of(w, mesh->point[p].x);
done:
  return status;
}

// A list of tetrahedra is taken by groups: the last one stands for those that lack.
static inline void pad_list(int32_t *list, int32_t count) {
  for (int k = 0; k < PAD && count; k++) list[count + k] = list[count - 1];
}

// Where a point is to go: from its place by what it has moved in single precision.
static inline void find_goal(const CwTetWork *w, int32_t p, double goal[3]) {
  const double *x = cw_tet_at(w, p);
  CwFour way = w->place[p] - place_of(w, x);
  for (int i = 0; i < 3; i++) goal[i] = x[i] + (double)way[i];
}

static double quality_at_goals(const CwTetWork *w, const int32_t corner[4]) {
  double x[4][3];
  for (int k = 0; k < 4; k++) find_goal(w, corner[k], x[k]);
  return cw_tet_quality(x[0], x[1], x[2], x[3]);
}

// Whether moves make a tetrahedron worse than it may be.
static int is_spoilt(const CwTetWork *w, int32_t t) {
  const CwDelaunayTet *tet = &w->mesh->tet[t];
  const int32_t *c = tet->corner;
  return tet->quality < w->floor && tet->quality < cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
}

// Marks the points of tetrahedra that are irregular, and adds the slender ones to their list, without branches.
static inline void note_shapes(CwTetWork *w, const int32_t *list, int count, const float *quality,
                               const int32_t *slender) {
  for (int k = 0; k < count && w->irregular; k++) {
    const int32_t *c = w->mesh->tet[list[k]].corner;
    for (int i = 0; i < 4; i++) w->irregular[c[i]] |= (uint8_t)cw_number(quality[k] < regular);
  }
  for (int k = 0; k < count; k++) {
    w->slender.tet[w->slender.count] = list[k];
    w->slender.count -= slender[k];
  }
}

// Sets the quality of some tetrahedra as it is to be, in a list with PAD more, and puts them into the list where they
// are below the limit, into that of the slender ones and, where given, into that of the spoilt ones.
static CwStatus judge(CwTetWork *w, const int32_t *list, int32_t count, CwTetList *spoilt) {
  CwStatus status = CW_OK;
  const float slender_square = (float)cw_tet_slender_square(w);
  CW_GROW(w->slender.tet, w->slender.space, w->slender.count + count + 1);
  for (int32_t from = 0; from < count; from += CW_TET_GROUP) {
    float quality[CW_TET_GROUP];
    int32_t slender[CW_TET_GROUP];
    int some = count - from < CW_TET_GROUP ? count - from : CW_TET_GROUP;
    cw_tet_group_qualities(w->mesh, list + from, w->place, (float)w->blurred, slender_square, quality, slender);
    note_shapes(w, list + from, some, quality, slender);
    for (int k = 0; k < some; k++) {
      int32_t t = list[from + k];
      CwDelaunayTet *tet = &w->mesh->tet[t];
      tet->quality = (double)quality[k];
      if (quality[k] > (float)(w->limit + unsure)) continue;
      tet->quality = quality_at_goals(w, tet->corner);
      if (tet->quality < w->limit) CW_TRY(cw_tet_push(w, t));
      if (!spoilt || !is_spoilt(w, t)) continue;
      CW_GROW(spoilt->tet, spoilt->space, spoilt->count + 1);
      spoilt->tet[spoilt->count++] = t;
    }
  }
done:
  return status;
}

CwStatus cw_tet_scan(CwTetWork *w) {
  CwStatus status = CW_OK;
  int32_t list[BLOCK + PAD];
  CW_TRY(set_places(w));
  w->slender.count = w->tet_count = 0;
  for (int32_t p = 0; p < w->mesh->point_count; p++) w->mesh->point[p].mark = 0;
  for (int32_t from = 0; from < w->mesh->tet_count; from += BLOCK) {
    int count = 0;
    for (int32_t t = from; t < from + BLOCK && t < w->mesh->tet_count; t++) {
      CwDelaunayTet *tet = &w->mesh->tet[t];
      tet->star = 0;
      tet->pass = CW_TET_NO_PASS;
      list[count] = t; // without a branch
      count += (int)cw_number(tet->corner[0] >= 0);
    }
    pad_list(list, count);
    CW_TRY(judge(w, list, count, NULL));
    w->tet_count += count;
  }
done:
  return status;
}

// Tetrahedra whose points move, with PAD more.
typedef struct {
  int32_t *tet, count;
} Moving;

// Lists the tetrahedra with such a point, of which all have room, and weighs them.
static void find_moving(CwDelaunay *mesh, const uint8_t *moved, uint8_t which, Moving *moving) {
  const uint32_t weight[2] = {1, beside_plane};
  int32_t count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) { // without branches, which would be taken at random
    CwDelaunayTet *tet = &mesh->tet[t];
    cw_delaunay_ask_ahead(tet);
    const int32_t *c = tet->corner, used = ~(c[0] >> 31);
    uint8_t any = moved[c[0] & used] | moved[c[1] & used] | moved[c[2] & used] | moved[c[3] & used];
    any &= (uint8_t)used;
    tet->weight = weight[(any & ON_PLANE) != 0];
    moving->tet[count] = t;
    count += (int32_t)cw_number((any & which) != 0);
  }
  pad_list(moving->tet, count);
  moving->count = count;
}

typedef void Add(const CwDelaunay *mesh, const int32_t *list, int32_t count, const CwFour *place, CwFour *sum);

// Moves such points at once towards the weighted mean of the places that their tetrahedra want them at, by `share` of
// the way.
static void move_all(CwTetWork *w, const Moving *moving, Add *add, float share, const uint8_t *moved, uint8_t which,
                     CwFour *sum) {
  memset(sum, 0, (size_t)w->mesh->point_count * sizeof *sum);
  add(w->mesh, moving->tet, moving->count, w->place, sum);
  for (int32_t p = 0; p < w->mesh->point_count; p++) {
    if (!(moved[p] & which) || !(sum[p][3] > 0.0f)) continue;
    w->place[p] += cw_four_if((CwFourMask){-1, -1, -1, 0}, share / sum[p][3] * sum[p]);
  }
}

// A point of t is to stay where it is. *whole: its tetrahedra are too many to be judged here.
static CwStatus put_back(CwTetWork *w, int32_t t, int32_t point, CwTetList *spoilt, int *whole) {
  CwStatus status = CW_OK;
  int32_t star[CW_TET_STAR + PAD];
  w->place[point] = place_of(w, cw_tet_at(w, point));
  int count = cw_tet_star(w, t, point, star);
  *whole |= count == 0;
  pad_list(star, count);
  CW_TRY(judge(w, star, count, spoilt));
done:
  return status;
}

// Judges the tetrahedra of all moved points. Where one is spoilt its points go back, and those of others that are
// spoilt by this.
static CwStatus take_back(CwTetWork *w, const Moving *moving, uint8_t *moved) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = w->mesh;
  CwTetList spoilt = {0};
  int whole;
  do {
    whole = 0;
    w->slender.count = 0;
    CW_TRY(judge(w, moving->tet, moving->count, &spoilt));
    while (spoilt.count) {
      int32_t t = spoilt.tet[--spoilt.count];
      for (int i = 0; i < 4 && is_spoilt(w, t); i++) {
        int32_t point = mesh->tet[t].corner[i];
        if (!(moved[point] & MOVED)) continue;
        moved[point] = RETURNED;
        w->count.points_moved--;
        CW_TRY(put_back(w, t, point, &spoilt, &whole));
      }
    }
  } while (whole);
done:
  free(spoilt.tet);
  return status;
}

// Moves such points down the gradient of their aspects by ever shorter steps, of which the first goes `share` of the
// way; returns the share that comes next.
static float even_edges(CwTetWork *w, const Moving *moving, int steps, float share, const uint8_t *moved, uint8_t which,
                        CwFour *sum) {
  for (int k = 0; k < steps; k++, share *= decay) move_all(w, moving, cw_tet_add_pulls, share, moved, which, sum);
  return share;
}

// Further steps of the points beside dividing planes alone: there triangles that both sides share hold tetrahedra more
// than elsewhere.
static void even_beside_planes(CwTetWork *w, Moving *moving, int steps, float share, uint8_t *moved, CwFour *sum) {
  CwDelaunay *mesh = w->mesh;
  int32_t count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) {
    const int32_t *c = mesh->tet[t].corner;
    if (c[0] < 0 || !((moved[c[0]] | moved[c[1]] | moved[c[2]] | moved[c[3]]) & ON_PLANE)) continue;
    for (int i = 0; i < 4; i++) {
      if (!(moved[c[i]] & MOVED)) continue;
      moved[c[i]] |= BESIDE;
      count++;
    }
  }
  if (count == 0) return;
  find_moving(mesh, moved, BESIDE, moving);
  even_edges(w, moving, steps, share, moved, BESIDE, sum);
  find_moving(mesh, moved, MOVED, moving); // as before
}

// Every inner point that is not in a lattice goes to the weighted mean of the centres round it (L. Chen and J. Xu,
// Optimal Delaunay triangulations, J. Comp. Math. 22, 2004), and from there by ever shorter steps to where its
// tetrahedra's edges are more even.
CwStatus cw_tet_relax(CwTetWork *w, CwTetMoves moves) {
  CwStatus status = CW_OK;
  CwDelaunay *mesh = w->mesh;
  CwFour *sum = NULL;
  uint8_t *moved = NULL;
  Moving moving = {0};
  CW_NEW_UNSET(sum, mesh->point_count);
  CW_NEW(moved, mesh->point_count);
  CW_NEW_UNSET(moving.tet, mesh->tet_count + PAD);
  CW_TRY(set_places(w));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    int32_t source = mesh->source[p], is_free = source >= w->fixed_count;
    moved[p] = is_free && w->irregular[p] ? MOVED : 0;
    if (!is_free && source >= 0 && w->on_plane && w->on_plane[source]) moved[p] = ON_PLANE;
    w->irregular[p] = 0;
    w->count.points_moved += moved[p] == MOVED;
  }
  find_moving(mesh, moved, MOVED, &moving);
  if (moves.centres) move_all(w, &moving, cw_tet_add_centres, 1.0f, moved, MOVED, sum);
  float share = even_edges(w, &moving, moves.evenings, (float)moves.pull, moved, MOVED, sum);
  if (moves.beside && w->on_plane) even_beside_planes(w, &moving, moves.beside, share, moved, sum);
  CW_TRY(take_back(w, &moving, moved));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    double goal[3];
    if (!(moved[p] & MOVED)) continue;
    find_goal(w, p, goal);
    memcpy(mesh->point[p].x, goal, sizeof goal);
  }
done:
  free(sum);
  free(moved);
  free(moving.tet);
  return status;
}
