// SPDX-License-Identifier: GPL-3.0-or-later
#include "server/http/service.h"

#include <algorithm>
#include <cctype>

#include "jobs/store/identifier.h"

namespace toile::http {

namespace {

using Steady = std::chrono::steady_clock;

// The client's own id when it is a short plain word, else a fresh one.
std::string request_id_of(const Request& request) {
  const std::string given = request.header("X-Request-Id");
  const bool plain =
      !given.empty() && given.size() <= 64 && std::all_of(given.begin(), given.end(), [](unsigned char c) {
        return (c < 128 && std::isalnum(c) != 0) || c == '-' || c == '_' || c == '.';
      });
  return plain ? given : random_identifier("req");
}

}  // namespace

Seat::Seat(std::atomic<int>& taken, int places) : taken_(taken), seated_(taken.fetch_add(1) < places) {
  if (!seated_) taken_.fetch_sub(1);
}

Seat::~Seat() {
  if (seated_) taken_.fetch_sub(1);
}

Service::Service(Store& store_, ServiceOptions options_, ApiKeys keys_, EventLog log_)
    : store(store_), options(std::move(options_)), keys(std::move(keys_)), log(std::move(log_)) {
  add_input_routes(*this);
  add_job_routes(*this);
  add_event_routes(*this);
  add_artifact_routes(*this);
  add_batch_routes(*this);
  add_batch_summary_routes(*this);
  add_system_routes(*this);
}

Response Service::routed(Request& request, std::string& pattern) {
  try {
    const Route& route = router.find(request);
    pattern = route.pattern;
    if (!route.open) request.tenant = keys.tenant(request);
    return route.handler(request);
  } catch (const Problem& problem) {
    return problem_response(problem, request.request_id);
  } catch (const Error& error) {
    Problem problem = problem_of(error);
    if (problem.status == 401) problem.headers.emplace_back("WWW-Authenticate", "Bearer");
    return problem_response(problem, request.request_id);
  } catch (const std::bad_alloc&) {
    return problem_response(problem_of(Error(ErrorCode::StorageFailed, "memory", "the server is short of memory")),
                            request.request_id);
  } catch (const std::exception& error) {
    log("internal_error", {{"request", request.request_id}, {"what", error.what()}});
    return problem_response(problem_of(Error(ErrorCode::Internal, "", "an unexpected failure; the log tells more")),
                            request.request_id);
  }
}

Response Service::answer(Request& request) {
  const auto started = Steady::now();
  request.request_id = request_id_of(request);
  std::string pattern = "none";
  Response response = routed(request, pattern);
  response.with("X-Request-Id", request.request_id).with("X-Content-Type-Options", "nosniff");
  const double seconds = std::chrono::duration<double>(Steady::now() - started).count();
  metrics.count_request(request.method, pattern, response.status, seconds);
  log("request", {{"request", request.request_id},
                  {"tenant", request.tenant},
                  {"method", request.method},
                  {"route", pattern},
                  {"status", std::to_string(response.status)},
                  {"ms", std::to_string(static_cast<std::int64_t>(seconds * 1000))},
                  {"remote", request.remote}});
  return response;
}

}  // namespace toile::http
