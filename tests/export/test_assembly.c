// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/assembly.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "tests/export/synthetic_run.h"
#include "tests/export/whole_mesh.h"
#include "tests/seal_run.h"
#include "tests/mpi_group.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

enum { REGIONS = 5, ROTOR = 3 };
static CwRanks ranks = {.size = 1};
static WholeMesh whole;
static CwAssembly assembly;

static int make(void **state) {
  return make_test_folder(state) || whole_mesh_make(in_test_folder("run"), &ranks, &whole, &assembly) ? -1 : 0;
}

static int release(void **state) {
  cw_assembly_free(&assembly);
  whole_mesh_free(&whole);
  return clear_test_folder(state);
}

static void totals_are_those_of_the_cells(void **state) {
  int64_t points[2] = {0, 0}, cells[2] = {0, 0};
  for (int64_t p = 0; p < whole.point_count; ++p) ++points[whole.points[p].domain];
  for (int r = 0; r < REGIONS; ++r) {
    assert_int_equal(assembly.places[r].cell, cells[0] + cells[1]);
    cells[whole.regions[r].domain] += cw_region_cell_count(&whole.regions[r]);
  }
  for (int d = 0; d < 2; ++d) {
    const CwDomainTotal *total = &assembly.totals[d];
    assert_int_equal(total->points, points[d]);
    assert_int_equal(total->first_point, d ? points[0] : 0);
    assert_int_equal(total->cells, cells[d]);
    assert_int_equal(total->tetrahedra + total->pyramids + total->prisms, cells[d]);
  }
  assert_true(assembly.totals[1].pyramids > 0);
  assert_int_equal(cw_assembly_cells(&assembly), cells[0] + cells[1]);
}

// Each point of a domain has one number, whichever region names it, and each number has a point.
static void every_point_has_one_number(void **state) {
  int64_t *number = malloc((size_t)whole.point_count * sizeof *number);
  uint8_t *taken = calloc((size_t)whole.point_count, 1);
  assert_true(number && taken);
  for (int64_t p = 0; p < whole.point_count; ++p) number[p] = -1;
  for (int r = 0; r < REGIONS; ++r) {
    const CwRegionData *data = &whole.regions[r];
    for (int32_t p = 0; p < data->point_count; ++p) {
      const CwDomainTotal *total = &assembly.totals[data->domain];
      const int64_t at = whole_mesh_point(&whole, r, p), here = cw_point_number(&assembly, r, data, p);
      assert_in_range(here, 0, total->points - 1);
      if (number[at] >= 0) {
        assert_int_equal(here, number[at]);
        continue;
      }
      number[at] = here;
      assert_false(taken[total->first_point + here]++);
      if (p < data->shared_count)
        assert_memory_equal(assembly.shared[data->domain][here], whole.points[at].x, sizeof whole.points[at].x);
    }
  }
  free(taken);
  free(number);
}

