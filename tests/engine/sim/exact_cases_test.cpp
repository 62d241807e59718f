// SPDX-License-Identifier: GPL-3.0-or-later
// Drapes with closed-form answers: cases 15 to 18 of design/method.md.
#include <numbers>

#include <gtest/gtest.h>

#include "engine/core/units.h"
#include "engine/sim/membrane.h"
#include "engine/sim/position_based.h"
#include "engine/sim/relax.h"
#include "tests/support/ledger/ledger.h"
#include "tests/support/tubes.h"

namespace toile {
namespace {

// Contact with multipliers, no thickness, no friction: the exact obstacle.
ContactOptions exact_contact() {
  ContactOptions options;
  options.thickness = 0;
  options.friction = 0;
  options.multipliers = true;
  return options;
}

RelaxOptions tight() {
  RelaxOptions options;
  options.iterations = 6000;
  options.stop_residual = 1e-5;
  return options;
}

// Several rounds, each to rest: the multipliers converge by a factor of about thirty a round.
RelaxResult relax_in_rounds(DrapeEnergy& energy, Points3 start, const RelaxOptions& options, int rounds) {
  RelaxResult result;
  for (int i = 0; i < rounds; ++i) {
    result = relax(energy, start, options, nullptr);
    start = result.nodes;
  }
  return result;
}

// Case 15. A tube 5 % too small on a cylinder becomes a regular n-gon on it: hoop 2 R sin(pi / n) n / L.
TEST(ExactDrape, TubeOnACylinderHasTheHoopStretchOfItsPolygon) {
  const double radius = 0.14, girth = 0.95 * 2 * std::numbers::pi * radius;
  for (const auto& [n, published] : {std::pair(24, 1.04963), std::pair(52, 1.05199), std::pair(74, 1.05232)}) {
    const Pattern pattern = test::tube_skirt_pattern(girth, 0.3, 0.0, 0.2);
    const PatternMesh mesh = test::structured_mesh(pattern, n / 2, 8);
    const Cloth cloth = make_cloth(pattern, mesh);
    CylinderField field(radius);
    Contact contact(cloth, field, exact_contact());
    DrapeEnergy energy(cloth, &contact, 0.0);
    const Points3 start = test::wrapped_tube(
                              pattern, mesh, [&](double y) { return radius * (1.02 + 0.05 * y); }, 0.0)
                              .nodes;
    const Points3 x = relax_in_rounds(energy, start, tight(), 12).nodes;

    const double exact = 2 * radius * std::sin(std::numbers::pi / n) * n / girth;
    EXPECT_NEAR(exact, published, 6e-6);
    double worst_hoop = 0, worst_axial = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
        const Vec2 rest = mesh.rest.row(b) - mesh.rest.row(a);
        const double ratio = (x.row(mesh.node_of_vertex[static_cast<std::size_t>(b)]) -
                              x.row(mesh.node_of_vertex[static_cast<std::size_t>(a)]))
                                 .norm() /
                             rest.norm();
        if (std::abs(rest.y()) < 1e-12) worst_hoop = std::max(worst_hoop, std::abs(ratio - exact));
        if (std::abs(rest.x()) < 1e-12) worst_axial = std::max(worst_axial, std::abs(ratio - 1));
      }
    EXPECT_LT(worst_hoop, 1e-6) << n;
    EXPECT_LT(worst_axial, 1e-3) << n;
  }
}

// Case 16. Rest radius 14 cm on R(z) = 13 + 4 exp(-((z - 30) / 8)^2) cm; the published 33.79 is in kg cm^2/s^2 at a
// stiffness of 2 kg/s^2 without shear resistance. Energy is proportional to the stiffness.
TEST(ExactDrape, TubeOnABellyHasThePublishedEnergy) {
  Pattern pattern = test::tube_skirt_pattern(2 * std::numbers::pi * 0.14, 0.6, 0.0, 0.2);
  pattern.fabric.shear_stiffness = 1e-3;
  pattern.fabric.bending_stiffness = 0;
  const PatternMesh mesh = test::structured_mesh(pattern, 26, 41);
  ASSERT_EQ(mesh.triangle_count(), 4264);
  const Cloth cloth = make_cloth(pattern, mesh);
  BellyField field(0.13, 0.04, 0.30, 0.08);
  Contact contact(cloth, field, exact_contact());
  DrapeEnergy energy(cloth, &contact, 0.0);
  const auto start = [](double y) { return std::max(0.1405, 0.13 + 0.041 * std::exp(-std::pow((y - 0.3) / 0.08, 2))); };
  RelaxOptions options = tight();
  options.stop_residual = 0.05;
  // Balanced on the belly's crest it would slip off: what is symmetric about the crest's height stays there.
  for (int v = 0; v < mesh.vertex_count(); ++v)
    if (const double height = mesh.rest(v, 1); std::abs(height - 0.3) < 0.01)
      energy.holds.push_back({mesh.node_of_vertex[static_cast<std::size_t>(v)], height, 1.0});
  const Points3 x = relax_in_rounds(energy, test::wrapped_tube(pattern, mesh, start, 0.0).nodes, options, 4).nodes;
  Points3 gradient = Points3::Zero(mesh.node_count, 3);
  const double published = 33.79e-4 * pattern.fabric.weft_stiffness / 2;
  EXPECT_NEAR(membrane_energy_gradient(cloth, x, gradient) / published, 1, 0.01);
}

// The same by the paper's averaging: 34.19 after 1000 iterations (design/method.md, section 3).
TEST(ExactDrape, AveragedTargetsReachThePublishedEnergyOfTheBelly) {
  Pattern pattern = test::tube_skirt_pattern(2 * std::numbers::pi * 0.14, 0.6, 0.0, 0.2);
  pattern.fabric.shear_stiffness = 1e-3;
  const PatternMesh mesh = test::structured_mesh(pattern, 26, 41);
  const Cloth cloth = make_cloth(pattern, mesh);
  BellyField field(0.13, 0.04, 0.30, 0.08);
  const DrapeEnergy garment(cloth, nullptr, 0.0);
  const auto start = [](double y) { return std::max(0.14, 0.13 + 0.04 * std::exp(-std::pow((y - 0.3) / 0.08, 2))); };
  PositionBasedOptions options;
  options.gravity = 0;
  const Points3 x =
      position_based(garment, field, 0.0, test::wrapped_tube(pattern, mesh, start, 0.0).nodes, options, nullptr);
  Points3 gradient = Points3::Zero(mesh.node_count, 3);
  const double published = 34.19e-4 * pattern.fabric.weft_stiffness / 2;
  EXPECT_NEAR(membrane_energy_gradient(cloth, x, gradient) / published, 1, 0.05);
}

// Case 17. A hanging sheet grows by rho g H^2 / (2 k).
TEST(ExactDrape, HangingSheetStretchesUnderItsOwnWeight) {
  Pattern pattern = test::sheet_pattern(0.2, 0.6, 1.0);
  pattern.fabric.density = 0.2;
  pattern.fabric.shear_stiffness = 0.01;
  pattern.fabric.weft_stiffness = 20;
  pattern.fabric.warp_stiffness = 20 - pattern.fabric.shear_stiffness;
  pattern.fabric.bending_stiffness = 0;
  const PatternMesh mesh = test::structured_mesh(pattern, 6, 18);
  const Cloth cloth = make_cloth(pattern, mesh);
  DrapeEnergy energy(cloth, nullptr, kGravity);
  const Points3 start = test::placed_nodes(pattern, mesh);
  for (int v : mesh.edge_vertices[0][2]) {
    const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
    energy.pins.push_back({node, start.row(node), 1e7});
  }
  const RelaxResult result = relax(energy, start, tight(), nullptr);
  const double exact = 0.2 * kGravity * 0.36 / (2 * 20);
  EXPECT_NEAR(exact, 0.017658, 1e-6);
  EXPECT_NEAR((0.4 - result.nodes.col(1).minCoeff()) / exact, 1, 1e-3);
}

// The heavy elastica: B theta'' = w (L - s) cos(theta), theta(0) = 0, theta'(L) = 0; height the tip sinks. Shooting on
// theta'(0) by bisection, fourth-order Runge-Kutta.
double elastica_sag(double bending, double weight_per_area, double length) {
  const int steps = 2000;
  const double h = length / steps;
  double sag = 0;
  const auto end_curvature = [&](double curvature) {
    double theta = 0, s = 0;
    sag = 0;
    const auto rate = [&](double at, double angle) {
      return weight_per_area * (length - at) * std::cos(angle) / -bending;
    };
    for (int i = 0; i < steps; ++i, s += h) {
      const double a1 = curvature, b1 = rate(s, theta);
      const double a2 = curvature + h / 2 * b1, b2 = rate(s + h / 2, theta + h / 2 * a1);
      const double a3 = curvature + h / 2 * b2, b3 = rate(s + h / 2, theta + h / 2 * a2);
      const double a4 = curvature + h * b3, b4 = rate(s + h, theta + h * a3);
      const double next = theta + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      sag += h * std::sin(0.5 * (theta + next));
      theta = next;
      curvature += h / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    }
    return curvature;
  };
  double low = 0, high = 1000;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (end_curvature(middle) < 0 ? low : high) = middle;
  }
  end_curvature(0.5 * (low + high));
  return sag;
}

