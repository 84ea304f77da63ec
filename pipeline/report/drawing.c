// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/report/surface.h"
#include "pipeline/vec.h"

static const uint32_t ink = 0x27313c, bare_colour = 0xd5dade;
const uint32_t cw_pyramid_colour = 0xb98fc0;
enum { PATCHES = CW_PATCHES_MOST };

// What a domain is in a picture: the first that does not rotate is the stator, others are pipes.
static unsigned part_of(const CwMesh *mesh, int d) {
  if (mesh->domains[d].rotating) return CW_SEES_ROTOR;
  for (int before = 0; before < d; before++)
    if (!mesh->domains[before].rotating) return CW_SEES_PIPES;
  return CW_SEES_STATOR;
}

static void mark_parts(const CwMesh *mesh, CwDrawing *drawing) {
  for (int d = 0; d < mesh->domain_count; d++) drawing->part[d] = part_of(mesh, d);
  if (!drawing->spec->hidden) return;
  for (int p = 0; p < mesh->patch_count; p++) {
    const CwModelPatch *patch = &mesh->patches[p];
    const int index = p - mesh->domains[patch->domain].first_patch;
    drawing->hidden[patch->domain][index] = cw_picture_hides(drawing->spec, patch->name);
    drawing->colour[patch->domain][index] = cw_patch_colour(patch->name, index);
  }
}

void cw_drawing_start(const CwPictureSpec *spec, const CwMesh *mesh, const CwSurvey *survey, CwDrawing *drawing) {
  drawing->spec = spec;
  drawing->suction = survey->sizes.suction;
  mark_parts(mesh, drawing);
  cw_drawing_aim(drawing, survey);
}

// From directions along radius, rotation and axis at `middle` to x, y, z; on the axis the same.
static void turn_with(const double middle[3], const double local[3], double x[3]) {
  double radius = hypot(middle[0], middle[1]);
  double c = radius > 0 ? middle[0] / radius : 1, s = radius > 0 ? middle[1] / radius : 0;
  x[0] = c * local[0] - s * local[1];
  x[1] = s * local[0] + c * local[1];
  x[2] = local[2];
}

void cw_drawing_aim(CwDrawing *drawing, const CwSurvey *survey) {
  const CwPictureSpec *spec = drawing->spec;
  CwCamera *camera = &drawing->camera;
  const double suction = drawing->suction;
  double towards[3] = {0, 0, suction}, up[3] = {1, 0, 0}, middle[3] = {0, 0, 0};
  double azimuth = cw_survey_meridional_azimuth(survey), z = 0;
  double radius = 0.5 * (survey->sizes.interface_radius + survey->sizes.base_radius);
  if (spec->plane == CW_PLANE_MERIDIONAL) { // the radius to the right
    memcpy(towards, (double[3]){suction * sin(azimuth), -suction * cos(azimuth), 0}, sizeof towards);
    memcpy(up, (double[3]){0, 0, suction}, sizeof up);
  }
  switch (spec->target) {
  case CW_TARGET_ALL:
    break;
  case CW_TARGET_PLACE:
    if (!cw_survey_place(survey, spec->place, middle)) drawing->lacking = "the mesh has no such patch";
    break;
  case CW_TARGET_SHROUD:
    radius = 0.43 * survey->sizes.outlet_radius;
    if (!cw_survey_wall(survey, CW_WALL_SHROUD, radius, &z)) drawing->lacking = "the mesh has no shroud";
    // fall through
  case CW_TARGET_NECK:
    memcpy(middle, (double[3]){radius * cos(azimuth), radius * sin(azimuth), z}, sizeof middle);
    break;
  }
  if (isfinite(cw_plane_span(spec->plane)) && !cw_survey_has_span(survey))
    drawing->lacking = "the mesh has no hub, or no shroud";
  if (spec->plane == CW_PLANE_NONE) {
    turn_with(middle, (double[3]){spec->towards[0], spec->towards[1], -suction * spec->towards[2]}, towards);
    turn_with(middle, (double[3]){spec->up[0], spec->up[1], -suction * spec->up[2]}, up);
  }
  cw_camera_turn(camera, towards, up);
  memcpy(camera->centre, middle, sizeof middle);
  camera->width = spec->width;
  camera->height = spec->height;
  camera->metres_per_pixel = spec->span * 2 * survey->sizes.outlet_radius / spec->width;
  memcpy(drawing->plane.u, camera->right, sizeof camera->right);
  memcpy(drawing->plane.v, camera->up, sizeof camera->up);
  memcpy(drawing->plane.normal, camera->towards, sizeof camera->towards);
  if (spec->target == CW_TARGET_ALL && spec->plane == CW_PLANE_MERIDIONAL) {
    double z_least, z_most;
    if (!cw_survey_meridional_reach(survey, azimuth, &radius, &z_least, &z_most)) {
      drawing->lacking = "the mesh has no boundary near the plane";
      return;
    }
    for (int corner = 0; corner < 4; corner++) {
      const double r = corner % 2 ? radius : -radius, z_corner = corner / 2 ? z_most : z_least;
      cw_camera_reach(camera, (double[3]){r * cos(azimuth), r * sin(azimuth), z_corner}, &drawing->reach);
    }
  }
}

