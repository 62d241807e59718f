// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/find_arm.h"

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/geometry/convex_hull.h"
#include "engine/geometry/edge_graph.h"

namespace toile {
namespace {

// Fractions of the height.
constexpr double kRingStep = 0.01;
constexpr int kRings = 66;                                 // to 0.65: past every armpit
constexpr double kTrunkBand = 0.09;                        // half width of the trunk that distances start from
constexpr double kForearmLow = 0.16, kForearmHigh = 0.30;  // rings whose median girth is the arm's
constexpr double kGrown = 1.75;                            // times that girth: the ring has grown onto the trunk
// Fractions of the arm's length from the finger tip.
constexpr double kHandEnd = 0.03, kWrist = 0.31, kElbow = 0.65, kBelowElbow = 0.68, kUpperArm = 0.90;
constexpr double kShoulder = 1.03;
constexpr double kBendLow = 0.54, kBendHigh = 0.78, kBendStep = 0.01;  // where the bend of an elbow is sought
constexpr double kForearmFrom = 0.36;
constexpr double kBent = 0.94;  // cosine over which an arm is straight: its elbow is then taken by length

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

// Hull girth of points round a limb, in the plane that fits them best.
double girth_in_own_plane(const std::vector<Vec3>& points, const Vec3& centre) {
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - centre) * (p - centre).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  std::vector<Vec2> flat;
  for (const Vec3& p : points)
    flat.emplace_back((p - centre).dot(axes.eigenvectors().col(2)), (p - centre).dot(axes.eigenvectors().col(1)));
  return hull_perimeter(std::move(flat));
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Point at distance d on the centre line whose points lie one ring step apart, the first at one step.
Vec3 along(const Points3& line, double step, double d) {
  const double at_ring = std::clamp(d / step - 1.0, 0.0, static_cast<double>(line.rows()) - 1.0);
  const auto i = std::min(static_cast<Eigen::Index>(at_ring), line.rows() - 2);
  const double t = at_ring - static_cast<double>(i);
  return (1.0 - t) * line.row(i) + t * line.row(i + 1);
}

struct Line {
  Vec3 middle, direction;  // direction of rising distance, unit
  double misfit;           // sum of squared distances of its points
};

// The line that fits best to the centre line between two distances.
Line fit_line(const Points3& line, double step, double from, double to) {
  std::vector<Vec3> points;
  for (double d = from; d <= to + 1e-9; d += step) points.push_back(along(line, step, d));
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points) middle += p;
  middle /= static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  Vec3 direction = axes.eigenvectors().col(2);
  if (direction.dot(points.back() - points.front()) < 0) direction = -direction;
  return {middle, direction, axes.eigenvalues()[0] + axes.eigenvalues()[1]};
}

struct Bend {
  double at;   // fraction of the arm's length
  Vec3 joint;  // where forearm and upper arm meet
  Vec3 upper;  // direction of the upper arm, towards the shoulder
};

// The point between two lines that is nearest to both.
Vec3 meeting_point(const Line& a, const Line& b) {
  const Vec3 gap = b.middle - a.middle;
  const double c = a.direction.dot(b.direction), da = a.direction.dot(gap), db = b.direction.dot(gap);
  const double s = (da - c * db) / (1.0 - c * c), t = (c * da - db) / (1.0 - c * c);
  return 0.5 * (a.middle + s * a.direction + b.middle + t * b.direction);
}

// Where the centre line is best fitted by two straight pieces; none if the arm is straight.
std::optional<Bend> find_bend(const Points3& line, double step, double length) {
  double least = 1e300;
  std::optional<Bend> best;
  for (double at_fraction = kBendLow; at_fraction <= kBendHigh; at_fraction += kBendStep) {
    const Line fore = fit_line(line, step, kForearmFrom * length, at_fraction * length);
    const Line upper = fit_line(line, step, at_fraction * length, kUpperArm * length);
    if (fore.misfit + upper.misfit >= least) continue;
    least = fore.misfit + upper.misfit;
    best.reset();
    if (fore.direction.dot(upper.direction) < kBent)
      best = Bend{at_fraction, meeting_point(fore, upper), upper.direction};
  }
  return best;
}

struct Rings {
  std::vector<std::vector<Vec3>> points;
  std::vector<Vec3> centre;
  std::vector<double> girth;
};

// Ring q holds the points of mesh edges at distance (q + 1) steps, on the arm's side of the body.
Rings collect_rings(const TriangleMesh& body, const EdgeGraph& graph, const Eigen::VectorXd& distance, Side side,
                    double step) {
  Rings rings;
  rings.points.resize(kRings);
  for (const auto& [a, b] : graph.edges()) {
    const double da = distance[a], db = distance[b];
    if (!std::isfinite(da) || !std::isfinite(db) || da == db) continue;
    if ((body.vertices(a, 0) > 0) != (side == Left)) continue;
    const int first = static_cast<int>(std::ceil(std::min(da, db) / step)),
              last = static_cast<int>(std::max(da, db) / step);
    for (int q = std::max(first, 1); q <= std::min(last, kRings); ++q) {
      const double t = (q * step - da) / (db - da);
      rings.points[at(q - 1)].push_back((1.0 - t) * body.vertices.row(a) + t * body.vertices.row(b));
    }
  }
  for (const auto& points : rings.points) {
    if (points.size() < 3) break;
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : points) centre += p;
    rings.centre.push_back(centre / static_cast<double>(points.size()));
    rings.girth.push_back(girth_in_own_plane(points, rings.centre.back()));
  }
  return rings;
}

