// SPDX-License-Identifier: AGPL-3.0-or-later
// The tuned numbers of the mesher, by room:
//
//   NUMBER(type, name, value, off, unit, meaning and evidence)
//
// A file that needs them defines NUMBER and includes this one, as policy.h does, more than once. `off`: the value that
// switches off what the number rules; `none` where no value does. Units: `1` of ratios and counts, `h` the wanted edge
// length at the place, `edge` that of the triangle or tetrahedron, `quality` that of cw_tet_quality, mostly the sine of
// the least dihedral angle. What is not here is mathematics, a constant of physics or of a format, a bound of rounding,
// a resolution or a bound of tries that only costs time, or one of those that still stand in their sources: what the
// first pass counts cells by (run/cell_count.c), predicted times of tasks (run/), and factors in the expressions of
// surface/ and boundary/. tests/bench/ablate.py measures what each number of the table does.

// What several rooms share.
NUMBER(double, flat_angle, 12, 0, "degrees",
       "of tetrahedra: where the boundary allows more a search begins below, and again, and edges become shorter: what "
       "counts as good; 13 for the search: no better")
NUMBER(double, wanted_angle, 20, 0, "degrees",
       "of tetrahedra: below, new points are tried round about, and a search counts what is less; narrower concave "
       "edges are opened, wall triangles with greater angles are fair, planes that cross CAD edges at less run along "
       "them, and layers go where edges would be so long that triangles over narrow faces have less")
NUMBER(double, improve_below, 0.4226, 0, "quality",
       "sine of 25 degrees: what is less is improved, and concave edges are opened up to it; more costs time and "
       "aspect and gives no better worst ones")
NUMBER(double, sound_quality, 0.05, 0, "quality",
       "least, of prisms where better ones cannot be had, and of what moves for the aspect and disturbances leave: "
       "flips follow, and mend nearly all of it")
NUMBER(double, least_distance, 0.65, 0, "h",
       "of new points on surfaces, of offset points and of lattice points from them (of their spacing), and between "
       "the layers of walls that face each other (of edges): there 0.5 leaves angles of 9 degrees, 0.8 thin last "
       "layers (pumps of nq 7 to 9 at 150,000 cells); of offset points 0.7: aspect 0.3 % greater")
NUMBER(double, boundary_distance, 0.5, none, "h",
       "or edge, where that is less: least distance of lattice points to boundary triangles, of points on surfaces to "
       "given edges, and of partition planes to CAD edges; a quarter more or less moves the mean aspect by 2 %")
NUMBER(double, slope, 0.3, none, "1",
       "change per distance, at most: of thicknesses of columns, of sizes away from short given edges, and from layer "
       "to layer where their number is automatic, each 1.3 times as tall as the one below")
NUMBER(double, crease_cosine, 0.94, 1, "cosine",
       "20 degrees between normals: of the faces of a crease, or of CAD edges that are a feature; less apart are walls "
       "as good as flat, pairs that may be flipped and walls of a gap that no crease causes")
NUMBER(double, upright_cosine, 0.5, 0, "cosine",
       "60 degrees: columns of lines of planes that lean more to a wall's normal are lower, and their planes are "
       "moved: cells had small determinants (the paper's pump of 100 million cells); triangles that lean more to "
       "their surface at a corner are divided")
NUMBER(double, column_least_cosine, 0.3, 0, "cosine",
       "of a column to the normals of its wall, that a search may choose: vertices of the wall that allow no more are "
       "flipped open, and lines of partition planes that lean more will not do")
NUMBER(double, column_kept, 0.8, 1, "1", "that a thinned column keeps, and all about a failed region")
NUMBER(double, missed_share, 0.01, 0, "1",
       "of the wall faces that may miss a first height for which there is room, and of the area that may be nearer to "
       "the wall opposite than its layers have room for: what counts as good")

