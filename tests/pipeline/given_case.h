// SPDX-License-Identifier: AGPL-3.0-or-later
// A case of a few lines, read from a file of the test's folder.
#pragma once

#include "pipeline/case_read.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

// Reads `head` with `lines` behind it; the file is gone then.
static inline CwStatus read_given(const char *head, const char *lines, CwCase *table) {
  char text[2000];
  const char *path = in_test_folder("case.yaml");
  assert_true(snprintf(text, sizeof text, "%s%s\n", head, lines) < (int)sizeof text);
  write_text(path, text);
  cw_fail_clear();
  const CwStatus status = cw_case_read(path, table);
  unlink(path);
  return status;
}
