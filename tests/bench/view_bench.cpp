// SPDX-License-Identifier: GPL-3.0-or-later
// view BODY.obj [DRAPE.obj] OUT.png [--stretch SCALE]: looks at a drape from four sides. A colour per `o` or `g` group
// of the drape; with --stretch the signed stretch of `v` against `vt` (centimetres).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "engine/render/contact_sheet.h"
#include "engine/render/palette.h"
#include "engine/render/png.h"
#include "tests/bench/bench.h"

namespace toile::bench {
namespace {

struct ObjModel {
  std::vector<Vec3> positions;
  std::vector<Vec2> rest;                                     // vt, cm
  std::vector<std::array<int, 3>> triangles, rest_triangles;  // -1: no vt
  std::vector<int> group;                                     // per triangle
};

void add_face(ObjModel& model, std::istringstream& words, int group) {
  std::vector<std::pair<int, int>> corners;
  for (std::string word; words >> word;) {
    const std::size_t slash = word.find('/');
    const int v = std::atoi(word.c_str());
    const int t = slash == std::string::npos ? 0 : std::atoi(word.c_str() + slash + 1);
    const auto index = [](int i, std::size_t count) { return i < 0 ? static_cast<int>(count) + i : i - 1; };
    corners.emplace_back(index(v, model.positions.size()), t == 0 ? -1 : index(t, model.rest.size()));
  }
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    model.triangles.push_back({corners[0].first, corners[i].first, corners[i + 1].first});
    model.rest_triangles.push_back({corners[0].second, corners[i].second, corners[i + 1].second});
    model.group.push_back(group);
  }
}

ObjModel read_obj(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  ObjModel model;
  int group = -1;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    double x = 0, y = 0, z = 0;
    if (kind == "v" && words >> x >> y >> z) model.positions.emplace_back(x, y, z);
    if (kind == "vt" && words >> x >> y) model.rest.emplace_back(x, y);
    if (kind == "o" || kind == "g") ++group;
    if (kind == "f") add_face(model, words, std::max(0, group));
  }
  return model;
}

// Signed stretch of larger magnitude of triangle f, in either orientation of its rest shape.
double stretch_of(const ObjModel& model, std::size_t f) {
  const auto& t = model.triangles[f];
  const auto& r = model.rest_triangles[f];
  if (r[0] < 0 || r[1] < 0 || r[2] < 0) return 0.0;
  const auto rest = [&](int k) {
    return model.rest.at(static_cast<std::size_t>(r[static_cast<std::size_t>(k)])) * 0.01;
  };
  const auto at = [&](int k) { return model.positions.at(static_cast<std::size_t>(t[static_cast<std::size_t>(k)])); };
  Mat2 flat;
  flat << rest(1) - rest(0), rest(2) - rest(0);
  Mat32 draped;
  draped << at(1) - at(0), at(2) - at(0);
  if (std::abs(flat.determinant()) < 1e-12) return 0.0;
  const Mat32 gradient = draped * flat.inverse();
  const double weft = gradient.col(0).norm() - 1, warp = gradient.col(1).norm() - 1;
  return std::abs(weft) >= std::abs(warp) ? weft : warp;
}

Surface surface_of(const ObjModel& model) {
  Surface surface;
  surface.vertices.resize(static_cast<Eigen::Index>(model.positions.size()), 3);
  for (std::size_t v = 0; v < model.positions.size(); ++v)
    surface.vertices.row(static_cast<Eigen::Index>(v)) = model.positions[v].transpose();
  surface.triangles.resize(static_cast<Eigen::Index>(model.triangles.size()), 3);
  for (std::size_t f = 0; f < model.triangles.size(); ++f)
    for (int k = 0; k < 3; ++k)
      surface.triangles(static_cast<Eigen::Index>(f), k) = model.triangles[f][static_cast<std::size_t>(k)];
  return surface;
}

// Edges that two groups, or one triangle alone, own.
void add_border_lines(Surface& surface, const ObjModel& model) {
  std::map<std::pair<int, int>, std::vector<int>> groups_of_edge;
  for (std::size_t f = 0; f < model.triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = model.triangles[f][k], b = model.triangles[f][(k + 1) % 3];
      groups_of_edge[std::minmax(a, b)].push_back(model.group[f]);
    }
  for (const auto& [edge, groups] : groups_of_edge)
    if (groups.size() == 1 || groups.front() != groups.back()) surface.lines.push_back(edge);
}

}  // namespace

int bench_view(const Arguments& arguments) {
  std::vector<std::string> files;
  std::optional<double> stretch;
  for (std::size_t i = 0; i < arguments.words.size(); ++i) {
    if (arguments.words[i] == "--stretch" && i + 1 < arguments.words.size())
      stretch = std::atof(arguments.words[++i].c_str());
    else
      files.push_back(arguments.words[i]);
  }
  if (files.size() < 2 || files.size() > 3) {
    std::fprintf(stderr, "usage: toile-bench view BODY.obj [DRAPE.obj] OUT.png [--stretch 0.1]\n");
    return 2;
  }
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i + 1 < files.size(); ++i) {
    const ObjModel model = read_obj(files[i]);
    Surface surface = surface_of(model);
    for (std::size_t f = 0; f < model.triangles.size(); ++f)
      surface.colours.push_back(i == 0    ? kSkin
                                : stretch ? stretch_colour(stretch_of(model, f), *stretch)
                                          : panel_colour(model.group[f]));
    if (i == 1) add_border_lines(surface, model);
    surfaces.push_back(std::move(surface));
  }
  SheetOptions sheet;
  sheet.frame.add(surfaces.back().vertices);
  sheet.frame.grow(0.05);
  sheet.title = files[files.size() - 2];
  sheet.stretch_scale = stretch;
  const double start = cpu_seconds();
  const Image image = contact_sheet(surfaces, sheet);
  const double painted = cpu_seconds();
  const Bytes png = write_png(image);
  std::printf("%d x %d: views %.0f ms, PNG %.0f ms (CPU)\n", image.width, image.height, 1e3 * (painted - start),
              1e3 * (cpu_seconds() - painted));
  std::ofstream(files.back(), std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  return 0;
}

}  // namespace toile::bench
