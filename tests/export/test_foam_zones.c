// SPDX-License-Identifier: AGPL-3.0-or-later
// Which interface the flow from rotor to stator is reported at.
#include <string.h>

#include "export/foam_zones.h"
#include "tests/unit_test.h"

enum { ROTOR, SUCTION, RING, CASING, PATCHES = 10, INTERFACES = 4 };

// A drawn pump whose zones are in no order: the rotor takes water from the suction and gives it to the casing; the ring
// beside it leads to the casing too.
static void check(const int order[INTERFACES]) {
  CwModelPatch patches[PATCHES] = {{.name = "eye", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                                   {.name = "rim", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                                   {.name = "back", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
                                   {.name = "inlet", .kind = CW_PATCH_INLET, .domain = SUCTION},
                                   {.name = "pipe_end", .kind = CW_PATCH_INTERFACE, .domain = SUCTION},
                                   {.name = "ring_front", .kind = CW_PATCH_INTERFACE, .domain = RING},
                                   {.name = "ring_top", .kind = CW_PATCH_INTERFACE, .domain = RING},
                                   {.name = "casing_bottom", .kind = CW_PATCH_INTERFACE, .domain = CASING},
                                   {.name = "casing_in", .kind = CW_PATCH_INTERFACE, .domain = CASING},
                                   {.name = "outlet", .kind = CW_PATCH_OUTLET, .domain = CASING, .flow_share = 1}};
  static const CwModelInterface all[INTERFACES] = {{{0, 4}, CW_SURFACE_PLANE, 0},
                                                   {{5, 2}, CW_SURFACE_PLANE, 0},
                                                   {{6, 7}, CW_SURFACE_PLANE, 0},
                                                   {{8, 1}, CW_SURFACE_CYLINDER, 0.1}};
  CwModelInterface interfaces[INTERFACES];
  CwPatchPart parts[PATCHES];
  for (int i = 0; i < INTERFACES; ++i) interfaces[i] = all[order[i]];
  for (int p = 0; p < PATCHES; ++p) parts[p] = (CwPatchPart){.faces.triangles = 1};
  CwMesh mesh = {
      .domain_count = 4,
      .domains = {{.name = "rotor", .rotating = 1}, {.name = "suction"}, {.name = "ring"}, {.name = "casing"}},
      .interface_count = INTERFACES,
      .interfaces = interfaces,
      .patch_count = PATCHES,
      .patches = patches};
  const CwAssembly assembly = {.mesh = &mesh, .patches = parts};
  CwValues values = {0};
  assert_int_equal(cw_values_set(&values, "speed", "100"), CW_OK);
  assert_int_equal(cw_foam_zones_set(&assembly, &values), CW_OK);
  assert_string_equal(cw_values_get(&values, "rotor_interface"), "rim");
  assert_string_equal(cw_values_get(&values, "stator_interface"), "casing_in");
  const char *flows = cw_values_get(&values, "interface_flows");
  static const char *const others[] = {"flow_eye\n",      "flow_pipe_end\n", "flow_ring_front\n",
                                       "flow_ring_top\n", "flow_back\n",     "flow_casing_bottom\n"};
  for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
    if (!strstr(flows, others[i])) fail_msg("no '%s' in:\n%s", others[i], flows);
  assert_null(strstr(flows, "flow_rim"));
  cw_values_free(&values);
}

static void the_flow_that_leaves_the_rotor_is_reported(void **state) {
  check((int[]){0, 1, 2, 3});
  check((int[]){3, 2, 1, 0});
  check((int[]){1, 0, 3, 2});
}

// Without an outlet that a zone at rest leads to, the first one.
static void any_interface_of_the_rotor_will_do(void **state) {
  CwModelPatch patches[] = {{.name = "inlet", .kind = CW_PATCH_INLET, .domain = 1},
                            {.name = "pipe_end", .kind = CW_PATCH_INTERFACE, .domain = 1},
                            {.name = "eye", .kind = CW_PATCH_INTERFACE, .domain = 0},
                            {.name = "outlet", .kind = CW_PATCH_OUTLET, .domain = 0, .flow_share = 1}};
  CwModelInterface interface = {{1, 2}, CW_SURFACE_PLANE, 0};
  CwPatchPart parts[4] = {
      {.faces.triangles = 1}, {.faces.triangles = 1}, {.faces.triangles = 1}, {.faces.triangles = 1}};
  CwMesh mesh = {.domain_count = 2,
                 .domains = {{.name = "rotor", .rotating = 1}, {.name = "suction"}},
                 .interface_count = 1,
                 .interfaces = &interface,
                 .patch_count = 4,
                 .patches = patches};
  const CwAssembly assembly = {.mesh = &mesh, .patches = parts};
  CwValues values = {0};
  assert_int_equal(cw_values_set(&values, "speed", "100"), CW_OK);
  assert_int_equal(cw_foam_zones_set(&assembly, &values), CW_OK);
  assert_string_equal(cw_values_get(&values, "rotor_interface"), "eye");
  assert_string_equal(cw_values_get(&values, "stator_interface"), "pipe_end");
  cw_values_free(&values);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_flow_that_leaves_the_rotor_is_reported),
      cmocka_unit_test(any_interface_of_the_rotor_will_do),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
