// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/sew_altered.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/alter/kept_cloth.h"
#include "engine/alter/piece_edges.h"
#include "engine/geometry/curve.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

constexpr double kMostTurnedOver = 0.005;  // share of a piece's area
constexpr double kLeastTurnIn = 1e-3;      // m: a cut is opened by this much even without seam allowance
constexpr double kNotchedSeam = 0.06;      // m: longer new seams get a notch in their middle
constexpr double kTurnedInArea = 1e-4;     // m^2: a piece larger by more was widened for what is turned in
constexpr double kLeastEdge = 3e-4;        // m: shorter chains are left out
// Plies of one panel that differ by more than both cannot be eased onto each other: the wanted panel has its darts
// elsewhere than the cloth, and strips across their mouths would gather it.
constexpr double kMostEased = 0.33, kMostEasedLength = 8e-3;  // of the longer ply, and m

struct DrawnPiece {
  PieceBorder border;
  std::vector<const BorderChain*> chains;
  PieceEdges edges;
  int insertion = -1;
  bool reversed = false;  // the panel's outline runs clockwise
};

void move_rest(const PolygonPlace& place, PieceMap& map) {
  for (Eigen::Index v = 0; v < map.rest.rows(); ++v) map.rest.row(v) = place(map.rest.row(v).transpose()).transpose();
}

class Sewing {
 public:
  Sewing(const Pattern& pattern, const PatternMesh& mesh, const Points2& target_rest, const TornPattern& inserting,
         const TornPattern& removing, const AlterPatternResult& result, RecutPanels& recut)
      : pattern_(pattern),
        mesh_(mesh),
        target_rest_(target_rest),
        inserting_(inserting),
        removing_(removing),
        alteration_(result),
        recut_(recut) {}

  SewnPattern run() {
    for (int p = 0; p < static_cast<int>(pattern_.panels.size()); ++p)
      if (!add_panel(p)) return std::move(sewn_);
    corners_ = share_corners(pattern_, mesh_, borders_);
    chains_ = border_chains(borders_);
    draw_pieces();
    if (!all_sound()) return std::move(sewn_);
    start_pattern();
    for (std::size_t i = 0; i < drawn_.size(); ++i) add_piece(i);
    sew_lines();
    sew_neighbours();
    if (!all_meet()) return std::move(sewn_);
    add_notches();
    add_pins();
    return std::move(sewn_);
  }

 private:
  std::vector<bool> let_out(const PanelAlteration& panel) const;
  bool add_panel(int p);
  std::string try_panel(int p, const AlteredParts& parts, bool recut);
  void draw_pieces();
  bool all_sound();
  bool all_meet();
  void start_pattern();
  void add_piece(std::size_t i);
  std::string name_of(std::size_t i) const;
  PanelEdge edge_of(std::size_t i, std::size_t k) const;
  void carry_details(const Panel& from, std::size_t i, Panel& to) const;
  void place(std::size_t i, Panel& panel) const;
  void sew_lines();
  void sew_line(const SeamLine& a, const SeamLine& b, bool against, bool added);
  void sew_neighbours();
  void sew(const SeamSide& a, const SeamSide& b, bool right_wrong, bool added);
  void add_notches();
  void add_pins();
  // Edges along a line, one per stretch between its corners; an invalid panel where there is none.
  std::vector<SeamSide> edges_along(const SeamLine& line) const;
  std::vector<SeamLine> cuts() const;
  double length_of(const SeamSide& side) const;
  int edge_number(std::size_t i, std::size_t k) const {
    const auto count = static_cast<int>(drawn_[i].chains.size());
    return drawn_[i].reversed ? count - 1 - static_cast<int>(k) : static_cast<int>(k);
  }

  const Pattern& pattern_;
  const PatternMesh& mesh_;
  const Points2& target_rest_;
  const TornPattern &inserting_, &removing_;
  const AlterPatternResult& alteration_;
  RecutPanels& recut_;
  SewnPattern sewn_;
  std::vector<PieceBorder> borders_;
  std::vector<BorderChain> chains_;
  LineCorners corners_;
  std::vector<DrawnPiece> drawn_;
};

std::vector<bool> Sewing::let_out(const PanelAlteration& panel) const {
  std::vector<bool> from_allowance;
  for (const AlteredRegion& region : panel.insertions)
    from_allowance.push_back(region.operation >= 0 &&
                             alteration_.ticket.operations[static_cast<std::size_t>(region.operation)].fabric ==
                                 FabricNeed::WithinAllowance);
  return from_allowance;
}

