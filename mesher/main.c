// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-mesh: exact geometry in, region files out. Run it under mpirun.
#include <hdf5.h>
#include <mpi.h>
#include <stdlib.h>

#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "mesher/policy.h"
#include "mesher/run/mesh_run.h"
#include "mesher/run/stage_view.h"
#include "pipeline/log.h"
#include "pipeline/stage_args.h"
#include "pipeline/stop_line.h"
#include "pipeline/version.h"

static const CwStageOption OPTIONS[] = {
    {"stop-after", "STAGE", "end after size, decomposition, curves, surface, layers or interfaces, without a mesh"},
    {"vtk", NULL, "write what that stage made, RUN/mesh/DOMAIN-STAGE.vtk"},
};
enum { STOP_AFTER, VTK, OPTION_COUNT };

static const CwStageUsage USAGE = {
    .stage = "mesh",
    .version = cw_version,
    .summary =
        "Meshes RUN/geometry into region files and a manifest in RUN/mesh. Regions that an earlier run left whole\n"
        "are kept. Start it under mpirun for more than one rank; the mesh is the same for any number.\n",
    .options = OPTIONS,
    .option_count = OPTION_COUNT,
    .reads = {"geometry"},
};

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CwStageArgs args = {0};
  CwCase table;
  CwMeshRun run = {0};
  CwTeam *team = NULL;
  char *record_path = NULL;
  H5dont_atexit(); // HDF5 stumbles there over files that could not be closed
  CW_TRY(cw_mpi_start(&argc, &argv, &team));
  run.rank = cw_team_rank(team);
  run.context.team = team;
  CW_TRY(cw_profiler_make(&run.context.profiler));
  CW_TRY(cw_team_agree(team, cw_stage_begin(argc, argv, &USAGE, run.rank == 0, &args, &table)));
  if (args.finished) goto done;
  run.context.log = args.log;
  CW_TRY(cw_team_agree(team, cw_policy_start()));
  // Of each of these all ranks know the end before they go on: else the run folder might be that of another mesher,
  // which has the file of cw_stop_claim, or that file might be late.
  CW_TRY(cw_team_agree(team, cw_stop_watch(args.run_path, "mesh", run.rank == 0)));
  run.table = &table;
  run.run_path = args.run_path;
  if (args.options[STOP_AFTER]) CW_TRY(cw_stage_of(args.options[STOP_AFTER], &run.stop_after));
  run.vtk = args.options[VTK] != NULL;
  CW_TRY(cw_record_start("mesh", args.log, &run.record));
  CW_TRY(cw_record_made_from(run.record, args.run_path, USAGE.reads));
  CW_TRY(cw_mesh_run(&run));
  json_t *account = NULL, *sides = NULL;
  CW_TRY(cw_profiler_json(&run.context, &account, &sides));
  CW_TRY(cw_record_json(run.record, "together", account));
  CW_TRY(cw_record_json(run.record, "side_by_side", sides));
  long long mine = cw_host_memory_peak(run.context.team), all = 0;
  MPI_Reduce(&mine, &all, 1, MPI_LONG_LONG, MPI_SUM, 0, MPI_COMM_WORLD);
  // Together: the last rank that has them holds all that the ranks of a host share.
  CW_TRY(cw_team_agree(team, status));
  cw_mesh_run_free(&run);
  if (run.rank == 0 && !run.stopped) { // else there is no mesh to vouch for
    CW_TRY(cw_stage_path(&args, "mesh/record.json", &record_path));
    cw_record_set_peak_memory(run.record, all);
    CW_TRY(cw_record_case(run.record, &table));
    CW_TRY(cw_record_write(run.record, record_path));
  }
done:
  if (status != CW_OK) return cw_mpi_fail(args.log, status);
  cw_profiler_free(&run.context.profiler);
  cw_record_free(run.record);
  free(record_path);
  cw_log_close(&args.log);
  cw_stop_end();
  cw_mpi_end(&team);
  return 0;
}
