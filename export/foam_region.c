// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_region.h"

#include <stdlib.h>
#include <string.h>

#include "export/foam_files.h"
#include "pipeline/mesh/cell.h"

// A region on its way into the files of a part.
typedef struct {
  const CwFoamMesh *mesh;
  int region;
  const CwRegionData *data;
  const int32_t *piece_of; // by cell
  const int64_t *cell;     // by cell: its number in its part
  const int64_t *point;    // by point: its number in the part, or -1
  CwFoamFiles *files;
  const CwRegionFaces *of;
  CwFaceStretch *inner; // of several parts: all inner faces of the region
} Writer;

// Faces on their way into the files.
enum { AT_ONCE = CW_FACES_AT_ONCE };

typedef struct {
  const Writer *writer;
  int64_t faces, label_count;      // in the arrays
  int64_t first_face, first_label; // before those
  int64_t offsets[AT_ONCE], labels[4 * AT_ONCE], owners[AT_ONCE], neighbours[AT_ONCE];
  int64_t numbers[AT_ONCE]; // in the whole mesh, from 1; below 0: turned over
} Stretch;

static CwStatus stretch_new(const Writer *w, CwFaceCount before, Stretch **s) {
  CwStatus status = CW_OK;
  CW_NEW_UNSET(*s, 1);
  (*s)->writer = w;
  (*s)->faces = (*s)->label_count = 0;
  (*s)->first_face = cw_face_count(before);
  (*s)->first_label = cw_corner_count(before);
done:
  return status;
}

// Writes what the arrays hold. Faces on patches have no neighbour.
static CwStatus stretch_write(Stretch *s, int is_inner) {
  CwStatus status = CW_OK;
  const Writer *w = s->writer;
  const int size = w->mesh->label_size;
  CW_TRY(cw_foam_put_labels(w->files, CW_FOAM_FACES, s->offsets, s->faces, s->first_face));
  CW_TRY(cw_place_file_put_labels(&w->files->file[CW_FOAM_FACES], s->labels, s->label_count, size,
                                  w->mesh->parts[w->files->part].label_start + size * s->first_label));
  CW_TRY(cw_foam_put_labels(w->files, CW_FOAM_OWNER, s->owners, s->faces, s->first_face));
  if (is_inner) CW_TRY(cw_foam_put_labels(w->files, CW_FOAM_NEIGHBOUR, s->neighbours, s->faces, s->first_face));
  CW_TRY(cw_foam_put_labels(w->files, CW_FOAM_OF_FACES, s->numbers, s->faces, s->first_face));
  s->first_face += s->faces;
  s->first_label += s->label_count;
  s->faces = s->label_count = 0;
done:
  return status;
}

// Turned over, a face begins with the same node. Neighbours below 0: none.
static inline CwStatus stretch_add(Stretch *s, const int32_t *corner, int sides, int64_t owner, int64_t neighbour,
                                   int64_t number) {
  const int64_t *point = s->writer->point, at = s->faces++;
  int64_t *label = s->labels + s->label_count;
  s->offsets[at] = s->first_label + s->label_count;
  s->owners[at] = owner;
  s->neighbours[at] = neighbour;
  s->numbers[at] = number;
  for (int i = 0; i < sides; ++i) label[i] = point[corner[number > 0 ? i : (sides - i) % sides]];
  s->label_count += sides;
  return s->faces == AT_ONCE ? stretch_write(s, neighbour >= 0) : CW_OK;
}

// The piece that a cell lies in.
static inline const CwPiece *piece_at(const Writer *w, int64_t cell) {
  const CwDivision *v = &w->mesh->division;
  return &v->pieces[v->first_piece[w->region] + w->piece_of[cell]];
}

// The other cell of an inner face: its part and its number there.
static int64_t other_cell(const Writer *w, const CwFaceStretch *s, int64_t f, int *part) {
  const CwDivision *v = &w->mesh->division;
  const int64_t local = s->across[f] - w->mesh->assembly->places[w->region].cell;
  if (s->open[f] < 0) {
    *part = piece_at(w, local)->part;
    return w->cell[local];
  }
  const int64_t there = w->mesh->assembly->partner[s->open[f]];
  *part = v->open_part[there];
  return v->open_cell[there];
}

