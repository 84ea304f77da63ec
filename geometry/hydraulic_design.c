// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/hydraulic_design.h"

#include <math.h>
#include <stdio.h>

#include "geometry/blade.h"
#include "geometry/correlations.h"
#include "geometry/design_source.h"
#include "geometry/design_volute.h"
#include "geometry/impeller_design.h"
#include "geometry/meridian.h"
#include "geometry/meridian_passage.h"
#include "geometry/pump.h"
#include "geometry/root_fillet_size.h"
#include "geometry/velocity_triangles.h"
#include "geometry/viscous_correction.h"
#include "pipeline/water.h"

// The duty point with water to which that of the fluid corresponds.
static void water_duty(const CwCase *table, CwDesign *design) {
  SET(viscosity, table->fluid.kinematic_viscosity, "case or its default");
  const CwViscousCorrection c =
      cw_viscous_selection(design->viscosity, design->flow_rate, design->head, design->angular_speed);
  SET(viscous_parameter, c.parameter, "ANSI/HI 9.6.7: 16.5 nu^0.5 H^0.0625 / (Q^0.375 n^0.25)");
  SET(viscous_head_factor, c.head, "ANSI/HI 9.6.7: exp(-0.165 (lg B)^3.15), over that of water");
  SET(viscous_efficiency_factor, c.efficiency, "ANSI/HI 9.6.7: B^(-0.0547 B^0.69), over that of water");
  SET(water_flow_rate, design->flow_rate / c.head, "Q / C_Q");
  SET(water_head, design->head / c.head, "H / C_H");
}

static void specific_speeds(const CwCase *table, CwDesign *design) {
  const double q = design->water_flow_rate, h = design->water_head, omega = design->angular_speed;
  const double rpm = omega * 30 / M_PI;
  const char *source;
  SET(specific_speed_nq, rpm * sqrt(q) / pow(h, 0.75), "n Q^0.5 / H^0.75 with water, rpm, m3/s, m");
  SET(specific_speed_ns, 3.65 * design->specific_speed_nq, "3.65 nq");
  SET(specific_speed_us, rpm * sqrt(q * 60e12 / 3785411784.0) / pow(h / 0.3048, 0.75), "n Q^0.5 / H^0.75");
  SET(type_number, omega * sqrt(q) / pow(CW_GRAVITY * h, 0.75), "omega Q^0.5 / (g H)^0.75, ISO 2548");
  SET(efficiency, CORRELATED(CW_CORRELATED_EFFICIENCY) * design->viscous_efficiency_factor, source);
  SET(hydraulic_efficiency, CORRELATED(CW_CORRELATED_HYDRAULIC_EFFICIENCY), source);
  SET(shaft_power, table->fluid.density * CW_GRAVITY * design->flow_rate * design->head / design->efficiency,
      "rho g Q H / efficiency");
  SET(shaft_diameter, CORRELATED(CW_CORRELATED_SHAFT_DIAMETER), source);
}

// The least difference of the wraps at shroud and hub with which all sections have a law within the allowed
// angles and blades stand on hub and shroud at 70 degrees or more; where there is none, the one with the
// steepest blades. Cylindrical blades have one wrap.
static void choose_wrap_spread(const CwImpellerTable *given, const CwMeridian *meridian, CwDesign *design) {
  CwBladeSection section;
  const double step = 3 * CW_DEGREE, enough = 70 * CW_DEGREE;
  double best = -1, best_spread = 0;
  TAKE(wrap_spread, given->wrap_spread, 0, "none needed");
  if (design->blade_form == CW_BLADE_CYLINDRICAL && design->wrap_spread != 0)
    GIVE_WAY(wrap_spread, 0, given->wrap_spread,
             "wrap_spread_deg gives way to cylindrical blades, which have one wrap");
  if (cw_case_given(given->wrap_spread) || design->blade_form != CW_BLADE_TWISTED) return;
  for (int i = 0; i <= 40; i++) {
    double angle = 0;
    design->wrap_spread = (i % 2 ? 1 : -1) * ((i + 1) / 2) * step;
    int fits = 1;
    for (int j = 1; fits && j < 4; j++) fits = cw_blade_section(design, meridian, 0.25 * j, &section) == CW_OK;
    fits = fits && cw_blade_wall_angle(design, meridian, &angle) == CW_OK;
    cw_fail_clear();
    if (!fits || angle <= best) continue;
    best = angle;
    best_spread = design->wrap_spread;
    if (angle > enough) break;
  }
  SET(wrap_spread, best_spread,
      best_spread != 0 ? "angles within 12 to 60 deg, steep blades at the walls" : "none needed");
}

