// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/arrange_panels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace toile {
namespace {

constexpr double kShoulderBand = 0.09;  // m below the highest torso seam point that counts as shoulder
constexpr double kSearchRange = 0.10, kSearchStep = 0.005;  // m, of the torso's height
constexpr double kDepthCap = 0.05, kClearance = 0.005;      // m
constexpr double kSleeveLower = 0.6;                        // share of the sleeve that is centred on the arm
constexpr int kStations = 21;
constexpr double kLegStation = 0.02, kLegBlend = 0.15;                      // m
constexpr double kMarchStep = 0.005, kMarchMost = 0.10, kMarchGap = 0.002;  // m
constexpr double kOppositeSides = 0.03;  // m in z between the middles of front and back panels

// A pattern vertex on each side of a seam.
struct SeamPair {
  int a, b;
};

class Arranger {
 public:
  Arranger(const Pattern& pattern, const PatternMesh& mesh, const GarmentClass& garment, const BodyGuides& guides,
           const BodyLevels& levels, SignedField& field, const ArrangeOptions& options)
      : pattern_(pattern),
        mesh_(mesh),
        garment_(garment),
        guides_(guides),
        levels_(levels),
        field_(field),
        options_(options),
        x_(placed_vertices(pattern, mesh)) {
    for (const auto& seam : mesh.seam_vertices)
      for (const auto& [a, b] : seam) pairs_.push_back({a, b});
  }

  ArrangeResult run() {
    if (garment_.bodice) {
      place_torso();
      close_gap_below();
    } else {
      raise_all(guides_.levels.waist_y - levels_.waist_y);
    }
    for (const Side side : {Left, Right}) {
      place_sleeve(side);
      place_leg(side);
    }
    result_.nodes = welded(mesh_, x_);
    if (!garment_.bodice) measure_waist();
    march_out();
    return result_;
  }

 private:
  const PanelClass& class_of(int vertex) const {
    return garment_.panels[static_cast<std::size_t>(mesh_.panel_of_vertex[static_cast<std::size_t>(vertex)])];
  }
  double panel_z(int vertex) const {
    const PanelRange& range =
        mesh_.panels[static_cast<std::size_t>(mesh_.panel_of_vertex[static_cast<std::size_t>(vertex)])];
    return x_.col(2).segment(range.vertex_begin, range.vertex_end - range.vertex_begin).mean();
  }
  template <class Choice>
  void shift(const Vec3& by, const Choice& choice) {
    for (Eigen::Index v = 0; v < x_.rows(); ++v)
      if (choice(class_of(static_cast<int>(v)))) x_.row(v) += by.transpose();
  }
  void raise_all(double dy) { x_.col(1).array() += dy; }

  // Seam points between front and back torso panels.
  std::vector<SeamPair> torso_pairs() const {
    std::vector<SeamPair> chosen;
    for (const SeamPair& pair : pairs_)
      if (class_of(pair.a).torso && class_of(pair.b).torso &&
          std::abs(panel_z(pair.a) - panel_z(pair.b)) > kOppositeSides)
        chosen.push_back(pair);
    return chosen;
  }
  Vec3 middle(const SeamPair& pair) const { return 0.5 * (x_.row(pair.a) + x_.row(pair.b)).transpose(); }

  // D1, D2: the torso's seams over the shoulders' middle plane, and as low as they clear the body, then a little up.
  void place_torso() {
    const std::vector<SeamPair> pairs = torso_pairs();
    if (pairs.empty()) return;
    double top = -std::numeric_limits<double>::infinity(), z = 0;
    for (const SeamPair& pair : pairs) top = std::max(top, middle(pair).y());
    int shoulder = 0;
    for (const SeamPair& pair : pairs)
      if (middle(pair).y() > top - kShoulderBand) z += middle(pair).z(), ++shoulder;
    const auto upper = [](const PanelClass& c) { return c.kind == PanelKind::Trunk || c.kind == PanelKind::Arm; };
    const auto trunk = [](const PanelClass& c) { return c.kind == PanelKind::Trunk; };
    shift(Vec3(0, 0, guides_.shoulder_z - z / shoulder), trunk);
    const double own = guides_.levels.shoulder_y - levels_.shoulder_y;
    const double found = own + best_height(pairs, own);
    result_.upper_shift = found + options_.lift;
    shift(Vec3(0, result_.upper_shift, 0), upper);
  }

