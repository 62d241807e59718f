// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/html_page.h"

#include <algorithm>

#include "engine/io/base64.h"
#include "engine/io/text_format.h"

namespace toile {
namespace {

constexpr std::string_view kPageStyle = R"(
:root{--ink:#1c1c20;--soft:#6b6b75;--line:#dcdce2;--paper:#fff;--tint:#f6f4f0;--blue:#2f5bd8;--red:#c8281e}
*{box-sizing:border-box}
body{margin:0 auto;max-width:62rem;padding:1.2rem 1rem 3rem;color:var(--ink);background:var(--paper);
 font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,Helvetica,Arial,sans-serif}
h1{font-size:1.6rem;line-height:1.2;margin:0 0 .2rem;overflow-wrap:anywhere}
h2{font-size:1.2rem;margin:2rem 0 .6rem;padding-top:.6rem;border-top:2px solid var(--ink)}
p{margin:.4rem 0}.soft{color:var(--soft)}.note{background:var(--tint);padding:.6rem .8rem;border-radius:.3rem}
figure{margin:1rem 0}figcaption{color:var(--soft);font-size:.9rem;margin-top:.3rem}
.wide{overflow-x:auto;border:1px solid var(--line);border-radius:.3rem;background:#fff}
.wide>*{display:block;width:100%;height:auto;min-width:44rem}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums;font-size:.95rem}
.scroll{overflow-x:auto;margin:.6rem 0}
caption{text-align:left;font-weight:600;padding:.3rem 0}
th,td{padding:.3rem .6rem;border-bottom:1px solid var(--line);text-align:right;vertical-align:top;white-space:nowrap}
th:first-child,td:first-child{text-align:left}th{font-weight:600;color:var(--soft)}
dl{display:grid;grid-template-columns:minmax(8rem,auto) 1fr;gap:.15rem .9rem;margin:.4rem 0;font-size:.95rem}
dt{color:var(--soft)}dd{margin:0;overflow-wrap:anywhere}
details{margin:.6rem 0}summary{cursor:pointer;font-weight:600}
ol.work{list-style:none;margin:0;padding:0}
ol.work>li{border:1px solid var(--line);border-left:.35rem solid var(--ink);border-radius:.3rem;padding:.7rem .9rem;
 margin:.8rem 0;break-inside:avoid}
ol.work>li.adds{border-left-color:var(--blue)}ol.work>li.takes{border-left-color:var(--red)}
.step{display:flex;gap:.7rem;align-items:baseline;font-weight:600}.step .box{flex:none;width:1rem;height:1rem;
 border:1.5px solid var(--ink);border-radius:.15rem;display:inline-block;transform:translateY(.15rem)}
.tag{font-size:.8rem;padding:.05rem .5rem;border-radius:1rem;background:var(--tint);font-weight:400;white-space:nowrap}
.tag.warn{background:#fde7c8}.profile{width:100%;max-width:30rem;height:auto}
@media(max-width:34rem){table{font-size:.85rem}th,td{padding:.25rem .35rem}th{white-space:normal}dl{grid-template-columns:1fr}dd{margin-bottom:.3rem}body{padding:.8rem .7rem 2rem}}
@page{size:A4;margin:14mm}
@media print{body{max-width:none;padding:0;font-size:10pt}.wide{border:0;overflow:visible}.wide>*{min-width:0}.scroll{overflow:visible}table{font-size:8pt}th,td{padding:.2rem .35rem}
 h2{break-after:avoid}figure,table,ol.work>li{break-inside:avoid}}
)";

std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

struct ValueText {
  std::string operator()(std::monostate) const { return "-"; }
  std::string operator()(bool value) const { return value ? "yes" : "no"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number(value, 4); }
  std::string operator()(const std::string& value) const { return escape_xml(value); }
  std::string operator()(const Record& value) const { return list_of(value); }
  std::string operator()(const std::vector<Record>& values) const {
    std::string text;
    for (const Record& value : values) text += list_of(value);
    return text.empty() ? "none" : text;
  }
  std::string operator()(const std::vector<double>& values) const {
    std::string text;
    for (const double value : values) append(text, {text.empty() ? "" : ", ", number(value, 4)});
    return text;
  }
  std::string operator()(const std::vector<std::vector<double>>& rows) const {
    std::string text;
    for (const auto& row : rows) append(text, {text.empty() ? "" : "; ", (*this)(row)});
    return text;
  }
  std::string operator()(const std::vector<std::int64_t>& values) const {
    std::string text;
    for (const std::int64_t value : values) append(text, {text.empty() ? "" : ", ", std::to_string(value)});
    return text;
  }
  std::string operator()(const std::vector<std::string>& values) const {
    std::string text;
    for (const std::string& value : values) append(text, {text.empty() ? "" : ", ", escape_xml(value)});
    return text;
  }
  static std::string list_of(const Record& record) {
    std::string text = "<dl>";
    for (const RecordField& field : record.fields())
      append(text,
             {"<dt>", escape_xml(spaced(field.name)), "</dt><dd>", std::visit(ValueText{}, field.value), "</dd>"});
    return text += "</dl>\n";
  }
};

}  // namespace

HtmlPage::HtmlPage(std::string_view title, std::string_view subtitle) : title_(title) {
  append(body_, {"<header><h1>", escape_xml(title), "</h1>\n"});
  if (!subtitle.empty()) append(body_, {"<p class=\"soft\">", escape_xml(subtitle), "</p>"});
  body_ += "</header>\n";
}

void HtmlPage::heading(std::string_view text) {
  append(body_, {"<h2>", escape_xml(text), "</h2>\n"});
}

void HtmlPage::paragraph(std::string_view text, std::string_view css_class) {
  body_ += "<p";
  if (!css_class.empty()) append(body_, {" class=\"", css_class, "\""});
  append(body_, {">", escape_xml(text), "</p>\n"});
}

void HtmlPage::list(const std::vector<std::string>& items) {
  if (items.empty()) return;
  body_ += "<ul>";
  for (const std::string& item : items) append(body_, {"<li>", escape_xml(item), "</li>\n"});
  body_ += "</ul>\n";
}

void HtmlPage::table(const HtmlTable& table) {
  body_ += "<div class=\"scroll\"><table>";
  if (!table.title.empty()) append(body_, {"<caption>", escape_xml(table.title), "</caption>"});
  body_ += "<thead><tr>";
  for (const std::string& column : table.columns) append(body_, {"<th>", escape_xml(column), "</th>"});
  body_ += "</tr></thead>\n<tbody>";
  for (const auto& row : table.rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) append(body_, {"<td>", escape_xml(cell), "</td>"});
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlPage::picture(const Bytes& png, std::string_view caption) {
  append(body_, {"<figure><div class=\"wide\"><img alt=\"", escape_xml(caption), "\" src=\"",
                 data_uri("image/png", png), "\"></div><figcaption>", escape_xml(caption), "</figcaption></figure>\n"});
}

void HtmlPage::record(const Record& record) {
  body_ += ValueText::list_of(record);
}

Bytes HtmlPage::finish() const {
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\n";
  append(page, {"<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>", escape_xml(title_),
                "</title>\n<style>", kPageStyle, "</style></head>\n<body>\n", body_, "</body>\n</html>\n"});
  return Bytes(page.begin(), page.end());
}

}  // namespace toile
