// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/stages/import_pattern.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/geometry/curve.h"
#include "engine/io/garmentcode_json.h"
#include "engine/io/json.h"
#include "engine/io/obj_garment.h"
#include "engine/stages/outline_crossing.h"

namespace toile {

namespace {

std::string panel_pointer(const Panel& panel) {
  return "/pattern/panels" + pointer_step(panel.name);
}
std::string edge_pointer(const Panel& panel, int edge) {
  return panel_pointer(panel) + "/edges/" + std::to_string(edge);
}

std::string centimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g cm", metres * 100.0);
  return text;
}

bool all_finite(const Panel& panel) {
  for (int e = 0; e < panel.edge_count(); ++e) {
    const EdgeCurve& curve = panel.edges[static_cast<std::size_t>(e)].curve;
    if (!panel.edge_start(e).allFinite() || !curve.control[0].allFinite() || !curve.control[1].allFinite() ||
        !std::isfinite(curve.radius))
      return false;
    for (const Vec2& point : curve.points)
      if (!point.allFinite()) return false;
  }
  return panel.rotation.allFinite() && panel.translation.allFinite();
}

void check_edges(const Panel& panel) {
  for (int e = 0; e < panel.edge_count(); ++e) {
    const Curve curve = edge_curve(panel, e);
    if ((curve.end - curve.start).norm() < kShortestEdge)
      throw Error(ErrorCode::GarmentInvalid, edge_pointer(panel, e),
                  "edge " + std::to_string(e) + " of panel \"" + panel.name + "\" starts and ends at the same point (" +
                      centimetres((curve.end - curve.start).norm()) + " apart); remove it or split the curve");
  }
}

void check_simple(const Panel& panel, CrossingWork& work) {
  const auto crossing = find_outline_crossing(panel, work);
  if (work.comparisons_left < 0)
    throw Error(ErrorCode::LimitExceeded, panel_pointer(panel),
                "the outline of panel \"" + panel.name +
                    "\" is too intricate to be checked; draw it with fewer edges and points");
  if (!crossing) return;
  throw Error(ErrorCode::GarmentInvalid, edge_pointer(panel, crossing->second_edge),
              "the outline of panel \"" + panel.name + "\" crosses or touches itself: edge " +
                  std::to_string(crossing->first_edge) + " and edge " + std::to_string(crossing->second_edge) +
                  " meet near (" + centimetres(crossing->place.x()) + ", " + centimetres(crossing->place.y()) +
                  "); move the corners or curve points apart");
}

void check_panel(const Panel& panel, CrossingWork& work) {
  if (panel.edge_count() < 2 || panel.corners.size() != panel.edges.size())
    throw Error(ErrorCode::GarmentInvalid, panel_pointer(panel),
                "panel \"" + panel.name + "\" needs at least two edges");
  if (panel.edge_count() > kMaxEdgesPerPanel)
    throw Error(ErrorCode::LimitExceeded, panel_pointer(panel),
                "panel \"" + panel.name + "\" has more than 2,000 edges; draw curves as curves");
  if (!all_finite(panel))
    throw Error(ErrorCode::GarmentInvalid, panel_pointer(panel),
                "panel \"" + panel.name + "\" has a coordinate that is not a finite number; correct it");
  check_edges(panel);
  check_simple(panel, work);
  const double area = std::abs(outline_signed_area(panel));
  if (!(area >= kSmallestPanel))
    throw Error(
        ErrorCode::GarmentInvalid, panel_pointer(panel),
        "panel \"" + panel.name + "\" is degenerate: it encloses less than 0.1 cm2; remove it or correct its vertices");
}

void check_seams(const Pattern& pattern) {
  std::map<std::pair<int, int>, std::size_t> seam_of_edge;
  for (std::size_t s = 0; s < pattern.seams.size(); ++s) {
    const Seam& seam = pattern.seams[s];
    const std::string pointer = "/pattern/stitches/" + std::to_string(s);
    int side_number = 0;
    for (const SeamSide& side : {seam.a, seam.b}) {
      const std::string side_pointer = pointer + "/" + std::to_string(side_number++);
      if (side.panel.value < 0 || side.panel.value >= static_cast<int>(pattern.panels.size()) || side.edge < 0 ||
          side.edge >= pattern.panel(side.panel).edge_count())
        throw Error(ErrorCode::SeamInvalid, side_pointer,
                    "the stitch names an edge that is not there; correct panel and edge");
      const auto [place, fresh] = seam_of_edge.emplace(std::pair(side.panel.value, side.edge), s);
      if (!fresh)
        throw Error(ErrorCode::SeamInvalid, side_pointer,
                    "edge " + std::to_string(side.edge) + " of panel \"" + pattern.panel(side.panel).name +
                        "\" is already sewn by stitch " + std::to_string(place->second) +
                        "; sew each edge once, split it if two pieces meet there");
    }
  }
}

bool is_blank(std::span<const std::uint8_t> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t c) { return c <= ' '; });
}

}  // namespace

void validate_pattern(const Pattern& pattern) {
  if (pattern.panels.empty())
    throw Error(ErrorCode::GarmentInvalid, "/pattern/panels", "the pattern has no panel; add at least one");
  if (pattern.panels.size() > kMaxPanels)
    throw Error(ErrorCode::LimitExceeded, "/pattern/panels", "a pattern may have at most 200 panels");
  CrossingWork work = crossing_work(pattern);
  for (const Panel& panel : pattern.panels) check_panel(panel, work);
  check_seams(pattern);
}

Pattern import_pattern(std::span<const std::uint8_t> bytes, Progress* progress) {
  report(progress, "import_pattern", 0.0);
  Pattern pattern = read_garmentcode(bytes);
  validate_pattern(pattern);
  report(progress, "import_pattern", 1.0);
  return pattern;
}

ImportedGarment import_garment(std::span<const std::uint8_t> bytes, const std::string& name,
                               const ImportGarmentOptions& options, Progress* progress) {
  if (is_blank(bytes)) throw Error(ErrorCode::FileMalformed, name, "the file is empty; export the garment again");
  if (looks_like_json(bytes)) return {import_pattern(bytes, progress), {}, {}};
  report(progress, "import_pattern", 0.0);
  ObjGarment garment = read_obj_garment(bytes, name, {options.metre_per_uv_unit, options.sidecar});
  validate_pattern(garment.pattern);
  report(progress, "import_pattern", 1.0);
  return {std::move(garment.pattern), std::move(garment.mesh), std::move(garment.drape)};
}

}  // namespace toile
