// SPDX-License-Identifier: AGPL-3.0-or-later
// A tessellated face as it travels between ranks (background_tessellate): counts, nodes, triangles, edges.
#pragma once

#include <cstdint>
#include <cstring>

struct FaceNode {
  double uv[2], x[3];
};

struct FaceBlock {
  int32_t nodes, triangles;
  FaceNode *node;
  int32_t (*triangle)[3];
  int32_t *side; // for each edge of the face its number, a count of nodes and these

  explicit FaceBlock(void *bytes) {
    std::memcpy(&nodes, bytes, sizeof nodes);
    std::memcpy(&triangles, (char *)bytes + sizeof nodes, sizeof triangles);
    node = (FaceNode *)((char *)bytes + sizeof nodes + sizeof triangles);
    triangle = (int32_t(*)[3])(node + nodes);
    side = (int32_t *)(triangle + triangles);
  }
};
