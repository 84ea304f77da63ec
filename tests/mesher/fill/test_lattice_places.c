// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/fill/lattice_places.h"
#include "tests/unit_test.h"

typedef struct {
  double size, growth; // along x
} Field;

static double size_at(const void *context, const double x[3]) {
  const Field *f = context;
  return f->size + f->growth * x[0];
}

static const CwLatticeFrame frame = {{0, 0, 0}, 0.25};

static int64_t places_of(const Field *field, int32_t count, const CwLatticeCell *cell, CwRadix **place) {
  CwFillInput input = {.size = size_at, .size_context = field, .name = "box"};
  int64_t places;
  if (cw_lattice_places(&input, &frame, count, cell, &places, place) != CW_OK) fail_msg("%s", cw_fail_message());
  for (int64_t k = 1; k < places; k++) assert_true((*place)[k].key > (*place)[k - 1].key);
  return places;
}

// One cell of 8 m cut down to 1 m: 9^3 corners and 8^3 centres. Cell 0 of two has the corners between them.
static void even_field_gives_corners_and_centres(void **unused) {
  const Field field = {1.0 / CW_LATTICE_CONSTANT, 0};
  const CwLatticeCell cell[2] = {{{0, 0, 0}, 5, 1}, {{32, 0, 0}, 5, 1}};
  CwRadix *place;
  int64_t count = places_of(&field, 1, cell, &place);
  assert_int_equal(count, 729 + 512);
  free(place);
  count = places_of(&field, 2, cell, &place);
  assert_int_equal(count, 17 * 81 + 1024);
  for (int64_t k = 0; k < count; k++) {
    double fixed[3], x[3];
    cw_lattice_fixed(&frame, place[k].key, fixed);
    cw_lattice_point(&frame, &place[k], x);
    assert_int_equal(place[k].tag, 2);
    assert_int_equal(place[k].item, fixed[0] > 8);
    for (int i = 0; i < 3; i++) {
      assert_true(fixed[i] * 2 == floor(fixed[i] * 2) && fabs(x[i] - fixed[i]) <= 1e-3);
      assert_true(fixed[i] - floor(fixed[i]) == fixed[0] - floor(fixed[0])); // all halves, or none
    }
  }
  free(place);
}

// As many cells as are asked for, though the cells halve; those that do not count are cut as the others.
static void spacing_is_fitted(void **unused) {
  const Field field = {0.35, 0.04};
  CwLatticeCell cell[2] = {{{0, 0, 0}, 5, 1}, {{32, 0, 0}, 5, 1}};
  CwRadix *place;
  double wanted = 0, centres = 0;
  int64_t count = places_of(&field, 2, cell, &place);
  for (int k = 0; k < 1600; k++) {
    double x[3] = {0.01 * (k + 0.5), 0, 0};
    wanted += 0.01 * 64 / pow(CW_LATTICE_CONSTANT * size_at(&field, x), 3);
  }
  for (int64_t k = 0; k < count; k++) {
    int32_t half[3];
    cw_lattice_at(place[k].key, half);
    int32_t any = half[0] | half[1] | half[2];
    centres += (any & ((2 << place[k].tag) - 1)) != 0 && (half[0] & half[1] & half[2] & 1 << place[k].tag) != 0;
  }
  assert_true(fabs(centres / wanted - 1) < 0.1);
  free(place);
}

static void equal_bits_twice(void **unused) {
  const Field field = {0.3, 0.05};
  const CwLatticeCell cell = {{0, 0, 0}, 5, 1};
  CwRadix *one, *two;
  int64_t count = places_of(&field, 1, &cell, &one);
  assert_int_equal(places_of(&field, 1, &cell, &two), count);
  assert_memory_equal(one, two, (size_t)count * sizeof *one);
  free(one);
  free(two);
}

static void field_without_length_is_an_error(void **unused) {
  const Field field = {0.5, -0.1};
  const CwLatticeCell cell = {{0, 0, 0}, 5, 1};
  CwFillInput input = {.size = size_at, .size_context = &field, .name = "box"};
  CwRadix *place;
  int64_t count;
  assert_int_equal(cw_lattice_places(&input, &frame, 1, &cell, &count, &place), CW_ERR_MESH);
  assert_non_null(strstr(cw_fail_message(), "box: the size field gives"));
  assert_null(place);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(even_field_gives_corners_and_centres),
      cmocka_unit_test(spacing_is_fitted),
      cmocka_unit_test(equal_bits_twice),
      cmocka_unit_test(field_without_length_is_an_error),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