// False, when not even the target panel can be cut.
bool Sewing::add_panel(int p) {
  const auto index = static_cast<std::size_t>(p);
  const PanelAlteration& panel = alteration_.panels[index];
  const bool altered = !panel.insertions.empty() || !panel.removals.empty();
  const AlteredParts whole = whole_panel(mesh_, target_rest_, panel.target, p);
  const bool known = recut_.contains(p);
  std::string problem = known ? recut_.at(p).why : "";
  if (problem.empty()) {
    const AlteredParts parts =
        altered ? part_altered_panel(mesh_, target_rest_, inserting_.sheets[index], removing_.sheets[index], panel,
                                     let_out(panel), std::max(pattern_.seam_allowance, kLeastTurnIn))
                : whole;
    problem = parts.problem.empty() ? try_panel(p, parts, false) : parts.problem;
  }
  if (problem.empty()) return true;
  const std::string hopeless = try_panel(p, whole, true);
  if (hopeless.empty()) {
    if (!known) recut_.emplace(p, CutAnew{problem, std::nullopt});
    return true;
  }
  sewn_.flags.push_back("panel " + panel.panel + " cannot be sewn: " + hopeless);
  sewn_.pieces.clear();
  return false;
}

// Adds the panel's pieces; adds none and says why, when their cloth cannot be sewn.
std::string Sewing::try_panel(int p, const AlteredParts& parts, bool recut) {
  const auto index = static_cast<std::size_t>(p);
  const ClothSource source(inserting_.sheets[index], removing_.sheets[index], alteration_.panels[index]);
  std::vector<SewnPiece> pieces;
  std::vector<PieceBorder> borders;
  for (std::size_t i = 0; i < parts.parts.size(); ++i) {
    const AlteredPart& part = parts.parts[i];
    PieceCloth cloth = recut || part.insertion >= 0 ? identical_cloth(parts, i, inserting_.sheets[index].edge_length)
                                                    : source.of(parts, i);
    if (!cloth.problem.empty()) return cloth.problem;
    const bool own_cloth = recut && recut_.contains(p) && recut_.at(p).in_own_cloth;
    if (own_cloth) move_rest(*recut_.at(p).in_own_cloth, cloth.map);
    if (cloth.turned_over > kMostTurnedOver) return "its cloth turns over";
    PieceBorder border{p, static_cast<int>(i), {}, part.loop};
    std::vector<Vec2> outline;
    for (int v = 0; v < cloth.map.border_count; ++v) outline.emplace_back(cloth.map.rest.row(v));
    if (!is_simple_polygon(outline)) return "the outline of a kept piece crosses itself";
    for (std::size_t k = 0; k < part.loop.size(); ++k) {
      const int point = part.loop[k].from;
      border.vertices.push_back({point, parts.points[static_cast<std::size_t>(point)],
                                 cloth.map.rest.row(cloth.border[k]), parts.corner[static_cast<std::size_t>(point)]});
    }
    borders.push_back(std::move(border));
    pieces.push_back({p, part.insertion, recut, own_cloth, cloth.strain, cloth.turned_over, cloth.map});
  }
  std::move(pieces.begin(), pieces.end(), std::back_inserter(sewn_.pieces));
  std::move(borders.begin(), borders.end(), std::back_inserter(borders_));
  return {};
}

void Sewing::draw_pieces() {
  for (std::size_t i = 0; i < borders_.size(); ++i) {
    const SewnPiece& piece = sewn_.pieces[i];
    DrawnPiece drawn{borders_[i],
                     {},
                     {},
                     piece.insertion,
                     static_cast<bool>(mesh_.panel_reversed[static_cast<std::size_t>(piece.panel)])};
    for (const BorderChain& chain : chains_) {
      if (chain.piece != static_cast<int>(i)) continue;
      double length = 0.0;
      for (std::size_t k = 1; k < chain.vertices.size(); ++k)
        length += (drawn.border.vertices[static_cast<std::size_t>(chain.vertices[k])].rest -
                   drawn.border.vertices[static_cast<std::size_t>(chain.vertices[k - 1])].rest)
                      .norm();
      if (length >= kLeastEdge) drawn.chains.push_back(&chain);
    }
    const Panel& panel = pattern_.panels[static_cast<std::size_t>(piece.panel)];
    drawn.edges = draw_piece_edges(drawn.border, drawn.chains, piece.insertion < 0 && !piece.recut ? &panel : nullptr);
    drawn_.push_back(std::move(drawn));
  }
}

