// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/api_keys.h"

#include <algorithm>
#include <sstream>

#include "engine/core/content_hash.h"
#include "engine/core/error.h"

namespace toile::http {

namespace {

bool is_sha256(const std::string& text) {
  return text.size() == 64 &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

}  // namespace

ApiKeys ApiKeys::parse(const std::string& text) {
  ApiKeys keys;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string tenant, hash;
    if (!(words >> tenant) || tenant.starts_with('#')) continue;
    if (!(words >> hash) || !is_sha256(hash))
      throw Error(ErrorCode::OptionInvalid, "api-keys:" + std::to_string(number),
                  "each line is a tenant and the SHA-256 of its key: TENANT 64-HEX-DIGITS");
    keys.tenant_of_hash_[hash] = tenant;
  }
  if (keys.open()) throw Error(ErrorCode::OptionInvalid, "api-keys", "the file holds no key: nobody could come in");
  return keys;
}

std::string ApiKeys::tenant(const Request& request) const {
  if (open()) return "default";
  std::string key = request.header("X-Api-Key");
  const std::string authorization = request.header("Authorization");
  if (key.empty() && authorization.starts_with("Bearer ")) key = authorization.substr(7);
  // Looked up by hash: how long it takes says nothing about the key.
  const auto found = key.empty() ? tenant_of_hash_.end() : tenant_of_hash_.find(sha256_hex(key));
  if (found == tenant_of_hash_.end())
    throw Error(ErrorCode::Unauthorized, "", "send `Authorization: Bearer KEY` with a key this server knows");
  return found->second;
}

}  // namespace toile::http
