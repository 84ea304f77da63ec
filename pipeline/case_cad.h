// SPDX-License-Identifier: AGPL-3.0-or-later
// The section `cad` of the case file: a pump whose solids come from CAD files in place of the hydraulic design. Points
// are those of the files. docs/own-cad.md is the guide.
#pragma once

#include "pipeline/case.h"
#include "pipeline/case_tree.h"
#include "pipeline/hash.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
  CW_CAD_KIND_OPEN, // by geometry
  CW_CAD_KIND_WALL,
  CW_CAD_KIND_INLET,
  CW_CAD_KIND_OUTLET,
  CW_CAD_KIND_SYMMETRY,
  CW_CAD_KIND_INTERFACE // its faces must touch another domain
} CwCadKind;

typedef enum {
  CW_CAD_WALLS_OPEN,
  CW_CAD_WALLS_BLADE,
  CW_CAD_WALLS_HUB_SHROUD,
  CW_CAD_WALLS_VOLUTE,
  CW_CAD_WALLS_PIPE
} CwCadWalls;

typedef struct {
  int count;
  char **text; // a number is text too
} CwCadTexts;

typedef struct {
  int count;
  double (*at)[3]; // m
} CwCadPoints;

// A domain is made of the solids that its words or points choose.
typedef struct {
  char name[CW_NAME_SIZE];
  CwCadTexts solids;  // names, patterns with * and ?, or numbers from 1 on
  CwCadPoints inside; // points inside
  int rotating;
  CwEventPlace place;
} CwCadDomain;

// A patch takes the faces that one of its words, its colour, its layer or one of its points chooses.
typedef struct {
  char name[CW_NAME_SIZE];
  CwCadTexts faces; // names, patterns, or numbers as the table of faces has them
  CwCadTexts layers;
  CwCadPoints near;
  int colour;                // 0xRRGGBB; -1: none
  char domain[CW_NAME_SIZE]; // only of this one; "": of all
  CwCadKind kind;
  CwCadWalls walls;
  double y_plus;   // NAN: of the group
  double velocity; // m/s; NAN: of the group, or measured
  int turns;       // of a wall: 1 or 0; -1: as its domain
  int monitored;   // of a wall: 1: solvers record its mean pressure; 0; -1: by its name
  CwEventPlace place;
} CwCadPatch;

// A surface of revolution about the axis along which solids are parted: a cylinder, or through points.
typedef struct {
  double radius; // m; 0: none
  int count;
  double (*meridian)[2]; // (r, z), m, z from the point of the axis along it
} CwCadCut;

typedef struct CwCaseCad {
  CwCadTexts files;         // as the case has them, beside the folder of the case file
  double unit;              // of the files, m; 0: STEP files have their own, B-rep files are in mm
  double point[3], axis[3]; // m; unit vector about which the wheel turns by the right hand
  double tolerance;         // of sewing, m; NAN: computed
  CwCadCut cut;
  int names_are_patches; // 1: a face that no patch takes goes by its name in the file
  int domain_count, patch_count;
  CwCadDomain *domain;
  CwCadPatch *patch; // the first that takes a face has it
  CwEventPlace place;
  char digest[CW_HASH_TEXT]; // of all that the section says
} CwCaseCad;

// Reads the section from its tree. `case_path` (as messages show it, and as it is) places relative files. CW_ERR_INPUT
// with FILE:LINE:COLUMN. Free with cw_case_cad_free().
CwStatus cw_case_cad_read(const char *shown_path, const char *case_path, const CwCaseNode *section, CwCaseCad **cad);
void cw_case_cad_free(CwCaseCad *cad);

#ifdef __cplusplus
}
#endif
