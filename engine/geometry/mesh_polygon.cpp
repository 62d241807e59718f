// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/geometry/mesh_polygon.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/flat_vectors.h"
#include "engine/geometry/triangulate.h"

namespace toile {

namespace {

constexpr double kBoundaryDistance = 0.6;  // of the edge length: nearer lattice points would make flat triangles
constexpr int kRounds = 2;
constexpr int kSweepsPerRound = 5;
constexpr double kMostCellsAcross = 2000.0;  // bounds the memory for long thin polygons

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 d = b - a;
  const double t = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return (p - a - t * d).norm();
}

double longest_extent(const std::vector<Vec2>& polygon) {
  Vec2 low = polygon.front(), high = polygon.front();
  for (const Vec2& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).maxCoeff();
}

// Boundary segments in square cells, so that the distance of a point to the boundary is a look at nine cells.
class SegmentGrid {
 public:
  SegmentGrid(const std::vector<Vec2>& polygon, double cell) : polygon_(polygon), cell_(cell) {
    low_ = high_ = polygon.front();
    for (const Vec2& p : polygon) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
    columns_ = static_cast<int>((high_.x() - low_.x()) / cell_) + 3;
    rows_ = static_cast<int>((high_.y() - low_.y()) / cell_) + 3;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int i = 0; i < static_cast<int>(polygon.size()); ++i) add(i);
  }

  const Vec2& low() const { return low_; }
  const Vec2& high() const { return high_; }

  // Requires reach <= cell.
  bool nearer_than(const Vec2& p, double reach) const {
    const int cx = column(p.x()), cy = row(p.y());
    for (int y = std::max(0, cy - 1); y <= std::min(rows_ - 1, cy + 1); ++y)
      for (int x = std::max(0, cx - 1); x <= std::min(columns_ - 1, cx + 1); ++x)
        for (const int i : cells_[index(x, y)])
          if (distance_to_segment(p, start(i), end(i)) < reach) return true;
    return false;
  }

 private:
  int column(double x) const { return static_cast<int>((x - low_.x()) / cell_) + 1; }
  int row(double y) const { return static_cast<int>((y - low_.y()) / cell_) + 1; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }
  const Vec2& start(int i) const { return polygon_[static_cast<std::size_t>(i)]; }
  const Vec2& end(int i) const { return polygon_[(static_cast<std::size_t>(i) + 1) % polygon_.size()]; }

  // Every cell that a point of the segment lies in, walked in steps of half a cell.
  void add(int i) {
    const Vec2 d = end(i) - start(i);
    const int steps = static_cast<int>(2.0 * d.norm() / cell_) + 1;
    std::size_t last = cells_.size();
    for (int s = 0; s <= steps; ++s) {
      const Vec2 p = start(i) + (static_cast<double>(s) / steps) * d;
      const std::size_t at = index(column(p.x()), row(p.y()));
      if (at != last) cells_[at].push_back(i);
      last = at;
    }
  }

  const std::vector<Vec2>& polygon_;
  double cell_;
  Vec2 low_, high_;
  int columns_ = 0, rows_ = 0;
  std::vector<std::vector<int>> cells_;
};

// Where the horizontal line at `y` crosses the polygon, ascending.
class RowCrossings {
 public:
  explicit RowCrossings(const std::vector<Vec2>& polygon) : polygon_(polygon) {
    for (int i = 0; i < static_cast<int>(polygon.size()); ++i) order_.push_back(i);
    std::sort(order_.begin(), order_.end(),
              [&](int i, int j) { return std::pair(least(i), i) < std::pair(least(j), j); });
  }

