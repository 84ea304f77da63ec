// SPDX-License-Identifier: AGPL-3.0-or-later
// Which patch a face gets: rules before names of the file before proposals; kinds; clean and unique names.
#include "cad/small_parts.hpp"

extern "C" {
#include "geometry/cad/face_patches.h"
}

// A block and a block behind it; all faces but the common one are walls.
struct Blocks : SmallParts {
  CwCadPatch patch[3] = {};
  CwFaceRole role[12];
  CwFacePatches made = {};

  Blocks() : SmallParts({{"rotor", small_box(0, 0, 0, 10, 10, 10)}, {"stator", small_box(10, 0, 0, 10, 10, 10)}}) {
    if (look()) fail_msg("%s", cw_fail_message());
    for (int f = 0; f < 12; f++) role[f] = contact[f].part >= 0 ? CW_ROLE_CONTACT : CW_ROLE_WALL;
    cad.patch = patch;
    cad.names_are_patches = 1;
    for (CwCadPatch &rule : patch) rule.colour = rule.turns = -1;
  }
  ~Blocks() {
    cw_face_patches_free(&made);
  }
  CwCadPatch &rule(const char *name) {
    CwCadPatch &added = patch[cad.patch_count++];
    strcpy(added.name, name);
    return added;
  }
  CwStatus make() {
    cw_face_patches_free(&made);
    return cw_face_patches_make(&cad, &small_frame, &parts, &survey, contact, role, small_tolerance, &made);
  }
  int count(const char *name, CwPatchKind kind) const {
    int faces = 0;
    for (int f = 0; f < survey.face_count; f++) {
      const CwFacePatch &of = made.patch[made.of_face[f]];
      faces += !strcmp(of.name, name) && of.kind == kind;
    }
    return faces;
  }
};

static void without_rules_faces_are_proposed(void **) {
  Blocks blocks;
  assert_int_equal(blocks.make(), CW_OK);
  assert_int_equal(blocks.made.count, 4);
  assert_int_equal(blocks.count("rotor_wall", CW_PATCH_WALL), 5);
  assert_int_equal(blocks.count("rotor_to_stator", CW_PATCH_INTERFACE), 1);
  assert_int_equal(blocks.count("stator_to_rotor", CW_PATCH_INTERFACE), 1);
}

static void names_of_the_file_are_cleaned(void **) {
  Blocks blocks;
  blocks.parts.part[0].origin[0].name = "3 Blade PS/1";
  blocks.parts.part[0].origin[1].name = "NONE";
  blocks.parts.part[1].origin[1].name = "Blade_PS_1"; // of another domain
  assert_int_equal(blocks.make(), CW_OK);
  assert_int_equal(blocks.count("Blade_PS_1", CW_PATCH_WALL), 1);
  assert_int_equal(blocks.count("Blade_PS_1_2", CW_PATCH_INTERFACE) + blocks.count("Blade_PS_1_2", CW_PATCH_WALL), 1);
  blocks.cad.names_are_patches = 0;
  assert_int_equal(blocks.make(), CW_OK);
  assert_int_equal(blocks.made.count, 4);
}

static void the_first_rule_has_a_face(void **) {
  Blocks blocks;
  char pattern[] = "PS*", number[] = "2", *texts[] = {pattern, number};
  blocks.parts.part[0].origin[2].name = "PS_7";
  blocks.parts.part[0].origin[2].colour = 0xff0000;
  blocks.parts.part[0].origin[3].colour = 0xff0000;
  blocks.rule("first").faces = {2, texts};
  blocks.rule("second").colour = 0xff0000;
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  int first = 0, second = 0;
  for (int f = 0; f < 6; f++) {
    const CwFacePatch &of = blocks.made.patch[blocks.made.of_face[f]];
    first += of.rule == 0;
    second += of.rule == 1;
    if (f == 1 || f == 2) assert_int_equal(of.rule, 0);
    if (f == 3) assert_int_equal(of.rule, 1);
  }
  assert_int_equal(first, 2);
  assert_int_equal(second, 1);
}

// A rule for one wall, by the name that the others are proposed: its patch is the rule's.
static void rules_hold_for_proposals_of_their_name(void **) {
  Blocks blocks;
  char number[16], *texts[] = {number};
  snprintf(number, sizeof number, "%d", blocks.contact[0].part < 0 ? 1 : 2);
  blocks.rule("rotor_wall").faces = {1, texts};
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(blocks.count("rotor_wall", CW_PATCH_WALL), 5);
  const CwFacePatch &of = blocks.made.patch[blocks.made.of_face[atoi(number) - 1]];
  assert_int_equal(of.rule, 0);
  assert_int_equal(of.source, CW_FROM_RULE);
}

