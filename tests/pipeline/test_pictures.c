// SPDX-License-Identifier: AGPL-3.0-or-later
// All pictures of a mesh of two boxes with a solved flow: which there are, and what they show. The patches are those
// that most pictures take off, so that few have to be drawn.
#include "pipeline/report/pictures.h"

#include <math.h>
#include <string.h>

#include "pipeline/atomic_file.h"
#include "tests/mpi_group.h"
#include "tests/pipeline/box_run.h"
#include "tests/pipeline/png_surface.h"
#include "tests/seal_run.h"

static CwRanks ranks = {.size = 1};
static CwMesh mesh;
static CwFlow flow;
static CwReportPictures pictures;
static CwView view;

// Of two cells each in rotor and stator: pressures and velocities; y+ of the two faces of a wall.
static const double pressure[] = {25, 25, 25, 25}, velocity[12] = {0, 3, 0, 0, 3, 0, 0, 3, 0, 0, 3, 0},
                    y_plus[] = {10, 10};
static CwFoamValues walls[] = {{.patch = "shroud", .bytes = (const char *)y_plus, .count = 2}};

static void make_flow(void) {
  flow =
      (CwFlow){.present = 1,
               .density = 1000,
               .pressure = {.components = 1, .scalar_size = 8, .cells = {.bytes = (const char *)pressure, .count = 4}},
               .velocity = {.components = 3, .scalar_size = 8, .cells = {.bytes = (const char *)velocity, .count = 4}},
               .y_plus = {.components = 1, .scalar_size = 8, .patch = walls, .patch_count = 1}};
  flow.span[CW_FLOW_PRESSURE] = (CwColourSpan){0, 100, 0};
  flow.span[CW_FLOW_Y_PLUS] = (CwColourSpan){1, 100, 1};
  flow.span[CW_FLOW_SPEED] = (CwColourSpan){0, 6, 0};
  flow.first_cell = calloc(2, sizeof *flow.first_cell);
  flow.next_face = calloc(8, sizeof *flow.next_face);
  flow.first_cell[1] = 2;
}

// Walls below, above, without a face, and around.
#define FOUR(a, b, c, d) "[" WALL(a) "," WALL(b) "," WALL(c) "," WALL(d) "]"

static int draw_all(void **state) {
  const CwPumpSizes sizes = {6, INFINITY, 0.1, 0.101, 0.102, -1};
  if (make_test_folder(state)) return -1;
  assert_int_equal(cw_make_directory(in_test_folder("mesh")), CW_OK);
  write_in_run("mesh/manifest.json",
               "{\"format\":3,\"domains\":[" MESHED(
                   "rotor", "true", FOUR("shroud", "inlet", "hub", "rotor_interface"),
                   "rotor-0001.h5") "," MESHED("stator", "false",
                                               FOUR("volute", "suction_pipe", "neck", "stator_interface"),
                                               "stator-0001.h5") "],\"interfaces\":[]," FLOW "}");
  write_region("rotor", 0.03, 0.101, 7);
  write_region("stator", 0.101, 0.14, 7);
  if (seal_run(test_folder) || cw_mesh_manifest_read(test_folder, &mesh) != CW_OK) return -1;
  make_flow();
  if (cw_report_pictures_draw(&ranks, &mesh, &sizes, &flow, &pictures, &view) == CW_OK) return 0;
  fprintf(stderr, "%s\n", cw_fail_message());
  return -1;
}

static int free_all(void **state) {
  cw_report_pictures_free(&pictures);
  cw_view_free(&view);
  free(flow.first_cell);
  free(flow.next_face);
  cw_mesh_free(&mesh);
  return clear_test_folder(state);
}

static const CwReportPicture *picture_of(const char *title) {
  for (int k = 0; k < pictures.count; k++)
    if (!strcmp(pictures.picture[k].spec->title, title)) return &pictures.picture[k];
  fail_msg("no picture '%s'", title);
  return NULL;
}

