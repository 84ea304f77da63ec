// SPDX-License-Identifier: AGPL-3.0-or-later
// Views, faces and cut cells of single pictures, sample by sample on their canvas.
#include "pipeline/report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/pipeline/surveyed_walls.h"
#include "tests/unit_test.h"

enum { WIDTH = 100, HEIGHT = 80, WHITE = 0xffffff };
enum { ROTOR, STATOR, PIPE, DOMAINS };

static CwModelPatch patches[] = {{.name = "hub", .kind = CW_PATCH_WALL, .domain = ROTOR},
                                 {.name = "shroud", .kind = CW_PATCH_WALL, .domain = ROTOR},
                                 {.name = "volute", .kind = CW_PATCH_WALL, .domain = STATOR},
                                 {.name = "inlet_pipe", .kind = CW_PATCH_WALL, .domain = PIPE}};
static const CwMesh mesh = {.domain_count = DOMAINS,
                            .domains = {{.name = "rotor", .rotating = 1, .patch_count = 2},
                                        {.name = "stator", .first_patch = 2, .patch_count = 1},
                                        {.name = "pipe", .first_patch = 3, .patch_count = 1}},
                            .patch_count = 4,
                            .patches = patches};
static const CwPumpSizes sizes = {2, 0.05, 0.1, 0.101, 0.103, -1};
static CwSurvey survey;
static CwDrawing drawing;

// Begins a picture; of the flow with velocities.
static void start(const CwPictureSpec *spec) {
  memset(&drawing, 0, sizeof drawing);
  cw_drawing_start(spec, &mesh, &survey, &drawing);
  assert_int_equal(cw_render_start(spec->width, spec->height, WHITE, spec->plane == CW_PLANE_NONE, &drawing.canvas),
                   CW_OK);
  if (spec->colour == CW_COLOUR_SPEED) assert_int_equal(cw_render_keep_velocity(&drawing.canvas), CW_OK);
}

static void end(void) {
  cw_render_free(&drawing.canvas);
}

static int begin_survey(void **state) {
  cw_survey_start(&survey, &sizes);
  return 0;
}

// What the canvas shows where a point of the pump lies.
static uint32_t colour_at(double x, double y, double z) {
  double p[3];
  cw_camera_project(&drawing.camera, (double[]){x, y, z}, p);
  const int column = (int)floor(p[0] * CW_RENDER_SAMPLES), row = (int)floor(p[1] * CW_RENDER_SAMPLES);
  assert_true(column >= 0 && column < drawing.canvas.columns && row >= 0 && row < drawing.canvas.rows);
  const size_t at = (size_t)row * (size_t)drawing.canvas.columns + (size_t)column;
  return drawing.canvas.group[at] ? drawing.canvas.colour[at] : drawing.canvas.background;
}

static int group_at(double x, double y, double z) {
  double p[3];
  cw_camera_project(&drawing.camera, (double[]){x, y, z}, p);
  return drawing.canvas.group[(size_t)floor(p[1] * CW_RENDER_SAMPLES) * (size_t)drawing.canvas.columns +
                              (size_t)floor(p[0] * CW_RENDER_SAMPLES)];
}

// Along the axis, of all that it sees, as wide as 0.25 m.
static CwPictureSpec along_axis(void) {
  return (CwPictureSpec){.width = WIDTH,
                         .height = HEIGHT,
                         .sees = CW_SEES_ALL,
                         .hidden = "",
                         .target = CW_TARGET_PLACE,
                         .span = 1.25,
                         .towards = {0, 0, -1},
                         .up = {1, 0, 0}};
}

// The camera of a picture that hangs on no place, and its plane.
static void look_from(CwPictureSpec *spec) {
  start(spec);
  drawing.camera.metres_per_pixel = 0.25 / spec->width;
  memset(drawing.camera.centre, 0, sizeof drawing.camera.centre);
  drawing.lacking = NULL;
}

// A square of two triangles and one of one quadrilateral, both facing -z at z; the first from x = -0.1 to 0, the other
// on to 0.1, y from -0.05 to 0.05. Patches by face: 0, 0 and 1 of the domain.
static double square_x[6][3];
static int32_t square_triangles[2][3] = {{0, 3, 1}, {1, 3, 4}}, square_quad[1][4] = {{1, 4, 5, 2}};
static int32_t triangle_patch[2], quad_patch[1];

