// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/plan/plan_make.h"

#include "mesher/plan/plan_divide.h"

CwStatus cw_plan_make(const CwContext *context, const CwCad *cad, const CwBackground *background,
                      const CwVerticals *inside, const CwSize *size, const CwPlanOptions *options, CwPlan *plan) {
  CwStatus status = CW_OK;
  CwPlanModel model = {0};
  CwPlanPart whole = {0};
  CW_TRY(cw_plan_new((size_t)options->region_count, plan));
  CW_TRY(cw_plan_model_make(context, cad, background, inside, size, options, &model));
  CW_TRY(cw_plan_part_whole(&model, &whole));
  model.mean_work = whole.work / options->region_count;
  CW_TRY(cw_plan_divide(&model, plan, &whole, options->region_count, -1, 0));
done:
  cw_plan_part_free(&whole);
  cw_plan_model_free(&model);
  if (status != CW_OK) cw_plan_free(plan);
  return status;
}
