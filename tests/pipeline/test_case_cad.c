// SPDX-License-Identifier: AGPL-3.0-or-later
// The section `cad`: what is read of it, and the place of what is wrong.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "given_case.h"
#include "pipeline/case_cad.h"
#include "tests/unit_test.h"

static CwStatus read_text(const char *cad, CwCase *table) {
  return read_given("name: x\noperating_point: {flow_rate_m3_per_h: 4, head_m: 2, speed_rpm: 1450}\ncad:\n", cad,
                    table);
}

static void everything_is_read(void **state) {
  CwCase table;
  if (read_text("  files: [pump.step, /abs/other.brep]\n"
                "  unit_in: 1\n"
                "  tolerance_um: 20\n"
                "  face_names: ignored\n"
                "  axis: {point_in: [1, 0, 2], direction: [0, 3, 4]}\n"
                "  cut: {meridian_mm: [[40, -5], [60, 5.5]]}\n"
                "  domains:\n"
                "    rotor: {solid: [wheel*, 3], rotating: true}\n"
                "    stator: {inside_mm: [[1, 2, 3], [4, 5, 6]]}\n"
                "  patches:\n"
                "    blade_PS: {faces: ['PS*', 12], domain: rotor, walls: blade, y_plus: 5, velocity_m_per_s: 7}\n"
                "    in: {near_mm: [0, 0, -9], kind: inlet}\n"
                "    lid: {colour: '#00Ff10', layer: wet, kind: wall, turns: false, monitored: true}\n"
                "    face: {faces: 4, kind: interface}\n",
                &table))
    fail_msg("%s", cw_fail_message());
  const CwCaseCad *cad = table.cad;
  const char *placed = in_test_folder("pump.step");
  assert_string_equal(cad->files.text[0], placed);
  assert_string_equal(cad->files.text[1], "/abs/other.brep");
  assert_near(cad->unit, 0.0254, 1e-12);
  assert_near(cad->tolerance, 20e-6, 1e-12);
  assert_int_equal(cad->names_are_patches, 0);
  assert_near(cad->point[2], 0.0508, 1e-12);
  assert_near(cad->axis[2], 0.8, 1e-12);
  assert_int_equal(cad->cut.count, 2);
  assert_near(cad->cut.meridian[1][0], 0.06, 1e-12);
  assert_near(cad->cut.meridian[1][1], 0.0055, 1e-12);
  assert_int_equal(cad->domain_count, 2);
  assert_int_equal(cad->domain[0].rotating, 1);
  assert_string_equal(cad->domain[0].solids.text[1], "3");
  assert_near(cad->domain[1].inside.at[1][2], 0.006, 1e-12);
  const CwCadPatch *patch = cad->patch;
  assert_int_equal(cad->patch_count, 4);
  assert_string_equal(patch[0].faces.text[1], "12");
  assert_string_equal(patch[0].domain, "rotor");
  assert_int_equal(patch[0].walls, CW_CAD_WALLS_BLADE);
  assert_near(patch[0].y_plus, 5, 1e-12);
  assert_near(patch[0].velocity, 7, 1e-12);
  assert_int_equal(patch[0].turns, -1);
  assert_int_equal(patch[1].kind, CW_CAD_KIND_INLET);
  assert_near(patch[1].near.at[0][2], -0.009, 1e-12);
  assert_true(isnan(patch[1].y_plus));
  assert_int_equal(patch[2].colour, 0x00ff10);
  assert_string_equal(patch[2].layers.text[0], "wet");
  assert_int_equal(patch[2].turns, 0);
  assert_int_equal(patch[2].monitored, 1);
  assert_int_equal(patch[3].kind, CW_CAD_KIND_INTERFACE);
  cw_case_free(&table);
}

static void what_is_left_out_has_its_default(void **state) {
  CwCase table;
  if (read_text("  files: pump.step\n  cut: {radius_cm: 10}\n  domains: {a: {solid: 1}}\n", &table))
    fail_msg("%s", cw_fail_message());
  assert_true(table.cad->unit == 0); // the file's own
  assert_true(isnan(table.cad->tolerance));
  assert_near(table.cad->axis[2], 1, 1e-12);
  assert_near(table.cad->cut.radius, 0.1, 1e-12);
  assert_int_equal(table.cad->names_are_patches, 1);
  assert_int_equal(table.cad->patch_count, 0);
  char first[CW_HASH_TEXT];
  strcpy(first, table.cad->digest);
  cw_case_free(&table);
  assert_int_equal(read_text("  files: pump.step\n  cut: {radius_cm: 11}\n  domains: {a: {solid: 1}}\n", &table),
                   CW_OK);
  assert_string_not_equal(first, table.cad->digest);
  cw_case_free(&table);
}

