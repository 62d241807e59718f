// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/cloth_contact.h"

#include <numbers>

#include "engine/core/units.h"
#include "engine/sim/relax.h"
#include "engine/stages/drape_quality.h"
#include "tests/engine/sim/finite_difference.h"
#include "tests/support/grid_garment.h"

namespace toile {
namespace {

class FloorField : public SignedField {
 public:
  double evaluate(const Vec3& p, double, Vec3& gradient) override {
    gradient = Vec3::UnitY();
    return p.y();
  }
};

enum class Between { All, Panels };

int crossings(const PatternMesh& mesh, const Points3& nodes, Between between = Between::All) {
  Triangles sewn(mesh.triangle_count(), 3);
  for (int f = 0; f < mesh.triangle_count(); ++f) sewn.row(f) = mesh.nodes_of_triangle(f).transpose();
  int count = 0;
  for (const auto& [f, g] : crossing_pairs(nodes, sewn))
    count += between == Between::All ||
             mesh.panel_of_triangle[static_cast<std::size_t>(f)] != mesh.panel_of_triangle[static_cast<std::size_t>(g)];
  return count;
}

// Two square sheets above each other, the upper one turned a little so that no edges are parallel.
struct TwoSheets {
  test::GridGarment garment = test::grid_garment({{"lower", 0.2, 0.2, 10, 10, 0.0}, {"upper", 0.2, 0.2, 10, 10, 0.2}});
  Cloth cloth = make_cloth(garment.pattern, garment.mesh);

