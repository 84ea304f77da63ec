// SPDX-License-Identifier: AGPL-3.0-or-later
// The picture that turns, as an element of the page.
#ifndef CUTWATER_PIPELINE_REPORT_PAGE_VIEW_H
#define CUTWATER_PIPELINE_REPORT_PAGE_VIEW_H

#include <stdio.h>

#include "pipeline/report/view.h"

// Writes <figure id="view"> with its controls, its data and its script. Nothing for a view without parts.
CwStatus cw_page_view(FILE *page, const CwMesh *mesh, const CwView *view);

#endif
