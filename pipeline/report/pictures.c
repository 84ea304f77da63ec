// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pipeline/log.h"
#include "pipeline/report/drawing.h"
#include "pipeline/report/surface.h"

static const uint32_t background = 0xffffff, ink = 0x27313c;
enum { FIT_MARGIN = 28 };
static const double STREAMLINES = 14; // px apart
static const double NUMBER_ROOM = 7;  // px from the middle of a region's number to the region's edge

// What all ranks draw together: each its regions, which are neighbours in the order of the manifest.
typedef struct {
  const CwRanks *ranks;
  const CwMesh *mesh;
  const CwFlow *flow;
  int first, last; // regions from `first` to `last` - 1
  CwSurvey *survey;
  CwDrawing *drawing; // one for each of the list
} Board;

// Each picture is finished by one rank, beginning with the last: the first finishes the view too.
static int finisher(const Board *board, int picture) {
  return board->ranks->size - 1 - picture % board->ranks->size;
}

// Whether a picture shows what this pump or run does not have: the page leaves it out.
static int is_absent(const Board *board, const CwPictureSpec *spec) {
  return (spec->needs_pipes && board->mesh->domain_count <= 2) ||
         (cw_picture_is_of_flow(spec) && !board->flow->present);
}

// The work on a face in units of that on a cell, which is read, and looked at for the planes: in survey and view, and
// in each picture that shows the faces of its domain. Ratios of times measured at 100 million cells. Ranks share the
// regions by them; the page does not depend on them.
static const double SURVEY_OF_FACE = 24, PICTURE_OF_FACE = 5;

static double work_on(const Board *board, const CwMeshRegion *region) {
  double of_face = SURVEY_OF_FACE;
  for (int k = 0; k < cw_picture_list_count; k++) {
    const CwPictureSpec *spec = &cw_picture_list[k];
    if (spec->plane == CW_PLANE_NONE && spec->sees & board->drawing[k].part[region->domain] && !is_absent(board, spec))
      of_face += PICTURE_OF_FACE;
  }
  return (double)cw_mesh_region_cells(region) + of_face * (double)(region->triangles + region->quads);
}

// Shares the regions by the work on them.
static void take_regions(Board *board) {
  const CwMesh *mesh = board->mesh;
  double all = 0, before = 0;
  for (int r = 0; r < mesh->region_count; r++) all += work_on(board, &mesh->regions[r]);
  board->first = board->last = 0;
  for (int r = 0; r < mesh->region_count; r++) {
    const double work = work_on(board, &mesh->regions[r]);
    const int owner = (int)(board->ranks->size * fmin((before + 0.5 * work) / fmax(all, 1), 1 - 1e-9));
    board->first += owner < board->ranks->rank;
    board->last += owner <= board->ranks->rank;
    before += work;
  }
}

static void add_legend(CwReportPicture *picture, const char *label, uint32_t colour) {
  for (int k = 0; k < picture->legend_count; k++) {
    if (!strcmp(picture->legend[k].label, label)) return;
  }
  if (picture->legend_count == sizeof picture->legend / sizeof *picture->legend)
    return; // domains have more patches together
  CwLegendItem *item = &picture->legend[picture->legend_count++];
  snprintf(item->label, sizeof item->label, "%s", label);
  for (char *c = item->label; *c; c++) {
    if (*c == '_') *c = ' ';
  }
  item->colour = colour;
}

static void make_legend(const CwMesh *mesh, const CwDrawing *drawing, CwReportPicture *picture) {
  static const char *const kind[] = {"prisms", "tetrahedra"};
  int pyramids = 0;
  const CwPictureSpec *spec = drawing->spec;
  if (spec->colour == CW_COLOUR_REGION || spec->inset_name || cw_picture_is_of_flow(spec)) return;
  if (spec->colour == CW_COLOUR_CUT) {
    for (int d = 0; d < mesh->domain_count; d++) {
      if (!(spec->sees & drawing->part[d])) continue;
      for (int k = 1; k >= 0; k--) {
        char label[40];
        snprintf(label, sizeof label, "%.20s %s", mesh->domains[d].name, kind[k]);
        add_legend(picture, label, cw_domain_colour(d, k + 1));
      }
    }
    for (int r = 0; r < mesh->region_count; r++) pyramids |= mesh->regions[r].pyramids > 0;
    if (pyramids) add_legend(picture, "pyramids", cw_pyramid_colour);
    return;
  }
  for (int d = 0; d < mesh->domain_count; d++) {
    for (int p = 0; p < mesh->domains[d].patch_count; p++) {
      const char *name = mesh->patches[mesh->domains[d].first_patch + p].name;
      if (drawing->seen[d][p]) add_legend(picture, name, cw_patch_colour(name, p));
    }
  }
}

