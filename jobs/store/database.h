// SPDX-License-Identifier: GPL-3.0-or-later
// The one database of a data folder: a writer behind a lock, a few readers beside it (write-ahead log), migrations.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

#include "jobs/store/sqlite.h"

namespace toile {

class Database;

// What a commit promises. A power cut ends every worker with the machine: what only tells who works on what need not
// outlive it, and need not wait for the disk.
enum class Durability {
  Flushed,     // on the disk when commit() returns
  Eventually,  // atomic and in order, on the disk with the next flushed one
};

// BEGIN IMMEDIATE ... COMMIT on the writer. Rolls back unless committed. Holds the writer's lock: keep it short.
class Transaction {
 public:
  explicit Transaction(Database& database, Durability durability = Durability::Flushed);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  Connection* operator->() { return &connection_; }
  Connection& operator*() { return connection_; }
  void commit();

 private:
  std::unique_lock<std::mutex> lock_;
  Connection& connection_;
  bool open_ = true;
};

// A reader on loan. Each statement sees one consistent state.
class Reader {
 public:
  explicit Reader(Database& database);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  Connection* operator->() { return connection_.get(); }

 private:
  Database& database_;
  std::unique_ptr<Connection> connection_;
};

class Database {
 public:
  // Opens or creates the file, checks it (quick_check), brings its tables up to date.
  // Throws Error{StorageFailed}: damaged, or written by a newer version of Toile.
  explicit Database(const std::filesystem::path& file);

  // Builds the database anew from its rows (VACUUM), 6 ms per MB. secure_delete zeroes a row where it stands, but
  // SQLite shares rows out among neighbouring pages as they fill and leaves copies in the unused middle of a page.
  void rewrite();
  // Moves the log into the database and empties it; true when no reader was in the way.
  bool empty_log();
  // Full integrity check; "ok" when sound.
  std::string integrity();

 private:
  friend class Transaction;
  friend class Reader;

  std::filesystem::path file_;
  std::mutex writer_lock_;
  std::unique_ptr<Connection> writer_;
  Durability durability_ = Durability::Flushed;  // the writer's present setting
  std::mutex readers_lock_;
  std::vector<std::unique_ptr<Connection>> idle_readers_;
};

}  // namespace toile
