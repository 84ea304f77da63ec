// SPDX-License-Identifier: AGPL-3.0-or-later
// A run of two boxes, for tests of the report: files in the folder of the test, and its mesh.
#pragma once

#include <jansson.h>
#include <stdlib.h>

#include "pipeline/case_origin.h"
#include "pipeline/case_read.h"
#include "pipeline/mesh/region_items.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

#define CASE CUTWATER_SOURCE_DIR "/cases/paper/case.yaml"

static inline void write_in_run(const char *name, const char *text) {
  write_text(in_test_folder(name), text);
}

// A stage's record, with the case that it ran for.
static inline void write_record(const char *name, const char *text) {
  CwCase table;
  assert_int_equal(cw_case_read(CASE, &table), CW_OK);
  json_t *record = json_loads(text, 0, NULL);
  assert_int_equal(json_object_set_new(record, "case", cw_case_origin(&table)), 0);
  char *whole = json_dumps(record, 0);
  write_in_run(name, whole);
  free(whole);
  json_decref(record);
}

// A box from (x0, -0.02, -0.004) to (x1, 0.02, 0.004) m of two prisms standing on z; patches by side: 0
// below, 1 above, 3 around. `corner` is the highest index used.
static inline void write_region(const char *domain, double x0, double x1, int corner) {
  double x[8][3];
  for (int k = 0; k < 8; k++) {
    x[k][0] = k & 1 ? x1 : x0;
    x[k][1] = k & 2 ? 0.02 : -0.02;
    x[k][2] = k & 4 ? 0.004 : -0.004;
  }
  int32_t prism[2][6] = {{0, 1, 2, 4, 5, 6}, {1, 3, 2, 5, corner, 6}};
  int32_t triangle[4][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}}, triangle_patch[4] = {0, 0, 1, 1};
  int32_t quad[4][4] = {{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}, quad_patch[4] = {3, 3, 3, 3};
  int32_t triangle_cell[4] = {0, 1, 0, 1}, quad_cell[4] = {0, 1, 1, 0};
  char name[40], digest[CW_HASH_TEXT];
  snprintf(name, sizeof name, "mesh/%s-0001.h5", domain);
  const CwRegionData data = {.point_count = 8,
                             .prism_count = 2,
                             .triangle_count = 4,
                             .quad_count = 4,
                             .points = x,
                             .prisms = prism,
                             .triangles = triangle,
                             .triangle_patch = triangle_patch,
                             .triangle_cell = triangle_cell,
                             .quads = quad,
                             .quad_patch = quad_patch,
                             .quad_cell = quad_cell};
  hid_t file = cw_region_items_create(in_test_folder(name));
  assert_true(file >= 0);
  assert_int_equal(cw_region_items_put_integer(file, "format", CW_REGION_FORMAT), CW_OK);
  assert_int_equal(cw_region_items_put_integer(file, "region", 1), CW_OK);
  assert_int_equal(cw_region_items_put_text(file, "domain", domain), CW_OK);
  assert_int_equal(cw_region_items_put_number(file, "unit_m", 1), CW_OK);
  assert_int_equal(cw_region_items_write(file, &data, digest), CW_OK);
  H5Fclose(file);
}

// clang-format off
#define REGION(file) "{\"file\":\"" file "\",\"region\":1,\"number\":1,\"points\":8,\"own_points\":8," \
  "\"tetrahedra\":0,\"pyramids\":0,\"prisms\":2,\"triangles\":4,\"quads\":4}"
#define WALL(name) "{\"name\":\"" name "\",\"kind\":\"wall\",\"size\":\"volute\",\"group\":\"volute\",\"flow\":" \
  "{\"speed_m_per_s\":7,\"length_m\":0.1,\"diameter_m\":0.01,\"width_m\":0.01}}"
#define PATCHES(a, b, end, c) "[" WALL(a) "," WALL(b) "," \
  "{\"name\":\"" end "\",\"kind\":\"" end "\",\"size\":\"pipe\",\"flow_share\":1}," \
  "{\"name\":\"" c "\",\"kind\":\"interface\",\"size\":\"interface\"}]"
#define MESHED(name, turns, patches, file) "{\"name\":\"" name "\",\"rotating\":" turns ",\"shared_points\":0," \
  "\"solid_volume_m3\":1,\"patches\":" patches ",\"regions\":[" REGION(file) "]}"
#define FLOW "\"flow\":{\"inlet_speed_m_per_s\":2,\"inlet_diameter_m\":0.07,\"passage_speed_m_per_s\":7," \
  "\"passage_width_m\":0.01,\"reference_length_m\":0.2,\"blade_count\":6}"
#define MANIFEST "{\"format\":3,\"domains\":[" \
  MESHED("rotor", "true", PATCHES("shroud", "hub", "inlet", "rotor_interface"), "rotor-0001.h5") "," \
  MESHED("stator", "false", PATCHES("volute", "tongue", "outlet", "stator_interface"), "stator-0001.h5") "]," \
  "\"interfaces\":[{\"patches\":[\"rotor_interface\",\"stator_interface\"],\"surface\":\"cylinder\"," \
  "\"radius_m\":0.101}]," FLOW "}"
// clang-format on
