// SPDX-License-Identifier: AGPL-3.0-or-later
// record.json of a stage: what it did, how long it took, what it warned of, and its results for the report.
// The format is in docs/file-formats.md.
#pragma once

#include <jansson.h>
#include <stdint.h>

#include "pipeline/case.h"
#include "pipeline/log.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CwRecord CwRecord;

// Starts the record of `stage` and its clock. [in] log: outlives the record, which tells its warnings; may be NULL.
// [out] record: free with cw_record_free.
CwStatus cw_record_start(const char *stage, const CwLog *log, CwRecord **record);
void cw_record_free(CwRecord *record);

// Adds a step that is over: `items` of `unit` ("faces", "cells") in `seconds`. Steps stay in the order of the
// calls.
CwStatus cw_record_step(CwRecord *record, const char *name, double seconds, int64_t items, const char *unit);

// Sets the peak memory to write, such as the sum over the ranks; without it that of this process is written.
void cw_record_set_peak_memory(CwRecord *record, int64_t bytes);

// Keeps of which case the stage's files are made (case_origin.h).
CwStatus cw_record_case(CwRecord *record, const CwCase *table);

// Keeps from which files of earlier stages (stage_files.h): called before they are read. `stages` ends with NULL.
CwStatus cw_record_made_from(CwRecord *record, const char *run, const char *const *stages);

// Keeps the digest of a file of the user's that the stage reads, by its absolute path (stage_files.h): called before it
// is read. CW_ERR_IO.
CwStatus cw_record_input(CwRecord *record, const char *path);

// Keeps the digest of FOLDER/NAME, a file that the stage has written for others; or one that is known.
CwStatus cw_record_file(CwRecord *record, const char *folder, const char *name);
CwStatus cw_record_file_digest(CwRecord *record, const char *name, const char *digest);

// Set one result. A number that is not finite becomes null. Keys keep the order of their first setting.
CwStatus cw_record_number(CwRecord *record, const char *key, double value);
CwStatus cw_record_integer(CwRecord *record, const char *key, int64_t value);

// Sets one result to any JSON value and takes over the reference, also on failure. NULL fails with
// CW_ERR_MEMORY.
CwStatus cw_record_json(CwRecord *record, const char *key, json_t *value);

// Writes the record whole and with its own digest (sealed_json.h): the seconds since cw_record_start and the warnings
// of the log first.
CwStatus cw_record_write(const CwRecord *record, const char *path);

// A JSON number; null for NAN and infinities, which JSON does not know.
json_t *cw_json_number(double value);

// Writes any JSON value whole, two blanks a level, keys in the order they were set.
CwStatus cw_json_write(const json_t *value, const char *path);

#ifdef __cplusplus
}
#endif
