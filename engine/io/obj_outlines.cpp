// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/obj_outlines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "engine/geometry/disjoint_sets.h"

namespace toile {

namespace {

constexpr double kCornerTurn = 30.0 * std::numbers::pi / 180.0;

// Numbers of the places in space where outline vertices meet: one for vertices within the tolerance of each other.
std::vector<int> places(const ObjTextured& obj, const ObjIslands& islands, const BorderSegments& borders,
                        double tolerance) {
  const auto position = [&](int segment) {
    return islands.position[static_cast<std::size_t>(borders.start[static_cast<std::size_t>(segment)])];
  };
  DisjointSets sets(borders.size());
  std::map<std::array<std::int64_t, 3>, std::vector<int>> cells;
  std::map<int, int> first_at_position;
  for (int i = 0; i < borders.size(); ++i) {
    const auto [place, fresh] = first_at_position.emplace(position(i), i);
    if (!fresh) {
      sets.join(i, place->second);
      continue;
    }
    const Vec3& p = obj.positions[static_cast<std::size_t>(position(i))];
    std::array<std::int64_t, 3> cell{};
    for (int k = 0; k < 3; ++k) cell[static_cast<std::size_t>(k)] = std::llround(p[k] / tolerance);
    for (std::int64_t x = -1; x <= 1; ++x)
      for (std::int64_t y = -1; y <= 1; ++y)
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = cells.find({cell[0] + x, cell[1] + y, cell[2] + z});
          if (found == cells.end()) continue;
          for (const int j : found->second)
            if ((obj.positions[static_cast<std::size_t>(position(j))] - p).norm() <= tolerance) sets.join(i, j);
        }
    cells[cell].push_back(i);
  }
  return sets.numbering().first;
}

double turn_at(const ObjIslands& islands, const BorderSegments& borders, int segment) {
  const auto point = [&](int i) {
    return islands.flat[static_cast<std::size_t>(borders.start[static_cast<std::size_t>(i)])];
  };
  const Vec2 in = point(segment) - point(borders.previous(segment)),
             out = point(borders.next(segment)) - point(segment);
  return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
}

// Whether the mates of two consecutive segments follow each other as well.
bool mates_continue(const BorderSegments& borders, int segment) {
  const int before = borders.previous(segment);
  const int a = borders.mate[static_cast<std::size_t>(before)], b = borders.mate[static_cast<std::size_t>(segment)];
  if (a < 0 || b < 0) return a == b;
  if (a == segment) return false;  // the tip of a dart
  if (borders.same_way[static_cast<std::size_t>(before)] != borders.same_way[static_cast<std::size_t>(segment)])
    return false;
  return b == (borders.same_way[static_cast<std::size_t>(segment)] ? borders.next(a) : borders.previous(a));
}

// The segments whose start lies where segment i starts, across the seams of i and of the one before it.
std::vector<int> across_start(const BorderSegments& borders, int i) {
  std::vector<int> starts;
  const int before = borders.previous(i);
  const int ahead = borders.mate[static_cast<std::size_t>(i)], behind = borders.mate[static_cast<std::size_t>(before)];
  if (ahead >= 0) starts.push_back(borders.same_way[static_cast<std::size_t>(i)] ? ahead : borders.next(ahead));
  if (behind >= 0) starts.push_back(borders.same_way[static_cast<std::size_t>(before)] ? borders.next(behind) : behind);
  return starts;
}

// An outline needs two edges at least.
void cut_round_outlines(BorderSegments& borders) {
  for (std::size_t p = 0; p + 1 < borders.first.size(); ++p) {
    const int begin = borders.first[p], end = borders.first[p + 1], size = end - begin;
    const auto cuts = [&] { return std::count(borders.cut.begin() + begin, borders.cut.begin() + end, true); };
    if (cuts() == 0) cut_at(borders, begin);
    if (cuts() == 1) {
      const auto only = std::find(borders.cut.begin() + begin, borders.cut.begin() + end, true) - borders.cut.begin();
      int opposite = begin + (static_cast<int>(only) - begin + size / 2) % size;
      while (borders.whole[static_cast<std::size_t>(opposite)]) opposite = borders.next(opposite);
      cut_at(borders, opposite);
    }
  }
}

}  // namespace

void cut_at(BorderSegments& borders, int segment) {
  std::vector<int> waiting = {segment};
  while (!waiting.empty()) {
    const int i = waiting.back();
    waiting.pop_back();
    if (borders.cut[static_cast<std::size_t>(i)]) continue;
    borders.cut[static_cast<std::size_t>(i)] = true;
    for (const int j : across_start(borders, i)) waiting.push_back(j);
  }
}

