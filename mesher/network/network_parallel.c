// SPDX-License-Identifier: AGPL-3.0-or-later
// The traces of all planes, one plane a task: each is traced into a network of its own, which travels packed and is
// joined to the whole in the order of the planes.
#include <stdlib.h>
#include <string.h>

#include "mesher/network/network.h"
#include "mesher/parallel/schedule.h"

enum { DOUBLES = 5 }; // of a fine point: place, two parameters

// Corners, curves and then the arrays of each curve follow it, aligned as numbers need it.
typedef struct {
  CwOutcome outcome;
  _Alignas(double) int32_t corners, curves;
} Head;

typedef struct {
  const CwNetwork *network;
  const CwBackground *background;
} Traces;

static CwStatus pack(const CwNetwork *network, const CwOutcome *outcome, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  Head head = {.outcome = *outcome, .corners = network->corner_count, .curves = network->curve_count};
  size_t corners = (size_t)head.corners * sizeof *network->corner;
  size_t curves = (size_t)head.curves * sizeof *network->curve, points = 0;
  char *block;
  for (int32_t i = 0; i < head.curves; i++) points += (size_t)network->curve[i].fine_count;
  size_t all = sizeof head + corners + curves + points * DOUBLES * sizeof(double);
  CW_NEW(block, all);
  memcpy(block, &head, sizeof head);
  if (corners) memcpy(block + sizeof head, network->corner, corners);
  if (curves) memcpy(block + sizeof head + corners, network->curve, curves);
  char *at = block + sizeof head + corners + curves;
  for (int32_t i = 0; i < head.curves; i++) {
    const CwCurve *curve = &network->curve[i];
    size_t count = (size_t)curve->fine_count;
    memcpy(at, curve->fine_x, count * sizeof *curve->fine_x);
    at += count * sizeof *curve->fine_x;
    memcpy(at, curve->fine_parameter, count * sizeof *curve->fine_parameter);
    at += count * sizeof *curve->fine_parameter;
  }
  *bytes = block;
  *size = (int64_t)all;
done:
  return status;
}

static CwStatus trace_plane(void *context, int32_t node, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Traces *traces = context;
  CwNetwork made = {.cad = traces->network->cad, .plan = traces->network->plan};
  CwOutcome outcome = {0};
  CW_TRY(cw_network_trace(&made, traces->background, node, &outcome));
  CW_TRY(pack(&made, &outcome, bytes, size));
done:
  cw_network_free(&made);
  return status;
}

// Adds a packed curve, whose arrays begin at `at` and whose corners have the numbers `corner` in the whole network.
static CwStatus join_curve(CwNetwork *network, const CwCurve *packed, const int32_t *corner, const char *at) {
  CwStatus status = CW_OK;
  CwCurve curve = *packed;
  size_t count = (size_t)curve.fine_count;
  for (int k = 0; k < 2; k++) curve.corner[k] = corner[packed->corner[k]];
  CW_TRY(cw_curve_fine_make(packed->fine_count, &curve)); // the packed addresses mean nothing here
  memcpy(curve.fine_x, at, count * sizeof *curve.fine_x);
  at += count * sizeof *curve.fine_x;
  memcpy(curve.fine_parameter, at, count * sizeof *curve.fine_parameter);
  CW_TRY(cw_network_add_curve(network, &curve));
done:
  return status;
}

static CwStatus join(CwNetwork *network, const void *bytes, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  Head head;
  int32_t *corner = NULL;
  memcpy(&head, bytes, sizeof head);
  head.outcome.domain = outcome->domain; // which the trace does not know
  *outcome = head.outcome;
  if (outcome->kind != CW_OUTCOME_DONE) goto done;
  const CwCorner *corners = (const CwCorner *)((const char *)bytes + sizeof head);
  const CwCurve *curves = (const CwCurve *)(corners + head.corners);
  const char *at = (const char *)(curves + head.curves);
  CW_NEW(corner, head.corners);
  for (int32_t i = 0; i < head.corners; i++) {
    CW_TRY(cw_network_corner(network, &corners[i], cw_same_corner, &corner[i]));
  }
  for (int32_t i = 0; i < head.curves; i++) {
    CW_TRY(join_curve(network, &curves[i], corner, at));
    at += (size_t)curves[i].fine_count * DOUBLES * sizeof(double);
  }
done:
  free(corner);
  return status;
}

CwStatus cw_network_trace_all(const CwContext *context, CwNetwork *network, const CwBackground *background,
                              CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int32_t nodes = network->plan->node_count;
  Traces traces = {network, background};
  CwTaskResults results = {0};
  CwSchedule schedule = {.step = "traces of the planes", .count = nodes, .run = trace_plane, .context = &traces};
  CW_TRY(cw_schedule_gather(context, &schedule, &results));
  for (int32_t node = 0; node < nodes; node++) CW_TRY_STAGE(join(network, results.bytes[node], outcome), outcome);
done:
  cw_task_results_free(&results);
  return status;
}
