// SPDX-License-Identifier: GPL-3.0-or-later
// From method and path to the endpoint.
#pragma once

#include "server/http/problem.h"

namespace toile::http {

using Handler = std::function<Response(Request&)>;

struct Route {
  std::string method;
  std::string pattern;  // "/v1/jobs/{id}/artifacts/{name}"
  Handler handler;
  bool open = false;  // answers without an API key
};

class Router {
 public:
  void add(Route route);
  // The route, with `path_values` of the request filled. Throws Problem 404, or 405 with Allow.
  const Route& find(Request& request) const;

 private:
  std::vector<Route> routes_;
};

// "%41+b" -> "A b" for queries; malformed escapes stay as they are.
std::string url_decoded(std::string_view text, bool plus_is_space);
std::map<std::string, std::string> parse_query(std::string_view query);

}  // namespace toile::http
