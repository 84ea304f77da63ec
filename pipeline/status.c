// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/status.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Per thread: a message belongs to the call chain that failed, and bridges may run worker threads.
static _Thread_local CwFailure failure;

const char *cw_status_text(CwStatus status) {
  switch (status) {
#define CW_STATUS_TEXT(name, value, text)                                                                              \
  case name:                                                                                                           \
    return text;
    CW_STATUS_LIST(CW_STATUS_TEXT)
#undef CW_STATUS_TEXT
  }
  return "unknown status";
}

// A library that ran out of memory says so by another name, or has caught its own exception.
static int is_for_memory(CwStatus code) {
  return errno == ENOMEM && code > CW_OK && code != CW_ERR_USAGE && code != CW_ERR_MEMORY && code != CW_ERR_RANK;
}

CwStatus cw_fail_at(const char *source_file, int line, const char *function, CwStatus code, const char *format, ...) {
  // Formatted aside first: an argument may be the old message itself.
  char fresh[sizeof failure.message];
  int used = 0;
  va_list arguments;
  if (is_for_memory(code)) {
    code = CW_ERR_MEMORY;
    used = snprintf(fresh, sizeof fresh, "out of memory: ");
  }
  va_start(arguments, format);
  vsnprintf(fresh + used, sizeof fresh - (size_t)used, format, arguments);
  va_end(arguments);
  memcpy(failure.message, fresh, sizeof failure.message);
  failure.trace[0] = '\0';
  cw_fail_passed(source_file, line, function);
  return code;
}

CwFailure *cw_failure(void) {
  return &failure;
}

const char *cw_fail_message(void) {
  return failure.message;
}

const char *cw_fail_trace(void) {
  return failure.trace;
}

void cw_fail_passed(const char *source_file, int line, const char *function) {
  size_t used = strlen(failure.trace);
  snprintf(failure.trace + used, sizeof failure.trace - used, "%s%s:%d %s", used ? " < " : "", source_file, line,
           function);
}

void cw_fail_place(const char *place) {
  char fresh[sizeof failure.message];
  if (!strncmp(failure.message, place, strlen(place))) return;
  snprintf(fresh, sizeof fresh, "%s: ", place);
  size_t used = strlen(fresh);
  memcpy(fresh + used, failure.message, sizeof fresh - used);
  fresh[sizeof fresh - 1] = '\0';
  memcpy(failure.message, fresh, sizeof failure.message);
}

void cw_fail_clear(void) {
  failure.message[0] = failure.trace[0] = '\0';
}
