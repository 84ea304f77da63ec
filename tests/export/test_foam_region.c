// SPDX-License-Identifier: AGPL-3.0-or-later
// What regions write into a polyMesh, whole and in parts, face by face beside the cells of the pump.
#include "export/foam_region.h"

#include "export/foam_mesh.h"
#include "pipeline/atomic_file.h"
#include "pipeline/mesh/cell.h"
#include "tests/export/synthetic_run.h"
#include "tests/export/whole_mesh.h"
#include "tests/mpi_group.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

static CwRanks ranks = {.size = 1};
static WholeMesh whole;
static CwAssembly assembly;

// A face as its cell has it. Cells are counted region by region, over all domains.
typedef struct {
  int64_t partner; // the cell on its other side; -1: on a patch
  int patch;       // of the mesh; -1: between cells
  int written;     // how often, since the last count
} Slot;

typedef struct {
  int region;
  int32_t cell; // of the region
  int64_t first_slot;
  int faces;
} Cell;

static Cell *cells;
static Slot *slots;
static int64_t cell_count, slot_count;

// The face of a cell that has all the nodes.
static int face_of(const CwRegionData *data, int32_t cell, const int32_t *nodes, int count) {
  int corners;
  cw_cell_nodes(data, cell, &corners);
  for (int f = 0; f < (corners == 4 ? 4 : 5); ++f) {
    int32_t own[4];
    int same = 0;
    if (cw_cell_face(data, cell, f, own) != count) continue;
    for (int i = 0; i < count; ++i)
      for (int k = 0; k < count; ++k) same += own[i] == nodes[k];
    if (same == count) return f;
  }
  fail_msg("cell %d has no such face", cell);
  return -1;
}

static void list_slots(void) {
  int64_t *first_cell = calloc((size_t)whole.mesh.region_count + 1, sizeof *first_cell);
  assert_non_null(first_cell);
  for (int r = 0; r < whole.mesh.region_count; ++r)
    first_cell[r + 1] = first_cell[r] + cw_region_cell_count(&whole.regions[r]);
  cell_count = first_cell[whole.mesh.region_count];
  cells = calloc((size_t)cell_count, sizeof *cells);
  slots = calloc((size_t)(CW_CELL_FACES * cell_count), sizeof *slots);
  assert_true(cells && slots);
  for (int r = 0; r < whole.mesh.region_count; ++r) {
    const CwRegionData *data = &whole.regions[r];
    for (int32_t c = 0; c < cw_region_cell_count(data); ++c) {
      int corners;
      cw_cell_nodes(data, c, &corners);
      Cell *cell = &cells[first_cell[r] + c];
      *cell = (Cell){r, c, slot_count, corners == 4 ? 4 : 5};
      for (int f = 0; f < cell->faces; ++f) slots[slot_count++] = (Slot){.partner = -1, .patch = -1};
    }
    const int first_patch = whole.mesh.domains[data->domain].first_patch;
    for (int32_t t = 0; t < data->triangle_count; ++t) {
      const int32_t c = data->triangle_cell[t];
      slots[cells[first_cell[r] + c].first_slot + face_of(data, c, data->triangles[t], 3)].patch =
          first_patch + data->triangle_patch[t];
    }
    for (int32_t q = 0; q < data->quad_count; ++q) {
      const int32_t c = data->quad_cell[q];
      slots[cells[first_cell[r] + c].first_slot + face_of(data, c, data->quads[q], 4)].patch =
          first_patch + data->quad_patch[q];
    }
  }
  for (int64_t i = 0; i + 1 < whole.face_count; ++i) {
    if (!whole_mesh_is_pair(&whole, i)) continue;
    for (int side = 0; side < 2; ++side) {
      const WholeFace *here = &whole.faces[i + side], *there = &whole.faces[i + 1 - side];
      const int64_t own_first = cells[first_cell[here->region]].first_slot; // slots are counted in the region
      slots[own_first + here->slot].partner = first_cell[there->region] + there->cell;
    }
    i++;
  }
  free(first_cell);
}

static void release_pump(void) {
  free(cells);
  free(slots);
  cells = NULL;
  slots = NULL;
  slot_count = 0;
  cw_assembly_free(&assembly);
  whole_mesh_free(&whole);
}

// Of all kinds of cells, in 3 + 2 regions.
static int make(void **state) {
  if (make_test_folder(state) || whole_mesh_make(in_test_folder("run"), &ranks, &whole, &assembly)) return -1;
  list_slots();
  return 0;
}

static int release(void **state) {
  release_pump();
  return clear_test_folder(state);
}

// A part as it lies in its files. `of`: numbers in the whole mesh, also those of a whole one.
typedef struct {
  int64_t points, faces, inner, cells;
  double (*x)[3];
  int64_t *offset, *label, *owner, *neighbour, *of_point, *of_face, *of_cell;
} Part;

