// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/layer_record.h"

#include <math.h>
#include <stdio.h>

#include "pipeline/log.h"
#include "pipeline/record.h"

static const double MOST_SHARE = 0.05; // of the faces, may exceed CW_RATIO_FAIR
enum { WHERE_SIZE = 1500 };

void cw_put_layer_ratio(const CwLayerRatio *ratio, json_t *patch) {
  json_t *at = json_pack("[o, o, o]", cw_json_number(ratio->greatest_at[0]), cw_json_number(ratio->greatest_at[1]),
                         cw_json_number(ratio->greatest_at[2]));
  json_object_set_new(patch, "volume_ratio_95_percent", cw_json_number(cw_layer_ratio_quantile(ratio, 0.95)));
  json_object_set_new(patch, "volume_ratio_greatest", cw_json_number(ratio->greatest));
  json_object_set_new(patch, "volume_ratio_greatest_at_m", at);
  json_object_set_new(patch, "thin_last_layer_faces", json_integer((json_int_t)ratio->thin_over_fair));
  json_object_set_new(patch, "thick_last_layer_faces", json_integer((json_int_t)ratio->thick_over_fair));
  json_object_set_new(patch, "volume_ratio_over_10_faces", json_integer((json_int_t)ratio->over_most));
  json_object_set_new(patch, "small_weight_faces", json_integer((json_int_t)ratio->small_weight));
}

// What the warning of a domain adds up.
typedef struct {
  double thin, thick;    // faces over CW_RATIO_FAIR
  double missing_layers; // most that a patch lacks
  char where[WHERE_SIZE];
  size_t length;
} Jumps;

static double number(const json_t *patch, const char *key) {
  return json_number_value(json_object_get(patch, key));
}

static void add_patch(const json_t *patch, Jumps *jumps) {
  double faces = number(patch, "wall_faces"), thin = number(patch, "thin_last_layer_faces");
  double thick = number(patch, "thick_last_layer_faces"), most = number(patch, "volume_ratio_95_percent");
  double weights = number(patch, "small_weight_faces");
  int uneven = thin + thick > MOST_SHARE * faces;
  if (!uneven && number(patch, "volume_ratio_over_10_faces") == 0 && weights == 0) return;
  jumps->thin += thin;
  jumps->thick += thick;
  // Each layer more brings the last one nearer by the growth ratio.
  double growth = fmax(number(patch, "growth_ratio_most"), 1.1);
  if (uneven && thin > thick)
    jumps->missing_layers = fmax(jumps->missing_layers, ceil(log(most / CW_RATIO_FAIR) / log(growth)));
  size_t left = sizeof jumps->where - jumps->length;
  int added =
      snprintf(jumps->where + jumps->length, left, "%s%.40s %.3g, greatest %.3g", jumps->length ? "; " : "",
               json_string_value(json_object_get(patch, "patch")), most, number(patch, "volume_ratio_greatest"));
  jumps->length += (size_t)added < left ? (size_t)added : left - 1;
  if (weights == 0) return;
  left = sizeof jumps->where - jumps->length;
  added = snprintf(jumps->where + jumps->length, left, ", %.0f face weights below %.2g", weights, CW_SMALL_WEIGHT);
  jumps->length += (size_t)added < left ? (size_t)added : left - 1;
}

void cw_warn_of_layers(const char *domain, int layers, const json_t *coverage) {
  Jumps jumps = {0};
  size_t k;
  json_t *patch;
  char remedy[160];
  json_array_foreach((json_t *)coverage, k, patch) add_patch(patch, &jumps);
  if (jumps.length == 0) return;
  if (jumps.missing_layers > 0)
    snprintf(remedy, sizeof remedy, "last layers are thin: walls.layer_count %.0f instead of %d, or auto",
             fmin(layers + jumps.missing_layers, 40), layers);
  else if (jumps.thick > jumps.thin)
    snprintf(remedy, sizeof remedy, "last layers are thick: walls.growth_ratio or walls.layer_count auto, or less");
  else
    snprintf(remedy, sizeof remedy, "columns are thinned in narrow places: mesh.cells_across_gap greater than it is");
  cw_log_warn("%s: volumes change by more than %.0f on more than %.0f %% of the layer top, or by more than %.0f; 95 %% "
              "are within: %s; %s",
              domain, CW_RATIO_FAIR, 100 * MOST_SHARE, CW_RATIO_MOST, jumps.where, remedy);
}
