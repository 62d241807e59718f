// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/couple_plies.h"

#include <algorithm>
#include <cmath>

#include "engine/alter/search_tears.h"
#include "engine/core/work_off.h"

namespace toile {
namespace {

constexpr double kApart = 5e-5;   // m: plies that lie nearer to each other are alike
constexpr double kAcross = 0.05;  // m: half the length of the line that holds a vertex at its place along the seam

// A vertex of a sheet on the side that holds a seam.
struct Ply {
  int vertex = -1;
  double wanted = 0.0, now = 0.0;  // arc length along the wanted side
  bool fixed = false;              // hangs on another side too
};

class Coupling {
 public:
  Coupling(const Pattern& pattern, const PatternMesh& mesh, const Points2& wanted, double stretch_limit,
           std::vector<Sheet>& sheets, TearMemory* memory)
      : pattern_(pattern),
        mesh_(mesh),
        wanted_(wanted),
        limit_(stretch_limit),
        sheets_(sheets),
        memory_(memory),
        holds_(sheets.size()) {
    for (const Sheet& sheet : sheets) {
      vertices_.emplace_back(static_cast<std::size_t>(mesh.vertex_count()), -1);
      for (int v = sheet.vertex_count() - 1; v >= 0; --v)
        if (const int origin = sheet.vertices[static_cast<std::size_t>(v)].origin; origin >= 0)
          vertices_.back()[static_cast<std::size_t>(origin)] = v;
    }
  }

  void run(const RelaxOptions& options, Progress* progress) {
    for (std::size_t s = 0; s < pattern_.seams.size(); ++s) couple(s);
    work_off(sheets_.size(), [&](std::size_t p) {
      if (std::any_of(holds_[p].begin(), holds_[p].end(), [](const SeamHold& hold) { return hold.moves; }))
        hold_panel(p, options, progress);
    });
  }

 private:
  int side_of(const SeamSide& seam) const {
    const auto& sides = sheets_[static_cast<std::size_t>(seam.panel.value)].sides;
    for (std::size_t s = 0; s < sides.size(); ++s)
      if (std::find(sides[s].edges.begin(), sides[s].edges.end(), seam.edge) != sides[s].edges.end())
        return static_cast<int>(s);
    return -1;
  }

  double wanted_at(int panel, int side, int v) const {
    const Sheet& sheet = sheets_[static_cast<std::size_t>(panel)];
    return sheet.wanted_sides[static_cast<std::size_t>(side)].closest(wanted_.row(v).transpose()).at;
  }

  // vertex -1: it does not hang there.
  Ply ply(int panel, int side, int v) const {
    const Sheet& sheet = sheets_[static_cast<std::size_t>(panel)];
    Ply result;
    const int own = vertices_[static_cast<std::size_t>(panel)][static_cast<std::size_t>(v)];
    if (own < 0) return result;
    const SheetVertex& vertex = sheet.vertices[static_cast<std::size_t>(own)];
    const SheetAnchor* anchor = vertex.anchor(side);
    if (!anchor || !anchor->attached) return result;
    result.vertex = own;
    result.wanted = wanted_at(panel, side, v);
    result.now = sheet.wanted_sides[static_cast<std::size_t>(side)].closest(vertex.now).at;
    result.fixed = pattern_.panels[static_cast<std::size_t>(panel)].locked;
    for (const SheetAnchor& other : vertex.anchors)
      if (other.side >= 0 && other.side != side && other.attached) result.fixed = true;
    return result;
  }

  void couple(std::size_t s) {
    const Seam& seam = pattern_.seams[s];
    const auto& pairs = mesh_.seam_vertices[s];
    const int side_a = side_of(seam.a), side_b = side_of(seam.b);
    if (side_a < 0 || side_b < 0 || pairs.size() < 2) return;
    const int panel_a = seam.a.panel.value, panel_b = seam.b.panel.value;
    const double long_a =
        wanted_at(panel_a, side_a, pairs.back().first) - wanted_at(panel_a, side_a, pairs.front().first);
    const double long_b =
        wanted_at(panel_b, side_b, pairs.back().second) - wanted_at(panel_b, side_b, pairs.front().second);
    if (std::abs(long_a) < kApart || std::abs(long_b) < kApart) return;
    const double ratio = long_a / long_b;  // < 0 where the sides run against each other
    for (const auto& [v, w] : pairs) {
      const Ply a = ply(panel_a, side_a, v), b = ply(panel_b, side_b, w);
      if (a.vertex < 0 || b.vertex < 0) continue;
      const double way_a = a.now - a.wanted, way_b = ratio * (b.now - b.wanted);
      const double way = a.fixed ? way_a : b.fixed ? way_b : 0.5 * (way_a + way_b);
      if (!a.fixed) hold(panel_a, {a.vertex, side_a, a.wanted + way, std::abs(way - way_a) > kApart});
      if (!b.fixed) hold(panel_b, {b.vertex, side_b, b.wanted + way / ratio, std::abs(way - way_b) > kApart});
    }
  }

