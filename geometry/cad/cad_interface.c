// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_interface.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/cad/contact_surface.h"
#include "pipeline/vec.h"

static const double SAME_AREA = 0.02;         // of the greater: sides of an interface, as triangulated and cut
static const double TURN = 2.399963229728653; // rad, the golden angle: no number of passages comes to itself by it
enum { TURNS = 3 };
// Of the greatest radius. Nodes near walls stand a thousandth of it apart, and may be 1 % of that off a cylinder
// (pipeline/mesh/cell.h).
static const double SAME_RADIUS = 1e-7;
static const double SAME_END = 1e-10;    // of the radius: a tenth of what the exporter allows (export/interface.c)
static const double SAME_OUTLINE = 2e-5; // of area, and of its root: twice the error of areas (survey.h)

// Whether the points of a face still lie on faces when they are turned about the axis.
static CwStatus stays_when_turned(const CwSurvey *survey, int face, double tolerance, int *stays) {
  CwStatus status = CW_OK;
  const CwSurveyFace *of = &survey->face[face];
  *stays = 1;
  for (int i = of->first_sample; i < of->first_sample + of->sample_count && *stays; i++)
    for (int k = 1; k <= TURNS && *stays; k++) {
      const double *x = survey->sample[i].at, c = cos(k * TURN), s = sin(k * TURN);
      const double turned[3] = {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
      double distance;
      int nearest;
      CW_TRY(cw_survey_nearest(survey, -1, turned, 2 * tolerance, &nearest, &distance, NULL));
      *stays = nearest >= 0 && distance <= tolerance;
    }
done:
  return status;
}

// Exact surfaces are told by their normals, splines only by their points.
static CwStatus check_turned(const CwCaseCad *cad, const CwSurvey *survey, int face, const CwContact *contact,
                             double tolerance) {
  CwStatus status = CW_OK;
  const CwSurveyFace *of = &survey->face[face];
  const CwCadDomain *own = &cad->domain[of->part], *other = &cad->domain[contact[face].part];
  int stays;
  if (of->turned || own->rotating == other->rotating) goto done;
  CW_TRY(stays_when_turned(survey, face, tolerance, &stays));
  CW_REQUIRE(
      stays, CW_ERR_GEOMETRY,
      "cad.axis: the interface between %s and %s is no surface of revolution about the axis (face %d of %s, at "
      "radius %.4g to %.4g mm) within cad.tolerance_mm, %.3g; allowed: cylinders, cones, planes across it and the "
      "like; does the axis run through the wheel?",
      own->name, other->name, face + 1, own->name, 1e3 * of->radius[0], 1e3 * of->radius[1], 1e3 * tolerance);
done:
  return status;
}

static int lies_in_plane(const CwSurvey *survey, const CwSurveyFace *face, const CwSurveyFace *plane, double within) {
  for (int t = face->first_triangle; t < face->first_triangle + face->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      double way[3];
      cw_sub(survey->point[survey->triangle[t][k]], plane->at, way);
      if (fabs(cw_dot(plane->normal, way)) > within) return 0;
    }
  return 1;
}

// One side of an interface.
typedef struct {
  const CwSurveyFace *first;
  int turned, revolved; // all of its faces
  double radius[2], height[2], moment[3];
} Side;

static Side side_of(const CwSurvey *survey, const CwFacePatches *patches, int patch) {
  Side side = {NULL, 1, 1, {INFINITY, 0}, {INFINITY, -INFINITY}, {0}};
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    if (patches->of_face[f] != patch) continue;
    if (!side.first) side.first = face;
    side.turned &= face->turned;
    side.revolved &= face->form == CW_FORM_REVOLVED;
    side.radius[0] = fmin(side.radius[0], face->radius[0]);
    side.radius[1] = fmax(side.radius[1], face->radius[1]);
    side.height[0] = fmin(side.height[0], face->height[0]);
    side.height[1] = fmax(side.height[1], face->height[1]);
    for (int k = 0; k < 3; k++) side.moment[k] += face->area * face->centre[k];
  }
  return side;
}

static int is_cylinder(const Side *side) {
  return side->revolved && side->radius[1] - side->radius[0] <= SAME_RADIUS * side->radius[1];
}

// Whether all faces of both sides lie in the plane of the first, and have the same outline.
static int is_plane(const CwSurvey *survey, const CwFacePatches *patches, const Side side[2],
                    const CwCadInterface *between) {
  const double size = sqrt(between->area[0]), reach = fmax(side[0].radius[1], side[1].radius[1]);
  double off[3];
  if (!between->flat || fabs(between->area[0] - between->area[1]) > SAME_OUTLINE * between->area[0]) return 0;
  for (int k = 0; k < 3; k++) off[k] = side[0].moment[k] / between->area[0] - side[1].moment[k] / between->area[1];
  if (cw_norm(off) > SAME_OUTLINE * size) return 0;
  if (side[0].turned && side[1].turned && fabs(side[0].radius[1] - side[1].radius[1]) > SAME_RADIUS * reach) return 0;
  for (int f = 0; f < survey->face_count; f++) {
    const int patch = patches->of_face[f];
    if ((patch == between->patch[0] || patch == between->patch[1]) &&
        !lies_in_plane(survey, &survey->face[f], side[0].first, SAME_RADIUS * size))
      return 0;
  }
  return 1;
}

