// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sewn_borders.h"

#include <algorithm>
#include <cmath>

namespace toile {
namespace {

constexpr double kSamePlace = 1e-4;     // m: of one ply
constexpr double kLeastEdge = 3e-4;     // m: shorter chains are left out
constexpr double kSameCorner = 1.5e-3;  // m: corners of two plies nearer than this meet

struct Corner {
  double a, b;  // on either ply
};

class CornerSharing {
 public:
  CornerSharing(const Pattern& pattern, const PatternMesh& mesh, std::vector<PieceBorder>& pieces)
      : mesh_(mesh), pieces_(pieces) {
    for (const PieceBorder& piece : pieces)
      for (std::size_t k = 0; k < piece.borders.size(); ++k) {
        if (piece.vertices[k].corner) note(piece, (k + piece.borders.size() - 1) % piece.borders.size(), k);
      }
    for (auto& [line, corners] : own_) tidy(line, corners);
    for (const Seam& seam : pattern.seams)
      match({seam.a.panel.value, {seam.a.edge, -1, false}}, {seam.b.panel.value, {seam.b.edge, -1, false}},
            !seam.right_wrong);
    for (const auto& [line, corners] : std::map(own_))
      if (line.track.cut >= 0 && line.track.left) match(line, {line.panel, {-1, line.track.cut, false}}, false);
  }

  LineCorners run() {
    for (PieceBorder& piece : pieces_) add_corners(piece);
    return own_;
  }

 private:
  void note(const PieceBorder& piece, std::size_t in, std::size_t out) {
    const RegionBorder &before = piece.borders[in], &after = piece.borders[out];
    if (before.neighbour < 0) own_[{piece.panel, before.track}].push_back(before.at_to);
    if (after.neighbour < 0) own_[{piece.panel, after.track}].push_back(after.at_from);
  }

  // Length of a unit of `at` on a line: of the mesh's edges along an edge, 1 along a cut.
  double unit(const SeamLine& line) const {
    if (line.track.edge < 0) return 1.0;
    const auto& vertices = vertices_of(line);
    double length = 0.0;
    for (std::size_t i = 1; i < vertices.size(); ++i)
      length += (mesh_.rest.row(vertices[i]) - mesh_.rest.row(vertices[i - 1])).norm();
    return std::max(1e-6, length / std::max(1.0, static_cast<double>(vertices.size()) - 1.0));
  }
  const std::vector<int>& vertices_of(const SeamLine& line) const {
    return mesh_.edge_vertices[static_cast<std::size_t>(line.panel)][static_cast<std::size_t>(line.track.edge)];
  }

  void tidy(const SeamLine& line, std::vector<double>& corners) const {
    std::sort(corners.begin(), corners.end());
    const double same = kSamePlace / unit(line);
    if (line.track.edge >= 0) {
      const double end = static_cast<double>(vertices_of(line).size()) - 1.0;
      std::erase_if(corners, [&](double at) { return at < same || at > end - same; });
      corners.insert(corners.begin(), 0.0);
      corners.push_back(end);
    }
    corners.erase(std::unique(corners.begin(), corners.end(), [&](double x, double y) { return y - x < same; }),
                  corners.end());
  }

  void match(const SeamLine& a, const SeamLine& b, bool against) {
    const auto of_a = own_.find(a), of_b = own_.find(b);
    if (of_a == own_.end() || of_b == own_.end()) return;
    const double end = a.track.edge >= 0 ? static_cast<double>(vertices_of(a).size()) - 1.0 : 0.0;
    const auto other = [&](double at) { return against ? end - at : at; };
    const double same = kSameCorner / unit(a);
    std::vector<Corner> corners;
    for (const double at : of_a->second) corners.push_back({at, other(at)});
    const std::size_t own = corners.size();
    std::vector<bool> met(own, false);
    for (const double at : of_b->second) {
      std::size_t nearest = own;
      for (std::size_t i = 0; i < own; ++i)
        if (!met[i] && std::abs(corners[i].a - other(at)) < same &&
            (nearest == own || std::abs(corners[i].a - other(at)) < std::abs(corners[nearest].a - other(at))))
          nearest = i;
      if (nearest < own) {
        met[nearest] = true;
        corners[nearest].b = at;
      } else {
        corners.push_back({other(at), at});
      }
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& x, const Corner& y) { return x.a < y.a; });
    of_a->second.clear();
    of_b->second.clear();
    for (const Corner& corner : corners) {
      of_a->second.push_back(corner.a);
      of_b->second.push_back(corner.b);
    }
    std::sort(of_b->second.begin(), of_b->second.end());
  }

