// SPDX-License-Identifier: AGPL-3.0-or-later
// Reads pump.cgns back with the CGNS library, and checks what cgnscheck and the audit of the mesh itself
// (tests/measure/cgns_audit.c, test_cgns_faults.c) do not: that the cells fill the solid, that each condition has its
// family, that the interface is complete and lies where it says, which equations the file names, and that files with
// 64-bit integers or for VTK hold the same mesh.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgnslib.h>
#include <jansson.h>

#include "tests/export/stage_run.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

static char output[STAGE_OUTPUT_SIZE];
static int file;

typedef struct {
  cgsize_t size[3];
  double *x[3];
  cgsize_t cells, pyramids;
  cgsize_t *boundary_nodes; // four for each element behind the cells, 0 at the end of a triangle
} Zone;

static int open_export(void **state) {
  SyntheticPump pump = synthetic_pump();
  pump.pyramids = 1;
  return make_test_folder(state) || stage_cgns_open(test_folder, &pump, output, &file);
}

static int close_export(void **state) {
  cg_close(file);
  return clear_test_folder(state);
}

static void node_place(const Zone *z, cgsize_t node, double x[3]) {
  for (int k = 0; k < 3; ++k) x[k] = z->x[k][node - 1];
}

// By the cross product of the diagonals, or of two edges; the shapes here have flat faces.
static double area_of(const Zone *z, const cgsize_t *n, int count) {
  double a[3], b[3], c[3], d[3], u[3], v[3], area[3];
  node_place(z, n[0], a);
  node_place(z, n[1], b);
  node_place(z, n[2], c);
  node_place(z, n[count - 1], d);
  for (int k = 0; k < 3; ++k) {
    u[k] = count == 3 ? b[k] - a[k] : c[k] - a[k];
    v[k] = count == 3 ? c[k] - a[k] : d[k] - b[k];
  }
  for (int k = 0; k < 3; ++k) area[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
  return 0.5 * sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
}

static void zone_read(int number, Zone *z) {
  static const char *const names[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
  char name[33];
  int sections;
  cgsize_t one = 1, next = 1;
  memset(z, 0, sizeof *z);
  assert_int_equal(cg_zone_read(file, 1, number, name, z->size), 0);
  for (int k = 0; k < 3; ++k) {
    z->x[k] = malloc((size_t)z->size[0] * sizeof(double));
    assert_int_equal(cg_coord_read(file, 1, number, names[k], RealDouble, &one, &z->size[0], z->x[k]), 0);
  }
  z->cells = z->size[1];
  assert_int_equal(cg_nsections(file, 1, number, &sections), 0);
  for (int s = 1; s <= sections; ++s) {
    ElementType_t type;
    cgsize_t first, last, size;
    int boundary, parents, nodes;
    assert_int_equal(cg_section_read(file, 1, number, s, name, &type, &first, &last, &boundary, &parents), 0);
    assert_int_equal(first, next); // no gap, no overlap
    next = last + 1;
    if (type == PYRA_5) z->pyramids += last - first + 1;
    if (first <= z->cells) continue;
    assert_true(type == TRI_3 || type == QUAD_4);
    cg_npe(type, &nodes);
    cg_ElementDataSize(file, 1, number, s, &size);
    assert_int_equal(size, (last - first + 1) * nodes);
    cgsize_t *data = malloc((size_t)size * sizeof *data);
    assert_int_equal(cg_elements_read(file, 1, number, s, data, NULL), 0);
    z->boundary_nodes = realloc(z->boundary_nodes, (size_t)(4 * (last - z->cells)) * sizeof *data);
    for (cgsize_t e = first; e <= last; ++e) {
      cgsize_t *to = z->boundary_nodes + 4 * (e - z->cells - 1);
      to[3] = 0;
      memcpy(to, data + (e - first) * nodes, (size_t)nodes * sizeof *data);
    }
    free(data);
  }
}

static void zone_free(Zone *z) {
  for (int k = 0; k < 3; ++k) free(z->x[k]);
  free(z->boundary_nodes);
}

static void cells_are_sound_and_fill_the_solid(void **state) {
  static const char *const names[] = {"ROTOR", "STATOR"};
  char words[40];
  const char *path = in_test_folder("run/mesh/manifest.json");
  json_t *manifest = json_load_file(path, 0, NULL);
  if (stage_shell(output, "'%s/cgns_audit' '%s/run/export/pump.cgns'", CUTWATER_BIN_DIR, test_folder))
    fail_msg("%s", output);
  for (int number = 1; number <= 2; ++number) {
    Zone z;
    zone_read(number, &z);
    double solid = json_number_value(
        json_object_get(json_array_get(json_object_get(manifest, "domains"), (size_t)number - 1), "solid_volume_m3"));
    snprintf(words, sizeof words, "\"zone\": \"%s\"", names[number - 1]);
    const char *zone = strstr(output, words), *volume = zone ? strstr(zone, "\"volume\": ") : NULL;
    assert_non_null(volume);
    assert_near(strtod(volume + strlen("\"volume\": "), NULL) / solid, 1, 1e-9);
    // Every ninth of the 90 cells around the stator holds five; the rotor's section is left out.
    assert_int_equal(z.pyramids, number == 1 ? 0 : 50);
    zone_free(&z);
  }
  json_decref(manifest);
}

static void every_condition_has_its_family(void **state) {
  const int conditions_wanted[] = {10, 8};
  for (int number = 1; number <= 2; ++number) {
    int conditions;
    assert_int_equal(cg_nbocos(file, 1, number, &conditions), 0);
    assert_int_equal(conditions, conditions_wanted[number - 1]);
    for (int c = 1; c <= conditions; ++c) {
      char name[33], family[33];
      BCType_t type;
      PointSetType_t set;
      GridLocation_t location;
      DataType_t normal_type;
      cgsize_t count, normals;
      int normal_index[3], sets;
      assert_int_equal(
          cg_boco_info(file, 1, number, c, name, &type, &set, &count, normal_index, &normals, &normal_type, &sets), 0);
      assert_int_equal(type, FamilySpecified);
      assert_int_equal(set, PointRange);
      assert_int_equal(cg_boco_gridlocation_read(file, 1, number, c, &location), 0);
      assert_int_equal(location, FaceCenter);
      assert_int_equal(cg_goto(file, 1, "Zone_t", number, "ZoneBC_t", 1, "BC_t", c, "end"), 0);
      assert_int_equal(cg_famname_read(family), 0);
      assert_string_equal(family, name);
    }
  }
}

static void the_interface_is_whole_and_lies_on_its_donors(void **state) {
  Zone zones[2];
  zone_read(1, &zones[0]);
  zone_read(2, &zones[1]);
  for (int side = 0; side < 2; ++side) {
    int connections;
    char name[33], donor_zone[33];
    GridLocation_t location;
    GridConnectivityType_t type;
    PointSetType_t set, donor_set;
    ZoneType_t donor_type;
    DataType_t data_type;
    cgsize_t count, donor_count, range[2];
    assert_int_equal(cg_nconns(file, 1, side + 1, &connections), 0);
    assert_int_equal(connections, 1);
    assert_int_equal(cg_conn_info(file, 1, side + 1, 1, name, &location, &type, &set, &count, donor_zone, &donor_type,
                                  &donor_set, &data_type, &donor_count),
                     0);
    assert_int_equal(type, Abutting);
    assert_int_equal(location, FaceCenter);
    assert_int_equal(donor_set, CellListDonor);
    assert_string_equal(donor_zone, side ? "ROTOR" : "STATOR");
    cgsize_t *donors = malloc((size_t)donor_count * sizeof *donors);
    double *place = malloc(2 * (size_t)donor_count * sizeof *place);
    assert_int_equal(cg_conn_read(file, 1, side + 1, 1, range, data_type, donors), 0);
    assert_int_equal(range[1] - range[0] + 1, donor_count);
    assert_int_equal(cg_goto(file, 1, "Zone_t", side + 1, "ZoneGridConnectivity_t", 1, "GridConnectivity_t", 1, "end"),
                     0);
    assert_int_equal(cg_array_read(1, place), 0);
    double area = 0;
    for (cgsize_t i = 0; i < donor_count; ++i) {
      const Zone *here = &zones[side], *there = &zones[1 - side];
      const cgsize_t *n = here->boundary_nodes + 4 * (range[0] + i - here->cells - 1);
      const cgsize_t *d = there->boundary_nodes + 4 * (donors[i] - there->cells - 1);
      double r = place[2 * i], s = place[2 * i + 1], centre[3] = {0}, over[3] = {0}, x[3];
      const double weights3[] = {1 - r - s, r, s}, weights4[] = {(1 - r) * (1 - s), r * (1 - s), r * s, (1 - r) * s};
      int corners = n[3] ? 4 : 3, donor_corners = d[3] ? 4 : 3;
      for (int c = 0; c < corners; ++c) {
        node_place(here, n[c], x);
        assert_near(hypot(x[0], x[1]), 0.101, 1e-12);
        for (int k = 0; k < 3; ++k) centre[k] += x[k] / corners;
      }
      for (int c = 0; c < donor_corners; ++c) {
        node_place(there, d[c], x);
        for (int k = 0; k < 3; ++k) over[k] += (donor_corners == 3 ? weights3[c] : weights4[c]) * x[k];
      }
      // Both lie on chords of the same circle: apart by less than the two sagittas, 0.1 mm each.
      assert_true(hypot(hypot(centre[0] - over[0], centre[1] - over[1]), centre[2] - over[2]) < 2e-4);
      area += area_of(here, n, corners);
    }
    // A cylinder of 8 mm, less what 72 or 90 chords cut off.
    int chords = side ? 90 : 72;
    assert_near(area, 0.008 * 2 * chords * 0.101 * sin(M_PI / chords), 1e-12);
    free(donors);
    free(place);
  }
  zone_free(&zones[0]);
  zone_free(&zones[1]);
}

static void rotation_and_units_are_there(void **state) {
  float rate[3], centre[3];
  MassUnits_t mass;
  LengthUnits_t length;
  TimeUnits_t time;
  TemperatureUnits_t temperature;
  AngleUnits_t angle;
  cg_goto(file, 1, "Zone_t", 1, "end");
  assert_int_equal(cg_rotating_read(rate, centre), 0);
  assert_near(rate[2], 1450 * M_PI / 30, 1e-4);
  assert_near(fabs(rate[0]) + fabs(rate[1]) + fabs(centre[0]) + fabs(centre[1]) + fabs(centre[2]), 0, 0);
  cg_goto(file, 1, "Zone_t", 2, "end");
  assert_int_equal(cg_rotating_read(rate, centre), CG_NODE_NOT_FOUND);
  cg_goto(file, 1, "end");
  assert_int_equal(cg_units_read(&mass, &length, &time, &temperature, &angle), 0);
  assert_true(mass == Kilogram && length == Meter && time == Second && angle == Radian);
}

// By the y+ that the walls were made for, as the set-ups of the solvers have it.
static void the_equations_follow_from_the_walls(void **state) {
  static const struct {
    const char *y_plus;
    GoverningEquationsType_t equations;
    int found;
    ModelType_t model;
  } walls[] = {{"30.0", NSTurbulent, CG_OK, TwoEquation_JonesLaunder},
               {"1.0", NSTurbulent, CG_OK, TwoEquation_MenterSST},
               {"null", NSLaminar, CG_NODE_NOT_FOUND, ModelTypeNull}};
  const char *run = in_test_folder("walls"), *path = in_test_folder("walls/export/pump.cgns");
  assert_int_equal(stage_shell(output, "cp -r '%s/run' '%s'", test_folder, run), 0);
  for (size_t i = 0; i < sizeof walls / sizeof *walls; ++i) {
    GoverningEquationsType_t equations;
    ModelType_t model;
    int one;
    assert_int_equal(stage_walls_set(run, NULL, walls[i].y_plus, output), 0);
    assert_int_equal(stage_export(run, 1, output), 0);
    assert_int_equal(cg_open(path, CG_MODE_READ, &one), CG_OK);
    assert_int_equal(cg_goto(one, 1, "FlowEquationSet_t", 1, "end"), CG_OK);
    assert_int_equal(cg_governing_read(&equations), CG_OK);
    assert_int_equal(equations, walls[i].equations);
    assert_int_equal(cg_model_read("TurbulenceModel_t", &model), walls[i].found);
    if (walls[i].found == CG_OK) assert_int_equal(model, walls[i].model);
    cg_close(one);
  }
}

// The nodes of all elements of a file, section by section, in *nodes, and how many of the elements are prisms.
static cgsize_t all_nodes(const char *path, int bits, cgsize_t **nodes, cgsize_t *prisms) {
  int one, precision, sections, boundary, parents;
  cgsize_t count = 0, first, last, size;
  char name[33];
  ElementType_t type;
  *nodes = NULL;
  *prisms = 0;
  assert_int_equal(cg_open(path, CG_MODE_READ, &one), CG_OK);
  assert_int_equal(cg_precision(one, &precision), CG_OK);
  assert_int_equal(precision, bits);
  for (int number = 1; number <= 2; ++number) {
    assert_int_equal(cg_nsections(one, 1, number, &sections), CG_OK);
    for (int s = 1; s <= sections; ++s) {
      assert_int_equal(cg_section_read(one, 1, number, s, name, &type, &first, &last, &boundary, &parents), CG_OK);
      assert_int_equal(cg_ElementDataSize(one, 1, number, s, &size), CG_OK);
      *nodes = realloc(*nodes, (size_t)(count + size) * sizeof **nodes);
      assert_int_equal(cg_elements_read(one, 1, number, s, *nodes + count, NULL), CG_OK);
      if (type == PENTA_6) *prisms += last - first + 1;
      count += size;
    }
  }
  cg_close(one);
  return count;
}

// The same nodes in 64 bits; for VTK too, but that the two triangles of each prism have changed places.
static void other_files_hold_the_same_mesh(void **state) {
  const char *run = in_test_folder("kinds"), *path = in_test_folder("kinds/export/pump.cgns");
  cgsize_t *strict, *other, prisms, found, turned = 0;
  assert_int_equal(stage_shell(output, "cp -r '%s/run' '%s'", test_folder, run), 0);
  const cgsize_t count = all_nodes(path, 32, &strict, &prisms);
  assert_int_equal(stage_export_with(run, 2, "cgns: {integers: 64}", output), 0);
  assert_int_equal(all_nodes(path, 64, &other, &found), count);
  assert_memory_equal(other, strict, (size_t)count * sizeof *other);
  free(other);
  assert_int_equal(stage_export_with(run, 2, "cgns: {profile: vendor}\nexport: {formats: cgns}", output), 0);
  assert_int_equal(all_nodes(path, 32, &other, &found), count);
  assert_int_equal(found, prisms);
  for (cgsize_t i = 0; i < count; ++i) {
    if (other[i] == strict[i]) continue;
    assert_memory_equal(other + i, strict + i + 3, 3 * sizeof *other);
    assert_memory_equal(other + i + 3, strict + i, 3 * sizeof *other);
    ++turned;
    i += 5;
  }
  assert_true(prisms > 0);
  assert_int_equal(turned, prisms);
  free(other);
  free(strict);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cells_are_sound_and_fill_the_solid),
      cmocka_unit_test(every_condition_has_its_family),
      cmocka_unit_test(the_interface_is_whole_and_lies_on_its_donors),
      cmocka_unit_test(rotation_and_units_are_there),
      cmocka_unit_test(the_equations_follow_from_the_walls),
      cmocka_unit_test(other_files_hold_the_same_mesh),
  };
  return cmocka_run_group_tests(tests, open_export, close_export);
}
