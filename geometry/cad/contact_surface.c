// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/contact_surface.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double SMOOTH = M_PI / 180; // rad off pi: an edge inside a surface
static const double SAME = 0.5;          // of the smaller extent in r and in z: what faces of one surface share

typedef struct {
  const CwCaseCad *cad;
  const CwSurvey *survey;
  const CwContact *contact;
  double tolerance;
} Work;

// Whether two faces lie between the same two parts, on either side.
static int same_parts(const Work *work, int f, int g) {
  const int a = work->survey->face[f].part, b = work->contact[f].part, c = work->survey->face[g].part,
            d = work->contact[g].part;
  return b >= 0 && d >= 0 && ((a == c && b == d) || (a == d && b == c));
}

// Whether the surface between the parts of a face goes round the axis, as it does where one of them rotates.
static int goes_round(const Work *work, int f) {
  const CwCaseCad *cad = work->cad;
  return work->survey->face[f].turned ||
         cad->domain[work->survey->face[f].part].rotating != cad->domain[work->contact[f].part].rotating;
}

// Whether faces that go round the axis lie over one another in the meridian: pieces between blades.
static int same_meridian(const Work *work, int f, int g) {
  const CwSurveyFace *a = &work->survey->face[f], *b = &work->survey->face[g];
  const double *of[2][2] = {{a->radius, b->radius}, {a->height, b->height}};
  double sum = 0;
  if (!goes_round(work, f) || !goes_round(work, g)) return 0;
  for (int k = 0; k < 2; k++) {
    const double *p = of[k][0], *q = of[k][1], shared = fmin(p[1], q[1]) - fmax(p[0], q[0]);
    if (shared < SAME * fmin(p[1] - p[0], q[1] - q[0]) - work->tolerance) return 0;
    sum += shared;
  }
  return sum > work->tolerance;
}

// Joins the sets of two faces under the lesser number. Returns 1 where they were two.
static int join(const Work *work, int *set, int f, int g) {
  const int least = set[f] < set[g] ? set[f] : set[g], other = set[f] < set[g] ? set[g] : set[f];
  for (int i = 0; i < work->survey->face_count && least != other; i++)
    if (set[i] == other) set[i] = least;
  return least != other;
}

// [out] set: of each face the least face of its surface; -1: it touches none.
static void join_faces(const Work *work, int *set) {
  const CwSurvey *survey = work->survey;
  for (int f = 0; f < survey->face_count; f++) set[f] = work->contact[f].part >= 0 ? f : -1;
  for (int e = 0; e < survey->edge_count; e++) {
    const CwSurveyEdge *edge = &survey->edge[e];
    if (same_parts(work, edge->face[0], edge->face[1]) && fabs(edge->angle - M_PI) < SMOOTH)
      join(work, set, edge->face[0], edge->face[1]);
  }
  for (int f = 0; f < survey->face_count; f++) {
    const int other = work->contact[f].other;
    if (set[f] >= 0 && other >= 0 && same_parts(work, f, other)) join(work, set, f, other);
    for (int g = 0; g < f && set[f] >= 0; g++)
      if (same_parts(work, f, g) && same_meridian(work, f, g)) join(work, set, f, g);
  }
}

// Farthest from the axis first, then from the lowest z.
static int comes_before(const Work *work, const double reach[], const double low[], int a, int b) {
  if (fabs(reach[a] - reach[b]) > work->tolerance) return reach[a] > reach[b];
  if (fabs(low[a] - low[b]) > work->tolerance) return low[a] < low[b];
  return a < b;
}