// Single changes.
NUMBER(int64_t, improve_passes, 5, 0, "1", "over the list, at most")
NUMBER(double, least_gain, 2e-3, 0, "quality",
       "of a move or a new point: smaller ones of moves cost much and give little; of points 0.02 gives no better "
       "aspect")
NUMBER(double, usual_aspect, 1.5, none, "1",
       "longest over shortest edge: neither helps nor hinders a sum of aspects; above, the longest edge may go; a "
       "quarter more or less: aspect 1 %")

// Moves of all points at once.
NUMBER(double, even_pull, 0.3, 0, "edge",
       "that the first step towards even edges goes; without any the aspect is 1.3 % greater")
NUMBER(int64_t, even_steps, 5, 0, "1", "each shorter by the same")

// Search of patches for what single changes cannot mend; without it least angles are 1.7 degrees less.
NUMBER(double, search_wanted, 0.3090, none, "sine",
       "18 degrees: and below where the boundary allows more; layer tops leave room for three beside a plane")
NUMBER(int64_t, search_patch, 150, none, "tetrahedra", "of a patch; of 300: 0.4 degrees less in the same time")
NUMBER(
    int64_t, search_vain, 20, none, "1",
    "tries in a row without gain that end a beginning; of 10 to 60 angles are as good (regions of 18 solids from CAD)")
NUMBER(int64_t, search_share, 500, none, "tetrahedra",
       "of a mesh for one try more, and for a bad one: where there are more bad ones it is the boundary that asks for "
       "them, and a search is time wasted")
NUMBER(int64_t, search_fewest, 600, 0, "1", "tries of a mesh, or more by the share")
NUMBER(int64_t, search_any, 40, 0, "1",
       "bad ones that are searched in any mesh, however small: with none, angles of 4 degrees stay where 10 can be had "
       "(pumps of nq 8 at 150,000 cells, regions of 1200 tetrahedra)")

// Decomposition (plan/).
NUMBER(double, plan_uneven, 0.15, none, "1",
       "of the mean, that a region's work may be off: a fault; with 0.1 angles beside planes are 1 degree less")
NUMBER(double, plan_area, 0.125, 0, "1",
       "faults of a section as large as the face of a cube of the part's volume; without, planes along a pipe, a tenth "
       "more interfaces")
NUMBER(double, plan_room, 2, 1, "1",
       "times the least room, beside lines and edges of two planes, layers of walls and other lines: from there on "
       "nothing is cramped")

// Triangles on surfaces (surface/, region/).
NUMBER(double, surface_clearly_less, 0.9, 1, "1",
       "of the longest: triangles are too large only where edges are wanted that are shorter")
NUMBER(double, front_done_radius, 0.74, none, "h",
       "radius of the circumscribed circle of a triangle that is done; equilateral: 0.577")
NUMBER(double, surface_long_edge, 1.45, none, "h", "longer ones are divided")
NUMBER(double, interface_sphere, 1, 0, "1",
       "radius over that of the circumscribed circle, kept free by the rule of region numbers; 1.05: no better")
NUMBER(double, surface_least_distance, 0.62, 0, "h",
       "of points: edges that are shorter go, and new points of interfaces stay as far apart as lattice points keep "
       "from the boundary")

// Runs (run/).
NUMBER(double, poor_rare, 5e7, none, "cells",
       "for each region with flat tetrahedra, from which on the mesh is not made anew for them: at 1,000 million cells "
       "two such regions doubled the time")
NUMBER(double, thin_reach, 4, none, "h", "about a failure in which layers are thinned; doubled each time")

// Layers (layers/, boundary/).
NUMBER(double, concave_rise, 0.3, none, "1", "of an edge of the wall over its length: a bend is concave, at the latest")
NUMBER(double, gap_share, 0.35, none, "1", "of the gap to another wall, the most that a column takes")
NUMBER(double, fit_share, 0.2, none, "1",
       "of a passage's width, what even layers take whose asked first height does not fit: with gap_share ten pumps of "
       "the population with options had it on 37 to 93 % of the walls and least angles from 3.2 degrees, with this on "
       "53 to 99 %, from 6.4 degrees")
