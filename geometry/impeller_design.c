// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/impeller_design.h"

#include <math.h>

#include "geometry/blade.h"
#include "geometry/correlations.h"
#include "geometry/design_source.h"
#include "geometry/meridian_passage.h"
#include "geometry/meridian_shape.h"
#include "geometry/velocity_triangles.h"

// D3 over D2 at least, where D3 is given and D2 is not; usual are 1.03 to 1.08.
static const double LEAST_BASE = 1.02;

// Of a given D1, where the hub is open: more than half of the eye is left.
static const double LARGEST_HUB_IN_EYE = 0.65;

static double largest_outlet_diameter(const CwCase *table) {
  return cw_case_given(table->volute.base_diameter) ? table->volute.base_diameter / LEAST_BASE : INFINITY;
}

// Of D1: from the inlet to the hub, at least, where the pipe's length is open.
static const double LEAST_BEFORE_HUB = 1.0 / 24;

// Blades this thick at 30 degrees leave 0.3 of the circumference of D1.
static double largest_leading_edge(const CwDesign *design) {
  return 0.7 * M_PI * design->inlet_diameter * sin(30 * CW_DEGREE) / design->blade_count;
}

// Nut and shaft. A shaft as thick as the hub leaves no nut.
static void hub_end(const CwImpellerTable *given, CwDesign *design) {
  const double shaft = given->through_shaft_diameter;
  SET(through_shaft_diameter, fmin(shaft, design->hub_diameter), shaft > 0 ? "case" : "none");
  if (shaft > 0 && shaft > (1 - 1e-9) * design->hub_diameter) {
    SET(nut_length, 0, "none: the shaft is as thick as the hub");
    SET(nut_disk_radius, design->hub_diameter / 2, "the shaft's");
    if (cw_case_given(given->nut_length))
      GIVE_WAY(nut_length, 0, given->nut_length, "hub_nut_length_mm gives way to a shaft as thick as the hub");
  } else {
    TAKE(nut_length, given->nut_length, 7.0 / 12 * (design->hub_diameter - shaft),
         shaft > 0 ? "7/12 of the hub's diameter over the shaft's" : "7/12 hub diameter");
    TAKE(nut_disk_radius, shaft > 0 ? shaft / 2 : given->nut_flat_diameter / 2, 0.145 * design->hub_diameter,
         "0.145 hub diameter");
  }
  if (shaft > 0 && cw_case_given(given->nut_flat_diameter))
    GIVE_WAY(nut_disk_radius, design->nut_disk_radius, given->nut_flat_diameter / 2,
             "hub_nut_flat_diameter_mm gives way to the shaft through the inlet");
}

