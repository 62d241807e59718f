// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/fabric_lab.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/core/units.h"
#include "engine/sim/newton.h"
#include "engine/sim/relax.h"
#include "tests/support/tubes.h"

namespace toile::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSlope = 41.5 * kPi / 180;  // of the plane a cantilever's tip touches
constexpr double kClamp = 1e5;               // N/m, of a clamped node
constexpr double kStripWidth = 0.025;        // m, of a cantilever
constexpr int kClampedCells = 4;
// Of the triangles round a drape meter's disc against those along its radius: folds bend the cloth across the radius.
constexpr double kNarrow = 1.6;
constexpr double kInner = 0.09, kOuter = 0.15;  // m, radii of a drape meter's disc and specimen

void settle(Specimen& s, DrapeEnergy& energy, double residual, int iterations) {
  RelaxOptions first;
  first.iterations = iterations;
  first.stop_residual = residual;
  const RelaxResult near = relax(energy, s.drape.nodes, first, nullptr);
  NewtonOptions last;
  last.stop_residual = 0.01 * residual;
  last.iterations = 30;
  const NewtonResult rest = newton(energy, near.nodes, last, nullptr);
  s.drape.nodes = rest.nodes;
  s.residual = rest.residual;
}

// Angle by which the chord from the edge to the tip has fallen.
double hang(Specimen& s, const Fabric& fabric, double overhang, int cells) {
  const double cell = overhang / (cells + 0.5);  // two clamped rows fix a direction at the middle between them
  const int columns = cells + kClampedCells;
  s.pattern = sheet_pattern(columns * cell, kStripWidth, 0.0);
  s.pattern.fabric = fabric;
  s.mesh = structured_mesh(s.pattern, columns, std::max(3, static_cast<int>(std::lround(kStripWidth / cell))));
  const Cloth cloth = make_cloth(s.pattern, s.mesh);
  DrapeEnergy energy(cloth, nullptr, kGravity);
  s.drape.nodes.resize(s.mesh.node_count, 3);
  for (int v = 0; v < s.mesh.vertex_count(); ++v) {
    s.drape.nodes.row(v) << s.mesh.rest(v, 0), 0, s.mesh.rest(v, 1);
    if (s.mesh.rest(v, 0) < (kClampedCells + 0.5) * cell) energy.pins.push_back({v, s.drape.nodes.row(v), kClamp});
  }
  NewtonOptions options;
  options.stop_residual = 1e-5;
  const NewtonResult result = newton(energy, s.drape.nodes, options, nullptr);
  s.drape.nodes = result.nodes;
  s.residual = result.residual;
  double tip = 0, along = 0;
  int count = 0;
  for (int v = 0; v < s.mesh.vertex_count(); ++v)
    if (s.mesh.rest(v, 0) > (columns - 0.5) * cell)
      tip -= s.drape.nodes(v, 1), along += s.drape.nodes(v, 0) - (kClampedCells - 0.5) * cell, ++count;
  return std::atan2(tip / count, along / count);
}

struct Ring {
  double radius = 0;
  int first = 0, count = 0;
};

// Rings of nodes `spacing` apart, turned against each other by an irrational share so that no fold is favoured.
std::vector<Ring> ring_vertices(double inner, double spacing, int rings, PatternMesh& mesh) {
  std::vector<Ring> found;
  std::vector<Vec2> points;
  for (int k = 0; k < rings; ++k) {
    Ring ring{inner + k * spacing, static_cast<int>(points.size()), 0};
    ring.count = static_cast<int>(std::lround(kNarrow * 2 * kPi * ring.radius / (spacing * 2 / std::sqrt(3.0))));
    for (int i = 0; i < ring.count; ++i) {
      const double angle = 2 * kPi * (i + k * std::numbers::phi) / ring.count;
      points.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle));
    }
    found.push_back(ring);
  }
  mesh.rest.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t i = 0; i < points.size(); ++i) mesh.rest.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return found;
}

