// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/distance_field.h"

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/side_by_side.h"
#include "engine/geometry/line_crossings.h"

namespace toile {

double SignedField::evaluate_again(const Vec3& p, double reach, Vec3& gradient, std::int32_t&) {
  return evaluate(p, reach, gradient);
}

Mat3 SignedField::hessian(const Vec3& p) {
  constexpr double kStep = 1e-6, kEverywhere = 1e6;  // m
  Mat3 result;
  for (int d = 0; d < 3; ++d) {
    Vec3 ahead, behind;
    evaluate(p + kStep * Vec3::Unit(d), kEverywhere, ahead);
    evaluate(p - kStep * Vec3::Unit(d), kEverywhere, behind);
    result.col(d) = (ahead - behind) / (2 * kStep);
  }
  return 0.5 * (result + result.transpose());
}

double CylinderField::evaluate(const Vec3& p, double, Vec3& gradient) {
  const double r = std::hypot(p.x(), p.z());
  gradient = r > 0 ? Vec3(p.x() / r, 0, p.z() / r) : Vec3(1, 0, 0);
  return r - radius_;
}

Mat3 CylinderField::hessian(const Vec3& p) {
  Vec3 radial;
  const double r = evaluate(p, 0, radial) + radius_;
  if (!(r > 0)) return Mat3::Zero();
  const Vec3 around(radial.z(), 0, -radial.x());
  return around * around.transpose() / r;
}

double BellyField::evaluate(const Vec3& p, double, Vec3& gradient) {
  const double r = std::hypot(p.x(), p.z()), t = (p.y() - middle_) / width_;
  const double bump = height_ * std::exp(-t * t);
  const double slope = -2 * t / width_ * bump, curvature = (4 * t * t - 2) / (width_ * width_) * bump;
  const double gap = r - base_ - bump, scale = 1 / std::sqrt(1 + slope * slope);
  const Vec3 radial = r > 0 ? Vec3(p.x() / r, 0, p.z() / r) : Vec3(1, 0, 0);
  gradient = scale * radial;
  gradient.y() = -scale * slope - gap * scale * scale * scale * slope * curvature;
  return gap * scale;
}

namespace {

constexpr int kBlock = 4;  // nodes of a block along each axis: memory is taken by blocks
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr int kBlockNodes = kBlock * kBlock * kBlock;
constexpr std::int64_t kMostColumns = 4'000'000, kMostBlocks = 40'000'000;
constexpr int kMostNodes = std::numeric_limits<std::int16_t>::max();  // along an axis

}  // namespace

struct CoarseLattice {
  double spacing = 0;
  Eigen::Vector3i count;
  std::vector<float> distance;  // signed, at the nodes; NaN not computed

  std::size_t index(const Eigen::Vector3i& c) const {
    return (static_cast<std::size_t>(c.z()) * static_cast<std::size_t>(count.y()) + static_cast<std::size_t>(c.y())) *
               static_cast<std::size_t>(count.x()) +
           static_cast<std::size_t>(c.x());
  }
};

// Lattice values round one node, what the spline needs there, in two cache lines: evaluating it waits for memory most.
struct alignas(64) SplineCell {
  using Row = Eigen::Array4d;
  std::array<float, 28> value;         // rows of three along x, then y, then z, and a zero
  std::array<std::int16_t, 3> centre;  // the node's index

  Row row(int j, int k) const {  // and one value more
    return Eigen::Map<const Eigen::Array4f>(value.data() + 3 * (3 * k + j)).cast<double>();
  }

