// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/case_cad.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/case_schema.h"
#include "pipeline/case_value.h"
#include "pipeline/vec.h"

static const char *const section_keys[] = {"files",   "unit_mm", "axis", "tolerance_mm", "face_names", "cut",
                                           "domains", "patches", NULL};
static const char *const axis_keys[] = {"point_mm", "direction", NULL};
static const char *const cut_keys[] = {"radius_mm", "meridian_mm", NULL};
static const char *const domain_keys[] = {"solid", "inside_mm", "rotating", NULL};
static const char *const patch_keys[] = {"faces",  "colour",           "layer", "near_mm",   "domain", "kind", "walls",
                                         "y_plus", "velocity_m_per_s", "turns", "monitored", NULL};
static const char *const kinds[] = {"auto", "wall", "inlet", "outlet", "symmetry", "interface", NULL};
static const char *const groups[] = {"auto", "blade", "hub_shroud", "volute", "pipe", NULL};
static const char *const truths[] = {"false", "true", NULL};
static const char *const name_uses[] = {"ignored", "patches", NULL};
enum { DOMAIN_NAME_MOST = 14, PATCH_NAME_MOST = 22 };

#define FAIL_AT(node, format, ...)                                                                                     \
  CW_FAIL(CW_ERR_INPUT, "%s:%d:%d: %s: " format, path, (node)->place.line, (node)->place.column, (node)->path,         \
          __VA_ARGS__)

// Whether `key` is `known`, which may end in another unit of length or speed. *unit: the one it ends in.
static int is_key(const char *key, const char *known, const CwUnit **unit) {
  size_t stem, known_stem;
  *unit = cw_unit_of_key(key, &stem);
  const CwUnit *own = cw_unit_of_key(known, &known_stem);
  if (!strcmp(key, known)) return 1;
  return *unit && own && !strcmp((*unit)->quantity, own->quantity) && stem == known_stem && !strncmp(key, known, stem);
}

// The member `known` of a mapping and its unit, or NULL.
static const CwCaseNode *member(const CwCaseNode *map, const char *known, const CwUnit **unit) {
  for (int i = 0; i < map->count; i++)
    if (is_key(map->item[i].key, known, unit)) return &map->item[i];
  return NULL;
}

static CwStatus require_map(const char *path, const CwCaseNode *node, const char *const *known) {
  CwStatus status = CW_OK;
  char words[CW_WRONG_SIZE];
  const CwUnit *unit;
  if (known)
    cw_case_words(known, words, sizeof words);
  else
    snprintf(words, sizeof words, "free names, one a line");
  if (node->type != CW_NODE_MAP) return FAIL_AT(node, "it is no mapping; allowed: the keys %s", words);
  for (int i = 0; known && i < node->count; i++) {
    const char *const *own = known;
    while (*own && !is_key(node->item[i].key, *own, &unit)) own++;
    if (!*own) return FAIL_AT(&node->item[i], "no such key; allowed: %s", words);
    const CwCaseNode *first = member(node, *own, &unit); // it may end in another unit
    if (first != &node->item[i])
      return FAIL_AT(&node->item[i], "given twice, first in line %d; allowed: once", first->place.line);
  }
  return status;
}

static CwStatus read_number(const char *path, const CwCaseNode *node, const CwUnit *unit, double least, double most,
                            double *value) {
  char shown[CW_SHOWN_SIZE];
  double number = NAN;
  cw_show(node->text ? node->text : "a list", shown);
  const char *what = node->type == CW_NODE_SCALAR ? cw_number_text_read(node->text, &number) : "is not one number";
  if (!what && unit) number = number * unit->numerator / unit->denominator;
  if (!what && (number < least || number > most)) what = "is out of range";
  if (what)
    return FAIL_AT(node, "%s %s; allowed: %.6g to %.6g%s", shown, what, least, most, unit ? " in SI units" : "");
  *value = number;
  return CW_OK;
}

static CwStatus read_point(const char *path, const CwCaseNode *node, const CwUnit *unit, double point[3]) {
  CwStatus status = CW_OK;
  if (node->type != CW_NODE_LIST || node->count != 3) return FAIL_AT(node, "it is no point; allowed: [%s]", "x, y, z");
  for (int i = 0; i < 3; i++) CW_TRY(read_number(path, &node->item[i], unit, -1e4, 1e4, &point[i]));
done:
  return status;
}

static CwStatus read_points(const char *path, const CwCaseNode *node, const CwUnit *unit, CwCadPoints *points) {
  CwStatus status = CW_OK;
  const int many = node->type == CW_NODE_LIST && node->count > 0 && node->item[0].type == CW_NODE_LIST;
  const int count = many ? node->count : 1;
  CW_NEW(points->at, count);
  for (; points->count < count; points->count++)
    CW_TRY(read_point(path, many ? &node->item[points->count] : node, unit, points->at[points->count]));
done:
  return status;
}

