// SPDX-License-Identifier: AGPL-3.0-or-later
// Areas, forms and edges of a box, a pipe and a step, by hand.

#include "cad/small_parts.hpp"

static const double mm = 1e-3;

static void a_box_has_planes_and_right_angles(void **) {
  SmallParts small({{"water", small_box(10, 20, 30, 2, 3, 4)}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_OK);
  assert_near(small.survey.size, 4 * mm, 1e-9); // the longest side
  assert_int_equal(small.survey.face_count, 6);
  assert_int_equal(small.survey.edge_count, 12);
  double area = 0, length = 0;
  for (int f = 0; f < 6; f++) {
    const CwSurveyFace &face = small.survey.face[f];
    area += face.area;
    assert_int_equal(face.form, CW_FORM_PLANE);
    assert_int_equal(face.turned, std::fabs(face.normal[2]) > 0.5); // across the axis
    const double middle[] = {11 * mm, 21.5 * mm, 32 * mm};
    double outward = 0;
    for (int i = 0; i < 3; i++) outward += face.normal[i] * (face.at[i] - middle[i]);
    assert_true(outward > 0);
  }
  assert_near(area, 52 * mm * mm, 1e-12);
  for (int e = 0; e < 12; e++) {
    length += small.survey.edge[e].length;
    assert_near(small.survey.edge[e].angle, M_PI / 2, 1e-9);
  }
  assert_near(length, 36 * mm, 1e-12);
}

// Into a notch the water has three right angles.
static void notches_are_concave(void **) {
  SmallParts small({{"water", BRepAlgoAPI_Cut(small_box(0, 0, 0, 4, 4, 4), small_box(2, 2, -1, 4, 4, 6)).Shape()}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_OK);
  int concave = 0;
  for (int e = 0; e < small.survey.edge_count; e++)
    if (small.survey.edge[e].angle > M_PI) {
      concave++;
      assert_near(small.survey.edge[e].angle, 3 * M_PI / 2, 1e-9);
    }
  assert_int_equal(concave, 1);
}

static void pipes_are_revolved(void **) {
  SmallParts small({{"water", small_cylinder(-3, 5, 10)}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_OK);
  int revolved = 0;
  for (int f = 0; f < small.survey.face_count; f++) {
    const CwSurveyFace &face = small.survey.face[f];
    assert_true(face.turned);
    assert_near(face.mean_radius, face.form == CW_FORM_REVOLVED ? 5 * mm : 5 * mm / std::sqrt(2), 1e-6); // of a disc
    if (face.form != CW_FORM_REVOLVED) continue;
    revolved++;
    assert_near(face.area, 2 * M_PI * 5 * 10 * mm * mm, 1e-10);
    assert_near(face.radius[0], 5 * mm, 1e-9);
    assert_near(face.height[0], -3 * mm, 1e-9);
    assert_near(face.height[1], 7 * mm, 1e-9);
  }
  assert_int_equal(revolved, 1);
}

// The ends of a ring that is narrower than its chords are deep, 0.2 mm: no triangle has its middle on them.
static void narrow_rings_have_a_point(void **) {
  SmallParts small({{"water", BRepAlgoAPI_Cut(small_cylinder(0, 100.05, 50), small_cylinder(0, 100, 50)).Shape()}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_OK);
  int ends = 0;
  for (int f = 0; f < small.survey.face_count; f++) {
    const CwSurveyFace &face = small.survey.face[f];
    const double r = std::hypot(face.at[0], face.at[1]);
    assert_true(r > 99.999999 * mm && r < 100.050001 * mm);
    if (face.form != CW_FORM_PLANE) continue;
    ends++;
    assert_true(r > 100 * mm && r < 100.05 * mm);
    assert_near(face.at[2], face.normal[2] > 0 ? 50 * mm : 0, 1e-9);
  }
  assert_int_equal(ends, 2);
}

// The outline of a bow tie crosses itself: no triangles. The file's origin is at x = 100 mm of the pump.
static void faces_without_triangles_are_told_with_their_place(void **) {
  const CwCadFrame frame = {{-100 * mm, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0};
  SmallParts small({{"water", small_bow_tie()}});
  small.parts.part[0].origin[0].name = "LID";
  assert_int_equal(cw_survey_make(&small.parts, &frame, &small.survey), CW_ERR_GEOMETRY);
  const char *told = strstr(cw_fail_message(), "cad.domains.water: a face with a corner at (-9");
  assert_non_null(told);
  assert_non_null(strstr(told, ", 3.000) mm cannot be triangulated: face 1 'LID'; allowed"));
  double length = 0;
  for (int s = 0; s < small.survey.segment_count; s++) {
    const CwSurveySegment &segment = small.survey.segment[s];
    assert_int_equal(segment.face, 0);
    length += std::hypot(segment.at[1][0] - segment.at[0][0], segment.at[1][1] - segment.at[0][1]);
  }
  assert_near(length, (2 + 2 * std::sqrt(2)) * mm, 1e-9);
}

// Of a pipe beside the axis nothing is revolved; the blade-like wall has a twist where it looks along the rotation.
static void off_the_axis_nothing_is_revolved(void **) {
  gp_Trsf aside;
  aside.SetTranslation(gp_Vec(20, 0, 0));
  SmallParts small({{"water", BRepBuilderAPI_Transform(small_cylinder(0, 5, 10), aside, Standard_True).Shape()}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_OK);
  for (int f = 0; f < small.survey.face_count; f++) assert_int_not_equal(small.survey.face[f].form, CW_FORM_REVOLVED);
}

static void the_nearest_face_is_found(void **) {
  SmallParts small({{"water", small_box(0, 0, 0, 10, 10, 10)}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_OK);
  const double at[] = {5 * mm, 4 * mm, 10.5 * mm};
  int face;
  double distance;
  int number[6] = {0, 1, 2, 3, 4, 5};
  CwSurveyNext next = {number, -1, 0};
  assert_int_equal(cw_survey_nearest(&small.survey, -1, at, 1, &face, &distance, &next), CW_OK);
  assert_near(small.survey.face[face].normal[2], 1, 1e-12);
  assert_near(distance, 0.5 * mm, 1e-12);
  assert_near(next.distance, std::hypot(4, 0.5) * mm, 1e-12);
  assert_near(small.survey.face[next.face].normal[1], -1, 1e-12);
  number[next.face] = number[face]; // a piece of the nearest one
  assert_int_equal(cw_survey_nearest(&small.survey, -1, at, 1, &face, &distance, &next), CW_OK);
  assert_near(small.survey.face[face].normal[2], 1, 1e-12);
  assert_near(next.distance, std::hypot(5, 0.5) * mm, 1e-12);
  assert_int_equal(cw_survey_nearest(&small.survey, -1, at, 0.1 * mm, &face, &distance, nullptr), CW_OK);
  assert_int_equal(face, -1);
}

// A place 0.55 mm off a pipe is not within a little less, however the quotient of reach and unit is rounded.
static void no_face_is_nearer_than_it_is(void **) {
  SmallParts small({{"water", small_cylinder(0, 10, 20)}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_OK);
  const double at[] = {10.55 * mm * std::sqrt(0.5), 10.55 * mm * std::sqrt(0.5), 10 * mm};
  int face;
  double distance;
  for (int i = 1; i < 1000; i++) {
    assert_int_equal(cw_survey_nearest(&small.survey, -1, at, 0.55 * mm * (1 - 1e-5 * i), &face, &distance, nullptr),
                     CW_OK);
    assert_int_equal(face, -1);
  }
  assert_int_equal(cw_survey_nearest(&small.survey, -1, at, 0.56 * mm, &face, &distance, nullptr), CW_OK);
  assert_int_equal(small.survey.face[face].form, CW_FORM_REVOLVED);
  assert_near(distance, 0.55 * mm, 1e-9);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_box_has_planes_and_right_angles),
                                     cmocka_unit_test(notches_are_concave),
                                     cmocka_unit_test(pipes_are_revolved),
                                     cmocka_unit_test(narrow_rings_have_a_point),
                                     cmocka_unit_test(faces_without_triangles_are_told_with_their_place),
                                     cmocka_unit_test(off_the_axis_nothing_is_revolved),
                                     cmocka_unit_test(the_nearest_face_is_found),
                                     cmocka_unit_test(no_face_is_nearer_than_it_is)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
