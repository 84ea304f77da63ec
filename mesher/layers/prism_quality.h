// SPDX-License-Identifier: AGPL-3.0-or-later
// How sound the thick prism between a wall triangle and the ends of its columns is, and how well shaped its layer top
// is. Corners are those of the wall triangle, normal out of the domain, and the ends of their columns, in its order.
#pragma once

// The least corner Jacobian at any layer between wall and layer top, scaled to 1 for a right prism over the same wall
// triangle.
double cw_prism_quality(const double *const wall[3], const double *const top[3]);

// Least over the corners of a layer top triangle of the sine there, seen along the wall's normal, over that on the
// wall: 1 where it is only moved or smaller, not above 0 where it is turned over. Where columns lean much, prisms may
// be sound and their layer top all the same needles or folds, on which only flat tetrahedra fit.
double cw_prism_top_quality(const double *const wall[3], const double *const top[3]);

// Least determinant (thin_prism.h) of the lowest of `layers` even layers between wall and layer top and of the highest,
// which takes the shares `last` of its columns, over what checkMesh asks for; 1 where it is enough. Layers so thin that
// right prisms would be small too do not count: what is left are columns that lean so much that the sides of their
// prisms are large for base and height. Less too where columns lean apart so much that a side is hardly convex, seen
// from the middle of its prism: of the pyramid between them, either half of either division by a diagonal is to be a
// tenth of the mean at least. Solvers that divide cells so have to find one for both cells beside a side.
double cw_prism_shear_quality(const double *const wall[3], const double *const top[3], int layers,
                              const double last[3]);
