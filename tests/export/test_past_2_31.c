// SPDX-License-Identifier: AGPL-3.0-or-later
// Every writer past 2^31 points, elements, faces, corners and bytes: a region of one cell behind one of thousands of
// millions, of which nothing is written. The files are full of holes and take no disk.
#include <string.h>

#include "export/cgns_file.h"
#include "export/fluent_mesh.h"
#include "export/foam_mesh.h"
#include "export/foam_region.h"
#include "pipeline/mesh/cell.h"
#include "tests/export/stage_run.h"
#include "tests/mpi_group.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static CwRanks ranks = {.size = 1};

// The last region: a tetrahedron, its four faces on the patch.
static double points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static int32_t tetrahedron[1][4] = {{0, 1, 2, 3}};
static int32_t triangles[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
static int32_t zeros[4], faces_of[4] = {0, 1, 2, 3};
static int32_t across[CW_CELL_FACES] = {CW_ACROSS_PATCH, CW_ACROSS_PATCH, CW_ACROSS_PATCH, CW_ACROSS_PATCH,
                                        CW_ACROSS_NO_FACE};
static CwRegionData data = {.point_count = 4,
                            .tetrahedron_count = 1,
                            .triangle_count = 4,
                            .points = points,
                            .tetrahedra = tetrahedron,
                            .triangles = triangles,
                            .triangle_patch = zeros,
                            .triangle_cell = zeros};
static CwRegionFaces faces = {.across = across, .triangle_face = faces_of};

// What the region before it has.
typedef struct {
  int64_t points, cells, inner, patch; // inner faces, faces on the patch
} Before;

typedef struct {
  CwModelPatch patch;
  CwMeshRegion regions[2];
  CwMesh mesh;
  CwRegionPlace places[2];
  CwPatchPart parts[2], sum;
  CwAssembly assembly;
} Large;

static void large_make(Before before, Large *l) {
  memset(l, 0, sizeof *l);
  l->patch = (CwModelPatch){.name = "hub", .kind = CW_PATCH_WALL};
  l->regions[0] = (CwMeshRegion){.own_points = before.points, .tetrahedra = before.cells};
  l->regions[1] = (CwMeshRegion){.own_points = 4, .tetrahedra = 1, .region = 2};
  l->mesh = (CwMesh){.domain_count = 1, .patches = &l->patch, .patch_count = 1};
  l->mesh.regions = l->regions, l->mesh.region_count = 2;
  l->mesh.domains[0] = (CwMeshDomain){.name = "rotor", .zone = "ROTOR", .patch_count = 1, .region_count = 2};
  l->places[0] = (CwRegionPlace){.inner.triangles = before.inner};
  l->places[1] = (CwRegionPlace){.own_point = before.points, .tetrahedron = before.cells, .cell = before.cells};
  l->parts[0] = (CwPatchPart){.faces.triangles = before.patch};
  l->parts[1] = (CwPatchPart){.faces.triangles = 4, .before.triangles = before.patch};
  l->sum = (CwPatchPart){.faces.triangles = before.patch + 4};
  l->assembly = (CwAssembly){.mesh = &l->mesh, .places = l->places, .parts = l->parts, .patches = &l->sum};
  l->assembly.totals[0] =
      (CwDomainTotal){.points = before.points + 4, .cells = before.cells + 1, .tetrahedra = before.cells + 1};
  l->assembly.shared[0] = points; // none of them
}

// `count` values of an array of the file from `first` on.
static void read_back(hid_t file, const char *path, int64_t size, int64_t first, hsize_t count, hid_t type, void *to) {
  hid_t set = H5Dopen2(file, path, H5P_DEFAULT), there = H5Dget_space(set), here = H5Screate_simple(1, &count, NULL);
  const hsize_t from = (hsize_t)first;
  if (set < 0) fail_msg("no %s", path);
  assert_int_equal(H5Sget_simple_extent_npoints(there), size);
  if ((int64_t)count < size) H5Sselect_hyperslab(there, H5S_SELECT_SET, &from, NULL, &count, NULL); // else of any shape
  assert_true(H5Dread(set, type, here, there, H5P_DEFAULT, to) >= 0);
  H5Sclose(here);
  H5Sclose(there);
  H5Dclose(set);
}

static void cgns_has_its_integers(void **state) {
  const Before before = {.points = 3000000000, .cells = 2200000000, .patch = 2500000000};
  static CwCase table;
  Large l;
  const char *path = in_test_folder("pump.cgns");
  CwCgnsFile out = {0};
  large_make(before, &l);
  assert_int_equal(cw_cgns_plan(&l.assembly, CW_INTEGERS_AUTO, &out.wide), CW_OK);
  assert_true(out.wide);
  assert_int_equal(cw_cgns_tree_write(path, &l.assembly, NULL, &table, out.wide), CW_OK);
  assert_int_equal(cw_cgns_open(test_folder, &l.assembly, &ranks, &out), CW_OK);
  assert_int_equal(cw_cgns_write_region(&out, 1, &data), CW_OK);
  assert_int_equal(cw_cgns_close(&out), CW_OK);

  int64_t range[2], node[12];
  double x[4];
  hid_t in = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
  read_back(in, "/pump/ROTOR/GridCoordinates/CoordinateY/ data", before.points + 4, before.points, 4, H5T_NATIVE_DOUBLE,
            x);
  for (int i = 0; i < 4; ++i) assert_true(x[i] == points[i][1]);
  read_back(in, "/pump/ROTOR/tetrahedra/ElementConnectivity/ data", 4 * (before.cells + 1), 4 * before.cells, 4,
            H5T_NATIVE_INT64, node);
  for (int i = 0; i < 4; ++i) assert_int_equal(node[i], before.points + tetrahedron[0][i] + 1);
  read_back(in, "/pump/ROTOR/hub_triangles/ElementConnectivity/ data", 3 * (before.patch + 4), 3 * before.patch, 12,
            H5T_NATIVE_INT64, node);
  for (int i = 0; i < 12; ++i) assert_int_equal(node[i], before.points + triangles[i / 3][i % 3] + 1);
  read_back(in, "/pump/ROTOR/ZoneBC/hub/PointRange/ data", 2, 0, 2, H5T_NATIVE_INT64, range);
  assert_int_equal(range[0], before.cells + 2);
  assert_int_equal(range[1], before.cells + 1 + before.patch + 4);
  H5Fclose(in);
  remove(path);
}

static int64_t integer_at(const char *path, int64_t at) {
  int64_t value = -1;
  FILE *in = fopen(path, "rb");
  assert_non_null(in);
  assert_int_equal(fseeko(in, at, SEEK_SET), 0);
  assert_int_equal(fread(&value, sizeof value, 1, in), 1);
  fclose(in);
  return value;
}

// Where the values of a file begin: behind the first bracket after the header.
static int64_t start_of(const char *path) {
  char head[1001] = {0};
  FILE *in = fopen(path, "rb");
  assert_non_null(in);
  assert_true(fread(head, 1, 1000, in) > 0);
  fclose(in);
  return strstr(strstr(head, "}\n\n"), "\n(") + 2 - head;
}

static void openfoam_has_its_labels(void **state) {
  // Cells, of which a case allows fewer, are a thousand: their numbers would be written for the zone.
  const Before before = {.points = 3000000000, .cells = 1000, .inner = 3000000000, .patch = 2500000000};
  const CwExportTable table = {.foam_processors = 1};
  const int64_t all = before.inner + before.patch;
  CwFoamMesh mesh = {0};
  Large l;
  const char *folder_of = in_test_folder("openfoam"), *path = in_test_folder("openfoam/constant/polyMesh/faces");
  char text[50];
  large_make(before, &l);
  assert_int_equal(stage_shell(text, "mkdir '%s' '%s/constant'", folder_of, folder_of), 0);
  assert_int_equal(cw_foam_layout_plan(&l.assembly, folder_of, &table, &mesh), CW_OK);
  assert_int_equal(mesh.label_size, 8);
  assert_int_equal(cw_foam_mesh_create(&mesh, &ranks), CW_OK);
  assert_int_equal(cw_foam_region_write(&mesh, 1, &data, &faces), CW_OK);
  cw_foam_layout_free(&mesh);

  int64_t at = start_of(path);
  for (int f = 0; f < 4; ++f) assert_int_equal(integer_at(path, at + 8 * (all + f)), 3 * (all + f));
  at += 8 * (all + 5) + snprintf(text, sizeof text, ")\n\n%lld\n(", (long long)(3 * (all + 4)));
  for (int f = 0; f < 4; ++f)
    for (int i = 0; i < 3; ++i)
      assert_int_equal(integer_at(path, at + 8 * (3 * (all + f) + i)), before.points + triangles[f][i]);
  path = in_test_folder("openfoam/constant/polyMesh/owner");
  for (int f = 0; f < 4; ++f) assert_int_equal(integer_at(path, start_of(path) + 8 * (all + f)), before.cells);
  path = in_test_folder("openfoam/constant/polyMesh/points");
  const int64_t bits = integer_at(path, start_of(path) + 24 * (before.points + 1));
  double x;
  memcpy(&x, &bits, sizeof x);
  assert_true(x == points[1][0]);
  remove_folder(folder_of);
}

// The mesh has fewer faces, but half of them are as many face corners.
static void a_part_has_its_labels(void **state) {
  const Before before = {.points = 100, .cells = 700000000, .inner = 1500000000};
  for (int is_auto = 0; is_auto < 2; ++is_auto) {
    const CwExportTable table = {.foam_processors = 2, .foam_labels = is_auto ? CW_INTEGERS_AUTO : CW_INTEGERS_32};
    CwFoamMesh mesh = {0};
    Large l;
    large_make(before, &l);
    assert_int_equal(cw_foam_layout_plan(&l.assembly, test_folder, &table, &mesh), CW_OK);
    assert_int_equal(mesh.label_size, 4);
    mesh.division.parts[0].inner.triangles = before.inner / 2;
    assert_int_equal(cw_foam_layout_parts(&mesh), is_auto ? CW_OK : CW_ERR_EXPORT);
    assert_int_equal(mesh.label_size, is_auto ? 8 : 4);
    cw_foam_layout_free(&mesh);
  }
}

static void fluent_has_its_lines(void **state) {
  // As many points and faces as the format allows, nearly: 150 and 99 gigabytes.
  const Before before = {.points = 2100000000, .cells = 1900000000, .inner = 1000000000, .patch = 1100000000};
  CwFluentMesh mesh = {0};
  Large l;
  const char *path = in_test_folder("pump.msh");
  char text[2000] = {0}, line[60];
  large_make(before, &l);
  assert_int_equal(cw_fluent_mesh_plan(&l.assembly, &mesh), CW_OK);
  assert_int_equal(cw_fluent_mesh_create(test_folder, &mesh), CW_OK);
  assert_int_equal(cw_fluent_mesh_write_region(&mesh, 1, &data, &faces), CW_OK);
  assert_int_equal(cw_fluent_mesh_close(&mesh), CW_OK);

  FILE *in = fopen(path, "rb");
  assert_non_null(in);
  assert_true(fread(text, 1, 600, in) > 0);
  const int64_t start = strstr(text, " 1 3)(\n") + 7 - text;
  assert_int_equal(fseeko(in, start + 72 * (before.points + 2), SEEK_SET), 0);
  double x[3];
  assert_int_equal(fscanf(in, "%lf %lf %lf", &x[0], &x[1], &x[2]), 3);
  for (int k = 0; k < 3; ++k) assert_true(x[k] == points[2][k]);
  assert_int_equal(fseeko(in, -600, SEEK_END), 0);
  memset(text, 0, sizeof text);
  assert_true(fread(text, 1, 600, in) > 0);
  fclose(in);
  const char *end = text;
  while (end < text + 600 && !*end) ++end; // what nobody has written
  for (int f = 0; f < 4; ++f) {            // turned over: the rule of the right hand points into the cell
    snprintf(line, sizeof line, "3 %08llx %08llx %08llx %08llx 00000000\n%s",
             (unsigned long long)(before.points + triangles[f][2] + 1),
             (unsigned long long)(before.points + triangles[f][1] + 1),
             (unsigned long long)(before.points + triangles[f][0] + 1), (unsigned long long)(before.cells + 1),
             f == 3 ? "))\n(45 " : "3 ");
    if (!strstr(end, line)) fail_msg("no '%s' in %s", line, end);
  }
  remove(path);
}

int main(int argc, char **argv) {
  begin_mpi(&argc, &argv, &ranks);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cgns_has_its_integers),
      cmocka_unit_test(openfoam_has_its_labels),
      cmocka_unit_test(a_part_has_its_labels),
      cmocka_unit_test(fluent_has_its_lines),
  };
  return end_mpi(cmocka_run_group_tests(tests, make_test_folder, remove_test_folder));
}
