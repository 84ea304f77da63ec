// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/pump.h"

#include <math.h>

#include "geometry/rotor.h"
#include "geometry/rotor_volume.h"
#include "geometry/stator.h"

static const double degree = M_PI / 180;

CwStatus cw_pump_solid(const CwDesign *design, int which, CwSolid **solid) {
  CwStatus status = CW_OK;
  CW_TRY(which == CW_PUMP_ROTOR ? cw_rotor_build(design, solid) : cw_stator_build(&design->volute, solid));
  if (design->rotation == CW_ROTATION_CLOCKWISE)
    CW_TRY(cw_solid_mirror(*solid));
done:
  return status;
}

static CwStatus check_solid(const CwDesign *design, const CwSolid *solid, const CwMeasuredSolid *measured) {
  CwStatus status = CW_OK;
  const double edge = CW_PUMP_LEAST_EDGE * design->outlet_diameter,
               face = CW_PUMP_LEAST_FACE * design->outlet_diameter;
  CW_REQUIRE(measured->valid && measured->closed && measured->largest_tolerance < CW_PUMP_LARGEST_TOLERANCE,
             CW_ERR_GEOMETRY,
             "%s: the solid is %s and %s, its largest tolerance is %.3g mm; it must be valid, closed and under "
             "%.3g mm: UNSOUND",
             cw_solid_domain(solid), measured->valid ? "valid" : "not valid",
             measured->closed ? "closed" : "not closed", measured->largest_tolerance * 1e3,
             CW_PUMP_LARGEST_TOLERANCE * 1e3);
  CW_REQUIRE(measured->shortest_edge > edge && measured->narrowest_face > face, CW_ERR_GEOMETRY,
             "%s: the shortest edge is %.3g mm long, the narrowest face %.3g mm wide; at least %.3g and %.3g mm "
             "are allowed: raise the thickness, bevel or radius that makes it",
             cw_solid_domain(solid), measured->shortest_edge * 1e3, measured->narrowest_face * 1e3, edge * 1e3,
             face * 1e3);
done:
  return status;
}

static CwStatus check_rotor(const CwDesign *design, CwMeasuredPump *measured) {
  CwStatus status = CW_OK;
  const CwMeasuredAngle *kink = &measured->rotor_dimensions.kink;
  CW_TRY(cw_rotor_volume(design, &measured->rotor_volume_of_sections));
  CW_REQUIRE(fabs(measured->rotor.volume / measured->rotor_volume_of_sections - 1) < CW_PUMP_VOLUME_TOLERANCE,
             CW_ERR_GEOMETRY,
             "rotor: the solid has %.3f cm3, the sections of meridian and blades %.3f cm3; %.2g %% apart are "
             "allowed: UNSOUND",
             measured->rotor.volume * 1e6, measured->rotor_volume_of_sections * 1e6,
             100 * CW_PUMP_VOLUME_TOLERANCE);
  CW_REQUIRE(kink->angle < CW_PUMP_LARGEST_KINK, CW_ERR_GEOMETRY,
             "rotor: faces that should be smooth meet with a kink of %.2f deg at (%.2f, %.2f, %.2f) mm; %.0f deg "
             "are allowed: lower root_fillet_radius_mm or leading_edge_ratio",
             kink->angle / degree, kink->at[0] * 1e3, kink->at[1] * 1e3, kink->at[2] * 1e3,
             CW_PUMP_LARGEST_KINK / degree);
done:
  return status;
}

// Both sides of the interface must be the same cylinder, so that every weight of the coupling is 1.
static CwStatus check_interface(const CwMeasuredRotor *rotor, const CwMeasuredStator *stator) {
  CwStatus status = CW_OK;
  CW_REQUIRE(fabs(rotor->interface_radius - stator->interface_radius) < 1e-8 &&
                 fabs(rotor->interface_area / stator->interface_area - 1) < 1e-6,
             CW_ERR_GEOMETRY,
             "the interface is r = %.6f mm, %.4f mm2 on the rotor and r = %.6f mm, %.4f mm2 on the stator",
             rotor->interface_radius * 1e3, rotor->interface_area * 1e6, stator->interface_radius * 1e3,
             stator->interface_area * 1e6);
done:
  return status;
}

CwStatus cw_pump_measure(const CwDesign *design, const CwSolid *const solid[CW_PUMP_SOLIDS],
                         CwMeasuredPump *measured) {
  CwStatus status = CW_OK;
  CW_TRY(cw_measure_solid(solid[CW_PUMP_ROTOR], &measured->rotor));
  CW_TRY(check_solid(design, solid[CW_PUMP_ROTOR], &measured->rotor));
  CW_TRY(cw_measure_solid(solid[CW_PUMP_STATOR], &measured->stator));
  CW_TRY(check_solid(design, solid[CW_PUMP_STATOR], &measured->stator));
  CW_TRY(cw_measure_rotor(solid[CW_PUMP_ROTOR], &measured->rotor_dimensions));
  CW_TRY(cw_measure_stator(solid[CW_PUMP_STATOR], &measured->stator_dimensions));
  CW_TRY(check_rotor(design, measured));
  CW_TRY(check_interface(&measured->rotor_dimensions, &measured->stator_dimensions));
done:
  return status;
}
