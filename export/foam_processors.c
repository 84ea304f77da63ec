// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/foam_processors.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/atomic_file.h"

enum { PATH_SIZE = 4096 };

static CwStatus make_link(const char *folder, const char *name, const char *target) {
  CwStatus status = CW_OK;
  char path[PATH_SIZE];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  CW_REQUIRE(symlink(target, path) == 0, CW_ERR_IO, "%s: cannot be made: %s", path, strerror(errno));
done:
  return status;
}

CwStatus cw_foam_processors_link(const char *folder, int count, const char *above) {
  CwStatus status = CW_OK;
  char part[PATH_SIZE - 100], target[100];
  for (int p = 0; p < count; ++p) {
    snprintf(part, sizeof part, "%s/processor%d", folder, p);
    CW_TRY(cw_make_directory(part));
    CW_TRY(make_link(part, "0", "../0"));
    snprintf(target, sizeof target, "%s/processor%d/constant", above ? above : "", p);
    if (above) CW_TRY(make_link(part, "constant", target));
  }
done:
  return status;
}
