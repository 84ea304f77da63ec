// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/rotor.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "geometry/blade.h"
#include "geometry/blade_patches.hpp"
#include "geometry/design_unit.h"
#include "geometry/meridian.h"
#include "geometry/rotor_faces.hpp"
#include "geometry/solid.hpp"

namespace {

// Parameter planes of the surfaces of revolution begin a margin before a blade's trailing edge, so that a whole passage
// has angles between 0 and 2 pi; half of it is left behind the leading edge. rad; bevels and leaning edges need the
// least.
const double usual_margin = 0.5;

// From the design to the solid: the sections of blade, splitter and seams, their patches, then edges and faces.
class RotorMaker {
public:
  explicit RotorMaker(const CwDesign *from) : design(from) {}
  CwStatus sections();
  CwSolid *build();

private:
  const CwDesign *design; // in the model unit
  CwMeridian meridian;
  std::vector<CwBladeShape> shapes; // the blade and, behind its pressure side, the splitter or seams
  double pitch, margin;

  CwStatus seams();
};

CwStatus RotorMaker::sections() {
  CwStatus status = CW_OK;
  pitch = 2 * M_PI / design->blade_count;
  CW_TRY(cw_meridian_make(design, &meridian));
  shapes.resize(design->splitter_start > 0 ? 2 : 1);
  for (int j = 0; j < CW_SPAN_POINTS; j++) {
    CwBladeSection section;
    CW_TRY(cw_blade_section(design, &meridian, (double)j / (CW_SPAN_POINTS - 1), &section));
    shapes[0].section.push_back(section);
    if (shapes.size() > 1) shapes[1].section.push_back(cw_blade_splitter(design, &section));
  }
  shapes[0].name = "blade";
  if (shapes.size() > 1) shapes[1].name = "splitter";
  for (const CwBladeShape &shape : shapes)
    for (const CwBladeSection &s : shape.section) {
      const double longest = cw_blade_longest_nose(&s),
                   thickness = 0.99 * longest / s.nose * design->leading_edge_thickness;
      CW_REQUIRE(s.nose < longest, CW_ERR_GEOMETRY,
                 "the leading edge's ellipse takes %.0f %% of the %s at span %.2f; allowed: %.0f %%: lower "
                 "leading_edge_thickness_mm to %.3g, or raise thickest_at",
                 100 * s.nose, shape.name, s.span, 100 * longest, 1e3 * design->unit * thickness);
    }
  CW_TRY(seams());
done:
  return status;
}

// Cuts a passage by the seams that it needs.
CwStatus RotorMaker::seams() {
  CwStatus status = CW_OK;
  CwBladeSeams seams;
  CW_TRY(cw_blade_seams(design, &meridian, &seams));
  CW_REQUIRE(seams.reach <= CW_SEAM_REACH_MOST, CW_ERR_GEOMETRY,
             "the blades and a part of their pitch of %.1f deg wind round the axis by %.1f deg; at most %.1f deg are "
             "allowed: lower wrap_angle_deg or raise blade_count%s",
             pitch * 180 / M_PI, seams.reach * 180 / M_PI, CW_SEAM_REACH_MOST * 180 / M_PI,
             design->splitter_start > 0 ? ", or leave splitter_start out" : "");
  margin = std::min(usual_margin, (2 * M_PI - seams.reach) / 1.5);
  for (int part = 1; part < seams.parts; part++) {
    CwBladeShape seam = {};
    seam.name = "seam";
    seam.section = shapes[0].section;
    seam.seam = true;
    seam.begin = pitch * part / seams.parts;
    for (CwBladeSection &s : seam.section) s.shift += seam.begin;
    shapes.push_back(seam);
  }
done:
  return status;
}

CwSolid *RotorMaker::build() {
  for (CwBladeShape &shape : shapes)
    if (shape.seam)
      cw_blade_seam(design, &meridian, pitch / shapes.size(), &shape);
    else
      cw_blade_patches(design, &meridian, shape.section[0].start > 0 ? pitch : std::min(pitch, margin), &shape);
  return RotorFaces(design, meridian, shapes, margin).make();
}

} // namespace

CwStatus cw_rotor_build(const CwDesign *design, CwSolid **rotor) {
  *rotor = nullptr;
  return cw_solid_guard(CW_ERR_GEOMETRY, "rotor", "", [&]() -> CwStatus {
    const CwDesign in_unit = cw_design_in_unit(design, cw_solid_unit_of_pump(design->outlet_diameter));
    RotorMaker maker(&in_unit);
    const CwStatus status = maker.sections();
    if (status != CW_OK) return status;
    *rotor = maker.build();
    const std::string fault = cw_solid_fault(**rotor);
    if (!fault.empty()) {
      cw_solid_free(rotor);
      return CW_FAIL(CW_ERR_GEOMETRY,
                     "rotor: %s; there are %d blades%s with a wrap of %.1f deg: lower blade_count or "
                     "blade_thickness_mm%s%s",
                     fault.c_str(), design->blade_count, design->splitter_start > 0 ? " and as many splitters" : "",
                     design->wrap_angle * 180 / M_PI, design->splitter_start > 0 ? ", or leave splitter_start out" : "",
                     design->blade_form == CW_BLADE_CYLINDRICAL ? ", or take blade_form twisted" : "");
    }
    return CW_OK;
  });
}
