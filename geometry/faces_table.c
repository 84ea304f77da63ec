// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/faces_table.h"

#include "pipeline/atomic_file.h"

CwStatus cw_faces_table_write(const CwSolid *const *solids, int count, const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  CW_TRY(cw_atomic_file_open(path, &file));
  fprintf(file.stream, "domain,face,patch,kind,name\n");
  for (int i = 0; i < count; i++)
    for (int face = 0; face < cw_solid_face_count(solids[i]); face++)
      fprintf(file.stream, "%s,%d,%s,%s,%s\n", cw_solid_domain(solids[i]), face + 1,
              cw_solid_face_patch(solids[i], face), cw_solid_face_kind(solids[i], face),
              cw_solid_face_name(solids[i], face));
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}
