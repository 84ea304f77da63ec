// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/model.h"

#include <ctype.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/json_read.h"
#include "pipeline/record.h"

enum { FORMAT = 2 };

static const char *const kinds[] = {"wall", "inlet", "outlet", "interface", "symmetry"};
static const char *const groups[] = {"blade", "hub_shroud", "volute", "pipe", "interface"};
static const char *const surfaces[] = {"cylinder", "plane", "other"};

const char *cw_patch_kind_name(CwPatchKind kind) {
  return kinds[kind];
}

const char *cw_patch_group_name(CwPatchGroup group) {
  return groups[group];
}

void cw_model_free(CwModel *model) {
  free(model->patch);
  free(model->interface);
  memset(model, 0, sizeof *model);
}

int cw_model_domain_find(const CwModel *model, const char *name) {
  for (int d = 0; d < model->domain_count; d++)
    if (!strcmp(model->domain[d].name, name)) return d;
  return -1;
}

int cw_model_patch_find(const CwModel *model, const char *name) {
  for (int p = 0; p < model->patch_count; p++)
    if (!strcmp(model->patch[p].name, name)) return p;
  return -1;
}

int cw_interface_of(const CwModelInterface *interface, int count, int patch, int *side) {
  for (int i = 0; i < count; i++)
    for (*side = 0; *side < 2; ++*side)
      if (interface[i].patch[*side] == patch) return i;
  return -1;
}

#define SMALL "abcdefghijklmnopqrstuvwxyz"
#define CAPITALS "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
#define DIGITS "0123456789_"

static CwStatus check_name(const char *what, const char *name, int most, const char *allowed, const char *text) {
  return name[0] && strlen(name) <= (size_t)most && strspn(name, allowed) == strlen(name)
             ? CW_OK
             : CW_FAIL(CW_ERR_INPUT, "%s '%s'; allowed are 1 to %d %s, digits and _", what, name, most, text);
}

void cw_domain_zone_name(const char *domain, char name[CW_NAME_SIZE]) {
  size_t length = strlen(domain);
  for (size_t k = 0; k <= length; k++) name[k] = (char)toupper((unsigned char)domain[k]);
}

void cw_domain_family_name(const char *domain, char name[CW_NAME_SIZE]) {
  snprintf(name, CW_NAME_SIZE, "%.*s_domain", CW_DOMAIN_NAME_MOST, domain);
}

// In CGNS zone and family of a domain stand beside the families of patches.
static CwStatus check_patch_name(const char *patch, const char *domain) {
  CwStatus status = CW_OK;
  char zone[CW_NAME_SIZE], family[CW_NAME_SIZE];
  cw_domain_zone_name(domain, zone);
  cw_domain_family_name(domain, family);
  CW_REQUIRE(strcmp(patch, zone) && strcmp(patch, family), CW_ERR_INPUT,
             "patch '%s' has a name that domain '%s' has in CGNS; any other will do, such as '%s_wall'", patch, domain,
             domain);
done:
  return status;
}

CwStatus cw_model_add_domain(CwModel *model, const char *name, int rotating) {
  CwStatus status = CW_OK;
  CW_TRY(check_name("domain name", name, CW_DOMAIN_NAME_MOST, SMALL DIGITS, "small letters"));
  CW_REQUIRE(cw_model_domain_find(model, name) < 0, CW_ERR_INPUT, "domain '%s' is named twice", name);
  CW_REQUIRE(model->domain_count < CW_DOMAINS_MOST, CW_ERR_INPUT, "domain '%s' is one more than %d, which are allowed",
             name, CW_DOMAINS_MOST);
  for (int p = 0; p < model->patch_count; p++) CW_TRY(check_patch_name(model->patch[p].name, name));
  CwModelDomain *domain = &model->domain[model->domain_count++];
  *domain = (CwModelDomain){.rotating = rotating, .first_patch = model->patch_count};
  strcpy(domain->name, name);
done:
  return status;
}

