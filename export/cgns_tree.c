// SPDX-License-Identifier: AGPL-3.0-or-later
// The nodes of pump.cgns. One zone a domain; sections: tetrahedra, pyramids, prisms, then the triangles and
// quadrilaterals of each patch next to each other, so that one range covers a patch.
#include <stdio.h>
#include <stdlib.h>

#include "export/cgns_file.h"
#include "export/cgns_node.h"
#include "export/cgns_sections.h"
#include "export/patch_role.h"

static CwStatus put_reference_state(hid_t base, const CwCase *table, double reference_length) {
  CwStatus status = CW_OK;
  hid_t state = -1;
  const struct {
    const char *name;
    double value;
    float exponents[5];
  } values[] = {
      {"Density", table->fluid.density, {1, -3, 0, 0, 0}},
      {"Pressure", table->operating_point.inlet_pressure, {1, -1, -2, 0, 0}},
      {"ViscosityKinematic", table->fluid.kinematic_viscosity, {0, 2, -1, 0, 0}},
      {"LengthReference", reference_length, {0, 1, 0, 0, 0}},
  };
  CW_TRY(cw_cgns_node(base, "ReferenceState", "ReferenceState_t", "MT", 0, NULL, NULL, &state));
  for (size_t i = 0; i < sizeof values / sizeof *values; ++i)
    CW_TRY(cw_cgns_quantity(state, values[i].name, "R8", 1, &values[i].value, values[i].exponents));
done:
  if (state >= 0) H5Gclose(state);
  return status;
}

static CwStatus put_equations(hid_t base, CwTurbulenceModel model) {
  CwStatus status = CW_OK;
  static const char *const models[] = {
      [CW_K_EPSILON] = "TwoEquation_JonesLaunder", [CW_SST] = "TwoEquation_MenterSST", [CW_LAMINAR] = NULL};
  hid_t set = -1;
  const int three = 3;
  CW_TRY(cw_cgns_node(base, "FlowEquationSet", "FlowEquationSet_t", "MT", 0, NULL, NULL, &set));
  CW_TRY(cw_cgns_list(set, "EquationDimension", "\"int\"", "I4", 1, &three, NULL));
  CW_TRY(cw_cgns_text(set, "GoverningEquations", "GoverningEquations_t", models[model] ? "NSTurbulent" : "NSLaminar",
                      NULL));
  if (models[model]) CW_TRY(cw_cgns_text(set, "TurbulenceModel", "TurbulenceModel_t", models[model], NULL));
done:
  if (set >= 0) H5Gclose(set);
  return status;
}

static CwStatus put_families(hid_t base, const CwMesh *mesh) {
  CwStatus status = CW_OK;
  static const char *const types[] = {"BCWallViscous", "BCInflow", "BCOutflow", "UserDefined", "BCSymmetryPlane"};
  hid_t family = -1;
  for (int p = 0; p < mesh->patch_count; ++p) {
    CW_TRY(cw_cgns_node(base, mesh->patches[p].name, "Family_t", "MT", 0, NULL, NULL, &family));
    CW_TRY(cw_cgns_text(family, "FamBC", "FamilyBC_t", types[mesh->patches[p].kind], NULL));
    H5Gclose(family);
    family = -1;
  }
  for (int d = 0; d < mesh->domain_count; ++d) {
    char name[CW_MESH_NAME_SIZE];
    cw_domain_family_name(mesh->domains[d].name, name);
    CW_TRY(cw_cgns_node(base, name, "Family_t", "MT", 0, NULL, NULL, NULL));
  }
done:
  if (family >= 0) H5Gclose(family);
  return status;
}

static CwStatus put_coordinates(hid_t zone, int64_t points) {
  CwStatus status = CW_OK;
  static const char *const names[] = {"CoordinateX", "CoordinateY", "CoordinateZ"};
  hid_t grid = -1;
  CW_TRY(cw_cgns_node(zone, "GridCoordinates", "GridCoordinates_t", "MT", 0, NULL, NULL, &grid));
  for (int k = 0; k < 3; ++k)
    CW_TRY(cw_cgns_quantity(grid, names[k], "R8", (hsize_t)points, NULL, (float[]){0, 1, 0, 0, 0}));
done:
  if (grid >= 0) H5Gclose(grid);
  return status;
}

static CwStatus put_section(hid_t zone, const CwSection *section, int wide) {
  CwStatus status = CW_OK;
  hid_t elements = -1;
  const int code[] = {section->type, 0};
  const int64_t range[] = {section->first, section->first + section->count - 1};
  CW_TRY(cw_cgns_list(zone, section->name, "Elements_t", "I4", 2, code, &elements));
  CW_TRY(cw_cgns_integers(elements, "ElementRange", "IndexRange_t", wide, 2, 0, range, NULL));
  CW_TRY(cw_cgns_integers(elements, "ElementConnectivity", "DataArray_t", wide,
                          (hsize_t)(section->count * section->nodes), 0, NULL, NULL));
done:
  if (elements >= 0) H5Gclose(elements);
  return status;
}

