// SPDX-License-Identifier: AGPL-3.0-or-later
// The nodes of pump.cgns of a pump of four zones, read by the CGNS library.
#include <cgnslib.h>

#include "export/cgns_file.h"
#include "tests/export/pump_by_hand.h"
#include "tests/refused_write.h"

static PumpByHand pump;
static CwInterface interfaces[INTERFACES];
static int64_t donors[INTERFACES][2][8];
static double places[INTERFACES][2][8][2];

static int64_t faces_of(int patch) {
  return cw_face_count(pump.parts[patch].faces);
}

// Two triangles and up to two quadrilaterals on each patch; donors are any faces of the other side.
static void make_pump(void) {
  static const CwDomainTotal totals[ZONES] = {
      {.points = 50, .tetrahedra = 20, .prisms = 5, .cells = 25},
      {.points = 12, .tetrahedra = 8, .cells = 8},
      {.points = 60, .tetrahedra = 30, .pyramids = 4, .prisms = 6, .cells = 40},
      {.points = 9, .prisms = 3, .cells = 3},
  };
  pump_by_hand(&pump);
  memcpy(pump.assembly.totals, totals, sizeof totals);
  for (int p = 0; p < PATCHES; ++p) pump.parts[p].faces = (CwFaceCount){p == LID ? 0 : 2, p == LID ? 0 : p % 3};
  for (int i = 0; i < INTERFACES; ++i)
    for (int side = 0; side < 2; ++side) {
      const int64_t count = faces_of(pump.interfaces[i].patch[side]),
                    others = faces_of(pump.interfaces[i].patch[1 - side]);
      interfaces[i].count[side] = count;
      interfaces[i].donor[side] = donors[i][side];
      interfaces[i].place[side] = places[i][side];
      for (int64_t f = 0; f < count; ++f) {
        donors[i][side][f] = (3 * f + 1) % others;
        for (int k = 0; k < 2; ++k) places[i][side][f][k] = (double)(i + 2 * side + 3 * f + 5 * k) / 32;
      }
    }
}

// The first number of the elements on a patch: behind the cells of its zone and the faces of the patches before it.
static int64_t first_face(int patch) {
  const CwMeshDomain *zone = &pump.mesh.domains[pump.patches[patch].domain];
  int64_t first = pump.assembly.totals[pump.patches[patch].domain].cells + 1;
  for (int p = zone->first_patch; p < patch; ++p) first += faces_of(p);
  return first;
}

// As a file called so, in integers of 32 or 64 bits.
static const char *write_tree(const char *name, int wide) {
  const char *path = in_test_folder(name);
  if (cw_cgns_tree_write(path, &pump.assembly, interfaces, &pump.table, wide) != CW_OK)
    fail_msg("%s", cw_fail_message());
  return path;
}

static const char *const trees[2] = {"narrow.cgns", "wide.cgns"};
static int files[2], file; // of the library; `file` is the first

static int open_trees(void **state) {
  if (make_test_folder(state)) return -1;
  make_pump();
  for (int wide = 0; wide < 2; ++wide)
    if (cg_open(write_tree(trees[wide], wide), CG_MODE_READ, &files[wide]) != CG_OK) return -1;
  file = files[0];
  return 0;
}

static int close_trees(void **state) {
  for (int wide = 0; wide < 2; ++wide) cg_close(files[wide]);
  return clear_test_folder(state);
}

// Only the rotor and its patches: few nodes.
static void make_small_pump(void) {
  make_pump();
  pump.mesh.domain_count = 1;
  pump.mesh.patch_count = DISC;
  pump.mesh.interface_count = 0;
}

// The number of a domain's zone for the library, which sorts them by name.
static int zone_of(int domain) {
  int count;
  assert_int_equal(cg_nzones(file, 1, &count), CG_OK);
  for (int z = 1; z <= count; ++z) {
    char name[33];
    cgsize_t size[3];
    assert_int_equal(cg_zone_read(file, 1, z, name, size), CG_OK);
    if (!strcmp(name, pump.mesh.domains[domain].zone)) return z;
  }
  fail_msg("no zone %s", pump.mesh.domains[domain].zone);
  return 0;
}