  // Quadratic B-spline at `t` from the cell's node and its slope, both in lattice spacings.
  double evaluate(const Vec3& t, Vec3& slope) const {
    Row w[3], dw[3];  // weights and derivatives along each axis
    for (int d = 0; d < 3; ++d) {
      w[d] << 0.5 * (0.5 - t[d]) * (0.5 - t[d]), 0.75 - t[d] * t[d], 0.5 * (0.5 + t[d]) * (0.5 + t[d]), 0;
      dw[d] << t[d] - 0.5, -2 * t[d], t[d] + 0.5, 0;
    }
    Row in = Row::Zero(), in_y = Row::Zero(), in_z = Row::Zero();
    for (int k = 0; k < 3; ++k) {
      Row sum = Row::Zero(), dsum = Row::Zero();
      for (int j = 0; j < 3; ++j) {
        const Row values = row(j, k);
        sum += w[1][j] * values;
        dsum += dw[1][j] * values;
      }
      in += w[2][k] * sum;
      in_y += w[2][k] * dsum;
      in_z += dw[2][k] * sum;
    }
    slope = Vec3((dw[0] * in).sum(), (w[0] * in_y).sum(), (w[0] * in_z).sum());
    return (w[0] * in).sum();
  }
};

// Nearest lattice index along every axis.
Eigen::Vector3i nearest_index(const Vec3& q) {
  return (q.array() + 0.5).floor().max(-1.0).min(1e9).cast<int>();
}

struct SurfaceField::State {
  SurfaceTree tree;
  double h = 0, inverse_h = 0;
  Vec3 origin;                    // of all lattices
  Eigen::Vector3i nodes, blocks;  // counts along each axis; blocks = ceil(nodes / kBlock)
  std::unique_ptr<LineCrossings> crossings;
  std::vector<std::int32_t> block_slot;  // dense; -1 not touched, else number in `values`
  std::vector<std::array<float, kBlockNodes>> values;
  std::vector<std::array<std::int32_t, kBlockNodes>> cell_slot;  // beside `values`; -1 no cell there, else its number
  std::vector<SplineCell> cells;
  std::vector<CoarseLattice> coarse;  // from the coarsest down
  int computed = 0;
  int start = -1;  // triangle of the last query, to begin the next one with

  bool has_cell(const Eigen::Vector3i& centre) const {
    return (centre.array() >= 1).all() && (centre.array() <= nodes.array() - 2).all();
  }

  float lattice(int x, int y, int z) {
    float& node = values[block(x, y, z)][within(x, y, z)];
    if (std::isnan(node)) node = node_value(x, y, z);
    return node;
  }

  std::size_t block_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(z / kBlock) * static_cast<std::size_t>(blocks.y()) +
            static_cast<std::size_t>(y / kBlock)) *
               static_cast<std::size_t>(blocks.x()) +
           static_cast<std::size_t>(x / kBlock);
  }
  static std::size_t within(int x, int y, int z) {
    return static_cast<std::size_t>(((z % kBlock) * kBlock + y % kBlock) * kBlock + x % kBlock);
  }

  // Number of the block that holds a node.
  std::size_t block(int x, int y, int z) {
    std::int32_t& slot = block_slot[block_of(x, y, z)];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(values.size());
      values.emplace_back().fill(kUnknown);
      cell_slot.emplace_back().fill(-1);
    }
    return static_cast<std::size_t>(slot);
  }

  // Number of the cell round a node if it has been visited before, else -1.
  std::int32_t known_cell(const Eigen::Vector3i& c) const {
    const std::int32_t slot = block_slot[block_of(c.x(), c.y(), c.z())];
    return slot < 0 ? -1 : cell_slot[static_cast<std::size_t>(slot)][within(c.x(), c.y(), c.z())];
  }

  std::int32_t new_cell(const Eigen::Vector3i& c) {
    const auto number = static_cast<std::int32_t>(cells.size());
    cell_slot[block(c.x(), c.y(), c.z())][within(c.x(), c.y(), c.z())] = number;
    SplineCell cell{
        {}, {static_cast<std::int16_t>(c.x()), static_cast<std::int16_t>(c.y()), static_cast<std::int16_t>(c.z())}};
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
          cell.value[static_cast<std::size_t>(3 * (3 * k + j) + i)] =
              lattice(c.x() - 1 + i, c.y() - 1 + j, c.z() - 1 + k);
    cells.push_back(cell);
    return number;
  }

  bool is_cell(std::int32_t number, const Eigen::Vector3i& c) const {
    if (static_cast<std::size_t>(number) >= cells.size()) return false;
    const auto& at = cells[static_cast<std::size_t>(number)].centre;
    return at[0] == c.x() && at[1] == c.y() && at[2] == c.z();
  }

  // Signed distance at lattice node (x, y, z). The last answer is near the next question: it starts the search. The
  // value does not depend on it.
  float node_value(int x, int y, int z) {
    ++computed;
    return node_value_from(x, y, z, start);
  }
  float node_value_from(int x, int y, int z, int& from) const {
    const Vec3 p = origin + h * Vec3(x, y, z);
    const double distance = tree.distance(p, from);
    return static_cast<float>(crossings->winding(x, y, p.z()) > 0 ? -distance : distance);
  }

  // Nodes round the node `centre` whose value is not known yet; they count as asked for from now on.
  void ask_around(const Eigen::Vector3i& centre, std::vector<Eigen::Vector3i>& asked) {
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
          const Eigen::Vector3i c = centre + Eigen::Vector3i(i, j, k);
          float& value = values[block(c.x(), c.y(), c.z())][within(c.x(), c.y(), c.z())];
          if (!std::isnan(value)) continue;
          value = 0;
          asked.push_back(c);
        }
  }

  // Lower bound of the distance at p from the nearest node of each coarser lattice, coarsest first.
  double far_bound(const Vec3& p, double enough) {
    double bound = -std::numeric_limits<double>::infinity();
    for (CoarseLattice& level : coarse) {
      Eigen::Vector3i c = nearest_index((p - origin) / level.spacing);
      c = c.cwiseMax(0).cwiseMin(level.count - Eigen::Vector3i::Ones());
      const Vec3 node = origin + level.spacing * c.cast<double>();
      const double slack = (p - node).norm() + 1e-6;
      float& distance = level.distance[level.index(c)];
      if (std::isnan(distance)) {
        const auto away = static_cast<float>(tree.distance(node, start));
        distance = tree.winding_number(node) > 0 ? -away : away;
      }
      bound = std::max(bound, static_cast<double>(distance) - slack);
      if (bound > enough || distance + slack < enough) break;  // certainly far, or certainly near
    }
    return bound;
  }
};

