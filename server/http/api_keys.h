// SPDX-License-Identifier: GPL-3.0-or-later
// Who may come in. Keys are kept as SHA-256 only; each belongs to a tenant.
#pragma once

#include <map>

#include "server/http/message.h"

namespace toile::http {

class ApiKeys {
 public:
  // Without keys everybody is the tenant `default`.
  ApiKeys() = default;
  // Lines `TENANT SHA256`; empty lines and lines with `#` in front are skipped. Throws Error{OptionInvalid} with the
  // line.
  static ApiKeys parse(const std::string& text);

  bool open() const { return tenant_of_hash_.empty(); }
  // `Authorization: Bearer KEY` or `X-Api-Key: KEY`. Throws Error{Unauthorized}.
  std::string tenant(const Request& request) const;

 private:
  std::map<std::string, std::string> tenant_of_hash_;
};

}  // namespace toile::http
