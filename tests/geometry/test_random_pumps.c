// SPDX-License-Identifier: AGPL-3.0-or-later
// Random pumps, from a fixed seed: specific speed ns 35 to 220, 3 to 9 blades, all options. Each ends in
// valid solids or in one line that says what does not fit; at least 97 % in valid solids.
//
//   geometry_test_random_pumps [LAST [FIRST]]     pumps 1 to 16, or FIRST to LAST; prints each that ends in a line
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/blade.h"
#include "geometry/hydraulic_design.h"
#include "geometry/meridian.h"
#include "geometry/pump.h"
#include "pipeline/case_schema.h"
#include "pipeline/log.h"
#include "tests/unit_test.h"

static const double degree = M_PI / 180;
static int last_pump = 16, first_pump = 1;

// Splitmix64.
static double draw(uint64_t *state, double least, double most) {
  uint64_t x = *state += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  x ^= x >> 31;
  return least + (most - least) * (double)(x >> 11) / 9007199254740992.0;
}

static int chance(uint64_t *state, double share) {
  return draw(state, 0, 1) < share;
}

// Flow rate, head and speed of a specific speed; heads of 3 to 120 m.
static void draw_duty(uint64_t *state, CwCase *table) {
  static const double speeds[] = {970, 1450, 2900};
  const double ns = 35 * pow(220.0 / 35, draw(state, 0, 1)), rpm = speeds[(int)draw(state, 0, 3)];
  double q, h;
  do {
    q = 3 * pow(1000.0 / 3, draw(state, 0, 1)) / 3600;
    h = pow(3.65 * rpm * sqrt(q) / ns, 4.0 / 3);
  } while (h < 3 || h > 120);
  table->operating_point.flow_rate = q;
  table->operating_point.head = h;
  table->operating_point.speed = rpm * M_PI / 30;
}

static void draw_options(uint64_t *state, CwCase *table) {
  CwImpellerTable *impeller = &table->impeller;
  table->design.correlations = chance(state, 0.5) ? CW_CORRELATIONS_GUAN : CW_CORRELATIONS_GUELICH;
  table->design.slip = chance(state, 0.3) ? CW_SLIP_PFLEIDERER : CW_SLIP_WIESNER;
  impeller->rotation = chance(state, 0.3) ? CW_ROTATION_CLOCKWISE : CW_ROTATION_COUNTER_CLOCKWISE;
  impeller->trailing_edge = (CwTrailingEdge)(chance(state, 0.4) ? 0 : (int)draw(state, 0, 4));
  impeller->blade_form = chance(state, 0.15) ? CW_BLADE_CYLINDRICAL : CW_BLADE_TWISTED;
  if (chance(state, 0.7)) impeller->blade_count = (int)draw(state, 3, 10);
  if (chance(state, 0.3)) impeller->lean_angle = draw(state, -12, 12) * degree;
  if (chance(state, 0.5)) impeller->leading_edge_ratio = draw(state, 1, 4);
  if (chance(state, 0.5)) impeller->thickest_at = draw(state, 0.3, 0.6);
  if (chance(state, 0.25)) {
    impeller->splitter_start = draw(state, 0.3, 0.6);
    impeller->splitter_position = draw(state, 0.42, 0.58);
  }
  if (chance(state, 0.25)) {
    impeller->nut_length = draw(state, 2e-3, 20e-3);
    impeller->nut_flat_diameter = draw(state, 1e-3, 8e-3);
  }
}

// What the blades leave free of hub and shroud, less the quarter of their thickness that fillets must leave.
static double room_beside(const CwDesign *design) {
  CwMeridian meridian;
  double clear = 0;
  assert_int_equal(cw_meridian_make(design, &meridian), CW_OK);
  assert_int_equal(cw_blade_clearance(design, &meridian, &clear), CW_OK);
  return clear - 0.25 * design->blade_thickness;
}

