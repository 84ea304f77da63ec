// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <cstring>

#include <BRepPrimAPI_MakeBox.hxx>

extern "C" {
#include "mesher/layers/thin_prism.h"
#include "mesher/policy.h"
#include "mesher/run/layer_coverage.h"
}

#include "solids.h"

// Two equilateral triangles that share an edge, and one far from them, on faces of a box; columns straight up.
enum { VERTICES = 7, TRIANGLES = 3, LAYERS = 3 };
static const double FIRST = 1, GROWTH = 1.2, FULL = FIRST * (1 + GROWTH + GROWTH * GROWTH), EDGE = 20;

// 18 fields: the arrays of surface, targets and layers that the coverage is counted from, and the domain of them.
struct Wall {
  CwCad *cad;
  double x[VERTICES][3], top[VERTICES][3], thickness[VERTICES], first[VERTICES];
  double wanted[VERTICES], growth[VERTICES], target[VERTICES];
  uint8_t reason[VERTICES];
  int32_t triangle[TRIANGLES][3], face[TRIANGLES], start[3], in_region[TRIANGLES];
  CwDomain domain;

  Wall()
      : cad(open_solid(
            BRepPrimAPI_MakeBox(1, 2, 3).Shape(),
            [made = 0](const TopoDS_Face &) mutable { return std::string(made++ ? "rest,wall" : "floor,wall"); })),
        triangle{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}}, face{0, 0, 1}, start{0, 2, 3}, in_region{0, 2, 1}, domain() {
    const double h = std::sqrt(0.75);
    const double place[VERTICES][2] = {{0, 0}, {1, 0}, {0.5, h}, {1.5, h}, {5, 0}, {6, 0}, {5.5, h}};
    for (int v = 0; v < VERTICES; v++) {
      for (int k = 0; k < 3; k++) x[v][k] = k < 2 ? EDGE * place[v][k] : 0;
      wanted[v] = first[v] = FIRST;
      growth[v] = GROWTH;
      target[v] = FULL;
      set(v, FULL, CW_LAYER_FULL);
    }
    domain.cad = cad;
    domain.surface.x = x;
    domain.surface.vertex_count = VERTICES;
    domain.surface.triangle = domain.layers.triangle = triangle;
    domain.surface.triangle_count = domain.layers.triangle_count = TRIANGLES;
    domain.surface.face = face;
    domain.surface.region_start = start;
    domain.surface.region_triangle = in_region;
    domain.layers.column_count = VERTICES;
    domain.layers.top = top;
    domain.layers.thickness = thickness;
    domain.layers.first_height = first;
    domain.layers.reason = reason;
    domain.targets.layer_count = LAYERS;
    domain.targets.vertex_count = VERTICES;
    domain.targets.first_height = wanted;
    domain.targets.growth = growth;
    domain.targets.target = target;
  }
  ~Wall() {
    cw_cad_close(&cad);
  }
  void set(int v, double height, CwLayerReason why) {
    thickness[v] = height;
    reason[v] = (uint8_t)why;
    for (int k = 0; k < 3; k++) top[v][k] = x[v][k] + (k == 2 ? height : 0);
  }
  CwLayerCoverage of(int region, int patch) const {
    CwLayerCoverage coverage[2] = {};
    cw_domain_coverage(&domain, region, coverage);
    return coverage[patch];
  }
};

static void full_layers(void **) {
  Wall wall;
  const CwLayerCoverage floor = wall.of(0, 0), rest = wall.of(0, 1), other = wall.of(1, 0);
  assert_int_equal(floor.faces, 1);
  assert_int_equal(rest.faces, 1);
  assert_int_equal(other.faces, 1);
  assert_int_equal(wall.of(1, 1).faces, 0);
  assert_int_equal(floor.full, 1);
  assert_int_equal(floor.first_met, 1);
  assert_int_equal(floor.reason[CW_LAYER_FULL], 1);
  assert_near(floor.thickness, FULL, 1e-12);
  assert_near(floor.least, FULL, 0);
  assert_int_equal(floor.thin, 0);
}

