// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/sim/half_cloth.h"

#include <algorithm>
#include <numeric>

namespace toile {
namespace {

using Index = Eigen::Index;

template <class T>
decltype(auto) at(T& list, int i) {
  return list[static_cast<std::size_t>(i)];
}

template <class Visit>
void visit_triangles(const Cloth& cloth, const Visit& visit) {
  for (const TriangleBlock& block : cloth.blocks)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      if (block.area[static_cast<Index>(lane)] != 0)
        visit(block, lane, std::array<int, 3>{block.node[0][lane], block.node[1][lane], block.node[2][lane]});
}

// Pieces of cloth that hang together off the middle.
class Pieces {
 public:
  Pieces(const Cloth& cloth, const NodeMirror& mirror) : piece_(mirror.image.size()) {
    std::iota(piece_.begin(), piece_.end(), 0);
    visit_triangles(cloth, [&](const TriangleBlock&, std::size_t, const std::array<int, 3>& nodes) {
      int last = -1;
      for (const int n : nodes) {
        if (at(mirror.image, n) == n) continue;
        if (last >= 0) join(n, last);
        last = n;
      }
      if (last < 0) flat_ = true;
    });
  }

  int of(int node) {
    while (at(piece_, node) != node) node = at(piece_, node) = at(piece_, at(piece_, node));
    return node;
  }
  bool lies_in_the_middle() const { return flat_; }  // some triangle does

 private:
  void join(int a, int b) {
    const auto [first, second] = std::minmax({of(a), of(b)});
    at(piece_, second) = first;
  }

