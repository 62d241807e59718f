// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/sqlite.h"

#include <cerrno>
#include <utility>

#include <sqlite3.h>

#include "engine/core/error.h"
#include "jobs/store/fault_point.h"

namespace toile {

namespace {

constexpr int kBusyTimeoutMs = 15000;  // longer than the longest transaction, a checkpoint of a large log

[[noreturn]] void fail(sqlite3* database, int code) {
  const std::string message = database ? sqlite3_errmsg(database) : sqlite3_errstr(code);
  const bool full = code == SQLITE_FULL || (database && (sqlite3_system_errno(database) == ENOSPC));
  if (full) throw Error(ErrorCode::StorageFull, "database", "no space left for the database: free some disk space");
  throw Error(ErrorCode::StorageFailed, "database", "database error: " + message);
}

}  // namespace

Statement::Statement(sqlite3* database, sqlite3_stmt* statement) : database_(database), statement_(statement) {}

Statement::Statement(Statement&& other) noexcept
    : database_(other.database_), statement_(std::exchange(other.statement_, nullptr)) {}

Statement::~Statement() {
  if (!statement_) return;
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

bool Statement::step() {
  fault_point("statement");
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) fail(database_, code);
  return false;
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}
std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}
double Statement::real(int column) const {
  return sqlite3_column_double(statement_, column);
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))) : std::string();
}

std::optional<std::int64_t> Statement::optional_integer(int column) const {
  return is_null(column) ? std::nullopt : std::optional(integer(column));
}

std::optional<std::string> Statement::optional_text(int column) const {
  return is_null(column) ? std::nullopt : std::optional(text(column));
}

void Statement::bind(int index, std::nullptr_t) {
  sqlite3_bind_null(statement_, index);
}
void Statement::bind(int index, std::int64_t value) {
  sqlite3_bind_int64(statement_, index, value);
}
void Statement::bind(int index, double value) {
  sqlite3_bind_double(statement_, index, value);
}
void Statement::bind(int index, std::string_view value) {
  const char* bytes = value.data() ? value.data() : "";
  sqlite3_bind_text(statement_, index, bytes, static_cast<int>(value.size()), SQLITE_TRANSIENT);
}

Connection::Connection(const std::filesystem::path& file, Access access) {
  const int flags = SQLITE_OPEN_NOMUTEX |
                    (access == Access::ReadOnly ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  const int code = sqlite3_open_v2(file.c_str(), &handle_, flags, nullptr);
  if (code != SQLITE_OK) {
    const std::string message = handle_ ? sqlite3_errmsg(handle_) : sqlite3_errstr(code);
    sqlite3_close(handle_);
    throw Error(ErrorCode::StorageFailed, "database", "cannot open the database: " + message);
  }
  sqlite3_extended_result_codes(handle_, 0);
  sqlite3_busy_timeout(handle_, kBusyTimeoutMs);
}

Connection::~Connection() {
  for (auto& [sql, statement] : statements_) sqlite3_finalize(statement);
  sqlite3_close(handle_);
}

void Connection::run_script(const std::string& sql) {
  fault_point("script");
  const int code = sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(handle_, code);
}

sqlite3_stmt* Connection::prepared(const char* sql) {
  const auto found = statements_.find(std::string_view(sql));
  if (found != statements_.end()) return found->second;
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(handle_, sql, -1, SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  if (code != SQLITE_OK) fail(handle_, code);
  statements_.emplace(sql, statement);
  return statement;
}

std::int64_t Connection::changed_rows() const {
  return sqlite3_changes64(handle_);
}

}  // namespace toile
