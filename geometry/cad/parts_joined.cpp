// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/parts_joined.h"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <BRepAlgoAPI_Common.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <GProp_GProps.hxx>

#include "geometry/cad/cad_part.hpp"

namespace {

const double REACH = 0.02; // of the size of all: how far off faces are looked for that are meant to touch

struct Work {
  const CwCadParts &parts;
  const CwSurvey &survey;
  const CwContact *contact;
  const CwCadFrame &frame;
  const CwCaseCad &cad;
  double tolerance;
};

const char *key_of(const CwCadDomain &domain) {
  return domain.solids.count ? "solid" : "inside_mm";
}

const char *solid_of(const CwCadDomain &domain) {
  return domain.solids.count ? domain.solids.text[0] : "its solid";
}

gp_Pnt in_units(const Work &work, const double at[3]) {
  const double unit = work.parts.unit;
  return gp_Pnt(at[0] / unit, at[1] / unit, at[2] / unit);
}

// A face that runs along another part within the tolerance may seem to lie in it: by volume it does not.
CwStatus tell_overlap(const Work &work, const CwSurveyFace &face, int other) {
  const double unit = work.parts.unit;
  BRepAlgoAPI_Common common(work.parts.part[face.part].solid, work.parts.part[other].solid);
  GProp_GProps properties;
  char size[40] = "";
  if (!common.HasErrors()) {
    BRepGProp::VolumeProperties(common.Shape(), properties);
    const double volume = properties.Mass() * std::pow(unit, 3);
    if (volume <= work.tolerance * face.area) return CW_OK;
    snprintf(size, sizeof size, " by %.4g mm3", 1e9 * volume);
  }
  const CwCadDomain &own = work.cad.domain[face.part];
  return CW_FAIL(CW_ERR_GEOMETRY,
                 "cad.domains.%s.%s: %s and %s overlap%s, %s; allowed: domains that share surfaces and no volume; cut "
                 "one by the other",
                 own.name, key_of(own), own.name, work.cad.domain[other].name, size,
                 cw_cad_place(in_units(work, face.at), unit, work.frame).c_str());
}

bool may_hold(const std::array<double, 6> &box, const gp_Pnt &at) {
  return at.X() > box[0] && at.Y() > box[1] && at.Z() > box[2] && at.X() < box[3] && at.Y() < box[4] && at.Z() < box[5];
}

// Looks from the middle of each face that touches nothing.
CwStatus check_overlap(const Work &work) {
  for (int p = 0; p < (int)work.parts.part.size(); p++) {
    const TopoDS_Shape &solid = work.parts.part[p].solid;
    const std::array<double, 6> box = cw_cad_box(solid);
    std::unique_ptr<BRepClass3d_SolidClassifier> inside;
    for (int f = 0; f < work.survey.face_count; f++) {
      const CwSurveyFace &face = work.survey.face[f];
      const gp_Pnt at = in_units(work, face.at);
      if (face.part == p || work.contact[f].part >= 0 || !may_hold(box, at)) continue;
      if (!inside) inside.reset(new BRepClass3d_SolidClassifier(solid));
      inside->Perform(at, work.tolerance / work.parts.unit);
      const CwStatus status = inside->State() == TopAbs_IN ? tell_overlap(work, face, p) : CW_OK;
      if (status != CW_OK) return status;
    }
  }
  return CW_OK;
}

// Of each part the least of those that contacts join it to.
std::vector<int> sets_of(const Work &work) {
  std::vector<int> set(work.parts.part.size());
  for (size_t p = 0; p < set.size(); p++) set[p] = (int)p;
  for (bool changed = true; changed;) {
    changed = false;
    for (int f = 0; f < work.survey.face_count; f++) {
      if (work.contact[f].part < 0) continue;
      int &a = set[work.survey.face[f].part], &b = set[work.contact[f].part];
      changed |= a != b;
      a = b = std::min(a, b);
    }
  }
  return set;
}

// The nearest faces of a part and of others that are not joined to it.
struct Gap {
  double distance;
  int other = -1; // part
  const double *at = nullptr;
};

CwStatus find_gap(const Work &work, const std::vector<int> &set, int part, Gap &gap) {
  CwStatus status = CW_OK;
  for (int f = 0; f < work.survey.face_count; f++) {
    const CwSurveyFace &face = work.survey.face[f];
    if (face.part != part) continue;
    for (int i = face.first_sample; i < face.first_sample + face.sample_count; i++)
      for (int p = 0; p < (int)set.size(); p++) {
        const CwSurveySample &sample = work.survey.sample[i];
        double distance;
        int other;
        if (set[p] == set[part]) continue;
        CW_TRY(cw_survey_nearest(&work.survey, p, sample.at, gap.distance, &other, &distance, nullptr));
        if (other >= 0 && cw_contact_faces(&work.survey, &sample, other)) gap = {distance, p, sample.at};
      }
  }
done:
  return status;
}

bool has_opening(const CwFacePatches &patches, int part) {
  for (int i = 0; i < patches.count; i++)
    if (patches.patch[i].part == part && patches.patch[i].kind != CW_PATCH_WALL) return true;
  return false;
}

CwStatus tell_apart(const Work &work, const std::vector<int> &set, int wheel, int part, const CwFacePatches &patches) {
  const CwCadDomain &own = work.cad.domain[part], &first = work.cad.domain[wheel];
  Gap gap = {REACH * work.survey.size};
  const CwStatus status = find_gap(work, set, part, gap);
  if (status != CW_OK) return status;
  if (gap.other >= 0)
    return CW_FAIL(
        CW_ERR_GEOMETRY,
        "cad.domains.%s.%s: no face of %s joins it to %s; the nearest faces that face one another are a gap of "
        "%.4g mm apart, of %s and %s, %s; allowed: at the most cad.tolerance_mm, %.3g; draw the interface "
        "once and use it for both",
        own.name, key_of(own), solid_of(own), first.name, 1e3 * gap.distance, own.name, work.cad.domain[gap.other].name,
        cw_cad_place(in_units(work, gap.at), work.parts.unit, work.frame).c_str(), 1e3 * work.tolerance);
  if (!has_opening(patches, part)) return CW_OK;
  return CW_FAIL(CW_ERR_GEOMETRY,
                 "cad.domains.%s.%s: no face of %s joins it to %s%s; allowed: the water of one pump with one operating "
                 "point, all domains joined by shared faces",
                 own.name, key_of(own), solid_of(own), first.name, own.rotating ? ", which rotates too" : "");
}

} // namespace

CwStatus cw_parts_joined(const CwCadParts *parts, const CwSurvey *survey, const CwContact *contact,
                         const CwCadFrame *frame, const CwCaseCad *cad, double tolerance,
                         const CwFacePatches *patches) {
  const Work work = {*parts, *survey, contact, *frame, *cad, tolerance};
  return cw_cad_guard("cad.domains", [&]() -> CwStatus {
    CwStatus status = check_overlap(work);
    if (status != CW_OK) return status;
    const std::vector<int> set = sets_of(work);
    int wheel = 0;
    while (wheel + 1 < (int)set.size() && !cad->domain[wheel].rotating) wheel++;
    for (int p = 0; p < (int)set.size() && status == CW_OK; p++)
      if (set[p] != set[wheel]) status = tell_apart(work, set, wheel, p, *patches);
    return status;
  });
}
