// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/assembly.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/log.h"
#include "pipeline/mesh/cell.h"
#include "pipeline/vec.h"

static const double ROUNDING = 1e-11;    // of the greatest coordinate
static const double SURFACE_OPEN = 1e-9; // of its area, what rounding may leave of the sum of its area vectors

// A face on a partition plane. `loop` are the shared numbers of its nodes in the order of cw_face_loop(), -1 at the end
// of a triangle; `reversed` if the outward normal runs the other way.
typedef struct {
  int64_t loop[4];
  int32_t domain, region; // into CwMesh.domains and CwMesh.regions
  int32_t slot;           // place among the open faces of its region
  int32_t cell;           // of the region
  int32_t reversed;
  CwFaceKind kind; // as the cell makes it
  CwMiddle middle; // of the cell
} OpenFace;

// What one rank collects over its regions.
typedef struct {
  CwAssembly *assembly;
  OpenFace *open;
  int64_t open_count, open_capacity;
  CwInterfaceFace *interface[CW_INTERFACES_MOST][2];
  int64_t interface_count[CW_INTERFACES_MOST][2], interface_capacity[CW_INTERFACES_MOST][2];
  double *least[CW_DOMAINS_MOST], *most[CW_DOMAINS_MOST]; // coordinates of each shared point over the regions
} Collected;

static void collected_free(Collected *c) {
  free(c->open);
  for (int i = 0; i < CW_INTERFACES_MOST; ++i) {
    free(c->interface[i][0]);
    free(c->interface[i][1]);
  }
  for (int d = 0; d < CW_DOMAINS_MOST; ++d) {
    free(c->least[d]);
    free(c->most[d]);
  }
}

void cw_assembly_free(CwAssembly *assembly) {
  cw_region_share_free(&assembly->share);
  free(assembly->places);
  free(assembly->parts);
  free(assembly->patches);
  free(assembly->across);
  free(assembly->partner);
  for (int d = 0; d < CW_DOMAINS_MOST; ++d) free(assembly->shared[d]);
  for (int i = 0; i < CW_INTERFACES_MOST; ++i) {
    free(assembly->interface[i][0]);
    free(assembly->interface[i][1]);
  }
  memset(assembly, 0, sizeof *assembly);
}

// Numbers that follow from the manifest alone.
static CwStatus number_regions(const CwMesh *mesh, CwAssembly *a) {
  CwStatus status = CW_OK;
  int64_t cells = 0, points = 0;
  CW_NEW(a->places, mesh->region_count);
  for (int d = 0; d < mesh->domain_count; ++d) {
    CwDomainTotal *t = &a->totals[d];
    const CwMeshDomain *domain = &mesh->domains[d];
    t->points = domain->shared_points;
    cw_face_quality_start(&t->faces);
    for (int r = domain->first_region; r < domain->first_region + domain->region_count; ++r) {
      const CwMeshRegion *line = &mesh->regions[r];
      a->places[r].own_point = t->points;
      a->places[r].tetrahedron = t->tetrahedra;
      a->places[r].pyramid = t->pyramids;
      a->places[r].prism = t->prisms;
      a->places[r].cell = cells;
      t->points += line->own_points;
      t->tetrahedra += line->tetrahedra;
      t->pyramids += line->pyramids;
      t->prisms += line->prisms;
      cells += cw_mesh_region_cells(line);
    }
    t->cells = t->tetrahedra + t->pyramids + t->prisms;
    t->first_point = points;
    points += t->points;
  }
done:
  return status;
}

static void collect_points(const CwRegionData *data, Collected *c) {
  for (int32_t p = 0; p < data->shared_count; ++p) {
    double *least = c->least[data->domain] + 3 * data->shared_id[p];
    double *most = c->most[data->domain] + 3 * data->shared_id[p];
    for (int k = 0; k < 3; ++k) {
      // 0 turns -0 into 0: the bits must not follow from the order of the ranks.
      double value = data->points[p][k] + 0.0;
      least[k] = fmin(least[k], value);
      most[k] = fmax(most[k], value);
    }
  }
}

static void add_patch_face(CwPatchPart *part, const CwRegionData *data, const int32_t *nodes, int count) {
  double vector[3];
  cw_face_area((const double(*)[3])data->points, nodes, count, vector);
  ++*(count == 3 ? &part->faces.triangles : &part->faces.quads);
  for (int k = 0; k < 3; ++k) part->vector[k] += vector[k];
  part->area += cw_norm(vector);
}

