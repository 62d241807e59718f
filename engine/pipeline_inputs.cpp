// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/pipeline_inputs.h"

#include "engine/core/content_hash.h"
#include "engine/core/error.h"
#include "engine/io/body_json.h"
#include "engine/stages/find_skeleton.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/make_form.h"
#include "engine/stages/measure_body.h"

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

}  // namespace

std::string input_key(const GarmentInput& garment) {
  return ContentHash().add("garment").add(garment.bytes).hex();
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
  Pattern pattern = import_pattern(garment.bytes);
  if (pattern.name.empty()) pattern.name = garment.name;
  return pattern;
}

Body read_body(const BodyInput& body) {
  return take_in_body(body).body;
}

ImportBodyResult take_in_body(const BodyInput& input, Progress* progress) {
  if (input.name.starts_with(kBuiltin)) {
    ImportBodyResult result;
    result.body = make_builtin_form(std::string_view(input.name).substr(kBuiltin.size()));
    result.file_vertices = result.body.surface.vertex_count();
    result.file_triangles = result.body.surface.triangle_count();
    return result;
  }
  ImportBodyResult result = import_body(input.bytes, input.name, input.import, progress);
  if (!input.landmarks.empty())
    result.body.landmarks = normalised_landmarks(read_landmarks(input.landmarks, input.name + " landmarks"),
                                                 result.body.normalised_from_file);
  if (result.body.kind == BodyKind::Human) measure(result.body);
  return result;
}

}  // namespace toile