// All pieces of a face of the file come with the one that the point is on.
static void points_take_all_pieces_of_a_face(void **) {
  Blocks blocks;
  double point[][3] = {{5e-3, 5e-3, 10e-3}};
  int top = -1, bottom = -1;
  for (int f = 0; f < 6; f++) {
    if (blocks.survey.face[f].normal[2] > 0.5) top = f;
    if (blocks.survey.face[f].normal[2] < -0.5) bottom = f;
  }
  blocks.parts.part[0].origin[bottom].number = blocks.parts.part[0].origin[top].number;
  CwCadPatch &rule = blocks.rule("lids");
  rule.near = {1, point};
  strcpy(rule.domain, "rotor");
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(blocks.count("lids", CW_PATCH_WALL), 2);
}

static void kinds_must_fit(void **) {
  Blocks blocks;
  int common = 0;
  while (blocks.contact[common].part < 0) common++;
  char touching[16], other[16], *texts[] = {touching}, *others[] = {other};
  snprintf(touching, sizeof touching, "%d", common + 1);
  snprintf(other, sizeof other, "%d", common ? common : 2);
  CwCadPatch &rule = blocks.rule("gate");
  rule.faces = {1, texts};
  rule.kind = CW_CAD_KIND_WALL;
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "touches stator; allowed there: interface"));
  rule.kind = CW_CAD_KIND_INTERFACE;
  assert_int_equal(blocks.make(), CW_OK);
  assert_int_equal(blocks.count("gate", CW_PATCH_INTERFACE), 1);
  rule.faces = {1, others};
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "touches no other domain; allowed: interface only"));
  rule.kind = CW_CAD_KIND_SYMMETRY;
  assert_int_equal(blocks.make(), CW_OK);
  assert_int_equal(blocks.count("gate", CW_PATCH_SYMMETRY), 1);
}

static void rules_without_a_face_are_told(void **) {
  Blocks blocks;
  char pattern[] = "PS*", *texts[] = {pattern};
  double point[][3] = {{1, 1, 1}};
  CwCadPatch &rule = blocks.rule("blade");
  rule.faces = {1, texts};
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "cad.patches.blade.faces: 'PS*' matches no face"));
  rule.faces = {0, nullptr};
  rule.near = {1, point};
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  const char *told = strstr(cw_fail_message(), "cad.patches.blade.near_mm: no face lies within");
  double within = 0, at[3] = {0, 0, 0};
  assert_non_null(told);
  assert_int_equal(sscanf(told, "cad.patches.blade.near_mm: no face lies within %lf mm of (%lf, %lf, %lf)", &within, at,
                          at + 1, at + 2),
                   4);
  for (double x : at) assert_true(x == 1000);
  assert_true(within > 0 && within < 1000);
}

// Also beside a name that matches.
static void colours_and_layers_without_a_face_are_told(void **) {
  Blocks blocks;
  char number[] = "1", layer[] = "wet", *numbers[] = {number}, *layers[] = {layer};
  CwCadPatch &rule = blocks.rule("lid");
  rule.faces = {1, numbers};
  rule.colour = 0x00ff00;
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "cad.patches.lid.colour: no face has its colour, #00ff00"));
  rule.colour = -1;
  rule.layers = {1, layers};
  strcpy(rule.domain, "rotor");
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "cad.patches.lid.layer: no face of rotor has its layer, 'wet'"));
  blocks.parts.part[0].origin[1].layers = {"dry", "wet"};
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(blocks.made.patch[blocks.made.of_face[0]].rule, 0);
  assert_int_equal(blocks.made.patch[blocks.made.of_face[1]].rule, 0);
}

static void rules_that_come_too_late_are_told(void **) {
  Blocks blocks;
  char number[] = "3", all[] = "*", *numbers[] = {number}, *patterns[] = {all};
  blocks.rule("all").faces = {1, patterns};
  blocks.rule("one").faces = {1, numbers};
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  assert_non_null(
      strstr(cw_fail_message(), "cad.patches.one: earlier patches take all its faces, such as face 3 (all); "));
}

