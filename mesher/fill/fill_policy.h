// SPDX-License-Identifier: AGPL-3.0-or-later
// The tuned numbers of fill/, as X(type, name, value, unit, meaning and evidence); mesher/policy.h makes structs,
// tables and options of it. Qualities are those of cw_tet_quality, mostly sines of the least dihedral angle. `1` is the
// unit of ratios and counts, `h` the wanted edge length at the place, `edge` that of the triangle or tetrahedron.
#ifndef CUTWATER_MESHER_FILL_FILL_POLICY_H
#define CUTWATER_MESHER_FILL_FILL_POLICY_H

#define CW_FILL_POLICY(X)                                                                                              \
  CW_FILL_POLICY_POINTS(X)                                                                                             \
  CW_FILL_POLICY_RECOVER(X) CW_FILL_POLICY_IMPROVE(X) CW_FILL_POLICY_RELAX(X) CW_FILL_POLICY_SEARCH(X)

// Inner points.
#define CW_FILL_POLICY_POINTS(X)                                                                                       \
  X(double, coarse_cell, 2.2, "h", "octree cells with lists of the boundary are cut down to this; time alone")         \
  X(double, wall_distance, 0.5, "edge", "or h where that is less: least distance of a point to a boundary triangle")   \
  X(double, tetgen_clearance, 2.0, "1", "times that distance when TetGen tries again")                                 \
  X(double, lattice_jitter, 1e-3, "cell", "points are moved off common spheres by up to this")                         \
  X(double, lattice_fit, 0.01, "1", "log of cells found over cells wanted: below it the spacing fits")                 \
  X(double, offset_height, 0.75, "spacing", "of offset points; sqrt(2/3) in a close packing, denser than asked for")   \
  X(double, offset_spacing_most, 1.3, "edge", "spacing of offset points at most")                                      \
  X(double, offset_apart, 0.7, "spacing", "least distance between offset points")                                      \
  X(double, offset_clear, 0.65, "spacing", "least distance of lattice points from offset points")                      \
  X(double, offset_ball, 0.6, "1",                                                                                     \
    "of the square of a triangle's sphere, out of which offset points keep: with all of it large triangles leave "     \
    "gaps where edges are of unlike length")

// Recovery of the boundary by flips.
#define CW_FILL_POLICY_RECOVER(X)                                                                                      \
  X(int32_t, recover_rounds, 4, "1", "what one facet could not have may be free after others have theirs")             \
  X(int32_t, recover_tries, 8, "1", "of an edge or facet, from its ends in turn, each two of a depth")                 \
  X(int32_t, recover_hold, 16, "1", "flips that only prepare others, before the other end is tried")

// Single changes.
#define CW_FILL_POLICY_IMPROVE(X)                                                                                      \
  X(double, improve_below, 0.4226, "quality", "sine of 25 degrees: more costs time and gives no better worst ones")    \
  X(double, improve_below_crowded, 0.3584, "quality",                                                                  \
    "sine of 21 degrees, in crowded regions: the last degrees, which the boundary keeps many from, cost aspect")       \
  X(int32_t, improve_passes, 5, "1", "over the list, at most")                                                         \
  X(double, move_gain, 2e-3, "quality", "least gain of a move: smaller ones cost much and give little")                \
  X(double, move_step, 0.2, "radius", "first step of the search for the best place in a cavity")                       \
  X(double, move_step_last, 0.2, "1", "last step over the first")                                                      \
  X(double, insert_below, 0.4226, "quality", "a new point is tried")                                                   \
  X(double, insert_round_below, 0.38, "quality", "and at places round about")                                          \
  X(double, insert_gain, 0.02, "quality", "least gain of a new point: it must pay for its cells")                      \
  X(double, insert_aim_high, 0.4, "quality", "first threshold for the growth of a cavity")                             \
  X(double, insert_aim, 0.32, "quality", "second threshold")                                                           \
  X(double, insert_aim_low, 0.25, "quality", "third threshold, before none")                                           \
  X(double, insert_shell, 0.2, "edge", "distance between the shells of places round about")                            \
  X(double, slender_aspect, 1.6, "1", "longest over shortest edge above which the longest edge may go")                \
  X(double, slender_aspect_crowded, 1.5, "1", "the same in crowded regions, once points were taken away")              \
  X(double, usual_aspect, 1.4, "1", "of a tetrahedron that neither helps nor hinders a sum of aspects")                \
  X(double, crowded_share, 0.235, "1", "of slender tetrahedra, above which points stand too close and some go")        \
  X(double, collapse_loss, 1.0, "aspect", "a point goes although the sum of aspects grows by less: relaxing mends it") \
  X(int32_t, collapse_slender, 7, "1", "slender tetrahedra with their shortest edge at a point that is tried")         \
  X(double, shorten_gain, 1e-3, "aspect", "least gain of the removal of a longest edge, in the sum")                   \
  X(double, shorten_longer, 1.3, "1", "square of the edge that comes, over that of the one that goes, at most")        \
  X(double, shorten_cosine, 0.3, "1", "of the dihedral angle at an edge that four tetrahedra or fewer share, at most")

