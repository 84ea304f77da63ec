// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/division.h"

#include <stdlib.h>
#include <string.h>

#include "export/bisection.h"
#include "pipeline/mesh/cell.h"

// The first cell of a part among `cells`, and the part of a cell.
static int64_t part_begin(int64_t part, int64_t parts, int64_t cells) {
  return part * cells / parts;
}
static int part_of(int64_t cell, int64_t parts, int64_t cells) {
  return (int)(((cell + 1) * parts - 1) / cells);
}

static int64_t region_cells(const CwAssembly *a, int region) {
  return cw_mesh_region_cells(&a->mesh->regions[region]);
}

static CwStatus plan_pieces(CwDivision *v, int64_t cells) {
  CwStatus status = CW_OK;
  const CwAssembly *a = v->assembly;
  int count = 0;
  CW_NEW(v->first_piece, a->mesh->region_count + 1);
  for (int r = 0; r < a->mesh->region_count; ++r) {
    v->first_piece[r] = count;
    count += part_of(a->places[r].cell + region_cells(a, r) - 1, v->part_count, cells) -
             part_of(a->places[r].cell, v->part_count, cells) + 1;
  }
  v->first_piece[a->mesh->region_count] = count;
  CW_NEW(v->pieces, count);
  for (int r = 0; r < a->mesh->region_count; ++r) {
    const int64_t begin = a->places[r].cell, end = begin + region_cells(a, r);
    const int patches = a->mesh->domains[a->mesh->regions[r].domain].patch_count;
    for (int p = v->first_piece[r]; p < v->first_piece[r + 1]; ++p) {
      CwPiece *piece = &v->pieces[p];
      piece->part = part_of(begin, v->part_count, cells) + p - v->first_piece[r];
      const int64_t from = part_begin(piece->part, v->part_count, cells);
      const int64_t to = part_begin(piece->part + 1, v->part_count, cells);
      piece->first_cell = begin > from ? begin - from : 0;
      piece->cells = (end < to ? end : to) - (begin > from ? begin : from);
      CW_NEW(piece->patch, patches);
      CW_NEW(piece->first_patch, patches);
    }
  }
done:
  return status;
}

CwStatus cw_division_plan(const CwAssembly *a, int parts, CwDivision *v) {
  CwStatus status = CW_OK;
  const int64_t cells = cw_assembly_cells(a);
  *v = (CwDivision){.assembly = a, .part_count = parts};
  CW_REQUIRE(parts <= cells, CW_ERR_EXPORT, "openfoam.processors: %d parts of %lld cells; allowed: 1 to %lld", parts,
             (long long)cells, (long long)cells);
  CW_NEW(v->parts, parts);
  for (int p = 0; p < parts; ++p) {
    CW_NEW(v->parts[p].patch, a->mesh->patch_count);
    v->parts[p].cells = part_begin(p + 1, parts, cells) - part_begin(p, parts, cells);
  }
  CW_TRY(plan_pieces(v, cells));
done:
  return status;
}

void cw_division_free(CwDivision *v) {
  for (int p = 0; v->parts && p < v->part_count; ++p) free(v->parts[p].patch);
  const int pieces = v->pieces ? v->first_piece[v->assembly->mesh->region_count] : 0;
  for (int p = 0; p < pieces; ++p) {
    free(v->pieces[p].patch);
    free(v->pieces[p].first_patch);
  }
  free(v->parts);
  free(v->first_piece);
  free(v->pieces);
  free(v->links);
  free(v->first_shared);
  free(v->shared);
  free(v->open_cell);
  free(v->open_part);
  memset(v, 0, sizeof *v);
}

