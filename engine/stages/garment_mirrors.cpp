// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/garment_mirrors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/stages/panel_mirrors.h"

namespace toile {
namespace {

constexpr double kFarthest = 0.15;   // of a panel's worn size: how far it may hang from the mirror image of its image
constexpr double kSamePoint = 2e-6;  // m; flat positions of mirrored vertices

PanelImage inverse(const PanelImage& image, int panel) {
  PanelImage back{panel, image.reflection.transpose(), Vec2::Zero(), std::vector<int>(image.edge_of.size())};
  back.offset = -back.reflection * image.offset;
  for (std::size_t e = 0; e < image.edge_of.size(); ++e)
    back.edge_of[static_cast<std::size_t>(image.edge_of[e])] = static_cast<int>(e);
  return back;
}

class MirrorFinder {
 public:
  MirrorFinder(const Pattern& pattern, const PatternMesh& mesh, const Drape& worn, const MirrorPlane& plane)
      : pattern_(pattern), mesh_(mesh), worn_(worn) {
    const Vec3 normal(plane[0], plane[1], plane[2]);
    normal_ = normal.normalized();
    offset_ = plane[3] / normal.norm();
  }

  GarmentMirrors run() {
    collect();
    std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) { return a.off < b.off; });
    result_.panels.resize(pattern_.panels.size());
    result_.vertex.assign(static_cast<std::size_t>(mesh_.vertex_count()), -1);
    for (const Found& found : found_) accept(found);
    const bool any = std::any_of(result_.panels.begin(), result_.panels.end(),
                                 [](const PanelImage& image) { return image.panel >= 0; });
    return any ? std::move(result_) : GarmentMirrors{};
  }

 private:
  struct Found {
    int panel;
    PanelImage image;
    double off;  // m, mean distance of worn corners from the mirror images of their images
  };

  void collect() {
    const PanelMirrors mirrors = find_panel_mirrors(pattern_);
    const auto add = [&](int panel, const PanelMirror& mirror) {
      const PanelImage image{panel, mirror.reflection, mirror.offset, mirror.edge_of};
      const int source = mirror.source.value;
      const double off = distance(source, image);
      if (off <= kFarthest * worn_size(source)) found_.push_back({source, image, off});
    };
    for (int p = 0; p < static_cast<int>(pattern_.panels.size()); ++p) {
      if (const auto& self = mirrors.self[static_cast<std::size_t>(p)]) add(p, *self);
      for (const PanelMirror& pair : mirrors.pairs[static_cast<std::size_t>(p)]) add(p, pair);
    }
  }

  Vec3 worn_at(int vertex) const {
    return worn_.nodes.row(mesh_.node_of_vertex[static_cast<std::size_t>(vertex)]).transpose();
  }

  // Over points along the edges, at equal shares of their vertices: the image's edge runs the other way.
  double distance(int source, const PanelImage& image) const {
    double sum = 0.0;
    int count = 0;
    for (std::size_t e = 0; e < image.edge_of.size(); ++e) {
      const auto& from = mesh_.edge_vertices[static_cast<std::size_t>(source)][e];
      const auto& to =
          mesh_.edge_vertices[static_cast<std::size_t>(image.panel)][static_cast<std::size_t>(image.edge_of[e])];
      for (const double share : {0.0, 0.5}) {
        const auto at = [&](const std::vector<int>& run, double s) {
          return worn_at(run[static_cast<std::size_t>(std::lround(s * static_cast<double>(run.size() - 1)))]);
        };
        const Vec3 p = at(from, share);
        sum += (p - 2.0 * (normal_.dot(p) - offset_) * normal_ - at(to, 1.0 - share)).norm();
        ++count;
      }
    }
    return count > 0 ? sum / count : 0.0;
  }

  double worn_size(int panel) const {
    const PanelRange& range = mesh_.panels[static_cast<std::size_t>(panel)];
    Vec3 low = worn_at(range.vertex_begin), high = low;
    for (int v = range.vertex_begin; v < range.vertex_end; ++v) {
      low = low.cwiseMin(worn_at(v));
      high = high.cwiseMax(worn_at(v));
    }
    return (high - low).norm();
  }

  void accept(const Found& found) {
    PanelImage& there = result_.panels[static_cast<std::size_t>(found.panel)];
    PanelImage& back = result_.panels[static_cast<std::size_t>(found.image.panel)];
    if (there.panel >= 0 || back.panel >= 0) return;
    there = found.image;
    if (found.image.panel != found.panel) back = inverse(found.image, found.panel);
    match_vertices(found.panel, found.image);
  }

  // Mirrored panels are meshed alike; should they not be, none of their vertices gets an image.
  void match_vertices(int panel, const PanelImage& image) {
    const PanelRange &from = mesh_.panels[static_cast<std::size_t>(panel)],
                     &to = mesh_.panels[static_cast<std::size_t>(image.panel)];
    std::vector<int> by_x(static_cast<std::size_t>(to.vertex_end - to.vertex_begin));
    std::iota(by_x.begin(), by_x.end(), to.vertex_begin);
    std::sort(by_x.begin(), by_x.end(), [&](int a, int b) { return mesh_.rest(a, 0) < mesh_.rest(b, 0); });
    std::vector<int> found;
    for (int v = from.vertex_begin; v < from.vertex_end; ++v) {
      const Vec2 wanted = image.reflection * mesh_.rest.row(v).transpose() + image.offset;
      const int w = nearest(by_x, wanted);
      if (w < 0) return;
      found.push_back(w);
    }
    if (found.size() != by_x.size() || !same_triangles(from, to, found)) return;
    for (int v = from.vertex_begin; v < from.vertex_end; ++v) {
      const int w = found[static_cast<std::size_t>(v - from.vertex_begin)];
      result_.vertex[static_cast<std::size_t>(v)] = w;
      result_.vertex[static_cast<std::size_t>(w)] = v;
    }
  }

