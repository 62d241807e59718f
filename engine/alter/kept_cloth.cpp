// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/kept_cloth.h"

#include <algorithm>
#include <cmath>

#include "engine/alter/stretch.h"
#include "engine/geometry/flat_locator.h"
#include "engine/geometry/mesh_polygon.h"

namespace toile {
namespace {

constexpr double kLeastRun = 1e-3;  // m: shorter runs of border do not hold the cloth
constexpr double kCrossing = 0.02;  // m: from a corner to where the two curves that hold it cross, at most
constexpr double kLongest = 1.3;    // of the edge length: longer borders are divided for the mesh

void judge(PieceCloth& cloth) {
  std::vector<std::pair<double, double>> stretch;  // value, area
  double area = 0.0, turned = 0.0;
  const PieceMap& map = cloth.map;
  for (Eigen::Index f = 0; f < map.triangles.rows(); ++f) {
    Mat2 rest, target;
    for (int k = 0; k < 2; ++k) {
      rest.col(k) = (map.rest.row(map.triangles(f, k + 1)) - map.rest.row(map.triangles(f, 0))).transpose();
      target.col(k) = (map.target.row(map.triangles(f, k + 1)) - map.target.row(map.triangles(f, 0))).transpose();
    }
    const double size = 0.5 * target.determinant();
    area += size;
    if (rest.determinant() <= 0)
      turned += size;
    else
      stretch.emplace_back((target * rest.inverse()).colwise().norm().maxCoeff() - 1.0, size);
  }
  std::sort(stretch.begin(), stretch.end());
  double below = 0.0;
  for (const auto& [value, size] : stretch) {
    cloth.strain = value;
    below += size;
    if (below >= 0.98 * area) break;
  }
  cloth.turned_over = area > 0 ? turned / area : 0.0;
}

// Fills the part with triangles and lays its cloth out as in the wanted panel.
PieceCloth mesh_part(const AlteredParts& parts, const AlteredPart& part, double edge_length) {
  PieceCloth cloth;
  std::vector<Vec2> outline;
  for (const RegionBorder& border : part.loop) {
    const Vec2 &a = parts.points[static_cast<std::size_t>(border.from)],
               &b = parts.points[static_cast<std::size_t>(border.to)];
    cloth.border.push_back(static_cast<int>(outline.size()));
    const int steps = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (kLongest * edge_length))));
    for (int i = 0; i < steps; ++i) outline.emplace_back(a + (static_cast<double>(i) / steps) * (b - a));
  }
  if (!is_simple_polygon(outline)) {
    cloth.problem = "a piece's outline touches itself";
    return cloth;
  }
  cloth.map.border_count = static_cast<int>(outline.size());
  const PolygonMesh mesh = mesh_polygon(outline, edge_length);
  cloth.map.target.resize(static_cast<Eigen::Index>(mesh.points.size()), 2);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    cloth.map.target.row(static_cast<Eigen::Index>(i)) = mesh.points[i];
  cloth.map.rest = cloth.map.target;
  cloth.map.triangles = mesh.triangles;
  return cloth;
}

// Whether two curves that hold a corner cross near it: where nearly parallel ones do says nothing.
bool cross_near(const SideCurve& a, const SideCurve& b, const Vec2& corner) {
  const SideFoot first = a.closest(corner), second = b.closest(corner);
  const double sine = std::abs(first.normal.x() * second.normal.y() - first.normal.y() * second.normal.x());
  return (corner - first.point).norm() + (corner - second.point).norm() < kCrossing * sine;
}

}  // namespace

// A sheet's faces between two layouts of its vertices.
class ClothSource::SheetMap {
 public:
  SheetMap(const Sheet& sheet, Vec2 SheetVertex::*from, Vec2 SheetVertex::*to)
      : faces_(faces_of(sheet)), to_(layout(sheet, to)), locator_(layout(sheet, from), faces_) {}
  Vec2 operator()(const Vec2& p) const { return locator_.extended(p).of(to_, faces_).transpose(); }

 private:
  static Points2 layout(const Sheet& sheet, Vec2 SheetVertex::*where) {
    Points2 points(sheet.vertex_count(), 2);
    for (int v = 0; v < sheet.vertex_count(); ++v) points.row(v) = sheet.vertices[static_cast<std::size_t>(v)].*where;
    return points;
  }
  static Triangles faces_of(const Sheet& sheet) {
    Triangles faces(static_cast<Eigen::Index>(sheet.faces.size()), 3);
    for (std::size_t f = 0; f < sheet.faces.size(); ++f)
      for (int k = 0; k < 3; ++k) faces(static_cast<Eigen::Index>(f), k) = sheet.faces[f][static_cast<std::size_t>(k)];
    return faces;
  }
  Triangles faces_;
  Points2 to_;
  FlatLocator locator_;
};