CwStatus cw_division_cells(const CwDivision *v, int region, const CwRegionData *data, int32_t *piece, int64_t *number) {
  CwStatus status = CW_OK;
  const CwPiece *pieces = &v->pieces[v->first_piece[region]];
  const int count = v->first_piece[region + 1] - v->first_piece[region];
  const int32_t cells = cw_region_cell_count(data);
  double(*centres)[3] = NULL;
  int64_t *sizes = NULL;
  int32_t *order = NULL;
  if (count == 1) {
    memset(piece, 0, (size_t)cells * sizeof *piece);
    for (int32_t i = 0; i < cells; ++i) number[i] = pieces->first_cell + i;
    goto done;
  }
  CW_NEW(centres, cells);
  CW_NEW(order, cells);
  CW_NEW(sizes, count);
  for (int k = 0; k < count; ++k) sizes[k] = pieces[k].cells;
  for (int32_t i = 0; i < cells; ++i) cw_cell_centre(data, i, centres[i]);
  cw_bisection((const double(*)[3])centres, cells, sizes, count, order, piece);
  for (int k = 0; k < count; ++k) sizes[k] = pieces[k].first_cell;
  for (int32_t i = 0; i < cells; ++i) number[i] = sizes[piece[i]]++;
done:
  free(centres);
  free(order);
  free(sizes);
  return status;
}

int64_t cw_division_shared(const CwDivision *v, int part, int domain, int64_t shared_id) {
  if (!v->shared) return v->parts[part].first_point[domain] + shared_id;
  const int64_t *first = &v->first_shared[(int64_t)part * v->assembly->mesh->domain_count + domain];
  int64_t low = first[0], high = first[1];
  while (low < high) {
    const int64_t middle = low + (high - low) / 2;
    if (v->shared[middle] < shared_id)
      low = middle + 1;
    else
      high = middle;
  }
  return v->parts[part].first_point[domain] + low - first[0];
}

void cw_division_points(const CwDivision *v, int region, int piece, const CwRegionData *data, const int32_t *piece_of,
                        int64_t *number) {
  const CwPiece *of = &v->pieces[v->first_piece[region] + piece];
  int64_t own = of->first_own_point;
  for (int32_t p = 0; p < data->point_count; ++p) number[p] = -1;
  for (int32_t cell = 0, cells = cw_region_cell_count(data); cell < cells; ++cell) {
    if (piece_of[cell] != piece) continue;
    int count;
    const int32_t *nodes = cw_cell_nodes(data, cell, &count);
    for (int i = 0; i < count; ++i) number[nodes[i]] = 0;
  }
  for (int32_t p = 0; p < data->point_count; ++p)
    if (number[p] == 0)
      number[p] = p < data->shared_count ? cw_division_shared(v, of->part, data->domain, data->shared_id[p]) : own++;
}

static int compare_links(const void *left, const void *right) {
  const CwLink *x = left, *y = right;
  if (x->part != y->part) return x->part < y->part ? -1 : 1;
  if (x->other != y->other) return x->other < y->other ? -1 : 1;
  return (x->region > y->region) - (x->region < y->region);
}

// What one rank finds in its regions.
typedef struct {
  CwDivision *division;
  CwLink *links;
  int64_t link_count, link_capacity;
  struct Shared {
    int64_t slot, id; // slot: part * domains + domain
  } * shared;
  int64_t shared_count, shared_capacity;
  int8_t *open_sides; // by open face, 3 or 4
} Found;

static CwStatus add_link(CwLink **links, int64_t *count, int64_t *capacity, int part, int other, int region,
                         int sides) {
  CwStatus status = CW_OK;
  const CwFaceCount one = {sides == 3, sides == 4};
  CW_GROW(*links, *capacity, *count + 2);
  (*links)[(*count)++] = (CwLink){.part = part, .other = other, .region = region, .count = one};
  (*links)[(*count)++] = (CwLink){.part = other, .other = part, .region = region, .count = one};
done:
  return status;
}

// Sums up what stands more than once from `first` on.
static void merge_links(CwLink *links, int64_t first, int64_t *count) {
  int64_t kept = first;
  if (*count > first) qsort(links + first, (size_t)(*count - first), sizeof *links, compare_links);
  for (int64_t i = first; i < *count; ++i)
    if (kept > first && compare_links(&links[kept - 1], &links[i]) == 0)
      cw_face_count_add(&links[kept - 1].count, links[i].count);
    else
      links[kept++] = links[i];
  *count = kept;
}

static void count_patches(const CwDivision *v, int region, const CwRegionData *data, const int32_t *piece_of) {
  CwPiece *pieces = &v->pieces[v->first_piece[region]];
  for (int32_t i = 0; i < data->triangle_count; ++i)
    ++pieces[piece_of[data->triangle_cell[i]]].patch[data->triangle_patch[i]].triangles;
  for (int32_t i = 0; i < data->quad_count; ++i)
    ++pieces[piece_of[data->quad_cell[i]]].patch[data->quad_patch[i]].quads;
}

