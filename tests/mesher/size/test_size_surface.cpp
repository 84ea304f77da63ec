// SPDX-License-Identifier: AGPL-3.0-or-later
// What faces ask for: patch sizes, curvature and gaps, each from its formula on solids of random sizes; and how seeds
// are taken up.
#include <cstring>
#include <vector>

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <gp_Pln.hxx>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/common/vec.h"
#include "mesher/size/size_sources.h"
}

#include "solids.h"
#include "tests/draw.h"

// A solid whose faces are all of one wanted size (m), with the seeds of one of them on a grid.
struct Seeded {
  CwCad *cad;
  CwBackground background;
  CwMeshTable table = {};
  std::vector<double> relative;
  CwSizeSurface *surface = nullptr;
  CwSizeGrid grid = {};

  Seeded(const TopoDS_Shape &shape, double size, double share, double angle, double cells,
         const PatchOfFace &patch_of = all_wall)
      : cad(open_solid(shape, patch_of)), relative(cw_cad_patch_count(cad), share) {
    check(cw_background_make(cad, 1e-5, 0.1, &background));
    table.gradation = 0.2;
    table.curvature_angle = angle;
    table.cells_across_gap = cells;
    const CwSizeInput input = {cad, &background, &table, relative.data(), size / share, nullptr};
    check(cw_size_surface_make(&input, &surface));
    cw_size_surface_grid(&input, &grid);
    grid.value = (float *)std::malloc(cw_size_grid_nodes(&grid) * sizeof *grid.value);
  }
  ~Seeded() {
    cw_size_surface_free(&surface);
    cw_size_grid_free(&grid);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
  // The seeds of one face, or with -1 of the creases, alone.
  void seed(int face) {
    void *bytes = nullptr;
    int64_t count;
    check(face < 0 ? cw_size_seed_creases(surface, &bytes, &count) : cw_size_seed_face(surface, face, &bytes, &count));
    cw_size_grid_clear(&grid);
    cw_size_take_seeds(&grid, bytes, 1, INFINITY, INFINITY);
    std::free(bytes);
  }
  // The field in metres at a place in millimetres.
  double at(double x, double y, double z) const {
    const double metres[3] = {x * 1e-3, y * 1e-3, z * 1e-3};
    return cw_size_grid_at(&grid, metres);
  }
  // The face whose normal at its middle is `n`.
  int face_to(double nx, double ny, double nz) const {
    const double wanted[3] = {nx, ny, nz};
    for (int32_t t = 0; t < background.triangle_count; t++) {
      double n[3];
      cw_background_normal(&background, t, n);
      if (cw_dot(n, wanted) > 0.999) return background.face[t];
    }
    fail_msg("no face to (%g, %g, %g)", nx, ny, nz);
    return -1;
  }
};

// Each face of a block seeds the cells that it touches with the size of its patch, and no others.
static void a_face_seeds_where_it_is(void **) {
  const double side[3] = {40, 30, 20};
  Seeded block(BRepPrimAPI_MakeBox(side[0], side[1], side[2]).Shape(), 3e-3, 0.5, 0.3, 1);
  for (int axis = 0; axis < 3; axis++) {
    for (int upper = 0; upper < 2; upper++) {
      double n[3] = {0, 0, 0};
      n[axis] = upper ? 1 : -1;
      block.seed(block.face_to(n[0], n[1], n[2]));
      const double spacing = block.grid.spacing * (1 + 1e-6);
      for (int64_t node = 0; node < (int64_t)cw_size_grid_nodes(&block.grid); node++) {
        const int64_t nx = block.grid.count[0], ny = block.grid.count[1];
        const int64_t place[3] = {node % nx, node / nx % ny, node / nx / ny};
        int is_near = 1, is_over = 1;
        for (int k = 0; k < 3; k++) {
          const double x = block.grid.low[k] + block.grid.spacing * (double)place[k], high = side[k] * 1e-3;
          const double from = k == axis ? upper * high : 0, to = k == axis && !upper ? 0 : high;
          is_near &= x > from - spacing && x < to + spacing;
          // Along the face the seeds come within a spacing of its rim.
          is_over &= k == axis ? std::fabs(x - from) < 0.45 * spacing : x >= spacing && x <= high - spacing;
        }
        if (is_over) assert_near(block.grid.value[node], 3e-3, 1e-9);
        if (!is_near) assert_true(block.grid.value[node] == cw_size_unset);
      }
    }
  }
}

// A face with `patch` as the wanted size, before a wall at the distance `gap` of its own, or before an opening.
static void gaps_of_slabs(void **) {
  const PatchOfFace open_top = [](const TopoDS_Face &face) {
    gp_Pln plane = BRepAdaptor_Surface(face).Plane();
    int top = std::fabs(plane.Axis().Direction().Z()) > 0.5 && plane.Location().Z() > 0.1;
    return std::string(top ? "top,interface" : "rest,wall");
  };
  uint64_t seed = 4;
  int asked = 0;
  for (int i = 0; i < 10; i++) {
    const double gap = 0.8 + 7 * draw(&seed), patch = 2, cells = 1 + draw_below(&seed, 6), share = i % 2 ? 1 : 0.5;
    const int is_open = i % 3 == 0;
    Seeded slab(BRepPrimAPI_MakeBox(40, 40, gap).Shape(), patch * 1e-3, share, 0.3, cells,
                is_open ? open_top : PatchOfFace(all_wall));
    const double counted = is_open ? std::fmin(cells, 2) : cells;
    const double wanted = std::fmin(patch, std::fmax(gap / counted, 0.15 * patch / share)) * 1e-3;
    for (int upper = 0; upper < 2; upper++) {
      slab.seed(slab.face_to(0, 0, upper ? 1 : -1));
      for (int k = 0; k < 10; k++)
        assert_near(slab.at(5 + 30 * draw(&seed), 5 + 30 * draw(&seed), upper * gap), wanted, 1e-7);
    }
    asked += wanted < patch * 1e-3;
  }
  assert_true(asked > 3);
}

// Two walls that meet at an angle: below 20 degrees they are a gap, however near the crease is; above, none, and above
// the angle at which they face one another none in any case.
static void walls_that_meet(void **) {
  const double angle[4] = {12, 18, 25, 50}, patch = 3, cells = 4;
  for (double degrees : angle) {
    const double a = degrees * M_PI / 180, slope = std::tan(a);
    Seeded wedge(BRepPrimAPI_MakeCylinder(60, 40, a).Shape(), patch * 1e-3, 1, 0.3, cells);
    wedge.seed(wedge.face_to(0, -1, 0));
    for (double s = 8; s < 45; s += 1) {
      const double spacing = wedge.grid.spacing * 1e3, way = s * slope;
      const double gap = std::fmax(way / cells, 0.15 * patch), off = 4 * spacing * slope / cells;
      // The ray ends where the round face begins.
      if (degrees < 20 && way < cells * patch - 1 && s / std::cos(a) < 58) {
        assert_true(wedge.at(s, 0, 20) <= std::fmin(patch, gap + off) * 1e-3 + 1e-9);
        assert_true(wedge.at(s, 0, 20) >= std::fmin(patch, std::fmax(gap - off, 0.15 * patch)) * 1e-3 - 1e-9);
      } else if (degrees > 20 && s < 20) {
        assert_near(wedge.at(s, 0, 20), patch * 1e-3, 1e-7);
      }
    }
  }
}

// On a round face an edge turns by the angle asked for, at least two fifths of the wanted size and no more than all.
static void round_faces(void **) {
  uint64_t seed = 6;
  int between = 0;
  for (int i = 0; i < 10; i++) {
    const double radius = 4 + 8 * draw(&seed), angle = 0.05 + 0.5 * draw(&seed), patch = 2, share = i % 3 ? 1 : 0.5;
    const double wanted = std::fmin(patch, std::fmax(radius * angle, 0.4 * patch)) * 1e-3;
    const TopoDS_Shape bar = BRepPrimAPI_MakeCylinder(radius, 30, 2).Shape();
    const TopoDS_Shape ball = BRepPrimAPI_MakeSphere(radius, -0.8, 0.8, 2).Shape();
    Seeded solid(i % 2 ? bar : ball, patch * 1e-3, share, angle, 1, by_shape);
    solid.seed(curved_face(solid.cad));
    for (int k = 0; k < 10; k++) {
      const double turn = 0.5 + draw(&seed), rise = i % 2 ? 0 : 0.6 * (draw(&seed) - 0.5);
      const double z = i % 2 ? 5 + 20 * draw(&seed) : radius * std::sin(rise), r = radius * std::cos(rise);
      assert_near(solid.at(r * std::cos(turn), r * std::sin(turn), z), wanted, 2e-3 * wanted);
    }
    between += radius * angle > 0.4 * patch && radius * angle < patch;
  }
  assert_true(between > 2);
}

// Of a seed counts a share, but no less than 0.4 of it, or of the base where that is less; no more than all of it, nor
// than the most; and a node keeps what is less already.
static void seeds_are_taken_up(void **) {
  struct {
    int64_t count;
    struct {
      int32_t node;
      float value;
    } seed[2];
  } block = {2, {{3, 2.0F}, {7, 0.5F}}};
  const double given[6][3] = {{1, 10, 10}, {0.5, 10, 10}, {0.1, 10, 10}, {0.1, 1, 10}, {5, 10, 10}, {1, 10, 0.7}};
  const double wanted[6][2] = {{2, 0.5}, {1, 0.25}, {0.8, 0.2}, {0.4, 0.2}, {2, 0.5}, {0.7, 0.5}};
  const double low[3] = {0, 0, 0};
  CwSizeGrid grid;
  check(cw_size_grid_make(low, low, 1, 1000, &grid));
  for (int i = 0; i < 6; i++) {
    cw_size_grid_clear(&grid);
    cw_size_take_seeds(&grid, &block, given[i][0], given[i][1], given[i][2]);
    assert_near(grid.value[3], wanted[i][0], 1e-6);
    assert_near(grid.value[7], wanted[i][1], 1e-6);
    grid.value[3] = 0.1F, grid.value[7] = 3;
    cw_size_take_seeds(&grid, &block, given[i][0], given[i][1], given[i][2]);
    assert_near(grid.value[3], 0.1, 1e-6);
    assert_near(grid.value[7], wanted[i][1], 1e-6);
    for (int64_t node = 0; node < (int64_t)cw_size_grid_nodes(&grid); node++)
      if (node != 3 && node != 7) assert_true(grid.value[node] == cw_size_unset);
  }
  cw_size_grid_free(&grid);
}

// Creases come packed as the seeds of faces do, and each leaves the grid as it was: in any order the same bytes.
static void parts_do_not_mix(void **) {
  Seeded solid(BRepPrimAPI_MakeCylinder(10, 4, 2).Shape(), 2e-3, 1, 0.1, 3, by_shape);
  std::vector<std::vector<char>> first;
  const int faces = cw_cad_face_count(solid.cad);
  for (int pass = 0; pass < 2; pass++) {
    for (int i = 0; i <= faces; i++) {
      const int part = pass ? faces - i : i;
      void *bytes = nullptr;
      int64_t count;
      check(part < faces ? cw_size_seed_face(solid.surface, part, &bytes, &count)
                         : cw_size_seed_creases(solid.surface, &bytes, &count));
      const std::vector<char> made((char *)bytes, (char *)bytes + count);
      if (pass) assert_true(made == first[part]);
      if (!pass) first.push_back(made);
      std::free(bytes);
    }
  }
  const CwSizeInput input = {solid.cad, &solid.background, &solid.table, solid.relative.data(), 2e-3, nullptr};
  CwSizeGrid alone = solid.grid;
  alone.value = (float *)std::malloc(cw_size_grid_nodes(&alone) * sizeof *alone.value);
  cw_size_grid_clear(&alone);
  check(cw_size_seed_edges(&input, &alone));
  solid.seed(-1);
  assert_memory_equal(alone.value, solid.grid.value, cw_size_grid_nodes(&alone) * sizeof *alone.value);
  cw_size_grid_free(&alone);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(a_face_seeds_where_it_is), cmocka_unit_test(gaps_of_slabs),
                              cmocka_unit_test(walls_that_meet),          cmocka_unit_test(round_faces),
                              cmocka_unit_test(seeds_are_taken_up),       cmocka_unit_test(parts_do_not_mix)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
