// SPDX-License-Identifier: AGPL-3.0-or-later
// The small files of a polyMesh of four patches, by hand.
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "export/foam_boundary.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

enum { PATCHES = 4, FIRST = 100 }; // FIRST: faces between cells

// What was written behind the head, without blanks; "" where there is no file. It is removed.
static void content(const char *name, char text[4000]) {
  const char *path = in_test_folder(name);
  FILE *file = fopen(path, "r");
  size_t count = 0;
  int letter;
  while (file && (letter = fgetc(file)) != EOF && count < 3999)
    if (letter != ' ') text[count++] = (char)letter;
  text[count] = '\0';
  if (!file) return;
  fclose(file);
  unlink(path);
  char *end = strstr(text, "\n}\n\n");
  assert_non_null(end);
  memmove(text, end + 4, strlen(end + 4) + 1);
}

static void write_files(const CwPatchKind kind[PATCHES]) {
  static const CwFaceCount count[PATCHES] = {{3, 0}, {20, 10}, {0, 2}, {1, 1}};
  CwModelPatch patches[PATCHES];
  CwPatchPart sums[PATCHES];
  CwFaceCount first[PATCHES + 1] = {{FIRST, 0}};
  static const char *const names[PATCHES] = {"a", "b", "c", "d"};
  for (int p = 0; p < PATCHES; p++) {
    patches[p] = (CwModelPatch){.kind = kind[p], .flow_share = 1};
    strcpy(patches[p].name, names[p]);
    sums[p] = (CwPatchPart){.faces = count[p]};
    first[p + 1] = (CwFaceCount){first[p].triangles + count[p].triangles, first[p].quads + count[p].quads};
  }
  CwMesh input = {.patch_count = PATCHES, .patches = patches};
  CwAssembly assembly = {.mesh = &input, .patches = sums};
  CwPart part = {.patch = (CwFaceCount *)count};
  CwFoamPart laid = {.patch = first};
  CwFoamMesh mesh = {
      .assembly = &assembly, .division = {.assembly = &assembly, .part_count = 1, .parts = &part}, .parts = &laid};
  assert_int_equal(cw_foam_boundary_write(&mesh, 0, test_folder), CW_OK);
}

// One inlet and one outlet are patches; several are a zone too, wherever they stand among the patches.
static void several_ends_are_a_zone(void **state) {
  const CwPatchKind one[] = {CW_PATCH_INLET, CW_PATCH_WALL, CW_PATCH_WALL, CW_PATCH_OUTLET};
  const CwPatchKind inlets[] = {CW_PATCH_INLET, CW_PATCH_WALL, CW_PATCH_INLET, CW_PATCH_OUTLET};
  const CwPatchKind outlets[] = {CW_PATCH_OUTLET, CW_PATCH_WALL, CW_PATCH_INLET, CW_PATCH_OUTLET};
  char text[4000];
  write_files(one);
  content("faceZones", text);
  assert_string_equal(text, "");
  content("boundary", text);
  assert_string_equal(text, "4\n(\na\n{\ntypepatch;\nnFaces3;\nstartFace100;\n}\n"
                            "b\n{\ntypewall;\ninGroups1(wall);\nnFaces30;\nstartFace103;\n}\n"
                            "c\n{\ntypewall;\ninGroups1(wall);\nnFaces2;\nstartFace133;\n}\n"
                            "d\n{\ntypepatch;\nnFaces2;\nstartFace135;\n}\n)\n");
  write_files(inlets);
  content("boundary", text);
  content("faceZones", text);
  assert_string_equal(text,
                      "1\n(\ninlets\n{\ntypefaceZone;\nfaceLabelsList<label>\n5\n(\n100\n101\n102\n133\n134\n)\n;\n"
                      "flipMapList<bool>5{0};\n}\n)\n");
  write_files(outlets);
  content("boundary", text);
  content("faceZones", text);
  assert_string_equal(text,
                      "1\n(\noutlets\n{\ntypefaceZone;\nfaceLabelsList<label>\n5\n(\n100\n101\n102\n135\n136\n)\n;\n"
                      "flipMapList<bool>5{0};\n}\n)\n");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(several_ends_are_a_zone)};
  return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
