// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_read.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "pipeline/case_cad.h"
#include "pipeline/case_check.h"
#include "pipeline/case_event.h"
#include "pipeline/case_fluid.h"
#include "pipeline/case_schema.h"
#include "pipeline/case_value.h"

enum { FILE_LIMIT = 1 << 20, PATH_SHOWN = 300 };

typedef struct {
  CwEventStream stream;
  const char *case_path;
  CwEventPlace root; // of the mapping that is the file
  CwCasePlace cad;   // of the section cad
  CwCase table;
  CwCasePlace *places;   // one a key
  CwCasePlace *sections; // one a key: the place of the section that begins with that key
} Reader;

static CwStatus require_once(const Reader *reader, const char *path, CwCasePlace *found, CwEventPlace key,
                             CwEventPlace value) {
  CwStatus status = CW_OK;
  CW_REQUIRE(!found->given, CW_ERR_INPUT, "%s:%d:%d: %s: given twice, first in line %d; allowed: once",
             reader->stream.path, key.line, key.column, path, found->line);
  *found = (CwCasePlace){1, value.line, value.column};
done:
  return status;
}

// Reads one value of key `index`, of a list one of its values.
static CwStatus read_value(Reader *reader, int index, const CwUnit *unit, const char *path, const CwEvent *value) {
  CwStatus status = CW_OK;
  char wrong[CW_WRONG_SIZE], allowed[CW_KEY_ALLOWED_SIZE];
  cw_case_key_allowed(&cw_case_keys[index], allowed);
  CW_REQUIRE(value->type == FYET_SCALAR, CW_ERR_INPUT, "%s:%d:%d: %s: it is %s, not one value; allowed: %s",
             reader->stream.path, value->place.line, value->place.column, path, cw_event_words(value->type), allowed);
  CW_REQUIRE(!value->tagged, CW_ERR_INPUT, "%s:%d:%d: %s: it has a tag (!...); allowed: without tag, %s",
             reader->stream.path, value->place.line, value->place.column, path, allowed);
  CW_REQUIRE(cw_case_value_read(&cw_case_keys[index], unit, value->text, value->plain, &reader->table, wrong),
             CW_ERR_INPUT, "%s:%d:%d: %s: %s", reader->stream.path, value->place.line, value->place.column, path,
             wrong);
done:
  return status;
}

static CwStatus read_list(Reader *reader, int index, const CwUnit *unit, const char *path) {
  CwStatus status = CW_OK;
  CwEvent value;
  char allowed[CW_KEY_ALLOWED_SIZE];
  for (int count = 0;; ++count) {
    CW_TRY(cw_event_next(&reader->stream, &value));
    cw_case_key_allowed(&cw_case_keys[index], allowed);
    int ends = value.type == FYET_SEQUENCE_END;
    CW_REQUIRE(ends ? count > 0 : count < CW_LIST_MOST, CW_ERR_INPUT, "%s:%d:%d: %s: the list has %s; allowed: %s",
               reader->stream.path, value.place.line, value.place.column, path, ends ? "no value" : "too many values",
               allowed);
    if (ends) break;
    CW_TRY(read_value(reader, index, unit, path, &value));
  }
done:
  return status;
}

// Reads the pair of `key` (a scalar) and `value` that stand in `section`. The value has been taken from the
// stream.
static CwStatus read_pair(Reader *reader, const char *section, const CwEvent *key, CwEvent *value) {
  CwStatus status = CW_OK;
  char wrong[CW_WRONG_SIZE], name[CW_SHOWN_SIZE];
  int scalar = value->type == FYET_SCALAR;
  const CwUnit *unit;
  int index = cw_case_key_find_in(section, key->text, &unit);
  cw_show(key->text, name);
  char path[CW_KEY_PATH_SIZE + CW_SHOWN_SIZE];
  snprintf(path, sizeof path, "%s%s%s", section, section[0] ? "." : "", name);
  if (index < 0) {
    cw_case_key_unknown(section, key->text, scalar ? value->text : NULL, wrong);
    CW_REQUIRE(0, CW_ERR_INPUT, "%s:%d:%d: %s: %s", reader->stream.path, key->place.line, key->place.column, path,
               wrong);
  }
  CW_TRY(require_once(reader, path, &reader->places[index], key->place, value->place));
  reader->table.given[index] = 1;
  const CwCaseKey *known = &cw_case_keys[index];
  if (known->type == CW_KEY_CHOICES) cw_case_key_set(known, 0, &reader->table);
  const int many = known->type == CW_KEY_LIST || known->type == CW_KEY_CHOICES;
  if (many && value->type == FYET_SEQUENCE_START && !value->tagged)
    CW_TRY(read_list(reader, index, unit, path));
  else
    CW_TRY(read_value(reader, index, unit, path, value));
done:
  return status;
}

