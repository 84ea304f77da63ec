// SPDX-License-Identifier: AGPL-3.0-or-later
// The case file as a stream of YAML events, each with its place. Events and not a document, since only events show a
// key that is given twice.
#pragma once

#include <libfyaml.h>

#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_EVENT_TEXT_SIZE = 256 };

typedef struct {
  int line, column; // 1-based
} CwEventPlace;

typedef struct {
  enum fy_event_type type;
  int plain, tagged;
  CwEventPlace place;
  char text[CW_EVENT_TEXT_SIZE]; // of a scalar; of a longer one its beginning
} CwEvent;

typedef struct {
  const char *path; // as messages show it
  struct fy_parser *parser;
  struct fy_diag *diag;
  CwEventPlace last;   // of the newest event
  char complaint[500]; // the library's first "LINE:COLUMN: error: text"
} CwEventStream;

// Reads `text`, which must outlive the stream, as must the stream stay where it is. Close also after a failure.
CwStatus cw_event_stream_open(const char *path, const char *text, size_t length, CwEventStream *stream);
void cw_event_stream_close(CwEventStream *stream);

// The next event. Fails with CW_ERR_INPUT where the text is not YAML.
CwStatus cw_event_next(CwEventStream *stream, CwEvent *event);

// The next key of a mapping that messages call `path`; an event of type FYET_MAPPING_END behind the last. CW_ERR_INPUT
// also where a key is no scalar.
CwStatus cw_event_next_key(CwEventStream *stream, const char *path, CwEvent *key);

// "a mapping", "a list": for messages.
const char *cw_event_words(enum fy_event_type type);

#ifdef __cplusplus
}
#endif