static CwRegionData squares(int domain, double z, int last_patch) {
  static const double x[] = {-0.1, 0, 0.1};
  for (int k = 0; k < 6; k++) memcpy(square_x[k], (double[]){x[k % 3], k < 3 ? -0.05 : 0.05, z}, sizeof *square_x);
  quad_patch[0] = last_patch;
  return (CwRegionData){.domain = domain,
                        .points = square_x,
                        .point_count = 6,
                        .triangles = square_triangles,
                        .triangle_count = 2,
                        .quads = square_quad,
                        .quad_count = 1,
                        .triangle_patch = triangle_patch,
                        .quad_patch = quad_patch};
}

static void add(const CwRegionData *surface, int region, double *const share[2]) {
  assert_int_equal(cw_drawing_add_faces(&drawing, region, surface, share), CW_OK);
}

// Of the light (-0.37, 0.46, 0.81) a face that looks at the viewer gets 0.81: 0.5 + 0.56 * 0.81 of its colour.
static uint32_t lit(uint32_t colour) {
  return cw_render_shade(colour, 0.5 + 0.56 * 0.81);
}

static void faces_have_the_colours_of_their_patches(void **state) {
  CwPictureSpec spec = along_axis();
  const CwRegionData surface = squares(ROTOR, 0, 1);
  look_from(&spec);
  add(&surface, 7, NULL);
  assert_int_equal(colour_at(-0.07, 0.03, 0), lit(cw_patch_colour("hub", 0)));
  assert_int_equal(colour_at(-0.03, -0.03, 0), lit(cw_patch_colour("hub", 0)));
  assert_int_equal(colour_at(0.05, 0.02, 0), lit(cw_patch_colour("shroud", 1)));
  assert_int_equal(colour_at(0, 0.07, 0), WHITE);
  cw_drawing_mark_seen(&drawing);
  assert_true(drawing.seen[ROTOR][0] && drawing.seen[ROTOR][1]);
  assert_false(drawing.seen[STATOR][0] || drawing.seen[ROTOR][2]);
  end();
  // What is hidden is not drawn, and not seen.
  spec.hidden = "|shroud|";
  look_from(&spec);
  add(&surface, 7, NULL);
  assert_int_equal(colour_at(0.05, 0.02, 0), WHITE);
  cw_drawing_mark_seen(&drawing);
  assert_true(drawing.seen[ROTOR][0] && !drawing.seen[ROTOR][1]);
  end();
  // Patches are counted in each zone.
  const CwRegionData volute = squares(STATOR, 0, 0);
  look_from(&spec);
  add(&volute, 7, NULL);
  assert_int_equal(colour_at(0.05, 0.02, 0), lit(cw_patch_colour("volute", 0)));
  cw_drawing_mark_seen(&drawing);
  assert_true(drawing.seen[STATOR][0] && !drawing.seen[ROTOR][0] && !drawing.seen[ROTOR][1]);
  end();
  // From the other side the light comes from there.
  spec.towards[2] = 1;
  look_from(&spec);
  add(&volute, 7, NULL);
  assert_int_equal(colour_at(-0.07, 0.03, 0), lit(cw_patch_colour("volute", 0)));
  end();
}

// Along x the same square is seen from its edge; turned by 45 degrees it gets the light of its own direction.
static void light_follows_the_normal(void **state) {
  CwPictureSpec spec = along_axis();
  const CwRegionData surface = squares(ROTOR, 0, 0);
  memcpy(spec.towards, (double[]){1, 0, -1}, sizeof spec.towards); // up then is (1, 0, 1): the square looks down
  look_from(&spec);
  add(&surface, 0, NULL);
  // The normal towards the viewer is (0, 0, -1): right 0, up -0.707, towards 0.707.
  const double cosine = -0.46 * M_SQRT1_2 + 0.81 * M_SQRT1_2;
  assert_int_equal(colour_at(-0.05, 0.02, 0), cw_render_shade(cw_patch_colour("hub", 0), 0.5 + 0.56 * cosine));
  end();
}

// Faces of regions have the colour of their number, and groups by which the numbers are written on them.
static void regions_have_their_colours(void **state) {
  CwPictureSpec spec = along_axis();
  spec.colour = CW_COLOUR_REGION;
  look_from(&spec);
  const CwRegionData surface = squares(STATOR, 0, 0);
  add(&surface, 4, NULL);
  assert_int_equal(colour_at(-0.07, 0.03, 0), lit(cw_region_colour(4)));
  assert_int_equal(group_at(-0.07, 0.03, 0), 5);
  end();
}