// The inner faces of the region where there is one part, whose cells are numbered as those of all regions.
static CwStatus write_inner_whole(const Writer *w, CwFaceCount before) {
  CwStatus status = CW_OK;
  Stretch *s = NULL;
  CwFaceStretch *faces = w->inner;
  const int64_t first_cell = w->mesh->assembly->places[w->region].cell;
  CW_TRY(stretch_new(w, before, &s));
  while (cw_face_stretch_inner(w->mesh->assembly, w->region, w->data, w->of, faces)) {
    const int32_t *corner = faces->corner;
    for (int64_t f = 0; f < faces->faces; corner += faces->sides[f++])
      CW_TRY(stretch_add(s, corner, faces->sides[f], first_cell + faces->cell[f], faces->across[f], 1));
  }
  CW_TRY(stretch_write(s, 1));
done:
  free(s);
  return status;
}

// The inner faces of the region that lie in the writer's part, or between it and the part `link->other`.
static CwStatus write_inner(const Writer *w, const CwLink *link, CwFaceCount before) {
  CwStatus status = CW_OK;
  Stretch *s = NULL;
  const CwFaceStretch *all = w->inner;
  const int32_t *corner = all->corner;
  const int64_t number = cw_face_count(w->mesh->layout.region[w->region]) + 1;
  const int mine = w->files->part;
  CW_TRY(stretch_new(w, before, &s));
  for (int64_t f = 0; f < all->faces; corner += all->sides[f++]) {
    int there;
    const int here = piece_at(w, all->cell[f])->part;
    const int64_t own = w->cell[all->cell[f]], other = other_cell(w, all, f, &there);
    if (!link && here == mine && there == mine)
      CW_TRY(stretch_add(s, corner, all->sides[f], own, other, number + f));
    else if (link && here == mine && there == link->other)
      CW_TRY(stretch_add(s, corner, all->sides[f], own, -1, number + f));
    else if (link && there == mine && here == link->other)
      CW_TRY(stretch_add(s, corner, all->sides[f], other, -1, -(number + f)));
  }
  CW_TRY(stretch_write(s, !link));
done:
  free(s);
  return status;
}

// The faces of the region to other parts. A part that has no cell of the region may lie beyond a partition plane.
static CwStatus write_links(const Writer *w) {
  CwStatus status = CW_OK;
  const CwDivision *v = &w->mesh->division;
  const CwPart *part = &v->parts[w->files->part];
  for (int i = 0; i < part->link_count; ++i) {
    const CwLink *link = &v->links[part->first_link + i];
    if (link->region == w->region) CW_TRY(write_inner(w, link, w->mesh->parts[w->files->part].link[i]));
  }
done:
  return status;
}

static CwStatus write_patch(const Writer *w, const CwPiece *piece, int patch) {
  CwStatus status = CW_OK;
  Stretch *s = NULL;
  CwFaceStretch faces = {0};
  const CwAssembly *a = w->mesh->assembly;
  const int local = patch - a->mesh->domains[w->data->domain].first_patch;
  CwFaceCount before = w->mesh->parts[piece->part].patch[patch];
  int64_t number = cw_face_count(cw_face_layout_patch(&w->mesh->layout, a, w->region, patch)) + 1;
  if (cw_face_count(piece->patch[local]) == 0) goto done;
  cw_face_count_add(&before, piece->first_patch[local]);
  CW_TRY(stretch_new(w, before, &s));
  CW_TRY(cw_face_stretch_new(CW_FACES_AT_ONCE, &faces));
  for (; cw_face_stretch_patch(a, patch, w->data, w->of, &faces); number += faces.faces) {
    const int32_t *corner = faces.corner;
    for (int64_t f = 0; f < faces.faces; corner += faces.sides[f++])
      if (piece_at(w, faces.cell[f]) == piece)
        CW_TRY(stretch_add(s, corner, faces.sides[f], w->cell[faces.cell[f]], -1, number + f));
  }
  CW_TRY(stretch_write(s, 0));
done:
  cw_face_stretch_free(&faces);
  free(s);
  return status;
}

static CwStatus write_points(const Writer *w, const CwPiece *piece) {
  CwStatus status = CW_OK;
  const CwAssembly *a = w->mesh->assembly;
  const int64_t number = a->totals[w->data->domain].first_point + a->places[w->region].own_point;
  double(*points)[3] = NULL;
  int64_t *numbers = NULL, count = 0;
  CW_NEW(points, piece->own_points);
  CW_NEW(numbers, piece->own_points);
  for (int32_t p = w->data->shared_count; p < w->data->point_count; ++p) {
    if (w->point[p] < 0) continue;
    memcpy(points[count], w->data->points[p], sizeof *points);
    numbers[count++] = number + p - w->data->shared_count;
  }
  CW_TRY(cw_foam_put_points(w->files, (const double(*)[3])points, numbers, count, piece->first_own_point));
done:
  free(points);
  free(numbers);
  return status;
}

