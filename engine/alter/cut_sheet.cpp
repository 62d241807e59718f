// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/cut_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace toile {
namespace {

constexpr double kSnap = 0.3;            // of the mean edge length: vertices nearer to the line move onto it
constexpr double kLeastAltitude = 1e-4;  // of the edge length squared: smallest area a moved vertex may leave

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double doubled_area(const Sheet& s, const std::array<int, 3>& f) {
  const Vec2& a = s.vertices[static_cast<std::size_t>(f[0])].flat;
  return cross(s.vertices[static_cast<std::size_t>(f[1])].flat - a,
               s.vertices[static_cast<std::size_t>(f[2])].flat - a);
}

bool contains(const std::array<int, 3>& face, int v) {
  return face[0] == v || face[1] == v || face[2] == v;
}

SheetVertex between(const SheetVertex& a, const SheetVertex& b, double t) {
  SheetVertex m;
  m.flat = (1 - t) * a.flat + t * b.flat;
  m.guide = (1 - t) * a.guide + t * b.guide;
  m.now = (1 - t) * a.now + t * b.now;
  for (const SheetAnchor& anchor : a.anchors) {  // on an outline edge both ends share a side
    const SheetAnchor* other = anchor.side >= 0 ? b.anchor(anchor.side) : nullptr;
    if (other) m.anchors[0] = {anchor.side, (1 - t) * anchor.at + t * other->at, anchor.attached && other->attached};
  }
  return m;
}

// Walks a straight line through the mesh, remeshing it so that the line runs along edges.
class LineWalk {
 public:
  LineWalk(Sheet& sheet, int start, const Vec2& direction)
      : sheet_(sheet), origin_(sheet.vertices[static_cast<std::size_t>(start)].flat), direction_(direction) {
    around_.resize(sheet.vertices.size());
    for (std::size_t f = 0; f < sheet.faces.size(); ++f) enter(f);
    path_ = {start};
  }

  std::vector<int> run() {
    while (step()) {
    }
    return path_;
  }

 private:
  void enter(std::size_t f) {
    for (const int v : sheet_.faces[f]) around_[static_cast<std::size_t>(v)].insert(f);
  }
  void leave(std::size_t f) {
    for (const int v : sheet_.faces[f]) around_[static_cast<std::size_t>(v)].erase(f);
  }
  SheetVertex& vertex(int v) { return sheet_.vertices[static_cast<std::size_t>(v)]; }
  double side(int v) { return cross(direction_, vertex(v).flat - origin_); }  // > 0: left of the line
  double along(int v) { return direction_.dot(vertex(v).flat - origin_); }

  bool on_border(int v);
  bool step();
  bool snap(int v);
  int split(int right, int left);