// Of a face seen from without the water, which is the metal of a blade, the rotor's is marked to be left white.
static void metal_is_marked(void **state) {
  CwPictureSpec spec = along_axis();
  spec.hollow_white = 1;
  for (int outside = 0; outside < 2; outside++) {
    spec.towards[2] = outside ? -1 : 1;
    for (int domain = ROTOR; domain <= STATOR; domain++) {
      look_from(&spec);
      const CwRegionData surface = squares(domain, 0, 0);
      add(&surface, 0, NULL);
      assert_int_equal(group_at(-0.07, 0.03, 0) == CW_DRAWING_METAL, outside && domain == ROTOR);
      end();
    }
  }
}

// Shares of the scale by face, triangles before quadrilaterals; no value, no colour.
static void solved_values_have_the_colours_of_the_scale(void **state) {
  CwPictureSpec spec = along_axis();
  double pressure[] = {0.2, 0.2, 0.9}, y_plus[] = {0.7, 0.7, NAN};
  double *const share[2] = {pressure, y_plus};
  const CwRegionData surface = squares(ROTOR, 0, 1);
  spec.colour = CW_COLOUR_PRESSURE;
  look_from(&spec);
  add(&surface, 0, share);
  assert_int_equal(colour_at(-0.07, 0.03, 0), lit(cw_colour_scale(0.2)));
  assert_int_equal(colour_at(0.05, 0.02, 0), lit(cw_colour_scale(0.9)));
  end();
  spec.colour = CW_COLOUR_Y_PLUS;
  look_from(&spec);
  add(&surface, 0, share);
  assert_int_equal(colour_at(-0.07, 0.03, 0), lit(cw_colour_scale(0.7)));
  const uint32_t bare = colour_at(0.05, 0.02, 0);
  for (int k = 0; k <= 100; k++) assert_int_not_equal(bare, lit(cw_colour_scale(k / 100.)));
  assert_int_not_equal(bare, WHITE);
  end();
}

// A wall at x = 0.05 from z = -0.05 to 0.05, or what of it lies off z = 0 on one side: of a stator that is cut nothing
// is left on the side of the suction, wherever that is, and all on the other; of a rotor, and uncut, all.
static void check_cut(int side, int cut, int domain, double from, double to) {
  double x[4][3] = {{0.05, -0.05, from}, {0.05, 0.05, from}, {0.05, 0.05, to}, {0.05, -0.05, to}};
  int32_t quad[1][4] = {{0, 1, 2, 3}}, patch[1] = {0};
  const CwRegionData wall = {
      .domain = domain, .points = x, .point_count = 4, .quads = quad, .quad_count = 1, .quad_patch = patch};
  CwPictureSpec spec = along_axis();
  memcpy(spec.towards, (double[]){1, 0, 0}, sizeof spec.towards);
  memcpy(spec.up, (double[]){0, 0, 1}, sizeof spec.up);
  spec.drive_half = cut;
  survey.sizes.suction = side;
  look_from(&spec);
  add(&wall, 0, NULL);
  for (int k = -20; k < 20; k++) {
    const double z = 0.002 * k + 0.001;
    const int gone = (cut && domain == STATOR && z * side > 0) || z < from || z > to;
    assert_int_equal(colour_at(0.05, 0.02, z) == WHITE, gone);
  }
  end();
}

static void the_suction_half_of_the_stator_is_cut_off(void **state) {
  for (int side = -1; side <= 1; side += 2)
    for (int cut = 0; cut < 2; cut++)
      for (int domain = ROTOR; domain <= STATOR; domain++) {
        check_cut(side, cut, domain, -0.05, 0.05);
        check_cut(side, cut, domain, -0.05, -0.01);
        check_cut(side, cut, domain, 0.01, 0.05);
      }
  survey.sizes.suction = -1;
}

