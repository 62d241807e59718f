// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/folder_stages.h"

#include <fstream>

#include "engine/core/content_hash.h"

namespace toile::app {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kHashDigits = 64;  // a file starts with the hash of what follows: half a file is none

}  // namespace

FolderStages::FolderStages(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_, error);
}

std::optional<Bytes> FolderStages::get(const std::string& key) {
  std::ifstream in(folder_ / key, std::ios::binary);
  if (!in) return std::nullopt;
  std::string hash(kHashDigits, '\0');
  in.read(hash.data(), static_cast<std::streamsize>(hash.size()));
  const Bytes value(std::istreambuf_iterator<char>(in), {});
  return sha256_hex(value) == hash ? std::optional(value) : std::nullopt;
}

void FolderStages::put(const std::string& key, const Bytes& value) {
  const fs::path aside = folder_ / (key + ".new");
  std::ofstream out(aside, std::ios::binary);
  out << sha256_hex(value);
  out.write(reinterpret_cast<const char*>(value.data()), static_cast<std::streamsize>(value.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(aside, folder_ / key, error);
}

}  // namespace toile::app
