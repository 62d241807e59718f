// SPDX-License-Identifier: GPL-3.0-or-later
// What a user hands in: bytes and how to read them.
#pragma once

#include "engine/bodies/import_body.h"
#include "engine/core/archive_values.h"
#include "engine/core/drape.h"
#include "engine/core/fitting_map.h"
#include "engine/core/pattern.h"
#include "engine/core/pattern_mesh.h"
#include "engine/core/types.h"

namespace toile {

struct GarmentInput {
  std::string name;  // of the file, for messages and documents
  Bytes bytes;       // GarmentCode specification, or an OBJ whose texture coordinates are the pattern
  std::optional<double> metre_per_uv_unit = {};  // of an OBJ; empty: found
  Bytes sidecar = {};                            // JSON beside an OBJ (obj_garment.h), or empty
  bool keep_drape = false;                       // take the positions of an OBJ as the drape, unmoved
  Bytes worn = {};  // beside a specification: how it hangs and the fit it was derived for (worn_garment.h), or empty
};

struct BodyInput {
  std::string name;  // of the file, or "builtin:NAME" with no bytes
  Bytes bytes;       // OBJ, PLY or STL, or a measurements document (body_json.h) for a mannequin
  ImportBodyOptions import = {};
  Bytes landmarks = {};  // a landmarks document (body_json.h), or empty
};

// Key of an input: the same bytes read the same way have the same key, whatever their name.
std::string input_key(const GarmentInput& garment);
std::string input_key(const BodyInput& body);

// Throw the importers' and make_mannequin's errors; their subject names the input.
Pattern read_garment(const GarmentInput& garment);
// Of an OBJ that is draped, or beside a specification: its mesh, and its positions in the normalised frame of the body
// it is worn by.
std::optional<PatternMesh> read_garment_mesh(const GarmentInput& garment);
std::optional<Drape> read_garment_drape(const GarmentInput& garment, const Body& wearer);
// The fit that is asked for of a garment that was derived from another one, where the file beside it says so.
std::optional<FittingMap> read_garment_fit(const GarmentInput& garment);
Body read_body(const BodyInput& body);
// A body to register to: with how many of its triangles close holes of a scan.
struct TargetBody {
  Body body;
  int patch_triangles = 0;

  Body seen() const { return without_patches(body, patch_triangles); }
};
template <class A>
void archive(A& a, TargetBody& v) {
  a(v.body, v.patch_triangles);
}
TargetBody read_target_body(const BodyInput& body);
// The same with what was mended; a person has a skeleton, landmarks and measurements, a form has none.
ImportBodyResult take_in_body(const BodyInput& body, Progress* progress = nullptr);

// The landmarks handed in with a body, in its normalised frame; empty if there were none.
Landmarks given_landmarks(const BodyInput& input, const Mat4& normalised_from_file);
// Throws Error{BodyUnusable} for one that the reference body does not have: it could not be used. A form has none.
void require_known(const BodyInput& input, const Landmarks& given, const Body& reference);

}  // namespace toile
