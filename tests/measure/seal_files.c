// SPDX-License-Identifier: AGPL-3.0-or-later
// seal_files FOLDER: makes the digests of FOLDER/record.json those of the files that lie there now, as if the stage had
// written them. For tests of what later stages make of files that no stage of ours writes.
#include <jansson.h>
#include <stdio.h>

#include "pipeline/file_digest.h"
#include "pipeline/json_read.h"
#include "pipeline/log.h"
#include "pipeline/sealed_json.h"

static CwStatus seal(const char *folder) {
  CwStatus status = CW_OK;
  json_t *record = NULL, *files, *old;
  char path[4096], digest[CW_HASH_TEXT];
  const char *name;
  void *next;
  snprintf(path, sizeof path, "%s/record.json", folder);
  CW_TRY(cw_sealed_json_read(path, &record));
  CW_TRY(cw_json_object(record, path, "files", &files));
  json_object_foreach_safe(files, next, name, old) {
    snprintf(path, sizeof path, "%s/%s", folder, name);
    CW_TRY(cw_file_digest(path, digest));
    CW_REQUIRE(json_object_set_new(files, name, json_string(digest)) == 0, CW_ERR_MEMORY, "out of memory: %s", name);
  }
  json_object_del(record, "digest");
  snprintf(path, sizeof path, "%s/record.json", folder);
  CW_TRY(cw_sealed_json_write(record, path));
done:
  json_decref(record);
  return status;
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CW_REQUIRE(argc == 2, CW_ERR_USAGE, "usage: seal_files FOLDER");
  CW_TRY(seal(argv[1]));
done:
  return status == CW_OK ? 0 : cw_log_error(NULL, status);
}