static void add_interface_face(CwInterfaceFace *face, int64_t place, const CwRegionData *data, const int32_t *nodes,
                               int count) {
  face->place = place;
  face->count = count;
  for (int i = 0; i < count; ++i) memcpy(face->nodes[i], data->points[nodes[i]], sizeof face->nodes[i]);
}

// `place` of the interface faces counts within the region here; settle_interface() makes it the one in the
// patch. The region goes into its upper half, so that nothing else need be kept.
static CwStatus collect_interface(const CwMesh *mesh, int region, const CwRegionData *data, const CwAssembly *a, int i,
                                  int side, Collected *c) {
  CwStatus status = CW_OK;
  int patch = mesh->interfaces[i].patch[side], local = patch - mesh->domains[data->domain].first_patch;
  int64_t *count = &c->interface_count[i][side], place = (int64_t)region << 32;
  CW_GROW(c->interface[i][side], c->interface_capacity[i][side],
          *count + cw_face_count(cw_patch_part(a, region, patch)->faces));
  for (int32_t f = 0; f < data->triangle_count; ++f)
    if (data->triangle_patch[f] == local)
      add_interface_face(&c->interface[i][side][(*count)++], place++, data, data->triangles[f], 3);
  place = (int64_t)region << 32;
  for (int32_t f = 0; f < data->quad_count; ++f)
    if (data->quad_patch[f] == local)
      add_interface_face(&c->interface[i][side][(*count)++], place++, data, data->quads[f], 4);
done:
  return status;
}

static CwStatus collect_patches(const CwMesh *mesh, int region, const CwRegionData *data, CwAssembly *a, Collected *c) {
  CwStatus status = CW_OK;
  const CwMeshDomain *domain = &mesh->domains[data->domain];
  CwPatchPart *parts = cw_patch_part(a, region, domain->first_patch);
  for (int32_t i = 0; i < data->triangle_count; ++i)
    add_patch_face(&parts[data->triangle_patch[i]], data, data->triangles[i], 3);
  for (int32_t i = 0; i < data->quad_count; ++i) add_patch_face(&parts[data->quad_patch[i]], data, data->quads[i], 4);
  for (int i = 0; i < mesh->interface_count; ++i)
    for (int side = 0; side < 2; ++side)
      if (mesh->patches[mesh->interfaces[i].patch[side]].domain == data->domain)
        CW_TRY(collect_interface(mesh, region, data, a, i, side, c));
done:
  return status;
}

static OpenFace open_face(int region, const CwRegionData *data, int32_t slot, int32_t ref) {
  OpenFace face = {
      .domain = data->domain, .region = region, .slot = slot, .cell = ref / CW_CELL_FACES, .loop = {-1, -1, -1, -1}};
  int32_t nodes[4];
  int64_t wide[4];
  int order[4], count = cw_cell_face(data, face.cell, ref % CW_CELL_FACES, nodes);
  for (int k = 0; k < count; ++k) wide[k] = data->shared_id[nodes[k]];
  face.middle = cw_cell_middle(data, face.cell);
  face.kind = face.cell >= data->tetrahedron_count + data->pyramid_count ? CW_FACE_OF_PRISM : CW_FACE_OTHER;
  face.reversed = cw_face_loop(wide, count, order);
  for (int k = 0; k < count; ++k) face.loop[k] = wide[order[k]];
  return face;
}

CwStatus cw_each_region(const CwAssembly *a, const CwRanks *ranks, const char *title, CwDirection direction,
                        CwRegionWork work, void *context) {
  CwStatus status = CW_OK;
  const int *own = a->share.own, count = a->share.own_count, step = direction == CW_FORWARDS ? 1 : -1;
  int place = direction == CW_FORWARDS ? 0 : count - 1;
  cw_progress_start(ranks->log, title, a->mesh->region_count, "regions");
  for (int i = 0; i < count && status == CW_OK; ++i, place += step) {
    CwRegionData data = {0};
    if (i + 1 < count) cw_mesh_region_ahead(a->mesh, own[place + step]);
    status = cw_mesh_region_read(a->mesh, own[place], CW_REGION_WHOLE, &data);
    if (status == CW_OK) status = work(context, own[place], &data);
    cw_mesh_region_free(&data);
    cw_progress(ranks->log, (int64_t)(i + 1) * a->mesh->region_count / count);
  }
  cw_progress_end(ranks->log);
  return status;
}

