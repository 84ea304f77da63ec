// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/cad/face_table.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMN_DOMAIN, COLUMN_FACE, COLUMN_PATCH, COLUMN_KIND, COLUMN_NAME, COLUMN_COUNT };

static const char *const header_line = "domain,face,patch,kind,name";

// Splits in place; returns the number of columns found (at most one more than wanted).
static int split(char *line, char *column[COLUMN_COUNT]) {
  int count = 0;
  for (char *rest = line; rest;) {
    char *comma = strchr(rest, ',');
    if (comma) *comma = '\0';
    if (count == COLUMN_COUNT) return count + 1;
    column[count++] = rest;
    rest = comma ? comma + 1 : NULL;
  }
  return count;
}

static CwStatus check_name(const char *path, int line, const char *what, const char *name) {
  CwStatus status = CW_OK;
  size_t length = strlen(name);
  CW_REQUIRE(length > 0 && length < CW_NAME_SIZE, CW_ERR_INPUT,
             "%s:%d: %s '%s' has %zu characters; allowed are 1 to %d", path, line, what, name, length,
             CW_NAME_SIZE - 1);
done:
  return status;
}

static CwStatus find_patch(const char *path, int line, const char *name, const char *kind, CwFaceTable *table,
                           int *patch) {
  CwStatus status = CW_OK;
  int kind_index = 0;
  while (kind_index < CW_PATCH_KINDS && strcmp(kind, cw_patch_kind_name((CwPatchKind)kind_index)) != 0) kind_index++;
  CW_REQUIRE(kind_index < CW_PATCH_KINDS, CW_ERR_INPUT,
             "%s:%d: kind '%s' is unknown; allowed are wall, inlet, outlet, interface and symmetry", path, line, kind);
  CW_TRY(check_name(path, line, "patch", name));
  for (int p = 0; p < table->patch_count; p++) {
    if (strcmp(table->patch[p].name, name) != 0) continue;
    CW_REQUIRE((int)table->patch[p].kind == kind_index, CW_ERR_INPUT,
               "%s:%d: patch '%s' is of kind '%s' here and '%s' above; a patch has one kind", path, line, name, kind,
               cw_patch_kind_name(table->patch[p].kind));
    *patch = p;
    goto done;
  }
  *patch = table->patch_count++; // never more patches than faces, each face has one row
  strcpy(table->patch[*patch].name, name);
  table->patch[*patch].kind = (CwPatchKind)kind_index;
done:
  return status;
}

static CwStatus read_row(const char *path, int line, const char *domain, char *text, CwFaceTable *table) {
  CwStatus status = CW_OK;
  char *column[COLUMN_COUNT], *end = NULL;
  int count = split(text, column);
  CW_REQUIRE(count == COLUMN_COUNT, CW_ERR_INPUT, "%s:%d: the row has %s than 5 columns; they are %s", path, line,
             count < COLUMN_COUNT ? "fewer" : "more", header_line);
  if (strcmp(column[COLUMN_DOMAIN], domain) != 0) goto done;

  long face = strtol(column[COLUMN_FACE], &end, 10);
  CW_REQUIRE(end != column[COLUMN_FACE] && *end == '\0' && face >= 1 && face <= table->face_count, CW_ERR_INPUT,
             "%s:%d: face '%s' is wrong; %s has faces 1 to %d", path, line, column[COLUMN_FACE], domain,
             table->face_count);
  CwFaceRow *row = &table->face[face - 1];
  CW_REQUIRE(row->patch < 0, CW_ERR_INPUT, "%s:%d: face %ld of %s is named a second time; each face has one row", path,
             line, face, domain);
  CW_TRY(check_name(path, line, "name", column[COLUMN_NAME]));
  CW_TRY(find_patch(path, line, column[COLUMN_PATCH], column[COLUMN_KIND], table, &row->patch));
  strcpy(row->name, column[COLUMN_NAME]);
done:
  return status;
}

CwStatus cw_face_table_read(const char *path, const char *domain, int face_count, CwFaceTable *table) {
  CwStatus status = CW_OK;
  FILE *file = NULL;
  char *text = NULL;
  size_t size = 0;
  int line = 0;
  memset(table, 0, sizeof *table);
  table->face_count = face_count;
  CW_NEW(table->face, face_count);
  CW_NEW(table->patch, face_count);
  for (int f = 0; f < face_count; f++) table->face[f].patch = -1;

  file = fopen(path, "r");
  CW_REQUIRE(file, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  while (getline(&text, &size, file) >= 0) {
    line++;
    text[strcspn(text, "\r\n")] = '\0';
    if (line == 1) {
      CW_REQUIRE(strcmp(text, header_line) == 0, CW_ERR_INPUT, "%s:1: the header is '%s'; it must be '%s'", path, text,
                 header_line);
    } else if (text[0] != '\0') {
      CW_TRY(read_row(path, line, domain, text, table));
    }
  }
  CW_REQUIRE(!ferror(file), CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
  for (int f = 0; f < face_count; f++) {
    CW_REQUIRE(table->face[f].patch >= 0, CW_ERR_INPUT, "%s: face %d of %s has no row; each of its %d faces needs one",
               path, f + 1, domain, face_count);
  }
done:
  free(text);
  if (file) fclose(file);
  if (status != CW_OK) cw_face_table_free(table);
  return status;
}

void cw_face_table_free(CwFaceTable *table) {
  free(table->face);
  free(table->patch);
  memset(table, 0, sizeof *table);
}
