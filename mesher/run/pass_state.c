// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/pass_state.h"

#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "mesher/parallel/ranks.h"
#include "mesher/policy.h"
#include "pipeline/hash.h"
#include "pipeline/log.h"
#include "pipeline/sealed_json.h"

enum { PATH_SIZE = 4096 };

static CwStatus hash_file(CwHash *hash, const char *run_path, const char *name) {
  CwStatus status = CW_OK;
  char path[PATH_SIZE], block[65536];
  size_t size;
  snprintf(path, sizeof path, "%s/geometry/%s", run_path, name);
  FILE *file = fopen(path, "rb");
  CW_REQUIRE(file, CW_ERR_IO, "%s: cannot be read: %s; made by cutwater-geometry", path, strerror(errno));
  while ((size = fread(block, 1, sizeof block, file)) > 0) cw_hash_bytes(hash, block, size);
  CW_REQUIRE(!ferror(file), CW_ERR_IO, "%s: cannot be read: %s", path, strerror(errno));
done:
  if (file) fclose(file);
  return status;
}

CwStatus cw_pass_fingerprint(const CwCase *table, const char *run_path, const CwModel *model,
                             char fingerprint[CW_HASH_TEXT]) {
  CwStatus status = CW_OK;
  static const char *const FILES[] = {"faces.csv", "model.json"};
  CwHash hash = cw_hash_start();
  const CwWalls *walls = &table->walls;
  const CwMeshTable *mesh = &table->mesh;
  // Value by value: structures have padding.
  const double value[] = {walls->layer_count,      walls->growth_ratio,
                          walls->total_thickness,  walls->y_plus_at,
                          (double)mesh->cells,     (double)mesh->cells_per_region,
                          mesh->least_regions,     mesh->fill,
                          mesh->periodic_impeller, mesh->gradation,
                          mesh->curvature_angle,   mesh->cells_across_gap,
                          mesh->size_blade,        mesh->size_hub_shroud,
                          mesh->size_volute,       mesh->size_pipe,
                          mesh->size_interface,    table->fluid.kinematic_viscosity};
  cw_policy_hash(&hash);
  cw_hash_bytes(&hash, value, sizeof value);
  const CwWallGroup *const group[] = {&walls->blade, &walls->hub_shroud, &walls->volute, &walls->pipe};
  for (size_t i = 0; i < sizeof group / sizeof *group; i++) {
    const double of_group[] = {group[i]->y_plus, group[i]->velocity, group[i]->first_height, group[i]->growth_ratio,
                               group[i]->total_thickness};
    cw_hash_bytes(&hash, of_group, sizeof of_group);
  }
  for (size_t i = 0; i < sizeof FILES / sizeof *FILES; i++) CW_TRY(hash_file(&hash, run_path, FILES[i]));
  for (int d = 0; d < model->domain_count; d++) {
    char name[CW_NAME_SIZE + 8];
    snprintf(name, sizeof name, "%s.brep", model->domain[d].name);
    CW_TRY(hash_file(&hash, run_path, name));
  }
  cw_hash_hex(&hash, fingerprint);
done:
  return status;
}

static int int_in(const json_t *file, const char *key) {
  return (int)json_integer_value(json_object_get(file, key));
}

static CwCellLaw law_in(const json_t *file) {
  return (CwCellLaw){json_number_value(json_object_get(file, "factor")),
                     json_number_value(json_object_get(file, "scale")),
                     json_number_value(json_object_get(file, "exponent")), int_in(file, "layers")};
}

static json_t *law_packed(const CwCellLaw *law) {
  return json_pack("{s:f, s:f, s:f, s:I}", "factor", law->factor, "scale", law->scale, "exponent", law->exponent,
                   "layers", (json_int_t)law->layers);
}

static CwStatus places_in(const json_t *file, CwFinerPlaces *places) {
  CwStatus status = CW_OK;
  size_t count = json_array_size(file);
  CW_GROW(places->place, places->capacity, (int32_t)count);
  for (size_t i = 0; i < count; i++) {
    const json_t *of = json_array_get(file, i);
    double value[6];
    for (size_t k = 0; k < 6; k++) value[k] = json_number_value(json_array_get(of, k));
    places->place[places->count++] =
        (CwFinerPlace){(int32_t)value[0], (int32_t)value[1], {{value[2], value[3], value[4]}, value[5]}};
  }
done:
  return status;
}

static json_t *places_packed(const CwFinerPlaces *places) {
  json_t *file = json_array();
  for (int32_t i = 0; i < places->count; i++) {
    const CwFinerPlace *place = &places->place[i];
    const CwSizePoint *point = &place->point;
    json_array_append_new(file, json_pack("[i, i, f, f, f, f]", place->domain, place->pinched, point->x[0], point->x[1],
                                          point->x[2], point->size));
  }
  return file;
}