// Small and narrow pieces can be nothing, or touch themselves, once they are drawn: their panel is cut anew, and where
// that is no cure either, nothing is sewn.
bool Sewing::all_sound() {
  bool sound = true;
  for (const DrawnPiece& drawn : drawn_) {
    if (drawn.edges.sound) continue;
    sound = false;
    const int p = drawn.border.panel;
    const std::string problem = "the outline of a piece encloses nothing or touches itself";
    if (recut_.emplace(p, CutAnew{problem, std::nullopt}).second) continue;
    sewn_.flags.push_back("panel " + pattern_.panels[static_cast<std::size_t>(p)].name + " cannot be sewn: " + problem);
  }
  if (!sound) sewn_.pieces.clear();
  return sound;
}

// Pieces of a panel whose edges are far from alike where they are sewn to each other: the panel is cut anew.
bool Sewing::all_meet() {
  std::map<std::pair<int, int>, std::pair<double, double>> plies;
  for (std::size_t s = 0; s < sewn_.seams.size(); ++s) {
    const int a = sewn_.pattern.seams[s].a.panel.value, b = sewn_.pattern.seams[s].b.panel.value;
    if (sewn_.pieces[static_cast<std::size_t>(a)].panel != sewn_.pieces[static_cast<std::size_t>(b)].panel) continue;
    auto& [first, second] = plies[std::minmax(a, b)];
    first += a <= b ? sewn_.seams[s].length_a : sewn_.seams[s].length_b;
    second += a <= b ? sewn_.seams[s].length_b : sewn_.seams[s].length_a;
  }
  bool meet = true;
  for (const auto& [pieces, lengths] : plies) {
    const int p = sewn_.pieces[static_cast<std::size_t>(pieces.first)].panel;
    const auto [shorter, longer] = std::minmax(lengths.first, lengths.second);
    if (longer - shorter <= std::max(kMostEased * longer, kMostEasedLength)) continue;
    if (pattern_.panels[static_cast<std::size_t>(p)].locked) continue;
    if (recut_.emplace(p, CutAnew{"the edges of its pieces do not meet", std::nullopt}).second) meet = false;
  }
  if (!meet) sewn_.pieces.clear();
  return meet;
}

void Sewing::start_pattern() {
  sewn_.pattern.name = pattern_.name;
  sewn_.pattern.fabric = pattern_.fabric;
  sewn_.pattern.seam_allowance = pattern_.seam_allowance;
  sewn_.pattern.symmetry = pattern_.symmetry;
  sewn_.pattern.symmetry_plane = pattern_.symmetry_plane;
}

// Kept cloth has its panel's name, numbered where there are several pieces of it.
std::string Sewing::name_of(std::size_t i) const {
  const SewnPiece& piece = sewn_.pieces[i];
  const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(piece.panel)];
  if (piece.insertion >= 0) return panel.insertions[static_cast<std::size_t>(piece.insertion)].name;
  int before = 0, all = 0;
  for (std::size_t k = 0; k < sewn_.pieces.size(); ++k)
    if (sewn_.pieces[k].panel == piece.panel && sewn_.pieces[k].insertion < 0) {
      ++all;
      if (k < i) ++before;
    }
  return all == 1 ? panel.panel : panel.panel + "_part_" + std::to_string(before + 1);
}

void Sewing::add_piece(std::size_t i) {
  const DrawnPiece& drawn = drawn_[i];
  const Panel& original = pattern_.panels[static_cast<std::size_t>(drawn.border.panel)];
  Panel panel;
  panel.name = name_of(i);
  panel.label = original.label;
  panel.quantity = original.quantity;
  panel.material = original.material;
  const std::size_t count = drawn.chains.size();
  for (std::size_t k = 0; k < count; ++k) {
    PanelEdge edge = edge_of(i, k);
    edge.curve = drawn.edges.curves[k];
    const Vec2 &from = drawn.edges.corners[k], &to = drawn.edges.corners[(k + 1) % count];
    if (drawn.reversed) edge.curve = toile::reversed({from, to, edge.curve}).shape;
    panel.corners.push_back(drawn.reversed ? to : from);
    panel.edges.push_back(std::move(edge));
  }
  if (drawn.reversed) {
    std::reverse(panel.corners.begin(), panel.corners.end());
    std::reverse(panel.edges.begin(), panel.edges.end());
  }
  place(i, panel);
  carry_details(original, i, panel);
  sewn_.pattern.panels.push_back(std::move(panel));
}