static CwStatus read_texts(const char *path, const CwCaseNode *node, CwCadTexts *texts) {
  CwStatus status = CW_OK;
  const int count = node->type == CW_NODE_LIST ? node->count : 1;
  if (node->type == CW_NODE_MAP || count == 0)
    return FAIL_AT(node, "it names nothing; allowed: %s", "a name or a list of them");
  CW_NEW(texts->text, count);
  for (; texts->count < count; texts->count++) {
    const CwCaseNode *item = node->type == CW_NODE_LIST ? &node->item[texts->count] : node;
    if (item->type != CW_NODE_SCALAR || !item->text[0])
      return FAIL_AT(item, "it is no name; allowed: %s", "a name or a list of them");
    CW_NEW(texts->text[texts->count], strlen(item->text) + 1);
    strcpy(texts->text[texts->count], item->text);
  }
done:
  return status;
}

static CwStatus read_choice(const char *path, const CwCaseNode *node, const char *const *words, int *choice) {
  char allowed[CW_WRONG_SIZE], shown[CW_SHOWN_SIZE];
  for (int i = 0; node->type == CW_NODE_SCALAR && words[i]; i++) {
    if (strcmp(node->text, words[i])) continue;
    *choice = i;
    return CW_OK;
  }
  cw_case_words(words, allowed, sizeof allowed);
  cw_show(node->text ? node->text : "a list", shown);
  return FAIL_AT(node, "%s is not one of the choices; allowed: %s", shown, allowed);
}

static CwStatus read_name(const char *path, const CwCaseNode *node, const char *text, int most, int small,
                          char name[CW_NAME_SIZE]) {
  size_t length = strlen(text), fine = 0;
  while (fine < length && (isdigit((unsigned char)text[fine]) || text[fine] == '_' ||
                           (small ? islower((unsigned char)text[fine]) : isalpha((unsigned char)text[fine]))))
    fine++;
  if (!length || fine < length || length > (size_t)most || !isalpha((unsigned char)text[0]))
    return FAIL_AT(node,
                   "no name that files and solvers take; allowed: 1 to %d %sletters, digits and _, a letter first",
                   most, small ? "small " : "");
  strcpy(name, text);
  return CW_OK;
}

static CwStatus read_colour(const char *path, const CwCaseNode *node, int *colour) {
  const char *text = node->type == CW_NODE_SCALAR ? node->text : "";
  if (text[0] != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6)
    return FAIL_AT(node, "it is no colour; allowed: %s", "\"#rrggbb\", in quotes");
  *colour = (int)strtol(text + 1, NULL, 16);
  return CW_OK;
}

static CwStatus read_axis(const char *path, const CwCaseNode *node, CwCaseCad *cad) {
  CwStatus status = CW_OK;
  const CwUnit *unit;
  CW_TRY(require_map(path, node, axis_keys));
  const CwCaseNode *point = member(node, "point_mm", &unit);
  if (point) CW_TRY(read_point(path, point, unit, cad->point));
  const CwCaseNode *direction = member(node, "direction", &unit);
  if (!direction) goto done;
  CW_TRY(read_point(path, direction, NULL, cad->axis));
  if (!(cw_unit(cad->axis) > 0))
    status = FAIL_AT(direction, "it has no length; allowed: %s", "a vector other than [0, 0, 0]");
done:
  return status;
}

static CwStatus read_cut(const char *path, const CwCaseNode *node, CwCadCut *cut) {
  CwStatus status = CW_OK;
  const CwUnit *unit;
  CW_TRY(require_map(path, node, cut_keys));
  const CwCaseNode *radius = member(node, "radius_mm", &unit);
  if (radius) CW_TRY(read_number(path, radius, unit, 1e-4, 10, &cut->radius));
  const CwCaseNode *meridian = member(node, "meridian_mm", &unit);
  if (!meridian == !radius || (meridian && (meridian->type != CW_NODE_LIST || meridian->count < 2)))
    status = FAIL_AT(node, "it is no surface; allowed: %s", "radius_mm: R, or meridian_mm: [[r, z], [r, z]]");
  if (status != CW_OK || !meridian) goto done;
  CW_NEW(cut->meridian, meridian->count);
  for (; cut->count < meridian->count; cut->count++) {
    const CwCaseNode *point = &meridian->item[cut->count];
    if (point->type != CW_NODE_LIST || point->count != 2) {
      status = FAIL_AT(point, "it is no point of a meridian; allowed: [%s]", "r, z");
      goto done;
    }
    CW_TRY(read_number(path, &point->item[0], unit, 0, 10, &cut->meridian[cut->count][0]));
    CW_TRY(read_number(path, &point->item[1], unit, -1e3, 1e3, &cut->meridian[cut->count][1]));
  }
done:
  return status;
}

