// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/cad/face_patches.h"

#include <ctype.h>
#include <fnmatch.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double NEAR = 0.05; // of the size: how far a point may lie from the face that it chooses
static const double CLEAR = 2;   // how much farther than that face the next one must lie
enum { ROLES = CW_ROLE_PIPE + 1 };

static const char *const role_names[] = {"wall", "interface", "inlet", "outlet", "hub", "shroud", "blade", "pipe"};

typedef struct {
  const CwCaseCad *cad;
  const CwCadFrame *frame;
  const CwCadParts *parts;
  const CwSurvey *survey;
  const CwContact *contact;
  const CwFaceRole *role;
  double tolerance; // m
  int *number;      // of each face: that of the face in the file, or below 0 one of its own
  int *rule;        // of each face; -1: none
} Work;

const char *cw_face_role_name(CwFaceRole role) {
  return role_names[role];
}

const char *cw_patch_source_name(CwPatchSource source) {
  static const char *const names[] = {"case", "file", "proposed"};
  return names[source];
}

static CwCadFaceInfo info_of(const Work *work, int face) {
  const CwSurveyFace *of = &work->survey->face[face];
  return cw_cad_part_face(work->parts, of->part, of->face);
}

static int in_domain(const Work *work, const CwCadPatch *rule, int face) {
  return !rule->domain[0] || !strcmp(work->cad->domain[work->survey->face[face].part].name, rule->domain);
}

// A text of a rule that faces are called by. Where one is called so to the letter it is no pattern: names have
// brackets.
typedef struct {
  const char *text;
  int whole;
} Word;

static int takes(Word word, const char *name) {
  return word.whole ? !strcmp(word.text, name) : !fnmatch(word.text, name, 0);
}

// The number of a face over all parts, or a name.
static int word_takes_face(const Work *work, Word word, int face) {
  char *end;
  const long number = strtol(word.text, &end, 10);
  if (!*end) return number == face + 1;
  return takes(word, info_of(work, face).name);
}

// Any of its layers.
static int word_takes_layer(const Work *work, Word word, int face) {
  const CwSurveyFace *of = &work->survey->face[face];
  const char *layer;
  for (int i = 0; (layer = cw_cad_part_face_layer(work->parts, of->part, of->face, i)); i++)
    if (takes(word, layer)) return 1;
  return 0;
}

// Faces that a rule chooses, whether or not an earlier rule has them.
typedef struct {
  int count, last; // the last of them
} Found;

static void take(const Work *work, int rule, int face, Found *found) {
  found->count++;
  found->last = face;
  if (work->rule[face] < 0) work->rule[face] = rule;
}

// What a word chooses, to the letter or else as a pattern. Returns how many faces.
static int take_word(const Work *work, int r, const char *text, int (*word_takes)(const Work *, Word, int),
                     Found *found) {
  const int before = found->count;
  for (int whole = 1; whole >= 0 && found->count == before; whole--)
    for (int f = 0; f < work->survey->face_count; f++)
      if (in_domain(work, &work->cad->patch[r], f) && word_takes(work, (Word){text, whole}, f)) take(work, r, f, found);
  return found->count - before;
}

// All of the face in the file that a face is all or a piece of; faces whose origin is not known are no pieces of one.
static int is_piece_of(const Work *work, int face, int other) {
  return work->number[face] == work->number[other] && (work->contact[face].part < 0) == (work->contact[other].part < 0);
}

