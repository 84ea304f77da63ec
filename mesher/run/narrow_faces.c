// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mesher/run/narrow_faces.h"

#include <math.h>
#include <stdlib.h>

#include "mesher/cad/cad_leave_out.h"
#include "mesher/run/layer_record.h"

static const double LEAST_SHARE = 0.5; // of the edges, that a face is wide which a mesh shows
static const double EXPONENT = 2.7;    // of edge lengths, with which the number of cells falls
static const double DIGITS = 1e-6;     // of shares: images are alike

// What is measured of the strips of a face, or of all its images.
typedef struct {
  double length, share, size; // share and size: times the length
} Narrow;

typedef struct {
  int number;
  Narrow sum;
  double share;  // mean of width / h
  int32_t image; // the least first image of its faces: the same for all its images
  int touches;   // 1: an image of it, so that not all of them can go
} Chain;

static int compare_chains(const void *p, const void *q) {
  const Chain *a = p, *b = q;
  if (a->share != b->share) return a->share < b->share ? -1 : 1;
  return (a->number > b->number) - (a->number < b->number);
}

static int32_t first_image(const CwDomain *domain, int32_t face) {
  return domain->symmetry ? domain->symmetry->face.first[face] : face;
}

static void add(const CwDomain *domain, const CwCadStrip *strip, Narrow *to) {
  double share = 0, size = 0;
  for (int i = 0; i < CW_STRIP_SAMPLES; i++) {
    double h = cw_size_at(domain->size, strip->x[i]);
    share += strip->width[i] / h / CW_STRIP_SAMPLES;
    size += h / CW_STRIP_SAMPLES;
  }
  to->length += strip->length;
  to->share += strip->length * share;
  to->size += strip->length * size;
}

// Marks chains that have a vertex in common with an image of theirs.
static CwStatus find_touching(const CwDomain *domain, int strips, const CwCadStrip *strip, Chain *chain) {
  CwStatus status = CW_OK;
  const CwCad *cad = domain->cad;
  int *of_face = NULL, *of_vertex = NULL; // chain + 1, 0: none
  CW_NEW(of_face, cw_cad_face_count(cad));
  CW_NEW(of_vertex, cw_cad_vertex_count(cad));
  for (int i = 0; i < strips; i++) of_face[strip[i].face] = strip[i].chain + 1;
  for (int e = 0; e < cw_cad_edge_count(cad); e++) {
    int face[2], vertex[2];
    cw_cad_edge_faces(cad, e, face);
    cw_cad_edge_vertices(cad, e, vertex);
    for (int k = 0; k < 4; k++) {
      int here = of_face[face[k / 2]], *there = &of_vertex[vertex[k % 2]];
      if (here == 0) continue;
      if (*there == 0) *there = here;
      if (*there == here || chain[*there - 1].image != chain[here - 1].image) continue;
      chain[*there - 1].touches = chain[here - 1].touches = 1;
    }
  }
  for (int i = 0; i < strips; i++) // all images alike
    for (int j = 0; chain[strip[i].chain].touches && j < strips; j++)
      if (chain[strip[j].chain].image == chain[strip[i].chain].image) chain[strip[j].chain].touches = 1;
done:
  free(of_face);
  free(of_vertex);
  return status;
}

// The chains of a domain, the narrowest first.
static CwStatus list_chains(const CwDomain *domain, int *count, Chain **chain) {
  CwStatus status = CW_OK;
  int strips;
  CwCadStrip *strip = NULL;
  Narrow *face = NULL; // by first image
  *count = 0;
  CW_TRY(cw_cad_strips_find(domain->cad, &strips, &strip));
  CW_NEW(face, cw_cad_face_count(domain->cad));
  CW_NEW(*chain, strips);
  for (int i = 0; i < strips; i++) add(domain, &strip[i], &face[first_image(domain, strip[i].face)]);
  for (int i = 0; i < strips; i++) {
    const Narrow *of = &face[first_image(domain, strip[i].face)];
    Chain *to = &(*chain)[strip[i].chain];
    int32_t image = first_image(domain, strip[i].face);
    to->image = to->sum.length > 0 && to->image < image ? to->image : image;
    to->number = strip[i].chain;
    to->sum.length += of->length;
    to->sum.share += of->share;
    to->sum.size += of->size;
    if (strip[i].chain >= *count) *count = strip[i].chain + 1;
  }
  CW_TRY(find_touching(domain, strips, strip, *chain));
  for (int c = 0; c < *count; c++) {
    Chain *of = &(*chain)[c];
    of->share = round(of->sum.share / of->sum.length / DIGITS) * DIGITS;
  }
  qsort(*chain, (size_t)*count, sizeof **chain, compare_chains);
done:
  free(strip);
  free(face);
  return status;
}

static CwStatus leave_out(CwMeshRun *run, CwDomain *domain, int *faces) {
  CwStatus status = CW_OK;
  Chain *chain = NULL;
  int count = 0, narrow = 0, *number = NULL;
  double least = LEAST_SHARE;
  Narrow sum = {0};
  *faces = 0;
  CW_TRY(list_chains(domain, &count, &chain));
  CW_NEW(number, count);
  for (int c = 0; c < count; c++) {
    cw_log_debug(run->context.log, "%s: chain %d of narrow faces is %.2f of the edges there wide", domain->name,
                 chain[c].number, chain[c].share);
    if (chain[c].share >= LEAST_SHARE || chain[c].touches) continue;
    if (narrow == 0) least = chain[c].share;
    number[narrow++] = chain[c].number;
    sum.length += chain[c].sum.length;
    sum.size += chain[c].sum.size;
  }
  if (narrow == 0) goto done;
  CW_TRY(cw_cad_leave_out(domain->cad, narrow, number, faces));
  if (*faces == 0) goto done;
  double cells = (double)run->table->mesh.cells * pow(LEAST_SHARE / least, EXPONENT);
  cw_warn_of_left_out(run->context.log, domain, sum.size / sum.length, cells, run->headlines);
done:
  free(chain);
  free(number);
  return status;
}

CwStatus cw_leave_out_narrow(CwMeshRun *run, int *left) {
  CwStatus status = CW_OK;
  *left = 0;
  for (int d = 0; d < run->model.domain_count; d++) {
    int faces;
    CW_TRY(leave_out(run, &run->domain[d], &faces));
    *left += faces;
  }
done:
  return status;
}