  // Requires ascending `y` from call to call.
  std::vector<double> at(double y) {
    for (; next_ < order_.size() && least(order_[next_]) <= y; ++next_) active_.push_back(order_[next_]);
    std::erase_if(active_, [&](int i) { return std::max(point(i).y(), point(i + 1).y()) <= y; });
    std::vector<double> crossings;
    for (const int i : active_) {
      const Vec2 &a = point(i), &b = point(i + 1);
      if ((a.y() <= y) != (b.y() <= y)) crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    return crossings;
  }

 private:
  const Vec2& point(int i) const { return polygon_[static_cast<std::size_t>(i) % polygon_.size()]; }
  double least(int i) const { return std::min(point(i).y(), point(i + 1).y()); }

  const std::vector<Vec2>& polygon_;
  std::vector<int> order_, active_;
  std::size_t next_ = 0;
};

std::vector<Vec2> lattice_points(const std::vector<Vec2>& polygon, double h) {
  const SegmentGrid grid(polygon, std::max(h, longest_extent(polygon) / kMostCellsAcross));
  RowCrossings crossings(polygon);
  const double pitch = 0.5 * std::sqrt(3.0) * h;
  const Vec2 centre = 0.5 * (grid.low() + grid.high());
  const int first_row = static_cast<int>(std::ceil((grid.low().y() - centre.y()) / pitch));
  const int last_row = static_cast<int>(std::floor((grid.high().y() - centre.y()) / pitch));
  std::vector<Vec2> points;
  for (int row = first_row; row <= last_row; ++row) {
    const double y = centre.y() + row * pitch;
    const double origin = centre.x() + (row % 2 != 0 ? 0.5 * h : 0.0);
    const auto xs = crossings.at(y);
    for (std::size_t k = 0; k + 1 < xs.size(); k += 2) {
      const int last = static_cast<int>(std::floor((xs[k + 1] - origin) / h));
      for (int column = static_cast<int>(std::ceil((xs[k] - origin) / h)); column <= last; ++column) {
        const Vec2 p(origin + column * h, y);
        if (!grid.nearer_than(p, kBoundaryDistance * h)) points.push_back(p);
      }
    }
  }
  return points;
}

// Triangles round each vertex, as one array with offsets.
struct Corners {
  std::vector<int> begin, triangle;

  Corners(const Triangles& triangles, int vertex_count) : begin(static_cast<std::size_t>(vertex_count) + 1, 0) {
    for (Eigen::Index i = 0; i < triangles.size(); ++i) ++begin[static_cast<std::size_t>(triangles.data()[i]) + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    triangle.resize(static_cast<std::size_t>(triangles.size()));
    std::vector<int> fill(begin.begin(), begin.end() - 1);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
      for (int k = 0; k < 3; ++k)
        triangle[static_cast<std::size_t>(fill[static_cast<std::size_t>(triangles(f, k))]++)] = static_cast<int>(f);
  }
};

// Moves interior points to the mean of their neighbours, unless that would turn a triangle over.
void smooth(PolygonMesh& mesh, int fixed_count) {
  const int n = static_cast<int>(mesh.points.size());
  const Corners corners(mesh.triangles, n);
  const auto point = [&](int v) -> Vec2& { return mesh.points[static_cast<std::size_t>(v)]; };
  for (int sweep = 0; sweep < kSweepsPerRound; ++sweep)
    for (int v = fixed_count; v < n; ++v) {
      const int from = corners.begin[static_cast<std::size_t>(v)], to = corners.begin[static_cast<std::size_t>(v) + 1];
      if (from == to) continue;
      Vec2 mean = Vec2::Zero();
      for (int i = from; i < to; ++i) {
        const int f = corners.triangle[static_cast<std::size_t>(i)];
        for (int k = 0; k < 3; ++k)
          if (mesh.triangles(f, k) == v) mean += point(mesh.triangles(f, (k + 1) % 3));
      }
      mean /= to - from;  // round an interior vertex every neighbour follows it in exactly one triangle
      const Vec2 before = point(v);
      point(v) = mean;
      for (int i = from; i < to; ++i) {
        const auto t = mesh.triangles.row(corners.triangle[static_cast<std::size_t>(i)]);
        if (cross(point(t[1]) - point(t[0]), point(t[2]) - point(t[0])) > 0) continue;
        point(v) = before;
        break;
      }
    }
}

}  // namespace

PolygonMesh mesh_polygon(const std::vector<Vec2>& polygon, double edge_length) {
  const int boundary = static_cast<int>(polygon.size());
  std::vector<std::array<int, 2>> segments;
  for (int i = 0; i < boundary; ++i) segments.push_back({i, (i + 1) % boundary});
  PolygonMesh mesh;
  mesh.points = polygon;
  const auto interior = lattice_points(polygon, edge_length);
  mesh.points.insert(mesh.points.end(), interior.begin(), interior.end());
  mesh.triangles = triangulate(mesh.points, segments);
  for (int round = 0; round < kRounds && !interior.empty(); ++round) {
    smooth(mesh, boundary);
    mesh.triangles = triangulate(mesh.points, segments);
  }
  return mesh;
}

}  // namespace toile