static CwStatus count_points(const CwDivision *v, int region, const CwRegionData *data, const int32_t *piece_of,
                             Found *found) {
  CwStatus status = CW_OK;
  int64_t *number = NULL;
  CwPiece *pieces = &v->pieces[v->first_piece[region]];
  CW_NEW(number, data->point_count);
  for (int k = 0; k < v->first_piece[region + 1] - v->first_piece[region]; ++k) {
    cw_division_points(v, region, k, data, piece_of, number);
    CW_GROW(found->shared, found->shared_capacity, found->shared_count + data->shared_count);
    for (int32_t p = 0; p < data->point_count; ++p) {
      if (number[p] < 0) continue;
      if (p >= data->shared_count)
        ++pieces[k].own_points;
      else
        found->shared[found->shared_count++] = (struct Shared){
            (int64_t)pieces[k].part * v->assembly->mesh->domain_count + data->domain, data->shared_id[p]};
    }
  }
done:
  free(number);
  return status;
}

// The cells at the open faces of the region, in the order of those.
static void note_open(CwDivision *v, int region, const CwRegionData *data, const CwRegionFaces *faces,
                      const int32_t *piece_of, const int64_t *number, Found *found) {
  int64_t open = v->assembly->places[region].first_open;
  for (int32_t cell = 0, cells = cw_region_cell_count(data); cell < cells; ++cell)
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      int32_t nodes[4];
      if (faces->across[CW_CELL_FACES * cell + f] != CW_ACROSS_OPEN) continue;
      v->open_cell[open] = number[cell];
      v->open_part[open] = v->pieces[v->first_piece[region] + piece_of[cell]].part;
      found->open_sides[open++] = (int8_t)cw_cell_face(data, cell, f, nodes);
    }
}

static CwStatus count_inner(const CwDivision *v, int region, const CwRegionData *data, const CwRegionFaces *faces,
                            const int32_t *piece_of, Found *found) {
  CwStatus status = CW_OK;
  CwFaceStretch s = {0};
  CwPiece *pieces = &v->pieces[v->first_piece[region]];
  const int64_t before = found->link_count;
  CW_TRY(cw_face_stretch_new(CW_FACES_AT_ONCE, &s));
  while (cw_face_stretch_inner(v->assembly, region, data, faces, &s))
    for (int64_t f = 0; f < s.faces; ++f) {
      if (s.open[f] >= 0) continue;
      const int32_t here = piece_of[s.cell[f]], there = piece_of[s.across[f] - v->assembly->places[region].cell];
      if (here == there)
        cw_face_count_add(&pieces[here].inner, (CwFaceCount){s.sides[f] == 3, s.sides[f] == 4});
      else
        CW_TRY(add_link(&found->links, &found->link_count, &found->link_capacity, pieces[here].part, pieces[there].part,
                        region, s.sides[f]));
    }
  merge_links(found->links, before, &found->link_count);
done:
  cw_face_stretch_free(&s);
  return status;
}

static CwStatus count_region(void *context, int region, CwRegionData *data) {
  CwStatus status = CW_OK;
  Found *found = context;
  CwDivision *v = found->division;
  CwRegionFaces faces = {0};
  int32_t *piece_of = NULL;
  int64_t *number = NULL;
  CW_NEW(piece_of, cw_region_cell_count(data));
  CW_NEW(number, cw_region_cell_count(data));
  CW_TRY(cw_division_cells(v, region, data, piece_of, number));
  CW_TRY(cw_region_faces(v->assembly->mesh->regions[region].path, CW_ERR_INPUT, data, &faces));
  note_open(v, region, data, &faces, piece_of, number, found);
  CW_TRY(count_inner(v, region, data, &faces, piece_of, found));
  count_patches(v, region, data, piece_of);
  CW_TRY(count_points(v, region, data, piece_of, found));
done:
  free(piece_of);
  free(number);
  cw_region_faces_free(&faces);
  return status;
}

