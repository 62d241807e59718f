// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/mannequin_cage.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace toile {
namespace {

constexpr int kAround = MannequinCage::kAround;

class CageBuilder {
 public:
  MannequinCage build() {
    number_points();
    add_trunk();
    add_head();
    add_leg();
    add_arm();
    mirror();
    return std::move(cage_);
  }

 private:
  int next() { return cage_.half_count++; }
  int next_on_midline() {
    cage_.midline.push_back(cage_.half_count);
    return next();
  }

  void number_row(CageRow<kAround>& row, bool gap = false) {
    for (int i = 0; i < kAround; ++i)
      row[i] = i == 0 || i == kAround - 1 ? next_on_midline() : gap && i == 4 ? -1 : next();
  }

  template <std::size_t N>
  void number_loop(std::array<int, N>& loop) {
    for (int& point : loop) point = next();
  }

  void number_points() {
    for (auto& row : cage_.trunk) number_row(row);
    for (std::size_t r = 0; r < cage_.shoulder.size(); ++r) number_row(cage_.shoulder[r], r < 2);
    number_row(cage_.neck);
    for (auto& row : cage_.head) number_row(row);
    for (auto& pair : cage_.crown) pair = {next_on_midline(), next()};
    cage_.bridge = next_on_midline();
    for (auto& row : cage_.leg) number_loop(row);
    for (auto& row : cage_.foot) number_loop(row);
    number_loop(cage_.toe);
    for (auto& row : cage_.arm) number_loop(row);
    for (auto& row : cage_.hand) number_loop(row);
    for (auto& finger : cage_.finger)
      for (auto& row : finger) number_loop(row);
    for (auto& row : cage_.thumb) number_loop(row);
  }

  void quad(int a, int b, int c, int d) { left_.push_back({a, b, c, d}); }

  // From the front to the back over the left side; `above` lies on the +y side.
  void band(const CageRow<kAround>& below, const CageRow<kAround>& above) {
    for (int i = 0; i + 1 < kAround; ++i)
      if (below[i] >= 0 && below[i + 1] >= 0 && above[i] >= 0 && above[i + 1] >= 0)
        quad(below[i], below[i + 1], above[i + 1], above[i]);
  }

  // Around a limb; seen from the limb's end the loops turn counter-clockwise.
  template <std::size_t N>
  void tube(const std::array<int, N>& inner, const std::array<int, N>& outer, int skip = -1) {
    for (std::size_t i = 0; i < N; ++i) {
      const std::size_t j = (i + 1) % N;
      if (static_cast<int>(i) != skip) quad(inner[i], inner[j], outer[j], outer[i]);
    }
  }

  // A rectangle of points, counter-clockwise rows: (r, c) (r, c+1) (r+1, c+1) (r+1, c).
  void patch(const std::vector<std::vector<int>>& rows) {
    for (std::size_t r = 0; r + 1 < rows.size(); ++r)
      for (std::size_t c = 0; c + 1 < rows[r].size(); ++c)
        quad(rows[r][c], rows[r][c + 1], rows[r + 1][c + 1], rows[r + 1][c]);
  }

  void add_trunk() {
    for (std::size_t r = 0; r + 1 < cage_.trunk.size(); ++r) band(cage_.trunk[r], cage_.trunk[r + 1]);
    band(cage_.trunk.back(), cage_.shoulder.front());
    for (std::size_t r = 0; r + 1 < cage_.shoulder.size(); ++r) band(cage_.shoulder[r], cage_.shoulder[r + 1]);
    band(cage_.shoulder.back(), cage_.neck);
  }

  void add_head() {
    band(cage_.neck, cage_.head.front());
    for (std::size_t r = 0; r + 1 < cage_.head.size(); ++r) band(cage_.head[r], cage_.head[r + 1]);
    const auto& rim = cage_.head.back();
    const auto& c = cage_.crown;
    patch({{rim[0], rim[1], rim[2]},  // front to back, each row from the midline to the left
           {c[0][0], c[0][1], rim[3]},
           {c[1][0], c[1][1], rim[4]},
           {c[2][0], c[2][1], rim[5]},
           {rim[8], rim[7], rim[6]}});
  }