// Gives some dimensions near those of the computed design, and one of the priorities.
static void draw_dimensions(uint64_t *state, const CwDesign *design, CwCase *table) {
  CwImpellerTable *impeller = &table->impeller;
  if (chance(state, 0.5)) impeller->outlet_width = design->outlet_width * draw(state, 0.9, 1.1);
  if (chance(state, 0.5)) impeller->inlet_diameter = design->inlet_diameter * draw(state, 0.95, 1.05);
  if (chance(state, 0.5)) impeller->hub_diameter = design->hub_diameter * draw(state, 0.9, 1.2);
  if (chance(state, 0.3)) impeller->blade_thickness = design->blade_thickness * draw(state, 0.8, 1.2);
  const double choice = draw(state, 0, 1);
  // Shafts and fillets as the pump's size has them.
  if (chance(state, 0.25))
    impeller->through_shaft_diameter =
        chance(state, 0.3) ? design->hub_diameter : design->hub_diameter * draw(state, 0.5, 0.9);
  if (impeller->through_shaft_diameter > 0)
    impeller->hub_diameter = fmax(design->hub_diameter, impeller->through_shaft_diameter);
  if (chance(state, 0.4))
    impeller->root_fillet_radius = fmin(design->outlet_diameter * draw(state, 0.002, 0.015),
                                        fmin(0.25 * design->outlet_width, 0.3 * room_beside(design)));
  if (choice < 0.35) {
    impeller->priority = CW_PRIORITY_WRAP;
    impeller->wrap_angle = fmax(design->wrap_angle * draw(state, 0.9, 1.1), 21 * degree);
    impeller->outlet_diameter = design->outlet_diameter;
  } else if (choice < 0.7) {
    impeller->priority = CW_PRIORITY_BETA;
    impeller->outlet_blade_angle = draw(state, 20, 32) * degree;
  } else if (choice < 0.85) {
    impeller->priority = CW_PRIORITY_HEAD;
    impeller->outlet_diameter = design->outlet_diameter * draw(state, 1, 1.05);
  }
}

// Pipes as zones of their own, from a sequence apart.
static void draw_zones(uint64_t *state, CwCase *table) {
  const int suction = chance(state, 0.3), discharge = chance(state, 0.3);
  if (suction) table->impeller.suction_pipe_zone = CW_PIPE_OWN_ZONE;
  if (discharge) table->volute.discharge_pipe_zone = CW_PIPE_OWN_ZONE;
}

static int build(const CwCase *table, CwDesign *design) {
  CwPump pump = {0};
  CwPipeStubs stubs;
  CwMeasuredPump measured;
  const int fine = cw_hydraulic_design(table, design) == CW_OK && cw_pump_pipe_stubs(table, design, &stubs) == CW_OK &&
                   cw_pump_build(table, design, &stubs, &pump) == CW_OK &&
                   cw_pump_measure(design, &pump, &measured) == CW_OK;
  cw_pump_free(&pump);
  return fine;
}

static void random_pumps(void **state_) {
  uint64_t state = 20240607, zone_state = 20240608;
  const int pump_count = last_pump - first_pump + 1;
  int built = 0, unsound = 0, lines = 0;
  double longest = 0, begin = cw_seconds();
  for (int i = 0; i < last_pump; i++) {
    CwCase table;
    CwDesign design;
    cw_case_defaults(&table);
    draw_duty(&state, &table);
    draw_options(&state, &table);
    const double start = cw_seconds();
    uint64_t before = state;
    if (cw_hydraulic_design(&table, &design) == CW_OK && chance(&state, 0.6))
      draw_dimensions(&state, &design, &table);
    else
      state = before;
    cw_fail_clear();
    draw_zones(&zone_state, &table);
    if (i + 1 < first_pump) continue;
    const int fine = build(&table, &design);
    longest = fmax(longest, cw_seconds() - start);
    built += fine;
    if (!fine) {
      const char *message = cw_fail_message();
      unsound += strstr(message, "a fault of the program") != NULL;
      // One line, with a number in it and something to do.
      lines += strlen(message) > 20 && !strchr(message, '\n') && strpbrk(message, "0123456789") != NULL;
      print_message("pump %d, ns %.0f, %.1f m3/h, %.1f m, z %d%s, wrap %.0f deg, D2 %.0f, b2 %.1f mm, edge "
                    "%d, form %d, fillet %.2f, shaft %.1f mm: %s\n",
                    i + 1, design.specific_speed_ns, design.flow_rate * 3600, design.head, design.blade_count,
                    design.splitter_start > 0 ? " with splitters" : "", design.wrap_angle / degree,
                    design.outlet_diameter * 1e3, design.outlet_width * 1e3, design.trailing_edge, design.blade_form,
                    design.root_fillet_radius * 1e3, design.through_shaft_diameter * 1e3, message);
      cw_fail_clear();
    }
  }
  print_message("%d of %d random pumps are valid (%.1f %%), %.2f s each, the longest %.2f s\n", built, pump_count,
                100.0 * built / pump_count, (cw_seconds() - begin) / pump_count, longest);
  assert_int_equal(unsound, 0);
  assert_int_equal(built + lines, pump_count);
  assert_true(pump_count - built <= fmax(1, 0.03 * pump_count)); // one of a few is no sign
}

int main(int argc, char **argv) {
  if (argc > 1) last_pump = atoi(argv[1]);
  if (argc > 2) first_pump = atoi(argv[2]);
  const struct CMUnitTest tests[] = {cmocka_unit_test(random_pumps)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
