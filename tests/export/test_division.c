// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/division.h"

#include <stdlib.h>
#include <string.h>

#include "pipeline/mesh/cell.h"
#include "tests/export/whole_mesh.h"
#include "tests/mpi_group.h"
#include "tests/test_folder.h"
#include "tests/unit_test.h"

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

// Where each cell of each region has gone.
typedef struct {
  int32_t *piece;  // of its region
  int64_t *number; // in its part
  int *part;
} Cells;

static Cells *cells_of(const CwDivision *division) {
  Cells *all = calloc((size_t)whole.mesh.region_count, sizeof *all);
  assert_non_null(all);
  for (int r = 0; r < whole.mesh.region_count; ++r) {
    const int32_t count = cw_region_cell_count(&whole.regions[r]);
    all[r].piece = calloc((size_t)count, sizeof *all[r].piece);
    all[r].number = calloc((size_t)count, sizeof *all[r].number);
    all[r].part = calloc((size_t)count, sizeof *all[r].part);
    assert_true(all[r].piece && all[r].number && all[r].part);
    assert_int_equal(cw_division_cells(division, r, &whole.regions[r], all[r].piece, all[r].number), CW_OK);
    for (int32_t c = 0; c < count; ++c)
      all[r].part[c] = division->pieces[division->first_piece[r] + all[r].piece[c]].part;
  }
  return all;
}

static void free_cells(Cells *all) {
  for (int r = 0; r < whole.mesh.region_count; ++r) {
    free(all[r].piece);
    free(all[r].number);
    free(all[r].part);
  }
  free(all);
}

// Parts take whole regions in their order, hold equally many cells, and number each of them once.
static void check_cells(const CwDivision *v, const Cells *cells) {
  const int64_t total = cw_assembly_cells(&assembly);
  uint8_t *taken = calloc((size_t)total, 1);
  int64_t *first = calloc((size_t)v->part_count + 1, sizeof *first), sum = 0;
  int last = 0;
  assert_true(taken && first);
  for (int p = 0; p < v->part_count; ++p) {
    assert_in_range(v->parts[p].cells, total / v->part_count, (total + v->part_count - 1) / v->part_count);
    first[p] = sum;
    sum += v->parts[p].cells;
  }
  assert_int_equal(sum, total);
  for (int r = 0; r < whole.mesh.region_count; ++r) {
    int least = v->part_count, most = 0;
    for (int32_t c = 0; c < cw_region_cell_count(&whole.regions[r]); ++c) {
      const int part = cells[r].part[c];
      assert_in_range(cells[r].number[c], 0, v->parts[part].cells - 1);
      assert_false(taken[first[part] + cells[r].number[c]]++);
      if (part < least) least = part;
      if (part > most) most = part;
    }
    assert_true(least >= last);
    last = most;
  }
  free(first);
  free(taken);
}

// Inner faces of each part, and those of each two parts, from all faces at once.
static void check_faces(const CwDivision *v, const Cells *cells) {
  const int n = v->part_count;
  CwFaceCount *between = calloc((size_t)(n * n), sizeof *between), *linked = calloc((size_t)(n * n), sizeof *linked);
  int64_t single = 0, patch_faces = 0;
  assert_true(between && linked);
  for (int64_t i = 0; i < whole.face_count; ++i) {
    const WholeFace *a = &whole.faces[i], *b = a + 1;
    if (!whole_mesh_is_pair(&whole, i)) {
      single++;
      continue;
    }
    i++;
    const int here = cells[a->region].part[a->cell], there = cells[b->region].part[b->cell];
    whole_mesh_count(&between[here * n + there], a);
    if (here != there) whole_mesh_count(&between[there * n + here], a);
  }
  for (int i = 0; i < v->link_count; ++i) {
    const CwLink *link = &v->links[i];
    CwFaceCount *sum = &linked[link->part * n + link->other];
    assert_int_not_equal(link->part, link->other);
    assert_counts_equal(link->first, *sum);
    cw_face_count_add(sum, link->count);
    const CwPart *part = &v->parts[link->part];
    assert_in_range(i, part->first_link, part->first_link + part->link_count - 1);
  }
  for (int p = 0; p < n; ++p) {
    for (int q = 0; q < n; ++q) assert_counts_equal(p == q ? v->parts[p].inner : linked[p * n + q], between[p * n + q]);
    for (int k = 0; k < whole.mesh.patch_count; ++k) patch_faces += cw_face_count(v->parts[p].patch[k]);
  }
  assert_int_equal(patch_faces, single);
  for (int k = 0; k < whole.mesh.patch_count; ++k) {
    CwFaceCount sum = {0};
    for (int p = 0; p < n; ++p) cw_face_count_add(&sum, v->parts[p].patch[k]);
    assert_counts_equal(sum, assembly.patches[k].faces);
  }
  free(linked);
  free(between);
}

