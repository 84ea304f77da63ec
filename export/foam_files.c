// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_files.h"

#include <stdio.h>
#include <stdlib.h>

#include "pipeline/atomic_file.h"

CwStatus cw_foam_part_folder(const CwFoamMesh *mesh, int part, char **path) {
  CwStatus status = CW_OK;
  int length = cw_foam_is_divided(mesh) ? asprintf(path, "%s/processor%d/constant/polyMesh", mesh->folder, part)
                                        : asprintf(path, "%s/constant/polyMesh", mesh->folder);
  CW_REQUIRE(length >= 0, CW_ERR_MEMORY, "out of memory");
done:
  return status;
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

CwStatus cw_foam_put_labels(const CwFoamFiles *files, CwFoamFile f, const int64_t *values, int64_t count, int64_t start,
                            int64_t before) {
  const int size = files->mesh->label_size;
  return cw_place_file_put_labels(&files->file[f], values, count, size, start + size * before);
}
