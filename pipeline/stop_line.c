// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/stop_line.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct {
  char *token, *line; // NULL: nobody watches
  size_t line_size;
  int makes;
  struct sigaction before;
} watch;

int cw_stop_claim(void) {
  // Of all that remove a file one succeeds. Where none can, each tells for itself.
  return !watch.token || unlink(watch.token) == 0 || errno != ENOENT;
}

// Calls nothing but what is safe in a signal handler.
static void stop(int signal_number) {
  ssize_t told = cw_stop_claim() ? write(STDERR_FILENO, watch.line, watch.line_size) : 0;
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
  CW_REQUIRE(asprintf(&watch.token, "%s/log/%s.running", run, stage) >= 0, CW_ERR_MEMORY, "out of memory: a path");
  if (makes) {
    int file = open(watch.token, O_WRONLY | O_CREAT, 0666);
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
  free(watch.line);
  memset(&watch, 0, sizeof watch);
}
