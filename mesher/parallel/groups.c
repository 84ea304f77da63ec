// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/groups.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
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
  cw_team_broadcast(hand->team, data, size, hand->from);
}

// Account and results of an item to the ranks that were on others.
static CwStatus hand_over(const CwContext *context, const CwGroupWork *work, const CwGroupHand *hand,
                          const CwOutcome *outcome) {
  CwStatus status = CW_OK;
  char *account = NULL; // that of the rank that gives, also on others of its group
  int64_t size = 0;
  int gives = cw_team_rank(hand->team) == hand->from;
  if (gives) CW_TRY(cw_profiler_pack(context, hand->item, &account, &size));
  cw_group_give(hand, &size, sizeof size);
  if (!gives) CW_NEW_UNSET(account, size);
  cw_group_give(hand, account, size);
  if (!hand->mine) CW_TRY(cw_profiler_take(context, hand->item, account, size));
  if (outcome->kind == CW_OUTCOME_DONE) CW_TRY(work->hand(work->given, hand));
done:
  free(account);
  return status;
}

// Rank 0 prints the lines that the first rank of a group has kept.
static CwStatus print_kept(CwLog *log, const CwTeam *team, int from) {
  CwStatus status = CW_OK;
  int64_t size = (int64_t)strlen(cw_log_kept(log)) + 1;
  char *lines = NULL;
  cw_team_broadcast(team, &size, sizeof size, from);
  CW_NEW_UNSET(lines, size);
  if (cw_team_rank(team) == from) memcpy(lines, cw_log_kept(log), (size_t)size);
  if (size > 1) cw_team_broadcast(team, lines, size, from);
  for (char *line = lines, *end; cw_team_rank(team) == 0 && size > 1 && (end = strchr(line, '\n')); line = end + 1) {
    cw_log_debug(log, "%.*s", (int)(end - line), line);
  }
done:
  free(lines);
  return status;
}

CwStatus cw_groups_run(const CwContext *context, const CwGroupWork *work, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwTeam *all = cw_team_of(context);
  CwLog *log = cw_log_of(context);
  CwTeam *own = NULL;
  int group_of[CW_GROUPS_MOST], ranks_of[CW_GROUPS_MOST], first[CW_GROUPS_MOST] = {0}, owner[CW_GROUPS_MOST], mine = 0;
  CW_REQUIRE(work->count <= CW_GROUPS_MOST, CW_ERR_INPUT, "%d items; at most %d are allowed", work->count,
             CW_GROUPS_MOST);
  memset(outcome, 0, (size_t)work->count * sizeof *outcome);
  CW_TRY(cw_profiler_groups(context, work->step, work->count, work->cost, work->own));
  int groups = cw_groups_divide(work->count, work->cost, work->own, all->ranks, group_of, ranks_of);
  for (int g = 1; g < groups; g++) {
    first[g] = first[g - 1] + ranks_of[g - 1];
    if (all->rank >= first[g]) mine = g;
  }
  if (groups > 1) CW_TRY(cw_team_split(all, mine, &own));
  CwContext group = context ? *context : (CwContext){0};
  group.team = own ? own : all;
  cw_log_keep(log, all->rank == first[mine]);
  for (int32_t s = 0; s < work->count; s++) {
    owner[s] = first[group_of[s]];
    if (group_of[s] != mine) continue;
    cw_profiler_item(context, s);
    CW_TRY(work->run(work->given, &group, s, &outcome[s]));
    cw_profiler_item(context, -1);
  }
  cw_log_keep(log, 0);
  if (own) cw_team_join(all, &own);
  const char *part = cw_profiler_part(context, "exchange");
  if (groups > 1) cw_outcomes_agree(all, work->count, outcome, owner);
  for (int32_t s = 0; s < work->count && groups > 1; s++) {
    CwGroupHand hand = {.team = all, .item = s, .mine = group_of[s] == mine, .from = owner[s]};
    CW_TRY(hand_over(context, work, &hand, &outcome[s]));
  }
  for (int g = 1; g < groups; g++) CW_TRY(print_kept(log, all, first[g]));
  cw_log_drop_kept(log);
  cw_profiler_part(context, part);
done:
  return status;
}
