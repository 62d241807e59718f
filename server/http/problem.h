// SPDX-License-Identifier: GPL-3.0-or-later
// Refusals as RFC 9457 problem documents. One table maps the engine's error codes to HTTP statuses.
#pragma once

#include "engine/core/error.h"
#include "server/http/message.h"

namespace toile::http {

struct FieldError {
  std::string pointer;  // JSON pointer into the request, or the name of a form field, parameter or header
  std::string message;
};

// What an endpoint throws when it refuses.
struct Problem {
  int status = 500;
  std::string code;  // of error_name(), or one of the transport's own ("too_many_headers", ...)
  std::string detail;
  std::vector<FieldError> errors;
  std::vector<std::pair<std::string, std::string>> headers;  // Retry-After, Allow, WWW-Authenticate
};

int status_of(ErrorCode code);
Problem problem_of(const Error& error);
Problem invalid(std::string pointer, std::string message);  // 422 bad_usage with one field error
Problem not_found(const std::string& what);

std::string reason_phrase(int status);
Response problem_response(const Problem& problem, const std::string& request_id);

}  // namespace toile::http
