// SPDX-License-Identifier: AGPL-3.0-or-later
// The volume of the blades by strips across them, and of the root fillets by vectors in space.
#include "geometry/rotor_volume.h"

#include <math.h>

#include "geometry/blade.h"
#include "geometry/meridian.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/unit_test.h"

enum { PIECE = 400, OUTLINE = 4 * PIECE, STRIPS = 3000, GAUSS = 4 };

static double volume_of(const CwDesign *design) {
  double volume = NAN;
  if (cw_rotor_volume(design, &volume) != CW_OK) fail_msg("%s", cw_fail_message());
  return volume;
}

// Round a section, in any sense: nose, pressure side, trailing edge, suction side. A bevel begins on the suction side
// where it does on mid-span, and ends on D2.
static void outline(const CwDesign *design, const CwBladeSection *section, const CwBladeSection *middle,
                    CwBladePoint point[OUTLINE]) {
  const CwTrailingEdge edge = design->trailing_edge;
  const int bevelled = edge == CW_EDGE_BEVELLED || edge == CW_EDGE_SHARP;
  const double begin = bevelled ? cw_blade_bevel_begin(middle, edge, design->trailing_edge_bevel) : section->end;
  const double corner = cw_blade_bevel_theta(middle, begin) - middle->shift + section->shift;
  for (int i = 0; i < PIECE; i++) {
    const double f = (double)i / PIECE;
    point[i] = cw_blade_leading_edge(section, M_PI * (f - 0.5));
    point[PIECE + i] = cw_blade_side(section, CW_BLADE_PRESSURE, section->nose + (section->end - section->nose) * f);
    point[2 * PIECE + i] = edge == CW_EDGE_ROUNDED    ? cw_blade_trailing_edge(section, M_PI * (0.5 - f))
                           : i == 0                   ? cw_blade_side(section, CW_BLADE_PRESSURE, section->end)
                           : edge == CW_EDGE_BEVELLED ? (CwBladePoint){1, corner}
                           : edge == CW_EDGE_SHARP    ? cw_blade_side(section, CW_BLADE_PRESSURE, section->end)
                                                      : cw_blade_side(section, CW_BLADE_SUCTION, section->end);
    point[3 * PIECE + i] = cw_blade_side(section, CW_BLADE_SUCTION, begin + (section->nose - begin) * f);
  }
}

// The angle that the section takes at each of even steps of q, from -0.1 to 1.1: its sides' difference.
static void widths(const CwBladePoint point[OUTLINE], double width[STRIPS]) {
  for (int k = 0; k < STRIPS; k++) width[k] = 0;
  for (int i = 0; i < OUTLINE; i++) {
    const CwBladePoint *a = &point[i], *b = &point[(i + 1) % OUTLINE];
    const CwBladePoint *low = a->q < b->q ? a : b, *high = a->q < b->q ? b : a;
    const double place = (low->q + 0.1) / 1.2 * STRIPS - 0.5;
    for (int k = (int)ceil(place); k < STRIPS; k++) {
      const double q = -0.1 + 1.2 * (k + 0.5) / STRIPS;
      if (q >= high->q) break;
      width[k] += (a == low ? 1 : -1) * (low->theta + (q - low->q) / (high->q - low->q) * (high->theta - low->theta));
    }
  }
}

// One blade, or splitter: the sum of r dtheta over the section of the meridian, which q and the span s run through.
static double blade_volume(const CwDesign *design, const CwMeridian *meridian, int splitter) {
  static const double x[GAUSS] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  static const double w[GAUSS] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  static CwBladePoint point[OUTLINE];
  static double width[STRIPS];
  CwBladeSection section, middle;
  double sum = 0;
  assert_int_equal(cw_blade_section(design, meridian, 0.5, &middle), CW_OK);
  if (splitter) middle = cw_blade_splitter(design, &middle);
  for (int j = 0; j < GAUSS; j++) {
    const double s = 0.5 + 0.5 * x[j];
    assert_int_equal(cw_blade_section(design, meridian, s, &section), CW_OK);
    if (splitter) section = cw_blade_splitter(design, &section);
    outline(design, &section, &middle, point);
    widths(point, width);
    for (int k = 0; k < STRIPS; k++) {
      if (width[k] == 0) continue;
      const double q = -0.1 + 1.2 * (k + 0.5) / STRIPS, h = 1e-4;
      double m[4][2], at[2];
      cw_meridian_blade_point(meridian, s, q, at, NULL);
      cw_meridian_blade_point(meridian, s, q - h, m[0], NULL);
      cw_meridian_blade_point(meridian, s, q + h, m[1], NULL);
      cw_meridian_blade_point(meridian, 0, q, m[2], NULL);
      cw_meridian_blade_point(meridian, 1, q, m[3], NULL);
      const double by_q[2] = {(m[1][0] - m[0][0]) / (2 * h), (m[1][1] - m[0][1]) / (2 * h)};
      const double by_s[2] = {m[3][0] - m[2][0], m[3][1] - m[2][1]};
      sum += w[j] / 2 * 1.2 / STRIPS * fabs(width[k]) * at[0] * fabs(by_q[0] * by_s[1] - by_q[1] * by_s[0]);
    }
  }
  return sum;
}

