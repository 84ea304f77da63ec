// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/cad_model.h"

#include <math.h>
#include <stdlib.h>

#include "geometry/wall_flow.h"
#include "pipeline/vec.h"

static const double HYDRAULIC_EFFICIENCY = 0.85; // Guelich, table 3.9, for medium pumps
static const double SAME_AREA = 0.02;            // of the greater: sides of an interface, as triangulated and cut
static const double REACHES = 0.99;              // of the wheel's radius: a blade that ends at its outlet
static const double LOOKS = 0.01;                // sine of the angle by which a side of a blade leaves the meridian
static const double TURN = 2.399963229728653;    // rad, the golden angle: no number of passages comes to itself by it
enum { TURNS = 3 };

typedef struct {
  double inlet_area, outlet_area, wheel_radius, interface_radius, interface_width;
  double eye_area; // of all eyes
  int inlets, eyes;
  double volute_radius; // mean of the spiral's walls
} Sizes;

// Whether the points of a face still lie on faces when they are turned about the axis.
static CwStatus stays_when_turned(const CwSurvey *survey, int face, double tolerance, int *stays) {
  CwStatus status = CW_OK;
  const CwSurveyFace *of = &survey->face[face];
  *stays = 1;
  for (int i = of->first_sample; i < of->first_sample + of->sample_count && *stays; i++)
    for (int k = 1; k <= TURNS && *stays; k++) {
      const double *x = survey->sample[i].at, c = cos(k * TURN), s = sin(k * TURN);
      const double turned[3] = {c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
      double distance;
      int nearest;
      CW_TRY(cw_survey_nearest(survey, -1, turned, 2 * tolerance, &nearest, &distance, NULL));
      *stays = nearest >= 0 && distance <= tolerance;
    }
done:
  return status;
}

// Exact surfaces are told by their normals, splines only by their points.
static CwStatus check_turned(const CwCaseCad *cad, const CwSurvey *survey, int face, const CwContact *contact,
                             double tolerance) {
  CwStatus status = CW_OK;
  const CwSurveyFace *of = &survey->face[face];
  const CwCadDomain *own = &cad->domain[of->part], *other = &cad->domain[contact[face].part];
  int stays;
  if (of->turned || own->rotating == other->rotating) goto done;
  CW_TRY(stays_when_turned(survey, face, tolerance, &stays));
  CW_REQUIRE(
      stays, CW_ERR_GEOMETRY,
      "cad.axis: the interface between %s and %s is no surface of revolution about the axis (face %d of %s, at "
      "radius %.4g to %.4g mm) within cad.tolerance_mm, %.3g; allowed: cylinders, cones, planes across it and the "
      "like; does the axis run through the wheel?",
      own->name, other->name, face + 1, own->name, 1e3 * of->radius[0], 1e3 * of->radius[1], 1e3 * tolerance);
done:
  return status;
}

static int lies_in_plane(const CwSurvey *survey, const CwSurveyFace *face, const CwSurveyFace *plane,
                         double tolerance) {
  for (int t = face->first_triangle; t < face->first_triangle + face->triangle_count; t++)
    for (int k = 0; k < 3; k++) {
      double way[3];
      cw_sub(survey->point[survey->triangle[t][k]], plane->at, way);
      if (fabs(cw_dot(plane->normal, way)) > 2 * tolerance) return 0;
    }
  return 1;
}

// What both sides of an interface lie on. Flat eyes of a wheel that has two are no plane.
static void set_surface(const CwSurvey *survey, const CwFacePatches *patches, double tolerance,
                        CwCadInterface *between) {
  double radius[2] = {INFINITY, 0};
  int plane = 1;
  const CwSurveyFace *first = NULL;
  between->flat = 1;
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    for (int s = 0; s < 2; s++) {
      if (patches->of_face[f] != between->patch[s]) continue;
      if (!first) first = face;
      between->area[s] += face->area;
      between->flat &= face->form == CW_FORM_PLANE;
      plane &= between->flat && lies_in_plane(survey, face, first, tolerance);
      radius[0] = fmin(radius[0], face->form == CW_FORM_REVOLVED ? face->radius[0] : 0);
      radius[1] = fmax(radius[1], face->radius[1]);
    }
  }
  const int cylinder = radius[1] - radius[0] < 1e-4 * radius[1];
  between->surface = plane ? CW_SURFACE_PLANE : cylinder ? CW_SURFACE_CYLINDER : CW_SURFACE_OTHER;
  between->radius = cylinder ? radius[1] : 0;
}

// The other side of the interface, where one is that patch; else -1.
static int beyond(const CwCadInterface *between, int patch) {
  return between->patch[0] == patch ? between->patch[1] : between->patch[1] == patch ? between->patch[0] : -1;
}

