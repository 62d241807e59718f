// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/search_tears.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kLeastWay = 0.004;  // m: what strain moves by less is below the accuracy of measuring    [ISO20685]
constexpr double kReach = 0.3;    // m: cloth that is longer may be strained less, so that its ends are moved no farther
constexpr double kProbe = 0.004;  // m, between the places where a line is looked at

class Search {
 public:
  Search(const Sheet& stretched, const std::vector<TearUnit>& units, const SearchTearsOptions& options,
         SheetEquations& equations, std::vector<TriedSet>& tried, std::vector<TearSet>& sets, int& trials,
         Progress* progress)
      : stretched_(stretched),
        units_(units),
        options_(options),
        equations_(equations),
        tried_(tried),
        found_(sets),
        trials_(trials),
        progress_(progress) {
    for (const TearSet& set : sets) seen_.insert(set.units);
  }

  void run(int first_unit) {
    if (found_.empty()) found_.push_back({{}, measure_stress(stretched_), {}, {}});
    if (within(found_.front())) return;
    std::vector<std::size_t> level = best_of(0);
    if (level.size() > static_cast<std::size_t>(options_.beam)) level.resize(static_cast<std::size_t>(options_.beam));
    if (std::find(level.begin(), level.end(), std::size_t{0}) == level.end()) level.push_back(0);
    for (int size = 1; size <= options_.most_units && !level.empty(); ++size) {
      const std::size_t first = found_.size();
      for (const std::size_t parent : level) enlarge(found_[parent].units, size == 1 ? first_unit : 0);
      level = best_of(first);
      // What one set reaches, larger ones need not; pairs are tried all the same, so that panels can agree.
      if (size > 1 && reached(first)) break;
      if (size > 1 && level.size() > static_cast<std::size_t>(options_.beam))
        level.resize(static_cast<std::size_t>(options_.beam));
    }
  }

 private:
  bool within(const TearSet& set) const {
    return share_of_limit(set.stress, options_.stretch_limit) < 1.0 &&
           share_of_lean(set.stress, options_.stretch_limit) < 1.0;
  }

  bool reached(std::size_t first) const {
    return std::any_of(found_.begin() + static_cast<std::ptrdiff_t>(first), found_.end(),
                       [&](const TearSet& set) { return within(set); });
  }

  // Sets from `first` on that leave too much, the best first.
  std::vector<std::size_t> best_of(std::size_t first) const {
    std::vector<std::size_t> level;
    for (std::size_t i = first; i < found_.size(); ++i)
      if (!within(found_[i])) level.push_back(i);
    std::stable_sort(level.begin(), level.end(),
                     [&](std::size_t a, std::size_t b) { return found_[a].stress.energy < found_[b].stress.energy; });
    return level;
  }

  void enlarge(std::vector<int> units, int first_unit) {
    if (static_cast<int>(units.size()) >= options_.most_units) return;
    for (int unit = first_unit; unit < static_cast<int>(units_.size()); ++unit) {
      if (std::find(units.begin(), units.end(), unit) != units.end()) continue;
      std::vector<int> more = units;
      more.push_back(unit);
      std::sort(more.begin(), more.end());
      if (seen_.insert(more).second) add_set(more);
    }
  }

  void add_set(const std::vector<int>& units) {
    ++trials_;
    std::vector<std::vector<Tear>> tears;
    for (const int unit : units) tears.push_back(units_[static_cast<std::size_t>(unit)].tears);
    auto known = std::find_if(tried_.begin(), tried_.end(), [&](const TriedSet& set) { return set.units == tears; });
    if (known == tried_.end()) known = tried_.insert(known, {tears, try_set(tears)});
    if (!known->left) return;
    found_.push_back(*known->left);
    found_.back().units = units;
  }

  // Nothing, where they cannot be made.
  std::optional<TearSet> try_set(const std::vector<std::vector<Tear>>& units) const {
    Sheet sheet = stretched_;
    std::vector<Tear> tears;
    for (const auto& own : units) tears.insert(tears.end(), own.begin(), own.end());
    const std::vector<TearOutcome> outcomes = propagate_tears(sheet, tears, options_.tear, progress_, &equations_);
    TearSet set{{}, measure_stress(sheet), {}, {}};
    std::size_t next = 0;
    for (const auto& own : units) {
      double largest = 0.0;
      for (const Tear& tear : own) {
        const TearOutcome& outcome = outcomes[next++];
        set.mouths.insert(set.mouths.end(), outcome.mouths.begin(), outcome.mouths.end());
        largest = std::max(largest, outcome.largest_gap);
        if (!worth_it(tear, outcome)) return std::nullopt;
      }
      set.largest_gaps.push_back(largest);
    }
    // Trials are relaxed only roughly; the garment's own mesh is held to the limit itself.
    if (farthest_outside(sheet) > 2.0 * kMostOutside) return std::nullopt;
    if (!options_.keep_outs.empty() && enters_keep_out(sheet, tears)) return std::nullopt;
    for (const TearMouth& mouth : set.mouths)
      if (stretched_.sides[static_cast<std::size_t>(mouth.side)].locked) return std::nullopt;
    return set;
  }

