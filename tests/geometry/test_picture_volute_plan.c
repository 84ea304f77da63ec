// SPDX-License-Identifier: AGPL-3.0-or-later
// The plan of the volute as it is read: by its scale bar, from the axis, the centre of its circles. Seen from the
// suction side the discharge leads to the right where the suction lies at -z, and the spiral opens from top to right.
#include "geometry/hydraulic_design.h"
#include "geometry/picture.h"
#include "geometry/volute_section.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/geometry/svg_sheet.h"

static const double degree = M_PI / 180, near = 0.1; // px

enum { SPIRAL = 181, NOSE = 25 }; // points of the walls before the diffuser's

typedef struct {
  SvgSheet sheet;
  double scale, *centre; // px per m
  int right;
  const SvgItem *outer, *inner, *throat;
} Plan;

// The paper's, of either hand and discharge.
static CwDesign design_with(CwRotation rotation, CwDischarge discharge) {
  CwCase table = paper();
  table.impeller.rotation = rotation;
  table.volute.discharge = discharge;
  return design_of(&table);
}

static Plan drawn(const CwDesign *design) {
  Plan plan = {.sheet = svg_drawn(cw_picture_volute_plan, design)};
  plan.right = design->rotation == CW_ROTATION_CLOCKWISE ? -1 : 1;
  plan.scale = svg_scale(&plan.sheet);
  plan.centre = svg_nth(&plan.sheet, SVG_CIRCLE, NULL, 0)->x[0];
  plan.outer = svg_nth(&plan.sheet, SVG_LINE, SVG_WALL, 0);
  plan.inner = svg_nth(&plan.sheet, SVG_LINE, SVG_WALL, 1);
  plan.throat = svg_nth(&plan.sheet, SVG_LINE, SVG_FLOW, 0);
  return plan;
}

static double radius_of(const Plan *plan, const double x[2]) {
  return svg_distance(plan->centre, x) / plan->scale;
}

// From straight up, rad, in the sense of rotation.
static double angle_of(const Plan *plan, const double x[2]) {
  return atan2(plan->right * (x[0] - plan->centre[0]), plan->centre[1] - x[1]);
}

// From the start of the spiral: the ray of 360 degrees.
static double angle_of_spiral(const Plan *plan, const double x[2]) {
  return remainder(angle_of(plan, x) - angle_of(plan, svg_nth(&plan->sheet, SVG_LINE, SVG_THIN, 7)->x[1]), 2 * M_PI);
}

static void circles_are_the_base_and_the_interface(void **state) {
  const CwDesign design = design_with(CW_ROTATION_COUNTER_CLOCKWISE, CW_DISCHARGE_TANGENTIAL);
  Plan plan = drawn(&design);
  const SvgItem *interface = svg_nth(&plan.sheet, SVG_CIRCLE, NULL, 1);
  assert_near(svg_nth(&plan.sheet, SVG_CIRCLE, NULL, 0)->radius, 0.102 * plan.scale, near);
  assert_near(interface->radius, 0.101 * plan.scale, near);
  assert_near(svg_distance(interface->x[0], plan.centre), 0, 0);
  for (int k = 0; k < 2; k++) { // the cross in their middle
    const SvgItem *line = svg_nth(&plan.sheet, SVG_CHAIN, NULL, k);
    for (int i = 0; i < 2; i++) assert_near((line->x[0][i] + line->x[1][i]) / 2, plan.centre[i], 0.011);
  }
  svg_free(&plan.sheet);
}

