// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/picture_list.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Sizes: over the page, two beside one another, details.
#define WIDE .wide = 1, .width = 1180, .height = 760
#define OF_TWO .width = 760, .height = 640
#define DETAIL .width = 760, .height = 600

// Around one of the survey's places.
#define AROUND(where, over_diameter) .target = CW_TARGET_PLACE, .place = where, .span = over_diameter

// Cuts, and details of them.
#define MERIDIONAL_CUT .colour = CW_COLOUR_CUT, .sees = CW_SEES_ROTOR | CW_SEES_STATOR, .plane = CW_PLANE_MERIDIONAL
#define Z0_CUT .colour = CW_COLOUR_CUT, .sees = CW_SEES_ALL, .plane = CW_PLANE_Z0
#define INSET(whole, name) DETAIL, .inset_of = whole, .inset_name = name

// One way for all: along the axis and obliquely from the suction side, x up, so that the discharge leads to the right;
// across the axis and close by, the suction side up.
#define ALONG_AXIS .towards = {0, 0, -1}, .up = {1, 0, 0}
#define ALMOST_ALONG_AXIS .towards = {-0.35, 0, -1}, .up = {1, 0, 0}
#define OBLIQUE .towards = {-0.95, 0.1, -1}, .up = {1, 0, 0}
#define STEEP .towards = {-0.95, 0.1, -0.6}, .up = {1, 0, 0}

// What lies before the blades is taken off.
#define COVER "|shroud|suction_pipe|inlet|rotor_interface|"
#define OPEN_ROTOR_AND(more) .sees = CW_SEES_ROTOR, .hidden = COVER more, .hollow_white = 1
#define OPEN_ROTOR OPEN_ROTOR_AND("")
#define OPEN_PUMP                                                                                                      \
  .sees = CW_SEES_ROTOR | CW_SEES_STATOR, .hidden = COVER "stator_interface|", .drive_half = 1, .hollow_white = 1,     \
  OBLIQUE

enum { MERIDIONAL = 11, Z0 = 14 }; // indices of the whole cuts in the list

