// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-export: `mpirun -n RANKS cutwater-export --case FILE --run DIR`.
#include <hdf5.h>
#include <malloc.h>
#include <mpi.h>
#include <unistd.h>

#include "export/cgns_file.h"
#include "export/stage.h"
#include "pipeline/log.h"
#include "pipeline/mpi_settings.h"
#include "pipeline/stage_args.h"
#include "pipeline/stop_line.h"
#include "pipeline/version.h"

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  static const CwStageUsage usage = {
      .stage = "export",
      .version = cw_version,
      .summary = "Writes RUN/export from the mesh in RUN/mesh: what the case's export.formats asks, which is\n"
                 "pump.cgns, an OpenFOAM case and a CFX set-up where it asks nothing.\n"
                 "Runs under mpirun with any number of ranks; what it writes is the same for all.\n",
      .reads = {"geometry", "mesh"}};
  CwStageArgs args = {0};
  CwCase table;
  CwRanks ranks = {.comm = MPI_COMM_WORLD};
  // Memory of one region serves the next: it is not given back to the system in between.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  cw_mpi_settings();
  H5dont_atexit();
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(ranks.comm, &ranks.rank);
  MPI_Comm_size(ranks.comm, &ranks.size);
  CW_TRY(cw_ranks_agree(&ranks, cw_stage_begin(argc, argv, &usage, ranks.rank == 0, &args, &table)));
  ranks.log = args.log;
  if (!args.finished) CW_TRY(cw_ranks_agree(&ranks, cw_stop_watch(args.run_path, "export", ranks.rank == 0)));
  if (!args.finished) CW_TRY(cw_export_run(&table, args.run_path, usage.reads, &ranks));
done:;
  int code = cw_ranks_end(&ranks, status, args.log);
  cw_log_close(&args.log);
  cw_stop_end();
  // Where one rank has to end without MPI_Finalize(), the others would wait for it there.
  int stuck = cw_cgns_stuck();
  MPI_Allreduce(MPI_IN_PLACE, &stuck, 1, MPI_INT, MPI_MAX, ranks.comm);
  if (stuck) _exit(code);
  if (code == 0) H5close();
  MPI_Finalize();
  return code;
}
