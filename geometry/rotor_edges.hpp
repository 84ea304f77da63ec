// SPDX-License-Identifier: AGPL-3.0-or-later
// The vertices and edges of the rotor's shell: along the blades at hub, shroud and the ends of root fillets, across the
// span, along the flow on the walls, and arcs from each blade to the next.
#pragma once

#include <cmath>
#include <vector>

#include <Geom_Curve.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pnt.hxx>

#include "geometry/blade_shape.hpp"
#include "geometry/design.h"
#include "geometry/meridian.h"
#include "geometry/shell_builder.hpp"

enum { SLANTED_POINTS = 33 }; // that a slanted line is interpolated at, in space and in a plane
enum { WALL_LEVELS = 4 };     // curves along the blade: hub, ends of both root fillets, shroud

// A blade in the shell. Levels run from the hub's (0) to the shroud's, one more than bands; inner levels are
// where root fillets end. The fields are the vertices and edges of its faces, by the names of blade.h.
struct RotorBlade {
  const CwBladeShape *shape;
  int turns; // multiples of the pitch
  // Vertices on the walls: upstream corner of the meridian line, tip of the nose, on the interface.
  int up[2], tip[2], out[2], disk, inlet, shaft;
  // Vertices of each level: nose/pressure, nose/suction, end of the pressure side, begin and end of the bevel.
  int nose_p[WALL_LEVELS], nose_s[WALL_LEVELS], corner[WALL_LEVELS], bevel0[WALL_LEVELS], bevel1[WALL_LEVELS];
  // Edges on the walls: meridian lines, their continuation on nut or pipe, along the shaft and the inlet, arcs
  // from this blade to the next.
  int e_up[2], e_down[2], e_end[2], e_shaft, e_inlet, x_out, a_out[2], a_up[2], a_end[2], a_shaft;
  // Edges of each level. On a wall the nose has two edges with the tip between, on an inner level one (nose_p).
  int e_nose_s[WALL_LEVELS], e_nose_p[WALL_LEVELS], e_p[WALL_LEVELS], e_s[WALL_LEVELS], e_bevel[WALL_LEVELS],
      e_te[WALL_LEVELS];
  // Edges across the span, of each band.
  int x_p[WALL_LEVELS], x_s[WALL_LEVELS], x_bevel0[WALL_LEVELS], x_bevel1[WALL_LEVELS], x_corner[WALL_LEVELS];
};

class RotorEdges {
public:
  // Makes them all, of a design in the model unit. [in] from, section, kinds: outlive this; the kinds are the blades of
  // one pitch, by their angle, with patches and guide lines. `before`: by what angle the parameter planes of a passage
  // begin before its blade, rad.
  RotorEdges(const CwDesign *from, const CwMeridian &section, const std::vector<CwBladeShape> &kinds, double before);

protected:
  const CwDesign *design;
  const CwMeridian &meridian;
  const std::vector<CwBladeShape> &shapes; // the blade and, behind its pressure side, the splitter or seams
  const CwMeridianCurve *curve[2];         // hub and shroud
  const double pitch, margin;
  const int bands;
  const bool has_nut, has_shaft;
  std::vector<RotorBlade> blade; // those of all pitches
  CwShellBuilder shell;

  gp_Ax3 blade_axes(int i, double z = 0) const;
  Handle(Geom_Curve) meridian_curve(const CwMeridianCurve &curve, double theta) const;
  Handle(Geom_Curve) nut_curve(double theta) const;
  // The parameter planes of the passage behind blade i: the angle where they begin, and what is added in them to the
  // angles of blade i and of the next blade, which may be the first of its pitch.
  double zero_of(int i) const {
    return blade[i].turns * pitch + blade[i].shape->begin - margin;
  }
  double near_of(int i) const {
    return margin - blade[i].shape->begin;
  }
  double far_of(int i) const {
    return ((i + 1) % (int)shapes.size() == 0 ? pitch : 0) + near_of(i);
  }

private:
  gp_Pnt at(double r, double theta, double z) const {
    return gp_Pnt(r * std::cos(theta), r * std::sin(theta), z);
  }
  // An edge between places (r, theta, z), in which it is linear: straight where both angles are the same, else part of
  // a helix or spiral.
  int slanted_line(const double from[3], const double to[3], int begin, int end);
  void level_edges(RotorBlade &b, int level);
  void band_edges(RotorBlade &b, int band);
  void wall_edges(RotorBlade &b);
  void arcs(int i);
};
