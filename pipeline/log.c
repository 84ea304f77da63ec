// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/log.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

// Lines go to standard error: mpirun hands its ranks a pseudo terminal as standard output even when its own
// output is a file, so only standard error tells truly whether a person is watching.
enum { LINE_SIZE = 1200, WARNING_LIMIT = 1000 };

static const double terminal_interval = 0.1; // s between rewritten lines
static const double plain_interval = 5;      // s between plain lines

typedef struct {
  int active;
  int line_shown; // a rewritten line stands on the terminal, without its newline
  char step[81];
  char unit[33];
  int64_t total, done;
  double started, terminal_time, plain_time;
} Progress;

struct CwLog {
  char stage[33];
  FILE *copy;
  int speaks;
  int verbose;
  int terminal;
  char **warnings;
  size_t warning_count;
  int keeps;
  char *kept; // lines, each with its newline; NULL: none
  size_t kept_size;
  Progress progress;
};

double cw_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double cw_processor_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int64_t cw_peak_memory_bytes(void) {
  struct rusage usage;
  if (getrusage(RUSAGE_SELF, &usage)) return 0;
  return (int64_t)usage.ru_maxrss * 1024; // Linux counts in kibibytes
}

// An event is one line whatever a file name or a library's message holds.
static void make_one_line(char *text) {
  for (char *c = text; *c; ++c)
    if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = ' ';
}

static void make_line(char text[LINE_SIZE], const char *format, va_list arguments) {
  vsnprintf(text, LINE_SIZE, format, arguments);
  make_one_line(text);
}

static void erase_progress_line(CwLog *log) {
  if (log->progress.line_shown) fputs("\r\033[K", stderr);
  log->progress.line_shown = 0;
}

static void write_copy(CwLog *log, const char *kind, const char *text) {
  if (!log->copy) return;
  fprintf(log->copy, "cutwater-%s: %s%s\n", log->stage, kind, text);
  fflush(log->copy);
}

// `kind` is "", "warning: " or "error: ".
static void write_line(CwLog *log, const char *kind, const char *text) {
  if (log) erase_progress_line(log);
  fprintf(stderr, "cutwater%s%s: %s%s\n", log ? "-" : "", log ? log->stage : "", kind, text);
  fflush(stderr);
  if (log) write_copy(log, kind, text);
}

CwStatus cw_log_open(const char *stage, const char *log_path, int speaks, int verbose, CwLog **log) {
  CwStatus status = CW_OK;
  CwLog *made = NULL;
  cw_log_close(log);
  CW_NEW(made, 1);
  snprintf(made->stage, sizeof made->stage, "%s", stage);
  made->speaks = speaks;
  made->verbose = verbose;
  made->terminal = isatty(STDERR_FILENO);
  *log = made; // so that an error from here on bears the stage's name
  if (log_path && speaks) {
    made->copy = fopen(log_path, "w");
    CW_REQUIRE(made->copy, CW_ERR_IO, "%s: cannot be written: %s", log_path, strerror(errno));
  }
done:
  return status;
}

void cw_log_close(CwLog **log) {
  CwLog *closed = *log;
  if (!closed) return;
  erase_progress_line(closed);
  if (closed->copy) fclose(closed->copy);
  for (size_t i = 0; i < closed->warning_count; ++i) free(closed->warnings[i]);
  free(closed->warnings);
  free(closed->kept);
  free(closed);
  *log = NULL;
}

void cw_log(CwLog *log, const char *format, ...) {
  if (!log || !log->speaks) return;
  char text[LINE_SIZE];
  va_list arguments;
  va_start(arguments, format);
  make_line(text, format, arguments);
  va_end(arguments);
  write_line(log, "", text);
}

static void keep_line(CwLog *log, const char *text) {
  size_t size = strlen(text) + 1; // with the newline
  char *grown = realloc(log->kept, log->kept_size + size + 1);
  if (!grown) return; // a line that only tells more
  memcpy(grown + log->kept_size, text, size);
  log->kept = grown;
  log->kept_size += size;
  memcpy(log->kept + log->kept_size - 1, "\n", 2);
}

void cw_log_keep(CwLog *log, int keeps) {
  if (log) log->keeps = keeps;
}

const char *cw_log_kept(const CwLog *log) {
  return log && log->kept ? log->kept : "";
}

void cw_log_drop_kept(CwLog *log) {
  if (!log) return;
  free(log->kept);
  log->kept = NULL;
  log->kept_size = 0;
}

void cw_log_debug(CwLog *log, const char *format, ...) {
  if (!log || !log->verbose || !(log->speaks || log->keeps)) return;
  char text[LINE_SIZE];
  va_list arguments;
  va_start(arguments, format);
  make_line(text, format, arguments);
  va_end(arguments);
  if (log->speaks) {
    write_line(log, "", text);
  } else {
    keep_line(log, text);
  }
}

static void keep_warning(CwLog *log, const char *text) {
  if (log->warning_count == WARNING_LIMIT) return;
  char **larger = realloc(log->warnings, (log->warning_count + 1) * sizeof *larger);
  if (!larger) return; // the line was printed; a warning is no reason to stop
  log->warnings = larger;
  char *kept = strdup(text);
  if (kept) log->warnings[log->warning_count++] = kept;
}

void cw_log_warn(CwLog *log, const char *format, ...) {
  if (!log) return;
  char text[LINE_SIZE];
  va_list arguments;
  va_start(arguments, format);
  make_line(text, format, arguments);
  va_end(arguments);
  keep_warning(log, text);
  if (log->speaks) write_line(log, "warning: ", text);
}

