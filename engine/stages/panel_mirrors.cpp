// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/panel_mirrors.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/curve.h"
#include "engine/geometry/fit_reflection.h"

namespace toile {

namespace {

constexpr double kTolerance = 1e-6;  // m
constexpr int kMostEdges = 200;      // finer polylines are not searched: the search is quadratic in the edges
const std::vector<double> kProbes = {0.0, 0.25, 0.5, 0.75};  // of an edge's arc length; its end is the next one's start

struct Outline {
  std::vector<double> lengths;
  std::vector<std::vector<Vec2>> probes;  // per edge, at kProbes
  double area = 0.0;

  explicit Outline(const Panel& panel) : area(outline_signed_area(panel)) {
    for (int e = 0; e < panel.edge_count(); ++e) {
      lengths.push_back(edge_length(panel, e));
      probes.push_back(curve_points_at(edge_curve(panel, e), kProbes));
    }
  }
  int size() const { return static_cast<int>(lengths.size()); }
};

// The probe of `to` that mirrors probe k of edge e, when edge e of the other mirrors edge `image`.
const Vec2& image_probe(const Outline& to, int image, std::size_t k) {
  const int n = to.size();
  if (k == 0) return to.probes[static_cast<std::size_t>((image + 1) % n)][0];
  return to.probes[static_cast<std::size_t>(image)][kProbes.size() - k];
}

// The best reflection of `from` onto `to` with edge e onto edge (shift - e), if it fits.
std::optional<PanelMirror> fit(const Outline& from, const Outline& to, int shift) {
  const int n = from.size();
  const auto image = [&](int e) { return ((shift - e) % n + n) % n; };
  for (int e = 0; e < n; ++e)
    if (std::abs(from.lengths[static_cast<std::size_t>(e)] - to.lengths[static_cast<std::size_t>(image(e))]) >
        kTolerance)
      return std::nullopt;
  std::vector<std::pair<Vec2, Vec2>> pairs;
  Vec2 from_centre = Vec2::Zero(), to_centre = Vec2::Zero();
  for (int e = 0; e < n; ++e)
    for (std::size_t k = 0; k < kProbes.size(); ++k) {
      pairs.emplace_back(from.probes[static_cast<std::size_t>(e)][k], image_probe(to, image(e), k));
      from_centre += pairs.back().first, to_centre += pairs.back().second;
    }
  from_centre /= static_cast<double>(pairs.size()), to_centre /= static_cast<double>(pairs.size());
  const auto reflection = fit_reflection(pairs, from_centre, to_centre);
  if (!reflection) return std::nullopt;
  PanelMirror mirror;
  mirror.reflection = *reflection;
  mirror.offset = to_centre - mirror.reflection * from_centre;
  for (const auto& [p, q] : pairs)
    if ((mirror.reflection * p + mirror.offset - q).norm() > kTolerance) return std::nullopt;
  for (int e = 0; e < n; ++e) mirror.edge_of.push_back(image(e));
  return mirror;
}

std::optional<PanelMirror> find_mirror(const Outline& from, const Outline& to) {
  if (from.size() != to.size() || from.size() > kMostEdges) return std::nullopt;
  double perimeter = 0.0;
  for (const double length : from.lengths) perimeter += length;
  if (std::abs(std::abs(from.area) - std::abs(to.area)) > kTolerance * perimeter) return std::nullopt;
  std::optional<PanelMirror> best;
  for (int shift = 0; shift < from.size(); ++shift) {
    auto found = fit(from, to, shift);
    // reflection(0, 0) is -1 for x -> -x, the usual way that left and right are drawn.
    if (found && (!best || found->reflection(0, 0) < best->reflection(0, 0) - 1e-9)) best = std::move(found);
  }
  return best;
}

Vec3 placed_centre(const Panel& panel) {
  Vec2 centre = Vec2::Zero();
  for (const Vec2& corner : panel.corners) centre += corner / static_cast<double>(panel.corners.size());
  return panel.rotation * Vec3(centre.x(), centre.y(), 0) + panel.translation;
}

}  // namespace

PanelMirrors find_panel_mirrors(const Pattern& pattern) {
  std::vector<Outline> outlines;
  std::vector<Vec3> centres;
  for (const Panel& panel : pattern.panels) {
    outlines.emplace_back(panel);
    centres.push_back(placed_centre(panel));
  }
  PanelMirrors mirrors;
  mirrors.self.resize(outlines.size());
  mirrors.pairs.resize(outlines.size());
  const auto add_source = [](std::optional<PanelMirror> mirror, std::size_t source) {
    if (mirror) mirror->source = PanelId(static_cast<int>(source));
    return mirror;
  };
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    mirrors.self[i] = add_source(find_mirror(outlines[i], outlines[i]), i);
    for (std::size_t j = 0; j < i; ++j)
      if (auto mirror = add_source(find_mirror(outlines[j], outlines[i]), j))
        mirrors.pairs[i].push_back(std::move(*mirror));
    const auto mismatch = [&](const PanelMirror& mirror) {
      const Vec3& c = centres[static_cast<std::size_t>(mirror.source.value)];
      return (Vec3(-c.x(), c.y(), c.z()) - centres[i]).norm();
    };
    std::stable_sort(mirrors.pairs[i].begin(), mirrors.pairs[i].end(),
                     [&](const PanelMirror& a, const PanelMirror& b) { return mismatch(a) < mismatch(b); });
  }
  return mirrors;
}

}  // namespace toile
