#!/bin/bash
# SPDX-License-Identifier: AGPL-3.0-or-later
# A run under Slurm: CASE=paper CELLS=100M sbatch --nodes=4 slurm.sh, with `cutwater` in the PATH. Called again, it goes
# on where it was stopped.
#SBATCH --job-name=cutwater
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=32
#SBATCH --time=01:00:00
set -eu
exec cutwater "${CASE:-paper}" ${CELLS:+CELLS=$CELLS} ${OUT:+OUT=$OUT} LAUNCHER="${LAUNCHER:-srun --mpi=pmix}"
