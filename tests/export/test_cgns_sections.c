// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/cgns_sections.h"

#include <stdlib.h>
#include <string.h>

#include "tests/draw.h"
#include "tests/unit_test.h"

// The second domain has no pyramids, a patch of both kinds of faces, one without any, and one of each kind alone.
static CwModelPatch patches[] = {{.name = "blade", .domain = 0},
                                 {.name = "a_wall_of_22_letters__", .domain = 1},
                                 {.name = "empty", .domain = 1},
                                 {.name = "inlet", .domain = 1},
                                 {.name = "pipe", .domain = 1}};
static CwMesh mesh = {.domain_count = 2,
                      .domains = {{.first_patch = 0, .patch_count = 1}, {.first_patch = 1, .patch_count = 4}},
                      .patch_count = 5,
                      .patches = patches};

static void sections_follow_one_another(void **state) {
  static const CwSection wanted[] = {{"tetrahedra", 10, 4, -1, 1, 100},
                                     {"prisms", 14, 6, -1, 101, 30},
                                     {"a_wall_of_22_letters___triangles", 5, 3, 1, 131, 7},
                                     {"a_wall_of_22_letters___quads", 7, 4, 1, 138, 5},
                                     {"inlet_triangles", 5, 3, 3, 143, 9},
                                     {"pipe_quads", 7, 4, 4, 152, 2}};
  CwPatchPart faces[] = {
      {.faces = {50, 60}}, {.faces = {7, 5}}, {.faces = {0, 0}}, {.faces = {9, 0}}, {.faces = {0, 2}}};
  const CwAssembly a = {.mesh = &mesh,
                        .patches = faces,
                        .totals = {{.tetrahedra = 9, .cells = 9}, {.tetrahedra = 100, .prisms = 30, .cells = 130}}};
  CwSection *section;
  int count;
  assert_int_equal(cw_cgns_sections(&a, 1, &section, &count), CW_OK);
  assert_int_equal(count, sizeof wanted / sizeof *wanted);
  for (int s = 0; s < count; ++s) {
    assert_string_equal(section[s].name, wanted[s].name);
    assert_int_equal(section[s].type, wanted[s].type);
    assert_int_equal(section[s].nodes, wanted[s].nodes);
    assert_int_equal(section[s].patch, wanted[s].patch);
    assert_int_equal(section[s].first, wanted[s].first);
    assert_int_equal(section[s].count, wanted[s].count);
  }
  free(section);
  assert_int_equal(cw_cgns_patch_first(&a, 0), 10); // behind the nine cells of its own zone
}

static int64_t draw_count(uint64_t *seed) {
  return draw(seed) < 0.3 ? 0 : (int64_t)(draw(seed) * 0x1p40); // past 32 bits
}

// Of any mesh the elements of a zone are numbered from 1 on without a gap, cells first, and one range holds a patch.
static void every_element_has_one_number(void **state) {
  uint64_t seed = 3;
  for (int round = 0; round < 200; ++round) {
    CwPatchPart faces[5] = {{.area = 0}};
    CwAssembly a = {.mesh = &mesh, .patches = faces};
    for (int p = 0; p < 5; ++p) faces[p].faces = (CwFaceCount){draw_count(&seed), draw_count(&seed)};
    for (int d = 0; d < 2; ++d) {
      CwDomainTotal *t = &a.totals[d];
      *t = (CwDomainTotal){.tetrahedra = draw_count(&seed), .pyramids = draw_count(&seed), .prisms = draw_count(&seed)};
      t->cells = t->tetrahedra + t->pyramids + t->prisms;
      CwSection *section;
      int count;
      int64_t next = 1, cells = 0, of_patch[5] = {0}, first[5] = {0};
      assert_int_equal(cw_cgns_sections(&a, d, &section, &count), CW_OK);
      for (int s = 0; s < count; ++s) {
        const int patch = section[s].patch;
        assert_int_equal(section[s].first, next);
        assert_true(section[s].count > 0);
        next += section[s].count;
        if (patch < 0) {
          cells += section[s].count;
          continue;
        }
        assert_true(section[s].first > t->cells);
        if (!of_patch[patch]) first[patch] = section[s].first;
        of_patch[patch] += section[s].count;
      }
      assert_int_equal(cells, t->cells);
      for (int p = mesh.domains[d].first_patch; p < mesh.domains[d].first_patch + mesh.domains[d].patch_count; ++p) {
        assert_int_equal(of_patch[p], cw_face_count(faces[p].faces));
        if (of_patch[p]) assert_int_equal(cw_cgns_patch_first(&a, p), first[p]);
      }
      free(section);
    }
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(sections_follow_one_another),
      cmocka_unit_test(every_element_has_one_number),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
