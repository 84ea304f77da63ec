// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_wheel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double REACHES = 0.99; // of the wheel's radius: a blade that ends at its outlet
static const double LOOKS = 0.01;   // sine of the angle by which a side of a blade leaves the meridian

typedef struct {
  const CwCaseCad *cad;
  const CwSurvey *survey;
  const CwFacePatches *patches;
  int interface_count;
  const CwCadInterface *interfaces;
} Work;

int cw_cad_is_before(const CwFacePatches *patches, int part) {
  int before = 0;
  for (int i = 0; i < patches->count; i++) {
    if (patches->patch[i].part != part) continue;
    if (patches->patch[i].kind == CW_PATCH_INLET) before = 1;
    if (patches->patch[i].kind == CW_PATCH_OUTLET) return 0;
  }
  return before;
}

// Gives what both stand for the lesser of their numbers, where both have one. Returns 1 where they had two.
static int join(int *a, int *b) {
  if (*a < 0 || *b < 0 || *a == *b) return 0;
  *a = *b = *a < *b ? *a : *b;
  return 1;
}

int cw_cad_join_faces(const CwSurvey *survey, int *first) {
  int sets = 0;
  for (int changed = 1; changed;) {
    changed = 0;
    for (int e = 0; e < survey->edge_count; e++)
      changed |= join(&first[survey->edge[e].face[0]], &first[survey->edge[e].face[1]]);
  }
  for (int f = 0; f < survey->face_count; f++) sets += first[f] == f;
  return sets;
}

// Whether water enters what rotates through a patch: from outside, or from what comes before the wheel.
static int is_eye(const Work *work, int patch) {
  const CwFacePatch *of = &work->patches->patch[patch];
  if (!work->cad->domain[of->part].rotating) return 0;
  if (of->kind == CW_PATCH_INLET) return 1;
  for (int i = 0; i < work->interface_count; i++) {
    const int other = cw_cad_interface_beyond(&work->interfaces[i], patch);
    const int part = other < 0 ? -1 : work->patches->patch[other].part;
    if (part >= 0 && !work->cad->domain[part].rotating && cw_cad_is_before(work->patches, part)) return 1;
  }
  return 0;
}

// Whether a face is of a blade that rotates.
static int is_blade(const Work *work, int face) {
  return work->cad->domain[work->survey->face[face].part].rotating &&
         work->patches->patch[work->patches->of_face[face]].role == CW_ROLE_BLADE;
}

// A blade: its faces that hang together.
typedef struct {
  double radius, height[2], area;
  int sides; // 1: it has faces that look the way the wheel turns, 2: others that look back
} Blade;

static void add_to_blade(const CwSurveyFace *face, Blade *blade) {
  const int begun = blade->area > 0;
  blade->area += face->area;
  blade->radius = fmax(blade->radius, face->radius[1]);
  blade->height[0] = begun ? fmin(blade->height[0], face->height[0]) : face->height[0];
  blade->height[1] = begun ? fmax(blade->height[1], face->height[1]) : face->height[1];
  if (fabs(face->twist) > LOOKS) blade->sides |= face->twist > 0 ? 1 : 2;
}

// Blades side by side at the wheel's outlet, splitters among them: of one wheel alone a multiple of the passages. Not
// counted are those of a wheel's other half, whose middle lies beside the largest blade, and single sides, which no
// edge joins.
static CwStatus count_at_outlet(const Work *work, int passages, const CwCadWheels *wheels, int w) {
  CwStatus status = CW_OK;
  const CwSurvey *survey = work->survey;
  int *first = NULL, most = -1, *count = &wheels->wheel[w].blades;
  Blade *blade = NULL;
  CW_NEW(first, survey->face_count);
  CW_NEW(blade, survey->face_count);
  for (int f = 0; f < survey->face_count; f++)
    first[f] = is_blade(work, f) && wheels->of_part[survey->face[f].part] == w ? f : -1;
  cw_cad_join_faces(survey, first);
  for (int f = 0; f < survey->face_count; f++)
    if (first[f] >= 0) add_to_blade(&survey->face[f], &blade[first[f]]);
  *count = 0;
  for (int f = 0; f < survey->face_count; f++) {
    if (blade[f].sides != 3 || blade[f].radius < REACHES * wheels->wheel[w].radius) blade[f].area = 0;
    if (blade[f].area > (most < 0 ? 0 : blade[most].area)) most = f;
  }
  for (int f = 0; f < survey->face_count; f++) {
    const double middle = (blade[f].height[0] + blade[f].height[1]) / 2;
    *count += blade[f].area > 0 && middle > blade[most].height[0] && middle < blade[most].height[1];
  }
  if (*count == 0 || (wheels->count == 1 && *count % passages)) *count = passages;
done:
  free(first);
  free(blade);
  return status;
}

