// SPDX-License-Identifier: AGPL-3.0-or-later
// Which of both fills is taken: kernel and TetGen stand here as functions that give what the test asks of them.
// (With both as they are: test_hard_boundaries.)
#include "mesher/fill/fill_with_fallback.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/fill/kernel.h"
#include "mesher/fill/tetgen_fill.h"
#include "tests/unit_test.h"

enum { OF_KERNEL = 4, OF_TETGEN = 5 }; // points of their fills

// Of a tetrahedron over an equilateral triangle: its height for a flatness.
static double height_for(double flatness) {
  return flatness / sqrt(0.75);
}

// One tetrahedron over an equilateral triangle with edges of 1, its longest; with some points more, unused.
static void make_fill(int32_t points, double flatness, CwFill *fill) {
  const double x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0.5, sqrt(0.75), 0}, {0.5, sqrt(0.75) / 3, height_for(flatness)}};
  *fill = (CwFill){.point_count = points, .tetrahedron_count = 1};
  fill->x = calloc((size_t)points, sizeof *fill->x);
  fill->tetrahedron = malloc(sizeof *fill->tetrahedron);
  assert_true(fill->x && fill->tetrahedron);
  memcpy(fill->x, x, sizeof x);
  for (int k = 0; k < 4; k++) fill->tetrahedron[0][k] = k;
}

static struct {
  CwStatus status;
  CwKernelOutcome outcome;
  double flatness;
  int calls;
} kernel;

static struct {
  CwStatus status;
  double flatness;
  int calls;
} tetgen;

static const CwFillInput boundary = {.name = "rotor region 3"};
static const CwFillRecovery tried = {.missing = 7, .flips = 11};

CwStatus cw_kernel_fill(const CwFillInput *input, CwFill *fill, CwKernelOutcome *outcome) {
  assert_ptr_equal(input, &boundary);
  kernel.calls++;
  *fill = (CwFill){0};
  *outcome = kernel.outcome;
  if (kernel.status != CW_OK) return kernel.status;
  if (kernel.outcome == CW_KERNEL_FILLED) make_fill(OF_KERNEL, kernel.flatness, fill);
  fill->recovery = tried;
  return CW_OK;
}

CwStatus cw_tetgen_fill(const CwFillInput *input, CwFill *fill) {
  assert_ptr_equal(input, &boundary);
  tetgen.calls++;
  *fill = (CwFill){0};
  if (tetgen.status != CW_OK) return tetgen.status;
  make_fill(OF_TETGEN, tetgen.flatness, fill);
  return CW_OK;
}

static void no_kernel_where_tetgen_is_asked_for(void **state) {
  CwFill fill;
  kernel.calls = tetgen.calls = 0;
  tetgen.status = CW_OK;
  tetgen.flatness = 0.5;
  assert_int_equal(cw_fill_with_fallback(&boundary, CW_FILL_TETGEN, &fill), CW_OK);
  assert_int_equal(kernel.calls, 0);
  assert_int_equal(tetgen.calls, 1);
  assert_int_equal(fill.point_count, OF_TETGEN);
  assert_memory_equal(&fill.recovery, &((CwFillRecovery){.tetgen = 1}), sizeof fill.recovery);
  cw_fill_free(&fill);
}

