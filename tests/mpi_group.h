// SPDX-License-Identifier: AGPL-3.0-or-later
// The main function of a test whose module wants all ranks.
#pragma once

#include <mpi.h>

#include "pipeline/mpi_settings.h"
#include "pipeline/parallel/ranks.h"

static inline void begin_mpi(int *argc, char ***argv, CwRanks *all) {
  cw_mpi_settings();
  MPI_Init(argc, argv);
  all->comm = MPI_COMM_WORLD;
}

// Hands on how many tests have failed.
static inline int end_mpi(int failed) {
  MPI_Finalize();
  return failed;
}
