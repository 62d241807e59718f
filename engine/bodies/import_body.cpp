// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/bodies/import_body.h"

#include "engine/core/error.h"
#include "engine/core/units.h"
#include "engine/geometry/half_edges.h"
#include "engine/io/mesh_file.h"

namespace toile {

namespace {

// Stages speak of "body"; here it is known which file that was.
NormaliseBodyResult normalise_named(const TriangleMesh& mesh, const std::string& name,
                                    const ImportBodyOptions& options) {
  try {
    return normalise_body(mesh, {.kind = options.kind, .unit = options.unit, .up = options.up});
  } catch (const Error& error) {
    throw Error(error.code, name, error.message);
  }
}

void require_closed(const TriangleMesh& mesh, const std::string& name) {
  const SurfaceDefects defects = find_defects(mesh.vertex_count(), mesh.triangles);
  if (mesh.triangle_count() > 0 && defects.none()) return;
  throw Error(ErrorCode::BodyUnusable, name,
              "the surface could not be closed (" + std::to_string(defects.open_edges) + " open edges, " +
                  std::to_string(defects.tangled_edges) +
                  " edges of more than two triangles are left); close it in a " + "modelling program, or scan again");
}

}  // namespace

int BodyRepairs::hole_edges() const {
  int sum = 0;
  for (const ClosedHole& hole : holes) sum += hole.edges;
  return sum;
}

int BodyRepairs::added_vertices() const {
  int sum = cleaning.split_vertices;
  for (const ClosedHole& hole : holes) sum += hole.added_vertices;
  return sum;
}

int BodyRepairs::added_triangles() const {
  int sum = 0;
  for (const ClosedHole& hole : holes) sum += hole.added_triangles;
  return sum;
}

ImportBodyResult import_body(std::span<const std::uint8_t> bytes, const std::string& name,
                             const ImportBodyOptions& options, Progress* progress) {
  report(progress, "import_body", 0.0);
  return import_body(read_mesh(bytes, name), name, options, progress);
}

ImportBodyResult import_body(TriangleMesh in_file, const std::string& name, const ImportBodyOptions& options,
                             Progress* progress) {
  report(progress, "import_body", 0.2);
  ImportBodyResult result;
  result.file_vertices = in_file.vertex_count();
  result.file_triangles = in_file.triangle_count();
  result.repairs.cleaning = clean_mesh(in_file);
  if (in_file.triangle_count() == 0)
    throw Error(ErrorCode::BodyUnusable, name,
                "no usable surface is left after removing broken triangles; export the body as one connected mesh");
  result.repairs.turned_triangles = orient_outward(in_file);
  report(progress, "import_body", 0.4);

  result.normalisation = normalise_named(in_file, name, options);
  report(progress, "import_body", 0.7);

  Body& body = result.body;
  body.name = name;
  body.kind = options.kind;
  body.normalised_from_file = result.normalisation.normalised_from_file;
  body.surface = std::move(result.normalisation.surface);
  result.normalisation.surface = {};
  result.repairs.holes = close_holes(body.surface, {.lowest_y = 0.0}, progress);
  result.repairs.turned_triangles += orient_outward(body.surface);
  require_closed(body.surface, name);
  report(progress, "import_body", 1.0);
  return result;
}

Body without_patches(const Body& body, int patch_triangles) {
  Body seen = body;
  if (patch_triangles <= 0 || patch_triangles >= body.surface.triangle_count()) return seen;
  seen.surface.triangles = body.surface.triangles.topRows(body.surface.triangle_count() - patch_triangles);
  seen.surface.vertices = body.surface.vertices.topRows(seen.surface.triangles.maxCoeff() + 1);  // patches' come last
  return seen;
}

Record describe_repairs(const BodyRepairs& repairs) {
  const CleanMeshReport& cleaning = repairs.cleaning;
  std::vector<Record> holes;
  for (const ClosedHole& hole : repairs.holes) {
    holes.emplace_back();
    holes.back()
        .add("edges", hole.edges)
        .add("perimeter_m", hole.perimeter)
        .add("centre_m", std::vector<double>{hole.centre.x(), hole.centre.y(), hole.centre.z()})
        .add("added_vertices", hole.added_vertices)
        .add("added_triangles", hole.added_triangles);
  }
  Record record;
  record.add("repeated_corners", cleaning.repeated_corners)
      .add("duplicate_triangles", cleaning.duplicate_triangles)
      .add("welded_vertices", cleaning.welded_vertices)
      .add("tangled_triangles", cleaning.tangled_triangles)
      .add("one_sided_triangles", cleaning.one_sided_triangles)
      .add("pinched_triangles", cleaning.pinched_triangles)
      .add("split_vertices", cleaning.split_vertices)
      .add("specks", cleaning.specks)
      .add("speck_triangles", cleaning.speck_triangles)
      .add("slivers", cleaning.slivers)
      .add("flipped_triangles", cleaning.flipped_triangles + repairs.turned_triangles)
      .add("unused_vertices", cleaning.unused_vertices)
      .add("closed_holes", static_cast<int>(repairs.holes.size()))
      .add("holes", std::move(holes));
  return record;
}

Record describe_normalisation(const NormaliseBodyResult& normalisation) {
  Record record;
  record.add("unit", std::string(unit_name(normalisation.unit)))
      .add("up", std::string(up_name(normalisation.up)))
      .add("up_score", normalisation.up_score)
      .add("yaw_deg", normalisation.yaw * kDegreePerRadian)
      .add("front", normalisation.front)
      .add("mirror_residual_mm", normalisation.mirror_residual * kMmPerMetre)
      .add("kept_coordinates", normalisation.kept_coordinates)
      .add("warnings", normalisation.warnings);
  return record;
}

}  // namespace toile
