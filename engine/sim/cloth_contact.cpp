// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/cloth_contact.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/closest_features.h"
#include "engine/geometry/closest_point.h"

namespace toile {
namespace {

constexpr double kLeastReach = 0.3, kMostReach = 0.75;  // of the mean edge: less than a row of triangles
constexpr double kWiderReach = 1.0;                     // within which candidates are searched, of the mean edge
constexpr double kReachPerMove = 4.0;                   // reach over the largest move between two refreshes
constexpr double kLeastGap = 1e-9;                      // m: closer features have no direction between them
constexpr double kPlaneMargin = 0.2;                    // share of the gap that stays free on either side of a plane
// Pairs repel that are this many thicknesses apart when they are looked for: the planes keep all others from coming
// nearer than the thickness before the next look.
constexpr double kListed = 2.5;
constexpr double kUnfolded = 0.8;  // share of the distance in the panel at which two of its features count as flat
// Shares of the pressure that a pair answers for: both layers have vertices, a layer has three edges a vertex, and an
// edge crosses 2.2 of another layer's.
constexpr double kVertexShare = 1.0 / 4, kEdgeShare = 1.0 / 6 / 2.2;
constexpr int kMarkedRings = 1;
constexpr double kRoundedUp = 1 + 1e-9;  // bounds of moves stay bounds, whatever the rounding

// Largest distance of a row of `a` from that of `b`.
double farthest(const Points3& a, const Points3& b) {
  return std::sqrt((a - b).rowwise().squaredNorm().maxCoeff());
}

template <class T>
decltype(auto) at(T& list, int i) {
  return list[static_cast<std::size_t>(i)];
}

}  // namespace

ClothContact::ClothContact(const Cloth& cloth, const PatternMesh& mesh, const ClothContactOptions& options)
    : cloth_(cloth),
      options_(options),
      features_(mesh),
      rest_centre_(features_.centres()),
      patches_(features_.triangles, rest_centre_, features_.panel),
      vertex_share_(static_cast<std::size_t>(cloth.node_count), 1.0),
      edge_share_(features_.edges.size(), 1.0),
      reach_(kMostReach * cloth.mean_edge),
      marked_(static_cast<std::size_t>(cloth.node_count), false),
      swelling_(Points3::Zero(cloth.node_count, 3)) {
  boxes_.resize(static_cast<std::size_t>(features_.triangle_count()));
  centre_.setZero(features_.triangle_count(), 3);
  normal_.setZero(features_.triangle_count(), 3);
  if (options.half) leave_out_other_half();
}

void ClothContact::leave_out_other_half() {
  const std::vector<int>& side = options_.half->side;
  const auto share = [](int least, int most) { return least == 0 && most == 0 ? 0.5 : least < 0 ? 0.0 : 1.0; };
  for (std::size_t n = 0; n < side.size(); ++n) vertex_share_[n] = share(side[n], side[n]);
  for (std::size_t e = 0; e < edge_share_.size(); ++e) {
    const auto [a, b] = features_.edges[e].node;
    edge_share_[e] = share(std::min(at(side, a), at(side, b)), std::max(at(side, a), at(side, b)));
  }
  std::vector<char> other(boxes_.size());
  for (int f = 0; f < features_.triangle_count(); ++f)
    at(other, f) = std::max({at(side, corner(f, 0)), at(side, corner(f, 1)), at(side, corner(f, 2))}) < 0;
  patches_.leave_out(other);
  whole_.setZero(cloth_.node_count, 3);
}

const Points3& ClothContact::whole(const Points3& nodes) {
  if (!options_.half) return nodes;
  options_.half->unfold(nodes, whole_);
  return whole_;
}

double ClothContact::energy_gradient(const Points3& nodes, Points3& gradient) {
  if (!options_.half) return pairs_.energy_gradient(nodes, gradient);
  if (pairs_.empty()) return 0;
  forces_.setZero(cloth_.node_count, 3);
  const double energy = pairs_.energy_gradient(whole(nodes), forces_);
  options_.half->add_folded(forces_, gradient);
  return energy;
}

// Layers that touch their own reflections may not move across x = 0, which is the way that matters.
void ClothContact::add_stiffness(const Points3& nodes, std::vector<Eigen::Triplet<double>>& entries) {
  const std::size_t before = entries.size();
  pairs_.add_stiffness(whole(nodes), entries);
  if (!options_.half) return;
  const HalfCloth& half = *options_.half;
  for (std::size_t k = before; k < entries.size(); ++k) {
    const auto i = static_cast<int>(entries[k].row()), j = static_cast<int>(entries[k].col());
    const auto [column, row] = std::minmax({at(half.row, i), at(half.row, j)});
    double value = entries[k].value();
    if ((at(half.side, i) < 0) != (at(half.side, j) < 0)) value = -value;
    if (i != j && row == column) value *= 2;
    entries[k] = {row, column, value};
  }
}

bool ClothContact::refresh(const Points3& nodes) {
  const bool pierced = !piercings_.empty();
  if (fresh_) {
    const double moved = farthest(nodes, seen_at_);
    reach_ = std::clamp(kReachPerMove * moved, std::max(kLeastReach * cloth_.mean_edge, 2 * options_.thickness),
                        kMostReach * cloth_.mean_edge);
  }
  const Points3& all = whole(nodes);
  seen_at_ = nodes;
  moved_ = 0;
  fresh_ = true;
  stale_ = false;
  hindered_ = false;
  near_.clear(), pairs_.clear(), planes_.clear();
  find_near(all);
  find_piercings(all);
  mark_around_piercings();
  for (const auto& [f, g] : near_) {
    find_vertex_pairs(all, f, g);
    find_vertex_pairs(all, g, f);
    find_edge_pairs(all, f, g);
  }
  for (const PiercedTriangle& piercing : piercings_) add_push(all, piercing);
  if (options_.mirror && !options_.half) planes_.reflect(options_.mirror->image);
  planes_.sort(nodes);
  return pierced || !piercings_.empty() || swollen_;
}

void ClothContact::swell(const Points3& nodes) {
  pairs_.swell(whole(nodes), options_.mirror ? options_.mirror->image : std::vector<int>(), swelling_);
  if (options_.mirror) symmetrise(*options_.mirror, swelling_);
  swollen_ = swelling_.any();
}

// Of a pair's closest points towards each other.
double ClothContact::swelling(const LayerPair& pair, const std::array<double, 4>& weight) const {
  double sum = 0;
  if (!swollen_) return sum;
  for (std::size_t k = 0; k < 4; ++k) sum += std::max(0.0, weight[k] * swelling_.row(pair.node[k]).dot(pair.normal));
  return sum;
}

// Triangles within reach, out of candidates that are searched for anew only where nodes have moved too far.
void ClothContact::find_near(const Points3& nodes) {
  if (patches_.update(nodes, reach_, kWiderReach * cloth_.mean_edge)) find_involved();
  for (const int f : involved_) {
    const Vec3 a = nodes.row(corner(f, 0)), b = nodes.row(corner(f, 1)), c = nodes.row(corner(f, 2));
    boxes_[static_cast<std::size_t>(f)] = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
    centre_.row(f) = ((a + b + c) / 3).transpose();
    normal_.row(f) = (b - a).cross(c - a).transpose();
  }
  for (const auto& [f, g] : patches_.near())
    if (at(boxes_, f).near(at(boxes_, g), reach_) && !unfolded(f, g)) near_.emplace_back(f, g);
}

void ClothContact::find_involved() {
  std::vector<char> involved(boxes_.size(), false);
  for (const auto& [f, g] : patches_.near()) at(involved, f) = at(involved, g) = true;
  involved_.clear();
  for (int f = 0; f < static_cast<int>(involved.size()); ++f)
    if (at(involved, f)) involved_.push_back(f);
}

void ClothContact::find_piercings(const Points3& nodes) {
  piercings_.clear();
  const auto look = [&](int f, int g) {
    for (int e : at(features_.owned_edges, f)) {
      if (e < 0 || at(edge_share_, e) == 0) continue;
      const auto [p, q] = at(features_.edges, e).node;
      if (features_.has_node(g, p) || features_.has_node(g, q)) continue;
      if (const auto found = pierce(nodes.row(p), nodes.row(q), nodes.row(corner(g, 0)), nodes.row(corner(g, 1)),
                                    nodes.row(corner(g, 2))))
        piercings_.push_back({e, g, found->s, found->barycentric});
    }
  };
  for (const auto& [f, g] : near_)
    if (at(boxes_, f).near(at(boxes_, g), 0)) look(f, g), look(g, f);
}

void ClothContact::mark_around_piercings() {
  std::fill(marked_.begin(), marked_.end(), false);
  if (piercings_.empty()) return;
  for (const PiercedTriangle& piercing : piercings_) {
    for (int n : at(features_.edges, piercing.edge).node) at(marked_, n) = true;
    for (int k = 0; k < 3; ++k) at(marked_, corner(piercing.triangle, k)) = true;
  }
  if (options_.mirror)
    for (std::size_t n = 0; n < marked_.size(); ++n)
      if (marked_[n]) at(marked_, options_.mirror->image[n]) = true;
  for (int ring = 0; ring < kMarkedRings; ++ring) {
    const std::vector<char> before = marked_;
    for (const ClothFeatures::Edge& edge : features_.edges)
      if (at(before, edge.node[0]) || at(before, edge.node[1]))
        at(marked_, edge.node[0]) = at(marked_, edge.node[1]) = true;
  }
}

// Vertices owned by f against triangle g.
void ClothContact::find_vertex_pairs(const Points3& nodes, int f, int g) {
  const Vec3 a = nodes.row(corner(g, 0)), b = nodes.row(corner(g, 1)), c = nodes.row(corner(g, 2));
  const bool uncertain = at(marked_, corner(g, 0)) || at(marked_, corner(g, 1)) || at(marked_, corner(g, 2));
  const Vec3 normal = normal_.row(g);
  const double steep = reach_ * reach_ * normal.squaredNorm();
  for (int k = 0; k < 3; ++k) {
    const int v = corner(f, k);
    if (at(features_.owner_of_node, v) != f || at(vertex_share_, v) == 0) continue;
    if (features_.has_node(g, v) || (uncertain && at(marked_, v))) continue;
    const Vec3 p = nodes.row(v);
    const double height = normal.dot(p - a);
    if (height * height > steep || !at(boxes_, g).near({p, p}, reach_)) continue;
    const SurfacePoint nearest = closest_point_on_triangle(p, a, b, c);
    const double distance = std::sqrt(nearest.distance_squared);
    if (distance >= reach_ || distance < kLeastGap) continue;
    const LayerPair::Kind kind = LayerPair::Kind::VertexTriangle;
    const Vec3 direction = (p - nearest.point) / distance;
    LayerPair pair{kind, {v, corner(g, 0), corner(g, 1), corner(g, 2)}, direction};
    add_planes(pair, distance, direction.dot(nearest.point));
    if (distance >= kListed * options_.thickness) continue;
    pair.thickness = thickness_of(f, g, [&](const Mat3& one, const Mat3& other) {
      return closest_point_on_triangle(one.row(k), other.row(0), other.row(1), other.row(2)).distance();
    });
    const Vec3& inside = nearest.barycentric;
    pair.taken_up = swelling(pair, {1, -inside[0], -inside[1], -inside[2]});
    pair.stiffness = at(vertex_share_, v) * kVertexShare * options_.stiffness * cloth_.node_area[v];
    pairs_.add(pair, nodes);
  }
}

void ClothContact::find_edge_pairs(const Points3& nodes, int f, int g) {
  for (int k = 0; k < 3; ++k) {
    const int e = at(features_.owned_edges, f)[static_cast<std::size_t>(k)];
    if (e < 0) continue;
    const auto [p, q] = at(features_.edges, e).node;
    const Vec3 a = nodes.row(p), b = nodes.row(q);
    const TriangleBox box{a.cwiseMin(b), a.cwiseMax(b)};
    if (!box.near(at(boxes_, g), reach_)) continue;
    const bool uncertain = at(marked_, p) || at(marked_, q);
    for (int l = 0; l < 3; ++l) {
      const int other = at(features_.owned_edges, g)[static_cast<std::size_t>(l)];
      const double share = other < 0 ? 0.0 : 0.5 * (at(edge_share_, e) + at(edge_share_, other));
      if (share == 0) continue;
      const auto [r, s] = at(features_.edges, other).node;
      if (p == r || p == s || q == r || q == s || (uncertain && (at(marked_, r) || at(marked_, s)))) continue;
      const Vec3 c = nodes.row(r), d = nodes.row(s);
      if (!box.near({c.cwiseMin(d), c.cwiseMax(d)}, reach_)) continue;
      const SegmentPair nearest = closest_points_of_segments(a, b, c, d);
      const double distance = nearest.apart.norm();
      if (distance >= reach_ || distance < kLeastGap) continue;
      LayerPair pair{LayerPair::Kind::EdgeEdge, {p, q, r, s}, nearest.apart / distance};
      // Where an end is closest, a vertex pair has the planes.
      if (nearest.s > 0 && nearest.s < 1 && nearest.t > 0 && nearest.t < 1)
        add_planes(pair, distance, pair.normal.dot(c + nearest.t * (d - c)));
      if (distance >= kListed * options_.thickness) continue;
      pair.thickness = thickness_of(f, g, [k, l](const Mat3& one, const Mat3& two) {
        return closest_points_of_segments(one.row(k), one.row((k + 1) % 3), two.row(l), two.row((l + 1) % 3))
            .apart.norm();
      });
      pair.taken_up = swelling(pair, {1 - nearest.s, nearest.s, nearest.t - 1, -nearest.t});
      pair.stiffness = share * kEdgeShare * options_.stiffness * 0.25 *
                       (cloth_.node_area[p] + cloth_.node_area[q] + cloth_.node_area[r] + cloth_.node_area[s]);
      pairs_.add(pair, nodes);
    }
  }
}

// Features of one panel may be nearer each other than the thickness as they lie flat.
template <class Distance>
double ClothContact::thickness_of(int f, int g, Distance distance_at_rest) const {
  if (at(features_.panel, f) != at(features_.panel, g)) return options_.thickness;
  return std::min(options_.thickness, kUnfolded * distance_at_rest(at(features_.rest, f), at(features_.rest, g)));
}

// Two triangles of one panel that are about as far apart as in flat cloth and face the same way: what lies between them
// is no fold.
bool ClothContact::unfolded(int f, int g) const {
  if (at(features_.panel, f) != at(features_.panel, g)) return false;
  const double apart = (centre_.row(f) - centre_.row(g)).squaredNorm();
  return apart > kUnfolded * kUnfolded * (rest_centre_.row(f) - rest_centre_.row(g)).squaredNorm() &&
         normal_.row(f).dot(normal_.row(g)) > 0;
}

// Planes half-way between the closest points, the lower of which lies at `along` of the normal.
void ClothContact::add_planes(const LayerPair& pair, double distance, double along) {
  const double middle = along + 0.5 * distance, margin = kPlaneMargin * distance;
  const std::size_t above = pair.kind == LayerPair::Kind::VertexTriangle ? 1 : 2;
  for (std::size_t k = 0; k < 4; ++k)
    if (k < above)
      add_plane(pair.node[k], pair.normal, middle + margin);
    else
      add_plane(pair.node[k], -pair.normal, -middle + margin);
}

void ClothContact::add_plane(int node, const Vec3& normal, double offset) {
  const HalfCloth* half = options_.half;
  if (!half) return planes_.add(node, normal, offset);
  const int row = at(half->row, node), side = at(half->side, node);
  if (side >= 0) planes_.add(row, normal, offset);
  if (side <= 0) planes_.add(row, {-normal.x(), normal.y(), normal.z()}, offset);
}

// Direction in which to move the edge against the triangle so that their line of intersection gets shorter.
Vec3 ClothContact::shortening(const Points3& nodes, const PiercedTriangle& piercing) const {
  const auto normal_of = [&](int f) {
    const Vec3 a = nodes.row(corner(f, 0)), b = nodes.row(corner(f, 1)), c = nodes.row(corner(f, 2));
    return Vec3((b - a).cross(c - a).normalized());
  };
  const ClothFeatures::Edge& edge = at(features_.edges, piercing.edge);
  const Vec3 p = nodes.row(edge.node[0]), q = nodes.row(edge.node[1]);
  const Vec3 along = (q - p).normalized(), normal = normal_of(piercing.triangle);
  Vec3 direction = Vec3::Zero();
  for (int f : edge.triangle) {
    if (f < 0) continue;
    Vec3 line = normal.cross(normal_of(f));
    if (!(line.norm() > 1e-9)) continue;
    line.normalize();
    int opposite = corner(f, 0);
    for (int k = 1; k < 3; ++k)
      if (opposite == edge.node[0] || opposite == edge.node[1]) opposite = corner(f, k);
    const Vec3 across = nodes.row(opposite).transpose() - p, inward = across - along * along.dot(across);
    if (line.dot(inward) < 0) line = -line;
    const double steep = along.dot(normal);
    direction += line - 2 * along.dot(line) * steep / std::max(steep * steep, 1e-4) * normal;
  }
  const double length = direction.norm();
  return length > 1e-9 ? Vec3(direction / length) : Vec3::Zero();
}

void ClothContact::add_push(const Points3& nodes, const PiercedTriangle& piercing) {
  const ClothFeatures::Edge& edge = at(features_.edges, piercing.edge);
  LayerPush pair;
  for (int k = 0; k < 3; ++k) {
    at(pair.node, k + 2) = corner(piercing.triangle, k);
    at(pair.weight, k + 2) = -piercing.barycentric[k];
  }
  pair.node[0] = edge.node[0], pair.node[1] = edge.node[1];
  pair.weight[0] = 1 - piercing.s, pair.weight[1] = piercing.s;
  pair.normal = shortening(nodes, piercing);
  pair.stiffness = at(edge_share_, piercing.edge) * options_.push_stiffness * 0.5 *
                   (cloth_.node_area[edge.node[0]] + cloth_.node_area[edge.node[1]]);
  pair.offset = options_.push;
  pairs_.add(pair);  // its points coincide: n . sum(weight x) is 0 here
}

bool ClothContact::limit(const Points3& from, Points3& to, double longest) {
  const double ball = 0.49 * (reach_ - options_.thickness);  // what is out of reach cannot begin to repel
  moved_ = kRoundedUp * (moved_ + longest);
  bool limited = false;
  if (moved_ > ball) {
    limited = keep_within(ball, to);
    moved_ = kRoundedUp * std::max(farthest(seen_at_, from), farthest(seen_at_, to));
  }
  if (!planes_.limit(from, to, moved_)) return limited;
  hindered_ = true;
  return true;
}

bool ClothContact::keep_within(double ball, Points3& to) {
  bool kept = false;
  for (Eigen::Index i = 0; i < to.rows(); ++i) {
    const Vec3 seen = seen_at_.row(i), away = to.row(i).transpose() - seen;
    const double far = away.squaredNorm();
    if (far <= ball * ball) continue;
    kept = stale_ = true;
    to.row(i) = (seen + ball / std::sqrt(far) * away).transpose();
  }
  return kept;
}

double ClothContact::tangle() const {
  return static_cast<double>(piercings()) / (options_.half ? options_.half->cloth : cloth_).triangle_count;
}

bool ClothContact::moved_beyond(double distance, const Points3& nodes) {
  if (moved_ <= distance) return false;
  moved_ = farthest(seen_at_, nodes);
  return moved_ > distance;
}

}  // namespace toile
