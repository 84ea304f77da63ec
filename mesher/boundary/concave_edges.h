// SPDX-License-Identifier: AGPL-3.0-or-later
// Opens narrow concave edges of the layer top: places where two triangles of it stand so narrow over their edge that
// only flat tetrahedra fit between, though all prisms are sound and no triangle is a needle. They come from the repair,
// from the choice of columns on the seams of periodic images, or from a flip.
#pragma once

#include "mesher/boundary/boundary.h"
#include "mesher/layers/layers.h"

// Turns columns at narrow concave edges and changes their thicknesses by a tenth, never below `least` of `wall`, each
// up to eight times where the least bound of the triangles round it rises by that, up to improve_below; alike in all
// periodic images. All stays as it was where the layer top would cross something, or a prism that is not good become
// worse. *opened: columns that moved, copies not counted. `layers` are those over `wall`, that of the boundary.
// Collective.
CwStatus cw_open_concave_edges(const CwPeriodicImages *images, const CwSurfaceMesh *surface, const CwLayerInput *wall,
                               CwLayers *layers, int32_t *opened);
