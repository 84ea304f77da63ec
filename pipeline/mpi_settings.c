// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mpi_settings.h"

#include <stdlib.h>
#include <string.h>

void cw_mpi_settings(void) {
  const char *all = getenv("OMPI_COMM_WORLD_SIZE"), *here = getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  int alone = !all && !getenv("PMIX_NAMESPACE") && !getenv("PMI_RANK"); // other launchers set one of these
  if (alone) setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  if (alone || (all && here && strcmp(all, here) == 0)) setenv("OMPI_MCA_pml", "ob1", 0);
}
