// SPDX-License-Identifier: GPL-3.0-or-later
// SQLite with owners: connections, statements that reset themselves, transactions that roll back unless committed.
// Every failure is an Error: StorageFull when the disk or the database is full, StorageFailed otherwise.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace toile {

// A borrowed, bound statement; reset when it goes out of scope, so that no read transaction lingers.
class Statement {
 public:
  Statement(sqlite3* database, sqlite3_stmt* statement);
  ~Statement();
  Statement(Statement&& other) noexcept;
  Statement& operator=(Statement&&) = delete;

  // True while there is a row.
  bool step();

  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::optional<std::int64_t> optional_integer(int column) const;
  std::optional<std::string> optional_text(int column) const;

  void bind(int index, std::nullptr_t);
  void bind(int index, std::int64_t value);
  void bind(int index, int value) { bind(index, static_cast<std::int64_t>(value)); }
  void bind(int index, bool value) { bind(index, static_cast<std::int64_t>(value)); }
  void bind(int index, double value);
  void bind(int index, std::string_view value);
  void bind(int index, const std::string& value) { bind(index, std::string_view(value)); }
  void bind(int index, const char* value) { bind(index, std::string_view(value)); }
  template <class T>
  void bind(int index, const std::optional<T>& value) {
    value ? bind(index, *value) : bind(index, nullptr);
  }

 private:
  sqlite3* database_;
  sqlite3_stmt* statement_;
};

// One connection, used by one thread at a time. Statements are prepared once.
class Connection {
 public:
  enum class Access { ReadWrite, ReadOnly };
  Connection(const std::filesystem::path& file, Access access);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // `sql` holds one statement with `?` in the order of `values`.
  template <class... Values>
  Statement query(const char* sql, const Values&... values) {
    Statement statement(handle_, prepared(sql));
    int index = 0;
    (statement.bind(++index, values), ...);
    return statement;
  }

  // Runs a statement without rows; answers the number of rows it changed.
  template <class... Values>
  std::int64_t run(const char* sql, const Values&... values) {
    {
      Statement statement = query(sql, values...);
      while (statement.step()) {
      }
    }
    return changed_rows();
  }

  // Runs a script of several statements (migrations, pragmas).
  void run_script(const std::string& sql);

 private:
  sqlite3_stmt* prepared(const char* sql);
  std::int64_t changed_rows() const;

  sqlite3* handle_ = nullptr;
  std::map<std::string, sqlite3_stmt*, std::less<>> statements_;
};

}  // namespace toile