// Zones: what turns, the first that does not, all others.
static void pictures_see_their_zones(void **state) {
  const CwPictureSpec spec = along_axis();
  look_from(&(CwPictureSpec){.width = 10, .height = 10, .hidden = "", .towards = {0, 0, -1}, .up = {1, 0, 0}});
  assert_int_equal(drawing.part[ROTOR], CW_SEES_ROTOR);
  assert_int_equal(drawing.part[STATOR], CW_SEES_STATOR);
  assert_int_equal(drawing.part[PIPE], CW_SEES_PIPES);
  end();
  // A view of all reaches over the faces that it shows, and no others.
  CwPictureSpec all = spec;
  all.target = CW_TARGET_ALL;
  all.sees = CW_SEES_ROTOR | CW_SEES_STATOR;
  all.hidden = "|shroud|";
  start(&all);
  const CwRegionData pipe = squares(PIPE, 0, 0);
  cw_drawing_reach(&drawing, &pipe);
  assert_false(drawing.reach.started);
  const CwRegionData rotor = squares(ROTOR, 0, 1);
  cw_drawing_reach(&drawing, &rotor); // up is x: the hub's square from -0.1 to 0
  assert_true(drawing.reach.started);
  assert_near(drawing.reach.least[1], -0.1, 1e-12);
  assert_near(drawing.reach.most[1], 0, 1e-12);
  assert_near(drawing.reach.most[0], 0.05, 1e-12);
  end();
  all.target = CW_TARGET_PLACE; // has its place, and its width
  start(&all);
  cw_drawing_reach(&drawing, &rotor);
  assert_false(drawing.reach.started);
  end();
}

// A place stands in the middle, the view turned with it; the picture is as wide as its share of the outlet diameter.
static void views_stand_at_their_places(void **state) {
  survey_walls(&sizes, &survey);
  CwPictureSpec spec = along_axis();
  spec.place = CW_PLACE_TRAILING_EDGE;
  spec.span = 0.1;
  memcpy(spec.towards, (double[]){1, 0.5, -0.7}, sizeof spec.towards);
  memcpy(spec.up, (double[]){0, 0, -1}, sizeof spec.up);
  start(&spec);
  assert_null(drawing.lacking);
  assert_near(drawing.camera.centre[0], 0, 1e-9);
  assert_near(drawing.camera.centre[1], 0.1, 1e-9);
  assert_near(drawing.camera.centre[2], 0.004 / 3, 1e-9);
  assert_near(drawing.camera.metres_per_pixel * WIDTH, 0.1 * 0.2, 1e-12);
  // Along radius (y here), rotation (-x) and axis.
  const double length = sqrt(1 + 0.25 + 0.49);
  assert_near(drawing.camera.towards[0], -0.5 / length, 1e-9);
  assert_near(drawing.camera.towards[1], 1 / length, 1e-9);
  assert_near(drawing.camera.towards[2], -0.7 / length, 1e-12);
  end();
  survey.sizes.suction = 1; // the same in the mirror z = 0
  start(&spec);
  assert_near(drawing.camera.towards[2], 0.7 / length, 1e-12);
  assert_true(drawing.camera.up[2] > 0.4);
  end();
  survey.sizes.suction = -1;
  spec.place = CW_PLACE_TONGUE;
  start(&spec);
  assert_string_equal(drawing.lacking, "the mesh has no such patch");
  end();
  // At the neck: midway between interface and base, in the meridional plane, at half a pitch from the blade.
  spec = (CwPictureSpec){.width = WIDTH,
                         .height = HEIGHT,
                         .sees = CW_SEES_ALL,
                         .colour = CW_COLOUR_CUT,
                         .plane = CW_PLANE_MERIDIONAL,
                         .target = CW_TARGET_NECK,
                         .span = 0.1};
  start(&spec);
  const double azimuth = cw_survey_meridional_azimuth(&survey);
  assert_near(fabs(cos(azimuth)), 1, 1e-9); // two blades, one at 90 degrees
  assert_near(drawing.camera.centre[0], 0.102 * cos(azimuth), 1e-9);
  assert_near(drawing.camera.centre[1], 0.102 * sin(azimuth), 1e-9);
  assert_near(drawing.camera.centre[2], 0, 1e-12);
  // The radius runs to the right, the suction side (z < 0) is up.
  assert_near(drawing.camera.right[0], cos(azimuth), 1e-9);
  assert_near(drawing.camera.up[2], -1, 1e-12);
  // A point of the plane has no distance from it.
  assert_near(cw_cut_distance(&drawing.plane, (double[]){0.03 * cos(azimuth), 0.03 * sin(azimuth), 7}), 0, 1e-12);
  end();
  spec.target = CW_TARGET_SHROUD;
  start(&spec);
  assert_null(drawing.lacking);
  assert_near(hypot(drawing.camera.centre[0], drawing.camera.centre[1]), 0.043, 1e-9);
  assert_near(drawing.camera.centre[2], -0.02, 1e-9);
  end();
}