// A point on a face chooses it however near its edges are, but for those that it lies on within the tolerance.
static CwStatus take_point(const Work *work, int r, int part, const double at[3], Found *found) {
  CwStatus status = CW_OK;
  const char *name = work->cad->patch[r].name;
  const double reach = NEAR * work->survey->size;
  CwSurveyNext next = {.number = work->number};
  double x[3], distance;
  int face;
  cw_cad_frame_from_file(work->frame, at, x);
  CW_TRY(cw_survey_nearest(work->survey, part, x, reach, &face, &distance, &next));
  CW_REQUIRE(face >= 0, CW_ERR_INPUT,
             "cad.patches.%s.near_mm: no face lies within %.3g mm of (%.6g, %.6g, %.6g); allowed: a point on the face",
             name, 1e3 * reach, 1e3 * at[0], 1e3 * at[1], 1e3 * at[2]);
  CW_REQUIRE(next.face < 0 || work->contact[face].part >= 0 || next.distance > fmax(CLEAR * distance, work->tolerance),
             CW_ERR_INPUT,
             "cad.patches.%s.near_mm: (%.6g, %.6g, %.6g) lies as near to another face, %d, %.3g mm off, as to face %d, "
             "%.3g mm off; allowed: a point on the face, more than %.3g mm off its edges, such as that of "
             "geometry/faces_sheet.csv",
             name, 1e3 * at[0], 1e3 * at[1], 1e3 * at[2], next.face + 1, 1e3 * next.distance, face + 1, 1e3 * distance,
             1e3 * work->tolerance);
  for (int f = 0; f < work->survey->face_count; f++)
    if (is_piece_of(work, f, face)) take(work, r, f, found);
done:
  return status;
}

static CwStatus take_points(const Work *work, int r, Found *found) {
  CwStatus status = CW_OK;
  const CwCadPatch *rule = &work->cad->patch[r];
  int part = -1;
  for (int d = 0; d < work->cad->domain_count; d++)
    if (rule->domain[0] && !strcmp(work->cad->domain[d].name, rule->domain)) part = d;
  for (int i = 0; i < rule->near.count; i++) CW_TRY(take_point(work, r, part, rule->near.at[i], found));
done:
  return status;
}

// What each word of a rule chooses, which must be a face.
static CwStatus take_words(const Work *work, int r, Found *found) {
  CwStatus status = CW_OK;
  const CwCadPatch *rule = &work->cad->patch[r];
  const char *of = rule->domain[0] ? " of " : "";
  for (int i = 0; i < rule->faces.count; i++) {
    CW_REQUIRE(take_word(work, r, rule->faces.text[i], word_takes_face, found), CW_ERR_INPUT,
               "cad.patches.%s.faces: '%s' matches no face%s%s; allowed: names, patterns and numbers of "
               "geometry/faces_sheet.csv",
               rule->name, rule->faces.text[i], of, rule->domain);
  }
  for (int i = 0; i < rule->layers.count; i++) {
    CW_REQUIRE(take_word(work, r, rule->layers.text[i], word_takes_layer, found), CW_ERR_INPUT,
               "cad.patches.%s.layer: no face%s%s has its layer, '%s'; allowed: those of geometry/faces_sheet.csv",
               rule->name, of, rule->domain, rule->layers.text[i]);
  }
  const int before = found->count;
  for (int f = 0; f < work->survey->face_count; f++)
    if (in_domain(work, rule, f) && rule->colour >= 0 && rule->colour == info_of(work, f).colour)
      take(work, r, f, found);
  CW_REQUIRE(rule->colour < 0 || found->count > before, CW_ERR_INPUT,
             "cad.patches.%s.colour: no face%s%s has its colour, #%06x; allowed: those of geometry/faces_sheet.csv",
             rule->name, of, rule->domain, (unsigned)rule->colour);
done:
  return status;
}

static CwStatus apply_rule(const Work *work, int r) {
  CwStatus status = CW_OK;
  Found found = {0};
  int own = 0;
  CW_TRY(take_words(work, r, &found));
  CW_TRY(take_points(work, r, &found));
  for (int f = 0; f < work->survey->face_count; f++) own += work->rule[f] == r;
  CW_REQUIRE(own || !found.count, CW_ERR_INPUT,
             "cad.patches.%s: earlier patches take all its faces, such as face %d (%s); allowed: a place before them",
             work->cad->patch[r].name, found.last + 1, work->cad->patch[work->rule[found.last]].name);
done:
  return status;
}

