// SPDX-License-Identifier: AGPL-3.0-or-later
// One pump, its operating point, its walls and its mesh, as the case file gives them (case_read.h). All is SI (m, kg,
// s, rad, Pa) whatever the unit in the key.
#pragma once

#include <math.h>
#include <stdint.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_NAME_SIZE = 33 }; // 32 characters: the limit of CGNS names
enum { CW_LIST_MOST = 12 };

#define CW_GRAVITY 9.80665 // m/s2, standard

typedef enum { CW_PRIORITY_WRAP, CW_PRIORITY_HEAD, CW_PRIORITY_BETA, CW_PRIORITY_AUTO } CwPriority;
typedef enum { CW_CORRELATIONS_GUELICH, CW_CORRELATIONS_GUAN } CwCorrelations;
typedef enum { CW_SLIP_WIESNER, CW_SLIP_PFLEIDERER } CwSlip;
typedef enum { CW_BLADE_TWISTED, CW_BLADE_CYLINDRICAL } CwBladeForm;
typedef enum { CW_EDGE_BEVELLED, CW_EDGE_BLUNT, CW_EDGE_ROUNDED, CW_EDGE_SHARP } CwTrailingEdge;
typedef enum { CW_ROTATION_COUNTER_CLOCKWISE, CW_ROTATION_CLOCKWISE } CwRotation; // seen from the drive
// -1 or 1: the sign of z on the suction side: a wheel that turns clockwise, seen from the drive, has it at z > 0.
static inline int cw_suction_side(CwRotation rotation) {
  return rotation == CW_ROTATION_CLOCKWISE ? 1 : -1;
}
typedef enum { CW_AREA_LAW_ANGULAR_MOMENTUM, CW_AREA_LAW_VELOCITY } CwAreaLaw;
typedef enum { CW_SECTION_TRAPEZOID, CW_SECTION_RECTANGLE, CW_SECTION_CIRCLE } CwVoluteSectionKind;
typedef enum { CW_DISCHARGE_TANGENTIAL, CW_DISCHARGE_RADIAL } CwDischarge;
typedef enum { CW_PIPE_WITH_NEIGHBOUR, CW_PIPE_OWN_ZONE } CwPipeZone;
typedef enum { CW_FILL_KERNEL, CW_FILL_TETGEN } CwFillMethod;
typedef enum { CW_Y_PLUS_AT_NODE, CW_Y_PLUS_AT_CELL_CENTRE } CwYPlusAt;
typedef enum { CW_SWEEP_LAYERS_STAY, CW_SWEEP_SIMILAR } CwSweep;
typedef enum { CW_WALL_FUNCTION_SMOOTH, CW_WALL_FUNCTION_ROUGH } CwWallTreatment;
typedef enum {
  CW_FORMAT_CGNS,
  CW_FORMAT_OPENFOAM,
  CW_FORMAT_CFX,
  CW_FORMAT_FLUENT,
  CW_FORMAT_SATURNE,
  CW_FORMATS
} CwFormat;
typedef enum { CW_FOAM_V1912, CW_FOAM_V2406 } CwFoamRelease;
typedef enum { CW_INTEGERS_AUTO, CW_INTEGERS_32, CW_INTEGERS_64 } CwIntegers;
typedef enum { CW_CGNS_STRICT, CW_CGNS_VENDOR } CwCgnsProfile;

// A value the case leaves out (an optional key) is NAN: the hydraulic design or, of an automatic key, the mesher then
// finds it.
static inline int cw_case_given(double value) {
  return !isnan(value);
}

typedef struct {
  double flow_rate;       // m3/s
  double head;            // m
  double speed;           // rad/s
  double inlet_pressure;  // Pa, absolute
  double time_step_angle; // rad of rotation per time step of the transient run
  double test_head;       // m, measured at this point; NAN: none
} CwOperatingPoint;

typedef struct {
  int count; // 0: left out
  double value[CW_LIST_MOST];
} CwList;

// The points of the characteristic curve; one of the two lists is given at the most (case_points.h).
typedef struct {
  CwList flow_shares; // of operating_point.flow_rate
  CwList flow_rates;  // m3/s
} CwOperatingPoints;

typedef struct {
  double density;             // kg/m3
  double kinematic_viscosity; // m2/s
  double temperature;         // degrees Celsius, of water; NAN: not given
  double vapour_pressure;     // Pa
} CwFluid;

// How the hydraulic design works out what the table leaves open.
typedef struct {
  CwCorrelations correlations; // the family of books
  CwSlip slip;                 // slip model of the predicted head
  double warn_share;           // a given value that differs more from its correlation is warned of
} CwDesignTable;

