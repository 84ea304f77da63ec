// SPDX-License-Identifier: AGPL-3.0-or-later
// seal RUN: gives the files of a run the digests that its stages would have given them (seal_run.h).
#include <stdio.h>

#include "tests/seal_run.h"

int main(int argc, char **argv) {
  if (argc != 2) fprintf(stderr, "usage: seal RUN\n");
  return argc != 2 || seal_run(argv[1]) != 0;
}
