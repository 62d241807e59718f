// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/report_html.h"

#include "engine/io/ticket_document.h"

namespace toile {

namespace {
void add_pictures(const std::vector<ReportPicture>& pictures, HtmlPage& page) {
  for (const ReportPicture& picture : pictures)
    if (!picture.png.empty()) page.picture(picture.png, picture.caption);
}

void add_folded(std::string_view title, const Record& record, HtmlPage& page) {
  if (record.fields().empty()) return;
  page.raw("<details><summary>");
  page.raw(title);
  page.raw("</summary>\n");
  page.record(record);
  page.raw("</details>\n");
}
}  // namespace

Bytes write_report_html(const Report& report) {
  HtmlPage page(report.title, report.subtitle);
  for (const std::string& sentence : report.summary) page.paragraph(sentence, "note");
  if (report.ticket) {
    page.heading("What to do");
    add_ticket(*report.ticket, page);
  }
  if (!report.fits.empty() || !report.zones.empty()) {
    page.heading("Fit");
    page.paragraph("Red is stretched, green as cut, blue compressed or slack: one scale for all pictures.", "soft");
  }
  add_pictures(report.fits, page);
  for (const HtmlTable& table : report.zones) page.table(table);
  if (!report.pattern_svg.empty() || !report.pictures.empty()) page.heading("Pattern");
  if (!report.pattern_svg.empty()) {
    page.raw("<figure><div class=\"wide\">");
    page.raw({reinterpret_cast<const char*>(report.pattern_svg.data()), report.pattern_svg.size()});
    page.raw(
        "</div><figcaption>Solid: cut. Dashed: stitch. Blue: cloth added. Red: cloth taken "
        "away.</figcaption></figure>\n");
  }
  add_pictures(report.pictures, page);
  if (!report.quality.empty() || !report.findings.empty()) page.heading("Quality");
  page.list(report.findings);
  for (const HtmlTable& table : report.quality) page.table(table);
  add_folded("Measurements", report.measurements, page);
  add_folded("Options", report.options, page);
  return page.finish();
}

}  // namespace toile
