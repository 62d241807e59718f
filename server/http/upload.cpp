// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/upload.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "server/http/documents.h"
#include "server/http/multipart.h"

namespace toile::http {

using nlohmann::json;

namespace {

constexpr std::size_t kMaxFieldBytes = 64 << 10;
constexpr std::size_t kMaxNameBytes = 200;

// Only the last piece of a client's path, without control characters: a caption, never a path.
std::string caption(const std::string& filename) {
  std::string name = filename.substr(filename.find_last_of("/\\") + 1).substr(0, kMaxNameBytes);
  std::erase_if(name, [](unsigned char c) { return c < 32 || c == 127; });
  return name;
}

std::string extension(const std::string& filename) {
  const std::size_t dot = filename.rfind('.');
  std::string text = dot == std::string::npos ? std::string() : filename.substr(dot + 1).substr(0, 8);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  std::erase_if(text, [](unsigned char c) { return std::isalnum(c) == 0; });
  return text;
}

std::vector<std::string> split_labels(const std::string& text) {
  json labels = json::array();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end > begin) labels.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return labels_of(labels, "labels");
}

using Fields = std::map<std::string, std::string>;

const std::map<std::string, std::set<std::string>>& choices() {
  static const std::map<std::string, std::set<std::string>> all = {{"kind", {"human", "form"}},
                                                                   {"unit", {"auto", "m", "cm", "mm", "in"}},
                                                                   {"uv_unit", {"m", "cm", "mm"}},
                                                                   {"up", {"auto", "+x", "-x", "+y", "-y", "+z", "-z"}},
                                                                   {"keep_drape", {"true", "false"}}};
  return all;
}

void check_fields(const Fields& fields, InputKind kind) {
  const std::set<std::string> body = {"name", "labels", "kind", "unit", "up", "landmarks"};
  const std::set<std::string> garment = {"name", "labels", "uv_unit", "keep_drape", "seams"};
  for (const auto& [name, value] : fields) {
    if (!(kind == InputKind::Body ? body : garment).contains(name))
      throw invalid(name, "unknown form field `" + name + "`; see /openapi.yaml");
    const auto allowed = choices().find(name);
    if (allowed == choices().end() || allowed->second.contains(value)) continue;
    std::string list;
    for (const std::string& choice : allowed->second) list += (list.empty() ? "" : ", ") + choice;
    throw invalid(name, "`" + name + "` is one of " + list);
  }
}

// How the bytes are to be read: what the importer needs to know beyond them. The fields were checked.
std::string reading_fields(const Fields& fields, const std::string& format) {
  json reading = json::object();
  if (!format.empty()) reading["format"] = format;
  for (const auto& [name, value] : fields) {
    if (name == "unit" || name == "up" || name == "kind" || name == "uv_unit") reading[name] = value;
    if (name == "keep_drape") reading[name] = value == "true";
    if (name != "landmarks" && name != "seams") continue;
    const json document = json::parse(value, nullptr, false);
    if (!document.is_object()) throw invalid(name, "`" + name + "` is a JSON object; see /openapi.yaml");
    reading[name] = document;
  }
  return reading.dump();
}

Upload read_multipart(Service& service, Request& request, InputKind kind, const std::string& boundary) {
  BlobWriter file(service.store.artifacts.temporary_folder());
  Fields fields;
  std::string current, filename;
  bool has_file = false;
  MultipartReader reader(
      boundary, {},
      [&](const PartHead& part) {
        current = part.name;
        if (current != "file") {
          fields[current].clear();
          return;
        }
        if (has_file) throw invalid("file", "send one file");
        has_file = true;
        filename = caption(part.filename);
      },
      [&](std::span<const std::uint8_t> bytes) {
        if (current == "file") return file.write(bytes);
        std::string& value = fields[current];
        value.append(bytes.begin(), bytes.end());
        if (value.size() > kMaxFieldBytes) throw Problem{413, "limit_exceeded", "a form field is too long", {}, {}};
      });
  const bool complete = request.read_body([&](std::span<const std::uint8_t> bytes) {
    reader.feed(bytes);
    return true;
  });
  if (!complete) throw Problem{400, "file_malformed", "the upload ended early", {}, {}};
  reader.finish();
  if (!has_file || file.size() == 0) throw invalid("file", "send the bytes as a form part called `file`");
  check_fields(fields, kind);
  NewInput input{request.tenant,
                 kind,
                 fields.contains("name") ? caption(fields["name"]) : filename,
                 reading_fields(fields, extension(filename)),
                 "{}",
                 split_labels(fields["labels"])};
  return {std::move(input), file.finish()};
}

PreparedBlob prepare_text(Service& service, const std::string& text) {
  return service.store.artifacts.prepare(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

// {"name", "labels", and one of: "measurements" {...}, "builtin" NAME (bodies); "specification" {...} (garments)}, or a
// GarmentCode specification as it is.
Upload read_json_upload(Service& service, Request& request, InputKind kind) {
  std::string raw;
  const json document = read_json(request, service.options.max_upload_bytes, &raw);
  NewInput input{request.tenant, kind, "", "{}", "{}", {}};
  if (kind == InputKind::Garment && document.is_object() && document.contains("pattern")) {
    input.fields = R"({"format":"json"})";
    return {std::move(input), prepare_text(service, raw)};
  }
  require_schema(document, "input_request");
  const bool body = kind == InputKind::Body;
  input.name = caption(document.value("name", ""));
  if (document.contains("labels")) input.labels = labels_of(document["labels"], "/labels");
  json reading = json::object();
  if (document.contains("kind")) reading["kind"] = document["kind"];
  const char* member = body ? "measurements" : "specification";
  if (document.contains(member)) {
    reading["format"] = body ? "measurements" : "json";
    input.fields = reading.dump();
    return {std::move(input), prepare_text(service, document[member].dump())};
  }
  if (body && document.contains("builtin")) {
    reading["format"] = "builtin";
    input.fields = reading.dump();
    if (input.name.empty()) input.name = caption(document["builtin"]);
    return {std::move(input), prepare_text(service, document["builtin"].get<std::string>())};
  }
  throw invalid("", body ? "give `measurements` or `builtin`, or send a file as multipart/form-data"
                         : "give `specification`, or send a file as multipart/form-data");
}

}  // namespace

Upload read_upload(Service& service, Request& request, InputKind kind) {
  if (service.store.free_bytes() < service.options.min_free_bytes)
    throw Error(ErrorCode::StorageFull, "", "the server's disk is nearly full");
  const std::int64_t limit = service.options.max_upload_bytes + static_cast<std::int64_t>(kMaxFieldBytes);
  if (request.content_length > limit)
    throw Problem{413,
                  "limit_exceeded",
                  "a file may have at most " + std::to_string(service.options.max_upload_bytes) + " bytes",
                  {},
                  {}};
  const Seat seat(service.uploading, service.options.max_uploads);
  if (!seat) throw Problem{503, "busy", "too many uploads at a time: try again", {}, {{"Retry-After", "1"}}};
  const std::string boundary = multipart_boundary(request.header("Content-Type"));
  if (!boundary.empty()) return read_multipart(service, request, kind, boundary);
  if (request.media_type() == "application/json") return read_json_upload(service, request, kind);
  throw Problem{415, "format_unknown", "send multipart/form-data with a part `file`, or application/json", {}, {}};
}

}  // namespace toile::http
