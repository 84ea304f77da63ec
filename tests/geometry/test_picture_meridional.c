// SPDX-License-Identifier: AGPL-3.0-or-later
// The meridional section as it is read: by its scale bar from the axis, the chain line, and from z = 0, half-way along
// the interface.
#include "geometry/hydraulic_design.h"
#include "geometry/picture.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/geometry/svg_sheet.h"

static const double near = 0.1; // px: the scale bar is drawn to 0.02 of its 110

typedef struct {
  SvgSheet sheet;
  double scale, axis, middle; // px per m; y of r = 0, x of z = 0
} Section;

// With `shape`, wherever the water goes: a shaft, splitters and fillets.
static CwDesign design_with(int shape) {
  CwCase table = paper();
  if (shape) {
    table.impeller.hub_diameter = 0.03;
    table.impeller.through_shaft_diameter = 0.024;
    table.impeller.splitter_start = 0.4;
    table.impeller.root_fillet_radius = 1e-3;
  }
  return design_of(&table);
}

static Section drawn(const CwDesign *design) {
  Section s = {.sheet = svg_drawn(cw_picture_meridional, design)};
  const SvgItem *axis = svg_nth(&s.sheet, SVG_CHAIN, NULL, 0), *interface = svg_nth(&s.sheet, SVG_LINE, SVG_THIN, 1);
  s.scale = svg_scale(&s.sheet);
  s.axis = axis->x[0][1];
  s.middle = (interface->x[0][0] + interface->x[1][0]) / 2;
  assert_near(axis->x[1][1], s.axis, 0);
  return s;
}

static void lies_at(const Section *s, const double x[2], double r, double z) {
  assert_near(x[0], s->middle + s->scale * z, near);
  assert_near(x[1], s->axis - s->scale * r, near);
}

// A wheel of 74 and 200 mm with an outlet 8 mm wide, its interface at (200 + 204) / 4 = 101 mm.
static void walls_have_the_dimensions(void **state) {
  const CwDesign design = design_with(0);
  Section s = drawn(&design);
  const double rn = design.hub_diameter / 2, length = design.axial_length, share = design.hub_pole_radial;
  const double hub_begin = 0.004 - 1.2 * length, inlet = -0.004 - length - design.suction_pipe_length;
  const SvgItem *hub = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 0), *shroud = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 1);
  lies_at(&s, hub->x[0], rn, hub_begin);
  lies_at(&s, hub->x[hub->count - 1], 0.101, 0.004);
  // Half-way of a cubic with its poles at (rn, begin), (rn, 4 mm), (rn + share (37 mm - rn), 4 mm), (101 mm, 4 mm).
  lies_at(&s, hub->x[40], (7 * rn + 3 * share * (0.037 - rn) + 0.101) / 8, 0.004 - 1.2 * length / 8);
  lies_at(&s, shroud->x[0], 0.037, -0.004 - length);
  lies_at(&s, shroud->x[shroud->count - 1], 0.101, -0.004);
  const SvgItem *nut = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 2), *pipe = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 3);
  lies_at(&s, nut->x[0], 0, hub_begin - design.nut_length);
  lies_at(&s, nut->x[1], design.nut_disk_radius, hub_begin - design.nut_length);
  // Half-way round a quarter of an ellipse.
  lies_at(&s, nut->x[41], design.nut_disk_radius + (rn - design.nut_disk_radius) * sqrt(0.5),
          hub_begin - design.nut_length * sqrt(0.5));
  lies_at(&s, nut->x[nut->count - 1], rn, hub_begin);
  lies_at(&s, pipe->x[0], 0.037, inlet);
  lies_at(&s, pipe->x[1], 0.037, -0.004 - length);
  const SvgItem *in = svg_nth(&s.sheet, SVG_LINE, SVG_THIN, 0), *out = svg_nth(&s.sheet, SVG_LINE, SVG_THIN, 1);
  lies_at(&s, in->x[0], 0, inlet);
  lies_at(&s, in->x[1], 0.037, inlet);
  lies_at(&s, out->x[0], 0.101, -0.004);
  lies_at(&s, out->x[1], 0.101, 0.004);
  svg_free(&s.sheet);
}

