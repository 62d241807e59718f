// SPDX-License-Identifier: GPL-3.0-or-later
// Cases 1-6 of the method: target patterns that are known exactly.
#include "engine/stages/derive_pattern.h"

#include <numbers>

#include <gtest/gtest.h>

#include "engine/stages/build_fitting_map.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

using test::grid_garment;
using test::GridGarment;
using test::GridPanel;

constexpr double kExact = 1e-8;         // m: 1e-6 cm
constexpr double kUnstructured = 2e-4;  // m: a chord is shorter than its arc, differently on every irregular triangle
constexpr double kSeam = 1e-4;          // m

using Shape = std::function<Vec3(int panel, const Vec2&)>;

Drape draped(const GridGarment& garment, const Points2& flat, const Shape& shape) {
  Drape drape;
  drape.nodes.resize(garment.mesh.node_count, 3);
  for (int v = 0; v < garment.mesh.vertex_count(); ++v)
    drape.nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
        shape(garment.mesh.panel_of_vertex[static_cast<std::size_t>(v)], flat.row(v).transpose()).transpose();
  return drape;
}

// Two panels, front and back, round a tube of radius r; their widths are half its girth in the reference pattern.
constexpr double kReferenceRadius = 0.14;
GridGarment tube(int columns, int rows, double jitter) {
  const double half_girth = std::numbers::pi * kReferenceRadius;
  return grid_garment(
      {{"front", half_girth, 0.6, columns, rows, jitter}, {"back", half_girth, 0.6, columns, rows, jitter}},
      {{0, 1, 1, 3}, {1, 1, 0, 3}});
}
Vec3 on_tube(int panel, const Vec2& p, const std::function<double(double)>& radius, double tall) {
  const double angle = p.x() / kReferenceRadius + panel * std::numbers::pi, r = radius(p.y());
  return Vec3(r * std::sin(angle), tall * p.y(), r * std::cos(angle));
}
Shape tube_shape(double radius, double tall) {
  return [=](int panel, const Vec2& p) {
    return on_tube(
        panel, p, [=](double) { return radius; }, tall);
  };
}

