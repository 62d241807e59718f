// SPDX-License-Identifier: GPL-3.0-or-later
// pareto [SCENE...] [--points N:R[:S],... | --sizes N,N,... --residuals R,R,...] [--newton] [--fine N]
//        [--fine-residual R] [--held] [--flat]
// Run time against error of meshing, draping, transport and derivation together, over triangles N x residual R x solver
// (S: the residual at which a settled drape is left, the default's if not told). Errors are distances to
//   the same scene on a fine mesh to a tight residual;
//   held: the same rest state on the point's own triangles cut into four: its friction held, all to that residual;
//   flat: the fine mesh draped from flat on its own, without the coarse drape that all resolutions begin with.
// The first is the error a user has, held the part of it that the mesh makes, flat shows how far apart rest states can
// lie that friction allows. Rows on the front are marked: no other of the scene is both cheaper and nearer in the
// pattern.
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

struct ParetoRequest {
  std::vector<std::string> scenes;
  std::vector<Accuracy> points;
  Accuracy fine{40000, 0.1, SolverKind::Default, 0.1};
  bool held = false, flat = false;
};

std::vector<double> numbers(const std::vector<std::string>& texts) {
  std::vector<double> found;
  for (const std::string& text : texts) found.push_back(std::atof(text.c_str()));
  return found;
}

// N:R or N:R:S.
Accuracy point_of(const std::string& text) {
  Accuracy point;
  char* at = nullptr;
  point.triangles = static_cast<int>(std::strtol(text.c_str(), &at, 10));
  if (*at == ':') point.stop_residual = std::strtod(at + 1, &at);
  if (*at == ':') point.stop_settled = std::strtod(at + 1, &at);
  if (*at != 0) throw Error(ErrorCode::OptionInvalid, "--points", "no N:R or N:R:S: " + text);
  return point;
}

std::vector<Accuracy> points_of(Words& words) {
  std::vector<Accuracy> points;
  const auto named = words.list("--points"), sizes = words.list("--sizes"), residuals = words.list("--residuals");
  const bool newton = words.flag("--newton");
  if (named) {
    for (const std::string& text : *named) points.push_back(point_of(text));
    return points;
  }
  const std::vector<double> tried = residuals ? numbers(*residuals) : std::vector<double>{3.0, 1.0, 0.3, 0.1};
  for (const double size : sizes ? numbers(*sizes) : std::vector<double>{1000, 2000, 4000, 10000}) {
    for (const double residual : tried) points.push_back({static_cast<int>(size), residual});
    if (newton) points.push_back({static_cast<int>(size), tried.back(), SolverKind::Newton});
  }
  return points;
}

ParetoRequest pareto_request(Words words) {
  ParetoRequest request;
  request.points = points_of(words);
  request.fine.triangles = words.integer("--fine").value_or(request.fine.triangles);
  request.fine.stop_residual = words.number("--fine-residual").value_or(request.fine.stop_residual);
  request.fine.stop_settled = request.fine.stop_residual;
  request.held = words.flag("--held");
  request.flat = words.flag("--flat");
  request.scenes = words.rest();
  if (request.scenes.empty()) request.scenes = {"leggings_tight", "tshirt_fitted", "dress_sleeveless", "skirt_pencil"};
  return request;
}

struct Point {
  std::string scene;
  Accuracy accuracy;
  Answer found;
  double cpu_s = 0.0;
  AnswerError error;
  std::optional<AnswerError> held, flat;
};

std::string name_of(const Accuracy& accuracy) {
  return accuracy.solver == SolverKind::Newton ? "Newton" : "residual " + fixed(accuracy.stop_residual, 2);
}

Answer reference(const char* what, const std::string& name, const SceneBodies& scene, const Accuracy& accuracy) {
  Answer fine = answer(scene, accuracy);
  std::printf("%s: %s of %d triangles, residual %.2f, took %.1f CPU s\n", name.c_str(), what,
              fine.mesh.triangle_count(), fine.residual, fine.cpu_s);
  std::fflush(stdout);
  return fine;
}

Point run_point(const ParetoRequest& request, const SceneBodies& scene, Point point, int repeats) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    Answer found = answer(scene, point.accuracy);
    times.push_back(found.cpu_s);
    if (i + 1 == repeats) point.found = std::move(found);
  }
  std::sort(times.begin(), times.end());
  point.cpu_s = times[times.size() / 2];
  if (request.held) {
    const Answer finer = refined(scene, point.found, request.fine);
    point.held = compare(finer, point.found);
    std::printf("%s: %d triangles cut into four, residual %.2f, took %.1f CPU s\n", point.scene.c_str(),
                point.found.mesh.triangle_count(), finer.residual, finer.cpu_s);
    std::fflush(stdout);
  }
  return point;
}

std::vector<Point> run_scene(const ParetoRequest& request, const std::string& name, int repeats) {
  const SceneBodies scene = read_scene(test::named_scene(name));
  std::vector<Point> points;
  for (const Accuracy& accuracy : request.points)
    points.push_back(run_point(request, scene, {name, accuracy, {}, 0.0, {}, {}, {}}, repeats));
  const Answer fine = reference("reference", name, scene, request.fine);
  for (Point& point : points) point.error = compare(fine, point.found);
  if (!request.flat) return points;
  Accuracy alone = request.fine;
  alone.coarse_triangles = 0;
  const Answer flat = reference("reference from flat", name, scene, alone);
  for (Point& point : points) point.flat = compare(flat, point.found);
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
    Curve& curve = curves[point.scene + (point.accuracy.solver == SolverKind::Newton ? ", Newton" : "")];
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

void add_error(const std::optional<AnswerError>& error, std::vector<std::string>& row) {
  if (!error) {
    row.insert(row.end(), 6, "-");
    return;
  }
  for (const double share : {error->stretch, error->triangle_stretch}) row.push_back(fixed(100 * share, 2));
  for (const double length : {error->position, error->hem, error->girth, error->pattern})
    row.push_back(fixed(length * kMmPerMetre, 2));
}

}  // namespace

int bench_pareto(const Arguments& arguments) {
  const ParetoRequest request = pareto_request(Words(arguments.words));
  std::vector<Point> points;
  for (const std::string& scene : request.scenes) {
    try {
      const std::vector<Point> found = run_scene(request, scene, arguments.repeats);
      points.insert(points.end(), found.begin(), found.end());
    } catch (const Error& error) {
      std::printf("%s: %s\n", scene.c_str(), error.what());
    }
  }
  Table table({"scene",
               "triangles",
               "solver",
               "CPU s",
               "stretch %",
               "triangles' %",
               "position mm",
               "hem mm",
               "girth mm",
               "pattern mm",
               "held stretch %",
               "held triangles' %",
               "held position mm",
               "held hem mm",
               "held girth mm",
               "held pattern mm",
               "flat stretch %",
               "flat triangles' %",
               "flat position mm",
               "flat hem mm",
               "flat girth mm",
               "flat pattern mm",
               "front"});
  for (const Point& point : points) {
    std::vector<std::string> row{point.scene, std::to_string(point.found.mesh.triangle_count()),
                                 name_of(point.accuracy), fixed(point.cpu_s, 2)};
    for (const std::optional<AnswerError>& error : {std::optional(point.error), point.held, point.flat})
      add_error(error, row);
    row.push_back(on_front(point, points) ? "*" : "");
    table.add(row);
  }
  table.print(arguments.csv);
  if (!arguments.svg.empty()) write_plot(plot_of(points), arguments.svg);
  return 0;
}

}  // namespace toile::bench
