// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

static const char *file(void) {
  return in_test_folder("model-test.json");
}

static CwModelPatch *add(CwModel *model, const char *name, CwPatchKind kind) {
  CwModelPatch *patch;
  assert_int_equal(cw_model_add_patch(model, name, kind, &patch), CW_OK);
  return patch;
}

static CwModelPatch *add_wall(CwModel *model, const char *name) {
  CwModelPatch *patch = add(model, name, CW_PATCH_WALL);
  patch->flow = (CwWallFlow){1.0 / 3, 0.3, 0.02, 0.01, 0};
  return patch;
}

// Two inlets, three domains of which the second turns, a cylinder and another surface of revolution between them.
static CwModel double_suction(void) {
  CwModel model = {.unit = 1e-3};
  assert_int_equal(cw_model_add_domain(&model, "suction", 0), CW_OK);
  add(&model, "inlet_left", CW_PATCH_INLET);
  add(&model, "inlet_right", CW_PATCH_INLET);
  add(&model, "middle", CW_PATCH_SYMMETRY);
  add_wall(&model, "pipe")->group = CW_GROUP_PIPE;
  add(&model, "to_wheel", CW_PATCH_INTERFACE);
  assert_int_equal(cw_model_add_domain(&model, "wheel", 1), CW_OK);
  add(&model, "from_suction", CW_PATCH_INTERFACE);
  CwModelPatch *blade = add_wall(&model, "Vane_1");
  blade->group = blade->size = CW_GROUP_BLADE;
  blade->flow.before = 0.002;
  blade->y_plus_asked = 1;
  blade->y_plus = 1.25;
  blade->monitored = 1;
  add(&model, "to_casing", CW_PATCH_INTERFACE);
  assert_int_equal(cw_model_add_domain(&model, "casing", 0), CW_OK);
  add(&model, "from_wheel", CW_PATCH_INTERFACE);
  add_wall(&model, "spiral")->turns = 1;
  add(&model, "out", CW_PATCH_OUTLET)->flow_share = 0.25;
  const char *cylinder[] = {"to_casing", "from_wheel"}, *other[] = {"to_wheel", "from_suction"};
  assert_int_equal(cw_model_add_interface(&model, cylinder, CW_SURFACE_CYLINDER, 0.1), CW_OK);
  assert_int_equal(cw_model_add_interface(&model, other, CW_SURFACE_OTHER, 0.1), CW_OK);
  model.flow = (CwModelFlow){2, 0.07, 7, 0.008, 0.2, 6};
  return model;
}

// Every bit of every member comes back.
static void what_is_written_is_read(void **state) {
  CwModel model = double_suction(), again = {0};
  assert_int_equal(cw_model_write(&model, file()), CW_OK);
  if (cw_model_read(file(), &again) != CW_OK) fail_msg("%s", cw_fail_message());
  assert_true(again.unit == model.unit);
  assert_int_equal(again.domain_count, 3);
  assert_memory_equal(again.domain, model.domain, sizeof model.domain);
  assert_int_equal(again.patch_count, model.patch_count);
  for (int p = 0; p < model.patch_count; p++) {
    CwModelPatch *a = &again.patch[p], *b = &model.patch[p];
    assert_true(a->y_plus == b->y_plus || (isnan(a->y_plus) && isnan(b->y_plus)));
    assert_true(a->y_plus_asked == b->y_plus_asked || (isnan(a->y_plus_asked) && isnan(b->y_plus_asked)));
    assert_string_equal(a->name, b->name);
    assert_true(a->kind == b->kind && a->domain == b->domain && a->size == b->size && a->group == b->group);
    assert_memory_equal(&a->flow, &b->flow, sizeof a->flow);
    assert_true(a->turns == b->turns && a->monitored == b->monitored && a->flow_share == b->flow_share);
  }
  assert_int_equal(again.interface_count, 2);
  for (int i = 0; i < 2; i++) {
    const CwModelInterface *a = &again.interface[i], *b = &model.interface[i];
    assert_true(a->patch[0] == b->patch[0] && a->patch[1] == b->patch[1]);
    assert_true(a->surface == b->surface && a->radius == b->radius);
  }
  assert_true(again.interface[1].radius == 0);
  assert_memory_equal(&again.flow, &model.flow, sizeof model.flow);
  cw_model_free(&again);
  cw_model_free(&model);
  unlink(file());
}

static void what_is_left_open(void **state) {
  CwModel model = double_suction();
  int side;
  assert_int_equal(model.patch[cw_model_patch_find(&model, "Vane_1")].turns, 1);
  assert_int_equal(model.patch[cw_model_patch_find(&model, "pipe")].turns, 0);
  assert_int_equal(model.patch[cw_model_patch_find(&model, "from_wheel")].turns, 0);
  assert_int_equal(model.patch[cw_model_patch_find(&model, "to_casing")].size, CW_GROUP_INTERFACE);
  assert_int_equal(model.patch[cw_model_patch_find(&model, "middle")].size, CW_GROUP_PIPE);
  assert_int_equal(cw_model_domain_find(&model, "casing"), 2);
  assert_int_equal(cw_model_domain_find(&model, "rotor"), -1);
  int from = cw_model_patch_find(&model, "from_suction"), out = cw_model_patch_find(&model, "out");
  assert_int_equal(cw_interface_of(model.interface, model.interface_count, from, &side), 1);
  assert_int_equal(side, 1);
  assert_int_equal(cw_interface_of(model.interface, model.interface_count, out, &side), -1);
  cw_model_free(&model);
}

