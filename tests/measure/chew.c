// SPDX-License-Identifier: AGPL-3.0-or-later
// Meshes a case as cutwater-mesh does, and then fills the regions of one domain twice more from the surfaces that this
// has left: by the rule of region numbers, to see what it takes and sends, and by Chew's algorithm (chew_domain.h).
// Writes RUN/chew/DOMAIN-0001.h5 ... and RUN/chew/DOMAIN.json. For tests/bench/table1.py.
#include <hdf5.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chew_domain.h"
#include "mesher/parallel/profiler.h"
#include "mesher/parallel/ranks.h"
#include "mesher/policy.h"
#include "mesher/run/mesh_run.h"
#include "pipeline/atomic_file.h"
#include "pipeline/stage_args.h"
#include "pipeline/stop_line.h"
#include "pipeline/version.h"

static const CwStageOption OPTIONS[] = {
    {"domain", "NAME", "whose regions are filled; rotor by default"},
    {"radius", "R",
     "greatest radius of a sphere by Chew's algorithm, in h; by default as many tetrahedra as the rule's"},
    {"ratio", "B", "greatest ratio of that radius to the shortest edge; 1.4 by default"},
    {"undivided", NULL, "each domain is one region, however many cells it has"},
};
enum { DOMAIN, RADIUS, RATIO, UNDIVIDED, OPTION_COUNT };

enum { TRIES = 5 }; // of a radius that gives as many tetrahedra
static const double FIRST_RADIUS = 0.75, NEAR = 0.02;

static const CwStageUsage USAGE = {
    .stage = "mesh",
    .version = cw_version,
    .summary = "Meshes RUN/geometry, and once more by Chew's algorithm.\n",
    .options = OPTIONS,
    .option_count = OPTION_COUNT,
    .reads = {"geometry"},
};

static json_t *json_of(const CwChewFigures *f) {
  return json_pack("{s:f s:f s:f s:f s:I s:I s:I s:I s:I s:I s:I s:I}", "interface_seconds", f->interface_seconds,
                   "refine_seconds", f->refine_seconds, "fill_seconds", f->fill_seconds, "wall_seconds",
                   f->wall_seconds, "messages", (json_int_t)f->traffic.messages, "bytes", (json_int_t)f->traffic.bytes,
                   "sent_messages", (json_int_t)f->traffic.sent_messages, "sent_bytes",
                   (json_int_t)f->traffic.sent_bytes, "rounds", (json_int_t)f->rounds, "inserted",
                   (json_int_t)f->inserted, "refused", (json_int_t)f->refused, "tetrahedra", (json_int_t)f->tetrahedra);
}

static CwStatus write_figures(const char *path, const char *domain, int32_t regions, double radius,
                              const CwChewFigures *rule, const CwChewFigures *chew) {
  CwStatus status = CW_OK;
  char name[4200];
  json_t *all = json_pack("{s:i s:f s:o s:o}", "regions", (int)regions, "radius", radius, "rule", json_of(rule), "chew",
                          json_of(chew));
  snprintf(name, sizeof name, "%s/%s.json", path, domain);
  CW_REQUIRE(all && json_dump_file(all, name, JSON_INDENT(2)) == 0, CW_ERR_IO, "%s: cannot be written", name);
done:
  json_decref(all);
  return status;
}

// Both ways, once the run is done. Where no radius is given (0) Chew's algorithm is run until it makes about as many
// tetrahedra as the rule; the last try counts.
static CwStatus measure(CwMeshRun *run, const CwDomain *domain, CwChewBounds bounds) {
  CwStatus status = CW_OK;
  CwChewOwners owners = {0};
  CwChewFigures rule, chew;
  char path[4096];
  const CwRegionInput from = cw_domain_region_input(domain, run->context.log);
  snprintf(path, sizeof path, "%s/chew", run->run_path);
  CW_TRY(cw_make_directory(path));
  CW_TRY(cw_chew_owners_make(&domain->interfaces, domain->plan.region_count, domain->plan.predicted_cells, &owners));
  CW_TRY(cw_rule_domain(&from, &owners, domain->number, &rule));
  cw_chew_sum(&owners, &rule);
  int given = bounds.radius > 0;
  double scale = 1;
  if (!given) bounds.radius = FIRST_RADIUS;
  for (int tries = 0; tries < TRIES && (tries == 0 || (!given && fabs(scale * scale * scale - 1) > NEAR)); tries++) {
    bounds.radius *= scale;
    CW_TRY(cw_chew_domain(&from, &owners, &bounds, domain->name, path, &chew));
    cw_chew_sum(&owners, &chew);
    scale = cbrt((double)chew.tetrahedra / (double)rule.tetrahedra);
  }
  if (run->rank == 0) CW_TRY(write_figures(path, domain->name, owners.region_count, bounds.radius, &rule, &chew));
done:
  cw_chew_owners_free(&owners);
  return status;
}

static CwStatus number_of(const char *text, double otherwise, double *value) {
  CwStatus status = CW_OK;
  char *end = NULL;
  *value = otherwise;
  if (!text) return CW_OK;
  *value = strtod(text, &end);
  CW_REQUIRE(*value > 0 && *end == '\0', CW_ERR_USAGE, "%s: a number above 0 is wanted", text);
done:
  return status;
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CwStageArgs args = {0};
  CwCase table;
  CwMeshRun run = {0};
  CwTeam *team = NULL;
  CwChewBounds bounds;
  H5dont_atexit();
  CW_TRY(cw_mpi_start(&argc, &argv, &team));
  run.rank = cw_team_rank(team);
  run.context.team = team;
  CW_TRY(cw_profiler_make(&run.context.profiler));
  CW_TRY(cw_team_agree(team, cw_stage_begin(argc, argv, &USAGE, run.rank == 0, &args, &table)));
  if (args.finished) goto done;
  run.context.log = args.log;
  CW_TRY(cw_team_agree(team, cw_policy_start()));
  CW_TRY(cw_team_agree(team, cw_stop_watch(args.run_path, "mesh", run.rank == 0)));
  CW_TRY(number_of(args.options[RADIUS], 0, &bounds.radius));
  CW_TRY(number_of(args.options[RATIO], 1.4, &bounds.ratio));
  if (args.options[UNDIVIDED]) table.mesh.least_regions = 1, table.mesh.cells_per_region = INT64_MAX / 2;
  run.table = &table;
  run.run_path = args.run_path;
  CW_TRY(cw_record_start("mesh", args.log, &run.record));
  CW_TRY(cw_mesh_run(&run));
  const char *wanted = args.options[DOMAIN] ? args.options[DOMAIN] : "rotor";
  int d = 0;
  while (d < run.model.domain_count && strcmp(run.domain[d].name, wanted)) d++;
  CW_REQUIRE(d < run.model.domain_count, CW_ERR_USAGE, "there is no domain %s", wanted);
  CW_TRY(measure(&run, &run.domain[d], bounds));
done:
  if (status != CW_OK) return cw_mpi_fail(args.log, status);
  cw_mesh_run_free(&run);
  cw_profiler_free(&run.context.profiler);
  cw_record_free(run.record);
  cw_log_close(&args.log);
  cw_stop_end();
  cw_mpi_end(&team);
  return 0;
}
