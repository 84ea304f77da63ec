// SPDX-License-Identifier: AGPL-3.0-or-later
// Solids of OpenCASCADE's primitives as CwSolid, and what is measured on solids, for tests of single modules.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shell.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "geometry/solid.hpp"

// All faces are walls of the patch "wall" and are named "wall_1" on.
inline CwSolid hand_solid(const TopoDS_Shape &shape, double unit) {
  CwSolid solid = {"hand", unit, TopoDS::Solid(shape), {}};
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(solid.solid, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); i++)
    solid.faces.push_back({TopoDS::Face(faces(i)), "wall", CW_PATCH_WALL, "wall_" + std::to_string(i)});
  return solid;
}

// Over a flat polygon.
inline CwSolid hand_prism(const std::vector<gp_Pnt> &corners, const gp_Vec &along, double unit = 1) {
  BRepBuilderAPI_MakePolygon outline;
  for (const gp_Pnt &corner : corners) outline.Add(corner);
  outline.Close();
  return hand_solid(BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()).Face(), along).Shape(), unit);
}

// Some faces of another solid, the first `count`, as if they were all.
inline CwSolid hand_of_faces(const CwSolid &from, size_t count) {
  BRep_Builder builder;
  TopoDS_Shell shell;
  TopoDS_Solid solid;
  builder.MakeShell(shell);
  for (size_t f = 0; f < count; f++) builder.Add(shell, from.faces[f].face);
  shell.Closed(Standard_True);
  builder.MakeSolid(solid);
  builder.Add(solid, shell);
  return hand_solid(solid, from.unit);
}

// Negative of a solid that is inside out.
inline double hand_volume(const TopoDS_Shape &solid) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(solid, properties);
  return properties.Mass();
}

inline double hand_area(const TopoDS_Shape &face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties.Mass();
}

inline gp_Pnt hand_centre(const TopoDS_Shape &face) {
  GProp_GProps properties;
  BRepGProp::SurfaceProperties(face, properties);
  return properties.CentreOfMass();
}

// Of all faces of a patch.
inline double hand_patch_area(const CwSolid &solid, const std::string &patch) {
  double sum = 0;
  for (const CwSolidFace &face : solid.faces) sum += face.patch == patch ? hand_area(face.face) : 0;
  return sum;
}

inline int hand_patch_count(const CwSolid &solid, const std::string &patch) {
  int count = 0;
  for (const CwSolidFace &face : solid.faces) count += face.patch == patch;
  return count;
}

// Of all edges.
inline double hand_edge_tolerance(const CwSolid &solid) {
  double most = 0;
  for (TopExp_Explorer at(solid.solid, TopAbs_EDGE); at.More(); at.Next())
    most = std::max(most, BRep_Tool::Tolerance(TopoDS::Edge(at.Current())));
  return most;
}

// Whether the faces stand in the order that counts.
inline bool hand_faces_in_order(const CwSolid &solid) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(solid.solid, TopAbs_FACE, map);
  bool same = map.Extent() == (int)solid.faces.size();
  for (int i = 1; same && i <= map.Extent(); i++) same = map(i).IsEqual(solid.faces[i - 1].face);
  return same;
}
