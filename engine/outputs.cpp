// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/outputs.h"

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <iterator>

#include "engine/altered_pattern_record.h"
#include "engine/core/content_hash.h"
#include "engine/core/text.h"
#include "engine/draw_alteration.h"
#include "engine/io/body_json.h"
#include "engine/io/drape_obj.h"
#include "engine/io/dxf.h"
#include "engine/io/garmentcode_json.h"
#include "engine/io/options_json.h"
#include "engine/io/pdf.h"
#include "engine/io/record_json.h"
#include "engine/io/report_html.h"
#include "engine/io/svg.h"
#include "engine/io/text_format.h"
#include "engine/io/ticket_document.h"
#include "engine/render/drawing_picture.h"
#include "engine/render/png.h"
#include "engine/result_records.h"
#include "engine/stages/body_zones.h"
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
constexpr std::array<std::pair<const char*, io::PdfSheet>, 4> kPrints = {
    {{"altered_pattern.pdf", io::PdfSheet::A4},
     {"altered_pattern_letter.pdf", io::PdfSheet::Letter},
     {"altered_pattern_a0.pdf", io::PdfSheet::A0},
     {"altered_pattern_projector.pdf", io::PdfSheet::Projector}}};
const io::SvgOptions kInlined{.test_square = false, .inlined = true};

Bytes bytes_of(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

// Files that are asked for, in the order they are made.
class Outputs {
 public:
  explicit Outputs(const AlterOptions& options) : wanted_(options.outputs) {}

  // The file's bytes, valid until finish(); null when it is not asked for.
  const Bytes* make(const std::string& name, const char* type, const std::function<Bytes()>& work) {
    const auto asked = [this](const std::string& word) {
      return std::find(wanted_.begin(), wanted_.end(), word) != wanted_.end();
    };
    if (!asked("all") && !asked(name)) return nullptr;
    files_.push_back({name, type, work()});
    return &files_.back().bytes;
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
    return {std::make_move_iterator(files_.begin()), std::make_move_iterator(files_.end())};
  }

 private:
  std::vector<std::string> wanted_;
  std::deque<OutputFile> files_;  // a deque: bytes stay where they are
};

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
  record.add("inputs", std::move(inputs)).add("options", io::options_record(options));
  return record;
}

// Made when it is first asked for.
template <class T>
class OnDemand {
 public:
  explicit OnDemand(std::function<T()> make) : make_(std::move(make)) {}
  const T& value() {
    if (!value_) value_ = make_();
    return *value_;
  }

 private:
  std::function<T()> make_;
  std::optional<T> value_;
};

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
  ticket.garment = result.reference.pattern.name;
  ticket.reference_body = info.bodies.front().name;
  ticket.target_body = info.bodies.back().name;
  return ticket;
}

std::string percent(double share) {
  return io::number(100.0 * share, 1);
}

// Fits of a job against its reference; `after` is the altered garment's, where it was draped.
struct Fits {
  FitComparison before, ideal;
  std::optional<FitComparison> after;
};

io::HtmlTable zone_table(const Fits& fits) {
  io::HtmlTable table{"Stretch that differs from the reference fit, in percent",
                      {"zone", "before, weft", "before, warp", "ideal, weft", "ideal, warp"},
                      {}};
  if (fits.after) table.columns.insert(table.columns.end(), {"after, weft", "after, warp"});
  const auto add = [&](std::string_view zone, const auto& difference) {
    std::vector<std::string> row = {std::string(zone)};
    for (const FitComparison* fit : {&fits.before, &fits.ideal, fits.after ? &*fits.after : nullptr}) {
      if (!fit) continue;
      row.push_back(percent(difference(*fit).mean_weft));
      row.push_back(percent(difference(*fit).mean_warp));
    }
    table.rows.push_back(std::move(row));
  };
  add("whole garment", [](const FitComparison& fit) { return fit.whole; });
  for (std::size_t z = 0; z < fits.before.zones.size(); ++z)
    if (fits.before.zones[z].area > 0.0 && static_cast<BodyZone>(z) != BodyZone::Whole)
      add(zone_name(static_cast<BodyZone>(z)), [z](const FitComparison& fit) { return fit.zones[z]; });
  return table;
}