// What the edge is for comes from the line it lies on; the cloth beyond it from the original cloth.
PanelEdge Sewing::edge_of(std::size_t i, std::size_t k) const {
  const BorderChain& chain = *drawn_[i].chains[k];
  const Panel& original = pattern_.panels[static_cast<std::size_t>(drawn_[i].border.panel)];
  PanelEdge edge;
  const int same_curve = drawn_[i].edges.of_edge[k];
  if (chain.along.neighbour >= 0) {  // an unpicked seam keeps its allowance
    if (same_curve >= 0) edge.seam_allowance = original.edges[static_cast<std::size_t>(same_curve)].seam_allowance;
    return edge;
  }
  if (chain.along.track.edge < 0) return edge;
  edge = original.edges[static_cast<std::size_t>(chain.along.track.edge)];
  edge.curve = {};
  if (drawn_[i].insertion >= 0) return edge;
  for (const AlteredRegion& region : alteration_.panels[static_cast<std::size_t>(drawn_[i].border.panel)].insertions) {
    if (region.operation < 0) continue;
    const TicketOperation& operation = alteration_.ticket.operations[static_cast<std::size_t>(region.operation)];
    if (operation.fabric != FabricNeed::WithinAllowance) continue;
    for (const TicketSide& side : operation.sides)
      if (side.panel == original.name &&
          std::find(side.edges.begin(), side.edges.end(), chain.along.track.edge) != side.edges.end())
        (edge.hem ? edge.hem : edge.seam_allowance) = std::max(0.0, operation.allowance.left);
  }
  return edge;
}

// Label, grainline, keep-out regions.
void Sewing::carry_details(const Panel& from, std::size_t i, Panel& to) const {
  const std::string known = from.piece_label.empty() ? from.name : from.piece_label;
  to.piece_label = to.name == from.name ? from.piece_label : to.name;
  if (drawn_[i].insertion >= 0) to.piece_label = known + " insertion " + std::to_string(drawn_[i].insertion + 1);
  to.locked = from.locked;
  std::vector<Vec2> outline = flatten_outline(to, 1e-3);
  if (from.grainline) {
    const Vec2 along = ((*from.grainline)[1] - (*from.grainline)[0]).normalized();
    if (inside_polygon(outline, (*from.grainline)[0]) && inside_polygon(outline, (*from.grainline)[1])) {
      to.grainline = from.grainline;
    } else {
      const InnerPoint roomiest = roomiest_point(outline);
      const auto [back, ahead] = chord_through(outline, roomiest.at, along);
      const double half = std::max(1e-3, 0.35 * (ahead - back));
      const Vec2 middle = roomiest.at + 0.5 * (back + ahead) * along;
      to.grainline = {{middle - half * along, middle + half * along}};
    }
  }
  if (drawn_[i].insertion >= 0 || sewn_.pieces[i].recut) return;
  for (const KeepOut& keep : from.keep_outs) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : keep.polygon) middle += p / static_cast<double>(keep.polygon.size());
    if (inside_polygon(outline, middle)) to.keep_outs.push_back(keep);
  }
}

// Where the panel stood, turned and moved as the piece lies in the wanted panel.
void Sewing::place(std::size_t i, Panel& panel) const {
  const Panel& original = pattern_.panels[static_cast<std::size_t>(drawn_[i].border.panel)];
  const PieceMap& map = sewn_.pieces[i].map;
  const Vec2 rest = map.rest.colwise().mean(), target = map.target.colwise().mean();
  const Mat2 moment = (map.target.rowwise() - target.transpose()).transpose() * (map.rest.rowwise() - rest.transpose());
  const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment.trace());
  const Mat2 turned = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Vec2 shift = target - turned * rest;
  panel.rotation = original.rotation;
  panel.rotation.leftCols<2>() = original.rotation.leftCols<2>() * turned;
  panel.translation = original.translation + original.rotation.leftCols<2>() * shift;
}

double Sewing::length_of(const SeamSide& side) const {
  const auto i = static_cast<std::size_t>(side.panel.value);
  return drawn_[i].edges.lengths[static_cast<std::size_t>(edge_number(i, static_cast<std::size_t>(side.edge)))];
}

void Sewing::sew(const SeamSide& a, const SeamSide& b, bool right_wrong, bool added) {
  sewn_.pattern.seams.push_back({a, b, right_wrong});
  sewn_.seams.push_back({added, length_of(a), length_of(b)});
}

