// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/make_form.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include "engine/core/error.h"
#include "engine/core/units.h"

namespace toile {
namespace {

constexpr double kLeastHeight = 0.5, kMostHeight = 2.5;  // m, of any body (service contract, section 4)

double radius_at(const std::vector<std::pair<double, double>>& profile, double y) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const auto& [y0, r0] = profile[i - 1];
    const auto& [y1, r1] = profile[i];
    if (y <= y1) return r0 + (r1 - r0) * (y - y0) / (y1 - y0);
  }
  return profile.back().second;
}

void check(const MakeFormOptions& options) {
  const auto refuse = [](const char* why) { throw Error(ErrorCode::OptionInvalid, "form", why); };
  if (options.profile.size() < 2 || options.profile.front().first != 0.0)
    refuse("give at least two (height, radius) points, the first at height 0");
  if (options.rings < 1 || options.segments < 3) refuse("a form needs at least 1 ring and 3 segments");
  for (std::size_t i = 0; i < options.profile.size(); ++i) {
    if (!(options.profile[i].second > 0.0)) refuse("every radius must be greater than 0");
    if (i > 0 && !(options.profile[i].first > options.profile[i - 1].first)) refuse("heights must rise");
  }
  const double height = options.profile.back().first;
  if (height < kLeastHeight || height > kMostHeight) refuse("a form is between 0.5 m and 2.5 m high");
}

void add_cap(TriangleMesh& mesh, int& next, int centre, int first, int segments, bool top) {
  for (int s = 0; s < segments; ++s) {
    const int a = first + s, b = first + (s + 1) % segments;
    mesh.triangles.row(next++) << centre, top ? a : b, top ? b : a;
  }
}

std::optional<double> number(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

Body make_form(const MakeFormOptions& options) {
  check(options);
  const int rings = options.rings, segments = options.segments;
  const double height = options.profile.back().first;
  Body body;
  body.kind = BodyKind::Form;
  TriangleMesh& mesh = body.surface;
  mesh.vertices.resize((rings + 1) * segments + 2, 3);
  mesh.triangles.resize(2 * rings * segments + 2 * segments, 3);
  for (int r = 0; r <= rings; ++r) {
    const double y = height * r / rings, radius = radius_at(options.profile, y);
    for (int s = 0; s < segments; ++s) {
      const double angle = 2.0 * std::numbers::pi * s / segments;  // from +z towards +x: counter-clockwise from above
      mesh.vertices.row(r * segments + s) << radius * std::sin(angle), y, radius * std::cos(angle);
    }
  }
  const int floor_centre = (rings + 1) * segments, top_centre = floor_centre + 1;
  mesh.vertices.row(floor_centre) << 0.0, 0.0, 0.0;
  mesh.vertices.row(top_centre) << 0.0, height, 0.0;

  int next = 0;
  for (int r = 0; r < rings; ++r) {
    for (int s = 0; s < segments; ++s) {
      const int a = r * segments + s, b = r * segments + (s + 1) % segments;
      mesh.triangles.row(next++) << a, b, b + segments;
      mesh.triangles.row(next++) << a, b + segments, a + segments;
    }
  }
  add_cap(mesh, next, floor_centre, 0, segments, false);
  add_cap(mesh, next, top_centre, rings * segments, segments, true);
  return body;
}

Body make_builtin_form(std::string_view name) {
  constexpr std::string_view kTube = "tube-";
  if (name.starts_with(kTube)) {
    const std::string_view rest = name.substr(kTube.size());
    const std::size_t dash = rest.find('-');
    if (dash != std::string_view::npos) {
      const auto radius = number(rest.substr(0, dash)), tall = number(rest.substr(dash + 1));
      if (radius && tall) {
        const double r = *radius * kMetrePerCm, h = *tall * kMetrePerCm;
        Body body = make_form({.profile = {{0.0, r}, {h, r}}});
        body.name = name;
        return body;
      }
    }
  }
  throw Error(ErrorCode::NotFound, "builtin:" + std::string(name),
              "no built-in form of this name; forms are tube-R-H in centimetres, such as tube-14-100");
}

}  // namespace toile
