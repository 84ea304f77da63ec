// SPDX-License-Identifier: AGPL-3.0-or-later
// A mesh that is written in parts beside the one that OpenFOAM's decomposePar makes of the whole, cell by cell alike;
// its solver in both; and labels of 64 bits.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"
#include "tests/whole_file.h"

enum { PARTS = 4 }; // of 5 regions

static char run[sizeof test_folder + 10];
static char output[STAGE_OUTPUT_SIZE], other[STAGE_OUTPUT_SIZE];

// A file of lists of labels, as bytes, from the bracket of the first list.
typedef struct {
  char *bytes;
  const char *from;
  long count; // of the first list
} Lists;

static Lists read_lists(const char *path) {
  Lists lists = {.bytes = read_whole(path, NULL)};
  const char *at = strstr(lists.bytes, "\n}\n") + 3;
  while (*at < '0' || *at > '9') at = *at == '/' ? strchr(at, '\n') : at + 1; // comments
  char *end;
  lists.count = strtol(at, &end, 10);
  lists.from = strchr(end, '(') + 1;
  return lists;
}

static int make_run(void **state) {
  char more[100];
  SyntheticPump pump = synthetic_pump();
  if (make_test_folder(state) || stage_run_make(test_folder, &pump)) return -1;
  snprintf(run, sizeof run, "%s/run", test_folder);
  if (stage_export_with(run, 1, "export: {formats: openfoam}", output)) return -1;
  stage_shell(output, "cp -r '%s/export/openfoam' '%s/whole'", run, test_folder);
  snprintf(more, sizeof more, "export: {formats: openfoam}\nopenfoam: {processors: %d}", PARTS);
  if (stage_export_with(run, 2, more, output)) return -1;
  stage_shell(output, "cp -r '%s/export/openfoam' '%s/parts'", run, test_folder);
  return 0;
}

// The whole mesh, divided by decomposePar as the exporter has divided it.
static void decompose(void) {
  char path[STAGE_PATH_SIZE + 100];
  int32_t part_of[100000];
  int cells = 0;
  for (int p = 0; p < PARTS; ++p) {
    snprintf(path, sizeof path, "%s/parts/processor%d/constant/polyMesh/cellProcAddressing", test_folder, p);
    Lists list = read_lists(path);
    for (long i = 0; i < list.count; ++i) {
      int32_t cell;
      memcpy(&cell, list.from + 4 * i, 4);
      part_of[cell] = p;
    }
    cells += (int)list.count;
    free(list.bytes);
  }
  snprintf(path, sizeof path, "%s/whole/constant/cellDecomposition", test_folder);
  FILE *out = fopen(path, "w");
  fprintf(out, "FoamFile { version 2.0; format ascii; class labelList; object cellDecomposition; }\n%d\n(\n", cells);
  for (int i = 0; i < cells; ++i) fprintf(out, "%d\n", part_of[i]);
  fprintf(out, ")\n");
  fclose(out);
  if (stage_shell(output,
                  "cd '%s/whole' && sed -i '/^numberOf/,$d' system/decomposeParDict && echo 'numberOfSubdomains %d; "
                  "method manual; coeffs { dataFile \"cellDecomposition\"; }' >> system/decomposeParDict && "
                  "decomposePar",
                  test_folder, PARTS))
    fail_msg("%s", output);
}

