// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/proposal.h"

#include <math.h>
#include <stdlib.h>

#include "pipeline/vec.h"

static const double ALIKE = 1e-3;             // of area, radius and height: faces that are periodic images
static const double ACROSS = 10 * M_PI / 180; // rad off a right angle
static const double END = 1e-6;               // of the size: how far the part may reach past a plane at its end
// Of the hydraulic diameter: what is shorter behind a plane is no pipe. Side chambers of wheels have 0.03 to 0.06
// (J. F. Guelich, Centrifugal Pumps, section 9.1).
static const double STUB = 0.1;
static const double ONE_SIDED = 0.5; // of the area of a wheel's inlets: what more looks one way than the other
enum { BLADES_MOST = 64 };

// Whether all of the face's part lies on one side of its plane.
static int at_end(const CwSurvey *survey, int face) {
  const CwSurveyFace *of = &survey->face[face];
  const double level = cw_dot(of->normal, of->at);
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *other = &survey->face[f];
    if (other->part != of->part) continue;
    for (int t = other->first_triangle; t < other->first_triangle + other->triangle_count; t++)
      for (int k = 0; k < 3; k++)
        if (cw_dot(of->normal, survey->point[survey->triangle[t][k]]) > level + END * survey->size) return 0;
  }
  return 1;
}

// How far a face reaches behind a plane.
static double depth_behind(const CwSurvey *survey, const double normal[3], double level, int face) {
  const CwSurveyFace *of = &survey->face[face];
  double depth = 0;
  for (int t = of->first_triangle; t < of->first_triangle + of->triangle_count; t++)
    for (int k = 0; k < 3; k++) depth = fmax(depth, level - cw_dot(normal, survey->point[survey->triangle[t][k]]));
  return depth;
}

// Whether all neighbours stand across the face, convex as seen from outside, none of them is a contact, and the water
// behind it is more than a flat chamber.
static int is_opening(const CwSurvey *survey, const CwContact *contact, int face) {
  if (survey->face[face].form != CW_FORM_PLANE || contact[face].part >= 0 || !at_end(survey, face)) return 0;
  const CwSurveyFace *of = &survey->face[face];
  double outline = 0, depth = 0;
  for (int e = 0; e < survey->edge_count; e++) {
    const CwSurveyEdge *edge = &survey->edge[e];
    if (edge->face[0] != face && edge->face[1] != face) continue;
    const int other = edge->face[edge->face[0] == face];
    if (contact[other].part >= 0 || fabs(edge->angle - M_PI / 2) > ACROSS) return 0;
    outline += edge->length;
    depth = fmax(depth, depth_behind(survey, of->normal, cw_dot(of->normal, of->at), other));
  }
  return depth * outline >= STUB * 4 * of->area;
}

// Greatest radius of what rotates.
static double wheel_radius(const CwSurvey *survey, const int *rotating) {
  double radius = 0;
  for (int f = 0; f < survey->face_count; f++)
    if (rotating[survey->face[f].part]) radius = fmax(radius, survey->face[f].radius[1]);
  return radius;
}

// An opening about the axis is the inlet, and begins within the wheel; others are where the water leaves. A ring that
// goes round the wheel is a side wall.
static CwFaceRole opening_role(const CwSurveyFace *face, int rotating, double wheel) {
  const double off = hypot(face->centre[0], face->centre[1]);
  const int about = face->turned && off < 0.01 * face->radius[1];
  if (!rotating && about && face->radius[0] >= wheel) return CW_ROLE_WALL;
  return rotating || about ? CW_ROLE_INLET : CW_ROLE_OUTLET;
}

static int are_alike(const CwSurveyFace *a, const CwSurveyFace *b, double size) {
  if (a->part != b->part || fabs(a->area - b->area) > ALIKE * a->area) return 0;
  for (int i = 0; i < 2; i++) {
    if (fabs(a->radius[i] - b->radius[i]) > ALIKE * size) return 0;
    if (fabs(a->height[i] - b->height[i]) > ALIKE * size) return 0;
  }
  return fabs(a->twist - b->twist) < ALIKE + 0.01 * fabs(a->twist);
}

// How many faces are like this one, a z-th of a turn apart: z, or 0.
static int fold_of(const CwSurvey *survey, int face) {
  const CwSurveyFace *of = &survey->face[face];
  int alike[BLADES_MOST], count = 0;
  for (int f = 0; f < survey->face_count; f++) {
    if (!are_alike(of, &survey->face[f], survey->size)) continue;
    if (count == BLADES_MOST) return 0;
    alike[count++] = f;
  }
  // Several faces of a blade may be alike: z is the greatest divisor of their number that turns this one to another.
  for (int z = count; z >= 2; z--) {
    if (count % z) continue;
    int fine = 1;
    for (int k = 1; k < z && fine; k++) {
      const double c = cos(2 * M_PI * k / z), s = sin(2 * M_PI * k / z);
      const double turned[2] = {c * of->centre[0] - s * of->centre[1], s * of->centre[0] + c * of->centre[1]};
      fine = 0;
      for (int i = 0; i < count; i++) {
        const double *at = survey->face[alike[i]].centre;
        fine |= hypot(at[0] - turned[0], at[1] - turned[1]) < ALIKE * survey->size;
      }
    }
    if (fine) return z;
  }
  return 0;
}

// From which side along the axis the water comes to what rotates: -1 or +1 for all of it; 0: from both, to its halves
// below and above `middle`.
typedef struct {
  double side, middle;
} Suction;

