// SPDX-License-Identifier: AGPL-3.0-or-later
// What the faces of all parts look like: form, area, place, edges between them, and a coarse triangulation. Plain data
// in metres and in the pump's coordinates, from which patches are proposed, chosen and drawn; and distances from the
// exact faces.
#pragma once

#include "geometry/cad/cad_parts.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { CW_FORM_PLANE, CW_FORM_REVOLVED, CW_FORM_OTHER } CwSurveyForm; // revolved: about the axis, no plane

// Its fields are plain measures of one face; none follows from another.
typedef struct {
  int part, face; // from 0; faces of a part stand together, in their order
  CwSurveyForm form;
  int turned; // 1: of revolution about the axis, a plane across it too
  double area;
  double centre[3];   // of the area
  double normal[3];   // mean, out of the part: of length 1 on a plane, less on others
  double at[3];       // a point of the face, near its middle
  double radius[2];   // least and greatest distance from the axis
  double mean_radius; // of the area, root mean square
  double height[2];   // least and greatest z
  double twist;       // mean of normal times the direction of rotation
  int first_triangle, triangle_count;
  int first_sample, sample_count;
} CwSurveyFace;

// A point on a face, in the middle of one of its triangles or near a corner of it.
typedef struct {
  int triangle;
  double at[3];
} CwSurveySample;

typedef struct {
  int face[2]; // into CwSurvey.face, of one part
  double length;
  double angle; // through the water, rad: pi where smooth, less where the edge is concave as seen from the water
} CwSurveyEdge;

// A piece of the outline of a face.
typedef struct {
  int face;
  double at[2][3];
} CwSurveySegment;

typedef struct CwSurveyData CwSurveyData; // what holds the arrays, and the exact faces, for distances

typedef struct {
  int face_count, edge_count, triangle_count, point_count, sample_count, segment_count;
  CwSurveyFace *face;
  CwSurveyEdge *edge;
  int (*triangle)[3];
  double (*point)[3];
  CwSurveySample *sample;   // on the exact faces: about as many on each
  CwSurveySegment *segment; // of faces without triangles alone
  double (*box)[2][3];      // of each face
  double size;              // greatest extent of all
  CwSurveyData *data;
} CwSurvey;

// CW_ERR_GEOMETRY, naming domain, face and place in the file, where a face cannot be triangulated; the survey then is
// good for pictures alone, and has of such a face a corner, `at`, and its outline. Free also after a failure; zeroed
// `survey` on entry.
CwStatus cw_survey_make(const CwCadParts *parts, const CwCadFrame *frame, CwSurvey *survey);
void cw_survey_free(CwSurvey *survey);

// The nearest face of another number than that of the nearest one.
typedef struct {
  const int *number; // [in] of each face: pieces of one face share it
  int face;          // [out] -1: none within the reach
  double distance;   // [out] the reach where there is none
} CwSurveyNext;

// The face nearest to a point, of one part or (-1) of all, and its distance; -1 where none is within `reach`. [in,out]
// next: NULL where it is not asked for.
CwStatus cw_survey_nearest(const CwSurvey *survey, int part, const double point[3], double reach, int *face,
                           double *distance, CwSurveyNext *next);

#ifdef __cplusplus
}
#endif
