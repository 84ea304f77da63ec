// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/policy.h"

#include <errno.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/source_hash.h"

static const char VARIABLE[] = "CUTWATER_POLICY";

#ifdef CUTWATER_EXPERIMENT
#define NUMBER(type, name, value, off, unit, meaning) .name = (value),
CwPolicy cw_policy = {
#include "mesher/policy_table.h"
};
#undef NUMBER
#endif

typedef struct {
  const char *name;
  size_t offset;
  int is_double; // else int64_t
} Number;

#define IS_DOUBLE(type) _Generic((type)0, double : 1, int64_t : 0)
#define NUMBER(type, name, value, off, unit, meaning) {#name, offsetof(CwPolicy, name), IS_DOUBLE(type)},
static const Number number[] = {
#include "mesher/policy_table.h"
};
#undef NUMBER
enum { NUMBERS = sizeof number / sizeof *number };

static const Number *find(const char *name) {
  for (int k = 0; k < NUMBERS; k++) {
    if (!strcmp(number[k].name, name)) return &number[k];
  }
  return NULL;
}

CwStatus cw_policy_read(FILE *file, const char *path, CwPolicy *policy) {
  CwStatus status = CW_OK;
  char line[512], name[64], value[64], more[2], *end;
  for (int at = 1; fgets(line, sizeof line, file); at++) {
    line[strcspn(line, "#\n")] = 0;
    int words = sscanf(line, "%63s %63s %1s", name, value, more);
    if (words <= 0) continue;
    CW_REQUIRE(words == 2, CW_ERR_INPUT, "%s:%d: a line is `name value`, as `improve_passes 5`", path, at);
    const Number *one = find(name);
    CW_REQUIRE(one, CW_ERR_INPUT, "%s:%d: there is no number `%s`; the first one is `%s`", path, at, name,
               number[0].name);
    double read = strtod(value, &end);
    CW_REQUIRE(!*end && read == read && (one->is_double || read == (double)(int64_t)read), CW_ERR_INPUT,
               "%s:%d: `%s` is not a %s for `%s`", path, at, value, one->is_double ? "number" : "whole number", name);
    char *field = (char *)policy + one->offset;
    if (one->is_double)
      memcpy(field, &read, sizeof read);
    else
      memcpy(field, &(int64_t){(int64_t)read}, sizeof(int64_t));
  }
done:
  return status;
}

CwStatus cw_policy_start(void) {
  CwStatus status = CW_OK;
  const char *path = getenv(VARIABLE);
  FILE *file = NULL;
  if (!path) goto done;
#ifdef CUTWATER_EXPERIMENT
  file = fopen(path, "r");
  CW_REQUIRE(file, CW_ERR_IO, "%s (of $%s): cannot be read: %s", path, VARIABLE, strerror(errno));
  CW_TRY(cw_policy_read(file, path, &cw_policy));
#else
  status =
      CW_FAIL(CW_ERR_USAGE, "$%s is set (%s), but the numbers of this build are fixed: cmake -DCUTWATER_EXPERIMENT=ON",
              VARIABLE, path);
#endif
done:
  if (file) fclose(file);
  return status;
}

void cw_policy_hash(CwHash *hash) {
  cw_hash_bytes(hash, cw_source_hash, sizeof cw_source_hash);
#ifdef CUTWATER_EXPERIMENT
  cw_hash_bytes(hash, &cw_policy, sizeof cw_policy);
#endif
}
