// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/export_check.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/file_digest.h"
#include "pipeline/stage_files.h"

typedef struct {
  const char *name;
  int64_t size;
  CwFileSum sum; // of the blocks of this rank
} File;

struct CwExportCheck {
  const char *run;
  json_t *record;
  const CwRanks *ranks;
  File *file;
  int count, asked, joined;
  pthread_t reader;
  CwStatus status; // of the reader, and why
  CwFailure failure;
};

static CwStatus read_file(const CwExportCheck *check, File *file) {
  CwStatus status = CW_OK;
  char path[4096];
  snprintf(path, sizeof path, "%s/export/%s", check->run, file->name);
  CW_TRY(cw_file_size(path, &file->size));
  CW_TRY(cw_file_sum_blocks(path, file->size, check->ranks->rank, check->ranks->size, &file->sum));
done:
  return status;
}

static void *read_files(void *given) {
  CwExportCheck *check = given;
  for (int i = 0; i < check->count && check->status == CW_OK; i++) check->status = read_file(check, &check->file[i]);
  if (check->status != CW_OK) check->failure = *cw_failure();
  return NULL;
}

CwStatus cw_export_check_begin(const char *run, json_t *record, const CwRanks *ranks, CwExportCheck **made) {
  CwStatus status = CW_OK;
  CwExportCheck *check = NULL;
  json_t *files = json_object_get(record, "files"), *digest;
  const char *name;
  CW_TRY(cw_stage_files_source_check(run, "export", record));
  CW_NEW(check, 1);
  check->run = run;
  check->record = record;
  check->ranks = ranks;
  check->joined = 1; // nothing is to be waited for yet
  CW_NEW(check->file, json_object_size(files));
  json_object_foreach(files, name, digest) check->file[check->count++].name = name;
  int refused = pthread_create(&check->reader, NULL, read_files, check);
  CW_REQUIRE(!refused, CW_ERR_LIBRARY,
             "%s/export: the system gives no thread to read it: %s; raise the limit of processes (ulimit -u)", run,
             strerror(refused));
  check->joined = 0;
  *made = check;
  check = NULL;
done:
  cw_export_check_free(&check);
  return status;
}

static void wait_for(CwExportCheck *check) {
  if (!check->joined) pthread_join(check->reader, NULL);
  check->joined = 1;
}

// The digest of a file of the record, in whose order they are asked for. Collective.
static CwStatus digest_next(void *given, const char *path, char digest[CW_HASH_TEXT]) {
  CwExportCheck *check = given;
  File *file = &check->file[check->asked++];
  (void)path;
  cw_ranks_sum_digest(check->ranks, file->sum, file->size, digest);
  return CW_OK;
}

CwStatus cw_export_check_end(CwExportCheck *check) {
  CwStatus status = CW_OK;
  wait_for(check);
  if (check->status != CW_OK) *cw_failure() = check->failure;
  CW_TRY(cw_ranks_agree(check->ranks, check->status));
  status = cw_stage_files_check_by(check->run, "export", check->record, digest_next, check);
  CW_TRY(cw_ranks_agree(check->ranks, status));
done:
  return status;
}

void cw_export_check_free(CwExportCheck **given) {
  CwExportCheck *check = *given;
  if (!check) return;
  wait_for(check);
  free(check->file);
  free(check);
  *given = NULL;
}
