// SPDX-License-Identifier: AGPL-3.0-or-later
// The rule of region numbers (paper, section 2.3). Where a new point of a region falls into the sphere of an interface
// triangle, the region of the smaller number inserts the centre of the triangle's circle into the interface instead;
// its neighbour gets the nodes and inserts nothing there.
//
// New points are the candidates of the fill. They follow from the planned interfaces alone, so that the owner finds
// them before any region is filled (cw_interface_rule), the refined interfaces go to all ranks, and each fill takes up
// the same candidates, less those in a sphere of the final interfaces (cw_interface_rule_points). No fill waits for
// another.
#pragma once

#include "mesher/region/region_input.h"
#include "mesher/fill/lattice_core.h"

// Region (0-based) of the smaller number beside interface `outline`. In a z-fold symmetric domain the numbers are those
// of the first regions of the image sets, so that turns take owners to owners; between two images of one region it is
// the one behind the plane.
int32_t cw_interface_owner(const CwRegionInput *from, const int32_t *number, int32_t outline);

// The region that refines `outline`: its owner; -1 where the outline is a periodic image of one that is refined.
int32_t cw_interface_refiner(const CwRegionInput *from, const int32_t *number, int32_t outline);

// Refines all interfaces of which `region` is the refiner; packed for cw_interface_rule_merge. A task; the inner
// surfaces are merged.
CwStatus cw_interface_rule(const CwRegionInput *from, const int32_t *number, int32_t region, const char *name,
                           void **bytes, int64_t *size);

typedef struct {
  int64_t planned;    // interface triangles before,
  int64_t refined;    // and after
  int64_t encroached; // of the planned ones: with a candidate of the owner in their spheres
  int64_t inserted;   // centres
  int64_t left;       // still encroached: no centre can be had; both sides drop the candidates
} CwInterfaceRuleCounts;

// Takes up the results of all regions (NULL: refines nothing) and their periodic images: new nodes, new interface
// triangles. Adds to interfaces->images and to the counts, which are of all images.
CwStatus cw_interface_rule_merge(const CwPeriodicImages *images, CwInterfaces *interfaces, int32_t regions,
                                 void *const *bytes, CwInterfaceRuleCounts *counts);

// The inner points of a region: its candidates outside of all spheres of its interfaces, and their places in the
// lattice. Caller frees *x and *site.
CwStatus cw_interface_rule_points(const CwRegionInput *from, int32_t region, const char *name, int32_t *count,
                                  double (**x)[3], CwLatticeSite **site);
