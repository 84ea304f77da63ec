// SPDX-License-Identifier: AGPL-3.0-or-later
// Boxes side by side: which faces touch, with what share, at what gap; and what is cut.
#include "cad/small_parts.hpp"

#include <BRepPrimAPI_MakeCone.hxx>

// Faces of a part that touch another, and the least share of any.
static int touching(const SmallParts &small, int part, double *least) {
  int count = 0;
  *least = 1;
  for (int f = 0; f < small.survey.face_count; f++) {
    if (small.survey.face[f].part != part || small.contact[f].part < 0) continue;
    count++;
    *least = std::min(*least, small.contact[f].share);
  }
  return count;
}

static void equal_faces_touch_wholly(void **) {
  double share;
  SmallParts small({{"a", small_box(0, 0, 0, 10, 10, 10)}, {"b", small_box(10, 0, 0, 5, 10, 10)}});
  if (small.look()) fail_msg("%s", cw_fail_message());
  for (int part = 0; part < 2; part++) {
    assert_int_equal(touching(small, part, &share), 1);
    assert_near(share, 1, 0);
  }
}

// A small box on a large one: its face touches wholly, the large one in part until it is cut to 5 x 5 mm.
static void faces_that_touch_in_part_are_cut(void **) {
  double share, area = 0;
  int cut;
  SmallParts small({{"a", small_box(0, 0, 0, 20, 20, 5)}, {"b", small_box(8, 8, 5, 5, 5, 5)}});
  if (small.look()) fail_msg("%s", cw_fail_message());
  assert_int_equal(touching(small, 1, &share), 1);
  assert_near(share, 1, 0);
  assert_int_equal(cw_contact_imprint(&small.survey, small.contact, small_tolerance, NULL, &small.parts, &cut), CW_OK);
  assert_int_equal(cut, 1);
  cw_survey_free(&small.survey);
  free(small.contact);
  if (small.look()) fail_msg("%s", cw_fail_message());
  assert_int_equal(touching(small, 0, &share), 1);
  assert_near(share, 1, 0);
  for (int f = 0; f < small.survey.face_count; f++)
    if (small.contact[f].part == 1) area += small.survey.face[f].area;
  assert_near(area, 25e-6, 1e-12);
}

// The water in a wheel and a ring about it that goes on above: both ends of the contact, at its neck and along it, are
// off by 0.8 of the tolerance at once, in any directions. The ring's faces must be cut to what they touch.
static void contacts_off_in_two_directions_are_cut(void **) {
  enum { CYLINDER, CONE, PLANE_AND_CYLINDER, FORMS };
  const double off = 0.8 * small_tolerance / 1e-3, slope = 0.3, reach = 101;
  const auto widening = [&](double z, double wider, double height) {
    const double from = reach + wider + slope * (z + 90);
    return BRepPrimAPI_MakeCone(gp_Ax2(gp_Pnt(0, 0, z), gp::DZ()), from, from + slope * height, height).Shape();
  };
  for (int form = 0; form < FORMS; form++)
    for (int radial = -1; radial <= 1; radial++)
      for (int axial = -1; axial <= 1; axial++) {
        const double below = -90 - axial * off, wider = radial * off;
        TopoDS_Shape wheel = small_cylinder(below, reach + wider, 40 - below), ring;
        if (form == CONE) {
          wheel = widening(below, wider, 40 - below);
          ring = BRepAlgoAPI_Cut(small_cylinder(-90, 200, 180), widening(-91, 0, 182)).Shape();
        } else if (form == CYLINDER) {
          ring = BRepAlgoAPI_Cut(small_cylinder(-90, 200, 180), small_cylinder(-91, reach, 182)).Shape();
        } else {
          ring = BRepAlgoAPI_Cut(small_cylinder(-110, 200, 200), small_cylinder(-90, reach, 182)).Shape();
          ring = BRepAlgoAPI_Cut(ring, small_cylinder(-120, 60, 240)).Shape();
        }
        SmallParts small({{"wheel", wheel}, {"ring", ring}});
        double share;
        if (small.look_imprinted()) fail_msg("%s", cw_fail_message());
        for (int part = 0; part < 2; part++) {
          assert_int_equal(touching(small, part, &share), form == PLANE_AND_CYLINDER ? 2 : 1);
          assert_near(share, 1, 0);
        }
      }
}

