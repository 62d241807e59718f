// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "engine/bodies/make_builtin_body.h"
#include "engine/core/text.h"
#include "engine/io/mesh_file.h"
#include "tests/stress/job_scene.h"
#include "tests/stress/patchwork.h"
#include "tests/support/random_people.h"
#include "tests/support/shared_data.h"
#include "tests/support/shipped_examples.h"

namespace toile::stress {
namespace {

FormShape random_form(test::Dice& dice, bool wild) {
  FormShape form;
  form.height = wild ? dice.between(0.55, 2.4) : dice.between(0.9, 1.3);
  form.radius = wild ? dice.by_decades(0.02, 0.6) : dice.between(0.11, 0.19);
  form.bulge = wild ? dice.between(-0.6, 1.2) : dice.between(-0.15, 0.2);
  form.bulge_at = dice.between(0.3, 0.7);
  form.depth = wild ? dice.between(0.3, 2.0) : dice.between(0.75, 1.1);
  return form;
}

FormShape changed(test::Dice& dice, FormShape form, bool wild) {
  form.radius *= wild ? dice.by_decades(0.5, 2.0) : dice.between(0.88, 1.18);
  form.height *= wild ? dice.between(0.8, 1.25) : dice.between(0.97, 1.04);
  form.bulge += wild ? dice.between(-0.3, 0.5) : dice.between(-0.08, 0.1);
  return form;
}

Patchwork random_patchwork(test::Dice& dice, const FormShape& form, bool wild, double ease) {
  Patchwork p;
  p.columns = wild && dice.chance(0.2) ? 12 : dice.whole(2, wild ? 8 : 5);
  p.rows = wild && dice.chance(0.2) ? 5 : dice.whole(1, 2);
  p.girth = ease * girth(form) * (1.0 + 0.5 * std::max(0.0, form.bulge));
  p.height = form.height * dice.between(0.25, 0.5);
  p.bottom = form.height * dice.between(0.15, 0.4);
  p.distance = 1.1 * form.radius * (1.0 + std::max(0.0, form.bulge)) * std::max(1.0, form.depth) + 0.02;
  p.fabric = random_fabric(dice, wild);
  if (!wild) return p;
  if (dice.chance(0.3)) p.shear = dice.between(-0.6, 0.6);
  if (dice.chance(0.25)) p.sliver = dice.by_decades(0.001, 0.02);
  if (dice.chance(0.2)) p.godet = dice.by_decades(0.002, 0.2);
  if (dice.chance(0.25)) p.short_seam = dice.by_decades(0.0005, 0.01);
  p.doubled_points = dice.chance(0.15);
  if (dice.chance(0.2)) p.gather = dice.between(0.6, 1.6);
  return p;
}

// Points and lengths of a pattern times a matrix of its plane. Arcs are left to even scaling.
bool has_arcs(const Pattern& pattern) {
  for (const Panel& panel : pattern.panels)
    for (const PanelEdge& edge : panel.edges)
      if (edge.curve.kind == CurveKind::Arc) return true;
  return false;
}

void deform(Pattern& pattern, Mat2 by) {
  if (has_arcs(pattern)) by = Mat2::Identity() * std::sqrt(std::abs(by.determinant()));
  for (Panel& panel : pattern.panels) {
    for (Vec2& corner : panel.corners) corner = by * corner;
    for (PanelEdge& edge : panel.edges) {
      for (Vec2& control : edge.curve.control) control = by * control;
      for (Vec2& point : edge.curve.points) point = by * point;
      edge.curve.radius *= by(0, 0);
    }
    panel.grainline.reset();
    panel.keep_outs.clear();
  }
}

BodyInput measured_person(const test::RandomPerson& person) {
  std::string text = R"({"figure": ")";
  text += person.figure == Figure::Woman ? "woman" : person.figure == Figure::Man ? "man" : "child";
  text += R"(", "measurements_m": {)";
  bool first = true;
  for (const auto& [name, value] : person.asked) {
    text += print_text("%s\"%s\": %.6f", first ? "" : ", ", name.c_str(), value);
    first = false;
  }
  text += "}}";
  return {.name = "person.json", .bytes = Bytes(text.begin(), text.end())};
}

// Weights that add up to one, also below zero: people nobody is.
BodyInput extrapolated_person(test::Dice& dice) {
  Points3 vertices;
  Triangles triangles;
  double left = 1.0;
  const auto& names = test::kFiveMannequins;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double weight = i + 1 == names.size() ? left : dice.between(-0.4, 0.7);
    left -= weight;
    const Body body = make_builtin_body(names[i]);
    if (i == 0) vertices = Points3::Zero(body.surface.vertex_count(), 3), triangles = body.surface.triangles;
    vertices += weight * body.surface.vertices;
  }
  for (int axis = 0; axis < 3; ++axis) vertices.col(axis) *= dice.between(0.8, 1.25);
  return {.name = "extrapolated.obj", .bytes = write_obj({vertices, triangles})};
}

