// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_model.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/cad/cad_wheel.h"
#include "geometry/wall_flow.h"

static const double HYDRAULIC_EFFICIENCY = 0.85; // Guelich, table 3.9, for medium pumps

typedef struct {
  double inlet_area, outlet_area;
  int inlets;
  double *volute_radius; // of each wheel, mean of its spiral's walls; 0: none
} Sizes;

static int has_walls(const CwCaseCad *cad, const CwFacePatch *patch) {
  return patch->rule >= 0 && cad->patch[patch->rule].walls != CW_CAD_WALLS_OPEN;
}

// Group of a wall that goes by no name, and size of its cells.
static CwPatchGroup group_of(const CwCaseCad *cad, const CwFacePatch *patch) {
  static const CwPatchGroup of_rule[] = {CW_GROUP_VOLUTE, CW_GROUP_BLADE, CW_GROUP_HUB_SHROUD, CW_GROUP_VOLUTE,
                                         CW_GROUP_PIPE};
  if (has_walls(cad, patch)) return of_rule[cad->patch[patch->rule].walls];
  if (patch->role == CW_ROLE_BLADE) return CW_GROUP_BLADE;
  if (patch->role == CW_ROLE_PIPE) return CW_GROUP_PIPE;
  return cad->domain[patch->part].rotating ? CW_GROUP_HUB_SHROUD : CW_GROUP_VOLUTE;
}

// Blades, hubs and shrouds of what stands still, such as guide wheels and side chambers, have the flow of a spiral.
static CwAlong along_of(CwPatchGroup group, int rotating, int before) {
  const int of_wheel = group == CW_GROUP_BLADE || group == CW_GROUP_HUB_SHROUD;
  if (of_wheel && rotating) return CW_ALONG_BLADE;
  if (before) return CW_ALONG_SUCTION;
  return of_wheel || group == CW_GROUP_VOLUTE ? CW_ALONG_VOLUTE : CW_ALONG_DISCHARGE;
}

// Its group by what the case says of its walls, else by its name, else by form and place; what turns or is monitored by
// its name.
static CwWallName wall_of(const CwCaseCad *cad, const CwFacePatches *patches, const CwFacePatch *of) {
  const CwWallName *name = cw_wall_name(of->name);
  const int rotating = cad->domain[of->part].rotating, own = name && !has_walls(cad, of);
  CwWallName wall = name ? *name : (CwWallName){.turns = -1};
  if (!own) wall.group = wall.size = group_of(cad, of);
  const int of_wheel = wall.group == CW_GROUP_BLADE || wall.group == CW_GROUP_HUB_SHROUD;
  if (!own || (of_wheel && !rotating)) wall.along = along_of(wall.group, rotating, cw_cad_is_before(patches, of->part));
  return wall;
}

static CwStatus measure(const CwCaseCad *cad, const CwSurvey *survey, const CwFacePatches *patches,
                        const CwCadWheels *wheels, Sizes *sizes) {
  CwStatus status = CW_OK;
  int *first = NULL;
  double *area = NULL; // of the spirals' walls
  CW_NEW(first, survey->face_count);
  CW_NEW(area, cad->domain_count);
  CW_NEW(sizes->volute_radius, cad->domain_count);
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    const CwFacePatch *patch = &patches->patch[patches->of_face[f]];
    first[f] = patch->kind == CW_PATCH_INLET ? f : -1;
    if (patch->kind == CW_PATCH_INLET) sizes->inlet_area += face->area;
    if (patch->kind == CW_PATCH_OUTLET) sizes->outlet_area += face->area;
    const CwWallName wall = wall_of(cad, patches, patch);
    if (patch->kind == CW_PATCH_WALL && wall.along == CW_ALONG_VOLUTE && wall.group == CW_GROUP_VOLUTE) {
      area[wheels->of_part[face->part]] += face->area;
      sizes->volute_radius[wheels->of_part[face->part]] += face->area * face->mean_radius;
    }
  }
  sizes->inlets = cw_cad_join_faces(survey, first);
  for (int w = 0; w < wheels->count; w++)
    if (area[w] > 0) sizes->volute_radius[w] /= area[w];
done:
  free(first);
  free(area);
  return status;
}

static double diameter(double area) {
  return sqrt(4 * area / M_PI);
}