// All ranks get the counts of all pieces.
static void spread_pieces(CwDivision *v, const CwRanks *ranks) {
  const CwMesh *mesh = v->assembly->mesh;
  for (int r = 0; r < mesh->region_count; ++r)
    for (int p = v->first_piece[r]; p < v->first_piece[r + 1]; ++p) {
      CwPiece *piece = &v->pieces[p];
      MPI_Bcast(&piece->own_points, 1, MPI_INT64_T, v->assembly->share.owner[r], ranks->comm);
      MPI_Bcast(&piece->inner, 2, MPI_INT64_T, v->assembly->share.owner[r], ranks->comm);
      MPI_Bcast(piece->patch, 2 * mesh->domains[mesh->regions[r].domain].patch_count, MPI_INT64_T,
                v->assembly->share.owner[r], ranks->comm);
    }
}

static int compare_shared(const void *left, const void *right) {
  const struct Shared *x = left, *y = right;
  if (x->slot != y->slot) return x->slot < y->slot ? -1 : 1;
  return (x->id > y->id) - (x->id < y->id);
}

static CwStatus spread_shared(CwDivision *v, const CwRanks *ranks, const Found *found) {
  CwStatus status = CW_OK;
  struct Shared *all = NULL;
  int64_t count = 0, kept = 0;
  const int64_t slots = (int64_t)v->part_count * v->assembly->mesh->domain_count;
  CW_TRY(cw_ranks_gather(ranks, found->shared, found->shared_count, sizeof *all, (void **)&all, &count));
  if (count) qsort(all, (size_t)count, sizeof *all, compare_shared);
  for (int64_t i = 0; i < count; ++i)
    if (!kept || compare_shared(&all[kept - 1], &all[i]) != 0) all[kept++] = all[i];
  MPI_Bcast(&kept, 1, MPI_INT64_T, 0, ranks->comm);
  v->first_shared = calloc((size_t)slots + 1, sizeof *v->first_shared);
  v->shared = calloc((size_t)kept + 1, sizeof *v->shared);
  CW_TRY(cw_ranks_agree(ranks, v->first_shared && v->shared ? CW_OK : CW_FAIL(CW_ERR_MEMORY, "out of memory")));
  for (int64_t i = 0; i < kept && ranks->rank == 0; ++i) {
    ++v->first_shared[all[i].slot + 1];
    v->shared[i] = all[i].id;
  }
  for (int64_t s = 0; s < slots && ranks->rank == 0; ++s) v->first_shared[s + 1] += v->first_shared[s];
  cw_ranks_broadcast(ranks, v->first_shared, slots + 1, sizeof *v->first_shared);
  cw_ranks_broadcast(ranks, v->shared, kept, sizeof *v->shared);
done:
  free(all);
  return status;
}

// The links within regions from all ranks, and those across partition planes, which every rank can count.
static CwStatus spread_links(CwDivision *v, const CwRanks *ranks, Found *found) {
  CwStatus status = CW_OK;
  const CwAssembly *a = v->assembly;
  CwLink *all = NULL;
  int64_t count = 0, capacity;
  CW_TRY(cw_ranks_gather(ranks, found->links, found->link_count, sizeof *all, (void **)&all, &count));
  MPI_Bcast(&count, 1, MPI_INT64_T, 0, ranks->comm);
  capacity = count;
  if (!all) all = calloc((size_t)count + 1, sizeof *all);
  CW_TRY(cw_ranks_agree(ranks, all ? CW_OK : CW_FAIL(CW_ERR_MEMORY, "out of memory")));
  cw_ranks_broadcast(ranks, all, count, sizeof *all);
  for (int r = 0; r < a->mesh->region_count; ++r) {
    const int64_t first = a->places[r].first_open, before = count;
    for (int64_t i = first; i < first + a->places[r].open_count; ++i) {
      const int here = v->open_part[i], there = v->open_part[a->partner[i]];
      if (a->across[a->partner[i]] > a->across[i]) continue; // the other region's
      if (here == there)
        cw_face_count_add(&v->pieces[v->first_piece[r] + here - v->pieces[v->first_piece[r]].part].inner,
                          (CwFaceCount){found->open_sides[i] == 3, found->open_sides[i] == 4});
      else
        CW_TRY(add_link(&all, &count, &capacity, here, there, r, found->open_sides[i]));
    }
    merge_links(all, before, &count);
  }
  merge_links(all, 0, &count);
  v->links = all;
  v->link_count = (int)count;
  all = NULL;
done:
  free(all);
  return status;
}

