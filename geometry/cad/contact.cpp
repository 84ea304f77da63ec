// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/contact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <BRep_Builder.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>

#include "geometry/cad/cad_part.hpp"
#include "pipeline/vec.h"

namespace {

const double NEAR = 0.2; // of the model unit, of which the wheel has 128 to 256: a gap up to it is meant to be none
const double MOST = 0.5; // of a face's points: it can be one part alone that so many touch
const double EDGES = 2;  // tolerances that edges may be apart where each of their faces is off by one: 1 / sin(30 deg)
const double FACING = -0.7; // cosine of the normals of faces that face one another, by their triangles

double squared_distance(const double a[3], const double b[3]) {
  double d[3];
  cw_sub(a, b, d);
  return cw_dot(d, d);
}

void normal_of(const CwSurvey &survey, int triangle, double n[3]) {
  const int *corner = survey.triangle[triangle];
  cw_normal(survey.point[corner[0]], survey.point[corner[1]], survey.point[corner[2]], n);
  cw_unit(n);
}

struct Seen {
  int touching = 0, near = 0, looked = 0;
  std::map<int, int> others; // touching points by the face that they touch
  double gap = 0;
  const double *at = nullptr;
};

// Looks from a point at one other part.
CwStatus look_from(const CwSurvey &survey, const CwSurveySample &from, int part, double tolerance, double near,
                   Seen &seen) {
  double distance;
  int other;
  const double *at = from.at;
  const CwStatus status = cw_survey_nearest(&survey, part, at, near, &other, &distance, nullptr);
  if (status != CW_OK) return status;
  seen.looked++;
  if (other < 0 || !cw_contact_faces(&survey, &from, other)) return CW_OK;
  if (distance <= tolerance) {
    seen.touching++;
    seen.others[other]++;
  } else {
    seen.near++;
    if (distance > seen.gap) seen.gap = distance, seen.at = at;
  }
  return CW_OK;
}

CwStatus look(const CwSurvey &survey, int face, int part, double tolerance, double near, Seen &seen) {
  CwStatus status = CW_OK;
  const CwSurveyFace &of = survey.face[face];
  for (int i = of.first_sample; i < of.first_sample + of.sample_count; i++)
    CW_TRY(look_from(survey, survey.sample[i], part, tolerance, near, seen));
done:
  return status;
}

// A face that is much larger than the one before it may touch it between the points that were looked from.
void touch_back(const CwSurvey &survey, CwContact *contact) {
  for (int f = 0; f < survey.face_count; f++) {
    if (contact[f].part < 0 || contact[f].share < 1) continue;
    CwContact &other = contact[contact[f].other];
    if (other.part < 0) other = {survey.face[f].part, 0, f, 0, {}};
  }
}

// Of the faces that a face touches the one that has most of its points, first among those that touch its part too:
// points near its outline may touch a face beside.
int most_touched(const CwSurvey &survey, const CwContact *contact, int face, const std::map<int, int> &others) {
  std::pair<bool, int> most;
  int best = -1;
  for (const auto &[other, points] : others) {
    const std::pair<bool, int> weight(contact[other].part == survey.face[face].part, points);
    if (weight > most) most = weight, best = other;
  }
  return best;
}

std::string place_of(const double at[3], const CwCadFrame &frame) {
  return cw_cad_place(gp_Pnt(at[0], at[1], at[2]), 1, frame);
}

TopoDS_Shape unified(const std::vector<TopoDS_Shape> &faces) {
  BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  for (const TopoDS_Shape &face : faces) builder.Add(shell, face);
  ShapeUpgrade_UnifySameDomain unify(shell, Standard_True, Standard_True, Standard_False);
  unify.Build();
  return unify.Shape().IsNull() ? TopoDS_Shape(shell) : unify.Shape();
}

// Cuts the faces of a part along the outlines of `tools`.
CwStatus cut_part(const std::vector<TopoDS_Shape> &tools, double tolerance, CwCadPart &part) {
  TopTools_ListOfShape with;
  with.Append(unified(tools));
  const std::vector<TopoDS_Shape> solids = cw_cad_split(part.solid, with, tolerance);
  if (solids.size() != 1)
    return CW_FAIL(CW_ERR_GEOMETRY,
                   "cad.domains.%s: the outline of its neighbour's faces cannot be cut into its own; "
                   "allowed: domains that touch along whole faces",
                   part.domain.c_str());
  cw_cad_replace(solids[0], part);
  return CW_OK;
}

} // namespace

