// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/threads.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

// The fields are the threads, the work in hand, and how it ends.
struct CwThreads {
  int count; // beside the caller
  pthread_t *thread;
  pthread_mutex_t lock;
  pthread_cond_t begin, end;
  int64_t round; // of work, from 1
  int working, over;
  int32_t items;
  CwStatus (*body)(void *given, int32_t item);
  void *given;
  atomic_int next, failed; // failed: the first item that has
  CwStatus status;
  CwFailure failure;
};

static void note_failure(CwThreads *threads, int32_t item, CwStatus status) {
  pthread_mutex_lock(&threads->lock);
  if (item < atomic_load(&threads->failed)) {
    atomic_store(&threads->failed, item);
    threads->status = status;
    threads->failure = *cw_failure();
  }
  pthread_mutex_unlock(&threads->lock);
}

// Items are taken in order: those before one that has failed are taken, and say whether they fail too.
static void work(CwThreads *threads) {
  for (;;) {
    int32_t item = atomic_fetch_add(&threads->next, 1);
    if (item >= threads->items || item > atomic_load(&threads->failed)) return;
    CwStatus status = threads->body(threads->given, item);
    if (status != CW_OK) note_failure(threads, item, status);
  }
}

static void *serve(void *given) {
  CwThreads *threads = given;
  pthread_mutex_lock(&threads->lock);
  for (int64_t seen = 0;;) {
    while (threads->round == seen && !threads->over) pthread_cond_wait(&threads->begin, &threads->lock);
    if (threads->over) break;
    seen = threads->round;
    pthread_mutex_unlock(&threads->lock);
    work(threads);
    pthread_mutex_lock(&threads->lock);
    if (--threads->working == 0) pthread_cond_signal(&threads->end);
  }
  pthread_mutex_unlock(&threads->lock);
  return NULL;
}

// One more, on these cores, or on any where the system does not allow these.
static int add_thread(CwThreads *threads, const cpu_set_t *cores) {
  pthread_attr_t how;
  pthread_attr_init(&how);
  if (cores) pthread_attr_setaffinity_np(&how, sizeof *cores, cores);
  int failed = pthread_create(&threads->thread[threads->count], &how, serve, threads);
  pthread_attr_destroy(&how);
  return failed && cores ? add_thread(threads, NULL) : failed;
}

CwStatus cw_threads_make(int count, const cpu_set_t *cores, CwThreads **threads) {
  CwStatus status = CW_OK;
  CW_NEW(*threads, 1);
  CwThreads *made = *threads;
  CW_NEW(made->thread, count);
  pthread_mutex_init(&made->lock, NULL);
  pthread_cond_init(&made->begin, NULL);
  pthread_cond_init(&made->end, NULL);
  while (made->count < count - 1 && !add_thread(made, cores)) made->count++;
  errno = 0; // fewer are enough
done:
  return status;
}

CwStatus cw_threads_run(CwThreads *threads, int32_t count, CwStatus (*body)(void *given, int32_t item), void *given) {
  CwStatus status = CW_OK;
  pthread_mutex_lock(&threads->lock);
  threads->items = count;
  threads->body = body;
  threads->given = given;
  atomic_store(&threads->next, 0);
  atomic_store(&threads->failed, INT32_MAX);
  threads->working = threads->count;
  threads->round++;
  pthread_cond_broadcast(&threads->begin);
  pthread_mutex_unlock(&threads->lock);
  work(threads);
  pthread_mutex_lock(&threads->lock);
  while (threads->working > 0) pthread_cond_wait(&threads->end, &threads->lock);
  if (atomic_load(&threads->failed) < count) {
    status = threads->status;
    *cw_failure() = threads->failure;
  }
  pthread_mutex_unlock(&threads->lock);
  return status;
}

int cw_threads_count(const CwThreads *threads) {
  return threads->count + 1;
}

void cw_threads_free(CwThreads **threads) {
  CwThreads *old = *threads;
  if (!old) return;
  pthread_mutex_lock(&old->lock);
  old->over = 1;
  pthread_cond_broadcast(&old->begin);
  pthread_mutex_unlock(&old->lock);
  for (int i = 0; i < old->count; i++) pthread_join(old->thread[i], NULL);
  pthread_cond_destroy(&old->begin);
  pthread_cond_destroy(&old->end);
  pthread_mutex_destroy(&old->lock);
  free(old->thread);
  free(old);
  *threads = NULL;
}
