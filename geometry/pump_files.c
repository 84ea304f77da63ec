// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump_files.h"

#include <stdio.h>
#include <stdlib.h>

#include "geometry/step_file.h"
#include "pipeline/atomic_file.h"

enum { NAME_SIZE = CW_NAME_SIZE + 32 };
enum { FACES, MODEL, STEP, OF_ALL };
static const char *const names_of_all[] = {"faces.csv", "model.json", "pump.step"};
static const char name_with_faces[] = "pump_faces.step";

CwStatus cw_geometry_path(const CwStageArgs *args, const char *name, char **path) {
  char inside[NAME_SIZE + 16];
  snprintf(inside, sizeof inside, "geometry/%s", name);
  return cw_stage_path(args, inside, path);
}

CwStatus cw_faces_table_write(const CwSolid *const *solids, int count, const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  CW_TRY(cw_atomic_file_open(path, &file));
  fprintf(file.stream, "domain,face,patch,kind,name\n");
  for (int i = 0; i < count; i++)
    for (int face = 0; face < cw_solid_face_count(solids[i]); face++)
      fprintf(file.stream, "%s,%d,%s,%s,%s\n", cw_solid_domain(solids[i]), face + 1,
              cw_solid_face_patch(solids[i], face), cw_patch_kind_name(cw_solid_face_kind(solids[i], face)),
              cw_solid_face_name(solids[i], face));
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}

// File k: the solids', those of all pumps, the others, and the one that is made beside them.
static void name_of(const CwPumpFiles *files, int k, char name[NAME_SIZE]) {
  const int beyond = k - files->count, other = beyond - OF_ALL;
  snprintf(name, NAME_SIZE, "%s%s",
           beyond < 0                   ? cw_solid_domain(files->solid[k])
           : beyond < OF_ALL            ? names_of_all[beyond]
           : other < files->other_count ? files->other[other]
                                        : name_with_faces,
           beyond < 0 ? ".brep" : "");
}

static CwStatus write_file(const CwPumpFiles *files, int k, const char *path, CwBeside **beside) {
  const CwSolid *const *solids = (const CwSolid *const *)files->solid;
  const int beyond = k - files->count, other = beyond - OF_ALL;
  if (beyond < 0) return cw_solid_write_brep(solids[k], path);
  if (beyond == FACES) return cw_faces_table_write(solids, files->count, path);
  if (beyond == MODEL) return cw_model_write(files->model, path);
  if (beyond == STEP) return cw_step_write(solids, files->count, path);
  return other < files->other_count ? files->write(files->given, other, path) : cw_beside_end(beside, path);
}

CwStatus cw_pump_files_write(const CwStageArgs *args, const CwPumpFiles *files, CwRecord *record) {
  CwStatus status = CW_OK;
  CwBeside *beside = NULL;
  char *folder = NULL, *path = NULL, name[NAME_SIZE];
  const double begin = cw_seconds();
  const int count = files->count + OF_ALL + files->other_count + 1;
  CW_TRY(cw_stage_path(args, "geometry", &folder));
  CW_TRY(cw_geometry_path(args, name_with_faces, &path));
  CW_TRY(cw_step_write_with_faces((const CwSolid *const *)files->solid, files->count, path, &beside));
  for (int k = 0; k < count; k++) {
    name_of(files, k, name);
    free(path);
    CW_TRY(cw_geometry_path(args, name, &path));
    CW_TRY(write_file(files, k, path, &beside));
    CW_TRY(cw_record_file(record, folder, name));
  }
  CW_TRY(cw_record_step(record, "files", cw_seconds() - begin, count, "files"));
done:
  cw_beside_drop(&beside);
  free(folder);
  free(path);
  return status;
}