static void main_dimensions(const CwCase *table, double outlet_diameter, CwDesign *design) {
  const CwImpellerTable *given = &table->impeller;
  const char *source;
  const double largest = largest_outlet_diameter(table);
  double value = CORRELATED(CW_CORRELATED_OUTLET_DIAMETER);
  TAKE(outlet_diameter, given->outlet_diameter, fmin(value, largest), value > largest ? "D3 / 1.02" : source);
  if (cw_case_given(outlet_diameter))
    SET(outlet_diameter, outlet_diameter, "meets the head with the outlet blade angle");
  const double d2 = design->outlet_diameter, nq = design->specific_speed_nq;
  value = CORRELATED(CW_CORRELATED_HUB_DIAMETER);
  if (value > LARGEST_HUB_IN_EYE * given->inlet_diameter) { // not where that is left out
    value = LARGEST_HUB_IN_EYE * given->inlet_diameter;
    source = "at most 0.65 of the given D1";
  }
  if (value < given->through_shaft_diameter) {
    value = given->through_shaft_diameter;
    source = "that of the shaft through the inlet";
  }
  TAKE(hub_diameter, given->hub_diameter, value, source);
  TAKE(outlet_width, given->outlet_width, CORRELATED(CW_CORRELATED_OUTLET_WIDTH), source);
  SET(impeller_tip_speed, design->angular_speed * d2 / 2, "omega D2 / 2");
  SET(head_coefficient, 2 * CW_GRAVITY * design->water_head / pow(design->impeller_tip_speed, 2), "2 g H / u2^2");
  value = CORRELATED(CW_CORRELATED_INLET_DIAMETER);
  TAKE(inlet_diameter, given->inlet_diameter, fmin(value, 0.78 * d2), value > 0.78 * d2 ? "at most 0.78 D2" : source);
  const double d1 = design->inlet_diameter;
  TAKE(axial_length, given->axial_length, (d2 - d1) * pow(nq / 74, 1.07), "Guelich: (D2 - D1) (nq/74)^1.07");
  hub_end(given, design);
  SET(root_fillet_radius, given->root_fillet_radius, "case or its default");
  value = CORRELATED(CW_CORRELATED_BLADE_COUNT);
  design->blade_count = given->blade_count ? given->blade_count : (int)value;
  design->blade_count_source = given->blade_count ? "case" : source;
  TAKE(blade_thickness, given->blade_thickness, CORRELATED(CW_CORRELATED_BLADE_THICKNESS), source);
  const double room = 0.5 * largest_leading_edge(design);
  value = 0.70 * design->blade_thickness;
  TAKE(leading_edge_thickness, given->leading_edge_thickness, fmin(value, room),
       value > room ? "leaves two thirds of the inlet open" : "0.70 of the largest");
  TAKE(trailing_edge_thickness, given->trailing_edge_thickness, 0.50 * design->blade_thickness, "0.50 of the largest");
  const double nut = fmax(1.2 * design->nut_length, design->nut_length + LEAST_BEFORE_HUB * d1);
  TAKE(suction_pipe_length, given->suction_pipe_length,
       fmax(d1 / 3, nut - design->outlet_width + (CW_MERIDIAN_HUB_START - 1) * design->axial_length),
       "D1 / 3, past the nut");
  TAKE(base_diameter, table->volute.base_diameter, CORRELATED(CW_CORRELATED_BASE_DIAMETER), source);
  TAKE(inlet_width, table->volute.inlet_width, CORRELATED(CW_CORRELATED_INLET_WIDTH), source);
  const int splitters = cw_case_given(given->splitter_start);
  SET(splitter_start, splitters ? given->splitter_start : 0, splitters ? "case" : "none");
  SET(splitter_position, given->splitter_position, "case or its default");
  SET(leading_edge_ratio, given->leading_edge_ratio, "case or its default");
  SET(thickest_at, given->thickest_at, "case or its default");
  SET(lean_angle, given->lean_angle, "case or its default");
  TAKE(wrap_angle, given->wrap_angle, 1.2 * 2 * M_PI / design->blade_count, "overlap 1.2");
  SET(wrap_spread, 0, "none");
  SET(interface_radius, (d2 + design->base_diameter) / 4, "(D2 + D3) / 4");
}

static const double FARTHEST_OPEN_EDGE = 5.0 / 6; // of D2/2: an open leading edge on the shroud
static const double EYE_SHARE = 0.05; // of the eye's height: least distance of the leading edge from the eye's plane

// The leading edge on the shroud: outside the eye at low specific speed, and drawn into it above nq = 25, where the
// wheel turns mixed-flow and the blades would else become too short.
// A cylindrical blade stays outside, where the shroud has turned to the radius and the blade stands on it, but leaves
// itself a length.
static void leading_edge_shroud(const CwImpellerTable *given, CwDesign *design) {
  const double drawn_in =
      design->blade_form == CW_BLADE_CYLINDRICAL ? 0 : fmin(1, fmax(0, (design->specific_speed_nq - 25) / 35));
  const double share = 0.635 - 0.105 * drawn_in;
  const double radius = share * design->inlet_diameter, farthest = FARTHEST_OPEN_EDGE * design->outlet_diameter / 2;
  TAKE(leading_edge_radius_shroud, given->leading_edge_radius_shroud, fmin(radius, farthest),
       radius > farthest ? "leaves a sixth of D2 to the blade"
       : share < 0.635   ? "0.635 D1 to 0.53 D1 at nq 60"
                         : "0.635 D1");
}

// A leading edge that is given at the eye's radius or inside it begins just behind the plane where the wall begins,
// which is parallel to the axis there.
static void keep_behind_eye(const CwMeridianCurve *wall, double height, const char *source, double *radius,
                            const char **radius_source) {
  double x[2], begin[2];
  double low = 0, high = 1;
  cw_meridian_point(wall, 0, begin, NULL);
  for (int i = 0; i < 50; i++) {
    const double middle = 0.5 * (low + high);
    cw_meridian_point(wall, middle, x, NULL);
    *(hypot(x[0] - begin[0], x[1] - begin[1]) < EYE_SHARE * height ? &low : &high) = middle;
  }
  cw_meridian_point(wall, high, x, NULL);
  if (*radius >= x[0]) return;
  *radius = x[0];
  *radius_source = source;
}

