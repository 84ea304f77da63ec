// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-report: the files of a run in, one page to look at out.
#include <errno.h>
#include <hdf5.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/atomic_file.h"
#include "pipeline/log.h"
#include "pipeline/mpi_settings.h"
#include "pipeline/parallel/ranks.h"
#include "pipeline/record.h"
#include "pipeline/report/export_check.h"
#include "pipeline/report/page.h"
#include "pipeline/stage_args.h"
#include "pipeline/stop_line.h"
#include "pipeline/version.h"

static const CwStageUsage usage = {
    .stage = "report",
    .version = cw_version,
    .summary = "Writes RUN/report/index.html: figures, charts and pictures of RUN/geometry, RUN/mesh and, where it is\n"
               "there, RUN/export. The page is one file that refers to nothing outside itself.\n"
               "Runs by itself, or under mpirun with any number of ranks; the page is the same for all.\n",
    .reads = {"geometry", "mesh"},
};

// Writes the page without its pictures to nowhere, so that what is missing or wrong is told before they are drawn,
// which takes most of the time. CW_ERR_IO, CW_ERR_INPUT.
static CwStatus require_content(const CwReportData *data) {
  CwStatus status = CW_OK;
  FILE *nowhere = fopen("/dev/null", "w");
  CW_REQUIRE(nowhere, CW_ERR_IO, "/dev/null: cannot be opened: %s", strerror(errno));
  CW_TRY(cw_page_write(nowhere, data));
done:
  if (nowhere) fclose(nowhere);
  return status;
}

static CwStatus write_page(const CwStageArgs *args, const CwReportData *data, char **path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  CW_TRY(cw_stage_path(args, "report/index.html", path));
  CW_TRY(cw_atomic_file_open(*path, &file));
  CW_TRY(cw_page_write(file.stream, data));
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}

static CwStatus report(const CwStageArgs *args, const CwCase *table, const CwRanks *ranks) {
  CwStatus status = CW_OK;
  CwRecord *record = NULL;
  CwReportData data = {0};
  CwExportCheck *check = NULL;
  CwPumpSizes sizes;
  char *path = NULL, *record_path = NULL;
  double started = cw_seconds(), drawn;
  CW_TRY(cw_ranks_agree(ranks, cw_record_start("report", args->log, &record)));
  status = cw_report_data_read(args->run_path, table, &data);
  if (status == CW_OK) status = cw_report_sizes(&data, &sizes);
  if (status == CW_OK && ranks->rank == 0) status = require_content(&data);
  CW_TRY(cw_ranks_agree(ranks, status));
  if (data.record[CW_STAGE_OF_EXPORT]) {
    status = cw_export_check_begin(args->run_path, data.record[CW_STAGE_OF_EXPORT], ranks, &check);
    CW_TRY(cw_ranks_agree(ranks, status));
  }
  CW_TRY(cw_report_pictures_draw(ranks, &data.mesh, &sizes, &data.flow, &data.pictures, &data.view));
  if (check) CW_TRY(cw_export_check_end(check));
  drawn = cw_seconds();
  int64_t memory = cw_peak_memory_bytes();
  cw_ranks_reduce(ranks, &memory, 1, MPI_INT64_T, MPI_SUM);
  if (ranks->rank > 0) goto done;
  CW_TRY(write_page(args, &data, &path));
  CW_TRY(cw_stage_path(args, "report/record.json", &record_path));
  CW_TRY(cw_record_step(record, "pictures", drawn - started, data.pictures.count, "pictures"));
  CW_TRY(cw_record_step(record, "page", cw_seconds() - drawn, 1, "files"));
  cw_record_set_peak_memory(record, memory);
  CW_TRY(cw_record_write(record, record_path));
  cw_log(args->log, "%d pictures, page written to %s in %.1f s", data.pictures.count, path, cw_seconds() - started);
done:
  cw_export_check_free(&check);
  cw_record_free(record);
  cw_report_data_free(&data);
  free(path);
  free(record_path);
  return status;
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CwStageArgs args = {0};
  CwCase table;
  CwRanks ranks = {.comm = MPI_COMM_WORLD};
  cw_mpi_settings();
  // A rank that waits gives its core away (Open MPI): on a busy machine the one that it waits for needs it.
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  H5dont_atexit();
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(ranks.comm, &ranks.rank);
  MPI_Comm_size(ranks.comm, &ranks.size);
  CW_TRY(cw_ranks_agree(&ranks, cw_stage_begin(argc, argv, &usage, ranks.rank == 0, &args, &table)));
  ranks.log = args.log;
  if (!args.finished) CW_TRY(cw_ranks_agree(&ranks, cw_stop_watch(args.run_path, "report", ranks.rank == 0)));
  if (!args.finished) CW_TRY(cw_ranks_agree(&ranks, report(&args, &table, &ranks)));
done:;
  int code = cw_ranks_end(&ranks, status, args.log);
  cw_log_close(&args.log);
  cw_stop_end();
  H5close();
  MPI_Finalize();
  return code;
}
