// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <string.h>

#include "geometry/volute_design.h"
#include "geometry/volute_diffuser.h"
#include "geometry/volute_section.h"
#include "geometry/volute_tongue.h"
#include "tests/geometry/paper_volute.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180, mm = 1e-3;

static void tongue_angle(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.tongue_angle = 38 * degree;
  assert_near(designed_volute(&input).tip_angle, 38 * degree, 1e-9);
}

// A tongue that the spiral does not reach comes as near to it as the flattest arc and the steepest wedge lead.
static void nearest_tongue(void **state) {
  CwVoluteInput input = volute_of_paper();
  const double free = designed_volute(&input).tip_angle;
  input.tongue_angle = 5 * degree;
  const CwVolute low = designed_volute(&input);
  assert_true(low.tip_angle > 5 * degree && low.tip_angle < free);
  assert_near(low.arc_half_angle, 5 * degree, 1e-12);
  input.tongue_angle = low.tip_angle + 0.01 * degree;
  assert_near(designed_volute(&input).tip_angle, input.tongue_angle, 1e-6);
  input.tongue_angle = NAN;
  input.tongue_gap = 0.01 * mm;
  const CwVolute near = designed_volute(&input);
  assert_true(near.tip_radius - 0.102 > 0.01 * mm && near.tip_radius - 0.102 < 2.4 * mm);
}

static void area_ratio(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.outlet_diameter = NAN;
  input.diffuser_area_ratio = 1.8;
  CwVolute volute = designed_volute(&input);
  assert_near(M_PI / 4 * pow(volute.input.outlet_diameter, 2), 1.8 * 905e-6, 1e-11);
  assert_near(volute.diffuser_area_ratio, 1.8, 1e-12);
}

// Of 1200 mm2, by test_volute_diffuser: DN 65 with 50 m3/h and DN 50 with 25 in the pipe, whatever the law's flow rate.
static void bore_of_what_is_delivered(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.outlet_diameter = NAN;
  input.throat_area = 1200e-6;
  assert_near(designed_volute(&input).input.outlet_diameter, 50 * mm, 1e-12);
  input.pipe_flow_rate = 50 / 3600.0;
  assert_near(designed_volute(&input).input.outlet_diameter, 65 * mm, 1e-12);
  input.pipe_flow_rate = 25 / 3600.0;
  input.flow_rate = 30 / 3600.0;
  assert_near(designed_volute(&input).input.outlet_diameter, 50 * mm, 1e-12);
}

// The pipe's axis goes through the pump's, and the throat's middle and the diffuser's end lie on a circle
// that touches both directions: equal angles of the chord to them.
static void radial_discharge(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.discharge = CW_DISCHARGE_RADIAL;
  CwVolute volute = designed_volute(&input);
  double lean = volute.discharge_lean, middle = volute.inner_wall_x + 0.5 * volute.throat_width;
  assert_near(volute.outlet_x * cos(lean) + volute.outlet_y * sin(lean), 0, 1e-12);
  assert_true(volute.outlet_y * cos(lean) - volute.outlet_x * sin(lean) > 0.15);
  double dx = volute.outlet_x - middle, dy = volute.outlet_y - volute.throat_y;
  assert_near(atan2(-dx, dy), 0.5 * (volute.throat_lean + lean), 1e-12);
  double bend = volute.throat_lean - lean;
  assert_near(hypot(dx, dy), volute.diffuser_length * sin(bend / 2) / (bend / 2), 1e-12);
}

// Without a given throat the spiral takes up Q for K; the throat is then near the area of the plain
// trapezoid, whose hand-worked value for K = 0.95 and 20 degrees is 905 mm2.
static void spiral_by_swirl(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.throat_area = NAN;
  CwVolute volute = designed_volute(&input);
  assert_near(volute.law_end - volute.law_start, 25 / 3600.0 / 0.95, 1e-15);
  assert_near(volute.law_constant, 0.95, 1e-12);
  assert_near(volute.throat_area, 905e-6, 0.05 * 905e-6);
}