CwStatus cw_model_add_patch(CwModel *model, const char *name, CwPatchKind kind, CwModelPatch **patch) {
  CwStatus status = CW_OK;
  CW_REQUIRE(model->domain_count > 0, CW_ERR_INPUT, "patch '%s' stands before the first domain", name);
  CwModelDomain *domain = &model->domain[model->domain_count - 1];
  CW_TRY(check_name("patch name", name, CW_PATCH_NAME_MOST, SMALL CAPITALS DIGITS, "letters"));
  CW_REQUIRE(cw_model_patch_find(model, name) < 0, CW_ERR_INPUT, "patch '%s' is named twice", name);
  for (int d = 0; d < model->domain_count; d++) CW_TRY(check_patch_name(name, model->domain[d].name));
  CW_REQUIRE(domain->patch_count < CW_PATCHES_MOST, CW_ERR_INPUT, "domain '%s' has more than %d patches", domain->name,
             CW_PATCHES_MOST);
  CwModelPatch *grown = realloc(model->patch, (size_t)(model->patch_count + 1) * sizeof *grown);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d patches", model->patch_count + 1);
  model->patch = grown;
  *patch = &grown[model->patch_count++];
  **patch = (CwModelPatch){.kind = kind,
                           .domain = model->domain_count - 1,
                           .size = kind == CW_PATCH_WALL        ? CW_GROUP_VOLUTE
                                   : kind == CW_PATCH_INTERFACE ? CW_GROUP_INTERFACE
                                                                : CW_GROUP_PIPE,
                           .group = CW_GROUP_VOLUTE,
                           .y_plus_asked = NAN,
                           .y_plus = NAN,
                           .turns = kind == CW_PATCH_WALL && domain->rotating,
                           .flow_share = 1};
  strcpy((*patch)->name, name);
  domain->patch_count++;
done:
  return status;
}

CwStatus cw_model_add_interface(CwModel *model, const char *const patch[2], CwInterfaceSurface surface, double radius) {
  CwStatus status = CW_OK;
  CwModelInterface made = {.surface = surface, .radius = surface == CW_SURFACE_CYLINDER ? radius : 0};
  for (int s = 0; s < 2; s++) {
    int side;
    made.patch[s] = cw_model_patch_find(model, patch[s]);
    CW_REQUIRE(made.patch[s] >= 0 && model->patch[made.patch[s]].kind == CW_PATCH_INTERFACE, CW_ERR_INPUT,
               "interface %d: '%s' is no patch of kind interface", model->interface_count + 1, patch[s]);
    CW_REQUIRE(cw_interface_of(model->interface, model->interface_count, made.patch[s], &side) < 0, CW_ERR_INPUT,
               "interface %d: patch '%s' is a side of another one", model->interface_count + 1, patch[s]);
  }
  CW_REQUIRE(model->patch[made.patch[0]].domain != model->patch[made.patch[1]].domain, CW_ERR_INPUT,
             "interface %d has both sides in domain %s", model->interface_count + 1,
             model->domain[model->patch[made.patch[0]].domain].name);
  CW_REQUIRE(surface != CW_SURFACE_CYLINDER || radius > 0, CW_ERR_INPUT,
             "interface %d: the radius of a cylinder must be above 0", model->interface_count + 1);
  CW_REQUIRE(model->interface_count < CW_INTERFACES_MOST, CW_ERR_INPUT, "more than %d interfaces", CW_INTERFACES_MOST);
  CwModelInterface *grown = realloc(model->interface, (size_t)(model->interface_count + 1) * sizeof *grown);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d interfaces", model->interface_count + 1);
  model->interface = grown;
  model->interface[model->interface_count++] = made;
done:
  return status;
}

// Numbers of a JSON object and where they lie in a structure.
typedef struct {
  const char *key;
  size_t offset;
} Number;

static const Number wall_flow[] = {{"speed_m_per_s", offsetof(CwWallFlow, speed)},
                                   {"length_m", offsetof(CwWallFlow, length)},
                                   {"diameter_m", offsetof(CwWallFlow, diameter)},
                                   {"width_m", offsetof(CwWallFlow, width)}};
static const Number model_flow[] = {{"inlet_speed_m_per_s", offsetof(CwModelFlow, inlet_speed)},
                                    {"inlet_diameter_m", offsetof(CwModelFlow, inlet_diameter)},
                                    {"passage_speed_m_per_s", offsetof(CwModelFlow, passage_speed)},
                                    {"passage_width_m", offsetof(CwModelFlow, passage_width)},
                                    {"reference_length_m", offsetof(CwModelFlow, reference_length)}};
#define COUNT(list) (sizeof(list) / sizeof *(list))

static json_t *numbers_json(const void *from, const Number *number, size_t count) {
  json_t *object = json_object();
  for (size_t i = 0; i < count; i++)
    json_object_set_new(object, number[i].key, json_real(*(const double *)((const char *)from + number[i].offset)));
  return object;
}

static CwStatus read_numbers(json_t *object, const char *where, const Number *number, size_t count, void *into) {
  CwStatus status = CW_OK;
  for (size_t i = 0; i < count; i++)
    CW_TRY(cw_json_positive(object, where, number[i].key, (double *)((char *)into + number[i].offset)));
done:
  return status;
}