// The leading edge's ellipse must end before the blade is thickest, at every span. Fails where a section has no law.
static CwStatus fit_leading_edge(const CwMeridian *meridian, CwDesign *design) {
  enum { SECTIONS = 5 };
  const double room = 0.99;
  CwStatus status = CW_OK;
  CwBladeSection section;
  double share = 1;
  for (int j = 0; j < SECTIONS; j++) {
    CW_TRY(cw_blade_section(design, meridian, (double)j / (SECTIONS - 1), &section));
    share = fmin(share, cw_blade_longest_nose(&section) / section.nose);
    if (!(design->splitter_start > 0)) continue;
    section = cw_blade_splitter(design, &section);
    share = fmin(share, cw_blade_longest_nose(&section) / section.nose);
  }
  if (share < 1 && room * share * design->leading_edge_ratio >= 1)
    GIVE_WAY(leading_edge_ratio, room * share * design->leading_edge_ratio, design->leading_edge_ratio,
             "leading_edge_ratio gives way to an ellipse that ends before the blade is thickest");
done:
  return status;
}

static CwPriority resolved_priority(const CwImpellerTable *given) {
  if (given->priority != CW_PRIORITY_AUTO) return given->priority;
  return cw_case_given(given->wrap_angle)           ? CW_PRIORITY_WRAP
         : cw_case_given(given->outlet_blade_angle) ? CW_PRIORITY_BETA
                                                    : CW_PRIORITY_HEAD;
}

static void passage(const CwMeridian *meridian, CwDesign *design) {
  enum { STEPS = 100 };
  double x[2], dx[2], length = 0;
  CwPassageStation station[STEPS + 1];
  cw_meridian_passage(&meridian->hub, &meridian->shroud, design->outlet_diameter / 2, STEPS + 1, station);
  for (int i = 0; i <= STEPS; i++) {
    cw_meridian_blade_point(meridian, 0.5, (double)i / STEPS, x, dx);
    length += hypot(dx[0], dx[1]) * (i == 0 || i == STEPS ? 0.5 : 1) / STEPS;
  }
  SET(meridional_length, length, "meridian");
  SET(passage_area_eye, station[0].area, "meridian");
  SET(passage_area_inlet, cw_meridian_area(meridian, 0), "meridian");
  SET(passage_area_outlet, cw_meridian_area(meridian, 1), "meridian");
  SET(passage_area_reversal, cw_passage_reversal(station, STEPS + 1), "against its trend from the eye to D2");
  SET(shroud_bend_radius, cw_meridian_bend_radius(&meridian->shroud), "meridian");
}

// What two root fillets facing one another take of a wall on which the blades stand at an angle.
static double fillet_width(double radius, double wall_angle) {
  return 2 * radius / sin(fmax(M_PI / 4, wall_angle));
}

// Between neighbours a quarter of the blade's thickness must be left of hub and shroud beside the root fillets, and a
// part of the blade's height between those on either. Fillets that take more become smaller, to this share of what
// there is room for, and where that leaves narrower faces than a solid may have there are none.
static const double FILLETS_LEFT = 0.95;
static CwStatus fit_root_fillets(const CwMeridian *meridian, double room, CwDesign *design) {
  CwStatus status = CW_OK;
  CwFilletFit fit;
  const double asked = design->root_fillet_radius;
  if (asked == 0) goto done;
  if (room <= 1)
    GIVE_WAY(root_fillet_radius, FILLETS_LEFT * room * asked, asked,
             "root_fillet_radius_mm gives way to a quarter of the blade's thickness left between fillets");
  CW_TRY(cw_root_fillet_fit(design, meridian, &fit));
  if (fit.height_share > CW_ROOT_FILLETS_MOST)
    GIVE_WAY(root_fillet_radius, FILLETS_LEFT * CW_ROOT_FILLETS_MOST / fit.height_share * design->root_fillet_radius,
             asked, "root_fillet_radius_mm gives way to the blade's height between fillets");
  if (fit.chord * design->root_fillet_radius < CW_PUMP_LEAST_FACE * design->outlet_diameter)
    GIVE_WAY(root_fillet_radius, 0, asked, "root_fillet_radius_mm gives way to none: fillets that fit are too narrow");
done:
  return status;
}

static CwStatus make_clearance(const CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  double clear, angle;
  CW_TRY(cw_blade_clearance(design, meridian, &clear));
  CW_TRY(cw_blade_wall_angle(design, meridian, &angle));
  const double least = 0.25 * design->blade_thickness, fillets = fillet_width(design->root_fillet_radius, angle);
  const char *splitters = design->splitter_start > 0 ? " and as many splitters" : "";
  CW_REQUIRE(clear > least, CW_ERR_DESIGN,
             "%d blades%s are %.2f mm apart on hub or shroud; at least %.2f mm are allowed (a quarter of the blade's "
             "thickness): lower blade_count, blade_thickness_mm or the wrap%s",
             design->blade_count, splitters, clear * 1e3, least * 1e3,
             *splitters ? ", or leave splitter_start out" : "");
  CW_TRY(fit_root_fillets(meridian, (clear - least) / fillets, design));
done:
  return status;
}

