// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/distance_field.h"

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"

namespace toile {

double CylinderField::evaluate(const Vec3& p, double, Vec3& gradient) {
  const double r = std::hypot(p.x(), p.z());
  gradient = r > 0 ? Vec3(p.x() / r, 0, p.z() / r) : Vec3(1, 0, 0);
  return r - radius_;
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

constexpr int kBlock = 4;  // nodes of a block along each axis: blocks are filled whole
constexpr int kBlockNodes = kBlock * kBlock * kBlock;
constexpr std::int64_t kMostColumns = 4'000'000, kMostBlocks = 40'000'000;

// Heights at which vertical (z) lattice lines cross the surface, line by line.
class Crossings {
 public:
  struct Crossing {
    double z;
    int change;  // of the winding number on passing upwards in z
  };

  Crossings(const Points3& vertices, const Triangles& triangles, const Vec2& origin, double spacing, int nx, int ny)
      : origin_(origin), spacing_(spacing), nx_(nx), ny_(ny), begin_(static_cast<std::size_t>(nx) * ny + 1, 0) {
    for (int pass = 0; pass < 2; ++pass) {
      for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        rasterise(vertices.row(triangles(f, 0)), vertices.row(triangles(f, 1)), vertices.row(triangles(f, 2)), pass);
      if (pass == 0) {
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        crossings_.resize(static_cast<std::size_t>(begin_.back()));
      }
    }
    // The second pass counted every line's start down to where the line begins.
    for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
      std::sort(crossings_.begin() + begin_[i], crossings_.begin() + begin_[i + 1],
                [](const Crossing& a, const Crossing& b) { return a.z < b.z; });
  }

  int winding(int ix, int iy, double z) const {
    const std::size_t line =
        static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
    int winding = 0;
    for (int k = begin_[line]; k < begin_[line + 1] && crossings_[static_cast<std::size_t>(k)].z < z; ++k)
      winding += crossings_[static_cast<std::size_t>(k)].change;
    return winding;
  }

 private:
  void rasterise(const Vec3& a, const Vec3& b, const Vec3& c, int pass) {
    const auto index = [&](double v, int axis) { return (v - origin_[axis]) / spacing_; };
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    // Widened by a little: which triangle owns a line is for line_crossing alone to say, not for rounding here.
    const auto first = [&](double v, int axis) {
      return std::max(0, static_cast<int>(std::ceil(index(v, axis) - 1e-6)));
    };
    const auto last = [&](double v, int axis, int count) {
      return std::min(count - 1, static_cast<int>(std::floor(index(v, axis) + 1e-6)));
    };
    const int x0 = first(low.x(), 0), x1 = last(high.x(), 0, nx_), y0 = first(low.y(), 1), y1 = last(high.y(), 1, ny_);
    for (int iy = y0; iy <= y1; ++iy)
      for (int ix = x0; ix <= x1; ++ix) {
        const Vec2 at = origin_ + spacing_ * Vec2(ix, iy);
        double z = 0;
        const int side = line_crossing(at, a, b, c, z);
        if (side == 0) continue;
        const std::size_t line =
            static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
        if (pass == 0)
          ++begin_[line];
        else
          crossings_[static_cast<std::size_t>(--begin_[line])] = {z, -side};
      }
  }

  Vec2 origin_;
  double spacing_;
  int nx_, ny_;
  std::vector<int> begin_;
  std::vector<Crossing> crossings_;
};

}  // namespace

struct SurfaceField::State {
  SurfaceTree tree;
  double h = 0, inverse_h = 0, coarse_h = 0;
  Vec3 origin;                            // of the lattice
  Eigen::Vector3i nodes, blocks, coarse;  // counts along each axis; blocks = ceil(nodes / kBlock)
  std::unique_ptr<Crossings> crossings;
  std::vector<std::int32_t> block_slot;  // dense; -1 not filled, else number in `values`
  std::vector<std::array<float, kBlockNodes>> values;
  std::vector<float> coarse_distance;  // unsigned lower bounds' source; NaN not computed
  int start = -1;                      // triangle of the last query, to begin the next one with

  const float* block(int bx, int by, int bz) {
    const std::size_t at =
        (static_cast<std::size_t>(bz) * static_cast<std::size_t>(blocks.y()) + static_cast<std::size_t>(by)) *
            static_cast<std::size_t>(blocks.x()) +
        static_cast<std::size_t>(bx);
    if (block_slot[at] < 0) {
      block_slot[at] = static_cast<std::int32_t>(values.size());
      values.emplace_back();
      fill({bx * kBlock, by * kBlock, bz * kBlock}, values.back());
    }
    return values[static_cast<std::size_t>(block_slot[at])].data();
  }

  void fill(const Eigen::Vector3i& first, std::array<float, kBlockNodes>& block) const {
    int triangle = -1;
    double previous = 0;
    for (int i = 0; i < kBlockNodes; ++i) {
      // Back and forth, so that every node is a neighbour of the one before it.
      const int z = i / (kBlock * kBlock), row = i / kBlock % kBlock, y = z % 2 ? kBlock - 1 - row : row;
      const int x = (i / kBlock) % 2 ? kBlock - 1 - i % kBlock : i % kBlock;
      const Vec3 p = origin + h * (first + Eigen::Vector3i(x, y, z)).cast<double>();
      const double within = triangle < 0 ? std::numeric_limits<double>::infinity() : previous + 1.001 * h;
      const SurfacePoint near = tree.closest_point(p, within, triangle);
      triangle = near.triangle;
      previous = near.distance();
      const bool inside = crossings->winding(first.x() + x, first.y() + y, p.z()) > 0;
      block[static_cast<std::size_t>((z * kBlock + y) * kBlock + x)] =
          static_cast<float>(inside ? -previous : previous);
    }
  }