// On the hub: where a line square to the flow leads to from the shroud, but not so near to the axis that the blade
// would stand too steep there. Of a cylindrical blade the edge is as parallel to the axis as the blade: on another the
// blade angle would lean it over in the direction of rotation. The passage's height is that of the line.
static void leading_edge_hub(const CwImpellerTable *given, CwDesign *design) {
  CwMeridianCurve hub, shroud;
  cw_meridian_walls(design, design->hub_pole_radial, design->shroud_pole_axial, design->shroud_pole_radial, &hub,
                    &shroud);
  const double height = 0.5 * (design->inlet_diameter - design->hub_diameter);
  static const char *const at_eye = "at the eye: 0.05 of its height behind its plane";
  keep_behind_eye(&shroud, height, at_eye, &design->leading_edge_radius_shroud,
                  &design->source[CW_DESIGN_leading_edge_radius_shroud]);
  const CwPassageStation edge = cw_meridian_passage_at(&hub, &shroud, design->leading_edge_radius_shroud);
  if (design->blade_form == CW_BLADE_CYLINDRICAL)
    TAKE(leading_edge_radius_hub, given->leading_edge_radius_hub, design->leading_edge_radius_shroud,
         "parallel to the axis, as the blade");
  else
    TAKE(leading_edge_radius_hub, given->leading_edge_radius_hub,
         fmax(edge.hub[0], fmax(0.56 * design->hub_diameter, 0.55 * design->leading_edge_radius_shroud)),
         "square to the flow from the shroud's, at least 0.56 hub diameters and 0.55 of the shroud's");
  keep_behind_eye(&hub, height, at_eye, &design->leading_edge_radius_hub,
                  &design->source[CW_DESIGN_leading_edge_radius_hub]);
  SET(inlet_passage_width, edge.height, "square to the flow from the shroud's leading edge");
}

// Wrap of the straight law beta1 to beta2 at mid-span.
static double straight_wrap(const CwMeridian *meridian, double beta1, double beta2) {
  const double beta[3] = {beta1, 0.5 * (beta1 + beta2), beta2};
  return cw_blade_wrap(meridian, 0.5, beta);
}

// Of a computed beta2 where D2 is open, and so can meet the head instead.
static const double usual_beta[2] = {18 * M_PI / 180, 32 * M_PI / 180};

int cw_design_meets_head(const CwDesign *design) {
  return fabs(design->head_residual) < 1e-6 * design->head;
}

// Sets beta2 and the wrap by the priority. `fixed`: the outlet blade angle where D2 meets the head, or NAN.
static CwStatus outlet_angle(const CwCase *table, const CwMeridian *meridian, double fixed, CwDesign *design) {
  CwStatus status = CW_OK;
  const double given = table->impeller.outlet_blade_angle, beta1 = design->inlet_blade_angle;
  const double table_wrap = table->impeller.wrap_angle, least = cw_allowed_beta[0], largest = cw_allowed_beta[1];
  double low = least, high = largest;
  if (design->priority == CW_PRIORITY_BETA) {
    TAKE(outlet_blade_angle, given, 25 * CW_DEGREE, "25 deg: middle of the usual 18 to 32");
    SET(wrap_angle, straight_wrap(meridian, beta1, design->outlet_blade_angle), "straight law beta1 to beta2");
  } else if (design->priority == CW_PRIORITY_HEAD) {
    const double solved =
        cw_case_given(fixed) ? fixed : cw_outlet_angle_for_head(meridian, cw_allowed_beta, usual_beta, design);
    SET(outlet_blade_angle, solved,
        cw_case_given(fixed)           ? "limit of the usual 18 to 32 deg; D2 meets the head"
        : cw_design_meets_head(design) ? "solved for the head"
                                       : "nearest to the head of 12 to 60 deg");
    SET(wrap_angle, straight_wrap(meridian, beta1, design->outlet_blade_angle), "straight law beta1 to beta2");
  } else {
    for (int i = 0; i < 60; i++) {
      const double middle = 0.5 * (low + high);
      *(straight_wrap(meridian, beta1, middle) > design->wrap_angle ? &low : &high) = middle;
    }
    const double solved = 0.5 * (low + high);
    TAKE(outlet_blade_angle, given, solved, "straight law beta1 to beta2 closes the wrap");
    CW_REQUIRE(
        cw_case_given(given) || (solved > least + 1e-6 && solved < largest - 1e-6), CW_ERR_DESIGN,
        "a wrap of %.2f deg with beta1 = %.2f deg asks for an outlet blade angle outside 12 to 60 deg; allowed "
        "with that beta1: wrap_angle_deg of %.2f to %.2f; or change inlet_blade_angle_deg or the leading edge radii",
        design->wrap_angle / CW_DEGREE, beta1 / CW_DEGREE, straight_wrap(meridian, beta1, largest) / CW_DEGREE,
        straight_wrap(meridian, beta1, least) / CW_DEGREE);
  }
  SET(wrap_residual, cw_case_given(table_wrap) ? design->wrap_angle - table_wrap : 0, "wrap - table's wrap");
  SET(outlet_angle_residual, cw_case_given(given) ? design->outlet_blade_angle - given : 0, "beta2 - table's beta2");
  SET(overlap, design->blade_count * design->wrap_angle / (2 * M_PI), "z wrap / 360 deg");
  cw_outlet_triangle(meridian, design);
done:
  return status;
}