// Case 18. A strip clamped by its first rows of nodes sags like the heavy elastica (ASTM D1388), fine or coarse. Two
// rows fix a direction at the middle between them: there the overhang begins.
TEST(ExactDrape, CantileverStripSagsLikeTheHeavyElastica) {
  for (const auto& [cell, cells] : {std::pair(0.0025, 32), std::pair(0.005, 16), std::pair(0.0025, 48)}) {
    const int clamped = 4;
    const double overhang = (cells - clamped + 0.5) * cell;
    Pattern pattern = test::sheet_pattern(cells * cell, 0.025, 1.0);
    pattern.fabric.density = 0.2;
    const PatternMesh mesh = test::structured_mesh(pattern, cells, static_cast<int>(std::lround(0.025 / cell)));
    const Cloth cloth = make_cloth(pattern, mesh);
    DrapeEnergy energy(cloth, nullptr, kGravity);
    Points3 start(mesh.node_count, 3);
    for (int v = 0; v < mesh.vertex_count(); ++v) {  // laid level
      start.row(v) << mesh.rest(v, 0), 0, mesh.rest(v, 1);
      if (mesh.rest(v, 0) < (clamped + 0.5) * cell) energy.pins.push_back({v, start.row(v), 1e5});
    }
    RelaxOptions options = tight();
    options.stop_residual = 5e-3;
    const RelaxResult result = relax(energy, start, options, nullptr);
    const double exact = elastica_sag(pattern.fabric.bending_stiffness, 0.2 * kGravity, overhang);
    EXPECT_LT(result.residual, 5e-3);
    EXPECT_NEAR(-result.nodes.col(1).minCoeff() / exact, 1, 0.02) << overhang << " m, exact sag " << exact;
  }
}

}  // namespace
}  // namespace toile