static CwStatus collect_region(void *context, int region, CwRegionData *data) {
  CwStatus status = CW_OK;
  Collected *c = context;
  CwAssembly *a = c->assembly;
  const CwMesh *mesh = a->mesh;
  int32_t *open = NULL, count = 0;
  CwFaceCount inner; // twice
  CW_TRY(cw_region_open_faces(mesh->regions[region].path, CW_ERR_INPUT, data, 1, NULL, NULL, &open, &count));
  collect_points(data, c);
  CW_TRY(collect_patches(mesh, region, data, a, c));
  // Each face of a cell is one of two at an inner face, or lies on a patch or a partition plane.
  inner.triangles = 4 * (int64_t)(data->tetrahedron_count + data->pyramid_count) + 2 * (int64_t)data->prism_count;
  inner.triangles -= data->triangle_count;
  inner.quads = data->pyramid_count + 3 * (int64_t)data->prism_count - data->quad_count;
  CW_GROW(c->open, c->open_capacity, c->open_count + count);
  for (int32_t i = 0; i < count; ++i) {
    OpenFace *face = &c->open[c->open_count++];
    *face = open_face(region, data, i, open[i]);
    --*(face->loop[3] < 0 ? &inner.triangles : &inner.quads);
  }
  a->places[region].inner = (CwFaceCount){inner.triangles / 2, inner.quads / 2};
  a->places[region].open_count = count;
done:
  free(open);
  return status;
}

// Gives all ranks what each found of its regions, and room for the open faces of all.
static CwStatus spread(const CwRanks *ranks, CwAssembly *a) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  for (int r = 0; r < mesh->region_count; ++r) {
    int root = a->share.owner[r];
    MPI_Bcast(&a->places[r], sizeof a->places[r], MPI_BYTE, root, ranks->comm);
    MPI_Bcast(cw_patch_part(a, r, 0), (int)sizeof *a->parts * mesh->patch_count, MPI_BYTE, root, ranks->comm);
  }
  for (int r = 0; r < mesh->region_count; ++r) {
    a->places[r].first_open = a->open_count;
    a->open_count += a->places[r].open_count;
    for (int p = 0; p < mesh->patch_count; ++p) {
      CwPatchPart *part = cw_patch_part(a, r, p), *sum = &a->patches[p];
      part->before = sum->faces;
      cw_face_count_add(&sum->faces, part->faces);
      sum->area += part->area;
      for (int k = 0; k < 3; ++k) sum->vector[k] += part->vector[k];
    }
  }
  CW_NEW(a->across, a->open_count);
  CW_NEW(a->partner, a->open_count);
done:
  return status;
}

static CwStatus settle_points(const CwRanks *ranks, CwAssembly *a, Collected *c) {
  CwStatus status = CW_OK;
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    const CwMeshDomain *domain = &a->mesh->domains[d];
    int64_t count = 3 * domain->shared_points;
    cw_ranks_reduce(ranks, c->least[d], count, MPI_DOUBLE, MPI_MIN);
    cw_ranks_reduce(ranks, c->most[d], count, MPI_DOUBLE, MPI_MAX);
    double greatest = 0;
    for (int64_t i = 0; i < count; ++i) greatest = fmax(greatest, fmax(fabs(c->least[d][i]), fabs(c->most[d][i])));
    for (int64_t i = 0; i < count; ++i) {
      const double *x = c->least[d] + i / 3 * 3;
      CW_REQUIRE(isfinite(x[0]), CW_ERR_INPUT, "domain %s: shared point %lld is in no region", domain->name,
                 (long long)(i / 3));
      // Regions that are copies of one another, turned, differ by rounding: the least coordinates are taken.
      CW_REQUIRE(c->most[d][i] - c->least[d][i] <= ROUNDING * greatest, CW_ERR_INPUT,
                 "domain %s: shared point %lld near (%.6g, %.6g, %.6g) mm differs between regions by %.3g mm; allowed: "
                 "%.3g mm",
                 domain->name, (long long)(i / 3), 1e3 * x[0], 1e3 * x[1], 1e3 * x[2],
                 1e3 * (c->most[d][i] - c->least[d][i]), 1e3 * ROUNDING * greatest);
    }
    a->shared[d] = (double(*)[3])c->least[d];
    c->least[d] = NULL;
  }