static char *bytes_of(const CwFoamMesh *mesh, int part, CwFoamFile f, size_t *size) {
  char name[120];
  if (cw_foam_is_divided(mesh))
    snprintf(name, sizeof name, "foam/processor%d/constant/polyMesh/%s", part, cw_foam_file_names[f]);
  else
    snprintf(name, sizeof name, "foam/constant/polyMesh/%s", cw_foam_file_names[f]);
  return read_whole(in_test_folder(name), size);
}

// Labels of a file from a byte on.
static int64_t *labels_at(const CwFoamMesh *mesh, int part, CwFoamFile f, int64_t at, int64_t count) {
  size_t size;
  char *bytes = bytes_of(mesh, part, f, &size);
  int64_t *labels = calloc((size_t)count + 1, sizeof *labels);
  assert_true(labels && at + count * mesh->label_size <= (int64_t)size);
  for (int64_t i = 0; i < count; ++i) {
    int32_t narrow;
    memcpy(&narrow, bytes + at + 4 * i, 4);
    labels[i] = narrow;
    if (mesh->label_size == 8) memcpy(&labels[i], bytes + at + 8 * i, 8);
  }
  free(bytes);
  return labels;
}

static int64_t *counting(int64_t count, int64_t first) {
  int64_t *numbers = calloc((size_t)count + 1, sizeof *numbers);
  assert_non_null(numbers);
  for (int64_t i = 0; i < count; ++i) numbers[i] = first + i;
  return numbers;
}

static Part part_read(const CwFoamMesh *mesh, int p) {
  const CwFoamPart *of = &mesh->parts[p];
  const CwPart *counted = &mesh->division.parts[p];
  const int divided = cw_foam_is_divided(mesh);
  Part part = {.points = counted->points,
               .faces = cw_face_count(of->all),
               .inner = cw_face_count(counted->inner),
               .cells = counted->cells};
  size_t size;
  char *bytes = bytes_of(mesh, p, CW_FOAM_POINTS, &size);
  part.x = malloc((size_t)part.points * sizeof *part.x);
  assert_true(part.x && of->start[CW_FOAM_POINTS] + 24 * part.points <= (int64_t)size);
  memcpy(part.x, bytes + of->start[CW_FOAM_POINTS], (size_t)part.points * sizeof *part.x);
  free(bytes);
  part.offset = labels_at(mesh, p, CW_FOAM_FACES, of->start[CW_FOAM_FACES], part.faces + 1);
  part.label = labels_at(mesh, p, CW_FOAM_FACES, of->label_start, part.offset[part.faces]);
  part.owner = labels_at(mesh, p, CW_FOAM_OWNER, of->start[CW_FOAM_OWNER], part.faces);
  part.neighbour = labels_at(mesh, p, CW_FOAM_NEIGHBOUR, of->start[CW_FOAM_NEIGHBOUR], part.inner);
  if (!divided) {
    part.of_point = counting(part.points, 0);
    part.of_face = counting(part.faces, 1);
    part.of_cell = counting(part.cells, 0);
    return part;
  }
  part.of_point = labels_at(mesh, p, CW_FOAM_OF_POINTS, of->start[CW_FOAM_OF_POINTS], part.points);
  part.of_face = labels_at(mesh, p, CW_FOAM_OF_FACES, of->start[CW_FOAM_OF_FACES], part.faces);
  part.of_cell = labels_at(mesh, p, CW_FOAM_OF_CELLS, of->start[CW_FOAM_OF_CELLS], part.cells);
  return part;
}

static void part_free(Part *part) {
  free(part->x);
  free(part->offset);
  free(part->label);
  free(part->owner);
  free(part->neighbour);
  free(part->of_point);
  free(part->of_face);
  free(part->of_cell);
}

static void write_mesh(int parts, CwIntegers labels, CwFoamMesh *mesh) {
  const CwExportTable table = {.foam_processors = parts, .foam_labels = labels};
  const char *folder = in_test_folder("foam");
  char name[40];
  if (access(folder, F_OK) == 0) assert_int_equal(remove_folder(folder), 0);
  assert_int_equal(cw_make_directory(in_test_folder("foam/constant")), CW_OK);
  for (int p = 0; p < parts && parts > 1; ++p) {
    snprintf(name, sizeof name, "foam/processor%d", p);
    assert_int_equal(cw_make_directory(in_test_folder(name)), CW_OK);
  }
  memset(mesh, 0, sizeof *mesh);
  assert_int_equal(cw_foam_layout_plan(&assembly, in_test_folder("foam"), &table, mesh), CW_OK);
  assert_int_equal(cw_foam_mesh_create(mesh, &ranks), CW_OK);
  for (int r = whole.mesh.region_count - 1; r >= 0; --r) { // in any order
    CwRegionFaces faces = {0};
    assert_int_equal(cw_region_faces("r", CW_ERR_INPUT, &whole.regions[r], &faces), CW_OK);
    assert_int_equal(cw_foam_region_write(mesh, r, &whole.regions[r], &faces), CW_OK);
    cw_region_faces_free(&faces);
  }
}

