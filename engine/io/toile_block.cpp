// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/toile_block.h"

#include <map>

#include <nlohmann/json.hpp>

#include "engine/core/units.h"
#include "engine/io/garmentcode_json.h"

namespace toile {

using nlohmann::json;

namespace {

constexpr double kMaxAllowanceMm = 200.0;
constexpr double kMaxHemMm = 500.0;
constexpr std::size_t kMaxEntries = 100'000;
constexpr std::size_t kMaxKeepOutCorners = 1000;

struct NotchName {
  NotchType type;
  const char* name;
};
constexpr std::array<NotchName, 5> kNotchNames = {{{NotchType::V, "v"},
                                                   {NotchType::T, "t"},
                                                   {NotchType::Castle, "castle"},
                                                   {NotchType::Check, "check"},
                                                   {NotchType::U, "u"}}};

NotchType read_notch_type(const JsonView& value) {
  for (const auto& [type, name] : kNotchNames)
    if (value.text() == name) return type;
  value.fail("unknown notch; known are v, t, castle, check, u");
}

const char* notch_name(NotchType type) {
  for (const auto& [known, name] : kNotchNames)
    if (known == type) return name;
  return "v";
}

class BlockReader {
 public:
  BlockReader(Pattern& pattern, double metre_per_unit) : pattern_(pattern), unit_(metre_per_unit) {
    for (std::size_t p = 0; p < pattern.panels.size(); ++p)
      panel_by_name_[pattern.panels[p].name] = static_cast<int>(p);
  }

  void read(const JsonView& block) {
    block.require_only(
        {"name", "fabric", "seam_allowance_mm", "edges", "panels", "notches", "keep_out", "pins", "symmetry_plane"});
    if (const auto name = block.find("name")) pattern_.name = name->text();
    if (const auto fabric = block.find("fabric")) read_fabric(*fabric);
    if (const auto allowance = block.find("seam_allowance_mm"))
      pattern_.seam_allowance = allowance->number(0, kMaxAllowanceMm) * kMetrePerMm;
    for_each(block, "edges", [&](const JsonView& entry) { read_edge(entry); });
    for_each(block, "panels", [&](const JsonView& entry) { read_panel(entry); });
    for_each(block, "notches", [&](const JsonView& entry) { read_notch(entry); });
    for_each(block, "keep_out", [&](const JsonView& entry) { read_keep_out(entry); });
    for_each(block, "pins", [&](const JsonView& entry) {
      entry.require_only({"panel", "edge"});
      pattern_.pins.push_back(side_of(entry));
    });
    if (const auto plane = block.find("symmetry_plane")) read_symmetry(*plane);
  }

 private:
  template <class Function>
  static void for_each(const JsonView& block, std::string_view key, const Function& read_entry) {
    const auto list = block.find(key);
    if (!list) return;
    for (const JsonView& entry : list->elements(kMaxEntries)) read_entry(entry);
  }

  Panel& panel_of(const JsonView& entry) {
    const JsonView name = entry.at("panel");
    const auto found = panel_by_name_.find(name.text());
    if (found == panel_by_name_.end()) name.fail("no panel of this name; use a name from /pattern/panels");
    return pattern_.panels[static_cast<std::size_t>(found->second)];
  }

  SeamSide side_of(const JsonView& entry) {
    Panel& panel = panel_of(entry);
    return {PanelId(panel_by_name_[panel.name]), entry.at("edge").integer(0, panel.edge_count() - 1)};
  }

  PanelEdge& edge_of(const JsonView& entry) {
    const SeamSide side = side_of(entry);
    return pattern_.panel(side.panel).edges[static_cast<std::size_t>(side.edge)];
  }

  Vec2 point(const JsonView& value) const { return value.point(kMaxCoordinate / unit_) * unit_; }

  void read_fabric(const JsonView& value) {
    if (value.is_string()) {
      const auto fabric = fabric_named(value.text());
      if (!fabric) {
        std::string known;
        for (const auto& name : fabric_names()) known += (known.empty() ? "" : ", ") + name;
        value.fail("unknown fabric; known are " + known + ", or give the numbers as an object");
      }
      pattern_.fabric = *fabric;
      return;
    }
    value.require_only({"name", "weft_n_per_m", "warp_n_per_m", "shear_n_per_m", "bending_n_m", "density_kg_per_m2"});
    Fabric fabric;
    fabric.name = "custom";
    if (const auto name = value.find("name")) fabric.name = name->text();
    const auto take = [&](const char* key, double least, double most, double& field) {
      if (const auto number = value.find(key)) field = number->number(least, most);
    };
    take("weft_n_per_m", 1.0, 1e6, fabric.weft_stiffness);
    take("warp_n_per_m", 1.0, 1e6, fabric.warp_stiffness);
    take("shear_n_per_m", 0.1, 1e6, fabric.shear_stiffness);
    take("bending_n_m", 0.0, 1.0, fabric.bending_stiffness);
    take("density_kg_per_m2", 0.005, 5.0, fabric.density);
    pattern_.fabric = fabric;
  }

