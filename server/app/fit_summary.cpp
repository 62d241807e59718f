// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/fit_summary.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace toile::app {

using nlohmann::json;

std::map<std::string, double> fit_by_zone(const Bytes& result_json) {
  const json result = json::parse(result_json, nullptr, false);
  std::map<std::string, double> zones;
  if (!result.is_object() || !result.contains("fits")) return zones;
  const json& fits = result["fits"];
  for (const char* stage : {"after", "ideal", "before"}) {
    if (!fits.contains(stage)) continue;
    for (const json& zone : fits[stage].value("zones", json::array())) {
      const json difference = zone.value("difference", json::object());
      const double weft = difference.value("mean_weft", 0.0), warp = difference.value("mean_warp", 0.0);
      zones[zone.value("zone", "whole")] = std::abs(weft) > std::abs(warp) ? weft : warp;
    }
    break;
  }
  return zones;
}

}  // namespace toile::app
