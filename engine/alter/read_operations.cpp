// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/read_operations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "engine/alter/operation_words.h"
#include "engine/alter/tear_reading.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kProfileSpacing = 0.02;  // m, of the ticket's profiles
constexpr double kEqualAmount = 0.1;      // relative: left and right that differ by less are one operation

// Whether two readings are one job for the person who sews.
bool belong_together(const TornPattern& torn, const std::vector<std::vector<SeamPartner>>& partners,
                     const TearReading& a, const TearReading& b) {
  if (a.inserts != b.inserts) return false;
  if (a.job == b.job) return true;
  if (a.kind != b.kind || a.tear.kind != TearKind::Edge || b.tear.kind != TearKind::Edge) return false;
  const Sheet& sheet_b = torn.sheets[static_cast<std::size_t>(b.panel)];
  const double larger = std::max(a.profile.largest, b.profile.largest);
  if (a.panel != b.panel && a.mirror_name == b.mirror_name &&
      std::abs(a.profile.largest - b.profile.largest) < kEqualAmount * larger)
    return true;
  for (const TearMouth& mouth : a.mouths)
    for (const PartnerPlace& place : partner_places(torn.sheets, partners, a.panel, mouth))
      if (place.panel == b.panel && opens_at(sheet_b, b.mouths, place.places)) return true;
  return false;
}

std::vector<std::vector<std::size_t>> group(
    const std::vector<TearReading>& readings,
    const std::function<bool(const TearReading&, const TearReading&)>& together) {
  std::vector<std::size_t> parent(readings.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (std::size_t i = 0; i < readings.size(); ++i)
    for (std::size_t j = i + 1; j < readings.size(); ++j)
      if (together(readings[i], readings[j])) {
        const std::size_t a = root(i), b = root(j);
        parent[std::max(a, b)] = std::min(a, b);
      }
  std::vector<std::vector<std::size_t>> groups(readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) groups[root(i)].push_back(i);
  std::erase_if(groups, [](const auto& g) { return g.empty(); });
  return groups;
}

bool is_length(OperationKind kind) {
  return kind == OperationKind::Lengthen || kind == OperationKind::Shorten;
}

// "left and right side", "from the waist into front and back".
std::string where_words(const Pattern& pattern, const std::vector<const TearReading*>& members) {
  std::vector<std::string> sides, panels;
  std::set<int> numbers;
  bool hems = true;
  std::map<std::string, std::pair<std::vector<std::string>, std::vector<std::string>>> cuts;  // into which panels
  for (const TearReading* reading : members) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(reading->panel)];
    auto& [from, into] = cuts[without_left_right(spoken_list(reading->names))];
    panels.push_back(panel_words(panel));
    numbers.insert(reading->panel);
    hems = hems && !reading->cuts() && is_length(reading->kind) && reading->names[0].find(" of ") == std::string::npos;
    auto& names = reading->cuts() ? from : sides;
    names.insert(names.end(), reading->names.begin(), reading->names.end());
    if (reading->cuts()) into.push_back(panel_words(panel));
  }
  std::vector<std::string> words;
  if (!sides.empty()) words.push_back(spoken_list(sides));
  if (hems && numbers.size() < pattern.panels.size())  // which hem of several
    words.back() += " of " + spoken_list(panels);
  for (const auto& [key, cut] : cuts)
    if (!cut.second.empty()) words.push_back("from the " + spoken_list(cut.first) + " into " + spoken_list(cut.second));
  return spoken_list(words);
}