// What both sides of an interface lie on. Flat eyes of a wheel that has two are no plane.
static void set_surface(const CwSurvey *survey, const CwFacePatches *patches, CwCadInterface *between) {
  Side side[2];
  between->flat = 1;
  for (int s = 0; s < 2; s++) {
    side[s] = side_of(survey, patches, between->patch[s]);
    for (int f = 0; f < survey->face_count; f++) {
      if (patches->of_face[f] != between->patch[s]) continue;
      between->area[s] += survey->face[f].area;
      between->flat &= survey->face[f].form == CW_FORM_PLANE;
    }
  }
  const double radius = fmax(side[0].radius[1], side[1].radius[1]), wider = fabs(side[0].radius[1] - side[1].radius[1]);
  const double ends = fmax(fabs(side[0].height[0] - side[1].height[0]), fabs(side[0].height[1] - side[1].height[1]));
  const int cylinders = is_cylinder(&side[0]) && is_cylinder(&side[1]);
  const int same = cylinders && wider <= SAME_RADIUS * radius && ends <= SAME_END * radius;
  const int across = between->flat && side[0].turned && side[1].turned; // planes across the axis
  between->surface = is_plane(survey, patches, side, between) ? CW_SURFACE_PLANE
                     : same                                   ? CW_SURFACE_CYLINDER
                                                              : CW_SURFACE_OTHER;
  between->radius = same ? radius : 0;
  const double off = between->surface == CW_SURFACE_OTHER && (cylinders || across) ? fmax(ends, wider) : 0;
  between->off = off > SAME_END * radius ? off : 0;
}

// `number`: of each face, of its surface.
static void count_surfaces(const CwSurvey *survey, const CwFacePatches *patches, const int *number,
                           CwCadInterface *between) {
  for (int f = 0; f < survey->face_count; f++) {
    int fresh = patches->of_face[f] == between->patch[0];
    for (int g = 0; g < f && fresh; g++) fresh = patches->of_face[g] != between->patch[0] || number[g] != number[f];
    between->surfaces += fresh;
  }
}

// By side 0.
static void set_width(const CwSurvey *survey, const CwFacePatches *patches, const int *number,
                      CwCadInterface *between) {
  int least = survey->face_count;
  double area = 0;
  for (int f = 0; f < survey->face_count; f++)
    if (patches->of_face[f] == between->patch[0] && number[f] >= 0 && number[f] < least) least = number[f];
  for (int f = 0; f < survey->face_count; f++) {
    if (patches->of_face[f] != between->patch[0] || number[f] != least) continue;
    between->reach = fmax(between->reach, survey->face[f].radius[1]);
    area += survey->face[f].area;
  }
  between->width = area / (2 * M_PI * between->reach);
}

int cw_cad_interface_beyond(const CwCadInterface *between, int patch) {
  return between->patch[0] == patch ? between->patch[1] : between->patch[1] == patch ? between->patch[0] : -1;
}

CwStatus cw_cad_interfaces_make(const CwCaseCad *cad, const CwSurvey *survey, const CwContact *contact,
                                const CwFacePatches *patches, double tolerance, int *count,
                                CwCadInterface **interfaces) {
  CwStatus status = CW_OK;
  CwCadInterface *made = NULL;
  int *number = NULL;
  *count = 0;
  CW_NEW(made, patches->count);
  CW_NEW(number, survey->face_count);
  CW_TRY(cw_contact_surfaces(cad, survey, contact, tolerance, number));
  for (int f = 0; f < survey->face_count; f++) {
    if (contact[f].part < 0) continue;
    const int own = patches->of_face[f], other = patches->of_face[contact[f].other];
    CW_TRY(check_turned(cad, survey, f, contact, tolerance));
    int i = 0;
    while (i < *count && cw_cad_interface_beyond(&made[i], own) < 0 && cw_cad_interface_beyond(&made[i], other) < 0)
      i++;
    if (i == *count) made[(*count)++] = (CwCadInterface){.patch = {own, other}};
    const int shared = cw_cad_interface_beyond(&made[i], own) < 0 ? other : own, third = shared == own ? other : own;
    CW_REQUIRE(cw_cad_interface_beyond(&made[i], shared) == third, CW_ERR_INPUT,
               "cad.patches: patch %s touches both %s and %s; allowed: one patch on either side of an interface, give "
               "them names in cad.patches with domain",
               patches->patch[shared].name, patches->patch[third].name,
               patches->patch[cw_cad_interface_beyond(&made[i], shared)].name);
  }
  for (int i = 0; i < *count; i++) {
    set_surface(survey, patches, &made[i]);
    set_width(survey, patches, number, &made[i]);
    count_surfaces(survey, patches, number, &made[i]);
    const double *area = made[i].area;
    CW_REQUIRE(
        fabs(area[0] - area[1]) <= SAME_AREA * fmax(area[0], area[1]), CW_ERR_GEOMETRY,
        "cad.domains: the interface has %.6g mm2 as %s and %.6g mm2 as %s; allowed: the same surface on both sides",
        1e6 * area[0], patches->patch[made[i].patch[0]].name, 1e6 * area[1], patches->patch[made[i].patch[1]].name);
  }
  *interfaces = made;
  made = NULL;
done:
  free(made);
  free(number);
  return status;
}
