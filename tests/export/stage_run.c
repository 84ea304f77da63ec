// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tests/export/stage_run.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <cgnslib.h>

#include "tests/seal_run.h"
#include "tests/unit_test.h"

int stage_run_make(const char *folder, const SyntheticPump *pump) {
  char run[STAGE_PATH_SIZE + 10];
  // As root and with more ranks than cores; OpenFOAM must find its etc folder.
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
  setenv("WM_PROJECT_DIR", "/usr/share/openfoam", 0);
  snprintf(run, sizeof run, "%s/run", folder);
  return synthetic_run_write(run, pump);
}

int stage_shell(char *output, const char *format, ...) {
  char command[4000];
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(command, sizeof command - 10, format, arguments);
  va_end(arguments);
  if (length < 0 || (size_t)length >= sizeof command - 10) return -1;
  snprintf(command + length, sizeof command - (size_t)length, " 2>&1");
  FILE *pipe = popen(command, "r");
  if (!pipe) return -1;
  size_t used = fread(output, 1, STAGE_OUTPUT_SIZE - 1, pipe);
  output[used] = '\0';
  char rest[4096];
  while (fread(rest, 1, sizeof rest, pipe) > 0)
    ;
  int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int stage_export(const char *run, int ranks, char *output) {
  // One rank without mpirun, which has words of its own for a failed run.
  char launch[40] = "";
  if (ranks > 1) snprintf(launch, sizeof launch, "mpirun -q -n %d ", ranks);
  return stage_shell(output, "%s'%s/cutwater-export' --case '%s/cases/paper/case.yaml' --run '%s'", launch,
                     CUTWATER_BIN_DIR, CUTWATER_SOURCE_DIR, run);
}

int stage_cgns_open(const char *folder, const SyntheticPump *pump, char *output, int *file) {
  char path[STAGE_PATH_SIZE + 40];
  if (stage_run_make(folder, pump)) return -1;
  snprintf(path, sizeof path, "%s/run", folder);
  if (stage_export(path, 2, output)) return -1;
  snprintf(path, sizeof path, "%s/run/export/pump.cgns", folder);
  return cg_open(path, CG_MODE_READ, file);
}

int stage_export_with(const char *run, int ranks, const char *more, char *output) {
  return stage_shell(output,
                     "{ cat '%s/cases/paper/case.yaml'; echo '%s'; } > '%s/case.yaml' && mpirun -q -n %d "
                     "'%s/cutwater-export' --case '%s/case.yaml' --run '%s'",
                     CUTWATER_SOURCE_DIR, more, run, ranks, CUTWATER_BIN_DIR, run, run);
}

int stage_walls_set(const char *run, const char *wall, const char *y_plus, char *output) {
  char range[100] = "";
  if (wall) snprintf(range, sizeof range, "/\"name\": \"%s\"/,/y_plus/", wall);
  return stage_shell(output, "sed -i '%ss/\"y_plus\": [^,]*/\"y_plus\": %s/' '%s/mesh/manifest.json'", range, y_plus,
                     run) ||
         seal_run(run);
}

void stage_need_program(const char *name) {
  char output[STAGE_OUTPUT_SIZE];
  if (stage_shell(output, "command -v %s", name)) fail_msg("no %s here: pipeline/packages.sh check", name);
}
