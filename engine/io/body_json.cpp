// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/io/body_json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "engine/core/units.h"
#include "engine/io/json.h"

namespace toile {

namespace {

constexpr std::size_t kMaxNames = 500;   // landmarks or measurements of one document
constexpr double kMaxLandmark = 1e5;     // as for mesh files
constexpr double kMaxMeasurement = 5.0;  // m: no tape measure of a person is longer

// Runs `read` on the parsed document; refusals name the file and the JSON pointer.
template <class Read>
auto read_document(std::span<const std::uint8_t> bytes, const std::string& subject, Read read) {
  try {
    const nlohmann::json document = parse_json(bytes, {});
    return read(JsonView(document));
  } catch (const Error& error) {
    throw Error(error.code, subject, (error.subject.empty() ? "" : error.subject + ": ") + error.message);
  }
}

std::vector<double> coordinates(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Landmarks read_points(const JsonView& object) {
  const auto members = object.members();
  if (members.size() > kMaxNames)
    object.fail("more than 500 landmarks; give those of the body only", ErrorCode::LimitExceeded);
  Landmarks points;
  for (const auto& [name, value] : members) {
    if (!value.is_array() || value.size() != 3) value.fail("a landmark is [x, y, z]");
    for (std::size_t k = 0; k < 3; ++k)
      points[name][static_cast<int>(k)] = value.at(k).number(-kMaxLandmark, kMaxLandmark);
  }
  return points;
}

}  // namespace

Record describe_body(const Body& body) {
  Record measurements, landmarks;
  for (const auto& [name, value] : body.measurements) measurements.add(name, value);
  for (const auto& [name, point] : body.landmarks) landmarks.add(name, coordinates(point));
  std::vector<std::vector<double>> rows(4);
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) rows[static_cast<std::size_t>(r)].push_back(body.normalised_from_file(r, c));
  Record record;
  record.add("name", body.name)
      .add("kind", body.kind == BodyKind::Human ? "human" : "form")
      .add("normalised_from_file", std::move(rows))
      .add("measurements_m", std::move(measurements))
      .add("landmarks_m", std::move(landmarks));
  return record;
}

GivenLandmarks read_landmarks(std::span<const std::uint8_t> bytes, const std::string& subject) {
  return read_document(bytes, subject, [](const JsonView& root) {
    GivenLandmarks given;
    const auto normalised = root.find("landmarks_m");
    given.in_file_frame = !normalised;
    const auto in_file = root.find("landmarks");
    if (!normalised && !in_file)
      root.fail(
          "no landmarks; give \"landmarks\" in the frame of the body's file, or \"landmarks_m\" as toile body prints");
    given.points = read_points(normalised ? *normalised : *in_file);
    return given;
  });
}

Landmarks normalised_landmarks(const GivenLandmarks& given, const Mat4& normalised_from_file) {
  Landmarks points = given.points;
  if (given.in_file_frame)
    for (auto& [name, point] : points) point = (normalised_from_file * point.homogeneous()).head<3>();
  return points;
}

MeasurementsDocument read_measurements(std::span<const std::uint8_t> bytes, const std::string& subject) {
  return read_document(bytes, subject, [](const JsonView& root) {
    if (root.find("pattern"))
      root.fail("this is a garment; a body is a mesh, or tape measures as {\"measurements_cm\": {\"height\": 168}}");
    root.require_only({"schema", "figure", "measurements_m", "measurements_cm"});
    MeasurementsDocument document;
    if (const auto figure = root.find("figure")) document.figure = figure->text();
    const auto metres = root.find("measurements_m");
    const double unit = metres ? 1.0 : kMetrePerCm;
    const JsonView object = metres ? *metres : root.at("measurements_cm");
    const auto members = object.members();
    if (members.size() > kMaxNames) object.fail("more than 500 measurements", ErrorCode::LimitExceeded);
    for (const auto& [name, value] : members)
      document.measurements[name] = unit * value.number(0.0, kMaxMeasurement / unit);
    return document;
  });
}

}  // namespace toile