// The elements of a zone are numbered without a gap, with room for all corners.
static void zones_have_points_and_elements(void **state) {
  static const struct {
    ElementType_t type;
    int nodes;
  } kinds[] = {{TETRA_4, 4}, {PYRA_5, 5}, {PENTA_6, 6}, {TRI_3, 3}, {QUAD_4, 4}};
  for (int wide = 0; wide < 2; ++wide) {
    int count, dimension[2];
    file = files[wide];
    char name[33];
    assert_int_equal(cg_nbases(file, &count), CG_OK);
    assert_int_equal(count, 1);
    assert_int_equal(cg_base_read(file, 1, name, &dimension[0], &dimension[1]), CG_OK);
    assert_string_equal(name, "pump");
    assert_true(dimension[0] == 3 && dimension[1] == 3);
    assert_int_equal(cg_nzones(file, 1, &count), CG_OK);
    assert_int_equal(count, ZONES);
    for (int d = 0; d < ZONES; ++d) {
      const CwDomainTotal *total = &pump.assembly.totals[d];
      const CwMeshDomain *zone = &pump.mesh.domains[d];
      const int z = zone_of(d);
      cgsize_t size[3], next = 1;
      int section = 0, sections;
      assert_int_equal(cg_zone_read(file, 1, z, name, size), CG_OK);
      assert_true(size[0] == total->points && size[1] == total->cells && size[2] == 0);
      ZoneType_t type;
      assert_int_equal(cg_zone_type(file, 1, z, &type), CG_OK);
      assert_int_equal(type, Unstructured);
      assert_int_equal(cg_ncoords(file, 1, z, &count), CG_OK);
      assert_int_equal(count, 3);
      for (int s = -1; s < zone->patch_count; ++s) // the cells, then patch after patch
        for (int k = s < 0 ? 0 : 3; k < (s < 0 ? 3 : 5); ++k) {
          const CwFaceCount faces = s < 0 ? (CwFaceCount){0} : pump.parts[zone->first_patch + s].faces;
          const int64_t of[] = {total->tetrahedra, total->pyramids, total->prisms, faces.triangles, faces.quads};
          ElementType_t element;
          cgsize_t first, last, corners;
          int boundary, parents;
          if (of[k] == 0) continue;
          assert_int_equal(cg_section_read(file, 1, z, ++section, name, &element, &first, &last, &boundary, &parents),
                           CG_OK);
          assert_int_equal(element, kinds[k].type);
          assert_true(first == next && last == next + of[k] - 1);
          assert_int_equal(cg_ElementDataSize(file, 1, z, section, &corners), CG_OK);
          assert_int_equal(corners, of[k] * kinds[k].nodes);
          next = last + 1;
        }
      assert_int_equal(cg_nsections(file, 1, z, &sections), CG_OK);
      assert_int_equal(sections, section);
    }
  }
  file = files[0];
}

static void coordinates_are_lengths(void **state) {
  for (int z = 1; z <= ZONES; ++z)
    for (int k = 1; k <= 3; ++k) {
      char name[33], wanted[] = "CoordinateX";
      DataType_t type;
      float exponents[5];
      wanted[10] = "XYZ"[k - 1];
      assert_int_equal(cg_coord_info(file, 1, z, k, &type, name), CG_OK);
      assert_string_equal(name, wanted);
      assert_int_equal(type, RealDouble);
      assert_int_equal(cg_goto(file, 1, "Zone_t", z, "GridCoordinates_t", 1, "DataArray_t", k, "end"), CG_OK);
      assert_int_equal(cg_exponents_read(exponents), CG_OK);
      assert_memory_equal(exponents, ((float[]){0, 1, 0, 0, 0}), sizeof exponents);
    }
}

// Integers of 32 or 64 bits in every place that counts points or elements.
static void integers_are_as_wide_as_asked(void **state) {
  static const char *const sets[] = {"/pump/ROTOR/ data",
                                     "/pump/ROTOR/prisms/ElementRange/ data",
                                     "/pump/ROTOR/prisms/ElementConnectivity/ data",
                                     "/pump/ROTOR/ZoneBC/hub/PointRange/ data",
                                     "/pump/ROTOR/ZoneGridConnectivity/rotor_to_suction/PointRange/ data",
                                     "/pump/ROTOR/ZoneGridConnectivity/rotor_to_suction/CellListDonor/ data"};
  for (int wide = 0; wide < 2; ++wide) {
    hid_t file = H5Fopen(in_test_folder(trees[wide]), H5F_ACC_RDONLY, H5P_DEFAULT);
    for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
      hid_t set = H5Dopen2(file, sets[i], H5P_DEFAULT), type = H5Dget_type(set);
      if (set < 0) fail_msg("no %s", sets[i]);
      assert_int_equal(H5Tget_size(type), wide ? 8 : 4);
      H5Tclose(type);
      H5Dclose(set);
    }
    H5Fclose(file);
  }
}

