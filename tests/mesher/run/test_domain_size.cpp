// SPDX-License-Identifier: AGPL-3.0-or-later
// What a box and a hand-made wall come to: costs of seeds, cells asked by walls.
#include <cmath>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/policy.h"
#include "mesher/run/domain_size.h"
}

#include "planned_solid.h"

// A face costs its triangles, two of a rectangle, and its area in quarters of a base size squared.
static void seeds_cost_triangles_and_area(void **) {
  PlannedSolid box(BRepPrimAPI_MakeBox(40, 30, 20).Shape());
  CwDomain domain = {};
  domain.cad = box.cad;
  domain.background = box.background;
  domain.base_size = 5e-3;
  std::vector<double> cost(cw_size_seed_parts(box.cad));
  cw_domain_seed_costs(&domain, cost.data());
  double areas[3] = {}, sum = 0;
  for (int face = 0; face < 6; face++) {
    const double area = (cost[face] - 2) * 0.25 * 25e-6;
    sum += area;
    for (int k = 0; k < 3; k++) areas[k] += std::fabs(area - (k == 0 ? 1200e-6 : k == 1 ? 800e-6 : 600e-6)) < 1e-12;
  }
  for (double count : areas) assert_near(count, 2, 0);
  assert_near(sum, 5200e-6, 1e-12);
}

// Two pieces of wall, 4 cm2 with edges of 2 mm and 9 cm2 with edges of 3 mm at scale 1: at any scale s they are
// 200 / s^2 wanted triangles, more where edges are limited: area over that limit squared.
static void walls_ask_for_area_over_edges_squared(void **) {
  CwDomain domain = {};
  CwLayerSample sample[2] = {{4e-4 / 8e-9, 2e-3, 0}, {9e-4 / 27e-9, 3e-3, 1}};
  CwLayerTarget layers[2] = {};
  layers[0].growth = layers[1].growth = 1.2;
  layers[0].first_height = 1; // no limit
  layers[1].first_height = 1.5e-3 / (1.2 * cw_policy.prism_longest);
  domain.layer_sample = sample;
  domain.layer_sample_count = 2;
  domain.patch_layers = layers;
  for (double scale : {0.25, 0.5, 2.0}) {
    double wanted = 0, asked = 0;
    cw_domain_walls_ask(&domain, scale, &wanted, &asked);
    assert_near(wanted * scale * scale / 200, 1, 1e-12);
    const double limited = scale > 0.5 ? 9e-4 / 2.25e-6 : 100 / (scale * scale);
    assert_near(asked / (100 / (scale * scale) + limited), 1, 1e-12);
  }
}

int main() {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(seeds_cost_triangles_and_area),
      cmocka_unit_test(walls_ask_for_area_over_edges_squared),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
