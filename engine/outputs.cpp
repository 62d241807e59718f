// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/outputs.h"

#include <array>
#include <set>

#include "engine/altered_pattern_record.h"
#include "engine/core/content_hash.h"
#include "engine/core/side_by_side.h"
#include "engine/core/units.h"
#include "engine/draw_alteration.h"
#include "engine/draw_tears.h"
#include "engine/io/body_json.h"
#include "engine/io/drape_obj.h"
#include "engine/io/dxf.h"
#include "engine/io/garmentcode_json.h"
#include "engine/io/options_json.h"
#include "engine/io/pdf.h"
#include "engine/io/record_json.h"
#include "engine/io/report_html.h"
#include "engine/io/svg.h"
#include "engine/io/ticket_document.h"
#include "engine/job_report.h"
#include "engine/output_files.h"
#include "engine/render/drawing_picture.h"
#include "engine/render/png.h"
#include "engine/result_records.h"
#include "engine/stage_options.h"
#include "engine/stages/build_fitting_map.h"
#include "engine/stages/draw_pattern.h"
#include "engine/stages/render_views.h"

namespace toile {
namespace {

constexpr const char* kJson = "application/json";
constexpr const char* kObj = "model/obj";
constexpr const char* kPng = "image/png";
constexpr const char* kSvg = "image/svg+xml";
constexpr const char* kHtml = "text/html; charset=utf-8";
// The printed pattern for each kind of printer.
constexpr std::array<std::pair<const char*, PdfSheet>, 4> kPrints = {
    {{"altered_pattern.pdf", PdfSheet::A4},
     {"altered_pattern_letter.pdf", PdfSheet::Letter},
     {"altered_pattern_a0.pdf", PdfSheet::A0},
     {"altered_pattern_projector.pdf", PdfSheet::Projector}}};
const SvgOptions kInlined{.test_square = false, .inlined = true};

Bytes bytes_of(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

InputInfo info_of(const std::string& role, const std::string& name, const Bytes& bytes) {
  return {role, name, bytes.empty() ? std::string() : sha256_hex(bytes)};
}

void add_input(Record& inputs, const InputInfo& info) {
  Record input;
  input.add("name", info.name);
  if (!info.sha256.empty()) input.add("sha256", info.sha256);
  inputs.add(info.role, std::move(input));
}

Record head_record(const char* kind, const AlterOptions& options, const JobInfo& info) {
  Record inputs;
  add_input(inputs, info.garment);
  for (const InputInfo& body : info.bodies) add_input(inputs, body);
  Record record;
  record.add("schema", "toile/result/1").add("status", "done").add("kind", kind).add("toile_version", TOILE_VERSION);
  record.add("inputs", std::move(inputs)).add("options", options_record(options));
  if (const auto error = measured_error(options))
    record.add("accuracy_of_preset", Record()
                                         .add("against", "the same job with 40,000 triangles")
                                         .add("rms_stretch", error->stretch)
                                         .add("rms_position_mm", error->position * kMmPerMetre)
                                         .add("rms_pattern_mm", error->pattern * kMmPerMetre));
  return record;
}

// One scale for all pictures of a job.
ViewOptions views_of(const char* title) {
  ViewOptions views;
  views.view_height = views.max_view_width = 540;  // as wide as a report shows them
  views.title = title;
  views.marks = 3;
  return views;
}

// One frame for the drapes that are compared.
Box frame_of(const std::vector<const Drape*>& drapes) {
  Box frame;
  for (const Drape* drape : drapes) frame.add(drape->nodes);
  frame.grow(ViewOptions().margin);
  return frame;
}

// The ticket under the names the user knows the job's inputs by.
Ticket named_ticket(const AlterResult& result, const JobInfo& info) {
  Ticket ticket = result.altered.ticket;
  ticket.garment = readable_garment_name(result.reference.pattern.name);
  ticket.reference_body = info.bodies.front().name;
  ticket.target_body = info.bodies.back().name;
  return ticket;
}

// The files of one alteration. What several of them show is made once.
class AlterationFiles {
 public:
  AlterationFiles(const AlterResult& result, const AlterOptions& options, const JobInfo& info)
      : r_(result),
        options_(options),
        info_(info),
        files_(options.outputs),
        ticket_(named_ticket(result, info)),
        fits_(compare_job_fits(result)) {
    std::vector<const Drape*> compared = {&r_.reference.drape.drape, &r_.derived.drape.drape};
    if (r_.before) compared.push_back(&r_.before->drape);
    if (fits_.after) compared.push_back(&r_.after->drape.drape);
    frame_ = frame_of(compared);
  }

  std::vector<OutputFile> make(bool at_once) {
    const auto make_others = [this] {
      make_patterns();
      make_ticket();
      make_meshes();
    };
    if (at_once)  // what takes long, in two about equal parts
      side_by_side(
          true, [this] { draw_fits_before(); }, [&] { draw_fits_after(), make_others(); });
    else
      make_others();
    make_pictures();
    files_.make("report.html", kHtml, [this] { return report(); });
    return files_.finish(result());
  }

 private:
  void make_patterns();
  void make_ticket();
  void make_meshes();
  void make_pictures();
  void draw_fits_before();
  void draw_fits_after();
  bool shown(const char* name) const { return files_.wanted(name) || files_.wanted("report.html"); }
  Bytes report();
  Record result() const;
  Bytes picture(const Body& body, const PatternMesh& mesh, const DrapeResult& drape, const FittingMap& fit,
                const FittingMap* reference, const char* title) const;
  Bytes transport_picture() const;

  const AlterResult& r_;
  const AlterOptions& options_;
  const JobInfo& info_;
  OutputFiles files_;
  const Ticket ticket_;
  const JobFits fits_;
  Box frame_;
  OnDemand<Drawing> drawing_{[this] { return draw_alteration(r_.reference.pattern, r_.altered); }};
  OnDemand<Bytes> inlined_{[this] { return write_svg(drawing_.value(), kInlined); }};
  OnDemand<Bytes> fit_reference_{[this] {
    const DrapedGarment& garment = r_.reference;
    return picture(garment.body, garment.mesh, garment.drape, garment.fit, nullptr, "reference");
  }};
  OnDemand<Bytes> fit_before_{[this] {
    return picture(r_.target_body, r_.reference.mesh, *r_.before, r_.fit_before, &r_.reference.fit, "before");
  }};
  OnDemand<Bytes> fit_target_{[this] {
    return picture(r_.target_body, r_.reference.mesh, r_.derived.drape, r_.derived.fit, &r_.reference.fit,
                   "target pattern");
  }};
  OnDemand<Bytes> fit_after_{[this] {
    return picture(r_.target_body, r_.after->mesh, r_.after->drape, r_.after->fit, &r_.after->reference, "after");
  }};
};

// Marks say how much tighter or looser the garment sits than in `reference`, if that is given.
Bytes AlterationFiles::picture(const Body& body, const PatternMesh& mesh, const DrapeResult& drape,
                               const FittingMap& fit, const FittingMap* reference, const char* title) const {
  ViewOptions views = views_of(title);
  views.frame = frame_;
  views.reference = reference;
  return render_views(&body.surface, &mesh, &drape.drape, &fit, views);
}

// The garment as the body map carried it, and as it comes to rest from there. [Eggler2024, Fig. 6]
Bytes AlterationFiles::transport_picture() const {
  ViewOptions views;
  views.frame = frame_;
  views.views = {View::Front, View::Back};
  const auto draw = [&](const Drape& drape, const char* title) {
    views.title = title;
    const FittingMap fit = build_fitting_map(r_.reference.mesh, drape);
    return draw_views(&r_.target_body.surface, &r_.reference.mesh, &drape, &fit, views);
  };
  const Image carried = draw(r_.transported.drape, "carried by the body map"), worn = draw(r_.before->drape, "draped");
  Image both(carried.width + worn.width, std::max(carried.height, worn.height), Rgb{255, 255, 255});
  paste(both, carried, 0, 0);
  paste(both, worn, carried.width, 0);
  return write_png(both);
}

void AlterationFiles::make_patterns() {
  if (!r_.altered.sewn.pieces.empty())
    files_.make("altered_pattern.json", kJson, [this] {
      return bytes_of(write_altered_pattern(r_.altered.sewn.pattern, altered_pattern_record(r_.altered)));
    });
  files_.make("altered_pattern.svg", kSvg, [this] { return write_svg(drawing_.value()); });
  files_.make("altered_pattern.dxf", "image/vnd.dxf", [this] { return write_dxf(drawing_.value()); });
  for (const auto& [name, sheet] : kPrints)
    files_.make(name, "application/pdf", [this, paper = sheet] { return write_pdf(drawing_.value(), {paper, {}}); });
  files_.make("pattern.png", kPng, [this] { return write_png(draw_picture(drawing_.value())); });
  files_.make_if_named("tears.png", kPng, [this] {
    return write_png(picture_of_tears(draw_tears(r_.reference.pattern, r_.reference.mesh, r_.derived.mesh.rest,
                                                 r_.altered, alter_options_of(options_))));
  });
  const Pattern& target = r_.derived.drawn.pattern;
  files_.make("target_pattern.json", kJson, [&] { return bytes_of(write_garmentcode(target)); });
  files_.make("target_pattern.svg", kSvg, [&] { return write_svg(draw_changes(r_.reference.pattern, target)); });
}

void AlterationFiles::make_ticket() {
  files_.make("ticket.json", kJson, [this] { return write_json(ticket_record(ticket_)); });
  files_.make("ticket.html", kHtml, [this] { return write_ticket_html(ticket_, inlined_.value()); });
}

void AlterationFiles::make_meshes() {
  const Pattern& pattern = r_.reference.pattern;
  const PatternMesh& mesh = r_.reference.mesh;
  files_.make("reference_drape.obj", kObj, [&] { return write_drape_obj(pattern, mesh, r_.reference.drape.drape); });
  files_.make("target_worn.obj", kObj, [&] {
    return write_drape_obj(r_.derived.drawn.pattern, r_.derived.mesh, r_.transported.drape, &r_.reference.fit);
  });
  files_.make("target_before.obj", kObj, [&] { return write_drape_obj(pattern, mesh, r_.before->drape); });
  if (fits_.after)
    files_.make("target_after.obj", kObj,
                [this] { return write_drape_obj(r_.altered.sewn.pattern, r_.after->mesh, r_.after->drape.drape); });
}

void AlterationFiles::make_pictures() {
  files_.make("fit_reference.png", kPng, [this] { return fit_reference_.value(); });
  files_.make("fit_before.png", kPng, [this] { return fit_before_.value(); });
  files_.make_if_named("transport.png", kPng, [this] { return transport_picture(); });
  if (fits_.after) {
    files_.make("fit_after.png", kPng, [this] { return fit_after_.value(); });
    files_.make_if_named("fit_target.png", kPng, [this] { return fit_target_.value(); });
  } else {  // the next best that can be shown
    files_.make("fit_target.png", kPng, [this] { return fit_target_.value(); });
  }
}

// The pictures of the fit that a file asked for shows.
void AlterationFiles::draw_fits_before() {
  if (shown("fit_reference.png")) fit_reference_.value();
  if (shown("fit_before.png")) fit_before_.value();
}

void AlterationFiles::draw_fits_after() {
  if (!fits_.after) {
    if (shown("fit_target.png")) fit_target_.value();
    return;
  }
  if (files_.named("fit_target.png")) fit_target_.value();
  if (shown("fit_after.png")) fit_after_.value();
}

Bytes AlterationFiles::report() {
  Report report;
  report.title = ticket_.garment;
  report.subtitle = "from " + ticket_.reference_body + " to " + ticket_.target_body;
  report.summary = summary_sentences(r_, fits_);
  report.ticket = &ticket_;
  report.fits = {{fit_reference_.value(), "On the reference body"},
                 {fit_before_.value(), "On the target body, before alteration"}};
  if (fits_.after)
    report.fits.push_back({fit_after_.value(), "On the target body, after alteration"});
  else
    report.fits.push_back({fit_target_.value(), "On the target body, cut by the target pattern"});
  report.zones = {zone_table(fits_)};
  report.pattern_svg = inlined_.value();
  report.quality = {drape_quality_table(r_)};
  report.findings = r_.altered.flags;
  for (const auto& [name, value] : r_.target_body.measurements) report.measurements.add(name + "_m", value);
  report.options = options_record(options_);
  return write_report_html(report);
}

Record AlterationFiles::result() const {
  const Pattern& pattern = r_.reference.pattern;
  Record compared_fits;
  if (fits_.before) compared_fits.add("before", fit_record(pattern, *fits_.before));
  compared_fits.add("ideal", fit_record(pattern, fits_.ideal));
  if (fits_.after) compared_fits.add("after", fit_record(r_.altered.sewn.pattern, *fits_.after));
  Record quality;
  quality.add("reference_drape", quality_record(r_.reference.drape.quality));
  if (r_.before) quality.add("target_drape_before", quality_record(r_.before->quality));
  quality.add("target_pattern_drape", quality_record(r_.derived.drape.quality))
      .add("altered_place", place_record(r_.place))
      .add("area_imbalance", r_.altered.area_imbalance)
      .add("flags", Record::Value(r_.altered.flags));
  if (fits_.after) quality.add("target_drape_after", quality_record(r_.after->drape.quality));
  Record stages;
  stages.add("reference_drape", drape_record(r_.reference.drape))
      .add("register_bodies", r_.registration.diagnostics)
      .add("transport_garment", r_.transported.diagnostics);
  if (r_.before) stages.add("target_drape_before", drape_record(*r_.before));
  stages.add("derive_pattern", derivation_record(r_.derived))
      .add("fit_pattern_edges", edges_record(r_.derived.drawn))
      .add("alter_pattern", alteration_record(r_.altered));
  if (r_.after) stages.add("drape_altered", after_record(*r_.after));
  Record bodies;
  bodies.add("reference", describe_body(r_.reference.body)).add("target", describe_body(r_.target_body));
  Record result = head_record("alter", options_, info_);
  result.add("quality", std::move(quality))
      .add("alterations", *ticket_record(ticket_).find("operations"))
      .add("fits", std::move(compared_fits))
      .add("stages", std::move(stages))
      .add("bodies", std::move(bodies));
  return result;
}

}  // namespace

JobInfo job_info(const GarmentInput& garment, const BodyInput& body) {
  return {info_of("garment", garment.name, garment.bytes), {info_of("body", body.name, body.bytes)}};
}

JobInfo job_info(const GarmentInput& garment, const BodyInput& reference_body, const BodyInput& target_body) {
  return {info_of("garment", garment.name, garment.bytes),
          {info_of("reference_body", reference_body.name, reference_body.bytes),
           info_of("target_body", target_body.name, target_body.bytes)}};
}

void check_outputs(const AlterOptions& options, JobWork work) {
  const std::set<std::string> of_drapes = {"drape.obj", "fit.png"}, of_both = {"all", "result.json", "timings.json"};
  for (std::size_t i = 0; i < options.outputs.size(); ++i) {
    const std::string& name = options.outputs[i];
    if (of_both.contains(name) || of_drapes.contains(name) == (work == JobWork::Drape)) continue;
    throw Error(ErrorCode::OptionInvalid, "/outputs/" + std::to_string(i),
                work == JobWork::Drape
                    ? name + " comes from an alteration; a drape makes drape.obj, fit.png, result.json"
                    : name +
                          " comes from a drape alone; an alteration makes reference_drape.obj, "
                          "fit_reference.png and others");
  }
}

std::vector<OutputFile> drape_outputs(const DrapedGarment& draped, const AlterOptions& options, const JobInfo& info) {
  OutputFiles files(options.outputs);
  files.make("drape.obj", kObj, [&] { return write_drape_obj(draped.pattern, draped.mesh, draped.drape.drape); });
  files.make("fit.png", kPng, [&] {
    return render_views(&draped.body.surface, &draped.mesh, &draped.drape.drape, &draped.fit, views_of("fit"));
  });
  Record result = head_record("drape", options, info);
  result.add("quality", quality_record(draped.drape.quality))
      .add("drape", drape_record(draped.drape))
      .add("body", describe_body(draped.body));
  return files.finish(std::move(result));
}

std::vector<OutputFile> alter_outputs(const AlterResult& result, const AlterOptions& options, const JobInfo& info,
                                      bool at_once) {
  return AlterationFiles(result, options, info).make(at_once);
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
