// SPDX-License-Identifier: AGPL-3.0-or-later
// Distances of many points from the exact faces of a part. What OpenCASCADE's BRepExtrema_DistShapeShape prepares for
// each point anew, a lattice of the surface and the outline in its parameters, is prepared once a face.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include <BRepAdaptor_Surface.hxx>
#include <BRepExtrema_ExtPC.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <Bnd_Box.hxx>
#include <Extrema_ExtPS.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <gp_Pnt.hxx>

// The numbers, from 0, that the parts of a shape, of one kind, have in a map.
std::set<int> cw_cad_numbers(const TopoDS_Shape &shape, TopAbs_ShapeEnum kind, const TopTools_IndexedMapOfShape &all);

class CwFaceDistance {
public:
  explicit CwFaceDistance(const TopoDS_Shape &solid);
  // Of a point from a face, from 0 in the order of TopExp::MapShapes, in the unit of the solid; `reach` where it is no
  // less.
  double at(int number, const gp_Pnt &point, double reach);

private:
  struct Face {
    BRepAdaptor_Surface surface;
    Extrema_ExtPS nearest;
    BRepTopAdaptor_FClass2d outline;
    explicit Face(const TopoDS_Face &face);
  };
  struct Edge {
    Bnd_Box box;
    std::unique_ptr<BRepExtrema_ExtPC> nearest; // when first needed
  };
  TopTools_IndexedMapOfShape faces, edges, vertices;
  std::vector<Bnd_Box> box;                // of each face
  std::vector<std::unique_ptr<Face>> face; // when first needed
  std::vector<Edge> edge;
  std::vector<std::set<int>> edges_of, vertices_of; // of a face
};
