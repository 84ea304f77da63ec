// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>

#include "mesher/surface/chords.h"
#include "tests/unit_test.h"

// An arc about the origin from one angle to another, in degrees.
static CwChord arc(double radius, double from, double to, int32_t a, int32_t b) {
  CwChord chord = {.point = {a, b}, .deviation = radius * (1 - cos((to - from) * M_PI / 360))};
  for (int i = 0; i < CW_CHORD_SAMPLES; i++) {
    double angle = (from + (to - from) * i / (CW_CHORD_SAMPLES - 1)) * M_PI / 180;
    chord.uv[i][0] = radius * cos(angle);
    chord.uv[i][1] = radius * sin(angle);
  }
  return chord;
}

static CwChord line(double x0, double y0, double x1, double y1, int32_t a, int32_t b) {
  CwChord chord = {.point = {a, b}};
  for (int i = 0; i < CW_CHORD_SAMPLES; i++) {
    double s = (double)i / (CW_CHORD_SAMPLES - 1);
    chord.uv[i][0] = x0 + s * (x1 - x0);
    chord.uv[i][1] = y0 + s * (y1 - y0);
  }
  return chord;
}

static void assert_halved(int32_t count, const CwChord *chord, const char *wanted) {
  uint8_t halve[16];
  assert_int_equal(cw_chords_to_halve(count, chord, halve), CW_OK);
  for (int32_t i = 0; i < count; i++) assert_int_equal(halve[i], wanted[i] == 'h');
}

// A corner of the inner arc, at 45 degrees and radius r, is outside of the outer square where r > cos 45.
static void a_point_between_chord_and_curve_halves_the_chord(void **state) {
  for (int inside = 0; inside < 2; inside++) {
    double r = inside ? 0.70 : 0.72;
    CwChord chord[] = {arc(1, 0, 90, 0, 1), arc(r, 30, 45, 2, 3), arc(r, 45, 60, 3, 4)};
    assert_halved(3, chord, inside ? "..." : "h..");
  }
}

static void a_point_on_a_chord_halves_it(void **state) {
  CwChord chord[] = {line(0, 0, 2, 0, 0, 1), line(1, 0, 1, 1, 2, 3)};
  assert_halved(2, chord, "h.");
  chord[1] = line(1, 1e-3, 1, 1, 2, 3);
  assert_halved(2, chord, "..");
}

// Two arcs between the same two points.
static void of_chords_that_coincide_the_more_bent_is_halved(void **state) {
  CwChord flat = line(1, 0, 0, 1, 0, 1), bent = arc(1, 0, 90, 0, 1);
  CwChord chord[] = {flat, bent};
  assert_halved(2, chord, ".h");
  CwChord other[] = {bent, flat};
  assert_halved(2, other, "h.");
  bent.given = 1;
  CwChord fixed[] = {bent, flat};
  assert_halved(2, fixed, ".h");
}

// A straight chord crosses the chord of an arc beside it; all ends are outside of the lens.
static void of_chords_that_cross_the_more_bent_is_halved(void **state) {
  CwChord chord[] = {arc(1, 0, 90, 0, 1), line(0, 0, 0.6, 0.6, 2, 3)};
  assert_halved(2, chord, "h."); // its end is in the lens
  chord[1] = line(0, 0, 0.8, 0.8, 2, 3);
  chord[1].given = 1;
  assert_halved(2, chord, "h."); // it would cross the curve too: the mesh of the face tells
}

// Two circles that nearly touch, of four chords each that cross: halved until nothing is found, one polygon lies within
// the other.
static void halving_keeps_circles_apart(void **state) {
  CwChord chord[200];
  uint8_t halve[200];
  double gap = 1e-3, from[200], to[200], radius[200];
  int32_t count = 0, points = 8;
  for (int k = 0; k < 8; k++) {
    radius[k] = k < 4 ? 1 : 1 - gap;
    from[k] = 90 * (k % 4) + (k < 4 ? 0 : 17);
    to[k] = from[k] + 90;
    chord[count++] = arc(radius[k], from[k], to[k], k, k / 4 * 4 + (k + 1) % 4);
  }
  for (int more = 1, round = 0; more; round++) {
    assert_true(round < 12);
    more = 0;
    assert_int_equal(cw_chords_to_halve(count, chord, halve), CW_OK);
    for (int32_t i = 0, all = count; i < all; i++) {
      if (!halve[i]) continue;
      double middle = (from[i] + to[i]) / 2;
      from[count] = middle, to[count] = to[i], radius[count] = radius[i], to[i] = middle, more = 1;
      chord[count] = arc(radius[i], middle, to[count], points, chord[i].point[1]);
      chord[i] = arc(radius[i], from[i], middle, chord[i].point[0], points++);
      count++;
      assert_true(count < 200);
    }
  }
  // Both polygons are convex: the inner one lies within where its corners lie to the left of all outer chords.
  for (int32_t i = 0; i < count; i++) {
    for (int32_t j = 0; j < count && radius[i] == 1; j++) {
      const double *a = chord[i].uv[0], *b = chord[i].uv[CW_CHORD_SAMPLES - 1], *p = chord[j].uv[0];
      if (radius[j] < 1) assert_true((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_point_between_chord_and_curve_halves_the_chord),
      cmocka_unit_test(a_point_on_a_chord_halves_it), cmocka_unit_test(of_chords_that_coincide_the_more_bent_is_halved),
      cmocka_unit_test(of_chords_that_cross_the_more_bent_is_halved), cmocka_unit_test(halving_keeps_circles_apart)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
