// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/finer_places.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/cad/symmetry.h"

static const double SHORTER = 0.5; // than edges are now

CwStatus cw_finer_places_add(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places) {
  CwStatus status = CW_OK;
  int images = domain->symmetry ? domain->symmetry->count : 1;
  double size = SHORTER * cw_size_at(domain->size, x) / cw_size_scale(domain->size);
  CW_GROW(places->place, places->capacity, places->count + images);
  for (int turns = 0; turns < images; turns++) {
    CwFinerPlace *place = &places->place[places->count++];
    *place = (CwFinerPlace){number, {{x[0], x[1], x[2]}, size}};
    if (turns > 0) cw_symmetry_turn(images, turns, x, place->point.x);
  }
done:
  return status;
}

CwStatus cw_finer_places_of(const CwFinerPlaces *places, int32_t domain, int32_t *count, CwSizePoint **point) {
  CwStatus status = CW_OK;
  *count = 0;
  CW_NEW(*point, places->count);
  for (int32_t i = 0; i < places->count; i++)
    if (places->place[i].domain == domain) (*point)[(*count)++] = places->place[i].point;
done:
  return status;
}

void cw_finer_places_free(CwFinerPlaces *places) {
  free(places->place);
  memset(places, 0, sizeof *places);
}