std::vector<SeamSide> Sewing::edges_along(const SeamLine& line) const {
  const auto found = corners_.find(line);
  if (found == corners_.end() || found->second.size() < 2) return {};
  const std::vector<double>& corners = found->second;
  std::vector<SeamSide> edges(corners.size() - 1, SeamSide{PanelId(-1), 0});
  for (std::size_t i = 0; i < drawn_.size(); ++i)
    for (std::size_t k = 0; k < drawn_[i].chains.size(); ++k) {
      const RegionBorder& along = drawn_[i].chains[k]->along;
      if (along.neighbour >= 0 || SeamLine{drawn_[i].border.panel, along.track} != line) continue;
      const double middle = 0.5 * (along.at_from + along.at_to);
      const auto above = std::upper_bound(corners.begin(), corners.end(), middle);
      if (above == corners.begin() || above == corners.end()) continue;
      edges[static_cast<std::size_t>(above - corners.begin()) - 1] = {PanelId(static_cast<int>(i)), edge_number(i, k)};
    }
  return edges;
}

void Sewing::sew_line(const SeamLine& a, const SeamLine& b, bool against, bool added) {
  const std::vector<SeamSide> of_a = edges_along(a), of_b = edges_along(b);
  if (of_a.size() != of_b.size()) {
    sewn_.flags.push_back("a seam of panel " + pattern_.panels[static_cast<std::size_t>(a.panel)].name +
                          " stays open: its plies do not meet");
    return;
  }
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    const SeamSide &first = of_a[k], &second = of_b[against ? of_b.size() - 1 - k : k];
    if (first.panel.valid() && second.panel.valid()) sew(first, second, !against && !added, added);
  }
}

std::vector<SeamLine> Sewing::cuts() const {
  std::vector<SeamLine> lines;
  for (const auto& [line, corners] : corners_)
    if (line.track.cut >= 0 && line.track.left) lines.push_back(line);
  return lines;
}

void Sewing::sew_lines() {
  for (const Seam& seam : pattern_.seams)
    sew_line({seam.a.panel.value, {seam.a.edge, -1, false}}, {seam.b.panel.value, {seam.b.edge, -1, false}},
             !seam.right_wrong, false);
  for (const SeamLine& left : cuts()) sew_line(left, {left.panel, {-1, left.track.cut, false}}, false, true);
}

void Sewing::sew_neighbours() {
  std::map<std::array<int, 4>, SeamSide> open;  // panel, part, from, to
  for (std::size_t i = 0; i < drawn_.size(); ++i)
    for (std::size_t k = 0; k < drawn_[i].chains.size(); ++k) {
      const RegionBorder& along = drawn_[i].chains[k]->along;
      if (along.neighbour < 0) continue;
      const SeamSide side{PanelId(static_cast<int>(i)), edge_number(i, k)};
      const auto across = open.find({drawn_[i].border.panel, along.neighbour, along.to, along.from});
      if (across == open.end())
        open[{drawn_[i].border.panel, drawn_[i].border.part, along.from, along.to}] = side;
      else
        sew(across->second, side, false, true);
    }
}

// Old notches where their place on the seam is now; one in the middle of every new seam.
void Sewing::add_notches() {
  for (int p = 0; p < static_cast<int>(pattern_.panels.size()); ++p)
    for (const Notch& notch : pattern_.panels[static_cast<std::size_t>(p)].notches) {
      const SeamLine line{p, {notch.edge, -1, false}};
      const auto& vertices = mesh_.edge_vertices[static_cast<std::size_t>(p)][static_cast<std::size_t>(notch.edge)];
      const double at = notch.at * (static_cast<double>(vertices.size()) - 1.0);
      const std::vector<SeamSide> edges = edges_along(line);
      for (std::size_t k = 0; k < edges.size(); ++k) {
        const double from = corners_.at(line)[k], to = corners_.at(line)[k + 1];
        if (at < from || at > to || !edges[k].panel.valid() || (at == to && k + 1 < edges.size())) continue;
        sewn_.pattern.panel(edges[k].panel).notches.push_back({edges[k].edge, (at - from) / (to - from), notch.type});
      }
    }
  for (std::size_t s = 0; s < sewn_.seams.size(); ++s)
    if (sewn_.seams[s].added && std::min(sewn_.seams[s].length_a, sewn_.seams[s].length_b) > kNotchedSeam)
      for (const SeamSide& side : {sewn_.pattern.seams[s].a, sewn_.pattern.seams[s].b})
        sewn_.pattern.panel(side.panel).notches.push_back({side.edge, 0.5, NotchType::V});
}

void Sewing::add_pins() {
  for (const SeamSide& pin : pattern_.pins)
    for (const SeamSide& side : edges_along({pin.panel.value, {pin.edge, -1, false}}))
      if (side.panel.valid()) sewn_.pattern.pins.push_back(side);
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
                        const TornPattern& inserting, const TornPattern& removing, const AlterPatternResult& result,
                        RecutPanels& recut) {
  return Sewing(pattern, mesh, target_rest, inserting, removing, result, recut).run();
}

}  // namespace toile
