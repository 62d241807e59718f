// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/fine_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/convex_hull.h"
#include "engine/geometry/flat_locator.h"
#include "engine/stage_options.h"
#include "engine/stages/arrange_panels.h"
#include "engine/stages/carry_drape.h"
#include "tests/bench/bench.h"
#include "tests/bench/split_mesh.h"

namespace toile::bench {
namespace {

Triangles panel_triangles(const PatternMesh& mesh, std::size_t panel) {
  const PanelRange& range = mesh.panels[panel];
  return mesh.triangles.middleRows(range.triangle_begin, range.triangle_end - range.triangle_begin);
}

Points3 at_vertices(const PatternMesh& mesh, const Drape& drape) {
  Points3 all(mesh.vertex_count(), 3);
  for (int v = 0; v < mesh.vertex_count(); ++v)
    all.row(v) = drape.nodes.row(mesh.node_of_vertex[static_cast<std::size_t>(v)]);
  return all;
}

constexpr int kSamplesAcross = 4;  // along each side of a coarse triangle

// Mean stretch of the fine cloth over each coarse triangle, #F.
struct MeanStretch {
  Eigen::VectorXd weft, warp;
};

MeanStretch mean_stretch(const PatternMesh& fine, const FittingMap& fit, const PatternMesh& coarse) {
  MeanStretch mean{Eigen::VectorXd::Zero(coarse.triangle_count()), Eigen::VectorXd::Zero(coarse.triangle_count())};
  for (std::size_t p = 0; p < coarse.panels.size(); ++p) {
    const FlatLocator locator(fine.rest, panel_triangles(fine, p));
    for (int f = coarse.panels[p].triangle_begin; f < coarse.panels[p].triangle_end; ++f) {
      const Vec2 a = coarse.rest.row(coarse.triangles(f, 0)), b = coarse.rest.row(coarse.triangles(f, 1)),
                 c = coarse.rest.row(coarse.triangles(f, 2));
      for (int k = 0; k < kSamplesAcross * kSamplesAcross; ++k) {  // the middles of as many small triangles
        const int row = static_cast<int>(std::sqrt(k)), column = k - row * row;
        const double t = (row + (column % 2 ? 1.0 : 2.0) / 3) / kSamplesAcross,
                     s = (column / 2 + (column % 2 ? 2.0 : 1.0) / 3) / kSamplesAcross;
        const Vec2 at = a + (t - s) * (b - a) + s * (c - a);
        const int there = fine.panels[p].triangle_begin + locator.closest(at).triangle;
        mean.weft[f] += fit.stretch_weft[there] / (kSamplesAcross * kSamplesAcross);
        mean.warp[f] += fit.stretch_warp[there] / (kSamplesAcross * kSamplesAcross);
      }
    }
  }
  return mean;
}

double rms_between(const MeanStretch& mean, const FittingMap& fit) {
  const Eigen::ArrayXd squares =
      0.5 * ((fit.stretch_weft - mean.weft).array().square() + (fit.stretch_warp - mean.warp).array().square());
  return std::sqrt(fit.rest_area.dot(squares.matrix()) / fit.rest_area.sum());
}

// Each triangle's own, instead of that recovered from its neighbours'.
FittingMap not_recovered(FittingMap fit) {
  for (int f = 0; f < fit.triangle_count(); ++f) {
    const Mat2& tensor = fit.tensor[static_cast<std::size_t>(f)];
    fit.stretch_weft[f] = tensor(0, 0) - 1.0;
    fit.stretch_warp[f] = tensor.col(1).norm() - 1.0;
  }
  return fit;
}

// Root mean square distance after the turn and shift that make it least.
double rms_after_motion(const Points2& a, const Points2& b) {
  const Eigen::RowVector2d mean_a = a.colwise().mean(), mean_b = b.colwise().mean();
  const Points2 x = a.rowwise() - mean_a, y = b.rowwise() - mean_b;
  const Mat2 m = x.transpose() * y;
  const double angle = std::atan2(m(0, 1) - m(1, 0), m(0, 0) + m(1, 1));
  const Mat2 turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  return std::sqrt((x * turn.transpose() - y).rowwise().squaredNorm().mean());
}

double pattern_error(const Answer& fine, const Answer& coarse) {
  double squares = 0.0, count = 0.0;
  for (std::size_t p = 0; p < coarse.mesh.panels.size(); ++p) {
    const Triangles triangles = panel_triangles(fine.mesh, p);
    const FlatLocator locator(fine.mesh.rest, triangles);
    std::vector<int> border;
    for (const auto& edge : coarse.mesh.edge_vertices[p]) border.insert(border.end(), edge.begin(), edge.end());
    Points2 here(static_cast<Eigen::Index>(border.size()), 2), there = here;
    for (std::size_t i = 0; i < border.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      here.row(row) = coarse.target_rest.row(border[i]);
      there.row(row) = locator.closest(coarse.mesh.rest.row(border[i])).of(fine.target_rest, triangles);
    }
    const double rms = rms_after_motion(here, there);
    squares += rms * rms * static_cast<double>(border.size());
    count += static_cast<double>(border.size());
  }
  return std::sqrt(squares / count);
}

double position_error(const Answer& fine, const Answer& coarse) {
  const Points3 there = at_vertices(fine.mesh, fine.reference_drape),
                here = at_vertices(coarse.mesh, coarse.reference_drape);
  double squares = 0.0;
  for (std::size_t p = 0; p < coarse.mesh.panels.size(); ++p) {
    const Triangles triangles = panel_triangles(fine.mesh, p);
    const FlatLocator locator(fine.mesh.rest, triangles);
    for (int v = coarse.mesh.panels[p].vertex_begin; v < coarse.mesh.panels[p].vertex_end; ++v)
      squares += (locator.closest(coarse.mesh.rest.row(v)).of(there, triangles) - here.row(v)).squaredNorm();
  }
  return std::sqrt(squares / coarse.mesh.vertex_count());
}

}  // namespace

SceneBodies read_scene(const test::Scene& scene) {
  SceneBodies bodies{read_garment(scene.garment), read_body(scene.reference), read_body(scene.target), {}};
  bodies.map = register_bodies(bodies.reference, bodies.target).map;
  return bodies;
}

namespace {

DrapeOptions drape_options(const Accuracy& accuracy) {
  AlterOptions options;
  options.solver = accuracy.solver;
  DrapeOptions drape = drape_options_of(options);
  drape.stop_residual = accuracy.stop_residual;
  drape.stop_settled = accuracy.stop_settled;
  drape.coarse_triangles = accuracy.coarse_triangles;
  drape.newton_residual = std::min(1e-3, 0.01 * accuracy.stop_residual);
  return drape;
}

// Of the target pattern, from the reference drape.
void derive(const SceneBodies& scene, const DrapeOptions& options, Answer& result) {
  AlterOptions usual;
  usual.preset = Preset::Fine;
  if (options.stop_residual > drape_options_of(usual).stop_residual) usual.preset = Preset::Standard;
  result.hem_girth = hem_girth(scene.pattern, result.mesh, result.reference_drape);
  const FittingMap fit = build_fitting_map(result.mesh, result.reference_drape);
  const Drape carried =
      transport_garment(result.mesh, result.reference_drape, scene.reference, scene.target, scene.map).drape;
  const auto plane = mirror_plane_of(usual, scene.pattern);
  const auto mirrors =
      plane ? find_garment_mirrors(scene.pattern, result.mesh, result.reference_drape, *plane) : GarmentMirrors{};
  DrapeSeries on_target(scene.target);
  const DerivedPattern derived = derive_in_loop(scene.pattern, result.mesh, fit, on_target, carried, mirrors,
                                                derive_options_of(usual), options, loop_options_of(usual));
  result.target_drape = derived.drape.drape;
  result.target_rest = derived.mesh.rest;
}

}  // namespace

Answer answer(const SceneBodies& scene, const Accuracy& accuracy) {
  const DrapeOptions options = drape_options(accuracy);
  Answer result;
  const double start = cpu_seconds();
  result.mesh = mesh_panels(scene.pattern, {.triangles = accuracy.triangles});
  const DrapeResult worn = drape_to_hold(scene.pattern, result.mesh, scene.reference, options, result.held, nullptr);
  result.reference_drape = worn.drape;
  result.residual = worn.quality.residual;
  derive(scene, options, result);
  result.cpu_s = cpu_seconds() - start;
  return result;
}

Answer refined(const SceneBodies& scene, const Answer& coarse, const Accuracy& accuracy) {
  DrapeOptions options = drape_options(accuracy);
  Answer result;
  const double start = cpu_seconds();
  result.mesh = split_mesh(coarse.mesh);
  const DrapeEnd carried = carry_drape(scene.pattern, coarse.mesh, {coarse.reference_drape, coarse.held}, result.mesh);
  result.held = carried.held;
  const DrapeResult worn =
      drape_held(scene.pattern, result.mesh, scene.reference, carried.drape, carried.held, options, nullptr);
  result.reference_drape = worn.drape;
  result.residual = worn.quality.residual;
  derive(scene, options, result);
  result.cpu_s = cpu_seconds() - start;
  return result;
}

double hem_girth(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape) {
  double lowest = std::numeric_limits<double>::infinity(), girth = 0;
  for (const std::vector<int>& line : free_lines(pattern, mesh)) {
    std::vector<Vec2> flat;
    double height = 0;
    for (const int n : line) {
      flat.emplace_back(drape.nodes(n, 0), drape.nodes(n, 2));
      height += drape.nodes(n, 1) / static_cast<double>(line.size());
    }
    if (height < lowest) lowest = height, girth = hull_perimeter(flat);
  }
  return girth;
}

AnswerError compare(const Answer& fine, const Answer& coarse) {
  AnswerError error;
  const MeanStretch mean = mean_stretch(fine.mesh, build_fitting_map(fine.mesh, fine.reference_drape), coarse.mesh);
  const FittingMap fit = build_fitting_map(coarse.mesh, coarse.reference_drape);
  error.stretch = rms_between(mean, fit);
  error.triangle_stretch = rms_between(mean, not_recovered(fit));
  error.position = position_error(fine, coarse);
  error.pattern = pattern_error(fine, coarse);
  error.hem = std::abs(fine.reference_drape.nodes.col(1).minCoeff() - coarse.reference_drape.nodes.col(1).minCoeff());
  error.girth = std::abs(fine.hem_girth - coarse.hem_girth);
  return error;
}

}  // namespace toile::bench
