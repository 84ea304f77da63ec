// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/blade_shape.hpp"

std::vector<CwBladePatch *> CwBladeShape::patches() {
  std::vector<CwBladePatch *> all = {&pressure, &suction, &leading};
  if (has_bevel) all.push_back(&bevel);
  if (has_trailing) all.push_back(&trailing);
  return all;
}

CwBladeOnWall cw_blade_on_wall(const CwMeridian *meridian, int wall) {
  if (wall == CW_HUB) return {&meridian->hub, meridian->hub_leading, meridian->hub_trailing - meridian->hub_leading};
  return {&meridian->shroud, meridian->shroud_leading, meridian->shroud_trailing - meridian->shroud_leading};
}
