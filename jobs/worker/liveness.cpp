// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/worker/liveness.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace toile {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const Store& store) {
  return store.data / "workers";
}

}  // namespace

int hold_liveness(const Store& store, const std::string& worker) {
  fs::create_directories(folder_of(store));
  // Locked before it has its name: nobody sees it unlocked.
  const fs::path hidden = folder_of(store) / ("." + worker);
  const int descriptor = ::open(hidden.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    throw Error(ErrorCode::StorageFailed, "data", "cannot lock a file in the data folder: is it a local disk?");
  fs::rename(hidden, folder_of(store) / worker);
  return descriptor;
}

void drop_liveness(const Store& store, const std::string& worker, int descriptor) {
  std::error_code error;
  fs::remove(folder_of(store) / worker, error);
  ::close(descriptor);
}

std::vector<std::string> bury_dead_workers(const Store& store) {
  std::vector<std::string> dead;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_of(store), error)) {
    const std::string name = entry.path().filename().string();
    if (name.front() == '.') continue;
    const int descriptor = ::open(entry.path().c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) continue;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
      dead.push_back(name);
      fs::remove(entry.path(), error);
    }
    ::close(descriptor);
  }
  return dead;
}

}  // namespace toile
