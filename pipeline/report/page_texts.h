// SPDX-License-Identifier: AGPL-3.0-or-later
// The texts that the page carries, from the files beside this one.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_TEXTS_H
#define CUTWATER_PIPELINE_REPORT_PAGE_TEXTS_H

extern const char cw_page_viewer[]; // viewer.js
extern const char cw_page_style[];    // page.css

#endif
