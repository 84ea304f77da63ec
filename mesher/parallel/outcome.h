// SPDX-License-Identifier: AGPL-3.0-or-later
// How a stage of the mesher ends where no error stops it: done, or with what has to change before it is tried again.
// A function with an outcome returns CW_OK whatever the outcome is; its products are whole only where that is
// CW_OUTCOME_DONE, which it is handed as. What cannot be meshed at all is an error proper (CwStatus).
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  CW_OUTCOME_DONE,
  CW_OUTCOME_REPLAN,     // the partition planes do not fit the domain: others may
  CW_OUTCOME_ASYMMETRIC, // its passages do not come out alike: it may be meshed whole
  CW_OUTCOME_FINER,      // edges cross, miss what they bound, or fold the wall: shorter ones may not
  CW_OUTCOME_PINCH,      // no layers stand where edges are so long: shorter ones may, or they taper
  CW_OUTCOME_THIN        // the layers leave no room: thinner ones may
} CwOutcomeKind;

enum { CW_REASON_SIZE = 600 };   // the failure of a region, its place and the path of its boundary
enum { CW_OUTCOME_PLACES = 16 }; // that are told at once

// Plain data: it travels between ranks as bytes. Zeroed: done.
typedef struct {
  CwOutcomeKind kind;
  int32_t domain;                     // that it is about, set by who knows the domains
  int32_t places;                     // at which the reason holds, the first of which is told to people
  double place[CW_OUTCOME_PLACES][3]; // in the unit of lengths
  char reason[CW_REASON_SIZE];
} CwOutcome;

// Sets kind, place (in the unit of lengths; NULL: none) and reason (printf style); the domain stays.
void cw_outcome_set(CwOutcome *outcome, CwOutcomeKind kind, const double place[3], const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// Adds a place where the same holds, unless one within `apart` of it is there, or there are as many as can be.
void cw_outcome_add_place(CwOutcome *outcome, const double x[3], double apart);

// "REASON at (x, y, z) mm", for a person. millimetres: of the unit of lengths.
enum { CW_OUTCOME_TEXT_SIZE = CW_REASON_SIZE + 80 };
const char *cw_outcome_text(const CwOutcome *outcome, double millimetres, char text[CW_OUTCOME_TEXT_SIZE]);

// The ranks agree on `count` outcomes, each known to the rank `owner[i]`. Collective over the team.
void cw_outcomes_agree(const CwTeam *team, int32_t count, CwOutcome *outcome, const int *owner);

// The first of `count` outcomes that is not done, with its number as domain; done where all are.
CwOutcome cw_outcomes_first(int32_t count, const CwOutcome *outcome);

// Calls; on an error, or an outcome that is not done, goes to `done`.
#define CW_TRY_STAGE(call, outcome)                                                                                    \
  do {                                                                                                                 \
    CW_TRY(call);                                                                                                      \
    if ((outcome)->kind != CW_OUTCOME_DONE) goto done;                                                                 \
  } while (0)

// Ends the function with an outcome unless `condition` holds; then the arguments of cw_outcome_set.
#define CW_END_UNLESS(condition, outcome, ...)                                                                         \
  do {                                                                                                                 \
    if (!(condition)) {                                                                                                \
      cw_outcome_set((outcome), __VA_ARGS__);                                                                          \
      goto done;                                                                                                       \
    }                                                                                                                  \
  } while (0)

#ifdef __cplusplus
}
#endif