static void parts_are_those_of_decomposepar(void **state) {
  stage_need_program("decomposePar");
  static const char *const names[] = {
      "points", "faces", "owner", "neighbour", "cellProcAddressing", "faceProcAddressing", "pointProcAddressing"};
  decompose();
  for (int p = 0; p < PARTS; ++p)
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
      char path[2][STAGE_PATH_SIZE + 100];
      Lists list[2];
      for (int k = 0; k < 2; ++k) {
        snprintf(path[k], sizeof path[k], "%s/%s/processor%d/constant/polyMesh/%s", test_folder, k ? "whole" : "parts",
                 p, names[i]);
        list[k] = read_lists(path[k]);
      }
      assert_int_equal(list[0].count, list[1].count);
      const long size = list[0].count * (i == 0 ? 24 : 4);
      if (memcmp(list[0].from, list[1].from, (size_t)size) != 0) fail_msg("%s differs", path[0]);
      if (i == 1) { // the corners behind the offsets of the faces
        int32_t corners;
        const char *at[2];
        memcpy(&corners, list[0].from + size - 4, 4);
        for (int k = 0; k < 2; ++k) at[k] = strchr(list[k].from + size + 1, '(') + 1;
        if (memcmp(at[0], at[1], 4 * (size_t)corners) != 0) fail_msg("%s: the corners differ", path[0]);
      }
      free(list[0].bytes);
      free(list[1].bytes);
    }
  // Patches to other parts, of both the same.
  assert_int_equal(stage_shell(output,
                               "cd '%s' && for p in $(seq 0 %d); do for c in parts whole; do tr -d ' ' < "
                               "$c/processor$p/constant/polyMesh/boundary | grep -E "
                               "'^(procB|nFaces|startFace|neighbProc|[a-z_]+$)' > $c.told; done; "
                               "diff parts.told whole.told || exit 1; done",
                               test_folder, PARTS - 1),
                   0);
}

static void the_parts_are_balanced_and_sound(void **state) {
  stage_need_program("checkMesh");
  stage_shell(output, "cd '%s/parts' && mpirun -n %d checkMesh -parallel -allTopology -allGeometry", test_folder,
              PARTS);
  if (!strstr(output, "Mesh OK") || strstr(output, "***")) fail_msg("%s", output);
  stage_shell(other, "cd '%s/whole' && checkMesh", test_folder);
  static const char *const same[] = {"Total volume = ", "\n    cells: "};
  for (int i = 0; i < 2; ++i)
    assert_near(strtod(strstr(output, same[i]) + strlen(same[i]), NULL),
                strtod(strstr(other, same[i]) + strlen(same[i]), NULL), 1e-9);
  int least = 1 << 30, most = 0;
  for (int p = 0; p < PARTS; ++p) {
    stage_shell(output, "grep -a -o 'nCells:[0-9]*' '%s/parts/processor%d/constant/polyMesh/owner'", test_folder, p);
    const int cells = atoi(output + 7);
    least = cells < least ? cells : least;
    most = cells > most ? cells : most;
  }
  assert_true(most - least <= 1);
}

// The solver's residuals on both, but for the order in which ranks sum; on the whole mesh by one rank alike within the
// tolerance of the linear solvers.
static void residuals_are_those_of_the_decomposed_case(void **state) {
  enum { SOLVED = 14 }; // of two iterations: U, twice p, epsilon and k
  static const char words[] = "Initial residual = ";
  static const struct {
    const char *folder, *launch;
  } runs[] = {{"parts", "mpirun -n 4 simpleFoam -parallel"},
              {"whole", "mpirun -n 4 simpleFoam -parallel"},
              {"whole", "simpleFoam"}};
  double residual[3][SOLVED] = {{0}};
  int count[3] = {0};
  stage_need_program("simpleFoam");
  stage_need_program("decomposePar");
  for (int k = 0; k < 3; ++k) {
    if (stage_shell(output, "cd '%s/%s' && sed -i 's/endTime  .*/endTime 2;/' system/controlDict && %s", test_folder,
                    runs[k].folder, runs[k].launch))
      fail_msg("%s", output);
    for (const char *at = output; (at = strstr(at, words)) && count[k] < SOLVED; ++count[k])
      residual[k][count[k]] = strtod(at += strlen(words), NULL);
  }
  assert_int_equal(count[0], SOLVED);
  assert_int_equal(count[1], count[0]);
  assert_int_equal(count[2], count[0]);
  for (int i = 0; i < count[0]; ++i) {
    assert_near(residual[0][i] / residual[1][i], 1, 1e-6);
    assert_near(residual[0][i] / residual[2][i], 1, 0.1); // relTol of the momentum and turbulence equations
  }
}

