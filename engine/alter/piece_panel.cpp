// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/piece_panel.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/curve.h"
#include "engine/geometry/inner_point.h"

namespace toile {
namespace {

class PieceDrawing {
 public:
  PieceDrawing(const Pattern& pattern, const AlterPatternResult& result, const AlteredPieces& cut, std::size_t i)
      : alteration_(result),
        cut_(cut),
        number_(i),
        piece_(cut.pieces[i]),
        drawn_(cut.drawn[i]),
        original_(pattern.panels[static_cast<std::size_t>(piece_.panel)]) {}

  Panel run() const {
    Panel panel;
    panel.name = name();
    panel.label = original_.label;
    panel.quantity = original_.quantity;
    panel.material = original_.material;
    add_outline(panel);
    place(panel);
    carry_details(panel);
    return panel;
  }

 private:
  std::string name() const;
  void add_outline(Panel& panel) const;
  PanelEdge edge_of(std::size_t k) const;
  void carry_details(Panel& to) const;
  void place(Panel& panel) const;

  const AlterPatternResult& alteration_;
  const AlteredPieces& cut_;
  std::size_t number_;
  const SewnPiece& piece_;
  const DrawnPiece& drawn_;
  const Panel& original_;
};

// Kept cloth has its panel's name, numbered where there are several pieces of it.
std::string PieceDrawing::name() const {
  const PanelAlteration& panel = alteration_.panels[static_cast<std::size_t>(piece_.panel)];
  if (piece_.insertion >= 0) return panel.insertions[static_cast<std::size_t>(piece_.insertion)].name;
  int before = 0, all = 0;
  for (std::size_t k = 0; k < cut_.pieces.size(); ++k)
    if (cut_.pieces[k].panel == piece_.panel && cut_.pieces[k].insertion < 0) {
      ++all;
      if (k < number_) ++before;
    }
  return all == 1 ? panel.panel : panel.panel + "_part_" + std::to_string(before + 1);
}

void PieceDrawing::add_outline(Panel& panel) const {
  const std::size_t count = drawn_.chains.size();
  for (std::size_t k = 0; k < count; ++k) {
    PanelEdge edge = edge_of(k);
    edge.curve = drawn_.edges.curves[k];
    const Vec2 &from = drawn_.edges.corners[k], &to = drawn_.edges.corners[(k + 1) % count];
    if (drawn_.reversed) edge.curve = reversed({from, to, edge.curve}).shape;
    panel.corners.push_back(drawn_.reversed ? to : from);
    panel.edges.push_back(std::move(edge));
  }
  if (!drawn_.reversed) return;
  std::reverse(panel.corners.begin(), panel.corners.end());
  std::reverse(panel.edges.begin(), panel.edges.end());
}

// What the edge is for comes from the line it lies on; the cloth beyond it from the original cloth.
PanelEdge PieceDrawing::edge_of(std::size_t k) const {
  const BorderChain& chain = *drawn_.chains[k];
  PanelEdge edge;
  const int same_curve = drawn_.edges.of_edge[k];
  if (chain.along.neighbour >= 0) {  // an unpicked seam keeps its allowance
    if (same_curve >= 0) edge.seam_allowance = original_.edges[static_cast<std::size_t>(same_curve)].seam_allowance;
    return edge;
  }
  if (chain.along.track.edge < 0) return edge;
  edge = original_.edges[static_cast<std::size_t>(chain.along.track.edge)];
  edge.curve = {};
  if (piece_.insertion >= 0) return edge;
  for (const AlteredRegion& region : alteration_.panels[static_cast<std::size_t>(piece_.panel)].insertions) {
    if (region.operation < 0) continue;
    const TicketOperation& operation = alteration_.ticket.operations[static_cast<std::size_t>(region.operation)];
    if (operation.fabric != FabricNeed::WithinAllowance) continue;
    for (const TicketSide& side : operation.sides)
      if (side.panel == original_.name &&
          std::find(side.edges.begin(), side.edges.end(), chain.along.track.edge) != side.edges.end())
        (edge.hem ? edge.hem : edge.seam_allowance) = std::max(0.0, operation.allowance.left);
  }
  return edge;
}

// Label, grainline, keep-out regions.
void PieceDrawing::carry_details(Panel& to) const {
  const std::string known = original_.piece_label.empty() ? original_.name : original_.piece_label;
  to.piece_label = to.name == original_.name ? original_.piece_label : to.name;
  if (piece_.insertion >= 0) to.piece_label = known + " insertion " + std::to_string(piece_.insertion + 1);
  to.locked = original_.locked;
  std::vector<Vec2> outline = flatten_outline(to, 1e-3);
  if (original_.grainline) {
    const Vec2 along = ((*original_.grainline)[1] - (*original_.grainline)[0]).normalized();
    if (inside_polygon(outline, (*original_.grainline)[0]) && inside_polygon(outline, (*original_.grainline)[1])) {
      to.grainline = original_.grainline;
    } else {
      const InnerPoint roomiest = roomiest_point(outline);
      const auto [back, ahead] = chord_through(outline, roomiest.at, along);
      const double half = std::max(1e-3, 0.35 * (ahead - back));
      const Vec2 middle = roomiest.at + 0.5 * (back + ahead) * along;
      to.grainline = {{middle - half * along, middle + half * along}};
    }
  }
  if (piece_.insertion >= 0 || piece_.recut) return;
  for (const KeepOut& keep : original_.keep_outs) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : keep.polygon) middle += p / static_cast<double>(keep.polygon.size());
    if (inside_polygon(outline, middle)) to.keep_outs.push_back(keep);
  }
}

// Where the panel stood, turned and moved as the piece lies in the wanted panel.
void PieceDrawing::place(Panel& panel) const {
  const PieceMap& map = piece_.map;
  const Vec2 rest = map.rest.colwise().mean(), target = map.target.colwise().mean();
  const Mat2 moment = (map.target.rowwise() - target.transpose()).transpose() * (map.rest.rowwise() - rest.transpose());
  const double angle = std::atan2(moment(1, 0) - moment(0, 1), moment.trace());
  const Mat2 turned = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Vec2 shift = target - turned * rest;
  panel.rotation = original_.rotation;
  panel.rotation.leftCols<2>() = original_.rotation.leftCols<2>() * turned;
  panel.translation = original_.translation + original_.rotation.leftCols<2>() * shift;
}

}  // namespace

Panel panel_of_piece(const Pattern& pattern, const AlterPatternResult& result, const AlteredPieces& cut,
                     std::size_t i) {
  return PieceDrawing(pattern, result, cut, i).run();
}

}  // namespace toile
