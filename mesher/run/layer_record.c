// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/layer_record.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/common/model_unit.h"
#include "mesher/policy.h"
#include "mesher/run/layer_coverage.h"
#include "mesher/thickness/layer_count.h"
#include "pipeline/log.h"
#include "pipeline/mesh/cell.h"
#include "pipeline/record.h"

static const double MOST_SHARE = 0.05; // of the faces, may exceed CW_RATIO_FAIR
static const double LEAST_MET = 0.9;   // of the faces, have their first height
static const double REMEDY_MOST = 100; // times the first height that anyone would ask for
enum { WHERE_SIZE = 1500, TEXT_SIZE = 2500 };

static const char *const SOURCE_NAMES[] = {"asked", "auto", "fitted", "laminar"};

// A warning that is a headline too.
static void tell(CwLog *log, json_t *headlines, const char *format, ...) __attribute__((format(printf, 3, 4)));
static void tell(CwLog *log, json_t *headlines, const char *format, ...) {
  char text[TEXT_SIZE];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  cw_log_warn(log, "%s", text);
  json_array_append_new(headlines, json_string(text));
}

void cw_put_first_height(const CwPatchTarget *target, json_t *patch) {
  const CwFirstHeight *first = &target->first;
  json_object_set_new(patch, "first_height_from", json_string(SOURCE_NAMES[first->source]));
  json_object_set_new(patch, "first_height_asked_m", cw_json_number(first->asked));
  json_object_set_new(patch, "y_plus", cw_json_number(first->y_plus));
  json_object_set_new(patch, "passage_reynolds", cw_json_number(first->reynolds));
  json_object_set_new(patch, "passage_width_m", cw_json_number(target->flow.width));
}

void cw_put_layer_ratio(const CwLayerRatio *ratio, json_t *patch) {
  json_t *at = json_array();
  for (int k = 0; k < 3; k++) json_array_append_new(at, cw_json_number(ratio->greatest_at[k] * cw_model_unit()));
  json_object_set_new(patch, "volume_ratio_95_percent", cw_json_number(cw_layer_ratio_quantile(ratio, 0.95)));
  json_object_set_new(patch, "volume_ratio_greatest", cw_json_number(ratio->greatest));
  json_object_set_new(patch, "volume_ratio_greatest_at_m", at);
  json_object_set_new(patch, "thin_last_layer_faces", json_integer((json_int_t)ratio->thin_over_fair));
  json_object_set_new(patch, "thick_last_layer_faces", json_integer((json_int_t)ratio->thick_over_fair));
  json_object_set_new(patch, "volume_ratio_over_10_faces", json_integer((json_int_t)ratio->over_most));
  json_object_set_new(patch, "small_weight_faces", json_integer((json_int_t)ratio->small_weight));
}

// A list of patches in a message.
typedef struct {
  char text[WHERE_SIZE];
  size_t length;
} List;

static void add(List *list, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(List *list, const char *format, ...) {
  size_t left = sizeof list->text - list->length;
  va_list arguments;
  va_start(arguments, format);
  int added = vsnprintf(list->text + list->length, left, format, arguments);
  va_end(arguments);
  list->length += (size_t)added < left ? (size_t)added : left - 1;
}

// Whether an earlier wall patch of the same group has the same first height.
static int is_told(const CwDomain *domain, int patch) {
  for (int q = 0; q < patch; q++) {
    if (cw_cad_patch_kind(domain->cad, q) == CW_PATCH_WALL && domain->patch[q].group == domain->patch[patch].group &&
        domain->patch_target[q].first.height == domain->patch_target[patch].first.height)
      return 1;
  }
  return 0;
}

static void add_laminar(const CwPatchTarget *target, const char *patch, List *list) {
  const CwFirstHeight *first = &target->first;
  add(list, "%s%.40s %.0f (first height %.3g mm)", list->length ? ", " : "", patch, first->reynolds,
      1e3 * first->height);
}

// The key that asks for this first height, m, in brackets that are open.
static void add_key(const char *group, double height, double y_plus, List *list) {
  if (isnan(y_plus))
    add(list, "walls.first_height_%s_um: %.3g)", group, 1e6 * height);
  else
    add(list, "walls.y_plus_%s: %.3g)", group, y_plus);
}

static void add_fitted(const CwPatchTarget *target, const char *patch, const char *group, List *list) {
  const CwFirstHeight *first = &target->first;
  add(list, "%s%.40s %.3g mm instead of %.3g mm ", list->length ? ", " : "", patch, 1e3 * first->height,
      1e3 * first->asked);
  if (first->total > 0)
    add(list, "in walls.total_thickness_mm %.3g (", 1e3 * first->total);
  else
    add(list, "in a passage %.3g mm wide (", 1e3 * target->flow.width);
  add_key(group, first->height, first->y_plus, list);
}

// Two digits, rounded up.
static double round_up(double value) {
  double tenth = pow(10, floor(log10(value)) - 1);
  return ceil(value / tenth) * tenth;
}

void cw_warn_of_left_out(CwLog *log, const CwDomain *domain, double edge, double cells, json_t *headlines) {
  List names = {{0}, 0};
  int faces = 0, named = -1;
  double widest = 0;
  for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
    for (int f = 0; f < cw_cad_face_count(domain->cad); f++) {
      if (cw_cad_face_patch(domain->cad, f) != p || !cw_cad_face_is_left_out(domain->cad, f)) continue;
      widest = fmax(widest, cw_cad_face_left_out_width(domain->cad, f));
      faces++;
      if (named != p) add(&names, "%s%.40s", names.length ? ", " : "", cw_cad_patch_name(domain->cad, p));
      named = p;
    }
  }
  tell(
      log, headlines,
      "%s: %d narrow faces of %s are left out, up to %.2g mm wide: edges there are %.2g mm long; mesh.cells %.0f shows "
      "them",
      domain->name, faces, names.text, cw_mm(widest), cw_mm(edge), round_up(cells));
}