// The water enters to the right, between axis and pipe.
static void the_flow_enters_the_eye(void **state) {
  const CwDesign design = design_with(0);
  Section s = drawn(&design);
  const SvgItem *arrow = svg_nth(&s.sheet, SVG_LINE, SVG_FLOW, 0), *head = svg_nth(&s.sheet, SVG_HEAD, SVG_FLOW, 0);
  const SvgItem *pipe = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 3);
  assert_near(arrow->x[0][0], pipe->x[0][0], near);
  assert_true(head->x[0][0] > arrow->x[0][0] + 20 && head->x[0][0] < pipe->x[1][0]);
  assert_true(head->x[0][1] < s.axis && head->x[0][1] > pipe->x[0][1]);
  assert_near(head->x[0][1], arrow->x[0][1], 0);
  svg_free(&s.sheet);
}

// The blade lies between hub and shroud, from the leading edge's radii to D2: first along the hub, then back.
static void the_blade_has_its_edges(void **state) {
  for (int shape = 0; shape < 2; shape++) {
    const CwDesign design = design_with(shape);
    Section s = drawn(&design);
    assert_int_equal(svg_count(&s.sheet, SVG_AREA, NULL), 1);
    const SvgItem *blade = svg_nth(&s.sheet, SVG_AREA, SVG_BLADE, 0);
    const int last = blade->count - 1, half = last / 2;
    const double radius[4] = {design.leading_edge_radius_hub, 0.1, 0.1, design.leading_edge_radius_shroud};
    for (int k = 0; k < 4; k++) {
      const double *x = blade->x[k == 0 ? 0 : k == 1 ? half : k == 2 ? half + 1 : last];
      const SvgItem *wall = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, k > 1);
      double least = INFINITY;
      for (int i = 0; i < 1000 * (wall->count - 1); i++) {
        const double *a = wall->x[i / 1000], *b = wall->x[i / 1000 + 1], f = i % 1000 * 1e-3;
        least = fmin(least, svg_distance(x, (double[]){a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1])}));
      }
      assert_near((s.axis - x[1]) / s.scale, radius[k], near / s.scale);
      assert_true(least < 0.2);
    }
    svg_free(&s.sheet);
  }
}

static double length_of(const double (*x)[2], int from, int to) {
  double sum = 0;
  for (int i = from; i < to; i++) sum += svg_distance(x[i], x[i + 1]);
  return sum;
}

// A line across the blade, two fifths of its length from the leading edge on either wall.
static void splitters_begin_where_they_do(void **state) {
  const CwDesign plain = design_with(0), design = design_with(1);
  Section s = drawn(&plain);
  assert_int_equal(svg_count(&s.sheet, SVG_LINE, SVG_BLADE), 0);
  svg_free(&s.sheet);
  s = drawn(&design);
  assert_int_equal(svg_count(&s.sheet, SVG_LINE, SVG_BLADE), 1);
  const SvgItem *line = svg_nth(&s.sheet, SVG_LINE, SVG_BLADE, 0), *blade = svg_nth(&s.sheet, SVG_AREA, SVG_BLADE, 0);
  const double(*x)[2] = (const double(*)[2])blade->x;
  for (int side = 0; side < 2; side++) {
    const int at = side ? 161 - 32 : 32, from = side ? 81 : 0;
    const double share = length_of(x, from, at) / length_of(x, from, from + 80);
    assert_near(side ? 1 - share : share, 0.4, 1e-3);
    assert_near(svg_distance(x[at], line->x[side]), 0, 0.05);
  }
  svg_free(&s.sheet);
}

