// SPDX-License-Identifier: AGPL-3.0-or-later
// Loose faces become solids, with the voids that shells inside of others bound; open edges are told with their gap.
#include <BRepCheck_Analyzer.hxx>

#include "cad/small_parts.hpp"
#include "geometry/cad/sewing.hpp"

// The faces of a box, each a copy of its own, the last one moved up by `off`; every other one looks inward.
static std::vector<TopoDS_Shape> loose(const TopoDS_Shape &box, double off, int count = 6) {
  const TopTools_IndexedMapOfShape map = cw_cad_faces(box);
  std::vector<TopoDS_Shape> faces;
  for (int f = 1; f <= count; f++) {
    gp_Trsf motion;
    if (f == 6) motion.SetTranslation(gp_Vec(0, 0, off));
    const TopoDS_Shape face = BRepBuilderAPI_Transform(map(f), motion, Standard_True).Shape();
    faces.push_back(f % 2 ? face : face.Reversed());
  }
  return faces;
}

static std::vector<TopoDS_Shape> together(std::vector<TopoDS_Shape> all, const std::vector<TopoDS_Shape> &more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

static int shells_of(const TopoDS_Shape &solid) {
  int shells = 0;
  for (TopExp_Explorer at(solid, TopAbs_SHELL); at.More(); at.Next()) shells++;
  return shells;
}

static void shells_inside_are_voids(void **) {
  const std::vector<TopoDS_Shape> outer = loose(small_box(0, 0, 0, 10, 10, 10), 0.005),
                                  inner = loose(small_box(3, 3, 3, 2, 2, 2), 0.005);
  for (const auto &faces : {together(outer, inner), together(inner, outer)}) {
    const CwSewn sewn = cw_cad_sew(faces, 0.01);
    assert_int_equal(sewn.faces, 12);
    assert_true(sewn.open.empty());
    assert_int_equal(sewn.solids.size(), 1);
    assert_int_equal(shells_of(sewn.solids[0]), 2);
    assert_near(small_volume(sewn.solids[0]), 1000 - 8, 0.6);
    assert_true(BRepCheck_Analyzer(sewn.solids[0]).IsValid());
  }
}

// A body in the void of another, and one beside both.
static void bodies_in_voids_are_solids(void **) {
  std::vector<TopoDS_Shape> faces = loose(small_box(0, 0, 0, 10, 10, 10), 0);
  faces = together(faces, loose(small_box(2, 2, 2, 6, 6, 6), 0));
  faces = together(faces, loose(small_box(4, 4, 4, 2, 2, 2), 0));
  faces = together(faces, loose(small_box(20, 0, 0, 1, 1, 1), 0));
  const CwSewn sewn = cw_cad_sew(faces, 0.01);
  assert_int_equal(sewn.solids.size(), 3);
  double volume = 0;
  for (const TopoDS_Shape &solid : sewn.solids) {
    assert_true(small_volume(solid) > 0);
    volume += small_volume(solid);
  }
  assert_near(volume, 1000 - 216 + 8 + 1, 1e-6);
}

static void open_edges_are_told_with_their_gap(void **) {
  CwSewn sewn = cw_cad_sew(loose(small_box(0, 0, 0, 10, 10, 10), 0.3), 0.01);
  assert_int_equal(sewn.open.size(), 8); // of the lid and of what it was on
  assert_int_equal(sewn.solids.size(), 1);
  assert_int_equal(shells_of(sewn.solids[0]), 2);
  assert_near(cw_cad_opening(sewn.open[0], sewn.open).gap, 0.3, 1e-6);
  sewn = cw_cad_sew(loose(small_box(0, 0, 0, 10, 10, 10), 0, 5), 0.01);
  assert_int_equal(sewn.open.size(), 4);
  const CwOpening opening = cw_cad_opening(sewn.open[0], sewn.open);
  assert_near(opening.gap, 5, 1e-6); // half the lid that is missing
  assert_near(opening.at.Z(), 10, 1e-9);
  assert_true(cw_cad_opening(sewn.open[0], {sewn.open[0]}).gap < 0);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(shells_inside_are_voids),
                                     cmocka_unit_test(bodies_in_voids_are_solids),
                                     cmocka_unit_test(open_edges_are_told_with_their_gap)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
