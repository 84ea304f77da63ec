// SPDX-License-Identifier: AGPL-3.0-or-later
// What the program was built from, as cmake/version.cmake tells it: "0.1.0", "0.1.0+3f2a9c1". Linked into the stages.
#pragma once

extern const char cw_version[];
