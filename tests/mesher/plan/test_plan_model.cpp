// SPDX-License-Identifier: AGPL-3.0-or-later
// What the planner knows of a box with layers on its walls.
#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/plan/plan_model.h"
#include "mesher/policy.h"
}

#include "planned_solid.h"

// A box of 40 x 30 x 20 mm with layers of 1 mm.
struct Box : PlannedSolid {
  explicit Box(double thickness = 1e-3, decltype(CwPlanOptions::thickness) thickness_at = thickness_of)
      : PlannedSolid(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), thickness, thickness_at) {}
};

static const double layers = 1e-3, area = 2 * (40 * 30 + 40 * 20 + 30 * 20) * 1e-6, volume = 40e-3 * 30e-3 * 20e-3;

// Inside the layers, of (38 x 28 x 18) mm less, are no tetrahedra.
static void samples_stand_for_the_volume(void **) {
  Box box;
  double total = 0, outside = 0;
  for (int32_t i = 0; i < box.model.sample_count; i++) {
    const double *x = box.model.sample[i].x, h = cw_size_at(box.size, x);
    total += box.model.sample[i].volume;
    outside += box.model.sample[i].work * h * h * h;
  }
  assert_near(total / volume, 1, 0.03);
  // So many tetrahedra for each volume of h^3, whatever it is.
  const double middle[] = {0.02, 0.015, 0.01};
  double of_volume = 0;
  for (int32_t i = 0; i < box.model.sample_count; i++) {
    const double *x = box.model.sample[i].x, h = cw_size_at(box.size, x);
    if (std::fabs(x[0] - middle[0]) > 5e-3 || std::fabs(x[1] - middle[1]) > 5e-3 || std::fabs(x[2] - middle[2]) > 3e-3)
      continue;
    of_volume = box.model.sample[i].work * h * h * h / box.model.sample[i].volume;
  }
  assert_true(of_volume > 5 && of_volume < 12);
  assert_near(outside / of_volume, 38e-3 * 28e-3 * 18e-3, 0.1 * volume);
}

// At the top, 20 mm high, a fifth more than elsewhere.
static double thicker_at_the_top(const void *thickness, int32_t, const double x[3], const double normal[3]) {
  return thickness_of(thickness, 0, x, normal) * (1 + 10 * x[2] * normal[2]);
}

static void layers_are_as_thick_as_their_place_asks(void **) {
  Box box(layers, thicker_at_the_top);
  int top = 0;
  for (int32_t t = 0; t < box.background.triangle_count; t++) {
    int at_top = box.model.triangle[t].normal[2] > 0.5;
    top += at_top;
    assert_near(box.model.triangle[t].thickness, (at_top ? 1.2 : 1) * layers, 1e-9);
  }
  assert_true(top > 0);
  const double above[3] = {0.02, 0.015, 0.0195};
  assert_near(cw_plan_wall_near(&box.model, above, 1e-3, -1).thickness, 1.2 * layers, 1e-9);
}