// The swirl behind the wheel is that of the head; in the spiral it goes on as a free vortex (r times swirl stays) to
// the throat, whose middle is about as far out as the spiral's walls in the mean. The spiral's speed is the mean of
// both ends, as in a designed pump.
static CwWaterWay water_way(const CwOperatingPoint *point, const Sizes *of, const CwCadWheel *wheel,
                            double volute_radius) {
  const double r2 = wheel->radius, r3 = wheel->reach, u2 = point->speed * r2, width = wheel->width;
  const double flow = wheel->flow_share * point->flow_rate, head = wheel->head_share * point->head;
  const double meridional = flow / (2 * M_PI * r2 * width);
  const double swirl = fmin(CW_GRAVITY * head / (HYDRAULIC_EFFICIENCY * u2), 0.95 * u2);
  const double w2 = hypot(u2 - swirl, meridional), before = point->flow_rate / of->inlet_area;
  // Where the eyes of the wheel cannot be told the inlets stand for them.
  const double inlet = diameter(of->inlet_area / of->inlets),
               eye = wheel->eyes ? diameter(wheel->eye_area / wheel->eyes) : inlet,
               w1 = hypot(point->speed * eye / 2, wheel->eyes ? flow / wheel->eye_area : before);
  const double pitch = 2 * M_PI * r2 / wheel->blades * fmin(1, meridional / w2); // at the outlet, across w2
  const double outlet = diameter(of->outlet_area), after = point->flow_rate / of->outlet_area;
  const double around = fmax(swirl * r2 / r3, after);
  const double throat = fmax(swirl * r2 / fmax(r3, volute_radius), after);
  return (CwWaterWay){.radius = r3,
                      .blade_speed = (w1 + w2) / 2,
                      .passage = {width, pitch},
                      .blade_width = fmin(width, pitch),
                      .behind_blades = fmax(r3 - r2, 0),
                      .volute_speed = (around + throat) / 2,
                      .volute_width = width,
                      .neck_width = width,
                      .suction_speed = before,
                      .suction_diameter = inlet,
                      .suction_width = inlet,
                      .throat_speed = throat,
                      .throat_diameter = diameter(point->flow_rate / throat),
                      .discharge_speed = after,
                      .discharge_diameter = outlet};
}

static void set_wall(const CwCaseCad *cad, const CwFacePatches *patches, const CwFacePatch *of,
                     const CwWallFlow flow[CW_ALONG_COUNT], CwModelPatch *patch) {
  const CwWallName wall = wall_of(cad, patches, of);
  patch->group = wall.group;
  patch->size = wall.size;
  patch->flow = flow[wall.along];
  if (wall.turns >= 0) patch->turns = wall.turns;
  patch->monitored = wall.monitored;
  if (of->rule < 0) return;
  const CwCadPatch *rule = &cad->patch[of->rule];
  if (cw_case_given(rule->velocity)) patch->flow.speed = rule->velocity;
  if (rule->turns >= 0) patch->turns = rule->turns;
  patch->y_plus_asked = rule->y_plus;
  if (rule->monitored >= 0) patch->monitored = rule->monitored;
}

// Each wheel has walls, an interface with what stands still, another opening, and may have its share of the head.
static CwStatus check_wheels(const CwCaseCad *cad, const CwOperatingPoint *point, const CwFacePatches *patches,
                             int interface_count, const CwCadWheels *wheels) {
  CwStatus status = CW_OK;
  for (int w = 0; w < wheels->count; w++) {
    const CwCadWheel *wheel = &wheels->wheel[w];
    const CwCadDomain *domain = &cad->domain[wheel->part];
    int walls = 0;
    for (int i = 0; i < patches->count; i++)
      walls |= wheels->of_part[patches->patch[i].part] == w && cad->domain[patches->patch[i].part].rotating &&
               patches->patch[i].kind == CW_PATCH_WALL;
    CW_REQUIRE(walls, CW_ERR_GEOMETRY,
               "cad.domains.%s.%s: %s has no wall, all its faces touch other domains or are openings; allowed: the "
               "solid of the water in the wheel, between its blades (is it the metal?)",
               domain->name, domain->solids.count ? "solid" : "inside_mm",
               domain->solids.count ? domain->solids.text[0] : "its solid");
    CW_REQUIRE(
        wheel->reach > 0, CW_ERR_GEOMETRY,
        "cad.domains.%s: what rotates touches nothing that stands still; allowed: domains that share the surface "
        "between wheel and casing%s",
        domain->name, interface_count ? "" : " (there is no interface at all)");
    CW_REQUIRE(wheel->openings > 1, CW_ERR_GEOMETRY,
               "cad.domains.%s: the wheel has one opening alone, its interface, so that no water goes through it; "
               "allowed: an eye and an outlet, each an inlet or a surface that it shares with another domain within "
               "cad.tolerance_mm",
               domain->name);
    const double tip = point->speed * wheel->radius, most = tip * tip / (CW_GRAVITY * wheel->head_share);
    CW_REQUIRE(
        point->head < most, CW_ERR_INPUT,
        "operating_point.head_m: %.6g contradicts speed_rpm and the wheel, whose radius of %.4g mm gives the tip "
        "speed %.4g m/s; allowed: below %.4g m (u2^2/g%s); is the unit of cad.files right?",
        point->head, 1e3 * wheel->radius, tip, most, wheel->head_share < 1 ? ", of all stages" : "");
  }
done:
  return status;
}

