// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/parallel/task_server.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "mesher/parallel/team.h"

enum { ASK_TAG = 1, GIVE_TAG = 2, PARTS = 4, EARLY = 2 };
// Between two looks of the thread, s: each takes the processor from the first rank's task, which answers between its
// tasks, and the others ask before they need. Here and there a rank waits for a look near the end.
static const double SERVER_PAUSE = 4e-3;

typedef enum { OPEN, GIVEN, ENDED } PlaceState;

struct CwTaskServer {
  const CwTeam *team;
  CwTaskOrder order;
  // On the first rank alone, and under the lock.
  pthread_t thread;
  pthread_mutex_t lock;
  pthread_cond_t look; // for the thread: all ranks know of the end
  int started;
  unsigned char *state; // of each place, PlaceState
  int32_t first, ended; // no place ahead of `first` is open
  CwPlaces *held;       // by each rank; another one's may still be run (cw_task_server_look)
  unsigned char *asks;  // ranks that wait for an answer
  int gone;             // ranks that know of the end
  // On each rank: what it was given, whether it need not ask again, and but on the first the answer on its way.
  CwPlaces next;
  int last;
  MPI_Request answer;
};

static struct timespec after(double seconds) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  int64_t nanoseconds = time.tv_nsec + (int64_t)(seconds * 1e9);
  return (struct timespec){time.tv_sec + nanoseconds / 1000000000, nanoseconds % 1000000000};
}

// So many places from `first` on that all ranks end at about the same time.
static int32_t part_of(const CwTaskOrder *order, int ranks, int32_t first) {
  double part = 1.0 / (PARTS * ranks), cost = part * order->left[first];
  int32_t most = (int32_t)(part * (order->count - first)), count = 1;
  while (count < most && order->left[first] - order->left[first + count + 1] <= cost) count++;
  return count;
}

// The next open places that wait for none; none where all wait.
static CwPlaces choose(CwTaskServer *server) {
  const CwTaskOrder *order = &server->order;
  while (server->first < order->count && server->state[server->first] != OPEN) server->first++;
  for (int32_t place = server->first; place < order->count; place++) {
    int32_t before = order->before ? order->before[place] : -1;
    if (server->state[place] != OPEN || (before >= 0 && server->state[before] != ENDED)) continue;
    CwPlaces places = {.first = place, .count = order->before ? 1 : part_of(order, server->team->ranks, place)};
    for (int32_t i = 0; i < places.count; i++) server->state[place + i] = GIVEN;
    places.left = order->count - place - places.count;
    return places;
  }
  return (CwPlaces){0};
}

// Whether who gets these places need not ask again.
static int are_last(const CwTaskOrder *order, const CwPlaces *places) {
  return places->count == 0 || (!order->before && places->left == 0);
}

// A place has ended: with all that wait for it where it did in vain.
static void end_place(CwTaskServer *server, int32_t place, int in_vain) {
  const CwTaskOrder *order = &server->order;
  server->state[place] = ENDED;
  server->ended++;
  for (int32_t i = place + 1; in_vain && order->before && i < order->count; i++) {
    if (order->before[i] == place) end_place(server, i, 1);
  }
}

// A rank has ended what it held and asks for more; answers all ranks that can be answered.
static void take_up(CwTaskServer *server, int asking, int in_vain) {
  CwPlaces *held = server->held;
  for (int32_t i = 0; i < held[asking].count; i++) end_place(server, held[asking].first + i, in_vain);
  held[asking].count = 0;
  server->asks[asking] = 1;
  for (int rank = 0; rank < server->team->ranks; rank++) {
    if (!server->asks[rank]) continue;
    held[rank] = choose(server);
    if (server->order.before && held[rank].count == 0 && server->ended < server->order.count) break; // until others end
    server->asks[rank] = 0;
    server->gone += are_last(&server->order, &held[rank]);
    if (rank > 0) MPI_Send(&held[rank], 3, MPI_INT32_T, rank, GIVE_TAG, server->team->comm);
  }
  if (server->gone == server->team->ranks) pthread_cond_signal(&server->look);
}