const CwPictureSpec cw_picture_list[] = {
    // 0
    {.section = CW_SECTION_TITLE,
     .title = "The pump as meshed",
     .caption = "Obliquely from the suction side, x up: the impeller's blades on the hub, shroud taken off, within the "
                "hub's half of the volute.",
     WIDE,
     OPEN_PUMP},
    // 1
    {.section = CW_SECTION_GEOMETRY,
     .title = "Rotor from the suction side",
     .caption = "Along the axis; shroud, suction pipe, inlet and interface taken off. White: the metal of the blades.",
     OF_TWO,
     OPEN_ROTOR,
     ALONG_AXIS},
    {.section = CW_SECTION_GEOMETRY,
     .title = "Rotor, obliquely",
     .caption = "The same: blade height, hub and nut.",
     OF_TWO,
     OPEN_ROTOR,
     OBLIQUE},
    {.section = CW_SECTION_GEOMETRY,
     .title = "Rotor, the whole water body",
     .caption = "All boundary patches of the rotating zone.",
     OF_TWO,
     .sees = CW_SEES_ROTOR,
     .hidden = "",
     OBLIQUE},
    {.section = CW_SECTION_GEOMETRY,
     .title = "Stator, the whole water body",
     .caption = "Neck, step, volute, tongue, diffuser and discharge with all boundary patches.",
     OF_TWO,
     .sees = CW_SEES_STATOR,
     .hidden = "",
     OBLIQUE},
    // 5
    {.section = CW_SECTION_SURFACE,
     .title = "Leading edge",
     .caption = "One blade's leading edge down to its root on the hub, seen from the eye; shroud, nut and shaft are "
                "taken off.",
     DETAIL,
     OPEN_ROTOR_AND("hub_nut|hub_shaft|"),
     .edges = 1,
     AROUND(CW_PLACE_LEADING_EDGE, 0.2),
     .towards = {-1, 0.35, -0.9},
     .up = {0, 0, -1}},
    {.section = CW_SECTION_SURFACE,
     .title = "Trailing edge",
     .caption = "One blade's bevelled trailing edge, seen from the volute; the shroud is taken off.",
     DETAIL,
     OPEN_ROTOR,
     .edges = 1,
     AROUND(CW_PLACE_TRAILING_EDGE, 0.11),
     .towards = {1, 0.5, -0.7},
     .up = {0, 0, -1}},
    {.section = CW_SECTION_SURFACE,
     .title = "Tongue",
     .caption = "The tongue with the spiral and the diffuser, cut at z = 0, seen from the impeller over neck and step.",
     DETAIL,
     .sees = CW_SEES_STATOR,
     .hidden = "|stator_interface|",
     .drive_half = 1,
     .edges = 1,
     AROUND(CW_PLACE_TONGUE, 0.17),
     .towards = {-1, 0.2, -1.1},
     .up = {0, 0, -1}},
    {.section = CW_SECTION_SURFACE,
     .title = "Blade and passage",
     .caption = "The suction side of one blade on the hub, from its leading edge outwards.",
     DETAIL,
     OPEN_ROTOR,
     .edges = 1,
     AROUND(CW_PLACE_LEADING_EDGE, 0.5),
     .towards = {-0.9, 0.5, -1},
     .up = {0, 0, -1}},
    // 9
    {.section = CW_SECTION_DECOMPOSITION,
     .title = "Regions of the rotor",
     .caption = "Boundary coloured by region, with the numbers of the charts below.",
     OF_TWO,
     .colour = CW_COLOUR_REGION,
     OPEN_ROTOR,
     ALMOST_ALONG_AXIS},
    {.section = CW_SECTION_DECOMPOSITION,
     .title = "Regions of the stator",
     .caption = "Boundary coloured by region, with the numbers of the charts below.",
     OF_TWO,
     .colour = CW_COLOUR_REGION,
     .sees = CW_SEES_STATOR,
     .hidden = "",
     ALMOST_ALONG_AXIS},
    // 11
    {.section = CW_SECTION_CUT,
     .title = "Meridional cut",
     .caption = "Plane through the axis, midway between two blades at the outlet; horizontal the radius, vertical the "
                "axis, the suction side up. Each cell that the plane cuts is drawn with its outline.",
     .wide = 1,
     .width = 1560,
     .height = 560,
     MERIDIONAL_CUT},
    {.section = CW_SECTION_CUT,
     .title = "a: neck and step",
     .caption = "Impeller outlet, interface, neck and the step to the volute; prism layers on all walls.",
     MERIDIONAL_CUT,
     INSET(MERIDIONAL, "a"),
     .target = CW_TARGET_NECK,
     .span = 0.1},
    {.section = CW_SECTION_CUT,
     .title = "b: layers on the shroud",
     .caption = "Prism layers at the wall and the passage to the tetrahedra.",
     MERIDIONAL_CUT,
     INSET(MERIDIONAL, "b"),
     .target = CW_TARGET_SHROUD,
     .span = 0.09},
    // 14
    {.section = CW_SECTION_CUT,
     .title = "Cut z = 0",
     .caption = "The middle plane of the impeller's outlet, seen from the suction side; blades, hub and casing are "
                "white.",
     .wide = 1,
     .width = 1560,
     .height = 1010,
     Z0_CUT},
    {.section = CW_SECTION_CUT,
     .title = "c: trailing edge",
     .caption = "One blade's trailing edge, the interface behind it and the neck.",
     Z0_CUT,
     INSET(Z0, "c"),
     AROUND(CW_PLACE_TRAILING_EDGE, 0.1)},
    {.section = CW_SECTION_CUT,
     .title = "d: tongue",
     .caption = "Layers around the tongue's nose, between the spiral and the diffuser.",
     Z0_CUT,
     INSET(Z0, "d"),
     AROUND(CW_PLACE_TONGUE, 0.12)},
    // 17
    {.section = CW_SECTION_GEOMETRY,
     .title = "All zones",
     .caption = "The rotor, the stator and the pipes that are zones of their own, with all boundary patches.",
     WIDE,
     .sees = CW_SEES_ALL,
     .needs_pipes = 1,
     .hidden = "",
     STEEP},
    {.section = CW_SECTION_DECOMPOSITION,
     .title = "Regions of the pipes",
     .caption = "Boundary of the pipes that are zones of their own, coloured by region; each zone has numbers "
                "of its own.",
     OF_TWO,
     .colour = CW_COLOUR_REGION,
     .sees = CW_SEES_PIPES,
     .needs_pipes = 1,
     .hidden = "",
     STEEP},
    // 19
    {.section = CW_SECTION_FLOW,
     .title = "Pressure on the walls",
     .caption = "Static pressure of the solved flow, shroud taken off.",
     .colour = CW_COLOUR_PRESSURE,
     WIDE,
     OPEN_PUMP},
    {.section = CW_SECTION_FLOW,
     .title = "Pressure, rotor obliquely",
     .caption = "On hub and blades, shroud taken off.",
     .colour = CW_COLOUR_PRESSURE,
     OF_TWO,
     OPEN_ROTOR,
     OBLIQUE},
    {.section = CW_SECTION_FLOW,
     .title = "y+, rotor obliquely",
     .caption = "Of the solution, on hub and blades.",
     .colour = CW_COLOUR_Y_PLUS,
     OF_TWO,
     OPEN_ROTOR,
     OBLIQUE},
    {.section = CW_SECTION_FLOW,
     .title = "y+ on the walls",
     .caption = "Of the solution; shroud taken off.",
     .colour = CW_COLOUR_Y_PLUS,
     WIDE,
     OPEN_PUMP},
    {.section = CW_SECTION_FLOW,
     .title = "Relative velocity on the middle plane",
     .caption = "Plane z = 0, cell by cell: in the rotor the speed in its turning frame, elsewhere the absolute "
                "one; white: streamlines of the velocity in the plane.",
     .colour = CW_COLOUR_SPEED,
     .wide = 1,
     .width = 1560,
     .height = 1010,
     .sees = CW_SEES_ALL,
     .plane = CW_PLANE_Z0},
    {.section = CW_SECTION_FLOW,
     .title = "Relative velocity at mid-span",
     .caption = "On the surface of revolution midway between hub and shroud, in plan from the suction side; white: "
                "streamlines of the velocity across the axis.",
     .wide = 1,
     .colour = CW_COLOUR_SPEED,
     .width = 1180,
     .height = 900,
     .sees = CW_SEES_ROTOR,
     .plane = CW_PLANE_MID_SPAN},
    {.section = CW_SECTION_FLOW,
     .title = "Relative velocity near the hub",
     .caption = "The same at 0.1 of the way from hub to shroud.",
     .colour = CW_COLOUR_SPEED,
     OF_TWO,
     .sees = CW_SEES_ROTOR,
     .plane = CW_PLANE_NEAR_HUB},
    {.section = CW_SECTION_FLOW,
     .title = "Relative velocity near the shroud",
     .caption = "The same at 0.9 of the way from hub to shroud.",
     .colour = CW_COLOUR_SPEED,
     OF_TWO,
     .sees = CW_SEES_ROTOR,
     .plane = CW_PLANE_NEAR_SHROUD},
};
const int cw_picture_list_count = sizeof cw_picture_list / sizeof *cw_picture_list;

