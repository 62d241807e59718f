// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/altered_pieces.h"

#include <algorithm>
#include <map>

#include "engine/alter/kept_cloth.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kMostTurnedOver = 0.005;  // share of a piece's area
constexpr double kLeastTurnIn = 1e-3;      // m: a cut is opened by this much even without seam allowance
constexpr double kLeastEdge = 3e-4;        // m: shorter chains are left out

void move_rest(const PolygonPlace& place, PieceMap& map) {
  for (Eigen::Index v = 0; v < map.rest.rows(); ++v) map.rest.row(v) = place(map.rest.row(v).transpose()).transpose();
}

constexpr int kTruings = 2;  // after the first

// Plies of one panel that differ by more than both cannot be eased onto each other: the wanted panel has its darts
// elsewhere than the cloth, and strips across their mouths would gather it.
constexpr double kMostEased = 0.33, kMostEasedLength = 8e-3;  // of the longer ply, and m
constexpr double kMostUnlike = 0.02;                          // m, of a seam with another panel

class Cutting {
 public:
  Cutting(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
          const std::vector<CutPanel*>& cuts, const AlterPatternResult& result, RecutPanels& recut, SewMemory& memory)
      : pattern_(pattern),
        mesh_(mesh),
        target_rest_(target_rest),
        cuts_(cuts),
        alteration_(result),
        recut_(recut),
        memory_(memory) {}

  AlteredPieces run() {
    for (int p = 0; p < static_cast<int>(pattern_.panels.size()); ++p)
      if (!add_panel(p)) return std::move(cut_);
    cut_.corners = share_corners(pattern_, mesh_, cut_.borders);
    cut_.chains = border_chains(cut_.borders);
    cut_.seams = ChainSeams(cut_.borders, cut_.chains, cut_.corners).find(pattern_, mesh_, target_rest_, cut_.flags);
    if (all_meet()) {
      true_and_draw();
      if (all_sound()) return std::move(cut_);
    }
    cut_.pieces.clear();
    return std::move(cut_);
  }

 private:
  struct KeptEdge {
    int panel;
    double length;  // m, of its cloth
    double off;     // m, from the length in the target; 0 of cloth that is cut to it
  };
  std::vector<bool> let_out(const PanelAlteration& panel) const;
  bool add_panel(int p);
  PanelPieces altered_pieces(int p) const;
  const PanelPieces& known_pieces(int p) const;
  PanelPieces pieces_of(int p, const AlteredParts& parts, bool recut) const;
  void take(PanelPieces&& pieces);
  KeptEdge kept_edge(int chain) const;
  bool all_meet();
  bool neighbours_meet();
  std::vector<bool> fixed_pieces() const;
  void true_and_draw();
  void draw_pieces();
  void draw_edges(std::size_t i);
  bool all_sound();

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const Points2& target_rest_;
  const std::vector<CutPanel*>& cuts_;
  const AlterPatternResult& alteration_;
  RecutPanels& recut_;
  SewMemory& memory_;
  AlteredPieces cut_;
};

std::vector<bool> Cutting::let_out(const PanelAlteration& panel) const {
  std::vector<bool> from_allowance;
  for (const AlteredRegion& region : panel.insertions)
    from_allowance.push_back(region.operation >= 0 &&
                             alteration_.ticket.operations[static_cast<std::size_t>(region.operation)].fabric ==
                                 FabricNeed::WithinAllowance);
  return from_allowance;
}

// False, when not even the target panel can be cut.
bool Cutting::add_panel(int p) {
  const bool known = recut_.contains(p);
  std::string problem = known ? recut_.at(p).why : "";
  if (!known) {
    const PanelPieces& altered = known_pieces(p);
    if (altered.problem.empty()) {
      take(PanelPieces(altered));
      return true;
    }
    problem = altered.problem;
  }
  const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(p)];
  PanelPieces whole = pieces_of(p, whole_panel(mesh_, target_rest_, panel.target, p), true);
  if (whole.problem.empty()) {
    take(std::move(whole));
    if (!known) recut_.emplace(p, CutAnew{problem, {}, -1});
    return true;
  }
  cut_.flags.push_back("panel " + panel.panel + " cannot be sewn: " + whole.problem);
  cut_.pieces.clear();
  return false;
}

