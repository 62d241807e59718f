// SPDX-License-Identifier: GPL-3.0-or-later
// The power goes at any write or flush of the database: what was answered is still there, and the database is sound.
#include "tests/jobs/recording_disk.h"
#include "tests/jobs/store_fixture.h"

namespace toile::test {

namespace {

constexpr int kJobs = 60;
constexpr int kOneCutIn = 30;    // changes of a file
constexpr int kFatesPerCut = 2;  // ways in which the unflushed writes of one cut may turn out

// What clients and workers were told so far, and what the disk holds at that moment.
struct Cut {
  RecordingDisk::Files files;
  std::map<std::string, JobState> told;
};

class PowerCut : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void maybe_cut(const RecordingDisk& disk) {
    if (random_() % kOneCutIn == 0) cuts_.push_back({disk.files(), told_});
  }

  std::string enqueue(Store& store, const std::string& garment, int n) {
    NewJob job;
    job.tenant = "alice";
    job.kind = "write";
    job.inputs = {{"garment", garment}};
    job.options = "{\"n\":" + std::to_string(n) + "}";
    Transaction transaction(store.database);
    const std::string id = store.queue.enqueue(transaction, job);
    transaction.commit();
    return id;
  }

  // Jobs come in, are worked on, end or are put back; now and then the log moves into the database.
  void work(Store& store) {
    const PreparedBlob blob = store.artifacts.prepare(bytes_of("garment bytes"));
    store.artifacts.publish(std::span(&blob, 1));
    std::string garment;
    {
      Transaction transaction(store.database);
      garment = store.inputs.add(transaction, {"alice", InputKind::Garment, "name", "{}", "{}", {}}, blob).first.id;
      transaction.commit();
    }
    for (int n = 0; n < kJobs; ++n) {
      told_[enqueue(store, garment, n)] = JobState::Queued;
      if (n % 2 == 0) continue;
      const auto job = store.queue.claim("worker");
      ASSERT_TRUE(job);
      Outcome outcome;
      outcome.kind = n % 5 == 0 ? Outcome::Kind::Interrupted : Outcome::Kind::Succeeded;
      ASSERT_TRUE(store.queue.finish({job->id, job->attempt}, outcome));
      if (n % 5 != 0) told_[job->id] = JobState::Succeeded;
      if (n % 20 == 19) store.database.empty_log();
    }
  }

  void expect_sound(const Cut& cut, const std::filesystem::path& folder) {
    RecordingDisk::write_after_cut(cut.files, random_, folder);
    Store store(folder, {});
    ASSERT_EQ(store.database.integrity(), "ok");
    for (const auto& [id, told] : cut.told) {
      const auto job = store.jobs.find("alice", id);
      ASSERT_TRUE(job) << "a job that was accepted is lost";
      if (told == JobState::Succeeded) {
        ASSERT_EQ(job->state, JobState::Succeeded);
      }
    }
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / random_identifier("toile-cut");
  std::mt19937 random_{7};
  std::vector<Cut> cuts_;
  std::map<std::string, JobState> told_;
};

TEST_F(PowerCut, WhatWasAnsweredIsStillThereWhereverTheWritesStop) {
  {
    RecordingDisk* recording = nullptr;
    RecordingDisk disk([&] { maybe_cut(*recording); });
    recording = &disk;
    Store store(folder_ / "whole", {});
    ASSERT_NO_FATAL_FAILURE(work(store));
  }
  ASSERT_GT(cuts_.size(), 50u);
  std::size_t unflushed = 0, number = 0;
  for (const Cut& cut : cuts_) {
    for (const auto& [name, file] : cut.files) unflushed += file.pending.size();
    for (int fate = 0; fate < kFatesPerCut; ++fate) {
      const std::filesystem::path folder = folder_ / std::to_string(number++);
      ASSERT_NO_FATAL_FAILURE(expect_sound(cut, folder)) << "cut " << number;
      std::filesystem::remove_all(folder);
    }
  }
  EXPECT_GT(unflushed, cuts_.size() / 2);  // the cuts do fall between writing and flushing
}

// The test itself: on a disk that lies about flushing, accepted jobs do get lost.
TEST_F(PowerCut, IsNoticedWhereTheDatabaseDoesNotFlush) {
  {
    RecordingDisk* recording = nullptr;
    RecordingDisk disk([&] { maybe_cut(*recording); });
    recording = &disk;
    Store store(folder_ / "whole", {});
    ASSERT_NO_FATAL_FAILURE(work(store));
  }
  Cut middle = cuts_[cuts_.size() / 2];
  ASSERT_GT(middle.told.size(), 10u);
  for (auto& [name, file] : middle.files)
    if (name.ends_with("-wal")) file = {};
  RecordingDisk::write_after_cut(middle.files, random_, folder_ / "lost");
  Store store(folder_ / "lost", {});
  std::size_t lost = 0;
  for (const auto& [id, told] : middle.told) lost += store.jobs.find("alice", id) ? 0 : 1;
  EXPECT_GT(lost, 0u);
}

}  // namespace
}  // namespace toile::test
