// SPDX-License-Identifier: AGPL-3.0-or-later
// Gradation: the greatest thicknesses at the vertices of a surface that are nowhere above given ones and rise from
// vertex to vertex by no more than is allowed. Vertices are settled from the lowest on (E. W. Dijkstra, 1959).
#pragma once

#include <stdint.h>

#include "mesher/parallel/context.h"
#include "pipeline/status.h"

typedef struct {
  const CwContext *context;
  const char *step;                                        // in the profiler
  int32_t count;                                           // vertices
  const int32_t *start, *triangle;                         // triangles around each vertex, as CwIncident has them
  const int32_t (*corner)[3];                              // of each triangle
  double (*most)(const void *given, int32_t v, int32_t w); // thickness of w at most, beside the lower v
  const void *given;
  double *thickness; // [in, out] of each vertex
  uint8_t *graded;   // [out] set to 1 where the thickness was lowered; may be NULL
} CwGradation;

// `lowered`: marks the vertices lowered since the thicknesses were graded last; NULL: any may be. Equal bits for any
// number of ranks. Collective where `lowered` is NULL.
CwStatus cw_grade_thickness(const CwGradation *gradation, const uint8_t *lowered);
