// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sew_altered.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/alter/piece_panel.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kNotchedSeam = 0.06;   // m: longer new seams get a notch in their middle
constexpr double kTurnedInArea = 1e-4;  // m^2: a piece larger by more was widened for what is turned in

class Sewing {
 public:
  Sewing(const Pattern& pattern, const PatternMesh& mesh, const AlteredPieces& cut)
      : pattern_(pattern), mesh_(mesh), cut_(cut) {}

  SewnPattern run(const AlterPatternResult& result) {
    start_pattern();
    for (std::size_t i = 0; i < cut_.pieces.size(); ++i)
      sewn_.pattern.panels.push_back(panel_of_piece(pattern_, result, cut_, i));
    sew();
    add_notches();
    add_pins();
    const std::vector<std::string> unlike = unlike_seams(sewn_);
    sewn_.flags.insert(sewn_.flags.end(), unlike.begin(), unlike.end());
    return std::move(sewn_);
  }

 private:
  void start_pattern();
  void sew();
  void add_notches();
  void add_pins();
  const SeamSide& edge_of(int chain) const { return cut_.edges[static_cast<std::size_t>(chain)]; }
  std::vector<int> chains_along(const SeamLine& line) const {
    return ChainSeams(cut_.borders, cut_.chains, cut_.corners).along(line);
  }
  double length_of(int chain) const;

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const AlteredPieces& cut_;
  SewnPattern sewn_;
};

void Sewing::start_pattern() {
  sewn_.pieces = cut_.pieces;
  sewn_.flags = cut_.flags;
  sewn_.pattern.name = pattern_.name;
  sewn_.pattern.fabric = pattern_.fabric;
  sewn_.pattern.seam_allowance = pattern_.seam_allowance;
  sewn_.pattern.symmetry = pattern_.symmetry;
  sewn_.pattern.symmetry_plane = pattern_.symmetry_plane;
}

double Sewing::length_of(int chain) const {
  const BorderChain& along = cut_.chains[static_cast<std::size_t>(chain)];
  return chain_length(cut_.borders[static_cast<std::size_t>(along.piece)], along);
}

void Sewing::sew() {
  for (const ChainSeam& seam : cut_.seams) {
    sewn_.pattern.seams.push_back({edge_of(seam.a), edge_of(seam.b), seam.right_wrong});
    sewn_.seams.push_back({seam.added, length_of(seam.a), length_of(seam.b), seam.eased});
  }
}

// Old notches where their place on the seam is now; one in the middle of every new seam.
void Sewing::add_notches() {
  for (int p = 0; p < static_cast<int>(pattern_.panels.size()); ++p)
    for (const Notch& notch : pattern_.panels[static_cast<std::size_t>(p)].notches) {
      const SeamLine line{p, {notch.edge, -1, false}};
      const auto& vertices = mesh_.edge_vertices[static_cast<std::size_t>(p)][static_cast<std::size_t>(notch.edge)];
      const double at = notch.at * (static_cast<double>(vertices.size()) - 1.0);
      const std::vector<int> chains = chains_along(line);
      for (std::size_t k = 0; k < chains.size(); ++k) {
        const double from = cut_.corners.at(line)[k], to = cut_.corners.at(line)[k + 1];
        if (at < from || at > to || chains[k] < 0 || (at == to && k + 1 < chains.size())) continue;
        const SeamSide edge = edge_of(chains[k]);
        sewn_.pattern.panel(edge.panel).notches.push_back({edge.edge, (at - from) / (to - from), notch.type});
      }
    }
  for (std::size_t s = 0; s < sewn_.seams.size(); ++s)
    if (sewn_.seams[s].added && std::min(sewn_.seams[s].length_a, sewn_.seams[s].length_b) > kNotchedSeam)
      for (const SeamSide& side : {sewn_.pattern.seams[s].a, sewn_.pattern.seams[s].b})
        sewn_.pattern.panel(side.panel).notches.push_back({side.edge, 0.5, NotchType::V});
}

void Sewing::add_pins() {
  for (const SeamSide& pin : pattern_.pins)
    for (const int chain : chains_along({pin.panel.value, {pin.edge, -1, false}}))
      if (chain >= 0) sewn_.pattern.pins.push_back(edge_of(chain));
}

const Panel* panel_named(const Pattern& pattern, const std::string& name) {
  for (const Panel& panel : pattern.panels)
    if (panel.name == name) return &panel;
  return nullptr;
}

}  // namespace

void tell_ticket(const SewnPattern& sewn, Ticket& ticket) {
  bool turned_in = false;
  for (TicketOperation& operation : ticket.operations)
    for (TicketPiece& piece : operation.pieces) {
      const Panel* panel = panel_named(sewn.pattern, piece.name);
      if (!panel) continue;
      const Vec2 box = least_box(flatten_outline(*panel, 1e-4));
      const double size = std::abs(outline_signed_area(*panel));
      turned_in = turned_in || (operation.kind != OperationKind::CutAnew && size > piece.area + kTurnedInArea);
      piece.width = box.x();
      piece.length = box.y();
      piece.area = size;
    }
  if (turned_in)
    ticket.notes.push_back(
        "Where cloth is cut open it turns in one seam allowance; the pieces let in there are that much wider on every "
        "such side.");
  ticket.notes.insert(ticket.notes.end(), sewn.flags.begin(), sewn.flags.end());
}

SewnPattern sew_altered(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                        const std::vector<CutPanel*>& cuts, const AlterPatternResult& result, RecutPanels& recut,
                        SewMemory& memory) {
  const AlteredPieces cut = cut_altered_pieces(pattern, mesh, target_rest, cuts, result, recut, memory);
  if (cut.pieces.empty()) {
    SewnPattern nothing;
    nothing.flags = cut.flags;
    return nothing;
  }
  return Sewing(pattern, mesh, cut).run(result);
}

}  // namespace toile
