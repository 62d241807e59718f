// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/job_report.h"

#include <algorithm>
#include <cmath>

#include "engine/bodies/body_zones.h"
#include "engine/core/text.h"
#include "engine/core/units.h"

namespace toile {
namespace {

// "12.3 %", "+0.4 %" when a direction matters; never "-0.0 %".
std::string percent(double share) {
  return print_text("%.1f %%", 100.0 * share);
}
std::string signed_percent(double share) {
  const double tenths = std::round(1000.0 * share);
  return tenths == 0.0 ? "0" : print_text("%+.1f %%", 0.1 * tenths);
}

std::string counted(std::size_t count, const char* one, const char* many) {
  return print_text("%zu %s", count, count == 1 ? one : many);
}

std::string work_sentence(const Ticket& ticket) {
  if (ticket.operations.empty()) return "Nothing is to be altered.";
  const auto adds = static_cast<std::size_t>(
      std::count_if(ticket.operations.begin(), ticket.operations.end(),
                    [](const TicketOperation& o) { return o.fabric == FabricNeed::NeedsFabric; }));
  std::string text = counted(ticket.operations.size(), "operation", "operations");
  if (adds == 0) return text + "; no new cloth is needed.";
  return text + (adds == ticket.operations.size() ? "; new cloth is needed."
                                                  : print_text("; %zu of them with new cloth.", adds));
}

std::string fit_sentence(const JobFits& fits) {
  const auto rms = [](const FitComparison& fit) { return percent(fit.whole.rms_stretch); };
  std::string text = "The cloth's stretch differs from that on the reference body by " + rms(*fits.before) +
                     " before the alteration, ";
  if (fits.after) text += rms(*fits.after) + " after it, ";
  return text + rms(fits.ideal) + " with the ideal pattern (root mean square).";
}

std::string rest_words(Rest rest) {
  switch (rest) {
    case Rest::Converged: return "at rest";
    case Rest::Settled: return "settled";
    case Rest::NotAtRest: return "still moving";
    case Rest::AsGiven: return "as it was given";
  }
  return "";
}

}  // namespace

JobFits compare_job_fits(const AlterResult& r) {
  const PatternMesh& mesh = r.reference.mesh;
  const auto zones = body_zones(r.reference.pattern, mesh, r.reference.drape.drape, r.reference.body);
  JobFits fits{{}, compare_fits(mesh, r.reference.fit, r.derived.fit, {}, zones), {}};
  if (r.before) fits.before = compare_fits(mesh, r.reference.fit, r.fit_before, {}, zones);
  if (r.after && r.after->problem.empty())
    fits.after = compare_fits(r.after->mesh, r.after->reference, r.after->fit, {},
                              body_zones(r.altered.sewn.pattern, r.after->mesh, r.after->drape.drape, r.target_body));
  return fits;
}

std::string readable_garment_name(const std::string& name) {
  std::string text = name.substr(name.find_last_of('/') + 1);
  const std::size_t dot = text.find_last_of('.');
  if (dot == std::string::npos || dot == 0 || text.find(' ') != std::string::npos) return name;
  text.resize(dot);
  constexpr std::string_view kSuffix = "_specification";
  if (text.size() > kSuffix.size() && text.ends_with(kSuffix)) text.resize(text.size() - kSuffix.size());
  std::replace(text.begin(), text.end(), '_', ' ');
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::vector<std::string> summary_sentences(const AlterResult& result, const JobFits& fits) {
  std::vector<std::string> sentences = {work_sentence(result.altered.ticket), fit_sentence(fits)};
  const PlacedPlans& place = result.place;
  if (place.kept_plan().problem.empty() && !place.in_place(place.kept_plan()))
    sentences.push_back(
        print_text("Tried on, the altered garment rests %.1f mm off its place (root mean square); "
                   "%.1f mm was aimed at.",
                   place.kept_plan().position * kMmPerMetre, place.allowed * kMmPerMetre));
  if (result.after && !result.after->problem.empty())
    sentences.push_back("The altered garment could not be sewn together and worn: " + result.after->problem + ".");
  return sentences;
}

HtmlTable zone_table(const JobFits& fits) {
  HtmlTable table{"Mean stretch beyond that of the reference fit: + tighter, - looser",
                  {"zone", "before, weft", "before, warp"},
                  {}};
  if (fits.after) table.columns.insert(table.columns.end(), {"after, weft", "after, warp"});
  table.columns.insert(table.columns.end(), {"ideal, weft", "ideal, warp"});
  const auto add = [&](std::string_view zone, const auto& difference) {
    std::vector<std::string> row = {std::string(zone)};
    for (const FitComparison* fit : {&*fits.before, fits.after ? &*fits.after : nullptr, &fits.ideal}) {
      if (!fit) continue;
      row.push_back(signed_percent(difference(*fit).mean_weft));
      row.push_back(signed_percent(difference(*fit).mean_warp));
    }
    table.rows.push_back(std::move(row));
  };
  add("whole garment", [](const FitComparison& fit) { return fit.whole; });
  for (std::size_t z = 0; z < fits.before->zones.size(); ++z)
    if (fits.before->zones[z].area > 0.0 && static_cast<BodyZone>(z) != BodyZone::Whole)
      add(zone_name(static_cast<BodyZone>(z)), [z](const FitComparison& fit) { return fit.zones[z]; });
  return table;
}

HtmlTable drape_quality_table(const AlterResult& r) {
  std::vector<std::pair<const char*, const DrapeQuality*>> drapes = {{"reference", &r.reference.drape.quality},
                                                                     {"before", &r.before->quality}};
  if (r.after && r.after->problem.empty()) drapes.emplace_back("after", &r.after->drape.quality);
  drapes.emplace_back("ideal", &r.derived.drape.quality);
  HtmlTable table{"How sound the simulated drapes are", {""}, {}};
  for (const auto& [name, quality] : drapes) table.columns.emplace_back(name);
  const auto add = [&](const char* what, const auto& words) {
    table.rows.push_back({what});
    for (const auto& [name, quality] : drapes) table.rows.back().push_back(words(*quality));
  };
  add("cloth", [](const DrapeQuality& q) { return rest_words(q.rest); });
  add("weft stretch, median", [](const DrapeQuality& q) { return percent(q.weft.p50); });
  add("weft stretch, 99th percentile", [](const DrapeQuality& q) { return percent(q.weft.p99); });
  add("warp stretch, median", [](const DrapeQuality& q) { return percent(q.warp.p50); });
  add("warp stretch, 99th percentile", [](const DrapeQuality& q) { return percent(q.warp.p99); });
  add("deepest in the body", [](const DrapeQuality& q) {
    return print_text("%.1f mm", std::max(q.deepest_node, q.deepest_edge) * kMmPerMetre);
  });
  add("cloth through cloth", [](const DrapeQuality& q) { return percent(q.crossing_share); });
  return table;
}

}  // namespace toile
