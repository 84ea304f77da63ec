// SPDX-License-Identifier: AGPL-3.0-or-later
// Interfaces and open patches of two domains side by side, boxes or a tank of equal sectors, against those that are
// made one by one; and what becomes of layers that leave no room for them.
#include <cstring>
#include <numeric>
#include <set>
#include <vector>

extern "C" {
#include "mesher/region/interface_rule.h"
#include "mesher/region/region_number.h"
#include "mesher/run/run_interfaces.h"
}

#include "divided_box.h"
#include "run_domains.h"
#include "tank_surfaces.h"

enum { LAYERS = 4 };

// A run that frees what it makes of domains with layers.
struct Interfaces {
  DomainRun made;
  CwThinPlaces places = {};
  CwOutcome outcome = {};

  template <class Solid> void add(Solid &solid, const char *name) {
    made.add(name, solid.cad, solid.background, solid.plan, solid.boundary);
    CwDomain &domain = made.domain(made.run->model.domain_count - 1);
    domain.layer_count = LAYERS;
    domain.symmetry = const_cast<CwSymmetry *>(domain.images.symmetry);
  }
  ~Interfaces() {
    cw_thin_places_free(&places);
    for (int d = 0; d < made.run->model.domain_count; d++) {
      CwDomain &domain = made.domain(d);
      cw_shared_nodes_free(&domain.shared);
      cw_interfaces_free(&domain.interfaces);
      cw_free_curves_free(&domain.free_curves);
      free(domain.number);
      free(domain.pair);
    }
  }
  void make() {
    check(cw_run_interfaces(made.run.get(), &places, &outcome));
  }
};

static void expect_triangles(const CwInterfaceTriangles &made, const CwInterfaceTriangles &wanted) {
  assert_int_equal(made.count, wanted.count);
  assert_int_equal(made.triangle == nullptr, wanted.triangle == nullptr);
  if (!wanted.triangle) return;
  assert_memory_equal(made.triangle, wanted.triangle, (size_t)wanted.count * sizeof *wanted.triangle);
  assert_memory_equal(made.region, wanted.region, (size_t)wanted.count * sizeof *wanted.region);
}

static void expect_interfaces(const CwInterfaces &made, const CwInterfaces &wanted) {
  const CwOpenPatches &open = wanted.open_patch;
  assert_int_equal(made.nodes.count, wanted.nodes.count);
  assert_memory_equal(made.nodes.x, wanted.nodes.x, (size_t)wanted.nodes.count * sizeof *wanted.nodes.x);
  assert_memory_equal(made.nodes.on_plane, wanted.nodes.on_plane, (size_t)wanted.nodes.count);
  assert_int_equal(made.outline_count, wanted.outline_count);
  for (int i = 0; i < wanted.outline_count; i++) {
    assert_int_equal(made.outline[i].node, wanted.outline[i].node);
    assert_int_equal(made.outline[i].triangle_start, wanted.outline[i].triangle_start);
    assert_int_equal(made.outline[i].refined_count, wanted.outline[i].refined_count);
  }
  assert_int_equal(made.open_patch.count, open.count);
  assert_memory_equal(made.open_patch.triangle, open.triangle, (size_t)open.count * sizeof *open.triangle);
  assert_memory_equal(made.open_patch.face, open.face, (size_t)open.count * sizeof *open.face);
  assert_memory_equal(made.open_patch.region, open.region, (size_t)open.count * sizeof *open.region);
  expect_triangles(made.refined, wanted.refined);
  expect_triangles(made.planned, wanted.planned);
}

