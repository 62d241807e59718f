// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/chain_seams.h"

#include <algorithm>
#include <array>

namespace toile {
namespace {

// Of every stretch of a line between two corners, in the wanted panel; 0 along a cut.
std::vector<double> wanted_lengths(const PatternMesh& mesh, const Points2& target_rest, const SeamLine& line,
                                   const std::vector<double>& corners) {
  std::vector<double> lengths(corners.empty() ? 0 : corners.size() - 1, 0.0);
  if (line.track.edge < 0) return lengths;
  const auto& vertices =
      mesh.edge_vertices[static_cast<std::size_t>(line.panel)][static_cast<std::size_t>(line.track.edge)];
  for (std::size_t k = 0; k < lengths.size(); ++k)
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const auto end = static_cast<double>(i);
      const double share = std::min(end, corners[k + 1]) - std::max(end - 1.0, corners[k]);
      lengths[k] += std::max(0.0, share) * (target_rest.row(vertices[i]) - target_rest.row(vertices[i - 1])).norm();
    }
  return lengths;
}

SeamLine line_of(const SeamSide& side) {
  return {side.panel.value, {side.edge, -1, false}};
}

}  // namespace

std::vector<int> ChainSeams::along(const SeamLine& line) const {
  const auto found = corners_.find(line);
  if (found == corners_.end() || found->second.size() < 2) return {};
  const std::vector<double>& corners = found->second;
  std::vector<int> stretches(corners.size() - 1, -1);
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    const RegionBorder& border = chains_[c].along;
    const int panel = pieces_[static_cast<std::size_t>(chains_[c].piece)].panel;
    if (border.neighbour >= 0 || SeamLine{panel, border.track} != line) continue;
    const double middle = 0.5 * (border.at_from + border.at_to);
    const auto above = std::upper_bound(corners.begin(), corners.end(), middle);
    if (above == corners.begin() || above == corners.end()) continue;
    stretches[static_cast<std::size_t>(above - corners.begin()) - 1] = static_cast<int>(c);
  }
  return stretches;
}

std::vector<ChainSeam> ChainSeams::find(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                        std::vector<std::string>& open) const {
  std::vector<ChainSeam> seams;
  const auto sew = [&](const SeamLine& a, const SeamLine& b, bool against, bool added) {
    const std::vector<int> of_a = along(a), of_b = along(b);
    if (of_a.size() != of_b.size()) {
      open.push_back("a seam of panel " + pattern.panels[static_cast<std::size_t>(a.panel)].name +
                     " stays open: its plies do not meet");
      return;
    }
    if (of_a.empty()) return;
    const std::vector<double> long_a = wanted_lengths(mesh, target_rest, a, corners_.at(a)),
                              long_b = wanted_lengths(mesh, target_rest, b, corners_.at(b));
    for (std::size_t k = 0; k < of_a.size(); ++k) {
      const std::size_t other = against ? of_b.size() - 1 - k : k;
      if (of_a[k] >= 0 && of_b[other] >= 0)
        seams.push_back({of_a[k], of_b[other], !against && !added, added, long_a[k] - long_b[other]});
    }
  };
  for (const Seam& seam : pattern.seams) sew(line_of(seam.a), line_of(seam.b), !seam.right_wrong, false);
  for (const auto& [line, corners] : corners_)
    if (line.track.cut >= 0 && line.track.left) sew(line, {line.panel, {-1, line.track.cut, false}}, false, true);
  std::map<std::array<int, 4>, int> waiting;  // panel, part, from, to
  for (std::size_t c = 0; c < chains_.size(); ++c) {
    const RegionBorder& border = chains_[c].along;
    const PieceBorder& piece = pieces_[static_cast<std::size_t>(chains_[c].piece)];
    if (border.neighbour < 0) continue;
    const auto across = waiting.find({piece.panel, border.neighbour, border.to, border.from});
    if (across == waiting.end())
      waiting[{piece.panel, piece.part, border.from, border.to}] = static_cast<int>(c);
    else
      seams.push_back({across->second, static_cast<int>(c), false, true, 0.0});
  }
  return seams;
}

}  // namespace toile
