// SPDX-License-Identifier: AGPL-3.0-or-later
// The table of pictures agrees with itself, and colours are told apart.
#include "pipeline/report/picture_list.h"

#include <math.h>
#include <string.h>

#include "pipeline/report/flow.h"
#include "pipeline/vec.h"
#include "tests/unit_test.h"

// What goes together in a row: pictures of faces say what they leave out and from where they look, those of cells have
// a plane; what is drawn around a place has its width.
static void each_row_is_whole(void **state) {
  for (int k = 0; k < cw_picture_list_count; k++) {
    const CwPictureSpec *p = &cw_picture_list[k];
    const int faces = p->plane == CW_PLANE_NONE, solved = p->colour >= CW_COLOUR_PRESSURE;
    assert_true(p->title && *p->title);
    assert_int_equal(p->caption[strlen(p->caption) - 1], '.');
    assert_true(p->width >= 600 && p->height >= 500 && p->width > p->height);
    assert_int_equal(p->wide != 0, p->width > 1000); // over the page
    assert_true(p->sees && !(p->sees & ~(unsigned)CW_SEES_ALL));
    assert_int_equal(faces, p->hidden != NULL);
    assert_int_equal(faces, cw_norm(p->towards) > 0);
    assert_int_equal(faces, p->colour != CW_COLOUR_CUT && p->colour != CW_COLOUR_SPEED);
    assert_int_equal(solved, p->section == CW_SECTION_FLOW);
    assert_int_equal(cw_picture_is_of_flow(p), solved);
    assert_int_equal(p->colour == CW_COLOUR_REGION, p->section == CW_SECTION_DECOMPOSITION);
    assert_int_equal(p->colour == CW_COLOUR_CUT, p->section == CW_SECTION_CUT);
    assert_int_equal(p->target != CW_TARGET_ALL, p->span > 0);
    assert_true(p->span < 1);
    if (p->edges) assert_int_equal(p->section, CW_SECTION_SURFACE);
    if (p->drive_half) assert_true(faces && p->sees & CW_SEES_STATOR);
    if (p->needs_pipes) assert_true(p->sees & CW_SEES_PIPES);
    if (isfinite(cw_plane_span(p->plane))) assert_int_equal(p->sees, CW_SEES_ROTOR); // between hub and shroud
    if (!faces) continue;
    double across[3];
    cw_cross(p->towards, p->up, across);
    assert_true(cw_norm(across) > 0.3 * cw_norm(p->towards) * cw_norm(p->up)); // not parallel
    assert_true(p->towards[2] < 0);                                            // from the suction side
  }
  assert_int_equal(cw_picture_list[0].section, CW_SECTION_TITLE);
}

static void titles_and_letters_stand_once(void **state) {
  int titles = 0, insets = 0;
  for (int k = 0; k < cw_picture_list_count; k++) {
    const CwPictureSpec *p = &cw_picture_list[k];
    titles += p->section == CW_SECTION_TITLE;
    insets += p->inset_name != NULL;
    for (int i = 0; i < k; i++) {
      assert_string_not_equal(p->title, cw_picture_list[i].title);
      if (p->inset_name && cw_picture_list[i].inset_name)
        assert_string_not_equal(p->inset_name, cw_picture_list[i].inset_name);
    }
  }
  assert_int_equal(titles, 1);
  assert_int_equal(insets, 4);
}

// A close view is framed in a whole cut by the same plane of the same zones, and its title begins with its letter.
static void close_views_lie_in_their_cut(void **state) {
  for (int k = 0; k < cw_picture_list_count; k++) {
    const CwPictureSpec *inset = &cw_picture_list[k];
    if (!inset->inset_name) continue;
    assert_in_range(inset->inset_of, 0, cw_picture_list_count - 1);
    const CwPictureSpec *whole = &cw_picture_list[inset->inset_of];
    assert_null(whole->inset_name);
    assert_true(whole->wide);
    assert_int_equal(whole->target, CW_TARGET_ALL);
    assert_int_equal(whole->section, CW_SECTION_CUT);
    assert_int_equal(whole->plane, inset->plane);
    assert_int_equal(whole->sees, inset->sees);
    assert_int_equal(strncmp(inset->title, inset->inset_name, strlen(inset->inset_name)), 0);
    assert_int_equal(inset->title[strlen(inset->inset_name)], ':');
  }
}

// Colours of the flow are those of its quantities, in their order.
static void flow_colours_are_its_quantities(void **state) {
  assert_int_equal(CW_COLOUR_PRESSURE + CW_FLOW_PRESSURE, CW_COLOUR_PRESSURE);
  assert_int_equal(CW_COLOUR_PRESSURE + CW_FLOW_Y_PLUS, CW_COLOUR_Y_PLUS);
  assert_int_equal(CW_COLOUR_PRESSURE + CW_FLOW_SPEED, CW_COLOUR_SPEED);
}

