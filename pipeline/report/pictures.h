// SPDX-License-Identifier: AGPL-3.0-or-later
// The pictures of geometry and mesh, drawn from the region files, one region in memory of a rank at a time.
#pragma once

#include "pipeline/mesh/region_read.h"
#include "pipeline/parallel/ranks.h"
#include "pipeline/report/flow.h"
#include "pipeline/report/picture_list.h"
#include "pipeline/report/render.h"
#include "pipeline/report/survey.h"
#include "pipeline/report/view.h"

typedef struct {
  char label[40];
  uint32_t colour;
} CwLegendItem;

typedef struct {
  const CwPictureSpec *spec;
  CwPng png;           // no bytes: the mesh lacks what the picture shows
  const char *lacking; // then: what
  int absent;          // shows zones that this pump does not have: left out
  CwLegendItem legend[2 * CW_PATCHES_MOST];
  int legend_count;
  const char *scale_label; // of a picture of the flow; NULL: no scale
  CwColourSpan scale;
} CwReportPicture;

typedef struct {
  CwReportPicture *picture;
  int count;
} CwReportPictures;

// Each rank reads its share of the regions twice and draws, also the flow, where there is one; rank 0 gets all pictures
// and in *view, zeroed, the one that turns: the same for any number of ranks. Free with cw_report_pictures_free and
// cw_view_free on all ranks, also after a failure. Collective.
CwStatus cw_report_pictures_draw(const CwRanks *ranks, const CwMesh *mesh, const CwPumpSizes *sizes, CwFlow *flow,
                                 CwReportPictures *pictures, CwView *view);
void cw_report_pictures_free(CwReportPictures *pictures);