// Each patch with faces has a condition over its faces, in the order of the mesh, that leads to its family.
static void each_patch_has_its_condition(void **state) {
  for (int d = 0; d < ZONES; ++d) {
    const CwMeshDomain *zone = &pump.mesh.domains[d];
    const int z = zone_of(d);
    int conditions, c = 0;
    char name[33];
    for (int p = zone->first_patch; p < zone->first_patch + zone->patch_count; ++p) {
      BCType_t type;
      PointSetType_t set;
      GridLocation_t location;
      DataType_t normal_type;
      cgsize_t count, normals, range[2];
      int normal[3], sets;
      if (p == LID) continue;
      assert_int_equal(cg_boco_info(file, 1, z, ++c, name, &type, &set, &count, normal, &normals, &normal_type, &sets),
                       CG_OK);
      assert_string_equal(name, pump.patches[p].name);
      assert_int_equal(type, FamilySpecified);
      assert_int_equal(set, PointRange);
      assert_int_equal(cg_boco_read(file, 1, z, c, range, NULL), CG_OK);
      assert_true(range[0] == first_face(p) && range[1] == first_face(p) + faces_of(p) - 1);
      assert_int_equal(cg_boco_gridlocation_read(file, 1, z, c, &location), CG_OK);
      assert_int_equal(location, FaceCenter);
      assert_int_equal(cg_goto(file, 1, "Zone_t", z, "ZoneBC_t", 1, "BC_t", c, "end"), CG_OK);
      assert_int_equal(cg_famname_read(name), CG_OK);
      assert_string_equal(name, pump.patches[p].name);
    }
    assert_int_equal(cg_nbocos(file, 1, z, &conditions), CG_OK);
    assert_int_equal(conditions, c);
  }
}

// A family of each patch with its kind, and one of each zone without.
static void families_have_kinds(void **state) {
  static const BCType_t kinds[] = {[CW_PATCH_WALL] = BCWallViscous,
                                   [CW_PATCH_INLET] = BCInflow,
                                   [CW_PATCH_OUTLET] = BCOutflow,
                                   [CW_PATCH_INTERFACE] = BCTypeUserDefined,
                                   [CW_PATCH_SYMMETRY] = BCSymmetryPlane};
  int count, patches = 0, zones = 0;
  char name[33], wanted[33];
  assert_int_equal(cg_nfamilies(file, 1, &count), CG_OK);
  assert_int_equal(count, PATCHES + ZONES);
  for (int f = 1; f <= count; ++f) {
    int conditions, geometries;
    BCType_t kind;
    assert_int_equal(cg_family_read(file, 1, f, name, &conditions, &geometries), CG_OK);
    for (int p = 0; p < PATCHES; ++p) {
      if (strcmp(name, pump.patches[p].name) != 0) continue;
      assert_int_equal(conditions, 1);
      assert_int_equal(cg_fambc_read(file, 1, f, 1, wanted, &kind), CG_OK);
      assert_int_equal(kind, kinds[pump.patches[p].kind]);
      patches++;
    }
    if (!conditions) zones++;
  }
  assert_int_equal(patches, PATCHES);
  assert_int_equal(zones, ZONES);
  for (int z = 0; z < ZONES; ++z) {
    assert_int_equal(cg_goto(file, 1, "Zone_t", zone_of(z), "end"), CG_OK);
    assert_int_equal(cg_famname_read(name), CG_OK);
    snprintf(wanted, sizeof wanted, "%.20s_domain", pump.mesh.domains[z].name);
    assert_string_equal(name, wanted);
  }
}

