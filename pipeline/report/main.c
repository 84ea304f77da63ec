// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-report: the files of a run in, one page to look at out.
#include <stdio.h>
#include <stdlib.h>

#include "pipeline/atomic_file.h"
#include "pipeline/log.h"
#include "pipeline/record.h"
#include "pipeline/report/page.h"
#include "pipeline/stage_args.h"
#include "pipeline/version.h"

static const CwStageUsage usage = {
    .stage = "report",
    .version = cw_version,
    .summary = "Writes RUN/report/index.html: figures, charts and pictures of RUN/geometry, RUN/mesh and, "
               "where it is\n"
               "there, RUN/export. The page is one file that refers to nothing outside itself.\n",
    .reads = {"geometry", "mesh"},
};

// Writes the page without its pictures to nowhere, so that what is missing or wrong is told before they are drawn,
// which takes most of the time. CW_ERR_IO, CW_ERR_INPUT.
static CwStatus require_content(const CwReportData *data) {
  CwStatus status = CW_OK;
  FILE *nowhere = fopen("/dev/null", "w");
  CW_REQUIRE(nowhere, CW_ERR_IO, "/dev/null: cannot be opened");
  CW_TRY(cw_page_write(nowhere, data));
done:
  if (nowhere) fclose(nowhere);
  return status;
}

static CwStatus report(const CwStageArgs *args, const CwCase *table, CwRecord *record) {
  CwStatus status = CW_OK;
  CwReportData data = {0};
  CwPumpSizes sizes;
  CwAtomicFile file = {0};
  char *path = NULL, *record_path = NULL;
  double started = cw_seconds(), drawn;
  CW_TRY(cw_report_data_read(args->run_path, table, &data));
  CW_TRY(cw_report_sizes(&data, &sizes));
  CW_TRY(require_content(&data));
  CW_TRY(cw_report_pictures_draw(args->log, &data.mesh, &sizes, &data.flow, &data.pictures, &data.view));
  drawn = cw_seconds();
  CW_TRY(cw_stage_path(args, "report/index.html", &path));
  CW_TRY(cw_stage_path(args, "report/record.json", &record_path));
  CW_TRY(cw_atomic_file_open(path, &file));
  CW_TRY(cw_page_write(file.stream, &data));
  CW_TRY(cw_atomic_file_commit(&file));
  CW_TRY(cw_record_step(record, "pictures", drawn - started, data.pictures.count, "pictures"));
  CW_TRY(cw_record_step(record, "page", cw_seconds() - drawn, 1, "files"));
  CW_TRY(cw_record_write(record, record_path));
  cw_log(args->log, "%d pictures, page written to %s in %.1f s", data.pictures.count, path, cw_seconds() - started);
done:
  cw_atomic_file_abandon(&file);
  cw_report_data_free(&data);
  free(path);
  free(record_path);
  return status;
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CwStageArgs args;
  CwCase table;
  CwRecord *record = NULL;
  CW_TRY(cw_stage_begin(argc, argv, &usage, 1, &args, &table));
  if (args.finished) goto done;
  CW_TRY(cw_record_start("report", args.log, &record));
  CW_TRY(report(&args, &table, record));
done:;
  int code = cw_log_error(args.log, status);
  cw_record_free(record);
  cw_log_close(&args.log);
  return code;
}
