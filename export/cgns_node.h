// SPDX-License-Identifier: AGPL-3.0-or-later
// Nodes of a CGNS file (the HDF5 mapping of the CGNS standard), laid down through HDF5 itself: the CGNS
// library stamps the time on every node and cannot write in parallel. The library reads these files as its
// own.
#pragma once

#include <hdf5.h>

#include "pipeline/status.h"

// Creates the file with its root and CGNSLibraryVersion nodes. Without time stamps: the same calls give the
// same bytes. Fails with CW_ERR_IO; the message does not name the file.
CwStatus cw_cgns_create(const char *path, hid_t *file);

// Adds a node to `parent` and gives its group in *node (NULL: closes it). `type` is MT, C1, I4, I8, R4 or R8.
// `size` is in C order, the reverse of the standard's, with `dimensions` entries. data NULL with another type
// than MT: the space is set aside, to be filled later. Fails with CW_ERR_LIBRARY.
CwStatus cw_cgns_node(hid_t parent, const char *name, const char *label, const char *type, int dimensions,
                      const hsize_t *size, const void *data, hid_t *node);

// A node that holds a text.
CwStatus cw_cgns_text(hid_t parent, const char *name, const char *label, const char *text, hid_t *node);

// A node with `count` values in one dimension.
CwStatus cw_cgns_list(hid_t parent, const char *name, const char *label, const char *type, hsize_t count,
                      const void *data, hid_t *node);

// A node with `count` integers in one dimension or, where `columns` is above 0, in two; stored in 64 or 32 bits.
CwStatus cw_cgns_integers(hid_t parent, const char *name, const char *label, int wide, hsize_t count, hsize_t columns,
                          const int64_t *data, hid_t *node);

// A DataArray_t of `count` values with the exponents of mass, length, time, temperature and angle in its unit.
CwStatus cw_cgns_quantity(hid_t parent, const char *name, const char *type, hsize_t count, const void *data,
                          const float exponents[5]);