  Sheet& sheet_;
  Vec2 origin_, direction_;
  std::vector<std::set<std::size_t>> around_;
  std::vector<int> path_;
};

// A vertex is inside when its faces close a full turn: every neighbour is entered and left once.
bool LineWalk::on_border(int v) {
  std::map<int, int> count;
  for (const std::size_t f : around_[static_cast<std::size_t>(v)])
    for (const int w : sheet_.faces[f])
      if (w != v) ++count[w];
  return std::any_of(count.begin(), count.end(), [](const auto& entry) { return entry.second == 1; });
}

bool LineWalk::step() {
  const int here = path_.back();
  for (const std::size_t f : around_[static_cast<std::size_t>(here)]) {
    const std::array<int, 3>& face = sheet_.faces[f];
    const auto i = static_cast<std::size_t>(std::find(face.begin(), face.end(), here) - face.begin());
    const int right = face[(i + 1) % 3], left = face[(i + 2) % 3];
    if (std::max(along(right), along(left)) <= along(here)) continue;
    const double tiny = 1e-9 * sheet_.edge_length;
    if (side(right) > tiny || side(left) < -tiny) continue;
    if (std::abs(side(right)) <= tiny && along(right) > along(here)) {
      path_.push_back(right);
    } else if (std::abs(side(left)) <= tiny && along(left) > along(here)) {
      path_.push_back(left);
    } else if (side(right) >= 0.0 || side(left) <= 0.0) {
      continue;  // the line only grazes this face
    } else {
      const int nearer = -side(right) < side(left) ? right : left;
      path_.push_back(snap(nearer) ? nearer : split(right, left));
    }
    return !on_border(path_.back());
  }
  return false;
}

// Moves an inner vertex onto the line when it is near and no face around it is spoilt.
bool LineWalk::snap(int v) {
  const double off = side(v);
  if (std::abs(off) > kSnap * sheet_.edge_length || on_border(v)) return false;
  const SheetVertex before = vertex(v);
  const Vec2 move = off * Vec2(direction_.y(), -direction_.x());
  Mat2 to_now = Mat2::Zero(), to_guide = Mat2::Zero();
  double area = 0.0;
  for (const std::size_t f : around_[static_cast<std::size_t>(v)]) {
    const auto& face = sheet_.faces[f];
    Mat2 flat, now, guide;
    for (int k = 0; k < 2; ++k) {
      const SheetVertex &a = vertex(face[0]), &b = vertex(face[static_cast<std::size_t>(k + 1)]);
      flat.col(k) = b.flat - a.flat;
      now.col(k) = b.now - a.now;
      guide.col(k) = b.guide - a.guide;
    }
    const double weight = flat.determinant();
    to_now += weight * now * flat.inverse();
    to_guide += weight * guide * flat.inverse();
    area += weight;
  }
  vertex(v).flat += move;
  for (const std::size_t f : around_[static_cast<std::size_t>(v)])
    if (doubled_area(sheet_, sheet_.faces[f]) < kLeastAltitude * sheet_.edge_length * sheet_.edge_length) {
      vertex(v) = before;
      return false;
    }
  vertex(v).now += to_now * move / area;
  vertex(v).guide += to_guide * move / area;
  vertex(v).origin = -1;
  return true;
}

// Puts a vertex where the line crosses the edge, and splits the faces on both sides of it.
int LineWalk::split(int right, int left) {
  const double t = -side(right) / (side(left) - side(right));
  const int middle = sheet_.vertex_count();
  SheetVertex m = between(vertex(right), vertex(left), t);
  m.origin = -1;
  std::vector<std::size_t> both;
  for (const std::size_t f : around_[static_cast<std::size_t>(right)])
    if (contains(sheet_.faces[f], left)) both.push_back(f);
  if (both.size() > 1) m.anchors = {};  // an inner edge between two outline vertices is not on a side
  sheet_.vertices.push_back(m);
  around_.emplace_back();
  for (const std::size_t f : both) {
    leave(f);
    std::array<int, 3> other = sheet_.faces[f];
    std::replace(sheet_.faces[f].begin(), sheet_.faces[f].end(), left, middle);
    std::replace(other.begin(), other.end(), right, middle);
    sheet_.faces.push_back(other);
    sheet_.folded.push_back(sheet_.folded[f]);
    enter(f);
    enter(sheet_.faces.size() - 1);
  }
  return middle;
}

// Gives the faces on the right of the path their own copies of its vertices.
void open_path(Sheet& sheet, const std::vector<int>& path) {
  std::set<std::pair<int, int>> on_path;
  std::map<std::pair<int, int>, std::size_t> face_of_edge;
  const std::set<int> members(path.begin(), path.end());
  for (std::size_t i = 1; i < path.size(); ++i) {
    on_path.emplace(path[i - 1], path[i]);
    on_path.emplace(path[i], path[i - 1]);
  }
  for (std::size_t f = 0; f < sheet.faces.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i) face_of_edge[{sheet.faces[f][i], sheet.faces[f][(i + 1) % 3]}] = f;
  std::set<std::size_t> right;
  std::vector<std::size_t> open;
  for (std::size_t i = 1; i < path.size(); ++i)
    if (const auto found = face_of_edge.find({path[i], path[i - 1]}); found != face_of_edge.end())
      if (right.insert(found->second).second) open.push_back(found->second);
  while (!open.empty()) {  // over every edge that touches the path without being of it
    const std::array<int, 3> face = sheet.faces[open.back()];
    open.pop_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = face[i], b = face[(i + 1) % 3];
      if (on_path.contains({a, b}) || (!members.contains(a) && !members.contains(b))) continue;
      const auto found = face_of_edge.find({b, a});
      if (found != face_of_edge.end() && right.insert(found->second).second) open.push_back(found->second);
    }
  }
  Cut cut;
  std::map<int, int> copy;
  for (const int v : path) {
    copy[v] = sheet.vertex_count();
    cut.lips.emplace_back(v, sheet.vertex_count());
    sheet.vertices.push_back(sheet.vertices[static_cast<std::size_t>(v)]);
  }
  for (const std::size_t f : right)
    for (int& v : sheet.faces[f])
      if (const auto found = copy.find(v); found != copy.end()) v = found->second;
  sheet.cuts.push_back(std::move(cut));
}