static void annotate(const CwDrawing *drawings, int index, CwAnnotation *annotation) {
  static const char *const names[] = {"x", "y", "z"};
  const CwDrawing *drawing = &drawings[index];
  const CwCamera *camera = &drawing->camera;
  annotation->metres_per_pixel = camera->metres_per_pixel;
  annotation->streamlines_apart = drawing->spec->colour == CW_COLOUR_SPEED ? STREAMLINES : 0;
  annotation->axis_count = 3;
  for (int i = 0; i < 3; i++) annotation->axis[i] = (CwTriadAxis){names[i], {camera->right[i], -camera->up[i]}};
  if (drawing->spec->plane == CW_PLANE_MERIDIONAL) {
    annotation->axis_count = 2;
    annotation->axis[0] = (CwTriadAxis){"r", {1, 0}};
    annotation->axis[1] = (CwTriadAxis){"z", {0, -camera->up[2]}};
  }
  for (int k = 0; k < cw_picture_list_count; k++) {
    const CwCamera *inset = &drawings[k].camera;
    double at[3], share = inset->metres_per_pixel / camera->metres_per_pixel;
    if (!drawings[k].spec->inset_name || drawings[k].spec->inset_of != index || drawings[k].lacking) continue;
    cw_camera_project(camera, inset->centre, at);
    double width = inset->width * share, height = inset->height * share;
    annotation->frame[annotation->frame_count++] =
        (CwInsetFrame){drawings[k].spec->inset_name, at[0] - 0.5 * width, at[1] - 0.5 * height, width, height};
  }
}

// The number of each region where there is room for it.
static CwStatus number_regions(const CwMesh *mesh, const CwCanvas *canvas, CwAnnotation *annotation) {
  CwStatus status = CW_OK;
  CwGroupMiddle *middle = NULL;
  CW_NEW(middle, mesh->region_count);
  CW_NEW(annotation->label, mesh->region_count);
  CW_TRY(cw_render_middles(canvas, mesh->region_count, middle));
  for (int r = 0; r < mesh->region_count; r++) {
    if (middle[r].depth < NUMBER_ROOM) continue;
    CwLabel *label = &annotation->label[annotation->label_count++];
    *label = (CwLabel){.x = middle[r].x, .y = middle[r].y};
    snprintf(label->text, sizeof label->text, "%d", mesh->regions[r].region);
  }
done:
  free(middle);
  return status;
}

static CwStatus finish(const Board *board, int index, CwPng *png) {
  CwStatus status = CW_OK;
  CwDrawing *drawing = &board->drawing[index];
  CwAnnotation annotation = {0};
  cw_render_erase(&drawing->canvas, CW_DRAWING_METAL);
  if (drawing->spec->plane == CW_PLANE_NONE && !drawing->spec->edges)
    cw_render_occlusion(&drawing->canvas, 14, drawing->camera.metres_per_pixel);
  cw_render_outline(&drawing->canvas, ink, 3 * drawing->camera.metres_per_pixel);
  cw_drawing_mark_seen(drawing);
  annotate(board->drawing, index, &annotation);
  if (drawing->spec->colour == CW_COLOUR_REGION) CW_TRY(number_regions(board->mesh, &drawing->canvas, &annotation));
  CW_TRY(cw_render_png(&drawing->canvas, &annotation, png));
done:
  free(annotation.label);
  cw_render_free(&drawing->canvas);
  return status;
}

// The reach of each drawing over all ranks. Collective.
static void join_reaches(const Board *board) {
  for (int k = 0; k < cw_picture_list_count; k++) {
    CwCameraReach *reach = &board->drawing[k].reach;
    double most[4]; // least ones negative
    for (int i = 0; i < 2; i++) {
      most[i] = reach->started ? -reach->least[i] : -INFINITY;
      most[2 + i] = reach->started ? reach->most[i] : -INFINITY;
    }
    cw_ranks_reduce(board->ranks, most, 4, MPI_DOUBLE, MPI_MAX);
    *reach = (CwCameraReach){isfinite(most[0]), {-most[0], -most[1]}, {most[2], most[3]}};
  }
}

