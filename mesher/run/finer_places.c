// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/finer_places.h"

#include <stdlib.h>
#include <string.h>

#include "mesher/cad/symmetry.h"

static const double SHORTER = 0.5; // than edges are now

// With the periodic images.
static CwStatus add(const CwDomain *domain, CwFinerPlace place, CwFinerPlaces *places) {
  CwStatus status = CW_OK;
  const CwSymmetry *symmetry = domain->symmetry;
  int images = symmetry ? symmetry->count : 1;
  if (symmetry && place.bare >= 0) images = cw_images_size(&symmetry->face, images, place.bare);
  CW_GROW(places->place, places->capacity, places->count + images);
  for (int turns = 0; turns < images; turns++) {
    CwFinerPlace *image = &places->place[places->count++];
    *image = place;
    if (turns == 0) continue;
    cw_symmetry_turn(symmetry->count, turns, place.point.x, image->point.x);
    if (place.bare >= 0) image->bare = cw_images_turned(&symmetry->face, place.bare, turns);
  }
done:
  return status;
}

CwStatus cw_finer_places_add(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places) {
  double size = SHORTER * cw_size_at(domain->size, x) / cw_size_scale(domain->size);
  return add(domain, (CwFinerPlace){number, -1, {{x[0], x[1], x[2]}, size}}, places);
}

// The least wall with layers within half an edge of x; -1: none.
static CwStatus find_wall(const CwDomain *domain, const double x[3], int32_t *wall) {
  CwStatus status = CW_OK;
  const CwCad *cad = domain->cad;
  const double reach = 0.5 * cw_size_at(domain->size, x);
  double *area = NULL;
  *wall = -1;
  CW_TRY(cw_domain_face_areas(domain, &area));
  for (int f = 0; f < cw_cad_face_count(cad); f++) {
    if (!cw_cad_face_is_wall(cad, f) || (*wall >= 0 && area[f] >= area[*wall])) continue;
    if (cw_cad_face_distance(cad, f, x) <= reach) *wall = f;
  }
done:
  free(area);
  return status;
}

CwStatus cw_finer_places_add_bare(const CwDomain *domain, int32_t number, const double x[3], CwFinerPlaces *places) {
  CwStatus status = CW_OK;
  int32_t wall;
  CW_TRY(find_wall(domain, x, &wall));
  if (wall >= 0) CW_TRY(add(domain, (CwFinerPlace){number, wall, {{x[0], x[1], x[2]}, 0}}, places));
done:
  return status;
}

CwStatus cw_finer_places_of(const CwFinerPlaces *places, int32_t domain, int32_t *count, CwSizePoint **point) {
  CwStatus status = CW_OK;
  *count = 0;
  CW_NEW(*point, places->count);
  for (int32_t i = 0; i < places->count; i++)
    if (places->place[i].domain == domain && places->place[i].bare < 0) (*point)[(*count)++] = places->place[i].point;
done:
  return status;
}

void cw_finer_places_free(CwFinerPlaces *places) {
  free(places->place);
  memset(places, 0, sizeof *places);
}