static CwStatus read_domain(const char *path, const CwCaseNode *node, CwCadDomain *domain) {
  CwStatus status = CW_OK;
  const CwUnit *unit;
  domain->place = node->place;
  CW_TRY(read_name(path, node, node->key, DOMAIN_NAME_MOST, 1, domain->name));
  CW_TRY(require_map(path, node, domain_keys));
  const CwCaseNode *solid = member(node, "solid", &unit);
  if (solid) CW_TRY(read_texts(path, solid, &domain->solids));
  const CwCaseNode *inside = member(node, "inside_mm", &unit);
  if (inside) CW_TRY(read_points(path, inside, unit, &domain->inside));
  if (!solid && !inside)
    status = FAIL_AT(node, "it chooses no solid; allowed: %s", "solid: NAME or NUMBER, or inside_mm: [x, y, z]");
  if (status != CW_OK) goto done;
  const CwCaseNode *rotating = member(node, "rotating", &unit);
  if (rotating) CW_TRY(read_choice(path, rotating, truths, &domain->rotating));
done:
  return status;
}

static CwStatus read_patch_walls(const char *path, const CwCaseNode *node, CwCadPatch *patch) {
  CwStatus status = CW_OK;
  const CwUnit *unit;
  const CwCaseNode *item;
  int choice = 0;
  item = member(node, "kind", &unit);
  if (item && item->type == CW_NODE_SCALAR && !strcmp(item->text, "periodic"))
    return FAIL_AT(item, "one passage with periodic sides cannot be meshed by itself; allowed: %s",
                   "the water of the whole wheel, whose passages are found by themselves "
                   "(mesh.periodic_impeller), without this patch");
  if (item) CW_TRY(read_choice(path, item, kinds, &choice));
  patch->kind = (CwCadKind)choice;
  choice = 0;
  if ((item = member(node, "walls", &unit))) CW_TRY(read_choice(path, item, groups, &choice));
  patch->walls = (CwCadWalls)choice;
  if ((item = member(node, "turns", &unit))) CW_TRY(read_choice(path, item, truths, &patch->turns));
  if ((item = member(node, "monitored", &unit))) CW_TRY(read_choice(path, item, truths, &patch->monitored));
  if ((item = member(node, "y_plus", &unit))) CW_TRY(read_number(path, item, NULL, 0.05, 1000, &patch->y_plus));
  if ((item = member(node, "velocity_m_per_s", &unit)))
    CW_TRY(read_number(path, item, unit, 0.001, 1000, &patch->velocity));
done:
  return status;
}

static CwStatus read_patch(const char *path, const CwCaseNode *node, const CwCaseCad *cad, CwCadPatch *patch) {
  CwStatus status = CW_OK;
  const CwUnit *unit;
  const CwCaseNode *item, *layer, *near, *faces;
  patch->place = node->place;
  patch->colour = patch->turns = patch->monitored = -1;
  patch->y_plus = patch->velocity = NAN;
  CW_TRY(read_name(path, node, node->key, PATCH_NAME_MOST, 0, patch->name));
  CW_TRY(require_map(path, node, patch_keys));
  if ((faces = member(node, "faces", &unit))) CW_TRY(read_texts(path, faces, &patch->faces));
  if ((layer = member(node, "layer", &unit))) CW_TRY(read_texts(path, layer, &patch->layers));
  if ((near = member(node, "near_mm", &unit))) CW_TRY(read_points(path, near, unit, &patch->near));
  if ((item = member(node, "colour", &unit))) CW_TRY(read_colour(path, item, &patch->colour));
  if (!faces && !layer && !near && patch->colour < 0)
    status = FAIL_AT(node, "it takes no face; allowed: %s", "faces, colour, layer or near_mm");
  if (status != CW_OK) goto done;
  if ((item = member(node, "domain", &unit))) {
    int known = 0;
    for (int d = 0; d < cad->domain_count; d++) known |= item->text && !strcmp(cad->domain[d].name, item->text);
    if (!known) status = FAIL_AT(item, "there is no such domain; allowed: %s", "a name of cad.domains");
    if (status != CW_OK) goto done;
    strcpy(patch->domain, item->text);
  }
  CW_TRY(read_patch_walls(path, node, patch));
done:
  return status;
}