  bool worth_it(const Tear& tear, const TearOutcome& outcome) const {
    if (!outcome.opened) return false;
    return tear.kind == TearKind::Release || outcome.largest_gap >= options_.least_strip;
  }

  bool kept_out(const Vec2& a, const Vec2& b) const {
    const int steps = 1 + static_cast<int>((b - a).norm() / kProbe);
    for (int i = 0; i <= steps; ++i)
      for (const auto& polygon : options_.keep_outs)
        if (inside_polygon(polygon, a + (b - a) * i / steps)) return true;
    return false;
  }

  // Whether a cut crosses a region to keep out of, or cloth taken away at a side reaches into one.
  bool enters_keep_out(const Sheet& sheet, const std::vector<Tear>& tears) const {
    const auto original = [&](int v) -> const Vec2& {
      const SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(v)];
      return options_.removing ? vertex.now : vertex.flat;
    };
    for (const Cut& cut : sheet.cuts)
      for (std::size_t i = 0; i < cut.lips.size(); ++i) {
        if (kept_out(original(cut.lips[i].first), original(cut.lips[i].second))) return true;
        if (i > 0 && kept_out(original(cut.lips[i - 1].first), original(cut.lips[i].first))) return true;
      }
    if (!options_.removing) return false;
    for (const Tear& tear : tears)
      for (const SheetVertex& vertex : sheet.vertices) {
        const SheetAnchor* anchor = tear.kind == TearKind::Release ? vertex.anchor(tear.side) : nullptr;
        if (!anchor || anchor->attached) continue;
        const SideCurve& side = sheet.wanted_sides[static_cast<std::size_t>(tear.side)];
        if (kept_out(vertex.now, side.closest(vertex.now).point)) return true;
      }
    return false;
  }

  const Sheet& stretched_;
  const std::vector<TearUnit>& units_;
  const SearchTearsOptions& options_;
  SheetEquations& equations_;  // of all sets while only sides are let go
  std::vector<TriedSet>& tried_;
  std::vector<TearSet>& found_;
  int& trials_;
  Progress* progress_;
  std::set<std::vector<int>> seen_;
};

}  // namespace

double share_of_strain(const SheetStress& stress, double limit) {
  const double rms = stress.area > 0.0 ? std::sqrt(0.5 * stress.energy / stress.area) : 0.0;
  return std::min({stress.p95 / limit, 2.0 * rms / limit, stress.way / kLeastWay});
}

double share_of_shift(const SheetStress& stress, double limit) {
  return std::min(stress.shift / (limit * kReach), stress.way / kLeastWay);
}

double share_of_lean(const SheetStress& stress, double limit) {
  return stress.lean / (limit * kReach);
}

double share_of_limit(const SheetStress& stress, double limit) {
  return std::max(share_of_strain(stress, limit), share_of_shift(stress, limit));
}

double farthest_outside(const Sheet& sheet) {
  std::vector<Vec2> wanted;
  for (const SideCurve& side : sheet.wanted_sides)
    wanted.insert(wanted.end(), side.points().begin(), side.points().end() - 1);
  double farthest = 0.0;
  for (const BorderEdge& edge : border_edges(sheet)) {
    const Vec2& p = sheet.vertices[static_cast<std::size_t>(edge.from)].now;
    if (!inside_polygon(wanted, p)) farthest = std::max(farthest, distance_to_polygon(wanted, p));
  }
  return farthest;
}

void search_tears(const Sheet& stretched, const std::vector<TearUnit>& units, int first_unit,
                  const SearchTearsOptions& options, SheetEquations& equations, std::vector<TriedSet>& tried,
                  std::vector<TearSet>& sets, int& trials, Progress* progress) {
  Search(stretched, units, options, equations, tried, sets, trials, progress).run(first_unit);
}

}  // namespace toile
