// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/upright.h"

#include <algorithm>

#include "engine/geometry/mesh_slicer.h"

namespace toile {
namespace {

constexpr double kNearlyLongest = 0.8;  // in T-pose the arms span about the height
constexpr double kPieceGirth = 0.08;    // of the height: fingers, ears and specks are no pieces
constexpr double kMergeWithin =
    0.004;  // of the height: an outline broken by holes, and the mouth inside the head, are one
constexpr int kLegLevels = 9, kHeadLevels = 6;

int count_pieces(const MeshSlicer& slicer, double fraction, double height) {
  const auto pieces = slicer.slice(slicer.bottom() + fraction * height, kMergeWithin * height);
  return static_cast<int>(std::count_if(pieces.begin(), pieces.end(), [&](const SliceComponent& c) {
    return 2.0 * (c.high - c.low).sum() > kPieceGirth * height && c.hull_girth() > kPieceGirth * height;
  }));
}

// Share of levels, evenly from `low` to `high` of the height, at which the slice has `wanted` pieces.
double share_of_levels(const MeshSlicer& slicer, double low, double high, int levels, int wanted) {
  const double height = slicer.top() - slicer.bottom();
  int hits = 0;
  for (int i = 0; i < levels; ++i)
    hits += count_pieces(slicer, low + (high - low) * i / (levels - 1), height) == wanted;
  return static_cast<double>(hits) / levels;
}

TriangleMesh turned(const TriangleMesh& body, const Mat3& turn) {
  return {body.vertices * turn.transpose(), body.triangles};
}

}  // namespace

std::string_view up_name(UpAxis up) {
  constexpr std::string_view names[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
  return names[static_cast<int>(up)];
}

Mat3 turn_upright(UpAxis up) {
  Mat3 m;
  switch (up) {
    case UpAxis::PlusX: m << 0, -1, 0, 1, 0, 0, 0, 0, 1; break;
    case UpAxis::MinusX: m << 0, 1, 0, -1, 0, 0, 0, 0, 1; break;
    case UpAxis::PlusY: m.setIdentity(); break;
    case UpAxis::MinusY: m << 1, 0, 0, 0, -1, 0, 0, 0, -1; break;
    case UpAxis::PlusZ: m << 1, 0, 0, 0, 0, 1, 0, -1, 0; break;
    case UpAxis::MinusZ: m << 1, 0, 0, 0, 0, -1, 0, 1, 0; break;
  }
  return m;
}

double upright_score(const TriangleMesh& body, UpAxis up) {
  const TriangleMesh standing = turned(body, turn_upright(up));
  const MeshSlicer slicer(standing);
  return share_of_levels(slicer, 0.06, 0.40, kLegLevels, 2) + share_of_levels(slicer, 0.84, 0.97, kHeadLevels, 1);
}

Upright find_upright(const TriangleMesh& body) {
  const Vec3 extent = body.vertices.colwise().maxCoeff() - body.vertices.colwise().minCoeff();
  Upright best;
  for (const UpAxis up :
       {UpAxis::PlusY, UpAxis::PlusZ, UpAxis::PlusX, UpAxis::MinusY, UpAxis::MinusZ, UpAxis::MinusX}) {
    if (extent[static_cast<int>(up) / 2] < kNearlyLongest * extent.maxCoeff()) continue;
    const double score = upright_score(body, up);
    if (score > best.score) best = {up, score};
  }
  return best;
}

}  // namespace toile
