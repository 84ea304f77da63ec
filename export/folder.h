// SPDX-License-Identifier: AGPL-3.0-or-later
// Folders that appear whole or not at all, and paths.
#pragma once

#include "pipeline/status.h"

// Sets *path to a new string (printf style) and frees what was there. CW_ERR_MEMORY.
CwStatus cw_path_set(char **path, const char *format, ...) __attribute__((format(printf, 2, 3)));

// Makes `path` a symbolic link to `target`. CW_ERR_IO.
CwStatus cw_link_make(const char *path, const char *target);

// Removes a folder and what it holds; fine where there is none. CW_ERR_IO.
CwStatus cw_folder_remove(const char *path);

// Brings a folder and what it holds to the disk. CW_ERR_IO.
CwStatus cw_folder_sync(const char *path);

// Begins that with the files that are there, and does not wait (cw_sync_begin).
void cw_folder_sync_begin(const char *path);

// Puts the folder or file `from` in the place of `to`, whatever was there before, and that to the disk. CW_ERR_IO.
CwStatus cw_folder_replace(const char *from, const char *to);
