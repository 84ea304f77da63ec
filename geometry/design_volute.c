// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_volute.h"

#include <math.h>
#include <stdio.h>

#include "geometry/design_source.h"
#include "geometry/volute_diffuser.h"
#include "geometry/volute_design.h"
#include "geometry/volute_section.h"

// Least radius of the tongue's tip over r2: Guelich's 1.03 + 0.1 nq/40 + 0.07 rho H/(1000 kg/m3 1000 m), within the
// usual 1.05 to 1.2.
static const double LEAST_CUTWATER = 1.05, LARGEST_CUTWATER = 1.2;
static double cutwater_ratio(const CwDesign *design) {
  const double guelich =
      1.03 + 0.1 * design->specific_speed_nq / 40 + 0.07 * design->density / 1000 * design->head / 1000;
  return fmin(LARGEST_CUTWATER, fmax(LEAST_CUTWATER, guelich));
}

// The volute with the design's b3, side walls and tongue.
static CwStatus volute_of(const CwVoluteTable *given, CwDesign *design) {
  CwStatus status = CW_OK;
  const double r2 = design->outlet_diameter / 2, r3 = design->base_diameter / 2;
  const int rectangle = given->section == CW_SECTION_RECTANGLE;
  if (rectangle) SET(side_wall_angle, 0, "rectangle");
  // Stepanoff's chart of K3 over specific speed: about 0.48 at nq 10, 0.42 at 20, 0.36 at 40, as commonly quoted, not
  // held against the chart.
  const double factor =
      cw_case_given(given->velocity_factor) ? given->velocity_factor : 0.42 * pow(design->specific_speed_nq / 20, -0.2);
  SET(section_speed, factor * sqrt(2 * CW_GRAVITY * design->water_head),
      cw_case_given(given->velocity_factor) ? "case: K3" : "Stepanoff: K3 = 0.42 (nq / 20)^-0.2");
  // A plain trapezoid is near enough to see how wide the throat will be.
  const int velocity = given->area_law == CW_AREA_LAW_VELOCITY;
  const double b3 = design->inlet_width, slope = tan(design->side_wall_angle);
  const double spiral =
      cw_volute_trapezoid_height(r3, b3, design->side_wall_angle, design->water_flow_rate / design->swirl_constant);
  const double area = velocity ? design->water_flow_rate / design->section_speed : spiral * (b3 + spiral * slope);
  const double height = 2 * area / (b3 + sqrt(b3 * b3 + 4 * slope * area));
  TAKE(corner_radius, given->corner_radius, rectangle ? fmin(b3, height) / 6 : 0,
       rectangle ? "a sixth of b3 or of the throat's height" : "one arc");
  if (!cw_case_given(given->tongue_radius) && design->tongue_radius > height / 6)
    SET(tongue_radius, height / 6, "a sixth of the throat's height");
  const int chosen = !cw_case_given(given->tongue_gap) && !cw_case_given(given->tongue_angle);
  const CwVoluteInput input = {
      .flow_rate = design->water_flow_rate,
      .pipe_flow_rate = design->flow_rate,
      .area_law = given->area_law,
      .angular_momentum = design->swirl_constant,
      .section_speed = design->section_speed,
      .section = given->section,
      .corner_radius = design->corner_radius > 0 ? design->corner_radius : NAN,
      .interface_radius = design->interface_radius,
      .neck_width = design->outlet_width,
      .base_diameter = design->base_diameter,
      .inlet_width = design->inlet_width,
      .side_wall_angle = design->side_wall_angle,
      .throat_area = given->throat_area,
      .tongue_radius = design->tongue_radius,
      .tongue_gap = given->tongue_gap,
      .tongue_angle = given->tongue_angle,
      .tongue_gap_range = {chosen ? fmax(0, r2 * cutwater_ratio(design) - r3) : NAN,
                           chosen ? fmax(0, r2 * LARGEST_CUTWATER - r3) : NAN},
      .diffuser_length = given->diffuser_length,
      .diffuser_angle = cw_case_given(given->diffuser_angle) ? given->diffuser_angle : CW_DIFFUSER_ANGLE,
      .outlet_diameter = given->outlet_diameter,
      .diffuser_area_ratio = given->diffuser_area_ratio,
      .discharge = given->discharge,
      .discharge_pipe_length = given->discharge_pipe_length,
  };
  CW_TRY(cw_volute_design(&input, &design->volute));
done:
  return status;
}

// Mean width of the throat along the axis over its height: at 3 and more the diffuser's corners curl on their way from
// the flat throat to the circle.
static const double FLATTEST_THROAT = 2.9, LEAST_SIDE_WALL = 8 * M_PI / 180;
static double flatness(const CwVolute *volute) {
  return volute->throat_area / (volute->throat_width * volute->throat_width);
}

