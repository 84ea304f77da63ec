// SPDX-License-Identifier: AGPL-3.0-or-later
// How exactly the nodes of an interface lie on its surface: what the mesher holds its regions to as it makes them, and
// the exporter the mesh.
#ifndef CUTWATER_PIPELINE_MESH_INTERFACE_TOLERANCE_H
#define CUTWATER_PIPELINE_MESH_INTERFACE_TOLERANCE_H

// The distance from the exact surface, in the unit of the coordinates, that is allowed to the `count` (3 or 4) nodes of
// a face: a hundredth of its shortest edge. The gap is then little beside that of the chords, which any two meshes of
// a curved surface have between them, and no fold of a face.
double cw_interface_tolerance(int count, const double *const nodes[4]);

#endif