static int face_shown(const CwDrawing *drawing, int d, const CwSurfaceFace *face) {
  if (drawing->hidden[d][face->patch]) return 0;
  if (!drawing->spec->drive_half || drawing->part[d] == CW_SEES_ROTOR) return 1;
  for (int k = 0; k < face->count; k++)
    if (drawing->suction * face->x[k][2] < 0) return 1;
  return 0;
}

// Cuts off what lies on the side of the suction from z = 0: the corners that are left, in order; at most one more than
// before.
static int drive_part(const CwSurfaceFace *face, int suction, double part[5][3]) {
  int count = 0;
  for (int k = 0; k < face->count; k++) {
    const double *a = face->x[k], *b = face->x[(k + 1) % face->count];
    const int kept = suction * a[2] <= 0;
    if (kept) memcpy(part[count++], a, sizeof part[0]);
    if (kept == (suction * b[2] <= 0) || count == 5) continue;
    for (int i = 0; i < 3; i++) part[count][i] = a[i] + a[2] / (a[2] - b[2]) * (b[i] - a[i]);
    count++;
  }
  return count;
}

void cw_drawing_reach(CwDrawing *drawing, const CwRegionData *surface) {
  int d = surface->domain;
  if (!(drawing->spec->sees & drawing->part[d])) return;
  if (drawing->spec->target != CW_TARGET_ALL || drawing->spec->plane == CW_PLANE_MERIDIONAL) return;
  for (int32_t f = 0; f < cw_surface_face_count(surface); f++) {
    CwSurfaceFace face = cw_surface_face(surface, f);
    if (!face_shown(drawing, d, &face)) continue;
    for (int k = 0; k < face.count; k++) cw_camera_reach(&drawing->camera, face.x[k], &drawing->reach);
  }
}

// Flat shading by a light over the viewer's left shoulder; a face has no back.
// *outside becomes true where the viewer stands on the outer side of the face.
static double light_of(const CwCamera *camera, const CwSurfaceFace *face, int *outside) {
  static const double light[3] = {-0.37, 0.46, 0.81}; // right, up, towards
  const double *const axes[] = {camera->right, camera->up, camera->towards};
  double u[3], v[3], n[3], facing[3] = {0, 0, 0};
  cw_sub(face->x[face->count - 2], face->x[0], u);
  cw_sub(face->x[face->count - 1], face->x[face->count - 3], v);
  cw_cross(u, v, n);
  double length = cw_norm(n);
  *outside = 0;
  if (!(length > 0)) return 1;
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++) facing[k] += n[i] * axes[k][i] / length;
  *outside = facing[2] > 0;
  double sign = facing[2] < 0 ? -1 : 1, cosine = 0;
  for (int i = 0; i < 3; i++) cosine += sign * facing[i] * light[i];
  return 0.5 + 0.56 * fmax(cosine, 0);
}

// share: of pressure and y+ by face, for pictures of the flow.
static uint32_t face_colour(const CwDrawing *drawing, int domain, int region, const CwSurfaceFace *face, double share) {
  if (drawing->spec->colour == CW_COLOUR_REGION) return cw_region_colour(region);
  if (!cw_picture_is_of_flow(drawing->spec)) return drawing->colour[domain][face->patch];
  return isfinite(share) ? cw_colour_scale(share) : bare_colour;
}

// The polygon of a face on the canvas; `pixel`: where the points of the surface lie there. Returns its corners.
static int face_polygon(const CwDrawing *drawing, int d, const CwSurfaceFace *face, const double (*pixel)[3],
                        double p[5][3]) {
  double part[5][3];
  if (!drawing->spec->drive_half || drawing->part[d] != CW_SEES_STATOR) {
    for (int k = 0; k < face->count; k++) memcpy(p[k], pixel[face->corner[k]], sizeof p[k]);
    return face->count;
  }
  const int corners = drive_part(face, drawing->suction, part);
  for (int k = 0; k < corners; k++) cw_camera_project(&drawing->camera, part[k], p[k]);
  return corners;
}

