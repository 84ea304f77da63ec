// SPDX-License-Identifier: AGPL-3.0-or-later
// The model that geometry hands on beside the solids: domains, patches and interfaces, whatever made them. Written as
// RUN/geometry/model.json; RUN/mesh/manifest.json holds the same members for the stages after the mesher
// (docs/file-formats.md).
#pragma once

#include <jansson.h>

#include "pipeline/case.h"
#include "pipeline/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CW_DOMAINS_MOST = 64, CW_INTERFACES_MOST = 64, CW_PATCHES_MOST = 64 }; // patches: of a domain
// Names: letters, digits and _. CGNS names have 32 characters, and a patch's is also written with "_triangles", a
// domain's with that of another domain and "_to_" between them. Domains have small letters only.
enum { CW_PATCH_NAME_MOST = 22, CW_DOMAIN_NAME_MOST = 14 };

typedef enum {
  CW_PATCH_WALL,
  CW_PATCH_INLET,
  CW_PATCH_OUTLET,
  CW_PATCH_INTERFACE,
  CW_PATCH_SYMMETRY,
  CW_PATCH_KINDS
} CwPatchKind;

// The wall groups of the case, walls.blade and so on, and the relative sizes mesh.size_blade and so on.
typedef enum {
  CW_GROUP_BLADE,
  CW_GROUP_HUB_SHROUD,
  CW_GROUP_VOLUTE,
  CW_GROUP_PIPE,
  CW_GROUP_INTERFACE, // a size only
  CW_GROUPS
} CwPatchGroup;

// What the two sides of an interface lie on.
typedef enum {
  CW_SURFACE_CYLINDER, // about the axis
  CW_SURFACE_PLANE,
  CW_SURFACE_OTHER, // about the axis where one of its domains rotates
  CW_SURFACES
} CwInterfaceSurface;

// The flow along a wall.
typedef struct {
  double speed;    // m/s
  double length;   // along which the boundary layer grows, m
  double diameter; // hydraulic, of the passage, m
  double width;    // from wall to wall, where the passage is narrowest, m
  double before;   // way to an open patch that the wall looks at, m; 0: none
} CwWallFlow;

typedef struct {
  char name[CW_NAME_SIZE];
  CwPatchKind kind;
  int domain;
  CwPatchGroup size;   // relative size of its edges
  CwPatchGroup group;  // of a wall
  CwWallFlow flow;     // of a wall
  double y_plus_asked; // of a wall, in place of its group's; NAN: none
  double y_plus;       // of a wall, that its layers were made for; NAN: not yet, or the flow along it is laminar
  int turns;           // of a wall: 1: it turns with the impeller
  int monitored;       // of a wall: 1: solvers record its mean pressure
  double flow_share;   // of an outlet: its part of the flow rate
} CwModelPatch;

typedef struct {
  char name[CW_NAME_SIZE];
  int rotating;                 // 1: solved in the frame of the impeller
  int first_patch, patch_count; // into CwModel.patch
} CwModelDomain;

typedef struct {
  int patch[2]; // of two domains
  CwInterfaceSurface surface;
  double radius; // of a cylinder, m
} CwModelInterface;

// What solvers start from.
typedef struct {
  double inlet_speed, inlet_diameter;  // of the flow before the pump, m/s; hydraulic, m
  double passage_speed, passage_width; // the mean along the blades, m/s; m
  double reference_length;             // outlet diameter of the impeller, m
  int blade_count;                     // without splitters: what turns looks the same after so many parts of a turn
} CwModelFlow;

typedef struct {
  double unit; // of the B-rep files, m
  int domain_count, patch_count, interface_count;
  CwModelDomain domain[CW_DOMAINS_MOST];
  CwModelPatch *patch; // domain after domain
  CwModelInterface *interface;
  CwModelFlow flow;
} CwModel;

// Adds to a model that was zeroed at first. Patches belong to the domain that was added last; a patch begins with the
// group volute where it is a wall, the size interface or pipe where it is not, turning with its domain. CW_ERR_INPUT
// for a name that is not allowed or taken, or more of either than allowed. *patch: where it stands until the next
// is added.
CwStatus cw_model_add_domain(CwModel *model, const char *name, int rotating);
CwStatus cw_model_add_patch(CwModel *model, const char *name, CwPatchKind kind, CwModelPatch **patch);
// Between two patches of kind interface, of two domains, by name; `radius` of a cylinder. CW_ERR_INPUT else.
CwStatus cw_model_add_interface(CwModel *model, const char *const patch[2], CwInterfaceSurface surface, double radius);

// What a domain's zone (CGNS, CFX) and its family (CGNS) are called: the name in capitals, and with _domain behind it.
void cw_domain_zone_name(const char *domain, char name[CW_NAME_SIZE]);
void cw_domain_family_name(const char *domain, char name[CW_NAME_SIZE]);

// The index of what is called so, or -1.
int cw_model_domain_find(const CwModel *model, const char *name);
int cw_model_patch_find(const CwModel *model, const char *name);
// Of so many interfaces that which a patch is a side of, and which side, or -1.
int cw_interface_of(const CwModelInterface *interface, int count, int patch, int *side);
const char *cw_patch_kind_name(CwPatchKind kind);
const char *cw_patch_group_name(CwPatchGroup group);

// Whole or not at all. CW_ERR_INPUT where a patch of kind interface is no side of one, or an outlet's share, a speed or
// a length is not above 0; CW_ERR_IO.
CwStatus cw_model_write(const CwModel *model, const char *path);
// CW_ERR_IO; CW_ERR_INPUT with the file and what is wrong in it. Zeroed `model` on entry.
CwStatus cw_model_read(const char *path, CwModel *model);
void cw_model_free(CwModel *model);

// The members of the model in an object of their own, and from an object that has others too, which messages call
// `where`.
CwStatus cw_model_pack(const CwModel *model, json_t **root);
CwStatus cw_model_unpack(json_t *root, const char *where, CwModel *model);

#ifdef __cplusplus
}
#endif
