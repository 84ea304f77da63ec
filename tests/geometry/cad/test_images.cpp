// SPDX-License-Identifier: AGPL-3.0-or-later
// Images in boxes about the axis, counted by hand.
#include "cad/small_parts.hpp"

#include <BRepPrimAPI_MakeCone.hxx>

#include "geometry/cad/images.hpp"

static const double tolerance = 1e-6, unit = 1e-3;

static const TopoDS_Shape &box() {
  static const TopoDS_Shape made = small_box(-1, -1, 0, 2, 2, 3);
  return made;
}

static void a_box_is_fourfold(void **) {
  CwImagesOfSolid images;
  assert_string_equal(images.find(box(), 4, tolerance, unit).c_str(), "");
  assert_true(images.off < 1e-12);
  int fixed = 0, sides = 0;
  for (int f = 0; f < 6; f++) {
    fixed += images.is_fixed(f);
    sides += !images.is_fixed(f) && images.face.first[f] == f;
  }
  assert_int_equal(fixed, 2);
  assert_int_equal(sides, 1);
  int edges = 0, vertices = 0;
  for (int e = 0; e < 12; e++) edges += images.edge.first[e] == e;
  for (int v = 0; v < 8; v++) vertices += images.vertex.first[v] == v;
  assert_int_equal(edges, 3); // of the top, the bottom and the sides
  assert_int_equal(vertices, 2);
}

static void two_turns_make_sets_of_two(void **) {
  CwImagesOfSolid images;
  assert_string_equal(images.find(box(), 2, tolerance, unit).c_str(), "");
  int sides = 0;
  for (int f = 0; f < 6; f++) sides += !images.is_fixed(f) && images.face.first[f] == f;
  assert_int_equal(sides, 2);
}

// Of what is chosen, each item lies `turns` turns from its first, and the edges of first faces have firsts beside them.
static void the_chosen_are_firsts_of_their_sets(void **) {
  CwImagesOfSolid images;
  assert_string_equal(images.find(box(), 2, tolerance, unit).c_str(), "");
  images.choose();
  for (const CwImageSet *set : {&images.face, &images.edge, &images.vertex})
    for (size_t i = 0; i < set->next.size(); i++) {
      int item = set->first[i];
      assert_int_equal(set->first[item], item);
      for (int k = 0; k < set->turns[i]; k++) item = set->next[item];
      assert_int_equal(item, (int)i);
    }
  int together = 0; // first faces that share an edge: both sides' firsts hang together
  for (int e = 1; e <= images.edges.Extent(); e++) {
    int firsts = 0;
    for (int f = 1; f <= images.faces.Extent(); f++) {
      if (images.is_fixed(f - 1) || images.face.first[f - 1] != f - 1) continue;
      for (TopExp_Explorer at(images.faces(f), TopAbs_EDGE); at.More(); at.Next())
        firsts += at.Current().IsSame(images.edges(e));
    }
    together += firsts == 2;
  }
  assert_int_equal(together, 1);
}

static void no_image_is_told_with_its_place(void **) {
  CwImagesOfSolid images;
  // A corner at (1, 1), turned by 120 degrees, is nearest to another by 2 sin(15 degrees) times its radius.
  const std::string three = images.find(box(), 3, tolerance, unit);
  assert_string_equal(three.c_str(), "a corner at radius 1.414, z 3.000 mm is 0.732 mm off its image");
  // A seam, for which there is another turned.
  const std::string cone = images.find(BRepPrimAPI_MakeCone(3, 0, 7).Solid(), 2, tolerance, unit);
  if (cone.find("off its image") == std::string::npos) fail_msg("%s", cone.c_str());
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_box_is_fourfold),
      cmocka_unit_test(two_turns_make_sets_of_two),
      cmocka_unit_test(the_chosen_are_firsts_of_their_sets),
      cmocka_unit_test(no_image_is_told_with_its_place),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