NUMBER(double, core_ratio, 4, none, "1",
       "volume of a tetrahedron across that over the last prism, at most: what counts as even")
NUMBER(double, convex_cosine, 0.92, none, "cosine",
       "23 degrees from the most normal direction to a face: columns slide along convex edges that are sharper; with "
       "crease_cosine layers at blunt trailing edges are 2 % thinner (test_layers_pump)")
NUMBER(double, lean_share, 0.6, none, "1",
       "of the best cosine to the wall's normals, that columns and prisms keep which lean; with 0.5 columns at knife "
       "edges are thinned (test_layers_pump)")
NUMBER(double, free_share, 0.6, 1, "1",
       "of the way to an open patch, which has no layers, and of the thickness at which columns that lean to each "
       "other would meet: what a column takes at most; with 1 least angles are 3 degrees less (9 pumps, 150,000 cells)")
NUMBER(double, prism_good, 0.12, 0, "quality", "of prisms and their layer tops that is asked for")
NUMBER(double, top_flip_gain, 1.1, none, "1", "least factor by which a flip raises the least angle of the layer top")
NUMBER(double, smoothing_reach, 6, 0, "layers",
       "the smoothing ends at this many thicknesses from its source, and the opening of the crease is forgotten")
NUMBER(double, smoothing_poor, 0.2, 0, "quality",
       "of prisms under which a smoothing is widened; as prism_good columns at knife edges and in wedges are thinned "
       "(test_layers_pump)")
NUMBER(double, smoothing_widest, 5, 1, "1",
       "times its reach; without it least angles of the paper's rotor are 14 to 18 degrees for 20 to 21 and its aspect "
       "0.4 to 0.8 % greater (4 to 8 million cells; fewer: no difference)")
NUMBER(double, turn_top, 0.4, none, "1", "what the quality of the layer top counts beside that of prisms")

// Layer thickness (thickness/).
NUMBER(double, least_growth, 0.6, 1, "1",
       "of layers in thinned columns; of more than the usual number the last is as great a part of the first: without "
       "that tetrahedra had 20,000 times the volume of prisms beside them (17 layers, 150,000 cells)")
NUMBER(double, layer_count_share, 0.95, none, "1", "of the wall faces that have layers enough then")

// Size field (size/).
NUMBER(double, size_least, 0.4, 1, "1",
       "of the wanted size, that open edges and bends may ask for: shorter ones would take all cells")
NUMBER(double, size_least_asked, 0.28, none, "1",
       "of the wanted size: where open edges ask for less they get none shorter, for there prisms inside have a small "
       "determinant too")
NUMBER(double, size_facing, 0.7, 1, "cosine", "of the angle between a ray and the wall that it meets")
NUMBER(double, size_least_share, 0.15, 1, "1",
       "of the wanted size: what is smaller is no feature of its own, resolved by its edges alone; breaks of two "
       "domains that are nearer share one place")
NUMBER(double, region_cells, 270e3, none, "cells", "of a region at least, where the number of regions is automatic")
NUMBER(double, regions_most, 140, none, "1",
       "of the whole mesh, where their size is automatic and region_cells_most does not ask for more")
NUMBER(double, region_cells_most, 2e6, none, "cells",
       "of a region at most, where their size is automatic: 0.2 GB of the rank that fills it")
NUMBER(double, region_cells_fewest, 5000, none, "cells",
       "of a region beyond these: planes through fewer meet in too few edges")
NUMBER(double, prism_longest_open, 16, none, "first heights",
       "of edges of the wall where prisms have a side on the boundary")
NUMBER(double, prism_longest, 30, none, "second heights",
       "of edges of the wall, and of those of an equilateral triangle as large as any may be: inside, prisms of the "
       "second layer are the thinnest")
NUMBER(double, walls_ask_most, 2, none, "1",
       "times: prisms that walls may have by their limits, and the scale they are limited at, of those without limits")
