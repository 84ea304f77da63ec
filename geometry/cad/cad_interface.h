// SPDX-License-Identifier: AGPL-3.0-or-later
// The interfaces of a pump from CAD files: pairs of patches that touch, what they lie on, and how wide they are.
//
// A cylinder and a plane are told only where both sides are the same surface with the same ends, as the exporter needs
// them for exact coordinates on it. Sides that differ by less than the tolerance are an interface of any other surface,
// over which the nearest faces are coupled; `off` tells by how much.
#pragma once

#include "geometry/cad/face_patches.h"

#ifdef __cplusplus
extern "C" {
#endif

// One surface between two parts, as a patch of either.
typedef struct {
  int patch[2]; // into CwFacePatches.patch
  CwInterfaceSurface surface;
  int flat;      // 1: its faces are planes, one or several
  double radius; // of a cylinder, m
  double area[2];
  int surfaces;        // that it has (contact_surface.h)
  double reach, width; // of its outermost surface: greatest radius, area over circumference there
  double off;          // by which two cylinders or planes differ that are not the same, m; else 0
} CwCadInterface;

// Pairs of patches that touch; *interfaces is the caller's to free. CW_ERR_GEOMETRY where a patch touches several,
// areas differ, or one beside a part that rotates is no surface of revolution about the axis within `tolerance`, m.
CwStatus cw_cad_interfaces_make(const CwCaseCad *cad, const CwSurvey *survey, const CwContact *contact,
                                const CwFacePatches *patches, double tolerance, int *count,
                                CwCadInterface **interfaces);

// The other side of the interface, where one is that patch; else -1.
int cw_cad_interface_beyond(const CwCadInterface *between, int patch);

#ifdef __cplusplus
}
#endif