int cw_contact_faces(const CwSurvey *of, const CwSurveySample *sample, int other) {
  const CwSurvey &survey = *of;
  const double *at = sample->at;
  const CwSurveyFace &face = survey.face[other];
  int nearest = face.first_triangle;
  double best = INFINITY, n[3], m[3];
  for (int t = face.first_triangle; t < face.first_triangle + face.triangle_count; t++) {
    double least = INFINITY;
    for (int k = 0; k < 3; k++) least = std::min(least, squared_distance(survey.point[survey.triangle[t][k]], at));
    if (least < best) best = least, nearest = t;
  }
  normal_of(survey, sample->triangle, n);
  normal_of(survey, nearest, m);
  return cw_dot(n, m) < FACING;
}

CwStatus cw_contact_find(const CwCadParts *parts, const CwSurvey *survey, const CwCadFrame *frame, const CwCaseCad *cad,
                         double tolerance, CwContact *contact) {
  std::vector<std::map<int, int>> others(survey->face_count);
  const double near = std::max(NEAR * parts->unit, 2 * tolerance);
  for (int f = 0; f < survey->face_count; f++) {
    contact[f] = {-1, 0, -1, 0, {}};
    for (int p = 0; p < (int)parts->part.size(); p++) {
      const int own = survey->face[f].part;
      if (p == own) continue;
      Seen seen;
      const CwStatus status = look(*survey, f, p, tolerance, near, seen);
      if (status != CW_OK) return status;
      if (!seen.touching && seen.near == seen.looked && seen.at)
        return CW_FAIL(CW_ERR_GEOMETRY,
                       "cad.domains: between %s and %s is a gap or an overlap of %.4g mm, %s; "
                       "allowed: at the most cad.tolerance_mm, %.3g; draw the interface once and use it for both; or "
                       "metal thicker than %.3g mm",
                       cad->domain[own].name, cad->domain[p].name, 1e3 * seen.gap, place_of(seen.at, *frame).c_str(),
                       1e3 * tolerance, 1e3 * near);
      if (!seen.touching) continue;
      const double share = (double)seen.touching / seen.looked;
      if (std::min(contact[f].share, share) > MOST)
        return CW_FAIL(CW_ERR_GEOMETRY,
                       "cad.domains: a face of %s touches both %s and %s, %s; allowed: one neighbour at any "
                       "place, domains must not overlap",
                       cad->domain[own].name, cad->domain[contact[f].part].name, cad->domain[p].name,
                       place_of(survey->face[f].at, *frame).c_str());
      if (share <= contact[f].share) continue; // points near the outline may touch a part beside
      contact[f] = {p, share, -1, seen.gap, {}};
      if (seen.at) std::copy_n(seen.at, 3, contact[f].at);
      others[f] = seen.others;
    }
  }
  for (int f = 0; f < survey->face_count; f++)
    if (contact[f].part >= 0) contact[f].other = most_touched(*survey, contact, f, others[f]);
  touch_back(*survey, contact);
  return CW_OK;
}

CwStatus cw_contact_imprint(const CwSurvey *survey, const CwContact *contact, double tolerance, CwLog *log,
                            CwCadParts *parts, int *cut) {
  *cut = 0;
  return cw_cad_guard("cad.domains", [&]() -> CwStatus {
    const std::vector<CwCadPart> before = parts->part;
    for (size_t p = 0; p < before.size(); p++) {
      std::set<int> others;
      for (int f = 0; f < survey->face_count; f++) {
        if (survey->face[f].part != (int)p || contact[f].part < 0 || contact[f].share >= 1) continue;
        others.insert(contact[f].part);
        ++*cut;
      }
      std::vector<TopoDS_Shape> tools;
      for (int g = 0; g < survey->face_count; g++) {
        const CwSurveyFace &face = survey->face[g];
        if (!others.count(face.part) || contact[g].part != (int)p) continue;
        tools.push_back(cw_cad_faces(before[face.part].solid)(face.face + 1));
      }
      if (tools.empty()) continue;
      const CwStatus status = cut_part(tools, EDGES * tolerance / parts->unit, parts->part[p]);
      if (status != CW_OK) return status;
      cw_log(log, "%s: cut along the faces of its neighbours where they touch in part", before[p].domain.c_str());
    }
    return CW_OK;
  });
}
