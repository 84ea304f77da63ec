// SPDX-License-Identifier: AGPL-3.0-or-later
// The faces of the rotor's shell between its edges, one of each kind a passage, and the patches of the blades.
#pragma once

#include <Geom_Surface.hxx>

#include "geometry/rotor_edges.hpp"
#include "geometry/solid.hpp"

class RotorFaces : RotorEdges {
public:
  using RotorEdges::RotorEdges;
  // Makes the faces and of them the closed solid, once; the caller's to free. Throws Standard_Failure.
  CwSolid *make();

private:
  Handle(Geom_Surface) cylinder(int i, double r) const;
  void wall_face(int i, int w);
  void tube_faces(int i);
  void inlet_ring_face(int i);
  void interface_face(int i);
  void blade_faces(int i);
  void disk_face(double height, double r, int w, bool outward, const char *patch, CwPatchKind kind, const char *name);
};
