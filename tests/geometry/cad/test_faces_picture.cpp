// SPDX-License-Identifier: AGPL-3.0-or-later
// Every face of a part has its number in the picture, no other part's has.
#include <fstream>
#include <iterator>

#include "cad/small_parts.hpp"
#include "tests/test_folder.h"

extern "C" {
#include "geometry/cad/faces_picture.h"
}

static std::string picture_of(SmallParts &small, int part, const double *place) {
  const std::string path = in_test_folder("faces.svg");
  if (small.look() || cw_faces_picture_write(&small.survey, part, "of a <test>", place, path.c_str()))
    fail_msg("%s", cw_fail_message());
  std::ifstream in(path);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  remove(path.c_str());
  return text;
}

static int count(const std::string &text, const std::string &word) {
  int found = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) found++;
  return found;
}

static void each_face_has_its_number(void **) {
  SmallParts small({{"rotor", small_rotor()}, {"stator", small_stator()}});
  const std::string text = picture_of(small, 0, nullptr);
  assert_int_equal(count(text, "<image "), 8);
  assert_int_equal(count(text, "of a &lt;test&gt;"), 1);
  for (int f = 0; f < small.survey.face_count; f++) {
    const int numbers = count(text, ">" + std::to_string(f + 1) + "</text>");
    assert_int_equal(numbers > 0, small.survey.face[f].part == 0);
  }
  assert_int_equal(count(text, "seen from nowhere"), 0);
  assert_int_equal(text.compare(text.size() - 7, 7, "</svg>\n"), 0);
}

static void a_place_is_marked_in_each_view(void **) {
  SmallParts small({{"water", small_box(0, 0, 0, 10, 20, 30)}});
  const double place[] = {0.01, 0.02, 0.03};
  const std::string plain = picture_of(small, 0, nullptr), marked = picture_of(small, 0, place);
  assert_int_equal(count(plain, "<circle "), 0);
  assert_int_equal(count(marked, "<circle "), 8);
  assert_int_equal(count(marked, "<polyline ") - count(plain, "<polyline "), 16); // a cross in each
}

// The outline of a bow tie crosses itself: no triangles, but its four edges in each view.
static void edges_of_faces_without_triangles_are_drawn(void **) {
  SmallParts small({{"water", small_bow_tie()}});
  assert_int_equal(cw_survey_make(&small.parts, &small_frame, &small.survey), CW_ERR_GEOMETRY);
  const std::string path = in_test_folder("faces.svg");
  if (cw_faces_picture_write(&small.survey, 0, "tie", nullptr, path.c_str())) fail_msg("%s", cw_fail_message());
  std::ifstream in(path);
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  assert_true(count(text, "<polyline ") >= 8 * small.survey.segment_count);
  assert_true(small.survey.segment_count >= 4);
  remove(path.c_str());
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(each_face_has_its_number),
                                     cmocka_unit_test(a_place_is_marked_in_each_view),
                                     cmocka_unit_test(edges_of_faces_without_triangles_are_drawn)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
