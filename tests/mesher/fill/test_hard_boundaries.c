// SPDX-License-Identifier: AGPL-3.0-or-later
// Every boundary of the library but those of `refused` and `slow`, and each of a list of random ones, is filled by the
// kernel's flips or by TetGen. With `all` as argument, the slow ones too. With three numbers, random ones alone: as
// many, of the seeds from the second on, each so much after the one before as the third says. With a name, that
// boundary of the library alone; with `seed N`, that random one alone.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fill_fault.h"
#include "hard_boundaries.h"
#include "mesher/fill/boundary_check.h"
#include "mesher/fill/fill_with_fallback.h"
#include "pipeline/log.h"
#include "random_boundary.h"
#include "tests/unit_test.h"

static CwLog *test_log;

// Whether those of `slow` are among them.
static int all;

// Of the random ones.
static int random_count = 12;
static uint64_t first_seed = 1, seed_step = 1;

typedef struct {
  int filled, whole, flipped, tetgen;
} Count;

static void add(Count *count, const CwFillRecovery *recovery) {
  count->filled++;
  if (recovery->tetgen)
    count->tetgen++;
  else if (recovery->missing)
    count->flipped++;
  else
    count->whole++;
}

static void print_count(const char *what, const Count *c) {
  printf("%s: %d filled: %d Delaunay as they are, %d by flips, %d by TetGen\n", what, c->filled, c->whole, c->flipped,
         c->tetgen);
}

// What neither can fill without points on the boundary: a polyhedron for which a quadratic number of points inside is
// needed (B. Chazelle, Convex partitions of polyhedra, SIAM J. Comput. 13, 1984).
static const char *const refused[] = {"chazelle"};

static int is_refused(const char *name) {
  for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
    if (!strcmp(name, refused[k])) return 1;
  }
  return 0;
}

// Half the time of the library; comb_of_thin_teeth and void_near_the_wall are of their kinds.
static const char *const slow[] = {"comb", "comb_of_thin_slots", "nearly_touching_voids"};

static int is_left_out(const char *name) {
  for (size_t k = 0; k < sizeof slow / sizeof *slow && !all; k++) {
    if (!strcmp(name, slow[k])) return 1;
  }
  return 0;
}

// Whether a fault is a refusal in one line, with the region and the place.
static int is_told(const char *fault, const char *region) {
  return fault && !strncmp(fault, region, strlen(region)) && strstr(fault, " mm");
}

// Fills it; gives NULL or what is wrong.
static const char *fill_one(const Surface *s, const char *name, double size, Count *count) {
  CwFillInput input = fill_input(s, &size);
  CwFill fill;
  double seconds = cw_processor_seconds();
  if (cw_fill_with_fallback(&input, CW_FILL_KERNEL, &fill) != CW_OK) return cw_fail_message();
  seconds = cw_processor_seconds() - seconds;
  const char *fault = fill_fault(s, &fill);
  if (getenv("CUTWATER_VERBOSE"))
    printf("%-32s %6d triangles %7d cells %5d missing %6d flips%s, flatness %.2g, %.2f s\n", name, s->triangle_count,
           fill.tetrahedron_count, fill.recovery.missing, fill.recovery.flips, fill.recovery.tetgen ? ", TetGen" : "",
           cw_fill_flatness(&fill), seconds);
  add(count, &fill.recovery);
  cw_fill_free(&fill);
  return fault;
}

static void library(void **unused) {
  Count count = {0};
  int faults = 0, left_out = 0;
  for (int k = 0; k < hard_boundary_count(); k++) {
    Surface s;
    double size;
    const char *name = hard_boundary(k, &s, &size), *fault;
    if (is_left_out(name)) {
      surface_free(&s);
      left_out++;
      continue;
    }
    CwFillInput input = fill_input(&s, &size);
    if (cw_boundary_check_crossing(&input) != CW_OK) fail_msg("%s: no boundary: %s", name, cw_fail_message());
    fault = fill_one(&s, name, size, &count);
    if (is_refused(name)) {
      fault = is_told(fault, input.name) ? NULL : "was not refused with its place";
    }
    if (fault) print_error("%s: %s\n", name, fault);
    faults += fault != NULL;
    surface_free(&s);
  }
  print_count("library", &count);
  assert_int_equal(left_out, all ? 0 : sizeof slow / sizeof *slow);
  assert_int_equal(count.filled, hard_boundary_count() - (int)(sizeof refused / sizeof *refused) - left_out);
  assert_int_equal(faults, 0);
}