// Triangles between two rings, advancing on the ring whose next node comes first.
void zip_rings(const PatternMesh& mesh, const Ring& inner, const Ring& outer, std::vector<Eigen::Vector3i>& triangles) {
  const auto vertex = [](const Ring& ring, int i) { return ring.first + i % ring.count; };
  const auto angle = [&](int v) { return std::atan2(mesh.rest(v, 1), mesh.rest(v, 0)); };
  const double first = angle(inner.first);
  const auto from_first = [&](int v) {
    const double turn = angle(v) - first;
    return turn < 0 ? turn + 2 * kPi : turn;
  };
  int offset = 0;  // of the outer ring's node that comes first
  for (int i = 1; i < outer.count; ++i)
    if (from_first(outer.first + i) < from_first(outer.first + offset)) offset = i;
  const auto outer_angle = [&](int i) {
    return i >= outer.count ? 2 * kPi + from_first(vertex(outer, offset)) : from_first(vertex(outer, offset + i));
  };
  const auto inner_angle = [&](int i) { return i >= inner.count ? 2 * kPi : from_first(vertex(inner, i)); };
  for (int a = 0, b = 0; a < inner.count || b < outer.count;) {
    const int p = vertex(inner, a), q = vertex(outer, offset + b);
    const bool outward = a >= inner.count || (b < outer.count && outer_angle(b + 1) < inner_angle(a + 1));
    triangles.push_back(outward ? Eigen::Vector3i(p, q, vertex(outer, offset + ++b))
                                : Eigen::Vector3i(p, q, vertex(inner, ++a)));
  }
}

void finish_mesh(Specimen& s, const std::vector<Eigen::Vector3i>& triangles) {
  PatternMesh& mesh = s.mesh;
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    mesh.triangles.row(static_cast<Eigen::Index>(f)) = triangles[f].transpose();
  const auto vertices = static_cast<std::size_t>(mesh.rest.rows());
  mesh.panels = {{0, static_cast<int>(vertices), 0, static_cast<int>(triangles.size())}};
  mesh.panel_of_vertex.assign(vertices, 0);
  mesh.panel_of_triangle.assign(triangles.size(), 0);
  mesh.panel_reversed = {false};
  mesh.edge_vertices.resize(1);
  mesh.node_of_vertex.resize(vertices);
  std::iota(mesh.node_of_vertex.begin(), mesh.node_of_vertex.end(), 0);
  mesh.node_count = static_cast<int>(vertices);
  Panel panel;
  panel.name = "specimen";
  s.pattern.panels = {panel};
}

// Farthest reach of the projected cloth along every one of `rays` directions.
std::vector<double> shadow_radius(const Specimen& s, double least, int rays) {
  std::vector<double> radius(static_cast<std::size_t>(rays), least);
  for (Eigen::Index f = 0; f < s.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto at = [&](int c) {
        const int v = s.mesh.triangles(f, c % 3);
        return Vec2(s.drape.nodes(v, 0), s.drape.nodes(v, 2));
      };
      Vec2 a = at(k), b = at(k + 1);
      if (a.x() * b.y() - a.y() * b.x() < 0) std::swap(a, b);
      const double step = 2 * kPi / rays, from = std::atan2(a.y(), a.x()), to = std::atan2(b.y(), b.x());
      const int first = static_cast<int>(std::ceil(from / step));
      for (int i = first; i * step <= (to < from ? to + 2 * kPi : to); ++i) {
        const Vec2 ray(std::cos(i * step), std::sin(i * step)), along = b - a;
        const double cross = ray.x() * along.y() - ray.y() * along.x();
        if (std::abs(cross) < 1e-12) continue;
        double& r = radius[static_cast<std::size_t>(((i % rays) + rays) % rays)];
        r = std::max(r, (a.x() * along.y() - a.y() * along.x()) / cross);
      }
    }
  return radius;
}

