// SPDX-License-Identifier: AGPL-3.0-or-later
// Loaded into a stage before its other libraries: ends it where it hands MPI more than CUTWATER_MESSAGE_BYTES in one
// call. Libraries, which have rules of their own, are not looked at.
#include <dlfcn.h>
#include <mpi.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void look(const char *name, void *caller, int count, MPI_Datatype type) {
  const char *most = getenv("CUTWATER_MESSAGE_BYTES");
  Dl_info from;
  int size = 0;
  if (!most || (dladdr(caller, &from) && strstr(from.dli_fname, ".so"))) return;
  PMPI_Type_size(type, &size);
  if ((int64_t)count * size <= atoll(most)) return;
  fprintf(stderr, "%s is handed %d items of %d bytes at once\n", name, count, size);
  PMPI_Abort(MPI_COMM_WORLD, 99);
}

#define LOOK(count, type) look(__func__, __builtin_return_address(0), count, type)

int MPI_Send(const void *from, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  LOOK(count, type);
  return PMPI_Send(from, count, type, to, tag, comm);
}

int MPI_Bcast(void *items, int count, MPI_Datatype type, int root, MPI_Comm comm) {
  LOOK(count, type);
  return PMPI_Bcast(items, count, type, root, comm);
}

int MPI_Ibcast(void *items, int count, MPI_Datatype type, int root, MPI_Comm comm, MPI_Request *request) {
  LOOK(count, type);
  return PMPI_Ibcast(items, count, type, root, comm, request);
}

int MPI_Allgather(const void *from, int count, MPI_Datatype type, void *to, int each, MPI_Datatype kind,
                  MPI_Comm comm) {
  LOOK(count, type);
  return PMPI_Allgather(from, count, type, to, each, kind, comm);
}

int MPI_Iallgatherv(const void *from, int count, MPI_Datatype type, void *to, const int *each, const int *place,
                    MPI_Datatype kind, MPI_Comm comm, MPI_Request *request) {
  int ranks;
  MPI_Comm_size(comm, &ranks);
  LOOK(place[ranks - 1] + each[ranks - 1], kind);
  return PMPI_Iallgatherv(from, count, type, to, each, place, kind, comm, request);
}

int MPI_Reduce(const void *from, void *to, int count, MPI_Datatype type, MPI_Op operation, int root, MPI_Comm comm) {
  LOOK(count, type);
  return PMPI_Reduce(from, to, count, type, operation, root, comm);
}

int MPI_Allreduce(const void *from, void *to, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  LOOK(count, type);
  return PMPI_Allreduce(from, to, count, type, operation, comm);
}

int MPI_Iallreduce(const void *from, void *to, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm,
                   MPI_Request *request) {
  LOOK(count, type);
  return PMPI_Iallreduce(from, to, count, type, operation, comm, request);
}

int MPI_Exscan(const void *from, void *to, int count, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  LOOK(count, type);
  return PMPI_Exscan(from, to, count, type, operation, comm);
}