// Where two root fillets meet round an edge, their feet have corners of half of its wedge. A sharper edge leaves no
// sound triangle there, and nobody casts a fillet round a feather.
static const double LEAST_FILLETED_WEDGE = 30 * M_PI / 180;

// The longest bevel that blades and splitters have room for.
static double bevel_room(const CwBladeSection *blade, CwTrailingEdge edge, const CwDesign *design) {
  const double room = cw_blade_longest_bevel(blade, edge);
  if (!(design->splitter_start > 0)) return room;
  const CwBladeSection splitter = cw_blade_splitter(design, blade);
  return fmin(room, cw_blade_longest_bevel(&splitter, edge));
}

static double usual_bevel(CwTrailingEdge edge, const CwDesign *design) {
  return cw_blade_usual_bevel(edge, design->trailing_edge_thickness, design->outlet_blade_angle);
}

// The acute corner of a blunt edge has the blade angle as its wedge, a sharp edge less.
static CwStatus trailing_edge(const CwImpellerTable *given, const CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  const CwTrailingEdge edge = given->trailing_edge;
  const int blunt = edge == CW_EDGE_BLUNT, sharp = edge == CW_EDGE_SHARP;
  CwBladeSection blade;
  CW_TRY(cw_blade_section(design, meridian, 0.5, &blade));
  design->trailing_edge = edge;
  const double usual = usual_bevel(edge, design), room = bevel_room(&blade, edge, design);
  TAKE(trailing_edge_bevel, given->trailing_edge_bevel, fmin(usual, room),
       room < usual ? "as far as the blade has room for it"
       : sharp      ? "leg along the blade twice the cut"
                    : "as long as the rest of the trailing edge");
  if (blunt || edge == CW_EDGE_ROUNDED) {
    SET(trailing_edge_bevel, 0, "none: blunt or rounded edge");
    if (cw_case_given(given->trailing_edge_bevel))
      GIVE_WAY(trailing_edge_bevel, 0, given->trailing_edge_bevel,
               "trailing_edge_bevel_mm gives way to a blunt or rounded trailing edge");
  }
  if (design->root_fillet_radius > 0 && (sharp || (blunt && design->outlet_blade_angle < LEAST_FILLETED_WEDGE))) {
    design->trailing_edge = CW_EDGE_BEVELLED;
    GIVE_WAY(trailing_edge_bevel,
             fmin(usual_bevel(CW_EDGE_BEVELLED, design), bevel_room(&blade, CW_EDGE_BEVELLED, design)),
             blunt ? 0 : design->trailing_edge_bevel,
             blunt ? "trailing_edge blunt gives way to bevelled: root fillets need a wedge of 30 deg"
                   : "trailing_edge sharp gives way to bevelled: root fillets need a wedge of 30 deg");
  }
done:
  return status;
}

// All of the design behind the duty point.
static CwStatus pump(const CwCase *table, CwDesign *design) {
  CwStatus status = CW_OK;
  CwMeridian meridian;
  CW_TRY(cw_impeller_design(table, &meridian, design));
  choose_wrap_spread(&table->impeller, &meridian, design);
  CW_TRY(fit_leading_edge(&meridian, design));
  CW_TRY(make_clearance(&meridian, design));
  passage(&meridian, design);
  CW_TRY(cw_velocity_triangles(&meridian, table->operating_point.inlet_pressure, design));
  CW_TRY(trailing_edge(&table->impeller, &meridian, design));
  CW_TRY(cw_design_volute(&table->volute, design));
  const double r2 = design->outlet_diameter / 2, r3 = design->base_diameter / 2;
  SET(relative_speed, 0.5 * (design->inlet_relative_speed + design->outlet_relative_speed), "(w1 + w2) / 2");
  SET(volute_speed, 0.5 * (design->outlet_swirl_speed * r2 / r3 + design->throat_speed),
      "mean of K / r3 and the throat's speed");
  const double shaft = design->through_shaft_diameter;
  SET(suction_speed, design->flow_rate / (M_PI / 4 * (pow(design->inlet_diameter, 2) - pow(shaft, 2))),
      shaft > 0 ? "Q / (pi (D1^2 - shaft^2) / 4)" : "Q / (pi D1^2 / 4)");
  SET(discharge_speed, design->flow_rate / (M_PI / 4 * pow(design->discharge_diameter, 2)), "Q / (pi DN^2 / 4)");
done:
  return status;
}