static CwStatus read_section(Reader *reader, const char *section) {
  CwStatus status = CW_OK;
  CwEvent key, value;
  for (;;) {
    CW_TRY(cw_event_next_key(&reader->stream, section, &key));
    if (key.type == FYET_MAPPING_END) break;
    CW_TRY(cw_event_next(&reader->stream, &value));
    CW_TRY(read_pair(reader, section, &key, &value));
  }
done:
  return status;
}

// The place of a section is kept under its first key.
static CwCasePlace *section_place(const Reader *reader, const char *section) {
  size_t i = 0;
  while (i + 1 < cw_case_key_count && strcmp(cw_case_keys[i].section, section)) ++i;
  return &reader->sections[i];
}

static CwStatus read_cad(Reader *reader, const CwEvent *key, const CwEvent *value) {
  CwStatus status = CW_OK;
  CwCaseNode section = {0};
  CW_TRY(require_once(reader, "cad", &reader->cad, key->place, key->place));
  CW_TRY(cw_case_tree_read(&reader->stream, "cad", value, &section));
  section.place = key->place;
  CW_TRY(cw_case_cad_read(reader->stream.path, reader->case_path, &section, &reader->table.cad));
done:
  cw_case_tree_free(&section);
  return status;
}

static CwStatus read_top(Reader *reader) {
  CwStatus status = CW_OK;
  CwEvent key, value;
  char shown[CW_SHOWN_SIZE];
  for (;;) {
    CW_TRY(cw_event_next_key(&reader->stream, "case file", &key));
    if (key.type == FYET_MAPPING_END) break;
    CW_TRY(cw_event_next(&reader->stream, &value));
    if (!strcmp(key.text, "cad")) {
      CW_TRY(read_cad(reader, &key, &value));
      continue;
    }
    if (!key.text[0] || !cw_case_section_known(key.text)) {
      CW_TRY(read_pair(reader, "", &key, &value));
      continue;
    }
    CW_TRY(require_once(reader, key.text, section_place(reader, key.text), key.place, key.place));
    cw_show(value.text, shown);
    CW_REQUIRE(value.type == FYET_MAPPING_START, CW_ERR_INPUT,
               "%s:%d:%d: %s: %s is not a mapping; allowed: the section's keys, one a line, indented below it",
               reader->stream.path, value.place.line, value.place.column, key.text,
               value.type == FYET_SCALAR ? shown : cw_event_words(value.type));
    CW_TRY(read_section(reader, key.text));
  }
done:
  return status;
}

static CwStatus read_stream(Reader *reader) {
  CwStatus status = CW_OK;
  CwEvent event;
  do CW_TRY(cw_event_next(&reader->stream, &event));
  while (event.type == FYET_STREAM_START || event.type == FYET_DOCUMENT_START);
  CW_REQUIRE(event.type != FYET_STREAM_END, CW_ERR_INPUT,
             "%s:1:1: case file: it is empty; allowed: the keys of docs/case-reference.md", reader->stream.path);
  CW_REQUIRE(event.type == FYET_MAPPING_START, CW_ERR_INPUT,
             "%s:%d:%d: case file: it is not a mapping; allowed: the keys of docs/case-reference.md",
             reader->stream.path, event.place.line ? event.place.line : 1, event.place.line ? event.place.column : 1);
  reader->root = event.place;
  CW_TRY(read_top(reader));
  do CW_TRY(cw_event_next(&reader->stream, &event));
  while (event.type == FYET_DOCUMENT_END);
  CW_REQUIRE(event.type == FYET_STREAM_END, CW_ERR_INPUT,
             "%s:%d:%d: case file: a second document begins; allowed: one document", reader->stream.path,
             event.place.line, event.place.column);
done:
  return status;
}

// Gives keys that were left out the place of their section, and refuses the file where a key is required.
static CwStatus require_all(Reader *reader) {
  CwStatus status = CW_OK;
  char path[CW_KEY_PATH_SIZE], allowed[CW_KEY_ALLOWED_SIZE];
  for (size_t i = 0; i < cw_case_key_count; ++i) {
    const CwCaseKey *key = &cw_case_keys[i];
    CwCasePlace *place = &reader->places[i], *section = section_place(reader, key->section);
    if (place->given) continue;
    place->line = section->given ? section->line : reader->root.line;
    place->column = section->given ? section->column : reader->root.column;
    cw_case_key_path(key, path);
    cw_case_key_allowed(key, allowed);
    CW_REQUIRE(key->presence != CW_KEY_REQUIRED, CW_ERR_INPUT, "%s:%d:%d: %s: the key is missing; allowed: %s",
               reader->stream.path, place->line, place->column, path, allowed);
  }
done:
  return status;
}

