// SPDX-License-Identifier: AGPL-3.0-or-later
// The tuned numbers of the mesher, by room:
//
//   NUMBER(type, name, value, off, unit, meaning and evidence)
//
// A file that needs them defines NUMBER and includes this one, as policy.h does; hence no guard. `off`: the value that
// switches off what the number rules; `none` where no value does. Units: `1` of ratios and counts, `h` the wanted edge
// length at the place, `edge` that of the triangle or tetrahedron, `quality` that of cw_tet_quality, mostly the sine of
// the least dihedral angle. What is not here is mathematics, a constant of physics or of a format, a bound of rounding,
// a resolution that only costs time, or one of those that still stand in their sources: the weights in the score of
// planes (plan/), what the first pass counts cells by (run/cell_count.c), predicted times of tasks (run/), and factors
// in the expressions of surface/ and layers/. tests/bench/ablate.py measures what each number of the table does.

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
       "of an edge or facet from its ends in turn, each two of a depth; half of the flips that only prepare others")
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
NUMBER(double, search_wanted, 0.3090, none, "sine",
       "18 degrees: and below where the boundary allows more; layer tops leave room for three beside a plane")
NUMBER(int64_t, search_patch, 150, none, "tetrahedra", "of a patch; of 300: 0.4 degrees less in the same time")
NUMBER(int64_t, search_tries, 250, none, "1", "of a beginning")
NUMBER(int64_t, search_share, 500, none, "tetrahedra", "of a mesh for one try more")
NUMBER(int64_t, search_fewest, 600, 0, "1", "tries of a mesh, or more by the share")
NUMBER(int64_t, search_few, 250, none, "tetrahedra",
       "for a bad one: where there are more it is the boundary that asks for it, and a search is time wasted")
NUMBER(int64_t, search_any, 40, 0, "1",
       "bad ones that are searched in any mesh, however small: with none, angles of 4 degrees stay where 10 can be had "
       "(pumps of nq 8 at 150,000 cells, regions of 1200 tetrahedra)")

// Decomposition (plan/).
NUMBER(double, plan_line_room, 1.5, 1, "layers",
       "of room beside a line of two planes, in thicknesses of the layers: with less it may be cramped")
NUMBER(double, plan_lines_apart, 3, 1, "h", "between two lines on one interface: from there on they have room")
NUMBER(double, plan_line_upright, 0.55, 0, "cosine",
       "of a line to a wall's normal: columns of lines that lean more are lower")
NUMBER(double, plan_line_leaning, 0.25, 0, "cosine", "where nothing is left of them")
NUMBER(double, plan_line_tangent, 0.15, 0, "cosine",
       "where a column along the line would hardly leave the wall: such a plane will not do")
NUMBER(double, plan_line_concave, 0.8, 0, "layers", "that a line in them leaves behind where the wall bends")
NUMBER(double, plan_same_wall, 0.9, -1, "cosine", "least between triangles of one wall")
NUMBER(double, plan_line_beside, 0.3, 1, "1", "of a line that may run beside another")
NUMBER(double, plan_smooth_cosine, 0.98, 1, "cosine", "between the faces of an edge that is no feature")
NUMBER(double, plan_edge_room, 2, 0, "layers",
       "of room beside an edge: its columns and those of the plane's cut want a cell between them")
NUMBER(double, plan_smooth_room, 0.5, 0, "layers", "the same beside a smooth edge, where only the surface triangles do")
NUMBER(double, plan_touch_room, 0.5, 0, "h", "between a cut and an edge beside it")
NUMBER(double, plan_end_weight, 6, 1, "1", "of an end of a CAD edge, in points along it")
NUMBER(double, plan_along_edge, 0.35, 0, "sine", "of the least angle between a plane and a CAD edge that it crosses")
NUMBER(double, plan_improve_leaning, 0.42, 0, "cosine",
       "of a line to a wall's normal, below which planes are moved: cells had small determinants (the paper's pump "
       "of 100 million cells)")

// Triangles on surfaces (surface/, region/).
NUMBER(double, front_done_radius, 0.74, none, "h",
       "radius of the circumscribed circle of a triangle that is done; equilateral: 0.577")
