// SPDX-License-Identifier: AGPL-3.0-or-later
// Which pictures there are: what each shows, from where, how large.
#pragma once

#include <stdint.h>

#include "pipeline/report/survey.h"

typedef enum {
  CW_SECTION_TITLE,
  CW_SECTION_GEOMETRY,
  CW_SECTION_SURFACE,
  CW_SECTION_DECOMPOSITION,
  CW_SECTION_CUT,
  CW_SECTION_FLOW,
} CwPictureSection;

enum { CW_SEES_ROTOR = 1, CW_SEES_STATOR = 2, CW_SEES_PIPES = 4, CW_SEES_ALL = 7 };

// From CW_COLOUR_PRESSURE on: of the solved flow, in the order of CwFlowQuantity.
typedef enum {
  CW_COLOUR_PATCH,
  CW_COLOUR_REGION,
  CW_COLOUR_CUT,
  CW_COLOUR_PRESSURE,
  CW_COLOUR_Y_PLUS,
  CW_COLOUR_SPEED,
} CwPictureColour;
// NEAR_HUB and those behind it: surfaces of revolution between hub and shroud, in plan.
typedef enum {
  CW_PLANE_NONE,
  CW_PLANE_MERIDIONAL,
  CW_PLANE_Z0,
  CW_PLANE_NEAR_HUB,
  CW_PLANE_MID_SPAN,
  CW_PLANE_NEAR_SHROUD,
  CW_PLANE_COUNT,
} CwPicturePlane;

typedef enum {
  CW_TARGET_ALL,    // all that is seen
  CW_TARGET_PLACE,  // around one of the survey's places
  CW_TARGET_NECK,   // at the interface radius, in the meridional plane
  CW_TARGET_SHROUD, // at the shroud, in the meridional plane
} CwPictureTarget;

// One row of the table of pictures, whose columns are the fields.
typedef struct {
  CwPictureSection section;
  const char *title, *caption;
  int wide;          // takes the width of the page
  int width, height; // px
  CwPictureColour colour;
  unsigned sees;
  const char *hidden; // names of patches that are left out, "|a|b|"
  int needs_pipes;    // only where pipes are zones of their own
  int drive_half;     // of the stator, what lies on the side of the suction from z = 0 is cut off
  int hollow_white;   // faces of the rotor seen from within the metal are left white
  int edges;          // with the edges of the faces
  CwPicturePlane plane;
  CwPictureTarget target;
  CwPlace place;
  double span; // width of the picture over the outlet diameter; 0: all
  // Towards the viewer and upwards: x, y, z; of a place: along the radius, the direction of rotation, the axis. Of a
  // pump with its suction at z < 0; others are seen in the mirror z = 0, from their suction side too.
  double towards[3], up[3];
  const char *inset_name; // NULL: in no other picture
  int inset_of;           // index of the picture in which this one is framed
} CwPictureSpec;

// Share of the way from hub to shroud at which the surface lies; NAN for a true plane.
double cw_plane_span(CwPicturePlane plane);

static inline int cw_picture_is_of_flow(const CwPictureSpec *spec) {
  return spec->colour >= CW_COLOUR_PRESSURE;
}

// Whether the picture, which shows faces, leaves out the patch of that name.
int cw_picture_hides(const CwPictureSpec *spec, const char *patch);

extern const CwPictureSpec cw_picture_list[];
extern const int cw_picture_list_count;

// Colour of a patch by its name; of an unknown one by its index.
uint32_t cw_patch_colour(const char *name, int index);
uint32_t cw_region_colour(int index);

// Colour of a domain in charts and cuts: 0 full, 1 for its prisms, 2 for its tetrahedra.
uint32_t cw_domain_colour(int domain, int shade);
