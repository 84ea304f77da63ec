// SPDX-License-Identifier: AGPL-3.0-or-later
// cutwater-geometry: from the case file to the pump's solids. Writes RUN/geometry.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "geometry/cad/cad_stage.h"
#include "geometry/design_check.h"
#include "geometry/design_file.h"
#include "geometry/design_value.h"
#include "geometry/hydraulic_design.h"
#include "geometry/picture.h"
#include "geometry/pump.h"
#include "geometry/pump_files.h"
#include "geometry/pump_model.h"
#include "geometry/remedy.h"
#include "pipeline/case_read.h"
#include "pipeline/log.h"
#include "pipeline/record.h"
#include "pipeline/stage_args.h"
#include "pipeline/version.h"

static const CwStageUsage usage = {
    .stage = "geometry",
    .version = cw_version,
    .summary = "Designs the pump of the case file and writes its solids, with named faces, to RUN/geometry:\n"
               "a .brep file a domain, faces.csv, model.json, pump.step, design.json, record.json and pictures.\n",
};

static const double LEAST_CORNER = 15 * M_PI / 180; // of a face

static void show_design(CwLog *log, const CwDesign *design) {
  char line[200];
  cw_log(log, "%-52s %10d       %s", "blade number z", design->blade_count, design->blade_count_source);
  for (int i = 0; i < CW_DESIGN_COUNT; i++) {
    cw_hydraulic_design_row(design, i, line, sizeof line);
    cw_log(log, "%s", line);
  }
  CwDesignRemarks remarks;
  cw_design_check(design, &remarks);
  for (int i = 0; i < remarks.count; i++) cw_log_warn(log, "%s", remarks.text[i]);
}

static void show_solid(CwLog *log, const CwDesign *design, const CwSolid *solid, const CwMeasuredSolid *measured) {
  cw_log(log,
         "%s: %d faces, %.3f cm3, largest tolerance %.1e mm, valid and closed; shortest edge %.2f mm, narrowest "
         "face %.2f mm",
         cw_solid_domain(solid), measured->face_count, measured->volume * 1e6, measured->largest_tolerance * 1e3,
         measured->shortest_edge * 1e3, measured->narrowest_face * 1e3);
  cw_log(log,
         "%s: least angles: %.1f deg through the fluid (%s, %s), %.1f deg through the wall (%s, %s), %.1f deg in a "
         "corner of %s",
         cw_solid_domain(solid), measured->fluid_edge.angle / CW_DEGREE,
         cw_solid_face_name(solid, measured->fluid_edge_of[0]), cw_solid_face_name(solid, measured->fluid_edge_of[1]),
         measured->wall_edge.angle / CW_DEGREE, cw_solid_face_name(solid, measured->wall_edge_of[0]),
         cw_solid_face_name(solid, measured->wall_edge_of[1]), measured->corner.angle / CW_DEGREE,
         cw_solid_face_name(solid, measured->corner_of));
  if (measured->corner.angle < LEAST_CORNER)
    cw_log_warn(log,
                "%s: %s has a corner of %.1f deg at (%.2f, %.2f, %.2f) mm, and so have triangles there; 15 deg are "
                "usual: %s",
                cw_solid_domain(solid), cw_solid_face_name(solid, measured->corner_of),
                measured->corner.angle / CW_DEGREE, measured->corner.at[0] * 1e3, measured->corner.at[1] * 1e3,
                measured->corner.at[2] * 1e3, cw_pump_blunter_corner(design, cw_solid_domain(solid)));
}