// Maxima of the outline after smoothing over a tenth of a right angle.
int count_folds(const std::vector<double>& radius) {
  const int n = static_cast<int>(radius.size()), half = n / 72;
  std::vector<double> smooth(radius.size(), 0.0);
  for (int i = 0; i < n; ++i)
    for (int k = -half; k <= half; ++k)
      smooth[static_cast<std::size_t>(i)] += radius[static_cast<std::size_t>((i + k + n) % n)];
  int folds = 0;
  for (int i = 0; i < n; ++i) {
    const double here = smooth[static_cast<std::size_t>(i)];
    folds += here > smooth[static_cast<std::size_t>((i + n - 1) % n)] &&
             here >= smooth[static_cast<std::size_t>((i + 1) % n)];
  }
  return folds;
}

// Slope of the chord of the heavy elastica theta'' = (1 - s) cos(theta) k, k = w L^3 / B, clamped level, free at the
// tip.
double elastica_slope(double k) {
  constexpr int kSteps = 800;
  double x = 0, y = 0;
  const auto end_curvature = [&](double curvature) {
    double theta = 0, rate = curvature;
    const double h = 1.0 / kSteps;
    x = y = 0;
    for (int i = 0; i < kSteps; ++i) {  // midpoint rule, second order
      const double s = i * h, middle = theta + 0.5 * h * rate;
      const double middle_rate = rate - 0.5 * h * k * (1 - s) * std::cos(theta);
      rate -= h * k * (1 - s - 0.5 * h) * std::cos(middle);
      theta += h * middle_rate;
      x += h * std::cos(middle), y += h * std::sin(middle);
    }
    return rate;
  };
  double low = 0, high = k;
  for (int i = 0; i < 45; ++i) {
    const double middle = 0.5 * (low + high);
    (end_curvature(middle) < 0 ? low : high) = middle;
  }
  end_curvature(0.5 * (low + high));
  return std::atan2(y, x);
}

// The flat specimen of a drape meter with its rings of nodes, on the disc but for a small unevenness.
DrapeDrop drop_specimen(const Fabric& fabric, int rings, int number) {
  DrapeDrop drop;
  Specimen& s = drop.specimen;
  const double spacing = (kOuter - kInner) / (rings + 0.5);  // the clamp ends midway between the two clamped rings
  const std::vector<Ring> found = ring_vertices(kInner - 0.5 * spacing, spacing, rings + 2, s.mesh);
  std::vector<Eigen::Vector3i> triangles;
  for (std::size_t k = 0; k + 1 < found.size(); ++k) zip_rings(s.mesh, found[k], found[k + 1], triangles);
  finish_mesh(s, triangles);
  // Which specimen lies on the disc, with which face up, and how its grain lies against the mesh.
  const int piece = number / 2;
  const double face = number % 2 == 0 ? 1 : -1, turn = number * std::numbers::phi;
  s.pattern.fabric = fabric;
  s.pattern.panels[0].grainline = {Vec2::Zero(), Vec2(-std::sin(turn), std::cos(turn))};
  const Cloth cloth = make_cloth(s.pattern, s.mesh);
  DrapeEnergy energy(cloth, nullptr, kGravity);
  s.drape.nodes.resize(s.mesh.node_count, 3);
  for (int v = 0; v < s.mesh.vertex_count(); ++v) {
    const Vec2 p = s.mesh.rest.row(v);
    const double free = std::max(0.0, p.norm() - kInner - 0.6 * spacing), angle = std::atan2(p.y(), p.x()) - turn;
    double wave = 0;  // a small unevenness, the same for every mesh
    for (int k = 2; k <= 9; ++k) wave += std::cos(k * angle + 1.7 * k * k * (1 + piece));
    s.drape.nodes.row(v) << p.x(), 0.02 * face * free * wave, p.y();
    if (free == 0) energy.pins.push_back({v, s.drape.nodes.row(v), kClamp});
  }
  settle(s, energy, 0.02, 6000);
  return drop;
}

}  // namespace

double elastica_overhang_factor() {
  double low = 1, high = 30;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (elastica_slope(middle) < kSlope ? low : high) = middle;
  }
  return std::cbrt(0.5 * (low + high));
}