// A point beside the edge between two pieces of one face chooses both; between two faces it chooses none.
static void edges_of_pieces_are_no_edges(void **) {
  Blocks blocks;
  double point[][3] = {{5e-3, 5e-6, 10e-3}};
  int top = -1, side = -1;
  for (int f = 0; f < 6; f++) {
    if (blocks.survey.face[f].normal[2] > 0.5) top = f;
    if (blocks.survey.face[f].normal[1] < -0.5) side = f;
  }
  CwCadPatch &rule = blocks.rule("lid");
  rule.near = {1, point};
  strcpy(rule.domain, "rotor");
  assert_int_equal(blocks.make(), CW_ERR_INPUT);
  assert_non_null(strstr(cw_fail_message(), "cad.patches.lid.near_mm: (5, 0.005, 10) lies as near to another face, "));
  blocks.parts.part[0].origin[side].number = blocks.parts.part[0].origin[top].number;
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(blocks.count("lid", CW_PATCH_WALL), 2);
}

// A strip of 0.05 mm on a plate of 100 mm: its own point chooses it, and one that is a little off it too.
static void points_choose_narrow_faces(void **) {
  SmallParts small({{"plate", small_box(0, 0, 0, 100, 100, 0.05)}});
  CwCadPatch rule = {};
  CwFacePatches made = {};
  const CwFaceRole role[6] = {CW_ROLE_WALL, CW_ROLE_WALL, CW_ROLE_WALL, CW_ROLE_WALL, CW_ROLE_WALL, CW_ROLE_WALL};
  double point[][3] = {{0, 0, 0}};
  if (small.look()) fail_msg("%s", cw_fail_message());
  strcpy(rule.name, "edge");
  rule.near = {1, point};
  rule.colour = rule.turns = -1;
  small.cad.patch = &rule;
  small.cad.patch_count = 1;
  for (const double off : {0.0, 0.005e-3, 0.2e-3}) {
    for (int f = 0; f < 6; f++)
      if (small.survey.face[f].normal[0] > 0.5) memcpy(point[0], small.survey.face[f].at, sizeof point[0]);
    point[0][0] += off;
    const CwStatus status = cw_face_patches_make(&small.cad, &small_frame, &small.parts, &small.survey, small.contact,
                                                 role, small_tolerance, &made);
    assert_int_equal(status, off < 0.1e-3 ? CW_OK : CW_ERR_INPUT);
    int taken = 0;
    for (int f = 0; status == CW_OK && f < 6; f++) taken += made.patch[made.of_face[f]].rule == 0;
    if (status == CW_OK) assert_int_equal(taken, 1);
    cw_face_patches_free(&made);
  }
}

// A name with brackets is that name, not a pattern that has none of them; without one of that name it is a pattern.
static void names_with_brackets_match_themselves(void **) {
  Blocks blocks;
  char name[] = "Face[1]", *names[] = {name};
  blocks.parts.part[0].origin[1].name = "Face[1]";
  blocks.parts.part[0].origin[2].name = "Face1";
  CwCadPatch &rule = blocks.rule("lid");
  rule.faces = {1, names};
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(blocks.made.patch[blocks.made.of_face[1]].rule, 0);
  assert_int_equal(blocks.made.patch[blocks.made.of_face[2]].rule, -1);
  blocks.parts.part[0].origin[1].name = "";
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(blocks.made.patch[blocks.made.of_face[2]].rule, 0);
}

// A point takes one of two faces of which nobody knows what they are pieces of.
static void faces_of_no_known_origin_are_no_pieces(void **) {
  Blocks blocks;
  double point[][3] = {{5e-3, 5e-3, 10e-3}};
  for (CwCadFaceOrigin &origin : blocks.parts.part[0].origin) origin.number = -1;
  CwCadPatch &rule = blocks.rule("lid");
  rule.near = {1, point};
  strcpy(rule.domain, "rotor");
  if (blocks.make()) fail_msg("%s", cw_fail_message());
  assert_int_equal(blocks.count("lid", CW_PATCH_WALL), 1);
}

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(without_rules_faces_are_proposed),
                                     cmocka_unit_test(names_of_the_file_are_cleaned),
                                     cmocka_unit_test(the_first_rule_has_a_face),
                                     cmocka_unit_test(rules_hold_for_proposals_of_their_name),
                                     cmocka_unit_test(points_take_all_pieces_of_a_face),
                                     cmocka_unit_test(kinds_must_fit),
                                     cmocka_unit_test(rules_without_a_face_are_told),
                                     cmocka_unit_test(rules_that_come_too_late_are_told),
                                     cmocka_unit_test(colours_and_layers_without_a_face_are_told),
                                     cmocka_unit_test(edges_of_pieces_are_no_edges),
                                     cmocka_unit_test(points_choose_narrow_faces),
                                     cmocka_unit_test(names_with_brackets_match_themselves),
                                     cmocka_unit_test(faces_of_no_known_origin_are_no_pieces)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