static void gaps_are_told_with_their_size(void **) {
  SmallParts small({{"a", small_box(0, 0, 0, 100, 100, 100)}, {"b", small_box(100.05, 0, 0, 50, 100, 100)}});
  assert_int_equal(small.look(), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "between a and b is a gap or an overlap of 0.05 mm, at (100.000"));
  assert_non_null(strstr(cw_fail_message(), "or metal thicker than 0.2 mm"));
}

// A face that leans off by 0.05 mm over 100: it touches with a part, and how far off the rest is stays known.
static void the_gap_beside_a_contact_is_measured(void **) {
  double share, gap = 0;
  gp_Trsf lean;
  lean.SetRotation(gp_Ax1(gp_Pnt(100, 0, 0), gp::DY()), 0.05 / 100);
  SmallParts small({{"a", small_box(0, 0, 0, 100, 100, 100)},
                    {"b", BRepBuilderAPI_Transform(small_box(100, 0, 0, 50, 100, 100), lean, Standard_True).Shape()}});
  if (small.look()) fail_msg("%s", cw_fail_message());
  assert_int_equal(touching(small, 1, &share), 1);
  assert_true(share > 0 && share < 1);
  for (int f = 0; f < small.survey.face_count; f++)
    if (small.contact[f].part == 0) gap = small.contact[f].gap;
  assert_true(gap > 0.03e-3 && gap < 0.051e-3);
}

// A plate of 0.5 mm beside a pipe of 1 m is no gap: the wheel's size counts, not that of all.
static void thin_metal_is_no_gap(void **) {
  double share;
  SmallParts small({{"a", small_box(0, 0, 0, 10, 10, 10)},
                    {"b", small_box(10.5, 0, 0, 10, 10, 10)},
                    {"pipe", small_box(0, 0, 50, 1000, 10, 10)}});
  if (small.look()) fail_msg("%s", cw_fail_message());
  for (int part = 0; part < 3; part++) assert_int_equal(touching(small, part, &share), 0);
}

// Two domains that overlap, beside a third: its face is told by its place in the file.
static void faces_that_touch_two_parts_are_told(void **) {
  SmallParts small({{"a", small_box(0, 0, 0, 10, 10, 10)},
                    {"b", small_box(10, 0, 0, 10, 10, 10)},
                    {"c", small_box(10, 0, 0, 5, 10, 10)}});
  assert_int_equal(small.look(), CW_ERR_GEOMETRY);
  assert_non_null(strstr(cw_fail_message(), "cad.domains: a face of a touches both b and c, at (10.000, "));
}

static void far_parts_do_not_touch(void **) {
  double share;
  SmallParts small({{"a", small_box(0, 0, 0, 100, 100, 100)}, {"b", small_box(110, 0, 0, 50, 100, 100)}});
  assert_int_equal(small.look(), CW_OK);
  assert_int_equal(touching(small, 0, &share), 0);
}

// Rings that are thinner than their chords are deep: the points that are looked from lie on the faces all the same.
static void thin_rings_touch_wholly(void **) {
  double share;
  const auto ring = [](double z) {
    return BRepAlgoAPI_Cut(small_cylinder(z, 100.3, 50), small_cylinder(z, 100, 50)).Shape();
  };
  SmallParts small({{"a", ring(0)}, {"b", ring(50)}});
  if (small.look()) fail_msg("%s", cw_fail_message());
  for (int part = 0; part < 2; part++) {
    assert_int_equal(touching(small, part, &share), 1);
    assert_near(share, 1, 0);
  }
}

// Side walls that only share an edge with the neighbour's do not touch it.
static void edges_alone_do_not_touch(void **) {
  double share;
  SmallParts small({{"a", small_box(0, 0, 0, 10, 10, 10)}, {"b", small_box(10, 10, 0, 10, 10, 10)}});
  assert_int_equal(small.look(), CW_OK);
  assert_int_equal(touching(small, 0, &share) + touching(small, 1, &share), 0);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(equal_faces_touch_wholly),
                                     cmocka_unit_test(faces_that_touch_in_part_are_cut),
                                     cmocka_unit_test(the_gap_beside_a_contact_is_measured),
                                     cmocka_unit_test(contacts_off_in_two_directions_are_cut),
                                     cmocka_unit_test(gaps_are_told_with_their_size),
                                     cmocka_unit_test(faces_that_touch_two_parts_are_told),
                                     cmocka_unit_test(far_parts_do_not_touch),
                                     cmocka_unit_test(edges_alone_do_not_touch),
                                     cmocka_unit_test(thin_rings_touch_wholly),
                                     cmocka_unit_test(thin_metal_is_no_gap)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
