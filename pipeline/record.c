// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/record.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/atomic_file.h"
#include "pipeline/case_origin.h"
#include "pipeline/file_digest.h"
#include "pipeline/log.h"
#include "pipeline/sealed_json.h"
#include "pipeline/stage_files.h"

struct CwRecord {
  char stage[33];
  const CwLog *log;
  double started;
  int64_t peak_memory_bytes; // 0: ask the system
  json_t *steps, *results;
  json_t *files;     // digests by name
  json_t *inputs;    // digests by path
  json_t *made_from; // NULL: from no files
  json_t *origin;    // NULL: of no case
};

CwStatus cw_record_start(const char *stage, const CwLog *log, CwRecord **record) {
  CwStatus status = CW_OK;
  CwRecord *made = NULL;
  *record = NULL;
  CW_NEW(made, 1);
  snprintf(made->stage, sizeof made->stage, "%s", stage);
  made->log = log;
  made->started = cw_seconds();
  made->steps = json_array();
  made->results = json_object();
  made->files = json_object();
  made->inputs = json_object();
  CW_REQUIRE(made->steps && made->results && made->files && made->inputs, CW_ERR_MEMORY, "out of memory: the record");
  *record = made;
  made = NULL;
done:
  cw_record_free(made);
  return status;
}

void cw_record_free(CwRecord *record) {
  if (!record) return;
  json_decref(record->steps);
  json_decref(record->results);
  json_decref(record->files);
  json_decref(record->inputs);
  json_decref(record->made_from);
  json_decref(record->origin);
  free(record);
}

json_t *cw_json_number(double value) {
  return isfinite(value) ? json_real(value) : json_null();
}

// A text that is not UTF-8 (a file name may be anything) is kept with its odd bytes replaced.
static json_t *json_text(const char *text) {
  json_t *value = json_string(text);
  if (value) return value;
  char *plain = strdup(text);
  if (!plain) return NULL;
  for (char *c = plain; *c; ++c)
    if ((unsigned char)*c >= 0x80) *c = '?';
  value = json_string(plain);
  free(plain);
  return value;
}

CwStatus cw_record_step(CwRecord *record, const char *name, double seconds, int64_t items, const char *unit) {
  json_t *step = json_pack("{so so sI so}", "name", json_text(name), "seconds", cw_json_number(seconds), "items",
                           (json_int_t)items, "unit", json_text(unit));
  return step && !json_array_append_new(record->steps, step)
             ? CW_OK
             : CW_FAIL(CW_ERR_MEMORY, "out of memory: the record of step %s", name);
}

void cw_record_set_peak_memory(CwRecord *record, int64_t bytes) {
  record->peak_memory_bytes = bytes;
}

CwStatus cw_record_case(CwRecord *record, const CwCase *table) {
  json_decref(record->origin);
  record->origin = cw_case_origin(table);
  return record->origin ? CW_OK : CW_FAIL(CW_ERR_MEMORY, "out of memory: the record of the case");
}

CwStatus cw_record_made_from(CwRecord *record, const char *run, const char *const *stages) {
  json_decref(record->made_from);
  return cw_stage_files_read(run, stages, &record->made_from);
}

CwStatus cw_record_input(CwRecord *record, const char *path) {
  CwStatus status = CW_OK;
  char digest[CW_HASH_TEXT], *whole = realpath(path, NULL);
  json_t *name = NULL;
  CW_REQUIRE(whole, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_TRY(cw_file_digest(whole, digest));
  name = json_text(whole);
  CW_REQUIRE(name && !json_object_set_new(record->inputs, json_string_value(name), json_string(digest)), CW_ERR_MEMORY,
             "out of memory: the record of %s", path);
done:
  json_decref(name);
  free(whole);
  return status;
}

CwStatus cw_record_file(CwRecord *record, const char *folder, const char *name) {
  CwStatus status = CW_OK;
  char path[4096], digest[CW_HASH_TEXT];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  CW_TRY(cw_file_digest(path, digest));
  CW_TRY(cw_record_file_digest(record, name, digest));
done:
  return status;
}

CwStatus cw_record_file_digest(CwRecord *record, const char *name, const char *digest) {
  return !json_object_set_new(record->files, name, json_string(digest))
             ? CW_OK
             : CW_FAIL(CW_ERR_MEMORY, "out of memory: the record of %s", name);
}

CwStatus cw_record_json(CwRecord *record, const char *key, json_t *value) {
  return !json_object_set_new(record->results, key, value)
             ? CW_OK
             : CW_FAIL(CW_ERR_MEMORY, "out of memory: the record of result %s", key);
}

CwStatus cw_record_number(CwRecord *record, const char *key, double value) {
  return cw_record_json(record, key, cw_json_number(value));
}

CwStatus cw_record_integer(CwRecord *record, const char *key, int64_t value) {
  return cw_record_json(record, key, json_integer(value));
}

CwStatus cw_json_write(const json_t *value, const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  CW_TRY(cw_atomic_file_open(path, &file));
  int broken = json_dumpf(value, file.stream, CW_JSON_FORMAT) || fputc('\n', file.stream) == EOF;
  CW_REQUIRE(!broken, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  return status;
}

CwStatus cw_record_write(const CwRecord *record, const char *path) {
  CwStatus status = CW_OK;
  json_t *root = NULL;
  json_t *warnings = json_array();
  CW_REQUIRE(warnings, CW_ERR_MEMORY, "out of memory: the record");
  for (size_t i = 0; i < cw_log_warning_count(record->log); ++i)
    CW_REQUIRE(!json_array_append_new(warnings, json_text(cw_log_warning(record->log, i))), CW_ERR_MEMORY,
               "out of memory: the record of a warning");
  int64_t peak = record->peak_memory_bytes ? record->peak_memory_bytes : cw_peak_memory_bytes();
  root = json_pack("{so so sI sO sO sO sO}", "stage", json_text(record->stage), "seconds",
                   cw_json_number(cw_seconds() - record->started), "peak_memory_bytes", (json_int_t)peak, "steps",
                   record->steps, "warnings", warnings, "results", record->results, "files", record->files);
  CW_REQUIRE(root && (!json_object_size(record->inputs) || !json_object_set(root, "inputs", record->inputs)) &&
                 (!record->made_from || !json_object_set(root, "made_from", record->made_from)) &&
                 (!record->origin || !json_object_set(root, "case", record->origin)),
             CW_ERR_MEMORY, "out of memory: the record");
  CW_TRY(cw_sealed_json_write(root, path));
done:
  json_decref(root);
  json_decref(warnings);
  return status;
}
