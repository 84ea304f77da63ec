// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/solid_choice.h"

#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LIST_SIZE = 400 };

// "1 'rotor', 2 'stator'": what there is to choose.
static void list_bodies(const CwCadBodies *bodies, char list[LIST_SIZE]) {
  size_t used = 0;
  list[0] = '\0';
  for (int i = 0; i < cw_cad_body_count(bodies) && used < LIST_SIZE - 40; i++) {
    const char *name = cw_cad_body_name(bodies, i);
    used += (size_t)snprintf(list + used, LIST_SIZE - used, "%s%d%s%.60s%s", i ? ", " : "", i + 1, *name ? " '" : "",
                             name, *name ? "'" : "");
  }
}

// `whole`: a name to the letter, not a pattern.
static int body_matches(const CwCadBodies *bodies, int body, const char *word, int whole) {
  char *end;
  const long number = strtol(word, &end, 10);
  const char *name = cw_cad_body_name(bodies, body), *instance = cw_cad_body_instance(bodies, body);
  if (*word && !*end) return number == body + 1;
  if (whole) return !strcmp(word, name) || !strcmp(word, instance);
  return !fnmatch(word, name, 0) || !fnmatch(word, instance, 0);
}

static CwStatus take(const CwCaseCad *cad, const CwCadBodies *bodies, int which, int body, int *domain) {
  CwStatus status = CW_OK;
  const int before = domain[body];
  CW_REQUIRE(before < 0 || before == which, CW_ERR_INPUT,
             "cad.domains.%s: solid %d '%s' belongs to cad.domains.%s already; allowed: each solid in one domain",
             cad->domain[which].name, body + 1, cw_cad_body_name(bodies, body), cad->domain[before].name);
  domain[body] = which;
done:
  return status;
}

static CwStatus choose_by_word(const CwCaseCad *cad, const CwCadBodies *bodies, int which, const char *word,
                               int *domain) {
  CwStatus status = CW_OK;
  char list[LIST_SIZE];
  int found = 0, whole = 2;
  while (whole && !found) { // names have brackets: what is called so goes before what the pattern takes
    whole--;
    for (int i = 0; i < cw_cad_body_count(bodies); i++) {
      if (!body_matches(bodies, i, word, whole)) continue;
      CW_TRY(take(cad, bodies, which, i, domain));
      found++;
    }
  }
  list_bodies(bodies, list);
  CW_REQUIRE(found, CW_ERR_INPUT, "cad.domains.%s.solid: '%s' matches no solid of cad.files; allowed: %s",
             cad->domain[which].name, word, list);
  CW_REQUIRE(found == 1 || !whole, CW_ERR_INPUT,
             "cad.domains.%s.solid: '%s' matches %d solids; allowed: one of the numbers of %s, or a list of them, such "
             "as [1, 2]",
             cad->domain[which].name, word, found, list);
done:
  return status;
}

static CwStatus choose_by_point(const CwCaseCad *cad, const CwCadBodies *bodies, int which, const double point[3],
                                int *domain) {
  CwStatus status = CW_OK;
  int found = 0;
  for (int i = 0; i < cw_cad_body_count(bodies); i++) {
    int holds = 0;
    CW_TRY(cw_cad_body_holds(bodies, i, point, &holds));
    if (!holds) continue;
    CW_TRY(take(cad, bodies, which, i, domain));
    found++;
  }
  CW_REQUIRE(found == 1, CW_ERR_INPUT,
             "cad.domains.%s.inside_mm: (%.6g, %.6g, %.6g) lies in %d solids of cad.files; allowed: a point inside one",
             cad->domain[which].name, 1e3 * point[0], 1e3 * point[1], 1e3 * point[2], found);
done:
  return status;
}

CwStatus cw_cad_solid_choice(const CwCaseCad *cad, const CwCadBodies *bodies, int *domain) {
  CwStatus status = CW_OK;
  for (int i = 0; i < cw_cad_body_count(bodies); i++) domain[i] = -1;
  for (int d = 0; d < cad->domain_count; d++) {
    const CwCadDomain *of = &cad->domain[d];
    for (int i = 0; i < of->solids.count; i++) CW_TRY(choose_by_word(cad, bodies, d, of->solids.text[i], domain));
    for (int i = 0; i < of->inside.count; i++) CW_TRY(choose_by_point(cad, bodies, d, of->inside.at[i], domain));
  }
done:
  return status;
}