  std::vector<int> piece_;
  bool flat_ = false;
};

// 1: of the half, -1: of the other, 0: on the middle. Empty where a piece reaches from one side to the other.
std::vector<int> sides_of(const Cloth& cloth, const NodeMirror& mirror, const Points3& start) {
  Pieces pieces(cloth, mirror);
  if (pieces.lies_in_the_middle()) return {};
  std::vector<double> x(mirror.image.size(), 0.0);
  for (int n = 0; n < cloth.node_count; ++n) at(x, pieces.of(n)) += start(n, 0);
  std::vector<int> sides(mirror.image.size(), 0);
  for (int n = 0; n < cloth.node_count; ++n) {
    if (at(mirror.image, n) == n) continue;
    const int here = pieces.of(n), there = pieces.of(at(mirror.image, n));
    if (here == there) return {};
    const double left = at(x, here) - at(x, there);
    at(sides, n) = left > 0 || (left == 0 && here < there) ? 1 : -1;
  }
  return sides;
}

void add_triangles(const Cloth& whole, HalfCloth& half) {
  visit_triangles(whole, [&](const TriangleBlock& block, std::size_t lane, const std::array<int, 3>& nodes) {
    if (std::any_of(nodes.begin(), nodes.end(), [&](int n) { return at(half.side, n) < 0; })) return;
    Cloth& cloth = half.cloth;
    const auto to = static_cast<std::size_t>(cloth.triangle_count++ % kLanes);
    const auto from_lane = static_cast<Index>(lane), to_lane = static_cast<Index>(to);
    if (to == 0) {  // every lane starts as this triangle without area
      cloth.blocks.push_back(block);
      TriangleBlock& filled = cloth.blocks.back();
      for (std::size_t k = 0; k < 3; ++k) filled.node[k].fill(at(half.row, nodes[k]));
      for (Lanes* lanes : {&filled.u1, &filled.u2, &filled.v1, &filled.v2}) lanes->setConstant((*lanes)[from_lane]);
      filled.area.setZero();
    }
    TriangleBlock& last = cloth.blocks.back();
    for (std::size_t k = 0; k < 3; ++k) last.node[k][to] = at(half.row, nodes[k]);
    last.u1[to_lane] = block.u1[from_lane], last.u2[to_lane] = block.u2[from_lane];
    last.v1[to_lane] = block.v1[from_lane], last.v2[to_lane] = block.v2[from_lane];
    last.area[to_lane] = block.area[from_lane];
  });
}

// Fills column j with what `entries` add up to.
void append_column(SparseMatrix& matrix, int j, std::vector<std::pair<int, double>>& entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  matrix.startVec(j);
  for (std::size_t k = 0; k < entries.size();) {
    const int row = entries[k].first;
    double sum = 0;
    for (; k < entries.size() && entries[k].first == row; ++k) sum += entries[k].second;
    matrix.insertBack(row, j) = sum;
  }
}

// For y and z an image is where its node is, for x it is opposite.
void fold_bending(const SparseMatrix& bending, HalfCloth& half) {
  Cloth& cloth = half.cloth;
  cloth.bending.resize(cloth.node_count, cloth.node_count);
  cloth.bending_across.resize(cloth.node_count, cloth.node_count);
  std::vector<std::pair<int, double>> column, across;
  for (int j = 0; j < cloth.node_count; ++j) {
    const int node = at(half.node, j);
    const bool middle = at(half.side, node) == 0;
    column.clear(), across.clear();
    for (SparseMatrix::InnerIterator it(bending, node); it; ++it) {
      const auto i = static_cast<int>(it.index());
      column.emplace_back(at(half.row, i), (middle ? 0.5 : 1.0) * it.value());
      if (!middle && at(half.side, i) < 0) across.emplace_back(at(half.row, i), -2 * it.value());
    }
    append_column(cloth.bending, j, column);
    append_column(cloth.bending_across, j, across);
  }
  cloth.bending.finalize(), cloth.bending_across.finalize();
}

}  // namespace

Points3 HalfCloth::folded(const Points3& whole) const {
  Points3 rows(cloth.node_count, 3);
  for (int i = 0; i < cloth.node_count; ++i) rows.row(i) = whole.row(at(node, i));
  return rows;
}

Points3 HalfCloth::unfolded(const Points3& rows) const {
  Points3 whole(static_cast<Index>(row.size()), 3);
  unfold(rows, whole);
  return whole;
}

void HalfCloth::unfold(const Points3& rows, Points3& whole) const {
  const double* p = rows.data();
  for (int i = 0; i < cloth.node_count; ++i, p += 3) {
    double *there = whole.data() + 3 * static_cast<Index>(at(image, i)),
           *here = whole.data() + 3 * static_cast<Index>(at(node, i));
    there[0] = -p[0], there[1] = p[1], there[2] = p[2];
    here[0] = p[0], here[1] = p[1], here[2] = p[2];
  }
}

void HalfCloth::add_folded(const Points3& gradient, Points3& rows) const {
  double* g = rows.data();
  for (int i = 0; i < cloth.node_count; ++i, g += 3) {
    const double *there = gradient.data() + 3 * static_cast<Index>(at(image, i)),
                 *here = gradient.data() + 3 * static_cast<Index>(at(node, i));
    g[0] += here[0], g[1] += here[1], g[2] += here[2];
    if (here != there) g[0] -= there[0], g[1] += there[1], g[2] += there[2];
  }
}

FrictionState HalfCloth::folded(const FrictionState& whole) const {
  FrictionState rows{Eigen::VectorXd(cloth.node_count), folded(whole.anchor), folded(whole.normal)};
  for (int i = 0; i < cloth.node_count; ++i)
    rows.load[i] = (at(node, i) == at(image, i) ? 0.5 : 1) * whole.load[at(node, i)];
  return rows;
}

FrictionState HalfCloth::unfolded(const FrictionState& rows) const {
  FrictionState whole{Eigen::VectorXd(static_cast<Index>(row.size())), unfolded(rows.anchor), unfolded(rows.normal)};
  for (std::size_t n = 0; n < row.size(); ++n)
    whole.load[static_cast<Index>(n)] = (side[n] == 0 ? 2 : 1) * rows.load[row[n]];
  return whole;
}

std::optional<HalfCloth> half_of(const Cloth& cloth, const NodeMirror& mirror, const Points3& start) {
  HalfCloth half;
  half.side = sides_of(cloth, mirror, start);
  if (half.side.empty()) return {};
  half.row.assign(half.side.size(), -1);
  for (int n = 0; n < cloth.node_count; ++n) {
    if (at(half.side, n) < 0) continue;
    const int image = at(mirror.image, n), row = static_cast<int>(half.node.size());
    if (image == n) half.cloth.middle.push_back(row);
    at(half.row, n) = at(half.row, image) = row;
    half.node.push_back(n), half.image.push_back(image);
  }
  half.cloth.half = true;
  half.cloth.fabric = cloth.fabric;
  half.cloth.mean_edge = cloth.mean_edge;
  half.cloth.node_count = static_cast<int>(half.node.size());
  half.cloth.node_area = cloth.node_area(half.node);
  for (const int i : half.cloth.middle) half.cloth.node_area[i] *= 0.5;
  add_triangles(cloth, half);
  fold_bending(cloth.bending, half);
  return half;
}

}  // namespace toile