// Numbers from 1 on, each once, and no two regions of one colour side by side: with n colours, a chain of n.
static void check_numbers(const CwDomain &domain) {
  const int regions = domain.plan.region_count;
  std::set<int> numbers(domain.number, domain.number + regions);
  assert_int_equal(numbers.size(), regions);
  assert_int_equal(*numbers.begin(), 1);
  assert_int_equal(*numbers.rbegin(), regions);
  std::vector<int> wanted(regions);
  int colours;
  check(cw_region_numbers(regions, domain.pair_count, domain.pair, wanted.data(), nullptr, &colours));
  assert_memory_equal(domain.number, wanted.data(), (size_t)regions * sizeof wanted[0]);
  assert_int_equal(domain.colours, colours);
}

// Every region refines what it may: those that may not give nothing.
template <class Solid> static void refine(Solid &solid, const CwDomain &domain, CwInterfaceRuleCounts *counts) {
  DomainSurfaces &boundary = solid.boundary;
  const CwRegionInput from = boundary.regions();
  std::vector<void *> refined(solid.plan.region_count, nullptr);
  int64_t size;
  for (int i = 0; i < boundary.interfaces.outline_count; i++) {
    const int region = cw_interface_refiner(&from, domain.number, i);
    if (region >= 0 && !refined[region])
      check(cw_interface_rule(&from, domain.number, region, domain.name, &refined[region], &size));
  }
  check(
      cw_interface_rule_merge(&boundary.images, &boundary.interfaces, solid.plan.region_count, refined.data(), counts));
  for (void *bytes : refined) free(bytes);
}

// Interfaces, and then with the rule of region numbers at a size for which they are too coarse: `half`.
template <class Solid> static void check_domain(Solid &wanted, CwDomain &domain) {
  check(cw_interfaces_audit(&domain.interfaces, wanted.plan.region_count));
  expect_interfaces(domain.interfaces, wanted.boundary.interfaces);
  assert_null(domain.free_curves.nodes.x); // taken over
  check_numbers(domain);
}

template <class Solid> static void check_rule(Solid &wanted, const CwDomain &domain, CwSizeAt half, int copies) {
  CwInterfaceRuleCounts counts = {};
  CwSharedNodes shared;
  const int planned = wanted.boundary.interfaces.refined.count;
  wanted.boundary.input.size_at = half;
  refine(wanted, domain, &counts);
  check(cw_interfaces_audit(&domain.interfaces, wanted.plan.region_count));
  expect_interfaces(domain.interfaces, wanted.boundary.interfaces);
  assert_memory_equal(&domain.rule, &counts, sizeof counts);
  assert_int_equal(counts.planned, planned);
  assert_true(counts.inserted > 0);
  assert_int_equal(counts.inserted % copies, 0);
  assert_int_equal(domain.interfaces.refined.count, planned + 2 * counts.inserted); // Euler: outlines stay
  const CwRegionInput from = wanted.boundary.regions();
  check(cw_shared_nodes_make(&from, LAYERS, &shared));
  assert_int_equal(domain.shared.count, shared.count);
  assert_int_equal(domain.shared.node_count, shared.node_count);
  assert_memory_equal(domain.shared.base, shared.base, (size_t)shared.node_count * sizeof *shared.base);
  cw_shared_nodes_free(&shared);
}

static double half_of_box(const void *context, const double x[3]) {
  return even_size(context, x) / 2;
}

static void boxes_are_divided(void **) {
  Box first(3), second(1), wanted_first(3), wanted_second(1);
  Interfaces interfaces;
  make_layers(first);
  make_layers(second);
  make_surfaces(wanted_first);
  make_surfaces(wanted_second);
  interfaces.add(first, "first");
  interfaces.add(second, "second");
  interfaces.make();
  assert_int_equal(interfaces.outcome.kind, CW_OUTCOME_DONE);
  assert_int_equal(interfaces.places.count, 0);
  check_domain(wanted_first, interfaces.made.domain(0));
  check_domain(wanted_second, interfaces.made.domain(1));
  for (int d = 0; d < 2; d++) interfaces.made.domain(d).input.size_at = half_of_box;
  check(cw_run_region_rule(interfaces.made.run.get()));
  check_rule(wanted_first, interfaces.made.domain(0), half_of_box, 1);
  check_rule(wanted_second, interfaces.made.domain(1), half_of_box, 1);
}