// Where the amount is largest and how it goes on from there.
void describe_course(const TearReading& reading, const std::vector<Vec2>& outline, TicketOperation& operation) {
  constexpr double kEven = 0.8;     // of the largest: an amount that keeps to this is the same all along
  constexpr double kAtEnd = 0.08;   // of the length: nearer to an end is at that end
  constexpr double kMiddle = 0.25;  // of the length, of what runs round the body: farther from both ends
  const TearProfile& profile = reading.profile;
  operation.profile = {kProfileSpacing, profile.sampled(kProfileSpacing)};
  const auto least = std::min_element(profile.open.begin(), profile.open.end());
  operation.least = *least;
  if (*least > kEven * profile.largest) {
    operation.largest_at = "all along";
    return;
  }
  const auto place = [&](std::size_t i) {
    const double share = (profile.at[i] - profile.at.front()) / std::max(1e-9, profile.at.back() - profile.at.front());
    if (share < kAtEnd) return reading.end_words[0];
    if (share > 1.0 - kAtEnd) return reading.end_words[1];
    if (reading.upright || reading.cuts()) return place_words(profile.middle[i], outline);
    return std::string(share > kMiddle && share < 1.0 - kMiddle ? "in the middle" : "near an end");
  };
  operation.largest_at = place(profile.largest_index);
  if (!profile.shut_at_start && !profile.shut_at_end) {
    operation.least_at = place(static_cast<std::size_t>(least - profile.open.begin()));
    return;
  }
  const std::size_t end = profile.shut_at_end ? profile.at.size() - 1 : 0;
  std::size_t shut = end;  // the nearest place to the largest amount where nothing is open any more
  while (shut != profile.largest_index && profile.open[shut] < 1e-9)
    shut = shut > profile.largest_index ? shut - 1 : shut + 1;
  operation.tapers_to = place(shut);
  operation.taper_length = std::abs(profile.at[shut] - profile.at[profile.largest_index]);
}

TicketOperation describe(const Pattern& pattern, const TornPattern& torn, const std::vector<TearReading>& members,
                         const AlterPatternOptions& options) {
  TicketOperation operation;
  std::set<std::string> touches;
  std::vector<const TearReading*> all;
  const TearReading* largest = &members[0];
  for (const TearReading& reading : members) {
    const Sheet& sheet = torn.sheets[static_cast<std::size_t>(reading.panel)];
    const Panel& panel = pattern.panels[static_cast<std::size_t>(reading.panel)];
    all.push_back(&reading);
    if (reading.profile.largest > largest->profile.largest) largest = &reading;
    const std::vector<int>& edges = sheet.sides[static_cast<std::size_t>(reading.tear.side)].edges;
    operation.sides.push_back({panel.name, edges, spoken_list(reading.names), reading.profile.largest});
    for (const int edge : edges)
      if (panel.edges[static_cast<std::size_t>(edge)].zip) touches.insert("zip");
    for (const KeepOut& keep : panel.keep_outs) touches.insert(keep.why);
    if (reading.fabric == FabricNeed::NeedsFabric || operation.fabric == FabricNeed::None)
      operation.fabric = reading.fabric;
  }
  operation.kind = largest->kind;
  operation.per_ply = largest->profile.largest;
  operation.total = total_amount(pattern, torn, members);
  operation.allowance = largest->allowance;
  operation.where = where_words(pattern, all);
  operation.touches.assign(touches.begin(), touches.end());
  operation.below_accuracy = operation.total < options.least_change;
  std::vector<Vec2> outline;
  for (const SideCurve& side : torn.sheets[static_cast<std::size_t>(largest->panel)].wanted_sides)
    outline.insert(outline.end(), side.points().begin(), side.points().end());
  describe_course(*largest, outline, operation);
  return operation;
}

TicketPiece piece_of(const Pattern& pattern, const AlteredRegion& region) {
  TicketPiece piece;
  piece.name = piece.label = region.name;
  const Vec2 size = least_box(region.shape.outline);
  piece.width = size.x();
  piece.length = size.y();
  piece.area = region.area;
  piece.seam_allowance = pattern.seam_allowance;
  return piece;
}

// How much of a region a tear opened, as an area; 0 when none.
double opened_area(const TearReading& reading, const AlteredRegion& region) {
  const TearProfile& profile = reading.profile;
  double sum = 0.0;
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    if (!inside_polygon(region.shape.outline, profile.middle[i])) continue;
    const double from = profile.at[i > 0 ? i - 1 : 0], to = profile.at[std::min(i + 1, profile.at.size() - 1)];
    sum += 0.5 * (to - from) * profile.open[i];
  }
  return sum;
}

