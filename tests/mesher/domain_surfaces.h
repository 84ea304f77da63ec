// SPDX-License-Identifier: AGPL-3.0-or-later
// The products of one domain from its network to its interfaces, for tests that make them in turn.
#pragma once

extern "C" {
#include "mesher/boundary/boundary.h"
#include "mesher/region/region_input.h"
}

// Stays where it is: `input` points into it.
struct DomainSurfaces {
  CwNetwork network = {};
  CwPeriodicImages images = {};
  CwBoundaryInput input = {};
  CwOpenEdges open_edges = {};
  CwWallCurves wall_curves = {};
  CwSurfaceMesh surface = {};
  CwLayers layers = {};
  CwFreeCurves free_curves = {};
  CwInterfaces interfaces = {};

  DomainSurfaces() {
    input.network = &network;
    input.images = &images;
  }
  DomainSurfaces(const DomainSurfaces &) = delete;
  void free() {
    cw_interfaces_free(&interfaces);
    cw_free_curves_free(&free_curves);
    cw_layers_free(&layers);
    cw_surface_mesh_free(&surface);
    cw_wall_curves_free(&wall_curves);
    cw_open_edges_free(&open_edges);
    cw_periodic_images_free(&images);
    cw_network_free(&network);
  }
  CwRegionInput regions() const {
    return {nullptr, &input, &wall_curves, &surface, &layers, &interfaces};
  }
};