static void walls_have_their_layers_and_prisms(void **) {
  Box box;
  const CwBackground &background = box.background;
  double all = 0;
  for (int32_t t = 0; t < background.triangle_count; t++) {
    const int32_t *corner = background.triangle[t];
    const double *a = background.x[corner[0]], *b = background.x[corner[1]], *c = background.x[corner[2]];
    double n[3], u[3], v[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
    for (int k = 0; k < 3; k++) n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    all += 0.5 * std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    assert_int_equal(box.model.wall[t], 1);
    assert_near(box.model.triangle[t].thickness, layers, 1e-12);
    double outward = 0;
    for (int k = 0; k < 3; k++)
      outward += box.model.triangle[t].normal[k] * (a[k] - (k == 0 ? 0.02 : k == 1 ? 0.015 : 0.01));
    assert_true(outward > 0);
  }
  assert_near(all, area, 1e-9);
  assert_near(box.model.thickest, layers, 1e-12);
  double work = 0, samples = 0;
  for (int32_t i = 0; i < box.whole.pieces.count; i++) work += box.whole.pieces.work[i];
  for (int32_t i = 0; i < box.model.sample_count; i++) samples += box.model.sample[i].work;
  assert_near(box.whole.work / (work + samples), 1, 1e-9);
}

// Layers of 9 mm have no room between the faces that are 20 mm apart; between the others they have.
static void layers_give_way_to_a_wall_opposite(void **) {
  Box box(9e-3);
  for (int32_t t = 0; t < box.background.triangle_count; t++) {
    const bool level = std::fabs(box.model.triangle[t].normal[2]) > 0.5;
    assert_near(box.model.triangle[t].thickness, level ? cw_policy.gap_share * 20e-3 : 9e-3, 1e-9);
  }
  assert_near(box.model.thickest, 9e-3, 1e-12);
  for (int32_t i = 0; i < box.model.edge_count; i++) {
    const double room = box.model.edge[i].room / cw_policy.plan_room;
    assert_true(room > cw_policy.gap_share * 20e-3 - 1e-9 && room < 9e-3 + 1e-9);
  }
}

static void the_nearest_wall_is_found(void **) {
  Box box;
  const double x[] = {0.0215, 0.003, 0.0112};
  CwPlanWall wall = cw_plan_wall_near(&box.model, x, 0.02, -1);
  assert_true(wall.triangle >= 0);
  assert_near(wall.distance, 0.003, 1e-9);
  assert_near(wall.thickness, layers, 1e-12);
  assert_near(box.model.triangle[wall.triangle].normal[1], -1, 1e-9);
  for (int32_t beside = 0; beside < box.model.wall_count; beside++) {
    CwPlanWall same = cw_plan_wall_near(&box.model, x, 0.02, beside);
    assert_int_equal(same.point, wall.point);
    assert_near(same.distance, wall.distance, 0);
  }
  // None so near.
  const double middle[] = {0.02, 0.015, 0.01};
  wall = cw_plan_wall_near(&box.model, middle, 0.005, wall.point);
  assert_int_equal(wall.triangle, -1);
  assert_true(std::isinf(wall.distance));
}

// What one half has the other lacks, in work and volume.
static void halves_make_the_whole(void **) {
  Box box;
  const CwPlane plane = {{1, 0, 0}, 0.013};
  CwPlanPart half[2];
  for (int side = 0; side < 2; side++) {
    check(cw_plan_part_clip(&box.model, &box.whole, &plane, side, &half[side]));
    for (int32_t i = 0; i < half[side].sample_count; i++) {
      assert_int_equal(box.model.sample[half[side].sample[i]].x[0] > 0.013, side);
    }
  }
  assert_near((half[0].work + half[1].work) / box.whole.work, 1, 1e-9);
  assert_near((half[0].volume + half[1].volume) / box.whole.volume, 1, 1e-9);
  assert_near(half[0].volume / box.whole.volume, 13.0 / 40, 0.05);
  for (CwPlanPart &part : half) cw_plan_part_free(&part);
}

// The twelve edges of the box are sharp, and each point on them knows the room of twice the layers.
static void edges_keep_planes_off(void **) {
  Box box;
  int32_t ends = 0;
  assert_true(box.model.edge_count >= 12 * 17);
  for (int32_t i = 0; i < box.model.edge_count; i++) {
    assert_near(box.model.edge[i].room, 2 * layers, 1e-12);
    ends += box.model.edge[i].end;
  }
  assert_int_equal(ends, 24);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(samples_stand_for_the_volume),
                              cmocka_unit_test(layers_are_as_thick_as_their_place_asks),
                              cmocka_unit_test(walls_have_their_layers_and_prisms),
                              cmocka_unit_test(layers_give_way_to_a_wall_opposite),
                              cmocka_unit_test(the_nearest_wall_is_found),
                              cmocka_unit_test(halves_make_the_whole),
                              cmocka_unit_test(edges_keep_planes_off)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
