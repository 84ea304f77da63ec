// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/lattice_places.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/mix.h"
#include "mesher/common/model_unit.h"
#include "mesher/common/radix.h"

enum { ROUNDS = 9, SEEN = 13 };
static const double FIT = 0.01; // log of cells found over cells wanted: nearer than that the spacing fits
// Of a cell: points leave common spheres by up to this, far more than rounding and far less than their distances.
static const double JITTER = 1e-3;

// What the field asks for in a cell and in its children: asked once, for all rounds of the fit; 0: not yet.
typedef struct {
  double own, child[8];
} Asked;

typedef struct {
  const CwFillInput *input;
  const CwLatticeFrame *frame;
  Asked *asked;         // of each cell given
  double fit;           // factor on the wanted spacing
  double wanted, found; // cells that the size field asks for, and cells found
  CwRadix *place;
  int64_t place_count, place_capacity;
  uint64_t *seen; // places stored of late, by hash, so that few corners that cells share are stored again
} Lattice;

CwStatus cw_lattice_size(const CwFillInput *input, const double x[3], double *size) {
  CwStatus status = CW_OK;
  *size = input->size(input->size_context, x);
  CW_REQUIRE(*size > 0.0 && isfinite(*size), CW_ERR_MESH, "%s: the size field gives %g mm at (%.6g, %.6g, %.6g) mm",
             input->name, cw_mm(*size), CW_MM(x));
done:
  return status;
}

// Edge of a cell that the field asks for at the middle of the cell at `at`.
static CwStatus asked_in(const Lattice *lattice, const int32_t at[3], int level, double *asked) {
  CwStatus status = CW_OK;
  double centre[3];
  for (int i = 0; i < 3; i++)
    centre[i] = lattice->frame->origin[i] + lattice->frame->unit * (at[i] + 0.5 * (double)(1 << level));
  CW_TRY(cw_lattice_size(lattice->input, centre, asked));
  *asked *= CW_LATTICE_CONSTANT;
done:
  return status;
}

// Cuts down to the wanted spacing; counts, or stores the corners and centres of the leaves. `known`: of the cell, where
// it is one of those given, else NULL.
static CwStatus cut(Lattice *lattice, int32_t cell, const int32_t at[3], int level, double asked, Asked *known,
                    int store) {
  CwStatus status = CW_OK;
  double edge = lattice->frame->unit * (double)(1 << level);
  if (level > 0 && edge > 1.4142135623730951 * lattice->fit * asked) {
    int first = known && known->child[0] == 0.0;
    for (int child = 0; child < 8; child++) {
      int32_t corner[3];
      double below = known ? known->child[child] : 0.0;
      for (int i = 0; i < 3; i++) corner[i] = at[i] + ((child >> i & 1) << (level - 1));
      if (!known || first) CW_TRY(asked_in(lattice, corner, level - 1, &below));
      if (first) known->child[child] = below;
      CW_TRY(cut(lattice, cell, corner, level - 1, below, NULL, store));
    }
    goto done;
  }
  if (!store) {
    lattice->found += 1.0;
    lattice->wanted += edge / asked * (edge / asked) * (edge / asked);
    goto done;
  }
  CW_GROW(lattice->place, lattice->place_capacity, lattice->place_count + 9);
  for (int k = 0; k < 9; k++) {
    int32_t there[3];
    for (int i = 0; i < 3; i++) there[i] = 2 * at[i] + (k == 8 ? 1 << level : (k >> i & 1) << (level + 1));
    uint64_t key = cw_lattice_key(there), *seen = &lattice->seen[key * CW_MIX_STEP >> (64 - SEEN)];
    if (*seen != key) // of equal places the first one counts
      lattice->place[lattice->place_count++] = (CwRadix){key, cell, level};
    *seen = key;
  }
done:
  return status;
}

// Whether none of the places in a cell are asked for.
static int is_far(const Lattice *lattice, const CwLatticeCell *cell) {
  double edge = lattice->frame->unit * (double)(1 << cell->level), centre[3];
  for (int i = 0; i < 3; i++) centre[i] = lattice->frame->origin[i] + lattice->frame->unit * cell->at[i] + 0.5 * edge;
  for (int32_t s = 0; s < lattice->input->slab_count; s++) {
    const CwFillSlab *slab = &lattice->input->slab[s];
    // Half a diagonal, and what places are shaken by.
    if (fabs(cw_plane_distance(&slab->plane, centre)) <= slab->reach + 0.9 * edge) return 0;
  }
  return lattice->input->slab_count > 0;
}