// One part is the whole mesh, of which the assembly knows all.
static void take_whole(CwDivision *v) {
  const CwAssembly *a = v->assembly;
  for (int r = 0; r < a->mesh->region_count; ++r) {
    CwPiece *piece = &v->pieces[r];
    const CwRegionPlace *place = &a->places[r];
    const CwMeshDomain *domain = &a->mesh->domains[a->mesh->regions[r].domain];
    piece->own_points = a->mesh->regions[r].own_points;
    piece->inner = place->inner;
    cw_face_count_add(&piece->inner, place->outer);
    for (int p = 0; p < domain->patch_count; ++p) piece->patch[p] = cw_patch_part(a, r, domain->first_patch + p)->faces;
  }
}

// Numbers from counts, region by region.
static void number_pieces(CwDivision *v) {
  const CwMesh *mesh = v->assembly->mesh;
  for (int d = 0; d < mesh->domain_count; ++d) {
    const CwMeshDomain *domain = &mesh->domains[d];
    for (int p = 0; p < v->part_count; ++p) {
      const int64_t *first = v->shared ? &v->first_shared[(int64_t)p * mesh->domain_count + d] : NULL;
      v->parts[p].first_point[d] = v->parts[p].points;
      v->parts[p].points += first ? first[1] - first[0] : domain->shared_points;
    }
    for (int r = domain->first_region; r < domain->first_region + domain->region_count; ++r)
      for (CwPiece *piece = &v->pieces[v->first_piece[r]]; piece < &v->pieces[v->first_piece[r + 1]]; ++piece) {
        CwPart *part = &v->parts[piece->part];
        piece->first_own_point = part->points;
        part->points += piece->own_points;
        part->domain_cells[d] += piece->cells;
        piece->first_inner = part->inner;
        cw_face_count_add(&part->inner, piece->inner);
        for (int p = 0; p < domain->patch_count; ++p) {
          piece->first_patch[p] = part->patch[domain->first_patch + p];
          cw_face_count_add(&part->patch[domain->first_patch + p], piece->patch[p]);
        }
      }
  }
  for (int i = 0; i < v->link_count; ++i) {
    CwLink *link = &v->links[i], *last = i ? link - 1 : NULL;
    if (last && last->part == link->part && last->other == link->other) {
      link->first = last->first;
      cw_face_count_add(&link->first, last->count);
    }
    if (!v->parts[link->part].link_count++) v->parts[link->part].first_link = i;
  }
}

CwStatus cw_division_count(CwDivision *v, const CwRanks *ranks) {
  CwStatus status = CW_OK;
  const CwAssembly *a = v->assembly;
  Found found = {.division = v};
  if (v->part_count == 1) {
    take_whole(v);
    number_pieces(v);
    return status;
  }
  v->open_cell = calloc((size_t)a->open_count + 1, sizeof *v->open_cell);
  v->open_part = calloc((size_t)a->open_count + 1, sizeof *v->open_part);
  found.open_sides = calloc((size_t)a->open_count + 1, sizeof *found.open_sides);
  if (!v->open_cell || !v->open_part || !found.open_sides)
    status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %lld faces on partition planes", (long long)a->open_count);
  if (status == CW_OK) status = cw_each_region(a, ranks, "count the parts", CW_FORWARDS, count_region, &found);
  CW_TRY(cw_ranks_agree(ranks, status));
  cw_ranks_reduce(ranks, v->open_cell, a->open_count, MPI_INT64_T, MPI_SUM);
  cw_ranks_reduce(ranks, v->open_part, a->open_count, MPI_INT32_T, MPI_SUM);
  cw_ranks_reduce(ranks, found.open_sides, a->open_count, MPI_INT8_T, MPI_SUM);
  spread_pieces(v, ranks);
  CW_TRY(spread_shared(v, ranks, &found));
  CW_TRY(spread_links(v, ranks, &found));
  number_pieces(v);
done:
  free(found.links);
  free(found.shared);
  free(found.open_sides);
  return status;
}
