// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/groups.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/host_memory.h"
#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "mesher/parallel/team.h"
#include "pipeline/log.h"

enum { TOGETHER = 2 }; // ranks of a group at least, where all of them work

typedef struct {
  int groups, group_of[CW_GROUPS_MOST], ranks_of[CW_GROUPS_MOST];
  double seconds; // of the longest group
} Grouping;

// Largest items first, each to the group that has least; then rank by rank to the group that would take longest.
static Grouping group(int32_t count, const double *cost, double own, int ranks, int groups, int least_ranks) {
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
  for (int g = 0; g < groups; g++) made.ranks_of[g] = least_ranks;
  if (groups == 1) made.ranks_of[0] = ranks;
  for (int left = ranks - least_ranks * groups; groups > 1 && left > 0; left--) {
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

int cw_groups_divide(int32_t count, const double *cost, double own, int ranks, int least, int *group_of,
                     int *ranks_of) {
  Grouping best = group(count, cost, own, ranks, 1, least);
  for (int groups = 2; groups <= count && least * groups <= ranks; groups++) {
    Grouping other = group(count, cost, own, ranks, groups, least);
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
  if (outcome->kind == CW_OUTCOME_DONE || outcome->kind == CW_OUTCOME_THIN) CW_TRY(work->hand(work->given, hand));
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

// The groups of a step: ranks that follow one another.
typedef struct {
  int count, of_item[CW_GROUPS_MOST], first[CW_GROUPS_MOST], ranks[CW_GROUPS_MOST];
  int mine;  // this rank's
  int works; // this rank does
} Groups;

static int in_group(const Groups *groups, int g, int rank) {
  return rank >= groups->first[g] && rank < groups->first[g] + groups->ranks[g];
}

// The first rank of a group on the host whose first rank is `host`; -1: none.
static int maker_on(const CwTeam *all, const Groups *groups, int g, int host) {
  for (int rank = groups->first[g]; in_group(groups, g, rank); rank++) {
    if (all->host_of[rank] == host) return rank;
  }
  return -1;
}

static int least_ranks(const CwGroupWork *work) {
  return work->by_threads ? 1 : TOGETHER;
}

static Groups find_groups(const CwTeam *all, const CwGroupWork *work) {
  Groups groups = {.works = 1};
  groups.count =
      cw_groups_divide(work->count, work->cost, work->own, all->ranks, least_ranks(work), groups.of_item, groups.ranks);
  for (int g = 1; g < groups.count; g++) {
    groups.first[g] = groups.first[g - 1] + groups.ranks[g - 1];
    if (all->rank >= groups.first[g]) groups.mine = g;
  }
  if (work->by_threads && all->ranks > 1)
    groups.works = maker_on(all, &groups, groups.mine, all->host_of[all->rank]) == all->rank;
  return groups;
}

// Threads of this rank for all of its group on its host, on the cores that these have; work comes to each host by its
// threads.
static CwStatus start_threads(const CwTeam *all, CwLog *log, const Groups *groups, CwTeam *own) {
  CwStatus status = CW_OK;
  cpu_set_t cores;
  int g = groups->mine, count = 0, makers = 0;
  int *maker_number = NULL; // by the first rank of a host: of the group's maker there, from 1; 0: none yet
  CPU_ZERO(&cores);
  CW_NEW(maker_number, all->ranks);
  CW_NEW(own->slot_rank, groups->ranks[g]);
  for (int rank = groups->first[g]; in_group(groups, g, rank); rank++) {
    int host = all->host_of[rank];
    if (!maker_number[host]) maker_number[host] = ++makers;
    own->slot_rank[own->slots++] = maker_number[host] - 1;
    if (host != all->host_of[all->rank]) continue;
    CPU_OR(&cores, &cores, &all->cores[rank]);
    count++;
  }
  if (count > 1) {
    CW_TRY(cw_threads_make(count, CPU_COUNT(&cores) ? &cores : NULL, &own->pool));
    int made = cw_threads_count(own->pool);
    if (made < count)
      cw_log_warn(
          log,
          "%d of %d threads can be started; the work on walls takes longer; raise the limit of processes (ulimit -u)",
          made, count);
  }
done:
  free(maker_number);
  return status;
}

// This rank's team for the step. [out] own: NULL: all ranks.
static CwStatus go_apart(const CwTeam *all, CwLog *log, const CwGroupWork *work, const Groups *groups, CwTeam **own) {
  CwStatus status = CW_OK;
  if (all->ranks == 1 || (groups->count == 1 && !work->by_threads)) goto done;
  CW_TRY(cw_team_split(all, groups->works ? groups->mine : groups->count, own));
  if (work->by_threads && groups->works) CW_TRY(start_threads(all, log, groups, *own));
done:
  return status;
}

// How many ranks of a rank's host come before it: its number among them.
static int before_on_host(const CwTeam *all, int rank) {
  int before = 0;
  for (int other = 0; other < rank; other++) before += all->host_of[other] == all->host_of[rank];
  return before;
}

static CwGroupHand hand_of(const CwTeam *all, const CwGroupWork *work, const Groups *groups, int32_t item) {
  int g = groups->of_item[item];
  CwGroupHand hand = {.team = all,
                      .item = item,
                      .mine = g == groups->mine && groups->works,
                      .from = groups->first[g],
                      .maker = -1,
                      .everywhere = 1};
  if (!work->by_threads) return hand;
  int maker = maker_on(all, groups, g, all->host_of[all->rank]);
  if (maker >= 0) hand.maker = before_on_host(all, maker);
  for (int rank = 0; rank < all->ranks; rank++) {
    if (all->host_of[rank] == rank && maker_on(all, groups, g, rank) < 0) hand.everywhere = 0;
  }
  return hand;
}

CwStatus cw_groups_run(const CwContext *context, const CwGroupWork *work, CwOutcome *outcome) {
  CwStatus status = CW_OK;
  const CwTeam *all = cw_team_of(context);
  CwLog *log = cw_log_of(context);
  CwTeam *own = NULL;
  int owner[CW_GROUPS_MOST];
  CW_REQUIRE(work->count <= CW_GROUPS_MOST, CW_ERR_INPUT, "%d items; at most %d are allowed", work->count,
             CW_GROUPS_MOST);
  memset(outcome, 0, (size_t)work->count * sizeof *outcome);
  CW_TRY(cw_profiler_groups(context, work->step, work->count, work->cost, work->own, least_ranks(work)));
  const Groups groups = find_groups(all, work);
  CW_TRY(go_apart(all, log, work, &groups, &own));
  CwContext group = context ? *context : (CwContext){0};
  group.team = own ? own : all;
  cw_log_keep(log, all->rank == groups.first[groups.mine]);
  for (int32_t s = 0; s < work->count; s++) {
    owner[s] = groups.first[groups.of_item[s]];
    if (groups.of_item[s] != groups.mine || !groups.works) continue;
    cw_profiler_item(context, s);
    CW_TRY(work->run(work->given, &group, s, &outcome[s]));
    cw_profiler_item(context, -1);
  }
  cw_log_keep(log, 0);
  const char *part = cw_profiler_part(context, "exchange");
  int apart = own != NULL;
  if (own) cw_team_join(all, &own);
  if (apart) cw_outcomes_agree(all, work->count, outcome, owner);
  for (int32_t s = 0; s < work->count && apart; s++) {
    CwGroupHand hand = hand_of(all, work, &groups, s);
    CW_TRY(hand_over(context, work, &hand, &outcome[s]));
  }
  for (int g = 1; g < groups.count; g++) CW_TRY(print_kept(log, all, groups.first[g]));
  cw_log_drop_kept(log);
  cw_profiler_part(context, part);
done:
  return status;
}

// An array on its way: those behind pointers come to each rank at once, the others into memory of the host.
typedef struct {
  const CwGroupHand *hand;
  char *at;     // of this rank, where this host has them; NULL: to be counted
  int64_t size; // of those counted or placed
  CwStatus status;
} Holding;

static int64_t room(int64_t size) {
  return (size + 63) / 64 * 64;
}

static void give_pointers(Holding *holding, void **array, int64_t size) {
  const CwGroupHand *hand = holding->hand;
  void *copy = malloc(size > 0 ? (size_t)size : 1);
  if (!copy) {
    holding->status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %lld bytes", (long long)size);
    return;
  }
  if (cw_team_rank(hand->team) == hand->from) memcpy(copy, *array, (size_t)size);
  cw_group_give(hand, copy, size);
  if (hand->mine)
    free(copy);
  else
    *array = copy;
}

static void count_array(void *given, void **array, int64_t size, int pointers) {
  Holding *holding = given;
  if (!*array || holding->status != CW_OK) return;
  if (pointers)
    give_pointers(holding, array, size);
  else
    holding->size += room(size);
}

static void place_array(void *given, void **array, int64_t size, int pointers) {
  Holding *holding = given;
  if (pointers || !*array) return;
  char *place = holding->at + holding->size;
  holding->size += room(size);
  if (holding->hand->mine) {
    memcpy(place, *array, (size_t)size);
    free(*array);
  }
  *array = place;
}

CwStatus cw_group_hold(const CwGroupHand *hand, void *product, int64_t size, CwArrays arrays, CwHostMemory **memory) {
  CwStatus status = CW_OK;
  const CwTeam *all = hand->team;
  Holding holding = {.hand = hand};
  CwHostMemory *held = NULL;
  void *numbers = NULL;
  if (all->ranks == 1) goto done;
  CW_NEW_UNSET(numbers, size);
  if (all->rank == hand->from) memcpy(numbers, product, (size_t)size);
  cw_group_give(hand, numbers, size);
  if (!hand->mine) memcpy(product, numbers, (size_t)size); // pointers that are NULL are so everywhere
  *memory = NULL;
  arrays(product, count_array, &holding);
  CW_TRY(holding.status);
  int64_t bytes = holding.size;
  CW_TRY(cw_host_memory_make(all->host, bytes, &held));
  holding.at = cw_host_memory_at(held);
  holding.size = 0;
  arrays(product, place_array, &holding);
  if (hand->maker >= 0) cw_host_memory_spread(all->host, held, 0, bytes, hand->maker);
  if (!hand->everywhere) {
    int root = 0; // the host of the rank that gives, among the first ranks of all
    for (int rank = 0; rank < all->host_of[hand->from]; rank++) root += all->host_of[rank] == rank;
    if (all->firsts) cw_team_broadcast(all->firsts, holding.at, bytes, root);
    cw_host_memory_spread(all->host, held, 0, bytes, 0);
  }
  cw_host_memory_seal(held);
  *memory = held;
  held = NULL;
done:
  cw_host_memory_free(&held);
  free(numbers);
  return status;
}
