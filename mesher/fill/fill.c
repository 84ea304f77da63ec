// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/fill/fill.h"

#include <stdlib.h>
#include <string.h>

void cw_fill_free(CwFill *fill) {
  free(fill->x);
  free(fill->tetrahedron);
  memset(fill, 0, sizeof *fill);
}