void cw_put_left_out(const CwDomain *domain, json_t *result) {
  int faces = 0;
  double widest = 0;
  for (int f = 0; f < cw_cad_face_count(domain->cad); f++) {
    faces += cw_cad_face_is_left_out(domain->cad, f);
    widest = fmax(widest, cw_cad_face_left_out_width(domain->cad, f));
  }
  json_object_set_new(result, "left_out",
                      json_pack("{s:i, s:o}", "faces", faces, "widest_m", cw_json_number(widest * cw_model_unit())));
}

void cw_warn_of_few_layers(CwLog *log, const CwDomain *domain, int needed, double cells, json_t *headlines) {
  tell(log, headlines,
       "%s: %d of the %d layers that lead from the first height to the size of the tetrahedra: with more the edges on "
       "narrow faces would be too long; mesh.cells %.0f has room for all",
       domain->name, domain->layer_count, needed, round_up(cells));
}

void cw_warn_of_long_edges(CwLog *log, const CwCase *table, int made, double scale, double cells, json_t *headlines) {
  char layers[64] = "";
  int given = table->walls.layer_count;
  if (given > made)
    snprintf(layers, sizeof layers, " for walls.layer_count %d (%d are made)", given, made);
  else if (given > 0)
    snprintf(layers, sizeof layers, " for walls.layer_count %d", given);
  tell(log, headlines,
       "mesh.cells %lld%s leaves edges %.2g times as long as the shape of the walls asks, between which tetrahedra are "
       "flat and columns short; mesh.cells %.0f has room%s",
       (long long)table->mesh.cells, layers, scale, round_up(cells),
       given > 0 ? " for it, and walls.layer_count auto takes as many as there is room for" : "");
}

// Where faces of a patch are too round for its first height, that of the roundest.
static void add_rounded(const CwDomain *domain, int patch, List *list) {
  const CwFirstHeight *first = &domain->patch_target[patch].first;
  const char *group = cw_patch_group_name(domain->patch[patch].group);
  double height = INFINITY;
  for (int f = 0; f < cw_cad_face_count(domain->cad); f++)
    if (cw_cad_face_patch(domain->cad, f) == patch && cw_cad_face_is_wall(domain->cad, f))
      height = fmin(height, cw_domain_first_height(domain, f) * cw_model_unit());
  if (height >= (1 - CW_FIRST_HEIGHT_TOLERANCE) * first->height) return;
  add(list, "%s%.40s %.3g mm instead of %.3g mm (", list->length ? ", " : "", cw_cad_patch_name(domain->cad, patch),
      1e3 * height, 1e3 * first->height);
  add_key(group, height, first->y_plus * height / first->height, list);
}