done:
  return status;
}

static int compare_open_faces(const void *left, const void *right) {
  const OpenFace *x = left, *y = right;
  if (x->domain != y->domain) return x->domain < y->domain ? -1 : 1;
  for (int i = 0; i < 4; ++i)
    if (x->loop[i] != y->loop[i]) return x->loop[i] < y->loop[i] ? -1 : 1;
  return x->region != y->region ? (x->region > y->region) - (x->region < y->region)
                                : (x->slot > y->slot) - (x->slot < y->slot);
}

// Shared numbers are the domain's own.
static int same_nodes(const OpenFace *x, const OpenFace *y) {
  return x->domain == y->domain && memcmp(x->loop, y->loop, sizeof x->loop) == 0;
}

static CwStatus fail_at_open_face(const CwAssembly *a, const OpenFace *face, const char *what) {
  double x[3] = {0};
  int count = face->loop[3] < 0 ? 3 : 4;
  const CwMeshRegion *line = &a->mesh->regions[face->region];
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) x[k] += 1e3 * a->shared[line->domain][face->loop[i]][k] / count;
  return CW_FAIL(CW_ERR_INPUT, "%s: face at (%.6g, %.6g, %.6g) mm on a partition plane %s", line->path, x[0], x[1],
                 x[2], what);
}

// The face between the cells of x and y, of which x sees it in the order of its loop.
static void measure_open_face(CwAssembly *a, const OpenFace *x, const OpenFace *y) {
  int domain = a->mesh->regions[x->region].domain, count = x->loop[3] < 0 ? 3 : 4;
  const double *points[4];
  for (int i = 0; i < count; ++i) points[i] = a->shared[domain][x->loop[i]];
  CwFaceKind kind = x->kind == CW_FACE_OF_PRISM ? CW_FACE_OF_PRISM : y->kind;
  cw_face_quality_face(count, points, &x->middle, &y->middle, kind, &a->totals[domain].faces);
}

// Pairs the open faces of all regions. On rank 0.
static CwStatus pair_open_faces(CwAssembly *a, OpenFace *open, int64_t count) {
  CwStatus status = CW_OK;
  qsort(open, (size_t)count, sizeof *open, compare_open_faces);
  for (int64_t i = 0; i < count; i += 2) {
    const OpenFace *x = &open[i], *y = &open[i + 1];
    if (i + 1 == count || !same_nodes(x, y)) CW_TRY(fail_at_open_face(a, x, "has no partner in another region"));
    if (i + 2 < count && same_nodes(x, &open[i + 2]))
      CW_TRY(fail_at_open_face(a, x, "is shared by more than two cells"));
    if (x->reversed == y->reversed) CW_TRY(fail_at_open_face(a, x, "has both of its cells on the same side"));
    measure_open_face(a, x->reversed ? y : x, x->reversed ? x : y);
    const OpenFace *sides[2] = {x, y};
    for (int s = 0; s < 2; ++s) {
      const OpenFace *here = sides[s], *there = sides[1 - s];
      CwRegionPlace *place = &a->places[here->region];
      int64_t mine = place->cell + here->cell, other = a->places[there->region].cell + there->cell;
      a->across[place->first_open + here->slot] = other;
      a->partner[place->first_open + here->slot] = a->places[there->region].first_open + there->slot;
      if (mine < other) ++*(here->loop[3] < 0 ? &place->outer.triangles : &place->outer.quads);
    }
  }
done:
  return status;
}

static CwStatus settle_open_faces(const CwRanks *ranks, CwAssembly *a, Collected *c) {
  CwStatus status = CW_OK;
  OpenFace *all = NULL;
  int64_t total = 0;
  CW_TRY(cw_ranks_gather(ranks, c->open, c->open_count, sizeof *all, (void **)&all, &total));
  if (ranks->rank == 0) status = pair_open_faces(a, all, total);
  CW_TRY(cw_ranks_agree(ranks, status));
  cw_ranks_broadcast(ranks, a->across, a->open_count, sizeof *a->across);
  cw_ranks_broadcast(ranks, a->partner, a->open_count, sizeof *a->partner);
  cw_ranks_broadcast(ranks, a->places, a->mesh->region_count, sizeof *a->places);
done:
  free(all);
  return status;
}

