// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_pump.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "geometry/cad/cad_cut.h"
#include "geometry/cad/contact_surface.h"
#include "geometry/cad/divide.h"
#include "geometry/cad/parts_joined.h"
#include "geometry/cad/passages.h"
#include "geometry/cad/solid_choice.h"

// Gap that is closed where the case gives none, over the model unit: the wheel has 128 to 256 of them.
static const double TOLERANCE = 0.01;
enum { PIECES = 3 }; // of a closed face that does not rotate

static double tolerance_of(const CwCaseCad *cad, double unit) {
  return cw_case_given(cad->tolerance) ? cad->tolerance : TOLERANCE * unit;
}

// What is meant by the unit of a model before there are parts: of a wheel that reaches as far as the cut.
static double unit_of_cut(const CwCadCut *cut) {
  double reach = fmax(0, cut->radius);
  for (int i = 0; i < cut->count; i++) reach = fmax(reach, cut->meridian[i][0]);
  return reach > 0 ? cw_solid_unit_of_drawing(2 * reach) : 0;
}

static CwStatus read_parts(const CwCaseCad *cad, CwLog *log, CwCadPump *pump) {
  CwStatus status = CW_OK;
  CwCadBodies *bodies = NULL;
  int *domain = NULL;
  const double tolerance = cw_case_given(cad->tolerance) ? cad->tolerance : 0;
  cw_cad_frame_make(cad, &pump->frame);
  for (int i = 0; i < cad->files.count; i++)
    CW_TRY(cw_cad_file_read(cad->files.text[i], cad->unit, tolerance, &bodies));
  CW_TRY(cw_cad_cut(cad, &pump->frame, tolerance_of(cad, unit_of_cut(&cad->cut)), log, bodies));
  CW_NEW(domain, cw_cad_body_count(bodies));
  CW_TRY(cw_cad_solid_choice(cad, bodies, domain));
  CW_TRY(cw_cad_parts_make(cad, &pump->frame, bodies, domain, &pump->parts));
  const double unit = cw_cad_parts_unit(pump->parts);
  pump->tolerance = tolerance_of(cad, unit);
  CW_TRY(cw_cad_heal(pump->tolerance / unit, &pump->frame, log, pump->parts, &pump->fault));
done:
  free(domain);
  cw_cad_bodies_free(&bodies);
  return status;
}

// Looks at the faces as they are now.
static CwStatus look(const CwCaseCad *cad, CwCadPump *pump) {
  CwStatus status = CW_OK;
  int *rotating = NULL;
  cw_survey_free(&pump->survey);
  free(pump->contact);
  free(pump->role);
  pump->contact = NULL;
  pump->role = NULL;
  CW_TRY(cw_survey_make(pump->parts, &pump->frame, &pump->survey));
  CW_NEW(pump->contact, pump->survey.face_count);
  CW_NEW(pump->role, pump->survey.face_count);
  CW_NEW(rotating, cad->domain_count);
  for (int d = 0; d < cad->domain_count; d++) rotating[d] = cad->domain[d].rotating;
  CW_TRY(cw_contact_find(pump->parts, &pump->survey, &pump->frame, cad, pump->tolerance, pump->contact));
  CW_TRY(cw_proposal_make(&pump->survey, pump->contact, rotating, pump->role, &pump->blade_count));
done:
  free(rotating);
  return status;
}

static int number_of(const CwCadPump *pump, int face) {
  const CwSurveyFace *of = &pump->survey.face[face];
  return cw_cad_part_face(pump->parts, of->part, of->face).number;
}

// More than there are faces, where solids are fused or small faces go.
static int count_numbers(const CwCadPump *pump) {
  int count = 0;
  for (int f = 0; f < pump->survey.face_count; f++)
    if (number_of(pump, f) >= count) count = number_of(pump, f) + 1;
  return count;
}

// What the faces of the file are, by their numbers, as long as none is divided: a piece does not show it.
static void note_roles(const CwCadPump *pump, CwFaceRole *role) {
  for (int f = 0; f < pump->survey.face_count; f++)
    if (number_of(pump, f) >= 0) role[number_of(pump, f)] = pump->role[f];
}

// Pieces of blades are blades, and those of openings are openings.
static void keep_roles(CwCadPump *pump, int count, const CwFaceRole *role) {
  for (int f = 0; f < pump->survey.face_count; f++) {
    const int number = number_of(pump, f);
    if (pump->role[f] == CW_ROLE_CONTACT || number < 0 || number >= count) continue;
    if (role[number] == CW_ROLE_BLADE || role[number] == CW_ROLE_INLET || role[number] == CW_ROLE_OUTLET)
      pump->role[f] = role[number];
  }
}

