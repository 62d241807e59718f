// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/garmentcode_json.h"

#include <algorithm>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "engine/core/units.h"
#include "engine/io/json.h"
#include "engine/io/toile_block.h"

namespace toile {

namespace {

constexpr double kMaxRelativeParameter = 1e4;
constexpr double kMaxArcRadius = 1e4;  // m; flatter arcs are lines in all but name
constexpr std::size_t kMaxPolylinePoints = 100'000;

constexpr std::size_t kNamesTold = 5;

// Where the panels are; a document without says what it is instead.
JsonView pattern_of(const JsonView& root) {
  if (const auto pattern = root.find("pattern")) return *pattern;
  std::string found;
  const auto members = root.members();
  for (std::size_t i = 0; i < std::min(kNamesTold, members.size()); ++i)
    found += (i > 0 ? ", \"" : " \"") + members[i].first + "\"";
  root.fail("this is no garment: a GarmentCode specification has its panels in a member \"pattern\", here " +
            (members.empty() ? "is nothing" : "are" + found + (members.size() > kNamesTold ? " and others" : "")) +
            "; give the file that GarmentCode calls NAME_specification.json");
}

class SpecificationReader {
 public:
  explicit SpecificationReader(const JsonView& root) : root_(root), body_(pattern_of(root)) {
    if (const auto properties = root.find("properties")) {
      if (const auto units = properties->find("units_in_meter")) unit_ = 1.0 / units->number(1e-3, 1e5);
      if (const auto coordinates = properties->find("curvature_coords"))
        if (coordinates->text() != "relative")
          coordinates->fail("only \"relative\" curve parameters are read; export the pattern with relative ones");
    }
  }

  Pattern read() {
    for (const std::string& name : panel_names()) {
      panel_by_name_[name] = static_cast<int>(pattern_.panels.size());
      read_panel(name, body_.at("panels").at(name));
    }
    if (const auto stitches = body_.find("stitches"))
      for (const JsonView& stitch : stitches->elements(kMaxPanels * kMaxEdgesPerPanel)) read_stitch(stitch);
    if (const auto block = root_.find("toile")) read_toile_block(*block, unit_, pattern_);
    return std::move(pattern_);
  }

 private:
  std::vector<std::string> panel_names() const {
    const JsonView panels = body_.at("panels");
    const auto members = panels.members();
    if (members.empty()) panels.fail("the pattern has no panel; add at least one");
    if (members.size() > kMaxPanels)
      panels.fail("a pattern may have at most 200 panels, found " + std::to_string(members.size()),
                  ErrorCode::LimitExceeded);
    std::set<std::string> left;
    for (const auto& [name, panel] : members) left.insert(name);
    std::vector<std::string> names;
    if (const auto order = body_.find("panel_order"))
      for (const JsonView& entry : order->elements(kMaxPanels)) {
        if (left.erase(entry.text()) == 0) entry.fail("no panel of this name, or listed twice; correct panel_order");
        names.push_back(entry.text());
      }
    names.insert(names.end(), left.begin(), left.end());
    return names;
  }

  void read_panel(const std::string& name, const JsonView& value) {
    Panel panel;
    panel.name = name;
    if (const auto label = value.find("label")) panel.label = label->text();
    if (const auto translation = value.find("translation"))
      panel.translation = translation->vector3(kMaxCoordinate / unit_) * unit_;
    if (const auto rotation = value.find("rotation")) panel.rotation = rotation_of_degrees(rotation->vector3(1e4));
    read_outline(value, panel);
    pattern_.panels.push_back(std::move(panel));
  }

  void read_outline(const JsonView& value, Panel& panel) {
    std::vector<Vec2> vertices;
    for (const JsonView& vertex : value.at("vertices").elements(kMaxEdgesPerPanel + 1))
      vertices.push_back(vertex.point(kMaxCoordinate / unit_) * unit_);
    const JsonView edges = value.at("edges");
    const auto list = edges.elements(kMaxEdgesPerPanel);
    if (list.size() < 2) edges.fail("an outline needs at least two edges");
    std::vector<std::array<int, 2>> ends;
    for (const JsonView& edge : list) ends.push_back(read_endpoints(edge, static_cast<int>(vertices.size())));
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (ends[k][1] != ends[(k + 1) % list.size()][0])
        list[k]
            .at("endpoints")
            .fail("the outline is not closed: edge " + std::to_string(k) +
                  " must end where the next edge starts; list the edges in order round the panel");
      panel.corners.push_back(vertices[static_cast<std::size_t>(ends[k][0])]);
    }
    for (std::size_t k = 0; k < list.size(); ++k)
      panel.edges.push_back(read_edge(list[k], panel.corners[k], panel.corners[(k + 1) % list.size()]));
  }

