// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef CUTWATER_MESHER_SOURCE_HASH_H
#define CUTWATER_MESHER_SOURCE_HASH_H

// SHA-256, in hex, of the mesher's own sources (source_hash.cmake): regions of other code are not taken up.
extern const char cw_source_hash[65];

#endif
