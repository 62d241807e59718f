// SPDX-License-Identifier: GPL-3.0-or-later
// What all endpoints share: the store, the settings, who may come in, what is measured.
#pragma once

#include <atomic>
#include <mutex>
#include <set>

#include "jobs/worker/worker_pool.h"
#include "server/http/api_keys.h"
#include "server/http/metrics.h"
#include "server/http/router.h"

namespace toile::http {

struct ServiceOptions {
  std::int64_t max_upload_bytes = 64 << 20;   // of one body or garment
  std::int64_t max_document_bytes = 1 << 20;  // of a JSON request
  std::int64_t min_free_bytes = 512 << 20;    // below it nothing new is taken (507)
  int max_wait_s = 60;                        // of Prefer: wait and ?wait=
  int max_waiting = 12;                       // requests that may wait at a time; others are answered at once
  int max_uploads = 8;                        // large bodies taken at a time
  int max_batch = 1000;                       // bodies in one batch
  std::set<std::string> kinds = {"alter", "drape"};
  std::string version = TOILE_VERSION;
};

// Looks into an uploaded file before it is stored; answers what it found (JSON). Throws Error when it is unusable.
using InputInspector = std::function<std::string(InputKind kind, const std::string& name, const std::string& fields,
                                                 const std::filesystem::path& file)>;
// Checks a job's options (JSON); answers them with all defaults written out, so that equal jobs read equal. Throws
// Error whose subject is the JSON pointer.
using OptionsCheck = std::function<std::string(const std::string& kind, const std::string& options)>;
// Checks where a webhook may go. Throws Error.
using WebhookCheck = std::function<void(const std::string& url)>;

struct Service {
  Service(Store& store, ServiceOptions options, ApiKeys keys, EventLog log);

  Store& store;
  const ServiceOptions options;
  const ApiKeys keys;
  const EventLog log;
  InputInspector inspect;
  OptionsCheck check_options;
  WebhookCheck check_webhook;
  std::string openapi;  // the document at /openapi.yaml

  Metrics metrics;
  Router router;
  std::atomic<bool> stopping{false};
  std::atomic<int> waiting{0};
  std::atomic<int> uploading{0};

  // The one entrance: finds the route, the tenant, catches refusals, logs and counts.
  Response answer(Request& request);

 private:
  Response routed(Request& request, std::string& pattern);
};

// A place among the few that may hold a thread for long; false when all are taken.
class Seat {
 public:
  Seat(std::atomic<int>& taken, int places);
  ~Seat();
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;
  explicit operator bool() const { return seated_; }

 private:
  std::atomic<int>& taken_;
  bool seated_;
};

// Each file of endpoints adds its own routes.
void add_input_routes(Service& service);
void add_job_routes(Service& service);
void add_event_routes(Service& service);
void add_artifact_routes(Service& service);
void add_batch_routes(Service& service);
void add_batch_summary_routes(Service& service);
void add_system_routes(Service& service);

}  // namespace toile::http