// Everything up to the predicted head, with the given outlet diameter and outlet blade angle or NAN for each. The walls
// of the meridian are shaped anew where `shape` is set, and else keep their shares.
static CwStatus impeller(const CwCase *table, double outlet_diameter, double fixed, int shape, CwMeridian *meridian,
                         CwDesign *design) {
  CwStatus status = CW_OK;
  main_dimensions(table, outlet_diameter, design);
  CW_REQUIRE(design->leading_edge_thickness < largest_leading_edge(design), CW_ERR_DESIGN,
             "%d blades of leading_edge_thickness_mm %.2f fill the inlet of %.1f mm: lower it to %.2f, or lower "
             "blade_count",
             design->blade_count, design->leading_edge_thickness * 1e3, design->inlet_diameter * 1e3,
             0.5e3 * largest_leading_edge(design));
  leading_edge_shroud(&table->impeller, design);
  if (shape) cw_meridian_shape(&table->impeller, design);
  leading_edge_hub(&table->impeller, design);
  CW_TRY(cw_meridian_make(design, meridian));
  cw_inlet_triangle(table, meridian, design);
  CW_TRY(outlet_angle(table, meridian, fixed, design));
done:
  return status;
}

// Solves an open D2 for the head, from the correlation's value on, with the given outlet blade angle or NAN.
static CwStatus outlet_diameter_for_head(const CwCase *table, double fixed, CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  const double largest = largest_outlet_diameter(table), correlated = design->outlet_diameter;
  // Twice, since the walls are shaped for a diameter that then changes.
  for (int pass = 0; pass < 2; pass++) {
    double low = 0.7 * correlated, high = fmin(3 * correlated, largest);
    CW_TRY(impeller(table, design->outlet_diameter, fixed, 1, meridian, design));
    for (int i = 0; i < 50; i++) {
      const double middle = 0.5 * (low + high);
      CW_TRY(impeller(table, middle, fixed, 0, meridian, design));
      *(design->predicted_head < design->head ? &low : &high) = middle;
    }
  }
done:
  return status;
}

// Of the limits of the usual angles the one whose head is nearer to the asked.
static double usual_limit(const CwMeridian *meridian, CwDesign *design) {
  double off[2];
  for (int i = 0; i < 2; i++) {
    design->outlet_blade_angle = usual_beta[i];
    cw_outlet_triangle(meridian, design);
    off[i] = fabs(design->head_residual);
  }
  return usual_beta[off[1] < off[0]];
}

// A design by the head keeps the correlation's D2 where the outlet blade angle that it wants is a usual one. The
// largest D2 that a given D3 leaves may take a greater angle.
static CwStatus solve_outlet_diameter(const CwCase *table, CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  const double largest = largest_outlet_diameter(table);
  const int by_head = design->priority == CW_PRIORITY_HEAD;
  double fixed = NAN;
  CW_TRY(impeller(table, NAN, NAN, 1, meridian, design));
  if (by_head) {
    if (cw_design_meets_head(design) && design->outlet_blade_angle >= usual_beta[0] &&
        design->outlet_blade_angle <= usual_beta[1])
      goto done;
    fixed = usual_limit(meridian, design);
  }
  CW_TRY(outlet_diameter_for_head(table, fixed, meridian, design));
  if (by_head && !cw_design_meets_head(design) && design->outlet_diameter > (1 - 1e-9) * largest)
    CW_TRY(impeller(table, largest, NAN, 1, meridian, design));
  CW_REQUIRE(cw_design_meets_head(design) || design->outlet_diameter > (1 - 1e-9) * largest, CW_ERR_DESIGN,
             "no outlet diameter from 0.7 to 3 times the correlation's meets the head of %.3f m with beta2 "
             "= %.2f deg "
             "(%.3f m at D2 = %.1f mm): give outlet_diameter_mm, or change outlet_width_mm or blade_count",
             design->head, design->outlet_blade_angle / CW_DEGREE, design->predicted_head,
             design->outlet_diameter * 1e3);
done:
  return status;
}

