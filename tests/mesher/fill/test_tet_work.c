// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/tet_work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "joined_mesh.h"
#include "mesher/fill/fill_mesh.h"
#include "tests/unit_test.h"
#include "two_tets.h"

enum { E = CW_ENCLOSING_POINTS };

static CwTetMesh two_mesh(void) {
  double(*x)[3] = malloc(sizeof two_x);
  int32_t(*tet)[4] = malloc(sizeof two_tets);
  CwFill fill = {.point_count = 5, .x = x, .tetrahedron_count = 2, .tetrahedron = tet};
  CwTetMesh mesh;
  memcpy(x, two_x, sizeof two_x);
  memcpy(tet, two_tets, sizeof two_tets);
  assert_int_equal(cw_fill_to_mesh(&fill, &mesh), CW_OK);
  cw_fill_free(&fill);
  return mesh;
}

static void lists_keep_all(void **state) {
  CwTetList list = {0};
  for (int32_t k = 0; k < 10000; k++) assert_int_equal(cw_tet_list_push(&list, 7 * k), CW_OK);
  assert_int_equal(list.count, 10000);
  for (int32_t k = 0; k < 10000; k++) assert_int_equal(list.tet[k], 7 * k);
  free(list.tet);
}

// However often it is found, a tetrahedron is listed once a pass, and again in the next.
static void a_pass_lists_each_once(void **state) {
  CwTetMesh mesh = two_mesh();
  CwTetWork w = {.mesh = &mesh, .pass = 1};
  for (int32_t t = 0; t < 2; t++) mesh.tet[t].pass = CW_TET_NO_PASS;
  for (int k = 0; k < 3; k++)
    for (int32_t t = 0; t < 2; t++) assert_int_equal(cw_tet_push(&w, t), CW_OK);
  assert_int_equal(w.next.count, 2);
  assert_int_equal(w.next.tet[0], 0);
  assert_int_equal(w.next.tet[1], 1);
  w.pass = 2;
  assert_int_equal(cw_tet_push(&w, 1), CW_OK);
  assert_int_equal(cw_tet_push(&w, 1), CW_OK);
  assert_int_equal(w.next.count, 3);
  assert_int_equal(w.next.tet[2], 1);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
}

// Below the limit it is listed, at it no more; its points are marked with the pass, and for two passes it has changed.
static void a_quality_is_kept_in_mind(void **state) {
  CwTetMesh mesh = two_mesh();
  CwTetList changed = {0};
  CwTetWork w = {.mesh = &mesh, .pass = 5, .limit = 0.4, .changed = &changed};
  for (int32_t t = 0; t < 2; t++) mesh.tet[t].pass = CW_TET_NO_PASS;
  assert_int_equal(cw_tet_set_quality(&w, 0, 0.4), CW_OK);
  assert_int_equal(w.next.count, 0);
  assert_int_equal(cw_tet_set_quality(&w, 0, 0.39), CW_OK);
  assert_int_equal(w.next.count, 1);
  assert_near(mesh.tet[0].quality, 0.39, 0);
  assert_int_equal(changed.count, 2);
  assert_int_equal(changed.tet[1], 0);
  for (int p = 0; p < 5; p++) assert_int_equal(mesh.point[E + p].mark, p < 4 ? 5 : 0);
  assert_true(cw_tet_has_changed(&w, 0) && cw_tet_has_changed(&w, 1)); // it has points of the first
  w.pass = 6;
  assert_true(cw_tet_has_changed(&w, 0));
  w.pass = 7;
  assert_false(cw_tet_has_changed(&w, 0));
  free(changed.tet);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
}

static double least_of(const CwTetWork *w) {
  double least = INFINITY;
  for (int32_t t = 0; t < w->mesh->tet_count; t++) {
    const int32_t *c = w->mesh->tet[t].corner;
    if (c[0] >= 0) least = fmin(least, cw_tet_quality_of(w, c[0], c[1], c[2], c[3]));
  }
  return least;
}