  bool same_triangles(const PanelRange& from, const PanelRange& to, const std::vector<int>& image) const {
    using Corners = std::array<int, 3>;
    std::vector<Corners> wanted, there;
    const auto sorted = [](Corners corners) {
      std::sort(corners.begin(), corners.end());
      return corners;
    };
    for (int f = from.triangle_begin; f < from.triangle_end; ++f) {
      const auto at = [&](int k) { return image[static_cast<std::size_t>(mesh_.triangles(f, k) - from.vertex_begin)]; };
      wanted.push_back(sorted({at(0), at(1), at(2)}));
    }
    for (int f = to.triangle_begin; f < to.triangle_end; ++f)
      there.push_back(sorted({mesh_.triangles(f, 0), mesh_.triangles(f, 1), mesh_.triangles(f, 2)}));
    std::sort(wanted.begin(), wanted.end());
    std::sort(there.begin(), there.end());
    return wanted == there;
  }

  int nearest(const std::vector<int>& by_x, const Vec2& wanted) const {
    auto at = std::lower_bound(by_x.begin(), by_x.end(), wanted.x() - kSamePoint,
                               [&](int v, double x) { return mesh_.rest(v, 0) < x; });
    for (; at != by_x.end() && mesh_.rest(*at, 0) <= wanted.x() + kSamePoint; ++at)
      if (std::abs(mesh_.rest(*at, 1) - wanted.y()) <= kSamePoint) return *at;
    return -1;
  }

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const Drape& worn_;
  Vec3 normal_;
  double offset_ = 0.0;
  std::vector<Found> found_;
  GarmentMirrors result_;
};

bool mirrored(const PatternMesh& mesh, const GarmentMirrors& mirrors, int panel) {
  return mirrors.panels[static_cast<std::size_t>(panel)].panel >= 0 &&
         mirrors.vertex[static_cast<std::size_t>(mesh.panels[static_cast<std::size_t>(panel)].vertex_begin)] >= 0;
}

}  // namespace

const PanelImage* GarmentMirrors::image_of(int panel) const {
  if (empty() || panels[static_cast<std::size_t>(panel)].panel < 0) return nullptr;
  return &panels[static_cast<std::size_t>(panel)];
}

GarmentMirrors find_garment_mirrors(const Pattern& pattern, const PatternMesh& mesh, const Drape& worn,
                                    const MirrorPlane& plane) {
  return MirrorFinder(pattern, mesh, worn, plane).run();
}

void symmetrise_forces(const PatternMesh& mesh, const GarmentMirrors& mirrors, Eigen::MatrixXd& forces) {
  for (int p = 0; p < static_cast<int>(mirrors.panels.size()); ++p) {
    const PanelImage& image = mirrors.panels[static_cast<std::size_t>(p)];
    if (image.panel < p || !mirrored(mesh, mirrors, p)) continue;  // the earlier panel of a pair does both
    const PanelRange& range = mesh.panels[static_cast<std::size_t>(p)];
    for (int v = range.vertex_begin; v < range.vertex_end; ++v) {
      const int w = mirrors.vertex[static_cast<std::size_t>(v)];
      if (image.panel == p && w < v) continue;
      const Vec2 there = image.reflection * forces.row(v).transpose();
      const Vec2 mean = 0.5 * (there + forces.row(w).transpose());
      forces.row(v) = (image.reflection.transpose() * mean).transpose();
      forces.row(w) = mean.transpose();
    }
  }
}

void symmetrise(const PatternMesh& mesh, const GarmentMirrors& mirrors, Points2& rest) {
  for (int p = 0; p < static_cast<int>(mirrors.panels.size()); ++p) {
    const PanelImage& image = mirrors.panels[static_cast<std::size_t>(p)];
    if (image.panel < p || !mirrored(mesh, mirrors, p)) continue;
    const PanelRange& range = mesh.panels[static_cast<std::size_t>(p)];
    Vec2 offset = Vec2::Zero();
    for (int v = range.vertex_begin; v < range.vertex_end; ++v)
      offset += rest.row(mirrors.vertex[static_cast<std::size_t>(v)]).transpose() -
                image.reflection * rest.row(v).transpose();
    offset /= range.vertex_end - range.vertex_begin;
    const Points2 before = rest;
    for (int v = range.vertex_begin; v < range.vertex_end; ++v) {
      const int w = mirrors.vertex[static_cast<std::size_t>(v)];
      if (image.panel == p && w < v) continue;
      const Vec2 here = before.row(v).transpose(), there = before.row(w).transpose();
      const Vec2 mean = 0.5 * (here + image.reflection.transpose() * (there - offset));
      rest.row(v) = mean.transpose();
      rest.row(w) = (image.reflection * mean + offset).transpose();
    }
  }
}

}  // namespace toile
