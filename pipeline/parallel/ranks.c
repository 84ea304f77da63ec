// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/parallel/ranks.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/parallel/message.h"

CwStatus cw_ranks_agree(const CwRanks *ranks, CwStatus status) {
  int mine = status != CW_OK, any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, ranks->comm);
  if (mine) return status;
  return any ? CW_FAIL(CW_ERR_RANK, "another rank failed") : CW_OK;
}

int cw_ranks_end(const CwRanks *ranks, CwStatus status, CwLog *log) {
  int mine = status != CW_OK && status != CW_ERR_RANK ? ranks->rank : INT_MAX, first = INT_MAX, code = (int)status;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, ranks->comm);
  if (first == INT_MAX) return (int)status;
  MPI_Bcast(&code, 1, MPI_INT, first, ranks->comm);
  MPI_Bcast(cw_failure(), (int)sizeof(CwFailure), MPI_BYTE, first, ranks->comm);
  return ranks->rank == 0 ? cw_log_error(log, (CwStatus)code) : code;
}

void cw_ranks_pass(const CwRanks *ranks, void *items, int64_t count, size_t size, int from, int to) {
  const int64_t bytes = count * (int64_t)size;
  for (int64_t at = 0, part; at < bytes; at += part) {
    part = cw_message_items(bytes - at, 1);
    if (ranks->rank == from) MPI_Send((char *)items + at, (int)part, MPI_BYTE, to, 0, ranks->comm);
    if (ranks->rank == to) MPI_Recv((char *)items + at, (int)part, MPI_BYTE, from, 0, ranks->comm, MPI_STATUS_IGNORE);
  }
}

CwStatus cw_ranks_gather(const CwRanks *ranks, const void *items, int64_t count, size_t size, void **all,
                         int64_t *total) {
  CwStatus status = CW_OK;
  int64_t *counts = calloc((size_t)ranks->size, sizeof *counts), sum = 0;
  *all = NULL;
  *total = 0;
  if (!counts) status = CW_FAIL(CW_ERR_MEMORY, "out of memory: counts of %d ranks", ranks->size);
  CW_TRY(cw_ranks_agree(ranks, status));
  MPI_Allgather(&count, 1, MPI_INT64_T, counts, 1, MPI_INT64_T, ranks->comm);
  for (int r = 0; r < ranks->size; ++r) sum += counts[r];
  if (ranks->rank == 0) {
    *all = calloc(sum ? (size_t)sum : 1, size);
    if (!*all) status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %lld items of %zu bytes", (long long)sum, size);
  }
  CW_TRY(cw_ranks_agree(ranks, status));
  if (ranks->rank == 0) {
    char *place = *all;
    if (count > 0) memcpy(place, items, (size_t)count * size);
    for (int r = 1; r < ranks->size; ++r) {
      place += counts[r - 1] * (int64_t)size;
      cw_ranks_pass(ranks, place, counts[r], size, r, 0);
    }
    *total = sum;
  } else {
    cw_ranks_pass(ranks, (void *)(uintptr_t)items, count, size, ranks->rank, 0); // only read
  }
done:
  if (status != CW_OK) {
    free(*all);
    *all = NULL;
  }
  free(counts);
  return status;
}

void cw_ranks_broadcast(const CwRanks *ranks, void *items, int64_t count, size_t size) {
  const int64_t bytes = count * (int64_t)size;
  for (int64_t at = 0, part; at < bytes; at += part) {
    part = cw_message_items(bytes - at, 1);
    MPI_Bcast((char *)items + at, (int)part, MPI_BYTE, 0, ranks->comm);
  }
}

void cw_ranks_reduce(const CwRanks *ranks, void *values, int64_t count, MPI_Datatype type, MPI_Op operation) {
  int size;
  MPI_Type_size(type, &size);
  for (int64_t at = 0, part; at < count; at += part) {
    part = cw_message_items(count - at, (size_t)size);
    MPI_Allreduce(MPI_IN_PLACE, (char *)values + size * at, (int)part, type, operation, ranks->comm);
  }
}

void cw_ranks_before(const CwRanks *ranks, int64_t *values, int64_t count) {
  for (int64_t at = 0, part; at < count; at += part) {
    part = cw_message_items(count - at, sizeof *values);
    MPI_Exscan(MPI_IN_PLACE, values + at, (int)part, MPI_INT64_T, MPI_SUM, ranks->comm);
  }
  if (ranks->rank == 0) memset(values, 0, (size_t)count * sizeof *values); // MPI leaves these as they are
}

void cw_ranks_sum_digest(const CwRanks *ranks, CwFileSum sum, int64_t size, char digest[CW_HASH_TEXT]) {
  cw_ranks_reduce(ranks, sum.part, CW_SUM_PARTS, MPI_UINT64_T, MPI_SUM);
  cw_file_sum_digest(&sum, size, digest);
}

CwStatus cw_ranks_file_digest(const CwRanks *ranks, const char *path, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  CwFileSum sum = {0};
  int64_t size = 0;
  CW_TRY(cw_ranks_agree(ranks, cw_file_size(path, &size)));
  CW_TRY(cw_ranks_agree(ranks, cw_file_sum_blocks(path, size, ranks->rank, ranks->size, &sum)));
  cw_ranks_sum_digest(ranks, sum, size, digest);
done:
  return status;
}
