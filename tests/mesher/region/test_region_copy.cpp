// SPDX-License-Identifier: AGPL-3.0-or-later
// A tank filled by the regions of one pitch and their turned copies.
extern "C" {
#include "mesher/network/orbit.h"
#include "mesher/region/audit.h"
#include "mesher/region/region_copy.h"
#include "mesher/region/region_number.h"
}

#include "shared_points.h"
#include "tank.h"

// All regions, the copies too, are audited; together they are as large as the tank; shared points agree to the last
// bit.
static void fill_the_tank(bool divided) {
  Tank tank(5, 1, divided);
  CwSkeleton &skeleton = tank.skeleton;
  const CwSkeletonOrbits &orbits = skeleton.orbits;
  const int faces = cw_cad_face_count(tank.cad);
  std::vector<void *> walls(faces, nullptr), caps(faces, nullptr), interfaces;
  int64_t size;
  check(cw_orbit_network(&skeleton.network, &skeleton.orbits, &tank.outcome));
  check(cw_skeleton_wall_curves(&skeleton));
  for (int f = 0; f < faces; f++) {
    if (orbits.symmetry->face.first[f] != f) continue;
    if (cw_face_is_wall(tank.cad, f)) check(cw_skeleton_mesh_wall(&skeleton, f, &walls[f], &size));
  }
  check(cw_skeleton_merge_walls(&skeleton, walls.data()));
  check(cw_surface_mesh_audit(&skeleton.surface, tank.plan.region_count));
  std::vector<double> target(skeleton.surface.vertex_count, 1.5e-3), first(skeleton.surface.vertex_count, 2e-4),
      growth(skeleton.surface.vertex_count, 1.5);
  check(cw_skeleton_grow(&skeleton, &tank.background, target.data(), nullptr, nullptr, &tank.outcome));
  check(cw_skeleton_free_curves(&skeleton, &tank.outcome));
  assert_int_equal(tank.outcome.kind, CW_OUTCOME_DONE);
  for (int f = 0; f < faces; f++) {
    if (orbits.symmetry->face.first[f] != f) continue;
    if (!cw_face_is_wall(tank.cad, f)) check(cw_skeleton_mesh_cap(&skeleton, f, &caps[f], &size));
  }
  assert_int_equal(skeleton.interfaces.outline_count, divided ? 30 : 10);
  interfaces.resize(skeleton.interfaces.outline_count, nullptr);
  for (int i = 0; i < skeleton.interfaces.outline_count; i++) {
    if (orbits.outline.first[i] == i) check(cw_skeleton_mesh_interface(&skeleton, i, &interfaces[i], &size));
  }
  check(cw_skeleton_merge_inner(&skeleton, caps.data(), interfaces.data()));
  check(cw_interfaces_audit(&skeleton.interfaces, tank.plan.region_count));
  for (int v = 0; v < skeleton.surface.vertex_count; v++) {
    const int next = cw_orbit_node(&orbits, v, 1);
    if (next < 0) continue;
    double turned[3];
    cw_symmetry_turn(5, 1, skeleton.layers.front[v], turned);
    for (int k = 0; k < 3; k++) assert_near(turned[k], skeleton.layers.front[next][k], 1e-15);
    assert_int_equal(cw_orbit_node(&orbits, v, 5), v);
  }

  const int regions = tank.plan.region_count;
  int pair_count, colours;
  std::vector<int> number(regions);
  int32_t(*pair)[2];
  check(cw_skeleton_adjacency(&skeleton, &pair_count, &pair));
  assert_int_equal(pair_count, divided ? 30 : 10);
  check(cw_region_numbers(regions, pair_count, pair, number.data(), nullptr, &colours));
  CwRegionContext context = {};
  context.skeleton = &skeleton;
  context.domain = "tank";
  context.layer_count = 4;
  context.growth = growth.data();
  context.first_height = first.data();
  check(cw_region_context_make(&context));
  double volume = 0;
  SharedPoints shared;
  CwRegionMesh first_mesh[2], mesh;
  const int each = (regions - 1) / 5; // regions of a wedge
  for (int r = 0; r < each; r++) check(cw_region_build(&context, 1 + r, number[1 + r], &first_mesh[r]));
  for (int r = 0; r < regions; r++) {
    CwQuality quality;
    if (r <= each) {
      check(cw_region_build(&context, r, number[r], &mesh));
    } else {
      char fingerprint[33];
      const CwRegionMesh &source = first_mesh[(r - 1) % each];
      cw_region_copy_fingerprint(&context, &source, (r - 1) / each, fingerprint);
      check(cw_region_copy(&context, &source, (r - 1) / each, number[r], fingerprint, &mesh));
      assert_string_equal(mesh.fingerprint, fingerprint);
      assert_string_not_equal(mesh.fingerprint, source.fingerprint);
    }
    assert_int_equal(mesh.region, r + 1);
    check(cw_audit_region(&mesh, &quality));
    volume += quality.volume;
    for (int i = 0; i < mesh.point_count; i++) { // every point lies in its own region
      assert_true(cw_plan_in_region(&tank.plan, r, mesh.x[i], 1e-9));
    }
    shared.add(mesh);
    cw_region_free(&mesh);
  }
  for (int r = 0; r < each; r++) cw_region_free(&first_mesh[r]);
  assert_near(volume / solid_volume(tank.cad), 1, 1e-12);
  shared.check(context.shared_count);

  cw_region_context_free(&context);
  free(pair);
  for (void *bytes : walls) free(bytes);
  for (void *bytes : caps) free(bytes);
  for (void *bytes : interfaces) free(bytes);
}

static void copies_fill_the_tank(void **) {
  fill_the_tank(false);
  fill_the_tank(true);
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(copies_fill_the_tank),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