// Answers who has asked. Under the lock.
static void answer(CwTaskServer *server) {
  for (int there = 1, in_vain; there;) {
    MPI_Status message;
    MPI_Iprobe(MPI_ANY_SOURCE, ASK_TAG, server->team->comm, &there, &message);
    if (!there) break;
    MPI_Recv(&in_vain, 1, MPI_INT, message.MPI_SOURCE, ASK_TAG, server->team->comm, MPI_STATUS_IGNORE);
    take_up(server, message.MPI_SOURCE, in_vain);
  }
}

static void *serve(void *context) {
  CwTaskServer *server = context;
  pthread_mutex_lock(&server->lock);
  while (server->gone < server->team->ranks) {
    struct timespec end = after(SERVER_PAUSE);
    pthread_cond_timedwait(&server->look, &server->lock, &end);
    answer(server);
  }
  pthread_mutex_unlock(&server->lock);
  return NULL;
}

static void ask(CwTaskServer *server, int in_vain) {
  MPI_Irecv(&server->next, 3, MPI_INT32_T, 0, GIVE_TAG, server->team->comm, &server->answer);
  MPI_Send(&in_vain, 1, MPI_INT, 0, ASK_TAG, server->team->comm);
}

void cw_task_server_look(CwTaskServer *server, const CwPlaces *places, int32_t at) {
  if (server->team->rank > 0) {
    if (!server->order.before && at + 1 == places->count && places->left >= EARLY * server->team->ranks) ask(server, 0);
    return;
  }
  pthread_mutex_lock(&server->lock);
  answer(server);
  pthread_mutex_unlock(&server->lock);
}

static CwStatus start_thread(CwTaskServer *server) {
  CwStatus status = CW_OK;
  pthread_condattr_t clock;
  CW_NEW(server->state, server->order.count);
  CW_NEW(server->held, server->team->ranks);
  CW_NEW(server->asks, server->team->ranks);
  pthread_mutex_init(&server->lock, NULL);
  pthread_condattr_init(&clock);
  pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
  pthread_cond_init(&server->look, &clock);
  pthread_condattr_destroy(&clock);
  int refused = pthread_create(&server->thread, NULL, serve, server);
  server->started = !refused;
  CW_REQUIRE(server->started, CW_ERR_LIBRARY,
             "the system gives no thread to serve tasks of %d ranks: %s; raise the limit of processes (ulimit -u)",
             server->team->ranks, strerror(refused));
done:
  return status;
}

CwStatus cw_task_server_start(const CwTeam *team, const CwTaskOrder *order, CwTaskServer **made) {
  CwStatus status = CW_OK;
  CW_NEW(*made, 1);
  (*made)->team = team;
  (*made)->order = *order;
  (*made)->answer = MPI_REQUEST_NULL;
  if (team->rank == 0) CW_TRY(start_thread(*made));
done:
  return status;
}

// The first rank, which has nothing else to do, answers until it has its own answer, or all ranks know of the end.
static void attend(CwTaskServer *server, int to_the_end, void (*meanwhile)(void *given, int64_t ended), void *given) {
  CwTeamWait wait = cw_team_wait_begin();
  for (;; cw_team_wait_on(&wait)) {
    pthread_mutex_lock(&server->lock);
    answer(server);
    int over = to_the_end ? server->gone == server->team->ranks : !server->asks[0];
    int64_t ended = server->ended;
    pthread_mutex_unlock(&server->lock);
    if (meanwhile) meanwhile(given, ended);
    if (over) break;
  }
}

CwPlaces cw_task_server_next(CwTaskServer *server, int in_vain, void (*meanwhile)(void *given, int64_t ended),
                             void *given) {
  if (server->last) return (CwPlaces){0};
  if (server->team->rank > 0) {
    if (server->answer == MPI_REQUEST_NULL) ask(server, in_vain);
    cw_team_wait(&server->answer);
  } else {
    pthread_mutex_lock(&server->lock);
    take_up(server, 0, in_vain);
    pthread_mutex_unlock(&server->lock);
    attend(server, 0, meanwhile, given);
    server->next = server->held[0];
  }
  server->last = are_last(&server->order, &server->next);
  return server->next;
}

void cw_task_server_stop(CwTaskServer *server) {
  if (!server) return;
  if (server->started) {
    attend(server, 1, NULL, NULL);
    pthread_join(server->thread, NULL);
  }
  free(server->state);
  free(server->held);
  free(server->asks);
  free(server);
}