  void add_leg() {
    // Downwards: the loops turn clockwise seen from below, so that inner and outer change places.
    tube(cage_.leg.front(), cage_.leg_loop());
    for (std::size_t r = 0; r + 1 < cage_.leg.size(); ++r) tube(cage_.leg[r + 1], cage_.leg[r]);
    tube(cage_.foot.front(), cage_.leg.back());
    for (std::size_t r = 0; r + 1 < cage_.foot.size(); ++r) tube(cage_.foot[r + 1], cage_.foot[r]);
    const auto& end = cage_.foot.back();
    const auto& toe = cage_.toe;
    patch({{end[8], end[7], end[6], end[5]}, {end[9], toe[0], toe[1], end[4]}, {end[0], end[1], end[2], end[3]}});
  }

  void add_arm() {
    tube(cage_.armhole(), cage_.arm.front());
    for (std::size_t r = 0; r + 1 < cage_.arm.size(); ++r) tube(cage_.arm[r], cage_.arm[r + 1]);
    tube(cage_.arm.back(), cage_.hand.front());
    constexpr int kThumbRow = 0, kThumbColumn = 8;  // front of the hand, between its first two rows
    for (int r = 0; r + 1 < static_cast<int>(cage_.hand.size()); ++r)
      tube(cage_.hand[r], cage_.hand[r + 1], r == kThumbRow ? kThumbColumn : -1);
    const auto &low = cage_.hand[kThumbRow], &high = cage_.hand[kThumbRow + 1], &end = cage_.hand.back();
    add_finger({low[8], low[9], high[9], high[8]}, cage_.thumb);
    add_finger({end[9], end[0], end[7], end[8]}, cage_.finger[0]);
    for (std::size_t k = 1; k < cage_.finger.size(); ++k)
      add_finger({end[k - 1], end[k], end[7 - k], end[8 - k]}, cage_.finger[k]);
  }

  void add_finger(const CageRow<4>& root, const std::array<CageRow<4>, 3>& rows) {
    tube(root, rows[0]);
    tube(rows[0], rows[1]);
    tube(rows[1], rows[2]);
    quad(rows[2][0], rows[2][1], rows[2][2], rows[2][3]);
  }

  void mirror() {
    std::vector<int> image(static_cast<std::size_t>(cage_.half_count), -1);
    for (const int point : cage_.midline) image[static_cast<std::size_t>(point)] = point;
    int count = cage_.half_count;
    for (int& point : image)
      if (point < 0) point = count++;
    cage_.mirror_of.resize(static_cast<std::size_t>(count));
    for (int p = 0; p < cage_.half_count; ++p) {
      const int other = image[static_cast<std::size_t>(p)];
      cage_.mirror_of[static_cast<std::size_t>(p)] = other;
      cage_.mirror_of[static_cast<std::size_t>(other)] = p;
    }
    const auto of = [&](int p) { return image[static_cast<std::size_t>(p)]; };
    cage_.quads.resize(2 * static_cast<Eigen::Index>(left_.size()), 4);
    Eigen::Index row = 0;
    for (const auto& q : left_) cage_.quads.row(row++) << q[0], q[1], q[2], q[3];
    for (const auto& q : left_) cage_.quads.row(row++) << of(q[0]), of(q[3]), of(q[2]), of(q[1]);
  }