static void by_domain_in(const json_t *list, int32_t of_domain[CW_DOMAINS_MOST]) {
  for (size_t d = 0; d < CW_DOMAINS_MOST; d++) of_domain[d] = (int32_t)json_integer_value(json_array_get(list, d));
}

static json_t *by_domain_packed(const int32_t of_domain[CW_DOMAINS_MOST]) {
  json_t *list = json_array();
  for (int d = 0; d < CW_DOMAINS_MOST; d++) json_array_append_new(list, json_integer(of_domain[d]));
  return list;
}

static CwPassStart start_in(const json_t *file) {
  CwPassStart start = {.prisms = law_in(json_object_get(file, "prisms")),
                       .tets = law_in(json_object_get(file, "tetrahedra")),
                       .places = int_in(file, "places")};
  by_domain_in(json_object_get(file, "whole"), start.whole);
  by_domain_in(json_object_get(file, "more_regions"), start.more_regions);
  by_domain_in(json_object_get(file, "layers"), start.layers);
  return start;
}

static json_t *start_packed(const CwPassStart *start) {
  return json_pack("{s:o, s:o, s:i, s:o, s:o, s:o}", "prisms", law_packed(&start->prisms), "tetrahedra",
                   law_packed(&start->tets), "places", start->places, "whole", by_domain_packed(start->whole),
                   "more_regions", by_domain_packed(start->more_regions), "layers", by_domain_packed(start->layers));
}

CwStatus cw_pass_state_read(CwLog *log, const char *run_path, const char *fingerprint, CwPassState *state) {
  CwStatus status = CW_OK;
  char path[PATH_SIZE];
  snprintf(path, sizeof path, "%s/mesh/pass.json", run_path);
  json_t *file = NULL;
  if (access(path, F_OK) == 0 && cw_sealed_json_read(path, &file) != CW_OK)
    cw_log_warn(log, "%s; the passes begin anew", cw_fail_message());
  const char *of = json_string_value(json_object_get(file, "fingerprint"));
  if (!of || strcmp(of, fingerprint) || int_in(file, "pass") < 1) goto done;
  *state = (CwPassState){.pass = int_in(file, "pass"),
                         .first_pass = int_in(file, "first_pass"),
                         .start = start_in(json_object_get(file, "start")),
                         .finer_rounds = int_in(file, "finer_rounds"),
                         .poor_rounds = int_in(file, "poor_rounds"),
                         .best = start_in(json_object_get(file, "best")),
                         .least_deficit = json_number_value(json_object_get(file, "least_deficit")),
                         .best_round = int_in(file, "best_round"),
                         .plane_rounds = int_in(file, "plane_rounds")};
  by_domain_in(json_object_get(file, "best_lacks"), state->best_lacks);
  by_domain_in(json_object_get(file, "best_layers"), state->best_layers);
  CW_TRY(places_in(json_object_get(file, "finer"), &state->finer));
done:
  json_decref(file);
  return status;
}

CwStatus cw_pass_state_share(const CwTeam *team, CwPassState *state) {
  CwStatus status = CW_OK;
  CwFinerPlaces *finer = &state->finer;
  CwFinerPlace *own = finer->place;
  cw_team_broadcast(team, state, sizeof *state, 0);
  finer->place = own;
  if (cw_team_rank(team) > 0) {
    CW_NEW(finer->place, finer->count);
    finer->capacity = finer->count;
  }
  cw_team_broadcast(team, finer->place, finer->count * (int64_t)sizeof *finer->place, 0);
done:
  return status;
}

CwStatus cw_pass_state_write(const char *run_path, const char *fingerprint, const CwPassState *state) {
  CwStatus status = CW_OK;
  char path[PATH_SIZE];
  json_t *file =
      json_pack("{s:s, s:i, s:i, s:o, s:i, s:i, s:o, s:f, s:i, s:o, s:o, s:i, s:o}", "fingerprint", fingerprint, "pass",
                state->pass, "first_pass", state->first_pass, "start", start_packed(&state->start), "finer_rounds",
                state->finer_rounds, "poor_rounds", state->poor_rounds, "best", start_packed(&state->best),
                "least_deficit", state->least_deficit, "best_round", state->best_round, "best_lacks",
                by_domain_packed(state->best_lacks), "best_layers", by_domain_packed(state->best_layers),
                "plane_rounds", state->plane_rounds, "finer", places_packed(&state->finer));
  CW_REQUIRE(file, CW_ERR_MEMORY, "out of memory: state of the passes");
  snprintf(path, sizeof path, "%s/mesh/pass.json", run_path);
  CW_TRY(cw_sealed_json_write(file, path));
done:
  json_decref(file);
  return status;
}