// Drops vertices no face uses and renumbers.
void compact(Sheet& sheet) {
  std::vector<int> number(sheet.vertices.size(), -1);
  for (const auto& face : sheet.faces)
    for (const int v : face) number[static_cast<std::size_t>(v)] = 0;
  std::vector<SheetVertex> kept;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      number[v] = static_cast<int>(kept.size());
      kept.push_back(sheet.vertices[v]);
    }
  sheet.vertices = std::move(kept);
  for (auto& face : sheet.faces)
    for (int& v : face) v = number[static_cast<std::size_t>(v)];
  for (Cut& cut : sheet.cuts)
    for (auto& [left, right] : cut.lips) {
      left = number[static_cast<std::size_t>(left)];
      right = number[static_cast<std::size_t>(right)];
    }
}

}  // namespace

bool cut_straight(Sheet& sheet, int start, const Vec2& direction) {
  const std::vector<int> path = LineWalk(sheet, start, direction).run();
  if (path.size() < 2) return false;
  open_path(sheet, path);
  return true;
}

namespace {

// The way of a cut along mesh edges; it ends on the border, or where no edge leads on.
std::vector<int> way_along_edges(const Sheet& sheet, int start, const Vec2& direction, double smoothness,
                                 const std::set<int>& border) {
  std::vector<std::set<int>> neighbours(sheet.vertices.size());
  for (const auto& face : sheet.faces)
    for (std::size_t i = 0; i < 3; ++i) {
      neighbours[static_cast<std::size_t>(face[i])].insert(face[(i + 1) % 3]);
      neighbours[static_cast<std::size_t>(face[(i + 1) % 3])].insert(face[i]);
    }
  std::vector<int> path = {start};
  std::set<int> visited = {start};
  Vec2 way = direction;
  while (path.size() == 1 || !border.contains(path.back())) {
    int best = -1;
    double best_cosine = 0.2;  // never back, hardly ever sideways
    const Vec2 here = sheet.vertices[static_cast<std::size_t>(path.back())].flat;
    for (const int w : neighbours[static_cast<std::size_t>(path.back())]) {
      if (visited.contains(w) || (path.size() == 1 && border.contains(w))) continue;
      const double cosine = (sheet.vertices[static_cast<std::size_t>(w)].flat - here).normalized().dot(way);
      if (cosine > best_cosine) {
        best = w;
        best_cosine = cosine;
      }
    }
    if (best < 0) break;
    const Vec2 taken = (sheet.vertices[static_cast<std::size_t>(best)].flat - here).normalized();
    // The paper's smoothing; the wanted direction stays the grain's, so that the cut does not drift with the mesh.
    way = (smoothness * taken + (1.0 - smoothness) * direction).normalized();
    visited.insert(best);
    path.push_back(best);
  }
  return path;
}

}  // namespace

bool cut_along_edges(Sheet& sheet, int start, const Vec2& direction, double smoothness) {
  std::set<int> border;
  for (const BorderEdge& edge : border_edges(sheet)) border.insert(edge.from);
  // A way that keeps too much of where it was going turns into nowhere; then it heeds the wanted direction more.
  for (int halvings = 0; halvings < 4; ++halvings) {
    const double share = std::ldexp(smoothness, -halvings);
    const std::vector<int> path = way_along_edges(sheet, start, direction, share, border);
    if (path.size() < 2 || !border.contains(path.back())) continue;
    open_path(sheet, path);
    return true;
  }
  return false;
}

void zip_from(Sheet& sheet, std::size_t number, std::size_t first) {
  std::vector<std::pair<int, int>>& lips = sheet.cuts[number].lips;
  if (first >= lips.size()) return;
  std::map<int, int> merged;
  for (std::size_t i = first; i < lips.size(); ++i) {
    const auto [left, right] = lips[i];
    SheetVertex& kept = sheet.vertices[static_cast<std::size_t>(left)];
    kept.now = 0.5 * (kept.now + sheet.vertices[static_cast<std::size_t>(right)].now);
    merged[right] = left;
  }
  const auto renamed = [&](int& v) {
    if (const auto found = merged.find(v); found != merged.end()) v = found->second;
  };
  for (auto& face : sheet.faces) std::for_each(face.begin(), face.end(), renamed);
  lips.resize(first + 1);
  for (Cut& cut : sheet.cuts)
    for (auto& [left, right] : cut.lips) {
      renamed(left);
      renamed(right);
    }
  compact(sheet);
}

double gap(const Sheet& sheet, const Cut& cut, std::size_t i) {
  const auto [left, right] = cut.lips[i];
  return (sheet.vertices[static_cast<std::size_t>(left)].now - sheet.vertices[static_cast<std::size_t>(right)].now)
      .norm();
}

}  // namespace toile
