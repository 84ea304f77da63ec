// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_layout.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const cw_foam_file_names[CW_FOAM_FILES] = {"points",
                                                       "faces",
                                                       "owner",
                                                       "neighbour",
                                                       "cellZones",
                                                       "pointProcAddressing",
                                                       "faceProcAddressing",
                                                       "cellProcAddressing"};
static const char *const file_classes[CW_FOAM_FILES] = {"vectorField", "faceCompactList", "labelList", "labelList",
                                                        "regIOobject", "labelList",       "labelList", "labelList"};

int cw_foam_is_divided(const CwFoamMesh *mesh) {
  return mesh->division.part_count > 1;
}

static int64_t face_total(const CwFoamMesh *mesh, int part) {
  return cw_face_count(mesh->parts[part].all);
}

int64_t cw_foam_value_count(const CwFoamMesh *mesh, int part, CwFoamFile f) {
  const CwPart *of = &mesh->division.parts[part];
  switch (f) {
  case CW_FOAM_POINTS:
  case CW_FOAM_OF_POINTS:
    return of->points;
  case CW_FOAM_FACES:
    return face_total(mesh, part) + 1;
  case CW_FOAM_NEIGHBOUR:
    return cw_face_count(of->inner);
  case CW_FOAM_ZONES:
    return mesh->assembly->mesh->domain_count;
  case CW_FOAM_OF_CELLS:
    return of->cells;
  default:
    return face_total(mesh, part);
  }
}

int cw_foam_header(const CwFoamMesh *mesh, int part, CwFoamFile f, char text[CW_FOAM_HEADER_SIZE]) {
  char note[200] = "";
  if (f == CW_FOAM_OWNER || f == CW_FOAM_NEIGHBOUR)
    snprintf(note, sizeof note, "    note        \"nPoints:%lld  nCells:%lld  nFaces:%lld  nInternalFaces:%lld\";\n",
             (long long)mesh->division.parts[part].points, (long long)mesh->division.parts[part].cells,
             (long long)face_total(mesh, part), (long long)cw_face_count(mesh->division.parts[part].inner));
  return snprintf(text, CW_FOAM_HEADER_SIZE,
                  "FoamFile\n{\n    version     2.0;\n    format      binary;\n    class       %s;\n%s"
                  "    arch        \"LSB;label=%d;scalar=64\";\n    location    \"constant/polyMesh\";\n"
                  "    object      %s;\n}\n\n%lld\n(%s",
                  file_classes[f], note, 8 * mesh->label_size, cw_foam_file_names[f],
                  (long long)cw_foam_value_count(mesh, part, f), f == CW_FOAM_ZONES ? "\n" : "");
}

// Faces before those of each patch and link.
static CwStatus count_part(const CwFoamMesh *mesh, int p, CwFoamPart *part) {
  CwStatus status = CW_OK;
  const CwPart *of = &mesh->division.parts[p];
  const int patches = mesh->assembly->mesh->patch_count;
  CW_NEW(part->patch, patches + 1);
  CW_NEW(part->link, of->link_count);
  part->all = of->inner;
  for (int i = 0; i <= patches; ++i) {
    part->patch[i] = part->all;
    if (i < patches) cw_face_count_add(&part->all, of->patch[i]);
  }
  for (int i = 0; i < of->link_count; ++i) {
    part->link[i] = part->all;
    cw_face_count_add(&part->all, mesh->division.links[of->first_link + i].count);
  }
done:
  return status;
}

// Where the values stand in the files.
static void place_values(const CwFoamMesh *mesh, int p, CwFoamPart *part) {
  char text[CW_FOAM_HEADER_SIZE];
  for (int f = 0; f < CW_FOAM_FILES; ++f) part->start[f] = cw_foam_header(mesh, p, (CwFoamFile)f, text);
  // ")\n\nCOUNT\n(" stands between the offsets and the labels.
  part->label_start = part->start[CW_FOAM_FACES] + mesh->label_size * (face_total(mesh, p) + 1) +
                      snprintf(text, sizeof text, ")\n\n%lld\n(", (long long)cw_corner_count(part->all));
}

CwStatus cw_foam_layout_plan(const CwAssembly *a, const char *folder, const CwExportTable *table, CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  const int processors = table->foam_processors;
  mesh->labels = table->foam_labels;
  mesh->release = table->foam_release;
  mesh->assembly = a;
  CW_REQUIRE((mesh->folder = strdup(folder)), CW_ERR_MEMORY, "out of memory");
  CW_TRY(cw_face_layout_make(a, &mesh->layout));
  CW_TRY(cw_division_plan(a, processors, &mesh->division));
  CW_NEW(mesh->parts, processors);
  // The numbers of the parts in the whole mesh have to fit too; its face corners only where it is written whole: those
  // of parts are counted later.
  const int64_t most = processors > 1 ? cw_face_count(mesh->layout.all) : cw_corner_count(mesh->layout.all);
  const int fits = most <= INT32_MAX && mesh->layout.points <= INT32_MAX;
  CW_REQUIRE(fits || mesh->labels != CW_INTEGERS_32, CW_ERR_EXPORT,
             "%lld faces or face corners and %lld points; OpenFOAM with 32-bit labels allows %d (openfoam.labels: 64 "
             "holds them)",
             (long long)most, (long long)mesh->layout.points, INT32_MAX);
  mesh->label_size = mesh->labels == CW_INTEGERS_64 || !fits ? 8 : 4;
done:
  return status;
}

void cw_foam_layout_free(CwFoamMesh *mesh) {
  for (int p = 0; mesh->parts && p < mesh->division.part_count; ++p) {
    free(mesh->parts[p].patch);
    free(mesh->parts[p].link);
  }
  free(mesh->parts);
  free(mesh->folder);
  cw_face_layout_free(&mesh->layout);
  if (mesh->division.assembly) cw_division_free(&mesh->division);
  memset(mesh, 0, sizeof *mesh);
}

CwStatus cw_foam_layout_parts(CwFoamMesh *mesh) {
  CwStatus status = CW_OK;
  int64_t most = 0;
  for (int p = 0; p < mesh->division.part_count; ++p) {
    CW_TRY(count_part(mesh, p, &mesh->parts[p]));
    const int64_t corners = cw_corner_count(mesh->parts[p].all);
    most = corners > most ? corners : most;
  }
  CW_REQUIRE(most <= INT32_MAX || mesh->labels != CW_INTEGERS_32, CW_ERR_EXPORT,
             "%lld face corners in one part; OpenFOAM with 32-bit labels allows %d (openfoam.labels: 64 or more "
             "openfoam.processors hold them)",
             (long long)most, INT32_MAX);
  if (most > INT32_MAX) mesh->label_size = 8;
  for (int p = 0; p < mesh->division.part_count; ++p) place_values(mesh, p, &mesh->parts[p]);
done:
  return status;
}