void cw_warn_of_first_heights(CwLog *log, const CwDomain *domain, json_t *headlines) {
  List laminar = {{0}, 0}, fitted = {{0}, 0}, rounded = {{0}, 0};
  for (int p = 0; p < cw_cad_patch_count(domain->cad); p++) {
    const CwPatchTarget *target = &domain->patch_target[p];
    const char *name = cw_cad_patch_name(domain->cad, p);
    if (cw_cad_patch_kind(domain->cad, p) != CW_PATCH_WALL) continue;
    add_rounded(domain, p, &rounded);
    if (is_told(domain, p)) continue;
    if (target->first.source == CW_FIRST_LAMINAR) add_laminar(target, name, &laminar);
    if (target->first.source == CW_FIRST_FITTED)
      add_fitted(target, name, cw_patch_group_name(domain->patch[p].group), &fitted);
  }
  if (laminar.length)
    tell(log, headlines,
         "%s: the flow is laminar where the Reynolds number of the passage is below %.0f (that of pipe flow, "
         "Schlichting "
         "and Gersten): %s. y+ means nothing there; the first height is %g of the passage's width, or as "
         "walls.first_height_blade_um and its like give it",
         domain->name, CW_LAMINAR_REYNOLDS, laminar.text, CW_LAMINAR_SHARE);
  if (fitted.length)
    tell(log, headlines,
         "%s: first heights of which %d layers do not fit both walls, or walls.total_thickness_mm, become the greatest "
         "that do, or less beside edges of the walls: %s%s",
         domain->name, domain->layer_count, fitted.text,
         domain->layer_count > CW_LAYERS_LEAST ? "; fewer walls.layer_count have room for greater ones" : "");
  if (rounded.length)
    tell(log, headlines,
         "%s: round faces have no room for their first heights: on noses those become the radius, in fillets so small "
         "that all layers end at %g of the radius, and grow from there: %s",
         domain->name, cw_policy.free_share, rounded.text);
}

void cw_warn_of_pinched(CwLog *log, const CwDomain *domain, json_t *headlines) {
  const CwPinched *pinched = &domain->pinched;
  const int known = pinched->edges + pinched->corners > 0; // by the solid alone
  char remedy[160] = "round the solid there";
  if (known && pinched->open >= 0)
    snprintf(remedy, sizeof remedy, "let '%.80s' cross the walls there, not go on from one",
             cw_cad_patch_name(domain->cad, cw_cad_face_patch(domain->cad, pinched->open)));
  if (known)
    tell(log, headlines,
         "%s: layers taper to nothing at edges (%d) and corners (%d) about which no direction sees all faces and lies "
         "in "
         "the open ones, first at (%.6g, %.6g, %.6g) mm; %s, where its y+ matters",
         domain->name, pinched->edges, pinched->corners, CW_MM(pinched->at), remedy);
  if (pinched->place_count > 0)
    tell(log, headlines,
         "%s: layers taper to nothing at places (%d) where they fold or cross however short edges are, first at (%.6g, "
         "%.6g, %.6g) mm; a solid that is blunter there has room for them",
         domain->name, pinched->place_count, CW_MM(pinched->place[0].x));
}

void cw_put_sharp_edge(const CwDomain *domain, json_t *result) {
  json_object_set_new(result, "sharp_edge_deg",
                      cw_domain_is_sharp(domain) ? cw_json_number(domain->sharp.angle) : json_null());
}

void cw_tell_of_sharp_edge(CwLog *log, const CwDomain *domain) {
  const CwSharpEdge *edge = &domain->sharp;
  if (!cw_domain_is_sharp(domain)) return;
  cw_log(
      log,
      "%s: walls meet at %.3g degrees (%.40s and %.40s at (%.3f, %.3f, %.3f) mm): over an edge that sharp the layers "
      "are thinner than asked, the first one too; a blunter edge has room for them",
      domain->name, edge->angle, cw_cad_patch_name(domain->cad, cw_cad_face_patch(domain->cad, edge->face[0])),
      cw_cad_patch_name(domain->cad, cw_cad_face_patch(domain->cad, edge->face[1])), CW_MM(edge->at));
}

// What the warning of a domain adds up.
typedef struct {
  double faces, over;    // of the domain; over CW_RATIO_FAIR
  double thin, thick;    // those over it of patches with too many
  double missing_layers; // most that such a patch lacks
  List where;
} Jumps;

static double number(const json_t *patch, const char *key) {
  return json_number_value(json_object_get(patch, key));
}

static void add_patch(const json_t *patch, Jumps *jumps) {
  double faces = number(patch, "wall_faces"), thin = number(patch, "thin_last_layer_faces");
  double thick = number(patch, "thick_last_layer_faces"), most = number(patch, "volume_ratio_95_percent");
  double weights = number(patch, "small_weight_faces");
  int uneven = thin + thick > MOST_SHARE * faces;
  jumps->faces += faces;
  jumps->over += thin + thick;
  if (!uneven && number(patch, "volume_ratio_over_10_faces") == 0 && weights == 0) return;
  jumps->thin += uneven ? thin : 0;
  jumps->thick += uneven ? thick : 0;
  // Each layer more brings the last one nearer by the growth ratio.
  double growth = fmax(number(patch, "growth_ratio_most"), 1.1);
  if (uneven && thin > thick)
    jumps->missing_layers = fmax(jumps->missing_layers, ceil(log(most / CW_RATIO_FAIR) / log(growth)));
  add(&jumps->where, "%s%.40s %.3g, greatest %.3g", jumps->where.length ? "; " : "",
      json_string_value(json_object_get(patch, "patch")), most, number(patch, "volume_ratio_greatest"));
  if (weights > 0) add(&jumps->where, ", %.0f face weights below %.2g", weights, CW_SMALL_WEIGHT);
}

