// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_event.h"

#include <stdio.h>
#include <string.h>

static void keep_complaint(struct fy_diag *diag, void *user, const char *text, size_t length) {
  CwEventStream *stream = user;
  if (stream->complaint[0] || !memmem(text, length, ": error: ", 9)) return;
  snprintf(stream->complaint, sizeof stream->complaint, "%.*s", (int)length, text);
}

// Turns "NAME:LINE:COLUMN: error: text" of the library into our line. The name holds no colon of its own.
static CwStatus fail_syntax(const CwEventStream *stream) {
  int line = 1, column = 1;
  const char *what = strstr(stream->complaint, ": error: ");
  const char *numbers = strchr(stream->complaint, ':');
  if (!what || !numbers || sscanf(numbers, ":%d:%d", &line, &column) != 2)
    return CW_FAIL(CW_ERR_INPUT, "%s:1:1: case file: it is not YAML; allowed: YAML as in docs/case-reference.md",
                   stream->path);
  what += strlen(": error: ");
  return CW_FAIL(CW_ERR_INPUT,
                 "%s:%d:%d: case file: it is not YAML, %.*s; allowed: one \"key: value\" a line, sections "
                 "indented by blanks",
                 stream->path, line, column, (int)strcspn(what, "\r\n"), what);
}

CwStatus cw_event_next(CwEventStream *stream, CwEvent *event) {
  CwStatus status = CW_OK;
  memset(event, 0, sizeof *event);
  struct fy_event *raw = fy_parser_parse(stream->parser);
  if (!raw) {
    status = fail_syntax(stream);
    goto done;
  }
  event->type = raw->type;
  const struct fy_mark *mark = fy_event_start_mark(raw);
  // An empty key or value has no mark: it lies behind what came before.
  event->place = mark ? (CwEventPlace){mark->line + 1, mark->column + 1} : stream->last;
  event->tagged = fy_event_get_tag_token(raw) != NULL;
  if (raw->type == FYET_SCALAR) {
    size_t length = 0;
    const char *text = raw->scalar.value ? fy_token_get_text(raw->scalar.value, &length) : "";
    if (!text) length = 0;
    // A value that is cut here is longer than any that is allowed, so it is refused all the same.
    if (length >= CW_EVENT_TEXT_SIZE) length = CW_EVENT_TEXT_SIZE - 1;
    memcpy(event->text, text ? text : "", length);
    // An escape in quotes can make any character; behind a zero byte nothing may hide.
    for (size_t i = 0; i < length; ++i)
      if (!event->text[i]) event->text[i] = '?';
    enum fy_scalar_style style = raw->scalar.value ? fy_token_scalar_style(raw->scalar.value) : FYSS_PLAIN;
    event->plain = style == FYSS_PLAIN;
    // The library's mark stands behind the opening quote, and behind the star of an alias.
    if (style == FYSS_SINGLE_QUOTED || style == FYSS_DOUBLE_QUOTED) --event->place.column;
  }
  if (raw->type == FYET_ALIAS) --event->place.column;
  stream->last = event->place;
done:
  if (raw) fy_parser_event_free(stream->parser, raw);
  return status;
}

CwStatus cw_event_next_key(CwEventStream *stream, const char *path, CwEvent *key) {
  CwStatus status = CW_OK;
  CW_TRY(cw_event_next(stream, key));
  CW_REQUIRE(key->type == FYET_SCALAR || key->type == FYET_MAPPING_END, CW_ERR_INPUT,
             "%s:%d:%d: %s: a key is %s; allowed: a plain word", stream->path, key->place.line, key->place.column, path,
             cw_event_words(key->type));
done:
  return status;
}

const char *cw_event_words(enum fy_event_type type) {
  switch (type) {
  case FYET_MAPPING_START:
    return "a mapping";
  case FYET_SEQUENCE_START:
    return "a list";
  case FYET_ALIAS:
    return "an alias (*name)";
  default:
    return "something else";
  }
}

CwStatus cw_event_stream_open(const char *path, const char *text, size_t length, CwEventStream *stream) {
  CwStatus status = CW_OK;
  struct fy_diag_cfg diag_settings;
  *stream = (CwEventStream){.path = path, .last = {1, 1}};
  fy_diag_cfg_default(&diag_settings);
  diag_settings.fp = NULL;
  diag_settings.output_fn = keep_complaint;
  diag_settings.user = stream;
  diag_settings.colorize = false;
  stream->diag = fy_diag_create(&diag_settings);
  CW_REQUIRE(stream->diag, CW_ERR_MEMORY, "out of memory: the reader of %s", path);
  struct fy_parse_cfg settings = {.flags = FYPCF_DEFAULT_PARSE | FYPCF_JSON_NONE, .diag = stream->diag};
  stream->parser = fy_parser_create(&settings);
  CW_REQUIRE(stream->parser && !fy_parser_set_string(stream->parser, text, length), CW_ERR_LIBRARY,
             "%s: libfyaml cannot start", path);
done:
  return status;
}

void cw_event_stream_close(CwEventStream *stream) {
  if (stream->parser) fy_parser_destroy(stream->parser);
  if (stream->diag) fy_diag_destroy(stream->diag);
  stream->parser = NULL;
  stream->diag = NULL;
}
