// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/alter/lay_sheet.h"

#include "engine/geometry/flat_locator.h"

namespace toile {

void lay_like(Sheet& sheet, const Sheet& relaxed) {
  if (relaxed.faces.empty()) return;
  Points2 flat(relaxed.vertex_count(), 2), moves(relaxed.vertex_count(), 2);
  for (int v = 0; v < relaxed.vertex_count(); ++v) {
    const SheetVertex& vertex = relaxed.vertices[static_cast<std::size_t>(v)];
    flat.row(v) = vertex.flat.transpose();
    moves.row(v) = (vertex.now - vertex.guide).transpose();
  }
  Triangles faces(static_cast<Eigen::Index>(relaxed.faces.size()), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (Eigen::Index k = 0; k < 3; ++k)
      faces(f, k) = relaxed.faces[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)];
  const FlatLocator locator(flat, faces);
  for (SheetVertex& vertex : sheet.vertices)
    vertex.now = vertex.guide + locator.closest(vertex.flat).of(moves, faces).transpose();
}

}  // namespace toile
