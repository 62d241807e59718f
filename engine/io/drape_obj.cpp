// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/drape_obj.h"

#include <algorithm>
#include <cstdio>

#include "engine/core/units.h"

namespace toile {
namespace {

class Text {
 public:
  template <class... T>
  void line(const char* format, T... values) {
    char buffer[160];
    const int size = std::snprintf(buffer, sizeof buffer, format, values...);
    bytes_.insert(bytes_.end(), buffer, buffer + std::min<int>(size, sizeof buffer - 1));
  }
  void text(const std::string& words) { bytes_.insert(bytes_.end(), words.begin(), words.end()); }
  Bytes take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

// Names in an OBJ end at white space.
std::string one_word(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return name;
}

constexpr double kLeastFit = 0.2, kMostFit = 5.0;  // beyond what the derivation asks for of any triangle

// Tensors of triangles without a tangent frame are given in their polar frame.
Mat2 in_tangent_frame(const Mat2& tensor) {
  const double weft = std::clamp(tensor.col(0).norm(), kLeastFit, kMostFit);
  const double across = std::clamp(tensor.col(0).dot(tensor.col(1)) / weft, -kMostFit, kMostFit);
  return (Mat2() << weft, across, 0.0, std::clamp(tensor.determinant() / weft, kLeastFit, kMostFit)).finished();
}

}  // namespace

Bytes write_drape_obj(const Pattern& pattern, const PatternMesh& mesh, const Drape& drape, const FittingMap* wanted) {
  Text out;
  out.text("# metres; vt in centimetres of each panel's plane\n");
  for (Eigen::Index i = 0; i < drape.nodes.rows(); ++i)
    out.line("v %.6f %.6f %.6f\n", drape.nodes(i, 0), drape.nodes(i, 1), drape.nodes(i, 2));
  for (int v = 0; v < mesh.vertex_count(); ++v)
    out.line("vt %.5f %.5f\n", mesh.rest(v, 0) * kCmPerMetre, mesh.rest(v, 1) * kCmPerMetre);
  for (std::size_t p = 0; p < mesh.panels.size(); ++p) {
    out.text("o " + one_word(pattern.panels[p].name) + "\n");
    for (int f = mesh.panels[p].triangle_begin; f < mesh.panels[p].triangle_end; ++f) {
      const Eigen::Vector3i nodes = mesh.nodes_of_triangle(f);
      const int second = mesh.panel_reversed[p] ? 2 : 1, third = 3 - second;
      out.line("f %d/%d %d/%d %d/%d\n", nodes[0] + 1, mesh.triangles(f, 0) + 1, nodes[second] + 1,
               mesh.triangles(f, second) + 1, nodes[third] + 1, mesh.triangles(f, third) + 1);
      if (!wanted) continue;
      const Mat2 fit = in_tangent_frame(wanted->tensor[static_cast<std::size_t>(f)]);
      out.line("#fit %.6f %.6f %.6f\n", fit(0, 0), fit(0, 1), fit(1, 1));
    }
  }
  return out.take();
}

}  // namespace toile