static void what_is_not_there_is_lacking(void **state) {
  cw_survey_start(&survey, &sizes);
  CwPictureSpec spec = {.width = WIDTH, .height = HEIGHT, .sees = CW_SEES_ROTOR, .colour = CW_COLOUR_SPEED};
  spec.plane = CW_PLANE_MID_SPAN;
  start(&spec);
  assert_string_equal(drawing.lacking, "the mesh has no hub, or no shroud");
  end();
  spec.plane = CW_PLANE_MERIDIONAL;
  start(&spec);
  assert_string_equal(drawing.lacking, "the mesh has no boundary near the plane");
  end();
  spec.target = CW_TARGET_SHROUD;
  start(&spec);
  assert_string_equal(drawing.lacking, "the mesh has no shroud");
  end();
  // The whole meridional plane: both sides of the axis, as far as the boundary goes.
  survey_walls(&sizes, &survey);
  spec.target = CW_TARGET_ALL;
  start(&spec);
  assert_null(drawing.lacking);
  assert_true(drawing.reach.started);
  assert_near(drawing.reach.most[0], 0.09, 1e-9);
  assert_near(drawing.reach.least[0], -0.09, 1e-9);
  assert_near(drawing.reach.most[1], 0.02, 1e-9); // the suction side is up
  assert_near(drawing.reach.least[1], -0.01, 1e-9);
  end();
}

// A tetrahedron, a pyramid and a prism beside one another, from z = -0.02 to 0.02, each about a place of its own.
static double cell_x[15][3];
static int32_t tetrahedra[1][4] = {{0, 1, 2, 3}}, pyramids[1][5] = {{4, 5, 6, 7, 8}},
               prisms[1][6] = {{9, 10, 11, 12, 13, 14}};

static CwRegionData three_cells(int domain) {
  static const double x[15][3] = {
      {-0.09, -0.03, -0.02}, {-0.03, -0.03, -0.02}, {-0.06, 0.03, -0.02}, {-0.06, -0.01, 0.02}, {-0.02, -0.03, -0.02},
      {0.03, -0.03, -0.02},  {0.03, 0.03, -0.02},   {-0.02, 0.03, -0.02}, {0, 0, 0.02},         {0.04, -0.03, -0.02},
      {0.1, -0.03, -0.02},   {0.07, 0.03, -0.02},   {0.04, -0.03, 0.02},  {0.1, -0.03, 0.02},   {0.07, 0.03, 0.02}};
  memcpy(cell_x, x, sizeof x);
  return (CwRegionData){.domain = domain,
                        .points = cell_x,
                        .point_count = 15,
                        .tetrahedra = tetrahedra,
                        .tetrahedron_count = 1,
                        .pyramids = pyramids,
                        .pyramid_count = 1,
                        .prisms = prisms,
                        .prism_count = 1};
}

static CwPictureSpec cut_at_z0(CwPictureColour colour) {
  return (CwPictureSpec){.width = WIDTH, .height = HEIGHT, .sees = CW_SEES_ALL, .colour = colour, .plane = CW_PLANE_Z0};
}

static void cut(const CwRegionData *cells, const CwFlow *flow) {
  CwRegionCut found = {0};
  assert_int_equal(cw_drawing_cut(&drawing, &survey, cells, &found), CW_OK);
  cw_drawing_add_cells(&drawing, &mesh, 0, flow, cells, &found);
  cw_region_cut_free(&found);
}

// Cells have the colour of their kind and zone; they lie in the plane where the pump has them.
static void cut_cells_have_the_colours_of_their_kinds(void **state) {
  const CwPictureSpec spec = cut_at_z0(CW_COLOUR_CUT);
  cw_survey_start(&survey, &sizes);
  for (int domain = ROTOR; domain <= STATOR; domain++) {
    const CwRegionData cells = three_cells(domain);
    start(&spec);
    drawing.camera.metres_per_pixel = 0.25 / WIDTH;
    cut(&cells, NULL);
    assert_int_equal(colour_at(-0.06, -0.01, 0), cw_domain_colour(domain, 2));
    assert_int_equal(colour_at(0, 0, 0), cw_pyramid_colour);
    assert_int_equal(colour_at(0.07, -0.01, 0), cw_domain_colour(domain, 1));
    assert_int_equal(group_at(0.07, -0.01, 0), domain + 1);
    assert_int_equal(colour_at(0, 0.06, 0), WHITE);
    end();
  }
}

