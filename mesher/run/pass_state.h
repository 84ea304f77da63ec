// SPDX-License-Identifier: AGPL-3.0-or-later
// What the mesher knows when it begins a pass, or anew with shorter edges: kept in RUN/mesh/pass.json, so that a killed
// run goes on with the same pass, finds its region files current, and ends in the same bytes.
#pragma once

#include "mesher/parallel/context.h"
#include "mesher/run/cell_law.h"
#include "mesher/run/finer_places.h"
#include "pipeline/hash.h"
#include "pipeline/log.h"
#include "pipeline/model.h"

// What a mesh follows from, beside the case and its geometry.
typedef struct {
  CwCellLaw prisms, tets;                // as learned; factor 0: not yet
  int32_t places;                        // of `finer` that its size fields have
  int32_t whole[CW_DOMAINS_MOST];        // 1: of each domain, the symmetry is given up
  int32_t more_regions[CW_DOMAINS_MOST]; // of each domain, than its cells ask for
  int32_t layers[CW_DOMAINS_MOST];       // of each domain, at most; 0: as many as sizes and case ask for
} CwPassStart;

typedef struct {
  int pass;       // the pass to run, from 1; 0: none
  int first_pass; // of those with these places
  CwPassStart start;
  int finer_rounds, poor_rounds; // of shorter edges: for layers, and for quality
  CwPassStart best;              // of the mesh with the least deficit (poor_places)
  double least_deficit;
  int best_round;                       // of poor_rounds
  int32_t best_lacks[CW_DOMAINS_MOST];  // 1: of each domain, in the best mesh it falls short
  int32_t best_layers[CW_DOMAINS_MOST]; // of each domain, in the best mesh, where edges are too long for them; else 0
  int plane_rounds;                     // of other planes, then of fewer layers, for these
  CwFinerPlaces finer;
} CwPassState;

// Hex fingerprint of what the passes follow from: the mesher's sources, the case's walls and mesh tables and the files
// of the geometry stage.
CwStatus cw_pass_fingerprint(const CwCase *table, const char *run_path, const CwModel *model,
                             char fingerprint[CW_HASH_TEXT]);

// Reads the state where it is there, whole and of this fingerprint; leaves *state as it is otherwise, with a
// warning where it is damaged. Caller frees the places. CW_ERR_MEMORY alone.
CwStatus cw_pass_state_read(CwLog *log, const char *run_path, const char *fingerprint, CwPassState *state);

// The state of the first rank to the others, for which it is zeroed before: the file that they see may be an older one,
// or none. Collective over the team. CW_ERR_MEMORY.
CwStatus cw_pass_state_share(const CwTeam *team, CwPassState *state);

CwStatus cw_pass_state_write(const char *run_path, const char *fingerprint, const CwPassState *state);