static void cells_meet_across_partition_planes(void **state) {
  CwFaceCount inner[REGIONS] = {{0}}, outer[REGIONS] = {{0}};
  int64_t open = 0, single = 0, first[REGIONS + 1] = {0};
  // By region and slot: 1 + the place of the other face in the list, where that is another region's.
  int64_t *partner = calloc((size_t)whole.face_count, sizeof *partner);
  assert_non_null(partner);
  for (int64_t i = 0; i < whole.face_count; ++i) ++first[whole.faces[i].region + 1];
  for (int r = 0; r < REGIONS; ++r) first[r + 1] += first[r];
  for (int64_t i = 0; i < whole.face_count; ++i) {
    const WholeFace *a = &whole.faces[i], *b = a + 1;
    if (!whole_mesh_is_pair(&whole, i)) {
      single++;
      continue;
    }
    i++;
    if (a->region == b->region) {
      whole_mesh_count(&inner[a->region], a);
      continue;
    }
    whole_mesh_count(&outer[a->region], a); // the lower region has the lower cell
    partner[first[a->region] + a->slot] = 1 + (b - whole.faces);
    partner[first[b->region] + b->slot] = 1 + (a - whole.faces);
    open += 2;
  }
  for (int r = 0; r < REGIONS; ++r) {
    int64_t at = assembly.places[r].first_open;
    assert_counts_equal(assembly.places[r].inner, inner[r]);
    assert_counts_equal(assembly.places[r].outer, outer[r]);
    for (int64_t s = first[r]; s < first[r + 1]; ++s) { // open faces stand in the order of cells and faces
      if (!partner[s]) continue;
      const WholeFace *there = &whole.faces[partner[s] - 1];
      const CwRegionPlace *other = &assembly.places[there->region];
      assert_int_equal(assembly.across[at], other->cell + there->cell);
      assert_in_range(assembly.partner[at], other->first_open, other->first_open + other->open_count - 1);
      assert_int_equal(assembly.partner[assembly.partner[at]], at);
      at++;
    }
    assert_int_equal(at - assembly.places[r].first_open, assembly.places[r].open_count);
  }
  assert_int_equal(assembly.open_count, open);
  int64_t patch_faces = 0;
  for (int p = 0; p < whole.mesh.patch_count; ++p) patch_faces += cw_face_count(assembly.patches[p].faces);
  assert_int_equal(patch_faces, single);
  free(partner);
}

// Inlet, interface and outlet are prisms of n sides, of which the area is n 2 r sin(pi / n) h.
static double prism_area(const SyntheticPump *made, double radius, int sides) {
  return sides * 2 * radius * sin(M_PI / sides) * (made->top - made->bottom);
}

static void patches_have_their_areas(void **state) {
  const SyntheticPump made = synthetic_pump_of_all_cells();
  const struct {
    const char *name;
    double radius;
    int sides;
  } known[] = {{"inlet", made.rotor.inner, made.rotor.around},
               {"rotor_interface", made.rotor.outer, made.rotor.around},
               {"stator_interface", made.stator.inner, made.stator.around},
               {"outlet", made.stator.outer, made.stator.around}};
  for (int i = 0; i < 4; ++i) {
    const int patch = cw_mesh_patch_find(&whole.mesh, known[i].name);
    const CwPatchPart *sum = &assembly.patches[patch];
    const double area = prism_area(&made, known[i].radius, known[i].sides);
    CwFaceCount before = {0};
    assert_near(sum->area, area, 1e-12 * area);
    for (int k = 0; k < 3; ++k) assert_near(sum->vector[k], 0, 1e-12 * area);
    for (int r = 0; r < REGIONS; ++r) {
      const CwPatchPart *part = cw_patch_part(&assembly, r, patch);
      if (whole.regions[r].domain != whole.mesh.patches[patch].domain)
        assert_int_equal(cw_face_count(part->faces), 0);
      else
        assert_counts_equal(part->before, before);
      cw_face_count_add(&before, part->faces);
    }
    assert_counts_equal(before, sum->faces);
  }
}

// The faces of an interface stand at their places, triangles first, on their cylinder, each once.
static void interface_faces_have_their_places(void **state) {
  const SyntheticPump made = synthetic_pump_of_all_cells();
  for (int side = 0; side < 2; ++side) {
    const CwFaceCount count = assembly.patches[whole.mesh.interfaces[0].patch[side]].faces;
    double area = 0;
    assert_true(count.triangles > 0 && count.quads > 0);
    for (int64_t f = 0; f < cw_face_count(count); ++f) {
      const CwInterfaceFace *face = &assembly.interface[0][side][f];
      double vector[3];
      assert_int_equal(face->place, f);
      assert_int_equal(face->count, f < count.triangles ? 3 : 4);
      cw_face_area(face->nodes, (const int32_t[]){0, 1, 2, 3}, face->count, vector);
      area += hypot(hypot(vector[0], vector[1]), vector[2]);
      for (int k = 0; k < face->count; ++k)
        assert_near(hypot(face->nodes[k][0], face->nodes[k][1]), made.rotor.outer, 1e-12);
    }
    const double wanted = prism_area(&made, made.rotor.outer, side ? made.stator.around : made.rotor.around);
    assert_near(area, wanted, 1e-12 * wanted);
  }
}

