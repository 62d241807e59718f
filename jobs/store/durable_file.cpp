// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/durable_file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/core/content_hash.h"
#include "engine/core/error.h"
#include "jobs/store/fault_point.h"
#include "jobs/store/identifier.h"

namespace toile {

namespace {

[[noreturn]] void fail(const char* what) {
  const int code = errno;
  if (code == ENOSPC || code == EDQUOT || code == EFBIG)
    throw Error(ErrorCode::StorageFull, "artifacts", "no space left for files: free some disk space");
  throw Error(ErrorCode::StorageFailed, "artifacts", std::string("cannot ") + what + ": " + std::strerror(code));
}

struct Descriptor {
  int number;
  explicit Descriptor(int number_) : number(number_) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

void write_all(int descriptor, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("write a file");
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

struct BlobWriter::Hash {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  Hash() { EVP_DigestInit_ex(context, EVP_sha256(), nullptr); }
  ~Hash() { EVP_MD_CTX_free(context); }
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;

  void add(std::span<const std::uint8_t> bytes) { EVP_DigestUpdate(context, bytes.data(), bytes.size()); }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int length = 0;
    EVP_DigestFinal_ex(context, digest.data(), &length);
    std::string text;
    for (unsigned int i = 0; i < length; ++i) {
      constexpr const char* kDigits = "0123456789abcdef";
      text += kDigits[digest[i] >> 4];
      text += kDigits[digest[i] & 15];
    }
    return text;
  }
};

PreparedBlob::PreparedBlob(std::string sha256, std::int64_t size, std::filesystem::path file)
    : sha256_(std::move(sha256)), size_(size), file_(std::move(file)) {}

PreparedBlob::~PreparedBlob() {
  if (!file_.empty()) ::unlink(file_.c_str());
}

PreparedBlob::PreparedBlob(PreparedBlob&& other) noexcept
    : sha256_(std::move(other.sha256_)), size_(other.size_), file_(std::exchange(other.file_, {})) {}

BlobWriter::BlobWriter(const std::filesystem::path& folder)
    : file_(folder / random_identifier("new")), hash_(std::make_unique<Hash>()) {
  fault_point("create");
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor_ < 0) fail("create a file");
}

BlobWriter::~BlobWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!file_.empty()) ::unlink(file_.c_str());
}

void BlobWriter::write(std::span<const std::uint8_t> bytes) {
  fault_point("write");
  write_all(descriptor_, bytes);
  hash_->add(bytes);
  size_ += static_cast<std::int64_t>(bytes.size());
}

PreparedBlob BlobWriter::finish() {
  fault_point("flush");
  if (::fsync(descriptor_) != 0) fail("flush a file");
  ::close(std::exchange(descriptor_, -1));
  return PreparedBlob(hash_->hex(), size_, std::exchange(file_, {}));
}

PreparedBlob prepare_existing(const std::filesystem::path& file) {
  const Bytes bytes = read_whole_file(file);
  fault_point("flush");
  const Descriptor handle(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (handle.number < 0 || ::fsync(handle.number) != 0) fail("flush a file");
  return PreparedBlob(sha256_hex(bytes), static_cast<std::int64_t>(bytes.size()), file);
}

void link_blob(const PreparedBlob& prepared, const std::filesystem::path& target) {
  fault_point("link");
  if (::link(prepared.file().c_str(), target.c_str()) != 0 && errno != EEXIST) fail("name a file");
}

void flush_folder(const std::filesystem::path& folder) {
  fault_point("flush_folder");
  const Descriptor handle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.number < 0 || ::fsync(handle.number) != 0) fail("flush a folder");
}

Bytes read_whole_file(const std::filesystem::path& file) {
  const Descriptor handle(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  struct stat about {};
  if (handle.number < 0 || ::fstat(handle.number, &about) != 0 || !S_ISREG(about.st_mode)) fail("read a file");
  Bytes bytes(static_cast<std::size_t>(about.st_size));
  std::size_t at = 0;
  while (at < bytes.size()) {
    const ssize_t count = ::read(handle.number, bytes.data() + at, bytes.size() - at);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("read a file");
    if (count == 0) break;
    at += static_cast<std::size_t>(count);
  }
  bytes.resize(at);
  return bytes;
}

}  // namespace toile