// Tears whose opening was too small to become a region are not worth a word.
void drop_closed(const std::vector<PanelAlteration>& panels, std::vector<TearReading>& readings) {
  std::erase_if(readings, [&](const TearReading& reading) {
    const PanelAlteration& panel = panels[static_cast<std::size_t>(reading.panel)];
    const auto& regions = reading.inserts ? panel.insertions : panel.removals;
    return std::none_of(regions.begin(), regions.end(),
                        [&](const AlteredRegion& region) { return opened_area(reading, region) > 0.0; });
  });
}

double distance_to(const TearReading& reading, const AlteredRegion& region) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : reading.profile.middle) least = std::min(least, distance_to_polygon(region.shape.outline, p));
  return least;
}

// One operation with the tears it is made of.
struct Job {
  const TornPattern* torn;
  std::vector<TearReading> members;
  TicketOperation operation;
};

// Gives every region to the operation that opens most of it, and what it takes away to all that do.
void claim_region(std::vector<Job>& jobs, int panel, bool inserts, AlteredRegion& region) {
  std::vector<double> opened(jobs.size(), 0.0);
  std::pair<double, int> nearest{std::numeric_limits<double>::infinity(), -1};
  for (std::size_t j = 0; j < jobs.size(); ++j)
    for (const TearReading& reading : jobs[j].members) {
      if (reading.panel != panel || reading.inserts != inserts) continue;
      opened[j] += opened_area(reading, region);
      nearest = std::min(nearest, {distance_to(reading, region), static_cast<int>(j)});
    }
  const double sum = std::accumulate(opened.begin(), opened.end(), 0.0);
  region.operation = nearest.second;
  if (sum > 0.0) region.operation = static_cast<int>(std::max_element(opened.begin(), opened.end()) - opened.begin());
  if (region.operation < 0) return;
  const int owner = region.operation;
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    TicketOperation& operation = jobs[j].operation;
    const double share = sum > 0.0 ? opened[j] / sum : static_cast<int>(j) == owner;
    if (!inserts) operation.removed_area += share * region.area;
    if (share > 0.0 && static_cast<int>(j) != owner) operation.with_step = owner + 1;
  }
}

// New cloth for every operation; what another operation's piece brings along is said to come with it.
void list_pieces(const Pattern& pattern, std::vector<Job>& jobs, const std::vector<PanelAlteration>& panels) {
  const auto owned = [&](int job, bool inserts) {
    std::vector<const AlteredRegion*> regions;
    for (const PanelAlteration& panel : panels)
      for (const AlteredRegion& region : inserts ? panel.insertions : panel.removals)
        if (region.operation == job) regions.push_back(&region);
    return regions;
  };
  for (std::size_t j = 0; j < jobs.size(); ++j) {
    TicketOperation& operation = jobs[j].operation;
    const bool inserts = operation.fabric != FabricNeed::None;
    const auto own = owned(static_cast<int>(j), inserts);
    if (!own.empty()) operation.with_step = 0;
    if (operation.with_step > 0 && inserts)
      operation.fabric = jobs[static_cast<std::size_t>(operation.with_step - 1)].operation.fabric;
    if (operation.kind == OperationKind::LetOut && operation.fabric == FabricNeed::NeedsFabric)
      operation.kind = OperationKind::InsertStrip;
    if (operation.fabric == FabricNeed::NeedsFabric)
      for (const AlteredRegion* region : own) operation.pieces.push_back(piece_of(pattern, *region));
  }
}

