// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/faces_sheet.h"

#include "pipeline/atomic_file.h"

// Within quotes.
static void write_text(FILE *stream, const char *text) {
  for (const char *c = text; *c; c++) {
    if (*c == '"') fputc('"', stream);
    fputc((unsigned char)*c < 0x20 ? ' ' : *c, stream);
  }
}

// All in one cell.
static void write_layers(FILE *stream, const CwCadParts *parts, const CwSurveyFace *face) {
  const char *layer;
  for (int i = 0; (layer = cw_cad_part_face_layer(parts, face->part, face->face, i)); i++) {
    if (i) fputs("; ", stream);
    write_text(stream, layer);
  }
}

static void write_neighbours(FILE *stream, const CwSurvey *survey, int face) {
  int last = -1;
  // Ascending, each once.
  for (;;) {
    int next = -1;
    for (int e = 0; e < survey->edge_count; e++) {
      const CwSurveyEdge *edge = &survey->edge[e];
      if (edge->face[0] != face && edge->face[1] != face) continue;
      const int other = edge->face[edge->face[0] == face];
      if (other > last && (next < 0 || other < next)) next = other;
    }
    if (next < 0) return;
    fprintf(stream, "%s%d", last < 0 ? "" : " ", next + 1);
    last = next;
  }
}

CwStatus cw_faces_sheet_write(const CwCaseCad *cad, const CwCadFrame *frame, const CwCadParts *parts,
                              const CwSurvey *survey, const CwFaceRole *role, const CwFacePatches *patches,
                              const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  CW_TRY(cw_atomic_file_open(path, &file));
  FILE *stream = file.stream;
  static const char *const forms[] = {"plane", "revolved", "other"};
  fprintf(stream, "face,domain,name,colour,layer,form,area_mm2,normal_x,normal_y,normal_z,radius_least_mm,"
                  "radius_greatest_mm,near_x_mm,near_y_mm,near_z_mm,neighbours,proposed,patch,kind,from\n");
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    const CwFacePatch *patch = patches ? &patches->patch[patches->of_face[f]] : NULL;
    double at[3], normal[3], ahead[3], foot[3];
    cw_cad_frame_to_file(frame, face->at, at);
    for (int i = 0; i < 3; i++) ahead[i] = face->at[i] + face->normal[i];
    cw_cad_frame_to_file(frame, ahead, foot);
    for (int i = 0; i < 3; i++) normal[i] = foot[i] - at[i];
    const CwCadFaceInfo info = cw_cad_part_face(parts, face->part, face->face);
    fprintf(stream, "%d,%s,\"", f + 1, cad->domain[face->part].name);
    write_text(stream, info.name);
    if (info.colour >= 0)
      fprintf(stream, "\",#%06x,\"", info.colour);
    else
      fprintf(stream, "\",,\"");
    write_layers(stream, parts, face);
    fprintf(stream, "\",%s,%.6g,%.4f,%.4f,%.4f,%.6g,%.6g,%.4f,%.4f,%.4f,", forms[face->form], 1e6 * face->area,
            normal[0], normal[1], normal[2], 1e3 * face->radius[0], 1e3 * face->radius[1], 1e3 * at[0], 1e3 * at[1],
            1e3 * at[2]);
    write_neighbours(stream, survey, f);
    fprintf(stream, ",%s,%s,%s,%s\n", cw_face_role_name(role[f]), patch ? patch->name : "",
            patch ? cw_patch_kind_name(patch->kind) : "", patch ? cw_patch_source_name(patch->source) : "");
  }
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}
