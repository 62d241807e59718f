// SPDX-License-Identifier: GPL-3.0-or-later
// pareto [SCENE...] [--sizes N,N,...] [--residuals R,R,...] [--newton] [--fine N] [--fine-residual R]
// Run time against error of meshing, draping, transport and derivation together, over resolution x tolerance x solver;
// the error is the distance to the same scene on a fine mesh with a tight residual. Rows on the front are marked: no
// other of the scene is both cheaper and nearer in the pattern.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "tests/bench/fine_reference.h"
#include "tests/bench/plot.h"
#include "tests/bench/proof.h"
#include "tests/bench/words.h"

namespace toile::bench {
namespace {

struct Request {
  std::vector<std::string> scenes;
  std::vector<double> sizes = {1000, 2000, 4000, 10000}, residuals = {3.0, 1.0, 0.3, 0.1};
  Accuracy fine{20000, 0.05, SolverKind::Default};
  bool newton = false;
};

std::vector<double> numbers(const std::vector<std::string>& texts) {
  std::vector<double> found;
  for (const std::string& text : texts) found.push_back(std::atof(text.c_str()));
  return found;
}

Request parse(Words words) {
  Request request;
  if (const auto sizes = words.list("--sizes")) request.sizes = numbers(*sizes);
  if (const auto residuals = words.list("--residuals")) request.residuals = numbers(*residuals);
  request.fine.triangles = words.integer("--fine").value_or(request.fine.triangles);
  request.fine.stop_residual = words.number("--fine-residual").value_or(request.fine.stop_residual);
  request.newton = words.flag("--newton");
  request.scenes = words.rest();
  if (request.scenes.empty()) request.scenes = {"leggings_tight", "tshirt_fitted", "dress_sleeveless", "skirt_pencil"};
  return request;
}

struct Point {
  std::string scene;
  Accuracy accuracy;
  int triangles = 0;
  double cpu_s = 0.0;
  AnswerError error;
};

std::vector<Accuracy> accuracies(const Request& request) {
  std::vector<Accuracy> all;
  for (const double size : request.sizes) {
    for (const double residual : request.residuals) all.push_back({static_cast<int>(size), residual});
    if (request.newton) all.push_back({static_cast<int>(size), request.residuals.back(), SolverKind::Newton});
  }
  return all;
}

std::string name_of(const Accuracy& accuracy) {
  return accuracy.solver == SolverKind::Newton ? "Newton" : "residual " + fixed(accuracy.stop_residual, 2);
}

std::vector<Point> run_scene(const Request& request, const std::string& name, int repeats) {
  const SceneBodies scene = read_scene(test::named_scene(name));
  const Answer fine = answer(scene, request.fine);
  std::printf("%s: reference of %d triangles took %.1f CPU s\n", name.c_str(), fine.mesh.triangle_count(), fine.cpu_s);
  std::fflush(stdout);
  std::vector<Point> points;
  for (const Accuracy& accuracy : accuracies(request)) {
    std::vector<double> times;
    Point point{name, accuracy, 0, 0.0, {}};
    for (int i = 0; i < repeats; ++i) {
      const Answer coarse = answer(scene, accuracy);
      times.push_back(coarse.cpu_s);
      if (i == 0) point.error = compare(fine, coarse), point.triangles = coarse.mesh.triangle_count();
    }
    std::sort(times.begin(), times.end());
    point.cpu_s = times[times.size() / 2];
    points.push_back(point);
  }
  return points;
}

bool on_front(const Point& point, const std::vector<Point>& all) {
  return std::none_of(all.begin(), all.end(), [&](const Point& other) {
    return other.scene == point.scene && other.cpu_s < point.cpu_s && other.error.pattern < point.error.pattern;
  });
}

Plot plot_of(const std::vector<Point>& points) {
  Plot plot{"Run time against error of the derived pattern", "CPU s", "rms error of the outlines, mm", true, true, {}};
  std::map<std::string, Curve> curves;
  for (const Point& point : points) {
    Curve& curve = curves[point.scene + ", " + name_of(point.accuracy)];
    curve.x.push_back(point.cpu_s);
    curve.y.push_back(point.error.pattern * kMmPerMetre);
    curve.labels.push_back(std::to_string(point.accuracy.triangles / 1000) + "k");
  }
  for (auto& [name, curve] : curves) {
    curve.name = name;
    plot.curves.push_back(curve);
  }
  return plot;
}

}  // namespace

int bench_pareto(const Arguments& arguments) {
  const Request request = parse(Words(arguments.words));
  std::vector<Point> points;
  for (const std::string& scene : request.scenes) {
    try {
      const std::vector<Point> found = run_scene(request, scene, arguments.repeats);
      points.insert(points.end(), found.begin(), found.end());
    } catch (const Error& error) {
      std::printf("%s: %s\n", scene.c_str(), error.what());
    }
  }
  Table table({"scene", "triangles", "solver", "CPU s", "stretch %", "recovered %", "position mm", "hem mm",
               "pattern mm", "front"});
  for (const Point& point : points)
    table.add({point.scene, std::to_string(point.triangles), name_of(point.accuracy), fixed(point.cpu_s, 2),
               fixed(100 * point.error.stretch, 2), fixed(100 * point.error.recovered_stretch, 2),
               fixed(point.error.position * kMmPerMetre, 2), fixed(point.error.hem * kMmPerMetre, 2),
               fixed(point.error.pattern * kMmPerMetre, 2), on_front(point, points) ? "*" : ""});
  table.print(arguments.csv);
  if (!arguments.svg.empty()) write_plot(plot_of(points), arguments.svg);
  return 0;
}

}  // namespace toile::bench