double largest_difference(const Points2& a, const Points2& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

// After the best rotation and translation of `a` onto `b`: for targets that have no grain to fix their turn.
double largest_difference_aligned(const Points2& a, const Points2& b) {
  const Eigen::RowVector2d mean_a = a.colwise().mean(), mean_b = b.colwise().mean();
  const Mat2 moment = (a.rowwise() - mean_a).transpose() * (b.rowwise() - mean_b);
  const double angle = std::atan2(moment(0, 1) - moment(1, 0), moment.trace());
  const Mat2 turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return largest_difference((((a.rowwise() - mean_a) * turn.transpose()).rowwise() + mean_b).eval(), b);
}

void expect_monotone(const DerivePatternResult& result) {
  ASSERT_FALSE(result.sweeps.empty());
  for (std::size_t i = 1; i < result.sweeps.size(); ++i) {
    if (result.sweeps[i].edge_weight != result.sweeps[i - 1].edge_weight) continue;
    EXPECT_LE(result.sweeps[i].energy, result.sweeps[i - 1].energy * (1 + 1e-9) + 1e-20) << "sweep " << i;
  }
}

DerivePatternResult derive(const GridGarment& garment, const Shape& reference, const Shape& target,
                           const DerivePatternOptions& options = {}) {
  const FittingMap fit = build_fitting_map(garment.mesh, draped(garment, garment.mesh.rest, reference));
  const Drape drape = draped(garment, garment.mesh.rest, target);
  DerivePatternResult result = derive_pattern(garment.pattern, garment.mesh, fit, drape, {}, options);
  expect_monotone(result);
  EXPECT_EQ(result.flipped_triangles, 0);
  return result;
}

TEST(DerivePattern, Case1GivesThePatternBackWhenTheTargetIsTheReference) {
  for (const double jitter : {0.0, 0.25}) {
    const GridGarment garment = tube(20, 20, jitter);
    const auto belly = [](int panel, const Vec2& p) {
      return on_tube(
          panel, p, [](double y) { return 0.13 + 0.04 * std::exp(-std::pow((y - 0.3) / 0.08, 2)); }, 1.0);
    };
    EXPECT_LT(largest_difference(derive(garment, belly, belly).rest, garment.mesh.rest), kExact);
  }
}

TEST(DerivePattern, Case2ScalesWithTheBody) {
  for (const double scale : {1.3, 0.8}) {
    const GridGarment garment = tube(20, 20, 0.25);
    const auto scaled = [&](int panel, const Vec2& p) { return (scale * tube_shape(0.15, 1.0)(panel, p)).eval(); };
    const DerivePatternResult result = derive(garment, tube_shape(0.15, 1.0), scaled);
    EXPECT_LT(largest_difference(result.rest, scale * garment.mesh.rest), kExact);
  }
}

TEST(DerivePattern, Case3WidensNarrowsAndLengthensATube) {
  struct Case {
    double radius, tall;
  };
  for (const Case c : {Case{0.18, 1.0}, Case{0.11, 1.0}, Case{0.14, 1.25}, Case{0.18, 1.25}})
    for (const double jitter : {0.0, 0.25}) {
      const GridGarment garment = tube(22, 30, jitter);
      const double wider = c.radius / kReferenceRadius;
      const Points2 wanted = garment.mapped([&](int, const Vec2& p) { return Vec2(wider * p.x(), c.tall * p.y()); });
      const auto reference = tube_shape(kReferenceRadius, 1.0), target = tube_shape(c.radius, c.tall);
      EXPECT_LT(largest_difference(derive(garment, reference, target).rest, wanted),
                jitter == 0.0 ? kExact : kUnstructured);
    }
}

constexpr double kNear = 0.2, kFar = 0.7;  // m, radii of the sectors
Vec2 on_sector(const Vec2& unit, double angle) {
  const double r = kFar - (kFar - kNear) * unit.y(), turn = angle * (unit.x() - 0.5);
  return Vec2(r * std::sin(turn), -r * std::cos(turn));
}
Vec3 on_cone(const Vec2& unit, double angle) {
  const double r = kFar - (kFar - kNear) * unit.y(), sine = angle / (2 * std::numbers::pi);
  const double turn = 2 * std::numbers::pi * (unit.x() - 0.5);
  return Vec3(r * sine * std::sin(turn), -r * std::sqrt(1 - sine * sine), r * sine * std::cos(turn));
}

struct Sector {
  GridGarment garment;
  Points2 unit;  // where each vertex lies in the unit square
};
Sector sector(double spacing, double angle) {
  const int columns = static_cast<int>(std::lround(kFar * angle / spacing));
  const int rows = static_cast<int>(std::lround((kFar - kNear) / spacing));
  Sector result{grid_garment({{"sector", 1.0, 1.0, columns, rows, 0.2}}), {}};
  result.unit = result.garment.mesh.rest;
  result.garment.mesh.rest = result.garment.mapped([&](int, const Vec2& p) { return on_sector(p, angle); });
  for (PanelEdge& edge : result.garment.pattern.panels[0].edges) edge.straight = false;
  return result;
}
Points2 sector_points(const Sector& s, double angle) {
  Points2 points(s.unit.rows(), 2);
  for (int v = 0; v < s.unit.rows(); ++v) points.row(v) = on_sector(s.unit.row(v).transpose(), angle);
  return points;
}

double cone_error(double spacing) {
  const Sector s = sector(spacing, 1.6);
  const auto cone = [&](double angle) {
    Drape drape;
    drape.nodes.resize(s.garment.mesh.node_count, 3);
    for (int v = 0; v < s.unit.rows(); ++v) drape.nodes.row(v) = on_cone(s.unit.row(v).transpose(), angle).transpose();
    return drape;
  };
  const FittingMap fit = build_fitting_map(s.garment.mesh, cone(1.6));
  const DerivePatternResult result = derive_pattern(s.garment.pattern, s.garment.mesh, fit, cone(2.0));
  expect_monotone(result);
  return largest_difference_aligned(result.rest, sector_points(s, 2.0));
}

TEST(DerivePattern, Case4UnrollsAWiderConeWithSecondOrder) {
  const double coarse = cone_error(0.04), fine = cone_error(0.02);
  EXPECT_LT(fine, 3e-4);
  EXPECT_GT(coarse / fine, 3.0);  // 4 in the limit
}

TEST(DerivePattern, Case5FindsASectorThroughAnAnisotropicFit) {
  const Sector s = sector(0.04, 1.6);
  const auto stretched = [&](const Points2& flat) {
    return draped(s.garment, flat, [](int, const Vec2& p) { return Vec3(1.12 * p.x(), p.y(), 0.0); });
  };
  const Points2 wanted = sector_points(s, 2.0);
  const FittingMap fit = build_fitting_map(s.garment.mesh, stretched(s.garment.mesh.rest));
  const DerivePatternResult result = derive_pattern(s.garment.pattern, s.garment.mesh, fit, stretched(wanted));
  expect_monotone(result);
  const Points2 moved = result.rest.rowwise() + (wanted.row(0) - result.rest.row(0));
  EXPECT_LT(largest_difference(moved, wanted), 1e-4);
}

TEST(DerivePattern, Case6ClosesTheSeamLengthsOnABelly) {
  const GridGarment garment = tube(22, 30, 0.2);
  // A belly in front only: the front wants longer side seams than the back.
  const auto belly = [](int panel, const Vec2& p) {
    const double angle = p.x() / kReferenceRadius + panel * std::numbers::pi;
    const double bump = 0.08 * std::exp(-std::pow((p.y() - 0.3) / 0.1, 2)) * std::max(0.0, std::sin(angle + 0.4));
    const double r = kReferenceRadius + bump;
    return Vec3(r * std::sin(angle), p.y(), r * std::cos(angle));
  };
  DerivePatternOptions open;
  open.seam_weight = 0.0;
  const double without = derive(garment, tube_shape(kReferenceRadius, 1.0), belly, open).seam_residual;
  const double with = derive(garment, tube_shape(kReferenceRadius, 1.0), belly).seam_residual;
  EXPECT_GT(without, 3 * kSeam);  // there is something to close
  EXPECT_LT(with, kSeam);
}

TEST(DerivePattern, GrainStaysAsItWasWhereTheFitDoesNotTell) {
  const GridGarment sheet = grid_garment({{"sheet", 0.4, 0.6, 8, 12, 0.0}}, {});
  const Drape flat = draped(sheet, sheet.mesh.rest, [](int, const Vec2& p) { return Vec3(p.x(), p.y(), 0.0); });
  const FittingMap fit = build_fitting_map(sheet.mesh, flat);
  const Points2 turned = sheet.mesh.rest * Eigen::Rotation2Dd(0.01).toRotationMatrix().transpose();
  const DerivePatternResult result = derive_pattern(sheet.pattern, sheet.mesh, fit, flat, {}, {}, nullptr, &turned);
  const Points2 moved = result.rest.rowwise() + (sheet.mesh.rest.row(0) - result.rest.row(0));
  EXPECT_LT(largest_difference(moved, sheet.mesh.rest), 1e-5);
}

TEST(DerivePattern, HoldsALockedPanelAndTheShapeOfALockedSide) {
  GridGarment garment = tube(20, 20, 0.2);
  garment.pattern.panels[1].locked = true;
  garment.pattern.panels[0].edges[2].locked = true;
  const Points2 rest = derive(garment, tube_shape(kReferenceRadius, 1.0), tube_shape(0.18, 1.1)).rest;
  const PanelRange& back = garment.mesh.panels[1];
  const auto rows = [&](const Points2& p) {
    return p.middleRows(back.vertex_begin, back.vertex_end - back.vertex_begin);
  };
  EXPECT_EQ((rows(rest) - rows(garment.mesh.rest)).norm(), 0.0);
  const auto& top = garment.mesh.edge_vertices[0][2];
  const auto& bottom = garment.mesh.edge_vertices[0][0];
  const auto width = [](const Points2& p, const std::vector<int>& e) {
    return (p.row(e.front()) - p.row(e.back())).norm();
  };
  EXPECT_NEAR(width(rest, top), width(garment.mesh.rest, top), kSeam);
  EXPECT_GT(width(rest, bottom), 1.1 * width(garment.mesh.rest, bottom));
}

TEST(DerivePattern, IsTheSameEveryTime) {
  const GridGarment garment = tube(20, 20, 0.2);
  const auto run = [&] { return derive(garment, tube_shape(0.14, 1.0), tube_shape(0.18, 1.1)).rest; };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace toile