// Width and height in the head of a PNG (ISO/IEC 15948): big-endian, behind 16 bytes.
static int png_size(const CwPng *png, int at) {
  const unsigned char *b = png->bytes + 16 + 4 * at;
  return b[0] << 24 | b[1] << 16 | b[2] << 8 | b[3];
}

// Why a picture cannot be drawn of this mesh, which has no blades, no hub, and no wall that is not taken off, or is not
// in the half that is cut off; NULL: it can.
static const char *lacking_of(const CwPictureSpec *spec) {
  if (spec->needs_pipes) return "the pump has no such zones, or the run no solved fields";
  if (spec->target == CW_TARGET_PLACE) return "the mesh has no such patch";
  if (spec->target == CW_TARGET_SHROUD) return "the mesh has no shroud"; // at 43 mm from the axis
  if (isfinite(cw_plane_span(spec->plane))) return "the mesh has no hub, or no shroud";
  if (spec->plane == CW_PLANE_NONE && *spec->hidden) return "the mesh has no such faces";
  return NULL;
}

static void each_picture_is_there_or_says_why(void **state) {
  int drawn = 0;
  assert_int_equal(pictures.count, cw_picture_list_count);
  for (int k = 0; k < pictures.count; k++) {
    const CwReportPicture *p = &pictures.picture[k];
    const CwPictureSpec *spec = &cw_picture_list[k];
    const char *lacking = lacking_of(spec);
    assert_ptr_equal(p->spec, spec);
    assert_int_equal(p->absent, spec->needs_pipes); // two zones have none
    assert_int_equal(p->lacking == NULL, lacking == NULL);
    assert_int_equal(p->png.bytes == NULL, lacking != NULL);
    if (lacking) assert_string_equal(p->lacking, lacking);
    if (lacking) continue;
    drawn++;
    assert_memory_equal(p->png.bytes, "\211PNG\r\n\032\n", 8);
    assert_int_equal(png_size(&p->png, 0), spec->width);
    assert_int_equal(png_size(&p->png, 1), spec->height);
  }
  assert_true(drawn > 5);
}

static void assert_legend(const char *title, const char *const *labels, int count) {
  const CwReportPicture *p = picture_of(title);
  assert_int_equal(p->legend_count, count);
  for (int k = 0; k < count; k++) assert_string_equal(p->legend[k].label, labels[k]);
}

// Patches that are to be seen, from the suction side below; kinds of cells of the zones that are; neither of close
// views and solved values.
static void legends_tell_what_is_seen(void **state) {
  const CwReportPicture *cut = picture_of("Cut z = 0");
  assert_legend("Rotor, the whole water body", (const char *const[]){"shroud", "rotor interface"}, 2);
  assert_int_equal(picture_of("Rotor, the whole water body")->legend[1].colour, cw_patch_colour("rotor_interface", 3));
  assert_legend("Stator, the whole water body", (const char *const[]){"volute", "stator interface"}, 2);
  assert_legend("Cut z = 0",
                (const char *const[]){"rotor tetrahedra", "rotor prisms", "stator tetrahedra", "stator prisms"}, 4);
  assert_int_equal(cut->legend[0].colour, cw_domain_colour(0, 2));
  assert_int_equal(cut->legend[3].colour, cw_domain_colour(1, 1));
  assert_legend("a: neck and step", NULL, 0);
  assert_legend("Relative velocity on the middle plane", NULL, 0);
  assert_legend("Rotor, obliquely", NULL, 0); // not drawn
}

static void solved_values_have_their_scale(void **state) {
  static const char *const titles[] = {"Pressure on the walls", "y+ on the walls",
                                       "Relative velocity on the middle plane"};
  for (int q = 0; q < CW_FLOW_QUANTITIES; q++) {
    const CwReportPicture *p = picture_of(titles[q]);
    assert_ptr_equal(p->scale_label, cw_flow_label[q]);
    assert_memory_equal(&p->scale, &flow.span[q], sizeof p->scale);
  }
  assert_null(picture_of("Cut z = 0")->scale_label);
  assert_int_equal(view.quantity_count, 2);
  assert_string_equal(view.quantity[0].name, "pressure");
  assert_string_equal(view.quantity[1].name, "y+");
  for (int q = 0; q < 2; q++) {
    assert_ptr_equal(view.quantity[q].label, cw_flow_label[q]);
    assert_memory_equal(&view.quantity[q].span, &flow.span[q], sizeof flow.span[q]);
  }
  assert_int_equal(view.part_count, 8);
  assert_int_equal(view.part[0].triangle_count, 2);
  for (int p = 0; p < view.part[0].point_count; p++)
    assert_in_range(view.part[0].values[1][p], 127, 128); // y+ 10 is half of the way from 1 to 100
}