// Those that cross themselves or have triangles without area do not count, but must be refused with a place; and so may
// one of a hundred of the others be, of which nobody knows whether they can be filled without points on the boundary.
static void random_ones(void **unused) {
  Count count = {0};
  int faults = 0, crossing = 0, told = 0;
  for (uint64_t seed = first_seed; count.filled + told + faults < random_count; seed += seed_step) {
    Surface s;
    double size;
    char name[32];
    random_boundary(seed, &s, &size);
    snprintf(name, sizeof name, "seed %llu", (unsigned long long)seed);
    CwFillInput input = fill_input(&s, &size);
    const char *fault = NULL;
    if (cw_boundary_check(&input) != CW_OK || cw_boundary_check_crossing(&input) != CW_OK) {
      CwFill fill;
      crossing++;
      CwStatus status = cw_fill_with_fallback(&input, CW_FILL_KERNEL, &fill);
      if (status != CW_ERR_MESH || !strstr(cw_fail_message(), " mm"))
        fault = "a boundary that crosses itself was not refused with its place";
      cw_fill_free(&fill);
    } else {
      fault = fill_one(&s, name, size, &count);
      if (is_told(fault, input.name)) {
        printf("%s: refused: %s\n", name, fault);
        told++;
        fault = NULL;
      }
    }
    if (fault) print_error("%s: %s\n", name, fault);
    faults += fault != NULL;
    surface_free(&s);
  }
  print_count("random", &count);
  assert_true(100 * told <= random_count);
  printf("%d more were no boundaries and were refused\n", crossing);
  assert_int_equal(faults, 0);
}

static void equal_bits_twice(void **unused) {
  for (int k = 0; k < hard_boundary_count(); k += 6) {
    Surface s;
    double size;
    CwFill fill[2];
    hard_boundary(k, &s, &size);
    CwFillInput input = fill_input(&s, &size);
    assert_int_equal(cw_fill_with_fallback(&input, CW_FILL_KERNEL, &fill[0]), CW_OK);
    void *shift = malloc(4321); // other addresses the second time
    assert_int_equal(cw_fill_with_fallback(&input, CW_FILL_KERNEL, &fill[1]), CW_OK);
    assert_int_equal(fill[0].point_count, fill[1].point_count);
    assert_int_equal(fill[0].tetrahedron_count, fill[1].tetrahedron_count);
    assert_memory_equal(fill[0].x, fill[1].x, (size_t)fill[0].point_count * sizeof *fill[0].x);
    assert_memory_equal(fill[0].tetrahedron, fill[1].tetrahedron,
                        (size_t)fill[0].tetrahedron_count * sizeof *fill[0].tetrahedron);
    free(shift);
    cw_fill_free(&fill[0]);
    cw_fill_free(&fill[1]);
    surface_free(&s);
  }
}

static int one_alone(const char *name, uint64_t seed) {
  Count count = {0};
  const char *fault = "there is no such boundary";
  Surface s = {0};
  double size;
  if (!name) {
    random_boundary(seed, &s, &size);
    fault = fill_one(&s, "random", size, &count);
  }
  for (int k = 0; k < hard_boundary_count() && name; k++) {
    if (strcmp(hard_boundary(k, &s, &size), name) == 0) fault = fill_one(&s, name, size, &count);
    surface_free(&s);
  }
  surface_free(&s);
  if (fault) printf("%s\n", fault);
  return fault != NULL;
}

int main(int argc, char **argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(library), cmocka_unit_test(random_ones),
                                     cmocka_unit_test(equal_bits_twice)};
  const struct CMUnitTest many[] = {cmocka_unit_test(random_ones)};
  if (getenv("CUTWATER_VERBOSE")) cw_log_open("test", NULL, 1, getenv("CUTWATER_VERBOSE")[0] == '2', &test_log);
  if (argc == 3) return one_alone(NULL, strtoull(argv[2], NULL, 10));
  all = argc == 2 && !strcmp(argv[1], "all");
  if (argc == 2 && !all) return one_alone(argv[1], 0);
  if (argc == 4) {
    random_count = atoi(argv[1]);
    first_seed = strtoull(argv[2], NULL, 10);
    seed_step = strtoull(argv[3], NULL, 10);
    return cmocka_run_group_tests(many, NULL, NULL);
  }
  return cmocka_run_group_tests(tests, NULL, NULL);
}
