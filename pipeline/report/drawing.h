// SPDX-License-Identifier: AGPL-3.0-or-later
// A picture of geometry and mesh while it is drawn, region by region.
#pragma once

#include "pipeline/mesh/region_read.h"
#include "pipeline/report/camera.h"
#include "pipeline/report/cut.h"
#include "pipeline/report/flow.h"
#include "pipeline/report/picture_list.h"
#include "pipeline/report/render.h"
#include "pipeline/report/survey.h"

enum { CW_DRAWING_METAL = 65000 }; // the group of faces that are left white

extern const uint32_t cw_pyramid_colour;

typedef struct {
  const CwPictureSpec *spec;
  int suction; // CwPumpSizes
  CwCamera camera;
  CwCameraReach reach;
  CwCutPlane plane;
  CwCanvas canvas;
  const char *lacking;            // what is not there; then nothing is drawn
  unsigned part[CW_DOMAINS_MOST]; // CW_SEES_ROTOR and so on
  char hidden[CW_DOMAINS_MOST][CW_PATCHES_MOST];
  uint32_t colour[CW_DOMAINS_MOST][CW_PATCHES_MOST];
  char seen[CW_DOMAINS_MOST][CW_PATCHES_MOST];
} CwDrawing;

// Begins with the direction of the view, where it does not hang on a place: `survey` is empty. Zeroed `drawing` on
// entry; the caller starts its canvas (render.h) and frees it.
void cw_drawing_start(const CwPictureSpec *spec, const CwMesh *mesh, const CwSurvey *survey, CwDrawing *drawing);
// Takes what the view must hold of the boundary of a region (surface.h).
void cw_drawing_reach(CwDrawing *drawing, const CwRegionData *surface);
// Puts the view to its place by the whole survey, or finds it lacking.
void cw_drawing_aim(CwDrawing *drawing, const CwSurvey *survey);
// Draws the boundary of a region (surface.h), of a domain that the picture sees, with `share`s of the scales of
// pressure and y+ by face (cw_flow_faces). CW_ERR_MEMORY.
CwStatus cw_drawing_add_faces(CwDrawing *drawing, int region, const CwRegionData *surface, double *const share[2]);

// Adds to `cut`, zeroed on entry, the cells of a region that the picture's plane cuts: the same for all pictures of a
// plane. Free with cw_region_cut_free, also after a failure. CW_ERR_MEMORY.
CwStatus cw_drawing_cut(const CwDrawing *drawing, const CwSurvey *survey, const CwRegionData *cells, CwRegionCut *cut);
// Draws them.
void cw_drawing_add_cells(CwDrawing *drawing, const CwMesh *mesh, int region, const CwFlow *flow,
                          const CwRegionData *cells, const CwRegionCut *cut);
// Marks which patches are to be seen on the whole canvas.
void cw_drawing_mark_seen(CwDrawing *drawing);