void Cutting::take(PanelPieces&& panel) {
  std::move(panel.pieces.begin(), panel.pieces.end(), std::back_inserter(cut_.pieces));
  std::move(panel.borders.begin(), panel.borders.end(), std::back_inserter(cut_.borders));
}

Loops loops_of(const std::vector<AlteredRegion>& regions) {
  Loops loops;
  for (const AlteredRegion& region : regions) {
    loops.push_back(region.shape.outline);
    loops.insert(loops.end(), region.shape.holes.begin(), region.shape.holes.end());
  }
  return loops;
}

// Of a panel that is not cut anew; cut once for the same regions.
const PanelPieces& Cutting::known_pieces(int p) const {
  const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(p)];
  std::vector<KnownPieces>& known = cuts_[static_cast<std::size_t>(p)]->pieces;
  const KnownPieces wanted{loops_of(panel.insertions), loops_of(panel.removals), let_out(panel), {}};
  const auto found = std::find_if(known.begin(), known.end(), [&](const KnownPieces& pieces) {
    return pieces.insertions == wanted.insertions && pieces.removals == wanted.removals &&
           pieces.let_out == wanted.let_out;
  });
  if (found != known.end()) return found->cut;
  known.push_back(wanted);
  known.back().cut = altered_pieces(p);
  return known.back().cut;
}

PanelPieces Cutting::altered_pieces(int p) const {
  const auto index = static_cast<std::size_t>(p);
  const PanelAlteration& panel = alteration_.panels[index];
  if (panel.insertions.empty() && panel.removals.empty())
    return pieces_of(p, whole_panel(mesh_, target_rest_, panel.target, p), false);
  std::string problem;
  for (const bool trims : {false, true}) {  // slivers are a reason, and only then a change
    const AlteredParts parts =
        part_altered_panel(mesh_, target_rest_, cuts_[index]->inserting, cuts_[index]->removing, panel, let_out(panel),
                           std::max(pattern_.seam_allowance, kLeastTurnIn), trims);
    PanelPieces pieces = parts.problem.empty() ? pieces_of(p, parts, false) : PanelPieces{{}, {}, parts.problem};
    if (pieces.problem.empty()) return pieces;
    if (problem.empty()) problem = pieces.problem;
  }
  return {{}, {}, problem};
}

// `recut`: the panel is cut anew.
PanelPieces Cutting::pieces_of(int p, const AlteredParts& parts, bool recut) const {
  const auto index = static_cast<std::size_t>(p);
  const Sheet& inserting = cuts_[index]->inserting;
  ClothSource source(inserting, cuts_[index]->removing, alteration_.panels[index]);
  PanelPieces panel;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    const AlteredPart& part = parts.parts[i];
    PieceCloth cloth =
        recut || part.insertion >= 0 ? identical_cloth(parts, i, inserting.edge_length) : source.of(parts, i);
    if (!cloth.problem.empty()) return {{}, {}, cloth.problem};
    const bool own_cloth = recut && recut_.contains(p) && recut_.at(p).in_own_cloth;
    if (own_cloth) move_rest(*recut_.at(p).in_own_cloth, cloth.map);
    if (cloth.turned_over > kMostTurnedOver) return {{}, {}, "its cloth turns over"};
    PieceBorder border{p, static_cast<int>(i), {}, part.loop};
    std::vector<Vec2> outline;
    for (int v = 0; v < cloth.map.border_count; ++v) outline.emplace_back(cloth.map.rest.row(v));
    if (!is_simple_polygon(outline)) return {{}, {}, "the outline of a kept piece crosses itself"};
    for (std::size_t k = 0; k < part.loop.size(); ++k) {
      const int point = part.loop[k].from;
      border.vertices.push_back({point, parts.points[static_cast<std::size_t>(point)],
                                 cloth.map.rest.row(cloth.border[k]), parts.corner[static_cast<std::size_t>(point)]});
    }
    panel.borders.push_back(std::move(border));
    panel.pieces.push_back({p, part.insertion, recut, own_cloth, cloth.strain, cloth.turned_over, cloth.map});
  }
  return panel;
}

