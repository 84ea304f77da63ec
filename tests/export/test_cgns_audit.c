// SPDX-License-Identifier: AGPL-3.0-or-later
// Reads pump.cgns back with the CGNS library and checks what cgnscheck does not: that every cell is positive
// and the cells fill the solid, that every face is shared by two cells or is one boundary element with its
// normal outward, that every boundary element belongs to one condition, and that the interface is complete
// and lies where it says.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cgnslib.h>
#include <jansson.h>

#include "tests/export/stage_run.h"
#include "tests/unit_test.h"

static char folder[STAGE_PATH_SIZE];
static char output[STAGE_OUTPUT_SIZE];
static int file;

// One side of a face: sorted nodes, 0 at the end of a triangle, and its area vector.
typedef struct {
  cgsize_t nodes[4];
  double area[3];
  int is_boundary;
} Side;

typedef struct {
  cgsize_t size[3];
  double *x[3];
  cgsize_t cells, elements, pyramids;
  Side *sides;
  int side_count;
  double volume, least_volume;
  cgsize_t *boundary_nodes; // four for each element behind the cells
} Zone;

static int open_export(void **state) {
  SyntheticPump pump = synthetic_pump();
  pump.pyramids = 1;
  return stage_cgns_open(folder, &pump, output, &file);
}

static int close_export(void **state) {
  cg_close(file);
  stage_folder_remove(folder);
  return 0;
}

static void node_place(const Zone *z, cgsize_t node, double x[3]) {
  for (int k = 0; k < 3; ++k) x[k] = z->x[k][node - 1];
}

// Area vector by the cross product of the diagonals, or of two edges; the shapes here have flat faces.
static void area_of(const Zone *z, const cgsize_t *n, int count, double area[3]) {
  double a[3], b[3], c[3], d[3], u[3], v[3];
  node_place(z, n[0], a);
  node_place(z, n[1], b);
  node_place(z, n[2], c);
  node_place(z, n[count - 1], d);
  for (int k = 0; k < 3; ++k) {
    u[k] = count == 3 ? b[k] - a[k] : c[k] - a[k];
    v[k] = count == 3 ? c[k] - a[k] : d[k] - b[k];
  }
  area[0] = 0.5 * (u[1] * v[2] - u[2] * v[1]);
  area[1] = 0.5 * (u[2] * v[0] - u[0] * v[2]);
  area[2] = 0.5 * (u[0] * v[1] - u[1] * v[0]);
}

static int compare_nodes(const void *left, const void *right) {
  const cgsize_t *a = left, *b = right;
  return (*a > *b) - (*a < *b);
}

static void add_side(Zone *z, const cgsize_t *nodes, int count, int is_boundary) {
  Side *side = &z->sides[z->side_count++];
  memset(side, 0, sizeof *side);
  memcpy(side->nodes, nodes, (size_t)count * sizeof *nodes);
  qsort(side->nodes, (size_t)count, sizeof *nodes, compare_nodes);
  area_of(z, nodes, count, side->area);
  side->is_boundary = is_boundary;
}

static void add_cell(Zone *z, const cgsize_t *n, int count) {
  // Faces as the CGNS standard lists them, 1-based, 0 at the end of a triangle.
  static const int tetrahedron[4][4] = {{1, 3, 2, 0}, {1, 2, 4, 0}, {2, 3, 4, 0}, {3, 1, 4, 0}};
  static const int pyramid[5][4] = {{1, 4, 3, 2}, {1, 2, 5, 0}, {2, 3, 5, 0}, {3, 4, 5, 0}, {4, 1, 5, 0}};
  static const int prism[5][4] = {{1, 2, 5, 4}, {2, 3, 6, 5}, {3, 1, 4, 6}, {1, 3, 2, 0}, {4, 5, 6, 0}};
  double centre[3] = {0}, volume = 0;
  for (int i = 0; i < count; ++i) {
    double x[3];
    node_place(z, n[i], x);
    for (int k = 0; k < 3; ++k) centre[k] += x[k] / count;
  }
  for (int f = 0; f < (count == 4 ? 4 : 5); ++f) {
    const int *face = count == 4 ? tetrahedron[f] : count == 5 ? pyramid[f] : prism[f];
    cgsize_t nodes[4];
    int corners = face[3] ? 4 : 3;
    double x[3];
    for (int i = 0; i < corners; ++i) nodes[i] = n[face[i] - 1];
    add_side(z, nodes, corners, 0);
    node_place(z, nodes[0], x);
    for (int k = 0; k < 3; ++k) volume += z->sides[z->side_count - 1].area[k] * (x[k] - centre[k]) / 3;
  }
  z->volume += volume;
  z->least_volume = fmin(z->least_volume, volume);
}