// A face that touches another domain is an interface and nothing else, and only such a one.
static CwStatus check_kind(const Work *work, int face) {
  CwStatus status = CW_OK;
  const int rule = work->rule[face], touches = work->contact[face].part >= 0;
  if (rule < 0) goto done;
  const CwCadPatch *of = &work->cad->patch[rule];
  CW_REQUIRE(
      of->kind != CW_CAD_KIND_INTERFACE || touches, CW_ERR_INPUT,
      "cad.patches.%s.kind: face %d touches no other domain; allowed: interface only for faces that coincide with "
      "faces of another domain",
      of->name, face + 1);
  CW_REQUIRE(!touches || of->kind == CW_CAD_KIND_OPEN || of->kind == CW_CAD_KIND_INTERFACE, CW_ERR_INPUT,
             "cad.patches.%s.kind: face %d touches %s; allowed there: interface", of->name, face + 1,
             work->cad->domain[work->contact[face].part].name);
done:
  return status;
}

// The kind of a face by what it is called; else by itself.
static CwPatchKind kind_of(const Work *work, int face, const char *name) {
  static const CwPatchKind of_rule[] = {CW_PATCH_WALL,   CW_PATCH_WALL,     CW_PATCH_INLET,
                                        CW_PATCH_OUTLET, CW_PATCH_SYMMETRY, CW_PATCH_INTERFACE};
  static const CwPatchKind of_role[ROLES] = {[CW_ROLE_INLET] = CW_PATCH_INLET, [CW_ROLE_OUTLET] = CW_PATCH_OUTLET};
  const int rule = work->rule[face];
  if (work->role[face] == CW_ROLE_CONTACT) return CW_PATCH_INTERFACE;
  if (rule >= 0 && work->cad->patch[rule].kind != CW_CAD_KIND_OPEN) return of_rule[work->cad->patch[rule].kind];
  for (int kind = 0; kind < CW_PATCH_KINDS; kind++)
    if (kind != CW_PATCH_INTERFACE && !strcmp(name, cw_patch_kind_name((CwPatchKind)kind))) return (CwPatchKind)kind;
  return of_role[work->role[face]]; // others are walls
}

// A name that solvers take, of one that may have any characters.
static void clean_name(const char *from, char name[CW_NAME_SIZE]) {
  int used = 0;
  for (const char *c = from; *c && used < CW_PATCH_NAME_MOST; c++) {
    const int fine = (unsigned char)*c < 0x80 && (isalnum((unsigned char)*c) || *c == '_');
    if (used == 0 && !(fine && isalpha((unsigned char)*c))) continue;
    name[used++] = fine ? *c : '_';
  }
  name[used] = '\0';
}

// Names that translators give to faces that have none.
static int says_nothing(const char *name) {
  static const char *const empty[] = {"", "NONE", "Face", "face", "Unnamed", "unnamed"};
  for (size_t i = 0; i < sizeof empty / sizeof *empty; i++)
    if (!strcmp(name, empty[i])) return 1;
  return 0;
}

static void proposed_name(const Work *work, int face, char name[CW_NAME_SIZE]) {
  const int part = work->survey->face[face].part, other = work->contact[face].part;
  const char *domain = work->cad->domain[part].name;
  char text[3 * CW_NAME_SIZE];
  if (work->role[face] == CW_ROLE_CONTACT) {
    snprintf(text, sizeof text, "%s_to_%s", domain, work->cad->domain[other].name);
    if (strlen(text) > CW_PATCH_NAME_MOST) snprintf(text, sizeof text, "domain%d_to_%d", part + 1, other + 1);
  } else if (work->role[face] == CW_ROLE_WALL || work->role[face] == CW_ROLE_PIPE) {
    snprintf(text, sizeof text, "%s_%s", domain, role_names[work->role[face]]);
  } else {
    snprintf(text, sizeof text, "%s", role_names[work->role[face]]);
  }
  memcpy(name, text, CW_NAME_SIZE - 1);
  name[CW_NAME_SIZE - 1] = '\0';
}