typedef void Spoil(CwRegionData *data);

// The first tetrahedron with so many shared points.
static int32_t tetrahedron(const CwRegionData *data, int wanted) {
  for (int32_t t = 0; t < data->tetrahedron_count; ++t) {
    int shared = 0;
    for (int k = 0; k < 4; ++k) shared += data->tetrahedra[t][k] < data->shared_count;
    if (shared == wanted) return t;
  }
  fail_msg("no tetrahedron has %d shared points", wanted);
  return 0;
}

static void take_cell_away(CwRegionData *data) {
  memcpy(data->tetrahedra[tetrahedron(data, 3)], data->tetrahedra[tetrahedron(data, 0)], sizeof *data->tetrahedra);
}

static void turn_cell_over(CwRegionData *data) {
  int32_t *cell = data->tetrahedra[tetrahedron(data, 3)], kept = cell[0];
  cell[0] = cell[1];
  cell[1] = kept;
}

enum { OUTLET = 7 }; // among the patches of the stator
static void give_outlet_to_wall(CwRegionData *data) {
  for (int32_t f = 0; f < data->triangle_count; ++f) data->triangle_patch[f] -= data->triangle_patch[f] == OUTLET;
  for (int32_t f = 0; f < data->quad_count; ++f) data->quad_patch[f] -= data->quad_patch[f] == OUTLET;
}

static void double_a_face(CwRegionData *data) {
  memcpy(data->triangles[0], data->triangles[data->triangle_count - 1], sizeof *data->triangles);
}

// A run in which some regions are spoilt is refused with these words.
static void refused(const char *name, int first, int count, Spoil *spoil, const char *words) {
  const SyntheticPump made = synthetic_pump_of_all_cells();
  const char *run = in_test_folder(name);
  CwMesh mesh = {0};
  CwAssembly none = {0};
  assert_int_equal(synthetic_run_write(run, &made), 0);
  for (int r = first; r < first + count; ++r) {
    CwRegionData data = {0};
    const int stator = r >= ROTOR;
    assert_int_equal(cw_mesh_region_read(&whole.mesh, r, CW_REGION_WHOLE, &data), CW_OK);
    spoil(&data);
    assert_int_equal(synthetic_region_write(run, stator ? "stator" : "rotor", r + 1 - ROTOR * stator, &data), 0);
    cw_mesh_region_free(&data);
  }
  assert_int_equal(seal_run(run), 0);
  assert_int_equal(cw_mesh_manifest_read(run, &mesh), CW_OK);
  cw_fail_clear();
  assert_int_equal(cw_assembly_make(&mesh, &ranks, &none), CW_ERR_INPUT);
  if (!strstr(cw_fail_message(), words)) fail_msg("no '%s' in: %s", words, cw_fail_message());
  cw_fail_clear();
  cw_assembly_free(&none);
  cw_mesh_free(&mesh);
}

static void faults_are_told(void **state) {
  refused("taken", 1, 1, take_cell_away, "on a partition plane has no partner in another region");
  refused("turned", 1, 1, turn_cell_over, "on a partition plane has both of its cells on the same side");
  refused("empty", 3, 2, give_outlet_to_wall, "domain stator: patch 'outlet' has no face; allowed: only walls without");
  refused("doubled", 0, 1, double_a_face, "domain rotor: its surface is not closed: the area vectors of its patches");
}

int main(int argc, char **argv) {
  begin_mpi(&argc, &argv, &ranks);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(totals_are_those_of_the_cells),      cmocka_unit_test(every_point_has_one_number),
      cmocka_unit_test(cells_meet_across_partition_planes), cmocka_unit_test(patches_have_their_areas),
      cmocka_unit_test(interface_faces_have_their_places),  cmocka_unit_test(faults_are_told),
  };
  return end_mpi(cmocka_run_group_tests(tests, make, release));
}
