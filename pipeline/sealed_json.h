// SPDX-License-Identifier: AGPL-3.0-or-later
// JSON files that carry their own digest: the last member, "digest", is of all bytes before it.
#pragma once

#include <jansson.h>

#include "pipeline/status.h"

// How all JSON files are written: two blanks a level, and numbers with as many digits as bring every bit back.
#define CW_JSON_FORMAT (JSON_INDENT(2) | JSON_REAL_PRECISION(17))

// Writes an object whole, keys in the order they were set. CW_ERR_IO, CW_ERR_MEMORY.
CwStatus cw_sealed_json_write(const json_t *object, const char *path);

// Reads it. CW_ERR_IO where it cannot be read or is not as it was written; CW_ERR_INPUT where it is no such file. Free
// with json_decref.
CwStatus cw_sealed_json_read(const char *path, json_t **object);
