// SPDX-License-Identifier: AGPL-3.0-or-later
// The arrays of pump.cgns, read by HDF5: those of a whole pump beside its regions, and long ones of a region by hand.
#include <hdf5.h>

#include "export/cgns_file.h"
#include "pipeline/file_digest.h"
#include "tests/draw.h"
#include "tests/export/whole_mesh.h"
#include "tests/mpi_group.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

static CwRanks ranks = {.size = 1};
static WholeMesh whole;
static CwAssembly assembly;

static int make(void **state) {
  if (make_test_folder(state) || whole_mesh_make(in_test_folder("run"), &ranks, &whole, &assembly)) return -1;
  whole.mesh.interface_count = 0; // connections are no part of what is filled in
  return 0;
}

static int release(void **state) {
  cw_assembly_free(&assembly);
  whole_mesh_free(&whole);
  return clear_test_folder(state);
}

// Writes the regions of an assembly, the last one first where `backwards`. The digest that the writer keeps is the
// file's.
static void write_file(const CwAssembly *a, const CwRegionData *regions, int wide, CwCgnsProfile profile,
                       int backwards) {
  static CwCase table;
  const char *path = in_test_folder("pump.cgns");
  CwCgnsFile file = {.wide = wide, .profile = profile};
  char kept[CW_HASH_TEXT], wanted[CW_HASH_TEXT];
  unlink(path);
  assert_int_equal(cw_cgns_tree_write(path, a, NULL, &table, wide), CW_OK);
  assert_int_equal(cw_cgns_open(test_folder, a, &ranks, &file), CW_OK);
  assert_int_equal(cw_cgns_write_shared(&file), CW_OK);
  for (int i = 0; i < a->mesh->region_count; ++i) {
    const int r = backwards ? a->mesh->region_count - 1 - i : i;
    assert_int_equal(cw_cgns_write_region(&file, r, &regions[r]), CW_OK);
  }
  cw_file_sum_digest(&file.sum, file.size, kept);
  assert_int_equal(cw_cgns_close(&file), CW_OK);
  assert_int_equal(cw_file_digest(path, wanted), CW_OK);
  assert_string_equal(kept, wanted);
}

