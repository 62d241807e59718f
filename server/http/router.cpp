// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/router.h"

#include <charconv>

namespace toile::http {

namespace {

std::vector<std::string_view> segments(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    if (path.front() == '/') path.remove_prefix(1);
    const std::size_t end = path.find('/');
    parts.push_back(path.substr(0, end));
    path.remove_prefix(end == std::string_view::npos ? path.size() : end);
  }
  return parts;
}

bool matches(std::string_view pattern, std::string_view path, std::map<std::string, std::string>& values) {
  const auto wanted = segments(pattern), given = segments(path);
  if (wanted.size() != given.size()) return false;
  values.clear();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i].starts_with('{'))
      values[std::string(wanted[i].substr(1, wanted[i].size() - 2))] = url_decoded(given[i], false);
    else if (wanted[i] != given[i])
      return false;
  }
  return true;
}

}  // namespace

void Router::add(Route route) {
  routes_.push_back(std::move(route));
}

const Route& Router::find(Request& request) const {
  const std::string method = request.method == "HEAD" ? "GET" : request.method;
  std::string allowed;
  for (const Route& route : routes_) {
    std::map<std::string, std::string> values;
    if (!matches(route.pattern, request.path, values)) continue;
    if (route.method == method) {
      request.path_values = std::move(values);
      return route;
    }
    allowed += (allowed.empty() ? "" : ", ") + route.method + (route.method == "GET" ? ", HEAD" : "");
  }
  if (allowed.empty()) throw Problem{404, "not_found", "there is nothing at this address; see /openapi.yaml", {}, {}};
  throw Problem{405, "method_not_allowed", "this address answers " + allowed, {}, {{"Allow", allowed}}};
}

std::string url_decoded(std::string_view text, bool plus_is_space) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned value = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(text.data() + i + 1, text.data() + i + 3, value, 16).ptr == text.data() + i + 3) {
      out += static_cast<char>(value);
      i += 2;
    } else {
      out += plus_is_space && text[i] == '+' ? ' ' : text[i];
    }
  }
  return out;
}

std::map<std::string, std::string> parse_query(std::string_view query) {
  std::map<std::string, std::string> values;
  while (!query.empty()) {
    const std::size_t end = query.find('&');
    const std::string_view pair = query.substr(0, end);
    query.remove_prefix(end == std::string_view::npos ? query.size() : end + 1);
    const std::size_t equals = pair.find('=');
    if (pair.empty()) continue;
    const std::string_view value = equals == std::string_view::npos ? std::string_view() : pair.substr(equals + 1);
    values[url_decoded(pair.substr(0, equals), true)] = url_decoded(value, true);
  }
  return values;
}

}  // namespace toile::http