CwStatus cw_drawing_add_faces(CwDrawing *drawing, int region, const CwRegionData *surface, double *const share[2]) {
  CwStatus status = CW_OK;
  const CwPictureSpec *spec = drawing->spec;
  double(*pixel)[3] = NULL, p[5][3];
  int d = surface->domain, outside;
  CW_NEW_UNSET(pixel, surface->point_count);
  for (int32_t k = 0; k < surface->point_count; k++) cw_camera_project(&drawing->camera, surface->points[k], pixel[k]);
  for (int32_t f = 0; f < cw_surface_face_count(surface); f++) {
    CwSurfaceFace face = cw_surface_face(surface, f);
    if (!face_shown(drawing, d, &face)) continue;
    const int corners = face_polygon(drawing, d, &face, (const double(*)[3])pixel, p);
    if (!cw_render_meets(&drawing->canvas, (const double(*)[3])p, corners)) continue;
    double light = light_of(&drawing->camera, &face, &outside);
    const double *own = cw_picture_is_of_flow(spec) ? share[spec->colour - CW_COLOUR_PRESSURE] : NULL;
    uint32_t colour = face_colour(drawing, d, region, &face, own ? own[f] : NAN);
    int group = 1 + (spec->colour == CW_COLOUR_REGION ? region % 60000 : d * PATCHES + face.patch);
    if (spec->hollow_white && outside && drawing->part[d] == CW_SEES_ROTOR) group = CW_DRAWING_METAL;
    CwPaint paint = {.colour = cw_render_shade(colour, light),
                     .group = (uint16_t)group,
                     .edge_colour = ink,
                     .edge_width = spec->edges ? 0.9 : 0,
                     .edge_strength = spec->edges ? 0.75 : 0};
    cw_render_polygon(&drawing->canvas, (const double(*)[3])p, corners, &paint);
  }
done:
  free(pixel);
  return status;
}

CwStatus cw_drawing_cut(const CwDrawing *drawing, const CwSurvey *survey, const CwRegionData *cells, CwRegionCut *cut) {
  CwStatus status = CW_OK;
  double *distance = NULL;
  const double share = cw_plane_span(drawing->spec->plane);
  CW_NEW_UNSET(distance, cells->point_count);
  for (int32_t i = 0; i < cells->point_count; i++)
    distance[i] = isfinite(share) ? cw_survey_span(survey, share, cells->points[i])
                                  : cw_cut_distance(&drawing->plane, cells->points[i]);
  CW_TRY(cw_cut_region(&drawing->plane, cells, distance, cut));
done:
  free(distance);
  return status;
}

static void draw_cell(CwDrawing *drawing, const CwCutCell *cell, uint32_t colour, int group, const double velocity[3]) {
  const CwCamera *camera = &drawing->camera;
  double p[CW_CUT_CORNERS][3], centre[2] = {cw_dot(camera->centre, camera->right), cw_dot(camera->centre, camera->up)};
  double area = 0;
  for (int k = 0; k < cell->corners; k++)
    cw_camera_place(camera, cell->polygon[k][0] - centre[0], cell->polygon[k][1] - centre[1], 0, p[k]);
  if (!cw_render_meets(&drawing->canvas, (const double(*)[3])p, cell->corners)) return;
  for (int k = 0; k < cell->corners; k++) {
    int next = (k + 1) % cell->corners;
    area += 0.5 * (p[next][0] * p[k][1] - p[k][0] * p[next][1]);
  }
  // Lines of cells of a few pixels are drawn paler, or they would be all that one sees.
  double size = sqrt(fmax(area, 0));
  double strength = fmin(fmax(0.12 + 0.09 * (size - 1), 0.12), 0.8);
  CwPaint paint = {.colour = colour,
                   .group = (uint16_t)group,
                   .edge_colour = ink,
                   .edge_width = size > 12 ? 0.9 : 0.6,
                   .edge_strength = cw_picture_is_of_flow(drawing->spec) ? 0 : strength,
                   .velocity = {(float)cw_dot(velocity, camera->right), -(float)cw_dot(velocity, camera->up)}};
  cw_render_polygon(&drawing->canvas, (const double(*)[3])p, cell->corners, &paint);
}

void cw_drawing_add_cells(CwDrawing *drawing, const CwMesh *mesh, int region, const CwFlow *flow,
                          const CwRegionData *cells, const CwRegionCut *cut) {
  const int solved = cw_picture_is_of_flow(drawing->spec);
  const uint32_t kind[] = {cw_domain_colour(cells->domain, 2), cw_pyramid_colour, cw_domain_colour(cells->domain, 1)};
  for (int64_t k = 0; k < cut->count; k++) {
    const int32_t cell = cut->cells[k].cell, pyramid = cell - cells->tetrahedron_count;
    uint32_t colour = kind[(pyramid >= 0) + (pyramid >= cells->pyramid_count)];
    double velocity[3] = {0, 0, 0};
    if (solved) {
      cw_flow_cell_velocity(flow, mesh, region, cells, cell, velocity);
      colour = cw_colour_scale(cw_flow_speed_share(flow, velocity));
    }
    draw_cell(drawing, &cut->cells[k], colour, cells->domain + 1, velocity);
  }
}

void cw_drawing_mark_seen(CwDrawing *drawing) {
  size_t samples = (size_t)drawing->canvas.columns * (size_t)drawing->canvas.rows;
  for (size_t i = 0; i < samples; i++) {
    int group = drawing->canvas.group[i] - 1;
    if (group >= 0 && group < CW_DOMAINS_MOST * PATCHES) drawing->seen[group / PATCHES][group % PATCHES] = 1;
  }
}