  static std::array<int, 2> read_endpoints(const JsonView& edge, int vertex_count) {
    const JsonView ends = edge.at("endpoints");
    if (ends.size() != 2) ends.fail("expected two vertex numbers");
    std::array<int, 2> numbers{};
    for (std::size_t i = 0; i < 2; ++i) {
      const JsonView number = ends.at(i);
      numbers[i] = number.integer(-1'000'000'000, 1'000'000'000);
      if (numbers[i] < 0 || numbers[i] >= vertex_count)
        number.fail("vertex " + std::to_string(numbers[i]) + " is not there; the panel has vertices 0 to " +
                    std::to_string(vertex_count - 1));
    }
    return numbers;
  }

  PanelEdge read_edge(const JsonView& value, const Vec2& start, const Vec2& end) const {
    PanelEdge edge;
    if (const auto label = value.find("label")) edge.label = label->text();
    const auto curvature = value.find("curvature");
    if (!curvature) return edge;
    // Relative parameters: u along the chord, v along the chord turned a quarter left.
    const Vec2 chord = end - start, normal(-chord.y(), chord.x());
    const auto control = [&](const JsonView& parameter) -> Vec2 {
      const Vec2 uv = parameter.point(kMaxRelativeParameter);
      return start + uv.x() * chord + uv.y() * normal;
    };
    if (curvature->is_array()) {  // older files: a bare [u, v]
      edge.curve.kind = CurveKind::QuadraticBezier;
      edge.curve.control[0] = control(*curvature);
    } else {
      read_curve(*curvature, control, edge.curve);
    }
    return edge;
  }

  template <class Control>
  void read_curve(const JsonView& curvature, const Control& control, EdgeCurve& curve) const {
    const std::string type = curvature.at("type").text();
    const JsonView parameters = curvature.at("params");
    const auto require = [&](std::size_t count) {
      if (parameters.size() != count) parameters.fail("expected " + std::to_string(count) + " entries for " + type);
    };
    if (type == "quadratic") {
      require(1);
      curve.kind = CurveKind::QuadraticBezier;
      curve.control[0] = control(parameters.at(std::size_t{0}));
    } else if (type == "cubic") {
      require(2);
      curve.kind = CurveKind::CubicBezier;
      for (std::size_t i = 0; i < 2; ++i) curve.control[i] = control(parameters.at(i));
    } else if (type == "circle") {
      require(3);
      curve.kind = CurveKind::Arc;
      curve.radius = parameters.at(std::size_t{0}).number(0, kMaxArcRadius / unit_) * unit_;
      curve.large_arc = parameters.at(1).number(0, 1) != 0;
      curve.bulges_right = parameters.at(2).number(0, 1) != 0;
    } else if (type == "polyline") {
      curve.kind = CurveKind::Polyline;
      for (const JsonView& point : parameters.elements(kMaxPolylinePoints)) curve.points.push_back(control(point));
    } else {
      curvature.at("type").fail("unknown curve; known are quadratic, cubic, circle and polyline");
    }
  }

  SeamSide read_side(const JsonView& value) const {
    const JsonView name = value.at("panel");
    const auto found = panel_by_name_.find(name.text());
    if (found == panel_by_name_.end())
      name.fail("no panel is called \"" + name.text() + "\"; use a name from /pattern/panels", ErrorCode::SeamInvalid);
    const JsonView number = value.at("edge");
    const int count = pattern_.panels[static_cast<std::size_t>(found->second)].edge_count();
    const int edge = number.integer(-1'000'000'000, 1'000'000'000);
    if (edge < 0 || edge >= count)
      number.fail("panel \"" + name.text() + "\" has no edge " + std::to_string(edge) + "; its edges are 0 to " +
                      std::to_string(count - 1),
                  ErrorCode::SeamInvalid);
    return {PanelId(found->second), edge};
  }

  void read_stitch(const JsonView& value) {
    if (value.size() < 2 || value.size() > 3) value.fail("expected two sides and optionally \"right_wrong\"");
    Seam seam;
    seam.a = read_side(value.at(std::size_t{0}));
    seam.b = read_side(value.at(1));
    if (value.size() == 3) {
      if (!value.at(2).is_string() || value.at(2).text() != "right_wrong") value.at(2).fail("expected \"right_wrong\"");
      seam.right_wrong = true;
    }
    pattern_.seams.push_back(seam);
  }

  JsonView root_, body_;
  double unit_ = kMetrePerCm;
  Pattern pattern_;
  std::map<std::string, int> panel_by_name_;
};

}  // namespace

Mat3 rotation_of_degrees(const Vec3& degrees) {
  const Vec3 r = degrees * kRadianPerDegree;
  return (Eigen::AngleAxisd(r.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(r.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(r.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

Pattern read_garmentcode(std::span<const std::uint8_t> bytes) {
  const nlohmann::json document = parse_json(bytes, "garment");
  return SpecificationReader(JsonView(document)).read();
}

}  // namespace toile
