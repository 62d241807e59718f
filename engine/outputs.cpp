// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/outputs.h"

#include <algorithm>
#include <functional>

#include "engine/core/content_hash.h"
#include "engine/draw_alterations.h"
#include "engine/io/drape_obj.h"
#include "engine/io/options_json.h"
#include "engine/io/pdf.h"
#include "engine/io/record_json.h"
#include "engine/io/svg.h"
#include "engine/render/drawing_picture.h"
#include "engine/render/png.h"
#include "engine/result_records.h"
#include "engine/stages/render_views.h"

namespace toile {
namespace {

constexpr const char* kJson = "application/json";
constexpr const char* kObj = "model/obj";
constexpr const char* kPng = "image/png";

// Files that are asked for, in the order they are made.
class Outputs {
 public:
  explicit Outputs(const AlterOptions& options) : wanted_(options.outputs) {}

  void make(const std::string& name, const char* type, const std::function<Bytes()>& work) {
    const bool all = std::find(wanted_.begin(), wanted_.end(), "all") != wanted_.end();
    if (all || std::find(wanted_.begin(), wanted_.end(), name) != wanted_.end()) files_.push_back({name, type, work()});
  }
  // result.json is always made, last: it lists the others.
  std::vector<OutputFile> finish(Record result) {
    std::vector<Record> listed;
    for (const OutputFile& file : files_) {
      Record entry;
      entry.add("name", file.name).add("bytes", static_cast<std::int64_t>(file.bytes.size()));
      listed.push_back(std::move(entry.add("sha256", sha256_hex(file.bytes))));
    }
    result.add("files", std::move(listed));
    files_.push_back({"result.json", kJson, write_json(result)});
    return std::move(files_);
  }

 private:
  std::vector<std::string> wanted_;
  std::vector<OutputFile> files_;
};

Record input_record(const std::string& name, const std::string& sha256) {
  return Record().add("name", name).add("sha256", sha256);
}

Record head_record(const char* kind, const AlterOptions& options, const JobInfo& info) {
  Record inputs;
  inputs.add("garment", input_record(info.garment, info.garment_sha256));
  inputs.add("reference_body", input_record(info.reference_body, info.reference_body_sha256));
  if (!info.target_body.empty()) inputs.add("target_body", input_record(info.target_body, info.target_body_sha256));
  Record record;
  record.add("schema", "toile/result/1").add("status", "done").add("kind", kind).add("toile_version", TOILE_VERSION);
  record.add("inputs", std::move(inputs)).add("options", io::options_record(options));
  return record;
}

// One frame and one scale for all pictures of a job that are compared.
ViewOptions views_of(const char* title) {
  ViewOptions views;
  views.title = title;
  views.marks = 3;
  return views;
}

}  // namespace

std::vector<OutputFile> drape_outputs(const DrapedGarment& draped, const AlterOptions& options, const JobInfo& info) {
  Outputs outputs(options);
  outputs.make("drape.obj", kObj, [&] { return io::write_drape_obj(draped.pattern, draped.mesh, draped.drape.drape); });
  outputs.make("fit.png", kPng, [&] {
    return render_views(&draped.body.surface, &draped.mesh, &draped.drape.drape, &draped.fit, views_of("fit"));
  });
  Record result = head_record("drape", options, info);
  result.add("quality", quality_record(draped.drape.quality))
      .add("drape", drape_record(draped.drape))
      .add("body", body_record(draped.body));
  return outputs.finish(std::move(result));
}

std::vector<OutputFile> alter_outputs(const AlterResult& r, const AlterOptions& options, const JobInfo& info) {
  const Pattern& pattern = r.reference.pattern;
  const PatternMesh& mesh = r.reference.mesh;
  const TriangleMesh& wearer = r.reference.body.surface;
  Outputs outputs(options);
  outputs.make("reference_drape.obj", kObj,
               [&] { return io::write_drape_obj(pattern, mesh, r.reference.drape.drape); });
  outputs.make("target_before.obj", kObj, [&] { return io::write_drape_obj(pattern, mesh, r.before.drape); });
  outputs.make("fit_reference.png", kPng, [&] {
    return render_views(&wearer, &mesh, &r.reference.drape.drape, &r.reference.fit, views_of("reference"));
  });
  outputs.make("fit_before.png", kPng, [&] {
    return render_views(&r.target_body.surface, &mesh, &r.before.drape, &r.fit_before, views_of("before"));
  });

  const Drawing drawing = draw_alterations(pattern, r.altered);
  outputs.make("altered_pattern.svg", "image/svg+xml", [&] { return io::write_svg(drawing); });
  outputs.make("altered_pattern.pdf", "application/pdf", [&] { return io::write_pdf(drawing); });
  outputs.make("pattern.png", kPng, [&] { return write_png(draw_picture(drawing)); });

  const std::vector<BodyZone> zones = body_zones(pattern, mesh, r.reference.drape.drape, r.reference.body);
  const auto fit = [&](const FittingMap& map) {
    return fit_record(pattern, compare_fits(mesh, r.reference.fit, map, {}, zones));
  };
  Record fits;
  fits.add("before", fit(r.fit_before)).add("ideal", fit(r.derived.fit));
  Record stages;
  stages.add("reference_drape", drape_record(r.reference.drape))
      .add("register_bodies", r.registration.diagnostics)
      .add("transport_garment", r.transported.diagnostics)
      .add("target_drape_before", drape_record(r.before))
      .add("derive_pattern", derivation_record(r.derived))
      .add("alter_pattern", alteration_record(r.altered));
  Record bodies;
  bodies.add("reference", body_record(r.reference.body)).add("target", body_record(r.target_body));
  Record result = head_record("alter", options, info);
  result.add("fits", std::move(fits)).add("stages", std::move(stages)).add("bodies", std::move(bodies));
  return outputs.finish(std::move(result));
}

OutputFile timings_output(const std::vector<StageTiming>& timings) {
  std::vector<Record> stages;
  double cpu = 0.0, wall = 0.0;
  for (const StageTiming& timing : timings) {
    cpu += timing.cpu_s;
    wall += timing.wall_s;
    Record stage;
    stage.add("stage", timing.stage).add("cpu_s", timing.cpu_s).add("wall_s", timing.wall_s);
    stages.push_back(std::move(stage.add("reused", timing.reused)));
  }
  Record record;
  record.add("schema", "toile/timings/1").add("cpu_s", cpu).add("wall_s", wall).add("stages", std::move(stages));
  return {"timings.json", kJson, write_json(record)};
}

}  // namespace toile
