// SPDX-License-Identifier: AGPL-3.0-or-later
// A pump of primitives for tests, mm: the wheel's water is a disc of radius 50 with an inlet pipe of radius 20 along -z
// and six straight blades; the casing is a ring from radius 50 to 80, thicker than the wheel, with an outlet pipe along
// x.
#pragma once

#include <cmath>
#include <cstring>
#include <string>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>

inline TopoDS_Shape small_solid_of(const TopoDS_Shape &shape) {
  return TopExp_Explorer(shape, TopAbs_SOLID).Current();
}

inline double small_volume(const TopoDS_Shape &shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

inline TopoDS_Shape small_cylinder(double z, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, z), gp::DZ()), radius, height).Shape();
}

// `eyes`: 2 for another inlet pipe, along +z.
inline TopoDS_Shape small_rotor(int eyes = 1) {
  TopoDS_Shape water = BRepAlgoAPI_Fuse(small_cylinder(-5, 50, 10), small_cylinder(-60, 20, 55)).Shape();
  if (eyes == 2) water = BRepAlgoAPI_Fuse(water, small_cylinder(5, 20, 55)).Shape();
  for (int k = 0; k < 6; k++) {
    gp_Trsf turn;
    turn.SetRotation(gp::OZ(), k * M_PI / 3);
    const TopoDS_Shape blade = BRepPrimAPI_MakeBox(gp_Pnt(25, -1.5, -20), gp_Pnt(45, 1.5, 20)).Shape();
    water = BRepAlgoAPI_Cut(water, BRepBuilderAPI_Transform(blade, turn, Standard_True).Shape()).Shape();
  }
  return small_solid_of(water);
}

inline TopoDS_Shape small_stator() {
  const TopoDS_Shape pipe = BRepPrimAPI_MakeBox(gp_Pnt(0, 55, -8), gp_Pnt(150, 75, 8)).Shape();
  const TopoDS_Shape full = BRepAlgoAPI_Fuse(small_cylinder(-8, 80, 16), pipe).Shape();
  return small_solid_of(BRepAlgoAPI_Cut(full, small_cylinder(-8, 50, 16)).Shape());
}

inline void small_write(const std::string &path, const std::initializer_list<TopoDS_Shape> &shapes) {
  BRep_Builder builder;
  TopoDS_Compound all;
  builder.MakeCompound(all);
  for (const TopoDS_Shape &shape : shapes) builder.Add(all, shape);
  BRepTools::Write(all, path.c_str());
}
