// SPDX-License-Identifier: AGPL-3.0-or-later
// The sections of the volute as they are read: the chart by its numbers, the outlines by the inlet's width, the orange
// line, from the base circle on which it lies.
#include "geometry/hydraulic_design.h"
#include "geometry/picture.h"
#include "tests/geometry/paper_rotor.h"
#include "tests/geometry/svg_sheet.h"

static const double degree = M_PI / 180;

enum { COUNT = 8, HALF = 50 }; // outlines; points of each half

typedef struct {
  SvgSheet sheet;
  double scale, base; // px per m and y of D3/2, of the outlines
  double area[COUNT + 1], radius[COUNT + 1];
  const SvgItem *outline[COUNT + 1]; // from the first with an area, at 45 degrees
} Sections;

// All families with both laws of the spiral and both discharges.
enum { KINDS = 6 };
static CwDesign designs[KINDS];

static int make_designs(void **state) {
  for (int kind = 0; kind < KINDS; kind++) {
    CwCase table = paper();
    table.volute.section = (CwVoluteSectionKind)(kind % 3);
    if (table.volute.section == CW_SECTION_RECTANGLE) table.volute.corner_radius = 3e-3;
    table.volute.area_law = kind < 3 ? CW_AREA_LAW_ANGULAR_MOMENTUM : CW_AREA_LAW_VELOCITY;
    table.volute.discharge = kind < 3 ? CW_DISCHARGE_TANGENTIAL : CW_DISCHARGE_RADIAL;
    designs[kind] = design_of(&table);
  }
  return make_test_folder(state);
}

// Outlines, each with its number of degrees, area and radius; the last is filled.
static Sections drawn(const CwDesign *design) {
  Sections s = {.sheet = svg_drawn(cw_picture_volute_sections, design)};
  const SvgItem *inlet = svg_nth(&s.sheet, SVG_LINE, SVG_FLOW, 1);
  int found = 0;
  s.base = inlet->x[0][1];
  s.scale = svg_distance(inlet->x[0], inlet->x[1]) / design->inlet_width;
  for (int i = 0; i < s.sheet.count; i++) {
    const SvgItem *item = &s.sheet.item[i];
    int angle;
    double area, radius;
    if (item->kind != SVG_TEXT || sscanf(item->text, "%d deg: %lf mm2, r = %lf mm", &angle, &area, &radius) != 3)
      continue;
    assert_int_equal(angle % 45, 0);
    assert_in_range(angle, 45, 360);
    s.area[angle / 45] = area * 1e-6;
    s.radius[angle / 45] = radius * 1e-3;
    found++;
    assert_int_equal(item[-1].count, 2); // a line from the outline to the name
    assert_near(item[-1].x[0][1], item->x[0][1] - 4, 0.011);
    assert_int_equal(item[-2].count, 2 * HALF);
    assert_int_equal(item[-2].kind, angle == 360 ? SVG_AREA : SVG_LINE);
    s.outline[angle / 45] = &item[-2];
  }
  assert_int_equal(found, COUNT);
  return s;
}

// Each outline is symmetric about the middle, begins on the base circle as wide as the inlet, holds the area that is
// written, and reaches as far out as is written.
static void outlines_hold_their_areas(void **state) {
  for (int kind = 0; kind < KINDS; kind++) {
    const CwDesign *design = &designs[kind];
    Sections s = drawn(design);
    const double middle = svg_nth(&s.sheet, SVG_CHAIN, NULL, 1)->x[0][0];
    for (int i = 1; i <= COUNT; i++) {
      const SvgItem *line = s.outline[i];
      double area = 0, top = s.base;
      for (int k = 0; k < 2 * HALF; k++) {
        const double *a = line->x[k], *b = line->x[(k + 1) % (2 * HALF)];
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
        top = fmin(top, a[1]);
        assert_near(a[0] + line->x[2 * HALF - 1 - k][0], 2 * middle, 0.021);
        assert_near(a[1], line->x[2 * HALF - 1 - k][1], 0);
      }
      assert_near(line->x[0][1], s.base, 0.011);
      assert_near(fabs(line->x[0][0] - middle), design->inlet_width / 2 * s.scale, 0.02);
      assert_near(fabs(area) / (s.scale * s.scale), s.area[i], 4e-3 * s.area[i] + 5e-7);
      assert_near((s.base - top) / s.scale, s.radius[i] - 0.102, 1e-4);
      assert_true(s.area[i] > s.area[i - 1] && s.radius[i] > s.radius[i - 1]);
    }
    svg_text(&s.sheet, "D3/2 = 102.0 mm, b3 = 12.0 mm");
    svg_free(&s.sheet);
  }
}