// The face of a cell that has the corners of face `f` of a part, in its own direction or the other one.
static Slot *slot_of(const Part *part, int64_t f, int64_t cell, int *turned) {
  const CwRegionData *data = &whole.regions[cells[cell].region];
  const int count = (int)(part->offset[f + 1] - part->offset[f]);
  const int64_t *label = part->label + part->offset[f];
  for (int own = 0; own < cells[cell].faces; ++own) {
    int32_t nodes[4];
    if (cw_cell_face(data, cells[cell].cell, own, nodes) != count) continue;
    for (int at = 0; at < count; ++at)
      for (int way = 0; way < 2; ++way) {
        int same = 0;
        for (int i = 0; i < count; ++i) {
          const double *x = data->points[nodes[(at + (way ? count - i : i)) % count]];
          same += !memcmp(part->x[label[i]], x, sizeof part->x[0]);
        }
        if (same < count) continue;
        *turned = way;
        return &slots[cells[cell].first_slot + own];
      }
  }
  fail_msg("face %lld is none of its cell %lld", (long long)f, (long long)cell);
  return NULL;
}

// Face `f` of a part stands where it should, with its normal out of its owner.
static void check_face(const CwFoamMesh *mesh, int p, const Part *part, int64_t f) {
  const CwFoamPart *of = &mesh->parts[p];
  const int patches = whole.mesh.patch_count;
  int turned, patch = -1;
  assert_in_range(part->owner[f], 0, part->cells - 1);
  const int64_t owner = part->of_cell[part->owner[f]];
  Slot *slot = slot_of(part, f, owner, &turned);
  assert_false(turned);
  slot->written++;
  if (f < part->inner) {
    assert_in_range(part->neighbour[f], part->owner[f] + 1, part->cells - 1);
    const int64_t neighbour = part->of_cell[part->neighbour[f]];
    assert_int_equal(slot->partner, neighbour);
    slot_of(part, f, neighbour, &turned)->written++;
    assert_true(turned);
    return;
  }
  while (patch + 1 < patches && f >= cw_face_count(of->patch[patch + 1])) ++patch;
  if (f >= cw_face_count(of->patch[patches])) patch = -1; // to another part
  assert_int_equal(slot->patch, patch);
  assert_int_equal(slot->partner >= 0, patch < 0);
}

static void check_part(const CwFoamMesh *mesh, int p, const Part *part) {
  for (int64_t f = 0; f < part->faces; ++f) {
    check_face(mesh, p, part, f);
    const int64_t before = f > 0 ? part->owner[f - 1] : -1;
    if (f == 0 || f >= part->inner) continue; // upper-triangular
    assert_true(part->owner[f] > before || (part->owner[f] == before && part->neighbour[f] > part->neighbour[f - 1]));
  }
}

static void check_all_written(void) {
  for (int64_t s = 0; s < slot_count; ++s) {
    assert_int_equal(slots[s].written, 1);
    slots[s].written = 0;
  }
}

static void a_whole_mesh_has_every_face_once(void **state) {
  static const CwIntegers labels[] = {CW_INTEGERS_32, CW_INTEGERS_64};
  for (int i = 0; i < 2; ++i) {
    CwFoamMesh mesh;
    write_mesh(1, labels[i], &mesh);
    assert_int_equal(mesh.label_size, i ? 8 : 4);
    Part part = part_read(&mesh, 0);
    assert_int_equal(part.cells, cell_count);
    assert_int_equal(part.points, whole.point_count);
    check_part(&mesh, 0, &part);
    check_all_written();
    part_free(&part);
    cw_foam_layout_free(&mesh);
  }
}

