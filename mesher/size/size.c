// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/size/size.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/scanlines.h"
#include "mesher/common/model_unit.h"
#include "mesher/policy.h"
#include "mesher/size/size_grid.h"
#include "mesher/size/size_sources.h"

struct CwSizeSeeds {
  CwSizeSurface *surface;
  int faces;
};

struct CwSize {
  double scale;
  CwSizeGrid grid;       // to be scaled
  CwSizeGrid open_edge;  // m, whatever the scale: what open edges of walls allow; no nodes where they ask nothing
  double open_edge_asks; // mean along the open edges of what they allow over what is wanted at scale 1
  CwScanlines lines;
  void *block;           // that holds the arrays; NULL: another's
  void *open_edge_block; // that holds those of open edges that joined it; NULL: another's, or none
};

static CwStatus check_input(const CwSizeInput *input) {
  CwStatus status = CW_OK;
  CW_REQUIRE(input->base_size > 0 && isfinite(input->base_size), CW_ERR_USAGE,
             "base size %g mm must be greater than zero", cw_mm(input->base_size));
  CW_REQUIRE(input->table->gradation > 0 && input->table->curvature_angle > 0, CW_ERR_USAGE,
             "gradation %g and curvature angle %g rad must be greater than zero", input->table->gradation,
             input->table->curvature_angle);
  for (int p = 0; p < cw_cad_patch_count(input->cad); p++) {
    CW_REQUIRE(input->patch_size[p] > 0 && isfinite(input->patch_size[p]), CW_ERR_USAGE,
               "relative size %g of patch '%s' must be greater than zero", input->patch_size[p],
               cw_cad_patch_name(input->cad, p));
  }
done:
  return status;
}

CwStatus cw_size_seeds_start(const CwCad *cad, const CwBackground *background, const CwMeshTable *table,
                             const double *patch_size, double base_size, CwSizeSeeds **seeds) {
  CwStatus status = CW_OK;
  const CwSizeInput input = {cad, background, table, patch_size, base_size, NULL};
  CwSizeSeeds *made = NULL;
  CW_TRY(check_input(&input));
  CW_NEW(made, 1);
  made->faces = cw_cad_face_count(cad);
  CW_TRY(cw_size_surface_make(&input, &made->surface));
  *seeds = made;
  made = NULL;
done:
  cw_size_seeds_free(&made);
  return status;
}

// The plain part of the lines; starts and crossings follow it.
static CwStatus pack_lines(const CwScanlines *lines, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  size_t count = (size_t)lines->count[0] * (size_t)lines->count[1], starts = (count + 1) * sizeof *lines->start;
  size_t crossings = (size_t)lines->start[count] * sizeof *lines->crossing;
  char *block;
  CW_NEW(block, sizeof *lines + starts + crossings);
  memcpy(block, lines, sizeof *lines);
  memcpy(block + sizeof *lines, lines->start, starts);
  memcpy(block + sizeof *lines + starts, lines->crossing, crossings);
  *bytes = block;
  *byte_count = (int64_t)(sizeof *lines + starts + crossings);
done:
  return status;
}

// The lines where they came packed.
static CwScanlines lines_in(void *bytes) {
  CwScanlines lines;
  memcpy(&lines, bytes, sizeof lines);
  lines.start = (int64_t *)((char *)bytes + sizeof lines);
  lines.crossing = (double *)(lines.start + (size_t)lines.count[0] * (size_t)lines.count[1] + 1);
  return lines;
}

enum { MORE_PARTS = 2, WIDTHS = 2 }; // than faces: edges and lines; of a narrow face, its longest edges

int cw_size_seed_parts(const CwCad *cad) {
  return cw_cad_face_count(cad) + MORE_PARTS;
}

CwStatus cw_size_seeds_part(CwSizeSeeds *seeds, int part, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  CwScanlines lines = {0};
  if (part < seeds->faces) {
    CW_TRY(cw_size_seed_face(seeds->surface, part, bytes, byte_count));
  } else if (part == seeds->faces) {
    CW_TRY(cw_size_seed_creases(seeds->surface, bytes, byte_count));
  } else {
    CW_TRY(cw_size_surface_lines(seeds->surface, &lines));
    CW_TRY(pack_lines(&lines, bytes, byte_count));
  }
done:
  cw_scanlines_free(&lines);
  return status;
}