// Velocities of the cells (0, 3, 0), (4, 0, 3) and (0, 0, 0) m/s, a scale to 5 m/s. Seen from z < 0 with x up, y runs
// to the right.
static void cut_cells_have_the_colours_of_their_speeds(void **state) {
  static const double u[] = {0, 3, 0, 4, 0, 3, 0, 0, 0};
  static int64_t first_cell[1] = {0};
  CwFlow flow = {.present = 1,
                 .velocity = {.components = 3, .scalar_size = 8, .cells = {.bytes = (const char *)u, .count = 3}},
                 .first_cell = first_cell};
  flow.span[CW_FLOW_SPEED].most = 5;
  const CwPictureSpec spec = cut_at_z0(CW_COLOUR_SPEED);
  const CwRegionData cells = three_cells(STATOR);
  cw_survey_start(&survey, &sizes);
  start(&spec);
  drawing.camera.metres_per_pixel = 0.25 / WIDTH;
  cut(&cells, &flow);
  assert_int_equal(colour_at(-0.06, -0.01, 0), cw_colour_scale(0.6));
  assert_int_equal(colour_at(0, 0, 0), cw_colour_scale(1));
  assert_int_equal(colour_at(0.07, -0.01, 0), cw_colour_scale(0));
  static const struct {
    double x, y;
    float right, down;
  } places[] = {{-0.06, -0.01, 3, 0}, {0, 0, 0, -4}};
  for (int k = 0; k < 2; k++) {
    double p[3];
    cw_camera_project(&drawing.camera, (double[]){places[k].x, places[k].y, 0}, p);
    const float *velocity = drawing.canvas.velocity[(size_t)p[1] * WIDTH + (size_t)p[0]];
    assert_near(velocity[0], places[k].right, 1e-6);
    assert_near(velocity[1], places[k].down, 1e-6);
  }
  end();
}

// Halfway from the hub at z = 0.01 to the shroud at -0.02 lies z = -0.005: there a tetrahedron that ends at z = 0 is
// cut, which the middle plane misses.
static void surfaces_of_the_span_cut_cells(void **state) {
  CwPictureSpec spec = cut_at_z0(CW_COLOUR_SPEED);
  CwRegionData cells = three_cells(ROTOR);
  survey_walls(&sizes, &survey);
  cells.pyramid_count = cells.prism_count = 0;
  for (int k = 0; k < 4; k++) cell_x[k][0] += 0.11, cell_x[k][2] = k == 3 ? -0.001 : -0.02;
  for (int span = 0; span < 2; span++) {
    spec.plane = span ? CW_PLANE_MID_SPAN : CW_PLANE_Z0;
    start(&spec);
    CwRegionCut found = {0};
    assert_int_equal(cw_drawing_cut(&drawing, &survey, &cells, &found), CW_OK);
    assert_int_equal(found.count, span);
    cw_region_cut_free(&found);
    end();
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup(faces_have_the_colours_of_their_patches, begin_survey),
      cmocka_unit_test_setup(light_follows_the_normal, begin_survey),
      cmocka_unit_test_setup(regions_have_their_colours, begin_survey),
      cmocka_unit_test_setup(metal_is_marked, begin_survey),
      cmocka_unit_test_setup(solved_values_have_the_colours_of_the_scale, begin_survey),
      cmocka_unit_test_setup(the_suction_half_of_the_stator_is_cut_off, begin_survey),
      cmocka_unit_test_setup(pictures_see_their_zones, begin_survey),
      cmocka_unit_test(views_stand_at_their_places),
      cmocka_unit_test(what_is_not_there_is_lacking),
      cmocka_unit_test(cut_cells_have_the_colours_of_their_kinds),
      cmocka_unit_test(cut_cells_have_the_colours_of_their_speeds),
      cmocka_unit_test(surfaces_of_the_span_cut_cells),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
