// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_sweep.h"

#include "pipeline/case_schema.h"
#include "pipeline/wall_group.h"

// T(share) / T(1): what the first height is multiplied by when one layer becomes 1 / share of them.
static double first_height_factor(double growth, double share) {
  return growth == 1 ? share : (pow(growth, share) - 1) / (growth - 1);
}

static void refine(CwWallGroup *group, double growth, double share) {
  if (cw_case_given(group->growth_ratio)) {
    growth = group->growth_ratio;
    group->growth_ratio = pow(growth, share);
  }
  const double factor = first_height_factor(growth, share);
  group->y_plus *= factor; // NAN where it is not given
  group->first_height *= factor;
}

CwStatus cw_case_sweep(const char *path, int64_t cells, CwCase *table) {
  CwStatus status = CW_OK;
  CwWalls *walls = &table->walls;
  const double ratio = cbrt((double)cells / (double)table->mesh.cells);
  table->mesh.cells = cells;
  if (table->mesh.sweep != CW_SWEEP_SIMILAR || ratio == 1) goto done;
  CW_REQUIRE(
      walls->layer_count && cw_case_given(walls->growth_ratio) && !cw_walls_auto(walls), CW_ERR_INPUT,
      "%s: mesh.sweep: similar refines given layers, but some are left to the mesher; allowed: numbers for "
      "walls.layer_count (5), walls.growth_ratio (1.2) and a y_plus or first_height of each group (y_plus_blade: "
      "30), or sweep: layers_stay",
      path);
  const CwCaseKey *key = &cw_case_keys[cw_case_key_find("walls", "layer_count")];
  const int own = walls->layer_count;
  const double count = fmax(round(own * ratio), 1);
  CW_REQUIRE(count <= key->most, CW_ERR_INPUT,
             "%s: mesh.sweep: similar makes %.0f layers of %d for %lld cells; allowed: at most %.0f, so at most %.3g "
             "cells",
             path, count, own, (long long)cells, key->most, (double)cells * pow(key->most / (own * ratio), 3));
  const double share = own / count;
  CwWallGroup *const groups[] = {&walls->blade, &walls->hub_shroud, &walls->volute, &walls->pipe};
  for (size_t i = 0; i < sizeof groups / sizeof *groups; ++i) refine(groups[i], walls->growth_ratio, share);
  walls->growth_ratio = pow(walls->growth_ratio, share);
  walls->layer_count = (int)count;
done:
  return status;
}