  Points3 apart(double gap) const {
    Points3 nodes(garment.mesh.node_count, 3);
    for (int v = 0; v < garment.mesh.vertex_count(); ++v) {
      const bool upper = garment.mesh.panel_of_vertex[static_cast<std::size_t>(v)] == 1;
      const double x = garment.mesh.rest(v, 0) - 0.1, z = garment.mesh.rest(v, 1) - 0.1, turn = upper ? 0.3 : 0.0;
      nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
          Vec3(std::cos(turn) * x - std::sin(turn) * z, upper ? gap : 0, std::sin(turn) * x + std::cos(turn) * z);
    }
    return nodes;
  }
};

test::EnergyFunction energy_of(const ClothContact& contact) {
  return [&contact](const Points3& x, Points3& g) {
    g.setZero();
    return contact.pairs().energy_gradient(x, g);
  };
}

TEST(ClothContact, GradientIsTheDerivativeForNearAndForTouchingLayers) {
  const TwoSheets s;
  for (double gap : {0.0012, 0.0003}) {
    ClothContact contact(s.cloth, s.garment.mesh, {});
    const Points3 nodes = s.apart(gap);
    contact.refresh(nodes);
    EXPECT_EQ(contact.piercings(), 0);
    ASSERT_GT(contact.planes(), 100);
    test::expect_gradient(energy_of(contact), nodes + test::random_points(s.garment.mesh.node_count, 1e-4, 3), 1e-8,
                          1e-5);
  }
}

TEST(ClothContact, LookingForPairsAnewDoesNotChangeTheEnergyOfLayersThatDoNotPierce) {
  const TwoSheets s;
  ClothContact contact(s.cloth, s.garment.mesh, {});
  const Points3 nodes = s.apart(0.0012);
  contact.refresh(nodes);
  Points3 moved = nodes + test::random_points(s.garment.mesh.node_count, 1e-3, 5), before = nodes, after = nodes;
  contact.limit(nodes, moved);
  ASSERT_GT((moved - nodes).norm(), 1e-3);
  const double energy = energy_of(contact)(moved, before);
  contact.refresh(moved);
  ASSERT_GT(energy, 0);
  EXPECT_NEAR(energy_of(contact)(moved, after), energy, 1e-3 * energy);
  EXPECT_LT((after - before).norm(), 1e-3 * before.norm());
}

TEST(ClothContact, GradientIsTheDerivativeWherePiercedClothIsDrawnApart) {
  const TwoSheets s;
  ClothContact contact(s.cloth, s.garment.mesh, {});
  Points3 nodes = s.apart(0.002);
  nodes(60, 1) = 0.004;  // a lower node through the upper sheet
  contact.refresh(nodes);
  ASSERT_GT(contact.piercings(), 0);
  test::expect_gradient(energy_of(contact), nodes, 1e-8, 1e-5);
}

TEST(ClothContact, TangleIsTheShareOfPiercings) {
  const TwoSheets sheets;
  ClothContact contact(sheets.cloth, sheets.garment.mesh, {});
  Points3 nodes = sheets.apart(0.01);
  contact.refresh(nodes);
  EXPECT_EQ(contact.tangle(), 0.0);
  const Points3 lower = nodes;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i)  // the upper one turned upright, through the lower one
    if (lower(i, 1) > 0) nodes.row(i) << lower(i, 0), lower(i, 2) + 0.0013, 0.0017;
  contact.refresh(nodes);
  ASSERT_GT(contact.piercings(), 5);
  EXPECT_DOUBLE_EQ(contact.tangle(), contact.piercings() / 400.0);
}

TEST(ClothContact, HessianIsTheDerivativeOfTheGradient) {
  const TwoSheets s;
  ClothContact contact(s.cloth, s.garment.mesh, {});
  Points3 nodes = s.apart(0.0012);
  nodes(60, 1) = 0.004;
  contact.refresh(nodes);
  contact.hold(nodes);
  BlockHessian hessian(s.cloth);
  hessian.set_zero();
  contact.pairs().add_hessian(nodes, hessian);
  const double step = 1e-8;
  const Points3 along = test::random_points(s.garment.mesh.node_count, 1, 21);
  Points3 forward = Points3::Zero(nodes.rows(), 3), back = forward;
  contact.pairs().energy_gradient(nodes + step * along, forward);
  contact.pairs().energy_gradient(nodes - step * along, back);
  const Points3 product = hessian.times(along);
  ASSERT_GT(product.norm(), 1);
  EXPECT_LT((product - (forward - back) / (2 * step)).norm(), 1e-3 * product.norm());
}

TEST(ClothContact, LayersFurtherApartThanTheThicknessAreLeftAlone) {
  const TwoSheets s;
  ClothContact contact(s.cloth, s.garment.mesh, {});
  const Points3 nodes = s.apart(0.0016);
  contact.refresh(nodes);
  Points3 gradient = Points3::Zero(nodes.rows(), 3);
  EXPECT_EQ(contact.pairs().energy_gradient(nodes, gradient), 0);
  contact.refresh(s.apart(0.1));
  EXPECT_LT(contact.planes(), 10);
}

TEST(ClothContact, PressureBetweenLayersIsThatOfTheProfileWhateverTheMesh) {
  const TwoSheets s;
  const ClothContactOptions options;
  ClothContact contact(s.cloth, s.garment.mesh, options);
  const double gap = 0.0010, d = options.thickness;
  const Points3 nodes = s.apart(gap);
  contact.refresh(nodes);
  Points3 gradient = Points3::Zero(nodes.rows(), 3);
  contact.pairs().energy_gradient(nodes, gradient);
  const double force = gradient.topRows(121).col(1).sum();  // on the lower sheet
  const double pressure = options.stiffness * d * (d - gap) / gap;
  const double shared_area = 0.035;
  EXPECT_GT(force, 0.9 * pressure * shared_area);
  EXPECT_LT(force, 1.5 * pressure * shared_area);  // near the rims of triangles the pairs of both sides count
}

// However far the sheets are thrown through each other, what the limit leaves of the move does not let them cross.
TEST(ClothContact, NoMoveWithinTheLimitCrossesLayers) {
  const TwoSheets s;
  ClothContact contact(s.cloth, s.garment.mesh, {});
  Points3 nodes = s.apart(0.001);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> throw_by(-0.05, 0.05);
  double furthest = 0;
  for (int k = 0; k < 60; ++k) {
    contact.refresh(nodes);
    const Vec3 by(throw_by(random), throw_by(random), throw_by(random)), bend(throw_by(random), throw_by(random), 0);
    Points3 moved = nodes;
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
      const double sign = i < 121 ? 1 : -1, wave = std::sin(20 * (nodes(i, 0) + by.x())) * 0.1 * bend.x();
      moved.row(i) += sign * (by + Vec3(0, 0.02 + wave, 0)).transpose();
    }
    contact.limit(nodes, moved);
    furthest = std::max(furthest, (moved - nodes).rowwise().norm().maxCoeff());
    nodes = moved;
    ASSERT_EQ(crossings(s.garment.mesh, nodes, Between::Panels), 0) << k;
  }
  EXPECT_GT(furthest, 0.005);
}

TEST(ClothContact, PiercedSheetsComeApartAtRest) {
  const TwoSheets s;
  ClothContact contact(s.cloth, s.garment.mesh, {});
  Points3 nodes = s.apart(0.003);
  for (int n : {48, 49, 59, 60, 61}) nodes(n, 1) = 0.006;
  ASSERT_GT(crossings(s.garment.mesh, nodes), 0);
  DrapeEnergy energy(s.cloth, nullptr, 0);
  energy.cloth_contact = &contact;
  RelaxOptions options;
  options.iterations = 400;
  options.stop_residual = 1e-3;
  EXPECT_EQ(crossings(s.garment.mesh, relax(energy, nodes, options, nullptr).nodes), 0);
}

