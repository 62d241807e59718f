// SPDX-License-Identifier: GPL-3.0-or-later
// Shaded surfaces seen from the four sides, orthographic, to one scale. Lengths in metres in the body's normalised
// frame (Y up, facing +Z, wearer's left +X).
#pragma once

#include <utility>

#include "engine/core/body.h"
#include "engine/render/image.h"

namespace toile {

enum class View { Front, Back, Left, Right };  // Left: the wearer's left side is seen
std::string_view view_name(View view);         // "front", ...

// A surface with a colour per triangle, and dark lines on it. Both faces are seen; the inside is darker.
struct Surface {
  Points3 vertices;                        // #V x 3, m
  Triangles triangles;                     // #F x 3, counter-clockwise seen from outside
  std::vector<Rgb> colours;                // one per triangle
  std::vector<std::pair<int, int>> lines;  // vertex pairs
};

// Axis-aligned box; empty until something is added.
struct Box {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  bool empty() const { return !(low.x() <= high.x()); }
  void add(const Points3& points);  // rows that are not finite or beyond 10 km are left out
  void grow(double margin) { low.array() -= margin, high.array() += margin; }
};

// How a view maps the world: right, up and towards the viewer are orthonormal.
struct Camera {
  Vec3 right, up, towards;
  Vec3 centre = Vec3::Zero();
  double metres_per_pixel = 1.0;
  int width = 1, height = 1;  // pixels

  // Pixel coordinates (x right, y down) and depth (larger is nearer, m) of a point.
  Vec3 project(const Vec3& point) const;
};

// A camera that sees `box` from `view`; the picture is as wide and tall as the box at this scale.
Camera camera_for(View view, const Box& box, double metres_per_pixel);

// Brightness of a face whose unit normal in camera axes (right, up, towards) is `normal`: 1 where it faces the viewer;
// key light from the upper left, fill from the right, ambient.
double brightness(const Vec3& normal);

// Paints the surfaces with a camera's pixels times `supersample` along each axis. Triangles with coordinates that are
// not finite or beyond 10 km, or with indices out of range, are left out.
Image paint(const std::vector<Surface>& surfaces, const Camera& camera, int supersample, Rgb background);

}  // namespace toile
