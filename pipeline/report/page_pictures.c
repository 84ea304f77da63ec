// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_parts.h"

#include "pipeline/report/html.h"

static void write_picture(FILE *page, const CwReportPicture *picture) {
  const CwPictureSpec *spec = picture->spec;
  fprintf(page, "<figure%s>", spec->wide ? " class=\"wide\"" : "");
  if (picture->lacking) {
    cw_html_text(page, "<div class=\"lacking\">Not drawn: ", picture->lacking, ".</div>");
  } else {
    fprintf(page, "<img width=\"%d\" height=\"%d\" alt=\"", spec->width, spec->height);
    cw_html_text(page, "", spec->title, "\" src=\"data:image/png;base64,");
    cw_html_base64(page, picture->png.bytes, picture->png.size);
    fputs("\">", page);
  }
  cw_html_text(page, "<figcaption><b>", spec->title, ".</b> ");
  cw_html_text(page, "", spec->caption, "</figcaption>");
  if (picture->scale_label && !picture->lacking) cw_colour_bar(page, &picture->scale, picture->scale_label);
  if (picture->legend_count) {
    fputs("<div class=\"key\">", page);
    for (int k = 0; k < picture->legend_count; k++) {
      fprintf(page, "<span><i style=\"background:#%06x\"></i>", (unsigned)picture->legend[k].colour);
      cw_html_text(page, "", picture->legend[k].label, "</span>");
    }
    fputs("</div>", page);
  }
  fputs("</figure>\n", page);
}

void cw_page_picture_list(FILE *page, const CwReportData *data, CwPictureSection section) {
  fputs("<div class=\"grid\">\n", page);
  for (int k = 0; k < data->pictures.count; k++) {
    const CwReportPicture *picture = &data->pictures.picture[k];
    if (picture->spec->section == section && !picture->absent) write_picture(page, picture);
  }
  fputs("</div>\n", page);
}
