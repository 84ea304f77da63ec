// SPDX-License-Identifier: AGPL-3.0-or-later
// Numbers as people read them: grouped digits, sensible precision, SI prefixes. UTF-8; groups are parted by
// narrow no-break spaces. A value that is not finite reads as a dash.
#pragma once

#include <stdint.h>

enum { CW_FORMAT_SIZE = 64 };

// All functions write to `text` and return it.
char *cw_format_count(int64_t count, char text[CW_FORMAT_SIZE]); // 1 234 567
char *cw_format_number(double value, int significant,
                       char text[CW_FORMAT_SIZE]); // 12.87; digits before the point all
char *cw_format_si(double value, int significant,
                   char text[CW_FORMAT_SIZE]);                      // "1.23 M", "456 k", "220 \u00b5"
char *cw_format_seconds(double seconds, char text[CW_FORMAT_SIZE]); // "12.3 s", "4 min 05 s", "3 h 07 min"
char *cw_format_bytes(double bytes, char text[CW_FORMAT_SIZE]);     // "1.24 GB"
char *cw_format_percent(double share,
                        char text[CW_FORMAT_SIZE]); // of a share 0 to 1; 0 and 100 % only of none and all