// Integral of r^power over the throat, by strips of the plane y = y_t: a strip's height is that of the section through
// its middle.
static double throat_integral(const CwVolute *volute, int strips, int power) {
  double sum = 0, step = volute->throat_width / strips;
  for (int i = 0; i < strips; i++) {
    double x = volute->inner_wall_x + (i + 0.5) * step, r = hypot(x, volute->throat_y);
    CwVoluteSection s = cw_volute_section(volute, 2 * M_PI + atan2(volute->throat_y, x));
    double height = 0.006 + (r - 0.102) * tan(20 * degree);
    if (r > s.kink_radius) height = sqrt(fmax(0, pow(s.arc_radius, 2) - pow(r - s.arc_centre, 2)));
    sum += 2 * height * step * pow(r, power);
  }
  return sum;
}

static void throat_by_strips(void **state) {
  CwVoluteInput input = volute_of_paper();
  CwVolute volute = designed_volute(&input);
  assert_near(volute.throat_area, 905e-6, 1e-12);
  assert_near(throat_integral(&volute, 20000, 0), 905e-6, 2e-5 * 905e-6);
}

static void diffuser(void **state) {
  CwVoluteInput input = volute_of_paper();
  CwVolute volute = designed_volute(&input);
  // (50 - 33.95) / 2 / tan 4.5 deg
  assert_near(volute.diffuser_length, 102.0 * mm, 0.1 * mm);
  assert_near(volute.diffuser_angle, 9 * degree, 1e-12);
  input.diffuser_length = 0.12;
  volute = designed_volute(&input);
  assert_near(volute.diffuser_angle, 2 * atan((50 - 33.945) / 240), 1e-4);
}

// The largest angle of the key, 30 degrees, and the least length that a refusal names, (50 - 33.945) / 2 / tan 15 deg =
// 29.96 mm, are allowed.
static void widest_diffuser(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.diffuser_angle = 30 * degree;
  assert_near(designed_volute(&input).diffuser_angle, 30 * degree, 1e-9);
  input.diffuser_length = 20 * mm;
  CwVolute volute;
  assert_int_equal(cw_volute_design(&input, &volute), CW_ERR_DESIGN);
  assert_non_null(strstr(cw_fail_message(), "(at least 30.0 mm)"));
  cw_fail_clear();
  input.diffuser_length = 30 * mm;
  assert_true(designed_volute(&input).diffuser_angle > 29.9 * degree);
}

// Least distance of the diffuser's walls at z = 0, square to its axis at the throat, over that of the throat.
static double narrowest(const CwVolute *volute) {
  const CwDiffuserLines lines = cw_diffuser_lines(volute);
  const double radius = 0.5 * volute->input.outlet_diameter, throat = volute->throat_width * lines.axis[1];
  double wall[3], along[3], least = HUGE_VAL;
  cw_volute_wall_point(volute, cw_volute_throat_angle(volute, 0), 0, wall, along, NULL);
  for (int i = 0; i <= 200; i++) {
    double x[2][3];
    for (int k = 0; k < 2; k++) {
      const double start[3] = {k ? wall[0] : volute->inner_wall_x, volute->throat_y, 0}, side = k ? radius : -radius;
      const double leaving[3] = {k ? lines.tangent * along[0] / along[1] : 0, lines.tangent, 0};
      const double end[3] = {volute->outlet_x + side * lines.down[1], volute->outlet_y - side * lines.down[0], 0};
      cw_diffuser_line(&lines, start, leaving, end, i / 200.0, x[k]);
    }
    least = fmin(least, hypot(x[1][0] - x[0][0], x[1][1] - x[0][1]) / throat);
  }
  return least;
}

// The walls before the throat converge; however long the diffuser is, they narrow it by a tenth or little more.
static void long_diffusers_are_not_pinched(void **state) {
  for (double length = 0.05; length < 2; length *= 1.5) {
    CwVoluteInput input = volute_of_paper();
    input.diffuser_length = length;
    const CwVolute volute = designed_volute(&input);
    assert_true(narrowest(&volute) > 0.85);
    if (length < 0.11) assert_true(cw_diffuser_lines(&volute).turning == 1);
    if (length > 0.2) assert_true(cw_diffuser_lines(&volute).turning < 1 && narrowest(&volute) > 0.89);
  }
}