// Connection `c` of a zone, that of a side of an interface, is called so.
static void check_connection(int c, int i, int side, const char *wanted) {
  const int patch = pump.interfaces[i].patch[side], other = pump.interfaces[i].patch[1 - side];
  const int zone = zone_of(pump.patches[patch].domain);
  char name[33], donor_zone[33];
  GridLocation_t location;
  GridConnectivityType_t type;
  PointSetType_t set, donor_set;
  ZoneType_t donor_type;
  DataType_t data_type;
  cgsize_t count, donor_count, range[2], found[8], size[12];
  double place[8][2];
  int dimensions;
  assert_int_equal(cg_conn_info(file, 1, zone, c, name, &location, &type, &set, &count, donor_zone, &donor_type,
                                &donor_set, &data_type, &donor_count),
                   CG_OK);
  assert_string_equal(name, wanted);
  assert_string_equal(donor_zone, pump.mesh.domains[pump.patches[other].domain].zone);
  assert_true(location == FaceCenter && type == Abutting && set == PointRange && donor_set == CellListDonor);
  assert_int_equal(donor_count, faces_of(patch));
  assert_int_equal(cg_conn_read(file, 1, zone, c, range, data_type, found), CG_OK);
  assert_true(range[0] == first_face(patch) && range[1] == first_face(patch) + faces_of(patch) - 1);
  for (int64_t f = 0; f < donor_count; ++f) assert_int_equal(found[f], first_face(other) + donors[i][side][f]);
  assert_int_equal(cg_goto(file, 1, "Zone_t", zone, "ZoneGridConnectivity_t", 1, "GridConnectivity_t", c, "end"),
                   CG_OK);
  assert_int_equal(cg_array_info(1, name, &data_type, &dimensions, size), CG_OK);
  assert_string_equal(name, "InterpolantsDonor");
  assert_true(dimensions == 2 && size[0] == 2 && size[1] == donor_count); // r and s of a face beside one another
  assert_int_equal(cg_array_read(1, place), CG_OK);
  assert_memory_equal(place, places[i][side], (size_t)donor_count * sizeof *place);
}

static void interfaces_name_the_faces_of_the_other_side(void **state) {
  int count;
  check_connection(1, 0, 1, "rotor_to_suction");
  check_connection(2, 1, 0, "rotor_to_stator");
  check_connection(3, 2, 0, "rotor_to_chamber");
  check_connection(4, 3, 0, "rotor_to_stator_2");
  assert_int_equal(cg_nconns(file, 1, zone_of(ROTOR), &count), CG_OK);
  assert_int_equal(count, 4);
  check_connection(1, 2, 1, "chamber_to_rotor");
  check_connection(1, 1, 1, "stator_to_rotor");
  check_connection(2, 3, 1, "stator_to_rotor_2");
  assert_int_equal(cg_nconns(file, 1, zone_of(STATOR), &count), CG_OK);
  assert_int_equal(count, 2);
  check_connection(1, 0, 0, "suction_to_rotor");
}

// Zones that rotate, and no others, have their axis and speed.
static void frames_rotate_with_the_rotor(void **state) {
  for (int z = 0; z < ZONES; ++z) {
    float rate[3] = {1, 1, 1}, centre[3] = {1, 1, 1};
    assert_int_equal(cg_goto(file, 1, "Zone_t", zone_of(z), "end"), CG_OK);
    assert_int_equal(cg_rotating_read(rate, centre), z <= CHAMBER ? CG_OK : CG_NODE_NOT_FOUND);
    if (z > CHAMBER) continue;
    assert_memory_equal(rate, ((float[]){0, 0, 100}), sizeof rate);
    assert_memory_equal(centre, ((float[]){0, 0, 0}), sizeof centre);
  }
}

