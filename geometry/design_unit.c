// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_unit.h"

#include "geometry/volute_tongue.h"
#include "pipeline/significant.h"

// What becomes of a quantity of each kind. Multiples, for differences of equals that rounding made are no shape.
#define NUMBER(x) x = cw_multiple(x, -34);
#define ANGLE(x) x = cw_multiple(x, -34);
#define LENGTH(x) x = cw_multiple((x) / unit, -26);
#define AREA(x) x = cw_multiple((x) / (unit * unit), -20);
#define HEAD(x)
#define SPEED(x)
#define FLOW(x)
#define ANGULAR_SPEED(x)
#define DIFFUSIVITY(x)
#define POWER(x)
#define PRESSURE(x)

static void input_in_unit(CwVoluteInput *in, double unit){
    LENGTH(in->corner_radius) LENGTH(in->interface_radius) LENGTH(in->neck_width) LENGTH(in->base_diameter)
        LENGTH(in->inlet_width) ANGLE(in->side_wall_angle) AREA(in->throat_area) LENGTH(in->tongue_radius)
            LENGTH(in->tongue_gap) ANGLE(in->tongue_angle) LENGTH(in->tongue_gap_range[0])
                LENGTH(in->tongue_gap_range[1]) LENGTH(in->diffuser_length) ANGLE(in->diffuser_angle)
                    LENGTH(in->outlet_diameter) NUMBER(in->diffuser_area_ratio) LENGTH(in->discharge_pipe_length)}

CwVolute cw_volute_in_unit(const CwVolute *volute, double unit) {
  CwVolute of = *volute;
  input_in_unit(&of.input, unit);
  ANGLE(of.arc_half_angle)
  ANGLE(of.end_half_angle)
  if (of.input.area_law == CW_AREA_LAW_VELOCITY) {
    AREA(of.law_start)
    AREA(of.law_end)
  } else {
    LENGTH(of.law_start)
    LENGTH(of.law_end)
  }
  ANGLE(of.start_angle)
  ANGLE(of.tip_angle)
  LENGTH(of.tip_radius)
  LENGTH(of.inner_wall_x)
  LENGTH(of.throat_y)
  AREA(of.throat_area)
  LENGTH(of.throat_width)
  LENGTH(of.diffuser_length)
  ANGLE(of.diffuser_angle)
  NUMBER(of.diffuser_area_ratio)
  ANGLE(of.throat_lean)
  ANGLE(of.discharge_lean)
  LENGTH(of.outlet_x)
  LENGTH(of.outlet_y)
  cw_volute_side_line(&of); // its slope is a difference quotient, which would show rounding
  return of;
}

CwDesign cw_design_in_unit(const CwDesign *design, double unit) {
  CwDesign of = *design;
#define IN_UNIT(member, kind, text) kind(of.member)
  CW_DESIGN_LIST(IN_UNIT)
#undef IN_UNIT
  of.volute = cw_volute_in_unit(&design->volute, unit);
  of.unit = design->unit * unit;
  return of;
}