// The run in time begins in each part with the steady flow of that part; called again it has nothing to say of links.
static void the_rotor_turns_from_the_steady_flow_of_the_parts(void **state) {
  stage_need_program("pimpleFoam");
  // One step of 60 / 1450 / 360 s; none of the two is long enough for a report, which the scripts end with.
  int code =
      stage_shell(output,
                  "cd '%s/parts' && export LC_ALL=C && "
                  "sed -i 's/endTime  .*/endTime 2;/; s/writeInterval .*/writeInterval 2;/' system/controlDict && "
                  "sed -i 's/endTime  .*/endTime 1e-4;/; s/writeInterval .*/writeInterval 1;/' "
                  "transient/system/controlDict && { ./Allrun; ./transient/Allrun; ./transient/Allrun; :; } && "
                  "ls transient/processor3/0.000114942529/U && for p in 0 1 2 3; do for f in U p k; do "
                  "for of in processor$p/2 transient/processor$p/0; do sed '/^boundaryField/,$d' $of/$f | "
                  "md5sum; done | uniq | wc -l; done; done",
                  test_folder);
  if (code) fail_msg("%s", output);
  assert_non_null(strstr(output, "starts from iteration 2 of the steady run\n"));
  assert_null(strstr(output, "ln: "));
  // Twelve times the same inside.
  assert_non_null(strstr(output, "/U\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n1\n"));
  stage_shell(output, "grep -c movingWallVelocity '%s/parts/transient/processor0/0/U'", test_folder);
  assert_true(atoi(output) > 0);
}

// As many ranks as parts run the case's own scripts; another number is told.
static void the_scripts_know_the_parts(void **state) {
  stage_need_program("simpleFoam");
  assert_int_equal(stage_shell(output, "cd '%s/parts' && ./Allrun 3", test_folder), 1);
  assert_string_equal(output, "Allrun: RANKS is '3'; allowed: 4, for which the mesh is divided\n");
  assert_int_equal(
      stage_shell(output, "cd '%s/parts' && ./Allclean && ls processor3 && ./Allclean && ls processor3", test_folder),
      0);
  assert_string_equal(output, "0\nconstant\n0\nconstant\n");
}

static void labels_of_64_bits_hold_the_same_numbers(void **state) {
  static const char *const names[] = {"owner", "neighbour", "faces"};
  char path[STAGE_PATH_SIZE + 100];
  if (stage_export_with(run, 1, "export: {formats: openfoam}\nopenfoam: {labels: 64}", output)) fail_msg("%s", output);
  for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
    snprintf(path, sizeof path, "%s/export/openfoam/constant/polyMesh/%s", run, names[i]);
    Lists wide = read_lists(path);
    assert_non_null(strstr(wide.bytes, "\"LSB;label=64;scalar=64\""));
    snprintf(path, sizeof path, "%s/whole/constant/polyMesh/%s", test_folder, names[i]);
    Lists narrow = read_lists(path);
    assert_int_equal(wide.count, narrow.count);
    for (long k = 0; k < wide.count; ++k) {
      int64_t x;
      int32_t y;
      memcpy(&x, wide.from + 8 * k, 8);
      memcpy(&y, narrow.from + 4 * k, 4);
      assert_int_equal(x, y);
    }
    free(wide.bytes);
    free(narrow.bytes);
  }
}

static void too_many_parts_are_told(void **state) {
  static const char more[] = "export: {formats: openfoam}\nopenfoam: {processors: 99999}";
  assert_int_not_equal(stage_export_with(run, 1, more, output), 0);
  assert_non_null(strstr(output, "99999 parts of "));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(parts_are_those_of_decomposepar),
      cmocka_unit_test(the_parts_are_balanced_and_sound),
      cmocka_unit_test(residuals_are_those_of_the_decomposed_case),
      cmocka_unit_test(the_rotor_turns_from_the_steady_flow_of_the_parts),
      cmocka_unit_test(the_scripts_know_the_parts),
      cmocka_unit_test(labels_of_64_bits_hold_the_same_numbers),
      cmocka_unit_test(too_many_parts_are_told),
  };
  return cmocka_run_group_tests(tests, make_run, clear_test_folder);
}
