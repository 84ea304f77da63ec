// SPDX-License-Identifier: AGPL-3.0-or-later
#include "export/template.h"

#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "export/folder.h"
#include "pipeline/atomic_file.h"

CwStatus cw_values_set(CwValues *values, const char *key, const char *format, ...) {
  CwStatus status = CW_OK;
  va_list arguments;
  CwValue *grown = realloc(values->list, (size_t)(values->count + 1) * sizeof *grown);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory");
  values->list = grown;
  grown[values->count] = (CwValue){0};
  CW_REQUIRE((grown[values->count].key = strdup(key)), CW_ERR_MEMORY, "out of memory");
  va_start(arguments, format);
  int length = vasprintf(&grown[values->count].value, format, arguments);
  va_end(arguments);
  if (length < 0) free(grown[values->count].key);
  CW_REQUIRE(length >= 0, CW_ERR_MEMORY, "out of memory");
  ++values->count;
done:
  return status;
}

CwStatus cw_values_start(CwValues *values, const char *key) {
  return cw_values_set(values, key, "%s", "");
}

static CwValue *find_value(const CwValues *values, const char *key, size_t length) {
  for (int i = values->count - 1; i >= 0; --i)
    if (strlen(values->list[i].key) == length && strncmp(values->list[i].key, key, length) == 0)
      return &values->list[i];
  return NULL;
}

const char *cw_values_get(const CwValues *values, const char *key) {
  const CwValue *found = find_value(values, key, strlen(key));
  return found ? found->value : NULL;
}

CwStatus cw_values_append(CwValues *values, const char *key, const char *format, ...) {
  CwStatus status = CW_OK;
  CwValue *value = find_value(values, key, strlen(key));
  char *more = NULL, *whole = NULL;
  va_list arguments;
  va_start(arguments, format);
  if (vasprintf(&more, format, arguments) < 0) more = NULL;
  va_end(arguments);
  CW_REQUIRE(more && asprintf(&whole, "%s%s", value->value, more) >= 0, CW_ERR_MEMORY, "out of memory");
  free(value->value);
  value->value = whole;
done:
  free(more);
  return status;
}

static const CwTemplate *find_template(const char *path) {
  for (int i = 0; i < cw_template_count; ++i)
    if (strcmp(cw_templates[i].path, path) == 0) return &cw_templates[i];
  return NULL;
}

CwStatus cw_values_append_file(CwValues *values, const char *key, const char *path) {
  CwStatus status = CW_OK;
  char *filled = NULL;
  const CwTemplate *file = find_template(path);
  CW_REQUIRE(file, CW_ERR_EXPORT, "no template %s", path);
  CW_TRY(cw_template_fill(path, strchr(file->text, '\n') + 1, values, &filled));
  CW_TRY(cw_values_append(values, key, "%s", filled));
done:
  free(filled);
  return status;
}

CwStatus cw_values_set_file(CwValues *values, const char *key, const char *path) {
  const CwStatus status = cw_values_start(values, key);
  return status == CW_OK ? cw_values_append_file(values, key, path) : status;
}

void cw_values_free(CwValues *values) {
  for (int i = 0; i < values->count; ++i) {
    free(values->list[i].key);
    free(values->list[i].value);
  }
  free(values->list);
  memset(values, 0, sizeof *values);
}

CwStatus cw_template_fill(const char *name, const char *text, const CwValues *values, char **filled) {
  CwStatus status = CW_OK;
  size_t size = 0;
  FILE *out = open_memstream(filled, &size);
  CW_REQUIRE(out, CW_ERR_MEMORY, "out of memory");
  while (*text) {
    size_t length = 0;
    if (*text == '@')
      while (islower((unsigned char)text[1 + length]) || text[1 + length] == '_') ++length;
    if (length == 0 || text[1 + length] != '@') {
      fputc(*text++, out);
      continue;
    }
    const CwValue *found = find_value(values, text + 1, length);
    CW_REQUIRE(found, CW_ERR_EXPORT, "%s: no value for @%.*s@", name, (int)length, text + 1);
    fputs(found->value, out);
    text += length + 2;
  }
done:
  if (out && fclose(out) != 0 && status == CW_OK) status = CW_FAIL(CW_ERR_MEMORY, "out of memory");
  if (status != CW_OK && out) {
    free(*filled);
    *filled = NULL;
  }
  return status;
}

CwStatus cw_text_write(const char *path, const char *text, int executable) {
  CwStatus status = CW_OK;
  FILE *out = fopen(path, "w");
  CW_REQUIRE(out, CW_ERR_IO, "%s: cannot be written: %s", path, strerror(errno));
  fputs(text, out);
  int failed = ferror(out);
  failed |= fclose(out);
  CW_REQUIRE(!failed && (!executable || chmod(path, 0755) == 0), CW_ERR_IO, "%s: cannot be written: %s", path,
             strerror(errno));
done:
  return status;
}

static CwStatus write_filled(const CwTemplate *built_in, const char *path, const CwValues *values) {
  CwStatus status = CW_OK;
  char *text = NULL;
  CW_TRY(cw_template_fill(built_in->path, built_in->text, values, &text));
  CW_TRY(cw_text_write(path, text, built_in->executable));
done:
  free(text);
  return status;
}

CwStatus cw_templates_write(const char *prefix, const char *to, CwValuesOfFile of_file, CwValues *values) {
  CwStatus status = CW_OK;
  const size_t length = strlen(prefix);
  char *path = NULL;
  for (int i = 0; i < cw_template_count; ++i) {
    const CwTemplate *t = &cw_templates[i];
    if (strncmp(t->path, prefix, length) != 0 || strspn(t->path + length, "/.") == 0) continue;
    CW_TRY(cw_path_set(&path, "%s%s", to, t->path + length));
    char *slash = strrchr(path, '/');
    *slash = '\0';
    CW_TRY(cw_make_directory(path));
    *slash = '/';
    if (of_file) CW_TRY(of_file(slash + 1, values));
    CW_TRY(write_filled(t, path, values));
  }
done:
  free(path);
  return status;
}