// All values of an array of a zone, as new memory, and how many.
static void *read_array(const char *zone, const char *node, hid_t type, int64_t *count) {
  char path[200];
  snprintf(path, sizeof path, "/pump/%s/%s/ data", zone, node);
  hid_t file = H5Fopen(in_test_folder("pump.cgns"), H5F_ACC_RDONLY, H5P_DEFAULT),
        set = H5Dopen2(file, path, H5P_DEFAULT), space = H5Dget_space(set);
  if (set < 0) fail_msg("no %s", path);
  *count = H5Sget_simple_extent_npoints(space);
  void *values = malloc((size_t)*count * 8);
  assert_non_null(values);
  assert_true(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(file);
  return values;
}

// A zone as it was read.
typedef struct {
  const char *name;
  int64_t points;
  double *x[3];
} Zone;

static Zone zone_read(const char *name) {
  static const char *const nodes[] = {"GridCoordinates/CoordinateX", "GridCoordinates/CoordinateY",
                                      "GridCoordinates/CoordinateZ"};
  Zone zone = {.name = name};
  for (int k = 0; k < 3; ++k) zone.x[k] = read_array(name, nodes[k], H5T_NATIVE_DOUBLE, &zone.points);
  return zone;
}

static void zone_free(Zone *zone) {
  for (int k = 0; k < 3; ++k) free(zone->x[k]);
}

// Elements of one kind of a region; `patch`: of faces, that on which each lies.
typedef struct {
  const int32_t *nodes;
  int32_t count;
  const int32_t *patch;
} Elements;

typedef enum { TETRAHEDRA, PYRAMIDS, PRISMS, TRIANGLES, QUADS, KINDS } Kind;
static const int nodes_of[KINDS] = {4, 5, 6, 3, 4};

static Elements elements_of(const CwRegionData *r, Kind kind) {
  const Elements all[KINDS] = {{*r->tetrahedra, r->tetrahedron_count, NULL},
                               {*r->pyramids, r->pyramid_count, NULL},
                               {*r->prisms, r->prism_count, NULL},
                               {*r->triangles, r->triangle_count, r->triangle_patch},
                               {*r->quads, r->quad_count, r->quad_patch}};
  return all[kind];
}

// The elements of a section are those of the regions of the domain, one region after the other: corners lie at the same
// places, in turn from corner `first` on. Of faces those on a patch of the domain. Returns how many.
static int64_t check_section(const Zone *zone, const CwMesh *mesh, const CwRegionData *regions, int domain, Kind kind,
                             int patch, const char *name, int first) {
  char node[100];
  int64_t size, at = 0;
  const int n = nodes_of[kind];
  int64_t any = 0;
  for (int r = 0; r < mesh->region_count; ++r) {
    const Elements e = elements_of(&regions[r], kind);
    for (int32_t i = 0; i < e.count && regions[r].domain == domain; ++i) any += !e.patch || e.patch[i] == patch;
  }
  if (!any) return 0;
  snprintf(node, sizeof node, "%s/ElementConnectivity", name);
  int64_t *numbers = read_array(zone->name, node, H5T_NATIVE_INT64, &size);
  assert_int_equal(size, any * n);
  for (int r = 0; r < mesh->region_count; ++r) {
    const Elements e = elements_of(&regions[r], kind);
    for (int32_t i = 0; i < e.count && regions[r].domain == domain; ++i) {
      if (e.patch && e.patch[i] != patch) continue;
      for (int k = 0; k < n; ++k, ++at) {
        const double *x = regions[r].points[e.nodes[i * n + (first + k) % n]];
        const int64_t number = numbers[at] - 1;
        assert_true(number >= 0 && number < zone->points);
        for (int c = 0; c < 3; ++c)
          if (zone->x[c][number] != x[c]) fail_msg("%s of %s: corner %lld", name, zone->name, (long long)at);
      }
    }
  }
  free(numbers);
  return any;
}

static int compare_places(const void *a, const void *b) {
  return memcmp(a, b, 3 * sizeof(double));
}

// No point stands twice: corners that lie alike have one number.
static void check_points(const Zone *zone) {
  double(*x)[3] = malloc((size_t)zone->points * sizeof *x);
  assert_non_null(x);
  for (int64_t p = 0; p < zone->points; ++p)
    for (int k = 0; k < 3; ++k) x[p][k] = zone->x[k][p] + 0.0; // -0 is 0
  qsort(x, (size_t)zone->points, sizeof *x, compare_places);
  for (int64_t p = 1; p < zone->points; ++p) assert_true(compare_places(x[p - 1], x[p]) != 0);
  free(x);
}

static void check_zones(const CwMesh *mesh, const CwRegionData *regions, CwCgnsProfile profile) {
  static const char *const cells[] = {"tetrahedra", "pyramids", "prisms"};
  char name[60];
  int64_t all = 0, wanted = 0;
  for (int r = 0; r < mesh->region_count; ++r)
    for (int kind = 0; kind < KINDS; ++kind) wanted += elements_of(&regions[r], (Kind)kind).count;
  for (int d = 0; d < mesh->domain_count; ++d) {
    Zone zone = zone_read(mesh->domains[d].zone);
    check_points(&zone);
    for (int kind = TETRAHEDRA; kind <= PRISMS; ++kind) {
      const int first = kind == PRISMS && profile == CW_CGNS_VENDOR ? 3 : 0; // its triangles change places
      all += check_section(&zone, mesh, regions, d, (Kind)kind, 0, cells[kind], first);
    }
    for (int p = 0; p < mesh->domains[d].patch_count; ++p)
      for (int quads = 0; quads < 2; ++quads) {
        snprintf(name, sizeof name, "%s_%s", mesh->patches[mesh->domains[d].first_patch + p].name,
                 quads ? "quads" : "triangles");
        all += check_section(&zone, mesh, regions, d, quads ? QUADS : TRIANGLES, p, name, 0);
      }
    zone_free(&zone);
  }
  assert_int_equal(all, wanted);
}

static void all_cells_and_faces_of_a_pump_are_there(void **state) {
  for (int wide = 0; wide < 2; ++wide)
    for (int vendor = 0; vendor < 2; ++vendor) {
      const CwCgnsProfile profile = vendor ? CW_CGNS_VENDOR : CW_CGNS_STRICT;
      if (wide && vendor) continue;
      write_file(&assembly, whole.regions, wide, profile, 0);
      check_zones(&whole.mesh, whole.regions, profile);
    }
}

static void any_order_of_regions_gives_the_same_bytes(void **state) {
  size_t size[2];
  char *bytes[2];
  for (int k = 0; k < 2; ++k) {
    write_file(&assembly, whole.regions, 0, CW_CGNS_STRICT, k);
    bytes[k] = read_whole(in_test_folder("pump.cgns"), &size[k]);
  }
  assert_int_equal(size[0], size[1]);
  assert_memory_equal(bytes[0], bytes[1], size[0]);
  free(bytes[0]);
  free(bytes[1]);
}

// One region with more of all things than are written at once: 2^15 numbers of 64 bits, 2^16 of 32. Its elements have
// any corners, its faces lie on two patches in no order.
enum { POINTS = 70001, ELEMENTS = 24001, SHARED = 5 };

typedef struct {
  double points[POINTS][3];
  int32_t tetrahedra[ELEMENTS][4], pyramids[ELEMENTS][5], prisms[ELEMENTS][6], triangles[ELEMENTS][3],
      quads[ELEMENTS][4], triangle_patch[ELEMENTS], quad_patch[ELEMENTS];
  int64_t shared_id[SHARED];
} Arrays;

static void draw_elements(int32_t *nodes, int count, uint64_t *seed) {
  for (int i = 0; i < count; ++i) nodes[i] = (int32_t)draw_below(seed, POINTS);
}

static void long_arrays_are_whole(void **state) {
  static Arrays a;
  static CwModelPatch patches[] = {{.name = "hub"}, {.name = "shroud"}};
  static CwMeshRegion region = {.region = 1};
  uint64_t seed = 5;
  CwMesh mesh = {.domain_count = 1, .patch_count = 2, .patches = patches, .region_count = 1, .regions = &region};
  mesh.domains[0] = (CwMeshDomain){.name = "rotor", .zone = "ROTOR", .shared_points = SHARED, .patch_count = 2};
  for (int p = 0; p < POINTS; ++p) memcpy(a.points[p], (double[]){p, draw(&seed), draw(&seed)}, sizeof *a.points);
  draw_elements(*a.tetrahedra, 4 * ELEMENTS, &seed);
  draw_elements(*a.pyramids, 5 * ELEMENTS, &seed);
  draw_elements(*a.prisms, 6 * ELEMENTS, &seed);
  draw_elements(*a.triangles, 3 * ELEMENTS, &seed);
  draw_elements(*a.quads, 4 * ELEMENTS, &seed);
  CwFaceCount faces[2] = {{0}};
  for (int f = 0; f < ELEMENTS; ++f) {
    faces[a.triangle_patch[f] = draw_below(&seed, 5) > 0].triangles++;
    faces[a.quad_patch[f] = draw_below(&seed, 5) > 0].quads++;
  }
  double shared[SHARED][3];
  for (int s = 0; s < SHARED; ++s) { // the region has them in another order
    a.shared_id[s] = SHARED - 1 - s;
    memcpy(shared[SHARED - 1 - s], a.points[s], sizeof *shared);
  }
  const CwRegionData data = {.point_count = POINTS,
                             .shared_count = SHARED,
                             .points = a.points,
                             .shared_id = a.shared_id,
                             .tetrahedron_count = ELEMENTS,
                             .pyramid_count = ELEMENTS,
                             .prism_count = ELEMENTS,
                             .triangle_count = ELEMENTS,
                             .quad_count = ELEMENTS,
                             .tetrahedra = a.tetrahedra,
                             .pyramids = a.pyramids,
                             .prisms = a.prisms,
                             .triangles = a.triangles,
                             .quads = a.quads,
                             .triangle_patch = a.triangle_patch,
                             .quad_patch = a.quad_patch};
  CwRegionPlace place = {.own_point = SHARED};
  CwPatchPart parts[2] = {{.faces = faces[0]}, {.faces = faces[1]}};
  CwAssembly one = {.mesh = &mesh, .places = &place, .parts = parts, .patches = parts, .shared = {shared}};
  one.totals[0] = (CwDomainTotal){
      .points = POINTS, .tetrahedra = ELEMENTS, .pyramids = ELEMENTS, .prisms = ELEMENTS, .cells = 3 * ELEMENTS};
  for (int wide = 0; wide < 2; ++wide) {
    write_file(&one, &data, wide, CW_CGNS_STRICT, 0);
    check_zones(&mesh, &data, CW_CGNS_STRICT);
  }
}

// A file that is not there, one that HDF5 did not make, and one that was laid down for another pump.
static void files_of_others_are_told(void **state) {
  static CwCase table;
  CwCgnsFile file = {0};
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  unlink(in_test_folder("pump.cgns"));
  assert_int_equal(cw_cgns_open(test_folder, &assembly, &ranks, &file), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "pump.cgns"));
  cw_fail_clear();
  assert_int_equal(cw_cgns_close(&file), CW_OK);
  write_text(in_test_folder("pump.cgns"), "no HDF5");
  file = (CwCgnsFile){0};
  assert_int_equal(cw_cgns_open(test_folder, &assembly, &ranks, &file), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "pump.cgns: cannot be read by HDF5"));
  cw_fail_clear();
  assert_int_equal(cw_cgns_close(&file), CW_OK);
  unlink(in_test_folder("pump.cgns"));
  assert_int_equal(cw_cgns_tree_write(in_test_folder("pump.cgns"), &assembly, NULL, &table, 0), CW_OK);
  strcpy(whole.mesh.domains[1].zone, "CASING");
  file = (CwCgnsFile){0};
  assert_int_equal(cw_cgns_open(test_folder, &assembly, &ranks, &file), CW_ERR_LIBRARY);
  assert_non_null(strstr(cw_fail_message(), "pump.cgns: has no '/pump/CASING/GridCoordinates/CoordinateX/ data'"));
  cw_fail_clear();
  assert_int_equal(cw_cgns_close(&file), CW_OK);
  strcpy(whole.mesh.domains[1].zone, "STATOR");
}

int main(int argc, char **argv) {
  begin_mpi(&argc, &argv, &ranks);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(all_cells_and_faces_of_a_pump_are_there),
      cmocka_unit_test(any_order_of_regions_gives_the_same_bytes),
      cmocka_unit_test(long_arrays_are_whole),
      cmocka_unit_test(files_of_others_are_told),
  };
  return end_mpi(cmocka_run_group_tests(tests, make, release));
}
