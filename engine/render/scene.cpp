// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/render/scene.h"

#include <algorithm>
#include <cmath>

#include "engine/render/osmesa_context.h"
#include "engine/render/palette.h"

namespace toile {
namespace {

constexpr double kInsideBrightness = 0.62;  // the wrong side of cloth, so that openings read as such
constexpr double kLineLift = 0.004;         // m towards the viewer: lines lie on their surface

struct Axes {
  Vec3 right, towards;
};

Axes axes_of(View view) {
  switch (view) {
    case View::Back: return {-Vec3::UnitX(), -Vec3::UnitZ()};
    case View::Left: return {-Vec3::UnitZ(), Vec3::UnitX()};
    case View::Right: return {Vec3::UnitZ(), -Vec3::UnitX()};
    case View::Front: break;
  }
  return {Vec3::UnitX(), Vec3::UnitZ()};
}

// Points of one surface in camera axes, and the mean normal at each.
struct SeenSurface {
  Points3 points, normals;
};

constexpr double kFarthest = 1e4;  // m; what lies beyond is a mistake, not a garment

bool drawable(const Points3& points, int v) {
  return v >= 0 && v < points.rows() && points.row(v).allFinite() && points.row(v).cwiseAbs().maxCoeff() < kFarthest;
}

bool usable(const Surface& surface, int f) {
  for (int k = 0; k < 3; ++k)
    if (!drawable(surface.vertices, surface.triangles(f, k))) return false;
  return true;
}

SeenSurface look_at(const Surface& surface, const Camera& camera) {
  SeenSurface seen;
  Mat3 axes;
  axes << camera.right.transpose(), camera.up.transpose(), camera.towards.transpose();
  seen.points = (surface.vertices.rowwise() - camera.centre.transpose()) * axes.transpose();
  seen.normals = Points3::Zero(seen.points.rows(), 3);
  for (int f = 0; f < surface.triangles.rows(); ++f) {
    if (!usable(surface, f)) continue;
    const Eigen::Vector3i t = surface.triangles.row(f).transpose();
    const Vec3 a = seen.points.row(t[0]), b = seen.points.row(t[1]), c = seen.points.row(t[2]);
    const Eigen::RowVector3d area = (b - a).cross(c - a).transpose();
    for (int k = 0; k < 3; ++k) seen.normals.row(t[k]) += area;
  }
  for (int v = 0; v < seen.normals.rows(); ++v) {
    const double length = seen.normals.row(v).norm();
    if (length > 0) seen.normals.row(v) /= length;
  }
  return seen;
}

Rgb lit(Rgb colour, double factor) {
  const auto channel = [factor](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(c * factor, 0.0, 255.0)));
  };
  return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

// Fills a batch; depth runs over the given range so that the 24-bit buffer is used well.
class BatchFiller {
 public:
  BatchFiller(const Camera& camera, double nearest, double farthest)
      : scale_x_(2.0 / (camera.metres_per_pixel * camera.width)),
        scale_y_(2.0 / (camera.metres_per_pixel * camera.height)),
        middle_((nearest + farthest) / 2),
        scale_z_(1.98 / std::max(1e-6, nearest - farthest)) {}

  void add(const Surface& surface, const SeenSurface& seen) {
    for (int f = 0; f < surface.triangles.rows(); ++f)
      if (usable(surface, f)) add_triangle(surface, seen, f);
    for (const auto& [a, b] : surface.lines) add_line(seen, a, b);
  }
  RasterBatch take() { return std::move(batch_); }

 private:
  void position(std::vector<float>& out, const Vec3& p, double lift = 0.0) {
    out.push_back(static_cast<float>(p.x() * scale_x_));
    out.push_back(static_cast<float>(p.y() * scale_y_));
    out.push_back(static_cast<float>((p.z() + lift - middle_) * scale_z_));
  }
  static void colour(std::vector<std::uint8_t>& out, Rgb c) { out.insert(out.end(), {c.r, c.g, c.b}); }