static CwStatus read_domains(const char *path, const CwCaseNode *node, CwCaseCad *cad) {
  CwStatus status = CW_OK;
  CW_TRY(require_map(path, node, NULL));
  CW_NEW(cad->domain, node->count);
  cad->domain_count = node->count;
  for (int i = 0; i < node->count; i++) CW_TRY(read_domain(path, &node->item[i], &cad->domain[i]));
  if (!node->count) status = FAIL_AT(node, "it names no domain; allowed: %s", "NAME: {solid: NAME, rotating: true}");
done:
  return status;
}

static CwStatus read_patches(const char *path, const CwCaseNode *node, CwCaseCad *cad) {
  CwStatus status = CW_OK;
  CW_TRY(require_map(path, node, NULL));
  CW_NEW(cad->patch, node->count);
  cad->patch_count = node->count;
  for (int i = 0; i < node->count; i++) CW_TRY(read_patch(path, &node->item[i], cad, &cad->patch[i]));
done:
  return status;
}

// Files count from the folder of the case file.
static CwStatus place_files(const char *case_path, CwCadTexts *files) {
  CwStatus status = CW_OK;
  const char *slash = strrchr(case_path, '/');
  const size_t folder = slash ? (size_t)(slash - case_path) + 1 : 0;
  for (int i = 0; i < files->count; i++) {
    char *placed, *given = files->text[i];
    if (given[0] == '/' || !folder) continue;
    CW_NEW(placed, folder + strlen(given) + 1);
    memcpy(placed, case_path, folder);
    strcpy(placed + folder, given);
    free(given);
    files->text[i] = placed;
  }
done:
  return status;
}

static void add_to_digest(const CwCaseNode *node, CwHash *hash) {
  cw_hash_bytes(hash, &node->type, sizeof node->type);
  cw_hash_bytes(hash, &node->count, sizeof node->count);
  if (node->key) cw_hash_bytes(hash, node->key, strlen(node->key) + 1);
  if (node->text) cw_hash_bytes(hash, node->text, strlen(node->text) + 1);
  for (int i = 0; i < node->count; i++) add_to_digest(&node->item[i], hash);
}

CwStatus cw_case_cad_read(const char *path, const char *case_path, const CwCaseNode *section, CwCaseCad **made) {
  CwStatus status = CW_OK;
  CwCaseCad *cad = NULL;
  const CwUnit *unit;
  const CwCaseNode *item;
  CW_NEW(cad, 1);
  *cad = (CwCaseCad){.axis = {0, 0, 1}, .tolerance = NAN, .names_are_patches = 1, .place = section->place};
  CW_TRY(require_map(path, section, section_keys));
  if (!(item = member(section, "files", &unit))) {
    status = FAIL_AT(section, "the key files is missing; allowed: %s", "files: [pump.step]");
    goto done;
  }
  CW_TRY(read_texts(path, item, &cad->files));
  CW_TRY(place_files(case_path, &cad->files));
  if ((item = member(section, "unit_mm", &unit))) CW_TRY(read_number(path, item, unit, 1e-7, 10, &cad->unit));
  if ((item = member(section, "tolerance_mm", &unit)))
    CW_TRY(read_number(path, item, unit, 1e-9, 0.1, &cad->tolerance));
  if ((item = member(section, "axis", &unit))) CW_TRY(read_axis(path, item, cad));
  if ((item = member(section, "cut", &unit))) CW_TRY(read_cut(path, item, &cad->cut));
  if ((item = member(section, "face_names", &unit)))
    CW_TRY(read_choice(path, item, name_uses, &cad->names_are_patches));
  if (!(item = member(section, "domains", &unit))) {
    status =
        FAIL_AT(section, "the key domains is missing; allowed: %s", "domains: {rotor: {solid: NAME, rotating: true}}");
    goto done;
  }
  CW_TRY(read_domains(path, item, cad));
  if ((item = member(section, "patches", &unit))) CW_TRY(read_patches(path, item, cad));
  CwHash hash = cw_hash_start();
  add_to_digest(section, &hash);
  cw_hash_hex(&hash, cad->digest);
  *made = cad;
  cad = NULL;
done:
  cw_case_cad_free(cad);
  return status;
}

static void free_texts(CwCadTexts *texts) {
  for (int i = 0; texts->text && i < texts->count; i++) free(texts->text[i]);
  free(texts->text);
}

void cw_case_cad_free(CwCaseCad *cad) {
  if (!cad) return;
  free_texts(&cad->files);
  free(cad->cut.meridian);
  for (int i = 0; i < cad->domain_count; i++) {
    free_texts(&cad->domain[i].solids);
    free(cad->domain[i].inside.at);
  }
  for (int i = 0; i < cad->patch_count; i++) {
    free_texts(&cad->patch[i].faces);
    free_texts(&cad->patch[i].layers);
    free(cad->patch[i].near.at);
  }
  free(cad->domain);
  free(cad->patch);
  free(cad);
}