// A column as short as the layers with their growth turned over still has its first height.
static void short_columns_keep_their_first_height(void **) {
  Wall wall;
  const double lower = 1 / GROWTH;
  wall.set(3, FIRST * (1 + lower + lower * lower), CW_LAYER_GAP);
  assert_true(cw_domain_first_is_met(&wall.domain, 3));
  const CwLayerCoverage floor = wall.of(1, 0);
  assert_int_equal(floor.faces, 1);
  assert_int_equal(floor.full, 0);
  assert_int_equal(floor.first_met, 1);
  assert_int_equal(floor.reason[CW_LAYER_GAP], 1);
  assert_int_equal(floor.missed[CW_LAYER_GAP], 0);
  assert_near(floor.thickness, (2 * FULL + wall.thickness[3]) / 3, 1e-12);
  assert_near(floor.least, wall.thickness[3], 0);
  wall.set(3, 0.98 * FULL, CW_LAYER_GRADATION);
  assert_int_equal(wall.of(1, 0).full, 0);
  wall.set(3, 0.995 * FULL, CW_LAYER_GRADATION);
  assert_int_equal(wall.of(1, 0).full, 1);
}

// A first height may be off by a tenth, up or down; and where a column is far too short for it, it is.
static void first_heights_that_are_missed(void **) {
  Wall wall;
  const double of[] = {0.89, 0.91, 1.09, 1.11};
  wall.growth[3] = 2; // else the first height follows the column
  for (int i = 0; i < 4; i++) {
    wall.first[3] = of[i] * FIRST;
    assert_int_equal(cw_domain_first_is_met(&wall.domain, 3), i == 1 || i == 2);
  }
  wall.first[3] = FIRST;
  wall.growth[3] = GROWTH;
  wall.set(3, 0.3 * FIRST, CW_LAYER_REPAIR);
  wall.set(2, 0.3 * FIRST, CW_LAYER_GRADATION);
  assert_false(cw_domain_first_is_met(&wall.domain, 3));
  CwLayerCoverage floor = wall.of(1, 0);
  assert_int_equal(floor.first_met, 0);
  assert_int_equal(floor.missed[CW_LAYER_REPAIR], 1); // the last in the order of reasons
  assert_int_equal(floor.reason[CW_LAYER_REPAIR], 1);
  wall.set(2, 0.3 * FIRST, CW_LAYER_SHARPNESS); // but beside a sharp edge it is that
  floor = wall.of(1, 0);
  assert_int_equal(floor.missed[CW_LAYER_SHARPNESS], 1);
  assert_int_equal(floor.missed[CW_LAYER_REPAIR], 0);
  assert_int_equal(floor.reason[CW_LAYER_REPAIR], 1);
}

// Right prisms on equilateral triangles, some hundred times as long as they are high.
static void thin_prisms_are_counted(void **) {
  Wall wall;
  for (int v = 4; v < VERTICES; v++) {
    for (int k = 0; k < 2; k++) wall.x[v][k] *= 10;
    wall.set(v, FULL, CW_LAYER_FULL);
  }
  const CwLayerCoverage rest = wall.of(0, 1);
  double base[3][3], top[3][3];
  for (int k = 0; k < 3; k++) {
    std::memcpy(base[k], wall.x[4 + k], sizeof base[k]);
    std::memcpy(top[k], base[k], sizeof top[k]);
    top[k][2] = FIRST;
  }
  const double lowest = cw_prism_determinant(base, top, 1);
  assert_true(lowest < CW_SMALL_DETERMINANT);
  assert_int_equal(rest.thin, LAYERS);
  assert_true(rest.thin_wanted >= cw_thin_prism_wanted(lowest) * (1 - 1e-9));
  assert_memory_equal(rest.thin_at, wall.x[4], sizeof rest.thin_at);
  assert_int_equal(wall.of(0, 0).thin, 0);
}

// Columns over an edge of half the angle a are 1 / sin(a / 2) times as long, up to what they may lean.
static void edges_that_are_told_of(void **) {
  Wall wall;
  const double least = 2 * std::asin(0.9 * cw_policy.upright_cosine) / CW_DEGREE;
  wall.domain.sharp.angle = least - 0.01;
  assert_true(cw_domain_is_sharp(&wall.domain));
  wall.domain.sharp.angle = least + 0.01;
  assert_false(cw_domain_is_sharp(&wall.domain));
}

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(full_layers),
      cmocka_unit_test(short_columns_keep_their_first_height),
      cmocka_unit_test(first_heights_that_are_missed),
      cmocka_unit_test(thin_prisms_are_counted),
      cmocka_unit_test(edges_that_are_told_of),
  };
  if (cw_policy_start() != CW_OK) return 1;
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