void cw_size_seeds_free(CwSizeSeeds **seeds) {
  if (!*seeds) return;
  cw_size_surface_free(&(*seeds)->surface);
  free(*seeds);
  *seeds = NULL;
}

// Sets what lies before or after a set byte in each row of `count` bytes.
static void widen_along(uint8_t *restrict row, int32_t count, uint8_t *restrict old) {
  memcpy(old + 1, row, (size_t)count);
  old[0] = old[count + 1] = 0;
  for (int32_t i = 0; i < count; i++) row[i] = old[i] | old[i + 1] | old[i + 2];
}

// The same across `count` rows of `length` bytes that follow one another. `old` holds two rows.
static void widen_across(uint8_t *row, size_t length, int32_t count, uint8_t *old) {
  uint8_t *before = old, *here = old + length;
  memset(before, 0, length);
  for (int32_t i = 0; i < count; i++, row += length) {
    uint8_t *restrict to = row;
    memcpy(here, row, length);
    for (size_t b = 0; b < length; b++) to[b] |= before[b];
    if (i + 1 < count) {
      const uint8_t *restrict next = row + length;
      for (size_t b = 0; b < length; b++) to[b] |= next[b];
    }
    uint8_t *swap = before;
    before = here, here = swap;
  }
}

// Sets a byte for the nodes of the cells that lie in the domain, as the lines see it, and of those beside.
static CwStatus mark_inside(const CwSizeGrid *grid, const CwScanlines *lines, uint8_t **within) {
  CwStatus status = CW_OK;
  const int32_t *n = grid->count;
  size_t row = (size_t)n[0], slab = row * (size_t)n[1];
  uint8_t *old = NULL;
  CW_NEW(*within, slab * (size_t)n[2]);
  CW_NEW(old, 2 * slab + 2);
  // Thin passages may lie between the lines; seeds are everywhere on the surface.
  cw_size_grid_mark_set(grid, *within);
  for (int32_t k = 0; k < lines->count[1]; k++) {
    for (int32_t j = 0; j < lines->count[0]; j++) {
      size_t line = (size_t)j + (size_t)lines->count[0] * (size_t)k;
      for (int64_t c = lines->start[line]; c + 1 < lines->start[line + 1]; c += 2) {
        // The lattice begins one spacing into the grid: square (j, k) is cell (j + 1, k + 1).
        int32_t first = (int32_t)fmax(floor((lines->crossing[c] - grid->low[0]) / grid->spacing), 0);
        int32_t last = (int32_t)fmin(floor((lines->crossing[c + 1] - grid->low[0]) / grid->spacing) + 1, n[0] - 1);
        for (int32_t z = k + 1; z <= k + 2 && z < n[2]; z++) {
          for (int32_t y = j + 1; y <= j + 2 && y < n[1]; y++)
            memset(*within + (size_t)z * slab + (size_t)y * row + first, 1, (size_t)(last - first + 1));
        }
      }
    }
  }
  for (int32_t z = 0; z < n[2]; z++) {
    uint8_t *of = *within + (size_t)z * slab;
    for (int32_t y = 0; y < n[1]; y++) widen_along(of + (size_t)y * row, n[0], old);
    widen_across(of, row, n[1], old);
  }
  widen_across(*within, slab, n[2], old);
done:
  free(old);
  return status;
}

// The plain part of a field; arrays follow it: starts of the lines, crossings, values of both grids.
typedef struct {
  CwSize plain;
  size_t starts, crossings, nodes, open_edge_nodes;
} Packed;

static size_t packed_size(const Packed *head) {
  return sizeof *head + head->starts * sizeof(int64_t) + head->crossings * sizeof(double) +
         (head->nodes + head->open_edge_nodes) * sizeof(float);
}

// The plain part with its arrays in the block, which it does not own yet.
static CwSize arrays_in(const Packed *head, char *block) {
  CwSize size = head->plain;
  int64_t *start = (int64_t *)(block + sizeof *head);
  double *crossing = (double *)(start + head->starts);
  float *value = (float *)(crossing + head->crossings);
  size.lines.start = head->starts ? start : NULL;
  size.lines.crossing = head->starts ? crossing : NULL;
  size.grid.value = head->nodes ? value : NULL;
  size.open_edge.value = head->open_edge_nodes ? value + head->nodes : NULL;
  return size;
}

