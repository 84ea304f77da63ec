// SPDX-License-Identifier: AGPL-3.0-or-later
// Similar pumps: all lengths times s, the speed over it, the flow rate times its square, so that every dimensionless
// number is the same (design_unit). Their files must be the same but for the model unit, and what is measured on them
// the same times powers of s: to the last bit where s is a power of two, else but for rounding.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "geometry/hydraulic_design.h"
#include "geometry/pump.h"
#include "pipeline/case_read.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

// A case with all its lengths given, mm; `more` are further lines of the impeller's and the volute's tables.
typedef struct {
  const char *name, *impeller, *volute;
} Variant;

static void write_case(const char *path, double s, const Variant *variant) {
  static const struct {
    const char *key;
    double mm;
  } impeller[] = {{"inlet_diameter_mm", 74},
                  {"outlet_diameter_mm", 200},
                  {"outlet_width_mm", 8},
                  {"hub_diameter_mm", 24},
                  {"hub_nut_length_mm", 14},
                  {"hub_nut_flat_diameter_mm", 7},
                  {"axial_length_mm", 33.5},
                  {"leading_edge_radius_hub_mm", 39},
                  {"leading_edge_radius_shroud_mm", 47},
                  {"leading_edge_thickness_mm", 2.8},
                  {"blade_thickness_mm", 4},
                  {"trailing_edge_thickness_mm", 2},
                  {"trailing_edge_bevel_mm", 1.25},
                  {"suction_pipe_length_mm", 55}},
    volute[] = {
        {"base_diameter_mm", 210},   {"inlet_width_mm", 16.5},   {"tongue_radius_mm", 1.75},       {"tongue_gap_mm", 7},
        {"diffuser_length_mm", 105}, {"outlet_diameter_mm", 50}, {"discharge_pipe_length_mm", 100}};
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file,
          "name: similar\n"
          "operating_point:\n  flow_rate_m3_per_h: %.17g\n  head_m: 10\n  speed_rpm: %.17g\n"
          "fluid:\n  kinematic_viscosity_m2_per_s: %.17g\n"
          "impeller:\n  priority: wrap\n  blade_count: 6\n  wrap_angle_deg: 71\n  inlet_blade_angle_deg: 31\n"
          "  hub_pole_radial: 2.369\n  shroud_pole_axial: 0.067\n  shroud_pole_radial: 0.8\n%s",
          25 * s * s, 1450 / s, 1.004e-6 * s, variant->impeller);
  for (size_t i = 0; i < sizeof impeller / sizeof *impeller; i++)
    fprintf(file, "  %s: %.17g\n", impeller[i].key, impeller[i].mm * s);
  if (strstr(variant->name, "fillets")) fprintf(file, "  root_fillet_radius_mm: %.17g\n", 1 * s);
  if (strstr(variant->name, "shaft")) fprintf(file, "  through_shaft_diameter_mm: %.17g\n", 20 * s);
  fprintf(file, "volute:\n  side_wall_angle_deg: 20\n  throat_area_mm2: %.17g\n%s", 890 * s * s, variant->volute);
  for (size_t i = 0; i < sizeof volute / sizeof *volute; i++)
    fprintf(file, "  %s: %.17g\n", volute[i].key, volute[i].mm * s);
  fclose(file);
}

typedef struct {
  int count;
  char *text[CW_PUMP_DOMAINS_MOST]; // of the B-rep files
  size_t size[CW_PUMP_DOMAINS_MOST];
  double unit;
  CwMeasuredPump measured;
} Built;

static Built build(double s, const Variant *variant) {
  CwCase table;
  CwDesign design;
  CwPipeStubs stubs;
  CwPump pump = {0};
  Built built = {0};
  const char *path = in_test_folder("case.yaml");
  write_case(path, s, variant);
  if (cw_case_read(path, &table) != CW_OK || cw_hydraulic_design(&table, &design) != CW_OK ||
      cw_pump_pipe_stubs(&table, &design, &stubs) != CW_OK || cw_pump_build(&table, &design, &stubs, &pump) != CW_OK ||
      cw_pump_measure(&design, &pump, &built.measured) != CW_OK)
    fail_msg("%s at %g: %s", variant->name, s, cw_fail_message());
  unlink(path);
  built.count = pump.count;
  built.unit = cw_solid_unit(pump.solid[0]);
  for (int i = 0; i < pump.count; i++) {
    path = in_test_folder("solid.brep");
    assert_int_equal(cw_solid_write_brep(pump.solid[i], path), CW_OK);
    built.text[i] = read_whole(path, &built.size[i]);
    unlink(path);
  }
  cw_pump_free(&pump);
  return built;
}

static void free_built(Built *built) {
  for (int i = 0; i < built->count; i++) free(built->text[i]);
}

static void expect_times(double factor, double one, double other, double rounding) {
  assert_true(fabs(other - factor * one) <= rounding * fabs(other));
}

static void expect_similar(const Built *one, const Built *other, double s) {
  int exponent;
  const double rounding = frexp(s, &exponent) == 0.5 ? 0 : 1e-12;
  assert_int_equal(one->count, other->count);
  expect_times(s, one->unit, other->unit, rounding);
  for (int i = 0; i < one->count; i++) {
    const CwMeasuredSolid *a = &one->measured.solid[i], *b = &other->measured.solid[i];
    assert_int_equal(one->size[i], other->size[i]);
    assert_memory_equal(one->text[i], other->text[i], one->size[i]);
    expect_times(s * s * s, a->volume, b->volume, rounding);
    expect_times(s, a->shortest_edge, b->shortest_edge, rounding);
    expect_times(s, a->narrowest_face, b->narrowest_face, rounding);
    expect_times(s, a->largest_tolerance, b->largest_tolerance, rounding);
  }
  expect_times(s * s, one->measured.rotor.interface_area, other->measured.rotor.interface_area, rounding);
  expect_times(s, one->measured.rotor.outlet_diameter, other->measured.rotor.outlet_diameter, rounding);
  assert_true(other->measured.rotor.wrap_angle == one->measured.rotor.wrap_angle);
  expect_times(s * s * s, one->measured.rotor_volume_of_sections, other->measured.rotor_volume_of_sections, rounding);
}

static void any_size_gives_the_same_solids(void **state) {
  static const Variant variants[] = {
      {"plain", "", ""},
      {"fillets, splitters, radial", "  trailing_edge: rounded\n  leading_edge_ratio: 3\n  splitter_start: 0.45\n",
       "  discharge: radial\n"},
      {"shaft, zones, clockwise",
       "  rotation: clockwise\n  trailing_edge: blunt\n  lean_deg: 5\n  suction_pipe_zone: own\n",
       "  discharge_pipe_zone: own\n"},
  };
  static const double factors[] = {0.125, 3, 0.1, 0.25, 8, 0.075, 0.5, 10, 20, 2, 25, 4};
  for (size_t v = 0; v < sizeof variants / sizeof *variants; v++) {
    Built one = build(1, &variants[v]);
    for (size_t f = v; f < sizeof factors / sizeof *factors; f += sizeof variants / sizeof *variants) {
      Built other = build(factors[f], &variants[v]);
      expect_similar(&one, &other, factors[f]);
      free_built(&other);
    }
    free_built(&one);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(any_size_gives_the_same_solids)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
