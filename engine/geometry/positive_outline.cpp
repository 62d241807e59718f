// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/positive_outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "engine/geometry/flat_vectors.h"
#include "engine/geometry/offset_polygon.h"

namespace toile {
namespace {

// Parameters along each segment at which another segment crosses or touches it.
using Cuts = std::vector<std::vector<double>>;

class CrossingFinder {
 public:
  CrossingFinder(const std::vector<Vec2>& curve, double touch) : curve_(curve), touch_(touch), cuts_(curve.size()) {}

  // Sweeps over segments sorted by their left end.
  Cuts find() {
    const std::size_t n = curve_.size();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return std::pair(left(a), a) < std::pair(left(b), b); });
    std::vector<std::size_t> open;
    for (const std::size_t i : order) {
      std::erase_if(open, [&](std::size_t j) { return right(j) < left(i) - touch_; });
      for (const std::size_t j : open)
        if (!neighbours(i, j)) cross_pair(i, j);
      open.push_back(i);
    }
    return std::move(cuts_);
  }

 private:
  const Vec2& start(std::size_t i) const { return curve_[i]; }
  const Vec2& end(std::size_t i) const { return curve_[(i + 1) % curve_.size()]; }
  double left(std::size_t i) const { return std::min(start(i).x(), end(i).x()); }
  double right(std::size_t i) const { return std::max(start(i).x(), end(i).x()); }
  bool neighbours(std::size_t i, std::size_t j) const {
    const std::size_t n = curve_.size();
    return (i + 1) % n == j || (j + 1) % n == i;
  }

  void cross_pair(std::size_t i, std::size_t j) {
    const Vec2 d = end(i) - start(i), e = end(j) - start(j), offset = start(j) - start(i);
    const double area = cross(d, e), li = d.norm(), lj = e.norm();
    if (li <= 0 || lj <= 0) return;
    if (std::abs(area) > 1e-12 * li * lj) {
      const double s = cross(offset, e) / area, t = cross(offset, d) / area;
      if (s >= -touch_ / li && s <= 1 + touch_ / li && t >= -touch_ / lj && t <= 1 + touch_ / lj) add(i, s), add(j, t);
      return;
    }
    if (std::abs(cross(offset, d)) > touch_ * li) return;
    // On one line: each is cut where the other ends.
    add(i, offset.dot(d) / (li * li)), add(i, (offset + e).dot(d) / (li * li));
    add(j, -offset.dot(e) / (lj * lj)), add(j, (d - offset).dot(e) / (lj * lj));
  }
  void add(std::size_t i, double s) {
    if (s > 0 && s < 1) cuts_[i].push_back(s);
  }

  const std::vector<Vec2>& curve_;
  double touch_;
  Cuts cuts_;
};

// How often `curve` runs round `point` counter-clockwise.
int winding_number(const std::vector<Vec2>& curve, const Vec2& point) {
  int winding = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 &a = curve[i], &b = curve[(i + 1) % curve.size()];
    if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
    const double side = cross(b - a, point - a);
    if (b.y() > a.y() && side > 0) ++winding;
    if (b.y() < a.y() && side < 0) --winding;
  }
  return winding;
}

struct Piece {
  Vec2 start, end;
};

// Parts of the curve between crossings that have the positive region on their left and not on their right.
std::vector<Piece> boundary_pieces(const std::vector<Vec2>& curve, Cuts cuts, double step) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 &a = curve[i], &b = curve[(i + 1) % curve.size()];
    if ((b - a).norm() <= 0) continue;
    const Vec2 left = step * Vec2(-(b - a).y(), (b - a).x()).normalized();
    std::sort(cuts[i].begin(), cuts[i].end());
    cuts[i].push_back(1.0);
    double from = 0.0;
    for (const double to : cuts[i]) {
      if ((to - from) * (b - a).norm() <= step) continue;
      const Vec2 middle = a + 0.5 * (from + to) * (b - a);
      if (winding_number(curve, middle + left) > 0 && winding_number(curve, middle - left) <= 0)
        pieces.push_back({a + from * (b - a), to < 1.0 ? Vec2(a + to * (b - a)) : b});
      from = to;
    }
  }
  return pieces;
}

// Pieces joined end to start into closed loops; the nearest start within `reach` continues a loop.
std::vector<std::vector<Vec2>> chain(const std::vector<Piece>& pieces, double reach) {
  std::vector<std::vector<Vec2>> loops;
  std::vector<bool> used(pieces.size(), false);
  for (std::size_t first = 0; first < pieces.size(); ++first) {
    if (used[first]) continue;
    std::vector<Vec2> loop;
    std::size_t current = first;
    while (true) {
      used[current] = true;
      loop.push_back(pieces[current].start);
      if ((pieces[current].end - pieces[first].start).norm() <= reach) {
        if (loop.size() >= 3) loops.push_back(loop);
        break;
      }
      std::size_t next = pieces.size();
      double nearest = reach;
      for (std::size_t step = 1; step < pieces.size(); ++step) {
        const std::size_t j = (current + step) % pieces.size();
        const double distance = used[j] ? reach + 1 : (pieces[j].start - pieces[current].end).norm();
        if (distance <= nearest) {
          nearest = distance, next = j;
          if (distance == 0) break;
        }
      }
      if (next == pieces.size()) break;
      current = next;
    }
  }
  return loops;
}

}  // namespace

std::vector<Vec2> positive_outline(const std::vector<Vec2>& curve) {
  if (curve.size() < 3) return curve;
  Vec2 low = curve[0], high = curve[0];
  for (const Vec2& p : curve) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double extent = (high - low).norm();
  const Cuts cuts = CrossingFinder(curve, 1e-9 * extent).find();
  const bool crosses = std::any_of(cuts.begin(), cuts.end(), [](const auto& c) { return !c.empty(); });
  if (!crosses && polygon_area(curve) > 0) return curve;
  const auto loops = chain(boundary_pieces(curve, cuts, 1e-8 * extent), 1e-6 * extent);
  const std::vector<Vec2>* best = &curve;
  double largest = 0.0;
  for (const auto& loop : loops)
    if (polygon_area(loop) > largest) largest = polygon_area(loop), best = &loop;
  return *best;
}

}  // namespace toile
