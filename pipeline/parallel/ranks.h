// SPDX-License-Identifier: AGPL-3.0-or-later
// What all MPI ranks of exporter and report do together.
#pragma once

#include <mpi.h>
#include <stdint.h>

#include "pipeline/file_digest.h"
#include "pipeline/log.h"
#include "pipeline/status.h"

typedef struct {
  MPI_Comm comm;
  int rank, size;
  CwLog *log; // of this rank
} CwRanks;

// All ranks learn of a failure: returns `status` where it is one, CW_ERR_RANK where another rank has one,
// else CW_OK. Collective.
CwStatus cw_ranks_agree(const CwRanks *ranks, CwStatus status);

// The end of a run: the first rank with a failure of its own hands its status and its message on to all, and rank 0
// prints the line, so that it follows all that rank 0 has printed before. Returns the exit status, the same on all
// ranks: mpirun passes on the first one it sees. Collective.
int cw_ranks_end(const CwRanks *ranks, CwStatus status, CwLog *log);

// Gathers the `count` items of `size` bytes of each rank on rank 0, in the order of the ranks, into a new array (*all,
// of *total items; on the other ranks NULL and 0). Fails on all ranks alike. Collective.
CwStatus cw_ranks_gather(const CwRanks *ranks, const void *items, int64_t count, size_t size, void **all,
                         int64_t *total);

// `count` items of `size` bytes from one rank to another, for both of which it is called; others may call it too.
void cw_ranks_pass(const CwRanks *ranks, void *items, int64_t count, size_t size, int from, int to);

// Rank 0 sends `count` items of `size` bytes to all. Collective.
void cw_ranks_broadcast(const CwRanks *ranks, void *items, int64_t count, size_t size);

// All ranks get the sum, least or greatest (MPI's operation) of each of `count` values. Collective.
void cw_ranks_reduce(const CwRanks *ranks, void *values, int64_t count, MPI_Datatype type, MPI_Op operation);

// Each rank gets the sums over the ranks before it. [in,out] values. Collective.
void cw_ranks_before(const CwRanks *ranks, int64_t *values, int64_t count);

// The digest of a file, of which each rank reads some blocks. CW_ERR_IO, CW_ERR_MEMORY; fails on all ranks alike.
// Collective.
CwStatus cw_ranks_file_digest(const CwRanks *ranks, const char *path, char digest[CW_HASH_TEXT]);
// The same of a file of `size` bytes, of which each rank has summed a share. Collective.
void cw_ranks_sum_digest(const CwRanks *ranks, CwFileSum sum, int64_t size, char digest[CW_HASH_TEXT]);
