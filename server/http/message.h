// SPDX-License-Identifier: GPL-3.0-or-later
// Requests and responses as the endpoints see them, free of sockets and of the HTTP library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/byte_range.h"

namespace toile::http {

std::string lower_case(std::string_view text);  // ASCII letters

struct CaseBlind {
  bool operator()(std::string_view a, std::string_view b) const;
};

// Called with pieces of the request's body; false stops reading.
using BodyReceiver = std::function<bool(std::span<const std::uint8_t>)>;

struct Request {
  std::string method;                        // GET, HEAD, POST, DELETE
  std::string path;                          // without query, not decoded
  std::map<std::string, std::string> query;  // decoded
  std::map<std::string, std::string, CaseBlind> headers;
  std::map<std::string, std::string> path_values;  // "{id}" of the route -> its text
  std::int64_t content_length = 0;
  std::function<bool(const BodyReceiver&)> read_body;  // once; false when the sender broke off or was stopped
  std::string request_id;
  std::string tenant;
  std::string remote;

  std::string header(std::string_view name) const;
  std::string media_type() const;  // Content-Type without parameters, in small letters
  std::optional<std::string> parameter(const std::string& name) const;
  const std::string& path_value(const std::string& name) const { return path_values.at(name); }
};

// Receives pieces of a streamed answer; false when the client is gone.
using StreamSink = std::function<bool(std::string_view)>;

struct Response {
  int status = 200;
  std::string content_type;
  std::vector<std::pair<std::string, std::string>> headers;
  std::string body;
  std::optional<std::filesystem::path> file;      // sent instead of `body`,
  std::optional<ByteRange> range;                 // or these bytes of it
  std::function<void(const StreamSink&)> stream;  // sent instead of both, until it returns

  Response& with(std::string name, std::string value) {
    headers.emplace_back(std::move(name), std::move(value));
    return *this;
  }
};

Response json_response(int status, std::string body);

}  // namespace toile::http
