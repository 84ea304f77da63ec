// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_relax.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/branchless.h"
#include "mesher/fill/tet_group.h"
#include "mesher/policy.h"

// Tetrahedra whose points move, with CW_TET_PAD more.
typedef struct {
  int32_t *tet, count;
} Moving;

// Lists the tetrahedra with a point that moves, of which all have room.
static void find_moving(CwTetMesh *mesh, const uint8_t *moved, Moving *moving) {
  int32_t count = 0;
  for (int32_t t = 0; t < mesh->tet_count; t++) { // without branches, which would be taken at random
    CwTet *tet = &mesh->tet[t];
    cw_tet_prefetch_ahead(tet);
    const int32_t *c = tet->corner, used = ~(c[0] >> 31);
    uint8_t any = moved[c[0] & used] | moved[c[1] & used] | moved[c[2] & used] | moved[c[3] & used];
    moving->tet[count] = t;
    count += (int32_t)cw_branchless((any & (uint8_t)used) != 0);
  }
  cw_tet_pad_list(moving->tet, count);
  moving->count = count;
}

typedef void Add(const CwTetMesh *mesh, const int32_t *list, int32_t count, const Cw4f *place, Cw4f *sum);

// Moves the points at once towards the weighted mean of the places that their tetrahedra want them at, by `share` of
// the distance.
static void move_all(CwTetWork *w, CwTetShapes *shapes, const Moving *moving, Add *add, float share,
                     const uint8_t *moved, Cw4f *sum) {
  memset(sum, 0, (size_t)w->mesh->point_count * sizeof *sum);
  add(w->mesh, moving->tet, moving->count, shapes->place, sum);
  for (int32_t p = 0; p < w->mesh->point_count; p++) {
    if (!moved[p] || !(sum[p][3] > 0.0f)) continue;
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
        if (!moved[point]) continue;
        moved[point] = 0;
        w->count.points_moved--;
        CW_TRY(put_back(w, shapes, t, point, &spoilt, &whole));
      }
    }
  } while (whole);
done:
  free(spoilt.tet);
  return status;
}

CwStatus cw_tet_relax(CwTetWork *w, CwTetShapes *shapes, int moves) {
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
    moved[p] = is_free && shapes->irregular[p];
    shapes->irregular[p] = 0;
    w->count.points_moved += moved[p];
  }
  find_moving(mesh, moved, &moving);
  if (moves & CW_TET_CENTRES) move_all(w, shapes, &moving, cw_tet_add_centres, 1.0f, moved, sum);
  const int steps = moves & CW_TET_EDGES ? cw_policy.even_steps : 0;
  for (int k = 0; k < steps; k++) {
    float share = (float)(cw_policy.even_pull * (steps - k) / steps);
    move_all(w, shapes, &moving, cw_tet_add_pulls, share, moved, sum);
  }
  CW_TRY(take_back(w, shapes, &moving, moved));
  for (int32_t p = 0; p < mesh->point_count; p++) {
    double goal[3];
    if (!moved[p]) continue;
    cw_tet_goal(w, shapes, p, goal);
    memcpy(mesh->point[p].x, goal, sizeof goal);
  }
done:
  free(sum);
  free(moved);
  free(moving.tet);
  return status;
}