// A panel that is not altered, and its mirror image.
TicketOperation cut_anew(const Pattern& pattern, const std::vector<int>& numbers, bool own_cloth,
                         const std::vector<PanelAlteration>& panels) {
  TicketOperation operation;
  operation.kind = OperationKind::CutAnew;
  operation.fabric = own_cloth ? FabricNeed::None : FabricNeed::NeedsFabric;
  std::vector<std::string> names;
  std::set<std::string> touches;
  for (const int number : numbers) {
    const auto p = static_cast<std::size_t>(number);
    const Panel& panel = pattern.panels[p];
    for (const PanelEdge& edge : panel.edges)
      if (edge.zip) touches.insert("zip");
    for (const KeepOut& keep : panel.keep_outs) touches.insert(keep.why);
    std::vector<int> edges(panel.edges.size());
    std::iota(edges.begin(), edges.end(), 0);
    names.push_back(panel_words(panel));
    operation.sides.push_back({panel.name, std::move(edges), names.back(), 0.0});
    operation.removed_area += signed_area(panels[p].original);
    operation.pieces.push_back(
        piece_of(pattern, {panel.name, {panels[p].target, {}}, signed_area(panels[p].target), 0}));
    operation.pieces.back().quantity = panel.quantity;
  }
  operation.where = spoken_list(names);
  operation.touches.assign(touches.begin(), touches.end());
  operation.sentence = operation_sentence(operation);
  return operation;
}

// First what has the cloth, then what needs new cloth.
std::vector<TicketOperation> all_cut_anew(const Pattern& pattern, const RecutPanels& recut,
                                          const std::vector<PanelAlteration>& panels) {
  std::vector<TicketOperation> operations;
  for (const bool own_cloth : {true, false})
    for (const auto& [number, anew] : recut) {
      if (anew.in_own_cloth.has_value() != own_cloth) continue;
      const auto mirror = recut.find(anew.mirror);
      const bool together = mirror != recut.end() && mirror->second.in_own_cloth.has_value() == own_cloth;
      if (!together)
        operations.push_back(cut_anew(pattern, {number}, own_cloth, panels));
      else if (number < anew.mirror)
        operations.push_back(cut_anew(pattern, {number, anew.mirror}, own_cloth, panels));
    }
  return operations;
}

int work_order(OperationKind kind) {  // new panels, darts, widths, hems
  if (kind == OperationKind::CutAnew) return -1;
  if (kind == OperationKind::DartNew || kind == OperationKind::DartDeepen) return 0;
  return is_length(kind) ? 2 : 1;
}

}  // namespace

void read_operations(const Pattern& pattern, const PatternMesh& mesh, const TornPattern& inserting,
                     const TornPattern& removing, const AlterPatternOptions& options, const RecutPanels& recut,
                     AlterPatternResult& result) {
  const auto partners = find_seam_partners(mesh);
  std::vector<Job> jobs;
  for (TicketOperation& operation : all_cut_anew(pattern, recut, result.panels))
    jobs.push_back({nullptr, {}, std::move(operation)});
  std::vector<bool> skip(result.panels.size(), false);
  for (const auto& [p, anew] : recut) skip[static_cast<std::size_t>(p)] = true;
  for (const bool inserts : {true, false}) {
    const TornPattern& torn = inserts ? inserting : removing;
    std::vector<TearReading> readings = read_tears(pattern, torn, inserts, options, skip);
    drop_closed(result.panels, readings);
    const auto together = [&](const TearReading& a, const TearReading& b) {
      return belong_together(torn, partners, a, b);
    };
    for (const auto& numbers : group(readings, together)) {
      Job job{&torn, {}, {}};
      for (const std::size_t i : numbers) job.members.push_back(readings[i]);
      job.operation = describe(pattern, torn, job.members, options);
      jobs.push_back(std::move(job));
    }
  }
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
    return work_order(a.operation.kind) < work_order(b.operation.kind);
  });
  for (std::size_t p = 0; p < result.panels.size(); ++p)
    for (const bool inserts : {true, false})
      for (AlteredRegion& region : inserts ? result.panels[p].insertions : result.panels[p].removals)
        claim_region(jobs, static_cast<int>(p), inserts, region);
  list_pieces(pattern, jobs, result.panels);
  result.ticket.operations.clear();
  for (Job& job : jobs) {
    job.operation.sentence = operation_sentence(job.operation);
    result.ticket.operations.push_back(std::move(job.operation));
  }
}

}  // namespace toile