NUMBER(double, front_least_room, 0.65, none, "h", "that a new point keeps free around it")
NUMBER(double, front_growth, 0.3, none, "1", "of sizes away from short given edges, at most")
NUMBER(double, surface_long_edge, 1.45, none, "h", "longer ones are divided")
NUMBER(double, surface_short_edge, 0.62, 0, "h", "shorter ones go")
NUMBER(double, surface_least_height, 0.4, 0, "h", "that free points keep from given edges")
NUMBER(double, surface_steep_cosine, 0.5, -1, "cosine",
       "between a triangle's normal and the surface's at a corner: below it the triangle is divided")
NUMBER(double, surface_clearly_less, 0.9, 1, "1",
       "of the longest: triangles are too large only where edges are wanted that are shorter")
NUMBER(double, interface_sphere, 1.05, 0, "1",
       "radius over that of the circumscribed circle, kept free by the rule of region numbers")
NUMBER(double, interface_least_distance, 0.62, 0, "h",
       "of new points there: as far apart as lattice points keep from the boundary")
NUMBER(double, thinner, 0.7, none, "1", "that layers keep about a failed region")

// Runs (run/).
NUMBER(double, flat_angle, 12, 0, "degrees",
       "of tetrahedra about which edges become shorter where the boundary allows more: what counts as good")
NUMBER(double, poor_rare, 5e7, none, "cells",
       "for each region with flat tetrahedra, from which on the mesh is not made anew for them: at 1,000 million cells "
       "two such regions doubled the time")
NUMBER(double, missed_share, 0.01, 1, "1",
       "of the wall faces that may miss a first height for which there is room: what counts as good")
NUMBER(double, thin_reach, 4, none, "h", "about a failure in which layers are thinned; doubled each time")

// Layers (layers/, boundary/).
NUMBER(double, thickness_slope, 0.3, none, "1", "thicknesses of columns change by no more per distance between them")
NUMBER(double, gap_share, 0.35, none, "1", "of the gap to another wall, the most that a column takes")
NUMBER(double, fit_share, 0.2, none, "1",
       "of a passage's width, what even layers take whose asked first height does not fit: with gap_share ten pumps of "
       "the population with options had it on 37 to 93 % of the walls and least angles from 3.2 degrees, with this on "
       "53 to 99 %, from 6.4 degrees")
NUMBER(double, core_height, 0.65, 0, "edge",
       "between layers of walls that face each other, at least: 0.5 leaves angles of 9 degrees, 0.8 thin last layers "
       "(pumps of nq 7 to 9 at 150,000 cells)")
NUMBER(double, core_ratio, 4, none, "1",
       "volume of a tetrahedron across that over the last prism, at most: what counts as even")
NUMBER(double, prism_good, 0.12, 0, "quality", "of prisms and their layer tops that is asked for")
NUMBER(double, channel_share, 0.5, 1, "1",
       "that the quality of prisms and layer top counts where another wall is near: without it needles of the layer "
       "top leave angles of 5 to 11 degrees for 10 to 21 (pumps by duty and with y+ 0.5 to 40, 150,000 cells)")
NUMBER(double, prism_fair, 0.05, 0, "quality", "least, where prism_good cannot be had")
NUMBER(double, prism_kept, 0.08, 0, "quality", "least, where columns would have to give up their first height for more")
NUMBER(double, column_kept, 0.8, 1, "1", "that a thinned column keeps")
NUMBER(double, prism_valid, 0.02, 0, "quality", "least, of prisms that a flip may make")
NUMBER(double, top_flip_gain, 1.1, none, "1", "least factor by which a flip raises the least angle of the layer top")
NUMBER(double, top_flip_flat, 0.9, 1, "cosine", "between the normals of a pair that may be turned")
NUMBER(double, top_flip_wall, 0.6, 0, "1", "of its least angle that the wall keeps")
NUMBER(double, top_flip_fair, 0.35, none, "rad", "a wall triangle with angles above it is fair in any case")
NUMBER(double, smoothing_reach, 6, 0, "layers",
       "the smoothing ends at this many thicknesses from its source, and the opening of the crease is forgotten")
NUMBER(double, smoothing_poor, 0.2, 0, "quality", "of prisms under which a smoothing is widened")
NUMBER(double, smoothing_widest, 5, 1, "1", "times its reach")
NUMBER(double, column_least_cosine, 0.3, 0, "cosine",
       "of a column to the normals of its wall, that a search may choose")