static void surfaces_of_the_span_lie_between_the_walls(void **state) {
  const double near_hub = cw_plane_span(CW_PLANE_NEAR_HUB), middle = cw_plane_span(CW_PLANE_MID_SPAN),
               near_shroud = cw_plane_span(CW_PLANE_NEAR_SHROUD);
  assert_true(0 < near_hub && near_hub < middle && middle < near_shroud && near_shroud < 1);
  assert_near(middle, 0.5, 0);
  assert_near(near_hub, 1 - near_shroud, 1e-15);
  for (int plane = CW_PLANE_NONE; plane < CW_PLANE_NEAR_HUB; plane++)
    assert_true(isnan(cw_plane_span((CwPicturePlane)plane)));
}

// Whole names are left out, and nothing where the list is empty.
static void whole_names_are_hidden(void **state) {
  const CwPictureSpec some = {.hidden = "|shroud|hub_nut|inlet|"}, none = {.hidden = ""};
  static const char *const in[] = {"shroud", "hub_nut", "inlet"}, *const out[] = {"hub", "nut", "shroud_2",
                                                                                  "inlet_pipe"};
  for (int k = 0; k < 3; k++) assert_true(cw_picture_hides(&some, in[k]));
  for (int k = 0; k < 4; k++) assert_false(cw_picture_hides(&some, out[k]));
  for (int k = 0; k < 3; k++) assert_false(cw_picture_hides(&none, in[k]));
  // The open rotor shows blades and hub without what covers them; the open pump no interface either.
  const CwPictureSpec *open = &cw_picture_list[1], *title = &cw_picture_list[0];
  assert_true(cw_picture_hides(open, "shroud") && cw_picture_hides(title, "shroud"));
  assert_true(cw_picture_hides(title, "stator_interface"));
  assert_false(cw_picture_hides(open, "blade_pressure") || cw_picture_hides(open, "hub"));
}

// Both sides of an interface are alike, the faces of a blade are not; who is not known has the colour of a number.
static void patches_have_colours(void **state) {
  static const char *const blade[] = {"blade_pressure",      "blade_suction", "blade_leading_edge",
                                      "blade_trailing_edge", "hub",           "shroud"};
  static const char *const sides[][2] = {{"rotor_interface", "stator_interface"},
                                         {"rotor_to_suction", "suction_to_rotor"},
                                         {"stator_to_discharge", "discharge_to_stator"}};
  for (int a = 0; a < 6; a++)
    for (int b = 0; b < a; b++) assert_int_not_equal(cw_patch_colour(blade[a], 0), cw_patch_colour(blade[b], 0));
  for (int k = 0; k < 3; k++) assert_int_equal(cw_patch_colour(sides[k][0], 1), cw_patch_colour(sides[k][1], 7));
  for (int k = 0; k < 5; k++) assert_int_equal(cw_patch_colour("a_wall", k), cw_region_colour(k));
  assert_int_not_equal(cw_patch_colour("hub", 3), cw_region_colour(3));
}

// Hue of a colour in turns, with its least and most of red, green and blue (0 to 1).
static double hue_of(uint32_t colour, double *least, double *most) {
  const double c[3] = {(colour >> 16 & 255) / 255., (colour >> 8 & 255) / 255., (colour & 255) / 255.};
  int top = 0;
  *least = fmin(fmin(c[0], c[1]), c[2]);
  *most = fmax(fmax(c[0], c[1]), c[2]);
  for (int k = 1; k < 3; k++)
    if (c[k] > c[top]) top = k;
  const double hue = (2 * top + (c[(top + 1) % 3] - c[(top + 2) % 3]) / (*most - *least)) / 6;
  return hue - floor(hue);
}

// From one to the next the hue goes on by the golden section of the circle; odd ones are darker.
static void regions_go_round_the_circle(void **state) {
  for (int index = 0; index < 100; index++) {
    double least[2], most[2];
    const double here = hue_of(cw_region_colour(index), &least[0], &most[0]),
                 next = hue_of(cw_region_colour(index + 1), &least[1], &most[1]),
                 step = next - here - (sqrt(5) - 1) / 2;
    assert_near(step - round(step), 0, 0.01);
    const int dark = 1 - index % 2; // which of both
    assert_true(most[dark] < most[1 - dark] && least[dark] < least[1 - dark]);
  }
}

// Prisms are paler than the full colour, tetrahedra paler than prisms; zones beside one another differ.
static void zones_have_shades(void **state) {
  for (int d = 0; d < 8; d++) {
    uint32_t light[3];
    for (int shade = 0; shade < 3; shade++) {
      const uint32_t c = cw_domain_colour(d, shade);
      assert_true(c <= 0xffffff);
      light[shade] = (c >> 16 & 255) + (c >> 8 & 255) + (c & 255);
      assert_int_not_equal(c, cw_domain_colour(d + 1, shade));
    }
    assert_true(light[0] < light[1] && light[1] < light[2]);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_row_is_whole),
      cmocka_unit_test(titles_and_letters_stand_once),
      cmocka_unit_test(close_views_lie_in_their_cut),
      cmocka_unit_test(flow_colours_are_its_quantities),
      cmocka_unit_test(surfaces_of_the_span_lie_between_the_walls),
      cmocka_unit_test(whole_names_are_hidden),
      cmocka_unit_test(patches_have_colours),
      cmocka_unit_test(regions_go_round_the_circle),
      cmocka_unit_test(zones_have_shades),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