// The plain part of a field as it begins: the seeds' field has lines and their grid, that of the open edges its own
// grid.
static Packed packed_head(const CwSizeGrid *grid, const CwScanlines *lines, CwSizePart part) {
  Packed head = {.plain = {.scale = 1}};
  if (part == CW_SIZE_OPEN_EDGES) {
    head.plain.open_edge = *grid;
    head.open_edge_nodes = cw_size_grid_nodes(grid);
    return head;
  }
  head.plain.grid = *grid;
  head.plain.lines = *lines;
  head.plain.lines.start = NULL; // addresses mean nothing elsewhere
  head.plain.lines.crossing = NULL;
  head.nodes = cw_size_grid_nodes(grid);
  head.starts = (size_t)lines->count[0] * (size_t)lines->count[1] + 1;
  head.crossings = (size_t)lines->start[head.starts - 1];
  return head;
}

// The longest edge that a face allows; any where the list is that of the edges, behind the faces.
static double longest_of(const CwCad *cad, const CwSizeLimits *limits, int face) {
  if (!limits || !limits->wall || face == cw_cad_face_count(cad)) return INFINITY;
  return cw_cad_face_is_wall(cad, face) ? limits->wall[cw_cad_face_patch(cad, face)] : INFINITY;
}

// What the list behind the faces, of edges, is multiplied by. Edges of the mesh twice as long as a face is wide have
// triangles of 45 and 90 degrees across it; longer ones leave needles.
static double share_of(const CwCad *cad, const CwSizeLimits *limits, int face) {
  return limits && limits->scale > WIDTHS && face == cw_cad_face_count(cad) ? WIDTHS / limits->scale : 1;
}

CwStatus cw_size_make(const CwCad *cad, const CwBackground *background, const CwMeshTable *table,
                      const double *patch_size, double base_size, const CwSizeLimits *limits, void *const *seeds,
                      CwSizePart part, void **bytes, int64_t *byte_count) {
  CwStatus status = CW_OK;
  const CwSizeInput input = {cad, background, table, patch_size, base_size, limits ? limits->open_edge : NULL};
  CwSizeGrid grid;
  char *block = NULL;
  uint8_t *within = NULL;
  CW_TRY(check_input(&input));
  int lists = cw_cad_face_count(cad) + 1; // with that of the edges
  CwScanlines lines = lines_in(seeds[lists]);
  cw_size_surface_grid(&input, &grid);
  Packed head = packed_head(&grid, &lines, part);
  CW_NEW_UNSET(block, packed_size(&head));
  CwSize made = arrays_in(&head, block);
  grid.value = part == CW_SIZE_SEEDS ? made.grid.value : made.open_edge.value;
  cw_size_grid_clear(&grid);
  for (int i = 0; i < lists; i++)
    cw_size_take_seeds(&grid, seeds[i], share_of(cad, limits, i), base_size, longest_of(cad, limits, i));
  for (int32_t i = 0; limits && i < limits->point_count; i++)
    cw_size_grid_seed(&grid, limits->point[i].x, limits->point[i].size);
  CW_TRY(mark_inside(&grid, &lines, &within));
  if (part == CW_SIZE_SEEDS) {
    memcpy(made.lines.start, lines.start, head.starts * sizeof *lines.start);
    memcpy(made.lines.crossing, lines.crossing, head.crossings * sizeof *lines.crossing);
    CW_TRY(cw_size_grid_spread(&grid, table->gradation, within));
    if (limits) head.plain.open_edge_asks = cw_size_open_edges_ask(&input, &grid);
  } else {
    cw_size_grid_clear(&grid);
    cw_size_seed_open_edges(&input, &grid);
    CW_TRY(cw_size_grid_spread(&grid, table->gradation, within));
  }
  memcpy(block, &head, sizeof head);
  *bytes = block;
  *byte_count = (int64_t)packed_size(&head);
  block = NULL;
done:
  free(within);
  free(block);
  return status;
}

CwStatus cw_size_read(void *bytes, CwSize **size) {
  CwStatus status = CW_OK;
  Packed head;
  CwSize *made;
  CW_NEW(made, 1);
  memcpy(&head, bytes, sizeof head);
  *made = arrays_in(&head, bytes);
  *size = made;
done:
  return status;
}

CwStatus cw_size_unpack(void **bytes, CwSize **size) {
  CwStatus status = CW_OK;
  CW_TRY(cw_size_read(*bytes, size));
  (*size)->block = *bytes;
  *bytes = NULL;
done:
  return status;
}