CwStatus cw_contact_surfaces(const CwCaseCad *cad, const CwSurvey *survey, const CwContact *contact, double tolerance,
                             int *number) {
  CwStatus status = CW_OK;
  const Work work = {cad, survey, contact, tolerance};
  int *set = NULL;
  double *reach = NULL, *low = NULL; // of each set
  CW_NEW(set, survey->face_count);
  CW_NEW(reach, survey->face_count);
  CW_NEW(low, survey->face_count);
  join_faces(&work, set);
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    if (set[f] < 0) continue;
    reach[set[f]] = fmax(reach[set[f]], face->radius[1]);
    low[set[f]] = set[f] == f ? face->height[0] : fmin(low[set[f]], face->height[0]);
  }
  for (int f = 0; f < survey->face_count; f++) {
    number[f] = set[f] < 0 ? -1 : 0;
    for (int s = 0; s < survey->face_count && set[f] >= 0; s++)
      number[f] += set[s] == s && same_parts(&work, f, s) && comes_before(&work, reach, low, s, set[f]);
  }
done:
  free(set);
  free(reach);
  free(low);
  return status;
}

// Gives surfaces that one named patch holds the least number of them.
static void tie(const Work *work, const CwFacePatches *patches, int *number) {
  const int count = work->survey->face_count;
  for (int changed = 1; changed;) {
    changed = 0;
    for (int f = 0; f < count; f++)
      for (int g = 0; g < count; g++) {
        const int patch = patches->of_face[f];
        if (number[g] <= number[f] || patch != patches->of_face[g] || !same_parts(work, f, g) ||
            patches->patch[patch].source == CW_FROM_PROPOSAL)
          continue;
        const int from = number[g];
        for (int i = 0; i < count; i++)
          if (number[i] == from && same_parts(work, f, i)) number[i] = number[f];
        changed = 1;
      }
  }
}

static int has_name(const CwFacePatches *patches, const char *name) {
  for (int i = 0; i < patches->count; i++)
    if (!strcmp(patches->patch[i].name, name)) return 1;
  return 0;
}

// Puts the faces of a patch that have a number into a patch of their own.
static CwStatus part_off(const CwSurvey *survey, int from, int number, const int *numbers, CwFacePatches *patches) {
  CwStatus status = CW_OK;
  CwFacePatch *grown = realloc(patches->patch, (size_t)(patches->count + 1) * sizeof *grown);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d patches", patches->count + 1);
  patches->patch = grown;
  CwFacePatch made = grown[from];
  for (int suffix = number + 1; has_name(patches, made.name); suffix++)
    snprintf(made.name, sizeof made.name, "%.*s_%d", CW_PATCH_NAME_MOST - 3, grown[from].name, suffix);
  int at = from + 1;
  while (at < patches->count && grown[at].part == made.part) at++;
  memmove(&grown[at + 1], &grown[at], (size_t)(patches->count - at) * sizeof *grown);
  patches->count++;
  made.area = 0;
  for (int f = 0; f < survey->face_count; f++) {
    if (patches->of_face[f] >= at) patches->of_face[f]++;
    if (patches->of_face[f] != from || numbers[f] != number) continue;
    patches->of_face[f] = at;
    made.area += survey->face[f].area;
  }
  grown[at] = made;
  grown[from].area -= made.area;
done:
  return status;
}

CwStatus cw_contact_patches_part(const CwCaseCad *cad, const CwSurvey *survey, const CwContact *contact,
                                 double tolerance, CwFacePatches *patches) {
  CwStatus status = CW_OK;
  const Work work = {cad, survey, contact, tolerance};
  int *number = NULL;
  CW_NEW(number, survey->face_count);
  CW_TRY(cw_contact_surfaces(cad, survey, contact, tolerance, number));
  tie(&work, patches, number);
  for (int p = 0; p < patches->count; p++) {
    int least = survey->face_count;
    if (patches->patch[p].source != CW_FROM_PROPOSAL || patches->patch[p].kind != CW_PATCH_INTERFACE) continue;
    for (int f = 0; f < survey->face_count; f++)
      if (patches->of_face[f] == p && number[f] < least) least = number[f];
    for (int next = least + 1; next < survey->face_count; next++) {
      int holds = 0;
      for (int f = 0; f < survey->face_count; f++) holds |= patches->of_face[f] == p && number[f] == next;
      if (holds) CW_TRY(part_off(survey, p, next, number, patches));
    }
  }
done:
  free(number);
  return status;
}
