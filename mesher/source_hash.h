// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

// SHA-256, in hex, of the mesher's own sources (source_hash.cmake): regions of other code are not taken up.
extern const char cw_source_hash[65];
