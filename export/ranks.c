// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/ranks.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

// Items of one message: counts of MPI are int, and a message of two gigabytes and more is too much for some ways of
// sending.
static const int64_t MESSAGE_BYTES = 1 << 26;

CwStatus cw_ranks_agree(const CwRanks *ranks, CwStatus status) {
  int mine = status != CW_OK, any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, ranks->comm);
  if (mine) return status;
  return any ? CW_FAIL(CW_ERR_RANK, "another rank failed") : CW_OK;
}

int cw_ranks_speaks_of(const CwRanks *ranks, CwStatus status) {
  int mine = status != CW_OK && status != CW_ERR_RANK ? ranks->rank : INT_MAX, first = INT_MAX;
  MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, ranks->comm);
  return first == ranks->rank;
}

// Sends or receives items, message by message.
static void pass_items(const CwRanks *ranks, char *items, int64_t count, size_t size, int from, int to) {
  const int64_t most = MESSAGE_BYTES / (int64_t)size + 1;
  for (int64_t at = 0; at < count; at += most) {
    const int bytes = (int)((count - at < most ? count - at : most) * (int64_t)size);
    char *part = items + at * (int64_t)size;
    if (ranks->rank == from) MPI_Send(part, bytes, MPI_BYTE, to, 0, ranks->comm);
    if (ranks->rank == to) MPI_Recv(part, bytes, MPI_BYTE, from, 0, ranks->comm, MPI_STATUS_IGNORE);
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
      pass_items(ranks, place, counts[r], size, r, 0);
    }
    *total = sum;
  } else {
    pass_items(ranks, (char *)(uintptr_t)items, count, size, ranks->rank, 0); // only read
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
  for (int64_t at = 0; at < bytes; at += MESSAGE_BYTES)
    MPI_Bcast((char *)items + at, (int)(bytes - at < MESSAGE_BYTES ? bytes - at : MESSAGE_BYTES), MPI_BYTE, 0,
              ranks->comm);
}

void cw_ranks_reduce(const CwRanks *ranks, void *values, int64_t count, MPI_Datatype type, MPI_Op operation) {
  int size;
  MPI_Type_size(type, &size);
  const int64_t most = MESSAGE_BYTES / size;
  for (int64_t at = 0; at < count; at += most)
    MPI_Allreduce(MPI_IN_PLACE, (char *)values + size * at, (int)(count - at < most ? count - at : most), type,
                  operation, ranks->comm);
}