SurfaceField::SurfaceField(const Points3& vertices, const Triangles& triangles, const SurfaceFieldOptions& options)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.tree = SurfaceTree(vertices, triangles);
  s.h = options.spacing;
  s.inverse_h = 1 / s.h;
  // A lattice origin at a multiple of the spacing would put lattice lines exactly on symmetric vertices; harmless, but
  // the sign would hang on tie rules there. An odd fraction avoids it and keeps mirrored bodies mirrored.
  const Vec3 low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  for (int d = 0; d < 3; ++d) s.origin[d] = s.h * (std::floor((low[d] - options.margin) / s.h) - 0.5);
  s.nodes =
      ((high - s.origin).array() + options.margin).cwiseQuotient(Eigen::Array3d::Constant(s.h)).ceil().cast<int>() + 2;
  s.blocks = (s.nodes.array() + kBlock - 1) / kBlock;
  s.nodes = s.blocks * kBlock;
  const std::int64_t columns = static_cast<std::int64_t>(s.nodes.x()) * s.nodes.y();
  const std::int64_t blocks = static_cast<std::int64_t>(s.blocks.x()) * s.blocks.y() * s.blocks.z();
  if (s.nodes.maxCoeff() > kMostNodes || columns > kMostColumns || blocks > kMostBlocks)
    throw Error(ErrorCode::LimitExceeded, "body",
                "the body is too large for a distance field of this spacing; check its unit (metres expected)");
  for (const double spacing : options.coarse_spacings) {
    CoarseLattice level{spacing, (s.nodes.cast<double>() * s.h / spacing).array().ceil().cast<int>() + 1, {}};
    level.distance.assign(static_cast<std::size_t>(level.count.prod()), kUnknown);
    s.coarse.push_back(std::move(level));
  }
  s.crossings = std::make_unique<LineCrossings>(vertices, triangles, s.origin.head<2>(), s.h, s.nodes.x(), s.nodes.y());
  s.block_slot.assign(static_cast<std::size_t>(blocks), -1);
}

SurfaceField::~SurfaceField() = default;

int SurfaceField::lattice_nodes_computed() const {
  return state_->computed;
}
const SurfaceTree& SurfaceField::tree() const {
  return state_->tree;
}

double SurfaceField::evaluate(const Vec3& p, double reach, Vec3& gradient) {
  std::int32_t hint = -1;
  return evaluate_again(p, reach, gradient, hint);
}