static json_t *patch_json(const CwModelPatch *patch) {
  json_t *object =
      json_pack("{s:s, s:s, s:s}", "name", patch->name, "kind", kinds[patch->kind], "size", groups[patch->size]);
  if (patch->kind == CW_PATCH_WALL) {
    json_t *flow = numbers_json(&patch->flow, wall_flow, COUNT(wall_flow));
    if (patch->flow.before > 0) json_object_set_new(flow, "before_m", json_real(patch->flow.before));
    json_object_set_new(object, "group", json_string(groups[patch->group]));
    json_object_set_new(object, "turns", json_boolean(patch->turns));
    if (patch->monitored) json_object_set_new(object, "monitored", json_true());
    if (cw_case_given(patch->y_plus_asked)) json_object_set_new(object, "y_plus_asked", json_real(patch->y_plus_asked));
    if (cw_case_given(patch->y_plus)) json_object_set_new(object, "y_plus", json_real(patch->y_plus));
    json_object_set_new(object, "flow", flow);
  }
  if (patch->kind == CW_PATCH_OUTLET) json_object_set_new(object, "flow_share", json_real(patch->flow_share));
  return object;
}

CwStatus cw_model_pack(const CwModel *model, json_t **root) {
  CwStatus status = CW_OK;
  json_t *domains = json_array(), *interfaces = json_array();
  json_t *flow = numbers_json(&model->flow, model_flow, COUNT(model_flow));
  json_object_set_new(flow, "blade_count", json_integer(model->flow.blade_count));
  for (int d = 0; d < model->domain_count; d++) {
    const CwModelDomain *domain = &model->domain[d];
    json_t *patches = json_array();
    for (int p = 0; p < domain->patch_count; p++)
      json_array_append_new(patches, patch_json(&model->patch[domain->first_patch + p]));
    json_array_append_new(
        domains, json_pack("{s:s, s:b, s:o}", "name", domain->name, "rotating", domain->rotating, "patches", patches));
  }
  for (int i = 0; i < model->interface_count; i++) {
    const CwModelInterface *of = &model->interface[i];
    json_t *one = json_pack("{s:[s,s], s:s}", "patches", model->patch[of->patch[0]].name,
                            model->patch[of->patch[1]].name, "surface", surfaces[of->surface]);
    if (of->surface == CW_SURFACE_CYLINDER) json_object_set_new(one, "radius_m", json_real(of->radius));
    json_array_append_new(interfaces, one);
  }
  *root = json_pack("{s:o, s:o, s:o}", "domains", domains, "interfaces", interfaces, "flow", flow);
  CW_REQUIRE(*root, CW_ERR_MEMORY, "out of memory: the model");
done:
  return status;
}

// The index of a member's text in a list of names.
static CwStatus read_choice(json_t *object, const char *where, const char *key, const char *const *names, int count,
                            int *choice) {
  CwStatus status = CW_OK;
  const char *text;
  CW_TRY(cw_json_text(object, where, key, &text));
  for (*choice = 0; *choice < count && strcmp(names[*choice], text) != 0;) ++*choice;
  if (*choice < count) goto done;
  char allowed[100] = "";
  for (int i = 0; i < count; i++) strcat(strcat(allowed, i == 0 ? "" : i == count - 1 ? " and " : ", "), names[i]);
  CW_REQUIRE(0, CW_ERR_INPUT, "%s: %s '%s'; allowed are %s", where, key, text, allowed);
done:
  return status;
}

static CwStatus unpack_wall(json_t *object, const char *where, CwModelPatch *patch) {
  CwStatus status = CW_OK;
  json_t *flow;
  int group;
  CW_TRY(read_choice(object, where, "group", groups, CW_GROUP_INTERFACE, &group));
  patch->group = (CwPatchGroup)group;
  patch->turns = json_is_true(json_object_get(object, "turns"));
  patch->monitored = json_is_true(json_object_get(object, "monitored"));
  patch->y_plus_asked = cw_json_real(object, "y_plus_asked");
  patch->y_plus = cw_json_real(object, "y_plus");
  CW_TRY(cw_json_object(object, where, "flow", &flow));
  CW_TRY(read_numbers(flow, where, wall_flow, COUNT(wall_flow), &patch->flow));
  if (json_object_get(flow, "before_m")) CW_TRY(cw_json_positive(flow, where, "before_m", &patch->flow.before));
done:
  return status;
}

