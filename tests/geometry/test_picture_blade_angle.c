// SPDX-License-Identifier: AGPL-3.0-or-later
// The charts along the blade as they are read: a point of a curve by the numbers at the grid lines.
#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "geometry/picture.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/geometry/svg_sheet.h"

static const double degree = M_PI / 180;

enum { STEPS = 60 }; // of a curve
enum { ANGLE, AREA };

static CwDesign design_with(double splitter_start) {
  CwCase table = paper();
  if (splitter_start > 0) table.impeller.splitter_start = splitter_start;
  return design_of(&table);
}

// The value at y of a chart, by its lowest and highest grid line, of six, and the numbers at them.
static double value_at(const SvgSheet *sheet, int chart, double y) {
  double at[2], value[2];
  for (int k = 0; k < 2; k++) {
    const SvgItem *number = NULL;
    at[k] = svg_nth(sheet, SVG_LINE, SVG_THIN, 6 * chart + 5 * k)->x[0][1];
    for (int i = 0; i < sheet->count; i++)
      if (sheet->item[i].kind == SVG_TEXT && sheet->item[i].align == 'e' && fabs(sheet->item[i].x[0][1] - at[k]) < 6)
        number = &sheet->item[i];
    assert_non_null(number);
    value[k] = atof(number->text);
  }
  return value[0] + (y - at[0]) / (at[1] - at[0]) * (value[1] - value[0]);
}

// A curve of a chart by its colour, at equal steps of the share from 0.0 to 1.0.
static void curve(const SvgSheet *sheet, int chart, const char *colour, double value[STEPS + 1]) {
  const double left = svg_nth(sheet, SVG_LINE, SVG_THIN, 0)->x[0][0], right = left + 560;
  for (int n = 0;; n++) {
    const SvgItem *line = svg_nth(sheet, SVG_LINE, colour, n);
    const double top = svg_nth(sheet, SVG_LINE, SVG_THIN, 6 * chart + 5)->x[0][1];
    if (line->count != STEPS + 1 || line->x[0][1] < top - 1 || line->x[0][1] > top + 221) continue;
    for (int i = 0; i <= STEPS; i++) {
      assert_near(line->x[i][0], left + (right - left) * i / STEPS, 0.006);
      value[i] = value_at(sheet, chart, line->x[i][1]);
    }
    return;
  }
}

// Both charts have the shares of the length below and even steps of a round number beside them, which the curves reach
// over nearly half or more.
static void axes_are_numbered(void **state) {
  for (int k = 0; k < 2; k++) {
    const CwDesign design = design_with(0.4 * k);
    SvgSheet sheet = svg_drawn(cw_picture_blade_angle, &design);
    assert_int_equal(svg_count(&sheet, SVG_LINE, SVG_THIN), 12);
    for (int chart = 0; chart < 2; chart++) {
      const double top = svg_nth(&sheet, SVG_LINE, SVG_THIN, 6 * chart + 5)->x[0][1];
      const double bottom = svg_nth(&sheet, SVG_LINE, SVG_THIN, 6 * chart)->x[0][1];
      double value[STEPS + 1], most = 0;
      int steps = 0;
      curve(&sheet, chart, chart == ANGLE ? SVG_WALL : SVG_BLADE, value);
      for (int i = 0; i <= STEPS; i++) most = fmax(most, value[i]);
      assert_true(most < value_at(&sheet, chart, top) && most > 0.45 * value_at(&sheet, chart, top));
      assert_near(value_at(&sheet, chart, bottom), 0, 0);
      for (int i = 0; i < sheet.count; i++) {
        const SvgItem *item = &sheet.item[i];
        if (item->kind != SVG_TEXT) continue;
        if (item->align == 'e' && item->x[0][1] > top - 1 && item->x[0][1] < bottom + 6) {
          assert_near(atof(item->text), value_at(&sheet, chart, item->x[0][1] - 4), 1e-4 * most);
          steps++;
        }
        if (item->align == 'm' && fabs(item->x[0][1] - bottom - 18) < 1)
          assert_near(atof(item->text), (item->x[0][0] - 80) / 560, 1e-9);
      }
      assert_int_equal(steps, 6);
    }
    svg_text(&sheet, "Blade angle beta from the tangential direction, deg");
    svg_text(&sheet, "Passage area normal to the meridional flow, mm2");
    svg_text(&sheet, "Along the blade, from the leading (0) to the trailing edge (1)");
    svg_text(&sheet, "share of the meridional length");
    svg_free(&sheet);
  }
}

