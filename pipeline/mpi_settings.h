// SPDX-License-Identifier: AGPL-3.0-or-later
// How Open MPI is to start, where the user has not chosen. Before MPI_Init.
#pragma once

// Where all ranks are on one machine, Open MPI's way over shared memory needs none of the libraries of fast networks,
// and to load and ask them is more than half of what a rank needs to start. A rank started without mpirun needs no
// daemon beside it either, which takes a quarter of a second: nobody is going to join it. Where there is too little
// memory for MPI to start, the process ends here, with one line: MPI would crash.
//
// A message is copied once, from process to process, where a process may read the memory of another (process_vm_readv):
// ranks that share a core are two to three times as quick by that. Some containers and kernels forbid it, and Open MPI
// 4.1 fails there; it is tried once, by a child, and else Open MPI copies twice.
//
// Nobody here uses shared file pointers, but Open MPI prepares them for every file, and one of its ways of doing so
// (sharedfp/lockedfile, to 5.0.9) ends the process where the path has more than some 240 characters (open-mpi/ompi
// issue 13565). It is left out.
void cw_mpi_settings(void);
