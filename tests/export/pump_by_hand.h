// SPDX-License-Identifier: AGPL-3.0-or-later
// A pump of four zones without a mesh, for tests of the files that stand beside one: rotor and chamber turn, stator and
// suction stand still. And the text of such files.
#pragma once

#include "export/assembly.h"
#include "pipeline/case.h"
#include "tests/test_folder.h"
#include "tests/whole_file.h"

enum { ROTOR, CHAMBER, STATOR, SUCTION, ZONES };
// Patches, zone after zone.
enum { HUB, BLADE, RING, ROTOR_IN, ROTOR_OUT, ROTOR_GAP, ROTOR_LEAK };
enum { DISC = ROTOR_LEAK + 1, LID, CHAMBER_GAP };
enum { STATOR_IN = CHAMBER_GAP + 1, STATOR_LEAK, VOLUTE, TONGUE, OUTLET, DRAIN, MIDDLE };
enum { SUCTION_OUT = MIDDLE + 1, PIPE, SHAFT, INLET, FEED, PATCHES };
enum { INTERFACES = 4 };

typedef struct {
  CwModelPatch patches[PATCHES];
  CwModelInterface interfaces[INTERFACES];
  CwPatchPart parts[PATCHES];
  CwMesh mesh;
  CwAssembly assembly;
  CwCase table;
} PumpByHand;

