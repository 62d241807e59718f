// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/problem.h"

#include <nlohmann/json.hpp>

namespace toile::http {

int status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::Unauthorized: return 401;
    case ErrorCode::NotFound: return 404;
    case ErrorCode::Conflict: return 409;
    case ErrorCode::LimitExceeded: return 413;
    case ErrorCode::FormatUnknown: return 415;
    case ErrorCode::BadUsage:
    case ErrorCode::FileUnreadable:
    case ErrorCode::FileMalformed:
    case ErrorCode::OptionInvalid:
    case ErrorCode::BodyUnusable:
    case ErrorCode::BodyNotRecognised:
    case ErrorCode::GarmentInvalid:
    case ErrorCode::SeamInvalid:
    case ErrorCode::RegistrationFailed:
    case ErrorCode::DrapeFailed:
    case ErrorCode::DerivationFailed:
    case ErrorCode::AlterationFailed:
    case ErrorCode::TimedOut:
    case ErrorCode::ResourceLimit:
    case ErrorCode::Crashed: return 422;
    case ErrorCode::QueueFull: return 429;
    case ErrorCode::StorageFull: return 507;
    case ErrorCode::StorageFailed: return 503;
    case ErrorCode::Cancelled:
    case ErrorCode::Internal: return 500;
  }
  return 500;
}

Problem problem_of(const Error& error) {
  Problem problem{status_of(error.code), std::string(error_name(error.code)), error.message, {}, {}};
  if (!error.subject.empty() && problem.status < 500) problem.errors.push_back({error.subject, error.message});
  if (problem.status == 429 || problem.status == 503 || problem.status == 507)
    problem.headers.emplace_back("Retry-After", "10");
  return problem;
}

Problem invalid(std::string pointer, std::string message) {
  return {422, std::string(error_name(ErrorCode::BadUsage)), message, {{std::move(pointer), message}}, {}};
}

Problem not_found(const std::string& what) {
  return {404, std::string(error_name(ErrorCode::NotFound)), "no " + what + " with this id", {}, {}};
}

std::string reason_phrase(int status) {
  switch (status) {
    case 400: return "Bad Request";
    case 401: return "Unauthorized";
    case 404: return "Not Found";
    case 405: return "Method Not Allowed";
    case 406: return "Not Acceptable";
    case 408: return "Request Timeout";
    case 409: return "Conflict";
    case 411: return "Length Required";
    case 413: return "Content Too Large";
    case 414: return "URI Too Long";
    case 415: return "Unsupported Media Type";
    case 416: return "Range Not Satisfiable";
    case 422: return "Unprocessable Content";
    case 429: return "Too Many Requests";
    case 431: return "Request Header Fields Too Large";
    case 503: return "Service Unavailable";
    case 505: return "HTTP Version Not Supported";
    case 507: return "Insufficient Storage";
    default: return "Internal Server Error";
  }
}

Response problem_response(const Problem& problem, const std::string& request_id) {
  nlohmann::ordered_json document = {{"type", "about:blank"},    {"title", reason_phrase(problem.status)},
                                     {"status", problem.status}, {"code", problem.code},
                                     {"detail", problem.detail}, {"errors", nlohmann::ordered_json::array()}};
  for (const FieldError& error : problem.errors)
    document["errors"].push_back({{"pointer", error.pointer}, {"message", error.message}});
  if (!request_id.empty()) document["request_id"] = request_id;
  Response response =
      json_response(problem.status, document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  response.content_type = "application/problem+json";
  response.headers = problem.headers;
  return response;
}

}  // namespace toile::http
