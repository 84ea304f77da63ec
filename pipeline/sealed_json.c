// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/sealed_json.h"

#include <stdlib.h>
#include <string.h>

#include "pipeline/atomic_file.h"
#include "pipeline/file_digest.h"

#define SEAL_START ",\n  \"digest\": \""
#define SEAL_END "\"\n}\n"
enum { SEAL_SIZE = sizeof SEAL_START - 1 + CW_HASH_TEXT - 1 + sizeof SEAL_END - 1 };

static void digest_of(const char *text, size_t size, char digest[CW_HASH_TEXT]) {
  CwHash hash = cw_hash_start();
  cw_hash_bytes(&hash, text, size);
  cw_hash_hex(&hash, digest);
}

CwStatus cw_sealed_json_write(const json_t *object, const char *path) {
  CwStatus status = CW_OK;
  CwAtomicFile file = {0};
  char digest[CW_HASH_TEXT];
  char *text = json_dumps(object, CW_JSON_FORMAT);
  CW_REQUIRE(text, CW_ERR_MEMORY, "out of memory: %s", path);
  const int size = (int)strlen(text) - 2; // without the newline and the brace of its end
  digest_of(text, (size_t)size, digest);
  CW_TRY(cw_atomic_file_open(path, &file));
  fprintf(file.stream, "%.*s" SEAL_START "%s" SEAL_END, size, text, digest);
  CW_TRY(cw_atomic_file_commit(&file));
done:
  cw_atomic_file_abandon(&file);
  free(text);
  return status;
}

CwStatus cw_sealed_json_read(const char *path, json_t **object) {
  CwStatus status = CW_OK;
  char *text = NULL, digest[CW_HASH_TEXT], wanted[SEAL_SIZE + 1];
  size_t size = 0;
  json_error_t error;
  *object = NULL;
  CW_TRY(cw_file_text(path, &text, &size));
  size_t sealed = size > SEAL_SIZE ? size - SEAL_SIZE : 0;
  digest_of(text, sealed, digest);
  snprintf(wanted, sizeof wanted, SEAL_START "%s" SEAL_END, digest);
  CW_REQUIRE(!strcmp(text + sealed, wanted), CW_ERR_IO,
             "%s: is not as the stage wrote it: damaged, cut short or changed; run that stage again", path);
  *object = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
  CW_REQUIRE(*object, CW_ERR_INPUT, "%s:%d:%d: not valid JSON: %s", path, error.line, error.column, error.text);
done:
  free(text);
  return status;
}
