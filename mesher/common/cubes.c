// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/common/cubes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/common/box.h"
#include "mesher/common/incident.h"

enum { ALONG_MOST = 256 };

static int32_t cube_of(const CwCubes *cubes, const double x[3]) {
  int32_t place[3];
  for (int k = 0; k < 3; k++) {
    int32_t at = (int32_t)((x[k] - cubes->low[k]) / cubes->size);
    place[k] = at < cubes->count[k] ? at : cubes->count[k] - 1;
  }
  return (int32_t)cw_cube(cubes, place[0], place[1], place[2]);
}

CwStatus cw_cubes_make(int32_t count, const double (*x)[3], double size, CwCubes *cubes) {
  CwStatus status = CW_OK;
  int32_t *of = NULL; // of each point
  CwBox box = count ? cw_box_of_points(count, x) : (CwBox){{0}, {0}};
  size_t all = 1;
  memset(cubes, 0, sizeof *cubes);
  cubes->size = fmax(size, cw_box_longest(&box) / ALONG_MOST);
  for (int k = 0; k < 3; k++) {
    cubes->low[k] = box.low[k];
    cubes->count[k] = (int32_t)((box.high[k] - box.low[k]) / cubes->size) + 1;
    all *= (size_t)cubes->count[k];
  }
  CW_NEW(cubes->start, all + 1);
  CW_NEW_UNSET(cubes->member, count);
  CW_NEW_UNSET(of, count);
  for (int32_t i = 0; i < count; i++) of[i] = cube_of(cubes, x[i]);
  cw_list_by_group(count, of, (int32_t)all, cubes->start, cubes->member);
done:
  free(of);
  if (status != CW_OK) cw_cubes_free(cubes);
  return status;
}

void cw_cubes_free(CwCubes *cubes) {
  free(cubes->start);
  free(cubes->member);
  memset(cubes, 0, sizeof *cubes);
}

void cw_cubes_near(const CwCubes *cubes, const double x[3], double radius, int32_t from[3], int32_t to[3]) {
  for (int k = 0; k < 3; k++) {
    double first = floor((x[k] - radius - cubes->low[k]) / cubes->size);
    double last = floor((x[k] + radius - cubes->low[k]) / cubes->size);
    from[k] = (int32_t)fmin(fmax(first, 0), cubes->count[k]);
    to[k] = (int32_t)fmax(fmin(last, cubes->count[k] - 1), -1);
  }
}
