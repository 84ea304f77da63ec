// SPDX-License-Identifier: AGPL-3.0-or-later
// Point in domain: parity of the crossings of a vertical ray with the closed background triangulation.
#ifndef CUTWATER_MESHER_INSIDE_H
#define CUTWATER_MESHER_INSIDE_H

#include "mesher/background.h"

typedef struct CwInside CwInside;

// Sorts the triangles into columns over the xy-plane. `background` must outlive the result.
CwStatus cw_inside_make(const CwBackground *background, CwInside **inside);
void cw_inside_free(CwInside **inside);

// 1 where x (m) lies in the domain, else 0. A point nearer to the surface than the chord error of the
// triangulation may go either way.
int cw_inside(const CwInside *inside, const double x[3]);

#endif
