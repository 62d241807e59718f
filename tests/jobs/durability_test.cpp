// SPDX-License-Identifier: GPL-3.0-or-later
// The process dies before any statement and any step of a file write; the folder is opened again and must be sound.
#include <csignal>

#include <sys/wait.h>
#include <unistd.h>

#include "jobs/store/fault_point.h"
#include "tests/jobs/store_fixture.h"

namespace toile::test {

namespace {

int steps_left = 0;
void die_here(const char*) {
  if (steps_left-- == 0) ::kill(::getpid(), SIGKILL);
}
void full_here(const char*) {
  if (steps_left-- == 0) throw Error(ErrorCode::StorageFull, "test", "the disk is full");
}

}  // namespace

class Durability : public StoreTest {
 protected:
  // Runs `work` in a process that dies at its `step`-th step; true when it got to the end.
  bool dies_at(int step, const std::function<void()>& work) {
    store.reset();
    const pid_t child = ::fork();
    if (child == 0) {
      open();
      steps_left = step;
      fault_hook = die_here;
      work();
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    open();
    return WIFEXITED(status);
  }

  void expect_sound() {
    EXPECT_EQ(store->database.integrity(), "ok");
    Reader reader(store->database);
    Statement rows = reader->query("SELECT sha256 FROM blobs");
    while (rows.step()) EXPECT_NO_THROW(store->artifacts.read(rows.text(0)));
  }
};

TEST_F(Durability, AnAcceptedJobSurvivesDeathAtAnyStepAndHalfAJobIsNeverSeen) {
  bool done = false;
  int steps = 0;
  for (; !done; ++steps) {
    ASSERT_LT(steps, 200);
    const std::size_t before = store->jobs.list("alice", {}).size();
    done = dies_at(steps, [&] { enqueue(new_job("{\"step\":" + std::to_string(steps) + "}")); });
    const auto jobs = store->jobs.list("alice", {});
    EXPECT_GE(jobs.size(), before);
    EXPECT_LE(jobs.size(), before + 1);
    if (done) {
      EXPECT_EQ(jobs.size(), before + 1);
    }
    for (const Job& seen : jobs) EXPECT_EQ(seen.inputs.size(), 3U);
    expect_sound();
  }
  EXPECT_GT(steps, 8);
}

TEST_F(Durability, AJobEndsOnceAndCompletelyWhereverTheWorkerDies) {
  bool done = false;
  int steps = 0;
  for (; !done; ++steps) {
    ASSERT_LT(steps, 200);
    const std::string id = enqueue();
    const auto claimed = store->queue.claim("w");
    ASSERT_EQ(claimed->id, id);
    done = dies_at(steps, [&] { store->queue.finish({id, 1}, success("result " + id)); });
    if (state(id) == JobState::Succeeded) {
      EXPECT_EQ(store->artifacts.read(store->jobs.artifact(id, "result.json")->sha256), bytes_of("result " + id));
    } else {
      EXPECT_EQ(state(id), JobState::Running);
      EXPECT_TRUE(store->jobs.artifacts(id).empty());
      EXPECT_EQ(store->queue.give_back_jobs_of("w"), 1);
      EXPECT_EQ(store->queue.claim("v")->id, id);
      EXPECT_TRUE(store->queue.finish({id, 2}, success("result " + id)));
    }
    expect_sound();
  }
  EXPECT_GT(steps, 12);
  store->artifacts.remove_orphans(system_clock_ms() + 1000);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "tmp"));
}

TEST_F(Durability, ADeletionIsAllOrNothingAndFinishesLater) {
  bool done = false;
  for (int steps = 0; !done; ++steps) {
    ASSERT_LT(steps, 200);
    const std::string scan = add_input("alice", InputKind::Body, "scan " + std::to_string(steps));
    done = dies_at(steps, [&] { store->removal.remove_input("alice", InputKind::Body, scan); });
    expect_sound();
    if (store->inputs.find("alice", scan)) store->removal.remove_input("alice", InputKind::Body, scan);
    store->artifacts.empty_trash();
    EXPECT_FALSE(store->inputs.find("alice", scan));
  }
  store->artifacts.remove_orphans(system_clock_ms() + 1000);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder / "blobs")) ++files;
  EXPECT_EQ(files, 3U) << "the fixture's inputs and nothing else";
}

TEST_F(Durability, AFullDiskAtAnyStepLeavesTheJobAsItWas) {
  const std::string id = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  bool done = false;
  int refused = 0;
  for (int steps = 0; !done; ++steps) {
    ASSERT_LT(steps, 200);
    steps_left = steps;
    fault_hook = full_here;
    try {
      done = store->queue.finish({id, 1}, success());
    } catch (const Error& error) {
      EXPECT_EQ(error.code, ErrorCode::StorageFull);
      ++refused;
    }
    fault_hook = nullptr;
    // The hook behind a commit fires when all is written: the caller hears of a failure, the job has ended.
    if (!done && state(id) == JobState::Succeeded) break;
    expect_sound();
  }
  EXPECT_GT(refused, 5);
  EXPECT_EQ(state(id), JobState::Succeeded);
  EXPECT_EQ(store->jobs.artifacts(id).size(), 1U);
}

TEST_F(Durability, ADamagedDatabaseIsRefusedWithAMend) {
  store.reset();
  {
    std::FILE* file = std::fopen((folder / "toile.db").c_str(), "r+b");
    ASSERT_TRUE(file);
    std::fseek(file, 0, SEEK_SET);
    const std::string rubbish(8192, 'x');
    std::fwrite(rubbish.data(), 1, rubbish.size(), file);
    std::fclose(file);
  }
  std::filesystem::remove(folder / "toile.db-wal");
  EXPECT_THROW(open(), Error);
}

TEST_F(Durability, ADatabaseOfANewerToileIsRefused) {
  {
    Transaction transaction(store->database);
    transaction->run("PRAGMA user_version = 1000");
    transaction.commit();
  }
  EXPECT_THROW(reopen(), Error);
}

TEST_F(Durability, ADatabaseOfTheFirstStepIsBroughtUpToDateWithItsJobs) {
  enqueue();
  enqueue();
  {
    Transaction transaction(store->database);
    for (const char* sql :
         {"DROP TRIGGER jobs_come", "DROP TRIGGER jobs_return", "DROP TRIGGER jobs_leave", "DROP TRIGGER jobs_go",
          "DROP TABLE waiting", "DROP TABLE rewriting", "PRAGMA user_version = 1"})
      transaction->run(sql);
    transaction.commit();
  }
  options.max_queued = 3;
  reopen();
  enqueue();
  EXPECT_THROW(enqueue(), Error);
  EXPECT_TRUE(store->queue.claim("w"));
  enqueue();
  expect_sound();
}

TEST_F(Durability, AChangedFileIsNoticed) {
  const std::string sha256 = store->inputs.find("alice", body)->sha256;
  std::filesystem::permissions(store->artifacts.path_of(sha256), std::filesystem::perms::owner_all);
  std::FILE* file = std::fopen(store->artifacts.path_of(sha256).c_str(), "wb");
  std::fputs("other", file);
  std::fclose(file);
  EXPECT_THROW(store->artifacts.read(sha256), Error);
}

}  // namespace toile::test