NUMBER(double, turn_top, 0.4, none, "1", "what the quality of the layer top counts beside that of prisms")
NUMBER(double, turn_upright, 0.5, 1, "quality", "of prisms from which on columns lean too little to shear prisms much")
NUMBER(double, columns_apart, 0.25, 0, "edge", "of the wall: distance of columns that nearly meet")
NUMBER(double, unfold_open, 0.2, -1, "cosine", "of a vertex of the wall that needs no help")
NUMBER(double, top_narrow, 20.0, 0, "degrees",
       "triangles of the layer top that bound their tetrahedra below that are opened")
NUMBER(double, top_open, 26, none, "degrees", "bound up to which more is better")

// Layer thickness (thickness/).
NUMBER(double, wall_flat_cosine, 0.94, 1, "cosine", "least of the normals about a vertex of a wall as good as flat")
NUMBER(double, wall_concave_rise, 0.25, none, "1", "least rise of an edge over its length at a bend that is concave")
NUMBER(double, kept_growth, 0.7, none, "1",
       "least growth in columns thinned for their shape: thinned further, some made angles of 16 degrees where "
       "others have 19")
NUMBER(double, least_growth, 0.6, 1, "1",
       "of layers in thinned columns; of more than the usual number the last is as great a part of the first: without "
       "that tetrahedra had 20,000 times the volume of prisms beside them (17 layers, 150,000 cells)")
NUMBER(double, even_layers, 1.05, none, "1", "of count times first height: columns are asked to be no shorter")
NUMBER(double, tallest_column, 2.5, none, "h", "at the wall: about what columns come to, for the planes")
NUMBER(double, coupled_near, 0.15, 0, "h", "breaks of two domains that are nearer share one place")
NUMBER(double, width_share, 0.01, 0, "1",
       "of a patch's area that may be nearer to the wall opposite than its layers have room for: first heights are to "
       "be met on 99 % of the faces")
NUMBER(double, growth_auto, 1.3, none, "1", "greatest ratio of neighbouring layers where their number is automatic")
NUMBER(double, layer_count_share, 0.95, none, "1", "of the wall faces that have layers enough then")

// Size field (size/).
NUMBER(double, size_least_open, 0.4, none, "1",
       "of the wanted size, that open edges may ask for: shorter ones would take all cells")
NUMBER(double, size_least_asked, 0.28, none, "1",
       "of the wanted size: where open edges ask for less they get none shorter, for there prisms inside have a small "
       "determinant too")
NUMBER(double, crease_cosine, 0.94, 1, "cosine", "20 degrees between the normals of the faces of a crease")
NUMBER(double, size_least_curvature, 0.4, 1, "1", "of the patch's size, that bends ask for")
NUMBER(double, size_facing, 0.7, 1, "cosine", "of the angle between a ray and the wall that it meets")
NUMBER(double, size_parallel, 0.95, 1, "cosine", "from there on no crease can be the cause of a gap")
NUMBER(double, size_least_share, 0.15, 1, "1",
       "of the base size, for any single feature: what is smaller is resolved by its edges alone")
NUMBER(double, region_cells, 270e3, none, "cells", "of a region at least, where the number of regions is automatic")
NUMBER(double, regions_most, 140, none, "1", "of a domain, where it is automatic")
NUMBER(double, regions_free, 4, none, "1", "that are made however few cells there are")
NUMBER(double, region_cells_fewest, 5000, none, "cells",
       "of a region beyond these: planes through fewer meet in too few edges")
NUMBER(double, prism_longest_open, 16, none, "first heights",
       "of edges of the wall where prisms have a side on the boundary")
NUMBER(double, prism_longest, 30, none, "second heights",
       "of edges of the wall: inside, prisms of the second layer are the thinnest")
NUMBER(double, prism_largest, 40, none, "second heights", "the same of an equilateral triangle as large as any may be")
NUMBER(double, prisms_asked, 2, none, "1", "by walls, of the prisms that they have without their limits, at most")
NUMBER(double, scale_greater, 1.5, none, "1", "scale that walls are limited at, of that without limits")