// 1 kg of its water is 1/800 m3; 0.01 m3/s flow through it, three quarters of them to the outlet; it turns by 100
// rad/s, 200 time steps a turn. The ring about the rotor stands still, the shaft in the suction turns. No face lies on
// the lid of the chamber. Patch p has an area of p + 1 m2 along z, and layers for y+ 30 where it is a wall.
static inline void pump_by_hand(PumpByHand *pump) {
  static const CwModelPatch patches[PATCHES] = {
      [HUB] = {.name = "hub", .domain = ROTOR, .turns = 1, .group = CW_GROUP_HUB_SHROUD},
      [BLADE] = {.name = "blade", .domain = ROTOR, .turns = 1, .group = CW_GROUP_BLADE},
      [RING] = {.name = "ring", .domain = ROTOR, .group = CW_GROUP_PIPE},
      [ROTOR_IN] = {.name = "rotor_in", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
      [ROTOR_OUT] = {.name = "rotor_out", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
      [ROTOR_GAP] = {.name = "rotor_gap", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
      [ROTOR_LEAK] = {.name = "rotor_leak", .kind = CW_PATCH_INTERFACE, .domain = ROTOR},
      [DISC] = {.name = "disc", .domain = CHAMBER, .turns = 1, .group = CW_GROUP_HUB_SHROUD},
      [LID] = {.name = "lid", .domain = CHAMBER, .group = CW_GROUP_VOLUTE},
      [CHAMBER_GAP] = {.name = "chamber_gap", .kind = CW_PATCH_INTERFACE, .domain = CHAMBER},
      [STATOR_IN] = {.name = "stator_in", .kind = CW_PATCH_INTERFACE, .domain = STATOR},
      [STATOR_LEAK] = {.name = "stator_leak", .kind = CW_PATCH_INTERFACE, .domain = STATOR},
      [VOLUTE] = {.name = "volute", .domain = STATOR, .group = CW_GROUP_VOLUTE},
      [TONGUE] = {.name = "tongue", .domain = STATOR, .group = CW_GROUP_VOLUTE, .monitored = 1},
      [OUTLET] = {.name = "outlet", .kind = CW_PATCH_OUTLET, .domain = STATOR, .flow_share = 0.75},
      [DRAIN] = {.name = "drain", .kind = CW_PATCH_OUTLET, .domain = STATOR, .flow_share = 0.25},
      [MIDDLE] = {.name = "middle", .kind = CW_PATCH_SYMMETRY, .domain = STATOR},
      [SUCTION_OUT] = {.name = "suction_out", .kind = CW_PATCH_INTERFACE, .domain = SUCTION},
      [PIPE] = {.name = "pipe", .domain = SUCTION, .group = CW_GROUP_PIPE},
      [SHAFT] = {.name = "shaft_wall", .domain = SUCTION, .turns = 1, .group = CW_GROUP_HUB_SHROUD},
      [INLET] = {.name = "inlet", .kind = CW_PATCH_INLET, .domain = SUCTION},
      [FEED] = {.name = "feed", .kind = CW_PATCH_INLET, .domain = SUCTION}};
  static const CwModelInterface interfaces[INTERFACES] = {{{SUCTION_OUT, ROTOR_IN}, CW_SURFACE_PLANE, 0},
                                                          {{ROTOR_OUT, STATOR_IN}, CW_SURFACE_CYLINDER, 0.1},
                                                          {{ROTOR_GAP, CHAMBER_GAP}, CW_SURFACE_PLANE, 0},
                                                          {{ROTOR_LEAK, STATOR_LEAK}, CW_SURFACE_PLANE, 0}};
  memset(pump, 0, sizeof *pump);
  memcpy(pump->patches, patches, sizeof patches);
  memcpy(pump->interfaces, interfaces, sizeof interfaces);
  for (int p = 0; p < PATCHES; ++p) {
    pump->patches[p].y_plus = 30;
    pump->parts[p] = (CwPatchPart){.faces = {p == LID ? 0 : 2, 0}, .area = p + 1, .vector = {0, 0, p + 1}};
  }
  pump->mesh =
      (CwMesh){.domain_count = ZONES,
               .domains = {{.name = "rotor", .zone = "ROTOR", .rotating = 1, .patch_count = DISC},
                           {.name = "chamber", .zone = "CHAMBER", .rotating = 1, .first_patch = DISC, .patch_count = 3},
                           {.name = "stator", .zone = "STATOR", .first_patch = STATOR_IN, .patch_count = 7},
                           {.name = "suction", .zone = "SUCTION", .first_patch = SUCTION_OUT, .patch_count = 5}},
               .interface_count = INTERFACES,
               .interfaces = pump->interfaces,
               .patch_count = PATCHES,
               .patches = pump->patches,
               .flow = {2, 0.07, 9, 0.01, 0.2, 5}};
  pump->assembly = (CwAssembly){.mesh = &pump->mesh, .patches = pump->parts};
  pump->table = (CwCase){.name = "hand",
                         .operating_point = {.speed = 100,
                                             .flow_rate = 0.01,
                                             .head = 12,
                                             .inlet_pressure = 90000,
                                             .time_step_angle = 2 * M_PI / 200},
                         .fluid = {.density = 800, .kinematic_viscosity = 2e-6, .temperature = NAN},
                         .output.foam_processors = 1};
}

// The y+ that the layers of all walls were made for; NAN: the flow along them is laminar.
static inline void pump_by_hand_y_plus(PumpByHand *pump, double y_plus) {
  for (int p = 0; p < PATCHES; ++p) pump->patches[p].y_plus = y_plus;
}

// From the first `head` to the next `end` behind it, the text in between, until the next call; NULL: no such head.
static inline const char *block_of(const char *text, const char *head, const char *end) {
  static char block[8000];
  const char *from = strstr(text, head), *to = from ? strstr(from + strlen(head), end) : NULL;
  if (!to) return NULL;
  from += strlen(head);
  assert_true((size_t)(to - from) < sizeof block);
  snprintf(block, sizeof block, "%.*s", (int)(to - from), from);
  return block;
}

static inline void assert_block(const char *text, const char *head, const char *end, const char *words) {
  const char *block = block_of(text, head, end);
  if (!block) fail_msg("no '%s' in:\n%s", head, text);
  if (!strstr(block, words)) fail_msg("no '%s' behind '%s' in:\n%s", words, head, block);
}

static inline int count_of(const char *text, const char *words) {
  int count = 0;
  for (const char *at = text; (at = strstr(at, words)); at += strlen(words)) ++count;
  return count;
}
