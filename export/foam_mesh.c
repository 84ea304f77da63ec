// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_mesh.h"
#include "export/foam_zones.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/mesh/cell.h"

static const char *const file_names[CW_FOAM_FILES] = {"points", "faces", "owner", "neighbour", "cellZones"};
static const char *const file_classes[CW_FOAM_FILES] = {"vectorField", "faceCompactList", "labelList", "labelList",
                                                        "regIOobject"};

enum { HEADER_SIZE = 1000 };

// The head of a binary file, up to the bracket before the first value or zone.
static int make_header(const CwFoamMesh *mesh, CwFoamFile f, char text[HEADER_SIZE]) {
  int64_t counts[CW_FOAM_FILES] = {mesh->points, mesh->faces + 1, mesh->faces, mesh->inner_faces,
                                   mesh->assembly->mesh->domain_count};
  char note[200] = "";
  if (f == CW_FOAM_OWNER || f == CW_FOAM_NEIGHBOUR)
    snprintf(note, sizeof note, "    note        \"nPoints:%lld  nCells:%lld  nFaces:%lld  nInternalFaces:%lld\";\n",
             (long long)mesh->points, (long long)mesh->cells, (long long)mesh->faces, (long long)mesh->inner_faces);
  return snprintf(text, HEADER_SIZE,
                  "FoamFile\n{\n    version     2.0;\n    format      binary;\n    class       %s;\n%s"
                  "    arch        \"LSB;label=32;scalar=64\";\n    location    \"constant/polyMesh\";\n"
                  "    object      %s;\n}\n\n%lld\n(%s",
                  file_classes[f], note, file_names[f], (long long)counts[f], f == CW_FOAM_ZONES ? "\n" : "");
}

// What stands before the cells of a domain in `cellZones`.
static int make_zone_head(const CwFoamMesh *mesh, int domain, char text[HEADER_SIZE]) {
  return snprintf(text, HEADER_SIZE, "%s\n{\n    type            cellZone;\n    cellLabels      List<label>\n%lld\n(",
                  mesh->assembly->mesh->domains[domain].name, (long long)mesh->assembly->totals[domain].cells);
}

static const char zone_tail[] = ");\n}\n";

CwStatus cw_foam_mesh_plan(const CwAssembly *a, const char *folder, CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  int64_t face = 0, label = 0;
  char text[HEADER_SIZE];
  mesh->assembly = a;
  CW_REQUIRE((mesh->folder = strdup(folder)), CW_ERR_MEMORY, "out of memory");
  CW_NEW(mesh->first_face, a->mesh->region_count);
  CW_NEW(mesh->first_label, a->mesh->region_count);
  CW_NEW(mesh->patch_face, a->mesh->patch_count);
  CW_NEW(mesh->patch_label, a->mesh->patch_count);
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    mesh->points += a->totals[d].points;
    mesh->cells += a->totals[d].cells;
  }
  for (int r = 0; r < a->mesh->region_count; ++r) {
    const CwRegionPlace *place = &a->places[r];
    int64_t triangles = place->inner_triangles + place->outer_triangles;
    int64_t quads = place->inner_quads + place->outer_quads;
    mesh->first_face[r] = face;
    mesh->first_label[r] = label;
    face += triangles + quads;
    label += 3 * triangles + 4 * quads;
  }
  mesh->inner_faces = face;
  for (int p = 0; p < a->mesh->patch_count; ++p) {
    mesh->patch_face[p] = face;
    mesh->patch_label[p] = label;
    face += a->patches[p].triangles + a->patches[p].quads;
    label += 3 * a->patches[p].triangles + 4 * a->patches[p].quads;
  }
  mesh->faces = face;
  mesh->labels = label;
  CW_REQUIRE(label <= INT32_MAX && mesh->points <= INT32_MAX, CW_ERR_EXPORT,
             "%lld face corners and %lld points; OpenFOAM with 32-bit labels allows %d", (long long)label,
             (long long)mesh->points, INT32_MAX);
  for (int f = 0; f < CW_FOAM_FILES; ++f) mesh->start[f] = make_header(mesh, (CwFoamFile)f, text);
  int64_t zone = mesh->start[CW_FOAM_ZONES];
  for (int d = 0; d < a->mesh->domain_count; ++d) {
    mesh->zone_start[d] = zone + make_zone_head(mesh, d, text);
    zone = mesh->zone_start[d] + 4 * a->totals[d].cells + (int64_t)strlen(zone_tail);
  }
  // ")\n\nCOUNT\n(" stands between the offsets and the labels.
  mesh->label_start = mesh->start[CW_FOAM_FACES] + 4 * (mesh->faces + 1) +
                      snprintf(text, sizeof text, ")\n\n%lld\n(", (long long)mesh->labels);
