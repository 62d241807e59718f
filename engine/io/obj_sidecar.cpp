// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/obj_sidecar.h"

#include <map>

#include <nlohmann/json.hpp>

#include "engine/core/units.h"
#include "engine/io/garmentcode_json.h"
#include "engine/io/json.h"
#include "engine/io/toile_block.h"

namespace toile {

namespace {

constexpr std::size_t kMostSeams = 100'000;

class SideFinder {
 public:
  SideFinder(const ObjIslands& islands, BorderSegments& borders) : borders_(borders) {
    for (int i = 0; i < borders.size(); ++i)
      segment_of_texture_[islands.texture[static_cast<std::size_t>(borders.start[static_cast<std::size_t>(i)])]] = i;
  }

  // The first segment, along the outline, of the side between two texture numbers.
  int find(const JsonView& side, bool against) {
    side.require_only({"from", "to"});
    int from = segment_at(side.at("from")), to = segment_at(side.at("to"));
    if (against) std::swap(from, to);
    if (borders_.island[static_cast<std::size_t>(from)] != borders_.island[static_cast<std::size_t>(to)] || from == to)
      side.fail("the two ends must be different vertices of one panel's outline", ErrorCode::SeamInvalid);
    cut_at(borders_, from);
    cut_at(borders_, to);
    for (int i = from; i != to; i = borders_.next(i)) {
      if (i != from && borders_.cut[static_cast<std::size_t>(i)])
        side.fail("another seam begins inside this side; cut it there", ErrorCode::SeamInvalid);
      borders_.whole[static_cast<std::size_t>(i)] = i != from;
    }
    return from;
  }

 private:
  int segment_at(const JsonView& number) {
    const auto found = segment_of_texture_.find(number.integer(1, 10'000'000) - 1);
    if (found == segment_of_texture_.end())
      number.fail("this texture coordinate does not lie on a panel's outline", ErrorCode::SeamInvalid);
    return found->second;
  }

  BorderSegments& borders_;
  std::map<int, int> segment_of_texture_;
};

}  // namespace

bool sidecar_names_seams(std::span<const std::uint8_t> sidecar) {
  const nlohmann::json document = parse_json(sidecar, "sidecar");
  const auto seams = JsonView(document).find("seams");
  return seams && seams->size() > 0;
}

std::vector<NamedSeam> apply_sidecar_seams(std::span<const std::uint8_t> sidecar, const ObjIslands& islands,
                                           BorderSegments& borders) {
  const nlohmann::json document = parse_json(sidecar, "sidecar");
  SideFinder finder(islands, borders);
  std::vector<NamedSeam> seams;
  const auto list = JsonView(document).find("seams");
  if (!list) return seams;
  for (const JsonView& entry : list->elements(kMostSeams)) {
    if (entry.size() < 2 || entry.size() > 3) entry.fail("expected two sides and optionally \"right_wrong\"");
    NamedSeam seam;
    if (entry.size() == 3 && entry.at(2).text() != "right_wrong") entry.at(2).fail("expected \"right_wrong\"");
    seam.right_wrong = entry.size() == 3;
    seam.a = finder.find(entry.at(std::size_t{0}), false);
    seam.b = finder.find(entry.at(1), !seam.right_wrong);
    seams.push_back(seam);
  }
  return seams;
}

void apply_sidecar_panels(std::span<const std::uint8_t> sidecar, Pattern& pattern) {
  const nlohmann::json document = parse_json(sidecar, "sidecar");
  const JsonView root(document);
  root.require_only({"schema", "seams", "panels", "toile"});
  if (const auto panels = root.find("panels"))
    for (const auto& [name, value] : panels->members()) {
      const auto same = [&, n = name](const Panel& panel) { return panel.name == n; };
      const auto panel = std::find_if(pattern.panels.begin(), pattern.panels.end(), same);
      if (panel == pattern.panels.end()) value.fail("no panel of this name; panels are named after the OBJ's groups");
      value.require_only({"translation", "rotation", "label"});
      if (const auto label = value.find("label")) panel->label = label->text();
      if (const auto translation = value.find("translation"))
        panel->translation = translation->vector3(kMaxCoordinate / kMetrePerCm) * kMetrePerCm;
      if (const auto rotation = value.find("rotation")) panel->rotation = rotation_of_degrees(rotation->vector3(1e4));
    }
  if (const auto block = root.find("toile")) read_toile_block(*block, kMetrePerCm, pattern);
}

}  // namespace toile
