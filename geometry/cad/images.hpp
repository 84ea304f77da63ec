// SPDX-License-Identifier: AGPL-3.0-or-later
// Periodic images in a solid: what a z-th of a turn about +z takes its faces, edges and vertices to.
#pragma once

#include <string>
#include <vector>

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Trsf.hxx>

// Of one kind of item, by their numbers from 0.
struct CwImageSet {
  std::vector<int> next;         // where one turn takes the item
  std::vector<int> first, turns; // of its set: the item that the others are copies of, and turns from it to this
};

struct CwImagesOfSolid {
  int count;
  double off;                                        // greatest distance of an image from the item in its place
  TopTools_IndexedMapOfShape faces, edges, vertices; // in the order of TopExp::MapShapes
  CwImageSet face, edge, vertex;

  // Finds them within the tolerance, in the unit of the solid, and returns why there are none, "" where all is found. A
  // face may be its own image, and a corner on the axis, where faces may have their poles. `unit`: m, for what is told.
  std::string find(const TopoDS_Shape &solid, int count, double tolerance, double unit);
  // Chooses the first of each set: faces that hang together, and edges and vertices of theirs.
  void choose();
  bool is_fixed(int face_number) const {
    return face.next[face_number] == face_number;
  }
  gp_Trsf turn(int turns) const;
};
