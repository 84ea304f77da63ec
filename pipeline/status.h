// SPDX-License-Identifier: AGPL-3.0-or-later
// Status codes and the one error path that every function of Cutwater follows.
//
// A function that can fail returns a CwStatus and keeps one exit:
//
//   CwStatus thing_do(const char *path) {
//     CwStatus status = CW_OK;
//     FILE *file = fopen(path, "r");
//     CW_REQUIRE(file, CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
//     CW_TRY(thing_parse(file));
//   done:
//     if (file) fclose(file);
//     return status;
//   }
//
// The message is one line for a person: what, where (file, line, key, or region, patch, coordinates in mm),
// and what is allowed. Only main() prints it, through cw_log_error() of log.h.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// One list makes the codes, their exit statuses and their texts.
// All but CW_OK are fatal and carry a message.
#define CW_STATUS_LIST(X)                                                                                              \
  X(CW_OK, 0, "fine")                                                                                                  \
  X(CW_ERR_USAGE, 2, "wrong use of the command line")                                                                  \
  X(CW_ERR_INPUT, 3, "wrong input")                                                                                    \
  X(CW_ERR_IO, 4, "a file cannot be read or written")                                                                  \
  X(CW_ERR_MEMORY, 5, "out of memory")                                                                                 \
  X(CW_ERR_DESIGN, 6, "the hydraulic design has no solution")                                                          \
  X(CW_ERR_GEOMETRY, 7, "the geometry cannot be built")                                                                \
  X(CW_ERR_MESH, 8, "the mesh cannot be made")                                                                         \
  X(CW_ERR_EXPORT, 9, "the case cannot be written")                                                                    \
  X(CW_ERR_LIBRARY, 10, "a library failed")                                                                            \
  X(CW_ERR_RANK, 11, "another rank failed")                                                                            \
  X(CW_ERR_FAULT, 12, "a fault of the program")

#define CW_STATUS_ENUM(name, value, text) name = value,
typedef enum { CW_STATUS_LIST(CW_STATUS_ENUM) } CwStatus;
#undef CW_STATUS_ENUM

// The text of a code, in a few words. Never NULL.
const char *cw_status_text(CwStatus status);

// Records the message of a failure (printf style, kept per thread, at most 1000 bytes) and returns `code`.
// Called where the failure is found; a later call replaces an earlier one, so a caller may add context. Where errno is
// ENOMEM, an allocation has failed, perhaps deep in a library that calls it something else: then the code becomes
// CW_ERR_MEMORY, and the message begins with "out of memory: ".
CwStatus cw_fail_at(const char *source_file, int line, const char *function, CwStatus code, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

// The last failure in this thread as plain bytes, for a rank that tells it for another one. Never NULL.
typedef struct {
  char message[1001];
  char trace[2000];
} CwFailure;
CwFailure *cw_failure(void);

// The message of the last failure in this thread, or "".
const char *cw_fail_message(void);

// The places a failure passed on its way up ("file:line function"), newest last; for --verbose. Never NULL.
const char *cw_fail_trace(void);
void cw_fail_passed(const char *source_file, int line, const char *function);

// Puts "PLACE: " before the message of the last failure, which keeps its code and its trace, unless it begins with that
// place already.
void cw_fail_place(const char *place);

// Forgets the last failure: for callers that recover.
void cw_fail_clear(void);

#define CW_FAIL(code, ...) cw_fail_at(__FILE__, __LINE__, __func__, (code), __VA_ARGS__)

// Calls; on anything but CW_OK goes to `done`.
#define CW_TRY(call)                                                                                                   \
  do {                                                                                                                 \
    status = (call);                                                                                                   \
    if (status != CW_OK) {                                                                                             \
      cw_fail_passed(__FILE__, __LINE__, __func__);                                                                    \
      goto done;                                                                                                       \
    }                                                                                                                  \
  } while (0)

// Fails with `code` and a message unless `condition` holds.
#define CW_REQUIRE(condition, code, ...)                                                                               \
  do {                                                                                                                 \
    if (!(condition)) {                                                                                                \
      status = CW_FAIL((code), __VA_ARGS__);                                                                           \
      goto done;                                                                                                       \
    }                                                                                                                  \
  } while (0)

// Allocates `count` zeroed items of *pointer; fails with CW_ERR_MEMORY. Zero items give one, never NULL.
#define CW_NEW(pointer, count)                                                                                         \
  do {                                                                                                                 \
    size_t cw_new_count = (size_t)(count);                                                                             \
    (pointer) = calloc(cw_new_count ? cw_new_count : 1, sizeof *(pointer));                                            \
    CW_REQUIRE((pointer), CW_ERR_MEMORY, "out of memory: %zu items of %zu bytes", cw_new_count, sizeof *(pointer));    \
  } while (0)

// The same without zeroing them: for large arrays that are written before they are read.
#define CW_NEW_UNSET(pointer, count)                                                                                   \
  do {                                                                                                                 \
    size_t cw_new_count = (size_t)(count);                                                                             \
    (pointer) = malloc((cw_new_count ? cw_new_count : 1) * sizeof *(pointer));                                         \
    CW_REQUIRE((pointer), CW_ERR_MEMORY, "out of memory: %zu items of %zu bytes", cw_new_count, sizeof *(pointer));    \
  } while (0)

// Makes room for `wanted` items in a list that has room for `capacity`, and for as many more, so that a list grown item
// by item is copied a few times only. The list stays as it is where memory is out (CW_ERR_MEMORY).
#define CW_GROW(pointer, capacity, wanted)                                                                             \
  do {                                                                                                                 \
    size_t cw_grow_wanted = (size_t)(wanted);                                                                          \
    if (cw_grow_wanted > (size_t)(capacity)) {                                                                         \
      size_t cw_grow_capacity = 2 * cw_grow_wanted + 64;                                                               \
      __typeof__(capacity) cw_grow_new = (__typeof__(capacity))cw_grow_capacity;                                       \
      void *cw_grown = cw_grow_new > (capacity) ? realloc((pointer), cw_grow_capacity * sizeof *(pointer)) : NULL;     \
      CW_REQUIRE(cw_grown, CW_ERR_MEMORY, "out of memory: %zu items of %zu bytes", cw_grow_capacity,                   \
                 sizeof *(pointer));                                                                                   \
      (pointer) = cw_grown;                                                                                            \
      (capacity) = cw_grow_new;                                                                                        \
    }                                                                                                                  \
  } while (0)

#ifdef __cplusplus
}
#endif