// The first look at this rank's regions; counts their faces by patch.
static CwStatus survey_own(Board *board, int64_t *faces) {
  CwStatus status = CW_OK;
  CwRegionData cells = {0}, surface = {0};
  for (int r = board->first; r < board->last; r++) {
    CW_TRY(cw_mesh_region_read(board->mesh, r, CW_REGION_SURFACE, &cells));
    int64_t *of = faces + board->mesh->domains[cells.domain].first_patch;
    for (int32_t t = 0; t < cells.triangle_count; t++) of[cells.triangle_patch[t]]++;
    for (int32_t q = 0; q < cells.quad_count; q++) of[cells.quad_patch[q]]++;
    CW_TRY(cw_surface_of(&cells, &surface));
    CW_TRY(cw_survey_add(board->survey, board->mesh, &surface));
    for (int k = 0; k < cw_picture_list_count; k++)
      if (!is_absent(board, &cw_picture_list[k])) cw_drawing_reach(&board->drawing[k], &surface);
    cw_mesh_region_free(&surface);
    cw_mesh_region_free(&cells);
  }
done:
  cw_mesh_region_free(&surface);
  cw_mesh_region_free(&cells);
  return status;
}

// The survey of all regions on all ranks, and where the faces of this rank begin in the fields of the flow. Collective.
static CwStatus survey_all(Board *board, CwFlow *flow) {
  CwStatus status = CW_OK;
  int64_t *faces = calloc((size_t)board->mesh->patch_count + 1, sizeof *faces);
  status = faces ? survey_own(board, faces) : CW_FAIL(CW_ERR_MEMORY, "out of memory: faces of patches");
  CW_TRY(cw_ranks_agree(board->ranks, status));
  cw_survey_join(board->survey, board->ranks);
  join_reaches(board);
  cw_ranks_before(board->ranks, faces, board->mesh->patch_count);
  if (flow->present) cw_flow_skip(flow, board->mesh, faces);
done:
  free(faces);
  return status;
}

static CwStatus start_canvas(const CwPictureSpec *spec, CwCanvas *canvas) {
  CwStatus status = CW_OK;
  CW_TRY(cw_render_start(spec->width, spec->height, background, spec->plane == CW_PLANE_NONE, canvas));
  if (spec->colour == CW_COLOUR_SPEED) CW_TRY(cw_render_keep_velocity(canvas));
done:
  return status;
}

// Puts all views to their places and begins the canvases.
static CwStatus begin_canvases(const Board *board) {
  CwStatus status = CW_OK;
  for (int k = 0; k < cw_picture_list_count; k++) {
    CwDrawing *drawing = &board->drawing[k];
    const CwPictureSpec *spec = drawing->spec;
    drawing->lacking = is_absent(board, spec) ? "the pump has no such zones, or the run no solved fields" : NULL;
    if (drawing->lacking) continue;
    cw_drawing_aim(drawing, board->survey);
    if (spec->target == CW_TARGET_ALL && !drawing->lacking) {
      if (drawing->reach.started)
        cw_camera_fit(&drawing->camera, &drawing->reach, FIT_MARGIN);
      else
        drawing->lacking = "the mesh has no such faces";
    }
    if (!drawing->lacking) CW_TRY(start_canvas(spec, &drawing->canvas));
  }
done:
  return status;
}

// The cells that a plane cuts are found once, for all pictures of the plane.
static CwStatus draw_region(const Board *board, int region, const CwRegionData *cells, const CwRegionData *surface,
                            double *const share[2]) {
  CwStatus status = CW_OK;
  CwRegionCut cut[CW_PLANE_COUNT] = {{0}};
  int is_cut[CW_PLANE_COUNT] = {0};
  for (int k = 0; k < cw_picture_list_count; k++) {
    CwDrawing *drawing = &board->drawing[k];
    const CwPicturePlane plane = drawing->spec->plane;
    if (drawing->lacking || !(drawing->spec->sees & drawing->part[cells->domain])) continue;
    if (plane == CW_PLANE_NONE) {
      CW_TRY(cw_drawing_add_faces(drawing, region, surface, share));
      continue;
    }
    if (!is_cut[plane]) CW_TRY(cw_drawing_cut(drawing, board->survey, cells, &cut[plane]));
    is_cut[plane] = 1;
    cw_drawing_add_cells(drawing, board->mesh, region, board->flow, cells, &cut[plane]);
  }
done:
  for (int plane = 0; plane < CW_PLANE_COUNT; plane++) cw_region_cut_free(&cut[plane]);
  return status;
}