static void parts_of(const Work *work, int i, int part[2]) {
  for (int s = 0; s < 2; s++) part[s] = work->patches->patch[work->interfaces[i].patch[s]].part;
}

// [out] set: of each part that rotates the first of those that interfaces join it to; -1: it stands still.
static void join_parts(const Work *work, int *set) {
  for (int d = 0; d < work->cad->domain_count; d++) set[d] = work->cad->domain[d].rotating ? d : -1;
  for (int changed = 1; changed;) {
    changed = 0;
    for (int i = 0; i < work->interface_count; i++) {
      int part[2];
      parts_of(work, i, part);
      changed |= join(&set[part[0]], &set[part[1]]);
    }
  }
}

// Makes a wheel of each set that has blades; of all, where none has.
static CwStatus find_wheels(const Work *work, CwCadWheels *wheels) {
  CwStatus status = CW_OK;
  const int count = work->cad->domain_count;
  int *set = NULL, *bladed = NULL, all = 1;
  CW_NEW(set, count);
  CW_NEW(bladed, count);
  CW_NEW(wheels->wheel, count);
  CW_NEW(wheels->of_part, count);
  join_parts(work, set);
  for (int f = 0; f < work->survey->face_count; f++)
    if (is_blade(work, f)) bladed[set[work->survey->face[f].part]] = 1, all = 0;
  for (int d = 0; d < count; d++) {
    wheels->of_part[d] = -1;
    if (set[d] != d || !(all || bladed[d])) continue;
    wheels->wheel[wheels->count++] = (CwCadWheel){.part = d};
  }
  for (int d = 0; d < count; d++)
    for (int w = 0; w < wheels->count; w++)
      if (set[d] == wheels->wheel[w].part) wheels->of_part[d] = w;
done:
  free(set);
  free(bladed);
  return status;
}

static void measure_radii(const Work *work, CwCadWheels *wheels) {
  for (int w = 0; w < wheels->count; w++) {
    CwCadWheel *wheel = &wheels->wheel[w];
    double widest = 0;
    for (int f = 0; f < work->survey->face_count; f++) {
      const CwSurveyFace *face = &work->survey->face[f];
      if (wheels->of_part[face->part] != w) continue;
      widest = fmax(widest, face->radius[1]);
      if (is_blade(work, f)) wheel->radius = fmax(wheel->radius, face->radius[1]);
    }
    if (wheel->radius == 0) wheel->radius = widest;
    if (wheel->radius > wheels->wheel[wheels->largest].radius) wheels->largest = w;
    for (int i = 0; i < work->interface_count; i++) {
      int part[2];
      parts_of(work, i, part);
      const int own = wheels->of_part[part[0]] == w || wheels->of_part[part[1]] == w;
      if (!own || work->cad->domain[part[0]].rotating == work->cad->domain[part[1]].rotating ||
          work->interfaces[i].reach <= wheel->reach)
        continue;
      wheel->reach = work->interfaces[i].reach;
      wheel->width = work->interfaces[i].width;
    }
  }
}

static void count_openings(const Work *work, CwCadWheels *wheels) {
  for (int p = 0; p < work->patches->count; p++) {
    const CwFacePatch *patch = &work->patches->patch[p];
    const int w = wheels->of_part[patch->part];
    if (w >= 0) wheels->wheel[w].openings += patch->kind == CW_PATCH_INLET || patch->kind == CW_PATCH_OUTLET;
  }
  for (int i = 0; i < work->interface_count; i++) {
    int part[2];
    parts_of(work, i, part);
    const int a = wheels->of_part[part[0]], b = wheels->of_part[part[1]];
    if (a >= 0 && a != b) wheels->wheel[a].openings += work->interfaces[i].surfaces;
    if (b >= 0 && a != b) wheels->wheel[b].openings += work->interfaces[i].surfaces;
  }
}

static CwStatus measure_eyes(const Work *work, CwCadWheels *wheels) {
  CwStatus status = CW_OK;
  const CwSurvey *survey = work->survey;
  int *first = NULL;
  CW_NEW(first, survey->face_count);
  for (int f = 0; f < survey->face_count; f++) {
    const int w = wheels->of_part[survey->face[f].part];
    first[f] = w >= 0 && is_eye(work, work->patches->of_face[f]) ? f : -1;
    if (first[f] >= 0) wheels->wheel[w].eye_area += survey->face[f].area;
  }
  cw_cad_join_faces(survey, first);
  for (int f = 0; f < survey->face_count; f++)
    if (first[f] == f) wheels->wheel[wheels->of_part[survey->face[f].part]].eyes++;
done:
  free(first);
  return status;
}