// Of an open b2 over the correlation's, or under it, where D2 is given and b2 has to meet the head.
static const double LARGEST_WIDENING = 1.5;

static CwStatus with_outlet_width(const CwCase *table, double width, double fixed, int shape, CwMeridian *meridian,
                                  CwDesign *design) {
  CwCase trial = *table;
  trial.impeller.outlet_width = width;
  return impeller(&trial, NAN, fixed, shape, meridian, design);
}

// A given D2 that no outlet blade angle from 12 to 60 degrees brings to the head leaves it to an open b2, with the
// limit of the usual angles, or, where b2 would be too unusual, with the angle that is then left.
static CwStatus solve_outlet_width(const CwCase *table, CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  CW_TRY(impeller(table, NAN, NAN, 1, meridian, design));
  if (design->priority != CW_PRIORITY_HEAD || cw_case_given(table->impeller.outlet_width) ||
      cw_design_meets_head(design))
    goto done;
  const int more = design->head_residual < 0;
  const double usual = design->outlet_width, fixed = usual_limit(meridian, design);
  double low = more ? usual : usual / LARGEST_WIDENING, high = more ? usual * LARGEST_WIDENING : usual;
  CW_TRY(with_outlet_width(table, more ? high : low, fixed, 1, meridian, design));
  const int within = more ? design->head_residual > 0 : design->head_residual < 0;
  if (within) {
    for (int i = 0; i < 50; i++) {
      const double middle = 0.5 * (low + high);
      CW_TRY(with_outlet_width(table, middle, fixed, 1, meridian, design));
      *(design->predicted_head < design->head ? &low : &high) = middle;
    }
    design->source[CW_DESIGN_outlet_blade_angle] = "limit of the usual 18 to 32 deg; b2 meets the head";
  } else {
    CW_TRY(with_outlet_width(table, more ? high : low, NAN, 1, meridian, design));
  }
  design->source[CW_DESIGN_outlet_width] = "meets the head with the outlet blade angle";
done:
  return status;
}

// Given dimensions go before the head, unless the priority is the head: a wheel is built where it reaches this share of
// the asked head, and no more than its inverse. What is further off contradicts the duty point, as feet taken for
// metres do (3.28).
static const double LEAST_HEAD_SHARE = 1 / 3.0;

static CwStatus check_head(const CwCase *table, const CwDesign *design) {
  CwStatus status = CW_OK;
  const int strict = table->impeller.priority == CW_PRIORITY_HEAD;
  const double share = design->predicted_head / design->head, least = strict ? 1 - 1e-3 : LEAST_HEAD_SHARE;
  CW_REQUIRE(share >= least && share <= 1 / least, CW_ERR_DESIGN,
             "the table asks for a head of %.4g m; its dimensions give %.4g m with beta2 = %.2f deg (12 to 60 are "
             "allowed) and D2 = %.4g mm%s: change outlet_diameter_mm, outlet_width_mm, outlet_blade_angle_deg%s%s",
             design->head, design->predicted_head, design->outlet_blade_angle / CW_DEGREE,
             design->outlet_diameter * 1e3,
             design->outlet_diameter > (1 - 1e-9) * largest_outlet_diameter(table) ? ", the most that D3 leaves" : "",
             cw_case_given(table->volute.base_diameter) ? ", base_diameter_mm" : "",
             strict ? " or the priority" : " or blade_count");
done:
  return status;
}

// The nose narrows from the hub on, and the hub's radius grows to that of the interface and no further.
static CwStatus check_hub(const CwDesign *design) {
  CwStatus status = CW_OK;
  const double hub = design->hub_diameter / 2, eye = design->inlet_diameter / 2 - hub;
  const double way = design->interface_radius - hub;
  CW_REQUIRE(design->nut_length == 0 || design->nut_disk_radius < hub, CW_ERR_DESIGN,
             "the flat end of the nut has %.4g mm, the hub %.4g mm: lower hub_nut_flat_diameter_mm to less than that "
             "(%.3g are usual), or raise hub_diameter_mm",
             2e3 * design->nut_disk_radius, 2e3 * hub, 0.29e3 * 2 * hub);
  CW_REQUIRE(design->hub_pole_radial * eye < way, CW_ERR_DESIGN,
             "hub_pole_radial of %.3g leads the hub beyond the interface at r = %.4g mm and back to it: lower "
             "hub_pole_radial to %.3g",
             design->hub_pole_radial, 1e3 * design->interface_radius, 0.9 * way / eye);
done:
  return status;
}