// The meridian's solid of revolution less the blades. The strips are good to some hundred-thousandths of a blade.
static void blades_by_strips(const CwCase *table) {
  const CwDesign design = design_of(table);
  CwMeridian meridian;
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  double blades = blade_volume(&design, &meridian, 0);
  if (design.splitter_start > 0) blades += blade_volume(&design, &meridian, 1);
  assert_near((cw_meridian_volume(&meridian) - volume_of(&design)) / (design.blade_count * blades), 1, 5e-5);
}

static void all_trailing_edges(void **state) {
  for (int edge = CW_EDGE_BEVELLED; edge <= CW_EDGE_SHARP; edge++) {
    CwCase table = paper();
    table.impeller.trailing_edge = (CwTrailingEdge)edge;
    blades_by_strips(&table);
  }
}

static void leaning_cylindrical_and_splitter_blades(void **state) {
  CwCase table = paper();
  table.impeller.lean_angle = 12 * M_PI / 180;
  blades_by_strips(&table);
  table = paper();
  table.impeller.splitter_start = 0.4;
  blades_by_strips(&table);
  table = case_of("ns200");
  blades_by_strips(&table);
}

// Blades without thickness take nothing, but for what the chords of one side lie off those of the other.
static void a_wheel_of_sheets(void **state) {
  CwCase table = paper();
  table.impeller.trailing_edge = CW_EDGE_BLUNT;
  CwDesign design = design_of(&table);
  CwMeridian meridian;
  design.leading_edge_thickness = design.blade_thickness = design.trailing_edge_thickness = 0;
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  assert_near(volume_of(&design) / cw_meridian_volume(&meridian), 1, 1e-6);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// All fillets of one blade of radius R: along the foot of its blunt outline, between the wall, on which the foot runs,
// and the blade, which goes up along its mean surface. Where both meet at the angle alpha through the fluid a rolling
// ball leaves R^2 (cot(alpha / 2) - (pi - alpha) / 2). Vectors are (r, theta, z) at the foot.
static double fillets_of(const CwDesign *design, const CwMeridian *meridian, double radius) {
  static CwBladePoint point[OUTLINE];
  double sum = 0;
  for (int wall = 0; wall < 2; wall++) {
    const double near = wall ? 0.875 : 0.125;
    CwBladeSection on, off, middle;
    assert_int_equal(cw_blade_section(design, meridian, wall, &on), CW_OK);
    assert_int_equal(cw_blade_section(design, meridian, near, &off), CW_OK);
    assert_int_equal(cw_blade_section(design, meridian, 0.5, &middle), CW_OK);
    outline(design, &on, &middle, point);
    for (int i = 0; i < OUTLINE; i++) {
      const CwBladePoint *a = &point[i], *b = &point[(i + 1) % OUTLINE];
      const double q = (a->q + b->q) / 2, p = fmin(1, fmax(0, q));
      double x[2], dx[2], foot[2], head[2];
      cw_meridian_blade_point(meridian, wall, q, x, dx);
      cw_meridian_blade_point(meridian, wall, p, foot, NULL);
      cw_meridian_blade_point(meridian, near, p, head, NULL);
      const double speed = hypot(dx[0], dx[1]), down[3] = {dx[0] / speed, 0, dx[1] / speed};
      const double m = (b->q - a->q) * speed, t = (b->theta - a->theta) * x[0], length = hypot(m, t);
      if (length == 0) continue;
      const double along[3] = {down[0] * m / length, t / length, down[2] * m / length};
      // The outline runs with the blade on its right: at the nose towards greater theta.
      const double out[3] = {-down[0] * t / length, m / length, -down[2] * t / length};
      double up[3] = {head[0] - foot[0], foot[0] * (cw_blade_theta(&off, p) - cw_blade_theta(&on, p)),
                      head[1] - foot[1]};
      const double part = dot(up, along);
      for (int k = 0; k < 3; k++) up[k] -= part * along[k];
      const double alpha = acos(dot(up, out) / sqrt(dot(up, up)));
      sum += length * radius * radius * (1 / tan(alpha / 2) - (M_PI - alpha) / 2);
    }
  }
  return sum;
}

// Fillets of 0.2 mm have room before the interface all along the blade: they take as much as the ball leaves, four
// times what those of 0.1 mm take.
static void fillets_take_what_a_ball_leaves(void **state) {
  CwCase table = paper();
  table.impeller.trailing_edge = CW_EDGE_BLUNT;
  CwDesign design = design_of(&table);
  CwMeridian meridian;
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  const double without = volume_of(&design);
  design.root_fillet_radius = 0.1e-3;
  const double small = without - volume_of(&design);
  design.root_fillet_radius = 0.2e-3;
  const double large = without - volume_of(&design);
  assert_true(small > 0);
  assert_near(large / small, 4, 1e-6);
  assert_near(large / (design.blade_count * fillets_of(&design, &meridian, 0.2e-3)), 1, 5e-4);
}

static void what_has_no_solution_fails(void **state) {
  const CwCase table = paper();
  CwDesign design = design_of(&table);
  double volume;
  design.wrap_angle = 21 * M_PI / 180;
  assert_int_equal(cw_rotor_volume(&design, &volume), CW_ERR_DESIGN);
  design.leading_edge_radius_hub = 0.2;
  assert_int_equal(cw_rotor_volume(&design, &volume), CW_ERR_DESIGN);
  cw_fail_clear();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_trailing_edges),         cmocka_unit_test(leaning_cylindrical_and_splitter_blades),
      cmocka_unit_test(a_wheel_of_sheets),          cmocka_unit_test(fillets_take_what_a_ball_leaves),
      cmocka_unit_test(what_has_no_solution_fails),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