// A sheet in a Z of three layers, a few millimetres apart, dropped on a floor.
struct Pleat {
  static constexpr double kRadius = 0.005, kFlat = 0.11, kTurn = std::numbers::pi * kRadius;
  test::GridGarment garment = test::grid_garment({{"sheet", 3 * kFlat + 2 * kTurn, 0.3, 50, 50, 0.25}});
  Cloth cloth = make_cloth(garment.pattern, garment.mesh);

  Vec3 folded(double s, double z) const {
    if (s < kFlat) return {s, 0.004, z};
    if (s < kFlat + kTurn) {
      const double a = (s - kFlat) / kRadius;
      return {kFlat + kRadius * std::sin(a), 0.004 + kRadius * (1 - std::cos(a)), z};
    }
    if (s < 2 * kFlat + kTurn) return {2 * kFlat + kTurn - s, 0.004 + 2 * kRadius, z};
    if (s < 2 * kFlat + 2 * kTurn) {
      const double a = (s - 2 * kFlat - kTurn) / kRadius;
      return {-kRadius * std::sin(a), 0.004 + kRadius * (3 - std::cos(a)), z};
    }
    return {s - 2 * kFlat - 2 * kTurn, 0.004 + 4 * kRadius, z};
  }
  Points3 start() const {
    Points3 nodes(garment.mesh.node_count, 3);
    for (int v = 0; v < garment.mesh.vertex_count(); ++v)
      nodes.row(garment.mesh.node_of_vertex[static_cast<std::size_t>(v)]) =
          folded(garment.mesh.rest(v, 0), garment.mesh.rest(v, 1));
    return nodes;
  }
};

TEST(SlowClothContact, PleatOfThreeLayersComesToRestWithoutCrossing) {
  const Pleat pleat;
  ASSERT_EQ(pleat.garment.mesh.triangle_count(), 5000);
  ASSERT_EQ(crossings(pleat.garment.mesh, pleat.start()), 0);
  for (bool on : {true, false}) {
    FloorField floor;
    Contact contact(pleat.cloth, floor, {});
    ClothContact layers(pleat.cloth, pleat.garment.mesh, {});
    DrapeEnergy energy(pleat.cloth, &contact, kGravity);
    if (on) energy.cloth_contact = &layers;
    RelaxOptions options;
    options.iterations = 600;
    const RelaxResult result = relax(energy, pleat.start(), options, nullptr);
    const int crossed = crossings(pleat.garment.mesh, result.nodes);
    EXPECT_EQ(crossed == 0, on) << crossed;
    EXPECT_LT(result.nodes.col(1).mean(), 0.011);  // from 0.014: it has come down
  }
}

// A tube round a body, and a sleeve 10 cm wide drawn to 6 cm from it by its outer line.
TEST(SlowClothContact, SleevePressedAgainstTheSideDoesNotPassThroughIt) {
  const double torso = 0.15, sleeve = 0.05;
  test::GridGarment garment = test::grid_garment({{"torso", 2 * std::numbers::pi * torso, 0.3, 48, 26, 0.2},
                                                  {"sleeve", 2 * std::numbers::pi * sleeve, 0.3, 32, 39, 0.2}},
                                                 {{0, 1, 0, 3}, {1, 1, 1, 3}});
  const PatternMesh& mesh = garment.mesh;
  ASSERT_NEAR(mesh.triangle_count(), 5000, 100);
  const Cloth cloth = make_cloth(garment.pattern, mesh);
  Points3 start(mesh.node_count, 3);
  std::vector<Pin> pins;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const bool is_sleeve = mesh.panel_of_vertex[static_cast<std::size_t>(v)] == 1;
    const double radius = is_sleeve ? sleeve : torso, angle = mesh.rest(v, 0) / radius;
    const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
    start.row(node) = Vec3((is_sleeve ? torso + sleeve + 0.005 : 0.0) - radius * std::cos(angle), mesh.rest(v, 1),
                           radius * std::sin(angle));
    if (is_sleeve && std::abs(angle - std::numbers::pi) < 0.1)
      pins.push_back({node, Vec3(torso + 0.06, mesh.rest(v, 1), 0), 100.0});
  }
  ASSERT_GT(pins.size(), 10u);
  ASSERT_EQ(crossings(mesh, start), 0);
  for (bool on : {true, false}) {
    CylinderField body(0.14);
    Contact contact(cloth, body, {});
    ClothContact layers(cloth, mesh, {});
    DrapeEnergy energy(cloth, &contact, 0);
    energy.pins = pins;
    if (on) energy.cloth_contact = &layers;
    RelaxOptions options;
    options.iterations = 600;
    const RelaxResult result = relax(energy, start, options, nullptr);
    const int crossed = crossings(mesh, result.nodes);
    EXPECT_EQ(crossed == 0, on) << crossed;
    EXPECT_TRUE(!on || result.residual < 3.0) << result.residual;
  }
}

}  // namespace
}  // namespace toile
