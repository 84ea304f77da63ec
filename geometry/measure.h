// SPDX-License-Identifier: AGPL-3.0-or-later
// Measures the solids as built: what the design asked for is read back from the B-rep itself.
#pragma once

#include "geometry/solid.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// An angle along an edge of the solid, measured through the fluid where nothing else is said, rad, and where it is
// found, m.
typedef struct {
  double angle;
  double at[3];
} CwMeasuredAngle;

// The fields are what files tell of a solid, and the faces that messages name.
typedef struct {
  int valid;       // BRepCheck finds no fault, and the volume is positive: not inside out
  int closed;      // each edge lies on two faces in opposite senses; no seam, no degenerate edge
  char fault[160]; // where it is not both: what is wrong, with the face; else ""
  int face_count;
  double largest_tolerance;              // of any vertex, edge or face, m
  double volume;                         // m3
  double shortest_edge;                  // m
  double narrowest_face;                 // vector area over half the circumference: at most a narrow face's width, m
  int loosest, shortest_of, narrowest;   // a face of that tolerance, one of that edge, and that face
  CwMeasuredAngle fluid_edge, wall_edge; // the sharpest edges: between two faces through the fluid, through the wall
  CwMeasuredAngle corner;                // the sharpest corner of a face, between two of its edges
  int fluid_edge_of[2], wall_edge_of[2], corner_of; // faces of these
} CwMeasuredSolid;

typedef struct {
  double wrap_angle;                         // mean line at mid-span, leading edge to trailing edge, blade 1, rad
  double inlet_diameter;                     // of the inlet, or of the disc towards the suction zone, m
  double inlet_area;                         // of the same, m2
  double outlet_diameter;                    // of the blade's cut, m
  double outlet_width;                       // axial extent of the interface, m
  double interface_radius;                   // m
  double interface_area;                     // m2
  CwMeasuredAngle hub_crease, shroud_crease; // least angle of blade to hub, blade to shroud
  CwMeasuredAngle trailing_edge;             // greatest angle round an edge of the trailing edge: the sharpest wedge
  // Greatest angle between the normals of two faces that a caster expects to be one smooth surface: hub, shroud,
  // nut, shaft and pipe in themselves and to one another, leading edge to both sides of the blade, root fillets
  // to blade and wall.
  CwMeasuredAngle kink;
} CwMeasuredRotor;

typedef struct {
  double base_diameter;    // of the step from b2 to b3, m
  double inlet_width;      // axial extent of the step, m
  double interface_radius; // m
  double interface_area;   // m2
} CwMeasuredStator;

CwStatus cw_measure_solid(const CwSolid *solid, CwMeasuredSolid *measured);
CwStatus cw_measure_rotor(const CwSolid *rotor, CwMeasuredRotor *measured);
CwStatus cw_measure_stator(const CwSolid *stator, CwMeasuredStator *measured);

#ifdef __cplusplus
}
#endif