// Pieces of a panel whose edges are far from alike where they are sewn to each other: the panel is cut anew.
bool Cutting::all_meet() {
  std::map<std::pair<int, int>, std::pair<double, double>> plies;
  const auto piece_of = [&](int chain) { return cut_.chains[static_cast<std::size_t>(chain)].piece; };
  const auto length = [&](int chain) {
    return chain_length(cut_.borders[static_cast<std::size_t>(piece_of(chain))],
                        cut_.chains[static_cast<std::size_t>(chain)]);
  };
  const auto panel_of = [&](int piece) { return cut_.pieces[static_cast<std::size_t>(piece)].panel; };
  for (const ChainSeam& seam : cut_.seams) {
    const int a = piece_of(seam.a), b = piece_of(seam.b);
    if (panel_of(a) != panel_of(b)) continue;
    auto& [first, second] = plies[std::minmax(a, b)];
    first += length(a <= b ? seam.a : seam.b);
    second += length(a <= b ? seam.b : seam.a);
  }
  bool meet = true;
  for (const auto& [pieces, lengths] : plies) {
    const int p = panel_of(pieces.first);
    const auto [shorter, longer] = std::minmax(lengths.first, lengths.second);
    if (longer - shorter <= std::max(kMostEased * longer, kMostEasedLength)) continue;
    if (pattern_.panels[static_cast<std::size_t>(p)].locked) continue;
    if (recut_.emplace(p, CutAnew{"the edges of its pieces do not meet", {}, -1}).second) meet = false;
  }
  return meet && neighbours_meet();
}

// Seams of two panels whose sides are far from alike: the panel is cut anew whose cloth is farther from the length that
// is wanted there. Its darts stayed elsewhere.
bool Cutting::neighbours_meet() {
  bool meet = true;
  for (const ChainSeam& seam : cut_.seams) {
    const KeptEdge a = kept_edge(seam.a), b = kept_edge(seam.b);
    if (a.panel == b.panel) continue;
    const double most = std::max(kMostEased * std::max(a.length, b.length), kMostUnlike);
    if (std::abs(a.length - b.length - seam.eased) <= most) continue;
    const KeptEdge& farther = a.off > b.off ? a : b;
    if (farther.off <= 0.0 || pattern_.panels[static_cast<std::size_t>(farther.panel)].locked) continue;
    if (recut_.emplace(farther.panel, CutAnew{"its edges do not meet those of other panels", {}, -1}).second)
      meet = false;
  }
  return meet;
}

Cutting::KeptEdge Cutting::kept_edge(int chain) const {
  const BorderChain& along = cut_.chains[static_cast<std::size_t>(chain)];
  const PieceBorder& border = cut_.borders[static_cast<std::size_t>(along.piece)];
  const SewnPiece& piece = cut_.pieces[static_cast<std::size_t>(along.piece)];
  KeptEdge edge{piece.panel, chain_length(border, along), 0.0};
  if (piece.insertion >= 0 || piece.recut) return edge;
  double wanted = 0.0;
  for (std::size_t i = 1; i < along.vertices.size(); ++i) {
    const auto at = [&](std::size_t k) { return border.vertices[static_cast<std::size_t>(along.vertices[k])].target; };
    wanted += (at(i) - at(i - 1)).norm();
  }
  edge.off = std::abs(edge.length - wanted);
  return edge;
}

// Cloth that is cut as it is: of locked panels, and what just fits into its own old cloth.
std::vector<bool> Cutting::fixed_pieces() const {
  std::vector<bool> fixed;
  for (const SewnPiece& piece : cut_.pieces)
    fixed.push_back(piece.own_cloth || pattern_.panels[static_cast<std::size_t>(piece.panel)].locked);
  return fixed;
}

