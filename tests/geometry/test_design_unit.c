// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/design_unit.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/design_value.h"
#include "geometry/volute_section.h"
#include "tests/draw.h"
#include "tests/geometry/paper_volute.h"
#include "tests/unit_test.h"

#define OFFSET(member, kind, text) offsetof(CwDesign, member),
static const size_t offsets[] = {CW_DESIGN_LIST(OFFSET)};
#undef OFFSET

static double *member_of(CwDesign *design, int quantity) {
  return (double *)(void *)((char *)design + offsets[quantity]);
}

// The power of length that a quantity of the shape has, by the unit that people read it in; -1: none of the shape.
static int power_of(const CwDesign *design, int quantity) {
  const char *unit = cw_hydraulic_design_value(design, (CwDesignQuantity)quantity).unit;
  return !strcmp(unit, "mm") ? 1 : !strcmp(unit, "mm2") ? 2 : !*unit || !strcmp(unit, "deg") ? 0 : -1;
}

static CwDesign *draw_design(uint64_t *seed) {
  const CwVoluteInput input = volute_of_paper();
  CwDesign *design = calloc(1, sizeof *design);
  for (int i = 0; i < CW_DESIGN_COUNT; i++) *member_of(design, i) = 0.01 + 0.3 * draw(seed);
  design->unit = 1;
  design->volute = designed_volute(&input);
  return design;
}

// Lengths and areas are multiples of the unit and its square, rounded as the header says; the rest stays.
static void quantities_are_in_the_unit(void **state) {
  static const double step[] = {0x1p-34, 0x1p-26, 0x1p-20}; // of numbers, lengths and areas
  uint64_t seed = 45;
  for (int round = 0; round < 20; round++) {
    CwDesign *design = draw_design(&seed);
    const double unit = 1e-3 * (0.3 + draw(&seed));
    CwDesign of = cw_design_in_unit(design, unit);
    int seen[3] = {0};
    for (int i = 0; i < CW_DESIGN_COUNT; i++) {
      const int power = power_of(design, i);
      const double si = *member_of(design, i), value = *member_of(&of, i);
      if (power < 0) {
        assert_true(value == si);
        continue;
      }
      assert_near(value, si / pow(unit, power), 0.5000001 * step[power]);
      assert_near(value / step[power], rint(value / step[power]), 0);
      seen[power]++;
    }
    for (int power = 0; power < 3; power++) assert_true(seen[power] > 3);
    assert_near(of.unit, unit, 0);
    of = cw_design_in_unit(&of, 0.5); // a unit of the unit
    assert_near(of.unit, 0.5 * unit, 0);
    free(design);
  }
}

// All lengths of a volute times s.
static CwVoluteInput times(CwVoluteInput in, double s) {
  double *const lengths[] = {&in.interface_radius, &in.neck_width,           &in.base_diameter, &in.inlet_width,
                             &in.tongue_radius,    &in.tongue_gap,           &in.corner_radius, &in.diffuser_length,
                             &in.outlet_diameter,  &in.discharge_pipe_length};
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) *lengths[i] *= s;
  in.throat_area *= s * s;
  in.flow_rate *= s * s; // at the same speeds
  in.pipe_flow_rate *= s * s;
  in.angular_momentum *= s;
  return in;
}

// Of similar volutes by either law: in units that are to each other as they are, all that shapes them is the same, bit
// by bit, and near to that of the volute in m over the unit.
static void similar_volutes_are_one(void **state) {
  for (int law = 0; law < 2; law++) {
    CwVoluteInput input = volute_of_paper();
    if (law == 1) {
      input.area_law = CW_AREA_LAW_VELOCITY;
      input.throat_area = NAN;
      input.corner_radius = 4e-3;
    }
    const CwVolute volute = designed_volute(&input), one = cw_volute_in_unit(&volute, 1e-3);
    for (double s = 0.13; s < 50; s *= 2.7) {
      const CwVoluteInput larger = times(input, s);
      const CwVolute similar = designed_volute(&larger), of = cw_volute_in_unit(&similar, 1e-3 * s);
      for (double phi = 0.5; phi < 6.9; phi += 0.37) {
        const CwVoluteSection a = cw_volute_section(&one, phi), b = cw_volute_section(&of, phi);
        const CwVoluteSection c = cw_volute_section(&volute, phi);
        assert_true(a.kink_radius == b.kink_radius && a.area == b.area && a.arc_angle == b.arc_angle);
        assert_near(1e-3 * a.kink_radius, c.kink_radius, 1e-9);
        assert_near(1e-6 * a.area, c.area, 1e-10);
        assert_near(a.arc_angle, c.arc_angle, 1e-9);
      }
      assert_true(one.inner_wall_x == of.inner_wall_x && one.throat_y == of.throat_y);
      assert_true(one.side_centre_y == of.side_centre_y && one.side_centre_slope == of.side_centre_slope);
      assert_true(one.outlet_x == of.outlet_x && one.outlet_y == of.outlet_y);
      assert_true(one.input.tongue_radius == of.input.tongue_radius && one.throat_area == of.throat_area);
      assert_near(1e-3 * one.outlet_y, volute.outlet_y, 1e-9);
      assert_near(one.side_centre_slope, volute.side_centre_slope, 5e-3); // over a ten thousandth of the level
      assert_true(isnan(one.input.tongue_gap));                           // what is open stays so
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(quantities_are_in_the_unit),
      cmocka_unit_test(similar_volutes_are_one),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