Skeleton::Arm build_arm(const Rings& rings, double height) {
  const double step = kRingStep * height;
  Skeleton::Arm arm;
  const auto ring_at = [](double fraction) { return static_cast<std::size_t>(std::lround(fraction / kRingStep)) - 1; };
  if (rings.girth.size() <= ring_at(kForearmHigh)) return arm;
  const double usual = median({rings.girth.begin() + static_cast<std::ptrdiff_t>(ring_at(kForearmLow)),
                               rings.girth.begin() + static_cast<std::ptrdiff_t>(ring_at(kForearmHigh)) + 1});
  std::size_t end = ring_at(kForearmHigh) - 1;
  while (end < rings.girth.size() && rings.girth[end] <= kGrown * usual) ++end;
  if (end == rings.girth.size()) return arm;

  const double before = end > 0 ? rings.girth[end - 1] : 0.0;
  const double part = std::clamp((kGrown * usual - before) / std::max(rings.girth[end] - before, 1e-9), 0.0, 1.0);
  arm.length = (static_cast<double>(end) + part) * step;
  arm.centre_line.resize(static_cast<Eigen::Index>(end), 3);
  for (std::size_t q = 0; q < end; ++q) arm.centre_line.row(static_cast<Eigen::Index>(q)) = rings.centre[q];
  std::vector<double> girths;
  for (std::size_t q = 0; q < end; ++q) {
    const double d = static_cast<double>(q + 1) * step / arm.length;
    if (d >= 0.45 && d <= 0.85) girths.push_back(rings.girth[q]);
  }
  arm.girth = median(std::move(girths));
  const auto on_line = [&](double fraction) { return along(arm.centre_line, step, fraction * arm.length); };
  arm.hand_end = on_line(kHandEnd);
  if (const auto bend = find_bend(arm.centre_line, step, arm.length)) {
    const double reach = bend->at / kElbow;  // what the arm's length should be by the place of its elbow
    arm.elbow = bend->joint;
    arm.wrist = on_line(kWrist * reach);
    arm.shoulder = arm.elbow + bend->upper * (kShoulder - kElbow) * reach * arm.length;
  } else {
    arm.elbow = on_line(kElbow);
    arm.wrist = on_line(kWrist);
    const Vec3 upper = on_line(kUpperArm) - on_line(kBelowElbow);
    arm.shoulder = on_line(kUpperArm) + upper * (kShoulder - kUpperArm) / (kUpperArm - kBelowElbow);
  }
  return arm;
}

std::vector<int> trunk_vertices(const TriangleMesh& body, double height, double level) {
  for (const double band : {0.01, 0.02, 0.04}) {
    std::vector<int> found;
    for (int v = 0; v < body.vertex_count(); ++v)
      if (std::abs(body.vertices(v, 0)) < kTrunkBand * height && std::abs(body.vertices(v, 1) - level) < band * height)
        found.push_back(v);
    if (found.size() >= 4) return found;
  }
  return {};
}

std::array<ArmRings, 2> arm_rings(const TriangleMesh& body, const EdgeGraph& graph, double height, double armpit_y) {
  const std::vector<int> trunk = trunk_vertices(body, height, armpit_y - 0.1 * height);
  const Eigen::VectorXd from_trunk = graph.distances(trunk);
  std::array<ArmRings, 2> arms;
  for (const Side side : {Left, Right}) {
    ArmRings& arm = arms[side];
    for (int v = 0; v < body.vertex_count(); ++v) {
      const double x = side == Left ? body.vertices(v, 0) : -body.vertices(v, 0);
      const double y = body.vertices(v, 1) / height;
      if (x < 0.10 * height || y < 0.28 || y > 0.95 || !std::isfinite(from_trunk[v])) continue;
      if (arm.tip < 0 || from_trunk[v] > from_trunk[arm.tip]) arm.tip = v;
    }
    if (arm.tip < 0)
      throw Error(ErrorCode::BodyNotRecognised, "body",
                  print_text("no %s arm was found: both whole arms are needed, free of the trunk",
                             side == Left ? "left" : "right"));
    arm.distance = graph.distances(std::array{arm.tip});
  }
  return arms;
}

}  // namespace

std::array<ArmRings, 2> find_arm_rings(const TriangleMesh& body, double height, double armpit_y) {
  return arm_rings(body, EdgeGraph(body), height, armpit_y);
}

std::array<Skeleton::Arm, 2> find_arms(const TriangleMesh& body, double height, double armpit_y) {
  const EdgeGraph graph(body);
  const auto rings = arm_rings(body, graph, height, armpit_y);
  std::array<Skeleton::Arm, 2> arms;
  for (const Side side : {Left, Right})
    arms[side] = build_arm(collect_rings(body, graph, rings[side].distance, side, kRingStep * height), height);
  return arms;
}

}  // namespace toile
