// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/lattice_core.h"

#include <stdlib.h>
#include <string.h>

enum { END = 1 << 21, EDGES = 4, AROUND = 24, LEVELS = 22 };

// Of a centre's site: its cell is calm: see is_calm_round.
enum { CALM = 128 };

typedef struct {
  int32_t count;
  const CwLatticeSite *site;
  // Where the last search from a site of a level in a direction ended: sites are looked at in ascending order, so the
  // next one ends near it.
  int32_t cursor[LEVELS][2][27];
  uint8_t *calm; // of each site: CALM of a centre, the number of calm cells round a corner
} Lattice;

static const int8_t beside_face[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
static const int8_t beside_edge[12][3] = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0},  {1, 1, 0},  {-1, 0, -1}, {1, 0, -1},
                                          {-1, 0, 1},  {1, 0, 1},  {0, -1, -1}, {0, 1, -1}, {0, -1, 1},  {0, 1, 1}};

// The site with a key, or -1: by doubled steps from where the cursor stands, which takes the place that the key has
// or would have.
static int32_t search(const Lattice *lattice, uint64_t key, int32_t *cursor) {
  const CwLatticeSite *site = lattice->site;
  int32_t low = *cursor, high = low, step = 1; // site[low].key <= key < site[high].key, as far as there are such
  if (site[low].key <= key) {
    for (; high < lattice->count && site[high].key <= key; step *= 2) {
      low = high;
      high = step < lattice->count - high ? high + step : lattice->count;
    }
  } else {
    for (; low >= 0 && site[low].key > key; step *= 2) {
      high = low;
      low = low >= step ? low - step : -1;
    }
  }
  while (high - low > 1) {
    int32_t middle = low + (high - low) / 2;
    if (site[middle].key <= key)
      low = middle;
    else
      high = middle;
  }
  *cursor = low < 0 ? 0 : low;
  return low >= 0 && site[low].key == key ? low : -1;
}

// Corners lie at even multiples of half an edge, centres at odd ones.
static int is_centre(const CwLatticeSite *site) {
  return (site->key >> site->level & 1) == 1;
}

// The site `length` half edges of a cell of this level, 1 or 2, towards o from a place, or -1.
static int32_t find_from(Lattice *lattice, const int32_t at[3], int level, int length, const int8_t o[3]) {
  int32_t there[3];
  for (int i = 0; i < 3; i++) {
    there[i] = at[i] + (length << level) * o[i];
    if ((uint32_t)there[i] >= END) return -1;
  }
  int towards = 9 * (o[2] + 1) + 3 * (o[1] + 1) + o[0] + 1;
  return search(lattice, cw_lattice_key(there), &lattice->cursor[level][length - 1][towards]);
}

// A corner of the cell with its centre at `at`, by bits of k: x, y, z.
static int32_t find_corner(Lattice *lattice, const int32_t at[3], int level, int k) {
  return find_from(lattice, at, level, 1,
                   (int8_t[3]){(int8_t)(k & 1 ? 1 : -1), (int8_t)(k & 2 ? 1 : -1), (int8_t)(k & 4 ? 1 : -1)});
}

// The centre of the clear cell of this level beside the one at `at`, or -1.
static int32_t find_beside(Lattice *lattice, const int32_t at[3], int level, const int8_t o[3]) {
  int32_t s = find_from(lattice, at, level, 2, o);
  return s >= 0 && lattice->site[s].level == level && lattice->site[s].clear ? s : -1;
}

// Whether the place of the cell beside lies in a clear cell of twice the size, which has no points but those that
// the smaller lattice would have there, too.
static int lies_in_larger(Lattice *lattice, const int32_t at[3], int level, const int8_t o[3]) {
  int32_t centre[3], edge = 2 << level;
  for (int i = 0; i < 3; i++) {
    int32_t low = at[i] + edge * o[i] - edge / 2;
    if (low < 0) return 0;
    centre[i] = (low & ~(2 * edge - 1)) + edge;
  }
  return find_beside(lattice, centre, level + 1, (int8_t[3]){0, 0, 0}) >= 0;
}