  // Lower bound of the distance at p from the nearest coarse node.
  double far_bound(const Vec3& p) {
    Eigen::Vector3i c = ((p - origin) / coarse_h).array().round().cast<int>();
    c = c.cwiseMax(0).cwiseMin(coarse - Eigen::Vector3i::Ones());
    const std::size_t at =
        (static_cast<std::size_t>(c.z()) * static_cast<std::size_t>(coarse.y()) + static_cast<std::size_t>(c.y())) *
            static_cast<std::size_t>(coarse.x()) +
        static_cast<std::size_t>(c.x());
    const Vec3 node = origin + coarse_h * c.cast<double>();
    if (std::isnan(coarse_distance[at])) coarse_distance[at] = static_cast<float>(tree.signed_distance(node));
    return static_cast<double>(coarse_distance[at]) - (p - node).norm() - 1e-6;
  }
};

SurfaceField::SurfaceField(const Points3& vertices, const Triangles& triangles, const SurfaceFieldOptions& options)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.tree = SurfaceTree(vertices, triangles);
  s.h = options.spacing;
  s.inverse_h = 1 / s.h;
  s.coarse_h = options.coarse_spacing;
  // A lattice origin at a multiple of the spacing would put lattice lines exactly on symmetric vertices; harmless, but
  // the sign would hang on tie rules there. An odd fraction avoids it and keeps mirrored bodies mirrored.
  const Vec3 low = vertices.colwise().minCoeff(), high = vertices.colwise().maxCoeff();
  for (int d = 0; d < 3; ++d) s.origin[d] = s.h * (std::floor((low[d] - options.margin) / s.h) - 0.5);
  s.nodes =
      ((high - s.origin).array() + options.margin).cwiseQuotient(Eigen::Array3d::Constant(s.h)).ceil().cast<int>() + 2;
  s.blocks = (s.nodes.array() + kBlock - 1) / kBlock;
  s.nodes = s.blocks * kBlock;
  s.coarse = (s.nodes.cast<double>() * s.h / s.coarse_h).array().ceil().cast<int>() + 1;
  const std::int64_t columns = static_cast<std::int64_t>(s.nodes.x()) * s.nodes.y();
  const std::int64_t blocks = static_cast<std::int64_t>(s.blocks.x()) * s.blocks.y() * s.blocks.z();
  if (columns > kMostColumns || blocks > kMostBlocks)
    throw Error(ErrorCode::LimitExceeded, "body",
                "the body is too large for a distance field of this spacing; check its unit (metres expected)");
  s.crossings = std::make_unique<Crossings>(vertices, triangles, s.origin.head<2>(), s.h, s.nodes.x(), s.nodes.y());
  s.block_slot.assign(static_cast<std::size_t>(blocks), -1);
  s.coarse_distance.assign(static_cast<std::size_t>(s.coarse.prod()), std::numeric_limits<float>::quiet_NaN());
}

SurfaceField::~SurfaceField() = default;

int SurfaceField::lattice_nodes_computed() const {
  return static_cast<int>(state_->values.size()) * kBlockNodes;
}
const SurfaceTree& SurfaceField::tree() const {
  return state_->tree;
}

double SurfaceField::evaluate(const Vec3& p, double reach, Vec3& gradient) {
  State& s = *state_;
  const double bound = s.far_bound(p);
  if (bound > reach) return bound;

  const Vec3 q = (p - s.origin) * s.inverse_h;
  Eigen::Vector3i centre = q.array().round().cast<int>();
  if ((centre.array() < 1).any() || (centre.array() > s.nodes.array() - 2).any()) {
    const SurfacePoint near = s.tree.closest_point(p);  // outside the lattice with a reach beyond its margin
    gradient = (p - near.point).normalized();
    return near.distance();
  }
  std::array<double, 3> w[3], dw[3];  // B-spline weights and derivatives along each axis
  for (int d = 0; d < 3; ++d) {
    const double t = q[d] - centre[d];
    w[d] = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
    dw[d] = {t - 0.5, -2 * t, t + 0.5};
  }
  double value = 0;
  Vec3 slope = Vec3::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    const int z = centre.z() - 1 + static_cast<int>(k);
    for (std::size_t j = 0; j < 3; ++j) {
      const int y = centre.y() - 1 + static_cast<int>(j);
      double sum = 0, dsum = 0;
      const float* row = nullptr;
      for (std::size_t i = 0; i < 3; ++i) {
        const int x = centre.x() - 1 + static_cast<int>(i);
        if (i == 0 || x % kBlock == 0)
          row = s.block(x / kBlock, y / kBlock, z / kBlock) + ((z % kBlock) * kBlock + y % kBlock) * kBlock;
        const auto v = static_cast<double>(row[x % kBlock]);
        sum += w[0][i] * v;
        dsum += dw[0][i] * v;
      }
      value += w[2][k] * w[1][j] * sum;
      slope += Vec3(w[2][k] * w[1][j] * dsum, w[2][k] * dw[1][j] * sum, dw[2][k] * w[1][j] * sum);
    }
  }
  gradient = slope * s.inverse_h;
  return value;
}

}  // namespace toile