// Of its three sectors the interfaces of one are made, and refined, and those of the others copied.
static void equal_sectors_are_divided_alike(void **) {
  Tank tank(3, 1), wanted(3, 1);
  Interfaces interfaces;
  make_layers(tank);
  make_surfaces(wanted, false);
  interfaces.add(tank, "tank");
  interfaces.make();
  assert_int_equal(interfaces.outcome.kind, CW_OUTCOME_DONE);
  check_domain(wanted, interfaces.made.domain(0));
  interfaces.made.domain(0).input.size_at = half_size;
  check(cw_run_region_rule(interfaces.made.run.get()));
  check_rule(wanted, interfaces.made.domain(0), half_size, 3);
}

// Layers 1.5 mm high over a line of two planes 1 mm above the wall: places on the planes of all such domains, in their
// order, and of no other.
static void layers_without_room_are_told(void **) {
  Box low(3, 0.001), high(1), also_low(3, 0.001), also_high(1);
  for (Box *box : {&low, &high, &also_low, &also_high}) make_layers(*box);
  check(cw_free_curves_make(&low.boundary.input, &low.boundary.wall_curves, &low.boundary.surface, &low.boundary.layers,
                            &low.boundary.free_curves, &low.outcome));
  const int each = low.boundary.free_curves.tight_count;
  assert_true(each > 0);
  Interfaces interfaces;
  interfaces.add(low, "low");
  interfaces.add(high, "high");
  interfaces.add(also_low, "also_low");
  interfaces.add(also_high, "also_high");
  interfaces.make();
  assert_int_equal(interfaces.outcome.kind, CW_OUTCOME_THIN);
  assert_int_equal(interfaces.places.count, 2 * each);
  for (int i = 0; i < 2 * each; i++) {
    const CwThinPlace &place = interfaces.places.place[i];
    assert_int_equal(place.domain, i < each ? 0 : 2);
    assert_int_equal(place.region, -1);
    assert_memory_equal(place.failure.at, low.boundary.free_curves.tight[i % each], sizeof place.failure.at);
    assert_string_equal(place.failure.message, low.outcome.reason);
  }
  for (int d = 0; d < 4; d++) {
    assert_int_equal(interfaces.made.domain(d).interfaces.outline_count, 0);
    assert_null(interfaces.made.domain(d).number);
  }
}

// A box that is said to come to itself when it is turned: all it has is fixed, but its interface, of which no turn
// finds the image. Where that is found the run does not look for thinner layers.
static void a_broken_symmetry_comes_before_thin_layers(void **) {
  for (int broken = 0; broken < 2; broken++) {
    Box low(3, 0.001), same(1);
    make_layers(low);
    make_layers(same);
    std::vector<int32_t> self(1000), turns(1000, 0);
    std::iota(self.begin(), self.end(), 0);
    const CwImages fixed = {self.data(), self.data(), turns.data()};
    CwSymmetry symmetry = {2, fixed, fixed, fixed};
    Interfaces interfaces;
    for (int d = 0; d < 2; d++) {
      if (d == broken)
        interfaces.add(same, "same");
      else
        interfaces.add(low, "low");
    }
    CwDomain &domain = interfaces.made.domain(broken);
    domain.images = {&symmetry, fixed, fixed};
    interfaces.make();
    assert_int_equal(interfaces.outcome.kind, CW_OUTCOME_ASYMMETRIC);
    assert_int_equal(interfaces.outcome.domain, broken);
    assert_non_null(strstr(interfaces.outcome.reason, "has no periodic image"));
  }
}

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(boxes_are_divided),
      cmocka_unit_test(equal_sectors_are_divided_alike),
      cmocka_unit_test(layers_without_room_are_told),
      cmocka_unit_test(a_broken_symmetry_comes_before_thin_layers),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
