// SPDX-License-Identifier: AGPL-3.0-or-later
// Pictures of a section as figures, and what stands in the place of those that could not be drawn.
#include "tests/pipeline/page_text.h"

static const CwPictureSpec wide = {
    .section = CW_SECTION_CUT, .title = "Cut & z", .caption = "From <above>.", .wide = 1, .width = 1560, .height = 560};
static const CwPictureSpec narrow = {
    .section = CW_SECTION_CUT, .title = "Detail", .caption = "Close.", .width = 760, .height = 600};
static const CwPictureSpec other = {.section = CW_SECTION_FLOW, .title = "Pressure", .width = 760, .height = 640};

static CwStatus cuts(FILE *page, const CwReportData *data) {
  cw_page_picture_list(page, data, CW_SECTION_CUT);
  return CW_OK;
}

static CwStatus flows(FILE *page, const CwReportData *data) {
  cw_page_picture_list(page, data, CW_SECTION_FLOW);
  return CW_OK;
}

static char *page_with(CwReportPicture *pictures, int count, PagePart part) {
  const CwReportData data = {.pictures = {.picture = pictures, .count = count}};
  return page_of(part, &data);
}

// The bytes 0 to 4 are AAECAwQ= in base 64 (RFC 4648).
static void a_picture_is_in_the_page(void **state) {
  unsigned char bytes[] = {0, 1, 2, 3, 4};
  CwReportPicture picture = {.spec = &wide, .png = {bytes, sizeof bytes}};
  char *page = page_with(&picture, 1, cuts);
  assert_string_equal(page,
                      "<div class=\"grid\">\n<figure class=\"wide\"><img width=\"1560\" height=\"560\" "
                      "alt=\"Cut &amp; z\" src=\"data:image/png;base64,AAECAwQ=\"><figcaption><b>Cut &amp; z.</b> "
                      "From &lt;above&gt;.</figcaption></figure>\n</div>\n");
  free(page);
}

static void sections_have_their_own(void **state) {
  CwReportPicture pictures[] = {{.spec = &wide}, {.spec = &other}, {.spec = &narrow}, {.spec = &narrow, .absent = 1}};
  char *page = page_with(pictures, 4, cuts);
  assert_int_equal(count_in(page, "<figure"), 2); // what this pump has no zones for is left out
  assert_int_equal(count_in(page, "class=\"wide\""), 1);
  assert_true(strstr(page, "Cut &amp; z.</b>") < strstr(page, "Detail.</b>"));
  assert_holds(page, "<figure><img width=\"760\" height=\"600\" alt=\"Detail\"");
  assert_null(strstr(page, "Pressure"));
  free(page);
  page = page_with(pictures, 4, flows);
  assert_int_equal(count_in(page, "<figure"), 1);
  assert_holds(page, "Pressure.</b>");
  free(page);
}

static void what_could_not_be_drawn_says_why(void **state) {
  CwReportPicture picture = {
      .spec = &narrow, .lacking = "the mesh has no <such> patch", .scale_label = "m/s", .scale = {0, 1, 0}};
  char *page = page_with(&picture, 1, cuts);
  assert_holds(page, "<figure><div class=\"lacking\">Not drawn: the mesh has no &lt;such&gt; patch.</div><figcaption>");
  assert_null(strstr(page, "<img"));
  assert_null(strstr(page, "<svg")); // no scale without a picture
  free(page);
}

static void scale_and_legend_follow(void **state) {
  CwReportPicture picture = {.spec = &narrow,
                             .scale_label = "speed, m/s",
                             .scale = {0, 8, 0},
                             .legend = {{"rotor & hub", 0x0102ff}, {"prisms", 0xabcdef}},
                             .legend_count = 2};
  char *page = page_with(&picture, 1, cuts);
  assert_holds(page, "speed, m/s");
  assert_int_equal(count_in(page, "<svg"), 1);
  assert_holds(page, "<div class=\"key\"><span><i style=\"background:#0102ff\"></i>rotor &amp; hub</span>"
                     "<span><i style=\"background:#abcdef\"></i>prisms</span></div></figure>\n");
  free(page);
  picture.scale_label = NULL;
  picture.legend_count = 0;
  page = page_with(&picture, 1, cuts);
  assert_null(strstr(page, "<svg"));
  assert_null(strstr(page, "class=\"key\""));
  free(page);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_picture_is_in_the_page),
      cmocka_unit_test(sections_have_their_own),
      cmocka_unit_test(what_could_not_be_drawn_says_why),
      cmocka_unit_test(scale_and_legend_follow),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