  // Height in a range round `from` at which the torso's seam points lie least inside the body.
  double best_height(const std::vector<SeamPair>& pairs, double from) {
    const int steps = static_cast<int>(std::lround(kSearchRange / kSearchStep));
    double best = 0, least = std::numeric_limits<double>::infinity();
    for (int i = -steps / 2; i <= steps; ++i) {
      const double dy = i * kSearchStep;
      double cost = 0;
      for (const SeamPair& pair : pairs) {
        Vec3 gradient;
        const double gap = field_.evaluate(middle(pair) + Vec3(0, from + dy, 0), kClearance, gradient);
        cost += std::clamp(kClearance - gap, 0.0, kDepthCap);
      }
      cost = cost / static_cast<double>(pairs.size()) + 1e-3 * std::abs(dy);
      if (cost < least) least = cost, best = dy;
    }
    result_.at_limit = best >= kSearchRange - 0.5 * kSearchStep;
    return best;
  }

  // D3: skirts and trousers up to the torso they are sewn to.
  void close_gap_below() {
    const auto below = [](const PanelClass& c) {
      return c.kind == PanelKind::TrouserLeg || c.kind == PanelKind::Skirt;
    };
    double gap = 0;
    int count = 0;
    for (const SeamPair& pair : pairs_)
      for (const auto& [v, w] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)})
        if (below(class_of(v)) && class_of(w).kind == PanelKind::Trunk) gap += x_(w, 1) - x_(v, 1), ++count;
    if (count > 0) shift(Vec3(0, gap / count, 0), below);
  }

  // D4: along the arm to the armhole, then the lower part's middle onto the arm's, station by station.
  void place_sleeve(Side side) {
    const auto mine = [side](const PanelClass& c) { return c.kind == PanelKind::Arm && c.side == side; };
    const Vec3 d = guides_.arm_direction[side], across(-d.y(), d.x(), 0), origin = guides_.arm[side].front();
    double gap = 0;
    int count = 0;
    for (const SeamPair& pair : pairs_)
      for (const auto& [v, w] : {std::pair(pair.a, pair.b), std::pair(pair.b, pair.a)})
        if (mine(class_of(v)) && class_of(w).kind == PanelKind::Trunk) gap += (x_.row(w) - x_.row(v)).dot(d), ++count;
    if (count > 0) shift(gap / count * d, mine);

    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto along = [&](Eigen::Index v) { return (x_.row(v).transpose() - origin).dot(d); };
    std::vector<Eigen::Index> vertices;
    for (Eigen::Index v = 0; v < x_.rows(); ++v)
      if (mine(class_of(static_cast<int>(v)))) {
        vertices.push_back(v);
        low = std::min(low, along(v)), high = std::max(high, along(v));
      }
    if (vertices.empty()) return;
    const double first = high - kSleeveLower * (high - low), step = (high - first) / (kStations - 1);
    std::vector<Vec2> shifts(kStations, Vec2::Zero());  // across, z
    for (int i = 0; i < kStations; ++i) {
      const double at = first + i * step;
      Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity()), most = -least;
      for (const Eigen::Index v : vertices) {
        if (std::abs(along(v) - at) > std::max(step, mesh_.target_edge_length)) continue;
        const Vec2 here((x_.row(v).transpose() - origin).dot(across), x_(v, 2));
        least = least.cwiseMin(here), most = most.cwiseMax(here);
      }
      const Vec3 arm = guides_.arm_at(side, at);
      if (least.x() <= most.x())
        shifts[static_cast<std::size_t>(i)] = Vec2((arm - origin).dot(across), arm.z()) - 0.5 * (least + most);
      else if (i > 0)
        shifts[static_cast<std::size_t>(i)] = shifts[static_cast<std::size_t>(i - 1)];
    }
    for (const Eigen::Index v : vertices) {
      const double t = step > 0 ? std::clamp((along(v) - first) / step, 0.0, kStations - 1.0) : 0.0;
      const auto k = static_cast<std::size_t>(std::min(static_cast<int>(t), kStations - 2));
      const Vec2 s = shifts[k] + (t - static_cast<double>(k)) * (shifts[k + 1] - shifts[k]);
      x_.row(v) += (s.x() * across + Vec3(0, 0, s.y())).transpose();
    }
  }

  // D5: trouser legs' middle onto the leg's, growing over 15 cm below the crotch.
  void place_leg(Side side) {
    std::vector<Eigen::Index> vertices;
    double low = std::numeric_limits<double>::infinity();
    for (Eigen::Index v = 0; v < x_.rows(); ++v) {
      const PanelClass& c = class_of(static_cast<int>(v));
      if (c.kind != PanelKind::TrouserLeg || c.side != side) continue;
      vertices.push_back(v);
      low = std::min(low, x_(v, 1));
    }
    const double crotch = guides_.levels.crotch_y;
    if (vertices.empty() || low >= crotch) return;
    const int stations = static_cast<int>((crotch - low) / kLegStation) + 2;
    std::vector<Vec2> shifts(static_cast<std::size_t>(stations), Vec2::Zero());
    for (int i = 0; i < stations; ++i) {
      const double y = crotch - i * kLegStation;
      Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity()), most = -least;
      for (const Eigen::Index v : vertices) {
        if (std::abs(x_(v, 1) - y) > std::max(kLegStation, mesh_.target_edge_length)) continue;
        const Vec2 here(x_(v, 0), x_(v, 2));
        least = least.cwiseMin(here), most = most.cwiseMax(here);
      }
      const Vec3 leg = guides_.leg_at(side, y);
      if (least.x() <= most.x())
        shifts[static_cast<std::size_t>(i)] =
            std::min(1.0, (crotch - y) / kLegBlend) * (Vec2(leg.x(), leg.z()) - 0.5 * (least + most));
      else if (i > 0)
        shifts[static_cast<std::size_t>(i)] = shifts[static_cast<std::size_t>(i - 1)];
    }
    for (const Eigen::Index v : vertices) {
      const double t = std::clamp((crotch - x_(v, 1)) / kLegStation, 0.0, stations - 1.0);
      const auto k = static_cast<std::size_t>(std::min(static_cast<int>(t), stations - 2));
      const Vec2 s = shifts[k] + (t - static_cast<double>(k)) * (shifts[k + 1] - shifts[k]);
      x_(v, 0) += s.x(), x_(v, 2) += s.y();
    }
  }

  void measure_waist() {
    const std::vector<int> nodes = waist_nodes(pattern_, mesh_, x_);
    for (int n : nodes) result_.waist_height += result_.nodes(n, 1) / static_cast<double>(nodes.size());
  }

  // D6: seam nodes inside the body leave it in the direction in which their panels end.
  void march_out() {
    Points3 outward = Points3::Zero(mesh_.node_count, 3);
    for (std::size_t p = 0; p < mesh_.edge_vertices.size(); ++p) {
      const Mat3& rotation = pattern_.panels[p].rotation;
      const double sign = mesh_.panel_reversed[p] ? -1 : 1;  // an outline listed clockwise has its inside on the right
      for (const std::vector<int>& edge : mesh_.edge_vertices[p])
        for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
          const Vec2 along = (mesh_.rest.row(edge[i + 1]) - mesh_.rest.row(edge[i])).transpose();
          const Vec3 normal = rotation * Vec3(sign * along.y(), -sign * along.x(), 0);
          for (int v : {edge[i], edge[i + 1]})
            outward.row(mesh_.node_of_vertex[static_cast<std::size_t>(v)]) += normal.transpose();
        }
    }
    std::vector<bool> seam(static_cast<std::size_t>(mesh_.node_count), false);
    for (const SeamPair& pair : pairs_)
      seam[static_cast<std::size_t>(mesh_.node_of_vertex[static_cast<std::size_t>(pair.a)])] = true;
    const double clear = options_.thickness + kMarchGap;
    for (Eigen::Index i = 0; i < result_.nodes.rows(); ++i) {
      const double length = outward.row(i).norm();
      if (!seam[static_cast<std::size_t>(i)] || length < 1e-9) continue;
      const Vec3 start = result_.nodes.row(i), step = kMarchStep / length * outward.row(i).transpose();
      Vec3 p = start, gradient;
      double gone = 0;
      while (gone <= kMarchMost && field_.evaluate(p, clear, gradient) < clear) p += step, gone += kMarchStep;
      if (gone <= kMarchMost) result_.nodes.row(i) = p.transpose();
    }
  }

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const GarmentClass& garment_;
  const BodyGuides& guides_;
  const BodyLevels& levels_;
  SignedField& field_;
  const ArrangeOptions& options_;
  Points3 x_;  // #V x 3
  std::vector<SeamPair> pairs_;
  ArrangeResult result_;
};

