// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/pipeline_inputs.h"

#include "engine/core/content_hash.h"
#include "engine/stages/find_skeleton.h"
#include "engine/stages/import_pattern.h"
#include "engine/stages/make_form.h"
#include "engine/stages/measure_body.h"

namespace toile {
namespace {

constexpr std::string_view kBuiltin = "builtin:";

}  // namespace

std::string input_key(const GarmentInput& garment) {
  return ContentHash().add("garment").add(garment.bytes).hex();
}

std::string input_key(const BodyInput& body) {
  ContentHash hash;
  hash.add("body").add(body.bytes).add(body.import.kind);
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
  if (body.name.starts_with(kBuiltin)) return make_builtin_form(std::string_view(body.name).substr(kBuiltin.size()));
  Body imported = import_body(body.bytes, body.name, body.import).body;
  if (imported.kind == BodyKind::Human) {
    imported.skeleton = find_skeleton(imported.surface).skeleton;
    MeasureBodyResult measured = measure_body(imported.surface, *imported.skeleton);
    imported.landmarks = std::move(measured.landmarks);
    imported.measurements = std::move(measured.measurements);
  }
  return imported;
}

}  // namespace toile