static CwStatus check(const CwCaseCad *cad, const CwFacePatches *patches, const Sizes *sizes) {
  CwStatus status = CW_OK;
  int still = 0;
  for (int d = 0; d < cad->domain_count; d++) still += !cad->domain[d].rotating;
  CW_REQUIRE(still > 0, CW_ERR_INPUT,
             "cad.domains: all rotate, %s too; allowed: rotating: true in the wheel's alone, and a domain that stands "
             "still",
             cad->domain[cad->domain_count - 1].name);
  for (int d = 0; d < cad->domain_count; d++) {
    int open = 0;
    for (int i = 0; i < patches->count; i++)
      open |= patches->patch[i].part == d && patches->patch[i].kind != CW_PATCH_WALL;
    CW_REQUIRE(
        open, CW_ERR_GEOMETRY,
        "cad.domains.%s: touches no other domain and has neither inlet nor outlet; allowed: a solid of the water "
        "(is it the metal?) that shares faces with another domain",
        cad->domain[d].name);
  }
  CW_REQUIRE(
      sizes->inlet_area > 0, CW_ERR_INPUT,
      "cad.patches: no face is an inlet; allowed: one with kind: inlet, such as inlet: {near_mm: [x, y, z], kind: "
      "inlet}");
  CW_REQUIRE(sizes->outlet_area > 0, CW_ERR_INPUT,
             "cad.patches: no face is an outlet; allowed: one with kind: outlet, such as outlet: {near_mm: [x, y, z], "
             "kind: outlet}");
done:
  return status;
}

static double outlet_share(const CwSurvey *survey, const CwFacePatches *patches, int patch, double all) {
  double area = 0;
  for (int f = 0; f < survey->face_count; f++)
    if (patches->of_face[f] == patch) area += survey->face[f].area;
  return area / all;
}

CwStatus cw_cad_model_make(const CwCase *table, const CwSurvey *survey, const CwFacePatches *patches,
                           int interface_count, const CwCadInterface *interfaces, int blade_count, double unit,
                           CwModel *model) {
  CwStatus status = CW_OK;
  const CwCaseCad *cad = table->cad;
  Sizes sizes = {0};
  CwCadWheels wheels = {0};
  CwWallFlow(*flow)[CW_ALONG_COUNT] = NULL; // at each wheel
  CW_TRY(cw_cad_wheels_make(cad, survey, patches, interface_count, interfaces, blade_count, &wheels));
  CW_TRY(measure(cad, survey, patches, &wheels, &sizes));
  CW_TRY(check(cad, patches, &sizes));
  CW_REQUIRE(wheels.count > 0, CW_ERR_INPUT, "cad.domains: none rotates; allowed: rotating: true in the wheel's");
  CW_TRY(check_wheels(cad, &table->operating_point, patches, interface_count, &wheels));
  CW_NEW(flow, wheels.count);
  for (int w = 0; w < wheels.count; w++) {
    const CwWaterWay way = water_way(&table->operating_point, &sizes, &wheels.wheel[w], sizes.volute_radius[w]);
    cw_wall_flows(&way, flow[w]);
  }
  model->unit = unit;
  for (int d = 0; d < cad->domain_count; d++) {
    CW_TRY(cw_model_add_domain(model, cad->domain[d].name, cad->domain[d].rotating));
    for (int i = 0; i < patches->count; i++) {
      const CwFacePatch *of = &patches->patch[i];
      CwModelPatch *patch;
      if (of->part != d) continue;
      CW_TRY(cw_model_add_patch(model, of->name, of->kind, &patch));
      if (of->kind == CW_PATCH_WALL) set_wall(cad, patches, of, flow[wheels.of_part[d]], patch);
      if (of->kind == CW_PATCH_OUTLET) patch->flow_share = outlet_share(survey, patches, i, sizes.outlet_area);
    }
  }
  for (int i = 0; i < interface_count; i++) {
    const char *names[] = {patches->patch[interfaces[i].patch[0]].name, patches->patch[interfaces[i].patch[1]].name};
    CW_TRY(cw_model_add_interface(model, names, interfaces[i].surface, interfaces[i].radius));
    for (int s = 0; s < 2 && interfaces[i].flat; s++) // before a pipe
      model->patch[cw_model_patch_find(model, names[s])].size = CW_GROUP_PIPE;
  }
  const CwWallFlow *of = flow[wheels.largest];
  model->flow =
      (CwModelFlow){of[CW_ALONG_SUCTION].speed, of[CW_ALONG_SUCTION].diameter,           of[CW_ALONG_BLADE].speed,
                    of[CW_ALONG_BLADE].width,   2 * wheels.wheel[wheels.largest].radius, blade_count};
done:
  free(flow);
  free(sizes.volute_radius);
  cw_cad_wheels_free(&wheels);
  return status;
}
