// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/store.h"

namespace toile {

namespace fs = std::filesystem;

namespace {

fs::path made(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / "scratch", error);
  if (error)
    throw Error(ErrorCode::StorageFailed, "data",
                "cannot create the data folder " + folder.string() + " (" + error.message() + "): check --data");
  fs::permissions(folder, fs::perms::owner_all, error);
  return folder;
}

}  // namespace

Store::Store(const fs::path& data_, QueueOptions options, Clock clock_)
    : data(made(data_)),
      clock(std::move(clock_)),
      database(data / "toile.db"),
      artifacts(data, database, clock),
      inputs(database, artifacts, clock),
      queue(database, artifacts, clock, std::move(options)),
      jobs(database),
      stages(database, artifacts, clock),
      removal(database, artifacts, clock),
      webhooks(database, clock) {}

std::int64_t Store::free_bytes() const {
  std::error_code error;
  const auto space = fs::space(data, error);
  return error ? 0 : static_cast<std::int64_t>(space.available);
}

void Store::note_worker(const WorkerStatus& status) {
  Transaction transaction(database, Durability::Eventually);
  transaction->run(
      "INSERT INTO workers(name, seen_ms, slots, running) VALUES (?1, ?2, ?3, ?4)"
      " ON CONFLICT (name) DO UPDATE SET seen_ms = ?2, slots = ?3, running = ?4",
      status.name, clock(), status.slots, status.running);
  transaction->run("DELETE FROM workers WHERE seen_ms < ?", clock() - 600000);
  transaction.commit();
}

void Store::forget_worker(const std::string& name) {
  Transaction transaction(database, Durability::Eventually);
  transaction->run("DELETE FROM workers WHERE name = ?", name);
  transaction.commit();
}

std::vector<WorkerStatus> Store::workers() {
  Reader reader(database);
  std::vector<WorkerStatus> list;
  Statement rows = reader->query("SELECT name, seen_ms, slots, running FROM workers ORDER BY name");
  while (rows.step())
    list.push_back(
        {rows.text(0), rows.integer(1), static_cast<int>(rows.integer(2)), static_cast<int>(rows.integer(3))});
  return list;
}

}  // namespace toile
