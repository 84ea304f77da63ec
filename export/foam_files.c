// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_files.h"

#include <stdlib.h>

#include "export/folder.h"
#include "pipeline/atomic_file.h"

CwStatus cw_foam_part_folder(const CwFoamMesh *mesh, int part, char **path) {
  return cw_foam_is_divided(mesh) ? cw_path_set(path, "%s/processor%d/constant/polyMesh", mesh->folder, part)
                                  : cw_path_set(path, "%s/constant/polyMesh", mesh->folder);
}

CwStatus cw_foam_files_close(CwFoamFiles *files, CwStatus status) {
  for (int f = 0; f < CW_FOAM_FILES; ++f) {
    const CwStatus closed = cw_place_file_close(&files->file[f]);
    if (status == CW_OK) status = closed;
  }
  return status;
}

CwStatus cw_foam_files_open(const CwFoamMesh *mesh, int part, int is_new, CwFoamFiles *files) {
  CwStatus status = CW_OK;
  char *folder = NULL;
  *files = (CwFoamFiles){.mesh = mesh, .part = part};
  CW_TRY(cw_foam_part_folder(mesh, part, &folder));
  if (is_new) CW_TRY(cw_make_directory(folder));
  for (int f = 0; f < (cw_foam_is_divided(mesh) ? CW_FOAM_FILES : CW_FOAM_WHOLE_FILES); ++f)
    CW_TRY(cw_place_file_open(folder, cw_foam_file_names[f], is_new, &files->file[f]));
done:
  free(folder);
  return status;
}

CwStatus cw_foam_put_labels(const CwFoamFiles *files, CwFoamFile f, const int64_t *values, int64_t count,
                            int64_t before) {
  const int size = files->mesh->label_size;
  if (f >= CW_FOAM_WHOLE_FILES && !cw_foam_is_divided(files->mesh)) return CW_OK;
  return cw_place_file_put_labels(&files->file[f], values, count, size,
                                  files->mesh->parts[files->part].start[f] + size * before);
}

CwStatus cw_foam_put_points(const CwFoamFiles *files, const double (*points)[3], const int64_t *numbers, int64_t count,
                            int64_t before) {
  CwStatus status = CW_OK;
  CW_TRY(cw_place_file_put(&files->file[CW_FOAM_POINTS], points, CW_FOAM_POINT_SIZE * count,
                           files->mesh->parts[files->part].start[CW_FOAM_POINTS] + CW_FOAM_POINT_SIZE * before));
  CW_TRY(cw_foam_put_labels(files, CW_FOAM_OF_POINTS, numbers, count, before));
done:
  return status;
}
