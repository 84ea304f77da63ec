// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include <Standard_Failure.hxx>

#include "mesher/cad/cad.h"
#include "mesher/cad/cad_shape.h"
#include "pipeline/brep/brep_scale.hpp"

CwStatus cw_cad_rescale(CwCad *cad, int power) {
  // The B-rep's unit is a millimetre or up to two from then on: what the library takes for near follows the model too.
  const double millimetre = 1e-3; // m
  int of_unit = std::ilogb(cad->unit / millimetre);
  cad->unit = std::ldexp(cad->unit, -of_unit);
  power += of_unit;
  if (power == 0) return CW_OK;
  try {
    cad->solid = cw_brep_scaled(cad->solid, std::ldexp(1.0, power));
    cw_cad_map_parts(cad);
    cad->face.clear();
    cad->edge.clear();
    return cw_cad_read_parts(cad->path.c_str(), cad);
  } catch (const Standard_Failure &failure) {
    const char *text = failure.GetMessageString();
    return CW_FAIL(CW_ERR_LIBRARY, "%s: OpenCASCADE failed: %s", cad->path.c_str(), text ? text : "?");
  }
}
