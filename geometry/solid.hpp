// SPDX-License-Identifier: AGPL-3.0-or-later
// What is behind CwSolid, and how OpenCASCADE fails, for the C++ files of this room only.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Standard_Failure.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>

#include "geometry/solid.h"

struct CwSolidFace {
  TopoDS_Face face;
  std::string patch;
  CwPatchKind kind;
  std::string name;
};

struct CwSolid {
  std::string domain;
  double unit; // model unit, m
  TopoDS_Solid solid;
  std::vector<CwSolidFace> faces; // in the order of TopExp::MapShapes
};

// What BRepCheck finds fault with, in a few words that name the face; "": the solid is valid.
std::string cw_solid_fault(const CwSolid &solid);

// Throws std::runtime_error with a line, printf style, that says what cannot be built: for cw_solid_guard().
[[noreturn]] void cw_solid_refuse(const char *format, ...) __attribute__((format(printf, 1, 2)));

// What OpenCASCADE says of a failure; never "".
std::string cw_solid_failure_text(const Standard_Failure &failure);

// Runs what uses OpenCASCADE. Exceptions become `code`, with `what` before their text; before that of OpenCASCADE's own
// stands `library` too.
CwStatus cw_solid_guard(CwStatus code, const std::string &what, const char *library,
                        const std::function<CwStatus()> &run);
