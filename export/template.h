// SPDX-License-Identifier: AGPL-3.0-or-later
// Text files with @key@ in place of the values of a case. The files of export/templates are built into the
// program.
#pragma once

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

// Sets a value to "", to which texts (printf style) are then appended, or built-in files without their first line (the
// licence), filled with the values: blocks of which a case has as many as its mesh has domains, patches or interfaces.
// What is appended to must be started; cw_values_set_file() starts it. CW_ERR_EXPORT where there is no such file, or a
// key in it has no value.
CwStatus cw_values_start(CwValues *values, const char *key);
CwStatus cw_values_append(CwValues *values, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
CwStatus cw_values_append_file(CwValues *values, const char *key, const char *path);
CwStatus cw_values_set_file(CwValues *values, const char *key, const char *path);

// The value of a key, or NULL.
const char *cw_values_get(const CwValues *values, const char *key);
void cw_values_free(CwValues *values);

// The text with every @key@ replaced, as a new string. CW_ERR_EXPORT where a key has no value; `name` says
// whose text it is.
CwStatus cw_template_fill(const char *name, const char *text, const CwValues *values, char **filled);

// Sets the values that follow from the name of a file.
typedef CwStatus (*CwValuesOfFile)(const char *name, CwValues *values);

// Writes, filled, every built-in file whose path goes on behind `prefix` by a '/' or a '.', with `to` in the place of
// that: "openfoam" is a folder, "cfx/steady" a name with several endings. Makes folders where needed. `of_file`: NULL:
// no such values. CW_ERR_EXPORT, CW_ERR_IO.
CwStatus cw_templates_write(const char *prefix, const char *to, CwValuesOfFile of_file, CwValues *values);

// Writes a text to a new file. CW_ERR_IO.
CwStatus cw_text_write(const char *path, const char *text, int executable);