// A chosen gap is that of the default wedge, 26 degrees, where it lies in its range, else the range's nearer end.
static void chosen_gap(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.tongue_gap_range[0] = 2 * mm;
  CwVolute chosen = designed_volute(&input);
  CwVoluteSection s = cw_volute_section(&chosen, chosen.start_angle);
  assert_near(chosen.start_angle - atan(s.kink_slope / s.kink_radius), 26 * degree, 1e-12);
  const double gap = chosen.tip_radius - 0.102;
  input.tongue_gap_range[0] = gap + 0.4 * mm;
  assert_near(designed_volute(&input).tip_radius - 0.102, input.tongue_gap_range[0], 1e-9);
  input.tongue_gap_range[0] = NAN;
  input.tongue_gap_range[1] = gap - 2 * mm;
  assert_near(designed_volute(&input).tip_radius - 0.102, input.tongue_gap_range[1], 1e-9);
}

// The law then begins later or earlier: the wedge stays, each degree takes up the same share of Q, and the throat keeps
// its area.
static void free_gap(void **state) {
  for (double gap = 4.6 * mm; gap < 31 * mm; gap += 5 * mm) {
    CwVoluteInput input = volute_of_paper();
    input.tongue_gap = gap;
    const CwVolute volute = designed_volute(&input);
    const CwVoluteSection s = cw_volute_section(&volute, volute.start_angle);
    assert_near(volute.tip_radius - 0.102, gap, 1e-9);
    assert_near(volute.start_angle - atan(s.kink_slope / s.kink_radius), 26 * degree, 1e-6);
    assert_near(volute.throat_area, 905e-6, 1e-12);
  }
}

// A tip nearer to the base circle than an arc of 35 degrees leaves it: the arc is as flat as it has to be in steps of 5
// degrees, and the law keeps its wedge. A gap that 35 degrees reach keeps them.
static void slim_gap(void **state) {
  double before = 35 * degree;
  for (double gap = 4.6 * mm; gap > 2.4 * mm; gap -= 0.3 * mm) {
    CwVoluteInput input = volute_of_paper();
    input.tongue_gap = gap;
    const CwVolute volute = designed_volute(&input);
    const CwVoluteSection s = cw_volute_section(&volute, volute.start_angle);
    assert_near(volute.tip_radius - 0.102, gap, 1e-9);
    assert_near(volute.start_angle - atan(s.kink_slope / s.kink_radius), 26 * degree, 1e-6);
    assert_near(volute.throat_area, 905e-6, 1e-12);
    assert_near(remainder(volute.arc_half_angle, 5 * degree), 0, 1e-12);
    assert_true(volute.arc_half_angle <= before && volute.arc_half_angle >= 5 * degree - 1e-12);
    before = volute.arc_half_angle;
    if (gap > 4.5 * mm) assert_true(before == 35 * degree);
  }
  assert_true(before < 34 * degree);
}

// At nq 8 the tongue is a third as thick as the throat is high. By strips of the cut at y = y_t, each passed at K/r,
// the throat takes at least 0.98 of Q whatever the tongue; a thin tongue leaves the spiral as the law alone makes it.
static void throat_passes_the_flow(void **state) {
  for (int i = 0; i < 3; i++) {
    CwVoluteInput input = volute_of_paper();
    input.throat_area = NAN;
    input.angular_momentum = i == 2 ? 0.95 : 2.85;
    input.tongue_radius = (i == 0 ? 0.4 : 1.2) * mm;
    input.outlet_diameter = NAN;
    const CwVolute volute = designed_volute(&input);
    const double flow = input.angular_momentum * throat_integral(&volute, 4000, -1);
    assert_true(flow > 0.979 * input.flow_rate);
    const double lawful = input.flow_rate / input.angular_momentum;
    if (i == 1) assert_near(flow, 0.98 * input.flow_rate, 1e-3 * input.flow_rate);
    if (i == 1) assert_true(volute.law_end - volute.law_start > 1.05 * lawful);
  }
}

static void refuse(CwVoluteInput input, const char *quantity) {
  CwVolute volute;
  assert_int_equal(cw_volute_design(&input, &volute), CW_ERR_DESIGN);
  if (!strstr(cw_fail_message(), quantity) || !strstr(cw_fail_message(), "volute: "))
    fail_msg("\"%s\" does not name %s", cw_fail_message(), quantity);
}

