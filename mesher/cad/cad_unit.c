// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/cad_unit.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/json_read.h"

static const double millimetre = 1e-3; // m

CwStatus cw_cad_unit_read(const char *geometry_dir, double *unit) {
  CwStatus status = CW_OK;
  json_t *root = NULL;
  const size_t size = strlen(geometry_dir) + sizeof "/model.json";
  char *path = malloc(size);
  CW_REQUIRE(path, CW_ERR_MEMORY, "out of memory: a path");
  snprintf(path, size, "%s/model.json", geometry_dir);
  *unit = millimetre;
  if (access(path, F_OK) != 0 && errno == ENOENT) goto done;
  CW_TRY(cw_json_read(path, &root));
  CW_TRY(cw_json_positive(root, path, "unit_m", unit));
done:
  json_decref(root);
  free(path);
  return status;
}