done:
  return status;
}

static CwStatus put(const CwFoamMesh *mesh, CwFoamFile f, const void *bytes, int64_t count, int64_t at) {
  CwStatus status = CW_OK;
  const char *from = bytes;
  while (count > 0) {
    ssize_t done_now = pwrite(mesh->file[f], from, (size_t)(count > 1 << 30 ? 1 << 30 : count), at);
    if (done_now < 0 && errno == EINTR) continue;
    CW_REQUIRE(done_now > 0, CW_ERR_IO, "%s/%s: cannot be written: %s", mesh->folder, file_names[f], strerror(errno));
    from += done_now;
    at += done_now;
    count -= done_now;
  }
done:
  return status;
}

static CwStatus open_file(CwFoamMesh *mesh, int f, int flags) {
  CwStatus status = CW_OK;
  char *path = NULL;
  CW_REQUIRE(asprintf(&path, "%s/%s", mesh->folder, file_names[f]) >= 0, CW_ERR_MEMORY, "out of memory");
  int descriptor = open(path, O_WRONLY | O_CLOEXEC | flags, 0666);
  CW_REQUIRE(descriptor > 0, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  mesh->file[f] = descriptor;
done:
  free(path);
  return status;
}

CwStatus cw_foam_mesh_open(CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  for (int f = 0; f < CW_FOAM_FILES; ++f)
    if (!mesh->file[f]) CW_TRY(open_file(mesh, f, 0));
done:
  return status;
}

CwStatus cw_foam_mesh_close(CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  for (int f = 0; f < CW_FOAM_FILES; ++f)
    if (mesh->file[f] && close(mesh->file[f]) != 0 && status == CW_OK)
      status = CW_FAIL(CW_ERR_IO, "%s/%s: cannot be written: %s", mesh->folder, file_names[f], strerror(errno));
  free(mesh->folder);
  free(mesh->first_face);
  free(mesh->first_label);
  free(mesh->patch_face);
  free(mesh->patch_label);
  memset(mesh, 0, sizeof *mesh);
  return status;
}

static CwStatus write_boundary(const CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  const CwMesh *input = mesh->assembly->mesh;
  FILE *out = NULL;
  char *path = NULL;
  int present = 0;
  CW_REQUIRE(asprintf(&path, "%s/boundary", mesh->folder) >= 0, CW_ERR_MEMORY, "out of memory");
  out = fopen(path, "w");
  CW_REQUIRE(out, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  for (int p = 0; p < input->patch_count; ++p)
    present += mesh->assembly->patches[p].triangles + mesh->assembly->patches[p].quads > 0;
  fprintf(out,
          "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       polyBoundaryMesh;\n"
          "    location    \"constant/polyMesh\";\n    object      boundary;\n}\n\n%d\n(\n",
          present);
  for (int p = 0; p < input->patch_count; ++p) {
    const CwModelPatch *patch = &input->patches[p];
    int64_t count = mesh->assembly->patches[p].triangles + mesh->assembly->patches[p].quads;
    if (count == 0) continue;
    fprintf(out, "    %s\n    {\n", patch->name);
    int side = 0, between = cw_mesh_interface_of(input, p, &side);
    if (patch->kind == CW_PATCH_INTERFACE)
      fprintf(out,
              "        type            cyclicAMI;\n        inGroups        1(cyclicAMI);\n"
              "        matchTolerance  0.0001;\n        transform       noOrdering;\n"
              "        neighbourPatch  %s;\n        lowWeightCorrection 0.2;\n",
              input->patches[input->interfaces[between].patch[1 - side]].name);
    else if (patch->kind == CW_PATCH_WALL)
      fprintf(out, "        type            wall;\n        inGroups        1(wall);\n");
    else if (patch->kind == CW_PATCH_SYMMETRY)
      fprintf(out, "        type            symmetry;\n        inGroups        1(symmetry);\n");
    else
      fprintf(out, "        type            patch;\n");
    fprintf(out, "        nFaces          %lld;\n        startFace       %lld;\n    }\n", (long long)count,
            (long long)mesh->patch_face[p]);
  }
  fprintf(out, ")\n");
  CW_REQUIRE(!ferror(out), CW_ERR_IO, "%s: cannot be written", path);
done:
  if (out && fclose(out) != 0 && status == CW_OK)
    status = CW_FAIL(CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  free(path);
  return status;
}

// Several inlets or outlets are a zone of faces too, over which solvers can report a mean.
static CwStatus write_end_zones(const CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  const CwMesh *input = mesh->assembly->mesh;
  FILE *out = NULL;
  char *path = NULL;
  int zones = 0, count[CW_PATCH_KINDS] = {0};
  int64_t faces[CW_PATCH_KINDS] = {0};
  for (int p = 0; p < input->patch_count; ++p) {
    ++count[input->patches[p].kind];
    faces[input->patches[p].kind] += mesh->assembly->patches[p].triangles + mesh->assembly->patches[p].quads;
  }
  for (int kind = CW_PATCH_INLET; kind <= CW_PATCH_OUTLET; ++kind) zones += count[kind] > 1;
  if (!zones) goto done;
  CW_REQUIRE(asprintf(&path, "%s/faceZones", mesh->folder) >= 0, CW_ERR_MEMORY, "out of memory");
  out = fopen(path, "w");
  CW_REQUIRE(out, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  fprintf(out,
          "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       regIOobject;\n"
          "    location    \"constant/polyMesh\";\n    object      faceZones;\n}\n\n%d\n(\n",
          zones);
  for (int kind = CW_PATCH_INLET; kind <= CW_PATCH_OUTLET; ++kind) {
    if (count[kind] <= 1) continue;
    fprintf(out, "%s\n{\n    type            faceZone;\n    faceLabels      List<label>\n%lld\n(\n",
            cw_foam_end_zone((CwPatchKind)kind), (long long)faces[kind]);
    for (int p = 0; p < input->patch_count; ++p) {
      int64_t here = mesh->assembly->patches[p].triangles + mesh->assembly->patches[p].quads;
      for (int64_t f = 0; f < here && (int)input->patches[p].kind == kind; ++f)
        fprintf(out, "%lld\n", (long long)(mesh->patch_face[p] + f));
    }
    fprintf(out, ")\n;\n    flipMap         List<bool> %lld{0};\n}\n", (long long)faces[kind]);
  }
  fprintf(out, ")\n");
  CW_REQUIRE(!ferror(out), CW_ERR_IO, "%s: cannot be written", path);
done:
  if (out && fclose(out) != 0 && status == CW_OK)
    status = CW_FAIL(CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  free(path);
  return status;
}

// All of `cellZones` but the numbers of the cells.
static CwStatus put_zone_texts(const CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  char text[HEADER_SIZE];
  int64_t end = 0;
  for (int d = 0; d < mesh->assembly->mesh->domain_count; ++d) {
    int length = make_zone_head(mesh, d, text);
    CW_TRY(put(mesh, CW_FOAM_ZONES, text, length, mesh->zone_start[d] - length));
    end = mesh->zone_start[d] + 4 * mesh->assembly->totals[d].cells;
    CW_TRY(put(mesh, CW_FOAM_ZONES, zone_tail, (int64_t)strlen(zone_tail), end));
  }
  CW_TRY(put(mesh, CW_FOAM_ZONES, ")\n", 2, end + (int64_t)strlen(zone_tail)));
done:
  return status;
}

CwStatus cw_foam_mesh_create(CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  const CwAssembly *a = mesh->assembly;
  char text[HEADER_SIZE];
  int32_t end = (int32_t)mesh->labels;
  for (int f = 0; f < CW_FOAM_FILES; ++f) {
    CW_TRY(open_file(mesh, f, O_CREAT | O_TRUNC));
    CW_TRY(put(mesh, (CwFoamFile)f, text, make_header(mesh, (CwFoamFile)f, text), 0));
  }
  CW_TRY(put(mesh, CW_FOAM_POINTS, ")\n", 2, mesh->start[CW_FOAM_POINTS] + 24 * mesh->points));
  CW_TRY(put(mesh, CW_FOAM_OWNER, ")\n", 2, mesh->start[CW_FOAM_OWNER] + 4 * mesh->faces));
  CW_TRY(put(mesh, CW_FOAM_NEIGHBOUR, ")\n", 2, mesh->start[CW_FOAM_NEIGHBOUR] + 4 * mesh->inner_faces));
  CW_TRY(put(mesh, CW_FOAM_FACES, &end, 4, mesh->start[CW_FOAM_FACES] + 4 * mesh->faces));
  int length = snprintf(text, sizeof text, ")\n\n%lld\n(", (long long)mesh->labels);
  CW_TRY(put(mesh, CW_FOAM_FACES, text, length, mesh->label_start - length));
  CW_TRY(put(mesh, CW_FOAM_FACES, ")\n", 2, mesh->label_start + 4 * mesh->labels));
  for (int d = 0; d < a->mesh->domain_count; ++d)
    CW_TRY(put(mesh, CW_FOAM_POINTS, a->shared[d], 24 * a->mesh->domains[d].shared_points,
               mesh->start[CW_FOAM_POINTS] + 24 * a->totals[d].first_point));
  CW_TRY(write_boundary(mesh));
  CW_TRY(write_end_zones(mesh));
  CW_TRY(put_zone_texts(mesh));
done:
  return status;
}

// A stretch of faces in memory.
typedef struct {
  int32_t *offsets, *labels, *owners, *neighbours;
  int64_t faces, labels_used, first_label;
} Stretch;

static CwStatus stretch_new(int64_t triangles, int64_t quads, int64_t first_label, Stretch *s) {
  CwStatus status = CW_OK;
  *s = (Stretch){.first_label = first_label};
  CW_NEW_UNSET(s->offsets, triangles + quads);
  CW_NEW_UNSET(s->owners, triangles + quads);
  CW_NEW_UNSET(s->neighbours, triangles + quads);
  CW_NEW_UNSET(s->labels, 3 * triangles + 4 * quads);
done:
  return status;
}

static void stretch_free(Stretch *s) {
  free(s->offsets);
  free(s->owners);
  free(s->neighbours);
  free(s->labels);
  memset(s, 0, sizeof *s);
}

static inline void stretch_add(Stretch *s, const CwFoamMesh *mesh, int region, const CwRegionData *data, int32_t cell,
                               int face, int64_t neighbour) {
  const CwAssembly *a = mesh->assembly;
  int64_t points_before = a->totals[data->domain].first_point;
  int count;
  const int32_t *nodes = cw_cell_nodes(data, cell, &count);
  const signed char *corner = cw_cell_face_table(count)[face];
  s->offsets[s->faces] = (int32_t)(s->first_label + s->labels_used);
  s->owners[s->faces] = (int32_t)(a->places[region].cell + cell);
  s->neighbours[s->faces++] = (int32_t)neighbour;
  for (int i = 0; i < 4 && corner[i] >= 0; ++i)
    s->labels[s->labels_used++] = (int32_t)(points_before + cw_point_number(a, region, data, nodes[corner[i]]));
}

static CwStatus stretch_write(const Stretch *s, const CwFoamMesh *mesh, int64_t first_face, int is_inner) {
  CwStatus status = CW_OK;
  CW_TRY(put(mesh, CW_FOAM_FACES, s->offsets, 4 * s->faces, mesh->start[CW_FOAM_FACES] + 4 * first_face));
  CW_TRY(put(mesh, CW_FOAM_FACES, s->labels, 4 * s->labels_used, mesh->label_start + 4 * s->first_label));
  CW_TRY(put(mesh, CW_FOAM_OWNER, s->owners, 4 * s->faces, mesh->start[CW_FOAM_OWNER] + 4 * first_face));
  if (is_inner)
    CW_TRY(put(mesh, CW_FOAM_NEIGHBOUR, s->neighbours, 4 * s->faces, mesh->start[CW_FOAM_NEIGHBOUR] + 4 * first_face));
done:
  return status;
}

static CwStatus write_inner_faces(const CwFoamMesh *mesh, int region, const CwRegionData *data,
                                  const CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  Stretch s = {0};
  const CwRegionPlace *place = &mesh->assembly->places[region];
  int64_t open = place->open;
  CW_TRY(stretch_new(place->inner_triangles + place->outer_triangles, place->inner_quads + place->outer_quads,
                     mesh->first_label[region], &s));
  for (int32_t cell = 0, cells = cw_region_cell_count(data); cell < cells; ++cell) {
    // The faces to cells of larger numbers, in the order of those numbers.
    int64_t other[CW_CELL_FACES];
    int face[CW_CELL_FACES], count = 0;
    for (int f = 0; f < CW_CELL_FACES; ++f) {
      int32_t across = faces->across[CW_CELL_FACES * cell + f];
      int64_t number = across >= 0 ? place->cell + across : -1;
      if (across == CW_ACROSS_OPEN) number = mesh->assembly->across[open++];
      if (number <= place->cell + cell) continue;
      int at = count++;
      for (; at > 0 && other[at - 1] > number; --at) {
        other[at] = other[at - 1];
        face[at] = face[at - 1];
      }
      other[at] = number;
      face[at] = f;
    }
    for (int i = 0; i < count; ++i) stretch_add(&s, mesh, region, data, cell, face[i], other[i]);
  }
  CW_TRY(stretch_write(&s, mesh, mesh->first_face[region], 1));
done:
  stretch_free(&s);
  return status;
}

static CwStatus write_patch_faces(const CwFoamMesh *mesh, int region, const CwRegionData *data,
                                  const CwRegionFaces *faces, int patch) {
  CwStatus status = CW_OK;
  Stretch s = {0};
  const CwAssembly *a = mesh->assembly;
  const CwPatchPart *part = &a->parts[(size_t)region * (size_t)a->mesh->patch_count + (size_t)patch];
  int local = patch - a->mesh->domains[data->domain].first_patch;
  if (part->triangles + part->quads == 0) goto done;
  CW_TRY(stretch_new(part->triangles, part->quads, mesh->patch_label[patch] + 3 * part->triangle + 4 * part->quad, &s));
  for (int32_t i = 0; i < data->triangle_count; ++i)
    if (data->triangle_patch[i] == local)
      stretch_add(&s, mesh, region, data, faces->triangle_face[i] / CW_CELL_FACES,
                  faces->triangle_face[i] % CW_CELL_FACES, -1);
  for (int32_t i = 0; i < data->quad_count; ++i)
    if (data->quad_patch[i] == local)
      stretch_add(&s, mesh, region, data, faces->quad_face[i] / CW_CELL_FACES, faces->quad_face[i] % CW_CELL_FACES, -1);
  CW_TRY(stretch_write(&s, mesh, mesh->patch_face[patch] + part->triangle + part->quad, 0));
done:
  stretch_free(&s);
  return status;
}

static CwStatus write_zone(const CwFoamMesh *mesh, int region, const CwRegionData *data) {
  CwStatus status = CW_OK;
  int32_t *cells = NULL, count = cw_region_cell_count(data);
  int64_t first = mesh->assembly->places[region].cell;
  int64_t before = 0; // cells of other domains
  for (int d = 0; d < data->domain; ++d) before += mesh->assembly->totals[d].cells;
  CW_NEW_UNSET(cells, count);
  for (int32_t i = 0; i < count; ++i) cells[i] = (int32_t)(first + i);
  CW_TRY(put(mesh, CW_FOAM_ZONES, cells, 4 * (int64_t)count, mesh->zone_start[data->domain] + 4 * (first - before)));
done:
  free(cells);
  return status;
}

CwStatus cw_foam_mesh_write_region(const CwFoamMesh *mesh, int region, const CwRegionData *data,
                                   const CwRegionFaces *faces) {
  CwStatus status = CW_OK;
  const CwAssembly *a = mesh->assembly;
  const CwMeshDomain *domain = &a->mesh->domains[data->domain];
  int64_t first_point = a->totals[data->domain].first_point + a->places[region].own_point;
  CW_TRY(put(mesh, CW_FOAM_POINTS, data->points + data->shared_count,
             24 * (int64_t)(data->point_count - data->shared_count), mesh->start[CW_FOAM_POINTS] + 24 * first_point));
  CW_TRY(write_zone(mesh, region, data));
  CW_TRY(write_inner_faces(mesh, region, data, faces));
  for (int p = domain->first_patch; p < domain->first_patch + domain->patch_count; ++p)
    CW_TRY(write_patch_faces(mesh, region, data, faces, p));
done:
  return status;
}
