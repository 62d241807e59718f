// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/sidecar.h"

#include <nlohmann/json.hpp>

#include "tests/support/shared_data.h"

namespace toile::test {
namespace {

nlohmann::json load(const std::string& file) {
  return nlohmann::json::parse(read_file(shared_data(file)));
}

Vec3 point(const nlohmann::json& j) {
  return Vec3(j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>());
}


}  // namespace

BodySidecar load_body_sidecar(const std::string& name) {
  const nlohmann::json j = load("bodies/" + name + ".json");
  BodySidecar out;
  for (const auto& [key, value] : j.at("measurements_m").items())
    if (value.is_number()) out.measurements[key] = value.get<double>();
  for (const auto& [key, value] : j.at("measurements_m").at("levels").items()) out.levels[key] = value.get<double>();
  for (const auto& [key, value] : j.at("landmarks").items()) {
    out.landmark_vertex[key] = value.at("vertex").get<int>();
    out.landmarks[key] = point(value.at("position"));
  }
  return out;
}

ScanSidecar load_scan_sidecar(const std::string& name) {
  const nlohmann::json j = load("scans/" + name + ".json");
  ScanSidecar out;
  out.source_body = j.at("source_body").get<std::string>();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) out.scan_from_body(r, c) = j.at("transform_body_m_to_scan").at(r).at(c).get<double>();
  const Mat4 body_from_scan = out.scan_from_body.inverse();
  for (const auto& [key, value] : j.at("landmarks").items())
    out.landmarks[key] = (body_from_scan * point(value.at("scan_position")).homogeneous()).head<3>();
  return out;
}

}  // namespace toile::test
