// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/picture_list.h"

#include <math.h>
#include <string.h>

#define OPEN_ROTOR "|shroud|suction_pipe|inlet|rotor_interface|"

enum { MERIDIONAL = 11, Z0 = 14 }; // indices of the whole cuts in the list

const CwPictureSpec cw_picture_list[] = {
    // 0
    {.section = CW_SECTION_TITLE, .title = "The pump as meshed",
     .caption = "Seen from the suction side: the impeller's blades on the hub, shroud taken off, within the "
                "hub's half of the volute.",
     .wide = 1, .width = 1180, .height = 760, .sees = CW_SEES_ROTOR | CW_SEES_STATOR,
     .hidden = OPEN_ROTOR "stator_interface|", .upper_half = 1, .towards = {-0.95, 0.1, -1}, .hollow_white = 1,
     .up = {1, 0, 0}, .inset_of = -1},
    // 1
    {.section = CW_SECTION_GEOMETRY, .title = "Rotor from the suction side",
     .caption = "Along the axis; shroud, suction pipe, inlet and interface taken off. White: the metal of the "
                "blades.",
     .width = 760, .height = 640, .sees = CW_SEES_ROTOR, .hidden = OPEN_ROTOR, .hollow_white = 1, .towards = {0, 0, -1}, .up = {0, 1, 0},
     .inset_of = -1},
    {.section = CW_SECTION_GEOMETRY, .title = "Rotor from above",
     .caption = "The same, obliquely: blade height, hub and nut.",
     .width = 760, .height = 640, .sees = CW_SEES_ROTOR, .hidden = OPEN_ROTOR, .hollow_white = 1, .towards = {0, -1, -0.75},
     .up = {0, 0, -1}, .inset_of = -1},
    {.section = CW_SECTION_GEOMETRY, .title = "Rotor, the whole water body",
     .caption = "All boundary patches of the rotating zone, inlet up.",
     .width = 760, .height = 640, .sees = CW_SEES_ROTOR, .hidden = "", .towards = {0, -1, -0.75}, .up = {0, 0, -1},
     .inset_of = -1},
    {.section = CW_SECTION_GEOMETRY, .title = "Stator, the whole water body",
     .caption = "Neck, step, volute, tongue, diffuser and discharge with all boundary patches.",
     .width = 760, .height = 640, .sees = CW_SEES_STATOR, .hidden = "", .towards = {-0.95, 0.1, -1},
     .up = {1, 0, 0}, .inset_of = -1},
    // 5
    {.section = CW_SECTION_SURFACE, .title = "Leading edge",
     .caption = "One blade's leading edge and the hub under it, seen from the eye; the shroud is taken off.",
     .width = 760, .height = 600, .sees = CW_SEES_ROTOR, .hidden = OPEN_ROTOR, .hollow_white = 1, .edges = 1, .target = CW_TARGET_PLACE,
     .place = CW_PLACE_LEADING_EDGE, .span = 0.2, .towards = {-1, 0.35, -0.9}, .up = {0, 0, -1}, .inset_of = -1},
    {.section = CW_SECTION_SURFACE, .title = "Trailing edge",
     .caption = "One blade's bevelled trailing edge, seen from the volute; the shroud is taken off.",
     .width = 760, .height = 600, .sees = CW_SEES_ROTOR, .hidden = OPEN_ROTOR, .hollow_white = 1, .edges = 1, .target = CW_TARGET_PLACE,
     .place = CW_PLACE_TRAILING_EDGE, .span = 0.11, .towards = {1, 0.5, -0.7}, .up = {0, 0, -1}, .inset_of = -1},
    {.section = CW_SECTION_SURFACE, .title = "Tongue",
     .caption = "The tongue with the spiral and the diffuser, cut at z = 0, seen from the impeller over neck and step.",
     .width = 760, .height = 600, .sees = CW_SEES_STATOR, .hidden = "|stator_interface|", .upper_half = 1, .edges = 1,
     .target = CW_TARGET_PLACE, .place = CW_PLACE_TONGUE, .span = 0.17, .towards = {-1, 0.2, -1.1}, .up = {0, 0, -1},
     .inset_of = -1},
    {.section = CW_SECTION_SURFACE, .title = "Blade and passage",
     .caption = "The suction side of one blade on the hub, from its leading edge outwards.",
     .width = 760, .height = 600, .sees = CW_SEES_ROTOR, .hidden = OPEN_ROTOR, .hollow_white = 1, .edges = 1,
     .target = CW_TARGET_PLACE, .place = CW_PLACE_LEADING_EDGE, .span = 0.5, .towards = {-0.9, 0.5, -1},
     .up = {0, 0, -1}, .inset_of = -1},
    // 9
    {.section = CW_SECTION_DECOMPOSITION, .title = "Regions of the rotor", .caption = "Boundary coloured by region.",
     .width = 760, .height = 640, .colour = CW_COLOUR_REGION, .sees = CW_SEES_ROTOR, .hidden = OPEN_ROTOR,
     .hollow_white = 1, .towards = {0, -0.35, -1}, .up = {0, 1, -0.35}, .inset_of = -1},
    {.section = CW_SECTION_DECOMPOSITION, .title = "Regions of the stator", .caption = "Boundary coloured by region.",
     .width = 760, .height = 640, .colour = CW_COLOUR_REGION, .sees = CW_SEES_STATOR, .hidden = "",
     .towards = {-0.35, 0, -1}, .up = {1, 0, 0}, .inset_of = -1},
    // 11
    {.section = CW_SECTION_CUT, .title = "Meridional cut",
     .caption = "Plane through the axis, midway between two blades at the outlet; horizontal the radius, vertical the "
                "axis. Each cell that the plane cuts is drawn with its outline.",
     .wide = 1, .width = 1560, .height = 560, .colour = CW_COLOUR_CUT, .sees = CW_SEES_ROTOR | CW_SEES_STATOR,
     .plane = CW_PLANE_MERIDIONAL, .inset_of = -1},
    {.section = CW_SECTION_CUT, .title = "a: neck and step",
     .caption = "Impeller outlet, interface, neck and the step to the volute; prism layers on all walls.",
     .width = 760, .height = 600, .colour = CW_COLOUR_CUT, .sees = CW_SEES_ROTOR | CW_SEES_STATOR,
     .plane = CW_PLANE_MERIDIONAL, .target = CW_TARGET_NECK, .span = 0.1, .inset_of = MERIDIONAL, .inset_name = "a"},
    {.section = CW_SECTION_CUT, .title = "b: layers on the shroud",
     .caption = "Prism layers at the wall and the passage to the tetrahedra.",
     .width = 760, .height = 600, .colour = CW_COLOUR_CUT, .sees = CW_SEES_ROTOR | CW_SEES_STATOR,
     .plane = CW_PLANE_MERIDIONAL, .target = CW_TARGET_SHROUD, .span = 0.09, .inset_of = MERIDIONAL, .inset_name = "b"},
    // 14
    {.section = CW_SECTION_CUT, .title = "Cut z = 0",
     .caption = "The middle plane of the impeller's outlet, seen from the suction side; blades, hub and casing are "
                "white.",
     .wide = 1, .width = 1560, .height = 1010, .colour = CW_COLOUR_CUT, .sees = CW_SEES_ROTOR | CW_SEES_STATOR,
     .plane = CW_PLANE_Z0, .inset_of = -1},
    {.section = CW_SECTION_CUT, .title = "c: trailing edge",
     .caption = "One blade's trailing edge, the interface behind it and the neck.",
     .width = 760, .height = 600, .colour = CW_COLOUR_CUT, .sees = CW_SEES_ROTOR | CW_SEES_STATOR,
     .plane = CW_PLANE_Z0, .target = CW_TARGET_PLACE, .place = CW_PLACE_TRAILING_EDGE, .span = 0.1, .inset_of = Z0,
     .inset_name = "c"},
    {.section = CW_SECTION_CUT, .title = "d: tongue",
     .caption = "Layers around the tongue's nose, between the spiral and the diffuser.",
     .width = 760, .height = 600, .colour = CW_COLOUR_CUT, .sees = CW_SEES_ROTOR | CW_SEES_STATOR,
     .plane = CW_PLANE_Z0, .target = CW_TARGET_PLACE, .place = CW_PLACE_TONGUE, .span = 0.12, .inset_of = Z0,
     .inset_name = "d"},
};
const int cw_picture_list_count = sizeof cw_picture_list / sizeof *cw_picture_list;

