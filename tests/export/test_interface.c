// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/interface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

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
        for (int c = 0; c < face->count; ++c) memcpy(face->nodes[c], corner[pick[t][c]], sizeof corner[0]);
      }
    }
  return count;
}

typedef struct {
  CwModelPatch names[2];
  CwModelInterface surfaces[3]; // the cylinder, a plane, and the cylinder taken for any surface
  CwPatchPart sums[2];
  CwMesh mesh;
  CwAssembly assembly;
} Pair;

static void make_pair(Pair *p) {
  memset(p, 0, sizeof *p);
  p->names[0] = (CwModelPatch){"rotor_interface", CW_PATCH_INTERFACE, .domain = 0};
  p->names[1] = (CwModelPatch){"stator_interface", CW_PATCH_INTERFACE, .domain = 1};
  p->surfaces[0] = (CwModelInterface){{0, 1}, CW_SURFACE_CYLINDER, RADIUS};
  p->surfaces[1] = (CwModelInterface){{0, 1}, CW_SURFACE_PLANE, 0};
  p->surfaces[2] = (CwModelInterface){{0, 1}, CW_SURFACE_OTHER, 0};
  p->mesh.interfaces = p->surfaces;
  p->mesh.interface_count = 1;
  p->mesh.patches = p->names;
  p->mesh.patch_count = 2;
  p->assembly.mesh = &p->mesh;
  p->assembly.patches = p->sums;
  p->sums[0].faces.triangles = make_ring(36, 5, 1, 0.02, &p->assembly.interface[0][0]);
  p->sums[1].faces.quads = make_ring(50, 7, 0, 0.3, &p->assembly.interface[0][1]);
}

static void free_pair(Pair *p) {
  free(p->assembly.interface[0][0]);
  free(p->assembly.interface[0][1]);
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
  Pair p;
  CwInterface interface = {0};
  make_pair(&p);
  assert_int_equal(cw_interface_make(&p.assembly, 0, &interface), CW_OK);
  for (int d = 0; d < 2; ++d) {
    assert_int_equal(interface.count[d], d ? 350 : 360);
    for (int64_t i = 0; i < interface.count[d]; ++i) {
      const CwInterfaceFace *face = &p.assembly.interface[0][d][i];
      double place[2], x[3] = {0};
      place_in(&p.assembly.interface[0][1 - d][interface.donor[d][i]], interface.place[d][i], place);
      for (int c = 0; c < face->count; ++c)
        for (int k = 0; k < 3; ++k) x[k] += face->nodes[c][k] / face->count;
      assert_near(place[1], x[2], 1e-12);
      // The centre of a triangle is off the mean of the angles by a third order of its width.
      assert_true(fabs(remainder(place[0] - atan2(x[1], x[0]), 2 * M_PI)) < 2e-4);
    }
  }
  cw_interface_free(&interface);
  free_pair(&p);
}

// That an interface of the mesh is refused, with both texts in the message; `patch`: NULL: one.
static void is_refused(const Pair *p, int number, const char *patch, const char *words) {
  CwInterface interface = {0};
  assert_int_equal(cw_interface_make(&p->assembly, number, &interface), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), words) || (patch && !strstr(cw_fail_message(), patch)))
    fail_msg("%s", cw_fail_message());
  cw_interface_free(&interface);
}

static void a_radial_gap_is_told(void **state) {
  Pair p;
  make_pair(&p);
  for (int64_t i = 0; i < 350; ++i)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 2; ++k) p.assembly.interface[0][1][i].nodes[c][k] *= 1.01;
  is_refused(&p, 0, "patch 'stator_interface'", "has the radius 101 mm; the interface has 100 mm");
  free_pair(&p);
}

static void different_ends_are_told(void **state) {
  Pair p;
  make_pair(&p);
  for (int64_t i = 0; i < 350; ++i)
    for (int c = 0; c < 4; ++c) p.assembly.interface[0][1][i].nodes[c][2] += 1e-3;
  is_refused(&p, 0, NULL, "from z = -10 to 10 mm on patch 'rotor_interface', but from -9 to 11 mm");
  free_pair(&p);
}

// A disc inscribed in the circle of RADIUS, as triangles round its middle in `rings`; tilted by 30 degrees about x.
static int64_t make_disc(int around, int rings, CwInterfaceFace **faces) {
  const double tilt = M_PI / 6;
  *faces = calloc((size_t)(around * (2 * rings - 1)), sizeof **faces);
  int64_t count = 0;
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < around; ++i)
      for (int half = 0; half < (r ? 2 : 1); ++half) {
        const int ring[2][3] = {{r, r + 1, r + 1}, {r, r + 1, r}}, step[2][3] = {{0, 0, 1}, {0, 1, 1}};
        CwInterfaceFace *face = &(*faces)[count];
        face->place = count++;
        face->count = 3;
        for (int c = 0; c < 3; ++c) {
          double radius = RADIUS * ring[half][c] / rings, angle = 2 * M_PI * (i + step[half][c]) / around;
          double x = radius * cos(angle), y = radius * sin(angle);
          memcpy(face->nodes[c], (double[]){x, y * cos(tilt), y * sin(tilt) + 0.3}, sizeof face->nodes[c]);
        }
      }
  return count;
}