// Creases sharper than this leave prism layers with more than the skewness that solvers accept.
static void show_rotor(CwLog *log, const CwDesign *design, const CwMeasuredRotor *rotor) {
  const int on_hub = rotor->hub_crease.angle < rotor->shroud_crease.angle;
  const CwMeasuredAngle *crease = on_hub ? &rotor->hub_crease : &rotor->shroud_crease, *edge = &rotor->trailing_edge;
  const double least = crease->angle / CW_DEGREE, wedge = 360 - edge->angle / CW_DEGREE;
  cw_log(log, "measured: wrap %.3f deg, D1 %.4f, D2 %.4f, b2 %.4f mm", rotor->wrap_angle / CW_DEGREE,
         rotor->inlet_diameter * 1e3, rotor->outlet_diameter * 1e3, rotor->outlet_width * 1e3);
  if (design->root_fillet_radius > 0)
    cw_log(log, "measured: root fillets of %.2f mm meet hub and shroud within %.2f deg of tangency",
           design->root_fillet_radius * 1e3, fabs(180 - least));
  else
    cw_log(log, "measured: blade to hub %.1f deg, blade to shroud %.1f deg at the least",
           rotor->hub_crease.angle / CW_DEGREE, rotor->shroud_crease.angle / CW_DEGREE);
  cw_log(log, "measured: sharpest wedge of the trailing edge %.1f deg", wedge);
  if (least < 66)
    cw_log_warn(
        log,
        "blades meet the %s at %.1f deg at (%.2f, %.2f, %.2f) mm; under 66 deg the prism layers there are skewed: "
        "%s",
        on_hub ? "hub" : "shroud", least, crease->at[0] * 1e3, crease->at[1] * 1e3, crease->at[2] * 1e3,
        design->blade_form == CW_BLADE_CYLINDRICAL ? "take blade_form twisted, or raise leading_edge_radius_shroud_mm"
        : design->lean_angle != 0
            ? "bring lean_deg nearer to 0, or raise leading_edge_radius_hub_mm and leading_edge_radius_shroud_mm"
            : "raise leading_edge_radius_hub_mm and leading_edge_radius_shroud_mm");
  if (wedge < 75)
    cw_log_warn(
        log,
        "the trailing edge has a wedge of %.1f deg at (%.2f, %.2f, %.2f) mm; under 75 deg the prism layers there "
        "are skewed: %s",
        wedge, edge->at[0] * 1e3, edge->at[1] * 1e3, edge->at[2] * 1e3, cw_pump_blunter_edge(design));
}

static void show_measured(CwLog *log, const CwDesign *design, const CwPump *pump, const CwMeasuredPump *measured) {
  const CwMeasuredRotor *rotor = &measured->rotor;
  const CwMeasuredStator *stator = &measured->stator;
  for (int i = 0; i < pump->count; i++) show_solid(log, design, pump->solid[i], &measured->solid[i]);
  cw_log(log, "measured: rotor's volume %+.4f %% off that of its sections, largest kink between smooth faces %.3f deg",
         100 * (measured->solid[CW_PUMP_ROTOR].volume / measured->rotor_volume_of_sections - 1),
         rotor->kink.angle / CW_DEGREE);
  show_rotor(log, design, rotor);
  cw_log(log, "measured: D3 %.4f, b3 %.4f, interface r %.4f mm, %.2f mm2 on both sides", stator->base_diameter * 1e3,
         stator->inlet_width * 1e3, rotor->interface_radius * 1e3, rotor->interface_area * 1e6);
}

static CwStatus build(CwLog *log, const CwCase *table, const CwDesign *design, const CwPipeStubs *stubs,
                      CwRecord *record, CwPump *pump, CwMeasuredPump *measured) {
  CwStatus status = CW_OK;
  double begin = cw_seconds();
  int64_t faces = 0;
  char key[40];
  CW_TRY(cw_pump_build(table, design, stubs, pump));
  for (int i = 0; i < pump->count; i++) faces += cw_solid_face_count(pump->solid[i]);
  CW_TRY(cw_record_step(record, "solids", cw_seconds() - begin, faces, "faces"));
  begin = cw_seconds();
  CW_TRY(cw_pump_measure(design, pump, measured));
  show_measured(log, design, pump, measured);
  CW_TRY(cw_record_step(record, "measure", cw_seconds() - begin, faces, "faces"));
  for (int i = CW_PUMP_STATOR + 1; i < pump->count; i++) {
    snprintf(key, sizeof key, "%s_volume_m3", cw_solid_domain(pump->solid[i]));
    CW_TRY(cw_record_number(record, key, measured->solid[i].volume));
  }
done:
  return status;
}

static const char *const design_files[] = {
    "design.json",     "meridional_section.svg", "blade_plan.svg", "velocity_triangles.svg",
    "blade_angle.svg", "volute_sections.svg",    "volute_plan.svg"};

typedef struct {
  const CwDesign *design;
  const CwMeasuredPump *measured;
} Designed;

static CwStatus write_design_file(const void *given, int k, const char *path) {
  const Designed *of = given;
  CwStatus (*const picture[])(const CwDesign *, const char *) = {cw_picture_meridional,         cw_picture_blade_plan,
                                                                 cw_picture_velocity_triangles, cw_picture_blade_angle,
                                                                 cw_picture_volute_sections,    cw_picture_volute_plan};
  return k == 0 ? cw_design_file_write(of->design, of->measured, path) : picture[k - 1](of->design, path);
}