uint32_t cw_patch_colour(const char *name, int index) {
  static const struct {
    const char *name;
    uint32_t colour;
  } known[] = {{"inlet", 0x8fb7d9},          {"suction_pipe", 0xc3ccd4},        {"hub", 0xa9bcae},
               {"hub_nut", 0xd9c27a},        {"shroud", 0xb9c7d6},              {"blade_pressure", 0xd9805f},
               {"blade_suction", 0x5b98c7},  {"blade_leading_edge", 0xf0c040},  {"blade_trailing_edge", 0x8a5fa8},
               {"rotor_interface", 0xa8d5ba}, {"stator_interface", 0xa8d5ba},   {"neck", 0xc9a2c6},
               {"step", 0xe7a977},           {"volute", 0x9dbcd4},              {"tongue", 0xd9584f},
               {"diffuser", 0xc9c6a0},       {"discharge", 0xc3ccd4},           {"outlet", 0x8fb7d9}};
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
    if (!strcmp(name, known[k].name)) return known[k].colour;
  }
  return cw_region_colour(index);
}

uint32_t cw_region_colour(int index) {
  // Hues one golden section of the circle apart: neighbours in number are never alike.
  double hue = fmod(0.58 + 0.61803398875 * index, 1) * 6, least = index % 2 ? 0.52 : 0.62, most = index % 2 ? 0.82 : 0.9;
  uint32_t colour = 0;
  for (int c = 0; c < 3; c++) {
    double offset = fabs(fmod(hue + (c == 0 ? 0 : c == 1 ? 4 : 2), 6) - 3) - 1; // 0 to 1 between the corners of the hue
    double value = least + (most - least) * fmin(fmax(offset, 0), 1);
    colour |= (uint32_t)(255 * value + 0.5) << (16 - 8 * c);
  }
  return colour;
}