CwStatus cw_cad_interfaces_make(const CwCaseCad *cad, const CwSurvey *survey, const CwContact *contact,
                                const CwFacePatches *patches, double tolerance, int *count,
                                CwCadInterface **interfaces) {
  CwStatus status = CW_OK;
  CwCadInterface *made = NULL;
  *count = 0;
  CW_NEW(made, patches->count);
  for (int f = 0; f < survey->face_count; f++) {
    if (contact[f].part < 0) continue;
    const int own = patches->of_face[f], other = patches->of_face[contact[f].other];
    CW_TRY(check_turned(cad, survey, f, contact, tolerance));
    int i = 0;
    while (i < *count && beyond(&made[i], own) < 0 && beyond(&made[i], other) < 0) i++;
    if (i == *count) made[(*count)++] = (CwCadInterface){.patch = {own, other}};
    const int shared = beyond(&made[i], own) < 0 ? other : own, third = shared == own ? other : own;
    CW_REQUIRE(beyond(&made[i], shared) == third, CW_ERR_INPUT,
               "cad.patches: patch %s touches both %s and %s; allowed: one patch on either side of an interface, give "
               "them names in cad.patches with domain",
               patches->patch[shared].name, patches->patch[third].name, patches->patch[beyond(&made[i], shared)].name);
  }
  for (int i = 0; i < *count; i++) {
    set_surface(survey, patches, tolerance, &made[i]);
    const double *area = made[i].area;
    CW_REQUIRE(
        fabs(area[0] - area[1]) <= SAME_AREA * fmax(area[0], area[1]), CW_ERR_GEOMETRY,
        "cad.domains: the interface has %.6g mm2 as %s and %.6g mm2 as %s; allowed: the same surface on both sides",
        1e6 * area[0], patches->patch[made[i].patch[0]].name, 1e6 * area[1], patches->patch[made[i].patch[1]].name);
  }
  *interfaces = made;
  made = NULL;
done:
  free(made);
  return status;
}

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

// Whether the water in a part has not yet been through the wheel: it has an inlet and no outlet.
static int is_before(const CwFacePatches *patches, int part) {
  int before = 0;
  for (int i = 0; i < patches->count; i++) {
    if (patches->patch[i].part != part) continue;
    if (patches->patch[i].kind == CW_PATCH_INLET) before = 1;
    if (patches->patch[i].kind == CW_PATCH_OUTLET) return 0;
  }
  return before;
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
  if (!own || (of_wheel && !rotating)) wall.along = along_of(wall.group, rotating, is_before(patches, of->part));
  return wall;
}

static void measure(const CwCaseCad *cad, const CwSurvey *survey, const CwFacePatches *patches, int interface_count,
                    const CwCadInterface *interfaces, Sizes *sizes) {
  *sizes = (Sizes){0};
  double blade_radius = 0, widest = 0, volute_area = 0, volute_moment = 0;
  for (int f = 0; f < survey->face_count; f++) {
    const CwSurveyFace *face = &survey->face[f];
    const CwFacePatch *patch = &patches->patch[patches->of_face[f]];
    const int rotating = cad->domain[face->part].rotating;
    if (patch->kind == CW_PATCH_INLET) sizes->inlet_area += face->area;
    if (patch->kind == CW_PATCH_OUTLET) sizes->outlet_area += face->area;
    if (rotating) widest = fmax(widest, face->radius[1]);
    if (rotating && patch->role == CW_ROLE_BLADE) blade_radius = fmax(blade_radius, face->radius[1]);
    const CwWallName wall = wall_of(cad, patches, patch);
    if (patch->kind == CW_PATCH_WALL && wall.along == CW_ALONG_VOLUTE && wall.group == CW_GROUP_VOLUTE) {
      volute_area += face->area;
      volute_moment += face->area * face->mean_radius;
    }
  }
  sizes->wheel_radius = blade_radius > 0 ? blade_radius : widest;
  sizes->volute_radius = volute_area > 0 ? volute_moment / volute_area : 0;
  // The wheel's outlet: of the interfaces between what rotates and what does not the one farthest out.
  for (int i = 0; i < interface_count; i++) {
    const CwCadInterface *between = &interfaces[i];
    const int a = patches->patch[between->patch[0]].part, b = patches->patch[between->patch[1]].part;
    if (cad->domain[a].rotating == cad->domain[b].rotating) continue;
    double radius = 0;
    for (int f = 0; f < survey->face_count; f++)
      if (patches->of_face[f] == between->patch[0]) radius = fmax(radius, survey->face[f].radius[1]);
    if (radius <= sizes->interface_radius) continue;
    sizes->interface_radius = radius;
    sizes->interface_width = between->area[0] / (2 * M_PI * radius);
  }
}