// Two tetrahedra become three round the line of their apexes and two again: exactly where all three are as good as is
// asked, and positive.
static void only_sound_ones_come(void **state) {
  static const int32_t three[3][4] = {
      {E + 0, E + 1, E + 4, E + 3}, {E + 1, E + 2, E + 4, E + 3}, {E + 2, E + 0, E + 4, E + 3}};
  const int32_t old[2] = {0, 1};
  CwTetMesh mesh = two_mesh();
  CwTetWork w = {.mesh = &mesh, .pass = 1};
  int32_t replaced = 0, slots[3], count = 0, inside[3][4];
  double least = INFINITY;
  for (int k = 0; k < 3; k++)
    least = fmin(least, cw_tet_quality_of(&w, three[k][0], three[k][1], three[k][2], three[k][3]));
  assert_true(least > 0);
  const double six = joined_volume6(&mesh);
  assert_int_equal(cw_tet_replace_sound(&w, 2, old, 3, three, nextafter(least, 1), &replaced), CW_OK);
  assert_int_equal(replaced, 0);
  assert_int_equal(mesh.tet[0].corner[3], E + 3); // as they were
  memcpy(inside, three, sizeof inside);
  inside[1][0] = three[1][1], inside[1][1] = three[1][0]; // one of them turned inside out
  assert_int_equal(cw_tet_replace_sound(&w, 2, old, 3, (const int32_t(*)[4])inside, -2, &replaced), CW_OK);
  assert_int_equal(replaced, 0);
  assert_int_equal(cw_tet_replace_sound(&w, 2, old, 3, three, least, &replaced), CW_OK);
  assert_int_equal(replaced, 1);
  assert_near(joined_volume6(&mesh) / six, 1, 1e-14);
  assert_near(least_of(&w), least, 0);
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    const int32_t *c = mesh.tet[t].corner;
    if (c[0] < 0) continue;
    assert_near(mesh.tet[t].quality, cw_tet_quality_of(&w, c[0], c[1], c[2], c[3]), 0);
    slots[count++] = t;
  }
  assert_int_equal(count, 3);
  const int32_t two[2][4] = {{E + 0, E + 1, E + 2, E + 3}, {E + 0, E + 2, E + 1, E + 4}};
  const double made_up[2] = {0.25, 0.75};
  assert_int_equal(cw_tet_replace(&w, 3, slots, 2, two, made_up), CW_OK);
  count = 0;
  for (int32_t t = 0; t < mesh.tet_count; t++) {
    if (mesh.tet[t].corner[0] < 0) continue;
    count++;
    assert_near(mesh.tet[t].quality, cw_tet_corner_of(&mesh.tet[t], E + 3) >= 0 ? 0.25 : 0.75, 0); // as given
  }
  assert_int_equal(count, 2);
  assert_near(joined_volume6(&mesh) / six, 1, 1e-14);
  cw_tet_work_free(&w);
  cw_tet_mesh_free(&mesh);
}

// From 3 to 4 two units straight down; from 1 to 2 the diagonal of a square.
static void squares_of_edges_by_hand(void **state) {
  CwTetMesh mesh = two_mesh();
  CwTetWork w = {.mesh = &mesh};
  assert_near(cw_tet_square_of(&w, E + 3, E + 4), 4, 1e-15);
  assert_near(cw_tet_square_of(&w, E + 1, E + 2), 2, 1e-15);
  assert_near(cw_tet_square_of(&w, E + 0, E + 3), 1.08, 1e-15);
  cw_tet_mesh_free(&mesh);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(lists_keep_all),
      cmocka_unit_test(a_pass_lists_each_once),
      cmocka_unit_test(a_quality_is_kept_in_mind),
      cmocka_unit_test(only_sound_ones_come),
      cmocka_unit_test(squares_of_edges_by_hand),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