  void add_corners(PieceBorder& piece) const {
    for (std::size_t k = 0; k < piece.borders.size(); ++k) {
      if (piece.borders[k].neighbour >= 0) continue;
      const SeamLine line{piece.panel, piece.borders[k].track};
      const auto found = own_.find(line);
      if (found == own_.end()) continue;
      const double same = kSamePlace / unit(line);
      for (const double at : found->second) split_border(piece, k, at, same);
    }
  }

  // A corner at `at` on border `k`, if it lies there; the border's first part keeps its number.
  static void split_border(PieceBorder& piece, std::size_t k, double at, double same) {
    const RegionBorder border = piece.borders[k];
    const std::size_t next = (k + 1) % piece.vertices.size();
    if (std::abs(at - border.at_from) <= same) piece.vertices[k].corner = true;
    if (std::abs(at - border.at_to) <= same) piece.vertices[next].corner = true;
    const double t = (at - border.at_from) / (border.at_to - border.at_from);
    if (std::abs(at - border.at_from) <= same || std::abs(at - border.at_to) <= same || !(t > 0 && t < 1)) return;
    const BorderVertex &a = piece.vertices[k], &b = piece.vertices[next];
    const BorderVertex middle{-1, (1 - t) * a.target + t * b.target, (1 - t) * a.rest + t * b.rest, true};
    RegionBorder first = border, second = border;
    first.to = second.from = -1;
    first.at_to = second.at_from = at;
    piece.borders[k] = first;
    piece.borders.insert(piece.borders.begin() + static_cast<std::ptrdiff_t>(k) + 1, second);
    piece.vertices.insert(piece.vertices.begin() + static_cast<std::ptrdiff_t>(k) + 1, middle);
  }

  const PatternMesh& mesh_;
  std::vector<PieceBorder>& pieces_;
  LineCorners own_;
};

}  // namespace

LineCorners share_corners(const Pattern& pattern, const PatternMesh& mesh, std::vector<PieceBorder>& pieces) {
  return CornerSharing(pattern, mesh, pieces).run();
}

double chain_length(const PieceBorder& piece, const BorderChain& chain) {
  double length = 0.0;
  for (std::size_t k = 1; k < chain.vertices.size(); ++k)
    length += (piece.vertices[static_cast<std::size_t>(chain.vertices[k])].rest -
               piece.vertices[static_cast<std::size_t>(chain.vertices[k - 1])].rest)
                  .norm();
  return length;
}

std::vector<BorderChain> border_chains(const std::vector<PieceBorder>& pieces) {
  std::vector<BorderChain> chains;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const PieceBorder& piece = pieces[p];
    const std::size_t count = piece.vertices.size();
    std::size_t first = 0;
    while (first < count && !piece.vertices[first].corner) ++first;
    first %= count;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = (first + k) % count, next = (at + 1) % count;
      if (k == 0 || piece.vertices[at].corner)
        chains.push_back({static_cast<int>(p), {static_cast<int>(at)}, piece.borders[at]});
      BorderChain& chain = chains.back();
      chain.vertices.push_back(static_cast<int>(next));
      chain.along.to = piece.borders[at].to;
      chain.along.at_to = piece.borders[at].at_to;
    }
  }
  std::erase_if(chains, [&](const BorderChain& chain) {
    return chain_length(pieces[static_cast<std::size_t>(chain.piece)], chain) < kLeastEdge;
  });
  return chains;
}

}  // namespace toile