// Joins faces by the edges between them. [in,out] first: of each face its number, then the least of its set; -1: it
// takes no part. Returns how many sets there are.
static int join(const CwSurvey *survey, int *first) {
  int sets = 0;
  for (int changed = 1; changed;) {
    changed = 0;
    for (int e = 0; e < survey->edge_count; e++) {
      int *a = &first[survey->edge[e].face[0]], *b = &first[survey->edge[e].face[1]];
      if (*a < 0 || *b < 0 || *a == *b) continue;
      *a = *b = *a < *b ? *a : *b;
      changed = 1;
    }
  }
  for (int f = 0; f < survey->face_count; f++) sets += first[f] == f;
  return sets;
}

// Whether water enters what rotates through a patch: from outside, or from what comes before the wheel.
static int is_eye(const CwCaseCad *cad, const CwFacePatches *patches, int interface_count,
                  const CwCadInterface *interfaces, int patch) {
  if (!cad->domain[patches->patch[patch].part].rotating) return 0;
  if (patches->patch[patch].kind == CW_PATCH_INLET) return 1;
  for (int i = 0; i < interface_count; i++) {
    const int other = beyond(&interfaces[i], patch), part = other < 0 ? -1 : patches->patch[other].part;
    if (part >= 0 && !cad->domain[part].rotating && is_before(patches, part)) return 1;
  }
  return 0;
}

// Inlets, and the wheel's eyes; where these cannot be told the inlets stand for them.
static CwStatus measure_eyes(const CwCaseCad *cad, const CwSurvey *survey, const CwFacePatches *patches,
                             int interface_count, const CwCadInterface *interfaces, Sizes *sizes) {
  CwStatus status = CW_OK;
  int *first = NULL;
  CW_NEW(first, survey->face_count);
  for (int f = 0; f < survey->face_count; f++)
    first[f] = patches->patch[patches->of_face[f]].kind == CW_PATCH_INLET ? f : -1;
  sizes->inlets = join(survey, first);
  for (int f = 0; f < survey->face_count; f++) {
    first[f] = is_eye(cad, patches, interface_count, interfaces, patches->of_face[f]) ? f : -1;
    if (first[f] >= 0) sizes->eye_area += survey->face[f].area;
  }
  sizes->eyes = join(survey, first);
  if (!sizes->eyes) sizes->eyes = sizes->inlets, sizes->eye_area = sizes->inlet_area;
done:
  free(first);
  return status;
}

// A blade: its faces that hang together.
typedef struct {
  double radius, height[2], area;
  int sides; // 1: it has faces that look the way the wheel turns, 2: others that look back
} Blade;

static void add_to_blade(const CwSurveyFace *face, Blade *blade) {
  const int begun = blade->area > 0;
  blade->area += face->area;
  blade->radius = fmax(blade->radius, face->radius[1]);
  blade->height[0] = begun ? fmin(blade->height[0], face->height[0]) : face->height[0];
  blade->height[1] = begun ? fmax(blade->height[1], face->height[1]) : face->height[1];
  if (fabs(face->twist) > LOOKS) blade->sides |= face->twist > 0 ? 1 : 2;
}

// Blades side by side at the wheel's outlet, splitters among them: a multiple of the passages. Not counted are those of
// a wheel's other half, whose middle lies beside the largest blade, and single sides, which no edge joins.
static CwStatus count_at_outlet(const CwCaseCad *cad, const CwSurvey *survey, const CwFacePatches *patches,
                                double radius, int passages, int *count) {
  CwStatus status = CW_OK;
  int *first = NULL, most = -1;
  Blade *blade = NULL;
  CW_NEW(first, survey->face_count);
  CW_NEW(blade, survey->face_count);
  for (int f = 0; f < survey->face_count; f++) {
    const int is_blade = patches->patch[patches->of_face[f]].role == CW_ROLE_BLADE;
    first[f] = is_blade && cad->domain[survey->face[f].part].rotating ? f : -1;
  }
  join(survey, first);
  for (int f = 0; f < survey->face_count; f++)
    if (first[f] >= 0) add_to_blade(&survey->face[f], &blade[first[f]]);
  *count = 0;
  for (int f = 0; f < survey->face_count; f++) {
    if (blade[f].sides != 3 || blade[f].radius < REACHES * radius) blade[f].area = 0;
    if (blade[f].area > (most < 0 ? 0 : blade[most].area)) most = f;
  }
  for (int f = 0; f < survey->face_count; f++) {
    const double middle = (blade[f].height[0] + blade[f].height[1]) / 2;
    *count += blade[f].area > 0 && middle > blade[most].height[0] && middle < blade[most].height[1];
  }
  if (*count == 0 || *count % passages) *count = passages;
done:
  free(first);
  free(blade);
  return status;
}