static CwPatchSource name_of(const Work *work, int face, char name[CW_NAME_SIZE]) {
  const int rule = work->rule[face];
  if (rule >= 0) {
    strcpy(name, work->cad->patch[rule].name);
    return CW_FROM_RULE;
  }
  const char *given = info_of(work, face).name;
  clean_name(work->cad->names_are_patches && !says_nothing(given) ? given : "", name);
  if (name[0]) return CW_FROM_FILE;
  proposed_name(work, face, name);
  return CW_FROM_PROPOSAL;
}

static int find(const CwFacePatches *patches, const char *name) {
  for (int i = 0; i < patches->count; i++)
    if (!strcmp(patches->patch[i].name, name)) return i;
  return -1;
}

// The patch of that name, part and kind; where another part or kind has the name, one with a number behind it.
static CwStatus patch_for(CwFacePatches *patches, const char *name, int part, CwPatchKind kind, int *patch) {
  CwStatus status = CW_OK;
  char own[CW_NAME_SIZE];
  snprintf(own, sizeof own, "%s", name);
  for (int number = 2;; number++) {
    *patch = find(patches, own);
    if (*patch < 0) break;
    const CwFacePatch *of = &patches->patch[*patch];
    if (of->part == part && of->kind == kind) goto done;
    snprintf(own, sizeof own, "%.*s_%d", CW_PATCH_NAME_MOST - 3, name, number);
  }
  CwFacePatch *grown = realloc(patches->patch, (size_t)(patches->count + 1) * sizeof *grown);
  CW_REQUIRE(grown, CW_ERR_MEMORY, "out of memory: %d patches", patches->count + 1);
  patches->patch = grown;
  *patch = patches->count++;
  grown[*patch] = (CwFacePatch){.part = part, .kind = kind, .rule = -1};
  strcpy(grown[*patch].name, own);
done:
  return status;
}

// The role that most of the area of each patch has.
static void set_roles(const Work *work, CwFacePatches *patches) {
  for (int p = 0; p < patches->count; p++) {
    double area[ROLES] = {0};
    for (int f = 0; f < work->survey->face_count; f++)
      if (patches->of_face[f] == p) area[work->role[f]] += work->survey->face[f].area;
    for (int role = 0; role < ROLES; role++) {
      patches->patch[p].area += area[role];
      if (area[role] > area[patches->patch[p].role]) patches->patch[p].role = (CwFaceRole)role;
    }
  }
}

CwStatus cw_face_patches_make(const CwCaseCad *cad, const CwCadFrame *frame, const CwCadParts *parts,
                              const CwSurvey *survey, const CwContact *contact, const CwFaceRole *role,
                              double tolerance, CwFacePatches *patches) {
  CwStatus status = CW_OK;
  Work work = {cad, frame, parts, survey, contact, role, tolerance, NULL, NULL};
  CW_NEW(work.number, survey->face_count);
  CW_NEW(work.rule, survey->face_count);
  CW_NEW(patches->of_face, survey->face_count);
  for (int f = 0; f < survey->face_count; f++) {
    const int number = info_of(&work, f).number;
    work.number[f] = number >= 0 ? number : -1 - f;
    work.rule[f] = -1;
  }
  for (int r = 0; r < cad->patch_count; r++) CW_TRY(apply_rule(&work, r));
  for (int f = 0; f < survey->face_count; f++) {
    char name[CW_NAME_SIZE];
    CW_TRY(check_kind(&work, f));
    const CwPatchSource source = name_of(&work, f, name);
    int *patch = &patches->of_face[f];
    CW_TRY(patch_for(patches, name, survey->face[f].part, kind_of(&work, f, name), patch));
    CwFacePatch *of = &patches->patch[*patch];
    if (of->rule >= 0) continue; // what the case says of a patch holds for faces of its name from elsewhere
    of->source = source;
    of->rule = work.rule[f];
  }
  set_roles(&work, patches);
done:
  free(work.number);
  free(work.rule);
  return status;
}

void cw_face_patches_free(CwFacePatches *patches) {
  free(patches->patch);
  free(patches->of_face);
  memset(patches, 0, sizeof *patches);
}