int BorderSegments::next(int i) const {
  const auto p = static_cast<std::size_t>(island[static_cast<std::size_t>(i)]);
  return i + 1 == first[p + 1] ? first[p] : i + 1;
}

int BorderSegments::previous(int i) const {
  const auto p = static_cast<std::size_t>(island[static_cast<std::size_t>(i)]);
  return i == first[p] ? first[p + 1] - 1 : i - 1;
}

BorderSegments border_segments(const ObjIslands& islands) {
  BorderSegments borders;
  borders.first.push_back(0);
  for (std::size_t p = 0; p < islands.islands.size(); ++p) {
    for (const int v : islands.islands[p].outline) {
      borders.start.push_back(v);
      borders.island.push_back(static_cast<int>(p));
    }
    borders.first.push_back(borders.size());
  }
  borders.mate.assign(borders.start.size(), -1);
  borders.same_way.assign(borders.start.size(), false);
  borders.cut.assign(borders.start.size(), false);
  borders.whole.assign(borders.start.size(), false);
  return borders;
}

void find_mates(const ObjTextured& obj, const ObjIslands& islands, double tolerance, BorderSegments& borders) {
  const std::vector<int> place = places(obj, islands, borders, tolerance);
  std::map<std::pair<int, int>, std::vector<int>> by_ends;
  for (int i = 0; i < borders.size(); ++i) {
    const int a = place[static_cast<std::size_t>(i)], b = place[static_cast<std::size_t>(borders.next(i))];
    if (a != b) by_ends[std::minmax(a, b)].push_back(i);
  }
  // More than two borders in one place: only two can be sewn to each other; opposite ways first, as cloth lies.
  const auto way = [&](int i) {
    return place[static_cast<std::size_t>(i)] < place[static_cast<std::size_t>(borders.next(i))];
  };
  for (const auto& [ends, segments] : by_ends) {
    if (segments.size() < 2) continue;
    std::size_t other = 1;
    for (std::size_t k = segments.size() - 1; k > 0; --k)
      if (way(segments[k]) != way(segments[0])) other = k;
    const int i = segments[0], j = segments[other];
    borders.mate[static_cast<std::size_t>(i)] = j;
    borders.mate[static_cast<std::size_t>(j)] = i;
    borders.same_way[static_cast<std::size_t>(i)] = borders.same_way[static_cast<std::size_t>(j)] = way(i) == way(j);
  }
}

OutlineEdges cut_outlines(const ObjIslands& islands, BorderSegments& borders) {
  for (int i = 0; i < borders.size(); ++i)
    if (!borders.whole[static_cast<std::size_t>(i)] &&
        (turn_at(islands, borders, i) > kCornerTurn || !mates_continue(borders, i)))
      cut_at(borders, i);
  cut_round_outlines(borders);

  OutlineEdges edges;
  auto& side_of = edges.side_of_segment;
  side_of.resize(borders.start.size());
  edges.edge_vertices.resize(islands.islands.size());
  for (std::size_t p = 0; p < islands.islands.size(); ++p) {
    int begin = borders.first[p];
    while (!borders.cut[static_cast<std::size_t>(begin)]) ++begin;
    int i = begin;
    do {
      const SeamSide side{PanelId(static_cast<int>(p)), static_cast<int>(edges.edge_vertices[p].size())};
      auto& vertices = edges.edge_vertices[p].emplace_back();
      do {
        vertices.push_back(borders.start[static_cast<std::size_t>(i)]);
        side_of[static_cast<std::size_t>(i)] = side;
        i = borders.next(i);
      } while (!borders.cut[static_cast<std::size_t>(i)]);
      vertices.push_back(borders.start[static_cast<std::size_t>(i)]);
    } while (i != begin);
  }
  for (int i = 0; i < borders.size(); ++i) {
    const int mate = borders.mate[static_cast<std::size_t>(i)];
    if (!borders.cut[static_cast<std::size_t>(i)] || mate < 0) continue;
    const SeamSide a = side_of[static_cast<std::size_t>(i)], b = side_of[static_cast<std::size_t>(mate)];
    const bool first = a.panel < b.panel || (a.panel == b.panel && a.edge < b.edge);
    if (first) edges.seams.push_back({a, b, borders.same_way[static_cast<std::size_t>(i)]});
  }
  return edges;
}

}  // namespace toile