// Whether interfaces lead from a wheel to an inlet and to an outlet by no other wheel.
static CwStatus stands_alone(const Work *work, const CwCadWheels *wheels, int w, int *alone) {
  CwStatus status = CW_OK;
  int *reached = NULL, inlet = 0, outlet = 0;
  CW_NEW(reached, work->cad->domain_count);
  for (int d = 0; d < work->cad->domain_count; d++) reached[d] = wheels->of_part[d] == w;
  for (int changed = 1; changed;) {
    changed = 0;
    for (int i = 0; i < work->interface_count; i++)
      for (int s = 0; s < 2; s++) {
        int part[2];
        parts_of(work, i, part);
        const int to = part[1 - s];
        if (!reached[part[s]] || reached[to] || wheels->of_part[to] >= 0) continue;
        reached[to] = changed = 1;
      }
  }
  for (int p = 0; p < work->patches->count; p++) {
    if (!reached[work->patches->patch[p].part]) continue;
    inlet |= work->patches->patch[p].kind == CW_PATCH_INLET;
    outlet |= work->patches->patch[p].kind == CW_PATCH_OUTLET;
  }
  *alone = inlet && outlet;
done:
  free(reached);
  return status;
}

static CwStatus share_point(const Work *work, CwCadWheels *wheels) {
  CwStatus status = CW_OK;
  int alone = 0;
  double squares = 0; // of the radii of stages in series
  for (int w = 0; w < wheels->count; w++) {
    int one;
    CW_TRY(stands_alone(work, wheels, w, &one));
    alone += one;
    wheels->wheel[w].head_share = one ? 0 : wheels->wheel[w].radius * wheels->wheel[w].radius;
    squares += wheels->wheel[w].head_share;
  }
  for (int w = 0; w < wheels->count; w++) {
    CwCadWheel *wheel = &wheels->wheel[w];
    const int parallel = wheel->head_share == 0;
    wheel->flow_share = parallel ? 1. / alone : 1;
    wheel->head_share = parallel ? 1 : wheel->head_share / squares;
  }
done:
  return status;
}

// What is no wheel has the wheel beside it.
static CwStatus set_neighbours(const Work *work, CwCadWheels *wheels) {
  CwStatus status = CW_OK;
  const int count = work->cad->domain_count;
  double *reach = NULL;
  int *beside = NULL;
  CW_NEW(reach, count);
  CW_NEW(beside, count);
  for (int d = 0; d < count; d++) beside[d] = wheels->of_part[d] < 0 ? wheels->largest : wheels->of_part[d];
  for (int i = 0; i < work->interface_count; i++)
    for (int s = 0; s < 2; s++) {
      int part[2];
      parts_of(work, i, part);
      const int w = wheels->of_part[part[s]], still = part[1 - s];
      if (w < 0 || work->cad->domain[still].rotating || work->interfaces[i].reach <= reach[still]) continue;
      reach[still] = work->interfaces[i].reach;
      beside[still] = w;
    }
  memcpy(wheels->of_part, beside, (size_t)count * sizeof *beside);
done:
  free(reach);
  free(beside);
  return status;
}

CwStatus cw_cad_wheels_make(const CwCaseCad *cad, const CwSurvey *survey, const CwFacePatches *patches,
                            int interface_count, const CwCadInterface *interfaces, int passages, CwCadWheels *wheels) {
  CwStatus status = CW_OK;
  const Work work = {cad, survey, patches, interface_count, interfaces};
  memset(wheels, 0, sizeof *wheels);
  CW_TRY(find_wheels(&work, wheels));
  measure_radii(&work, wheels);
  count_openings(&work, wheels);
  CW_TRY(measure_eyes(&work, wheels));
  for (int w = 0; w < wheels->count; w++) CW_TRY(count_at_outlet(&work, passages, wheels, w));
  CW_TRY(share_point(&work, wheels));
  CW_TRY(set_neighbours(&work, wheels));
done:
  return status;
}

void cw_cad_wheels_free(CwCadWheels *wheels) {
  free(wheels->wheel);
  free(wheels->of_part);
  memset(wheels, 0, sizeof *wheels);
}
