// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/content_hash.h"

#include <openssl/evp.h>

#include "engine/core/error.h"

namespace toile {

struct ContentHash::State {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~State() { EVP_MD_CTX_free(context); }

  void update(const void* data, std::size_t size) {
    if (EVP_DigestUpdate(context, data, size) != 1) throw Error(ErrorCode::Internal, "sha256", "digest failed");
  }
};

ContentHash::ContentHash() : state_(std::make_unique<State>()) {
  if (!state_->context || EVP_DigestInit_ex(state_->context, EVP_sha256(), nullptr) != 1)
    throw Error(ErrorCode::Internal, "sha256", "digest could not start");
}

ContentHash::~ContentHash() = default;

ContentHash& ContentHash::add(std::span<const std::uint8_t> bytes) {
  const auto size = static_cast<std::uint64_t>(bytes.size());
  state_->update(&size, sizeof size);
  state_->update(bytes.data(), bytes.size());
  return *this;
}

ContentHash& ContentHash::add(std::string_view text) {
  return add(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

namespace {
std::string finish_hex(EVP_MD_CTX* context) {
  std::array<unsigned char, 32> digest{};
  unsigned size = 0;
  if (EVP_DigestFinal_ex(context, digest.data(), &size) != 1 || size != digest.size())
    throw Error(ErrorCode::Internal, "sha256", "digest could not end");
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex;
  hex.reserve(2 * digest.size());
  for (unsigned char byte : digest) hex += {kDigits[byte >> 4], kDigits[byte & 15]};
  return hex;
}
}  // namespace

std::string ContentHash::hex() {
  return finish_hex(state_->context);
}

std::string sha256_hex(std::span<const std::uint8_t> bytes) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1 ||
      EVP_DigestUpdate(context.get(), bytes.data(), bytes.size()) != 1)
    throw Error(ErrorCode::Internal, "sha256", "digest failed");
  return finish_hex(context.get());
}

std::string sha256_hex(std::string_view text) {
  return sha256_hex(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace toile
