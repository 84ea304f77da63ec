// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <gp_Pnt.hxx>
#include <gp_Vec.hxx>

#include "mesher/cad/background_make.h"
#include "mesher/size/size.h"
#include "tests/draw.h"

#include "solids.h"

static const double gradation = 0.2;

// Everything of one solid; lengths in mm for the reader, as the field takes metres.
struct Model {
  CwCad *cad;
  CwBackground background;
  CwSize *size = nullptr;
  std::vector<char> packed; // the field of the seeds

  Model(const TopoDS_Shape &solid, double base_mm, double curvature_angle, double cells_across_gap,
        std::vector<double> patch_size, const PatchOfFace &patch_of = all_wall,
        const std::vector<double> &open_edge_size = {}, const std::vector<double> &wall_size = {}, double scale = 0,
        const std::vector<CwSizePoint> &point = {})
      : cad(open_solid(solid, patch_of)) {
    CwMeshTable table = {};
    table.gradation = gradation;
    table.curvature_angle = curvature_angle;
    table.cells_across_gap = cells_across_gap;
    assert_int_equal(patch_size.size(), cw_cad_patch_count(cad));
    if (cw_background_make(cad, 1e-5, 0.1, &background) != CW_OK) fail_msg("%s", cw_fail_message());
    CwSizeSeeds *seeds = nullptr;
    std::vector<void *> parts(cw_size_seed_parts(cad));
    int64_t bytes;
    void *block = nullptr;
    check(cw_size_seeds_start(cad, &background, &table, patch_size.data(), base_mm * 1e-3, &seeds));
    for (int i = (int)parts.size() - 1; i >= 0; i--) check(cw_size_seeds_part(seeds, i, &parts[i], &bytes));
    cw_size_seeds_free(&seeds);
    const CwSizeLimits limits = {open_edge_size.data(), wall_size.empty() ? nullptr : wall_size.data(), scale,
                                 (int32_t)point.size(), point.data()};
    const CwSizeLimits *open_edge = open_edge_size.empty() ? nullptr : &limits;
    check(cw_size_make(cad, &background, &table, patch_size.data(), base_mm * 1e-3, open_edge, parts.data(),
                       CW_SIZE_SEEDS, &block, &bytes));
    packed.assign((const char *)block, (const char *)block + bytes);
    check(cw_size_unpack(&block, &size));
    assert_null(block);
    if (open_edge) {
      CwSize *open_edges = nullptr;
      check(cw_size_make(cad, &background, &table, patch_size.data(), base_mm * 1e-3, open_edge, parts.data(),
                         CW_SIZE_OPEN_EDGES, &block, &bytes));
      check(cw_size_unpack(&block, &open_edges));
      cw_size_join(size, &open_edges);
      assert_null(open_edges);
      CwSize *again = nullptr; // made once more, as with another gradation, it takes the open edges of the first
      check(cw_size_make(cad, &background, &table, patch_size.data(), base_mm * 1e-3, open_edge, parts.data(),
                         CW_SIZE_SEEDS, &block, &bytes));
      check(cw_size_unpack(&block, &again));
      cw_size_join(again, &size);
      assert_null(size);
      size = again;
    }
    for (void *part : parts) free(part);
  }
  ~Model() {
    cw_size_free(&size);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
  double at(double x, double y, double z) const {
    const double metres[3] = {x * 1e-3, y * 1e-3, z * 1e-3};
    return cw_size_at(size, metres) * 1e3;
  }
};

static TopoDS_Shape bevelled_block() {
  const double leg = 1 / std::sqrt(2.0); // of the bevel: 1 mm wide
  BRepBuilderAPI_MakePolygon outline;
  outline.Add(gp_Pnt(0, 0, 0));
  outline.Add(gp_Pnt(30 - leg, 0, 0));
  outline.Add(gp_Pnt(30, leg, 0));
  outline.Add(gp_Pnt(30, 30, 0));
  outline.Add(gp_Pnt(0, 30, 0));
  outline.Close();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(outline.Wire()), gp_Vec(0, 0, 30)).Shape();
}

