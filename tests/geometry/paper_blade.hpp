// SPDX-License-Identifier: AGPL-3.0-or-later
// The blade, with splitters or seams, of a case in the model unit of its wheel, as rotor.cpp makes it, for tests of
// what a rotor is made of.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "geometry/blade_patches.hpp"
#include "geometry/design_unit.h"
#include "geometry/solid.h"
#include "tests/geometry/paper_rotor.h"

struct PaperBlade {
  CwDesign design; // in the model unit: of 1 mm for the paper's wheel of 200 mm
  CwMeridian meridian;
  std::vector<CwBladeShape> shapes;
  double pitch, margin = 0.5;

  explicit PaperBlade(const CwCase &table) {
    const CwDesign metres = design_of(&table);
    design = cw_design_in_unit(&metres, cw_solid_unit_of_pump(metres.outlet_diameter));
    pitch = 2 * M_PI / design.blade_count;
    if (cw_meridian_make(&design, &meridian)) fail_msg("%s", cw_fail_message());
    shapes.resize(design.splitter_start > 0 ? 2 : 1);
    shapes[0].name = "blade";
    if (shapes.size() > 1) shapes[1].name = "splitter";
    for (int j = 0; j < CW_SPAN_POINTS; j++) {
      shapes[0].section.push_back(section_at((double)j / (CW_SPAN_POINTS - 1)));
      if (shapes.size() > 1) shapes[1].section.push_back(cw_blade_splitter(&design, &shapes[0].section[j]));
    }
  }
  PaperBlade(const PaperBlade &) = delete; // its sections point to its meridian

  CwBladeSection section_at(double span) const {
    CwBladeSection section;
    if (cw_blade_section(&design, &meridian, span, &section)) fail_msg("%s", cw_fail_message());
    return section;
  }
  // The room in which a line before a shape turns, rad.
  double room_of(const CwBladeShape &shape) const {
    return shape.section[0].start > 0 ? pitch : std::min(pitch, margin);
  }
  void make() {
    for (CwBladeShape &shape : shapes) cw_blade_patches(&design, &meridian, room_of(shape), &shape);
  }
  // Divides the passage into equal parts by seams.
  void add_seams(int parts) {
    for (int part = 1; part < parts; part++) {
      CwBladeShape seam = {};
      seam.name = "seam";
      seam.section = shapes[0].section;
      seam.begin = pitch * part / parts;
      for (CwBladeSection &s : seam.section) s.shift += seam.begin;
      cw_blade_seam(&design, &meridian, pitch / parts, &seam);
      shapes.push_back(seam);
    }
  }
  // (r, theta, z) of a place of the blade's section of the meridian, in space.
  gp_Pnt at(double span, const CwBladePoint &point) const {
    double x[2];
    cw_meridian_blade_point(&meridian, span, point.q, x, nullptr);
    return gp_Pnt(x[0] * std::cos(point.theta), x[0] * std::sin(point.theta), x[1]);
  }
};

inline CwCase paper_with(CwTrailingEdge edge, double fillet_radius = 0, double splitter_start = 0) {
  CwCase table = paper();
  table.impeller.trailing_edge = edge;
  table.impeller.root_fillet_radius = fillet_radius;
  if (splitter_start > 0) table.impeller.splitter_start = splitter_start;
  return table;
}

// The paper's blade of that kind, made once for all tests of a program, which leave it as it is.
inline PaperBlade &made_blade(CwTrailingEdge edge, double fillet_radius = 0, double splitter_start = 0) {
  static std::map<std::tuple<int, double, double>, std::unique_ptr<PaperBlade>> all;
  std::unique_ptr<PaperBlade> &blade = all[{edge, fillet_radius, splitter_start}];
  if (!blade) {
    std::unique_ptr<PaperBlade> made(new PaperBlade(paper_with(edge, fillet_radius, splitter_start)));
    made->make();
    blade = std::move(made);
  }
  return *blade;
}

// What a blade is refused with; empty where it is made.
inline std::string refusal_of(PaperBlade &refused) {
  try {
    refused.make();
  } catch (const std::runtime_error &failure) {
    return failure.what();
  }
  return "";
}