  void hold(int panel, const SeamHold& hold) {
    auto& holds = holds_[static_cast<std::size_t>(panel)];
    const auto known =
        std::find_if(holds.begin(), holds.end(), [&](const SeamHold& other) { return other.vertex == hold.vertex; });
    if (known == holds.end()) holds.push_back(hold);
  }

  // Not where it would strain the panel beyond its limit.
  void hold_panel(std::size_t p, const RelaxOptions& options, Progress* progress) {
    const Sheet held = remembered(p, options, progress);
    const double before = share_of_strain(measure_stress(sheets_[p]), limit_);
    if (share_of_strain(measure_stress(held), limit_) > std::max(1.0, before)) return;
    for (std::size_t v = 0; v < held.vertices.size(); ++v) sheets_[p].vertices[v].now = held.vertices[v].now;
  }

  Sheet remembered(std::size_t p, const RelaxOptions& options, Progress* progress) const {
    if (!memory_) return held_sheet(p, options, progress);
    auto& known = (*memory_)[p].held;
    for (const HeldSheet& sheet : known)
      if (sheet.holds == holds_[p] && lie_alike(sheet.before, sheets_[p])) return sheet.after;
    known.push_back({sheets_[p], holds_[p], held_sheet(p, options, progress)});
    return known.back().after;
  }

  // What is known of a sheet that was not cut serves it while it is held.
  SheetEquations* equations_for(std::size_t p, double hold) const {
    const auto& vertices = sheets_[p].vertices;
    const PanelRange& range = mesh_.panels[p];
    const bool uncut =
        static_cast<int>(vertices.size()) == range.vertex_end - range.vertex_begin &&
        std::all_of(vertices.begin(), vertices.end(), [](const SheetVertex& vertex) { return vertex.origin >= 0; });
    return memory_ && uncut ? &equations_of((*memory_)[p].fine, sheets_[p], hold) : nullptr;
  }

  // Adds a line across the seam on which the vertex hangs besides.
  Sheet held_sheet(std::size_t p, const RelaxOptions& options, Progress* progress) const {
    Sheet held = sheets_[p];
    for (const SeamHold& hold : holds_[p]) {
      const SideCurve& side = held.wanted_sides[static_cast<std::size_t>(hold.side)];
      const Vec2 point = side.point(hold.at), across = kAcross * side.closest(point).normal;
      SheetVertex& vertex = held.vertices[static_cast<std::size_t>(hold.vertex)];
      for (SheetAnchor& anchor : vertex.anchors)
        if (anchor.side != hold.side) anchor = {static_cast<int>(held.wanted_sides.size()), 0.0, true};
      held.wanted_sides.emplace_back(std::vector<Vec2>{point - across, point + across});
    }
    relax(held, options, progress, equations_for(p, options.hold));
    return held;
  }

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const Points2& wanted_;
  double limit_;
  std::vector<Sheet>& sheets_;
  TearMemory* memory_;
  std::vector<std::vector<int>> vertices_;    // per sheet and pattern vertex: the sheet's, or -1
  std::vector<std::vector<SeamHold>> holds_;  // per sheet
};

}  // namespace

void couple_plies(const Pattern& pattern, const PatternMesh& mesh, const Points2& wanted, double stretch_limit,
                  const RelaxOptions& options, std::vector<Sheet>& sheets, TearMemory* memory, Progress* progress) {
  Coupling(pattern, mesh, wanted, stretch_limit, sheets, memory).run(options, progress);
}

}  // namespace toile
