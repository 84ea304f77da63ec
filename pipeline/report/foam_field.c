// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/foam_field.h"

#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

// A place in the file. Words are read up to a limit; lists are skipped by their length, whatever bytes they hold.
typedef struct {
  const char *path, *at, *end;
} Reader;

enum { WORD_SIZE = 256 };

// The next word: one of { } ; ( ), or all up to a blank or one of these; "" at the end.
static void next_word(Reader *reader, char word[WORD_SIZE]) {
  int length = 0;
  while (reader->at < reader->end && isspace((unsigned char)*reader->at)) reader->at++;
  while (reader->at < reader->end && length < WORD_SIZE - 1 && !isspace((unsigned char)*reader->at)) {
    int bracket = strchr("{};()", *reader->at) != NULL;
    if (bracket && length) break;
    word[length++] = *reader->at++;
    if (bracket) break;
  }
  word[length] = '\0';
}

static CwStatus expect(Reader *reader, const char *wanted) {
  char word[WORD_SIZE];
  next_word(reader, word);
  return !strcmp(word, wanted)
             ? CW_OK
             : CW_FAIL(CW_ERR_INPUT, "%s: '%s' stands where '%s' must; it is no whole field of OpenFOAM", reader->path,
                       word, wanted);
}

// Behind "List<...>": the number of items, and these in brackets; `bytes` at the first, NULL where there is none.
static CwStatus read_list(Reader *reader, const char *type, int scalar_size, CwFoamValues *values) {
  CwStatus status = CW_OK;
  char word[WORD_SIZE], *end;
  int components = !strcmp(type, "List<vector>") ? 3 : !strcmp(type, "List<scalar>") ? 1 : 0;
  CW_REQUIRE(components, CW_ERR_INPUT, "%s: a %s; allowed: List<scalar> or List<vector>", reader->path, type);
  next_word(reader, word);
  values->count = strtoll(word, &end, 10);
  CW_REQUIRE(*word && !*end && values->count >= 0, CW_ERR_INPUT, "%s: a list of '%s' items; allowed: a number from 0",
             reader->path, word);
  int64_t room = (reader->end - reader->at) / (components * scalar_size);
  CW_REQUIRE(values->count <= room, CW_ERR_IO, "%s: is cut short: it has no room for %lld values", reader->path,
             (long long)values->count);
  if (values->count == 0 && reader->at < reader->end && *reader->at != '(') goto done;
  CW_TRY(expect(reader, "("));
  values->bytes = reader->at;
  reader->at += values->count * components * scalar_size;
  CW_TRY(expect(reader, ")"));
done:
  return status;
}

static CwStatus read_uniform(Reader *reader, int components, CwFoamValues *values) {
  CwStatus status = CW_OK;
  char word[WORD_SIZE], *end;
  if (components > 1) CW_TRY(expect(reader, "("));
  for (int i = 0; i < components; i++) {
    next_word(reader, word);
    values->uniform[i] = strtod(word, &end);
    CW_REQUIRE(*word && !*end, CW_ERR_INPUT, "%s: '%s' is no number", reader->path, word);
  }
  if (components > 1) CW_TRY(expect(reader, ")"));
done:
  return status;
}

// Behind the keyword: `uniform V` or `nonuniform List<T> N(...)`.
static CwStatus read_values(Reader *reader, const CwFoamField *field, CwFoamValues *values) {
  CwStatus status = CW_OK;
  char word[WORD_SIZE];
  next_word(reader, word);
  if (!strcmp(word, "uniform")) {
    CW_TRY(read_uniform(reader, field->components, values));
  } else {
    CW_REQUIRE(!strcmp(word, "nonuniform"), CW_ERR_INPUT, "%s: values are '%s'; allowed: uniform, nonuniform",
               reader->path, word);
    next_word(reader, word);
    CW_REQUIRE(!strcmp(word, field->components == 3 ? "List<vector>" : "List<scalar>"), CW_ERR_INPUT,
               "%s: its values are a %s; allowed: %s", reader->path, word,
               field->components == 3 ? "List<vector>" : "List<scalar>");
    CW_TRY(read_list(reader, word, field->scalar_size, values));
  }
  CW_TRY(expect(reader, ";"));
done:
  return status;
}