// Each with its unit: kg/m3, Pa = kg/(m s2), m2/s, m.
static void the_reference_state_is_that_of_the_case(void **state) {
  static const struct {
    const char *name;
    double value;
    float exponents[5];
  } arrays[] = {{"Density", 800, {1, -3, 0, 0, 0}},
                {"Pressure", 90000, {1, -1, -2, 0, 0}},
                {"ViscosityKinematic", 2e-6, {0, 2, -1, 0, 0}},
                {"LengthReference", 0.2, {0, 1, 0, 0, 0}}};
  int count;
  assert_int_equal(cg_goto(file, 1, "ReferenceState_t", 1, "end"), CG_OK);
  assert_int_equal(cg_narrays(&count), CG_OK);
  assert_int_equal(count, 4);
  for (int a = 1; a <= count; ++a) {
    char name[33];
    DataType_t type;
    int dimensions, known = 0;
    cgsize_t size[12];
    double value;
    float exponents[5];
    assert_int_equal(cg_goto(file, 1, "ReferenceState_t", 1, "end"), CG_OK);
    assert_int_equal(cg_array_info(a, name, &type, &dimensions, size), CG_OK);
    assert_int_equal(cg_array_read(a, &value), CG_OK);
    assert_int_equal(cg_goto(file, 1, "ReferenceState_t", 1, "DataArray_t", a, "end"), CG_OK);
    assert_int_equal(cg_exponents_read(exponents), CG_OK);
    for (int w = 0; w < 4; ++w) {
      if (strcmp(arrays[w].name, name) != 0) continue;
      known = 1;
      assert_near(value, arrays[w].value, 0);
      assert_memory_equal(exponents, arrays[w].exponents, sizeof exponents);
    }
    assert_true(known);
  }
  MassUnits_t mass;
  LengthUnits_t length;
  TimeUnits_t time;
  TemperatureUnits_t temperature;
  AngleUnits_t angle;
  assert_int_equal(cg_goto(file, 1, "end"), CG_OK);
  assert_int_equal(cg_units_read(&mass, &length, &time, &temperature, &angle), CG_OK);
  assert_true(mass == Kilogram && length == Meter && time == Second && temperature == Kelvin && angle == Radian);
}

static void equations_follow_from_the_walls(void **state) {
  static const struct {
    double y_plus;
    GoverningEquationsType_t equations;
    int found;
    ModelType_t model;
  } walls[] = {{30, NSTurbulent, CG_OK, TwoEquation_JonesLaunder},
               {1, NSTurbulent, CG_OK, TwoEquation_MenterSST},
               {NAN, NSLaminar, CG_NODE_NOT_FOUND, ModelTypeNull}};
  make_small_pump();
  for (int w = 0; w < 3; ++w) {
    int one;
    GoverningEquationsType_t equations;
    ModelType_t model = ModelTypeNull;
    pump_by_hand_y_plus(&pump, walls[w].y_plus);
    assert_int_equal(cg_open(write_tree("small.cgns", 0), CG_MODE_READ, &one), CG_OK);
    assert_int_equal(cg_goto(one, 1, "FlowEquationSet_t", 1, "end"), CG_OK);
    assert_int_equal(cg_governing_read(&equations), CG_OK);
    assert_int_equal(equations, walls[w].equations);
    assert_int_equal(cg_model_read("TurbulenceModel_t", &model), walls[w].found);
    assert_int_equal(model, walls[w].model);
    cg_close(one);
  }
}

// Who orders prisms as VTK does says so.
static void another_order_of_corners_is_told(void **state) {
  make_small_pump();
  for (int vendor = 0; vendor < 2; ++vendor) {
    int one, count;
    pump.table.output.cgns_profile = vendor ? CW_CGNS_VENDOR : CW_CGNS_STRICT;
    assert_int_equal(cg_open(write_tree("small.cgns", 0), CG_MODE_READ, &one), CG_OK);
    assert_int_equal(cg_goto(one, 1, "end"), CG_OK);
    assert_int_equal(cg_ndescriptors(&count), CG_OK);
    assert_int_equal(count, vendor);
    cg_close(one);
  }
}

