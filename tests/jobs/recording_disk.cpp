// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/jobs/recording_disk.h"

#include <algorithm>
#include <cstring>
#include <fstream>

#include <sqlite3.h>

namespace toile::test {

namespace {

constexpr std::size_t kSector = 512;
constexpr const char* kName = "recording";

struct State {
  sqlite3_vfs* real = nullptr;
  sqlite3_vfs recording{};
  sqlite3_io_methods methods{};
  RecordingDisk::Files files;
  std::function<void()> on_change;
};
State* state = nullptr;

// SQLite's handle of one file; the real one lies right behind it.
struct Handle {
  sqlite3_file base;
  RecordedFile* record;
  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};
Handle* handle_of(sqlite3_file* file) {
  return reinterpret_cast<Handle*>(file);
}

void apply(std::string& content, const RecordedFile::Change& change) {
  const auto offset = static_cast<std::size_t>(change.offset);
  if (change.truncate) return content.resize(std::min(content.size(), offset));
  content.resize(std::max(content.size(), offset + change.bytes.size()));
  content.replace(offset, change.bytes.size(), change.bytes);
}

void remember(sqlite3_file* file, RecordedFile::Change change) {
  if (!handle_of(file)->record) return;
  handle_of(file)->record->pending.push_back(std::move(change));
  state->on_change();
}

int close_file(sqlite3_file* file) {
  sqlite3_file* real = handle_of(file)->real();
  return real->pMethods ? real->pMethods->xClose(real) : SQLITE_OK;
}
int read_file(sqlite3_file* file, void* to, int count, sqlite3_int64 offset) {
  sqlite3_file* real = handle_of(file)->real();
  return real->pMethods->xRead(real, to, count, offset);
}
int write_file(sqlite3_file* file, const void* from, int count, sqlite3_int64 offset) {
  sqlite3_file* real = handle_of(file)->real();
  const int code = real->pMethods->xWrite(real, from, count, offset);
  remember(file, {offset, std::string(static_cast<const char*>(from), static_cast<std::size_t>(count)), false});
  return code;
}
int truncate_file(sqlite3_file* file, sqlite3_int64 size) {
  sqlite3_file* real = handle_of(file)->real();
  const int code = real->pMethods->xTruncate(real, size);
  remember(file, {size, {}, true});
  return code;
}
int sync_file(sqlite3_file* file, int) {
  if (RecordedFile* record = handle_of(file)->record) {
    for (const RecordedFile::Change& change : record->pending) apply(record->flushed, change);
    record->pending.clear();
    state->on_change();
  }
  return SQLITE_OK;
}

template <auto Method, class... Arguments>
int forward(sqlite3_file* file, Arguments... arguments) {
  sqlite3_file* real = handle_of(file)->real();
  return (real->pMethods->*Method)(real, arguments...);
}

void set_methods(sqlite3_io_methods& m) {
  m.iVersion = 2;  // with shared memory, without memory-mapped reading
  m.xClose = close_file;
  m.xRead = read_file;
  m.xWrite = write_file;
  m.xTruncate = truncate_file;
  m.xSync = sync_file;
  m.xFileSize = forward<&sqlite3_io_methods::xFileSize, sqlite3_int64*>;
  m.xLock = forward<&sqlite3_io_methods::xLock, int>;
  m.xUnlock = forward<&sqlite3_io_methods::xUnlock, int>;
  m.xCheckReservedLock = forward<&sqlite3_io_methods::xCheckReservedLock, int*>;
  m.xFileControl = forward<&sqlite3_io_methods::xFileControl, int, void*>;
  m.xSectorSize = forward<&sqlite3_io_methods::xSectorSize>;
  // A disk that promises nothing.
  m.xDeviceCharacteristics = [](sqlite3_file*) { return 0; };
  m.xShmMap = forward<&sqlite3_io_methods::xShmMap, int, int, int, void volatile**>;
  m.xShmLock = forward<&sqlite3_io_methods::xShmLock, int, int, int>;
  m.xShmBarrier = [](sqlite3_file* file) {
    sqlite3_file* real = handle_of(file)->real();
    real->pMethods->xShmBarrier(real);
  };
  m.xShmUnmap = forward<&sqlite3_io_methods::xShmUnmap, int>;
}

int open_file(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  Handle* handle = handle_of(file);
  handle->base.pMethods = nullptr;
  handle->record = nullptr;
  const int code = state->real->xOpen(state->real, name, handle->real(), flags, out_flags);
  if (code != SQLITE_OK) return code;
  if (name && (flags & (SQLITE_OPEN_MAIN_DB | SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_WAL))) {
    handle->record = &state->files[std::filesystem::path(name).filename()];
    handle->record->exists = true;
  }
  handle->base.pMethods = &state->methods;
  return SQLITE_OK;
}
int delete_file(sqlite3_vfs*, const char* name, int sync) {
  state->files[std::filesystem::path(name).filename()] = {};
  return state->real->xDelete(state->real, name, sync);
}

// Of a write that was not flushed: all, nothing, or some sectors.
std::string after_cut(const RecordedFile& file, std::mt19937& random) {
  std::string content = file.flushed;
  for (const RecordedFile::Change& change : file.pending) {
    const auto fate = random() % 3;
    if (fate == 0 || (fate == 1 && change.truncate)) continue;
    if (fate == 2) {
      apply(content, change);
      continue;
    }
    for (std::size_t from = 0; from < change.bytes.size(); from += kSector)
      if (random() % 2)
        apply(content, {change.offset + static_cast<std::int64_t>(from), change.bytes.substr(from, kSector), false});
  }
  return content;
}

}  // namespace

RecordingDisk::RecordingDisk(std::function<void()> on_change) {
  state = new State;
  state->on_change = std::move(on_change);
  state->real = sqlite3_vfs_find(nullptr);
  state->recording = *state->real;
  state->recording.zName = kName;
  state->recording.szOsFile = static_cast<int>(sizeof(Handle)) + state->real->szOsFile;
  state->recording.xOpen = open_file;
  state->recording.xDelete = delete_file;
  set_methods(state->methods);
  sqlite3_vfs_register(&state->recording, 1);
}

RecordingDisk::~RecordingDisk() {
  sqlite3_vfs_unregister(&state->recording);
  sqlite3_vfs_register(state->real, 1);
  delete state;
  state = nullptr;
}

const RecordingDisk::Files& RecordingDisk::files() const {
  return state->files;
}

void RecordingDisk::write_after_cut(const Files& files, std::mt19937& random, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& [name, file] : files) {
    if (!file.exists) continue;
    const std::string content = after_cut(file, random);
    std::ofstream(folder / name, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }
}

}  // namespace toile::test