static void refused(CwStatus status, const char *message) {
  assert_int_equal(status, CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), message)) fail_msg("'%s' has no '%s'", cw_fail_message(), message);
  cw_fail_clear();
}

static void names_and_sides_are_held_against_the_rules(void **state) {
  CwModel model = double_suction(), none = {0};
  CwModelPatch *patch;
  const char *taken[] = {"to_wheel", "from_wheel"}, *no_side[] = {"pipe", "from_wheel"};
  refused(cw_model_add_patch(&none, "wall", CW_PATCH_WALL, &patch), "before the first domain");
  refused(cw_model_add_domain(&model, "wheel", 0), "'wheel' is named twice");
  refused(cw_model_add_domain(&model, "Wheel", 0), "domain name 'Wheel'; allowed are 1 to 14 small letters");
  refused(cw_model_add_domain(&model, "fifteen_letters", 0), "allowed are 1 to 14");
  refused(cw_model_add_patch(&model, "out", CW_PATCH_WALL, &patch), "patch 'out' is named twice");
  refused(cw_model_add_patch(&model, "WHEEL", CW_PATCH_WALL, &patch),
          "'WHEEL' has a name that domain 'wheel' has in CGNS");
  refused(cw_model_add_patch(&model, "casing_domain", CW_PATCH_WALL, &patch), "such as 'casing_wall'");
  add(&model, "Wheel", CW_PATCH_SYMMETRY);
  add(&model, "LATER", CW_PATCH_SYMMETRY);
  refused(cw_model_add_domain(&model, "later", 0), "patch 'LATER' has a name that domain 'later' has");
  refused(cw_model_add_patch(&model, "to wheel", CW_PATCH_WALL, &patch), "allowed are 1 to 22 letters, digits and _");
  refused(cw_model_add_interface(&model, taken, CW_SURFACE_PLANE, 0), "'to_wheel' is a side of another");
  refused(cw_model_add_interface(&model, no_side, CW_SURFACE_PLANE, 0), "'pipe' is no patch of kind interface");
  add(&model, "a", CW_PATCH_INTERFACE);
  add(&model, "b", CW_PATCH_INTERFACE);
  const char *same[] = {"a", "b"};
  refused(cw_model_add_interface(&model, same, CW_SURFACE_PLANE, 0), "both sides in domain casing");
  refused(cw_model_write(&model, file()), "model-test.json: patch 'a' of kind interface has no other side");
  cw_model_free(&model);
}

// A member of the file put at another value.
static void damaged(const char *find, const char *replace, const char *message) {
  CwModel model = double_suction(), again = {0};
  assert_int_equal(cw_model_write(&model, file()), CW_OK);
  char *text = read_whole(file(), NULL), *at = strstr(text, find);
  if (!at) fail_msg("no %s", find);
  FILE *stream = fopen(file(), "w");
  assert_non_null(stream);
  fprintf(stream, "%.*s%s%s", (int)(at - text), text, replace, at + strlen(find));
  fclose(stream);
  free(text);
  refused(cw_model_read(file(), &again), message);
  cw_model_free(&again);
  cw_model_free(&model);
  unlink(file());
}

static void wrong_files_are_told(void **state) {
  damaged("\"unit_m\": 0.001", "\"unit_m\": 0", "model-test.json: 'unit_m' must be there and a number above 0");
  damaged("\"format\": 2", "\"format\": 1", "'format' must be 2");
  damaged("\"kind\": \"inlet\"", "\"kind\": \"hole\"",
          "model-test.json: patch 'inlet_left': kind 'hole'; allowed are wall, inlet, outlet, interface and symmetry");
  damaged("\"group\": \"blade\"", "\"group\": \"interface\"",
          "patch 'Vane_1': group 'interface'; allowed are blade, hub_shroud, volute and pipe");
  damaged("\"width_m\": 0.01", "\"width_m\": -1", "patch 'pipe': 'width_m' must be there and a number above 0");
  damaged("\"flow_share\": 0.25", "\"flow_share\": 0", "patch 'out': 'flow_share' must be");
  damaged("\"surface\": \"cylinder\"", "\"surface\": \"cone\"", "interface 1: surface 'cone'");
  damaged("\"inlet_speed_m_per_s\"", "\"speed\"", "'inlet_speed_m_per_s' must be there");
  damaged("\"name\": \"casing\"", "\"name\": \"wheel\"", "model-test.json: domain 'wheel' is named twice");
}

static void a_missing_file_is_told(void **state) {
  CwModel model = {0};
  assert_int_equal(cw_model_read("no/such/model.json", &model), CW_ERR_IO);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_written_is_read), cmocka_unit_test(what_is_left_open),
                                     cmocka_unit_test(names_and_sides_are_held_against_the_rules),
                                     cmocka_unit_test(wrong_files_are_told), cmocka_unit_test(a_missing_file_is_told)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
