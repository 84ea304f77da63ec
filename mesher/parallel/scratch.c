// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/scratch.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>

struct CwScratch {
  int64_t size;
  pthread_mutex_t lock;
  int32_t count, capacity;
  void **array; // those that nobody has at present
};

CwStatus cw_scratch_make(int64_t size, CwScratch **scratch) {
  CwStatus status = CW_OK;
  CW_NEW(*scratch, 1);
  (*scratch)->size = size;
  pthread_mutex_init(&(*scratch)->lock, NULL);
done:
  return status;
}

CwStatus cw_scratch_take(CwScratch *scratch, void **array) {
  CwStatus status = CW_OK;
  pthread_mutex_lock(&scratch->lock);
  *array = scratch->count > 0 ? scratch->array[--scratch->count] : NULL;
  pthread_mutex_unlock(&scratch->lock);
  if (!*array) CW_NEW(*array, scratch->size);
done:
  return status;
}

void cw_scratch_give(CwScratch *scratch, void *array) {
  pthread_mutex_lock(&scratch->lock);
  if (array && scratch->count == scratch->capacity) {
    void *grown = realloc(scratch->array, (size_t)(scratch->capacity + 16) * sizeof *scratch->array);
    if (grown) {
      scratch->array = grown;
      scratch->capacity += 16;
    }
  }
  if (array && scratch->count < scratch->capacity) {
    scratch->array[scratch->count++] = array;
    array = NULL;
  }
  pthread_mutex_unlock(&scratch->lock);
  free(array); // where there was no room for it
  errno = 0;
}

void cw_scratch_free(CwScratch **scratch) {
  CwScratch *old = *scratch;
  if (!old) return;
  for (int32_t i = 0; i < old->count; i++) free(old->array[i]);
  free(old->array);
  pthread_mutex_destroy(&old->lock);
  free(old);
  *scratch = NULL;
}