// The dimensions of the wheel for its head.
static CwStatus solve_wheel(const CwCase *table, CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  if (cw_case_given(table->impeller.outlet_diameter))
    CW_TRY(solve_outlet_width(table, meridian, design));
  else
    CW_TRY(solve_outlet_diameter(table, meridian, design));
  CW_TRY(cw_inlet_check(table, design));
  CW_TRY(check_head(table, design));
  CW_TRY(check_hub(design));
done:
  return status;
}

// Least angles at which a cylindrical blade stands on hub and shroud, with an open leading edge and with a given one.
// It is parallel to the axis, as is the shroud in the eye: there it would leave the shroud at its own blade angle, in a
// wedge that nobody can cast and no layer can fill. 40 degrees are filled by two tetrahedra of 20.
static const double LEAST_STANDING = 50 * M_PI / 180, LEAST_GIVEN = 40 * M_PI / 180;
// How far out the leading edge is moved for that: of the way from where it was to D2, and its steps.
static const double FARTHEST_EDGE = 0.6;
enum { EDGE_STEPS = 12 };

// Moves the leading edge of cylindrical blades out until they stand at the least angle, or as far as there is a wheel.
static CwStatus stand_steeper(const CwCase *table, double least, CwMeridian *meridian, CwDesign *design,
                              double *angle) {
  CwStatus status = CW_OK;
  CwCase trial = *table;
  const double first = design->leading_edge_radius_shroud, given = table->impeller.leading_edge_radius_shroud;
  CW_TRY(cw_blade_wall_angle(design, meridian, angle));
  for (int i = 1; *angle < least && i <= EDGE_STEPS; i++) {
    trial.impeller.leading_edge_radius_shroud =
        first + FARTHEST_EDGE * i / EDGE_STEPS * (design->outlet_diameter / 2 - first);
    const CwDesign before = *design;
    const CwMeridian walls = *meridian;
    if (solve_wheel(&trial, meridian, design) != CW_OK) { // too short a blade for its wrap
      cw_fail_clear();
      *design = before;
      *meridian = walls;
      break;
    }
    const double radius = design->leading_edge_radius_shroud;
    if (cw_case_given(given))
      GIVE_WAY(leading_edge_radius_shroud, radius, given,
               "leading_edge_radius_shroud_mm gives way to cylindrical blades that stand at 40 deg on the walls");
    else
      SET(leading_edge_radius_shroud, radius, "as far out as cylindrical blades stand at 50 deg on the walls");
    CW_TRY(cw_blade_wall_angle(design, meridian, angle));
  }
done:
  return status;
}

CwStatus cw_impeller_design(const CwCase *table, CwMeridian *meridian, CwDesign *design) {
  CwStatus status = CW_OK;
  double angle, least = cw_case_given(table->impeller.leading_edge_radius_shroud) ? LEAST_GIVEN : LEAST_STANDING;
  CW_TRY(solve_wheel(table, meridian, design));
  if (design->blade_form != CW_BLADE_CYLINDRICAL) goto done;
  CW_TRY(stand_steeper(table, least, meridian, design, &angle));
  if (angle >= least) goto done;
  const CwDesign flat = *design;
  const CwMeridian walls = *meridian;
  design->blade_form = CW_BLADE_TWISTED;
  if (solve_wheel(table, meridian, design) == CW_OK) {
    const double radius = design->leading_edge_radius_shroud;
    GIVE_WAY(leading_edge_radius_shroud, radius, radius,
             "blade_form cylindrical gives way to twisted, which stands steeper on the walls");
    goto done;
  }
  cw_fail_clear();
  *design = flat;
  *meridian = walls;
  CW_REQUIRE(angle >= LEAST_GIVEN, CW_ERR_DESIGN,
             "cylindrical blades that begin at r = %.4g mm stand at %.0f deg on hub or shroud; allowed: %.0f deg and "
             "more: raise leading_edge_radius_shroud_mm or change wrap_angle_deg",
             1e3 * flat.leading_edge_radius_shroud, angle / CW_DEGREE, LEAST_GIVEN / CW_DEGREE);
done:
  return status;
}