// The dictionary of one patch, from its brace on: of its entries `value` is kept, others are passed over.
static CwStatus read_patch(Reader *reader, CwFoamField *field, const char *name) {
  CwStatus status = CW_OK;
  char word[WORD_SIZE];
  CwFoamValues values = {0}, other;
  int depth = 1, found = 0, begins = 1; // begins: at the start of an entry
  CW_REQUIRE(strlen(name) < CW_FOAM_NAME_SIZE, CW_ERR_INPUT, "%s: patch '%s'; allowed: a name below %d characters",
             reader->path, name, CW_FOAM_NAME_SIZE);
  snprintf(values.patch, sizeof values.patch, "%s", name);
  while (depth > 0) {
    next_word(reader, word);
    CW_REQUIRE(*word, CW_ERR_IO, "%s: is cut short in patch %s", reader->path, name);
    if (begins && depth == 1 && !strcmp(word, "value")) {
      CW_TRY(read_values(reader, field, &values));
      found = 1;
      continue;
    }
    if (!strncmp(word, "List<", 5)) CW_TRY(read_list(reader, word, field->scalar_size, &other));
    depth += !strcmp(word, "{") ? 1 : !strcmp(word, "}") ? -1 : 0;
    begins = !strcmp(word, ";") || !strcmp(word, "{") || !strcmp(word, "}");
  }
  if (!found) goto done;
  CW_GROW(field->patch, field->patch_capacity, field->patch_count + 1);
  field->patch[field->patch_count++] = values;
done:
  return status;
}

static CwStatus read_header(Reader *reader, CwFoamField *field) {
  CwStatus status = CW_OK;
  static const char *const scalars[] = {"scalar=32", "scalar=64"};
  char text[4096]; // the head is shorter
  size_t length = (size_t)(reader->end - reader->at);
  if (length > sizeof text - 1) length = sizeof text - 1;
  memcpy(text, reader->at, length);
  text[length] = '\0';
  char *head = strstr(text, "FoamFile"), *end = head ? strchr(head, '}') : NULL;
  CW_REQUIRE(end, CW_ERR_INPUT, "%s: has no head of OpenFOAM", reader->path);
  *end = '\0';
  field->components = strstr(head, "volVectorField") ? 3 : strstr(head, "volScalarField") ? 1 : 0;
  CW_REQUIRE(field->components, CW_ERR_INPUT, "%s: its class must be volScalarField or volVectorField", reader->path);
  CW_REQUIRE(strstr(head, "binary"), CW_ERR_INPUT, "%s: must be binary (writeFormat of system/controlDict)",
             reader->path);
  for (int k = 0; k < 2; k++)
    if (strstr(head, scalars[k])) field->scalar_size = 4 << k;
  CW_REQUIRE(field->scalar_size && strstr(head, "LSB"), CW_ERR_INPUT,
             "%s: of another machine; allowed: arch LSB with scalars of 32 or 64 bits", reader->path);
  reader->at += end + 1 - text;
done:
  return status;
}

static CwStatus read_field(Reader *reader, CwFoamField *field) {
  CwStatus status = CW_OK;
  char word[WORD_SIZE];
  CW_TRY(read_header(reader, field));
  do {
    next_word(reader, word);
    CW_REQUIRE(*word, CW_ERR_IO, "%s: has no internalField", reader->path);
  } while (strcmp(word, "internalField"));
  CW_TRY(read_values(reader, field, &field->cells));
  CW_TRY(expect(reader, "boundaryField"));
  CW_TRY(expect(reader, "{"));
  for (next_word(reader, word); strcmp(word, "}"); next_word(reader, word)) {
    CW_REQUIRE(*word, CW_ERR_IO, "%s: is cut short among its patches", reader->path);
    CW_TRY(expect(reader, "{"));
    CW_TRY(read_patch(reader, field, word));
  }
done:
  return status;
}

CwStatus cw_foam_field_open(const char *path, CwFoamField *field) {
  CwStatus status = CW_OK;
  struct stat about;
  int file = open(path, O_RDONLY);
  CW_REQUIRE(file >= 0 && fstat(file, &about) == 0, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  CW_REQUIRE(about.st_size > 0, CW_ERR_IO, "%s: is empty", path);
  field->size = (size_t)about.st_size;
  void *map = mmap(NULL, field->size, PROT_READ, MAP_PRIVATE, file, 0);
  CW_REQUIRE(map != MAP_FAILED, CW_ERR_IO, "%s: cannot be mapped: %s", path, strerror(errno));
  field->map = map;
  CW_TRY(read_field(&(Reader){path, field->map, field->map + field->size}, field));
done:
  if (file >= 0) close(file);
  return status;
}

void cw_foam_field_close(CwFoamField *field) {
  if (field->map) munmap(field->map, field->size);
  free(field->patch);
  *field = (CwFoamField){0};
}

const CwFoamValues *cw_foam_field_patch(const CwFoamField *field, const char *patch) {
  for (int k = 0; k < field->patch_count; k++)
    if (!strcmp(field->patch[k].patch, patch)) return &field->patch[k];
  return NULL;
}

void cw_foam_field_value(const CwFoamField *field, const CwFoamValues *values, int64_t index, double *value) {
  for (int i = 0; i < field->components; i++) {
    if (!values->bytes) {
      value[i] = values->uniform[i];
      continue;
    }
    const char *at = values->bytes + (index * field->components + i) * field->scalar_size;
    float single;
    if (field->scalar_size == 8) {
      memcpy(&value[i], at, 8);
    } else {
      memcpy(&single, at, 4);
      value[i] = single;
    }
  }
}
