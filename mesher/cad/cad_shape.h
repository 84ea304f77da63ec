// SPDX-License-Identifier: AGPL-3.0-or-later
// Inside of CwCad, for the C++ files of the bridge only: its faces and edges, and how they are evaluated. Lengths in
// here are in the unit of the B-rep; only the C functions speak metres, or the unit of the model.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Geom2dAdaptor_Curve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Standard_Failure.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Pnt.hxx>

#include "mesher/cad/cad_pole.h"
#include "mesher/cad/face_table.h"
#include "pipeline/status.h"

// Parameters at which a spline changes its polynomial. An adaptor keeps the polynomial of its last span; at a
// parameter a rounding error off a knot the span, and with it the last bits, would follow from the call
// before. So such parameters are put on the knot.
struct CwCadKnots {
  std::vector<double> knot; // ascending; empty for anything but splines
  double snap(double parameter) const;
};

struct CwCadFace {
  GeomAdaptor_Surface surface; // location applied
  CwCadKnots u_knots, v_knots;
  double u_range[2], v_range[2]; // of the surface; infinite where it is unbounded or periodic
  CwCadPole pole;                // (u,v) below and behind cad.h are the plane's where it is one
  int reversed;
  double left_out = 0; // greatest width, in the unit of the B-rep, of a narrow face that no mesh shows; 0: of no such

  gp_Pnt point(const double uv[2]) const;
  void derive(const double uv[2], gp_Pnt &p, gp_Vec first[2], CwCadSecond *second) const; // second: may be null
  void keep_in_ranges(double uv[2]) const;
};

struct CwCadEdge;

// What an edge has on the face that it bounds in place of a left-out one: the (u,v) of the edge that bounded it.
struct CwCadReplaced {
  int strip;                             // the face left out between the two edges
  int side;                              // of the edge that stays: the face on which it stands for the other
  double gap;                            // greatest distance of the two, in the unit of the B-rep
  std::vector<double> t;                 // parameter of the other at even steps of its own
  std::shared_ptr<const CwCadEdge> edge; // the other

  double parameter(double share) const; // of the other at a share of the edge's range
};

// An end of an edge that was brought to another vertex.
struct CwCadMovedEnd {
  bool is = false;
  double gap = 0;                  // from where it was, in the unit of the B-rep
  bool slides[2] = {false, false}; // on face[0], face[1]: the vertex lies on that face, elsewhere
};

struct CwCadEdge {
  GeomAdaptor_Curve curve; // location applied
  CwCadKnots knots;
  double range[2];
  int vertex[2];
  int face[2];
  Geom2dAdaptor_Curve pcurve[2]; // on face[0], face[1], with the parameter of the curve
  CwCadKnots pcurve_knots[2];
  std::shared_ptr<const CwCadReplaced> replaced; // null: of no left-out face
  CwCadMovedEnd moved[2];                        // at range[0], range[1]
};

struct CwCad {
  double metres;    // the unit of the B-rep, m
  double unit;      // the same in the unit of lengths: m, or the model's once the solid has that
  std::string path; // of the file
  TopoDS_Shape solid;
  TopTools_IndexedMapOfShape face_map, edge_map, vertex_map; // 1-based
  std::vector<CwCadFace> face;
  std::vector<CwCadEdge> edge;
  std::vector<gp_Pnt> vertex;
  bool inside_out; // faces of the file point into the solid (cw_cad_turn)
  CwFaceTable table;
};

// Fills everything but the table from the B-rep file; throws Standard_Failure where OpenCASCADE does.
CwStatus cw_cad_read_shape(const char *path, CwCad *cad);
// Lists faces, edges and vertices of the solid.
void cw_cad_map_parts(CwCad *cad);
// The shape 2^power times as large about the origin: each number in it is the old one or that times 2^power, also those
// of its curves in (u,v). Throws Standard_Failure.
TopoDS_Shape cw_cad_scaled_shape(const TopoDS_Shape &shape, int power);
// Checks edges and builds face and edge evaluators; needs the table for its messages.
CwStatus cw_cad_read_parts(CwCad *cad);
// CW_ERR_GEOMETRY, with name and place of a face at which OpenCASCADE has failed.
CwStatus cw_cad_face_failure(const CwCad *cad, int face, const Standard_Failure &failure);
