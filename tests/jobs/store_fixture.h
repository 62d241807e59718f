// SPDX-License-Identifier: GPL-3.0-or-later
// A store in a fresh folder with a clock the test owns, one garment and two bodies.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>

#include <gtest/gtest.h>

#include "jobs/store/identifier.h"
#include "jobs/store/store.h"

namespace toile::test {

inline Bytes bytes_of(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

class StoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / random_identifier("toile-test");
    open();
    garment = add_input("alice", InputKind::Garment, "garment bytes");
    body = add_input("alice", InputKind::Body, "body bytes");
    target = add_input("alice", InputKind::Body, "target bytes");
  }
  void TearDown() override {
    store.reset();
    std::filesystem::remove_all(folder);
  }

  void open() {
    store = std::make_unique<Store>(folder, options, [this] { return now_ms.load(); });
  }
  void reopen() {
    store.reset();
    open();
  }

  std::string add_input(const std::string& tenant, InputKind kind, const std::string& text) {
    const PreparedBlob blob = store->artifacts.prepare(bytes_of(text));
    store->artifacts.publish(std::span(&blob, 1));
    Transaction transaction(store->database);
    const std::string id = store->inputs.add(transaction, {tenant, kind, "name", "{}", "{}", {}}, blob).first.id;
    transaction.commit();
    return id;
  }

  NewJob new_job(const std::string& options_text = "{}") const {
    NewJob job;
    job.tenant = "alice";
    job.kind = "write";
    job.inputs = {{"garment", garment}, {"reference_body", body}, {"target_body", target}};
    job.options = options_text;
    return job;
  }

  std::string enqueue(const NewJob& job) {
    Transaction transaction(store->database);
    const std::string id = store->queue.enqueue(transaction, job);
    transaction.commit();
    return id;
  }
  // A job unlike all before it.
  std::string enqueue(Priority priority = Priority::Interactive) {
    NewJob job = new_job("{\"n\":" + std::to_string(++distinct) + "}");
    job.priority = priority;
    return enqueue(job);
  }

  Outcome success(const std::string& text = "result") {
    Outcome outcome;
    PreparedBlob blob = store->artifacts.prepare(bytes_of(text));
    store->artifacts.publish(std::span(&blob, 1));
    outcome.artifacts.push_back({"result.json", "application/json", std::move(blob)});
    outcome.summary = R"({"ok":true})";
    return outcome;
  }
  static Outcome ended(Outcome::Kind kind) {
    Outcome outcome;
    outcome.kind = kind;
    outcome.error = JobError{"crashed", "job", "told by the test"};
    return outcome;
  }

  LeaseState beat(const std::string& id, int attempt, double progress) {
    ProgressReport report;
    report.lease.job = id;
    report.lease.attempt = attempt;
    report.stage = "drape";
    report.progress = progress;
    return store->queue.heartbeat(std::span(&report, 1)).front();
  }
  LeaseState look(const std::string& id, int attempt) {
    const Lease lease{id, attempt};
    return store->queue.look(std::span(&lease, 1)).front();
  }

  Job job(const std::string& id) const { return store->jobs.find("alice", id).value(); }
  JobState state(const std::string& id) const { return job(id).state; }

  QueueOptions options;
  std::atomic<std::int64_t> now_ms{1'700'000'000'000};
  std::filesystem::path folder;
  std::unique_ptr<Store> store;
  std::string garment, body, target;
  int distinct = 0;
};

}  // namespace toile::test