std::vector<std::vector<bool>> sewn_edges(const Pattern& pattern) {
  std::vector<std::vector<bool>> sewn;
  for (const Panel& panel : pattern.panels) sewn.emplace_back(panel.edges.size(), false);
  for (const Seam& seam : pattern.seams)
    for (const SeamSide& side : {seam.a, seam.b})
      sewn[static_cast<std::size_t>(side.panel.value)][static_cast<std::size_t>(side.edge)] = true;
  return sewn;
}

}  // namespace

Points3 placed_vertices(const Pattern& pattern, const PatternMesh& mesh) {
  Points3 placed(mesh.vertex_count(), 3);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(mesh.panel_of_vertex[static_cast<std::size_t>(v)])];
    placed.row(v) = (panel.rotation * Vec3(mesh.rest(v, 0), mesh.rest(v, 1), 0) + panel.translation).transpose();
  }
  return placed;
}

Points3 welded(const PatternMesh& mesh, const Points3& vertices) {
  Points3 nodes = Points3::Zero(mesh.node_count, 3);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(mesh.node_count);
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
    nodes.row(node) += vertices.row(v);
    count[node] += 1;
  }
  return nodes.array().colwise() / count.array();
}

std::vector<std::vector<int>> free_lines(const Pattern& pattern, const PatternMesh& mesh) {
  const std::vector<std::vector<bool>> sewn = sewn_edges(pattern);
  std::vector<int> line_of(static_cast<std::size_t>(mesh.node_count), -1);
  const auto root = [&](int node) {
    while (line_of[static_cast<std::size_t>(node)] != node) node = line_of[static_cast<std::size_t>(node)];
    return node;
  };
  for (std::size_t p = 0; p < sewn.size(); ++p)
    for (std::size_t e = 0; e < sewn[p].size(); ++e) {
      if (sewn[p][e]) continue;
      int last = -1;
      for (int v : mesh.edge_vertices[p][e]) {
        const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
        if (line_of[static_cast<std::size_t>(node)] < 0) line_of[static_cast<std::size_t>(node)] = node;
        if (last >= 0) {
          const auto [low, high] = std::minmax({root(last), root(node)});
          line_of[static_cast<std::size_t>(high)] = low;
        }
        last = node;
      }
    }
  std::map<int, std::vector<int>> lines;
  for (int node = 0; node < mesh.node_count; ++node)
    if (line_of[static_cast<std::size_t>(node)] >= 0) lines[root(node)].push_back(node);
  std::vector<std::vector<int>> result;
  for (auto& [first, line] : lines) result.push_back(std::move(line));
  return result;
}

