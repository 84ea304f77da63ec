// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/stop_line.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

// That a rank on another host leaves to those on the host of the token, s: half of what Open MPI leaves a rank between
// SIGTERM and SIGKILL.
static const struct timespec NEAR_FIRST = {.tv_nsec = 500000000};

static struct {
  char *token, *line; // NULL: nobody watches
  char *far_token;    // the token once a rank on another host has it
  size_t line_size;
  char host[HOST_NAME_MAX + 1];
  int makes;
  struct sigaction before;
} watch;

int cw_stop_claim(void) {
  // Of all that remove a file one succeeds. Where none can, each tells for itself.
  return !watch.token || unlink(watch.token) == 0 || unlink(watch.far_token) == 0 || errno != ENOENT;
}

// Whether the token was made on another host.
static int is_far(void) {
  char host[sizeof watch.host] = {0};
  int file = open(watch.token, O_RDONLY);
  if (file < 0) file = open(watch.far_token, O_RDONLY);
  if (file < 0) return 0;
  ssize_t size = read(file, host, sizeof host - 1);
  close(file);
  return size > 0 && strcmp(host, watch.host) != 0;
}

// Nobody may hear this rank, for its host may be cut off: it speaks where none does on the host of the token, and
// leaves the token to those.
static int claim_far(void) {
  nanosleep(&NEAR_FIRST, NULL);
  return rename(watch.token, watch.far_token) == 0;
}

// Calls nothing but what is safe in a signal handler.
static void stop(int signal_number) {
  int first = is_far() ? claim_far() : cw_stop_claim();
  ssize_t told = first ? write(STDERR_FILENO, watch.line, watch.line_size) : 0;
  (void)told; // nothing is left to do about it
  _exit(128 + signal_number);
}

CwStatus cw_stop_watch(const char *run, const char *stage, int makes) {
  CwStatus status = CW_OK;
  cw_stop_end();
  watch.makes = makes;
  CW_REQUIRE(asprintf(&watch.line,
                      "%scutwater-%s: error: stopped from outside, or because a rank was killed, as the system does "
                      "where memory runs out; call it again\n",
                      isatty(STDERR_FILENO) ? "\r\033[K" : "", stage) >= 0,
             CW_ERR_MEMORY, "out of memory: a line");
  watch.line_size = strlen(watch.line);
  CW_REQUIRE(asprintf(&watch.far_token, "%s/log/%s.running.far", run, stage) >= 0, CW_ERR_MEMORY,
             "out of memory: a path");
  CW_REQUIRE(asprintf(&watch.token, "%s/log/%s.running", run, stage) >= 0, CW_ERR_MEMORY, "out of memory: a path");
  gethostname(watch.host, sizeof watch.host - 1);
  if (makes) {
    unlink(watch.far_token);
    int file = open(watch.token, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ssize_t told = file >= 0 ? write(file, watch.host, strlen(watch.host)) : 0;
    (void)told; // where it is not, all ranks are near
    if (file >= 0) close(file);
  }
  struct sigaction action = {.sa_handler = stop};
  sigaction(SIGTERM, &action, &watch.before);
done:
  return status;
}

void cw_stop_end(void) {
  if (!watch.token) return;
  sigaction(SIGTERM, &watch.before, NULL);
  if (watch.makes) unlink(watch.token);
  free(watch.token);
  free(watch.far_token);
  free(watch.line);
  memset(&watch, 0, sizeof watch);
}