// The fields are the keys of the table `impeller`.
typedef struct {
  CwPriority priority; // which constraint of an over-determined table is the law
  CwRotation rotation;
  int blade_count;                                               // z, 2 to 12; 0: computed
  double inlet_diameter;                                         // D1, m
  double outlet_diameter;                                        // D2, m
  double outlet_width;                                           // b2, m
  double wrap_angle;                                             // rad
  double wrap_spread;                                            // rad, wrap at the shroud minus wrap at the hub
  double hub_diameter;                                           // m, at the nut
  double axial_length;                                           // m, of the shroud
  double hub_pole_radial, shroud_pole_axial, shroud_pole_radial; // shares, inner Bezier poles of the meridian
  double leading_edge_radius_hub;                                // m
  double leading_edge_radius_shroud;                             // m
  double incidence;                                              // rad, of the computed inlet blade angle
  double inlet_blade_angle;                                      // beta1 at mid-span, rad from tangential
  double outlet_blade_angle;                                     // beta2, rad from tangential
  double leading_edge_thickness;                                 // m
  double blade_thickness;                                        // m, the largest
  double trailing_edge_thickness;                                // m
  double trailing_edge_bevel;                                    // m, length of the bevel facet
  CwTrailingEdge trailing_edge;
  double leading_edge_ratio; // semi-axes of the leading edge's ellipse, along to across
  double thickest_at;        // share of the blade's length where it is thickest
  CwBladeForm blade_form;
  double lean_angle;             // rad, of the trailing edge from the axial direction; positive: shroud ahead
  double splitter_start;         // share of the meridional length where splitters begin; NAN: none
  double splitter_position;      // share of the pitch from a blade to the splitter behind its pressure side
  double nut_length;             // m, of the hub's nose before the hub
  double nut_flat_diameter;      // m, of its flat end
  double through_shaft_diameter; // m, of a shaft that goes out through the inlet; 0: none
  double root_fillet_radius;     // m, between blades and hub and shroud; 0: none
  double suction_pipe_length;    // m, from the shroud's inlet
  CwPipeZone suction_pipe_zone;  // whether most of it is a zone of its own
} CwImpellerTable;

// The fields are the keys of the table `volute`.
typedef struct {
  double base_diameter;   // D3, m
  double inlet_width;     // b3, m
  CwAreaLaw area_law;     // how the sections grow
  double velocity_factor; // K3 = c3 / sqrt(2 g H), with constant velocity
  CwVoluteSectionKind section;
  double side_wall_angle;         // rad, half angle between the side walls; not of a rectangle
  double corner_radius;           // m, between side and outer wall; not of a circle
  double tongue_radius;           // m, nose
  double tongue_gap;              // m, radial, from D3/2 to the tongue's tip
  double tongue_angle;            // rad, from the spiral's start to the tongue's tip
  double throat_area;             // m2
  double diffuser_length;         // m
  double diffuser_angle;          // rad, full angle of the cone of equal areas
  double diffuser_area_ratio;     // of outlet to throat
  CwDischarge discharge;          // which way the discharge pipe points
  double outlet_diameter;         // DN, m
  double discharge_pipe_length;   // m
  CwPipeZone discharge_pipe_zone; // whether most of it is a zone of its own
} CwVoluteTable;

// What one group of walls asks of its layers.
typedef struct {
  double y_plus;          // target; NAN: auto
  double velocity;        // m/s, of the flow along the wall; NAN: from the design
  double first_height;    // m; NAN: from y+ and velocity
  double growth_ratio;    // the largest; NAN: that of all walls
  double total_thickness; // m, the target of a column; NAN: that of all walls
} CwWallGroup;

enum { CW_LAYERS_MOST = 40 }; // that a case may ask for

// Prism layers. The first height follows from y+ with the velocity and length scales of the wall. Their number is one
// for all: columns are shared where patches meet, and a mesh of prisms and tetrahedra has no cell that ends a layer.
typedef struct {
  int layer_count;        // 0: auto
  double growth_ratio;    // the largest; NAN: auto
  double total_thickness; // m, the target of a column; NAN: from first height, count and growth
  CwYPlusAt y_plus_at;
  CwWallGroup blade, hub_shroud, volute, pipe;
  CwWallTreatment treatment;
  double roughness; // m, equivalent sand grain
} CwWalls;

typedef struct {
  int64_t cells;            // asked number of cells, all zones together
  CwSweep sweep;            // what another number of cells does to the layers (case_sweep.h)
  CwFillMethod fill;        // what makes the tetrahedra; TetGen steps in where the kernel cannot
  int64_t cells_per_region; // about this many; 0: computed
  int least_regions;        // of a domain
  int periodic_impeller;    // 1: of the equal passages of the impeller one is meshed and copied, 0: meshed whole
  double gradation;         // growth of size with distance, d(size)/d(distance)
  double curvature_angle;   // rad of turn of the surface normal across one edge, at relative size 1
  double cells_across_gap;  // least number of cells across a narrow place
  double size_blade, size_hub_shroud, size_volute, size_pipe, size_interface; // relative to the base size
} CwMeshTable;

// What the mesh is exported to.
typedef struct {
  int formats;              // 1 << CwFormat of each
  int foam_processors;      // folders that OpenFOAM's mesh is divided into; 1: it is whole
  CwIntegers cgns_integers; // bits of the integers of pump.cgns
  CwCgnsProfile cgns_profile;
  CwFoamRelease foam_release;
  CwIntegers foam_labels; // bits of OpenFOAM's labels
} CwExportTable;

enum { CW_CASE_KEYS_MOST = 256 };

typedef struct {
  char name[CW_NAME_SIZE];
  CwOperatingPoint operating_point;
  CwOperatingPoints operating_points;
  CwFluid fluid;
  CwDesignTable design;
  CwImpellerTable impeller;
  CwVoluteTable volute;
  CwWalls walls;
  CwMeshTable mesh;
  CwExportTable output;
  struct CwCaseCad *cad;                  // case_cad.h; NULL: the pump is designed. Copies of the case share it
  unsigned char given[CW_CASE_KEYS_MOST]; // of each of cw_case_keys (case_schema.h): 1: the case file has it
} CwCase;

#ifdef __cplusplus
}
#endif
