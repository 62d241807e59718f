// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/bodies/import_body.h"
#include "engine/bodies/make_builtin_body.h"
#include "engine/core/text.h"
#include "engine/io/mesh_file.h"
#include "tests/stress/part_scenes.h"
#include "tests/stress/patchwork.h"
#include "tests/support/shipped_examples.h"

namespace toile::stress {
namespace {

// Every edge is walked once either way, and the whole holds a volume.
void check_closed(const TriangleMesh& mesh, Outcome& outcome) {
  if (!mesh.vertices.allFinite()) return outcome.fail("imported body is not finite");
  std::map<std::pair<int, int>, int> walked;
  double volume = 0.0;
  for (int f = 0; f < mesh.triangle_count(); ++f) {
    for (int k = 0; k < 3; ++k) ++walked[{mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3)}];
    const Vec3 a = mesh.vertices.row(mesh.triangles(f, 0)), b = mesh.vertices.row(mesh.triangles(f, 1)),
               c = mesh.vertices.row(mesh.triangles(f, 2));
    volume += a.dot(b.cross(c)) / 6.0;
  }
  const bool closed = std::all_of(walked.begin(), walked.end(), [&](const auto& edge) {
    const auto back = walked.find({edge.first.second, edge.first.first});
    return edge.second == 1 && back != walked.end() && back->second == 1;
  });
  if (!closed) outcome.fail("imported body is not closed, or not oriented");
  if (!(volume > 0)) outcome.fail("imported body holds no volume");
}

class Damage {
 public:
  Damage(test::Dice& dice, TriangleMesh mesh, Outcome& outcome)
      : dice_(dice), mesh_(std::move(mesh)), outcome_(outcome) {}

  TriangleMesh make() {
    for (int f = 0; f < mesh_.triangle_count(); ++f)
      triangles_.push_back({mesh_.triangles(f, 0), mesh_.triangles(f, 1), mesh_.triangles(f, 2)});
    if (dice_.chance(0.3)) zero_area();
    if (dice_.chance(0.3)) invert();
    if (dice_.chance(0.3)) holes();
    if (dice_.chance(0.2)) doubled();
    if (dice_.chance(0.2)) noise();
    if (dice_.chance(0.15)) soup();
    mesh_.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      for (int k = 0; k < 3; ++k)
        mesh_.triangles(static_cast<Eigen::Index>(f), k) = triangles_[f][static_cast<std::size_t>(k)];
    return mesh_;
  }

 private:
  std::size_t any() { return static_cast<std::size_t>(dice_.whole(0, static_cast<int>(triangles_.size()) - 1)); }
  void say(const char* what, int count) { outcome_.what += print_text(", %d %s", count, what); }

  void zero_area() {
    const int count = dice_.whole(1, 50);
    for (int i = 0; i < count; ++i) {
      const auto t = triangles_[any()];
      triangles_.push_back(dice_.chance(0.5) ? std::array{t[0], t[1], t[1]} : std::array{t[0], t[0], t[0]});
    }
    say("triangles without area", count);
  }
  void invert() {
    const int count = dice_.chance(0.3) ? static_cast<int>(triangles_.size()) : dice_.whole(1, 200);
    if (count == static_cast<int>(triangles_.size()))
      for (auto& t : triangles_) std::swap(t[0], t[1]);
    else
      for (int i = 0; i < count; ++i) {
        auto& t = triangles_[any()];
        std::swap(t[0], t[1]);
      }
    say("inverted triangles", count);
  }
  void holes() {
    const int count = dice_.whole(1, 40);
    for (int i = 0; i < count; ++i) triangles_.erase(triangles_.begin() + static_cast<std::ptrdiff_t>(any()));
    say("holes", count);
  }
  void doubled() {
    const int count = dice_.whole(1, 100);
    for (int i = 0; i < count; ++i) triangles_.push_back(triangles_[any()]);
    say("doubled triangles", count);
  }
  void noise() {
    const double size = dice_.by_decades(1e-6, 0.02);
    for (Eigen::Index i = 0; i < mesh_.vertices.size(); ++i) mesh_.vertices.data()[i] += dice_.between(-size, size);
    outcome_.what += print_text(", noise %.2g m", size);
  }
  // Every triangle with vertices of its own.
  void soup() {
    Points3 vertices(static_cast<Eigen::Index>(3 * triangles_.size()), 3);
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = static_cast<int>(3 * f + k);
        vertices.row(v) = mesh_.vertices.row(triangles_[f][k]);
        triangles_[f][k] = v;
      }
    mesh_.vertices = vertices;
    outcome_.what += ", as a soup";
  }

  test::Dice& dice_;
  TriangleMesh mesh_;
  std::vector<std::array<int, 3>> triangles_;
  Outcome& outcome_;
};

}  // namespace

void run_body_scene(test::Dice& dice, Outcome& outcome) {
  const bool form = dice.chance(0.6), damaged = dice.chance(0.7);
  const char* name = test::kFiveMannequins[static_cast<std::size_t>(dice.whole(0, 4))];
  TriangleMesh mesh = form ? make_body({.height = dice.between(0.6, 2.2), .radius = dice.between(0.05, 0.3)}).surface
                           : make_builtin_body(name).surface;
  const double height = mesh.vertices.col(1).maxCoeff() - mesh.vertices.col(1).minCoeff();
  outcome.what = form ? "form" : name;
  outcome.human_range = !damaged;
  if (damaged) mesh = Damage(dice, std::move(mesh), outcome).make();
  constexpr std::array<double, 4> kUnits = {1.0, 0.01, 0.001, 0.0254};
  const double unit = kUnits[static_cast<std::size_t>(dice.whole(0, 3))];
  mesh.vertices /= unit;
  const double away = dice.chance(0.4) ? dice.by_decades(1.0, 9e4) : 0.0;  // in file units
  const double turn = dice.between(-3.14, 3.14);
  mesh.vertices.rowwise() +=
      Eigen::RowVector3d(away * std::sin(turn), form ? 0.0 : dice.between(-1, 1), away * std::cos(turn));
  outcome.what += print_text(", unit %g m, %.3g units away", unit, away);
  ImportBodyOptions options;
  options.kind = form ? BodyKind::Form : BodyKind::Human;
  const Bytes bytes = dice.chance(0.5) ? write_obj(mesh) : dice.chance(0.5) ? write_ply(mesh) : write_stl(mesh);
  const ImportBodyResult result = import_body(bytes, "body", options);
  check_closed(result.body.surface, outcome);
  const double found = result.body.surface.vertices.col(1).maxCoeff() - result.body.surface.vertices.col(1).minCoeff();
  // A unit that could be another one as well is guessed, and the guess is told.
  const bool told = !result.normalisation.warnings.empty();
  if (!damaged && !told && std::abs(found - height) > 0.01 * height + 4e-7 * away * unit)
    outcome.fail(print_text("a body of %.3f m was taken in as %.3f m", height, found));
}

}  // namespace toile::stress
