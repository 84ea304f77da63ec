// SPDX-License-Identifier: AGPL-3.0-or-later
// What binds the files of a run together. The record of a stage holds a digest of each file that it wrote for others
// ("files"), one of the files of each stage that it read ("made_from"), and those of files of the user's ("inputs"). So
// a stage sees files that are damaged, replaced by hand, or newer than what was made of them, whatever their time
// stamps say.
#pragma once

#include <jansson.h>

#include "pipeline/hash.h"
#include "pipeline/status.h"

// Holds the files of RUN/STAGE, and those it was made from, against its record. CW_ERR_IO where one is missing or not
// as it was written, CW_ERR_INPUT where the stage was made from other files than lie there. Files of the user's may be
// missing: a run goes on elsewhere without them.
CwStatus cw_stage_files_check(const char *run, const char *stage);

// The first half, of the files, with a record that has been read, and another way to digest a file, which is called for
// each one in the order of the record. `given` goes to `digest_of`.
typedef CwStatus (*CwDigestOf)(void *given, const char *path, char digest[CW_HASH_TEXT]);
CwStatus cw_stage_files_check_by(const char *run, const char *stage, json_t *record, CwDigestOf digest_of, void *given);

// The second half, which reads records and no files: whether the stage was made from what lies there.
CwStatus cw_stage_files_source_check(const char *run, const char *stage, json_t *record);

// For the record: by name the digest of the files of each stage, as its record tells of them. `stages` ends with NULL.
// CW_ERR_IO, CW_ERR_INPUT, CW_ERR_MEMORY.
CwStatus cw_stage_files_read(const char *run, const char *const *stages, json_t **made_from);