void cw_warn_of_thin(CwLog *log, const char *domain, const json_t *coverage) {
  List where = {{0}, 0};
  double sum = 0, wanted = 0, at[3] = {0};
  size_t k;
  json_t *patch;
  char remedy[96] = "fewer layers, or far more cells";
  json_array_foreach((json_t *)coverage, k, patch) {
    double thin = number(patch, "thin_prisms"), own = number(patch, "thin_prisms_height_wanted");
    if (thin == 0) continue;
    add(&where, "%s%.40s %.0f", where.length ? ", " : "", json_string_value(json_object_get(patch, "patch")), thin);
    sum += thin;
    if (own <= wanted) continue;
    wanted = own;
    const json_t *place = json_object_get(patch, "thinnest_prism_at_m");
    for (size_t c = 0; c < 3; c++) at[c] = json_number_value(json_array_get(place, c));
  }
  if (sum == 0) return;
  if (wanted < REMEDY_MOST)
    snprintf(remedy, sizeof remedy, "%.1f times the first height, or with edges as much shorter",
             0.1 * ceil(10 * wanted));
  cw_log_warn(log,
              "%s: %.0f prisms are so long for their height that checkMesh calls their determinant small (%s; the "
              "thinnest at (%.3f, %.3f, %.3f) mm). They are sound; it would name none with %s",
              domain, sum, where.text, 1e3 * at[0], 1e3 * at[1], 1e3 * at[2], remedy);
}

static double missed_by(const json_t *patch, int reason) {
  char key[CW_LAYER_KEY_SIZE];
  return number(patch, cw_layer_reason_key("first_height_missed", reason, key));
}

// Why most faces of a patch miss their first height.
static const char *main_reason(const json_t *patch) {
  int most = CW_LAYER_GAP;
  for (int i = CW_LAYER_FULL + 1; i < CW_LAYER_REASONS; i++) {
    if (missed_by(patch, i) > missed_by(patch, most)) most = i;
  }
  return cw_layer_reason_name(most);
}

void cw_warn_of_missed(CwLog *log, const char *domain, const json_t *coverage, json_t *headlines) {
  List where = {{0}, 0};
  double all = 0, all_met = 0;
  size_t k;
  json_t *patch;
  json_array_foreach((json_t *)coverage, k, patch) {
    double faces = number(patch, "wall_faces"), met = number(patch, "first_height_met_faces");
    all += faces;
    all_met += met;
    if (met >= LEAST_MET * faces) continue;
    add(&where, "%s%.40s %.0f %% (%s)", where.length ? ", " : "", json_string_value(json_object_get(patch, "patch")),
        100 * met / faces, main_reason(patch));
  }
  if (all_met >= LEAST_MET * all) return;
  tell(log, headlines,
       "%s: only %.0f %% of the wall faces have their first height: %s; a lower y+ or walls.layer_count leaves room",
       domain, 100 * all_met / all, where.text);
}

void cw_warn_of_layers(CwLog *log, const char *domain, int layers, int automatic, const json_t *coverage,
                       json_t *headlines) {
  Jumps jumps = {0};
  size_t k;
  json_t *patch;
  char remedy[160];
  json_array_foreach((json_t *)coverage, k, patch) add_patch(patch, &jumps);
  if (jumps.where.length == 0) return;
  if (jumps.thin > jumps.thick)
    snprintf(remedy, sizeof remedy, "last layers are thin: %swalls.layer_count %.0f instead of %d%s",
             automatic ? "more mesh.cells, or " : "", fmin(layers + jumps.missing_layers, CW_LAYERS_MOST), layers,
             automatic ? "" : ", or auto");
  else if (jumps.thick > 0)
    snprintf(remedy, sizeof remedy, "last layers are thick: a lower walls.y_plus of these walls%s",
             automatic ? "" : ", or walls.layer_count auto");
  else
    snprintf(remedy, sizeof remedy, "few faces: more mesh.cells leave the columns room there");
  char text[TEXT_SIZE];
  snprintf(
      text, sizeof text,
      "%s: volumes change by more than %.0f on more than %.0f %% of the layer top, or by more than %.0f; 95 %% are "
      "within: %s; %s",
      domain, CW_RATIO_FAIR, 100 * MOST_SHARE, CW_RATIO_MOST, jumps.where.text, remedy);
  if (jumps.over > MOST_SHARE * jumps.faces)
    tell(log, headlines, "%s", text);
  else
    cw_log_warn(log, "%s", text);
}