static void patch_size_grows_into_the_inside(void **state) {
  Model box(BRepPrimAPI_MakeBox(100, 100, 100).Shape(), 5, 0.5, 2, {2});
  assert_near(box.at(50, 50, 0), 10, 0.01);
  assert_near(box.at(50, 30, 100), 10, 0.01);
  // 50 mm from every wall, less the spacing (3 mm) within which the size of the wall holds, and less what the
  // sweep rounds off where the growth from six walls meets.
  double centre = box.at(50, 50, 50);
  assert_true(centre <= 10 + gradation * 50 && centre >= 10 + gradation * 44);
  assert_near(box.at(50, 50, 1000), box.at(50, 50, 105), 1e-9); // clamped outside
  cw_size_set_scale(box.size, 0.5);
  assert_near(box.at(50, 50, 50), 0.5 * centre, 1e-9);
}

static void a_field_is_read_where_it_lies(void **state) {
  Model box(BRepPrimAPI_MakeBox(100, 100, 100).Shape(), 5, 0.5, 2, {2});
  const std::vector<char> before = box.packed;
  CwSize *there = nullptr, *joined = nullptr;
  check(cw_size_read(box.packed.data(), &there));
  check(cw_size_read(box.packed.data(), &joined));
  cw_size_join(joined, &there);
  assert_null(there);
  cw_size_set_scale(joined, 0.5);
  cw_size_set_scale(box.size, 0.5);
  const double places[3][3] = {{0.05, 0.05, 0}, {0.02, 0.07, 0.09}, {0.05, 0.05, 1}};
  for (const auto &x : places) assert_true(cw_size_at(joined, x) == cw_size_at(box.size, x));
  cw_size_free(&joined);
  assert_true(box.packed == before); // neither changed nor freed
}

static void curvature_refines_to_two_fifths_at_most(void **state) {
  const double x = 5 * std::cos(0.7), y = 5 * std::sin(0.7);
  const TopoDS_Shape quarter = BRepPrimAPI_MakeCylinder(5, 40, M_PI / 2).Shape();
  Model coarse(quarter, 2, 0.3, 1, {1, 1}, by_shape);
  assert_near(coarse.at(x, y, 20), 0.3 * 5, 0.02);
  Model fine(quarter, 2, 0.01, 1, {1, 1}, by_shape);
  assert_near(fine.at(x, y, 20), 0.4 * 2, 0.01);
  Model none(quarter, 1, 0.3, 1, {1, 1}, by_shape);
  assert_near(none.at(x, y, 20), 1, 0.01);
}

static void gaps_get_their_cells(void **state) {
  const TopoDS_Shape slab = BRepPrimAPI_MakeBox(60, 60, 4).Shape();
  Model four(slab, 2, 0.5, 4, {1});
  assert_near(four.at(30, 30, 0), 1, 0.01);
  assert_near(four.at(10, 50, 4), 1, 0.01);
  assert_true(four.at(30, 30, 2) >= 1 && four.at(30, 30, 2) <= 1 + gradation * 2);
  Model one(slab, 2, 0.5, 1, {1});
  assert_near(one.at(30, 30, 0), 2, 0.01);
  // Before an opening two cells do; no gap asks for less than 0.15 of the base size.
  Model open(slab, 3, 0.5, 4, {1, 1}, [](const TopoDS_Face &face) {
    double z = std::fabs(BRepAdaptor_Surface(face).Plane().Location().Z());
    double normal_z = std::fabs(BRepAdaptor_Surface(face).Plane().Axis().Direction().Z());
    return std::string(normal_z > 0.5 && z > 2 ? "top,interface" : "rest,wall");
  });
  assert_near(open.at(30, 30, 0), 2, 0.01);
  assert_near(open.at(30, 30, 4), 2, 0.01);
  Model thin(BRepPrimAPI_MakeBox(60, 60, 0.5).Shape(), 2, 0.5, 4, {1});
  assert_near(thin.at(30, 30, 0.5), 0.15 * 2, 0.01);
}