double cw_plane_span(CwPicturePlane plane) {
  switch (plane) {
  case CW_PLANE_NEAR_HUB:
    return 0.1;
  case CW_PLANE_MID_SPAN:
    return 0.5;
  case CW_PLANE_NEAR_SHROUD:
    return 0.9;
  default:
    return NAN;
  }
}

int cw_picture_hides(const CwPictureSpec *spec, const char *patch) {
  char name[CW_NAME_SIZE + 2];
  snprintf(name, sizeof name, "|%s|", patch);
  return strstr(spec->hidden, name) != NULL;
}

uint32_t cw_patch_colour(const char *name, int index) {
  static const struct {
    const char *name;
    uint32_t colour;
  } known[] = {{"inlet", 0x8fb7d9},
               {"suction_pipe", 0xc3ccd4},
               {"hub", 0xa9bcae},
               {"hub_nut", 0xd9c27a},
               {"hub_shaft", 0x98a3ad},
               {"hub_shaft_pipe", 0x98a3ad},
               {"shroud", 0xb9c7d6},
               {"blade_pressure", 0xd9805f},
               {"blade_suction", 0x5b98c7},
               {"blade_leading_edge", 0xf0c040},
               {"blade_trailing_edge", 0x8a5fa8},
               {"rotor_interface", 0xa8d5ba},
               {"stator_interface", 0xa8d5ba},
               {"neck", 0xc9a2c6},
               {"step", 0xe7a977},
               {"volute", 0x9dbcd4},
               {"tongue", 0xd9584f},
               {"diffuser", 0xc9c6a0},
               {"discharge", 0xc3ccd4},
               {"outlet", 0x8fb7d9},
               {"inlet_pipe", 0xd7dde2},
               {"outlet_pipe", 0xd7dde2},
               {"rotor_to_suction", 0xa8d5ba},
               {"suction_to_rotor", 0xa8d5ba},
               {"stator_to_discharge", 0xa8d5ba},
               {"discharge_to_stator", 0xa8d5ba}};
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
    if (!strcmp(name, known[k].name)) return known[k].colour;
  }
  return cw_region_colour(index);
}

uint32_t cw_domain_colour(int domain, int shade) {
  static const uint32_t colour[][3] = {{0x4f8fc0, 0x8db4da, 0xdbe7f2},
                                       {0xd9a24e, 0xe2bb78, 0xf6ecd6},
                                       {0x5f9e7c, 0x9cc9af, 0xe0efe6},
                                       {0xb9728a, 0xdaaab9, 0xf4e4e9}};
  return colour[(size_t)domain % (sizeof colour / sizeof *colour)][shade];
}

uint32_t cw_region_colour(int index) {
  // Hues one golden section of the circle apart: neighbours in number are never alike.
  double hue = fmod(0.58 + 0.61803398875 * index, 1) * 6, least = index % 2 ? 0.52 : 0.62,
         most = index % 2 ? 0.82 : 0.9;
  uint32_t colour = 0;
  for (int c = 0; c < 3; c++) {
    double offset = fabs(fmod(hue + (c == 0 ? 0 : c == 1 ? 4 : 2),
                              6) - 3) - 1; // 0 to 1 between the corners of the hue
    double value = least + (most - least) * fmin(fmax(offset, 0), 1);
    colour |= (uint32_t)(255 * value + 0.5) << (16 - 8 * c);
  }
  return colour;
}