// Moves of all points at once. A pull is the share of an edge that the first step of evening edges goes.
#define CW_FILL_POLICY_RELAX(X)                                                                                        \
  X(double, even_share, 0.16, "1", "of slender tetrahedra, above which evening edges a second time pays")              \
  X(double, aspect_floor, 0.05, "quality", "that relaxing may leave: flips follow, and mend nearly all of it")         \
  X(double, regular_quality, 0.8, "quality", "points stay where all is above: 0.866 in a lattice")                     \
  X(double, pull_decay, 0.7, "1", "of each step over the one before")                                                  \
  X(int32_t, interface_weight, 2, "1", "of tetrahedra beside partition planes, whose triangles both sides share")      \
  X(double, pull_needed, 0.5, "edge", "where a second time pays")                                                      \
  X(int32_t, steps_needed, 1, "1", "towards even edges there")                                                         \
  X(int32_t, steps_crowded, 3, "1", "in crowded regions")                                                              \
  X(double, pull_only, 0.14, "edge", "where it does not pay")                                                          \
  X(int32_t, steps_beside, 3, "1", "and further ones beside partition planes")                                         \
  X(double, pull_last, 0.22, "edge", "the second time")                                                                \
  X(int32_t, steps_last, 5, "1", "towards even edges then")                                                            \
  X(int32_t, steps_last_crowded, 4, "1", "in crowded regions")                                                         \
  X(int32_t, steps_last_beside, 2, "1", "and further ones beside partition planes")

// Search of patches for what single changes cannot mend.
#define CW_FILL_POLICY_SEARCH(X)                                                                                       \
  X(double, search_bad, 0.2250, "sine", "13 degrees: a search begins below")                                           \
  X(double, search_wanted, 0.3090, "sine", "18 degrees: and below where the boundary allows clearly more")             \
  X(double, search_worthwhile, 0.85, "1", "of the angle that the boundary allows: more is not clearly less")           \
  X(double, search_again, 0.2079, "sine", "12 degrees: below it a place is searched again and again")                  \
  X(double, search_beyond, 0.0170, "sine", "a degree: a search ends so much above where it begins")                    \
  X(double, search_counted, 0.3746, "sine", "22 degrees: what is less counts in a patch, and is improved there")       \
  X(double, search_kept, 0.95, "1", "of the least sine, in a search for determinants")                                 \
  X(double, search_sound, 0.02, "quality", "that a disturbance leaves; flatter ones are no matter of the search")      \
  X(double, search_aim, 0.3, "quality", "threshold for a cavity of a disturbance, at most")                            \
  X(double, search_alike, 0.05, "sine", "above the worst: those that are disturbed, too")                              \
  X(double, search_shaken, 0.3, "edge", "farthest that points are moved by a disturbance")                             \
  X(int32_t, search_patch, 300, "tetrahedra", "of a patch")                                                            \
  X(int32_t, search_patch_small, 100, "tetrahedra", "of every second one: few are searched more thoroughly")           \
  X(int32_t, search_tries, 400, "1", "of a beginning")                                                                 \
  X(int32_t, search_idle, 250, "1", "of these, without a gain")                                                        \
  X(int32_t, search_share, 500, "tetrahedra", "for one try more: a search takes half as long as the fill")             \
  X(int32_t, search_fewest, 600, "1", "tries of a mesh, or more by the share")                                         \
  X(int32_t, search_mild, 200, "1", "tries of a mesh where nothing is below 13 degrees")                               \
  X(int32_t, search_beginnings, 8, "1", "of a place")                                                                  \
  X(int32_t, search_mixed, 3, "1", "in one beginning of so many points do not only go in")                             \
  X(int32_t, search_few, 250, "tetrahedra", "for a bad one: where there are more it is the boundary that asks for it") \
  X(int32_t, search_changes, 3, "1", "of one disturbance, at most")                                                    \
  X(int32_t, search_away, 4, "faces", "to step over from a bad tetrahedron, at most")                                  \
  X(int32_t, search_passes, 4, "1", "of improvement after a disturbance")

#endif
