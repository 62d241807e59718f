// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/read_operations.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "engine/alter/operation_words.h"
#include "engine/alter/tear_profile.h"

namespace toile {
namespace {

constexpr double kProfileSpacing = 0.02;  // m, of the ticket's profiles
constexpr double kEqualAmount = 0.1;      // relative: left and right that differ by less are one operation

// One tear, read for itself.
struct Reading {
  bool inserts = true;
  int panel = 0;
  Tear tear;
  int job = -1;
  OperationKind kind = OperationKind::TakeIn;
  FabricNeed fabric = FabricNeed::None;
  TicketAllowance allowance;
  TearProfile profile;
  std::vector<TearMouth> mouths;
  std::string where, mirror_name;
};

// Whether a side faces up or down along the grain, so that moving it changes a length and not a girth.
bool faces_along_grain(const Sheet& sheet, int side) {
  const SideCurve& curve = sheet.cloth_sides[static_cast<std::size_t>(side)];
  return std::abs(curve.closest(curve.point(0.5 * curve.length())).normal.y()) > 0.7;
}

OperationKind released_kind(const Sheet& sheet, const Reading& reading) {
  const bool sewn = sheet.sides[static_cast<std::size_t>(reading.tear.side)].sewn;
  const bool length = !sewn && faces_along_grain(sheet, reading.tear.side);
  if (!reading.inserts) return length ? OperationKind::Shorten : OperationKind::TakeIn;
  if (length) return OperationKind::Lengthen;
  return reading.fabric == FabricNeed::WithinAllowance ? OperationKind::LetOut : OperationKind::InsertStrip;
}

OperationKind cut_kind(const Sheet& sheet, const Reading& reading) {
  const bool through = !reading.profile.shut_at_start && !reading.profile.shut_at_end;
  const bool across = std::abs(reading.tear.direction.x()) > std::abs(reading.tear.direction.y());
  if (!reading.inserts) {
    if (!through) return OperationKind::DartNew;
    return across ? OperationKind::Shorten : OperationKind::TakeIn;
  }
  if (through) return OperationKind::InsertStrip;
  return sheet.sides[static_cast<std::size_t>(reading.tear.side)].sewn ? OperationKind::InsertGusset
                                                                       : OperationKind::InsertGodet;
}

void read_allowance(const Pattern& pattern, const Sheet& sheet, const AlterPatternOptions& options, Reading& reading) {
  if (!reading.inserts) return;
  reading.fabric = FabricNeed::NeedsFabric;
  if (reading.tear.kind != TearKind::Release) return;
  reading.allowance.available =
      allowance_of(pattern, sheet.panel, sheet.sides[static_cast<std::size_t>(reading.tear.side)]);
  reading.allowance.needed = reading.profile.largest;
  reading.allowance.left = reading.allowance.available - reading.allowance.needed;
  if (reading.allowance.left >= options.least_allowance_left) reading.fabric = FabricNeed::WithinAllowance;
}

Reading read_tear(const Pattern& pattern, const Sheet& sheet, const Tear& tear, std::size_t cut, bool inserts,
                  const AlterPatternOptions& options) {
  Reading reading;
  reading.inserts = inserts;
  reading.panel = sheet.panel;
  reading.tear = tear;
  const bool release = tear.kind == TearKind::Release;
  reading.profile = release ? side_profile(sheet, tear.side) : cut_profile(sheet, sheet.cuts[cut]);
  read_allowance(pattern, sheet, options, reading);
  reading.kind = release ? released_kind(sheet, reading) : cut_kind(sheet, reading);
  const std::string side = side_words(pattern, sheet, tear.side);
  reading.where =
      release ? side : "from the " + side + " into " + pattern.panels[static_cast<std::size_t>(sheet.panel)].name;
  reading.mirror_name = without_left_right(reading.where);
  const std::vector<int>& ends = sheet.sides[static_cast<std::size_t>(tear.side)].vertices;
  if (release) {
    const int count = static_cast<int>(sheet.sides.size()), before = (tear.side + count - 1) % count;
    if (!reading.profile.shut_at_start)
      reading.mouths.push_back({before, sheet.cloth_sides[static_cast<std::size_t>(before)].length()});
    if (!reading.profile.shut_at_end) reading.mouths.push_back({(tear.side + 1) % count, 0.0});
  } else if (!ends.empty()) {
    for (const auto& lips : {sheet.cuts[cut].lips.front(), sheet.cuts[cut].lips.back()})
      for (const SheetAnchor& anchor : sheet.vertices[static_cast<std::size_t>(lips.first)].anchors)
        if (anchor.side >= 0 && lips.first != lips.second) reading.mouths.push_back({anchor.side, anchor.at});
  }
  return reading;
}

std::vector<Reading> read_pass(const Pattern& pattern, const TornPattern& torn, bool inserts,
                               const AlterPatternOptions& options) {
  std::vector<Reading> readings;
  for (std::size_t p = 0; p < torn.sheets.size(); ++p) {
    std::size_t cut = 0;  // cuts stand in the sheet in the order of its edge tears
    const std::vector<MadeTear>& tears = torn.panels[p].tears;
    for (std::size_t i = 0; i < tears.size(); ++i) {
      const std::size_t own = tears[i].tear.kind == TearKind::Edge ? cut++ : 0;
      Reading reading = read_tear(pattern, torn.sheets[p], tears[i].tear, own, inserts, options);
      reading.job = torn.jobs[p][i];
      if (reading.profile.largest > 0.0) readings.push_back(std::move(reading));
    }
  }
  return readings;
}

// Whether two readings are one job for the person who sews.
bool belong_together(const TornPattern& torn, const std::vector<std::vector<SeamPartner>>& partners, const Reading& a,
                     const Reading& b) {
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

std::vector<std::vector<std::size_t>> group(const std::vector<Reading>& readings,
                                            const std::function<bool(const Reading&, const Reading&)>& together) {
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

std::string joined_names(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : "; ") + name;
  return text;
}

void describe_taper(const Reading& reading, const std::vector<Vec2>& outline, TicketOperation& operation) {
  const TearProfile& profile = reading.profile;
  operation.profile = {kProfileSpacing, profile.sampled(kProfileSpacing)};
  const double least = *std::min_element(profile.open.begin(), profile.open.end());
  if (least > 0.8 * profile.largest) {
    operation.largest_at = "all along";
    return;
  }
  operation.largest_at = place_words(profile.middle[profile.largest_index], outline);
  if (!profile.shut_at_start && !profile.shut_at_end) return;
  const std::size_t end = profile.shut_at_end ? profile.at.size() - 1 : 0;
  std::size_t shut = end;  // the nearest place to the largest amount where nothing is open any more
  while (shut != profile.largest_index && profile.open[shut] < 1e-9)
    shut = shut > profile.largest_index ? shut - 1 : shut + 1;
  operation.tapers_to = place_words(profile.middle[shut], outline);
  operation.taper_length = std::abs(profile.at[shut] - profile.at[profile.largest_index]);
}

TicketOperation describe(const Pattern& pattern, const TornPattern& torn, const std::vector<Reading>& readings,
                         const std::vector<std::size_t>& members, const AlterPatternOptions& options) {
  TicketOperation operation;
  std::set<std::string> where, touches;
  const Reading* largest = &readings[members[0]];
  for (const std::size_t i : members) {
    const Reading& reading = readings[i];
    const Sheet& sheet = torn.sheets[static_cast<std::size_t>(reading.panel)];
    const Panel& panel = pattern.panels[static_cast<std::size_t>(reading.panel)];
    if (reading.profile.largest > largest->profile.largest) largest = &reading;
    where.insert(reading.where);
    const std::vector<int>& edges = sheet.sides[static_cast<std::size_t>(reading.tear.side)].edges;
    operation.sides.push_back({panel.name, edges, reading.where});
    operation.total += reading.profile.largest;
    for (const int edge : edges)
      if (panel.edges[static_cast<std::size_t>(edge)].zip) touches.insert("zip");
    for (const KeepOut& keep : panel.keep_outs) touches.insert(keep.why);
    if (reading.fabric == FabricNeed::NeedsFabric || operation.fabric == FabricNeed::None)
      operation.fabric = reading.fabric;
  }
  operation.kind = largest->kind;
  operation.per_ply = largest->profile.largest;
  if (operation.kind == OperationKind::Lengthen || operation.kind == OperationKind::Shorten)
    operation.total = operation.per_ply;
  operation.allowance = largest->allowance;
  operation.where = joined_names(where);
  operation.touches.assign(touches.begin(), touches.end());
  operation.below_accuracy = operation.total < options.least_change;
  const Sheet& sheet = torn.sheets[static_cast<std::size_t>(largest->panel)];
  std::vector<Vec2> outline;
  for (const SideCurve& side : sheet.wanted_sides)
    outline.insert(outline.end(), side.points().begin(), side.points().end());
  describe_taper(*largest, outline, operation);
  return operation;
}

bool inside(const PolygonWithHoles& polygon, const Vec2& p) {
  bool in = false;
  const auto& loop = polygon.outline;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++)
    if ((loop[i].y() > p.y()) != (loop[j].y() > p.y()) &&
        p.x() < loop[i].x() + (p.y() - loop[i].y()) / (loop[j].y() - loop[i].y()) * (loop[j].x() - loop[i].x()))
      in = !in;
  return in;
}

TicketPiece piece_of(const Pattern& pattern, const AlteredRegion& region) {
  Vec2 low = region.shape.outline[0], high = low;
  for (const Vec2& p : region.shape.outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  TicketPiece piece;
  piece.name = piece.label = region.name;
  piece.width = high.x() - low.x();
  piece.length = high.y() - low.y();
  piece.area = region.area;
  piece.seam_allowance = pattern.seam_allowance;
  return piece;
}

struct Job {
  std::vector<Reading> members;
  TicketOperation operation;
};

// The job that opened a region: the one whose tears lie in it along most of their way. -1: none.
int opener_of(const PolygonWithHoles& region, std::size_t panel, bool inserts, const std::vector<Job>& jobs) {
  int opener = -1;
  std::ptrdiff_t most = 0;
  for (std::size_t j = 0; j < jobs.size(); ++j)
    for (const Reading& reading : jobs[j].members) {
      if (reading.inserts != inserts || reading.panel != static_cast<int>(panel)) continue;
      const auto within = std::count_if(reading.profile.middle.begin(), reading.profile.middle.end(),
                                        [&](const Vec2& p) { return inside(region, p); });
      if (within <= most) continue;
      most = within;
      opener = static_cast<int>(j);
    }
  return opener;
}

void share_out_regions(const Pattern& pattern, std::vector<Job>& jobs, std::vector<PanelAlteration>& panels) {
  for (std::size_t p = 0; p < panels.size(); ++p)
    for (const bool inserts : {true, false})
      for (AlteredRegion& region : inserts ? panels[p].insertions : panels[p].removals) {
        region.operation = opener_of(region.shape, p, inserts, jobs);
        if (region.operation < 0) continue;
        TicketOperation& operation = jobs[static_cast<std::size_t>(region.operation)].operation;
        if (!inserts)
          operation.removed_area += region.area;
        else if (operation.fabric == FabricNeed::NeedsFabric)
          operation.pieces.push_back(piece_of(pattern, region));
      }
}

int work_order(OperationKind kind) {  // darts, then widths, then hems
  if (kind == OperationKind::DartNew || kind == OperationKind::DartDeepen) return 0;
  return kind == OperationKind::Lengthen || kind == OperationKind::Shorten ? 2 : 1;
}

}  // namespace

void read_operations(const Pattern& pattern, const PatternMesh& mesh, const TornPattern& inserting,
                     const TornPattern& removing, const AlterPatternOptions& options, AlterPatternResult& result) {
  const auto partners = find_seam_partners(mesh);
  std::vector<Job> jobs;
  for (const bool inserts : {true, false}) {
    const TornPattern& torn = inserts ? inserting : removing;
    const std::vector<Reading> readings = read_pass(pattern, torn, inserts, options);
    const auto together = [&](const Reading& a, const Reading& b) { return belong_together(torn, partners, a, b); };
    for (const auto& members : group(readings, together)) {
      Job job{{}, describe(pattern, torn, readings, members, options)};
      for (const std::size_t i : members) job.members.push_back(readings[i]);
      jobs.push_back(std::move(job));
    }
  }
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
    return work_order(a.operation.kind) < work_order(b.operation.kind);
  });
  share_out_regions(pattern, jobs, result.panels);
  for (Job& job : jobs) {
    job.operation.sentence = operation_sentence(job.operation);
    result.ticket.operations.push_back(std::move(job.operation));
  }
}

}  // namespace toile
