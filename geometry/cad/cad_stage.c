// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "geometry/cad/cad_pump.h"
#include "geometry/cad/faces_picture.h"
#include "geometry/cad/faces_sheet.h"
#include "geometry/pump_files.h"
#include "pipeline/case_cad.h"
#include "pipeline/log.h"

enum { MESSAGE_SIZE = 1000 };
static const double ALIKE = 0.01; // of the size

typedef struct {
  const CwCaseCad *cad;
  CwCadPump pump;
  CwModel model;
  CwSolid **solid;
} Work;

static CwStatus write_sheet(const CwStageArgs *args, const Work *work, int named) {
  CwStatus status = CW_OK;
  const CwCadPump *pump = &work->pump;
  char *path = NULL;
  CW_TRY(cw_geometry_path(args, "faces_sheet.csv", &path));
  CW_TRY(cw_faces_sheet_write(work->cad, &pump->frame, pump->parts, &pump->survey, pump->role,
                              named ? &pump->patches : NULL, path));
done:
  free(path);
  return status;
}

// One of each domain: faces_NAME.svg.
static CwStatus write_pictures(const CwStageArgs *args, const CwCaseCad *cad, const CwSurvey *survey) {
  CwStatus status = CW_OK;
  char *path = NULL;
  for (int d = 0; d < cad->domain_count; d++) {
    char name[CW_NAME_SIZE + 16], title[CW_NAME_SIZE + 80];
    snprintf(name, sizeof name, "faces_%s.svg", cad->domain[d].name);
    snprintf(title, sizeof title, "%s: faces by their numbers in faces_sheet.csv", cad->domain[d].name);
    CW_TRY(cw_geometry_path(args, name, &path));
    CW_TRY(cw_faces_picture_write(survey, d, title, NULL, path));
    free(path);
    path = NULL;
  }
done:
  free(path);
  return status;
}

// Where a solid cannot be healed, or one of its faces not be triangulated: fault.svg, with the place marked. The
// message is that of the solid whatever happens here.
static void show_fault(const CwStageArgs *args, const Work *work) {
  CwSurvey unhealed = {0};
  const CwSurvey *survey = &work->pump.survey;
  CwCadFault fault = work->pump.fault;
  char *path = NULL, title[CW_NAME_SIZE + 80], message[MESSAGE_SIZE];
  snprintf(message, sizeof message, "%s", cw_fail_message());
  if (fault.found) {
    cw_survey_make(work->pump.parts, &work->pump.frame, &unhealed); // one that fails is good for a picture
    survey = &unhealed;
  } else if (survey->segment_count) {
    const CwSurveyFace *face = &survey->face[survey->segment[0].face];
    fault = (CwCadFault){1, face->part, {face->at[0], face->at[1], face->at[2]}};
  }
  snprintf(title, sizeof title, "%s: the place of the fault", work->cad->domain[fault.part].name);
  if (fault.found && survey->face_count && cw_geometry_path(args, "fault.svg", &path) == CW_OK &&
      cw_faces_picture_write(survey, fault.part, title, fault.at, path) == CW_OK)
    cw_log(args->log, "geometry/fault.svg shows the place");
  CW_FAIL(CW_ERR_GEOMETRY, "%s", message);
  cw_survey_free(&unhealed);
  free(path);
}

// What an earlier run has drawn of a solid that is mended now.
static CwStatus remove_old_fault(const CwStageArgs *args) {
  CwStatus status = CW_OK;
  char *path = NULL;
  CW_TRY(cw_geometry_path(args, "fault.svg", &path));
  remove(path);
done:
  free(path);
  return status;
}

static void show(CwLog *log, const Work *work) {
  const CwCadPump *pump = &work->pump;
  for (int d = 0; d < work->cad->domain_count; d++)
    cw_log(log, "%s: %d faces, %s", work->cad->domain[d].name, cw_cad_part_face_count(pump->parts, d),
           work->cad->domain[d].rotating ? "rotating" : "at rest");
  if (pump->blade_count > 1) cw_log(log, "the wheel has %d equal passages", pump->blade_count);
  for (int i = 0; i < pump->patches.count; i++) {
    const CwFacePatch *patch = &pump->patches.patch[i];
    int faces = 0;
    for (int f = 0; f < pump->survey.face_count; f++) faces += pump->patches.of_face[f] == i;
    cw_log(log, "%-10s %-22s %-9s %4d faces %12.2f mm2%s", work->cad->domain[patch->part].name, patch->name,
           cw_patch_kind_name(patch->kind), faces, 1e6 * patch->area,
           patch->source == CW_FROM_RULE   ? ""
           : patch->source == CW_FROM_FILE ? "  named by the file"
                                           : "  proposed: name it in cad.patches");
  }
  for (int i = 0; i < pump->interface_count; i++) {
    const CwCadInterface *between = &pump->interface[i];
    if (between->off > 0)
      cw_log(log, "%s and %s: radii or ends differ by up to %.3g mm, so that nearest faces are coupled",
             pump->patches.patch[between->patch[0]].name, pump->patches.patch[between->patch[1]].name,
             1e3 * between->off);
  }
}