// A part has the points of its cells, each with one number, in whichever region or piece it is named.
static void check_points(const CwDivision *v, const Cells *cells) {
  int64_t *number = malloc((size_t)whole.point_count * sizeof *number), counted = 0;
  assert_non_null(number);
  for (int part = 0; part < v->part_count; ++part) {
    uint8_t *taken = calloc((size_t)v->parts[part].points, 1);
    int64_t count = 0;
    assert_non_null(taken);
    for (int64_t p = 0; p < whole.point_count; ++p) number[p] = -1;
    for (int r = 0; r < whole.mesh.region_count; ++r) {
      const CwRegionData *data = &whole.regions[r];
      int64_t *named = calloc((size_t)data->point_count, sizeof *named);
      assert_non_null(named);
      for (int k = 0; k < v->first_piece[r + 1] - v->first_piece[r]; ++k) {
        if (v->pieces[v->first_piece[r] + k].part != part) continue;
        cw_division_points(v, r, k, data, cells[r].piece, named);
        for (int32_t p = 0; p < data->point_count; ++p) {
          if (named[p] < 0) continue;
          int64_t *of = &number[whole_mesh_point(&whole, r, p)];
          if (*of < 0) {
            assert_in_range(named[p], 0, v->parts[part].points - 1);
            assert_false(taken[named[p]]++);
            *of = named[p];
            count++;
          }
          assert_int_equal(named[p], *of);
        }
        for (int32_t c = 0; c < cw_region_cell_count(data); ++c) {
          int corners;
          const int32_t *nodes = cw_cell_nodes(data, c, &corners);
          for (int i = 0; i < corners && cells[r].piece[c] == k; ++i) assert_true(named[nodes[i]] >= 0);
        }
      }
      free(named);
    }
    assert_int_equal(count, v->parts[part].points);
    counted += count;
    free(taken);
  }
  assert_true(v->part_count == 1 ? counted == whole.point_count : counted > whole.point_count);
  free(number);
}

static void any_number_of_parts_is_the_mesh(void **state) {
  const int parts[] = {1, 2, 5, 8, 23};
  for (int i = 0; i < 5; ++i) {
    CwDivision division;
    assert_int_equal(cw_division_plan(&assembly, parts[i], &division), CW_OK);
    assert_int_equal(cw_division_count(&division, &ranks), CW_OK);
    Cells *cells = cells_of(&division);
    check_cells(&division, cells);
    check_faces(&division, cells);
    check_points(&division, cells);
    free_cells(cells);
    cw_division_free(&division);
  }
}

// A region that is cut gives pieces that lie apart: along an axis, one ends where the other begins.
static void a_region_is_cut_by_planes(void **state) {
  CwDivision division;
  assert_int_equal(cw_division_plan(&assembly, 8, &division), CW_OK);
  Cells *cells = cells_of(&division);
  int cut = 0;
  for (int r = 0; r < whole.mesh.region_count; ++r) {
    if (division.first_piece[r + 1] - division.first_piece[r] != 2) continue;
    int apart = 0;
    for (int k = 0; k < 3; ++k)
      for (int side = 0; side < 2; ++side) {
        double most = -1e300, least = 1e300; // of the piece `side`, of the other
        for (int32_t c = 0; c < cw_region_cell_count(&whole.regions[r]); ++c) {
          double centre[3];
          cw_cell_centre(&whole.regions[r], c, centre);
          if (cells[r].piece[c] == side && centre[k] > most) most = centre[k];
          if (cells[r].piece[c] != side && centre[k] < least) least = centre[k];
        }
        apart |= most <= least;
      }
    assert_true(apart);
    cut++;
  }
  assert_true(cut > 0);
  free_cells(cells);
  cw_division_free(&division);
}

static void more_parts_than_cells_are_refused(void **state) {
  CwDivision division;
  char words[100];
  const int cells = (int)cw_assembly_cells(&assembly);
  assert_int_equal(cw_division_plan(&assembly, cells, &division), CW_OK);
  cw_division_free(&division);
  assert_int_equal(cw_division_plan(&assembly, cells + 1, &division), CW_ERR_EXPORT);
  snprintf(words, sizeof words, "openfoam.processors: %d parts of %d cells; allowed: 1 to %d", cells + 1, cells, cells);
  assert_non_null(strstr(cw_fail_message(), words));
  cw_fail_clear();
  cw_division_free(&division);
}

int main(int argc, char **argv) {
  begin_mpi(&argc, &argv, &ranks);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(any_number_of_parts_is_the_mesh),
      cmocka_unit_test(a_region_is_cut_by_planes),
      cmocka_unit_test(more_parts_than_cells_are_refused),
  };
  return end_mpi(cmocka_run_group_tests(tests, make, release));
}