// Whether no cell beside a face or an edge of the clear cell with its centre at `at` is cut finer or met by the
// boundary.
static int is_calm_round(Lattice *lattice, const int32_t at[3], int level) {
  for (int k = 0; k < 18; k++) {
    const int8_t *o = k < 6 ? beside_face[k] : beside_edge[k - 6];
    if (find_beside(lattice, at, level, o) < 0 && !lies_in_larger(lattice, at, level, o)) return 0;
  }
  return 1;
}

static void find_calm(Lattice *lattice) {
  for (int32_t s = 0; s < lattice->count; s++) {
    const CwLatticeSite *site = &lattice->site[s];
    int32_t at[3], corner[8];
    if (!site->clear || !is_centre(site)) continue;
    cw_lattice_at(site->key, at);
    int calm = is_calm_round(lattice, at, site->level);
    for (int k = 0; k < 8 && calm; k++) calm = (corner[k] = find_corner(lattice, at, site->level, k)) >= 0;
    if (!calm) continue;
    lattice->calm[s] = CALM;
    for (int k = 0; k < 8; k++) lattice->calm[corner[k]]++;
  }
}

// Deep is a centre whose cell and the six beside it are calm or, of these, clear and of its size; and a corner
// between eight calm cells. The tetrahedra round it each lie in two clear cells of one size beside a face, one of
// which is calm. Their spheres have their centres a quarter edge from the middle of the face, in the face, and
// the radius sqrt(5)/4 edges. Such a sphere lies in the two cells and the eight others that have an edge of the
// face, and none of the ten is cut finer: the next points that it could hold are 0.9 edges from its centre.
static void find_deep(Lattice *lattice, CwLatticeCore *core) {
  for (int32_t s = 0; s < lattice->count; s++) {
    const CwLatticeSite *site = &lattice->site[s];
    int32_t at[3];
    int deep = lattice->calm[s] == (is_centre(site) ? CALM : 8);
    cw_lattice_at(site->key, at);
    for (int d = 0; d < 6 && deep && is_centre(site); d++)
      deep = find_beside(lattice, at, site->level, beside_face[d]) >= 0;
    core->role[s] = deep ? CW_LATTICE_DEEP : CW_LATTICE_SHELL;
  }
}

// Leaves those that are innermost, all of whose 14 neighbours were deep, and the neighbours of these: thin cores
// are not worth their skin, nor is their skin, which stays as it is, good for what lies beyond.
static CwStatus leave_thick(Lattice *lattice, CwLatticeCore *core) {
  CwStatus status = CW_OK;
  uint8_t *thick = NULL;
  CW_NEW(thick, lattice->count);
  for (int32_t s = 0; s < lattice->count; s++) {
    int32_t at[3], near[14], level = lattice->site[s].level;
    int innermost = core->role[s] == CW_LATTICE_DEEP;
    cw_lattice_at(lattice->site[s].key, at);
    for (int k = 0; k < 14 && innermost; k++) {
      near[k] = k < 8 ? find_corner(lattice, at, level, k) : find_from(lattice, at, level, 2, beside_face[k - 8]);
      innermost = core->role[near[k]] == CW_LATTICE_DEEP;
    }
    thick[s] |= (uint8_t)innermost;
    for (int k = 0; k < 14 && innermost; k++) thick[near[k]] = 1;
  }
  for (int32_t s = 0; s < lattice->count; s++) {
    core->role[s] = thick[s] ? CW_LATTICE_DEEP : CW_LATTICE_SHELL;
    core->deep_count += thick[s];
  }
done:
  free(thick);
  return status;
}

static int is_deep(const CwLatticeCore *core, int32_t s) {
  return s >= 0 && core->role[s] == CW_LATTICE_DEEP;
}

static void add_face(CwLatticeCore *core, int32_t a, int32_t b, int32_t c) {
  memcpy(core->face[core->face_count++], (int32_t[3]){a, b, c}, sizeof *core->face);
}

