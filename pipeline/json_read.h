// SPDX-License-Identifier: AGPL-3.0-or-later
// Reading the stages' JSON files with one clear line for what is not there.
#pragma once

#include <jansson.h>

#include "pipeline/status.h"

// Reads a file whose top is an object. CW_ERR_IO where it cannot be read, CW_ERR_INPUT with line and column
// where it is no JSON. Free with json_decref.
CwStatus cw_json_read(const char *path, json_t **root);

// Fetch a member of `object`; `where` names the object for the message ("mesh/record.json: results").
// CW_ERR_INPUT where it is missing or of another type. What is fetched belongs to the object.
CwStatus cw_json_object(json_t *object, const char *where, const char *key, json_t **value);
CwStatus cw_json_array(json_t *object, const char *where, const char *key, json_t **value);
CwStatus cw_json_text(json_t *object, const char *where, const char *key, const char **value);
CwStatus cw_json_count(json_t *object, const char *where, const char *key, int64_t *value); // not negative

CwStatus cw_json_positive(json_t *object, const char *where, const char *key, double *value); // above 0

// A number, or NAN where there is none (null, missing, another type).
double cw_json_real(const json_t *object, const char *key);
