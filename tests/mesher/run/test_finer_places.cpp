// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "filleted_step.h"

extern "C" {
#include "mesher/cad/symmetry.h"
#include "mesher/policy.h"
#include "mesher/run/finer_places.h"
#include "mesher/run/poor_places.h"
}

#include "planned_solid.h"

// A place asks for half of the edges that are there, at scale 1, and so do its images; those of other domains are
// theirs.
static void places_ask_for_half(void **) {
  PlannedSolid solid(filleted_step(false));
  CwDomain domain = {};
  CwSymmetry symmetry = {};
  CwFinerPlaces places = {};
  const double x[3] = {3e-3, 1e-3, 2e-3};
  symmetry.count = 4;
  domain.size = solid.size;
  cw_size_set_scale(solid.size, 1);
  const double wanted = cw_size_at(solid.size, x);
  cw_size_set_scale(solid.size, 3);
  assert_int_equal(cw_finer_places_add(&domain, 1, x, &places), CW_OK);
  assert_int_equal(places.count, 1);
  domain.symmetry = &symmetry;
  assert_int_equal(cw_finer_places_add(&domain, 0, x, &places), CW_OK);
  assert_int_equal(places.count, 5);
  for (int d = 0; d < 2; d++) {
    int32_t count;
    CwSizePoint *point = nullptr;
    assert_int_equal(cw_finer_places_of(&places, d, &count, &point), CW_OK);
    assert_int_equal(count, d == 0 ? 4 : 1);
    for (int i = 0; i < count; i++) {
      const double turned[4][2] = {{x[0], x[1]}, {-x[1], x[0]}, {-x[0], -x[1]}, {x[1], -x[0]}};
      assert_near(point[i].size, wanted / 2, 1e-9 * wanted);
      assert_near(std::fabs(point[i].x[0] - turned[i][0]) + std::fabs(point[i].x[1] - turned[i][1]), 0, 1e-15);
      assert_near(point[i].x[2], x[2], 0);
    }
    std::free(point);
  }
  cw_finer_places_free(&places);
  assert_int_equal(places.count, 0);
}

// Of the walls at a place the least is left bare that still has layers, and its images; none of them asks for shorter
// edges.
static void the_least_wall_there_goes_bare(void **) {
  PlannedSolid solid(filleted_step(false));
  CwDomain domain = {};
  CwSymmetry symmetry = {};
  CwFinerPlaces places = {};
  CwSizePoint *point = nullptr;
  double *area = nullptr, x[3], range[2], far[3] = {1, 1, 1};
  int32_t count;
  int face[2];
  domain.cad = solid.cad;
  domain.background = solid.background;
  domain.size = solid.size;
  cw_size_set_scale(solid.size, 1e-3);
  check(cw_domain_face_areas(&domain, &area));
  cw_cad_edge_faces(solid.cad, 0, face);
  cw_cad_edge_range(solid.cad, 0, range);
  cw_cad_edge_point(solid.cad, 0, 0.5 * (range[0] + range[1]), x, nullptr);
  const int less = area[face[0]] < area[face[1]] ? 0 : 1;
  assert_true(area[face[less]] > 0 && area[face[less]] != area[face[!less]]);
  std::free(area);
  check(cw_finer_places_add_bare(&domain, 1, far, &places));
  assert_int_equal(places.count, 0);
  std::vector<int32_t> next, first, turns;
  for (int f = 0; f < cw_cad_face_count(solid.cad); f++) next.push_back(f), first.push_back(f), turns.push_back(0);
  symmetry.count = 2;
  symmetry.face = {next.data(), first.data(), turns.data()}; // each comes to itself, but for these two
  next[face[0]] = face[1];
  next[face[1]] = face[0];
  first[face[0]] = first[face[1]] = std::min(face[0], face[1]);
  turns[std::max(face[0], face[1])] = 1;
  domain.symmetry = &symmetry;
  check(cw_finer_places_add_bare(&domain, 1, x, &places));
  assert_int_equal(places.count, 2);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(places.place[i].domain, 1);
    assert_int_equal(places.place[i].bare, face[i == 0 ? less : !less]);
    assert_near(places.place[i].point.x[0], i == 0 ? x[0] : -x[0], 1e-15);
  }
  cw_cad_face_leave_bare(solid.cad, face[less]);
  domain.symmetry = nullptr;
  check(cw_finer_places_add_bare(&domain, 0, x, &places));
  assert_int_equal(places.place[2].bare, face[!less]);
  for (int d = 0; d < 2; d++) {
    check(cw_finer_places_of(&places, d, &count, &point));
    assert_int_equal(count, 0);
    std::free(point);
  }
  cw_finer_places_free(&places);
}

// Of two regions with places at 11, 15.9 and 17 degrees only the one that is flat asks for shorter edges: at the flat
// place and at the nearly flat one, below 4/3 of what is wanted. Of places that are near the first alone does.
static void flat_regions_ask_where_they_are_nearly_flat(void **) {
  static CwMeshRun run;
  PlannedSolid solid(filleted_step(false));
  CwRegionSummary made[2] = {};
  cw_size_set_scale(solid.size, 0.02);
  const double apart = 3 * cw_size_at(solid.size, (const double[]){1e-3, 1e-3, 1e-3});
  for (int r = 0; r < 2; r++) {
    made[r].dihedral_allowed = 40;
    made[r].quality.flat_count = 4;
    for (int i = 0; i < 4; i++) {
      const double flatness[] = {11, 11.5, 15.9, 17}, at[] = {0, 0.1, 1, 2};
      made[r].quality.flat[i] = {{1e-3 + at[i] * apart, 1e-3 + 5 * r * apart, 1e-3}, flatness[i]};
    }
    made[r].quality.flattest = r == 0 ? 11 : cw_policy.flat_angle;
  }
  run.model.domain_count = 1;
  run.domain[0].size = solid.size;
  run.domain[0].plan.region_count = 2;
  run.summary[0] = made;
  assert_int_equal(cw_finer_at_poor(&run), CW_OK);
  assert_int_equal(run.finer.count, 2);
  for (int i = 0; i < 2; i++) assert_near(run.finer.place[i].point.x[0], 1e-3 + i * apart, 1e-15);
  cw_finer_places_free(&run.finer);
}

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(places_ask_for_half), cmocka_unit_test(the_least_wall_there_goes_bare),
                              cmocka_unit_test(flat_regions_ask_where_they_are_nearly_flat)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