Cantilever cantilever(const Fabric& fabric, int cells) {
  Cantilever result;
  result.exact_overhang =
      elastica_overhang_factor() * std::cbrt(fabric.bending_stiffness / (fabric.density * kGravity));
  const double first = hang(result.specimen, fabric, result.exact_overhang, cells);
  Specimen longer;
  constexpr double kLonger = 1.03;
  const double second = hang(longer, fabric, kLonger * result.exact_overhang, cells);
  result.overhang = result.exact_overhang * (1 + (kLonger - 1) * (kSlope - first) / (second - first));
  return result;
}

DrapeDrop drape_drop(const Fabric& fabric, int rings, int number) {
  DrapeDrop drop = drop_specimen(fabric, rings, number);
  constexpr int kRays = 3600;
  const std::vector<double> radius = shadow_radius(drop.specimen, kInner, kRays);
  double area = 0;
  for (int i = 0; i < kRays; ++i) {
    const double r = radius[static_cast<std::size_t>(i)], angle = 2 * kPi * i / kRays;
    area += kPi / kRays * r * r;
    drop.shadow.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  drop.coefficient = (area / kPi - kInner * kInner) / (kOuter * kOuter - kInner * kInner);
  drop.folds = count_folds(radius);
  return drop;
}

DrapeMeter drape_meter(const Fabric& fabric, int rings, int drops) {
  DrapeMeter meter;
  double squares = 0;
  for (int k = 0; k < drops; ++k) {
    meter.drops.push_back(drape_drop(fabric, rings, k));
    const double before = meter.coefficient, coefficient = meter.drops.back().coefficient;
    meter.coefficient += (coefficient - before) / (k + 1);
    squares += (coefficient - before) * (coefficient - meter.coefficient);
  }
  meter.spread = drops > 1 ? std::sqrt(squares / (drops - 1)) : 0.0;
  return meter;
}

TensileStrip tensile_strip(const Fabric& fabric, double angle, double load) {
  constexpr double kLength = 0.2, kWidth = 0.05;  // m
  constexpr int kColumns = 10, kRows = 40;
  TensileStrip result;
  Specimen& s = result.specimen;
  s.pattern = sheet_pattern(kWidth, kLength, 0.0);
  s.pattern.fabric = fabric;
  s.pattern.panels[0].grainline = {Vec2::Zero(), Vec2(std::sin(angle), std::cos(angle))};
  s.mesh = structured_mesh(s.pattern, kColumns, kRows);
  const Cloth cloth = make_cloth(s.pattern, s.mesh);
  const Points3 flat = placed_nodes(s.pattern, s.mesh);
  const double top = flat.col(1).maxCoeff(), bottom = flat.col(1).minCoeff();
  // The lower jaw moves until the upper one feels the load.
  double low = 0, high = 3;
  for (int i = 0; i < 24; ++i) {
    const double extension = 0.5 * (low + high);
    DrapeEnergy energy(cloth, nullptr, 0.0);
    Points3 start = flat;
    start.col(1) = (top + (flat.col(1).array() - top) * (1 + extension)).matrix();
    for (int v = 0; v < s.mesh.node_count; ++v)
      if (flat(v, 1) > top - 1e-9 || flat(v, 1) < bottom + 1e-9) energy.pins.push_back({v, start.row(v), 1e7});
    NewtonOptions options;
    options.stop_residual = 1e-3;
    const NewtonResult pulled = newton(energy, start, options, nullptr);
    double force = 0;
    for (const Pin& pin : energy.pins)
      if (pin.at.y() > top - 1e-9) force += pin.stiffness * (pin.at.y() - pulled.nodes(pin.node, 1));
    (force / kWidth < load ? low : high) = extension;
    s.drape.nodes = pulled.nodes;
    s.residual = pulled.residual;
  }
  result.extension = 0.5 * (low + high);
  return result;
}

}  // namespace toile::test
