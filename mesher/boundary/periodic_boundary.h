// SPDX-License-Identifier: AGPL-3.0-or-later
// Steps of the boundary that know its image sets (periodic_images.h).
#pragma once

#include "mesher/boundary/boundary.h"
#include "mesher/layers/layers.h"

// Finds the image sets of the outlines on all planes. Outcome: CW_OUTCOME_ASYMMETRIC where they are not symmetric.
CwStatus cw_image_outlines(const CwBoundaryInput *in, CwFreeCurves *free_curves, CwOutcome *outcome);

// The layers of the whole wall `input` of a boundary with image sets: grown over the first of each image set with what
// stands near them, copied, and checked as copied. Collective. Outcome: that of cw_layers_make for what is grown,
// CW_OUTCOME_ASYMMETRIC where the copies do not fit one another.
CwStatus cw_image_layers(const CwPeriodicImages *images, const CwSurfaceMesh *surface, const CwLayerInput *input,
                         CwLayers *layers, CwOutcome *outcome);

// The least of the members of the image set of wall vertex v that are on first faces (is_first), -1 where none is.
int32_t cw_image_first_member(const CwNodeImages *images, const uint8_t *is_first, int32_t v);

// Makes those of the wall triangles that are copies anew, from those that they are copies of.
void cw_image_copy_triangles(const CwPeriodicImages *images, const CwSurfaceMesh *surface, int32_t (*triangle)[3]);
