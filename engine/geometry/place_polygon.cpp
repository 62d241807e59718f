// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/place_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr int kGrid = 16;           // places tried across and along
constexpr double kProbes = 150;     // round the inner polygon
constexpr double kFinest = 2e-4;    // m, last step of the search
constexpr double kRounding = 1e-9;  // m: outlines that touch

struct Box {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  explicit Box(const std::vector<Vec2>& points) {
    for (const Vec2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
};

// Corners and places between them.
std::vector<Vec2> probes_of(const std::vector<Vec2>& polygon) {
  double length = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  std::vector<Vec2> probes;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / length * kProbes)));
    for (int k = 0; k < steps; ++k) probes.emplace_back(a + (b - a) * k / steps);
  }
  return probes;
}

class Placing {
 public:
  Placing(const std::vector<Vec2>& outer, const std::vector<Vec2>& probes) : outer_(outer), probes_(probes) {}

  // Takes the shift if it leaves more room than the best one so far.
  bool try_shift(const Vec2& shift) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < probes_.size() && least > room_; ++i) {
      // The probe that stuck out last comes first.
      const Vec2 p = probes_[(i + worst_) % probes_.size()] + shift;
      const double distance = distance_to_polygon(outer_, p);
      const double room = inside_polygon(outer_, p) ? distance : -distance;
      if (room >= least) continue;
      least = room;
      if (least <= room_) worst_ = (i + worst_) % probes_.size();
    }
    if (least <= room_) return false;
    room_ = least;
    best_ = shift;
    return true;
  }

  void refine(double step) {
    for (; step > kFinest; step *= 0.5) {
      bool better = true;
      while (better) {
        better = false;
        const Vec2 from = best_;
        for (const Vec2& way :
             {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1), Vec2(1, 1), Vec2(-1, 1), Vec2(1, -1), Vec2(-1, -1)})
          better = try_shift(from + step * way) || better;
      }
    }
  }

  const Vec2& best() const { return best_; }
  double room() const { return room_; }

 private:
  const std::vector<Vec2>& outer_;
  const std::vector<Vec2>& probes_;
  std::size_t worst_ = 0;
  Vec2 best_ = Vec2::Zero();
  double room_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<PolygonPlace> place_inside(const std::vector<Vec2>& outer, const std::vector<Vec2>& inner, bool turned,
                                         double clearance) {
  if (outer.size() < 3 || inner.size() < 3) return std::nullopt;
  PolygonPlace place{Vec2::Zero(), turned, 0.0};
  std::vector<Vec2> probes = probes_of(inner);
  for (Vec2& p : probes) p = place(p);
  const Box room(outer), own(probes);
  const Vec2 low = room.low - own.low, high = room.high - own.high;
  if ((high - low).minCoeff() < -kRounding) return std::nullopt;
  Placing placing(outer, probes);
  if (!turned) placing.try_shift(Vec2::Zero().cwiseMax(low).cwiseMin(high));
  for (int i = 0; i <= kGrid; ++i)
    for (int k = 0; k <= kGrid; ++k)
      placing.try_shift(low + (high - low).cwiseProduct(Vec2(i, k) / static_cast<double>(kGrid)));
  placing.refine((high - low).maxCoeff() / kGrid);
  if (placing.room() < clearance - kRounding) return std::nullopt;
  place.shift = placing.best();
  place.clearance = std::max(0.0, placing.room());
  std::vector<Vec2> placed;
  for (const Vec2& p : inner) placed.push_back(place(p));
  // A notch of the outer polygon may reach in between two probes.
  for (const Vec2& corner : outer)
    if (inside_polygon(placed, corner) && distance_to_polygon(placed, corner) > kRounding) return std::nullopt;
  return place;
}

}  // namespace toile