static void zone_read(int number, Zone *z) {
  static const char *const names[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
  char name[33];
  int sections;
  cgsize_t one = 1;
  memset(z, 0, sizeof *z);
  z->least_volume = INFINITY;
  assert_int_equal(cg_zone_read(file, 1, number, name, z->size), 0);
  for (int k = 0; k < 3; ++k) {
    z->x[k] = malloc((size_t)z->size[0] * sizeof(double));
    assert_int_equal(cg_coord_read(file, 1, number, names[k], RealDouble, &one, &z->size[0], z->x[k]), 0);
  }
  z->cells = z->size[1];
  assert_int_equal(cg_nsections(file, 1, number, &sections), 0);
  for (int pass = 0; pass < 2; ++pass) {
    cgsize_t next = 1;
    for (int s = 1; s <= sections; ++s) {
      ElementType_t type;
      cgsize_t first, last, size;
      int boundary, parents, nodes;
      assert_int_equal(cg_section_read(file, 1, number, s, name, &type, &first, &last, &boundary, &parents), 0);
      assert_int_equal(first, next); // no gap, no overlap
      next = last + 1;
      if (!pass) continue;
      cg_npe(type, &nodes);
      cg_ElementDataSize(file, 1, number, s, &size);
      assert_int_equal(size, (last - first + 1) * nodes);
      cgsize_t *data = malloc((size_t)size * sizeof *data);
      assert_int_equal(cg_elements_read(file, 1, number, s, data, NULL), 0);
      for (cgsize_t e = first; e <= last; ++e) {
        const cgsize_t *n = data + (e - first) * nodes;
        if (e <= z->cells) {
          assert_true(type == TETRA_4 || type == PYRA_5 || type == PENTA_6);
          z->pyramids += type == PYRA_5;
          add_cell(z, n, nodes);
        } else {
          assert_true(type == TRI_3 || type == QUAD_4);
          add_side(z, n, nodes, 1);
          memcpy(z->boundary_nodes + 4 * (e - z->cells - 1), n, (size_t)nodes * sizeof *n);
        }
      }
      free(data);
    }
    if (!pass) {
      z->elements = next - 1;
      z->sides = malloc((size_t)(5 * z->elements) * sizeof *z->sides);
      z->boundary_nodes = calloc((size_t)(4 * (z->elements - z->cells)), sizeof *z->boundary_nodes);
    }
  }
}

static void zone_free(Zone *z) {
  for (int k = 0; k < 3; ++k) free(z->x[k]);
  free(z->sides);
  free(z->boundary_nodes);
}

static int compare_sides(const void *left, const void *right) {
  return memcmp(left, right, sizeof((Side *)0)->nodes);
}

static void cells_are_positive_and_fill_the_solid(void **state) {
  char path[STAGE_PATH_SIZE + 40];
  snprintf(path, sizeof path, "%s/run/mesh/manifest.json", folder);
  json_t *manifest = json_load_file(path, 0, NULL);
  for (int number = 1; number <= 2; ++number) {
    Zone z;
    zone_read(number, &z);
    double solid = json_number_value(
        json_object_get(json_array_get(json_object_get(manifest, "domains"), (size_t)number - 1), "solid_volume_m3"));
    assert_true(z.least_volume > 0);
    // Every ninth of the 90 cells around the stator holds five; the rotor's section is left out.
    assert_int_equal(z.pyramids, number == 1 ? 0 : 50);
    assert_float_equal(z.volume / solid, 1, 1e-12);
    zone_free(&z);
  }
  json_decref(manifest);
}

static void every_face_has_two_sides(void **state) {
  for (int number = 1; number <= 2; ++number) {
    Zone z;
    zone_read(number, &z);
    qsort(z.sides, (size_t)z.side_count, sizeof *z.sides, compare_sides);
    assert_int_equal(z.side_count % 2, 0);
    for (int i = 0; i < z.side_count; i += 2) {
      const Side *a = &z.sides[i], *b = &z.sides[i + 1];
      assert_memory_equal(a->nodes, b->nodes, sizeof a->nodes);
      assert_true(i + 2 == z.side_count || compare_sides(a, a + 2) != 0);
      // Two cells look at each other; a boundary element looks the way its cell does.
      int same_way = a->is_boundary != b->is_boundary;
      assert_false(a->is_boundary && b->is_boundary);
      double area = sqrt(a->area[0] * a->area[0] + a->area[1] * a->area[1] + a->area[2] * a->area[2]);
      for (int k = 0; k < 3; ++k) assert_true(fabs(a->area[k] - (same_way ? b->area[k] : -b->area[k])) < 1e-9 * area);
    }
    zone_free(&z);
  }
}

static void every_boundary_element_has_one_condition(void **state) {
  const int conditions_wanted[] = {10, 8};
  for (int number = 1; number <= 2; ++number) {
    Zone z;
    int conditions;
    zone_read(number, &z);
    int *hits = calloc((size_t)z.elements + 1, sizeof *hits);
    assert_int_equal(cg_nbocos(file, 1, number, &conditions), 0);
    assert_int_equal(conditions, conditions_wanted[number - 1]);
    for (int c = 1; c <= conditions; ++c) {
      char name[33], family[33];
      BCType_t type;
      PointSetType_t set;
      GridLocation_t location;
      DataType_t normal_type;
      cgsize_t count, normals, range[2];
      int normal_index[3], sets;
      assert_int_equal(
          cg_boco_info(file, 1, number, c, name, &type, &set, &count, normal_index, &normals, &normal_type, &sets), 0);
      assert_int_equal(type, FamilySpecified);
      assert_int_equal(set, PointRange);
      assert_int_equal(cg_boco_read(file, 1, number, c, range, NULL), 0);
      assert_int_equal(cg_boco_gridlocation_read(file, 1, number, c, &location), 0);
      assert_int_equal(location, FaceCenter);
      assert_int_equal(cg_goto(file, 1, "Zone_t", number, "ZoneBC_t", 1, "BC_t", c, "end"), 0);
      assert_int_equal(cg_famname_read(family), 0);
      assert_string_equal(family, name);
      for (cgsize_t e = range[0]; e <= range[1]; ++e) ++hits[e];
    }
    for (cgsize_t e = 1; e <= z.elements; ++e) assert_int_equal(hits[e], e > z.cells);
    free(hits);
    zone_free(&z);
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
      double r = place[2 * i], s = place[2 * i + 1], centre[3] = {0}, over[3] = {0}, x[3], vector[3];
      const double weights3[] = {1 - r - s, r, s}, weights4[] = {(1 - r) * (1 - s), r * (1 - s), r * s, (1 - r) * s};
      int corners = n[3] ? 4 : 3, donor_corners = d[3] ? 4 : 3;
      for (int c = 0; c < corners; ++c) {
        node_place(here, n[c], x);
        assert_float_equal(hypot(x[0], x[1]), 0.101, 1e-12);
        for (int k = 0; k < 3; ++k) centre[k] += x[k] / corners;
      }
      for (int c = 0; c < donor_corners; ++c) {
        node_place(there, d[c], x);
        for (int k = 0; k < 3; ++k) over[k] += (donor_corners == 3 ? weights3[c] : weights4[c]) * x[k];
      }
      // Both lie on chords of the same circle: apart by less than the two sagittas, 0.1 mm each.
      assert_true(hypot(hypot(centre[0] - over[0], centre[1] - over[1]), centre[2] - over[2]) < 2e-4);
      area_of(here, n, corners, vector);
      area += sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
    }
    // A cylinder of 8 mm, less what 72 or 90 chords cut off.
    int chords = side ? 90 : 72;
    assert_float_equal(area, 0.008 * 2 * chords * 0.101 * sin(M_PI / chords), 1e-12);
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
  assert_float_equal(rate[2], 1450 * M_PI / 30, 1e-4);
  assert_float_equal(fabs(rate[0]) + fabs(rate[1]) + fabs(centre[0]) + fabs(centre[1]) + fabs(centre[2]), 0, 0);
  cg_goto(file, 1, "Zone_t", 2, "end");
  assert_int_equal(cg_rotating_read(rate, centre), CG_NODE_NOT_FOUND);
  cg_goto(file, 1, "end");
  assert_int_equal(cg_units_read(&mass, &length, &time, &temperature, &angle), 0);
  assert_true(mass == Kilogram && length == Meter && time == Second && angle == Radian);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(cells_are_positive_and_fill_the_solid),
      cmocka_unit_test(every_face_has_two_sides),
      cmocka_unit_test(every_boundary_element_has_one_condition),
      cmocka_unit_test(the_interface_is_whole_and_lies_on_its_donors),
      cmocka_unit_test(rotation_and_units_are_there),
  };
  return cmocka_run_group_tests(tests, open_export, close_export);
}