// Both sides have the same rim; inside, one is much finer.
static void make_discs(Pair *p) {
  make_pair(p);
  p->mesh.interface_count = 2;
  for (int side = 0; side < 2; ++side) {
    p->sums[side] = (CwPatchPart){.area = M_PI * RADIUS * RADIUS,
                                  .vector = {0, (side ? 1 : -1) * sin(M_PI / 6), (side ? -1 : 1) * cos(M_PI / 6)}};
    p->sums[side].faces.triangles = make_disc(24, side ? 7 : 3, &p->assembly.interface[1][side]);
  }
}

static void free_discs(Pair *p) {
  for (int side = 0; side < 2; ++side) free(p->assembly.interface[1][side]);
  free_pair(p);
}

static void a_disc_finds_its_donors_in_its_plane(void **state) {
  Pair p;
  CwInterface interface = {0};
  make_discs(&p);
  assert_int_equal(cw_interface_make(&p.assembly, 1, &interface), CW_OK);
  for (int d = 0; d < 2; ++d) {
    assert_int_equal(interface.count[d], d ? 24 * 13 : 24 * 5);
    for (int64_t i = 0; i < interface.count[d]; ++i) {
      const CwInterfaceFace *face = &p.assembly.interface[1][d][i];
      const CwInterfaceFace *donor = &p.assembly.interface[1][1 - d][interface.donor[d][i]];
      const double r = interface.place[d][i][0], s = interface.place[d][i][1], w[3] = {1 - r - s, r, s};
      for (int k = 0; k < 3; ++k) {
        double centre = 0, place = 0;
        for (int c = 0; c < 3; ++c) {
          centre += face->nodes[c][k] / 3;
          place += w[c] * donor->nodes[c][k];
        }
        assert_near(place, centre, 1e-12);
      }
    }
  }
  cw_interface_free(&interface);
  free_discs(&p);
}

static void a_node_off_the_disc_is_told(void **state) {
  Pair p;
  make_discs(&p);
  p.assembly.interface[1][1][40].nodes[1][2] += 1e-3;
  is_refused(&p, 1, "patch 'stator_interface'", "is 0.866 mm off the interface's plane; allowed: ");
  free_discs(&p);
}

static void discs_of_different_size_are_told(void **state) {
  Pair p;
  make_discs(&p);
  for (int64_t i = 0; i < p.sums[1].faces.triangles; ++i)
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k)
        p.assembly.interface[1][1][i].nodes[c][k] +=
            0.03 * (p.assembly.interface[1][1][i].nodes[c][k] - (k == 2) * 0.3);
  is_refused(&p, 1, NULL, "'rotor_interface', but from -103 to 103 mm");
  free_discs(&p);
}

// Without coordinates of the surface; on a cylinder these say which donors are right.
static void any_surface_has_the_donors_of_the_cylinder(void **state) {
  Pair p;
  CwInterface wanted = {0}, found = {0};
  make_pair(&p);
  assert_int_equal(cw_interface_make(&p.assembly, 0, &wanted), CW_OK);
  for (int s = 0; s < 2; ++s) p.assembly.interface[2][s] = p.assembly.interface[0][s];
  if (cw_interface_make(&p.assembly, 2, &found) != CW_OK) fail_msg("%s", cw_fail_message());
  for (int d = 0; d < 2; ++d) {
    int64_t same = 0;
    for (int64_t i = 0; i < wanted.count[d]; ++i) {
      if (found.donor[d][i] != wanted.donor[d][i]) continue; // a chord's end may belong to its neighbour
      ++same;
      for (int k = 0; k < 2; ++k) assert_near(found.place[d][i][k], wanted.place[d][i][k], 0.02);
    }
    assert_true(same >= 0.98 * (double)wanted.count[d]);
  }
  cw_interface_free(&wanted);
  cw_interface_free(&found);
  free_pair(&p);
}

static void any_surface_with_a_gap_is_told(void **state) {
  Pair p;
  make_pair(&p);
  for (int s = 0; s < 2; ++s) p.assembly.interface[2][s] = p.assembly.interface[0][s];
  for (int64_t i = 0; i < 350; ++i)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 2; ++k) p.assembly.interface[0][1][i].nodes[c][k] *= 1.1; // edges of 12 to 17 mm
  is_refused(&p, 2, NULL, "of its longest edge off patch 'stator_interface'; allowed: 0.25");
  free_pair(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_centre_lies_where_its_donor_says),
      cmocka_unit_test(a_radial_gap_is_told),
      cmocka_unit_test(different_ends_are_told),
      cmocka_unit_test(a_disc_finds_its_donors_in_its_plane),
      cmocka_unit_test(a_node_off_the_disc_is_told),
      cmocka_unit_test(discs_of_different_size_are_told),
      cmocka_unit_test(any_surface_has_the_donors_of_the_cylinder),
      cmocka_unit_test(any_surface_with_a_gap_is_told),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