static CwStatus settle_interface(const CwRanks *ranks, int interface, int side, CwAssembly *a, Collected *c) {
  CwStatus status = CW_OK;
  CwInterfaceFace *all = NULL, *placed;
  int patch = a->mesh->interfaces[interface].patch[side];
  int64_t total = 0;
  CW_TRY(cw_ranks_gather(ranks, c->interface[interface][side], c->interface_count[interface][side], sizeof *all,
                         (void **)&all, &total));
  placed = a->interface[interface][side] = calloc(total ? (size_t)total : 1, sizeof *all);
  CW_TRY(cw_ranks_agree(ranks, placed ? CW_OK : CW_FAIL(CW_ERR_MEMORY, "out of memory")));
  for (int64_t i = 0; i < total; ++i) {
    int region = (int)(all[i].place >> 32);
    const CwFaceCount before = cw_patch_part(a, region, patch)->before;
    int64_t place = all[i].place & 0xffffffff;
    place += all[i].count == 3 ? before.triangles : a->patches[patch].faces.triangles + before.quads;
    placed[place] = all[i];
    placed[place].place = place;
  }
done:
  free(all);
  return status;
}

static CwStatus check_surface(const CwAssembly *a) {
  CwStatus status = CW_OK;
  const CwMesh *mesh = a->mesh;
  for (int d = 0; d < mesh->domain_count; ++d) {
    double area = 0, vector[3] = {0};
    const CwMeshDomain *domain = &mesh->domains[d];
    for (int p = domain->first_patch; p < domain->first_patch + domain->patch_count; ++p) {
      const CwPatchPart *sum = &a->patches[p];
      CW_REQUIRE(cw_face_count(sum->faces) > 0 || mesh->patches[p].kind == CW_PATCH_WALL, CW_ERR_INPUT,
                 "domain %s: patch '%s' has no face; allowed: only walls without", domain->name, mesh->patches[p].name);
      area += sum->area;
      for (int k = 0; k < 3; ++k) vector[k] += sum->vector[k];
    }
    double open = cw_norm(vector);
    CW_REQUIRE(open <= SURFACE_OPEN * area, CW_ERR_INPUT,
               "domain %s: its surface is not closed: the area vectors of its patches, of %.6g mm2, sum to %.3g mm2; "
               "allowed: %.3g mm2; run cutwater-mesh again",
               domain->name, 1e6 * area, 1e6 * open, 1e6 * SURFACE_OPEN * area);
  }
done:
  return status;
}

static CwStatus prepare(const CwMesh *mesh, const CwRanks *ranks, CwAssembly *a, Collected *c) {
  CwStatus status = CW_OK;
  a->mesh = mesh;
  CW_TRY(cw_region_share(mesh, ranks, &a->share));
  CW_TRY(number_regions(mesh, a));
  CW_NEW(a->parts, (size_t)mesh->region_count * (size_t)mesh->patch_count);
  CW_NEW(a->patches, mesh->patch_count);
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    CW_NEW(c->least[d], 3 * mesh->domains[d].shared_points);
    CW_NEW(c->most[d], 3 * mesh->domains[d].shared_points);
    for (int64_t i = 0; i < 3 * mesh->domains[d].shared_points; ++i) {
      c->least[d][i] = INFINITY;
      c->most[d][i] = -INFINITY;
    }
  }
done:
  return status;
}

CwStatus cw_assembly_make(const CwMesh *mesh, const CwRanks *ranks, CwAssembly *a) {
  CwStatus status = CW_OK;
  Collected c = {.assembly = a};
  CW_TRY(cw_ranks_agree(ranks, prepare(mesh, ranks, a, &c)));
  status = cw_each_region(a, ranks, "number the mesh", CW_FORWARDS, collect_region, &c);
  CW_TRY(cw_ranks_agree(ranks, status));
  CW_TRY(cw_ranks_agree(ranks, spread(ranks, a)));
  CW_TRY(cw_ranks_agree(ranks, settle_points(ranks, a, &c)));
  CW_TRY(settle_open_faces(ranks, a, &c));
  CW_TRY(check_surface(a));
  for (int i = 0; i < mesh->interface_count; ++i)
    for (int side = 0; side < 2; ++side) CW_TRY(settle_interface(ranks, i, side, a, &c));
done:
  collected_free(&c);
  return status;
}