size_t cw_log_warning_count(const CwLog *log) {
  return log ? log->warning_count : 0;
}

const char *cw_log_warning(const CwLog *log, size_t index) {
  return index < cw_log_warning_count(log) ? log->warnings[index] : "";
}

int cw_log_error(CwLog *log, CwStatus status) {
  if (status == CW_OK) return 0;
  if (status == CW_ERR_RANK && log && !log->speaks) return (int)status;
  char text[LINE_SIZE];
  snprintf(text, sizeof text, "%s%s", cw_fail_message()[0] ? cw_fail_message() : cw_status_text(status),
           status == CW_ERR_FAULT ? "; this is a fault of the program: please report it, with the case" : "");
  make_one_line(text);
  write_line(log, "error: ", text);
  if (log && log->verbose && cw_fail_trace()[0]) write_line(log, "passed: ", cw_fail_trace());
  return status > 0 ? (int)status : 1;
}

static void format_duration(char *text, size_t size, double seconds) {
  if (seconds < 9.95)
    snprintf(text, size, "%.1f s", seconds);
  else if (seconds < 59.5)
    snprintf(text, size, "%.0f s", seconds);
  else if (seconds < 3599.5)
    snprintf(text, size, "%d min %02d s", (int)(seconds + 0.5) / 60, (int)(seconds + 0.5) % 60);
  else
    snprintf(text, size, "%.0f h %02d min", floor((seconds + 30) / 3600), (int)fmod((seconds + 30) / 60, 60));
}

// 12.3, 123, 12.3 k, 1.23 M: three digits are enough to see a rate.
static void format_rate(char *text, size_t size, double rate) {
  const char *suffix = "";
  if (rate >= 999.5e3) {
    rate /= 1e6;
    suffix = " M";
  } else if (rate >= 9999.5) {
    rate /= 1e3;
    suffix = " k";
  }
  snprintf(text, size, rate >= 99.95 ? "%.0f%s" : rate >= 9.995 ? "%.1f%s" : "%.2f%s", rate, suffix);
}

static void format_progress(const Progress *progress, char *text, size_t size, double now, int last) {
  double elapsed = now - progress->started;
  double rate = elapsed > 0 ? (double)progress->done / elapsed : 0;
  char rate_text[32], spent[32], left[64] = "";
  char of[48] = "";
  format_rate(rate_text, sizeof rate_text, rate);
  format_duration(spent, sizeof spent, elapsed);
  if (progress->total > 0) {
    double share = 100.0 * (double)progress->done / (double)progress->total;
    snprintf(of, sizeof of, " of %lld", (long long)progress->total);
    if (!last && progress->done > 0 && progress->done <= progress->total) {
      char duration[32];
      format_duration(duration, sizeof duration, (double)(progress->total - progress->done) / rate);
      snprintf(left, sizeof left, ", %.0f %%, %s left", floor(share), duration);
    }
  }
  snprintf(text, size, "%s: %lld%s %s in %s, %s %s/s%s", progress->step, (long long)progress->done, of, progress->unit,
           spent, rate_text, progress->unit, left);
}

void cw_progress_start(CwLog *log, const char *step, int64_t total, const char *unit) {
  if (!log) return;
  if (log->progress.active) cw_progress_end(log);
  log->progress.active = 1;
  snprintf(log->progress.step, sizeof log->progress.step, "%s", step);
  snprintf(log->progress.unit, sizeof log->progress.unit, "%s", unit);
  make_one_line(log->progress.step);
  make_one_line(log->progress.unit);
  log->progress.total = total;
  log->progress.done = 0;
  log->progress.started = log->progress.plain_time = cw_seconds();
  log->progress.terminal_time = 0;
}

// A rewritten line that wraps could not be rewritten: it ends before the last column.
static void fit_terminal(const CwLog *log, char *text, size_t size) {
  struct winsize window;
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &window) || !window.ws_col) return;
  size_t head = strlen("cutwater-: ") + strlen(log->stage);
  size_t room = window.ws_col > head + 1 ? window.ws_col - head - 1 : 0;
  if (room < size) text[room] = '\0';
}

void cw_progress(CwLog *log, int64_t done) {
  if (!log || !log->progress.active) return;
  log->progress.done = done;
  if (!log->speaks) return;
  double now = cw_seconds();
  char text[LINE_SIZE];
  if (log->terminal && now - log->progress.terminal_time >= terminal_interval) {
    format_progress(&log->progress, text, sizeof text, now, 0);
    fit_terminal(log, text, sizeof text);
    fprintf(stderr, "\r\033[Kcutwater-%s: %s", log->stage, text);
    fflush(stderr);
    log->progress.line_shown = 1;
    log->progress.terminal_time = now;
  }
  if (now - log->progress.plain_time >= plain_interval &&
      done != log->progress.total) { // the end tells that all are done
    format_progress(&log->progress, text, sizeof text, now, 0);
    if (log->terminal)
      write_copy(log, "", text);
    else
      write_line(log, "", text);
    log->progress.plain_time = now;
  }
}

void cw_progress_end(CwLog *log) {
  if (!log || !log->progress.active) return;
  if (log->speaks) {
    char text[LINE_SIZE];
    format_progress(&log->progress, text, sizeof text, cw_seconds(), 1);
    write_line(log, "", text);
  }
  log->progress.active = 0;
}