// Points, cells and faces of a part beside those of the whole mesh that they are called by. A face below 0 is turned
// over, about its first corner.
static void check_numbers(const Part *part, const Part *all) {
  for (int64_t i = 0; i < part->points; ++i) {
    if (i > 0) assert_int_not_equal(part->of_point[i], part->of_point[i - 1]);
    assert_in_range(part->of_point[i], 0, all->points - 1);
    assert_memory_equal(part->x[i], all->x[part->of_point[i]], sizeof *part->x);
  }
  for (int64_t i = 1; i < part->cells; ++i) assert_true(part->of_cell[i] > part->of_cell[i - 1]);
  for (int64_t f = 0; f < part->faces; ++f) {
    const int64_t number = llabs(part->of_face[f]) - 1, count = part->offset[f + 1] - part->offset[f];
    assert_in_range(number, 0, all->faces - 1);
    assert_int_equal(all->offset[number + 1] - all->offset[number], count);
    for (int64_t i = 0; i < count; ++i) {
      const int64_t there = part->of_face[f] > 0 ? i : (count - i) % count;
      assert_int_equal(part->of_point[part->label[part->offset[f] + i]], all->label[all->offset[number] + there]);
    }
    const int64_t owner = part->of_cell[part->owner[f]];
    assert_int_equal(owner, part->of_face[f] > 0 ? all->owner[number] : all->neighbour[number]);
  }
}

// The faces between two parts are the same for both, one after the other, each turned over for one of them.
static void check_links(const CwFoamMesh *mesh, const Part *parts) {
  const CwDivision *v = &mesh->division;
  int64_t checked = 0;
  for (int i = 0; i < v->link_count; ++i)
    for (int k = 0; k < v->link_count; ++k) {
      const CwLink *here = &v->links[i], *there = &v->links[k];
      if (here->part != there->other || here->other != there->part || here->region != there->region) continue;
      const int64_t first = cw_face_count(mesh->parts[here->part].link[i - v->parts[here->part].first_link]),
                    other = cw_face_count(mesh->parts[there->part].link[k - v->parts[there->part].first_link]);
      for (int64_t f = 0; f < cw_face_count(here->count); ++f, ++checked)
        assert_int_equal(parts[here->part].of_face[first + f], -parts[there->part].of_face[other + f]);
    }
  assert_true(checked > 0);
}

// Divides the pump, and looks at all of its parts.
static void check_divisions(const int *divisions, int division_count) {
  CwFoamMesh mesh;
  write_mesh(1, CW_INTEGERS_32, &mesh);
  Part all = part_read(&mesh, 0);
  cw_foam_layout_free(&mesh);
  for (int i = 0; i < division_count; ++i) {
    const int count = divisions[i];
    Part parts[8] = {{0}};
    write_mesh(count, CW_INTEGERS_32, &mesh);
    for (int p = 0; p < count; ++p) {
      parts[p] = part_read(&mesh, p);
      check_part(&mesh, p, &parts[p]);
      check_numbers(&parts[p], &all);
    }
    check_all_written();
    check_links(&mesh, parts);
    for (int p = 0; p < count; ++p) part_free(&parts[p]);
    cw_foam_layout_free(&mesh);
  }
  part_free(&all);
}

static void parts_are_cut_out_of_the_whole_mesh(void **state) {
  check_divisions((const int[]){2, 3, 8}, 3);
}

static void a_folder_that_is_gone_is_told(void **state) {
  CwFoamMesh mesh;
  CwRegionFaces faces = {0};
  write_mesh(1, CW_INTEGERS_32, &mesh);
  assert_int_equal(remove_folder(in_test_folder("foam/constant/polyMesh")), 0);
  assert_int_equal(cw_region_faces("r", CW_ERR_INPUT, &whole.regions[0], &faces), CW_OK);
  assert_int_equal(cw_foam_region_write(&mesh, 0, &whole.regions[0], &faces), CW_ERR_IO);
  assert_non_null(strstr(cw_fail_message(), "polyMesh"));
  cw_fail_clear();
  cw_region_faces_free(&faces);
  cw_foam_layout_free(&mesh);
}

// A hub of one region with more faces than are written at once. The last test: the pump takes the place of the other.
static void large_patches_are_whole(void **state) {
  SyntheticPump pump = synthetic_pump();
  pump.rotor = (SyntheticAnnulus){.inner = 0.05, .outer = 0.101, .radial = 16, .around = 144, .axial = 3, .regions = 1};
  pump.stator.around = 12;
  release_pump();
  assert_int_equal(synthetic_run_write(in_test_folder("large"), &pump), 0);
  whole_mesh_read(in_test_folder("large"), &whole);
  assert_int_equal(cw_assembly_make(&whole.mesh, &ranks, &assembly), CW_OK);
  list_slots();
  assert_true(cw_face_count(assembly.patches[cw_mesh_patch_find(&whole.mesh, "hub")].faces) > CW_FACES_AT_ONCE);
  check_divisions((const int[]){2}, 1);
}

int main(int argc, char **argv) {
  begin_mpi(&argc, &argv, &ranks);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_whole_mesh_has_every_face_once),
      cmocka_unit_test(parts_are_cut_out_of_the_whole_mesh),
      cmocka_unit_test(a_folder_that_is_gone_is_told),
      cmocka_unit_test(large_patches_are_whole),
  };
  return end_mpi(cmocka_run_group_tests(tests, make, release));
}
