#!/bin/bash
# SPDX-License-Identifier: AGPL-3.0-or-later
# A run under PBS, by Open MPI's mpirun: qsub -v CASE=paper,CELLS=100M pbs.sh, with `cutwater` in the PATH. Called
# again, it goes on where it was stopped.
#PBS -N cutwater
#PBS -l select=2:ncpus=32:mpiprocs=32
#PBS -l walltime=01:00:00
set -eu
cd "$PBS_O_WORKDIR"
exec cutwater "${CASE:-paper}" ${CELLS:+CELLS=$CELLS} ${OUT:+OUT=$OUT} HOSTS="$PBS_NODEFILE"
