// SPDX-License-Identifier: AGPL-3.0-or-later
// What regions are made from: the finished surfaces of a domain and what these follow from. Of the surfaces a region
// needs what bounds it, and the layers that reach into it.
#pragma once

#include "mesher/boundary/boundary.h"
#include "pipeline/log.h"

typedef struct {
  CwLog *log; // of the rank that makes them
  const CwBoundaryInput *in;
  const CwWallCurves *wall_curves;
  const CwSurfaceMesh *surface;
  const CwLayers *layers;
  const CwInterfaces *interfaces;
} CwRegionInput;
