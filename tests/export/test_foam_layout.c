// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_layout.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit_test.h"

enum { PATCHES = 2, PARTS = 2, LINKS = 3 };

// Three domains, two patches and two parts, of which the first has two links and the second one.
typedef struct {
  CwMesh mesh;
  CwAssembly assembly;
  CwPart parts[PARTS];
  CwFaceCount patch[PARTS][PATCHES];
  CwLink links[LINKS];
  CwFoamMesh foam;
} Given;

static void make_given(Given *g) {
  memset(g, 0, sizeof *g);
  g->mesh.patch_count = PATCHES;
  g->mesh.domain_count = 3;
  g->assembly.mesh = &g->mesh;
  g->patch[0][0] = (CwFaceCount){5, 0};
  g->patch[0][1] = (CwFaceCount){1, 2};
  g->patch[1][1] = (CwFaceCount){0, 7};
  g->links[0].count = (CwFaceCount){3, 0};
  g->links[1].count = (CwFaceCount){0, 4};
  g->links[2].count = (CwFaceCount){3, 4};
  g->parts[0] = (CwPart){.cells = 40, .points = 60, .inner = {70, 20}, .patch = g->patch[0], .link_count = 2};
  g->parts[1] =
      (CwPart){.cells = 9, .points = 20, .inner = {10, 1}, .patch = g->patch[1], .first_link = 2, .link_count = 1};
  g->foam = (CwFoamMesh){.assembly = &g->assembly,
                         .label_size = 4,
                         .division = {.part_count = PARTS, .parts = g->parts, .links = g->links, .link_count = LINKS},
                         .parts = calloc(PARTS, sizeof(CwFoamPart))};
}

static void assert_count(CwFaceCount count, int64_t triangles, int64_t quads) {
  assert_int_equal(count.triangles, triangles);
  assert_int_equal(count.quads, quads);
}

// Inner faces, then patch after patch, then link after link.
static void faces_follow_one_another(void **state) {
  Given g;
  make_given(&g);
  assert_int_equal(cw_foam_layout_parts(&g.foam), CW_OK);
  const CwFoamPart *one = &g.foam.parts[0], *other = &g.foam.parts[1];
  assert_count(one->patch[0], 70, 20);
  assert_count(one->patch[1], 75, 20);
  assert_count(one->patch[2], 76, 22);
  assert_count(one->link[0], 76, 22);
  assert_count(one->link[1], 79, 22);
  assert_count(one->all, 79, 26);
  assert_count(other->patch[1], 10, 1);
  assert_count(other->link[0], 10, 8);
  assert_count(other->all, 13, 12);
  assert_true(cw_foam_is_divided(&g.foam));
  cw_foam_layout_free(&g.foam);
}

// 79 triangles and 26 quads are 105 faces, 90 of them inner; of 60 points, 40 cells and three domains.
static void each_file_has_its_values(void **state) {
  static const int64_t wanted[CW_FOAM_FILES] = {60, 106, 105, 90, 3, 60, 105, 40};
  static const char *const names[CW_FOAM_FILES] = {"points",
                                                   "faces",
                                                   "owner",
                                                   "neighbour",
                                                   "cellZones",
                                                   "pointProcAddressing",
                                                   "faceProcAddressing",
                                                   "cellProcAddressing"};
  Given g;
  make_given(&g);
  assert_int_equal(cw_foam_layout_parts(&g.foam), CW_OK);
  for (int f = 0; f < CW_FOAM_FILES; ++f) {
    char text[CW_FOAM_HEADER_SIZE], words[100];
    assert_int_equal(cw_foam_value_count(&g.foam, 0, (CwFoamFile)f), wanted[f]);
    const int length = cw_foam_header(&g.foam, 0, (CwFoamFile)f, text);
    assert_int_equal(length, strlen(text));
    assert_int_equal(g.foam.parts[0].start[f], length);
    assert_string_equal(cw_foam_file_names[f], names[f]);
    snprintf(words, sizeof words, "    object      %s;\n}\n\n%lld\n(%s", names[f], (long long)wanted[f],
             f == CW_FOAM_ZONES ? "\n" : "");
    assert_string_equal(text + length - strlen(words), words);
    assert_non_null(strstr(text, "    arch        \"LSB;label=32;scalar=64\";\n"));
    const int told = f == CW_FOAM_OWNER || f == CW_FOAM_NEIGHBOUR;
    assert_int_equal(strstr(text, "note        \"nPoints:60  nCells:40  nFaces:105  nInternalFaces:90\";\n") != NULL,
                     told);
    if (!told) assert_null(strstr(text, "note"));
  }
  cw_foam_layout_free(&g.foam);
}

// Behind the 106 offsets of `faces` stand ")", an empty line, the number of corners, 3 * 79 + 4 * 26 = 341, and "(".
static void labels_stand_behind_the_offsets(void **state) {
  for (int size = 4; size <= 8; size += 4) {
    Given g;
    char text[CW_FOAM_HEADER_SIZE];
    make_given(&g);
    g.foam.label_size = size;
    assert_int_equal(cw_foam_layout_parts(&g.foam), CW_OK);
    const int header = cw_foam_header(&g.foam, 0, CW_FOAM_FACES, text);
    assert_int_equal(g.foam.parts[0].label_start, header + 106 * size + (int)strlen(")\n\n341\n("));
    assert_non_null(strstr(text, size == 4 ? "label=32" : "label=64"));
    cw_foam_layout_free(&g.foam);
  }
}

// A part with 2^31 face corners: one with 32-bit labels is refused, one that chooses gets 64; with a corner less both
// have 32.
static void labels_grow_where_corners_ask_it(void **state) {
  for (int over = 0; over < 2; ++over)
    for (int labels = CW_INTEGERS_AUTO; labels <= CW_INTEGERS_64; ++labels) {
      Given g;
      make_given(&g);
      g.foam.labels = (CwIntegers)labels;
      g.foam.label_size = labels == CW_INTEGERS_64 ? 8 : 4;
      // All but the inner faces are 3 triangles and 11 quads, of 53 corners.
      const int64_t left = INT32_MAX + (int64_t)over - 53, quads = left % 3;
      g.parts[1].inner = (CwFaceCount){(left - 4 * quads) / 3, quads};
      assert_int_equal(cw_corner_count(g.parts[1].inner), left);
      const int refused = over && labels == CW_INTEGERS_32;
      assert_int_equal(cw_foam_layout_parts(&g.foam), refused ? CW_ERR_EXPORT : CW_OK);
      if (refused)
        assert_non_null(strstr(cw_fail_message(), "2147483648 face corners in one part; OpenFOAM with 32-bit labels "
                                                  "allows 2147483647 (openfoam.labels: 64 or more"));
      else
        assert_int_equal(g.foam.label_size, over || labels == CW_INTEGERS_64 ? 8 : 4);
      cw_foam_layout_free(&g.foam);
    }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(faces_follow_one_another),
      cmocka_unit_test(each_file_has_its_values),
      cmocka_unit_test(labels_stand_behind_the_offsets),
      cmocka_unit_test(labels_grow_where_corners_ask_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