// A run into a folder that held more zones must not leave their solids behind.
static CwStatus remove_old_solids(const CwStageArgs *args) {
  CwStatus status = CW_OK;
  static const char *const names[] = {"suction.brep", "discharge.brep"};
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    char *path = NULL;
    CW_TRY(cw_geometry_path(args, names[i], &path));
    remove(path);
    free(path);
  }
done:
  return status;
}

static CwStatus make_geometry(const CwStageArgs *args, const CwCase *table, CwRecord *record) {
  CwStatus status = CW_OK;
  CwDesign design;
  CwPipeStubs stubs;
  CwMeasuredPump measured = {0};
  CwPump pump = {0};
  CwModel model = {0};
  CW_TRY(cw_hydraulic_design(table, &design));
  CW_TRY(cw_pump_pipe_stubs(table, &design, &stubs));
  show_design(args->log, &design);
  CW_TRY(build(args->log, table, &design, &stubs, record, &pump, &measured));
  CW_TRY(cw_pump_model(&design, &pump, &model));
  CW_TRY(remove_old_solids(args));
  CW_TRY(cw_pump_files_write(args,
                             &(CwPumpFiles){.count = pump.count,
                                            .solid = pump.solid,
                                            .model = &model,
                                            .other_count = sizeof design_files / sizeof *design_files,
                                            .other = design_files,
                                            .write = write_design_file,
                                            .given = &(Designed){&design, &measured}},
                             record));
  CW_TRY(cw_record_case(record, table));
  CW_TRY(cw_record_json(record, "measured", cw_measured_json(&measured)));
  CW_TRY(cw_record_number(record, "predicted_head_m", design.predicted_head));
  CW_TRY(cw_record_number(record, "head_residual_m", design.head_residual));
  CW_TRY(cw_record_number(record, "specific_speed_ns", design.specific_speed_ns));
done:
  cw_model_free(&model);
  cw_pump_free(&pump);
  return status;
}

// The same without files or words, of a case that might replace a refused one.
static CwStatus try_geometry(const CwCase *table, CwDesign *design) {
  CwStatus status = CW_OK;
  CwPipeStubs stubs;
  CwMeasuredPump measured = {0};
  CwPump pump = {0};
  CW_TRY(cw_hydraulic_design(table, design));
  CW_TRY(cw_pump_pipe_stubs(table, design, &stubs));
  CW_TRY(cw_pump_build(table, design, &stubs, &pump));
  CW_TRY(cw_pump_measure(design, &pump, &measured));
done:
  cw_pump_free(&pump);
  return status;
}

// Adds what to change in the case to the line that refuses it.
static CwStatus add_remedy(CwLog *log, const CwCase *table, CwStatus status) {
  char refused[1000], remedy[400];
  snprintf(refused, sizeof refused, "%s", cw_fail_message());
  cw_log(log, "refused; trying changes of the case");
  if (cw_remedy_find(table, refused, try_geometry, remedy, sizeof remedy))
    return CW_FAIL(status, "%s; tried: %s", refused, remedy);
  return CW_FAIL(status, "%s", refused);
}

int main(int argc, char **argv) {
  CwStatus status = CW_OK;
  CwStageArgs args;
  CwCase table = {0};
  CwRecord *record = NULL;
  char *record_path = NULL;
  CW_TRY(cw_stage_begin(argc, argv, &usage, 1, &args, &table));
  if (args.finished) goto done;
  CW_TRY(cw_geometry_path(&args, "record.json", &record_path));
  CW_TRY(cw_record_start("geometry", args.log, &record));
  CW_TRY(table.cad ? cw_cad_stage(&args, &table, record) : make_geometry(&args, &table, record));
  CW_TRY(cw_record_write(record, record_path));
done:;
  if (table.cad && (status == CW_ERR_INPUT || status == CW_ERR_GEOMETRY)) {
    cw_fail_place(args.case_path);
  } else if (status == CW_ERR_DESIGN || status == CW_ERR_GEOMETRY) {
    add_remedy(args.log, &table, status);
    cw_fail_place(args.case_path); // what to change stands there
  }
  const int code = cw_log_error(args.log, status);
  free(record_path);
  cw_record_free(record);
  cw_case_free(&table);
  cw_log_close(&args.log);
  return code;
}