static CwStatus put_point_range(hid_t parent, int64_t first, int64_t count, int wide) {
  const int64_t range[] = {first, first + count - 1};
  return cw_cgns_integers(parent, "PointRange", "IndexRange_t", wide, 2, 1, range, NULL);
}

// A reader shows a surface only where a BC names it, so the interface has one too.
static CwStatus put_conditions(hid_t zone, const CwAssembly *a, int domain, int wide) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  hid_t all = -1, one = -1;
  CW_TRY(cw_cgns_node(zone, "ZoneBC", "ZoneBC_t", "MT", 0, NULL, NULL, &all));
  for (int p = 0; p < mesh->patch_count; ++p) {
    const int64_t faces = cw_face_count(a->patches[p].faces);
    if (mesh->patches[p].domain != domain || faces == 0) continue;
    CW_TRY(cw_cgns_text(all, mesh->patches[p].name, "BC_t", "FamilySpecified", &one));
    CW_TRY(put_point_range(one, cw_cgns_patch_first(a, p), faces, wide));
    CW_TRY(cw_cgns_text(one, "GridLocation", "GridLocation_t", "FaceCenter", NULL));
    CW_TRY(cw_cgns_text(one, "FamilyName", "FamilyName_t", mesh->patches[p].name, NULL));
    H5Gclose(one);
    one = -1;
  }
done:
  if (one >= 0) H5Gclose(one);
  if (all >= 0) H5Gclose(all);
  return status;
}

// The connection of one side of an interface, in the ZoneGridConnectivity of its zone.
static CwStatus put_connection(hid_t all, const CwAssembly *a, int number, const CwInterface *interface, int side,
                               int wide) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  const int *patch = mesh->interfaces[number].patch;
  const CwMeshDomain *here = &mesh->domains[mesh->patches[patch[side]].domain];
  const CwMeshDomain *there = &mesh->domains[mesh->patches[patch[1 - side]].domain];
  hid_t one = -1;
  int64_t *donors = NULL;
  int64_t count = interface->count[side], donor_first = cw_cgns_patch_first(a, patch[1 - side]);
  char name[48]; // no more than CGNS's 32 are used
  CW_NEW(donors, count);
  for (int64_t i = 0; i < count; ++i) donors[i] = donor_first + interface->donor[side][i];
  int again = cw_interfaces_before(mesh, number, side);
  snprintf(name, sizeof name, "%.14s_to_%.14s", here->name, there->name);
  if (again) snprintf(name, sizeof name, "%.12s_to_%.12s_%d", here->name, there->name, again + 1);
  CW_TRY(cw_cgns_text(all, name, "GridConnectivity_t", there->zone, &one));
  CW_TRY(cw_cgns_text(one, "GridConnectivityType", "GridConnectivityType_t", "Abutting", NULL));
  CW_TRY(cw_cgns_text(one, "GridLocation", "GridLocation_t", "FaceCenter", NULL));
  CW_TRY(put_point_range(one, cw_cgns_patch_first(a, patch[side]), count, wide));
  CW_TRY(cw_cgns_integers(one, "CellListDonor", "IndexArray_t", wide, (hsize_t)count, 1, donors, NULL));
  CW_TRY(cw_cgns_node(one, "InterpolantsDonor", "DataArray_t", "R8", 2, (hsize_t[]){(hsize_t)count, 2},
                      interface->place[side], NULL));
done:
  free(donors);
  if (one >= 0) H5Gclose(one);
  return status;
}

static CwStatus put_connections(hid_t zone, const CwAssembly *a, const CwInterface *interfaces, int domain, int wide) {
  CwStatus status = CW_OK;
  hid_t all = -1;
  CW_TRY(cw_cgns_node(zone, "ZoneGridConnectivity", "ZoneGridConnectivity_t", "MT", 0, NULL, NULL, &all));
  for (int i = 0; i < a->mesh->interface_count; ++i)
    for (int side = 0; side < 2; ++side)
      if (a->mesh->patches[a->mesh->interfaces[i].patch[side]].domain == domain)
        CW_TRY(put_connection(all, a, i, &interfaces[i], side, wide));
done:
  if (all >= 0) H5Gclose(all);
  return status;
}

static CwStatus put_rotation(hid_t zone, double speed) {
  CwStatus status = CW_OK;
  hid_t rotating = -1;
  CW_TRY(cw_cgns_node(zone, "RotatingCoordinates", "RotatingCoordinates_t", "MT", 0, NULL, NULL, &rotating));
  CW_TRY(cw_cgns_quantity(rotating, "RotationCenter", "R4", 3, (float[]){0, 0, 0}, (float[]){0, 1, 0, 0, 0}));
  CW_TRY(cw_cgns_quantity(rotating, "RotationRateVector", "R4", 3, (float[]){0, 0, (float)speed},
                          (float[]){0, 0, -1, 0, 1}));
done:
  if (rotating >= 0) H5Gclose(rotating);
  return status;
}