void cw_size_join(CwSize *size, CwSize **open_edges) {
  void **block = (*open_edges)->open_edge_block ? &(*open_edges)->open_edge_block : &(*open_edges)->block;
  size->open_edge = (*open_edges)->open_edge;
  size->open_edge_block = *block;
  *block = NULL;
  cw_size_free(open_edges);
}

void cw_size_free(CwSize **size) {
  if (!*size) return;
  free((*size)->block);
  free((*size)->open_edge_block);
  free(*size);
  *size = NULL;
}

double cw_size_scale_fine(void) {
  return WIDTHS / cw_policy.size_least;
}

double cw_size_scale_flat(void) {
  return 1 / (tan(cw_policy.wanted_angle * CW_DEGREE) * cw_policy.size_least);
}

void cw_size_set_scale(CwSize *size, double scale) {
  size->scale = scale;
}

double cw_size_scale(const CwSize *size) {
  return size->scale;
}

// The least share of the wanted length that open edges are granted.
static double least_at_open_edges(const CwSize *field) {
  double asked = field->open_edge_asks / field->scale;
  double refused = (cw_policy.size_least - asked) / (cw_policy.size_least - cw_policy.size_least_asked);
  return cw_policy.size_least + (1 - cw_policy.size_least) * fmin(fmax(refused, 0), 1);
}

double cw_size_at(const void *size, const double x[3]) {
  const CwSize *field = size;
  double wanted = field->scale * cw_size_grid_at(&field->grid, x);
  return field->open_edge.value
             ? fmin(wanted, fmax(cw_size_grid_at(&field->open_edge, x), least_at_open_edges(field) * wanted))
             : wanted;
}

// The inside runs of a line, cut into lengths of about one spacing.
typedef struct {
  double begin, length;
  int64_t parts;
} Run;

static Run run_at(const CwScanlines *lines, int64_t crossing) {
  Run run = {.begin = lines->crossing[crossing]};
  run.length = lines->crossing[crossing + 1] - run.begin;
  run.parts = (int64_t)fmax(round(run.length / lines->spacing), 1);
  return run;
}

static double run_place(const Run *run, int64_t part) {
  return run->begin + run->length * ((double)part + 0.5) / (double)run->parts;
}

int32_t cw_size_line_count(const CwSize *size) {
  return size->lines.count[0] * size->lines.count[1];
}

double cw_size_line_integral(const CwSize *size, int32_t line) {
  const CwScanlines *lines = &size->lines;
  double x[3], sum = 0;
  cw_scanlines_place(lines, line % lines->count[0], line / lines->count[0], &x[1]);
  for (int64_t c = lines->start[line]; c + 1 < lines->start[line + 1]; c += 2) {
    Run run = run_at(lines, c);
    for (int64_t i = 0; i < run.parts; i++) {
      x[0] = run_place(&run, i);
      double h = cw_size_at(size, x);
      sum += run.length / (double)run.parts / (h * h * h);
    }
  }
  return lines->spacing * lines->spacing * sum;
}

// Stores the parts of all runs where x is not NULL. Returns how many.
static int64_t cut_runs(const CwScanlines *lines, double (*x)[3], double *volume) {
  int64_t count = 0;
  double area = lines->spacing * lines->spacing;
  for (int32_t line = 0; line < lines->count[0] * lines->count[1]; line++) {
    double place[2];
    cw_scanlines_place(lines, line % lines->count[0], line / lines->count[0], place);
    for (int64_t c = lines->start[line]; c + 1 < lines->start[line + 1]; c += 2) {
      Run run = run_at(lines, c);
      for (int64_t i = 0; i < run.parts; i++, count++) {
        if (!x) continue;
        x[count][0] = run_place(&run, i);
        x[count][1] = place[0];
        x[count][2] = place[1];
        volume[count] = area * run.length / (double)run.parts;
      }
    }
  }
  return count;
}

CwStatus cw_size_samples(const CwSize *size, int32_t *count, double (**x)[3], double **volume) {
  CwStatus status = CW_OK;
  int64_t samples = cut_runs(&size->lines, NULL, NULL);
  *x = NULL;
  *volume = NULL;
  CW_NEW(*x, samples);
  CW_NEW(*volume, samples);
  cut_runs(&size->lines, *x, *volume);
  *count = (int32_t)samples;
done:
  if (status != CW_OK) {
    free(*x);
    free(*volume);
    *x = NULL;
    *volume = NULL;
  }
  return status;
}