  void add_triangle(const Surface& surface, const SeenSurface& seen, int f) {
    const Eigen::Vector3i t = surface.triangles.row(f).transpose();
    const Vec3 a = seen.points.row(t[0]), b = seen.points.row(t[1]), c = seen.points.row(t[2]);
    const bool inside = (b - a).cross(c - a).z() < 0;
    const Rgb base =
        static_cast<std::size_t>(f) < surface.colours.size() ? surface.colours[static_cast<std::size_t>(f)] : kSkin;
    for (int k = 0; k < 3; ++k) {
      Vec3 normal = seen.normals.row(t[k]);
      if (inside) normal = -normal;
      position(batch_.triangle_positions, seen.points.row(t[k]));
      colour(batch_.triangle_colours, lit(base, brightness(normal) * (inside ? kInsideBrightness : 1.0)));
    }
  }

  void add_line(const SeenSurface& seen, int a, int b) {
    if (!drawable(seen.points, a) || !drawable(seen.points, b)) return;
    for (const int v : {a, b}) {
      position(batch_.line_positions, seen.points.row(v), kLineLift);
      colour(batch_.line_colours, kInk);
    }
  }

  double scale_x_, scale_y_, middle_, scale_z_;
  RasterBatch batch_;
};

}  // namespace

std::string_view view_name(View view) {
  static constexpr std::array<std::string_view, 4> kNames = {"front", "back", "left", "right"};
  return kNames[static_cast<std::size_t>(view)];
}

void Box::add(const Points3& points) {
  for (int i = 0; i < points.rows(); ++i) {
    if (!drawable(points, i)) continue;
    const Vec3 p = points.row(i);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
}

Vec3 Camera::project(const Vec3& point) const {
  const Vec3 d = point - centre;
  return {0.5 * width + d.dot(right) / metres_per_pixel, 0.5 * height - d.dot(up) / metres_per_pixel, d.dot(towards)};
}

Camera camera_for(View view, const Box& box, double metres_per_pixel) {
  const auto [right, towards] = axes_of(view);
  Camera camera{right, Vec3::UnitY(), towards};
  if (!box.empty()) camera.centre = 0.5 * (box.low + box.high);
  const Vec3 size = box.empty() ? Vec3::Zero().eval() : (box.high - box.low).eval();
  const auto pixels = [&](double length) {
    return static_cast<int>(std::clamp(std::ceil(length / metres_per_pixel - 1e-6), 1.0, 8192.0));
  };
  camera.metres_per_pixel = metres_per_pixel;
  camera.width = pixels(std::abs(size.dot(right)));
  camera.height = pixels(size.y());
  return camera;
}

double brightness(const Vec3& normal) {
  static const Vec3 kKey = Vec3(-0.45, 0.55, 0.70).normalized(), kFill = Vec3(0.80, 0.05, 0.60).normalized();
  const auto light = [](const Vec3& n) {
    return 0.30 + 0.62 * std::max(0.0, n.dot(kKey)) + 0.26 * std::max(0.0, n.dot(kFill));
  };
  static const double kFacing = light(Vec3::UnitZ());
  return light(normal) / kFacing;
}

Image paint(const std::vector<Surface>& surfaces, const Camera& camera, int supersample, Rgb background) {
  std::vector<SeenSurface> seen;
  double nearest = -1e300, farthest = 1e300;
  for (const Surface& surface : surfaces) {
    seen.push_back(look_at(surface, camera));
    const Points3& points = seen.back().points;
    for (int v = 0; v < points.rows(); ++v)
      if (drawable(points, v))
        nearest = std::max(nearest, points(v, 2) + kLineLift), farthest = std::min(farthest, points(v, 2));
  }
  if (nearest < farthest) nearest = farthest = 0.0;
  BatchFiller filler(camera, nearest, farthest);
  for (std::size_t i = 0; i < surfaces.size(); ++i) filler.add(surfaces[i], seen[i]);
  RasterBatch batch = filler.take();
  batch.line_width = supersample;
  return rasterise(batch, camera.width * supersample, camera.height * supersample, background);
}

}  // namespace toile
