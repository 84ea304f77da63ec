// SPDX-License-Identifier: AGPL-3.0-or-later
// Boxes that overlap, stand apart, or belong to no common pump: told with size and place.
#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/parts_joined.h"
}

// `opening`: the part that has an inlet; -1: none.
static CwStatus check(SmallParts &small, int opening = -1) {
  CwFacePatch inlet = {};
  inlet.kind = CW_PATCH_INLET;
  inlet.part = opening;
  CwFacePatches patches = {opening >= 0, &inlet, nullptr};
  if (small.look()) fail_msg("%s", cw_fail_message());
  return cw_parts_joined(&small.parts, &small.survey, small.contact, &small_frame, &small.cad, small_tolerance,
                         &patches);
}

static void boxes_in_a_row_are_joined(void **) {
  SmallParts small({{"a", small_box(0, 0, 0, 10, 10, 10)},
                    {"b", small_box(10, 0, 0, 10, 10, 10)},
                    {"c", small_box(20, 0, 0, 10, 10, 10)}});
  if (check(small)) fail_msg("%s", cw_fail_message());
}

static void gaps_have_their_size(void **) {
  SmallParts small({{"a", small_box(0, 0, 0, 100, 30, 30)}, {"b", small_box(100.5, 0, 0, 50, 30, 30)}});
  assert_int_equal(check(small), CW_ERR_GEOMETRY);
  if (!strstr(cw_fail_message(), "cad.domains.b.inside_mm: ") ||
      !strstr(cw_fail_message(), "a gap of 0.5 mm apart, of b and a, at (100.500, "))
    fail_msg("%s", cw_fail_message());
}

static void overlaps_have_their_volume(void **) {
  SmallParts small({{"a", small_box(0, 0, 0, 100, 30, 30)}, {"b", small_box(99, 0, 0, 50, 30, 30)}});
  assert_int_equal(check(small), CW_ERR_GEOMETRY);
  if (!strstr(cw_fail_message(), "cad.domains.b.inside_mm: b and a overlap by 900 mm3, at (99.000, "))
    fail_msg("%s", cw_fail_message());
}

// A casing drawn over the wheel: their faces do not even cross.
static void a_part_inside_another_overlaps(void **) {
  SmallParts small({{"a", small_box(0, 0, 0, 10, 10, 10)}, {"b", small_box(-20, -20, 0, 50, 50, 30)}});
  assert_int_equal(check(small), CW_ERR_GEOMETRY);
  if (!strstr(cw_fail_message(), "cad.domains.a.inside_mm: a and b overlap by 1000 mm3"))
    fail_msg("%s", cw_fail_message());
}

// What has no opening is told by the model.
static void two_pumps_are_told(void **) {
  SmallParts apart({{"a", small_box(0, 0, 0, 10, 10, 10)}, {"b", small_box(100, 0, 0, 10, 10, 10)}});
  apart.domain[1].rotating = 1;
  assert_int_equal(check(apart, 1), CW_ERR_GEOMETRY);
  if (!strstr(cw_fail_message(), "cad.domains.b.inside_mm: no face of its solid joins it to a, which rotates too; "
                                 "allowed: the water of one pump"))
    fail_msg("%s", cw_fail_message());
  SmallParts closed({{"a", small_box(0, 0, 0, 10, 10, 10)}, {"b", small_box(100, 0, 0, 10, 10, 10)}});
  if (check(closed)) fail_msg("%s", cw_fail_message());
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(boxes_in_a_row_are_joined), cmocka_unit_test(gaps_have_their_size),
      cmocka_unit_test(overlaps_have_their_volume), cmocka_unit_test(a_part_inside_another_overlaps),
      cmocka_unit_test(two_pumps_are_told)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
