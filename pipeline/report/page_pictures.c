// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/report/page_pictures.h"

#include "pipeline/report/html.h"

static void write_picture(FILE *page, const CwReportPicture *picture) {
  fprintf(page, "<figure%s>", picture->wide ? " class=\"wide\"" : "");
  if (picture->lacking) {
    fputs("<div class=\"lacking\">Not drawn: ", page);
    cw_html_text(page, picture->lacking);
    fputs(".</div>", page);
  } else {
    fprintf(page, "<img width=\"%d\" height=\"%d\" alt=\"", picture->width, picture->height);
    cw_html_text(page, picture->title);
    fputs("\" src=\"data:image/png;base64,", page);
    cw_html_base64(page, picture->png.bytes, picture->png.size);
    fputs("\">", page);
  }
  fputs("<figcaption><b>", page);
  cw_html_text(page, picture->title);
  fputs(".</b> ", page);
  cw_html_text(page, picture->caption);
  fputs("</figcaption>", page);
  if (picture->scale_label && !picture->lacking) cw_colour_bar(page, &picture->scale, picture->scale_label);
  if (picture->legend_count) {
    fputs("<div class=\"key\">", page);
    for (int k = 0; k < picture->legend_count; k++) {
      fprintf(page, "<span><i style=\"background:#%06x\"></i>", (unsigned)picture->legend[k].colour);
      cw_html_text(page, picture->legend[k].label);
      fputs("</span>", page);
    }
    fputs("</div>", page);
  }
  fputs("</figure>\n", page);
}

void cw_page_picture_list(FILE *page, const CwReportData *data, CwPictureSection section) {
  fputs("<div class=\"grid\">\n", page);
  for (int k = 0; k < data->pictures.count; k++) {
    if (data->pictures.picture[k].section == section && !data->pictures.picture[k].absent)
      write_picture(page, &data->pictures.picture[k]);
  }
  fputs("</div>\n", page);
}
