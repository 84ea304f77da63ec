// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/measure/domain_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

CwStatus cw_domain_mesh_read(const char *mesh_dir, const char *domain, CwDomainMesh *mesh) {
  CwStatus status = CW_OK;
  char path[4096];
  int32_t count = 0;
  memset(mesh, 0, sizeof *mesh);
  for (;; count++) {
    snprintf(path, sizeof path, "%s/%s-%04d.h5", mesh_dir, domain, count + 1);
    if (access(path, R_OK)) break;
  }
  CW_REQUIRE(count > 0, CW_ERR_INPUT, "%s: no such file", path);
  CW_NEW(mesh->region, count);
  for (int32_t r = 0; r < count; r++) {
    snprintf(path, sizeof path, "%s/%s-%04d.h5", mesh_dir, domain, r + 1);
    CW_TRY(cw_region_read(path, &mesh->region[r]));
    mesh->region_count++;
  }
done:
  if (status != CW_OK) cw_domain_mesh_free(mesh);
  return status;
}

void cw_domain_mesh_free(CwDomainMesh *mesh) {
  for (int32_t r = 0; r < mesh->region_count; r++) cw_region_free(&mesh->region[r]);
  free(mesh->region);
  memset(mesh, 0, sizeof *mesh);
}
