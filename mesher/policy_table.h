// SPDX-License-Identifier: AGPL-3.0-or-later
// All tuned numbers of the mesher, by room:
//
//   NUMBER(type, name, value, off, unit, meaning and evidence)
//
// A file that needs them defines NUMBER and includes this one, as policy.h does; hence no guard. `off`: the value that
// switches off what the number rules; `none` where no value does. Units: `1` of ratios and counts, `h` the wanted edge
// length at the place, `edge` that of the triangle or tetrahedron, `quality` that of cw_tet_quality, mostly the sine of
// the least dihedral angle. What is not here is mathematics, a constant of physics or of a format, a bound of rounding,
// or a resolution that only costs time. tests/bench/ablate.py measures what each number does.

// Filling a region (fill/): inner points.
NUMBER(double, wall_distance, 0.5, none, "edge",
       "or h where that is less: least distance of a lattice point to a boundary triangle; a quarter more or less "
       "moves the mean aspect by 2 %")
NUMBER(double, offset_height, 0.75, none, "spacing",
       "of offset points over their triangles; sqrt(2/3) would be a close packing, and the aspect 0.2 % greater")
NUMBER(double, offset_apart, 0.65, 0, "spacing",
       "least distance of offset points from one another and of lattice points from them; 0.7: aspect 0.3 % greater")

// Recovery of the boundary by flips.
NUMBER(int64_t, recover_tries, 8, none, "1",
       "of an edge or facet, from its ends in turn, each two of a depth; and half of the flips that only prepare others")
NUMBER(int64_t, recover_rounds, 4, 0, "1", "what one facet could not have may be free after others have theirs")

// Single changes.
NUMBER(double, improve_below, 0.4226, 0, "quality",
       "sine of 25 degrees: what is less is improved; more costs time and aspect and gives no better worst ones")
NUMBER(double, improve_hard, 0.3746, 0, "quality",
       "sine of 22 degrees: new points are tried round about, too, and a search counts what is less")
NUMBER(int64_t, improve_passes, 5, 0, "1", "over the list, at most")
NUMBER(double, move_gain, 2e-3, 0, "quality", "least gain of a move: smaller ones cost much and give little")
NUMBER(double, insert_gain, 0.02, 0, "quality", "least gain of a new point: it must pay for its cells")
NUMBER(double, slender_aspect, 1.6, none, "1",
       "longest over shortest edge above which the longest edge may go; a quarter more or less: aspect 1 %")
NUMBER(double, usual_aspect, 1.4, none, "1", "of a tetrahedron that neither helps nor hinders a sum of aspects")

// Moves of all points at once.
NUMBER(double, sound_quality, 0.05, 0, "quality",
       "that moves for the aspect and disturbances may leave: flips follow, and mend nearly all of it")
NUMBER(double, regular_quality, 0.8, 1, "quality", "points stay where all is above: 0.866 in a lattice; time alone")
NUMBER(double, even_pull, 0.3, 0, "edge",
       "that the first step towards even edges goes; without any the aspect is 1.3 % greater")
NUMBER(int64_t, even_steps, 5, 0, "1", "each shorter by the same")

// Search of patches for what single changes cannot mend; without it least angles are 1.7 degrees less.
NUMBER(double, search_bad, 0.2250, 0, "sine", "13 degrees: a search begins below, and again and again")
NUMBER(double, search_wanted, 0.3090, none, "sine", "18 degrees: and below where the boundary allows more")
NUMBER(int64_t, search_patch, 150, none, "tetrahedra", "of a patch; of 300: 0.4 degrees less in the same time")
NUMBER(int64_t, search_tries, 250, none, "1", "of a beginning")
NUMBER(int64_t, search_share, 500, none, "tetrahedra", "of a mesh for one try more")
NUMBER(int64_t, search_fewest, 600, 0, "1", "tries of a mesh, or more by the share")
NUMBER(int64_t, search_few, 250, none, "tetrahedra",
       "for a bad one: where there are more it is the boundary that asks for it, and a search is time wasted")
