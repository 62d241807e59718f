// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/output_files.h"

#include <algorithm>
#include <cassert>

#include "engine/core/content_hash.h"
#include "engine/io/options_json.h"
#include "engine/io/record_json.h"

namespace toile {

bool OutputFiles::named(const std::string& name) const {
  assert(is_output_name(name));
  return std::find(wanted_.begin(), wanted_.end(), name) != wanted_.end();
}

void OutputFiles::make(const std::string& name, const char* type, const std::function<Bytes()>& work) {
  if (wanted(name)) files_.push_back({name, type, work()});
}

void OutputFiles::make_if_named(const std::string& name, const char* type, const std::function<Bytes()>& work) {
  if (named(name)) files_.push_back({name, type, work()});
}

std::vector<OutputFile> OutputFiles::finish(Record result) {
  std::vector<Record> listed;
  for (const OutputFile& file : files_) {
    Record entry;
    entry.add("name", file.name).add("bytes", static_cast<std::int64_t>(file.bytes.size()));
    listed.push_back(std::move(entry.add("sha256", sha256_hex(file.bytes))));
  }
  result.add("files", std::move(listed));
  files_.push_back({"result.json", "application/json", write_json(result)});
  return std::move(files_);
}

}  // namespace toile