// The numbers that the cells of a piece have in the whole mesh.
static CwStatus write_cells(const Writer *w, const CwPiece *piece) {
  CwStatus status = CW_OK;
  int64_t *numbers = NULL, count = 0;
  if (!cw_foam_is_divided(w->mesh)) goto done;
  CW_NEW(numbers, piece->cells);
  for (int32_t i = 0; i < cw_region_cell_count(w->data); ++i)
    if (piece_at(w, i) == piece) numbers[count++] = w->mesh->assembly->places[w->region].cell + i;
  CW_TRY(cw_foam_put_labels(w->files, CW_FOAM_OF_CELLS, numbers, count, piece->first_cell));
done:
  free(numbers);
  return status;
}

// What the region gives to a part: to one of its pieces or, where `piece` is NULL, to one beyond a partition plane that
// has the other cells of some of its faces.
static CwStatus write_part(Writer *w, int part, const CwPiece *piece, int64_t *point) {
  CwStatus status = CW_OK;
  CwFoamFiles files = {0};
  const CwDivision *v = &w->mesh->division;
  const CwMeshDomain *domain = &w->mesh->assembly->mesh->domains[w->data->domain];
  CW_TRY(cw_foam_files_open(w->mesh, part, 0, &files));
  w->files = &files;
  w->point = point;
  if (piece) {
    const int own = (int)(piece - &v->pieces[v->first_piece[w->region]]);
    cw_division_points(v, w->region, own, w->data, w->piece_of, point);
    CW_TRY(write_points(w, piece));
    CW_TRY(write_cells(w, piece));
  }
  // A face to another part may have nodes that no cell of the piece has.
  for (int32_t p = 0; p < w->data->shared_count && cw_foam_is_divided(w->mesh); ++p)
    point[p] = cw_division_shared(v, part, w->data->domain, w->data->shared_id[p]);
  if (piece && cw_foam_is_divided(w->mesh))
    CW_TRY(write_inner(w, NULL, piece->first_inner));
  else if (piece)
    CW_TRY(write_inner_whole(w, piece->first_inner));
  for (int p = domain->first_patch; piece && p < domain->first_patch + domain->patch_count; ++p)
    CW_TRY(write_patch(w, piece, p));
  CW_TRY(write_links(w));
done:
  return cw_foam_files_close(&files, status);
}

CwStatus cw_foam_region_write(const CwFoamMesh *mesh, int region, const CwRegionData *data,
                              const CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  const CwDivision *v = &mesh->division;
  const CwPiece *pieces = &v->pieces[v->first_piece[region]];
  const int count = v->first_piece[region + 1] - v->first_piece[region];
  const CwRegionPlace *place = &mesh->assembly->places[region];
  const int64_t all = cw_face_count(place->inner) + cw_face_count(place->outer);
  CwFaceStretch inner = {0};
  int32_t *piece_of = NULL;
  int64_t *cell = NULL, *point = NULL;
  CW_NEW_UNSET(piece_of, cw_region_cell_count(data));
  CW_NEW_UNSET(cell, cw_region_cell_count(data));
  CW_NEW_UNSET(point, data->point_count);
  Writer w = {.mesh = mesh, .region = region, .data = data, .piece_of = piece_of, .cell = cell};
  w.of = faces, w.inner = &inner;
  CW_TRY(cw_division_cells(v, region, data, piece_of, cell));
  CW_TRY(cw_face_stretch_new(cw_foam_is_divided(mesh) ? all + CW_CELL_FACES : CW_FACES_AT_ONCE, &inner));
  if (cw_foam_is_divided(mesh)) cw_face_stretch_inner(mesh->assembly, region, data, faces, &inner);
  for (int k = 0; k < count; ++k) CW_TRY(write_part(&w, pieces[k].part, &pieces[k], point));
  for (int i = 0, last = -1; i < v->link_count; ++i) {
    const int part = v->links[i].part, is_own = part >= pieces[0].part && part <= pieces[count - 1].part;
    if (v->links[i].region != region || is_own || part == last) continue;
    CW_TRY(write_part(&w, part, NULL, point));
    last = part;
  }
done:
  cw_face_stretch_free(&inner);
  free(piece_of);
  free(cell);
  free(point);
  return status;
}