// A zone may have 2^31 - 1 points and as many elements, faces with cells.
static void wide_integers_are_taken_where_they_must(void **state) {
  static const struct {
    int64_t points, cells, faces; // of the stator
    int fits;
  } sizes[] = {{INT32_MAX, INT32_MAX - 40, 40, 1},
               {INT32_MAX + INT64_C(1), 1, 40, 0},
               {1, INT32_MAX - 40, 41, 0},
               {1, INT32_MAX + INT64_C(1), 0, 0}};
  int wide;
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
    make_pump();
    for (int p = STATOR_IN; p < SUCTION_OUT; ++p) pump.parts[p].faces = (CwFaceCount){0, 0};
    pump.parts[VOLUTE].faces = (CwFaceCount){sizes[i].faces / 2, 0};
    pump.parts[TONGUE].faces = (CwFaceCount){0, sizes[i].faces - sizes[i].faces / 2};
    pump.assembly.totals[STATOR].points = sizes[i].points;
    pump.assembly.totals[STATOR].cells = sizes[i].cells;
    assert_int_equal(cw_cgns_plan(&pump.assembly, CW_INTEGERS_AUTO, &wide), CW_OK);
    assert_int_equal(wide, !sizes[i].fits);
    assert_int_equal(cw_cgns_plan(&pump.assembly, CW_INTEGERS_64, &wide), CW_OK);
    assert_int_equal(wide, 1);
    assert_int_equal(cw_cgns_plan(&pump.assembly, CW_INTEGERS_32, &wide), sizes[i].fits ? CW_OK : CW_ERR_EXPORT);
    if (sizes[i].fits) assert_int_equal(wide, 0);
    if (!sizes[i].fits) assert_non_null(strstr(cw_fail_message(), "domain stator: "));
    cw_fail_clear();
  }
}

static void a_file_is_the_same_each_time(void **state) {
  make_pump();
  size_t size[2];
  char *first = read_whole(in_test_folder(trees[0]), &size[0]),
       *again = read_whole(write_tree("again.cgns", 0), &size[1]);
  assert_int_equal(size[0], size[1]);
  assert_memory_equal(first, again, size[0]);
  free(again);
  free(first);
}

// Two families of one name, which HDF5 refuses.
static void what_hdf5_refuses_is_told_with_the_file(void **state) {
  const char *path = in_test_folder("twice.cgns");
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  make_small_pump();
  strcpy(pump.patches[BLADE].name, pump.patches[HUB].name);
  assert_int_equal(cw_cgns_tree_write(path, &pump.assembly, interfaces, &pump.table, 0), CW_ERR_LIBRARY);
  assert_non_null(strstr(cw_fail_message(), path));
  cw_fail_clear();
}

// A disk that is full for a moment: the failure names the file, and HDF5 is stuck where it could not close it.
static void no_write_is_lost_unseen(void **state) {
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
  make_small_pump();
  const char *path = in_test_folder("none/pump.cgns");
  assert_int_equal(cw_cgns_tree_write(path, &pump.assembly, interfaces, &pump.table, 0), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), path));
  assert_false(cw_cgns_stuck());
  for (refused_write = 1;; refused_write += 7) {
    char name[40];
    snprintf(name, sizeof name, "full%d.cgns", refused_write);
    path = in_test_folder(name);
    writes = 0;
    const CwStatus status = cw_cgns_tree_write(path, &pump.assembly, interfaces, &pump.table, 0);
    if (writes < refused_write) {
      assert_int_equal(status, CW_OK);
      break;
    }
    if (status == CW_OK) fail_msg("write %d of %d was lost unseen", refused_write, writes);
    assert_non_null(strstr(cw_fail_message(), path));
    cw_fail_clear();
  }
  assert_true(refused_write > 7);
  assert_true(cw_cgns_stuck());
  refused_write = 0;
}

int main(void) {
  H5dont_atexit(); // HDF5 stumbles there over files that could not be closed
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(zones_have_points_and_elements),
      cmocka_unit_test(coordinates_are_lengths),
      cmocka_unit_test(integers_are_as_wide_as_asked),
      cmocka_unit_test(each_patch_has_its_condition),
      cmocka_unit_test(families_have_kinds),
      cmocka_unit_test(interfaces_name_the_faces_of_the_other_side),
      cmocka_unit_test(frames_rotate_with_the_rotor),
      cmocka_unit_test(the_reference_state_is_that_of_the_case),
      cmocka_unit_test(equations_follow_from_the_walls),
      cmocka_unit_test(another_order_of_corners_is_told),
      cmocka_unit_test(wide_integers_are_taken_where_they_must),
      cmocka_unit_test(a_file_is_the_same_each_time),
      cmocka_unit_test(what_hdf5_refuses_is_told_with_the_file),
      cmocka_unit_test(no_write_is_lost_unseen), // the last: HDF5 is stuck then
  };
  return cmocka_run_group_tests(tests, open_trees, close_trees);
}
