// SPDX-License-Identifier: AGPL-3.0-or-later
// What is behind CwSolid, for the C++ files of this room only.
#ifndef CUTWATER_GEOMETRY_SOLID_HPP
#define CUTWATER_GEOMETRY_SOLID_HPP

#include <string>
#include <vector>

#include <TopoDS_Face.hxx>
#include <TopoDS_Solid.hxx>

#include "geometry/solid.h"

struct CwSolidFace {
  TopoDS_Face face;
  std::string patch, kind, name;
};

struct CwSolid {
  std::string domain;
  double unit; // model unit, m
  TopoDS_Solid solid;
  std::vector<CwSolidFace> faces; // in the order of TopExp::MapShapes
};

#endif
