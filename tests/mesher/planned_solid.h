// SPDX-License-Identifier: AGPL-3.0-or-later
// A small solid as the planner sees it: three regions to be, edges of about 2 mm and layers of 1 mm, as a rule, on all
// its faces.
#pragma once

#include <vector>

extern "C" {
#include "mesher/cad/background_make.h"
#include "mesher/plan/plan_model.h"
}

#include "solids.h"

static inline double thickness_of(const void *thickness, int32_t, const double[3], const double[3]) {
  return *static_cast<const double *>(thickness);
}

struct PlannedSolid {
  CwCad *cad;
  CwBackground background;
  CwVerticals *inside = nullptr;
  CwSize *size = nullptr;
  CwPlanModel model;
  CwPlanPart whole;

  explicit PlannedSolid(const TopoDS_Shape &shape, double thickness = 1e-3,
                        decltype(CwPlanOptions::thickness) thickness_at = thickness_of)
      : cad(open_solid(shape)) {
    CwMeshTable table = {};
    const double relative = 1;
    int64_t bytes;
    void *block = nullptr;
    table.gradation = 0.2;
    table.curvature_angle = 0.3;
    table.cells_across_gap = 1;
    check(cw_background_make(cad, 1e-4, 0.2, &background));
    check(cw_verticals_make(background.x, background.triangle_count, background.triangle, &inside));
    CwSizeSeeds *seeds = nullptr;
    std::vector<void *> seed(cw_size_seed_parts(cad));
    check(cw_size_seeds_start(cad, &background, &table, &relative, 2e-3, &seeds));
    for (size_t i = 0; i < seed.size(); i++) check(cw_size_seeds_part(seeds, (int)i, &seed[i], &bytes));
    cw_size_seeds_free(&seeds);
    check(cw_size_make(cad, &background, &table, &relative, 2e-3, nullptr, seed.data(), CW_SIZE_SEEDS, &block, &bytes));
    check(cw_size_unpack(&block, &size));
    for (void *one : seed) free(one);
    CwPlanOptions options = {3, thickness_at, &thickness, 2e-3, 12};
    check(cw_plan_model_make(NULL, cad, &background, inside, size, &options, &model));
    check(cw_plan_part_whole(&model, &whole));
    model.mean_work = whole.work / 3;
  }
  ~PlannedSolid() {
    cw_plan_part_free(&whole);
    cw_plan_model_free(&model);
    cw_size_free(&size);
    cw_verticals_free(&inside);
    cw_background_free(&background);
    cw_cad_close(&cad);
  }
};