static double diameter(double area) {
  return sqrt(4 * area / M_PI);
}

// The swirl behind the wheel is that of the head; in the spiral it goes on as a free vortex (r times swirl stays) to
// the throat, whose middle is about as far out as the spiral's walls in the mean. The spiral's speed is the mean of
// both ends, as in a designed pump.
static CwWaterWay water_way(const CwOperatingPoint *point, const Sizes *of, int blades) {
  const double r2 = of->wheel_radius, r3 = of->interface_radius, u2 = point->speed * r2, width = of->interface_width;
  const double meridional = point->flow_rate / (2 * M_PI * r2 * width);
  const double swirl = fmin(CW_GRAVITY * point->head / (HYDRAULIC_EFFICIENCY * u2), 0.95 * u2);
  const double w2 = hypot(u2 - swirl, meridional), before = point->flow_rate / of->inlet_area;
  const double inlet = diameter(of->inlet_area / of->inlets), eye = diameter(of->eye_area / of->eyes);
  const double w1 = hypot(point->speed * eye / 2, point->flow_rate / of->eye_area);
  const double pitch = 2 * M_PI * r2 / blades * fmin(1, meridional / w2); // at the outlet, across w2
  const double outlet = diameter(of->outlet_area), after = point->flow_rate / of->outlet_area;
  const double around = fmax(swirl * r2 / r3, after);
  const double throat = fmax(swirl * r2 / fmax(r3, of->volute_radius), after);
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

static CwStatus check(const CwCaseCad *cad, const CwOperatingPoint *point, const CwFacePatches *patches,
                      int interface_count, const Sizes *sizes) {
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
  CW_REQUIRE(sizes->interface_radius > 0, CW_ERR_GEOMETRY,
             "cad.domains: what rotates touches nothing that stands still; allowed: domains that share the surface "
             "between wheel and casing%s",
             interface_count ? "" : " (there is no interface at all)");
  const double tip = point->speed * sizes->wheel_radius;
  CW_REQUIRE(
      point->head < tip * tip / CW_GRAVITY, CW_ERR_INPUT,
      "operating_point.head_m: %.6g contradicts speed_rpm and the wheel, whose radius of %.4g mm gives the tip speed "
      "%.4g m/s; allowed: below %.4g m (u2^2/g); is the unit of cad.files right?",
      point->head, 1e3 * sizes->wheel_radius, tip, tip * tip / CW_GRAVITY);
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
  Sizes sizes;
  measure(cad, survey, patches, interface_count, interfaces, &sizes);
  CW_TRY(measure_eyes(cad, survey, patches, interface_count, interfaces, &sizes));
  CW_TRY(check(cad, &table->operating_point, patches, interface_count, &sizes));
  CwWallFlow flow[CW_ALONG_COUNT];
  int blades = blade_count; // with splitters
  CW_TRY(count_at_outlet(cad, survey, patches, sizes.wheel_radius, blade_count, &blades));
  const CwWaterWay way = water_way(&table->operating_point, &sizes, blades);
  cw_wall_flows(&way, flow);
  model->unit = unit;
  for (int d = 0; d < cad->domain_count; d++) {
    CW_TRY(cw_model_add_domain(model, cad->domain[d].name, cad->domain[d].rotating));
    for (int i = 0; i < patches->count; i++) {
      const CwFacePatch *of = &patches->patch[i];
      CwModelPatch *patch;
      if (of->part != d) continue;
      CW_TRY(cw_model_add_patch(model, of->name, of->kind, &patch));
      if (of->kind == CW_PATCH_WALL) set_wall(cad, patches, of, flow, patch);
      if (of->kind == CW_PATCH_OUTLET) patch->flow_share = outlet_share(survey, patches, i, sizes.outlet_area);
    }
  }
  for (int i = 0; i < interface_count; i++) {
    const char *names[] = {patches->patch[interfaces[i].patch[0]].name, patches->patch[interfaces[i].patch[1]].name};
    CW_TRY(cw_model_add_interface(model, names, interfaces[i].surface, interfaces[i].radius));
    for (int s = 0; s < 2 && interfaces[i].flat; s++) // before a pipe
      model->patch[cw_model_patch_find(model, names[s])].size = CW_GROUP_PIPE;
  }
  model->flow = (CwModelFlow){flow[CW_ALONG_SUCTION].speed, flow[CW_ALONG_SUCTION].diameter, flow[CW_ALONG_BLADE].speed,
                              flow[CW_ALONG_BLADE].width,   2 * sizes.wheel_radius,          blade_count};
done:
  return status;
}