static CwStatus cut_contacts(const CwCaseCad *cad, CwLog *log, CwCadPump *pump) {
  CwStatus status = CW_OK;
  int cut = 0;
  CW_TRY(cw_contact_imprint(&pump->survey, pump->contact, pump->tolerance, log, pump->parts, &cut));
  if (!cut) goto done;
  CW_TRY(look(cad, pump));
  for (int f = 0; f < pump->survey.face_count; f++) {
    const CwContact *contact = &pump->contact[f];
    double at[3];
    char off[80] = "";
    cw_cad_frame_to_file(&pump->frame, contact->gap > 0 ? contact->at : pump->survey.face[f].at, at);
    if (contact->gap > 0) snprintf(off, sizeof off, " and is up to %.4g mm off it elsewhere", 1e3 * contact->gap);
    CW_REQUIRE(
        contact->part < 0 || contact->share >= 1, CW_ERR_GEOMETRY,
        "cad.domains: a face of %s still touches %s with a part of it%s, at (%.3f, %.3f, %.3f) mm; allowed: "
        "domains that touch along whole faces, at the most cad.tolerance_mm, %.3g, apart; draw the interface once "
        "and use it for both",
        cad->domain[pump->survey.face[f].part].name, cad->domain[contact->part].name, off, 1e3 * at[0], 1e3 * at[1],
        1e3 * at[2], 1e3 * pump->tolerance);
  }
done:
  return status;
}

CwStatus cw_cad_pump_read(const CwCaseCad *cad, CwLog *log, CwCadPump *pump) {
  CwStatus status = CW_OK;
  int *pieces = NULL;
  CwFaceRole *role = NULL;
  CW_TRY(read_parts(cad, log, pump));
  CW_TRY(look(cad, pump));
  const int numbers = count_numbers(pump), blades = pump->blade_count;
  CW_NEW(pieces, cad->domain_count);
  CW_NEW(role, numbers);
  note_roles(pump, role);
  for (int d = 0; d < cad->domain_count; d++)
    pieces[d] = cad->domain[d].rotating && pump->blade_count > 1 ? pump->blade_count : PIECES;
  CW_TRY(cw_cad_divide(pieces, &pump->frame, log, pump->parts));
  for (int d = 0; d < cad->domain_count; d++) {
    if (cad->domain[d].rotating && blades > 1)
      CW_TRY(cw_cad_passages(d, blades, pump->tolerance / cw_cad_parts_unit(pump->parts), log, pump->parts));
  }
  CW_TRY(look(cad, pump));
  CW_TRY(cut_contacts(cad, log, pump));
  keep_roles(pump, numbers, role);
  if (blades > 1) pump->blade_count = blades;
done:
  free(pieces);
  free(role);
  return status;
}

CwStatus cw_cad_pump_name(const CwCaseCad *cad, CwCadPump *pump) {
  CwStatus status = CW_OK;
  CW_TRY(cw_face_patches_make(cad, &pump->frame, pump->parts, &pump->survey, pump->contact, pump->role, pump->tolerance,
                              &pump->patches));
  CW_TRY(cw_contact_patches_part(cad, &pump->survey, pump->contact, pump->tolerance, &pump->patches));
  CW_TRY(cw_cad_interfaces_make(cad, &pump->survey, pump->contact, &pump->patches, pump->tolerance,
                                &pump->interface_count, &pump->interface));
  CW_TRY(
      cw_parts_joined(pump->parts, &pump->survey, pump->contact, &pump->frame, cad, pump->tolerance, &pump->patches));
done:
  return status;
}

CwStatus cw_cad_pump_solids(const CwCadPump *pump, CwSolid **solids) {
  CwStatus status = CW_OK;
  const char **patch = NULL;
  CwPatchKind *kind = NULL;
  CW_NEW(patch, pump->survey.face_count);
  CW_NEW(kind, pump->survey.face_count);
  for (int p = 0, f = 0; p < cw_cad_part_count(pump->parts); p++) {
    int count = 0;
    for (; f < pump->survey.face_count && pump->survey.face[f].part == p; f++, count++) {
      const CwFacePatch *of = &pump->patches.patch[pump->patches.of_face[f]];
      patch[count] = of->name;
      kind[count] = of->kind;
    }
    CW_TRY(cw_cad_part_solid(pump->parts, p, patch, kind, &solids[p]));
  }
done:
  free(patch);
  free(kind);
  return status;
}

void cw_cad_pump_free(CwCadPump *pump) {
  cw_cad_parts_free(&pump->parts);
  cw_survey_free(&pump->survey);
  cw_face_patches_free(&pump->patches);
  free(pump->contact);
  free(pump->role);
  free(pump->interface);
  memset(pump, 0, sizeof *pump);
}
