// SPDX-License-Identifier: AGPL-3.0-or-later
// The triangles as they are read: lengths of the arrows at one scale, the names beside them, and the table. u = omega r
// with omega = 1450 pi / 30; the water enters without swirl, so that c = c_m and w^2 = u^2 + c_m^2.
#include "geometry/hydraulic_design.h"
#include "geometry/picture.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/geometry/svg_sheet.h"

static const double degree = M_PI / 180, omega = 1450 * M_PI / 30;

enum { OUTLET = 3, TRIANGLES };

// An arrow from its tail to its tip.
typedef struct {
  double from[2], to[2];
} Arrow;

static Arrow arrow(const SvgSheet *sheet, const char *colour, int n) {
  const double *tail = svg_nth(sheet, SVG_LINE, colour, n)->x[0], *tip = svg_nth(sheet, SVG_HEAD, colour, n)->x[0];
  return (Arrow){{tail[0], tail[1]}, {tip[0], tip[1]}};
}

static double length(const Arrow *a) {
  return svg_distance(a->from, a->to);
}

static CwDesign paper_design(void) {
  const CwCase table = paper();
  return design_of(&table);
}

static double radius_of(const CwDesign *design, int t) {
  return t == OUTLET ? 0.1
         : t == 0    ? design->leading_edge_radius_hub
         : t == 2    ? design->leading_edge_radius_shroud
                     : (design->leading_edge_radius_hub + design->leading_edge_radius_shroud) / 2;
}

// u lies level, c begins with it, w ends where c does, and all four triangles have one scale.
static void arrows_close_at_one_scale(void **state) {
  const CwDesign design = paper_design();
  SvgSheet sheet = svg_drawn(cw_picture_velocity_triangles, &design);
  const Arrow first = arrow(&sheet, SVG_WALL, OUTLET);
  const double scale = length(&first) / (omega * 0.1), near = 0.03; // px per m/s; px
  assert_int_equal(svg_count(&sheet, SVG_HEAD, NULL), 3 * TRIANGLES);
  for (int t = 0; t < TRIANGLES; t++) {
    const Arrow u = arrow(&sheet, SVG_WALL, t), c = arrow(&sheet, SVG_FLOW, t), w = arrow(&sheet, SVG_BLADE, t);
    const double c_m = t == OUTLET ? design.outlet_triangle[1].c_m : design.inlet_triangle[t].c_m;
    const double c_u = t == OUTLET ? design.outlet_swirl_speed : 0, speed = omega * radius_of(&design, t);
    assert_near(u.from[1], u.to[1], 0);
    assert_near(u.to[0] - u.from[0], scale * speed, near);
    assert_near(svg_distance(u.from, c.from) + svg_distance(u.to, w.from) + svg_distance(c.to, w.to), 0, 0);
    assert_near(c.to[0] - c.from[0], scale * c_u, near);
    assert_near(c.from[1] - c.to[1], scale * c_m, near);
    svg_text(&sheet, "u = %.2f", speed);
    svg_text(&sheet, "c = %.2f", hypot(c_u, c_m));
    svg_text(&sheet, "w = %.2f", hypot(speed - c_u, c_m));
  }
  svg_text(&sheet, "outlet, mid-span; chain line: without slip");
  svg_free(&sheet);
}