// Pieces too narrow to be trued stay as they are, and what is sewn to them follows.
void Cutting::true_and_draw() {
  const std::vector<PieceBorder> borders = cut_.borders;
  const std::vector<SewnPiece> pieces = cut_.pieces;
  std::vector<bool> fixed = fixed_pieces();
  for (int pass = 0;; ++pass) {
    std::vector<bool> failed =
        true_seams(cut_.chains, cut_.seams, fixed, mesh_.target_edge_length, cut_.borders, cut_.pieces, &memory_.trued);
    draw_pieces();
    for (std::size_t i = 0; i < failed.size(); ++i)
      if (!cut_.drawn[i].edges.sound && cut_.borders[i].trued) failed[i] = true;
    if (std::find(failed.begin(), failed.end(), true) == failed.end()) return;
    const bool again = pass < kTruings;
    for (std::size_t i = 0; i < failed.size(); ++i) {
      if (failed[i]) fixed[i] = true;
      if (!again && !failed[i]) continue;
      cut_.borders[i] = borders[i];
      cut_.pieces[i] = pieces[i];
      if (!again) draw_edges(i);
    }
    if (!again) return;
  }
}

void Cutting::draw_pieces() {
  cut_.drawn.clear();
  cut_.edges.assign(cut_.chains.size(), {PanelId(-1), 0});
  for (std::size_t i = 0; i < cut_.borders.size(); ++i) {
    const SewnPiece& piece = cut_.pieces[i];
    const auto p = static_cast<std::size_t>(piece.panel);
    DrawnPiece drawn{{}, {}, static_cast<bool>(mesh_.panel_reversed[p])};
    std::vector<std::size_t> own;
    for (std::size_t c = 0; c < cut_.chains.size(); ++c)
      if (cut_.chains[c].piece == static_cast<int>(i)) own.push_back(c);
    for (std::size_t k = 0; k < own.size(); ++k) {
      drawn.chains.push_back(&cut_.chains[own[k]]);
      cut_.edges[own[k]] = {PanelId(static_cast<int>(i)), static_cast<int>(drawn.reversed ? own.size() - 1 - k : k)};
    }
    cut_.drawn.push_back(std::move(drawn));
    draw_edges(i);
  }
}

void Cutting::draw_edges(std::size_t i) {
  const SewnPiece& piece = cut_.pieces[i];
  DrawnPiece& drawn = cut_.drawn[i];
  const bool kept = piece.insertion < 0 && !piece.recut;
  const auto same = [](const BorderChain& chain, const BorderChain* other) {
    return chain.vertices == other->vertices && chain.along == other->along;
  };
  for (const KnownDrawing& known : memory_.drawn)
    if (known.kept == kept && known.border == cut_.borders[i] &&
        std::equal(known.chains.begin(), known.chains.end(), drawn.chains.begin(), drawn.chains.end(), same)) {
      drawn.edges = known.edges;
      return;
    }
  drawn.edges = draw_piece_edges(cut_.borders[i], drawn.chains,
                                 kept ? &pattern_.panels[static_cast<std::size_t>(piece.panel)] : nullptr);
  memory_.drawn.push_back({cut_.borders[i], kept, {}, drawn.edges});
  for (const BorderChain* chain : drawn.chains) memory_.drawn.back().chains.push_back(*chain);
}

// Small and narrow pieces can be nothing, or touch themselves, once they are drawn: their panel is cut anew, and where
// that is no cure either, nothing is sewn.
bool Cutting::all_sound() {
  bool sound = true;
  for (std::size_t i = 0; i < cut_.drawn.size(); ++i) {
    if (cut_.drawn[i].edges.sound) continue;
    sound = false;
    const int p = cut_.pieces[i].panel;
    const std::string problem = "the outline of a piece encloses nothing or touches itself";
    if (recut_.emplace(p, CutAnew{problem, {}, -1}).second) continue;
    cut_.flags.push_back("panel " + pattern_.panels[static_cast<std::size_t>(p)].name + " cannot be sewn: " + problem);
  }
  return sound;
}

}  // namespace

AlteredPieces cut_altered_pieces(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest,
                                 const std::vector<CutPanel*>& cuts, const AlterPatternResult& result,
                                 RecutPanels& recut, SewMemory& memory) {
  return Cutting(pattern, mesh, target_rest, cuts, result, recut, memory).run();
}

}  // namespace toile