// The volute with b3 and side walls widened in steps as far as they may be, until its spiral can be built, which would
// else be too tall.
static CwStatus widened(const CwVoluteTable *given, double tongue, int width_open, int side_open, CwDesign *design) {
  enum { STEPS = 12, WIDTH_STEPS = 8 };
  CwStatus status = CW_ERR_DESIGN;
  CwVoluteTable wider = *given;
  const int parallel = given->section == CW_SECTION_RECTANGLE;
  const double width = design->inlet_width, widest = fmin(2.4 * design->outlet_width, 0.38 * design->base_diameter);
  if (parallel && side_open) wider.section = CW_SECTION_TRAPEZOID;
  for (int i = 1; status == CW_ERR_DESIGN && i <= STEPS; i++) {
    const double to = width + fmax(0, widest - width) * fmin(1, (double)i / WIDTH_STEPS), angle = (20 + i) * CW_DEGREE;
    cw_fail_clear();
    if (!cw_case_given(given->tongue_radius)) SET(tongue_radius, tongue, "0.0075 D2: casting");
    if (width_open && cw_case_given(given->inlet_width))
      GIVE_WAY(inlet_width, to, given->inlet_width, "inlet_width_mm gives way to a spiral that can be built");
    else if (width_open)
      SET(inlet_width, to, "widened for a spiral that can be built");
    if (side_open && parallel)
      GIVE_WAY(side_wall_angle, angle, 0, "section rectangle gives way to a spiral that can be built");
    else if (side_open && cw_case_given(given->side_wall_angle))
      GIVE_WAY(side_wall_angle, fmax(angle, given->side_wall_angle), given->side_wall_angle,
               "side_wall_angle_deg gives way to a spiral that can be built");
    else if (side_open)
      SET(side_wall_angle, angle, "widened for a spiral that can be built");
    status = volute_of(&wider, design);
  }
  return status;
}

// Given walls that no volute can have give way to the least that it can.
static void least_walls(const CwVoluteTable *given, CwDesign *design) {
  const double slack = 1 - 1e-9, least = design->outlet_width + CW_VOLUTE_LEAST_STEP * design->base_diameter;
  if (given->side_wall_angle < slack * CW_VOLUTE_LEAST_SIDE_WALL)
    GIVE_WAY(side_wall_angle, CW_VOLUTE_LEAST_SIDE_WALL, given->side_wall_angle,
             "side_wall_angle_deg gives way to the least of 5 deg");
  if (design->inlet_width >= slack * least) return;
  if (cw_case_given(given->inlet_width))
    GIVE_WAY(inlet_width, least, given->inlet_width, "inlet_width_mm gives way to the least of b2 + 0.005 D3");
  else
    SET(inlet_width, least, "b2 + 0.005 D3: the least");
}

// Where the usual volute has no solution, what is open of it yields: at high specific speed b3 and the side walls,
// which else would make the spiral too tall, at low specific speed the tongue's radius, which is too large for its
// throat. Then given side walls yield, and at last a given b3. Nothing yields where that could not help.
static CwStatus volute_that_fits(const CwVoluteTable *given, int width_open, int side_open, CwDesign *design) {
  const double tongue = 0.0075 * design->outlet_diameter;
  char first[1000];
  SET(swirl_constant, design->outlet_swirl_speed * design->outlet_diameter / 2, "c_u2 r2");
  TAKE(side_wall_angle, given->side_wall_angle, 20 * CW_DEGREE, "20 deg: full angle 40, usual 30 to 45");
  TAKE(tongue_radius, given->tongue_radius, tongue, "0.0075 D2: casting");
  least_walls(given, design);
  CwStatus status = volute_of(given, design);
  snprintf(first, sizeof first, "%s", cw_fail_message());
  const CwVoluteHelp help = design->volute.help;
  const int thinner = help != CW_VOLUTE_OTHER_INPUT && !cw_case_given(given->tongue_radius);
  for (int i = 1; status == CW_ERR_DESIGN && i <= 5 && thinner; i++) {
    cw_fail_clear();
    SET(tongue_radius, tongue * pow(0.75, i), "0.0075 D2, reduced for the small throat");
    status = volute_of(given, design);
  }
  const CwDesign before = *design;
  for (int more = 0; status == CW_ERR_DESIGN && help == CW_VOLUTE_WIDER_SPIRAL && more < 3; more++) {
    *design = before;
    if ((more == 0 && !width_open && !side_open) || (more == 1 && side_open) || (more == 2 && width_open)) continue;
    status = widened(given, tongue, width_open || more == 2, side_open || more >= 1, design);
  }
  return status == CW_ERR_DESIGN ? CW_FAIL(status, "%s", first) : status;
}