static void wrong_input(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.inlet_width = 8.5 * mm;
  refuse(input, "inlet_width_mm (b3) is 8.5 mm; allowed with this D3 and b2: 9.02 to 81.6 mm");
  input = volute_of_paper();
  input.throat_area = 0.5;
  refuse(input, "throat_area_mm2 is 500000 mm2; allowed");
  input.throat_area = 20e-6;
  refuse(input, "throat_area_mm2 is 20 mm2; allowed with this D3, b3 and tongue: ");
  input = volute_of_paper();
  input.throat_area = NAN;
  input.angular_momentum = 0.1;
  refuse(input, "outer wall beyond");
  input = volute_of_paper();
  input.outlet_diameter = 0.03;
  refuse(input, "outlet_diameter_mm is 30 mm");
  input = volute_of_paper();
  input.diffuser_length = 0.02;
  refuse(input, "diffuser_length_mm 20 mm");
  input = volute_of_paper();
  input.interface_radius = 0.102;
  refuse(input, "base_diameter_mm (D3) is 204 mm");
  input = volute_of_paper();
  input.side_wall_angle = NAN;
  refuse(input, "side_wall_angle_deg");
  input = volute_of_paper();
  input.tongue_radius = 0.015;
  refuse(input, "tongue");
  input = volute_of_paper();
  input.tongue_angle = 70 * degree;
  input.tongue_gap = 7 * mm;
  refuse(input, "tongue_gap_mm and tongue_angle_deg both");
  input = volute_of_paper();
  input.diffuser_area_ratio = 2;
  refuse(input, "outlet_diameter_mm and diffuser_area_ratio both");
  input = volute_of_paper();
  input.section = CW_SECTION_CIRCLE;
  input.corner_radius = 3 * mm;
  refuse(input, "corner_radius_mm is 3 mm, but a circle has no corners");
  input.section = CW_SECTION_RECTANGLE;
  input.corner_radius = NAN;
  refuse(input, "corner_radius_mm is nan");
  input.inlet_width = 75 * mm;
  input.corner_radius = 36 * mm;
  input.throat_area = NAN;
  refuse(input, "too small for its corners; lower corner_radius_mm");
  input.throat_area = 9000e-6; // with which the spiral has room
  input.outlet_diameter = 130 * mm;
  assert_near(designed_volute(&input).throat_area, 9000e-6, 1e-12);
  input = volute_of_paper();
  input.discharge = CW_DISCHARGE_RADIAL;
  input.diffuser_length = 35 * mm;
  refuse(input, "diffuser_length_mm 35 mm");
  input = volute_of_paper();
  input.area_law = CW_AREA_LAW_VELOCITY;
  input.section_speed = 0.2;
  input.throat_area = NAN;
  refuse(input, "Q / (K3 sqrt(2 g H))");
  // Q / K = 1.65 mm between walls 80 mm apart: a throat some 2 mm high, and a tongue whose tip lies 15 mm outside D3.
  // The throat of a spiral for 3 Q passes 0.6 Q.
  input = volute_of_paper();
  input.throat_area = NAN;
  input.inlet_width = 80 * mm;
  input.tongue_radius = 0.25 * mm;
  input.angular_momentum = 4.2;
  refuse(input, "less than 0.98 Q by the law, also of a spiral for 3 Q; lower inlet_width_mm or tongue_radius_mm");
}

// A wheel of 204 mm wants 204 / (1 - 4 0.00125) = 205.0251 mm; the interface lies half-way between both radii.
static void least_base_diameter(void **state) {
  CwVoluteInput input = volute_of_paper();
  input.base_diameter = 204.02 * mm;
  input.interface_radius = (204 * mm + input.base_diameter) / 4;
  refuse(input, "base_diameter_mm (D3) is 204.02 mm; allowed: at least 205.03 mm");
  input.base_diameter = 205.03 * mm;
  input.interface_radius = (204 * mm + input.base_diameter) / 4;
  designed_volute(&input);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(spiral_by_swirl),
      cmocka_unit_test(throat_by_strips),
      cmocka_unit_test(diffuser),
      cmocka_unit_test(widest_diffuser),
      cmocka_unit_test(long_diffusers_are_not_pinched),
      cmocka_unit_test(chosen_gap),
      cmocka_unit_test(free_gap),
      cmocka_unit_test(slim_gap),
      cmocka_unit_test(throat_passes_the_flow),
      cmocka_unit_test(wrong_input),
      cmocka_unit_test(least_base_diameter),
      cmocka_unit_test(tongue_angle),
      cmocka_unit_test(nearest_tongue),
      cmocka_unit_test(area_ratio),
      cmocka_unit_test(bore_of_what_is_delivered),
      cmocka_unit_test(radial_discharge),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
