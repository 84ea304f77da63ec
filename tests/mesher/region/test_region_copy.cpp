// SPDX-License-Identifier: AGPL-3.0-or-later
// A tank filled by the regions of one pitch and their periodic images, with the rule of region numbers (interface_rule)
// and without.
extern "C" {
#include "mesher/region/audit.h"
#include "mesher/region/interface_rule.h"
#include "mesher/region/region_copy.h"
#include "mesher/region/region_number.h"
}

#include "shared_points.h"
#include "tank_surfaces.h"

// The rule of region numbers on the interfaces of the first regions: turns take what it makes to what the others have.
static void refine(Tank &tank, const int32_t *number) {
  DomainSurfaces &boundary = tank.boundary;
  CwInterfaces &interfaces = boundary.interfaces;
  const CwRegionInput from = boundary.regions();
  const int regions = tank.plan.region_count, nodes = interfaces.nodes.count;
  std::vector<void *> refined(regions, nullptr);
  CwInterfaceRuleCounts counts;
  int64_t size;
  boundary.input.size_at = half_size;
  for (int i = 0; i < interfaces.outline_count; i++) {
    const int next = interfaces.outline_images.next[i];
    const int owner = cw_interface_owner(&from, number, i);
    assert_int_equal(cw_image_region(&boundary.images, &tank.plan, owner, 1), cw_interface_owner(&from, number, next));
  }
  for (int r = 0; r < regions; r++) {
    if (cw_image_region_first(&boundary.images, &tank.plan, r) != r) continue;
    check(cw_interface_rule(&from, number, r, "tank", &refined[r], &size));
  }
  check(cw_interface_rule_merge(&boundary.images, &interfaces, regions, refined.data(), &counts));
  check(cw_interfaces_audit(&interfaces, regions));
  assert_true(counts.inserted > 20);
  assert_int_equal(counts.inserted % 5, 0);
  assert_int_equal(interfaces.nodes.count, nodes + counts.inserted);
  assert_int_equal(counts.refined, counts.planned + 2 * counts.inserted); // Euler: outlines stay as they are
  for (int v = nodes; v < interfaces.nodes.count; v++) {
    double turned[3];
    cw_symmetry_turn(5, 1, interfaces.nodes.x[v], turned);
    const int next = cw_image_node(&interfaces.images, v, 1);
    for (int k = 0; k < 3; k++) assert_near(turned[k], interfaces.nodes.x[next][k], 1e-15);
    assert_int_equal(cw_image_node(&interfaces.images, v, 5), v);
  }
  for (void *bytes : refined) free(bytes);
}

// A region of the same surfaces whose faces belong to other patches is another one: its file names them by number.
static void check_patches(Tank &tank, const CwRegionContext &context) {
  char before[33], after[33];
  CwCad *other = open_tank(5, true);
  cw_region_fingerprint(&context, 0, before);
  tank.boundary.input.cad = other;
  cw_region_fingerprint(&context, 0, after);
  tank.boundary.input.cad = tank.cad;
  assert_string_not_equal(before, after);
  cw_region_fingerprint(&context, 0, after);
  assert_string_equal(before, after);
  cw_cad_close(&other);
}

// All regions, the copies too, are audited; together they are as large as the tank; shared points agree to the last
// bit.
static void fill_the_tank(bool divided, bool rule) {
  Tank tank(5, 1, divided);
  make_surfaces(tank, divided);
  DomainSurfaces &boundary = tank.boundary;
  std::vector<double> first(boundary.surface.vertex_count, 2e-4), growth(boundary.surface.vertex_count, 1.5);
  const int regions = tank.plan.region_count;
  int pair_count, colours;
  std::vector<int> number(regions);
  int32_t(*pair)[2];
  check(cw_interfaces_adjacency(&boundary.interfaces, regions, &pair_count, &pair));
  assert_int_equal(pair_count, divided ? 30 : 10);
  check(cw_region_numbers(regions, pair_count, pair, number.data(), nullptr, &colours));
  if (rule) refine(tank, number.data());
  CwRegionContext context = {};
  context.from = boundary.regions();
  context.domain = "tank";
  context.layer_count = 4;
  context.growth = growth.data();
  context.first_height = first.data();
  CwSharedNodes shared_nodes;
  check(cw_shared_nodes_make(&context.from, context.layer_count, &shared_nodes));
  context.shared = &shared_nodes;
  check(cw_open_edge_places_make(&context.from, &context.open_edge_places));
  check_patches(tank, context);
  double volume = 0;
  SharedPoints shared;
  CwRegionMesh mesh;
  const int each = (regions - 1) / 5; // regions of a wedge
  for (int r = 0; r < regions; r++) {
    CwQuality quality;
    CwOutcome outcome = {};
    if (r <= each) {
      check(cw_region_build(&context, r, number[r], &mesh, &outcome));
    } else {
      char fingerprint[33];
      const int source = 1 + (r - 1) % each;
      check(cw_region_build(&context, source, number[source], &mesh, &outcome));
      cw_region_copy_fingerprint(&context, &mesh, (r - 1) / each, fingerprint);
      assert_string_not_equal(mesh.fingerprint, fingerprint);
      check(cw_region_turn(&context, (r - 1) / each, number[r], fingerprint, &mesh));
      assert_string_equal(mesh.fingerprint, fingerprint);
    }
    assert_int_equal(outcome.kind, CW_OUTCOME_DONE);
    assert_int_equal(mesh.region, r + 1);
    check(cw_audit_region(&mesh, &quality, &outcome));
    volume += quality.volume;
    for (int i = 0; i < mesh.cells.point_count; i++) { // every point lies in its own region
      assert_true(cw_plan_in_region(&tank.plan, r, mesh.cells.points[i], 1e-9));
    }
    shared.add(mesh);
    cw_region_free(&mesh);
  }
  assert_near(volume / solid_volume(tank.cad), 1, 1e-12);
  shared.check(shared_nodes.count);

  cw_open_edge_places_free(&context.open_edge_places);
  cw_shared_nodes_free(&shared_nodes);
  free(pair);
}

static void copies_fill_the_tank(void **) {
  for (bool divided : {false, true}) {
    for (bool rule : {false, true}) fill_the_tank(divided, rule);
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(copies_fill_the_tank),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
