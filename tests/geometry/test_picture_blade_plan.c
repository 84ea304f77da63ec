// SPDX-License-Identifier: AGPL-3.0-or-later
// The plan of the blades as it is read: by its scale bar, from the centre of its circles, the x axis up. Seen from the
// suction side the y axis points to the right where the suction lies at -z, and the wheel turns from x to y.
#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "geometry/picture.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/geometry/svg_sheet.h"

static const double degree = M_PI / 180, near = 0.1; // px

enum { FOREMOST = 120 + 24 / 2 }; // point of an outline: behind its suction side, half-way round the nose

typedef struct {
  SvgSheet sheet;
  double scale, *centre; // px per m
  int right;
} Plan;

static CwCase wheel(CwRotation rotation, CwTrailingEdge edge, double splitter_start) {
  CwCase table = paper();
  table.impeller.rotation = rotation;
  table.impeller.trailing_edge = edge;
  if (splitter_start > 0) table.impeller.splitter_start = splitter_start;
  return table;
}

static Plan drawn(const CwDesign *design, int right) {
  Plan plan = {.sheet = svg_drawn(cw_picture_blade_plan, design), .right = right};
  plan.scale = svg_scale(&plan.sheet);
  plan.centre = svg_nth(&plan.sheet, SVG_CIRCLE, NULL, 0)->x[0];
  return plan;
}

static double radius_of(const Plan *plan, const double x[2]) {
  return svg_distance(plan->centre, x) / plan->scale;
}

// From the x axis, rad, in the sense of rotation.
static double angle_of(const Plan *plan, const double x[2]) {
  return atan2(plan->right * (x[0] - plan->centre[0]), plan->centre[1] - x[1]);
}

static double turned(double angle) {
  return remainder(angle, 2 * M_PI);
}

static void circles_are_the_inlet_and_the_interface(void **state) {
  const CwCase table = paper();
  const CwDesign design = design_of(&table);
  Plan plan = drawn(&design, 1);
  const SvgItem *inlet = svg_nth(&plan.sheet, SVG_CIRCLE, NULL, 1);
  assert_int_equal(svg_count(&plan.sheet, SVG_CIRCLE, NULL), 2);
  assert_near(svg_nth(&plan.sheet, SVG_CIRCLE, NULL, 0)->radius, 0.101 * plan.scale, near);
  assert_near(inlet->radius, 0.037 * plan.scale, near);
  assert_near(svg_distance(inlet->x[0], plan.centre), 0, 0);
  svg_text(&plan.sheet, "D2 = 200.0 mm; circles: D1 = 74.0 mm, interface r = 101.0 mm");
  svg_text(&plan.sheet,
           "Blades at mid-span in plan, from the suction side, x up; wrap 71.0, beta1 %.1f, beta2 %.1f deg",
           design.inlet_blade_angle / degree, design.outlet_blade_angle / degree);
  svg_free(&plan.sheet);
}

// Six, each a sixth of a turn before the last; from a leading edge half-way between those at hub and shroud, which is
// 71 degrees ahead of the end of the mean line, x axis of the first, out to D2.
static void blades_sweep_backward_by_the_wrap(void **state) {
  for (int k = 0; k < 2; k++) {
    const CwCase table = wheel(k ? CW_ROTATION_CLOCKWISE : CW_ROTATION_COUNTER_CLOCKWISE, CW_EDGE_BLUNT, 0);
    const CwDesign design = design_of(&table);
    Plan plan = drawn(&design, k ? -1 : 1);
    assert_int_equal(svg_count(&plan.sheet, SVG_AREA, NULL), 6);
    for (int b = 0; b < 6; b++) {
      const SvgItem *blade = svg_nth(&plan.sheet, SVG_AREA, SVG_BLADE, b);
      const double *nose = blade->x[FOREMOST];
      double most = 0, least = 1, first = 1, last = -1;
      for (int i = 0; i < blade->count; i++) {
        const double r = radius_of(&plan, blade->x[i]), at = turned(angle_of(&plan, blade->x[i]) - b * 60 * degree);
        most = fmax(most, r);
        least = fmin(least, r);
        if (r < 0.1 - 2e-5) continue; // the cut lies on D2
        first = fmin(first, at);
        last = fmax(last, at);
      }
      assert_near(most, 0.1, 3e-5);
      assert_near(radius_of(&plan, nose), (design.leading_edge_radius_hub + design.leading_edge_radius_shroud) / 2,
                  5e-5);
      assert_true(least < radius_of(&plan, nose) + 1e-12);
      assert_near(turned(angle_of(&plan, nose) - (71 + 60 * b) * degree), 0, 0.1 * degree);
      // A blade cut on a cylinder at the angle beta2 is its thickness over sin(beta2) wide there, half on either side.
      const double wide = design.trailing_edge_thickness / sin(design.outlet_blade_angle);
      assert_near(0.1 * (last - first), wide, 1e-2 * wide);
      assert_near(first + last, 0, 2e-2 * wide / 0.1);
    }
    svg_free(&plan.sheet);
  }
}