// Greatest half width of a section, m.
static double half_width(const Sections *s, int i) {
  double most = 0;
  for (int k = 0; k < 2 * HALF; k++)
    most = fmax(most, fabs(s->outline[i]->x[k][0] - svg_nth(&s->sheet, SVG_CHAIN, NULL, 1)->x[0][0]) / s->scale);
  return most;
}

// A rectangle stays as wide as the inlet; a trapezoid's side walls leave it by tan of their angle.
static void families_have_their_form(void **state) {
  for (int kind = 0; kind < 2; kind++) {
    const CwDesign *design = &designs[kind];
    Sections s = drawn(design);
    for (int i = 1; i <= COUNT; i++) {
      const double *kink = s.outline[i]->x[1], *begin = s.outline[i]->x[0];
      const double away = fabs(kink[0] - begin[0]), out = begin[1] - kink[1];
      if (kind == 1) assert_near(half_width(&s, i), 0.006, 1e-5);
      assert_near(away, out * (kind == 0 ? tan(design->side_wall_angle) : 0), 0.03);
      assert_true(out > 0);
    }
    svg_free(&s.sheet);
  }
}

// The integral over r, the height over the axis, of the width, or of the width over r, between the points of an
// outline.
static double taken_up(const Sections *s, int i, int over_radius) {
  const double middle = svg_nth(&s->sheet, SVG_CHAIN, NULL, 1)->x[0][0];
  double sum = 0;
  for (int k = 0; k + 1 < HALF; k++) {
    const double *a = s->outline[i]->x[k], *b = s->outline[i]->x[k + 1];
    const double r1 = 0.102 + (s->base - a[1]) / s->scale, r2 = 0.102 + (s->base - b[1]) / s->scale;
    const double b1 = 2 * fabs(a[0] - middle) / s->scale, b2 = 2 * fabs(b[0] - middle) / s->scale;
    if (!over_radius) sum += (b1 + b2) / 2 * (r2 - r1);
    if (!over_radius || fabs(r2 - r1) < 1e-9) continue;
    const double rate = (b2 - b1) / (r2 - r1); // b = b1 + rate (r - r1)
    sum += (b1 - rate * r1) * log(r2 / r1) + rate * (r2 - r1);
  }
  return sum;
}

// What a section takes up of Q grows by an eighth over 45 degrees: with constant angular momentum K the integral of
// b dr / r is that share of Q / K, with constant velocity c the area of Q / c. The title says K or c.
static void the_spiral_takes_up_the_flow(void **state) {
  static const char *const section[] = {"trapezoid", "rectangle", "circle"};
  for (int kind = 0; kind < KINDS; kind++) {
    const double flow = designs[kind].volute.input.flow_rate;
    Sections s = drawn(&designs[kind]);
    double law[COUNT + 1] = {0}, constant = 0;
    char law_name[40] = "", form[40] = "", way[40] = "";
    for (int i = 1; i <= COUNT; i++) law[i] = taken_up(&s, i, kind < 3);
    assert_int_equal(sscanf(s.sheet.item[0].text,
                            "Volute: %39s sections, constant %39[a-z ] %lf %*s throat %*f mm2, %39s", form, law_name,
                            &constant, way),
                     4);
    assert_string_equal(form, section[kind % 3]);
    assert_string_equal(law_name, kind < 3 ? "angular momentum " : "velocity ");
    assert_string_equal(way, kind < 3 ? "tangential" : "radial");
    assert_non_null(strstr(s.sheet.item[0].text, kind < 3 ? " m2/s, throat " : " m/s, throat "));
    for (int i = 2; i <= COUNT; i++) assert_near((law[i] - law[i - 1]) * constant / (flow / 8), 1, 2e-3);
    svg_free(&s.sheet);
  }
}

