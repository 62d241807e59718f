// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/drape_altered.h"

#include "engine/geometry/flat_locator.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/mesh_panels.h"

namespace toile {
namespace {

// One panel of a pattern mesh.
struct FlatPanel {
  int first_triangle;
  Triangles triangles;  // into the whole mesh
  FlatLocator locator;

  FlatPanel(const PatternMesh& mesh, int panel)
      : first_triangle(range(mesh, panel).triangle_begin),
        triangles(mesh.triangles.middleRows(first_triangle, range(mesh, panel).triangle_end - first_triangle)),
        locator(mesh.rest, triangles) {}
  static const PanelRange& range(const PatternMesh& mesh, int panel) {
    return mesh.panels[static_cast<std::size_t>(panel)];
  }
};

// Where the cloth of the sewn pieces is in the scene's patterns.
class ClothPlaces {
 public:
  ClothPlaces(const AlterationScene& scene, const SewnPattern& sewn)
      : sewn_(sewn), reference_fit_(scene.reference_fit) {
    for (int p = 0; p < static_cast<int>(scene.original.panels.size()); ++p) {
      original_.emplace_back(scene.original, p);
      target_.emplace_back(scene.target, p);
    }
    for (const SewnPiece& piece : sewn.pieces) flat_.emplace_back(piece.map.rest, piece.map.triangles);
    nodes_.resize(scene.target.vertex_count(), 3);
    for (int v = 0; v < scene.target.vertex_count(); ++v)
      nodes_.row(v) = scene.start.nodes.row(scene.target.node_of_vertex[static_cast<std::size_t>(v)]);
  }

  Drape start(const PatternMesh& mesh) const {
    Drape drape{Points3::Zero(mesh.node_count, 3)};
    std::vector<int> count(static_cast<std::size_t>(mesh.node_count), 0);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const int piece = mesh.panel_of_vertex[static_cast<std::size_t>(v)];
      const int node = mesh.node_of_vertex[static_cast<std::size_t>(v)];
      const FlatPanel& panel = target_panel(piece);
      const FlatPlace place = panel.locator.closest(in_target(piece, mesh.rest.row(v)));
      drape.nodes.row(node) += place.of(nodes_, panel.triangles);
      ++count[static_cast<std::size_t>(node)];
    }
    for (int n = 0; n < mesh.node_count; ++n) drape.nodes.row(n) /= count[static_cast<std::size_t>(n)];
    return drape;
  }

  // The reference fit of every triangle's cloth.
  FittingMap wanted(const PatternMesh& mesh, const FittingMap& fit) const {
    FittingMap map = fit;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
      const int piece = mesh.panel_of_triangle[static_cast<std::size_t>(f)];
      Vec2 middle = Vec2::Zero();
      for (int k = 0; k < 3; ++k) middle += mesh.rest.row(mesh.triangles(f, k)).transpose() / 3.0;
      const int from = reference_triangle(piece, middle);
      const auto to = static_cast<std::size_t>(f), source = static_cast<std::size_t>(from);
      map.tensor[to] = reference_fit_.tensor[source];
      map.degenerate[to] = reference_fit_.degenerate[source];
      map.stretch_weft[f] = reference_fit_.stretch_weft[from];
      map.stretch_warp[f] = reference_fit_.stretch_warp[from];
      map.shear[f] = reference_fit_.shear[from];
    }
    return map;
  }

 private:
  const SewnPiece& piece_of(int piece) const { return sewn_.pieces[static_cast<std::size_t>(piece)]; }
  const FlatPanel& target_panel(int piece) const { return target_[static_cast<std::size_t>(piece_of(piece).panel)]; }
  Vec2 in_target(int piece, const Vec2& rest) const {
    const PieceMap& map = piece_of(piece).map;
    return flat_[static_cast<std::size_t>(piece)].closest(rest).of(map.target, map.triangles).transpose();
  }
  int reference_triangle(int piece, const Vec2& rest) const {
    const bool own_cloth = piece_of(piece).insertion < 0 && !piece_of(piece).recut;
    const FlatPanel& panel =
        own_cloth ? original_[static_cast<std::size_t>(piece_of(piece).panel)] : target_panel(piece);
    return panel.first_triangle + panel.locator.closest(own_cloth ? rest : in_target(piece, rest)).triangle;
  }

  const SewnPattern& sewn_;
  const FittingMap& reference_fit_;
  std::vector<FlatPanel> original_, target_;
  std::vector<FlatLocator> flat_;  // per piece
  Points3 nodes_;                  // of the target pattern's vertices
};

}  // namespace

SewnPattern uncut(const Pattern& pattern, const PatternMesh& mesh) {
  SewnPattern sewn;
  sewn.pattern = pattern;
  for (std::size_t p = 0; p < mesh.panels.size(); ++p) {
    const PanelRange& range = mesh.panels[p];
    SewnPiece piece;
    piece.panel = static_cast<int>(p);
    piece.map.rest = mesh.rest.middleRows(range.vertex_begin, range.vertex_end - range.vertex_begin);
    piece.map.target = piece.map.rest;
    piece.map.triangles =
        mesh.triangles.middleRows(range.triangle_begin, range.triangle_end - range.triangle_begin).array() -
        range.vertex_begin;
    sewn.pieces.push_back(std::move(piece));
  }
  return sewn;
}

TriedOn try_on(const AlterationScene& scene, const SewnPattern& sewn, double edge_length, DrapeSeries& on_target,
               const DrapeOptions& options, Progress* progress) {
  TriedOn worn;
  if (sewn.pieces.empty()) {
    worn.problem = sewn.flags.empty() ? "there is no sewn pattern" : sewn.flags.front();
    return worn;
  }
  try {  // an alteration that cannot be sewn or worn is a finding, not a failure of the job
    validate_pattern(sewn.pattern);
    MeshPanelsOptions mesh_options;
    mesh_options.edge_length = edge_length;
    worn.mesh = mesh_panels(sewn.pattern, mesh_options, progress);
    const Drape start = ClothPlaces(scene, sewn).start(worn.mesh);
    worn.drape = on_target.drape_from(sewn.pattern, worn.mesh, start, options, progress);
    worn.position = compare_positions(start.nodes, worn.drape.drape.nodes);
  } catch (const Error& error) {
    if (error.code != ErrorCode::GarmentInvalid && error.code != ErrorCode::SeamInvalid &&
        error.code != ErrorCode::LimitExceeded && error.code != ErrorCode::DrapeFailed)
      throw;
    worn = {};
    worn.problem = error.what();
  }
  return worn;
}

DrapedAlteration drape_altered(const AlterationScene& scene, const SewnPattern& sewn, TriedOn worn,
                               DrapeSeries& on_target, const DrapeOptions& options, Progress* progress) {
  if (worn.mesh.triangle_count() == 0)
    worn = try_on(scene, sewn, scene.original.target_edge_length, on_target, options, progress);
  DrapedAlteration result;
  result.problem = std::move(worn.problem);
  if (!result.problem.empty()) return result;
  result.mesh = std::move(worn.mesh);
  result.drape = std::move(worn.drape);
  result.fit = build_fitting_map(result.mesh, result.drape.drape);
  const ClothPlaces places(scene, sewn);
  result.reference = places.wanted(result.mesh, result.fit);
  result.position = compare_positions(places.start(result.mesh).nodes, result.drape.drape.nodes);
  return result;
}

}  // namespace toile