// Length of the UTF-8 character at `text` (RFC 3629), 0 when it is none; control characters but tab and line
// ends are none either, for YAML does not allow them.
static size_t utf8_length(const unsigned char *text, size_t left) {
  if (text[0] < 0x20) return text[0] == '\t' || text[0] == '\n' || text[0] == '\r';
  if (text[0] < 0x80) return text[0] != 0x7f;
  size_t length = text[0] < 0xc2 ? 0 : text[0] < 0xe0 ? 2 : text[0] < 0xf0 ? 3 : text[0] < 0xf5 ? 4 : 0;
  if (!length || length > left) return 0;
  for (size_t i = 1; i < length; ++i)
    if ((text[i] & 0xc0) != 0x80) return 0;
  if (text[0] == 0xe0 && text[1] < 0xa0) return 0; // longer than needed
  if (text[0] == 0xed && text[1] > 0x9f) return 0; // half of a surrogate pair
  if (text[0] == 0xf0 && text[1] < 0x90) return 0;
  if (text[0] == 0xf4 && text[1] > 0x8f) return 0; // past U+10FFFF
  return length;
}

static CwStatus require_utf8(const char *path, const char *text, size_t length) {
  CwStatus status = CW_OK;
  int line = 1, column = 1;
  for (size_t i = 0; i < length;) {
    size_t step = utf8_length((const unsigned char *)text + i, length - i);
    CW_REQUIRE(step, CW_ERR_INPUT, "%s:%d:%d: case file: byte 0x%02x is no text; allowed: UTF-8 text", path, line,
               column, (unsigned char)text[i]);
    column = text[i] == '\n' ? 1 : column + 1;
    line += text[i] == '\n';
    i += step;
  }
done:
  return status;
}

static CwStatus read_file(const char *path, const char *shown_path, char **text, size_t *length) {
  CwStatus status = CW_OK;
  struct stat about;
  FILE *file = NULL;
  CW_REQUIRE(!stat(path, &about), CW_ERR_IO, "%s: the case file cannot be read: %s", shown_path, strerror(errno));
  // Every rank reads it: a pipe would serve one of them, and one without a writer would hold all.
  CW_REQUIRE(S_ISREG(about.st_mode), CW_ERR_IO, "%s: this is %s; allowed: a case file in YAML", shown_path,
             S_ISDIR(about.st_mode) ? "a folder" : "no plain file");
  file = fopen(path, "rb");
  CW_REQUIRE(file, CW_ERR_IO, "%s: the case file cannot be read: %s", shown_path, strerror(errno));
  CW_NEW(*text, FILE_LIMIT + 1);
  *length = fread(*text, 1, FILE_LIMIT + 1, file);
  CW_REQUIRE(!ferror(file), CW_ERR_IO, "%s: the case file cannot be read: %s", shown_path, strerror(errno));
  CW_REQUIRE(*length <= FILE_LIMIT, CW_ERR_INPUT, "%s:1:1: case file: it is too large; allowed: at most 1 MiB",
             shown_path);
done:
  if (file) fclose(file);
  return status;
}

void cw_case_free(CwCase *table) {
  cw_case_cad_free(table->cad);
  table->cad = NULL;
}

CwStatus cw_case_read(const char *path, CwCase *table) {
  CwStatus status = CW_OK;
  char *text = NULL, shown_path[PATH_SHOWN + 4];
  size_t length = 0;
  Reader reader = {.case_path = path};
  // A path of thousands of characters would push the rest out of the message.
  size_t path_length = strlen(path);
  int cut = path_length > PATH_SHOWN;
  snprintf(shown_path, sizeof shown_path, "%s%s", cut ? "..." : "", path + (cut ? path_length - PATH_SHOWN : 0));
  cw_case_defaults(&reader.table);
  CW_NEW(reader.places, cw_case_key_count);
  CW_NEW(reader.sections, cw_case_key_count);
  CW_TRY(read_file(path, shown_path, &text, &length));
  CW_TRY(require_utf8(shown_path, text, length));
  CW_TRY(cw_event_stream_open(shown_path, text, length, &reader.stream));
  CW_TRY(read_stream(&reader));
  CW_TRY(require_all(&reader));
  CW_TRY(cw_case_fluid(shown_path, reader.places, &reader.table));
  CW_TRY(cw_case_check(shown_path, &reader.table, reader.places));
  *table = reader.table;
  reader.table.cad = NULL;
done:
  cw_case_free(&reader.table);
  cw_event_stream_close(&reader.stream);
  free(text);
  free(reader.places);
  free(reader.sections);
  return status;
}
