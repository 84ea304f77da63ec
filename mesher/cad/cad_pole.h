// SPDX-License-Identifier: AGPL-3.0-or-later
// Faces one side of whose parameter rectangle is a single point: about the pole of a sphere, the tip of a cone, the
// corner of a three-sided spline. In (u,v) of the surface such a point is a line, and at it no derivative along that
// line is left. The bridge gives such a face other parameters, polar ones as a plane has them:
//
//      side that is a point                        b                 t
//      a0 ---------------- a1  b = pole             \               |   / a1
//       |                  |                         \    ->        | /
//       |                  |                                        o------- s     middle of a0, a1
//      a0 ---------------- a1                                         \ .
//                                                                       \ a0
//
// s + i t = |b - pole| exp(i rate (a - middle)), with the rate at which the directions out of the pole turn on the
// surface, so that the map is regular at the point and nearly isotropic beside it. In C++ for the bridge only.
#pragma once

#include <GeomAdaptor_Surface.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_Vec.hxx>

struct CwCadSecond {
  gp_Vec uu, vv, uv;
};

struct CwCadPole {
  bool is = false;     // else the parameters are those of the surface
  int around = 0;      // 0: u runs along the side that is a point, 1: v does
  double pole = 0;     // the other parameter there
  double inward = 1;   // sign of the other parameter, from there into the face
  double middle = 0;   // of the parameter along it
  double rate = 1;     // with the sign that keeps the side of the normal
  double smallest = 0; // distance from the pole at which derivatives are taken, at the least
  int vertex = -1;     // of the solid, where it is one

  void to_plane(double uv[2]) const;   // from the parameters of the surface
  void to_surface(double st[2]) const; // and back
  // Derivatives by s and t from those by u and v at the same point, which is st, off the pole; `second` may be null.
  void derive(const double st[2], gp_Vec first[2], CwCadSecond *second) const;
  // A point as near to st as derivatives can be taken.
  void keep_off(double st[2]) const;
};

// Finds the degenerate edges of a face. Those without extent in (u,v) need nothing. False where the face has more than
// one of the others, or one that runs along neither parameter.
bool cw_cad_pole_find(const TopoDS_Face &face, const GeomAdaptor_Surface &surface,
                      const TopTools_IndexedMapOfShape &vertices, CwCadPole &pole);
