// SPDX-License-Identifier: GPL-3.0-or-later
// What the queue costs a job: handing in, claiming and ending it, each answered only when the disk has it, with
// thousands waiting; against the time this disk takes to flush one page.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

#include "jobs/store/identifier.h"
#include "jobs/store/store.h"
#include "tests/bench/bench.h"

namespace toile::bench {

namespace {

constexpr int kWaiting = 10000;
constexpr int kSamples = 1000;
constexpr double kMostFlushes = 3.0;  // overhead of one job at p99, in flushes at p99

using Clock = std::chrono::steady_clock;

double milliseconds(const std::function<void()>& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Distribution {
  std::vector<double> sorted;
  explicit Distribution(std::vector<double> samples) : sorted(std::move(samples)) {
    std::sort(sorted.begin(), sorted.end());
  }
  double at(double share) const {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

// Appending one page and flushing it, as the write-ahead log does for a commit.
double flush_once(int file) {
  static const std::string page(4096, 'x');
  return milliseconds([&] {
    if (write(file, page.data(), page.size()) < 0 || fsync(file) != 0) std::perror("queue: flush");
  });
}

std::string add_garment(Store& store) {
  const PreparedBlob blob = store.artifacts.prepare(Bytes(1, 'x'));
  store.artifacts.publish(std::span(&blob, 1));
  Transaction transaction(store.database);
  const std::string id =
      store.inputs.add(transaction, {"", InputKind::Garment, "garment", "{}", "{}", {}}, blob).first.id;
  transaction.commit();
  return id;
}

NewJob numbered_job(const std::string& garment, int number) {
  NewJob job;
  job.kind = "alter";
  job.inputs = {{"garment", garment}};
  job.options = "{\"n\":" + std::to_string(number) + "}";
  return job;
}

void fill(Store& store, const std::string& garment) {
  Transaction transaction(store.database);
  for (int n = 0; n < kWaiting; ++n) store.queue.enqueue(transaction, numbered_job(garment, n));
  transaction.commit();
}

void add_row(Table& table, const std::string& what, const std::vector<double>& samples, double flush) {
  const Distribution of(samples);
  table.add({what, fixed(of.at(0.5), 3), fixed(of.at(0.99), 3), fixed(of.at(0.99) / flush, 2)});
}

}  // namespace

int bench_queue(const Arguments& arguments) {
  const std::filesystem::path folder =
      std::filesystem::path(arguments.words.empty() ? "." : arguments.words[0]) / random_identifier("queue-bench");
  std::filesystem::create_directories(folder);
  std::vector<double> flush, enqueue, claim, finish, all;
  {
    QueueOptions options;
    options.max_queued = 2 * kWaiting;
    Store store(folder / "data", options);
    const std::string garment = add_garment(store);
    fill(store, garment);
    const int file = open((folder / "flushed").c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    for (int n = 0; n < kSamples; ++n) {
      flush.push_back(flush_once(file));  // in turn with the rest: other work on the machine falls on both
      enqueue.push_back(milliseconds([&] {
        Transaction transaction(store.database);
        store.queue.enqueue(transaction, numbered_job(garment, kWaiting + n));
        transaction.commit();
      }));
      std::optional<Job> job;
      claim.push_back(milliseconds([&] { job = store.queue.claim("bench"); }));
      finish.push_back(milliseconds([&] { store.queue.finish({job->id, job->attempt}, Outcome{}); }));
      all.push_back(enqueue.back() + claim.back() + finish.back());
    }
    close(file);
  }
  std::filesystem::remove_all(folder);
  const double unit = Distribution(flush).at(0.99);
  Table table({"step", "p50_ms", "p99_ms", "flushes_at_p99"});
  add_row(table, "flush of one page", flush, unit);
  add_row(table, "hand in", enqueue, unit);
  add_row(table, "claim", claim, unit);
  add_row(table, "end", finish, unit);
  add_row(table, "all three", all, unit);
  std::printf("Queue with %d jobs waiting, %d samples, wall time\n", kWaiting, kSamples);
  table.print(arguments.csv);
  return Distribution(all).at(0.99) <= kMostFlushes * unit ? 0 : 1;
}

}  // namespace toile::bench
