// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/pipeline_inputs.h"

#include <cmath>
#include <cstdio>

#include "engine/bodies/find_skeleton.h"
#include "engine/bodies/make_builtin_body.h"
#include "engine/bodies/make_mannequin.h"
#include "engine/bodies/measure_body.h"
#include "engine/core/content_hash.h"
#include "engine/core/error.h"
#include "engine/io/body_json.h"
#include "engine/io/json.h"
#include "engine/io/worn_garment.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/import_pattern.h"

namespace toile {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

// Stages speak of "body"; the user knows it by its file.
void measure(Body& body) {
  try {
    body.skeleton = find_skeleton(body.surface).skeleton;
    MeasureBodyResult measured = measure_body(body.surface, *body.skeleton, body.landmarks);
    body.landmarks = std::move(measured.landmarks);
    body.measurements = std::move(measured.measurements);
  } catch (const Error& error) {
    throw Error(error.code, body.name, error.message);
  }
}

Body make_builtin(const std::string& name) {
  try {
    return make_builtin_body(std::string_view(name).substr(kBuiltin.size()));
  } catch (const Error& error) {
    throw Error(ErrorCode::BodyUnusable, name, error.message);  // a wrong name is bad input, whatever made it fail
  }
}

Figure figure_of(const std::string& name, const std::string& subject) {
  constexpr std::pair<std::string_view, Figure> figures[] = {{"", Figure::Person},
                                                             {"person", Figure::Person},
                                                             {"woman", Figure::Woman},
                                                             {"man", Figure::Man},
                                                             {"child", Figure::Child}};
  for (const auto& [known, figure] : figures)
    if (name == known) return figure;
  throw Error(ErrorCode::FileMalformed, subject, "/figure: one of person, woman, man, child is expected");
}

Body make_measured(const BodyInput& input) {
  const MeasurementsDocument document = read_measurements(input.bytes, input.name);
  try {
    Body body = make_mannequin(document.measurements, {.figure = figure_of(document.figure, input.name)}).body;
    body.name = input.name;
    return body;
  } catch (const Error& error) {
    if (error.code != ErrorCode::OptionInvalid) throw;
    throw Error(ErrorCode::BodyUnusable, input.name, error.subject + ": " + error.message);
  }
}

// A body that came from no mesh file: nothing to mend or to turn.
ImportBodyResult made(Body body) {
  ImportBodyResult result;
  result.file_vertices = body.surface.vertex_count();
  result.file_triangles = body.surface.triangle_count();
  result.normalisation.kept_coordinates = true;
  result.body = std::move(body);
  return result;
}

// What belongs to an OBJ must not be passed over in silence beside a specification.
void require_obj(const GarmentInput& garment) {
  const char* given = garment.metre_per_uv_unit                    ? "uv_unit"
                      : !garment.sidecar.empty()                   ? "seams"
                      : garment.keep_drape && garment.worn.empty() ? "keep_drape"
                                                                   : nullptr;
  if (given)
    throw Error(ErrorCode::OptionInvalid, garment.name,
                std::string(given) + " is for a garment as OBJ, this one is a specification; leave " + given + " out");
}

ImportedGarment take_in_garment(const GarmentInput& garment) {
  if (looks_like_json(garment.bytes)) require_obj(garment);
  try {
    return import_garment(garment.bytes, garment.name, {garment.metre_per_uv_unit, garment.sidecar});
  } catch (const Error& error) {
    // The file, then the place in it where there is one.
    if (error.subject == "garment") throw Error(error.code, garment.name, error.message);
    if (!error.subject.starts_with('/')) throw;
    const bool of_sidecar = !garment.sidecar.empty() && !error.subject.starts_with("/pattern/");
    throw Error(error.code, garment.name + (of_sidecar ? " seams#" : "#") + error.subject, error.message);
  }
}

constexpr double kFarFromBody = 0.3;  // m outside the body's box that no landmark lies

void require_near(const BodyInput& input, const Landmarks& given, const TriangleMesh& surface) {
  const Vec3 low = surface.vertices.colwise().minCoeff(), high = surface.vertices.colwise().maxCoeff();
  for (const auto& [name, point] : given) {
    const double off = std::max((low - point).maxCoeff(), (point - high).maxCoeff());
    if (off <= kFarFromBody) continue;
    char metres[32];
    std::snprintf(metres, sizeof metres, "%.2g m", off);
    throw Error(ErrorCode::BodyUnusable, input.name + " landmarks",
                name + " lies " + metres +
                    " away from the body; \"landmarks\" are in the frame and unit of the body's " +
                    "file, \"landmarks_m\" in the normalised frame in metres");
  }
}

std::optional<WornGarment> read_worn(const GarmentInput& garment) {
  if (garment.worn.empty()) return std::nullopt;
  return read_worn_garment(garment.worn, "worn garment", read_garment(garment));
}

}  // namespace