double SurfaceField::evaluate_again(const Vec3& p, double reach, Vec3& gradient, std::int32_t& hint) {
  State& s = *state_;
  const Vec3 q = (p - s.origin) * s.inverse_h;
  const Eigen::Vector3i centre = nearest_index(q);
  if (!s.is_cell(hint, centre)) {
    const bool in_lattice = s.has_cell(centre);
    const std::int32_t known = in_lattice ? s.known_cell(centre) : -1;
    if (known < 0) {
      // The spline may lie below the true distance in creases, by less than half a cell: without that margin its value
      // would jump where a bound takes over, and a line search would stall there.
      const double far = reach + 0.5 * s.h, bound = s.far_bound(p, far);
      if (bound > far) return bound;
      if (!in_lattice) {
        const SurfacePoint near = s.tree.closest_point(p);  // outside the lattice with a reach beyond its margin
        gradient = (p - near.point).normalized();
        return near.distance();
      }
    }
    hint = known < 0 ? s.new_cell(centre) : known;
  }
  const double value = s.cells[static_cast<std::size_t>(hint)].evaluate(q - centre.cast<double>(), gradient);
  gradient *= s.inverse_h;
  return value;
}

void SurfaceField::look_ahead(const Points3& points, double reach) {
  State& s = *state_;
  std::vector<Eigen::Vector3i> asked;
  const double far = reach + 0.5 * s.h;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Vec3 p = points.row(i);
    const Eigen::Vector3i centre = nearest_index((p - s.origin) * s.inverse_h);
    if (s.has_cell(centre) && s.known_cell(centre) < 0 && s.far_bound(p, far) <= far) s.ask_around(centre, asked);
  }
  std::vector<float> value(asked.size());
  const auto compute = [&](std::size_t begin, std::size_t end) {
    int from = s.start;
    for (std::size_t k = begin; k < end; ++k)
      value[k] = s.node_value_from(asked[k].x(), asked[k].y(), asked[k].z(), from);
    return from;
  };
  const std::size_t middle = asked.size() / 2;
  const bool at_once = middle > 0 && lent_threads() && lent_threads()->any_idle();
  s.start = side_by_side(
                at_once, [&] { return compute(0, middle); }, [&] { return compute(middle, asked.size()); })
                .second;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const Eigen::Vector3i& c = asked[k];
    s.values[s.block(c.x(), c.y(), c.z())][State::within(c.x(), c.y(), c.z())] = value[k];
  }
  s.computed += static_cast<int>(asked.size());
}

void SurfaceField::prepare(std::int32_t hint) const {
  const std::vector<SplineCell>& cells = state_->cells;
  if (static_cast<std::size_t>(hint) >= cells.size()) return;
  const auto* line = reinterpret_cast<const char*>(&cells[static_cast<std::size_t>(hint)]);
  __builtin_prefetch(line);
  __builtin_prefetch(line + 64);
}

Mat3 SurfaceField::hessian(const Vec3& p) {
  State& s = *state_;
  const Vec3 q = (p - s.origin) * s.inverse_h;
  const Eigen::Vector3i centre = nearest_index(q);
  if (!s.has_cell(centre)) return SignedField::hessian(p);
  std::array<Vec3, 3> w[3];  // along each axis, of each node: B-spline weight, its first and second derivative
  for (std::size_t d = 0; d < 3; ++d) {
    const double t = q[static_cast<int>(d)] - centre[static_cast<int>(d)];
    w[d] = {Vec3(0.5 * (0.5 - t) * (0.5 - t), t - 0.5, 1), Vec3(0.75 - t * t, -2 * t, -2),
            Vec3(0.5 * (0.5 + t) * (0.5 + t), t + 0.5, 1)};
  }
  Mat3 bend = Mat3::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto offset = Eigen::Vector3i(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
        const Eigen::Vector3i at = centre + offset - Eigen::Vector3i::Ones();
        const Vec3 &x = w[0][i], &y = w[1][j], &z = w[2][k];
        Mat3 second;
        second << x[2] * y[0] * z[0], x[1] * y[1] * z[0], x[1] * y[0] * z[1],  //
            x[1] * y[1] * z[0], x[0] * y[2] * z[0], x[0] * y[1] * z[1],        //
            x[1] * y[0] * z[1], x[0] * y[1] * z[1], x[0] * y[0] * z[2];
        bend += static_cast<double>(s.lattice(at.x(), at.y(), at.z())) * second;
      }
  return bend * s.inverse_h * s.inverse_h;
}

}  // namespace toile