static void walls_of_a_wedge_are_no_gap(void **state) {
  Model wedge(BRepPrimAPI_MakeCylinder(50, 50, M_PI / 6).Shape(), 2, 0.5, 4, {1});
  for (double r = 2; r < 20; r += 1) assert_near(wedge.at(r, 0, 25), 2, 0.02);
}

static void narrow_faces_get_their_width(void **state) {
  Model block(bevelled_block(), 3, 0.5, 1, {1});
  const double middle = 0.5 / std::sqrt(2.0);
  double h = block.at(30 - middle, middle, 15);
  assert_true(h >= 1 - 0.01 && h <= 1 + gradation * 0.5 + 0.01);
  assert_near(block.at(1, 29, 15), 3, 0.02);
  Model coarse(bevelled_block(), 10, 0.5, 1, {1});
  assert_near(coarse.at(30 - middle, middle, 15), 0.15 * 10, 0.15);
}

// The bevel is 1 mm wide: made for a scale of 4 its edges are as long as twice its width; made for 20, where that would
// be a thirtieth of what is wanted beside it, they are granted two fifths of what the scale alone would give them.
static void coarse_meshes_hold_narrow_faces(void **state) {
  const double middle = 0.5 / std::sqrt(2.0), made_for[2] = {4, 20}, longest[2] = {2, 0.4 * 20};
  for (int i = 0; i < 2; i++) {
    Model block(bevelled_block(), 3, 0.5, 1, {1}, all_wall, {1}, {}, made_for[i]);
    cw_size_set_scale(block.size, made_for[i]);
    double h = block.at(30 - middle, middle, 15);
    assert_true(h >= longest[i] - 0.01 && h <= longest[i] + made_for[i] * (gradation * 0.5 + 0.01));
    assert_near(block.at(1, 29, 15), made_for[i] * 3, 0.02 * made_for[i]);
  }
}

static void growth_is_limited(void **state) {
  Model block(bevelled_block(), 3, 0.5, 1, {1});
  uint64_t seed = 1;
  auto next = [&seed]() { return 30 * draw(&seed); };
  for (int i = 0; i < 200000; i++) {
    double p[3], q[3];
    for (int k = 0; k < 3; k++) {
      p[k] = next();
      q[k] = i % 2 ? next() : p[k] + (next() - 15) / 10;
    }
    double apart = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    double change = std::fabs(block.at(p[0], p[1], p[2]) - block.at(q[0], q[1], q[2]));
    // The first-order sweep is 6 % off far from small features; a fifth of the spacing is for the
    // interpolation.
    assert_true(change <= gradation * (apart * 1.06 + 0.2 * 1.8));
    // No more than the bevel allows.
    double off = std::hypot(30 - p[0], p[1]);
    assert_true(block.at(p[0], p[1], p[2]) <= 1 + gradation * (off + 0.1));
  }
}

static double check_samples(const Model &model, const std::function<bool(const double *)> &inside) {
  int32_t count;
  double(*x)[3], *volume, sum = 0, integral = 0;
  assert_int_equal(cw_size_samples(model.size, &count, &x, &volume), CW_OK);
  for (int32_t i = 0; i < count; i++) {
    assert_true(inside(x[i]));
    assert_true(volume[i] > 0);
    sum += volume[i];
    integral += volume[i] / std::pow(cw_size_at(model.size, x[i]), 3);
  }
  for (int32_t i = 0; i < cw_size_line_count(model.size); i++) integral -= cw_size_line_integral(model.size, i);
  assert_near(integral, 0, 1e-9 * sum / std::pow(0.002, 3));
  free(x);
  free(volume);
  return sum;
}