// Hangs every run of border that one pass made on the curve where that pass has it, to slide there.
void ClothSource::attach_borders(const AlteredPart& part, const PieceCloth& cloth, const SheetMap& inserted,
                                 const SheetMap& removed, Sheet& sheet) {
  const std::size_t count = part.loop.size();
  const auto same = [&](std::size_t a, std::size_t b) {
    return part.loop[a].neighbour == part.loop[b].neighbour && part.loop[a].track == part.loop[b].track;
  };
  std::size_t first = 0;
  while (first < count && same((first + count - 1) % count, first)) ++first;
  for (std::size_t k = 0, length = 1; k < count; k += length) {
    const std::size_t begin = (first + k) % count;
    for (length = 1; k + length < count && same(begin, (begin + length) % count);) ++length;
    const int from = cloth.border[begin], to = cloth.border[(begin + length) % count];
    std::vector<int> vertices = {from};
    do vertices.push_back((vertices.back() + 1) % cloth.map.border_count);
    while (vertices.back() != to);
    std::vector<Vec2> curve;
    double walked = 0.0;
    for (const int v : vertices) {
      const Vec2 p = cloth.map.target.row(v);
      curve.push_back(part.loop[begin].neighbour >= 0 ? inserted(p) : removed(p));
      if (curve.size() > 1) walked += (curve.back() - curve[curve.size() - 2]).norm();
    }
    if (walked < kLeastRun) continue;
    const int side = static_cast<int>(sheet.wanted_sides.size());
    sheet.wanted_sides.emplace_back(std::move(curve));
    for (const int v : vertices) {
      SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(v)];
      if (vertex.anchors[0].side < 0)
        vertex.anchors[0] = {side, 0.0, true};
      else if (cross_near(sheet.wanted_sides[static_cast<std::size_t>(vertex.anchors[0].side)],
                          sheet.wanted_sides[static_cast<std::size_t>(side)], vertex.now))
        vertex.anchors[1] = {side, 0.0, true};
    }
  }
}

ClothSource::ClothSource(const Sheet& inserting, const Sheet& removing, const PanelAlteration& alteration)
    : inserting_(inserting),
      removing_(removing),
      inserts_(!alteration.insertions.empty()),
      removes_(!alteration.removals.empty()) {}

ClothSource::~ClothSource() = default;

const ClothSource::SheetMap& ClothSource::inserted() {
  if (!inserted_) inserted_ = std::make_unique<SheetMap>(inserting_, &SheetVertex::now, &SheetVertex::flat);
  return *inserted_;
}

const ClothSource::SheetMap& ClothSource::removed() {
  if (!removed_) removed_ = std::make_unique<SheetMap>(removing_, &SheetVertex::flat, &SheetVertex::now);
  return *removed_;
}

PieceCloth ClothSource::of(const AlteredParts& parts, std::size_t part) {
  PieceCloth cloth = mesh_part(parts, parts.parts[part], inserting_.edge_length);
  if (!cloth.problem.empty()) return cloth;
  const SheetMap& source = inserts_ || !removes_ ? inserted() : removed();
  for (Eigen::Index v = 0; v < cloth.map.target.rows(); ++v)
    cloth.map.rest.row(v) = source(cloth.map.target.row(v).transpose());
  if (inserts_ && removes_) relax_both(parts.parts[part], cloth);
  judge(cloth);
  return cloth;
}

void ClothSource::relax_both(const AlteredPart& part, PieceCloth& cloth) {
  Sheet sheet;
  sheet.panel = inserting_.panel;
  sheet.edge_length = inserting_.edge_length;
  for (Eigen::Index v = 0; v < cloth.map.target.rows(); ++v) {
    SheetVertex vertex;
    vertex.flat = vertex.guide = cloth.map.target.row(v);
    vertex.now = cloth.map.rest.row(v);
    sheet.vertices.push_back(vertex);
  }
  for (Eigen::Index f = 0; f < cloth.map.triangles.rows(); ++f)
    sheet.faces.push_back({cloth.map.triangles(f, 0), cloth.map.triangles(f, 1), cloth.map.triangles(f, 2)});
  sheet.folded.assign(sheet.faces.size(), false);
  attach_borders(part, cloth, inserted(), removed(), sheet);
  relax(sheet, {.hold = 0.0});  // the guide tells lengths here, not places
  for (Eigen::Index v = 0; v < cloth.map.rest.rows(); ++v)
    cloth.map.rest.row(v) = sheet.vertices[static_cast<std::size_t>(v)].now;
}

PieceCloth identical_cloth(const AlteredParts& parts, std::size_t part, double edge_length) {
  return mesh_part(parts, parts.parts[part], edge_length);
}

}  // namespace toile