// A given D3 that leaves an open D2 no room for the head gives way.
static CwStatus pump_of_any_base(const CwCase *table, CwDesign *design) {
  const double given = table->volute.base_diameter;
  const CwDesign before = *design;
  CwStatus status = pump(table, design);
  if (status != CW_ERR_DESIGN || !cw_case_given(given) || cw_case_given(table->impeller.outlet_diameter)) return status;
  char refused[1000];
  CwCase trial = *table;
  snprintf(refused, sizeof refused, "%s", cw_fail_message());
  cw_fail_clear();
  trial.volute.base_diameter = NAN;
  *design = before;
  if (pump(&trial, design) != CW_OK) return CW_FAIL(status, "%s", refused);
  GIVE_WAY(base_diameter, design->base_diameter, given, "base_diameter_mm gives way to a wheel for the head");
  return CW_OK;
}

// A given wrap with which no pump can be had gives way, unless the priority is the wrap: to the nearest, in steps, of
// a quarter of it to four times.
static CwStatus pump_of_nearest_wrap(const CwCase *table, CwDesign *design) {
  enum { STEPS = 12 };
  const double step = 1.12, given = table->impeller.wrap_angle;
  const CwDesign before = *design;
  CwCase trial = *table;
  char refused[1000];
  CwStatus status = pump_of_any_base(table, design);
  if (status != CW_ERR_DESIGN || !cw_case_given(given) || table->impeller.priority != CW_PRIORITY_AUTO) return status;
  snprintf(refused, sizeof refused, "%s", cw_fail_message());
  for (int i = 2; status == CW_ERR_DESIGN && i <= 2 * STEPS + 1; i++) {
    cw_fail_clear();
    *design = before;
    trial.impeller.wrap_angle = given * pow(step, (i % 2 ? 1 : -1) * (i / 2));
    status = pump_of_any_base(&trial, design);
  }
  if (status != CW_OK) return CW_FAIL(status, "%s", refused);
  GIVE_WAY(wrap_angle, trial.impeller.wrap_angle, given, "wrap_angle_deg gives way to the nearest that can be built");
  SET(wrap_residual, design->wrap_angle - given, "wrap - table's wrap");
  return CW_OK;
}

// A wrap that follows from the blade angles, with which a passage would wind round the axis by more than a solid can
// have, becomes the greatest with which none does, where the head has priority; the blade angles follow it. Where no
// pump of that wrap meets the head the first one stays, for the geometry to refuse.
static CwStatus pump_within_a_revolution(const CwCase *table, CwDesign *design) {
  enum { STEPS = 8 };
  const double closeness = 0.99;
  const CwDesign before = *design;
  const CwStatus status = pump_of_nearest_wrap(table, design);
  if (status != CW_OK || before.priority != CW_PRIORITY_HEAD) return status;
  const CwDesign wound = *design;
  CwCase trial = *table;
  for (int i = 0, made = 1; i < STEPS && (!made || cw_design_meets_head(design)); i++) {
    CwMeridian meridian;
    CwBladeSeams seams;
    if (made) {
      if (cw_meridian_make(design, &meridian) != CW_OK || cw_blade_seams(design, &meridian, &seams) != CW_OK) break;
      if (seams.reach <= CW_SEAM_REACH_MOST) {
        if (i > 0) design->source[CW_DESIGN_wrap_angle] = CW_WRAP_WITHIN_A_REVOLUTION;
        return CW_OK;
      }
      trial.impeller.wrap_angle =
          closeness * design->wrap_angle * (1 - (seams.reach - CW_SEAM_REACH_MOST) / seams.foremost);
    } else { // no blade angles lead to so great a wrap
      trial.impeller.wrap_angle *= closeness;
    }
    *design = before;
    design->priority = CW_PRIORITY_WRAP;
    made = pump_of_any_base(&trial, design) == CW_OK;
    if (!made) cw_fail_clear();
  }
  cw_fail_clear();
  *design = wound;
  return CW_OK;
}

CwStatus cw_hydraulic_design(const CwCase *table, CwDesign *design) {
  *design = (CwDesign){.priority = resolved_priority(&table->impeller),
                       .correlations = table->design.correlations,
                       .slip = table->design.slip,
                       .rotation = table->impeller.rotation,
                       .blade_form = table->impeller.blade_form,
                       .trailing_edge = table->impeller.trailing_edge,
                       .warn_share = table->design.warn_share,
                       .density = table->fluid.density,
                       .unit = 1};
  SET(flow_rate, table->operating_point.flow_rate, "case");
  SET(head, table->operating_point.head, "case");
  SET(angular_speed, table->operating_point.speed, "case");
  const double vapour = table->fluid.vapour_pressure;
  SET(vapour_pressure, cw_case_given(vapour) ? vapour : cw_water_vapour_pressure(20), "case, or that of water (IAPWS)");
  water_duty(table, design);
  specific_speeds(table, design);
  return pump_within_a_revolution(table, design);
}
