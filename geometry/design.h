// SPDX-License-Identifier: AGPL-3.0-or-later
// A finished hydraulic design: every dimension of the pump and what follows from them. SI units: m, rad, s, kg. It is
// made by hydraulic_design.h; rotor and stator are built from it in their own unit (design_unit.h).
#pragma once

#include "geometry/volute.h"
#include "pipeline/case.h"
#include "pipeline/vec.h"

// Every quantity of the design, once: X(member, unit kind, text). A member `outlet_width` of kind LENGTH is
// CwDesign.outlet_width in m, CW_DESIGN_outlet_width in the enum and "outlet_width_m" in design.json.
#define CW_DESIGN_LIST(X)                                                                                              \
  X(flow_rate, FLOW, "flow rate Q")                                                                                    \
  X(head, HEAD, "head H asked")                                                                                        \
  X(viscosity, DIFFUSIVITY, "kinematic viscosity of the fluid")                                                        \
  X(viscous_parameter, NUMBER, "parameter B of the viscous correction")                                                \
  X(viscous_head_factor, NUMBER, "head and flow rate over those with water")                                           \
  X(viscous_efficiency_factor, NUMBER, "efficiency over that with water")                                              \
  X(water_flow_rate, FLOW, "flow rate with water, for which the pump is designed")                                     \
  X(water_head, HEAD, "head with water, for which the pump is designed")                                               \
  X(angular_speed, ANGULAR_SPEED, "angular speed")                                                                     \
  X(specific_speed_nq, NUMBER, "specific speed nq = n Q^0.5 / H^0.75")                                                 \
  X(specific_speed_ns, NUMBER, "specific speed ns = 3.65 nq")                                                          \
  X(specific_speed_us, NUMBER, "specific speed Ns, US: rpm, gal/min, ft")                                              \
  X(type_number, NUMBER, "type number omega Q^0.5 / (g H)^0.75")                                                       \
  X(efficiency, NUMBER, "overall efficiency")                                                                          \
  X(shaft_power, POWER, "shaft power")                                                                                 \
  X(shaft_diameter, LENGTH, "shaft, least diameter by torsion")                                                        \
  X(head_coefficient, NUMBER, "head coefficient psi = 2 g H / u2^2")                                                   \
  X(inlet_diameter, LENGTH, "impeller inlet D1")                                                                       \
  X(outlet_diameter, LENGTH, "impeller outlet D2")                                                                     \
  X(outlet_width, LENGTH, "impeller outlet width b2")                                                                  \
  X(hub_diameter, LENGTH, "hub at the nut")                                                                            \
  X(nut_disk_radius, LENGTH, "flat end of the hub nut, radius")                                                        \
  X(nut_length, LENGTH, "hub nut, length")                                                                             \
  X(through_shaft_diameter, LENGTH, "shaft through the inlet (0: none)")                                               \
  X(axial_length, LENGTH, "shroud, axial length from eye to outlet")                                                   \
  X(hub_pole_radial, NUMBER, "hub, radial share of its third Bezier pole")                                             \
  X(shroud_pole_axial, NUMBER, "shroud, axial share of its second Bezier pole")                                        \
  X(shroud_pole_radial, NUMBER, "shroud, radial share of its third Bezier pole")                                       \
  X(leading_edge_radius_hub, LENGTH, "leading edge at the hub, radius")                                                \
  X(leading_edge_radius_shroud, LENGTH, "leading edge at the shroud, radius")                                          \
  X(meridional_length, LENGTH, "blade length in the meridian, mid-span")                                               \
  X(inlet_passage_width, LENGTH, "passage width b1 at the leading edge")                                               \
  X(shroud_bend_radius, LENGTH, "shroud, least bend radius in the meridian")                                           \
  X(passage_area_eye, AREA, "passage area in the eye, no blades")                                                      \
  X(passage_area_inlet, AREA, "passage area at the leading edge")                                                      \
  X(passage_area_outlet, AREA, "passage area at the trailing edge")                                                    \
  X(passage_area_reversal, NUMBER, "passage area, largest step back on its way, share")                                \
  X(inlet_blade_angle, ANGLE, "blade angle beta1 at mid-span")                                                         \
  X(outlet_blade_angle, ANGLE, "blade angle beta2")                                                                    \
  X(wrap_angle, ANGLE, "wrap angle at mid-span")                                                                       \
  X(wrap_residual, ANGLE, "wrap angle minus the table's")                                                              \
  X(wrap_spread, ANGLE, "wrap at the shroud minus wrap at the hub")                                                    \
  X(outlet_angle_residual, ANGLE, "beta2 minus the table's")                                                           \
  X(overlap, NUMBER, "overlap z wrap / 360 deg")                                                                       \
  X(leading_edge_thickness, LENGTH, "blade thickness at the leading edge")                                             \
  X(blade_thickness, LENGTH, "blade thickness, largest")                                                               \
  X(trailing_edge_thickness, LENGTH, "blade thickness at the trailing edge")                                           \
  X(trailing_edge_bevel, LENGTH, "bevel of the trailing edge, facet length (0: none)")                                 \
  X(leading_edge_ratio, NUMBER, "leading edge ellipse, along to across")                                               \
  X(thickest_at, NUMBER, "blade thickest at this share of its length")                                                 \
  X(lean_angle, ANGLE, "lean of the trailing edge")                                                                    \
  X(root_fillet_radius, LENGTH, "root fillets, radius (0: none)")                                                      \
  X(splitter_start, NUMBER, "splitters begin at this share (0: none)")                                                 \
  X(splitter_position, NUMBER, "splitters at this share of the pitch")                                                 \
  X(suction_pipe_length, LENGTH, "suction pipe, length")                                                               \
  X(interface_radius, LENGTH, "rotor/stator interface, radius (D2 + D3) / 4")                                          \
  X(impeller_tip_speed, SPEED, "u2")                                                                                   \
  X(inlet_blade_speed, SPEED, "u1 at the mid-span leading edge")                                                       \
  X(inlet_meridional_speed, SPEED, "c_m1 before the blades")                                                           \
  X(inlet_blockage, NUMBER, "blade blockage tau1 at the inlet")                                                        \
  X(inlet_relative_speed, SPEED, "w1 with blockage")                                                                   \
  X(inlet_flow_angle, ANGLE, "relative flow angle at the inlet with blockage")                                         \
  X(incidence, ANGLE, "incidence: beta1 minus flow angle")                                                             \
  X(outlet_meridional_speed, SPEED, "c_m2 after the blades")                                                           \
  X(outlet_blockage, NUMBER, "blade blockage tau2 at the outlet")                                                      \
  X(slip_factor, NUMBER, "slip factor gamma, used")                                                                    \
  X(slip_factor_wiesner, NUMBER, "slip factor gamma by Wiesner")                                                       \
  X(slip_factor_pfleiderer, NUMBER, "slip factor gamma by Pfleiderer")                                                 \
  X(outlet_swirl_speed, SPEED, "c_u2")                                                                                 \
  X(outlet_absolute_speed, SPEED, "c_2")                                                                               \
  X(outlet_relative_speed, SPEED, "w_2")                                                                               \
  X(outlet_flow_angle, ANGLE, "relative flow angle at the outlet")                                                     \
  X(outlet_absolute_angle, ANGLE, "absolute flow angle alpha2")                                                        \
  X(diffusion_ratio, NUMBER, "w2 / w1")                                                                                \
  X(hydraulic_efficiency, NUMBER, "hydraulic efficiency with water")                                                   \
  X(theoretical_head, HEAD, "theoretical head u2 c_u2 / g")                                                            \
  X(predicted_head, HEAD, "predicted head")                                                                            \
  X(head_residual, HEAD, "predicted minus asked head")                                                                 \
  X(predicted_head_wiesner, HEAD, "predicted head with Wiesner's slip")                                                \
  X(predicted_head_pfleiderer, HEAD, "predicted head with Pfleiderer's slip")                                          \
  X(inlet_throat_width, LENGTH, "throat between the blades at the inlet, width")                                       \
  X(inlet_throat_area, AREA, "throat at the inlet, all passages")                                                      \
  X(inlet_throat_ratio, NUMBER, "w in the inlet throat / w1")                                                          \
  X(outlet_throat_width, LENGTH, "throat between the blades at the outlet, width")                                     \
  X(npsh_required, HEAD, "NPSH3 estimated")                                                                            \
  X(vapour_pressure, PRESSURE, "vapour pressure of the fluid")                                                         \
  X(npsh_available, HEAD, "NPSH at the inlet pressure")                                                                \
  X(suction_specific_speed, NUMBER, "suction specific speed nss = n Q^0.5 / NPSH3^0.75")                               \
  X(base_diameter, LENGTH, "volute base circle D3")                                                                    \
  X(inlet_width, LENGTH, "volute inlet width b3")                                                                      \
  X(side_wall_angle, ANGLE, "volute side walls, half angle")                                                           \
  X(swirl_constant, DIFFUSIVITY, "volute swirl K = c_u2 r2")                                                           \
  X(section_speed, SPEED, "volute speed K3 sqrt(2 g H) of the constant velocity law")                                  \
  X(corner_radius, LENGTH, "volute corner radius (0: none)")                                                           \
  X(throat_area, AREA, "volute throat area")                                                                           \
  X(throat_speed, SPEED, "speed in the throat")                                                                        \
  X(tongue_radius, LENGTH, "tongue nose radius")                                                                       \
  X(tongue_tip_radius, LENGTH, "tongue tip, radius from the axis")                                                     \
  X(tongue_angle, ANGLE, "tongue tip, behind the start of the spiral")                                                 \
  X(diffuser_length, LENGTH, "diffuser length")                                                                        \
  X(diffuser_angle, ANGLE, "diffuser, full angle of the cone of equal areas")                                          \
  X(diffuser_area_ratio, NUMBER, "diffuser, area ratio")                                                               \
  X(discharge_diameter, LENGTH, "discharge DN")                                                                        \
  X(discharge_pipe_length, LENGTH, "discharge pipe, length")                                                           \
  X(relative_speed, SPEED, "mean relative speed along the blade")                                                      \
  X(volute_speed, SPEED, "volute speed scale")                                                                         \
  X(suction_speed, SPEED, "suction pipe speed")                                                                        \
  X(discharge_speed, SPEED, "discharge pipe speed")

