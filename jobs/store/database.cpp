// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/database.h"

#include "engine/core/error.h"
#include "jobs/store/fault_point.h"
#include "jobs/store/migrations.h"

namespace toile {

namespace {

// The log is emptied by the sweeper; the automatic checkpoint is only the bound on its growth (pages of 4 KiB).
constexpr const char* kWriterPragmas =
    "PRAGMA journal_mode=WAL;"
    "PRAGMA synchronous=FULL;"
    "PRAGMA foreign_keys=ON;"
    "PRAGMA secure_delete=ON;"
    "PRAGMA temp_store=MEMORY;"
    "PRAGMA wal_autocheckpoint=4000;"
    "PRAGMA cache_size=-1024;"
    "PRAGMA journal_size_limit=67108864;";

// As many readers as requests at a time: with 2 MB each, the default, memory would grow with the database for hours.
// Pages are in the system's cache anyway.
constexpr const char* kReaderPragmas = "PRAGMA cache_size=-256";

std::string check(Connection& connection, const char* pragma) {
  Statement rows = connection.query(pragma);
  return rows.step() ? rows.text(0) : std::string("no answer");
}

}  // namespace

Transaction::Transaction(Database& database, Durability durability)
    : lock_(database.writer_lock_), connection_(*database.writer_) {
  if (database.durability_ != durability) {
    connection_.run_script(durability == Durability::Flushed ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=NORMAL");
    database.durability_ = durability;
  }
  connection_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    connection_.run("ROLLBACK");
  } catch (...) {
    // SQLite has already rolled back by itself (full disk, I/O error): nothing is left to undo.
  }
}

void Transaction::commit() {
  connection_.run("COMMIT");
  open_ = false;
  fault_point("committed");
}

Reader::Reader(Database& database) : database_(database) {
  {
    const std::lock_guard lock(database.readers_lock_);
    if (!database.idle_readers_.empty()) {
      connection_ = std::move(database.idle_readers_.back());
      database.idle_readers_.pop_back();
      return;
    }
  }
  connection_ = std::make_unique<Connection>(database.file_, Connection::Access::ReadOnly);
  connection_->run_script(kReaderPragmas);
}

Reader::~Reader() {
  const std::lock_guard lock(database_.readers_lock_);
  database_.idle_readers_.push_back(std::move(connection_));
}

Database::Database(const std::filesystem::path& file)
    : file_(file), writer_(std::make_unique<Connection>(file, Connection::Access::ReadWrite)) {
  writer_->run_script(kWriterPragmas);
  const std::string state = check(*writer_, "PRAGMA quick_check(1)");
  if (state != "ok")
    throw Error(ErrorCode::StorageFailed, "database", "the database is damaged (" + state + "): restore a backup");
  migrate(*writer_);
}

void Database::rewrite() {
  const std::lock_guard lock(writer_lock_);
  // In memory it would need the size of the database.
  writer_->run_script("PRAGMA temp_store=FILE");
  try {
    fault_point("rewrite");
    writer_->run_script("VACUUM");
  } catch (...) {
    writer_->run_script("PRAGMA temp_store=MEMORY");
    throw;
  }
  writer_->run_script("PRAGMA temp_store=MEMORY");
}

bool Database::empty_log() {
  const std::lock_guard lock(writer_lock_);
  Statement rows = writer_->query("PRAGMA wal_checkpoint(TRUNCATE)");
  return rows.step() && rows.integer(0) == 0;
}

std::string Database::integrity() {
  const std::lock_guard lock(writer_lock_);
  return check(*writer_, "PRAGMA integrity_check(1)");
}

}  // namespace toile
