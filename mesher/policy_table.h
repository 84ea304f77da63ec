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

// Inner points.
NUMBER(double, coarse_cell, 2.2, none, "h", "octree cells with lists of the boundary are cut down to this; time alone")
NUMBER(double, wall_distance, 0.5, none, "edge",
       "or h where that is less: least distance of a point to a boundary triangle")
NUMBER(double, tetgen_clearance, 2.0, none, "1", "times that distance when TetGen tries again")
NUMBER(double, lattice_jitter, 1e-3, none, "cell", "points are moved off common spheres by up to this")
NUMBER(double, lattice_fit, 0.01, none, "1", "log of cells found over cells wanted: below it the spacing fits")
NUMBER(double, offset_height, 0.75, none, "spacing",
       "of offset points; sqrt(2/3) in a close packing, denser than asked for")
NUMBER(double, offset_spacing_most, 1.3, none, "edge", "spacing of offset points at most")
NUMBER(double, offset_apart, 0.7, none, "spacing", "least distance between offset points")
NUMBER(double, offset_clear, 0.65, none, "spacing", "least distance of lattice points from offset points")
NUMBER(double, offset_ball, 0.6, none, "1",
       "of the square of a triangle's sphere, out of which offset points keep: with all of it large triangles leave "
       "gaps where edges are of unlike length")

// Recovery of the boundary by flips.
NUMBER(int32_t, recover_rounds, 4, none, "1", "what one facet could not have may be free after others have theirs")
NUMBER(int32_t, recover_tries, 8, none, "1", "of an edge or facet, from its ends in turn, each two of a depth")
NUMBER(int32_t, recover_hold, 16, none, "1", "flips that only prepare others, before the other end is tried")

// Single changes.
NUMBER(double, improve_below, 0.4226, none, "quality",
       "sine of 25 degrees: more costs time and gives no better worst ones")
NUMBER(double, improve_below_many_slender, 0.3584, none, "quality",
       "sine of 21 degrees, where many tetrahedra are slender: the last degrees, which the boundary keeps many from, "
       "cost aspect")
NUMBER(int32_t, improve_passes, 5, none, "1", "over the list, at most")
NUMBER(double, move_gain, 2e-3, none, "quality", "least gain of a move: smaller ones cost much and give little")
NUMBER(double, move_step, 0.2, none, "radius", "first step of the search for the best place in a cavity")
NUMBER(double, move_step_last, 0.2, none, "1", "last step over the first")
NUMBER(double, insert_below, 0.4226, none, "quality", "a new point is tried")
NUMBER(double, insert_round_below, 0.38, none, "quality", "and at places round about")
NUMBER(double, insert_gain, 0.02, none, "quality", "least gain of a new point: it must pay for its cells")
NUMBER(double, insert_aim_high, 0.4, none, "quality", "first threshold for the growth of a cavity")
NUMBER(double, insert_aim, 0.32, none, "quality", "second threshold")
NUMBER(double, insert_aim_low, 0.25, none, "quality", "third threshold, before none")
NUMBER(double, insert_shell, 0.2, none, "edge", "distance between the shells of places round about")
NUMBER(double, slender_aspect, 1.6, none, "1", "longest over shortest edge above which the longest edge may go")
NUMBER(double, slender_aspect_many, 1.5, none, "1",
       "the same where many tetrahedra are slender, once points were taken away")
NUMBER(double, usual_aspect, 1.4, none, "1", "of a tetrahedron that neither helps nor hinders a sum of aspects")
NUMBER(double, many_slender_share, 0.235, none, "1",
       "of slender tetrahedra, above which points stand too close and some go")
NUMBER(double, collapse_loss, 1.0, none, "aspect",
       "a point goes although the sum of aspects grows by less: relaxing mends it")
NUMBER(int32_t, collapse_slender, 7, none, "1", "slender tetrahedra with their shortest edge at a point that is tried")
NUMBER(double, shorten_gain, 1e-3, none, "aspect", "least gain of the removal of a longest edge, in the sum")
NUMBER(double, shorten_longer, 1.3, none, "1", "square of the edge that comes, over that of the one that goes, at most")
NUMBER(double, shorten_cosine, 0.3, none, "1",
       "of the dihedral angle at an edge that four tetrahedra or fewer share, at most")