// The tongue came as near to the given place as the spiral allows.
static void place_of_tongue(const CwVoluteTable *given, CwDesign *design) {
  const double r3 = design->base_diameter / 2, gap = given->tongue_gap, angle = given->tongue_angle;
  const double tip = design->volute.tip_radius, at = design->volute.tip_angle;
  SET(tongue_tip_radius, tip,
      cw_case_given(gap) ? "case: D3/2 + tongue gap"
      : cw_case_given(angle)
          ? "where its angle leads to"
          : "well shaped, from Guelich's r2 (1.03 + 0.1 nq/40 + 0.07 rho H/(1000 kg/m3 1000 m)) to 1.2 r2");
  if (cw_case_given(gap) && fabs(tip - r3 - gap) > CW_VOLUTE_TONGUE_SLACK * r3)
    GIVE_WAY(tongue_tip_radius, tip, r3 + gap, "tongue_gap_mm gives way to the nearest tongue that the spiral allows");
  SET(tongue_angle, at, cw_case_given(angle) ? "case" : "where its gap asks for it");
  if (cw_case_given(angle) && fabs(at - angle) > CW_VOLUTE_TONGUE_SLACK)
    GIVE_WAY(tongue_angle, at, angle, "tongue_angle_deg gives way to the nearest that the spiral allows");
}

// The volute with walls that were changed; where it has none, the design becomes the one before, which ends the steps.
static CwStatus next_step(const CwVoluteTable *given, const CwDesign *before, CwDesign *design, int *goes_on) {
  const CwStatus status = volute_of(given, design);
  *goes_on = status == CW_OK;
  if (status != CW_ERR_DESIGN) return status;
  cw_fail_clear();
  *design = *before;
  return CW_OK;
}

// Narrows an open b3, then closes open side walls, in steps until the throat is not too flat, or as far as there is a
// volute.
static CwStatus raise_throat(const CwVoluteTable *given, int width_open, int side_open, CwDesign *design) {
  CwStatus status = CW_OK;
  const double narrowest = 1.001 * (design->outlet_width + CW_VOLUTE_LEAST_STEP * design->base_diameter);
  int narrows = width_open, closes = side_open;
  while (narrows && flatness(&design->volute) > FLATTEST_THROAT && design->inlet_width > narrowest) {
    const CwDesign before = *design;
    SET(inlet_width, fmax(narrowest, 0.9 * design->inlet_width), "narrowed for a throat that is not too flat");
    CW_TRY(next_step(given, &before, design, &narrows));
  }
  while (closes && flatness(&design->volute) > FLATTEST_THROAT && design->side_wall_angle > LEAST_SIDE_WALL) {
    const CwDesign before = *design;
    SET(side_wall_angle, fmax(LEAST_SIDE_WALL, design->side_wall_angle - 2 * CW_DEGREE),
        "less open for a throat that is not too flat");
    CW_TRY(next_step(given, &before, design, &closes));
  }
done:
  return status;
}

CwStatus cw_design_volute(const CwVoluteTable *given, CwDesign *design) {
  CwStatus status = CW_OK;
  const int width_open = !cw_case_given(given->inlet_width);
  const int side_open = !cw_case_given(given->side_wall_angle) && given->section != CW_SECTION_RECTANGLE;
  CW_TRY(volute_that_fits(given, width_open, side_open, design));
  CW_TRY(raise_throat(given, width_open, side_open, design));
  TAKE(throat_area, given->throat_area, design->volute.throat_area,
       given->area_law == CW_AREA_LAW_VELOCITY ? "constant velocity" : "constant angular momentum K");
  SET(throat_speed, design->flow_rate / design->throat_area, "Q / throat area");
  place_of_tongue(given, design);
  TAKE(discharge_diameter, given->outlet_diameter, design->volute.input.outlet_diameter,
       cw_case_given(given->diffuser_area_ratio) ? "area ratio of the diffuser"
                                                 : "standard bore, area ratio 1.5 to 3, under 4 m/s where that allows");
  TAKE(discharge_pipe_length, given->discharge_pipe_length, design->volute.input.discharge_pipe_length, "2 DN");
  TAKE(diffuser_length, given->diffuser_length, design->volute.diffuser_length,
       cw_case_given(given->diffuser_angle) ? "full angle of the case" : "full angle 9 deg");
  SET(diffuser_area_ratio, design->volute.diffuser_area_ratio,
      cw_case_given(given->diffuser_area_ratio) ? "case" : "outlet over throat");
  SET(diffuser_angle, design->volute.diffuser_angle, "cone of equal areas");
done:
  return status;
}