#define CW_DESIGN_ENUM(member, kind, text) CW_DESIGN_##member,
typedef enum { CW_DESIGN_LIST(CW_DESIGN_ENUM) CW_DESIGN_COUNT } CwDesignQuantity;
#undef CW_DESIGN_ENUM

// A velocity triangle, m/s and rad. The blade's angle and the flow's are from the tangential direction.
typedef struct {
  double radius, u, c_m, c_u, w, c;
  double flow_angle, blade_angle; // of w; of the blade
} CwTriangle;

enum { CW_TRIANGLE_SPANS = 3 }; // hub, mid-span, shroud

#define CW_DESIGN_MEMBER(member, kind, text) double member;
typedef struct {
  int blade_count;
  const char *blade_count_source;
  CwPriority priority; // never CW_PRIORITY_AUTO
  CwCorrelations correlations;
  CwSlip slip;
  CwRotation rotation;
  CwBladeForm blade_form;
  CwTrailingEdge trailing_edge;
  double warn_share, density;
  double unit; // m: of the lengths; 1, but as design_unit.h makes it
  CW_DESIGN_LIST(CW_DESIGN_MEMBER)
  CwTriangle inlet_triangle[CW_TRIANGLE_SPANS];  // with blockage, without swirl
  CwTriangle outlet_triangle[CW_TRIANGLE_SPANS]; // behind the blades, with slip
  CwVolute volute;                               // the casing, for cw_stator_build()
  const char *source[CW_DESIGN_COUNT]; // correlation or "case": static texts, never NULL after cw_hydraulic_design
  double asked[CW_DESIGN_COUNT]; // SI: the case's value, or the same where a word gave way, for `source`; else NAN
} CwDesign;
#undef CW_DESIGN_MEMBER