std::string input_key(const GarmentInput& garment) {
  ContentHash hash;
  hash.add("garment")
      .add(garment.name)  // what a garment without a name of its own is called
      .add(garment.bytes)
      .add(garment.metre_per_uv_unit.value_or(0.0))
      .add(garment.sidecar)
      .add(garment.keep_drape)
      .add(garment.worn);
  return hash.hex();
}

std::string input_key(const BodyInput& body) {
  ContentHash hash;
  hash.add("body").add(body.bytes).add(body.landmarks).add(body.import.kind);
  hash.add(body.import.unit ? static_cast<int>(*body.import.unit) : -1);
  hash.add(body.import.up ? static_cast<int>(*body.import.up) : -1);
  if (body.bytes.empty()) hash.add(body.name);
  return hash.hex();
}

Pattern read_garment(const GarmentInput& garment) {
  Pattern pattern = take_in_garment(garment).pattern;
  if (pattern.name.empty()) pattern.name = garment.name;
  return pattern;
}

std::optional<PatternMesh> read_garment_mesh(const GarmentInput& garment) {
  if (auto worn = read_worn(garment)) return std::move(worn->mesh);
  return take_in_garment(garment).mesh;
}

std::optional<Drape> read_garment_drape(const GarmentInput& garment, const Body& wearer) {
  std::optional<Drape> drape;
  if (auto worn = read_worn(garment))
    drape = std::move(worn->drape);
  else
    drape = take_in_garment(garment).drape;
  if (!drape) return drape;
  // Garment and body come from one scene: the body's turn and shift hold for both; the garment is in metres already.
  const Mat3 linear = wearer.normalised_from_file.topLeftCorner<3, 3>();
  const Mat3 turn = linear / std::cbrt(linear.determinant());
  const Vec3 shift = wearer.normalised_from_file.topRightCorner<3, 1>();
  drape->nodes = ((drape->nodes * turn.transpose()).rowwise() + shift.transpose()).eval();
  return drape;
}

std::optional<FittingMap> read_garment_fit(const GarmentInput& garment) {
  auto worn = read_worn(garment);
  if (!worn || worn->wanted.empty()) return std::nullopt;
  return fitting_map_of(worn->mesh, std::move(worn->wanted));
}

Body read_body(const BodyInput& body) {
  return take_in_body(body).body;
}

TargetBody read_target_body(const BodyInput& body) {
  ImportBodyResult result = take_in_body(body);
  return {std::move(result.body), result.repairs.added_triangles()};
}

Landmarks given_landmarks(const BodyInput& input, const Mat4& normalised_from_file) {
  if (input.landmarks.empty()) return {};
  return normalised_landmarks(read_landmarks(input.landmarks, input.name + " landmarks"), normalised_from_file);
}

ImportBodyResult take_in_body(const BodyInput& input, Progress* progress) {
  const bool builtin = input.name.starts_with(kBuiltin);
  const bool mesh = !builtin && !looks_like_json(input.bytes);
  ImportBodyResult result = mesh ? import_body(input.bytes, input.name, input.import, progress)
                                 : made(builtin ? make_builtin(input.name) : make_measured(input));
  const Landmarks given = given_landmarks(input, result.body.normalised_from_file);
  require_near(input, given, result.body.surface);
  for (const auto& [name, point] : given) result.body.landmarks[name] = point;
  if (mesh && result.body.kind == BodyKind::Human) measure(result.body);
  return result;
}

void require_known(const BodyInput& input, const Landmarks& given, const Body& reference) {
  if (reference.landmarks.empty()) return;
  for (const auto& [name, point] : given) {
    if (reference.landmarks.contains(name)) continue;
    std::string known;
    for (const auto& [other, place] : reference.landmarks) known += (known.empty() ? "" : ", ") + other;
    throw Error(ErrorCode::BodyUnusable, input.name + " landmarks",
                "the reference body has no landmark \"" + name + "\"; it has " + known);
  }
}

}  // namespace toile