// By the inlets of the part; where it has none by its flat interfaces, else by the end that lies farther off.
static Suction suction_of(const CwSurvey *survey, const CwFaceRole *role, int part) {
  double sum[2] = {0}, area[2] = {0}; // of inlets, of flat interfaces
  double low = INFINITY, high = -INFINITY, width = 0, moment = 0;
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    const int flat = role[f] == CW_ROLE_CONTACT && face->form == CW_FORM_PLANE;
    if (face->part != part) continue;
    low = fmin(low, face->height[0]);
    high = fmax(high, face->height[1]);
    if (role[f] == CW_ROLE_INLET || flat) {
      sum[flat] += face->area * face->normal[2];
      area[flat] += face->area;
    } else if (role[f] == CW_ROLE_CONTACT) { // the wheel's outlet
      width += face->area;
      moment += face->area * face->centre[2];
    }
  }
  Suction suction = {0, width > 0 ? moment / width : (low + high) / 2};
  const int by = area[0] == 0;
  if (area[by] == 0)
    suction.side = fabs(low) >= fabs(high) - ALIKE * (high - low) ? -1 : 1;
  else if (fabs(sum[by]) > ONE_SIDED * area[by])
    suction.side = sum[by] < 0 ? -1 : 1;
  return suction;
}

// The hub has the water outside of it or before it, the shroud inside or behind. What is neither, such as a plane in
// the middle of two eyes, counts as hub.
static CwFaceRole wheel_role(const CwSurvey *survey, const CwSurveyFace *face, const Suction *suction) {
  double outward = 0, all = 0;
  for (int t = face->first_triangle; t < face->first_triangle + face->triangle_count; t++) {
    const double *a = survey->point[survey->triangle[t][0]], *b = survey->point[survey->triangle[t][1]],
                 *c = survey->point[survey->triangle[t][2]];
    double n[3];
    cw_normal(a, b, c, n);
    const double x = a[0] + b[0] + c[0], y = a[1] + b[1] + c[1], r = hypot(x, y);
    const double above = (a[2] + b[2] + c[2]) / 3 - suction->middle;
    const double half = fabs(above) <= END * survey->size ? 0 : above < 0 ? -1 : 1;
    outward += (r > 0 ? (n[0] * x + n[1] * y) / r : 0) + (suction->side != 0 ? suction->side : half) * n[2];
    all += cw_norm(n);
  }
  return outward > END * all ? CW_ROLE_SHROUD : CW_ROLE_HUB;
}

// Round walls beside an opening, all along it.
static int is_pipe(const CwSurvey *survey, const CwFaceRole *role, int face) {
  for (int e = 0; e < survey->edge_count; e++) {
    const CwSurveyEdge *edge = &survey->edge[e];
    if (edge->face[0] != face && edge->face[1] != face) continue;
    const CwFaceRole other = role[edge->face[edge->face[0] == face]];
    if (other == CW_ROLE_INLET || other == CW_ROLE_OUTLET) return 1;
  }
  return 0;
}

// A cut-off trailing edge: a cylinder about the axis with the water outside, most of whose outline borders blades.
static int is_trailing_edge(const CwSurvey *survey, const CwFaceRole *role, int face) {
  const CwSurveyFace *of = &survey->face[face];
  double outline = 0, blades = 0;
  if (of->form != CW_FORM_REVOLVED || of->radius[1] - of->radius[0] > ALIKE * of->radius[1] ||
      role[face] != CW_ROLE_HUB)
    return 0;
  for (int e = 0; e < survey->edge_count; e++) {
    const CwSurveyEdge *edge = &survey->edge[e];
    if (edge->face[0] != face && edge->face[1] != face) continue;
    outline += edge->length;
    if (role[edge->face[edge->face[0] == face]] == CW_ROLE_BLADE) blades += edge->length;
  }
  return 2 * blades > outline;
}

static int count_blades(const CwSurvey *survey, const CwFaceRole *role, const int *fold) {
  double area[BLADES_MOST + 1] = {0};
  int best = 1;
  for (int f = 0; f < survey->face_count; f++)
    if (role[f] == CW_ROLE_BLADE) area[fold[f]] += survey->face[f].area;
  for (int z = 2; z <= BLADES_MOST; z++)
    if (area[z] > area[best]) best = z;
  return best;
}

CwStatus cw_proposal_make(const CwSurvey *survey, const CwContact *contact, const int *rotating, CwFaceRole *role,
                          int *blade_count) {
  CwStatus status = CW_OK;
  int *fold = NULL;
  const double wheel = wheel_radius(survey, rotating);
  CW_NEW(fold, survey->face_count);
  for (int f = 0; f < survey->face_count; f++) {
    role[f] = contact[f].part >= 0 ? CW_ROLE_CONTACT : CW_ROLE_WALL;
    if (is_opening(survey, contact, f)) role[f] = opening_role(&survey->face[f], rotating[survey->face[f].part], wheel);
  }
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    if (role[f] != CW_ROLE_WALL) continue;
    if (!rotating[face->part]) {
      if (is_pipe(survey, role, f)) role[f] = CW_ROLE_PIPE;
    } else if (face->turned) {
      const Suction suction = suction_of(survey, role, face->part);
      role[f] = wheel_role(survey, face, &suction);
    } else if ((fold[f] = fold_of(survey, f)) > 1) {
      role[f] = CW_ROLE_BLADE;
    }
  }
  for (int f = 0; f < survey->face_count; f++)
    if (is_trailing_edge(survey, role, f)) role[f] = CW_ROLE_BLADE;
  *blade_count = count_blades(survey, role, fold);
done:
  free(fold);
  return status;
}
