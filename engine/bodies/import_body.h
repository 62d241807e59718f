// SPDX-License-Identifier: GPL-3.0-or-later
// Take in a body: read the file, make its surface one closed oriented skin, and bring it into the normalised frame.
//
// read -> weld, cut tangles, orient, drop specks (clean_mesh) -> stand, scale, face front (normalise_body)
//      -> close the holes, the soles flat on the floor (close_holes) -> orient outward
// A surface that is closed and stands in the frame already keeps its vertices, triangles and coordinates.
// Source: shared design page "registration", section 1.1. File units in, metres out.
#pragma once

#include <span>

#include "engine/bodies/normalise_body.h"
#include "engine/core/progress.h"
#include "engine/core/record.h"
#include "engine/geometry/clean_mesh.h"
#include "engine/geometry/close_holes.h"

namespace toile {

struct ImportBodyOptions {
  BodyKind kind = BodyKind::Human;      // Form: any closed upright shape, taken as it stands
  std::optional<LengthUnit> unit = {};  // of the file; empty: found from the height
  std::optional<UpAxis> up = {};        // of the file; empty: found from the slices (a form: +Y)
};

// What had to be mended. All zeros and no holes: nothing.
struct BodyRepairs {
  CleanMeshReport cleaning;
  int turned_triangles = 0;       // of pieces that were inside out as a whole
  std::vector<ClosedHole> holes;  // lengths in metres, normalised frame

  int hole_edges() const;
  int added_vertices() const;
  int added_triangles() const;
};

struct ImportBodyResult {
  Body body;  // surface, kind, name and transform; skeleton, landmarks and measurements are later stages' work
  BodyRepairs repairs;
  NormaliseBodyResult normalisation;  // its surface is moved into the body
  int file_vertices = 0, file_triangles = 0;
};

// `name` is the subject of errors about the file and becomes the body's name.
// Ensures: a closed, consistently oriented two-manifold of positive volume in every piece.
// Throws FormatUnknown, FileMalformed, LimitExceeded (read_mesh), BodyUnusable, BodyNotRecognised, Cancelled.
ImportBodyResult import_body(std::span<const std::uint8_t> bytes, const std::string& name,
                             const ImportBodyOptions& options = {}, Progress* progress = nullptr);
// The same from triangles already read.
ImportBodyResult import_body(TriangleMesh in_file, const std::string& name, const ImportBodyOptions& options = {},
                             Progress* progress = nullptr);

// The skin as it was scanned, without what closes its holes: BodyRepairs::added_triangles of them, which come last.
// A registered body bridges holes better than a patch does.
Body without_patches(const Body& body, int patch_triangles);

// For documents: every repair by name with its count, and each hole.
Record describe_repairs(const BodyRepairs& repairs);
// Unit, axis, turn and warnings of the normalisation.
Record describe_normalisation(const NormaliseBodyResult& normalisation);

}  // namespace toile
