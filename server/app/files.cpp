// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/app/files.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <sys/stat.h>
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
  std::error_code unknown;  // what cannot even be looked at, fopen tells better
  if (fs::is_directory(path, unknown))
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
  // Into a device, a pipe or what a link leads to; a renamed file would take the place of /dev/null itself.
  const fs::file_type type = fs::symlink_status(path, failed).type();
  const bool replaced = type == fs::file_type::regular || type == fs::file_type::not_found;
  const fs::path part = replaced ? path.string() + ".part" : path.string();
  std::FILE* file = std::fopen(part.c_str(), "wb");
  if (!file) cannot_write(path);
  const bool taken = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const bool written = std::fclose(file) == 0 && taken;  // some disks tell only now that they are full
  if (written && (!replaced || std::rename(part.c_str(), path.c_str()) == 0)) return;
  const int reason = errno;
  if (replaced) fs::remove(part, failed);
  errno = reason;
  cannot_write(path);
}

void check_standard_output() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  struct stat out {};
  const bool pipe = ::fstat(STDOUT_FILENO, &out) == 0 && (S_ISFIFO(out.st_mode) || S_ISSOCK(out.st_mode));
  if (!pipe) cannot_write("standard output");
}

}  // namespace toile::app