// Without slip w would have the angle of the blade, where the blades leave less room to c_m; the slip is (1 - gamma) u.
static void slip_parts_both_apexes(void **state) {
  const CwDesign design = paper_design();
  SvgSheet sheet = svg_drawn(cw_picture_velocity_triangles, &design);
  const Arrow u = arrow(&sheet, SVG_WALL, OUTLET), w = arrow(&sheet, SVG_BLADE, OUTLET);
  const double scale = length(&u) / (omega * 0.1), slip = (1 - design.slip_factor) * omega * 0.1;
  const SvgItem *blade = svg_nth(&sheet, SVG_CHAIN, NULL, 0), *gap = svg_nth(&sheet, SVG_CHAIN, NULL, 1);
  assert_int_equal(svg_count(&sheet, SVG_CHAIN, NULL), 2);
  assert_near(svg_distance(blade->x[0], u.to), 0, 0);
  assert_near(svg_distance(gap->x[0], w.to), 0, 0);
  assert_near(svg_distance(gap->x[1], blade->x[1]), 0, 0);
  assert_near(gap->x[1][0] - gap->x[0][0], scale * slip, 0.03);
  assert_near(gap->x[1][1], gap->x[0][1], 0);
  const double back = blade->x[0][0] - blade->x[1][0], up = blade->x[0][1] - blade->x[1][1];
  assert_near(atan2(design.outlet_blockage * up, back), design.outlet_blade_angle, 1e-3);
  svg_text(&sheet, "slip %.2f", slip);
  svg_free(&sheet);
}

// Whether a line passes through a box of left, right, top and bottom: what is left of it between them.
static int passes(const double a[2], const double b[2], const double box[4]) {
  double from = 0, to = 1;
  for (int k = 0; k < 2; k++) {
    const double d = b[k] - a[k], low = box[2 * k] - a[k], high = box[2 * k + 1] - a[k];
    if (d == 0 && (low > 0 || high < 0)) return 0;
    if (d == 0) continue;
    from = fmax(from, fmin(low / d, high / d));
    to = fmin(to, fmax(low / d, high / d));
  }
  return from < to;
}

static void names_keep_clear(const SvgSheet *sheet) {
  double box[4];
  for (int i = 0; i < sheet->count; i++) {
    const SvgItem *line = &sheet->item[i];
    if (line->kind != SVG_LINE && line->kind != SVG_CHAIN && line->kind != SVG_HEAD) continue;
    for (int k = 0; k < sheet->count; k++) {
      if (sheet->item[k].kind != SVG_TEXT) continue;
      svg_text_box(&sheet->item[k], box);
      for (int j = 0; j + 1 < line->count; j++)
        if (passes(line->x[j], line->x[j + 1], box)) fail_msg("a line passes through '%s'", sheet->item[k].text);
    }
  }
}

// The name of u stands below its middle, that of c before its middle, that of w by its arrow.
static void names_stand_by_their_arrows(void **state) {
  const CwDesign design = paper_design();
  SvgSheet sheet = svg_drawn(cw_picture_velocity_triangles, &design);
  names_keep_clear(&sheet);
  for (int t = 0; t < TRIANGLES; t++) {
    const Arrow u = arrow(&sheet, SVG_WALL, t), c = arrow(&sheet, SVG_FLOW, t), w = arrow(&sheet, SVG_BLADE, t);
    const CwTriangle *of = t == OUTLET ? &design.outlet_triangle[1] : &design.inlet_triangle[t];
    double box[4];
    svg_text_box(svg_text(&sheet, "u = %.2f", of->u), box);
    assert_near((box[0] + box[1]) / 2, (u.from[0] + u.to[0]) / 2, 1);
    assert_true(box[2] > u.to[1] && box[3] < u.to[1] + 30);
    svg_text_box(svg_text(&sheet, "c = %.2f", of->c), box);
    assert_true(box[1] < (c.from[0] + c.to[0]) / 2 && box[1] > (c.from[0] + c.to[0]) / 2 - 15);
    svg_text_box(svg_text(&sheet, "w = %.2f", of->w), box);
    assert_true(box[0] > w.to[0] && box[1] < u.to[0] + 70 && box[3] < u.to[1] && box[2] > w.to[1] - 20);
  }
  svg_free(&sheet);
}