static CwStatus put_zone(hid_t base, const CwAssembly *a, const CwInterface *interfaces, const CwCase *table,
                         int domain, int wide) {
  CwStatus status = CW_OK;
  hid_t zone = -1;
  CwSection *sections = NULL;
  int section_count = 0;
  const CwDomainTotal *total = &a->totals[domain];
  char family[CW_MESH_NAME_SIZE];
  const int64_t size[] = {total->points, total->cells, 0};
  CW_TRY(cw_cgns_sections(a, domain, &sections, &section_count));
  CW_TRY(cw_cgns_integers(base, a->mesh->domains[domain].zone, "Zone_t", wide, 3, 1, size, &zone));
  CW_TRY(cw_cgns_text(zone, "ZoneType", "ZoneType_t", "Unstructured", NULL));
  cw_domain_family_name(a->mesh->domains[domain].name, family);
  CW_TRY(cw_cgns_text(zone, "FamilyName", "FamilyName_t", family, NULL));
  CW_TRY(put_coordinates(zone, total->points));
  for (int s = 0; s < section_count; ++s) CW_TRY(put_section(zone, &sections[s], wide));
  CW_TRY(put_conditions(zone, a, domain, wide));
  CW_TRY(put_connections(zone, a, interfaces, domain, wide));
  if (a->mesh->domains[domain].rotating) CW_TRY(put_rotation(zone, table->operating_point.speed));
done:
  free(sections);
  if (zone >= 0) H5Gclose(zone);
  return status;
}

CwStatus cw_cgns_plan(const CwAssembly *a, CwIntegers integers, int *wide) {
  CwStatus status = CW_OK;
  *wide = integers == CW_INTEGERS_64;
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    int64_t elements = a->totals[d].cells;
    for (int p = 0; p < a->mesh->patch_count; ++p)
      if (a->mesh->patches[p].domain == d) elements += cw_face_count(a->patches[p].faces);
    if (a->totals[d].points <= INT32_MAX && elements <= INT32_MAX) continue;
    CW_REQUIRE(integers != CW_INTEGERS_32, CW_ERR_EXPORT,
               "domain %s: %lld points and %lld elements; CGNS with 32-bit integers allows %d (cgns.integers: 64 holds "
               "them)",
               a->mesh->domains[d].name, (long long)a->totals[d].points, (long long)elements, INT32_MAX);
    *wide = 1;
  }
done:
  return status;
}

static int stuck; // a file could not be closed: HDF5, of which a process has one, tries again at its end

int cw_cgns_stuck(void) {
  return stuck;
}

CwStatus cw_cgns_tree_write(const char *path, const CwAssembly *a, const CwInterface *interfaces, const CwCase *table,
                            int wide) {
  CwStatus status = CW_OK;
  hid_t file = -1, base = -1;
  const int dimensions[] = {3, 3};
  static const char units[] = "Kilogram                        "
                              "Meter                           "
                              "Second                          "
                              "Kelvin                          "
                              "Radian                          ";
  CW_TRY(cw_cgns_create(path, &file));
  CW_TRY(cw_cgns_list(file, "pump", "CGNSBase_t", "I4", 2, dimensions, &base));
  CW_TRY(cw_cgns_text(base, "SimulationType", "SimulationType_t", "NonTimeAccurate", NULL));
  CW_TRY(cw_cgns_text(base, "DataClass", "DataClass_t", "Dimensional", NULL));
  CW_TRY(cw_cgns_node(base, "DimensionalUnits", "DimensionalUnits_t", "C1", 2, (hsize_t[]){5, 32}, units, NULL));
  if (table->output.cgns_profile == CW_CGNS_VENDOR)
    CW_TRY(cw_cgns_text(base, "PrismCorners", "Descriptor_t", "PENTA_6 in the order of VTK_WEDGE", NULL));
  CW_TRY(put_equations(base, cw_turbulence_model(a->mesh)));
  CW_TRY(put_reference_state(base, table, a->mesh->flow.reference_length));
  CW_TRY(put_families(base, a->mesh));
  for (int d = 0; d < a->mesh->domain_count; ++d) CW_TRY(put_zone(base, a, interfaces, table, d, wide));
done:
  if (base >= 0) H5Gclose(base);
  if (status == CW_ERR_LIBRARY) cw_fail_place(path);
  if (status == CW_ERR_IO) status = CW_FAIL(status, "%s: %s (is the disk full?)", path, cw_fail_message());
  if (file >= 0 && H5Fclose(file) < 0) {
    stuck = 1;
    if (status == CW_OK) status = CW_FAIL(CW_ERR_IO, "%s: cannot be written to its end (is the disk full?)", path);
  }
  return status;
}