  MannequinCage cage_;
  std::vector<std::array<int, 4>> left_;
};

Triangles cut(const Quads& quads) {
  Triangles triangles(2 * quads.rows(), 3);
  for (Eigen::Index q = 0; q < quads.rows(); ++q) {
    triangles.row(2 * q) << quads(q, 0), quads(q, 1), quads(q, 2);
    triangles.row(2 * q + 1) << quads(q, 0), quads(q, 2), quads(q, 3);
  }
  return triangles;
}

// Vertices and their mirror images have mirrored stencils, hence equal values of a field and of its mirrored copy. The
// field's values are the fractions of large square roots: no two stencils have one sum.
std::vector<int> mirrored_vertices(const PointStencils& surface, const std::vector<int>& cage_mirror) {
  const auto count = static_cast<Eigen::Index>(cage_mirror.size());
  Eigen::VectorXd field(count), mirrored(count);
  for (Eigen::Index p = 0; p < count; ++p) field[p] = std::fmod(1e3 * std::sqrt(static_cast<double>(p + 2)), 1.0);
  for (Eigen::Index p = 0; p < count; ++p) mirrored[p] = field[cage_mirror[static_cast<std::size_t>(p)]];
  const Eigen::VectorXd here = surface * field, there = surface * mirrored;
  std::vector<int> order(static_cast<std::size_t>(here.size())), mirror_of(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return here[a] < here[b]; });
  constexpr double kRounding = 1e-12;
  for (std::size_t v = 0; v < order.size(); ++v) {
    const double value = there[static_cast<Eigen::Index>(v)] - kRounding;
    const auto found =
        std::lower_bound(order.begin(), order.end(), value, [&](int a, double x) { return here[a] < x; });
    mirror_of[v] = *found;
  }
  return mirror_of;
}

// On the side where the greater part of a vertex's stencil lies.
std::vector<bool> left_vertices(const PointStencils& surface, const MannequinCage& cage) {
  Eigen::VectorXd side = Eigen::VectorXd::Constant(cage.point_count(), -1.0);
  side.head(cage.half_count).setOnes();
  for (const int point : cage.midline) side[point] = 0.0;
  const Eigen::VectorXd sides = surface * side;
  std::vector<bool> left(static_cast<std::size_t>(sides.size()));
  for (std::size_t v = 0; v < left.size(); ++v) left[v] = sides[static_cast<Eigen::Index>(v)] > 0.0;
  return left;
}

// Triangles whose corners depend more on the points of the arm than on those of the trunk.
Triangles left_arm_triangles(const MannequinTemplate& shared) {
  Eigen::VectorXd arm = Eigen::VectorXd::Zero(shared.cage.point_count());
  for (const auto& row : shared.cage.arm)
    for (const int point : row) arm[point] = 1.0;
  for (const auto& row : shared.cage.hand)
    for (const int point : row) arm[point] = 1.0;
  const Eigen::VectorXd share = shared.surface * arm;
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index t = 0; t < shared.triangles.rows(); ++t) {
    const auto corners = shared.triangles.row(t);
    if (share[corners[0]] + share[corners[1]] + share[corners[2]] > 1.5) chosen.push_back(t);
  }
  return shared.triangles(chosen, Eigen::all);
}

MannequinTemplate make_template() {
  MannequinTemplate shared;
  shared.cage = make_mannequin_cage();
  const Quads& coarse = shared.cage.quads;
  const int points = shared.cage.point_count();
  const RefinedQuads once = refine_catmull_clark(coarse, points);
  const RefinedQuads twice = refine_catmull_clark(once.quads, static_cast<int>(once.points.rows()));
  const int vertices = static_cast<int>(twice.points.rows());
  shared.limit = catmull_clark_limit(coarse, points);
  shared.surface = catmull_clark_limit(twice.quads, vertices) * PointStencils(twice.points * once.points);
  shared.triangles = cut(twice.quads);
  shared.left = left_vertices(shared.surface, shared.cage);
  shared.mirror_of = mirrored_vertices(shared.surface, shared.cage.mirror_of);
  shared.left_arm = left_arm_triangles(shared);
  return shared;
}

}  // namespace

CageRow<MannequinCage::kLegAround> MannequinCage::leg_loop() const {
  CageRow<kLegAround> loop{};
  for (int i = 0; i < kAround; ++i) loop[i] = trunk.front()[i];
  loop[kAround] = bridge;
  return loop;
}

CageRow<MannequinCage::kArmAround> MannequinCage::armhole() const {
  const auto& low = trunk.back();
  const auto& high = shoulder[2];
  return {low[3],  low[4],  low[5],  shoulder[0][5], shoulder[1][5],
          high[5], high[4], high[3], shoulder[1][3], shoulder[0][3]};
}

MannequinCage make_mannequin_cage() {
  return CageBuilder().build();
}

const MannequinTemplate& mannequin_template() {
  static const MannequinTemplate shared = make_template();
  return shared;
}

}  // namespace toile
