// SPDX-License-Identifier: AGPL-3.0-or-later
// Why layers are thinner than asked, or miss their first height: the mesher's record counts the wall faces of a patch
// by it.
#pragma once

#include <stdio.h>

typedef enum {
  CW_LAYER_FULL,      // thickness as asked
  CW_LAYER_SHARPNESS, // limited by a convex edge so sharp that columns over it would be too long, or beside one
  CW_LAYER_TAPER,     // of no height, since no direction sees all faces or layers do not stand there; or beside one
  CW_LAYER_GAP,       // limited by a narrow gap or a concave place
  CW_LAYER_GRADATION, // limited by neighbours
  CW_LAYER_REPAIR     // limited by validity of the prisms or of the layer top
} CwLayerReason;

enum { CW_LAYER_REASONS = CW_LAYER_REPAIR + 1, CW_LAYER_KEY_SIZE = 64 };

// What a reason is called in keys and messages; of CW_LAYER_FULL NULL.
static inline const char *cw_layer_reason_name(int reason) {
  static const char *const names[CW_LAYER_REASONS] = {NULL, "sharpness", "taper", "gap", "gradation", "repair"};
  return names[reason];
}

// The key of the faces that are `what` ("thinned", "first_height_missed") for another reason than CW_LAYER_FULL;
// returns `key`.
static inline const char *cw_layer_reason_key(const char *what, int reason, char key[CW_LAYER_KEY_SIZE]) {
  snprintf(key, CW_LAYER_KEY_SIZE, "%s_by_%s_faces", what, cw_layer_reason_name(reason));
  return key;
}