// Moves of all points at once. A pull is the share of an edge that the first step of evening edges goes.
NUMBER(double, even_share, 0.16, none, "1", "of slender tetrahedra, above which evening edges a second time pays")
NUMBER(double, aspect_floor, 0.05, none, "quality", "that relaxing may leave: flips follow, and mend nearly all of it")
NUMBER(double, regular_quality, 0.8, none, "quality", "points stay where all is above: 0.866 in a lattice")
NUMBER(double, pull_decay, 0.7, none, "1", "of each step over the one before")
NUMBER(int32_t, interface_weight, 2, none, "1",
       "of tetrahedra beside partition planes, whose triangles both sides share")
NUMBER(double, pull_needed, 0.5, none, "edge", "where a second time pays")
NUMBER(int32_t, steps_needed, 1, none, "1", "towards even edges there")
NUMBER(int32_t, steps_many_slender, 3, none, "1", "where many tetrahedra are slender")
NUMBER(double, pull_only, 0.14, none, "edge", "where it does not pay")
NUMBER(int32_t, steps_beside, 3, none, "1", "and further ones beside partition planes")
NUMBER(double, pull_last, 0.22, none, "edge", "the second time")
NUMBER(int32_t, steps_last, 5, none, "1", "towards even edges then")
NUMBER(int32_t, steps_last_many_slender, 4, none, "1", "where many tetrahedra are slender")
NUMBER(int32_t, steps_last_beside, 2, none, "1", "and further ones beside partition planes")

// Search of patches for what single changes cannot mend.
NUMBER(double, search_bad, 0.2250, none, "sine", "13 degrees: a search begins below")
NUMBER(double, search_wanted, 0.3090, none, "sine", "18 degrees: and below where the boundary allows clearly more")
NUMBER(double, search_worthwhile, 0.85, none, "1", "of the angle that the boundary allows: more is not clearly less")
NUMBER(double, search_again, 0.2079, none, "sine", "12 degrees: below it a place is searched again and again")
NUMBER(double, search_beyond, 0.0170, none, "sine", "a degree: a search ends so much above where it begins")
NUMBER(double, search_counted, 0.3746, none, "sine",
       "22 degrees: what is less counts in a patch, and is improved there")
NUMBER(double, search_kept, 0.95, none, "1", "of the least sine, in a search for determinants")
NUMBER(double, search_sound, 0.02, none, "quality",
       "that a disturbance leaves; flatter ones are no matter of the search")
NUMBER(double, search_aim, 0.3, none, "quality", "threshold for a cavity of a disturbance, at most")
NUMBER(double, search_alike, 0.05, none, "sine", "above the worst: those that are disturbed, too")
NUMBER(double, search_shaken, 0.3, none, "edge", "farthest that points are moved by a disturbance")
NUMBER(int32_t, search_patch, 300, none, "tetrahedra", "of a patch")
NUMBER(int32_t, search_patch_small, 100, none, "tetrahedra", "of every second one: few are searched more thoroughly")
NUMBER(int32_t, search_tries, 400, none, "1", "of a beginning")
NUMBER(int32_t, search_idle, 250, none, "1", "of these, without a gain")
NUMBER(int32_t, search_share, 500, none, "tetrahedra", "for one try more: a search takes half as long as the fill")
NUMBER(int32_t, search_fewest, 600, none, "1", "tries of a mesh, or more by the share")
NUMBER(int32_t, search_mild, 200, none, "1", "tries of a mesh where nothing is below 13 degrees")
NUMBER(int32_t, search_beginnings, 8, none, "1", "of a place")
NUMBER(int32_t, search_mixed, 3, none, "1", "in one beginning of so many points do not only go in")
NUMBER(int32_t, search_few, 250, none, "tetrahedra",
       "for a bad one: where there are more it is the boundary that asks for it")
NUMBER(int32_t, search_changes, 3, none, "1", "of one disturbance, at most")
NUMBER(int32_t, search_away, 4, none, "faces", "to step over from a bad tetrahedron, at most")
NUMBER(int32_t, search_passes, 4, none, "1", "of improvement after a disturbance")