// The label of a ray stands within the base circle, at its begin.
static void rays_reach_the_wall_every_45_degrees(void **state) {
  for (int k = 0; k < 2; k++) {
    const CwDesign design = design_with(k ? CW_ROTATION_CLOCKWISE : CW_ROTATION_COUNTER_CLOCKWISE, k);
    Plan plan = drawn(&design);
    double before = 0.102;
    for (int i = 1; i <= 8; i++) {
      const SvgItem *ray = svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, i - 1);
      const SvgItem *label = svg_text(&plan.sheet, "%d\302\260", 45 * i);
      const double r = radius_of(&plan, ray->x[1]), middle[2] = {label->x[0][0], label->x[0][1] - 4};
      double least = INFINITY;
      for (int j = 0; j + 1 < SPIRAL; j++)
        for (int f = 0; f < 20; f++) {
          const double *a = plan.outer->x[j], *b = plan.outer->x[j + 1], share = f / 20.0;
          least = fmin(least,
                       svg_distance(ray->x[1], (double[]){a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])}));
        }
      assert_near(radius_of(&plan, ray->x[0]), 0.102, near / plan.scale);
      assert_near(remainder(angle_of_spiral(&plan, ray->x[0]) - 45 * i * degree, 2 * M_PI), 0, 2e-4);
      assert_near(remainder(angle_of_spiral(&plan, ray->x[1]) - 45 * i * degree, 2 * M_PI), 0, 2e-4);
      assert_near(r, cw_volute_section(&design.volute, 45 * i * degree).outer_radius, near / plan.scale);
      assert_true(least < 0.15);
      assert_true(r > before);
      before = r;
      assert_near(svg_distance(middle, ray->x[0]), 26, near);
      assert_near(remainder(angle_of_spiral(&plan, middle) - 45 * i * degree, 2 * M_PI), 0, 2e-3);
    }
    svg_free(&plan.sheet);
  }
}

// The radius of the circle through three points.
static double circle_through(const double a[2], const double b[2], const double c[2]) {
  const double area2 = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return svg_distance(a, b) * svg_distance(b, c) * svg_distance(c, a) / fabs(2 * area2);
}

// The inner wall begins where the outer one does, at the angle of the tongue, with the nose's circle, whose point
// nearest to the axis is the tip.
static void the_tongue_joins_both_walls(void **state) {
  for (int k = 0; k < 2; k++) {
    const CwDesign design = design_with(CW_ROTATION_COUNTER_CLOCKWISE, k);
    Plan plan = drawn(&design);
    double least = INFINITY;
    for (int i = 0; i < NOSE; i++) least = fmin(least, radius_of(&plan, plan.inner->x[i]));
    assert_near(svg_distance(plan.inner->x[0], plan.outer->x[0]), 0, 0.05);
    assert_near(angle_of_spiral(&plan, plan.inner->x[0]), design.tongue_angle, 1e-3);
    assert_near(circle_through(plan.inner->x[0], plan.inner->x[12], plan.inner->x[24]) / plan.scale,
                design.tongue_radius, 0.03 * design.tongue_radius);
    assert_near(least, design.tongue_tip_radius, near / plan.scale);
    svg_text(&plan.sheet, "tongue: nose radius %.2f mm, tip at r = %.1f mm and %.1f deg", 1e3 * design.tongue_radius,
             1e3 * design.tongue_tip_radius, design.tongue_angle / degree);
    svg_free(&plan.sheet);
  }
}

// The throat spans from wall to wall, where the diffuser begins; its bore, 50 mm, is (pi / 4) 50^2 / throat times it.
static void the_throat_and_the_diffuser(void **state) {
  const CwDesign design = design_with(CW_ROTATION_COUNTER_CLOCKWISE, CW_DISCHARGE_TANGENTIAL);
  Plan plan = drawn(&design);
  const double *a = plan.throat->x[0], *b = plan.throat->x[1];
  assert_near(svg_distance(a, plan.inner->x[NOSE]), 0, 0);
  assert_near(svg_distance(b, plan.outer->x[SPIRAL - 1]), 0, 0);
  assert_near(svg_distance(b, plan.outer->x[SPIRAL]), 0, 0);
  assert_near(svg_distance(a, b), design.volute.throat_width * plan.scale, near);
  const SvgItem *outlet = svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, 8);
  const double from[2] = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
  const double to[2] = {(outlet->x[0][0] + outlet->x[1][0]) / 2, (outlet->x[0][1] + outlet->x[1][1]) / 2};
  assert_near(svg_distance(from, to), design.diffuser_length * plan.scale, near);
  svg_text(&plan.sheet, "D3 = 204.0 mm; throat %.0f mm2 (orange), %.1f mm wide", 1e6 * design.throat_area,
           1e3 * design.volute.throat_width);
  svg_text(&plan.sheet, "diffuser %.1f mm, %.1f deg, area ratio %.2f; discharge DN = 50.0 mm, pipe 100 mm",
           1e3 * design.diffuser_length, design.diffuser_angle / degree, M_PI / 4 * 2500e-6 / design.throat_area);
  svg_free(&plan.sheet);
}