// The chart has the areas of the outlines over their angles; the tongue's mark stands where the chain line ends.
static void the_chart_has_the_same_areas(void **state) {
  for (int kind = 0; kind < KINDS; kind++) {
    const CwDesign *design = &designs[kind];
    Sections s = drawn(design);
    const SvgItem *low = svg_nth(&s.sheet, SVG_LINE, SVG_THIN, 0), *high = svg_nth(&s.sheet, SVG_LINE, SVG_THIN, 5);
    double top = 0;
    int numbers = 0;
    for (int i = 0; i < s.sheet.count; i++) {
      const SvgItem *item = &s.sheet.item[i];
      if (item->kind != SVG_TEXT || item->align != 'e') continue;
      const double share = (low->x[0][1] - item->x[0][1] + 4) / (low->x[0][1] - high->x[0][1]);
      if (share > 0.99) top = atof(item->text);
      assert_near(share, 0.2 * numbers++, 1e-3);
    }
    assert_int_equal(numbers, 6);
    assert_int_equal(svg_count(&s.sheet, SVG_CIRCLE, NULL), COUNT + 1);
    for (int i = 0; i <= COUNT; i++) {
      const double *dot = svg_nth(&s.sheet, SVG_CIRCLE, NULL, i)->x[0];
      const double share = (low->x[0][1] - dot[1]) / (low->x[0][1] - high->x[0][1]);
      int below = 0; // numbers of degrees
      for (int k = 0; k < s.sheet.count; k++) {
        const SvgItem *item = &s.sheet.item[k];
        if (item->kind != SVG_TEXT || item->align != 'm' || item->x[0][0] != dot[0] || strchr(item->text, '='))
          continue;
        assert_int_equal(atoi(item->text), 45 * i);
        assert_true(item->x[0][1] > low->x[0][1]);
        below++;
      }
      assert_int_equal(below, 1);
      assert_near(dot[0], low->x[0][0] + (low->x[1][0] - low->x[0][0]) * i / COUNT, 0.011);
      if (i > 0) assert_near(share * top * 1e-6, s.area[i], 1e-6 + 1e-4 * s.area[COUNT]);
    }
    const SvgItem *before = svg_nth(&s.sheet, SVG_CHAIN, NULL, 0), *behind = svg_nth(&s.sheet, SVG_LINE, SVG_BLADE, 0);
    const SvgItem *mark = svg_nth(&s.sheet, SVG_LINE, SVG_FLOW, 0);
    const double angle = (mark->x[0][0] - low->x[0][0]) / (low->x[1][0] - low->x[0][0]) * 360;
    assert_near(angle, design->tongue_angle / degree, 0.01);
    svg_text(&s.sheet, "tongue, %.1f deg", design->tongue_angle / degree);
    assert_near(before->x[before->count - 1][0], mark->x[0][0], 0.011);
    assert_near(svg_distance(before->x[before->count - 1], behind->x[0]), 0, 0.011);
    assert_near(svg_distance(before->x[0], svg_nth(&s.sheet, SVG_CIRCLE, NULL, 0)->x[0]), 0, 0.011);
    assert_near(svg_distance(behind->x[behind->count - 1], svg_nth(&s.sheet, SVG_CIRCLE, NULL, COUNT)->x[0]), 0, 0.011);
    svg_free(&s.sheet);
  }
}

// The chart's numbers end on 1, 2 or 5 times a power of ten, or five times those, at the largest area or above;
// outlines stay clear of their names, those of a narrow wheel before a wide spiral too.
static void other_pumps_fit(void **state) {
  static const char *const name[] = {"ns40", "ns200", "paper"};
  for (int i = 0; i < 9; i++) {
    CwCase table = i < 3 ? case_of(name[i]) : duty_point(60 * pow(1.3, i - 3), 20, 1450);
    if (i == 2) table.volute.inlet_width = 0.03;
    const CwDesign design = design_of(&table);
    Sections s = drawn(&design);
    const SvgItem *top = svg_nth(&s.sheet, SVG_LINE, SVG_THIN, 5), *name_of_last = s.outline[COUNT] + 2;
    double most = 0;
    assert_true(svg_nth(&s.sheet, SVG_CIRCLE, NULL, COUNT)->x[0][1] >= top->x[0][1]);
    for (int k = 0; k < s.sheet.count; k++)
      if (s.sheet.item[k].kind == SVG_TEXT && s.sheet.item[k].align == 'e')
        most = fmax(most, 1e-6 * atof(s.sheet.item[k].text));
    assert_true(most >= s.area[COUNT] && most < 2.6 * s.area[COUNT]);
    for (int k = 0; k < 2 * HALF; k++) assert_true(s.outline[COUNT]->x[k][0] < name_of_last->x[0][0] - 5);
    svg_free(&s.sheet);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(outlines_hold_their_areas),
      cmocka_unit_test(families_have_their_form),
      cmocka_unit_test(the_spiral_takes_up_the_flow),
      cmocka_unit_test(the_chart_has_the_same_areas),
      cmocka_unit_test(other_pumps_fit),
  };
  return cmocka_run_group_tests(tests, make_designs, remove_test_folder);
}