// nq = 1450 sqrt(25 / 3600) / 10^0.75 = 21.5.
static void labels_say_what_is_drawn(void **state) {
  for (int shape = 0; shape < 2; shape++) {
    const CwDesign design = design_with(shape);
    Section s = drawn(&design);
    svg_text(&s.sheet,
             "Meridional section: z = 6%s, nq = 21.5; passage %.0f mm2 in the eye, %.0f at the blade, %.0f at D2",
             shape ? " with splitters" : "", 1e6 * design.passage_area_eye, 1e6 * design.passage_area_inlet,
             1e6 * design.passage_area_outlet);
    const SvgItem *pipe = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 3), *hub = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 0);
    const double outlet[2] = {s.middle + 0.004 * s.scale, s.axis - 0.1 * s.scale};
    // Each beside the place that it names.
    assert_true(svg_distance(svg_text(&s.sheet, "D1 = 74.0 mm")->x[0], pipe->x[0]) < 15);
    assert_true(svg_distance(svg_text(&s.sheet, "D2 = 200.0 mm")->x[0], outlet) < 15);
    assert_near(svg_text(&s.sheet, "b2 = 8.0 mm")->x[0][0], s.middle, near);
    assert_true(svg_distance(svg_text(&s.sheet, "hub diameter = %d.0 mm", shape ? 30 : 24)->x[0], hub->x[0]) < 25);
    const SvgItem *blade = svg_nth(&s.sheet, SVG_AREA, SVG_BLADE, 0);
    const SvgItem *at_hub = svg_text(&s.sheet, "leading edge: hub r = %.1f mm", 1e3 * design.leading_edge_radius_hub);
    assert_near(at_hub->x[0][1], blade->x[0][1], 10);
    assert_true(at_hub->x[0][0] > s.middle);
    assert_true(
        svg_distance(
            svg_text(&s.sheet, "leading edge: shroud r = %.1f mm", 1e3 * design.leading_edge_radius_shroud)->x[0],
            blade->x[blade->count - 1]) < 15);
    assert_int_equal(svg_says(&s.sheet, "shaft"), shape);
    assert_int_equal(svg_says(&s.sheet, "fillets"), shape);
    if (shape) svg_text(&s.sheet, "root fillets: R = 1.0 mm");
    if (shape) svg_text(&s.sheet, "shaft = 24.0 mm");
    svg_free(&s.sheet);
  }
}

// The shaft's wall begins in the inlet, which is a ring round it.
static void a_shaft_goes_out_through_the_inlet(void **state) {
  const CwDesign design = design_with(1);
  Section s = drawn(&design);
  const SvgItem *nut = svg_nth(&s.sheet, SVG_LINE, SVG_WALL, 2), *inlet = svg_nth(&s.sheet, SVG_LINE, SVG_THIN, 0);
  const double z = -0.004 - design.axial_length - design.suction_pipe_length;
  lies_at(&s, nut->x[0], 0.012, z);
  lies_at(&s, nut->x[1], 0.012, 0.004 - 1.2 * design.axial_length - design.nut_length);
  lies_at(&s, inlet->x[0], 0.012, z);
  lies_at(&s, inlet->x[1], 0.037, z);
  svg_free(&s.sheet);
}

// From narrow wheels to wide ones: all that is drawn and written lies on the sheet.
static void other_pumps_fit(void **state) {
  static const char *const name[] = {"ns40", "ns200", "zones"};
  for (int i = 0; i < 3; i++) {
    const CwCase table = case_of(name[i]);
    const CwDesign design = design_of(&table);
    SvgSheet sheet = svg_drawn(cw_picture_meridional, &design);
    svg_text(&sheet, "D2 = %.1f mm", 1e3 * design.outlet_diameter);
    svg_free(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(walls_have_the_dimensions), cmocka_unit_test(the_flow_enters_the_eye),
      cmocka_unit_test(the_blade_has_its_edges),   cmocka_unit_test(splitters_begin_where_they_do),
      cmocka_unit_test(labels_say_what_is_drawn),  cmocka_unit_test(a_shaft_goes_out_through_the_inlet),
      cmocka_unit_test(other_pumps_fit),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