// Along +y, to the right, or to the left of the other hand: both walls end in a pipe of 50 mm and twice that length.
// Radial, its middle line points away from the axis.
static void the_discharge_leads_along_y(void **state) {
  for (int k = 0; k < 4; k++) {
    const CwDesign design = design_with((CwRotation)(k / 2), (CwDischarge)(k % 2));
    Plan plan = drawn(&design);
    for (int end = 0; end < 2; end++) {
      const SvgItem *bore = svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, 8 + end);
      const int back = 2 - end; // points before the end of the walls
      assert_near(bore->x[0][0], bore->x[1][0], near);
      assert_near(bore->x[0][1] - bore->x[1][1], 0.05 * plan.scale, near);
      assert_near(svg_distance(bore->x[0], plan.inner->x[plan.inner->count - back]), 0, near);
      assert_near(svg_distance(bore->x[1], plan.outer->x[plan.outer->count - back]), 0, near);
      if (k % 2) assert_near((bore->x[0][1] + bore->x[1][1]) / 2, plan.centre[1], near);
    }
    const double *first = svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, 8)->x[0];
    const double *last = svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, 9)->x[0];
    assert_near(plan.right * (last[0] - first[0]), 0.1 * plan.scale, near);
    assert_true(plan.right * (first[0] - plan.centre[0]) > 0);
    svg_free(&plan.sheet);
  }
}

// The other hand is the mirror image, from the axis.
static void hands_are_mirror_images(void **state) {
  const CwDesign design[2] = {design_with(CW_ROTATION_COUNTER_CLOCKWISE, CW_DISCHARGE_TANGENTIAL),
                              design_with(CW_ROTATION_CLOCKWISE, CW_DISCHARGE_TANGENTIAL)};
  Plan plan[2] = {drawn(&design[0]), drawn(&design[1])};
  for (int wall = 0; wall < 2; wall++) {
    const SvgItem *one = wall ? plan[0].inner : plan[0].outer, *other = wall ? plan[1].inner : plan[1].outer;
    for (int i = 0; i < one->count; i++) {
      assert_near(one->x[i][0] - plan[0].centre[0], plan[1].centre[0] - other->x[i][0], 0.021);
      assert_near(one->x[i][1] - plan[0].centre[1], other->x[i][1] - plan[1].centre[1], 0.021);
    }
  }
  for (int k = 0; k < 2; k++) svg_free(&plan[k].sheet);
}

static void other_pumps_fit(void **state) {
  static const char *const name[] = {"ns40", "ns200", "zones"};
  for (int i = 0; i < 3; i++) {
    const CwCase table = case_of(name[i]);
    const CwDesign design = design_of(&table);
    Plan plan = drawn(&design);
    assert_near(svg_nth(&plan.sheet, SVG_CIRCLE, NULL, 0)->radius / plan.scale, design.base_diameter / 2,
                1e-3 * design.base_diameter);
    svg_free(&plan.sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(circles_are_the_base_and_the_interface),
      cmocka_unit_test(rays_reach_the_wall_every_45_degrees),
      cmocka_unit_test(the_tongue_joins_both_walls),
      cmocka_unit_test(the_throat_and_the_diffuser),
      cmocka_unit_test(the_discharge_leads_along_y),
      cmocka_unit_test(hands_are_mirror_images),
      cmocka_unit_test(other_pumps_fit),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
