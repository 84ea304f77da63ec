// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/interface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

static const double RADIUS = 0.1, HEIGHT = 0.02;

// A ring of `around` x `along` quadrilaterals, or twice as many triangles.
static int64_t make_ring(int around, int along, int triangles, double turn, CwInterfaceFace **faces) {
  int64_t count = 0;
  *faces = calloc((size_t)(2 * around * along), sizeof **faces);
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < along; ++k) {
      double corner[4][3];
      for (int c = 0; c < 4; ++c) {
        double angle = turn + 2 * M_PI * (i + (c == 1 || c == 2)) / around;
        corner[c][0] = RADIUS * cos(angle);
        corner[c][1] = RADIUS * sin(angle);
        corner[c][2] = HEIGHT * (k + (c > 1)) / along - HEIGHT / 2;
      }
      for (int t = 0; t < 1 + triangles; ++t) {
        const int pick[2][4] = {{0, 1, 2, 3}, {0, 2, 3, 3}};
        CwInterfaceFace *face = &(*faces)[count];
        face->place = count++;
        face->count = triangles ? 3 : 4;
        for (int c = 0; c < face->count; ++c)
          memcpy(face->nodes[c], corner[pick[t][c]], sizeof corner[0]);
      }
    }
  return count;
}

typedef struct {
  CwMeshPatch names[2];
  CwPatchPart sums[2];
  CwMesh mesh;
  CwAssembly assembly;
} Pair;

static void make_pair(Pair *p) {
  memset(p, 0, sizeof *p);
  p->names[0] = (CwMeshPatch){"rotor_interface", CW_KIND_INTERFACE, 0};
  p->names[1] = (CwMeshPatch){"stator_interface", CW_KIND_INTERFACE, 1};
  p->mesh.patches = p->names;
  p->mesh.patch_count = 2;
  p->assembly.mesh = &p->mesh;
  p->assembly.patches = p->sums;
  p->sums[0].triangles = make_ring(36, 5, 1, 0.02, &p->assembly.interface[0]);
  p->sums[1].quads = make_ring(50, 7, 0, 0.3, &p->assembly.interface[1]);
}

static void free_pair(Pair *p) {
  free(p->assembly.interface[0]);
  free(p->assembly.interface[1]);
}

// The place that (r, s) means in a face, as angle and z.
static void place_in(const CwInterfaceFace *f, const double rs[2], double out[2]) {
  double r = rs[0], s = rs[1];
  double w[4] = {1 - r - s, r, s, 0};
  if (f->count == 4) {
    const double q[4] = {(1 - r) * (1 - s), r * (1 - s), r * s, (1 - r) * s};
    memcpy(w, q, sizeof q);
  }
  double first = atan2(f->nodes[0][1], f->nodes[0][0]);
  out[0] = first;
  out[1] = 0;
  for (int c = 0; c < f->count; ++c) {
    out[0] += w[c] * remainder(atan2(f->nodes[c][1], f->nodes[c][0]) - first, 2 * M_PI);
    out[1] += w[c] * f->nodes[c][2];
  }
}

static void every_centre_lies_where_its_donor_says(void **state) {
  (void)state;
  Pair p;
  CwInterface interface = {0};
  make_pair(&p);
  assert_int_equal(cw_interface_make(&p.assembly, RADIUS, &interface), CW_OK);
  for (int d = 0; d < 2; ++d) {
    assert_int_equal(interface.count[d], d ? 350 : 360);
    for (int64_t i = 0; i < interface.count[d]; ++i) {
      const CwInterfaceFace *face = &p.assembly.interface[d][i];
      double place[2], x[3] = {0};
      place_in(&p.assembly.interface[1 - d][interface.donor[d][i]], interface.place[d][i], place);
      for (int c = 0; c < face->count; ++c)
        for (int k = 0; k < 3; ++k)
          x[k] += face->nodes[c][k] / face->count;
      assert_float_equal(place[1], x[2], 1e-12);
      // The centre of a triangle is off the mean of the angles by a third order of its width.
      assert_true(fabs(remainder(place[0] - atan2(x[1], x[0]), 2 * M_PI)) < 2e-4);
    }
  }
  cw_interface_free(&interface);
  free_pair(&p);
}

static void a_radial_gap_is_told(void **state) {
  (void)state;
  Pair p;
  CwInterface interface = {0};
  make_pair(&p);
  for (int64_t i = 0; i < 350; ++i)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 2; ++k)
        p.assembly.interface[1][i].nodes[c][k] *= 1.01;
  assert_int_equal(cw_interface_make(&p.assembly, RADIUS, &interface), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "patch 'stator_interface'"));
  assert_non_null(strstr(cw_fail_message(), "has the radius 101 mm; the interface has 100 mm"));
  cw_interface_free(&interface);
  free_pair(&p);
}

static void different_ends_are_told(void **state) {
  (void)state;
  Pair p;
  CwInterface interface = {0};
  make_pair(&p);
  for (int64_t i = 0; i < 350; ++i)
    for (int c = 0; c < 4; ++c)
      p.assembly.interface[1][i].nodes[c][2] += 1e-3;
  assert_int_equal(cw_interface_make(&p.assembly, RADIUS, &interface), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "from z = -10 to 10 mm in the rotor, but from -9 to 11 mm"));
  cw_interface_free(&interface);
  free_pair(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_centre_lies_where_its_donor_says),
      cmocka_unit_test(a_radial_gap_is_told),
      cmocka_unit_test(different_ends_are_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