static CwStatus unpack_patch(json_t *object, const char *where, CwModel *model) {
  CwStatus status = CW_OK;
  const char *name;
  char place[1000];
  int kind, size;
  CwModelPatch *patch;
  CW_TRY(cw_json_text(object, where, "name", &name));
  snprintf(place, sizeof place, "%s: patch '%s'", where, name);
  CW_TRY(read_choice(object, place, "kind", kinds, CW_PATCH_KINDS, &kind));
  CW_TRY(cw_model_add_patch(model, name, (CwPatchKind)kind, &patch));
  CW_TRY(read_choice(object, place, "size", groups, CW_GROUPS, &size));
  patch->size = (CwPatchGroup)size;
  if (kind == CW_PATCH_WALL) CW_TRY(unpack_wall(object, place, patch));
  if (kind == CW_PATCH_OUTLET) CW_TRY(cw_json_positive(object, place, "flow_share", &patch->flow_share));
done:
  return status;
}

static CwStatus unpack_interface(json_t *object, const char *where, CwModel *model) {
  CwStatus status = CW_OK;
  const char *patch[2];
  char place[1000];
  int surface;
  double radius = 0;
  snprintf(place, sizeof place, "%s: interface %d", where, model->interface_count + 1);
  for (size_t s = 0; s < 2; s++) {
    patch[s] = json_string_value(json_array_get(json_object_get(object, "patches"), s));
    CW_REQUIRE(patch[s], CW_ERR_INPUT, "%s: 'patches' must be a list of two names", place);
  }
  CW_TRY(read_choice(object, place, "surface", surfaces, CW_SURFACES, &surface));
  if (surface == CW_SURFACE_CYLINDER) CW_TRY(cw_json_positive(object, place, "radius_m", &radius));
  CW_TRY(cw_model_add_interface(model, patch, (CwInterfaceSurface)surface, radius));
done:
  return status;
}

CwStatus cw_model_unpack(json_t *root, const char *where, CwModel *model) {
  CwStatus status = CW_OK;
  json_t *list, *item, *flow;
  size_t i, k;
  int64_t blades;
  CW_TRY(cw_json_array(root, where, "domains", &list));
  CW_REQUIRE(json_array_size(list) > 0, CW_ERR_INPUT, "%s: 'domains' is empty", where);
  json_array_foreach(list, i, item) {
    const char *name;
    json_t *patches, *patch;
    CW_TRY(cw_json_text(item, where, "name", &name));
    CW_TRY(cw_model_add_domain(model, name, json_is_true(json_object_get(item, "rotating"))));
    CW_TRY(cw_json_array(item, where, "patches", &patches));
    json_array_foreach(patches, k, patch) {
      CW_TRY(unpack_patch(patch, where, model));
    }
  }
  CW_TRY(cw_json_array(root, where, "interfaces", &list));
  json_array_foreach(list, i, item) {
    CW_TRY(unpack_interface(item, where, model));
  }
  for (int p = 0; p < model->patch_count; p++) {
    int side;
    CW_REQUIRE(model->patch[p].kind != CW_PATCH_INTERFACE ||
                   cw_interface_of(model->interface, model->interface_count, p, &side) >= 0,
               CW_ERR_INPUT, "patch '%s' of kind interface has no other side in 'interfaces'", model->patch[p].name);
  }
  CW_TRY(cw_json_object(root, where, "flow", &flow));
  CW_TRY(read_numbers(flow, where, model_flow, COUNT(model_flow), &model->flow));
  CW_TRY(cw_json_count(flow, where, "blade_count", &blades));
  model->flow.blade_count = blades < 1 ? 1 : (int)blades;
done:
  if (status == CW_ERR_INPUT) cw_fail_place(where);
  return status;
}

CwStatus cw_model_read(const char *path, CwModel *model) {
  CwStatus status = CW_OK;
  json_t *root = NULL;
  CW_TRY(cw_json_read(path, &root));
  CW_REQUIRE(json_integer_value(json_object_get(root, "format")) == FORMAT, CW_ERR_INPUT,
             "%s: 'format' must be %d: it was written by another version", path, FORMAT);
  CW_TRY(cw_json_positive(root, path, "unit_m", &model->unit));
  CW_TRY(cw_model_unpack(root, path, model));
done:
  json_decref(root);
  return status;
}

CwStatus cw_model_write(const CwModel *model, const char *path) {
  CwStatus status = CW_OK;
  json_t *root = NULL;
  CwModel again = {0};
  CW_TRY(cw_model_pack(model, &root));
  json_object_set_new(root, "format", json_integer(FORMAT));
  json_object_set_new(root, "unit_m", json_real(model->unit));
  CW_TRY(cw_model_unpack(root, path, &again)); // what its readers refuse is refused here
  CW_TRY(cw_json_write(root, path));
done:
  cw_model_free(&again);
  json_decref(root);
  return status;
}
