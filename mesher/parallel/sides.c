// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/sides.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/ledger.h"
#include "mesher/parallel/schedule.h"
#include "pipeline/log.h"

enum { LEAST_RANKS = 2, MESSAGE_SIZE = 1024 };

typedef struct {
  int groups, group_of[CW_SIDES_MOST], ranks_of[CW_SIDES_MOST];
  double seconds; // of the longest group
} Grouping;

// Largest sides first, each to the group that has least; then rank by rank to the group that would take longest.
static Grouping group(int32_t count, const double *cost, double own, int ranks, int groups) {
  Grouping made = {.groups = groups};
  double all[CW_SIDES_MOST] = {0};
  int placed[CW_SIDES_MOST] = {0};
  for (int32_t i = 0; i < count; i++) {
    int32_t largest = -1;
    int least = 0;
    for (int32_t s = 0; s < count; s++) {
      if (!placed[s] && (largest < 0 || cost[s] > cost[largest])) largest = s;
    }
    for (int g = 1; g < groups; g++) {
      if (all[g] < all[least]) least = g;
    }
    placed[largest] = 1;
    made.group_of[largest] = least;
    all[least] += cost[largest];
  }
  for (int g = 0; g < groups; g++) made.ranks_of[g] = LEAST_RANKS;
  if (groups == 1) made.ranks_of[0] = ranks;
  for (int left = ranks - LEAST_RANKS * groups; groups > 1 && left > 0; left--) {
    int longest = 0;
    for (int g = 1; g < groups; g++) {
      if (all[g] / made.ranks_of[g] > all[longest] / made.ranks_of[longest]) longest = g;
    }
    made.ranks_of[longest]++;
  }
  for (int g = 0; g < groups; g++) {
    double seconds = all[g] * (own + (1 - own) / made.ranks_of[g]);
    if (seconds > made.seconds) made.seconds = seconds;
  }
  return made;
}

int cw_sides_group(int32_t count, const double *cost, double own, int ranks, int *group_of, int *ranks_of) {
  Grouping best = group(count, cost, own, ranks, 1);
  for (int groups = 2; groups <= count && LEAST_RANKS * groups <= ranks; groups++) {
    Grouping other = group(count, cost, own, ranks, groups);
    if (other.seconds < best.seconds) best = other;
  }
  memcpy(group_of, best.group_of, (size_t)count * sizeof *group_of);
  memcpy(ranks_of, best.ranks_of, (size_t)best.groups * sizeof *ranks_of);
  return best.groups;
}

void cw_side_give(const CwSideHand *hand, void *data, int64_t size) {
  cw_mpi_broadcast(data, size, hand->from);
}

// How it went on a side.
typedef struct {
  CwStatus outcome;
  char message[MESSAGE_SIZE];
  int64_t account_size;
} Told;

static CwStatus run_side(const CwSides *sides, int32_t side, Told *told) {
  CwStatus status = CW_OK;
  cw_fail_clear();
  cw_ledger_side(side);
  told->outcome = sides->run(sides->context, side);
  cw_ledger_side(-1);
  snprintf(told->message, sizeof told->message, "%s", cw_fail_message());
  if (told->outcome != CW_RETRY) CW_TRY(told->outcome);
done:
  return status;
}

// Outcome, account and results of a side to the ranks that were on others.
static CwStatus hand_over(const CwSides *sides, const CwSideHand *hand, Told *told) {
  CwStatus status = CW_OK;
  char *account = NULL; // that of the rank that gives, also on others of its group
  int gives = cw_mpi_rank() == hand->from;
  if (gives) CW_TRY(cw_ledger_pack_side(hand->side, &account, &told->account_size));
  cw_side_give(hand, told, sizeof *told);
  if (!gives) CW_NEW_UNSET(account, told->account_size);
  cw_side_give(hand, account, told->account_size);
  if (!hand->mine) CW_TRY(cw_ledger_take_side(hand->side, account, told->account_size));
  if (told->outcome == CW_OK) CW_TRY(sides->hand(sides->context, hand));
done:
  free(account);
  return status;
}

// Rank 0 prints the lines that the first rank of a group has kept.
static CwStatus print_kept(int from) {
  CwStatus status = CW_OK;
  int64_t size = (int64_t)strlen(cw_log_kept()) + 1;
  char *lines = NULL;
  cw_mpi_broadcast(&size, sizeof size, from);
  CW_NEW_UNSET(lines, size);
  if (cw_mpi_rank() == from) memcpy(lines, cw_log_kept(), (size_t)size);
  if (size > 1) cw_mpi_broadcast(lines, size, from);
  for (char *line = lines, *end; cw_mpi_rank() == 0 && size > 1 && (end = strchr(line, '\n')); line = end + 1) {
    cw_log_debug("%.*s", (int)(end - line), line);
  }
done:
  free(lines);
  return status;
}

CwStatus cw_sides_run(const CwSides *sides, CwStatus *outcome) {
  CwStatus status = CW_OK;
  Told *told = NULL;
  int group_of[CW_SIDES_MOST], ranks_of[CW_SIDES_MOST], first[CW_SIDES_MOST] = {0}, mine = 0;
  CW_REQUIRE(sides->count <= CW_SIDES_MOST, CW_ERR_INPUT, "%d sides; at most %d are allowed", sides->count,
             CW_SIDES_MOST);
  CW_NEW(told, sides->count);
  CW_TRY(cw_ledger_sides(sides->step, sides->count, sides->cost, sides->own));
  int groups = cw_sides_group(sides->count, sides->cost, sides->own, cw_mpi_ranks(), group_of, ranks_of);
  for (int g = 1; g < groups; g++) {
    first[g] = first[g - 1] + ranks_of[g - 1];
    if (cw_mpi_rank() >= first[g]) mine = g;
  }
  if (groups > 1) cw_mpi_split(mine);
  cw_log_keep(cw_mpi_rank() == first[mine]);
  for (int32_t s = 0; s < sides->count; s++) {
    if (group_of[s] == mine) CW_TRY(run_side(sides, s, &told[s]));
  }
  cw_log_keep(0);
  if (groups > 1) cw_mpi_join();
  const char *part = cw_ledger_part("exchange");
  for (int32_t s = 0; s < sides->count && groups > 1; s++) {
    CwSideHand hand = {.side = s, .mine = group_of[s] == mine, .from = first[group_of[s]]};
    CW_TRY(hand_over(sides, &hand, &told[s]));
  }
  for (int g = 1; g < groups; g++) CW_TRY(print_kept(first[g]));
  cw_log_drop_kept();
  cw_ledger_part(part);
  cw_fail_clear();
  for (int32_t s = sides->count - 1; s >= 0; s--) {
    outcome[s] = told[s].outcome;
    if (outcome[s] != CW_OK && told[s].message[0]) CW_FAIL(outcome[s], "%s", told[s].message);
  }
done:
  free(told);
  return status;
}
