// SPDX-License-Identifier: AGPL-3.0-or-later
// Random volutes over the range of radial pumps: each is built whole or refused in one clear line.
// Usage: test_stator_random [DRAWS]
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include "geometry/measure.h"
#include "geometry/solid.hpp"
#include "geometry/volute_design.h"
#include "geometry/stator.h"
#include "tests/draw.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180, gravity = 9.80665;
static int draws = 24;

static uint64_t state;
static double uniform(double a, double b) {
  return a + (b - a) * draw(&state);
}

// A pump of the specific speed nq = 8 to 55 (ns = 30 to 200) with usual main dimensions.
static CwVoluteInput draw_volute() {
  CwVoluteInput in;
  double rpm = uniform(0, 1) < 0.5 ? 1450 : 2900, d2 = 0.12 * std::pow(4, uniform(0, 1)), nq = uniform(8, 55);
  double u2 = rpm * M_PI / 30 * d2 / 2, head = uniform(0.9, 1.1) * u2 * u2 / (2 * gravity);
  double b2 = std::max(3e-3, d2 * (0.012 + 0.0021 * nq) * uniform(0.85, 1.15));
  in.flow_rate = in.pipe_flow_rate = std::pow(nq * std::pow(head, 0.75) / rpm, 2);
  in.area_law = uniform(0, 1) < 0.5 ? CW_AREA_LAW_ANGULAR_MOMENTUM : CW_AREA_LAW_VELOCITY;
  in.angular_momentum = gravity * head / (rpm * M_PI / 30 * uniform(0.75, 0.9));
  in.section_speed = 0.42 * std::pow(nq / 20, -0.2) * uniform(0.9, 1.1) * std::sqrt(2 * gravity * head);
  double kind = uniform(0, 3);
  in.section = kind < 1 ? CW_SECTION_TRAPEZOID : kind < 2 ? CW_SECTION_RECTANGLE : CW_SECTION_CIRCLE;
  in.neck_width = b2;
  in.base_diameter = d2 * uniform(1.02, 1.1);
  in.interface_radius = (d2 + in.base_diameter) / 4;
  // A rectangle is as wide as its throat is high, more or less; the others open with the radius.
  double area = in.flow_rate / in.section_speed;
  in.inlet_width = b2 * uniform(1.2, 2.2);
  if (in.section == CW_SECTION_RECTANGLE)
    in.inlet_width = std::max(in.inlet_width, std::sqrt(area) * uniform(0.7, 1.1));
  in.inlet_width = std::min(std::max(b2 + 0.005 * in.base_diameter, in.inlet_width), 0.4 * in.base_diameter);
  in.side_wall_angle = uniform(12, 28) * degree;
  in.throat_area = NAN;
  double slope = in.section == CW_SECTION_RECTANGLE ? 0 : std::tan(in.side_wall_angle);
  double height = 2 * area / (in.inlet_width + std::sqrt(in.inlet_width * in.inlet_width + 4 * slope * area));
  bool corners = in.section == CW_SECTION_RECTANGLE || (in.section == CW_SECTION_TRAPEZOID && uniform(0, 1) < 0.5);
  in.corner_radius = corners ? std::max(0.5e-3, std::min(in.inlet_width, height) * uniform(0.1, 0.25)) : NAN;
  in.tongue_radius = std::max(1e-3 * in.base_diameter, std::min(0.0075 * d2 * uniform(0.7, 1.3), height / 6));
  in.tongue_gap = in.tongue_angle = NAN;
  in.tongue_gap_range[0] =
      std::max(0.0, d2 / 2 * std::min(1.2, 1.03 + 0.1 * nq / 40 + 0.07 * head / 1000) - in.base_diameter / 2);
  in.tongue_gap_range[1] = std::max(0.0, d2 / 2 * 1.2 - in.base_diameter / 2);
  in.diffuser_length = NAN;
  in.diffuser_angle = uniform(7, 11) * degree;
  in.outlet_diameter = NAN;
  in.diffuser_area_ratio = uniform(1.2, 2.2);
  in.discharge = uniform(0, 1) < 0.5 ? CW_DISCHARGE_TANGENTIAL : CW_DISCHARGE_RADIAL;
  in.discharge_pipe_length = d2 * uniform(0.2, 1);
  return in;
}

// The shortest edge of a solid, mm.
static double shortest_edge(const CwSolid *solid) {
  double least = HUGE_VAL;
  for (TopExp_Explorer at(solid->solid, TopAbs_EDGE); at.More(); at.Next()) {
    double first, last, length = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(at.Current()), first, last);
    for (int k = 0; k < 200; k++)
      length +=
          curve->Value(first + (last - first) * k / 200).Distance(curve->Value(first + (last - first) * (k + 1) / 200));
    least = std::min(least, length);
  }
  return least;
}

static void random_volutes(void **) {
  static const char *const section[] = {"trapezoid", "rectangle", "circle"};
  std::map<std::string, std::pair<int, int>> kinds; // built and drawn
  int built = 0;
  double shortest = HUGE_VAL;
  state = 20;
  for (int i = 0; i < draws; i++) {
    CwVoluteInput in = draw_volute();
    CwVolute volute;
    CwSolid *solid = NULL;
    CwStatus status = cw_volute_design(&in, &volute);
    if (status == CW_OK) status = cw_stator_build(&volute, cw_solid_unit_of_pump(in.base_diameter), &solid);
    std::string kind = std::string(section[in.section]) + (std::isnan(in.corner_radius) ? "" : " with corners");
    kinds[kind].second++;
    if (status == CW_OK) {
      CwMeasuredSolid measured;
      assert_int_equal(cw_measure_solid(solid, &measured), CW_OK);
      assert_true(measured.valid && measured.closed && measured.face_count == 51);
      assert_true(measured.largest_tolerance < 1e-6 && measured.volume > 0);
      const double edge = shortest_edge(solid);
      shortest = std::min(shortest, edge);
      assert_true(edge >= 0.05);
      kinds[kind].first++;
      built++;
    } else {
      print_message("%d: %s, law %d, D3 %.0f, b2 %.1f, b3 %.1f, corner %.1f mm, a %.0f deg: %s\n", i, kind.c_str(),
                    in.area_law, 1e3 * in.base_diameter, 1e3 * in.neck_width, 1e3 * in.inlet_width,
                    1e3 * in.corner_radius, in.side_wall_angle / degree, cw_fail_message());
      assert_true(std::strlen(cw_fail_message()) > 20 && !std::strchr(cw_fail_message(), '\n'));
      assert_true(status == CW_ERR_DESIGN || status == CW_ERR_GEOMETRY);
    }
    cw_solid_free(&solid);
  }
  for (const auto &one : kinds)
    print_message("%s: %d of %d built\n", one.first.c_str(), one.second.first, one.second.second);
  print_message("%d of %d volutes built; shortest edge %.3f mm\n", built, draws, shortest);
  assert_true(built >= 0.97 * draws);
}

int main(int argc, char **argv) {
  if (argc > 1) draws = std::atoi(argv[1]);
  const CMUnitTest tests[] = {cmocka_unit_test(random_volutes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
