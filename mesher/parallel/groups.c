// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/groups.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "pipeline/log.h"

enum { LEAST_RANKS = 2 };

typedef struct {
  int groups, group_of[CW_GROUPS_MOST], ranks_of[CW_GROUPS_MOST];
  double seconds; // of the longest group
} Grouping;

// Largest items first, each to the group that has least; then rank by rank to the group that would take longest.
static Grouping group(int32_t count, const double *cost, double own, int ranks, int groups) {
  Grouping made = {.groups = groups};
  double all[CW_GROUPS_MOST] = {0};
  int placed[CW_GROUPS_MOST] = {0};
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

int cw_groups_divide(int32_t count, const double *cost, double own, int ranks, int *group_of, int *ranks_of) {
  Grouping best = group(count, cost, own, ranks, 1);
  for (int groups = 2; groups <= count && LEAST_RANKS * groups <= ranks; groups++) {
    Grouping other = group(count, cost, own, ranks, groups);
    if (other.seconds < best.seconds) best = other;
  }
  memcpy(group_of, best.group_of, (size_t)count * sizeof *group_of);
  memcpy(ranks_of, best.ranks_of, (size_t)best.groups * sizeof *ranks_of);
  return best.groups;
}

void cw_group_give(const CwGroupHand *hand, void *data, int64_t size) {
  cw_mpi_broadcast(data, size, hand->from);
}

// Account and results of an item to the ranks that were on others.
static CwStatus hand_over(const CwGroupWork *work, const CwGroupHand *hand, const CwOutcome *outcome) {
  CwStatus status = CW_OK;
  char *account = NULL; // that of the rank that gives, also on others of its group
  int64_t size = 0;
  int gives = cw_mpi_rank() == hand->from;
  if (gives) CW_TRY(cw_profiler_pack(hand->item, &account, &size));
  cw_group_give(hand, &size, sizeof size);
  if (!gives) CW_NEW_UNSET(account, size);
  cw_group_give(hand, account, size);
  if (!hand->mine) CW_TRY(cw_profiler_take(hand->item, account, size));
  if (outcome->kind == CW_OUTCOME_DONE) CW_TRY(work->hand(work->context, hand));
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

CwStatus cw_groups_run(const CwGroupWork *work, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  int group_of[CW_GROUPS_MOST], ranks_of[CW_GROUPS_MOST], first[CW_GROUPS_MOST] = {0}, owner[CW_GROUPS_MOST], mine = 0;
  CW_REQUIRE(work->count <= CW_GROUPS_MOST, CW_ERR_INPUT, "%d items; at most %d are allowed", work->count,
             CW_GROUPS_MOST);
  memset(outcome, 0, (size_t)work->count * sizeof *outcome);
  CW_TRY(cw_profiler_groups(work->step, work->count, work->cost, work->own));
  int groups = cw_groups_divide(work->count, work->cost, work->own, cw_mpi_ranks(), group_of, ranks_of);
  for (int g = 1; g < groups; g++) {
    first[g] = first[g - 1] + ranks_of[g - 1];
    if (cw_mpi_rank() >= first[g]) mine = g;
  }
  if (groups > 1) cw_mpi_split(mine);
  cw_log_keep(cw_mpi_rank() == first[mine]);
  for (int32_t s = 0; s < work->count; s++) {
    owner[s] = first[group_of[s]];
    if (group_of[s] != mine) continue;
    cw_profiler_item(s);
    CW_TRY(work->run(work->context, s, &outcome[s]));
    cw_profiler_item(-1);
  }
  cw_log_keep(0);
  if (groups > 1) cw_mpi_join();
  const char *part = cw_profiler_part("exchange");
  if (groups > 1) cw_outcomes_agree(work->count, outcome, owner);
  for (int32_t s = 0; s < work->count && groups > 1; s++) {
    CwGroupHand hand = {.item = s, .mine = group_of[s] == mine, .from = owner[s]};
    CW_TRY(hand_over(work, &hand, &outcome[s]));
  }
  for (int g = 1; g < groups; g++) CW_TRY(print_kept(first[g]));
  cw_log_drop_kept();
  cw_profiler_part(part);
done:
  return status;
}