// The sides lie apart by the thickness, which on the middle of a blade is between that of its edges and the largest.
static void blades_have_their_thickness(void **state) {
  const CwCase table = wheel(CW_ROTATION_COUNTER_CLOCKWISE, CW_EDGE_BLUNT, 0);
  const CwDesign design = design_of(&table);
  Plan plan = drawn(&design, 1);
  const SvgItem *blade = svg_nth(&plan.sheet, SVG_AREA, SVG_BLADE, 0);
  for (int i = 30; i <= 90; i += 10) {
    const double *suction = blade->x[120 - i], *pressure = blade->x[145 + i];
    double least = INFINITY;
    for (int k = 145; k < 265; k++) least = fmin(least, svg_distance(suction, blade->x[k]) / plan.scale);
    assert_true(angle_of(&plan, pressure) > angle_of(&plan, suction)); // in front
    assert_true(least > 0.9 * fmin(design.leading_edge_thickness, design.trailing_edge_thickness));
    assert_true(least < 1.15 * design.blade_thickness); // the points lie apart by up to as much
  }
  svg_free(&plan.sheet);
}

// The facet closes a bevelled outline from the last point to the first; the usual bevel is as long as what is left of
// the cut. A sharp edge has a facet and no cut. A rounded one has neither: no two points lie as far apart.
static void trailing_edges_have_their_form(void **state) {
  for (int edge = CW_EDGE_BEVELLED; edge <= CW_EDGE_SHARP; edge++) {
    const CwCase table = wheel(CW_ROTATION_COUNTER_CLOCKWISE, (CwTrailingEdge)edge, 0);
    const CwDesign design = design_of(&table);
    Plan plan = drawn(&design, 1);
    const SvgItem *blade = svg_nth(&plan.sheet, SVG_AREA, SVG_BLADE, 0);
    const double *first = blade->x[0], *last = blade->x[blade->count - 1], *corner = blade->x[265];
    const double facet = svg_distance(first, last) / plan.scale, cut = svg_distance(corner, last) / plan.scale;
    double most = 0, longest = 0;
    for (int i = 0; i < blade->count; i++) {
      most = fmax(most, radius_of(&plan, blade->x[i]));
      if (i) longest = fmax(longest, svg_distance(blade->x[i - 1], blade->x[i]) / plan.scale);
    }
    assert_near(most, 0.1, 3e-5);
    if (edge == CW_EDGE_BEVELLED) assert_near(cut, design.trailing_edge_bevel, 0.03 * cut);
    if (edge == CW_EDGE_BEVELLED || edge == CW_EDGE_SHARP)
      assert_near(facet, design.trailing_edge_bevel, 0.03 * facet);
    else
      assert_near(facet, 0, 1e-9);
    if (edge == CW_EDGE_SHARP) assert_near(cut, 0, 1e-9);
    if (edge == CW_EDGE_ROUNDED) assert_true(longest < 0.7 * design.trailing_edge_thickness);
    svg_free(&plan.sheet);
  }
}

