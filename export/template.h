// SPDX-License-Identifier: AGPL-3.0-or-later
// Text files with @key@ in place of the values of a case. The files of export/templates are built into the
// program.
#ifndef CUTWATER_EXPORT_TEMPLATE_H
#define CUTWATER_EXPORT_TEMPLATE_H

#include "pipeline/status.h"

// A built-in file: its path below export/templates, its text, ended by 0, and whether it can be executed.
typedef struct {
  const char *path;
  const char *text;
  int executable;
} CwTemplate;

extern const CwTemplate cw_templates[];
extern const int cw_template_count;

typedef struct {
  char *key, *value;
} CwValue;

typedef struct {
  CwValue *list;
  int count;
} CwValues;

// Sets a value (printf style); a key's last value counts. Values must be freed with cw_values_free().
CwStatus cw_values_set(CwValues *values, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void cw_values_free(CwValues *values);

// The text with every @key@ replaced, as a new string. CW_ERR_EXPORT where a key has no value; `name` says
// whose text it is.
CwStatus cw_template_fill(const char *name, const char *text, const CwValues *values, char **filled);

// The built-in file of that path, or NULL.
const CwTemplate *cw_template_find(const char *path);

// Writes a built-in file, filled, to `path`, whose folder is there. CW_ERR_EXPORT, CW_ERR_IO.
CwStatus cw_template_write(const CwTemplate *built_in, const char *path, const CwValues *values);

// Writes every built-in file below `prefix` ("openfoam/") to `folder`, making folders where needed.
CwStatus cw_templates_write(const char *prefix, const char *folder, const CwValues *values);

// Writes a text to a new file. CW_ERR_IO.
CwStatus cw_text_write(const char *path, const char *text, int executable);

#endif
