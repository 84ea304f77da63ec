// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/outcome.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "mesher/parallel/ranks.h"

void cw_outcome_set(CwOutcome *outcome, CwOutcomeKind kind, const double place[3], const char *format, ...) {
  va_list arguments;
  outcome->kind = kind;
  outcome->places = 0;
  memset(outcome->place, 0, sizeof outcome->place);
  if (place) cw_outcome_add_place(outcome, place, 0);
  va_start(arguments, format);
  vsnprintf(outcome->reason, sizeof outcome->reason, format, arguments);
  va_end(arguments);
}

void cw_outcome_add_place(CwOutcome *outcome, const double x[3], double apart) {
  if (outcome->places == CW_OUTCOME_PLACES) return;
  for (int32_t i = 0; i < outcome->places; i++) {
    const double *y = outcome->place[i];
    if (hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]) < apart) return;
  }
  memcpy(outcome->place[outcome->places++], x, sizeof *outcome->place);
}

const char *cw_outcome_text(const CwOutcome *outcome, double millimetres, char text[CW_OUTCOME_TEXT_SIZE]) {
  const double *x = outcome->place[0];
  int used = snprintf(text, CW_OUTCOME_TEXT_SIZE, "%s", outcome->reason);
  if (outcome->places > 0) {
    snprintf(text + used, (size_t)(CW_OUTCOME_TEXT_SIZE - used), " at (%.3f, %.3f, %.3f) mm", millimetres * x[0],
             millimetres * x[1], millimetres * x[2]);
  }
  return text;
}

void cw_outcomes_agree(const CwTeam *team, int32_t count, CwOutcome *outcome, const int *owner) {
  for (int32_t i = 0; i < count; i++) cw_team_broadcast(team, &outcome[i], sizeof outcome[i], owner[i]);
}

CwOutcome cw_outcomes_first(int32_t count, const CwOutcome *outcome) {
  CwOutcome first = {0};
  for (int32_t i = count - 1; i >= 0; i--) {
    if (outcome[i].kind == CW_OUTCOME_DONE) continue;
    first = outcome[i];
    first.domain = i;
  }
  return first;
}