// The rays to both ends of blade 1 and the arc between them; the arrow turns as the wheel does.
static void wrap_and_rotation_are_marked(void **state) {
  for (int k = 0; k < 2; k++) {
    const CwCase table = wheel(k ? CW_ROTATION_CLOCKWISE : CW_ROTATION_COUNTER_CLOCKWISE, CW_EDGE_BEVELLED, 0);
    const CwDesign design = design_of(&table);
    Plan plan = drawn(&design, k ? -1 : 1);
    const SvgItem *arc = svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, 0);
    const double *end[2] = {arc->x[0], arc->x[arc->count - 1]};
    for (int i = 0; i < 2; i++) {
      const SvgItem *ray = svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, 1 + i);
      assert_near(svg_distance(ray->x[0], plan.centre), 0, 0);
      assert_near(angle_of(&plan, ray->x[1]), 71 * i * degree, 0.1 * degree);
      assert_near(angle_of(&plan, end[i]), 71 * i * degree, 0.1 * degree);
      assert_near(radius_of(&plan, end[i]), radius_of(&plan, end[0]), 1e-5);
    }
    assert_near(radius_of(&plan, svg_nth(&plan.sheet, SVG_LINE, SVG_THIN, 1)->x[1]), 0.1, 3e-5);
    const SvgItem *way = svg_nth(&plan.sheet, SVG_LINE, SVG_FLOW, 0), *head = svg_nth(&plan.sheet, SVG_HEAD, NULL, 0);
    const double *tail = way->x[0], *middle = way->x[20], *base = head->x[1];
    assert_true(turned(angle_of(&plan, middle) - angle_of(&plan, tail)) > 0.3);
    assert_true(turned(angle_of(&plan, head->x[0]) - angle_of(&plan, middle)) > 0.3);
    assert_true(turned(angle_of(&plan, head->x[0]) - angle_of(&plan, base)) > 0);
    assert_true(svg_distance(svg_text(&plan.sheet, "n")->x[0], middle) < 10);
    svg_free(&plan.sheet);
  }
}

// The sheet of the other hand is the mirror image of the first.
static void hands_are_mirror_images(void **state) {
  const CwCase table[2] = {wheel(CW_ROTATION_COUNTER_CLOCKWISE, CW_EDGE_BEVELLED, 0),
                           wheel(CW_ROTATION_CLOCKWISE, CW_EDGE_BEVELLED, 0)};
  const CwDesign design[2] = {design_of(&table[0]), design_of(&table[1])};
  Plan plan[2] = {drawn(&design[0], 1), drawn(&design[1], -1)};
  for (int b = 0; b < 6; b++) {
    const SvgItem *one = svg_nth(&plan[0].sheet, SVG_AREA, NULL, b),
                  *other = svg_nth(&plan[1].sheet, SVG_AREA, NULL, b);
    for (int i = 0; i < one->count; i++) {
      assert_near(one->x[i][0] + other->x[i][0], plan[0].sheet.width, 0.011);
      assert_near(one->x[i][1], other->x[i][1], 0);
    }
  }
  for (int k = 0; k < 2; k++) svg_free(&plan[k].sheet);
}

// As many again, from two fifths of the length on, in the middle of the pitch.
static void splitters_stand_between_the_blades(void **state) {
  CwCase table = wheel(CW_ROTATION_COUNTER_CLOCKWISE, CW_EDGE_BLUNT, 0.4);
  table.impeller.splitter_position = 0.45;
  const CwDesign design = design_of(&table);
  CwMeridian meridian;
  double begin[2];
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  cw_meridian_blade_point(&meridian, 0.5, 0.4, begin, NULL);
  Plan plan = drawn(&design, 1);
  assert_int_equal(svg_count(&plan.sheet, SVG_AREA, SVG_BLADE), 12);
  for (int b = 0; b < 6; b++) {
    const SvgItem *splitter = svg_nth(&plan.sheet, SVG_AREA, NULL, 6 + b);
    const double ends = angle_of(&plan, splitter->x[0]) +
                        turned(angle_of(&plan, splitter->x[265]) - angle_of(&plan, splitter->x[0])) / 2;
    assert_near(radius_of(&plan, splitter->x[FOREMOST]), begin[0], 5e-5);
    assert_near(turned(ends - (b + 0.45) * 60 * degree), 0, 0.1 * degree);
  }
  svg_free(&plan.sheet);
}

static void other_pumps_fit(void **state) {
  static const char *const name[] = {"ns40", "ns200", "splitters"};
  for (int i = 0; i < 3; i++) {
    const CwCase table = case_of(name[i]);
    const CwDesign design = design_of(&table);
    SvgSheet sheet = svg_drawn(cw_picture_blade_plan, &design);
    assert_int_equal(svg_count(&sheet, SVG_AREA, NULL), design.blade_count * (i == 2 ? 2 : 1));
    svg_free(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(circles_are_the_inlet_and_the_interface),
      cmocka_unit_test(blades_sweep_backward_by_the_wrap),
      cmocka_unit_test(blades_have_their_thickness),
      cmocka_unit_test(trailing_edges_have_their_form),
      cmocka_unit_test(wrap_and_rotation_are_marked),
      cmocka_unit_test(hands_are_mirror_images),
      cmocka_unit_test(splitters_stand_between_the_blades),
      cmocka_unit_test(other_pumps_fit),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