// The numbers in the line of text `row`, from left to right, each below the end of its head.
static void numbers_of_row(const SvgSheet *sheet, int row, double value[9]) {
  static const char *const head[] = {"r, mm", "u", "c_m", "c_u", "c", "w", "flow, deg", "blade, deg", "difference"};
  for (int k = 0; k < 9; k++) {
    const double x = svg_text(sheet, "%s", head[k])->x[0][0];
    int found = 0;
    for (int i = 0; i < sheet->count; i++) {
      const SvgItem *item = &sheet->item[i];
      if (item->kind != SVG_TEXT || item->align != 'e' || item->x[0][1] != sheet->item[row].x[0][1]) continue;
      if (item->x[0][0] == x) value[k] = atof(item->text), found++;
    }
    assert_int_equal(found, 1);
  }
}

static void the_table_has_all_speeds_and_angles(void **state) {
  static const char *const where[] = {"inlet, hub",  "inlet, mid-span",  "inlet, shroud",
                                      "outlet, hub", "outlet, mid-span", "outlet, shroud"};
  CwDesign design = paper_design();
  CwTriangle *shroud = &design.outlet_triangle[2]; // as if the flow were faster there
  shroud->c_u += 0.5;
  shroud->c = hypot(shroud->c_u, shroud->c_m);
  shroud->w = hypot(shroud->u - shroud->c_u, shroud->c_m);
  shroud->flow_angle = atan2(shroud->c_m, shroud->u - shroud->c_u);
  SvgSheet sheet = svg_drawn(cw_picture_velocity_triangles, &design);
  const double r1 = radius_of(&design, 1);
  for (int t = 0; t < 6; t++) {
    int row = -1;
    for (int i = 0; i < sheet.count; i++) // the last text that is this
      if (sheet.item[i].kind == SVG_TEXT && !strcmp(sheet.item[i].text, where[t])) row = i;
    const double r = t < 3 ? radius_of(&design, t) : 0.1, u = omega * r;
    const double c_m = (t < 3 ? design.inlet_triangle : design.outlet_triangle)[t % 3].c_m;
    const double c_u = t < 3 ? 0 : design.outlet_triangle[t % 3].c_u;
    // The blade's angle at the inlet is that of uniform c_m: its tangent falls as 1 / r.
    const double blade = t < 3 ? atan(tan(design.inlet_blade_angle) * r1 / r) : design.outlet_blade_angle;
    const double flow = atan2(c_m, u - c_u);
    const double wanted[9] = {1e3 * r,
                              u,
                              c_m,
                              c_u,
                              hypot(c_u, c_m),
                              hypot(u - c_u, c_m),
                              flow / degree,
                              blade / degree,
                              (blade - flow) / degree};
    double value[9] = {0};
    assert_true(row >= 0);
    numbers_of_row(&sheet, row, value);
    for (int k = 0; k < 9; k++) assert_near(value[k], wanted[k], k == 0 || k > 5 ? 0.0501 : 0.00501);
  }
  svg_text(&sheet, "slip factor %.3f (Wiesner %.3f, Pfleiderer %.3f), w2/w1 %.2f, predicted head %.2f m, asked 10.00 m",
           design.slip_factor, design.slip_factor_wiesner, design.slip_factor_pfleiderer, design.diffusion_ratio,
           design.predicted_head);
  svg_free(&sheet);
}

// Steep and flat triangles: nothing leaves the sheet, no name stands on another or on a line.
static void other_pumps_fit(void **state) {
  static const char *const name[] = {"ns40", "ns200", "nq24", "splitters"};
  for (int i = 0; i < 4; i++) {
    const CwCase table = case_of(name[i]);
    const CwDesign design = design_of(&table);
    SvgSheet sheet = svg_drawn(cw_picture_velocity_triangles, &design);
    names_keep_clear(&sheet);
    svg_free(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arrows_close_at_one_scale),
      cmocka_unit_test(slip_parts_both_apexes),
      cmocka_unit_test(names_stand_by_their_arrows),
      cmocka_unit_test(the_table_has_all_speeds_and_angles),
      cmocka_unit_test(other_pumps_fit),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
