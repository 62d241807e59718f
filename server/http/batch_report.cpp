// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/batch_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>

#include "engine/io/text_format.h"

namespace toile::http {

namespace {

constexpr double kFullColour = 0.10;  // stretch shown in the full colour

const char* word(BatchRowStatus status) {
  switch (status) {
    case BatchRowStatus::Done: return "done";
    case BatchRowStatus::Failed: return "failed";
    case BatchRowStatus::Cancelled: return "cancelled";
    case BatchRowStatus::Queued: return "queued";
    case BatchRowStatus::Running: return "running";
  }
  return "";
}

std::set<std::string> zones_of(const std::vector<BatchRow>& rows) {
  std::set<std::string> zones;
  for (const BatchRow& row : rows)
    for (const auto& [zone, stretch] : row.fit) zones.insert(zone);
  return zones;
}

std::string percent(double stretch) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", stretch * 100.0);
  return text.data();
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted("\"");
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted.append("\"");
}

double worst(const BatchRow& row) {
  if (row.status == BatchRowStatus::Failed) return 1e9;
  if (row.status != BatchRowStatus::Done) return -1.0;
  double most = 0.0;
  for (const auto& [zone, stretch] : row.fit) most = std::max(most, std::abs(stretch));
  return most;
}

// Tension red, slack blue, as in the pictures.
std::string cell(const BatchRow& row, const std::string& zone) {
  const auto found = row.fit.find(zone);
  if (found == row.fit.end()) return "<td></td>";
  const int pale = 255 - static_cast<int>(155.0 * std::min(1.0, std::abs(found->second) / kFullColour));
  const std::string shade = std::to_string(pale);
  const std::string colour = found->second >= 0
                                 ? std::string("rgb(255,").append(shade).append(",").append(shade).append(")")
                                 : std::string("rgb(").append(shade).append(",").append(shade).append(",255)");
  return "<td style=\"background:" + colour + "\">" + percent(found->second) + "</td>";
}

}  // namespace

std::string batch_csv(const std::vector<BatchRow>& rows) {
  const std::set<std::string> zones = zones_of(rows);
  const bool with_ids = std::any_of(rows.begin(), rows.end(), [](const BatchRow& row) { return !row.id.empty(); });
  std::string text = with_ids ? "body,id,status,error" : "body,status,error";
  for (const std::string& zone : zones) text.append(",").append(csv_field(zone)).append("_percent");
  text += "\n";
  for (const BatchRow& row : rows) {
    text += csv_field(row.body);
    if (with_ids) text.append(",").append(csv_field(row.id));
    text.append(",").append(word(row.status)).append(",").append(csv_field(row.error));
    for (const std::string& zone : zones)
      text.append(",").append(row.fit.contains(zone) ? percent(row.fit.at(zone)) : "");
    text += "\n";
  }
  return text;
}

namespace {

std::string html_row(const BatchRow& row, const std::set<std::string>& zones) {
  std::string text = "<tr><td>";
  if (row.link.empty())
    text += escape_xml(row.body);
  else
    text += "<a href=\"" + escape_xml(row.link) + "\">" + escape_xml(row.body) + "</a>";
  text += "</td>";
  if (row.status == BatchRowStatus::Done) {
    for (const std::string& zone : zones) text += cell(row, zone);
  } else {
    text += row.status == BatchRowStatus::Failed ? "<td class=\"no\" colspan=\"" : "<td colspan=\"";
    text += std::to_string(std::max<std::size_t>(1, zones.size())) + "\">" +
            escape_xml(row.error.empty() ? word(row.status) : row.error) + "</td>";
  }
  return text + "</tr>\n";
}

}  // namespace

std::string batch_html(const std::string& garment, const std::vector<BatchRow>& rows) {
  const std::set<std::string> zones = zones_of(rows);
  std::vector<BatchRow> sorted = rows;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const BatchRow& a, const BatchRow& b) { return worst(a) > worst(b); });
  std::string page =
      "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>" + escape_xml(garment) +
      "</title><style>body{font:14px sans-serif;margin:2em}td,th{padding:.2em .6em;text-align:right}"
      "td:first-child,th:first-child{text-align:left}.no{color:#a00}</style><h1>" +
      escape_xml(garment) + " on " + std::to_string(rows.size()) +
      " bodies</h1><p>Stretch left by zone in percent: red is tension, blue is slack; the worst first.</p>"
      "<table><tr><th>body</th>";
  for (const std::string& zone : zones) page += "<th>" + escape_xml(zone) + "</th>";
  page += "</tr>\n";
  for (const BatchRow& row : sorted) page += html_row(row, zones);
  return page + "</table></html>\n";
}

}  // namespace toile::http