std::vector<std::string> summary_of(const Ticket& ticket, const Fits& fits) {
  const std::size_t count = ticket.operations.size();
  const auto adds = static_cast<std::size_t>(
      std::count_if(ticket.operations.begin(), ticket.operations.end(),
                    [](const TicketOperation& o) { return o.fabric == FabricNeed::NeedsFabric; }));
  const auto rms = [](const FitComparison& fit) { return percent(fit.whole.rms_stretch) + " %"; };
  std::string fit = "Stretch differs from the reference fit by " + rms(fits.before) + " before alteration, ";
  if (fits.after) fit += "by " + rms(*fits.after) + " after it, ";
  fit += "by " + rms(fits.ideal) + " with the ideal pattern (root mean square).";
  return {print_text("%zu %s, %zu of them with new fabric.", count, count == 1 ? "operation" : "operations", adds),
          std::move(fit)};
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

std::vector<OutputFile> drape_outputs(const DrapedGarment& draped, const AlterOptions& options, const JobInfo& info) {
  Outputs outputs(options);
  outputs.make("drape.obj", kObj, [&] { return io::write_drape_obj(draped.pattern, draped.mesh, draped.drape.drape); });
  outputs.make("fit.png", kPng, [&] {
    return render_views(&draped.body.surface, &draped.mesh, &draped.drape.drape, &draped.fit, views_of("fit"));
  });
  Record result = head_record("drape", options, info);
  result.add("quality", quality_record(draped.drape.quality))
      .add("drape", drape_record(draped.drape))
      .add("body", describe_body(draped.body));
  return outputs.finish(std::move(result));
}

std::vector<OutputFile> alter_outputs(const AlterResult& r, const AlterOptions& options, const JobInfo& info) {
  const Pattern& pattern = r.reference.pattern;
  const PatternMesh& mesh = r.reference.mesh;
  const Pattern& target_pattern = r.derived.drawn.pattern;
  OnDemand<Drawing> drawing([&] { return draw_alteration(pattern, r.altered); });
  OnDemand<Bytes> inlined([&] { return io::write_svg(drawing.value(), kInlined); });
  const Ticket ticket = named_ticket(r, info);
  const std::vector<BodyZone> zones = body_zones(pattern, mesh, r.reference.drape.drape, r.reference.body);
  const bool worn_after = r.after && r.after->problem.empty();
  Fits fits{compare_fits(mesh, r.reference.fit, r.fit_before, {}, zones),
            compare_fits(mesh, r.reference.fit, r.derived.fit, {}, zones),
            {}};
  if (worn_after)
    fits.after = compare_fits(r.after->mesh, r.after->reference, r.after->fit, {},
                              body_zones(r.altered.sewn.pattern, r.after->mesh, r.after->drape.drape, r.target_body));
  std::vector<const Drape*> compared = {&r.reference.drape.drape, &r.before.drape, &r.derived.drape.drape};
  if (worn_after) compared.push_back(&r.after->drape.drape);
  const Box frame = frame_of(compared);
  // Marks say how much tighter or looser the garment sits than on the reference body.
  const auto picture = [&](const Body& body, const DrapeResult& drape, const FittingMap& fit, const char* title) {
    ViewOptions views = views_of(title);
    views.frame = frame;
    if (&fit != &r.reference.fit) views.reference = &r.reference.fit;
    return render_views(&body.surface, &mesh, &drape.drape, &fit, views);
  };

  Outputs outputs(options);
  if (!r.altered.sewn.pieces.empty())
    outputs.make("altered_pattern.json", kJson, [&] {
      return bytes_of(io::write_altered_pattern(r.altered.sewn.pattern, altered_pattern_record(r.altered)));
    });
  outputs.make("altered_pattern.svg", kSvg, [&] { return io::write_svg(drawing.value()); });
  outputs.make("altered_pattern.dxf", "image/vnd.dxf", [&] { return io::write_dxf(drawing.value()); });
  for (const auto& [name, sheet] : kPrints)
    outputs.make(name, "application/pdf", [&, paper = sheet] { return io::write_pdf(drawing.value(), {paper, {}}); });
  const Bytes* pattern_png =
      outputs.make("pattern.png", kPng, [&] { return write_png(draw_picture(drawing.value())); });
  outputs.make("tears.png", kPng, [&] { return write_png(draw_picture(draw_tears(pattern, r.altered))); });
  outputs.make("target_pattern.json", kJson, [&] { return bytes_of(io::write_garmentcode(target_pattern)); });
  outputs.make("target_pattern.svg", kSvg, [&] { return io::write_svg(draw_changes(pattern, target_pattern)); });
  outputs.make("ticket.json", kJson, [&] { return write_json(io::ticket_record(ticket)); });
  outputs.make("ticket.html", kHtml, [&] { return io::write_ticket_html(ticket, inlined.value()); });
  outputs.make("reference_drape.obj", kObj,
               [&] { return io::write_drape_obj(pattern, mesh, r.reference.drape.drape); });
  outputs.make("target_before.obj", kObj, [&] { return io::write_drape_obj(pattern, mesh, r.before.drape); });
  if (worn_after)
    outputs.make("target_after.obj", kObj,
                 [&] { return io::write_drape_obj(r.altered.sewn.pattern, r.after->mesh, r.after->drape.drape); });
  const Bytes* fit_reference = outputs.make("fit_reference.png", kPng, [&] {
    return picture(r.reference.body, r.reference.drape, r.reference.fit, "reference");
  });
  const Bytes* fit_before =
      outputs.make("fit_before.png", kPng, [&] { return picture(r.target_body, r.before, r.fit_before, "before"); });
  const Bytes* fit_target = outputs.make(
      "fit_target.png", kPng, [&] { return picture(r.target_body, r.derived.drape, r.derived.fit, "target pattern"); });
  const Bytes* fit_after = !worn_after ? nullptr : outputs.make("fit_after.png", kPng, [&] {
    ViewOptions views = views_of("after");
    views.frame = frame;
    views.reference = &r.after->reference;
    return render_views(&r.target_body.surface, &r.after->mesh, &r.after->drape.drape, &r.after->fit, views);
  });
  outputs.make("report.html", kHtml, [&] {
    io::Report report;
    report.title = pattern.name;
    report.subtitle = "from " + ticket.reference_body + " to " + ticket.target_body;
    if (fit_reference) report.fits.push_back({*fit_reference, "On the reference body"});
    if (fit_before) report.fits.push_back({*fit_before, "On the target body, before alteration"});
    if (fit_after) report.fits.push_back({*fit_after, "On the target body, after alteration"});
    if (fit_target) report.fits.push_back({*fit_target, "On the target body, cut by the target pattern"});
    if (pattern_png) report.pictures.push_back({*pattern_png, "Numbers with + are insertions, with - removals"});
    report.summary = summary_of(ticket, fits);
    report.zones = {zone_table(fits)};
    report.ticket = &ticket;
    report.pattern_svg = inlined.value();
    report.quality = quality_record(r.before.quality);
    for (const auto& [name, value] : r.target_body.measurements) report.measurements.add(name + "_m", value);
    report.options = io::options_record(options);
    return io::write_report_html(report);
  });

  Record compared_fits;
  compared_fits.add("before", fit_record(pattern, fits.before)).add("ideal", fit_record(pattern, fits.ideal));
  if (fits.after) compared_fits.add("after", fit_record(r.altered.sewn.pattern, *fits.after));
  Record quality;
  quality.add("reference_drape", quality_record(r.reference.drape.quality))
      .add("target_drape_before", quality_record(r.before.quality))
      .add("target_pattern_drape", quality_record(r.derived.drape.quality))
      .add("area_imbalance", r.altered.area_imbalance)
      .add("flags", Record::Value(r.altered.flags));
  if (worn_after) quality.add("target_drape_after", quality_record(r.after->drape.quality));
  Record stages;
  stages.add("reference_drape", drape_record(r.reference.drape))
      .add("register_bodies", r.registration.diagnostics)
      .add("transport_garment", r.transported.diagnostics)
      .add("target_drape_before", drape_record(r.before))
      .add("derive_pattern", derivation_record(r.derived))
      .add("fit_pattern_edges", edges_record(r.derived.drawn))
      .add("alter_pattern", alteration_record(r.altered));
  if (r.after) stages.add("drape_altered", after_record(*r.after));
  Record bodies;
  bodies.add("reference", describe_body(r.reference.body)).add("target", describe_body(r.target_body));
  Record result = head_record("alter", options, info);
  result.add("quality", std::move(quality))
      .add("alterations", *io::ticket_record(ticket).find("operations"))
      .add("fits", std::move(compared_fits))
      .add("stages", std::move(stages))
      .add("bodies", std::move(bodies));
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