static void samples_fill_the_domain(void **state) {
  Model slab(BRepPrimAPI_MakeBox(60, 60, 4).Shape(), 2, 0.5, 2, {1});
  double sum = check_samples(slab, [](const double *x) {
    return x[0] > 0 && x[0] < 0.06 && x[1] > 0 && x[1] < 0.06 && x[2] > 0 && x[2] < 0.004;
  });
  assert_near(sum, solid_volume(slab.cad), 0.01 * solid_volume(slab.cad));
  Model quarter(BRepPrimAPI_MakeCylinder(20, 40, M_PI / 2).Shape(), 1, 0.5, 2, {1});
  sum = check_samples(quarter, [](const double *x) {
    return x[0] > 0 && x[1] > 0 && std::hypot(x[0], x[1]) < 0.02 && x[2] > 0 && x[2] < 0.04;
  });
  assert_near(sum, solid_volume(quarter.cad), 0.01 * solid_volume(quarter.cad));
}

static void two_runs_are_the_same(void **state) {
  const TopoDS_Shape block = bevelled_block();
  Model a(block, 3, 0.5, 3, {1}), b(block, 3, 0.5, 3, {1});
  for (double x = -1; x < 32; x += 0.7) {
    double p = a.at(x, 31 - x, 0.9 * x), q = b.at(x, 31 - x, 0.9 * x);
    assert_memory_equal(&p, &q, sizeof p);
  }
}

// Of a box 30 mm high.
static std::string open_top(const TopoDS_Face &face) {
  gp_Pln plane = BRepAdaptor_Surface(face).Plane();
  int top = std::fabs(plane.Axis().Direction().Z()) > 0.5 && plane.Location().Z() > 29;
  return top ? "top,inlet" : "rest,wall";
}

static void rims_hold_at_any_scale(void **state) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(30, 30, 30).Shape();
  const Model plain(box, 3, 0.5, 1, {1, 1}, open_top), open_edge(box, 3, 0.5, 1, {1, 1}, open_top, {1e-3, 1e-3});
  for (double scale : {0.5, 0.8}) {
    cw_size_set_scale(plain.size, scale);
    cw_size_set_scale(open_edge.size, scale);
    assert_true(open_edge.at(15, 0, 30) <= 1 + 1e-6);                  // on the open edge, no matter the scale
    assert_near(open_edge.at(15, 15, 30), plain.at(15, 15, 30), 1e-6); // in the middle of the open face as before
    assert_true(open_edge.at(15, 0, 20) <= 1 + gradation * 12);        // down the wall
    assert_near(open_edge.at(0, 0, 0), plain.at(0, 0, 0), 1e-6);       // far from it as before
  }
  cw_size_set_scale(open_edge.size,
                    1 / 1.02); // asks 0.34, half-way from 0.4 down to 0.28: gets half-way from 0.4 up to 1
  assert_near(open_edge.at(15, 0, 30), 0.7 * 3 / 1.02, 1e-5);
  cw_size_set_scale(open_edge.size, 2); // asks a sixth, which is less than 0.28
  assert_near(open_edge.at(15, 0, 30), 2 * 3, 1e-5);
}

static void walls_hold_their_edges(void **state) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(30, 30, 30).Shape();
  const Model held(box, 3, 0.5, 1, {1, 1}, open_top, {1, 1}, {2e-3, 2e-3});
  assert_near(held.at(15, 15, 0), 2, 1e-5);
  assert_near(held.at(0, 15, 15), 2, 1e-5);
  assert_near(held.at(15, 15, 30), 3, 1e-5); // no wall
  const Model wide(box, 3, 0.5, 1, {1, 1}, open_top, {1, 1}, {4e-3, 4e-3});
  assert_near(wide.at(15, 15, 0), 3, 1e-5); // wants less than it may have
  cw_size_set_scale(held.size, 2);          // limits of walls go with the scale
  assert_near(held.at(15, 15, 0), 4, 1e-5);
}