// From beta1, whose tangent falls as 1 / r from hub to shroud, to beta2, by a law of the second degree: its third
// differences are nothing.
static void angles_follow_the_law(void **state) {
  static const char *const colour[] = {SVG_WALL, SVG_FLOW, SVG_BLADE};
  static const char *const where[] = {"hub", "mid-span", "shroud"};
  const CwDesign design = design_with(0);
  SvgSheet sheet = svg_drawn(cw_picture_blade_angle, &design);
  const double rh = design.leading_edge_radius_hub, rs = design.leading_edge_radius_shroud, rm = (rh + rs) / 2;
  const double radius[3] = {rh, rm, rs}, near = 0.03; // deg: of 50 over 220 px to 0.01
  for (int j = 0; j < 3; j++) {
    double beta[STEPS + 1];
    curve(&sheet, ANGLE, colour[j], beta);
    assert_near(beta[0], atan(tan(design.inlet_blade_angle) * rm / radius[j]) / degree, near);
    assert_near(beta[STEPS], design.outlet_blade_angle / degree, near);
    assert_near(beta[0] - 3 * beta[20] + 3 * beta[40] - beta[60], 0, 8 * near);
    // The legend: a short line of its colour before its name.
    const SvgItem *name = svg_text(&sheet, "%s", where[j]);
    int found = 0;
    for (int i = 0; i < sheet.count; i++) {
      const SvgItem *line = &sheet.item[i];
      if (line->kind != SVG_LINE || line->count != 2 || strcmp(line->colour, colour[j])) continue;
      found += fabs(line->x[1][0] - name->x[0][0]) < 12 && fabs(line->x[1][1] - name->x[0][1]) < 6;
    }
    assert_int_equal(found, 1);
  }
  svg_free(&sheet);
}

// The wrap is the integral of dm / (r tan beta) along mid-span: 71 degrees.
static void the_angle_has_the_wrap(void **state) {
  const CwDesign design = design_with(0);
  SvgSheet sheet = svg_drawn(cw_picture_blade_angle, &design);
  CwMeridian meridian;
  double beta[STEPS + 1], wrap = 0;
  assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
  curve(&sheet, ANGLE, SVG_FLOW, beta);
  for (int i = 0; i < STEPS; i++) {
    double a[2], b[2];
    cw_meridian_blade_point(&meridian, 0.5, (double)i / STEPS, a, NULL);
    cw_meridian_blade_point(&meridian, 0.5, (i + 1.0) / STEPS, b, NULL);
    wrap += svg_distance(a, b) / ((a[0] + b[0]) / 2 * tan((beta[i] + beta[i + 1]) / 2 * degree));
  }
  assert_near(wrap / degree, 71, 0.1);
  svg_free(&sheet);
}

// Without blades the area runs from the eye's to nearly pi D2 b2. Blades take t / sin beta each of the circumference:
// nothing at the tip of the nose, the largest thickness where it is, that of the trailing edge at the end; splitters as
// much again from where they begin.
static void blades_take_their_thickness_of_the_area(void **state) {
  for (int k = 0; k < 2; k++) {
    const CwDesign design = design_with(0.4 * k);
    SvgSheet sheet = svg_drawn(cw_picture_blade_angle, &design);
    CwMeridian meridian;
    double open[STEPS + 1], blocked[STEPS + 1], beta[STEPS + 1];
    assert_int_equal(cw_meridian_make(&design, &meridian), CW_OK);
    curve(&sheet, AREA, SVG_BLADE, open);
    curve(&sheet, AREA, SVG_FLOW, blocked);
    curve(&sheet, ANGLE, SVG_FLOW, beta);
    const double near = 1e6 * design.passage_area_outlet * 3e-4;
    assert_near(open[0], 1e6 * design.passage_area_inlet, near);
    assert_near(open[STEPS], 1e6 * design.passage_area_outlet, near);
    assert_near(open[STEPS], M_PI * 200 * 8, 0.002 * open[STEPS]);
    assert_near(blocked[0], open[0], near);
    const int thickest = (int)lround(design.thickest_at * STEPS), place[] = {thickest, STEPS};
    const double thickness[] = {design.blade_thickness, design.trailing_edge_thickness};
    for (int i = 0; i < 2; i++) {
      double x[2];
      cw_meridian_blade_point(&meridian, 0.5, (double)place[i] / STEPS, x, NULL);
      const int blades = k && place[i] >= 24 ? 12 : 6;
      const double taken = blades * thickness[i] / (2 * M_PI * x[0] * sin(beta[place[i]] * degree));
      assert_near(1 - blocked[place[i]] / open[place[i]], taken, 2e-3);
    }
    // Where splitters begin, at step 24, the step is as large as all that the blades take before.
    const double before = 1 - blocked[23] / open[23], behind = 1 - blocked[24] / open[24];
    assert_near(behind / before, k ? 2 : 1, 0.1);
    assert_true(svg_text(&sheet, "without blades")->x[0][1] < svg_text(&sheet, "with blades")->x[0][1]);
    svg_free(&sheet);
  }
}

static void other_pumps_fit(void **state) {
  static const char *const name[] = {"ns40", "ns200", "nq24"};
  for (int i = 0; i < 3; i++) {
    const CwCase table = case_of(name[i]);
    const CwDesign design = design_of(&table);
    SvgSheet sheet = svg_drawn(cw_picture_blade_angle, &design);
    double beta[STEPS + 1];
    curve(&sheet, ANGLE, SVG_FLOW, beta);
    assert_near(beta[STEPS], design.outlet_blade_angle / degree, 0.03);
    svg_free(&sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(axes_are_numbered),      cmocka_unit_test(angles_follow_the_law),
      cmocka_unit_test(the_angle_has_the_wrap), cmocka_unit_test(blades_take_their_thickness_of_the_area),
      cmocka_unit_test(other_pumps_fit),
  };
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
