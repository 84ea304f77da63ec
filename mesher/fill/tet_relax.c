// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_relax.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/branchless.h"
#include "mesher/fill/tet_group.h"
#include "mesher/policy.h"

enum { MOVED = 1, RETURNED = 2 };  // a point that is free to move
enum { ON_PLANE = 4, BESIDE = 8 }; // a fixed point on a partition plane; a free one of its tetrahedra

// Tetrahedra whose points move, with CW_TET_PAD more.
typedef struct {
  int32_t *tet, count;
} Moving;

// Lists the tetrahedra with such a point, of which all have room, and weighs them.
static void find_moving(CwTetMesh *mesh, const uint8_t *moved, uint8_t which, Moving *moving) {
  const uint32_t weight[2] = {1, (uint32_t)cw_policy.interface_weight};
  int32_t count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) { // without branches, which would be taken at random
    CwTet *tet = &mesh->tet[t];
    cw_tet_prefetch_ahead(tet);
    const int32_t *c = tet->corner, used = ~(c[0] >> 31);
    uint8_t any = moved[c[0] & used] | moved[c[1] & used] | moved[c[2] & used] | moved[c[3] & used];
    any &= (uint8_t)used;
    tet->weight = weight[(any & ON_PLANE) != 0];
    moving->tet[count] = t;
    count += (int32_t)cw_branchless((any & which) != 0);
  }
  cw_tet_pad_list(moving->tet, count);
  moving->count = count;
}

typedef void Add(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, Cw4f *sum);

// Moves such points at once towards the weighted mean of the places that their tetrahedra want them at, by `share` of
// the distance.
static void move_all(CwTetWork *w, CwTetShapes *shapes, const Moving *moving, Add *add, float share,
                     const uint8_t *moved, uint8_t which, Cw4f *sum) {
  memset(sum, 0, (size_t)w->mesh->point_count * sizeof *sum);
  add(w->mesh, moving->tet, moving->count, shapes->place, sum);
  for (int32_t p = 0; p < w->mesh->point_count; p++) {
    if (!(moved[p] & which) || !(sum[p][3] > 0.0f)) continue;
    shapes->place[p] += cw_4f_if((Cw4fMask){-1, -1, -1, 0}, share / sum[p][3] * sum[p]);
  }
}

// A point of t is to stay where it is. *whole: its tetrahedra are too many to be judged here.
static CwStatus put_back(CwTetWork *w, CwTetShapes *shapes, int32_t t, int32_t point, CwTetList *spoilt, int *whole) {
  CwStatus status = CW_OK;
  int32_t star[CW_STAR + CW_TET_PAD];
  shapes->place[point] = cw_4f_difference(shapes->middle, cw_tet_at(w, point));
  int count = cw_tet_star(w->mesh, t, point, CW_STAR, star);
  *whole |= count == 0;
  cw_tet_pad_list(star, count);
  CW_TRY(cw_tet_judge(w, shapes, star, count, spoilt));
done:
  return status;
}

// Judges the tetrahedra of all moved points. Where one is spoilt its points go back, and those of others that are
// spoilt by this.
static CwStatus take_back(CwTetWork *w, CwTetShapes *shapes, const Moving *moving, uint8_t *moved) {
  CwStatus status = CW_OK;
  CwTetMesh *mesh = w->mesh;
  CwTetList spoilt = {0};
  int whole;
  do {
    whole = 0;
    shapes->slender.count = 0;
    CW_TRY(cw_tet_judge(w, shapes, moving->tet, moving->count, &spoilt));
    while (spoilt.count) {
      int32_t t = spoilt.tet[--spoilt.count];
      for (int i = 0; i < 4 && cw_tet_is_spoilt(w, shapes, t); i++) {
        int32_t point = mesh->tet[t].corner[i];
        if (!(moved[point] & MOVED)) continue;
        moved[point] = RETURNED;
        w->count.points_moved--;
        CW_TRY(put_back(w, shapes, t, point, &spoilt, &whole));
      }
    }
  } while (whole);
done:
  free(spoilt.tet);
  return status;
}

// Moves such points down the gradient of their aspects by ever shorter steps, of which the first goes `share` of the
// distance; returns the share that comes next.
static float even_edges(CwTetWork *w, CwTetShapes *shapes, const Moving *moving, int steps, float share,
                        const uint8_t *moved, uint8_t which, Cw4f *sum) {
  for (int k = 0; k < steps; k++, share *= (float)cw_policy.pull_decay)
    move_all(w, shapes, moving, cw_tet_add_pulls, share, moved, which, sum);
  return share;
}

// Further steps of the points beside partition planes alone: there triangles that both sides share hold tetrahedra more
// than elsewhere.
static void even_beside_planes(CwTetWork *w, CwTetShapes *shapes, Moving *moving, int steps, float share,
                               uint8_t *moved, Cw4f *sum) {
  CwTetMesh *mesh = w->mesh;
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
  even_edges(w, shapes, moving, steps, share, moved, BESIDE, sum);
  find_moving(mesh, moved, MOVED, moving); // as before
}

// Every inner point that is not in a lattice goes to the weighted mean of the centres round it (L. Chen and J. Xu,
// Optimal Delaunay triangulations, J. Comp. Math. 22, 2004), and from there by ever shorter steps to where its
// tetrahedra's edges are more even.
CwStatus cw_tet_relax(CwTetWork *w, CwTetShapes *shapes, CwTetMoves moves) {
  CwStatus status = CW_OK;
  CwTetMesh *mesh = w->mesh;
  Cw4f *sum = NULL;
  uint8_t *moved = NULL;
  Moving moving = {0};
  CW_NEW_UNSET(sum, mesh->point_count);
  CW_NEW(moved, mesh->point_count);
  CW_NEW_UNSET(moving.tet, mesh->tet_count + CW_TET_PAD);
  CW_TRY(cw_tet_set_places(w, shapes));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    int32_t source = mesh->source[p], is_free = source >= w->fixed_count;
    moved[p] = is_free && shapes->irregular[p] ? MOVED : 0;
    if (!is_free && source >= 0 && shapes->on_plane && shapes->on_plane[source]) moved[p] = ON_PLANE;
    shapes->irregular[p] = 0;
    w->count.points_moved += moved[p] == MOVED;
  }
  find_moving(mesh, moved, MOVED, &moving);
  if (moves.centres) move_all(w, shapes, &moving, cw_tet_add_centres, 1.0f, moved, MOVED, sum);
  float share = even_edges(w, shapes, &moving, moves.evenings, (float)moves.pull, moved, MOVED, sum);
  if (moves.beside && shapes->on_plane) even_beside_planes(w, shapes, &moving, moves.beside, share, moved, sum);
  CW_TRY(take_back(w, shapes, &moving, moved));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    double goal[3];
    if (!(moved[p] & MOVED)) continue;
    cw_tet_goal(w, shapes, p, goal);
    memcpy(mesh->point[p].x, goal, sizeof goal);
  }
done:
  free(sum);
  free(moved);
  free(moving.tet);
  return status;
}