// Domains have up to 14 letters, patches up to 22.
static void names_may_be_so_long(void **state) {
  static const char letters[] = "abcdefghijklmnopqrstuvwxyz";
  for (int i = 0; i < 4; i++) {
    char text[200];
    CwCase table;
    const int domain = i == 1 ? 15 : 14, patch = i == 2 ? 23 : 22, fits = i != 1 && i != 2;
    snprintf(text, sizeof text, "  files: x.step\n  domains: {%.*s: {solid: 1}}\n  patches: {%.*s: {faces: 1}}\n",
             domain, letters, patch, letters);
    assert_int_equal(read_text(text, &table) == CW_OK, fits);
    if (!fits) assert_non_null(strstr(cw_fail_message(), "no name that files and solvers take; allowed: 1 to "));
    if (fits) assert_int_equal(strlen(table.cad->patch[0].name), 22);
    cw_case_free(&table);
  }
}

static void wrong_values_have_their_place(void **state) {
  static const struct {
    const char *cad, *message;
  } wrong[] = {
      {"  domains: {a: {solid: 1}}\n", ":3:1: cad: the key files is missing"},
      {"  files: x.step\n", "cad: the key domains is missing"},
      {"  files: x.step\n  domain: {a: {solid: 1}}\n", ":5:11: cad.domain: no such key; allowed: files"},
      {"  files: x.step\n  domains: {a: {}}\n", "cad.domains.a: it chooses no solid"},
      {"  files: x.step\n  domains: {Rotor: {solid: 1}}\n", "cad.domains.Rotor: no name that files and solvers take"},
      {"  files: x.step\n  domains: {a: {solid: 1, rotating: 1}}\n", "cad.domains.a.rotating: 1 is not one of"},
      {"  files: x.step\n  domains: {a: {inside_mm: [1, 2]}}\n", "cad.domains.a.inside_mm: it is no point"},
      {"  files: x.step\n  unit_mm: 0\n  domains: {a: {solid: 1}}\n", ":5:12: cad.unit_mm: 0 is out of range"},
      {"  files: x.step\n  unit_mm: 1\n  unit_in: 1\n  domains: {a: {solid: 1}}\n",
       ":6:12: cad.unit_in: given twice, first in line 5; allowed: once"},
      {"  files: x.step\n  domains: {a: {solid: 1}}\n  patches: {w: {near_mm: [1, 2, 3], near_in: [1, 2, 3]}}\n",
       "cad.patches.w.near_in: given twice"},
      {"  files: x.step\n  tolerance_mm: 1\n  tolerance_um: 5\n  domains: {a: {solid: 1}}\n",
       ":6:17: cad.tolerance_um: given twice, first in line 5; allowed: once"},
      {"  files: x.step\n  axis: {direction: [0, 0, 0]}\n  domains: {a: {solid: 1}}\n", "it has no length"},
      {"  files: x.step\n  cut: {}\n  domains: {a: {solid: 1}}\n", "cad.cut: it is no surface"},
      {"  files: x.step\n  cut: {radius_mm: 3, meridian_mm: [[1, 2], [3, 4]]}\n  domains: {a: {solid: 1}}\n",
       "cad.cut: it is no surface"},
      {"  files: x.step\n  cut: {meridian_mm: [[1, 2], [3]]}\n  domains: {a: {solid: 1}}\n",
       "it is no point of a meridian"},
      {"  files: x.step\n  domains: {a: {solid: 1}}\n  patches: {w: {kind: wall}}\n",
       "cad.patches.w: it takes no face"},
      {"  files: x.step\n  domains: {a: {solid: 1}}\n  patches: {w: {colour: red}}\n", "it is no colour"},
      {"  files: x.step\n  domains: {a: {solid: 1}}\n  patches: {w: {faces: 1, kind: pipe}}\n",
       "pipe is not one of the choices; allowed: auto, wall, inlet, outlet, symmetry or interface"},
      {"  files: x.step\n  domains: {a: {solid: 1}}\n  patches: {w: {faces: 1, kind: periodic}}\n",
       "cad.patches.w.kind: one passage with periodic sides cannot be meshed by itself; allowed: the water of the "
       "whole "
       "wheel"},
      {"  files: x.step\n  domains: {a: {solid: 1}}\n  patches: {w: {faces: 1, domain: b}}\n", "no such domain"},
      {"  files: x.step\n  domains: {a: {solid: 1}}\n  patches: {w: {faces: 1, y_plus: 0}}\n", "0 is out of range"},
  };
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    CwCase table = {0};
    assert_int_equal(read_text(wrong[i].cad, &table), CW_ERR_INPUT);
    if (!strstr(cw_fail_message(), wrong[i].message))
      fail_msg("'%s' is not in '%s'", wrong[i].message, cw_fail_message());
    cw_case_free(&table);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(everything_is_read), cmocka_unit_test(what_is_left_out_has_its_default),
      cmocka_unit_test(names_may_be_so_long), cmocka_unit_test(wrong_values_have_their_place)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