// h grows from the point by the gradation, whatever the walls want; far from it, it is what it was.
static void points_hold_their_edges(void **state) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(30, 30, 30).Shape();
  const PatchOfFace all = [](const TopoDS_Face &) { return std::string("rest,wall"); };
  const CwSizePoint point = {{15e-3, 15e-3, 0}, 0.5e-3};
  const Model held(box, 3, 0.5, 1, {1}, all, {1}, {}, 0, {point});
  assert_true(held.at(15, 15, 0) <= 0.5 + 1e-6);
  for (double away : {4.0, 8.0}) {
    const double wanted = 0.5 + gradation * away, spacing = 3; // of the grid: nodes about the point have its size
    assert_true(held.at(15 + away, 15, 0) <= wanted + 1e-6);
    assert_true(held.at(15 + away, 15, 0) >= wanted - gradation * std::sqrt(3) * spacing);
  }
  assert_near(held.at(30, 30, 30), 3, 1e-5);
}

// All triangles of a tiny face can fold away.
static void a_face_without_triangles_has_no_seeds(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  CwBackground background;
  CwMeshTable table = {};
  CwSizeSeeds *seeds = nullptr;
  void *block = nullptr;
  int64_t bytes, count;
  const double patch_size = 1;
  table.gradation = table.curvature_angle = 0.2;
  check(cw_background_make(cad, 1e-5, 0.1, &background));
  for (int32_t t = 0; t < background.triangle_count; t++)
    if (background.face[t] == 0) background.face[t] = 1;
  check(cw_size_seeds_start(cad, &background, &table, &patch_size, 0.001, &seeds));
  check(cw_size_seeds_part(seeds, 0, &block, &bytes));
  std::memcpy(&count, block, sizeof count);
  assert_int_equal(count, 0);
  assert_int_equal(bytes, sizeof count);
  free(block);
  cw_size_seeds_free(&seeds);
  cw_background_free(&background);
  cw_cad_close(&cad);
}

static void wrong_input_is_refused(void **state) {
  CwCad *cad = open_solid(BRepPrimAPI_MakeBox(1, 1, 1).Shape());
  CwBackground background;
  CwMeshTable table = {};
  void *block = nullptr;
  int64_t bytes;
  double patch_size = 1;
  table.gradation = table.curvature_angle = 0.2;
  assert_int_equal(cw_background_make(cad, 1e-5, 0.1, &background), CW_OK);
  assert_int_equal(
      cw_size_make(cad, &background, &table, &patch_size, 0, nullptr, nullptr, CW_SIZE_SEEDS, &block, &bytes),
      CW_ERR_USAGE);
  patch_size = 0;
  assert_int_equal(
      cw_size_make(cad, &background, &table, &patch_size, 0.001, nullptr, nullptr, CW_SIZE_SEEDS, &block, &bytes),
      CW_ERR_USAGE);
  assert_non_null(std::strstr(cw_fail_message(), "patch 'wall'"));
  assert_null(block);
  cw_background_free(&background);
  cw_cad_close(&cad);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(patch_size_grows_into_the_inside),
      cmocka_unit_test(a_field_is_read_where_it_lies),
      cmocka_unit_test(curvature_refines_to_two_fifths_at_most),
      cmocka_unit_test(gaps_get_their_cells),
      cmocka_unit_test(walls_of_a_wedge_are_no_gap),
      cmocka_unit_test(narrow_faces_get_their_width),
      cmocka_unit_test(coarse_meshes_hold_narrow_faces),
      cmocka_unit_test(growth_is_limited),
      cmocka_unit_test(samples_fill_the_domain),
      cmocka_unit_test(two_runs_are_the_same),
      cmocka_unit_test(rims_hold_at_any_scale),
      cmocka_unit_test(walls_hold_their_edges),
      cmocka_unit_test(points_hold_their_edges),
      cmocka_unit_test(a_face_without_triangles_has_no_seeds),
      cmocka_unit_test(wrong_input_is_refused),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