static CwStatus cut_all(Lattice *lattice, int32_t count, const CwLatticeCell *cell, int store) {
  CwStatus status = CW_OK;
  lattice->wanted = lattice->found = 0.0;
  for (int32_t c = 0; c < count; c++) {
    if (store ? is_far(lattice, &cell[c]) : !cell[c].counts) continue;
    Asked *asked = &lattice->asked[c];
    if (asked->own == 0.0) CW_TRY(asked_in(lattice, cell[c].at, cell[c].level, &asked->own));
    CW_TRY(cut(lattice, c, cell[c].at, cell[c].level, asked->own, asked, store));
  }
done:
  return status;
}

// Finds the factor on the wanted spacing with which there are as many cells as the size field asks for. The
// count falls with the factor, but in steps where sizes are nearly uniform: the best of the tried ones is
// taken.
static CwStatus fit_spacing(Lattice *lattice, int32_t count, const CwLatticeCell *cell) {
  CwStatus status = CW_OK;
  double low = 0.5, high = 2.0, best = 1.0, best_error = INFINITY;
  for (int round = 0; round < ROUNDS && best_error >= FIT; round++) {
    CW_TRY(cut_all(lattice, count, cell, 0));
    if (!(lattice->wanted > 0.0)) break;
    double ratio = lattice->found / lattice->wanted, error = fabs(log(ratio));
    if (error < best_error) {
      best = lattice->fit;
      best_error = error;
    }
    if (ratio > 1.0)
      low = lattice->fit;
    else
      high = lattice->fit;
    double next = lattice->fit * cbrt(ratio);
    lattice->fit = next > low && next < high && round < 3 ? next : sqrt(low * high);
  }
  lattice->fit = best;
done:
  return status;
}

CwStatus cw_lattice_places(const CwFillInput *input, const CwLatticeFrame *frame, int32_t cell_count,
                           const CwLatticeCell *cell, int64_t *count, CwRadix **place) {
  CwStatus status = CW_OK;
  Lattice lattice = {.input = input, .frame = frame, .fit = 1.0};
  *count = 0;
  *place = NULL;
  CW_NEW(lattice.asked, cell_count);
  CW_TRY(fit_spacing(&lattice, cell_count, cell));
  CW_NEW(lattice.seen, 1 << SEEN);
  memset(lattice.seen, 0xff, sizeof *lattice.seen << SEEN);
  CW_TRY(cut_all(&lattice, cell_count, cell, 1));
  free(lattice.asked);
  lattice.asked = NULL;
  CW_TRY(cw_radix_sort(lattice.place_count, lattice.place));
  for (int64_t k = 0; k < lattice.place_count; k++) {
    if (k == 0 || lattice.place[k].key != lattice.place[*count - 1].key) lattice.place[(*count)++] = lattice.place[k];
  }
  *place = lattice.place;
  lattice.place = NULL;
done:
  free(lattice.asked);
  free(lattice.place);
  free(lattice.seen);
  return status;
}

static double shake(uint64_t key, int axis) { // in [-1, 1), from the place alone
  uint64_t z = cw_mix(key + CW_MIX_STEP * (uint64_t)(axis + 1));
  return (double)(z >> 11) * 0x1p-52 - 1.0;
}

void cw_lattice_fixed(const CwLatticeFrame *frame, uint64_t key, double x[3]) {
  int32_t half[3];
  cw_lattice_at(key, half);
  for (int i = 0; i < 3; i++) x[i] = frame->origin[i] + frame->unit * 0.5 * half[i];
}

void cw_lattice_point(const CwLatticeFrame *frame, const CwRadix *place, double x[3]) {
  cw_lattice_fixed(frame, place->key, x);
  for (int i = 0; i < 3; i++) x[i] += frame->unit * JITTER * (double)(1 << place->tag) * shake(place->key, i);
}