test::RandomPerson person_like(test::Dice& dice, const std::string& wearer) {
  const Figure wanted = wearer.starts_with("woman")   ? Figure::Woman
                        : wearer.starts_with("child") ? Figure::Child
                                                      : Figure::Man;
  for (int number = dice.whole(0, 100000);; ++number)
    if (const test::RandomPerson person = test::random_person(number); person.figure == wanted) return person;
}

}  // namespace

BodyInput form_input(const TriangleMesh& surface, double metre_per_unit) {
  TriangleMesh in_file = surface;
  in_file.vertices /= metre_per_unit;
  BodyInput input{.name = "form.obj", .bytes = write_obj(in_file)};
  input.import.kind = BodyKind::Form;
  return input;
}

JobScene patchwork_scene(test::Dice& dice, Outcome& outcome) {
  const bool wild = !dice.chance(0.4);
  outcome.human_range = !wild;
  const FormShape reference = random_form(dice, wild), target = changed(dice, reference, wild);
  const double ease = wild ? dice.by_decades(0.5, 2.0) : dice.between(0.92, 1.2);
  const Patchwork p = random_patchwork(dice, reference, wild, ease);
  outcome.what = print_text(
      "form r %.3f h %.2f bulge %.2f depth %.2f, to r %.3f bulge %.2f; %d x %d panels, ease %.2f, shear %.2f, sliver "
      "%.4f, godet %.4f, short seam %.4f, gather %.2f%s; fabric %.3g %.3g %.3g %.3g %.3g",
      reference.radius, reference.height, reference.bulge, reference.depth, target.radius, target.bulge, p.columns,
      p.rows, ease, p.shear, p.sliver, p.godet, p.short_seam, p.gather, p.doubled_points ? ", doubled points" : "",
      p.fabric.weft_stiffness, p.fabric.warp_stiffness, p.fabric.shear_stiffness, p.fabric.bending_stiffness,
      p.fabric.density);
  JobScene scene;
  scene.pattern = make_pattern(p);
  const double unit = wild && dice.chance(0.3) ? 0.001 : 1.0;
  scene.reference = form_input(make_body(reference).surface, unit);
  scene.target = form_input(make_body(target).surface, unit);
  scene.options.triangles = dice.whole(500, 800);
  scene.options.max_tears_per_side = dice.whole(0, 2);
  scene.tight = !wild && ease < 1.0;
  scene.shiftable = unit == 1.0;
  return scene;
}

JobScene person_scene(test::Dice& dice, Outcome& outcome) {
  const bool wild = dice.chance(0.5);
  const auto& example = test::kShippedExamples[static_cast<std::size_t>(dice.whole(0, 4))];
  JobScene scene;
  const std::string file = std::string(example.name) + ".json";
  scene.pattern = read_garment({file, test::read_file(test::shipped_example_folder() + file)});
  scene.reference = {.name = std::string("builtin:") + example.wearer, .bytes = {}};
  scene.options.triangles = dice.whole(600, 1000);
  outcome.human_range = !wild;
  outcome.what = example.name;
  if (!wild) {
    scene.target = measured_person(person_like(dice, example.wearer));
    scene.pattern.fabric = random_fabric(dice, false);
    return scene;
  }
  Mat2 by = Mat2::Identity() * dice.between(0.6, 1.6);
  by(1, 1) *= dice.between(0.8, 1.25), by(0, 1) = dice.between(-0.2, 0.2);
  deform(scene.pattern, by);
  scene.pattern.fabric = random_fabric(dice, true);
  scene.target =
      dice.chance(0.5) ? extrapolated_person(dice) : measured_person(test::random_person(dice.whole(0, 100000)));
  outcome.what +=
      print_text(" scaled %.2f x %.2f, sheared %.2f, on %s", by(0, 0), by(1, 1), by(0, 1), scene.target.name.c_str());
  return scene;
}

}  // namespace toile::stress