// -1 or 1: the sign of z from the middle of what rotates to that of the inlets; -1 where both lie alike, as of a wheel
// with two eyes.
static int suction_side(const CwCaseCad *cad, const CwCadPump *pump) {
  double area[2] = {0}, moment[2] = {0}; // of what rotates, of inlets
  for (int f = 0; f < pump->survey.face_count; f++) {
    const CwSurveyFace *face = &pump->survey.face[f];
    const int inlet = pump->patches.patch[pump->patches.of_face[f]].kind == CW_PATCH_INLET;
    if (!inlet && !cad->domain[face->part].rotating) continue;
    area[inlet] += face->area;
    moment[inlet] += face->area * face->centre[2];
  }
  return moment[1] / area[1] - moment[0] / area[0] > ALIKE * pump->survey.size ? 1 : -1;
}

static CwStatus note(CwLog *log, const Work *work, const CwCase *table, CwRecord *record) {
  CwStatus status = CW_OK;
  const CwCadPump *pump = &work->pump;
  int proposed = 0;
  for (int i = 0; i < pump->patches.count; i++) proposed += pump->patches.patch[i].source == CW_FROM_PROPOSAL;
  if (proposed)
    cw_log_warn(log,
                "%d patches are proposals by geometry alone; look at geometry/faces_sheet.csv and name them in "
                "cad.patches",
                proposed);
  CW_TRY(cw_record_case(record, table));
  CW_TRY(cw_record_number(record, "faces", pump->survey.face_count));
  CW_TRY(cw_record_number(record, "proposed_patches", proposed));
  CW_TRY(cw_record_number(record, "tolerance_m", pump->tolerance));
  CW_TRY(cw_record_number(record, "blade_count", pump->blade_count));
  CW_TRY(cw_record_integer(record, "suction_side", suction_side(work->cad, pump)));
done:
  return status;
}

CwStatus cw_cad_stage(const CwStageArgs *args, const CwCase *table, CwRecord *record) {
  CwStatus status = CW_OK;
  Work work = {.cad = table->cad};
  const double begin = cw_seconds();
  CW_NEW(work.solid, work.cad->domain_count);
  CW_TRY(remove_old_fault(args));
  for (int i = 0; i < work.cad->files.count; i++)
    if (!access(work.cad->files.text[i], R_OK)) CW_TRY(cw_record_input(record, work.cad->files.text[i]));
  status = cw_cad_pump_read(work.cad, args->log, &work.pump);
  if (status == CW_ERR_GEOMETRY) show_fault(args, &work);
  if (status != CW_OK) goto done;
  CW_TRY(write_sheet(args, &work, 0));
  CW_TRY(write_pictures(args, work.cad, &work.pump.survey));
  CW_TRY(cw_record_step(record, "solids", cw_seconds() - begin, work.pump.survey.face_count, "faces"));
  CW_TRY(cw_cad_pump_name(work.cad, &work.pump));
  CW_TRY(write_sheet(args, &work, 1));
  show(args->log, &work);
  CW_TRY(cw_cad_model_make(table, &work.pump.survey, &work.pump.patches, work.pump.interface_count, work.pump.interface,
                           work.pump.blade_count, cw_cad_parts_unit(work.pump.parts), &work.model));
  CW_TRY(cw_cad_pump_solids(&work.pump, work.solid));
  CW_TRY(cw_pump_files_write(
      args, &(CwPumpFiles){.count = work.cad->domain_count, .solid = work.solid, .model = &work.model}, record));
  CW_TRY(note(args->log, &work, table, record));
done:
  for (int d = 0; work.solid && d < work.cad->domain_count; d++) cw_solid_free(&work.solid[d]);
  free(work.solid);
  cw_model_free(&work.model);
  cw_cad_pump_free(&work.pump);
  return status;
}
