// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/ranks.h"

#include <limits.h>
#include <stdlib.h>

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

CwStatus cw_ranks_gather(const CwRanks *ranks, const void *items, int64_t count, size_t size, void **all,
                         int64_t *total) {
  CwStatus status = CW_OK;
  int *counts = NULL, *offsets = NULL;
  MPI_Datatype type;
  int64_t sum = 0;
  int mine = (int)count;
  *all = NULL;
  *total = 0;
  MPI_Type_contiguous((int)size, MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Allreduce(&count, &sum, 1, MPI_INT64_T, MPI_SUM, ranks->comm);
  CW_REQUIRE(sum <= INT_MAX, CW_ERR_EXPORT, "%lld faces on partition planes or interfaces; at most %d are allowed",
             (long long)sum, INT_MAX);
  if (ranks->rank == 0) {
    *all = calloc(sum ? (size_t)sum : 1, size);
    counts = calloc((size_t)ranks->size, sizeof *counts);
    offsets = calloc((size_t)ranks->size, sizeof *offsets);
    if (!*all || !counts || !offsets)
      status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %lld items of %zu bytes", (long long)sum, size);
  }
  CW_TRY(cw_ranks_agree(ranks, status));
  MPI_Gather(&mine, 1, MPI_INT, counts, 1, MPI_INT, 0, ranks->comm);
  if (ranks->rank == 0)
    for (int r = 1; r < ranks->size; ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  MPI_Gatherv(items, mine, type, *all, counts, offsets, type, 0, ranks->comm);
  if (ranks->rank == 0) *total = sum;
done:
  if (status != CW_OK) {
    free(*all);
    *all = NULL;
  }
  MPI_Type_free(&type);
  free(counts);
  free(offsets);
  return status;
}

void cw_ranks_broadcast(const CwRanks *ranks, void *items, int64_t count, size_t size) {
  MPI_Datatype type;
  MPI_Type_contiguous((int)size, MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Bcast(items, (int)count, type, 0, ranks->comm);
  MPI_Type_free(&type);
}
