// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_judge.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/common/box.h"
#include "mesher/common/branchless.h"
#include "mesher/fill/tet_group.h"
#include "mesher/policy.h"

static const double unsure = 1e-3;  // of a quality in single precision, by far
static const double blurred = 1e-4; // of the extent of all: edges for which single precision will not do
static const float regular = 0.8f;  // least quality of a lattice is 0.866: points stay where all is above; saves time
enum { BLOCK = 128 };               // tetrahedra that are looked for together
_Static_assert(CW_TET_PAD >= CW_TET_GROUP - 1, "a group reads behind its list");

void cw_tet_shapes_free(CwTetShapes *shapes) {
  free(shapes->slender.tet);
  free(shapes->place);
  free(shapes->irregular);
  memset(shapes, 0, sizeof *shapes);
}

double cw_tet_slender_square(void) {
  return cw_policy.usual_aspect * cw_policy.usual_aspect;
}

static inline Cw4f place_of(const CwTetShapes *shapes, const double x[3]) {
  return cw_4f_difference(shapes->middle, x);
}

CwStatus cw_tet_set_places(CwTetWork *w, CwTetShapes *shapes) {
  CwStatus status = CW_OK;
  const CwTetMesh *mesh = w->mesh;
  CwBox box = cw_box_empty();
  CW_GROW(shapes->place, shapes->place_capacity, mesh->point_count);
  for (int32_t p = 0; p < mesh->point_count; p++) {
    if (mesh->source[p] >= 0) cw_box_add_point(&box, mesh->point[p].x);
  }
  for (int i = 0; i < 3; i++) shapes->middle[i] = 0.5 * (box.low[i] + box.high[i]);
  double extent = cw_box_longest(&box);
  shapes->blurred = blurred * blurred * extent * extent;
  for (int32_t p = 0; p < mesh->point_count; p++) shapes->place[p] = place_of(shapes, mesh->point[p].x);
done:
  return status;
}

void cw_tet_pad_list(int32_t *list, int32_t count) {
  for (int k = 0; k < CW_TET_PAD && count; k++) list[count + k] = list[count - 1];
}

// From its place by what it has moved in single precision.
void cw_tet_goal(const CwTetWork *w, const CwTetShapes *shapes, int32_t p, double goal[3]) {
  const double *x = cw_tet_at(w, p);
  Cw4f moved = shapes->place[p] - place_of(shapes, x);
  for (int i = 0; i < 3; i++) goal[i] = x[i] + (double)moved[i];
}

static double quality_at_goals(const CwTetWork *w, const CwTetShapes *shapes, const int32_t corner[4]) {
  double x[4][3];
  for (int k = 0; k < 4; k++) cw_tet_goal(w, shapes, corner[k], x[k]);
  return cw_tet_quality(x[0], x[1], x[2], x[3]);
}

int cw_tet_is_spoilt(const CwTetWork *w, const CwTetShapes *shapes, int32_t t) {
  const CwTet *tet = &w->mesh->tet[t];
  const int32_t *c = tet->corner;
  return tet->quality < shapes->floor && tet->quality < cw_tet_quality_of(w, c[0], c[1], c[2], c[3]);
}

// Marks the points of tetrahedra that are irregular, and adds the slender ones to their list, without branches.
static inline void note_shapes(const CwTetMesh *mesh, CwTetShapes *shapes, const int32_t *list, int count,
                               const float *quality, const int32_t *slender) {
  for (int k = 0; k < count && shapes->irregular; k++) {
    const int32_t *c = mesh->tet[list[k]].corner;
    for (int i = 0; i < 4; i++) shapes->irregular[c[i]] |= (uint8_t)cw_branchless(quality[k] < regular);
  }
  for (int k = 0; k < count; k++) {
    shapes->slender.tet[shapes->slender.count] = list[k];
    shapes->slender.count -= slender[k];
  }
}

CwStatus cw_tet_judge(CwTetWork *w, CwTetShapes *shapes, const int32_t *list, int32_t count, CwTetList *spoilt) {
  CwStatus status = CW_OK;
  const float slender_square = (float)cw_tet_slender_square();
  CW_GROW(shapes->slender.tet, shapes->slender.capacity, shapes->slender.count + count + 1);
  for (int32_t from = 0; from < count; from += CW_TET_GROUP) {
    float quality[CW_TET_GROUP];
    int32_t slender[CW_TET_GROUP];
    int some = count - from < CW_TET_GROUP ? count - from : CW_TET_GROUP;
    cw_tet_group_qualities(w->mesh, list + from, shapes->place, (float)shapes->blurred, slender_square, quality,
                           slender);
    note_shapes(w->mesh, shapes, list + from, some, quality, slender);
    for (int k = 0; k < some; k++) {
      int32_t t = list[from + k];
      CwTet *tet = &w->mesh->tet[t];
      tet->quality = (double)quality[k];
      if (quality[k] > (float)(w->limit + unsure)) continue;
      tet->quality = quality_at_goals(w, shapes, tet->corner);
      if (tet->quality < w->limit) CW_TRY(cw_tet_push(w, t));
      if (!spoilt || !cw_tet_is_spoilt(w, shapes, t)) continue;
      CW_TRY(cw_tet_list_push(spoilt, t));
    }
  }
done:
  return status;
}

CwStatus cw_tet_judge_all(CwTetWork *w, CwTetShapes *shapes) {
  CwStatus status = CW_OK;
  int32_t list[BLOCK + CW_TET_PAD];
  CW_TRY(cw_tet_set_places(w, shapes));
  shapes->slender.count = 0;
  for (int32_t p = 0; p < w->mesh->point_count; p++) w->mesh->point[p].mark = 0;
  for (int32_t from = 0; from < w->mesh->tet_count; from += BLOCK) {
    int count = 0;
    for (int32_t t = from; t < from + BLOCK && t < w->mesh->tet_count; t++) {
      CwTet *tet = &w->mesh->tet[t];
      tet->star = 0;
      tet->pass = CW_TET_NO_PASS;
      list[count] = t; // without a branch
      count += (int)cw_branchless(tet->corner[0] >= 0);
    }
    cw_tet_pad_list(list, count);
    CW_TRY(cw_tet_judge(w, shapes, list, count, NULL));
  }
done:
  return status;
}
