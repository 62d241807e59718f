// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <unistd.h>

#include "engine/core/error.h"

namespace toile::app {
namespace {

namespace fs = std::filesystem;
using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void cannot_write(const fs::path& path) {
  const int reason = errno;
  throw Error(reason == ENOSPC || reason == EDQUOT ? ErrorCode::StorageFull : ErrorCode::StorageFailed,
              "file:" + path.string(), std::string("cannot be written: ") + std::strerror(reason));
}

Bytes read_all(std::FILE* file, const std::string& path) {
  Bytes bytes;
  std::array<std::uint8_t, 1 << 16> block;
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), file)) {
    bytes.insert(bytes.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(n));
    if (bytes.size() > kMostInputBytes)
      throw Error(ErrorCode::LimitExceeded, "file:" + path, "larger than 64 MiB; simplify the mesh or crop the scan");
  }
  if (std::ferror(file)) throw Error(ErrorCode::FileUnreadable, "file:" + path, "reading stopped half-way; try again");
  return bytes;
}

}  // namespace

void prepare_folder(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (!failed && ::access(folder.c_str(), W_OK | X_OK) == 0) return;
  throw Error(
      ErrorCode::BadUsage, "--out " + folder.string(),
      "no file can be written there (" + (failed ? failed.message() : std::strerror(errno)) + "): name another folder");
}

Bytes read_file(const std::string& path) {
  if (path == "-") return read_all(stdin, "standard input");
  if (fs::is_directory(path))
    throw Error(ErrorCode::FileUnreadable, "file:" + path, "is a folder; name a file inside it");
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) {
    throw Error(ErrorCode::FileUnreadable, "file:" + path,
                std::string("cannot be read: ") + std::strerror(errno) + "; check the path and its permissions");
  }
  return read_all(file.get(), path);
}

void write_file(const fs::path& path, const Bytes& bytes) {
  std::error_code failed;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), failed);
  const fs::path part = path.string() + ".part";
  {
    File file(std::fopen(part.c_str(), "wb"), &std::fclose);
    if (!file) cannot_write(path);
    const bool written =
        std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() && std::fflush(file.get()) == 0;
    if (!written) {
      const int reason = errno;
      fs::remove(part, failed);
      errno = reason;
      cannot_write(path);
    }
  }
  if (std::rename(part.c_str(), path.c_str()) != 0) cannot_write(path);
}

}  // namespace toile::app