  void read_edge(const JsonView& entry) {
    entry.require_only({"panel", "edge", "name", "seam_allowance_mm", "hem", "locked", "zip", "straight", "on_fold"});
    PanelEdge& edge = edge_of(entry);
    if (const auto name = entry.find("name")) edge.name = name->text();
    if (const auto allowance = entry.find("seam_allowance_mm"))
      edge.seam_allowance = allowance->number(0, kMaxAllowanceMm) * kMetrePerMm;
    if (const auto hem = entry.find("hem")) edge.hem = hem->number(0, kMaxHemMm) * kMetrePerMm;
    if (const auto locked = entry.find("locked")) edge.locked = locked->boolean();
    if (const auto zip = entry.find("zip")) edge.zip = zip->boolean();
    if (const auto straight = entry.find("straight")) edge.straight = straight->boolean();
    if (const auto fold = entry.find("on_fold")) edge.on_fold = fold->boolean();
  }

  void read_panel(const JsonView& entry) {
    entry.require_only({"panel", "label", "quantity", "material", "grainline", "locked"});
    Panel& panel = panel_of(entry);
    if (const auto label = entry.find("label")) panel.piece_label = label->text();
    if (const auto quantity = entry.find("quantity")) panel.quantity = quantity->integer(1, 1000);
    if (const auto material = entry.find("material")) panel.material = material->text();
    if (const auto locked = entry.find("locked")) panel.locked = locked->boolean();
    const auto grainline = entry.find("grainline");
    if (!grainline) return;
    if (grainline->size() != 2) grainline->fail("expected two points, [[x, y], [x, y]]");
    panel.grainline = {{point(grainline->at(std::size_t{0})), point(grainline->at(std::size_t{1}))}};
    if (((*panel.grainline)[1] - (*panel.grainline)[0]).norm() < kMetrePerMm)
      grainline->fail("the two points must be at least 1 mm apart");
  }

  void read_notch(const JsonView& entry) {
    entry.require_only({"panel", "edge", "at", "type"});
    const SeamSide side = side_of(entry);
    Notch notch;
    notch.edge = side.edge;
    notch.at = entry.at("at").number(0, 1);
    if (const auto type = entry.find("type")) notch.type = read_notch_type(*type);
    pattern_.panel(side.panel).notches.push_back(notch);
  }

  void read_keep_out(const JsonView& entry) {
    entry.require_only({"panel", "polygon", "why"});
    KeepOut region;
    const JsonView polygon = entry.at("polygon");
    if (polygon.size() < 3) polygon.fail("a keep-out polygon needs at least 3 corners");
    for (const JsonView& corner : polygon.elements(kMaxKeepOutCorners)) region.polygon.push_back(point(corner));
    if (const auto why = entry.find("why")) region.why = why->text();
    panel_of(entry).keep_outs.push_back(std::move(region));
  }

  void read_symmetry(const JsonView& value) {
    if (value.is_string()) {
      const std::string word = value.text();
      if (word != "auto" && word != "none") value.fail("expected [a, b, c, d], \"auto\" or \"none\"");
      pattern_.symmetry = word == "auto" ? Pattern::Symmetry::Auto : Pattern::Symmetry::None;
      return;
    }
    if (value.size() != 4) value.fail("expected [a, b, c, d], the plane a x + b y + c z = d");
    std::array<double, 4> plane{};
    for (std::size_t i = 0; i < 4; ++i) plane[i] = value.at(i).number(-1e6, 1e6);
    const double length = Vec3(plane[0], plane[1], plane[2]).norm();
    if (length < 1e-9) value.fail("the plane's normal [a, b, c] must not be zero");
    pattern_.symmetry = Pattern::Symmetry::Plane;
    pattern_.symmetry_plane = {plane[0], plane[1], plane[2], plane[3] * unit_};
  }

