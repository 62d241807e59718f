// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_reading.h"

#include <algorithm>
#include <cmath>

#include "engine/alter/operation_words.h"

namespace toile {
namespace {

constexpr double kNothing = 0.001;    // m: a tear that opens less is not worth a word
constexpr double kSameHeight = 0.01;  // m: plies that end this near to a height count there

// Whether a side faces up or down along the grain, so that moving it changes a length and not a girth.
bool faces_along_grain(const Sheet& sheet, int side) {
  const SideCurve& curve = sheet.cloth_sides[static_cast<std::size_t>(side)];
  return std::abs(curve.closest(curve.point(0.5 * curve.length())).normal.y()) > 0.7;
}

OperationKind released_kind(const Sheet& sheet, const TearReading& reading) {
  const bool sewn = sheet.sides[static_cast<std::size_t>(reading.tear.side)].sewn;
  const bool length = !sewn && faces_along_grain(sheet, reading.tear.side);
  if (!reading.inserts) return length ? OperationKind::Shorten : OperationKind::TakeIn;
  if (length) return OperationKind::Lengthen;
  return reading.fabric == FabricNeed::WithinAllowance ? OperationKind::LetOut : OperationKind::InsertStrip;
}

OperationKind cut_kind(const Sheet& sheet, const TearReading& reading) {
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

void read_allowance(const Pattern& pattern, const Sheet& sheet, const AlterPatternOptions& options,
                    TearReading& reading) {
  if (!reading.inserts) return;
  reading.fabric = FabricNeed::NeedsFabric;
  if (reading.cuts()) return;
  reading.allowance.available =
      allowance_of(pattern, sheet.panel, sheet.sides[static_cast<std::size_t>(reading.tear.side)]);
  reading.allowance.needed = reading.profile.largest;
  reading.allowance.left = reading.allowance.available - reading.allowance.needed;
  if (reading.allowance.left >= options.least_allowance_left) reading.fabric = FabricNeed::WithinAllowance;
}

void read_mouths(const Sheet& sheet, const Cut* cut, TearReading& reading) {
  const int side = reading.tear.side, count = static_cast<int>(sheet.sides.size()), before = (side + count - 1) % count;
  if (!cut) {
    if (!reading.profile.shut_at_start)
      reading.mouths.push_back({before, sheet.cloth_sides[static_cast<std::size_t>(before)].length()});
    if (!reading.profile.shut_at_end) reading.mouths.push_back({(side + 1) % count, 0.0});
    return;
  }
  for (const auto& lips : {cut->lips.front(), cut->lips.back()})
    for (const SheetAnchor& anchor : sheet.vertices[static_cast<std::size_t>(lips.first)].anchors)
      if (anchor.side >= 0 && lips.first != lips.second) reading.mouths.push_back({anchor.side, anchor.at});
}

// The side that crosses a released one at its start or end says where that is.
void read_ends(const Pattern& pattern, const Sheet& sheet, TearReading& reading) {
  std::vector<Vec2> outline;
  for (const SideCurve& side : sheet.wanted_sides)
    outline.insert(outline.end(), side.points().begin(), side.points().end());
  const int count = static_cast<int>(sheet.sides.size());
  for (const bool at_end : {false, true}) {
    const Vec2& place = at_end ? reading.profile.middle.back() : reading.profile.middle.front();
    const int beside = (reading.tear.side + (at_end ? 1 : count - 1)) % count;
    std::string& words = reading.end_words[at_end];
    if (!reading.cuts() && beside != reading.tear.side) words = edge_words(pattern, sheet, beside);
    const bool sewn = sheet.sides[static_cast<std::size_t>(reading.tear.side)].sewn;
    if (words.empty() && !reading.cuts() && (!sewn || !reading.upright)) words = "end";  // where another seam crosses
    words = words.empty() ? place_words(place, outline) : "at the " + words;
  }
}

void read_heights(const Panel& panel, TearReading& reading) {
  double low = 1e9, high = -1e9;
  for (const Vec2& p : reading.profile.middle) {
    reading.height.push_back((panel.rotation.leftCols<2>() * p + panel.translation).y());
    low = std::min(low, reading.height.back()), high = std::max(high, reading.height.back());
  }
  reading.upright = high - low > 0.5 * (reading.profile.at.back() - reading.profile.at.front());
}

TearReading read_tear(const Pattern& pattern, const Sheet& sheet, const Tear& tear, std::size_t cut, bool inserts,
                      const AlterPatternOptions& options) {
  TearReading reading;
  reading.inserts = inserts;
  reading.panel = sheet.panel;
  reading.tear = tear;
  const Panel& panel = pattern.panels[static_cast<std::size_t>(sheet.panel)];
  const Cut* own = reading.cuts() ? &sheet.cuts[cut] : nullptr;
  reading.profile = own ? cut_profile(sheet, *own) : side_profile(sheet, tear.side);
  if (reading.profile.largest <= 0.0) return reading;
  read_allowance(pattern, sheet, options, reading);
  reading.kind = own ? cut_kind(sheet, reading) : released_kind(sheet, reading);
  reading.names = side_names(pattern, sheet, tear.side);
  reading.mirror_name = without_left_right(spoken_list(reading.names) + (own ? " into " + panel.name : ""));
  read_mouths(sheet, own, reading);
  read_heights(panel, reading);
  read_ends(pattern, sheet, reading);
  return reading;
}

// How far a ply is open at a height, 0 where it does not reach.
double open_at(const TearReading& reading, double height) {
  const std::vector<double>&h = reading.height, &open = reading.profile.open;
  double most = 0.0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (std::abs(h[i] - height) < kSameHeight) most = std::max(most, open[i]);
    if (i + 1 < h.size() && (h[i] - height) * (h[i + 1] - height) < 0)
      most = std::max(most, open[i] + (height - h[i]) / (h[i + 1] - h[i]) * (open[i + 1] - open[i]));
  }
  return most;
}

bool plies_of_one_seam(const Pattern& pattern, const TornPattern& torn, const TearReading& a, const TearReading& b) {
  const auto edges = [&](const TearReading& r) -> const std::vector<int>& {
    return torn.sheets[static_cast<std::size_t>(r.panel)].sides[static_cast<std::size_t>(r.tear.side)].edges;
  };
  return std::any_of(pattern.seams.begin(), pattern.seams.end(), [&](const Seam& seam) {
    const auto has = [&](const TearReading& r, const SeamSide& side) {
      return side.panel.value == r.panel && std::find(edges(r).begin(), edges(r).end(), side.edge) != edges(r).end();
    };
    return (has(a, seam.a) && has(b, seam.b)) || (has(a, seam.b) && has(b, seam.a));
  });
}

}  // namespace

std::vector<TearReading> read_tears(const Pattern& pattern, const TornPattern& torn, bool inserts,
                                    const AlterPatternOptions& options, const std::vector<bool>& skip) {
  std::vector<TearReading> readings;
  for (std::size_t p = 0; p < torn.sheets.size(); ++p) {
    std::size_t cut = 0;  // cuts stand in the sheet in the order of its edge tears
    const std::vector<MadeTear>& tears = torn.panels[p].tears;
    for (std::size_t i = 0; i < tears.size() && !skip[p]; ++i) {
      const std::size_t own = tears[i].tear.kind == TearKind::Edge ? cut++ : 0;
      TearReading reading = read_tear(pattern, torn.sheets[p], tears[i].tear, own, inserts, options);
      reading.job = torn.jobs[p][i];
      if (reading.profile.largest > kNothing) readings.push_back(std::move(reading));
    }
  }
  return readings;
}

double total_amount(const Pattern& pattern, const TornPattern& torn, const std::vector<TearReading>& members) {
  const auto largest = std::max_element(members.begin(), members.end(), [](const TearReading& a, const TearReading& b) {
    return a.profile.largest < b.profile.largest;
  });
  const double most = largest->profile.largest;
  if (largest->kind == OperationKind::Lengthen || largest->kind == OperationKind::Shorten) return most;
  double total = most;
  if (!largest->upright) {
    for (const TearReading& other : members)
      if (&other != &*largest && !largest->cuts() && plies_of_one_seam(pattern, torn, *largest, other))
        total = std::max(total, most + other.profile.largest);
    return total;
  }
  const std::string& part = pattern.panels[static_cast<std::size_t>(largest->panel)].label;
  const auto counts = [&](const TearReading& r) {
    return r.upright && pattern.panels[static_cast<std::size_t>(r.panel)].label == part;
  };
  for (const TearReading& reading : members)
    for (const double height : counts(reading) ? reading.height : std::vector<double>()) {
      double sum = 0.0;
      for (const TearReading& other : members) sum += counts(other) ? open_at(other, height) : 0.0;
      total = std::max(total, sum);
    }
  return total;
}

}  // namespace toile