static CwStatus draw_own(const Board *board, CwFlow *flow, CwView *view) {
  CwStatus status = CW_OK;
  double *share[2] = {NULL, NULL};
  CwRegionData cells = {0}, surface = {0};
  for (int r = board->first; r < board->last; r++) {
    if (r + 1 < board->last) cw_mesh_region_ahead(board->mesh, r + 1);
    CW_TRY(cw_mesh_region_read(board->mesh, r, CW_REGION_WHOLE, &cells));
    if (flow->present) CW_TRY(cw_flow_faces(flow, board->mesh, r, &cells, share));
    CW_TRY(cw_surface_of(&cells, &surface));
    CW_TRY(cw_view_add(view, board->mesh, &surface, share));
    CW_TRY(draw_region(board, r, &cells, &surface, share));
    cw_mesh_region_free(&surface);
    cw_mesh_region_free(&cells);
    for (int q = 0; q < 2; q++) {
      free(share[q]);
      share[q] = NULL;
    }
    cw_progress(board->ranks->log,
                (int64_t)(r + 1 - board->first) * board->mesh->region_count / (board->last - board->first));
  }
done:
  cw_mesh_region_free(&surface);
  cw_mesh_region_free(&cells);
  for (int q = 0; q < 2; q++) free(share[q]);
  return status;
}

// The rows of a canvas from one rank to another, which has one of the same size for them. Called on both.
static void pass_canvas(const CwRanks *ranks, CwCanvas *canvas, int from, int to) {
  int rows[2] = {canvas->top, canvas->bottom};
  cw_ranks_pass(ranks, rows, 2, sizeof *rows, from, to);
  canvas->top = rows[0];
  canvas->bottom = rows[1];
  if (rows[0] >= rows[1]) return;
  const size_t first = (size_t)rows[0] * (size_t)canvas->columns;
  const int64_t samples = (int64_t)(rows[1] - rows[0]) * canvas->columns;
  cw_ranks_pass(ranks, canvas->group + first, samples, sizeof *canvas->group, from, to);
  cw_ranks_pass(ranks, canvas->colour + first, samples, sizeof *canvas->colour, from, to);
  if (canvas->depth) cw_ranks_pass(ranks, canvas->depth + first, samples, sizeof *canvas->depth, from, to);
  if (!canvas->velocity) return;
  const int up = rows[0] / CW_RENDER_SAMPLES, down = (rows[1] + CW_RENDER_SAMPLES - 1) / CW_RENDER_SAMPLES;
  cw_ranks_pass(ranks, canvas->velocity + (size_t)up * (size_t)canvas->width, (int64_t)(down - up) * canvas->width,
                sizeof *canvas->velocity, from, to);
}

// What all ranks have drawn of a picture, on the canvas of the one that finishes it: in the order of the regions, from
// its own outwards. Collective.
static CwStatus join_canvas(const Board *board, int picture) {
  CwStatus status = CW_OK;
  const CwRanks *ranks = board->ranks;
  CwCanvas *canvas = &board->drawing[picture].canvas, other = {0};
  const int to = finisher(board, picture);
  if (ranks->size == 1) goto done;
  if (ranks->rank == to) status = start_canvas(board->drawing[picture].spec, &other);
  CW_TRY(cw_ranks_agree(ranks, status));
  for (int step = 1; step < ranks->size; step++) {
    const int from = step <= to ? to - step : step;
    if (ranks->rank == from) pass_canvas(ranks, canvas, from, to);
    if (ranks->rank != to) continue;
    pass_canvas(ranks, &other, from, to);
    cw_render_merge(canvas, &other, from > to);
  }
  if (ranks->rank != to) cw_render_free(canvas);
done:
  cw_render_free(&other);
  return status;
}

