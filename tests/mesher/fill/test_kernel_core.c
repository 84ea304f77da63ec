// SPDX-License-Identifier: AGPL-3.0-or-later
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fill_fault.h"
#include "mesher/common/quality.h"
#include "mesher/fill/fill_points.h"
#include "mesher/fill/kernel.h"
#include "mesher/fill/kernel_core.h"
#include "tests/unit_test.h"

typedef struct {
  Surface surface;
  double size;
  CwFillInput input;
  int32_t count;
  double (*x)[3];
  CwLatticeSite *site;
} Ball;

// With inner points of one size, and a row of them over all of its triangles where `row`.
static void make_ball(Ball *ball, int row) {
  memset(ball, 0, sizeof *ball);
  ball->size = 0.0035;
  surface_add_sphere(&ball->surface, (double[3]){0, 0, 0}, 0.05, 4, 1);
  ball->input = fill_input(&ball->surface, &ball->size);
  ball->input.offset_count = row ? ball->surface.triangle_count : 0;
  assert_int_equal(cw_fill_points(&ball->input, 1.0, &ball->count, &ball->x, &ball->site), CW_OK);
  ball->input.inner = (const double(*)[3])ball->x;
  ball->input.inner_count = ball->count;
}

static void free_ball(Ball *ball) {
  surface_free(&ball->surface);
  free(ball->x);
  free(ball->site);
}

static double volume6(const CwTetMesh *mesh, const int32_t c[4]) {
  return cw_tet_volume6(mesh->point[c[0]].x, mesh->point[c[1]].x, mesh->point[c[2]].x, mesh->point[c[3]].x);
}

// What is left of the Delaunay mesh has the core's faces open, and lacks the core's volume.
static void carved_mesh_and_core_fit(void **unused) {
  Ball ball;
  CwKernelCore core;
  CwTetMesh mesh;
  int32_t count, open = 0;
  double(*x)[3], whole = 0.0, left = 0.0, of_core = 0.0;
  make_ball(&ball, 0);
  assert_int_equal(
      cw_kernel_core_make(&ball.input, ball.count, (const double(*)[3])ball.x, ball.site, &core, &count, &x), CW_OK);
  assert_true(core.lattice.deep_count > ball.count / 8);
  assert_int_equal(count + core.lattice.deep_count, ball.surface.point_count + ball.count);
  assert_int_equal(cw_delaunay_make(count, (const double(*)[3])x, &mesh), CW_OK);
  for (int32_t t = 0; t < mesh.tet_count; t++)
    whole += mesh.tet[t].corner[0] < 0 ? 0.0 : volume6(&mesh, mesh.tet[t].corner);
  assert_int_equal(cw_kernel_core_carve(&core, &mesh), CW_OK);
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    const CwTet *tet = &mesh.tet[t];
    if (tet->corner[0] < 0) continue;
    left += volume6(&mesh, tet->corner);
    for (int i = 0; i < 4; i++) {
      open += tet->neighbour[i] < 0;
      assert_true(tet->neighbour[i] < 0 || mesh.tet[tet->neighbour[i] / 4].corner[0] >= 0);
    }
  }
  for (int32_t t = 0; t < core.lattice.tet_count; t++) {
    const double *c[4];
    for (int i = 0; i < 4; i++) {
      int32_t p = core.lattice.tet[t][i];
      c[i] = p < core.fixed_count ? x[p] : core.deep[p - core.fixed_count];
    }
    of_core += cw_tet_volume6(c[0], c[1], c[2], c[3]);
  }
  assert_int_equal(open, core.lattice.face_count + 4);
  assert_true(fabs((left + of_core) / whole - 1.0) < 1e-13);
  cw_tet_mesh_free(&mesh);
  cw_kernel_core_free(&core);
  free(x);
  free_ball(&ball);
}

// The fill is sound with the core and without it, of nearly as many tetrahedra, and the same volume and least angle.
static void fill_with_and_without(int row) {
  Ball ball;
  CwFill fill[2];
  double volume[2] = {0.0, 0.0}, least[2] = {180.0, 180.0};
  make_ball(&ball, row);
  for (int k = 0; k < 2; k++) {
    ball.input.inner_site = k ? ball.site : NULL;
    CwKernelOutcome outcome;
    assert_int_equal(cw_kernel_fill(&ball.input, &fill[k], &outcome), CW_OK);
    assert_int_equal(outcome, CW_KERNEL_FILLED);
    const char *fault = fill_fault(&ball.surface, &fill[k]);
    if (fault) fail_msg("%s", fault);
    for (int32_t t = 0; t < fill[k].tetrahedron_count; t++) {
      CwTetShape shape;
      const double *c[4];
      for (int i = 0; i < 4; i++) c[i] = fill[k].x[fill[k].tetrahedron[t][i]];
      cw_tet_shape(c, &shape);
      volume[k] += shape.volume;
      least[k] = fmin(least[k], shape.dihedral_least);
    }
  }
  assert_true(fabs(volume[1] / volume[0] - 1.0) < 1e-12);
  assert_true(abs(fill[1].tetrahedron_count - fill[0].tetrahedron_count) < fill[0].tetrahedron_count / 100);
  assert_true(fabs(least[1] - least[0]) < 3.0);
  cw_fill_free(&fill[0]);
  cw_fill_free(&fill[1]);
  free_ball(&ball);
}

static void fills_with_and_without(void **unused) {
  fill_with_and_without(0);
}

static void fills_with_and_without_under_a_row(void **unused) {
  fill_with_and_without(1);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(carved_mesh_and_core_fit),
      cmocka_unit_test(fills_with_and_without),
      cmocka_unit_test(fills_with_and_without_under_a_row),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