std::vector<int> waist_nodes(const Pattern& pattern, const PatternMesh& mesh, const Points3& vertices) {
  std::vector<int> nodes;
  const auto add_edge = [&](const std::vector<int>& edge) {
    for (int v : edge) nodes.push_back(mesh.node_of_vertex[static_cast<std::size_t>(v)]);
  };
  for (std::size_t p = 0; p < pattern.panels.size(); ++p)
    for (std::size_t e = 0; e < pattern.panels[p].edges.size(); ++e)
      if (pattern.panels[p].edges[e].label == "lower_interface") add_edge(mesh.edge_vertices[p][e]);
  if (nodes.empty()) {
    const std::vector<std::vector<bool>> sewn = sewn_edges(pattern);
    const auto height = [&](const std::vector<int>& edge) {
      double sum = 0;
      for (int v : edge) sum += vertices(v, 1) / static_cast<double>(edge.size());
      return sum;
    };
    double top = -std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t p = 0; p < sewn.size(); ++p)
        for (std::size_t e = 0; e < sewn[p].size(); ++e) {
          if (sewn[p][e]) continue;
          const double y = height(mesh.edge_vertices[p][e]);
          if (pass == 0)
            top = std::max(top, y);
          else if (y > top - kShoulderBand)
            add_edge(mesh.edge_vertices[p][e]);
        }
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

ArrangeResult arrange_panels(const Pattern& pattern, const PatternMesh& mesh, const GarmentClass& garment,
                             const BodyGuides& guides, const BodyLevels& levels, SignedField& field,
                             const ArrangeOptions& options) {
  return Arranger(pattern, mesh, garment, guides, levels, field, options).run();
}

}  // namespace toile
