// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/finer_places.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesher/cad/symmetry.h"
#include "mesher/common/vec.h"

static const double SHORTER = 0.5; // than edges are now
static const double WIDER = 2;     // radius of a place where columns did not do before

// With the periodic images.
static CwStatus add(const CwDomain *domain, CwFinerPlace place, CwFinerPlaces *places) {
  CwStatus status = CW_OK;
  const CwSymmetry *symmetry = domain->symmetry;
  int images = symmetry ? symmetry->count : 1;
  CW_GROW(places->place, places->capacity, places->count + images);
  for (int turns = 0; turns < images; turns++) {
    CwFinerPlace *image = &places->place[places->count++];
    *image = place;
    if (turns > 0) cw_symmetry_turn(symmetry->count, turns, place.point.x, image->point.x);
  }
done:
  return status;
}

CwStatus cw_finer_places_add(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places) {
  double size = SHORTER * cw_size_at(domain->size, x) / cw_size_scale(domain->size);
  return add(domain, (CwFinerPlace){number, 0, {{x[0], x[1], x[2]}, size}}, places);
}

CwStatus cw_finer_places_add_pinched(const CwDomain *domain, int32_t number, const double x[3], int32_t before,
                                     CwFinerPlaces *places) {
  double radius = cw_size_at(domain->size, x);
  for (int32_t i = 0; i < before; i++) {
    const CwFinerPlace *place = &places->place[i];
    double wider = WIDER * place->point.size;
    if (place->domain != number || !place->pinched || cw_distance(place->point.x, x) > wider) continue;
    radius = fmax(radius, wider);
  }
  return add(domain, (CwFinerPlace){number, 1, {{x[0], x[1], x[2]}, radius}}, places);
}

CwStatus cw_finer_places_of(const CwFinerPlaces *places, int32_t domain, int32_t *count, CwSizePoint **point) {
  CwStatus status = CW_OK;
  *count = 0;
  CW_NEW(*point, places->count);
  for (int32_t i = 0; i < places->count; i++)
    if (places->place[i].domain == domain && !places->place[i].pinched) (*point)[(*count)++] = places->place[i].point;
done:
  return status;
}

void cw_finer_places_free(CwFinerPlaces *places) {
  free(places->place);
  memset(places, 0, sizeof *places);
}