// The tetrahedra at the face of calm cell s towards d that have a deep corner; and those of their faces beyond
// which there is none: a tetrahedron beside one of the core is of the core where its apex over the face is deep.
static void add_tets(Lattice *lattice, CwLatticeCore *core, int32_t s, int32_t other, int d, const int32_t corner[8]) {
  static const int8_t turn[EDGES][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};  // counter-clockwise from outside
  static const int8_t out[EDGES][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}}; // beyond the edge to the next corner
  int level = lattice->site[s].level, side = d % 2, i = d / 2, j = (i + 1 + !side) % 3, k = (i + 2 - !side) % 3;
  int32_t at[2][3], of_face[EDGES];
  int any = is_deep(core, s) | is_deep(core, other);
  for (int e = 0; e < EDGES; e++) {
    of_face[e] = corner[side << i | turn[e][0] << j | turn[e][1] << k];
    any |= is_deep(core, of_face[e]);
  }
  if (!any) return;
  cw_lattice_at(lattice->site[s].key, at[0]);
  cw_lattice_at(lattice->site[other].key, at[1]);
  for (int e = 0; e < EDGES; e++) {
    int32_t p = of_face[e], q = of_face[(e + 1) % EDGES];
    int deep[4] = {is_deep(core, s), is_deep(core, other), is_deep(core, p), is_deep(core, q)};
    int count = deep[0] + deep[1] + deep[2] + deep[3];
    if (count == 0) continue;
    memcpy(core->tet[core->tet_count++], (int32_t[4]){s, other, p, q}, sizeof *core->tet);
    if (count > 1) continue;
    int8_t o[3] = {0, 0, 0};
    o[j] = out[e][0];
    o[k] = out[e][1];
    if (deep[0] && !is_deep(core, find_beside(lattice, at[1], level, o))) add_face(core, other, p, q);
    if (deep[1] && !is_deep(core, find_beside(lattice, at[0], level, o))) add_face(core, s, q, p);
    if (deep[2] && !is_deep(core, of_face[(e + 2) % EDGES])) add_face(core, s, other, q);
    if (deep[3] && !is_deep(core, of_face[(e + 3) % EDGES])) add_face(core, s, p, other);
  }
}

// Each face between two calm cells is looked at from one of them.
static void add_all(Lattice *lattice, CwLatticeCore *core) {
  for (int32_t s = 0; s < lattice->count; s++) {
    int32_t at[3], corner[8], level = lattice->site[s].level;
    if (lattice->calm[s] != CALM) continue;
    cw_lattice_at(lattice->site[s].key, at);
    for (int k = 0; k < 8; k++) corner[k] = find_corner(lattice, at, level, k);
    for (int d = 0; d < 6; d++) {
      int32_t other = find_beside(lattice, at, level, beside_face[d]);
      if (other >= 0 && (d % 2 || lattice->calm[other] != CALM)) add_tets(lattice, core, s, other, d, corner);
    }
  }
}

static void name_skin(CwLatticeCore *core) {
  for (int32_t t = 0; t < core->tet_count; t++) {
    for (int i = 0; i < 4; i++) {
      uint8_t *role = &core->role[core->tet[t][i]];
      core->skin_count += *role == CW_LATTICE_SHELL;
      *role = *role == CW_LATTICE_SHELL ? CW_LATTICE_SKIN : *role;
    }
  }
}

// What a block takes beyond its used part goes back; the same block where that fails.
static void *shrunk(void *block, size_t used) {
  void *less = realloc(block, used ? used : 1);
  return less ? less : block;
}

CwStatus cw_lattice_core_make(int32_t count, const CwLatticeSite *site, CwLatticeCore *core) {
  CwStatus status = CW_OK;
  Lattice lattice = {.count = count, .site = site};
  memset(core, 0, sizeof *core);
  CW_NEW(core->role, count);
  CW_NEW(lattice.calm, count);
  find_calm(&lattice);
  find_deep(&lattice, core);
  CW_TRY(leave_thick(&lattice, core));
  CW_NEW(core->tet, AROUND * (size_t)core->deep_count);
  CW_NEW(core->face, AROUND * (size_t)core->deep_count);
  add_all(&lattice, core);
  core->tet = shrunk(core->tet, (size_t)core->tet_count * sizeof *core->tet);
  core->face = shrunk(core->face, (size_t)core->face_count * sizeof *core->face);
  name_skin(core);
done:
  free(lattice.calm);
  if (status != CW_OK) cw_lattice_core_free(core);
  return status;
}

void cw_lattice_core_free(CwLatticeCore *core) {
  free(core->role);
  free(core->tet);
  free(core->face);
  memset(core, 0, sizeof *core);
}
