// SPDX-License-Identifier: AGPL-3.0-or-later
// The texts that the page carries, from the files beside this one.
#pragma once

extern const char cw_page_viewer[]; // viewer.js
extern const char cw_page_style[];    // page.css
