// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/parallel_for.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/parallel/ranks.h"
#include "mesher/parallel/schedule.h"
#include "mesher/parallel/team.h"

// Blocks enough for dozens of ranks to end together, none so small that to take it is as much work as to do it.
enum { BLOCKS = 256, LEAST_BLOCK = 64, MOST_BLOCK = 4096 };

typedef struct {
  CwParallelBody body;
  void *given;
  int32_t count;
  const int32_t *start; // of each item's list; NULL: one each
  size_t width;
  int32_t block; // items of one
  char *out;     // of all items, where this rank does all; else NULL
} Share;

static int32_t block_of(int32_t count) {
  int32_t block = count / BLOCKS;
  return block < LEAST_BLOCK ? LEAST_BLOCK : block > MOST_BLOCK ? MOST_BLOCK : block;
}

// Where the bytes of an item begin.
static size_t place_of(const Share *share, int32_t item) {
  return (size_t)(share->start ? share->start[item] : item) * share->width;
}

static CwStatus run_block(void *context, int32_t block, void **bytes, int64_t *size) {
  CwStatus status = CW_OK;
  const Share *share = context;
  int32_t first = block * share->block, left = share->count - first;
  int32_t last = left < share->block ? share->count : first + share->block;
  size_t length = place_of(share, last) - place_of(share, first);
  char *own = NULL;
  if (!share->out) CW_NEW_UNSET(own, length);
  char *result = own ? own : share->out + place_of(share, first);
  memset(result, 0, length);
  for (int32_t i = first; i < last; i++)
    CW_TRY(share->body(share->given, i, result + place_of(share, i) - place_of(share, first)));
  *bytes = own;
  *size = (int64_t)length;
  own = NULL;
done:
  free(own);
  return status;
}

CwStatus cw_parallel_for(const CwContext *context, const char *step, int32_t count, size_t width, CwParallelBody body,
                         void *given, void *out) {
  return cw_parallel_for_lists(context, step, count, NULL, width, body, given, out);
}

CwStatus cw_parallel_for_lists(const CwContext *context, const char *step, int32_t count, const int32_t *start,
                               size_t width, CwParallelBody body, void *given, void *out) {
  CwStatus status = CW_OK;
  int alone = cw_team_ranks(cw_team_of(context)) == 1;
  Share share = {body, given, count, start, width, block_of(count), alone ? out : NULL};
  int32_t blocks = (count + share.block - 1) / share.block;
  CwTaskResults results = {0};
  CwSchedule schedule = {.step = step, .count = blocks, .run = run_block, .context = &share, .alike = 1};
  CW_TRY(cw_schedule_gather(context, &schedule, &results));
  for (int32_t i = 0; i < blocks; i++) {
    if (results.bytes[i])
      memcpy((char *)out + place_of(&share, i * share.block), results.bytes[i], (size_t)results.size[i]);
  }
done:
  cw_task_results_free(&results);
  return status;
}