// Joins the pictures and finishes them, each on one rank; rank 0 gets them all, and finishes the view. Collective.
static CwStatus finish_all(const Board *board, CwReportPictures *pictures, CwView *view) {
  CwStatus status = CW_OK;
  const CwRanks *ranks = board->ranks;
  for (int k = 0; k < cw_picture_list_count; k++)
    if (!board->drawing[k].lacking) CW_TRY(join_canvas(board, k));
  if (ranks->rank == 0) status = cw_view_finish(view, board->mesh);
  for (int k = 0; k < cw_picture_list_count && status == CW_OK; k++)
    if (!board->drawing[k].lacking && finisher(board, k) == ranks->rank)
      status = finish(board, k, &pictures->picture[k].png);
  CW_TRY(cw_ranks_agree(ranks, status));
  for (int k = 0; k < cw_picture_list_count; k++) {
    CwPng *png = &pictures->picture[k].png;
    CwDrawing *drawing = &board->drawing[k];
    const int from = finisher(board, k);
    cw_ranks_reduce(ranks, drawing->seen, sizeof drawing->seen, MPI_SIGNED_CHAR, MPI_MAX);
    if (from == 0) continue;
    int64_t size = (int64_t)png->size;
    cw_ranks_pass(ranks, &size, 1, sizeof size, from, 0);
    if (ranks->rank == 0) png->bytes = malloc((size_t)size + 1);
    if (ranks->rank == 0 && !png->bytes) status = CW_FAIL(CW_ERR_MEMORY, "out of memory: %lld bytes", (long long)size);
    CW_TRY(cw_ranks_agree(ranks, status));
    cw_ranks_pass(ranks, png->bytes, size, 1, from, 0);
    png->size = (size_t)size;
  }
done:
  return status;
}

static void describe(const Board *board, int index, CwReportPicture *picture) {
  const CwPictureSpec *spec = &cw_picture_list[index];
  picture->spec = spec;
  picture->lacking = board->drawing[index].lacking;
  picture->absent = is_absent(board, spec);
  if (cw_picture_is_of_flow(spec)) {
    picture->scale_label = cw_flow_label[spec->colour - CW_COLOUR_PRESSURE];
    picture->scale = board->flow->span[spec->colour - CW_COLOUR_PRESSURE];
  }
  if (!picture->lacking) make_legend(board->mesh, &board->drawing[index], picture);
}

static CwStatus start_board(const CwPumpSizes *sizes, Board *board, CwReportPictures *pictures, CwView *view) {
  CwStatus status = CW_OK;
  CW_NEW(board->drawing, cw_picture_list_count);
  CW_NEW(board->survey, 1);
  CW_NEW(pictures->picture, cw_picture_list_count);
  pictures->count = cw_picture_list_count;
  cw_survey_start(board->survey, sizes);
  for (int k = 0; k < cw_picture_list_count; k++)
    cw_drawing_start(&cw_picture_list[k], board->mesh, board->survey, &board->drawing[k]);
  CW_TRY(cw_view_start(board->mesh, sizes->outlet_radius, view));
done:
  return status;
}

CwStatus cw_report_pictures_draw(const CwRanks *ranks, const CwMesh *mesh, const CwPumpSizes *sizes, CwFlow *flow,
                                 CwReportPictures *pictures, CwView *view) {
  CwStatus status = CW_OK;
  Board board = {.ranks = ranks, .mesh = mesh, .flow = flow};
  *pictures = (CwReportPictures){0};
  CW_TRY(cw_ranks_agree(ranks, start_board(sizes, &board, pictures, view)));
  take_regions(&board);
  CW_TRY(survey_all(&board, flow));
  CW_TRY(cw_ranks_agree(ranks, begin_canvases(&board)));
  cw_progress_start(ranks->log, "pictures", mesh->region_count, "regions");
  CW_TRY(cw_ranks_agree(ranks, draw_own(&board, flow, view)));
  cw_progress_end(ranks->log);
  CW_TRY(cw_view_join(view, mesh, ranks));
  CW_TRY(finish_all(&board, pictures, view));
  for (int q = 0; flow->present && q < CW_VIEW_QUANTITIES; q++)
    view->quantity[view->quantity_count++] = (CwViewQuantity){q ? "y+" : "pressure", cw_flow_label[q], flow->span[q]};
  for (int k = 0; k < cw_picture_list_count; k++) describe(&board, k, &pictures->picture[k]);
done:
  for (int k = 0; board.drawing && k < cw_picture_list_count; k++) cw_render_free(&board.drawing[k].canvas);
  free(board.drawing);
  free(board.survey);
  return status;
}

void cw_report_pictures_free(CwReportPictures *pictures) {
  for (int k = 0; k < pictures->count; k++) cw_png_free(&pictures->picture[k].png);
  free(pictures->picture);
  *pictures = (CwReportPictures){0};
}
