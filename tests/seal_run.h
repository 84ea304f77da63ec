// SPDX-License-Identifier: AGPL-3.0-or-later
// A run whose files were written or changed by a test, with the digests that its stages would have given them: for
// tests of what a stage says of content that it can only get from a stage with a fault.
#pragma once

// Renews the digests of the region files of `run`, in its manifest and in the records. What is not there, or is not
// what it should be, is passed over. 0, or -1 where a file cannot be written.
int seal_run(const char *run);
