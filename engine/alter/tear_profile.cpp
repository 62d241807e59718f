// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/tear_profile.h"

#include <algorithm>

#include "engine/alter/cut_sheet.h"

namespace toile {
namespace {

constexpr double kShut = 0.003;  // m: an end less open than this ends in nothing

void conclude(TearProfile& profile) {
  if (profile.open.empty()) return;
  const auto most = std::max_element(profile.open.begin(), profile.open.end());
  profile.largest = *most;
  profile.largest_index = static_cast<std::size_t>(most - profile.open.begin());
  profile.shut_at_start = profile.open.front() < kShut;
  profile.shut_at_end = profile.open.back() < kShut;
}

}  // namespace

std::vector<double> TearProfile::sampled(double spacing) const {
  std::vector<double> samples;
  if (at.empty()) return samples;
  std::size_t i = 0;
  for (double s = at.front(); s < at.back(); s += spacing) {
    while (i + 2 < at.size() && at[i + 1] < s) ++i;
    const double t =
        i + 1 < at.size() && at[i + 1] > at[i] ? std::clamp((s - at[i]) / (at[i + 1] - at[i]), 0.0, 1.0) : 0.0;
    samples.push_back((1 - t) * open[i] + t * open[std::min(i + 1, open.size() - 1)]);
  }
  samples.push_back(open.back());
  return samples;
}

TearProfile side_profile(const Sheet& sheet, int side) {
  std::vector<std::pair<double, int>> along;
  for (int v = 0; v < sheet.vertex_count(); ++v)
    if (const SheetAnchor* anchor = sheet.vertices[static_cast<std::size_t>(v)].anchor(side))
      along.emplace_back(anchor->at, v);
  std::sort(along.begin(), along.end());
  TearProfile profile;
  for (const auto& [at, v] : along) {
    const SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(v)];
    const double open = vertex.anchor(side)->attached ? 0.0 : std::max(0.0, gap_to_side(sheet, v, side));
    const Vec2 foot = sheet.wanted_sides[static_cast<std::size_t>(side)].closest(vertex.now).point;
    profile.at.push_back(at);
    profile.open.push_back(open);
    profile.middle.push_back(0.5 * (vertex.now + foot));
  }
  conclude(profile);
  return profile;
}

TearProfile cut_profile(const Sheet& sheet, const Cut& cut) {
  TearProfile profile;
  for (std::size_t i = 0; i < cut.lips.size(); ++i) {
    const SheetVertex &left = sheet.vertices[static_cast<std::size_t>(cut.lips[i].first)],
                      &right = sheet.vertices[static_cast<std::size_t>(cut.lips[i].second)];
    const Vec2& start = sheet.vertices[static_cast<std::size_t>(cut.lips.front().first)].flat;
    profile.at.push_back((left.flat - start).norm());
    profile.open.push_back(gap(sheet, cut, i));
    profile.middle.push_back(0.5 * (left.now + right.now));
  }
  conclude(profile);
  return profile;
}

}  // namespace toile