  Pattern& pattern_;
  double unit_;
  std::map<std::string, int> panel_by_name_;
};

json point_json(const Vec2& point, double unit) {
  return {point.x() / unit, point.y() / unit};
}

json fabric_json(const Fabric& fabric) {
  const auto named = fabric_named(fabric.name);
  if (named && named->weft_stiffness == fabric.weft_stiffness && named->warp_stiffness == fabric.warp_stiffness &&
      named->shear_stiffness == fabric.shear_stiffness && named->bending_stiffness == fabric.bending_stiffness &&
      named->density == fabric.density)
    return fabric.name;
  return {{"name", fabric.name},
          {"weft_n_per_m", fabric.weft_stiffness},
          {"warp_n_per_m", fabric.warp_stiffness},
          {"shear_n_per_m", fabric.shear_stiffness},
          {"bending_n_m", fabric.bending_stiffness},
          {"density_kg_per_m2", fabric.density}};
}

// Only what differs from the defaults; null when nothing does.
json edge_json(const PanelEdge& edge) {
  json entry;
  if (!edge.name.empty()) entry["name"] = edge.name;
  if (edge.seam_allowance) entry["seam_allowance_mm"] = *edge.seam_allowance * kMmPerMetre;
  if (edge.hem) entry["hem"] = *edge.hem * kMmPerMetre;
  if (edge.locked) entry["locked"] = true;
  if (edge.zip) entry["zip"] = true;
  if (edge.straight) entry["straight"] = *edge.straight;
  if (edge.on_fold) entry["on_fold"] = true;
  return entry;
}

json panel_json(const Panel& panel, double unit) {
  json entry;
  if (!panel.piece_label.empty()) entry["label"] = panel.piece_label;
  if (panel.quantity != 1) entry["quantity"] = panel.quantity;
  if (!panel.material.empty()) entry["material"] = panel.material;
  if (panel.grainline)
    entry["grainline"] = {point_json((*panel.grainline)[0], unit), point_json((*panel.grainline)[1], unit)};
  if (panel.locked) entry["locked"] = true;
  return entry;
}

void write_panel_parts(const Panel& panel, double unit, json& block) {
  for (std::size_t e = 0; e < panel.edges.size(); ++e) {
    json entry = edge_json(panel.edges[e]);
    if (entry.is_null()) continue;
    entry["panel"] = panel.name;
    entry["edge"] = e;
    block["edges"].push_back(entry);
  }
  json entry = panel_json(panel, unit);
  if (!entry.is_null()) {
    entry["panel"] = panel.name;
    block["panels"].push_back(entry);
  }
  for (const Notch& notch : panel.notches)
    block["notches"].push_back(
        {{"panel", panel.name}, {"edge", notch.edge}, {"at", notch.at}, {"type", notch_name(notch.type)}});
  for (const KeepOut& region : panel.keep_outs) {
    json polygon = json::array();
    for (const Vec2& corner : region.polygon) polygon.push_back(point_json(corner, unit));
    block["keep_out"].push_back({{"panel", panel.name}, {"polygon", polygon}, {"why", region.why}});
  }
}

}  // namespace

void read_toile_block(const JsonView& block, double metre_per_unit, Pattern& pattern) {
  BlockReader(pattern, metre_per_unit).read(block);
}

json write_toile_block(const Pattern& pattern, double metre_per_unit) {
  json block = json::object();
  const Pattern defaults;
  if (!pattern.name.empty()) block["name"] = pattern.name;
  const json fabric = fabric_json(pattern.fabric);
  if (fabric != json(defaults.fabric.name)) block["fabric"] = fabric;
  if (pattern.seam_allowance != defaults.seam_allowance)
    block["seam_allowance_mm"] = pattern.seam_allowance * kMmPerMetre;
  for (const Panel& panel : pattern.panels) write_panel_parts(panel, metre_per_unit, block);
  for (const SeamSide& pin : pattern.pins)
    block["pins"].push_back({{"panel", pattern.panel(pin.panel).name}, {"edge", pin.edge}});
  if (pattern.symmetry == Pattern::Symmetry::None) block["symmetry_plane"] = "none";
  if (pattern.symmetry == Pattern::Symmetry::Plane) {
    const auto& plane = pattern.symmetry_plane;
    block["symmetry_plane"] = {plane[0], plane[1], plane[2], plane[3] / metre_per_unit};
  }
  return block;
}

}  // namespace toile
