// SPDX-License-Identifier: AGPL-3.0-or-later
// What is behind CwCadBodies and CwCadParts, and what all steps do with their solids: for the C++ files of this room
// only. Lengths in here are millimetres in bodies and model units in parts.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <gp_Pnt.hxx>

#include "geometry/cad/cad_frame.h"
#include "pipeline/status.h"

// What the file says of a face.
struct CwCadFaceOrigin {
  std::string name;
  std::vector<std::string> layers;
  int colour = -1; // 0xRRGGBB
  int number = -1; // of the face, over all that were chosen: its pieces share it
};

struct CwCadBody {
  std::string file, name, instance; // of the product, and of its place in an assembly
  TopoDS_Shape solid;
  std::vector<CwCadFaceOrigin> origin; // in the order of TopExp::MapShapes(solid, TopAbs_FACE)
};

struct CwCadBodies {
  std::vector<CwCadBody> body;
};

struct CwCadPart {
  std::string domain;
  TopoDS_Shape solid;
  std::vector<CwCadFaceOrigin> origin; // in the order of TopExp::MapShapes(solid, TopAbs_FACE)
  std::string from = {};               // which solids of which files, for messages
};

struct CwCadParts {
  double unit; // m
  std::vector<CwCadPart> part;
};

// Runs what uses OpenCASCADE; its exceptions become CW_ERR_GEOMETRY with `what` before their text.
CwStatus cw_cad_guard(const std::string &what, const std::function<CwStatus()> &run);

// Gives each face of `part` what the file says of the face of `from` that it lies on; nothing where all are farther off
// than `within`.
void cw_cad_carry(const std::vector<CwCadPart> &from, CwCadPart &part, double within = 1e100);

// Puts another solid in the place of the part's; its faces keep what the file says of those they lie on.
void cw_cad_replace(const TopoDS_Shape &solid, CwCadPart &part);

// The solids that tools, faces or edges, leave of one; none where OpenCASCADE fails. What is nearer than `fuzzy` to a
// tool, in the unit of the solid, lies on it.
std::vector<TopoDS_Shape> cw_cad_split(const TopoDS_Shape &solid, const TopTools_ListOfShape &tools, double fuzzy = 0);

// Points at even steps of an edge's parameter, its ends among them.
std::vector<gp_Pnt> cw_cad_edge_points(const TopoDS_Edge &edge, int steps);

// Points of a lattice in the face's parameters, `along` intervals each way, that lie inside of it; `most` at the most.
std::vector<gp_Pnt> cw_cad_inner_points(const TopoDS_Face &face, int along, size_t most);

// A point inside a face, however narrow it is. False, and no other point, where none can be found.
bool cw_cad_inner_point(const TopoDS_Face &face, gp_Pnt &point);

// Least and greatest x, y, z of a shape as it is, by no triangulation of it: x, y, z, x, y, z.
std::array<double, 6> cw_cad_box(const TopoDS_Shape &shape);

// "at (X, Y, Z) mm" of the file, for messages; `unit`: of the point, m.
std::string cw_cad_place(const gp_Pnt &at, double unit, const CwCadFrame &frame);

// The faces of a shape, in the order that counts.
inline TopTools_IndexedMapOfShape cw_cad_faces(const TopoDS_Shape &shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  return faces;
}
