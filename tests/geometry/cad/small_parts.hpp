// SPDX-License-Identifier: AGPL-3.0-or-later
// Parts and a section `cad` for tests of single modules: solids in mm, the axis +z, nothing healed or divided.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <gp_Pln.hxx>

#include "cad/small_pump.hpp"
#include "geometry/cad/cad_part.hpp"
#include "geometry/cad/contact.h"

static const CwCadFrame small_frame = {{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1};
static const double small_tolerance = 1e-5; // m

// The parts, their domains, what touches, and what rotates: the first.
struct SmallParts {
  CwCadParts parts = {1e-3, {}};
  CwCadDomain domain[4] = {};
  CwCaseCad cad = {};
  int rotating[4] = {1, 0, 0, 0};
  CwSurvey survey = {};
  CwContact *contact = nullptr;

  explicit SmallParts(const std::initializer_list<std::pair<const char *, TopoDS_Shape>> &solids) {
    int faces = 0;
    for (const auto &[name, solid] : solids) {
      CwCadPart part = {name, small_solid_of(solid), {}};
      part.origin.resize(cw_cad_faces(part.solid).Extent());
      for (CwCadFaceOrigin &origin : part.origin) origin.number = faces++;
      snprintf(domain[parts.part.size()].name, CW_NAME_SIZE, "%s", name);
      domain[parts.part.size()].rotating = parts.part.empty();
      parts.part.push_back(part);
    }
    cad.domain = domain;
    cad.domain_count = (int)parts.part.size();
  }
  ~SmallParts() {
    cw_survey_free(&survey);
    free(contact);
  }
  CwStatus look() {
    CwStatus status = cw_survey_make(&parts, &small_frame, &survey);
    contact = (CwContact *)calloc(survey.face_count + 1, sizeof *contact);
    if (status == CW_OK) status = cw_contact_find(&parts, &survey, &small_frame, &cad, small_tolerance, contact);
    return status;
  }
  // With faces cut where others end on them, as the stage looks.
  CwStatus look_imprinted() {
    CwStatus status = CW_OK;
    int cut;
    CW_TRY(look());
    CW_TRY(cw_contact_imprint(&survey, contact, small_tolerance, NULL, &parts, &cut));
    cw_survey_free(&survey);
    free(contact);
    CW_TRY(look());
  done:
    return status;
  }
};

// A face whose outline crosses itself, a bow tie in the plane z = 3 mm: it has no triangles.
inline TopoDS_Shape small_bow_tie() {
  BRepBuilderAPI_MakePolygon outline(gp_Pnt(1, 1, 3), gp_Pnt(2, 2, 3), gp_Pnt(2, 1, 3), gp_Pnt(1, 2, 3), Standard_True);
  BRep_Builder builder;
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  builder.MakeShell(shell);
  builder.Add(shell, BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 3), gp::DZ()), outline.Wire(), Standard_False).Face());
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return solid;
}

inline TopoDS_Shape small_box(double x, double y, double z, double dx, double dy, double dz) {
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}

#include "tests/unit_test.h"
