// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/stage_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pipeline/file_digest.h"
#include "pipeline/json_read.h"
#include "pipeline/sealed_json.h"

enum { PATH_SIZE = 4096 };

static CwStatus read_record(const char *run, const char *stage, json_t **record, json_t **files) {
  CwStatus status = CW_OK;
  char path[PATH_SIZE];
  snprintf(path, sizeof path, "%s/%s/record.json", run, stage);
  CW_TRY(cw_sealed_json_read(path, record));
  CW_TRY(cw_json_object(*record, path, "files", files));
done:
  return status;
}

// The digest of the files of a stage, as its record tells of them.
static CwStatus digest_stage(const char *run, const char *stage, char digest[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  CwHash hash = cw_hash_start();
  char *text = NULL;
  json_t *record = NULL, *files;
  CW_TRY(read_record(run, stage, &record, &files));
  text = json_dumps(files, JSON_COMPACT | JSON_SORT_KEYS);
  CW_REQUIRE(text, CW_ERR_MEMORY, "out of memory: the digest of a stage");
  cw_hash_bytes(&hash, text, strlen(text));
  cw_hash_hex(&hash, digest);
done:
  free(text);
  json_decref(record);
  return status;
}

CwStatus cw_stage_files_source_check(const char *run, const char *stage, json_t *record) {
  CwStatus status = CW_OK;
  char digest[CW_HASH_TEXT];
  const char *from;
  json_t *wanted;
  json_object_foreach(json_object_get(record, "made_from"), from, wanted) {
    CW_TRY(digest_stage(run, from, digest));
    CW_REQUIRE(json_is_string(wanted) && !strcmp(digest, json_string_value(wanted)), CW_ERR_INPUT,
               "%s/%s: was made from other files than lie in %s/%s; run cutwater-%s again", run, stage, run, from,
               stage);
  }
done:
  return status;
}

CwStatus cw_stage_files_check_by(const char *run, const char *stage, json_t *record, CwDigestOf digest_of,
                                 void *given) {
  CwStatus status = CW_OK;
  char path[PATH_SIZE], digest[CW_HASH_TEXT];
  const char *name;
  json_t *files, *wanted;
  snprintf(path, sizeof path, "%s/%s/record.json", run, stage);
  CW_TRY(cw_json_object(record, path, "files", &files));
  json_object_foreach(files, name, wanted) {
    snprintf(path, sizeof path, "%s/%s/%s", run, stage, name);
    CW_TRY(digest_of(given, path, digest));
    CW_REQUIRE(json_is_string(wanted) && !strcmp(digest, json_string_value(wanted)), CW_ERR_IO,
               "%s: is not as cutwater-%s wrote it: damaged or replaced; run cutwater-%s again", path, stage, stage);
  }
done:
  return status;
}

static CwStatus digest_alone(void *given, const char *path, char digest[CW_HASH_TEXT]) {
  return cw_file_digest(path, digest);
}

static CwStatus check_inputs(const char *run, const char *stage, json_t *record) {
  CwStatus status = CW_OK;
  char digest[CW_HASH_TEXT];
  const char *path;
  json_t *wanted;
  json_object_foreach(json_object_get(record, "inputs"), path, wanted) {
    if (access(path, R_OK)) continue;
    CW_TRY(cw_file_digest(path, digest));
    CW_REQUIRE(json_is_string(wanted) && !strcmp(digest, json_string_value(wanted)), CW_ERR_INPUT,
               "%s: has changed since %s/%s was made from it; run cutwater-%s again", path, run, stage, stage);
  }
done:
  return status;
}

CwStatus cw_stage_files_check(const char *run, const char *stage) {
  CwStatus status = CW_OK;
  json_t *record = NULL, *files;
  CW_TRY(read_record(run, stage, &record, &files));
  CW_TRY(cw_stage_files_check_by(run, stage, record, digest_alone, NULL));
  CW_TRY(cw_stage_files_source_check(run, stage, record));
  CW_TRY(check_inputs(run, stage, record));
done:
  json_decref(record);
  return status;
}

CwStatus cw_stage_files_read(const char *run, const char *const *stages, json_t **made_from) {
  CwStatus status = CW_OK;
  char digest[CW_HASH_TEXT];
  *made_from = json_object();
  for (; *stages; ++stages) {
    CW_TRY(digest_stage(run, *stages, digest));
    CW_REQUIRE(!json_object_set_new(*made_from, *stages, json_string(digest)), CW_ERR_MEMORY,
               "out of memory: what a stage is made from");
  }
done:
  if (status != CW_OK) {
    json_decref(*made_from);
    *made_from = NULL;
  }
  return status;
}