// The kernel's fill counts unless it is as flat as rounding, 1e-7; then TetGen's, unless that is flatter. The kernel's
// recovery is told of in any case.
static void the_fill_that_is_less_flat_is_taken(void **state) {
  const struct {
    CwKernelOutcome outcome;
    double kernel;
    CwStatus status;
    double tetgen;
    int calls;      // of TetGen
    int32_t points; // of which; 0: none
  } tried_so[] = {
      {CW_KERNEL_FILLED, 0.5, CW_OK, 0.6, 0, OF_KERNEL},       {CW_KERNEL_FILLED, 1.01e-7, CW_OK, 0.6, 0, OF_KERNEL},
      {CW_KERNEL_FILLED, 0.99e-7, CW_OK, 0.6, 1, OF_TETGEN},   {CW_KERNEL_FILLED, 5e-8, CW_OK, 5.1e-8, 1, OF_TETGEN},
      {CW_KERNEL_FILLED, 5e-8, CW_OK, 4.9e-8, 1, OF_KERNEL},   {CW_KERNEL_FILLED, 5e-8, CW_ERR_MESH, 0, 1, OF_KERNEL},
      {CW_KERNEL_FILLED, 0, CW_OK, 1e-9, 1, OF_TETGEN},        {CW_KERNEL_FILLED, 0, CW_ERR_MESH, 0, 1, 0},
      {CW_KERNEL_NOT_RECOVERED, 0, CW_OK, 1e-9, 1, OF_TETGEN}, {CW_KERNEL_NOT_RECOVERED, 0, CW_ERR_MESH, 0, 1, 0},
  };
  kernel.status = CW_OK;
  for (size_t i = 0; i < sizeof tried_so / sizeof *tried_so; i++) {
    CwFill fill;
    kernel.outcome = tried_so[i].outcome;
    kernel.flatness = tried_so[i].kernel;
    tetgen.status = tried_so[i].status;
    tetgen.flatness = tried_so[i].tetgen;
    kernel.calls = tetgen.calls = 0;
    assert_int_equal(cw_fill_with_fallback(&boundary, CW_FILL_KERNEL, &fill),
                     tried_so[i].points ? CW_OK : tried_so[i].status);
    assert_int_equal(kernel.calls, 1);
    assert_int_equal(tetgen.calls, tried_so[i].calls);
    assert_int_equal(fill.point_count, tried_so[i].points);
    if (tried_so[i].points) {
      assert_int_equal(fill.recovery.missing, tried.missing);
      assert_int_equal(fill.recovery.flips, tried.flips);
      assert_int_equal(fill.recovery.tetgen, tried_so[i].points == OF_TETGEN);
      const double flatness = tried_so[i].points == OF_KERNEL ? kernel.flatness : tetgen.flatness;
      assert_near(cw_fill_flatness(&fill) / flatness, 1, 1e-12);
    }
    cw_fill_free(&fill);
  }
}

// A boundary that is wrong is not given to TetGen too.
static void an_error_of_the_kernel_ends_it(void **state) {
  CwFill fill;
  kernel.status = CW_ERR_MESH;
  tetgen.calls = 0;
  assert_int_equal(cw_fill_with_fallback(&boundary, CW_FILL_KERNEL, &fill), CW_ERR_MESH);
  assert_int_equal(tetgen.calls, 0);
  assert_null(fill.x);
  kernel.status = CW_OK;
}

// Six times the volume over the cube of the longest edge: of a regular tetrahedron sqrt(1/2), of the corner of a cube
// 2^-1.5; the least of all counts, in any unit.
static void flatness_is_that_of_the_flattest(void **state) {
  double regular[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  double x[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -0.1}}, low = 0.1 * pow(2, -1.5);
  int32_t tetrahedron[3][4] = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 3}}, one[1][4] = {{0, 2, 1, 3}};
  CwFill fill = {.x = regular, .tetrahedron_count = 1, .tetrahedron = one};
  assert_near(cw_fill_flatness(&fill), sqrt(0.5), 1e-15);
  fill = (CwFill){.x = x, .tetrahedron_count = 1, .tetrahedron = tetrahedron};
  assert_near(cw_fill_flatness(&fill), pow(2, -1.5), 1e-15);
  fill.tetrahedron_count = 3;
  assert_near(cw_fill_flatness(&fill), low, 1e-15);
  for (int k = 0; k < 15; k++) x[k / 3][k % 3] *= 1e-3;
  assert_near(cw_fill_flatness(&fill), low, 1e-15);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(no_kernel_where_tetgen_is_asked_for),
      cmocka_unit_test(the_fill_that_is_less_flat_is_taken),
      cmocka_unit_test(an_error_of_the_kernel_ends_it),
      cmocka_unit_test(flatness_is_that_of_the_flattest),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