// The pixels of a picture that have the colour, no part of it further off than `off`: their share of all, and the box
// about them.
typedef struct {
  double share;
  int least[2], most[2];
} Found;

static Found find(const char *title, uint32_t colour, int off) {
  Found found = {.least = {1 << 20, 1 << 20}};
  cairo_surface_t *surface = png_surface(&picture_of(title)->png);
  const int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
  for (int j = 0; j < height; j++)
    for (int i = 0; i < width; i++) {
      const int at[2] = {i, j};
      const uint32_t value = png_pixel(surface, i, j);
      int is_near = 1;
      for (int c = 0; c < 24; c += 8) is_near &= abs((int)(value >> c & 255) - (int)(colour >> c & 255)) <= off;
      if (!is_near) continue;
      found.share += 1. / (width * height);
      for (int k = 0; k < 2; k++) {
        if (at[k] < found.least[k]) found.least[k] = at[k];
        if (at[k] > found.most[k]) found.most[k] = at[k];
      }
    }
  cairo_surface_destroy(surface);
  return found;
}

// With x up and y to the right the plane z = 0 of both boxes, x from 30 to 101 and on to 140 mm, y from -20 to 20,
// fills the height but for 28 px on either side.
static void cuts_show_the_boxes(void **state) {
  const double scale = (1010 - 2 * 28) / 110., plane = 110 * 40 * scale * scale / (1560. * 1010); // px a mm
  for (int domain = 0; domain < 2; domain++) {
    const Found cut = find("Cut z = 0", cw_domain_colour(domain, 1), 0);
    assert_near(cut.share / plane, (domain ? 39 : 71) / 110., 0.03); // lines of cells and letters lie over it
    assert_near(cut.least[0], 780 - 20 * scale, 4);
    assert_near(cut.most[0], 780 + 20 * scale, 4);
    assert_near(cut.least[1], domain ? 28 : 28 + 39 * scale, 4);
    assert_near(cut.most[1], domain ? 28 + 39 * scale : 1010 - 28, 4);
  }
  // 3 m/s, as nothing turns; streamlines lie over it.
  const Found speed = find("Relative velocity on the middle plane", cw_colour_scale(0.5), 0);
  assert_true(speed.share > 0.6 * plane && speed.share < 0.95 * plane);
}

// In the meridional plane, with the axis in the middle of the picture, the neck is framed: 20 mm about a radius of
// 101.5 mm. The rotor begins 30 mm from the axis.
static void close_views_are_framed(void **state) {
  const double scale = (find("Meridional cut", cw_domain_colour(0, 1), 0).least[0] - 780) / 30.,
               high = 20 * scale * 600 / 760;
  const Found frame = find("Meridional cut", 0xb81c1c, 70);
  assert_near(frame.least[0], 780 + (101.5 - 10) * scale, 4);
  assert_near(frame.most[0], fmin(780 + (101.5 + 10) * scale, 1559), 4); // or beyond the picture
  assert_near(frame.least[1], 280 - 0.5 * high, 2);
  assert_near(frame.most[1], 280 + 0.5 * high, 2);
}

int main(int argc, char **argv) {
  begin_mpi(&argc, &argv, &ranks);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(each_picture_is_there_or_says_why),
      cmocka_unit_test(legends_tell_what_is_seen),
      cmocka_unit_test(solved_values_have_their_scale),
      cmocka_unit_test(cuts_show_the_boxes),
      cmocka_unit_test(close_views_are_framed),
  };
  return end_mpi(cmocka_run_group_tests(tests, draw_all, free_all));
}
