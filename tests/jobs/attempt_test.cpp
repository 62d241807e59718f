// SPDX-License-Identifier: GPL-3.0-or-later
// How an attempt is judged by what its process said and how it ended. The processes are shell scripts.
#include "jobs/worker/attempt.h"

#include "tests/jobs/store_fixture.h"

namespace toile::test {

namespace {

const std::string kDone = R"(echo '{"event":"done","summary":"{\"ok\":true}","timings":"{}"}' >&3;)";
const std::string kArtifact =
    R"(echo hello > out; echo '{"event":"artifact","name":"hello.txt","content_type":"text/plain","file":"out"}' >&3;)";

class AttemptTest : public StoreTest {
 protected:
  void SetUp() override {
    StoreTest::SetUp();
    attempt.wall_s = 60;
    attempt.limits.memory_bytes = 0;
    attempt.limits.cpu_s = 0;
  }

  // `script` runs with the request on standard input, in the working folder, telling events on descriptor 3.
  Outcome run(const std::string& script) {
    attempt.command = {"/bin/sh", "-c", "read request; " + script};
    enqueue();
    const std::optional<Job> job = store->queue.claim("worker");
    state = std::make_unique<AttemptState>(Lease{job->id, job->attempt});
    if (cancel) state->cancel = true;
    if (give_back) state->give_back = true;
    return make_attempt(*job, *store, attempt, *state);
  }

  AttemptOptions attempt;
  std::unique_ptr<AttemptState> state;
  bool cancel = false, give_back = false;
};

TEST_F(AttemptTest, SucceedsWithItsFiles) {
  const Outcome outcome = run(kArtifact + kDone);
  EXPECT_EQ(outcome.kind, Outcome::Kind::Succeeded);
  EXPECT_EQ(outcome.summary, R"({"ok":true})");
  ASSERT_EQ(outcome.artifacts.size(), 1u);
  EXPECT_EQ(outcome.artifacts[0].name, "hello.txt");
  EXPECT_EQ(store->artifacts.read(outcome.artifacts[0].blob.sha256()), bytes_of("hello\n"));
}

// A process killed between its last word and its end has done its work: it is neither lost nor failed for good.
TEST_F(AttemptTest, SucceedsHoweverItsProcessEndsAfterItsLastWord) {
  for (const char* end : {"kill -KILL $$", "kill -SEGV $$", "exit 7"}) {
    const Outcome outcome = run(kArtifact + kDone + end);
    EXPECT_EQ(outcome.kind, Outcome::Kind::Succeeded) << end;
    EXPECT_EQ(outcome.artifacts.size(), 1u) << end;
    EXPECT_FALSE(outcome.error) << end;
  }
}

TEST_F(AttemptTest, KilledFromOutsideIsNotItsOwnFault) {
  EXPECT_EQ(run(kArtifact + "kill -KILL $$").kind, Outcome::Kind::Interrupted);
}

TEST_F(AttemptTest, ACrashKeepsTheLastWords) {
  const Outcome fault = run("echo out of cloth >&2; kill -SEGV $$");
  EXPECT_EQ(fault.kind, Outcome::Kind::Crashed);
  ASSERT_TRUE(fault.error);
  EXPECT_NE(fault.error->message.find("out of cloth"), std::string::npos) << fault.error->message;
  const Outcome silent = run("exit 3");
  EXPECT_EQ(silent.kind, Outcome::Kind::Crashed);
  EXPECT_NE(silent.error->message.find("exit code 3"), std::string::npos) << silent.error->message;
}

TEST_F(AttemptTest, WhatTheJobSaysOfItselfHoldsAndAFullDiskPasses) {
  const auto say = [](const std::string& code) {
    return R"(echo '{"event":"failed","code":")" + code + R"(","subject":"body","message":"told"}' >&3;)";
  };
  const Outcome failed = run(say("drape_failed"));
  EXPECT_EQ(failed.kind, Outcome::Kind::Failed);
  EXPECT_EQ(failed.error->code, "drape_failed");
  EXPECT_EQ(failed.error->subject, "body");
  EXPECT_EQ(run(say("storage_full")).kind, Outcome::Kind::Transient);
  EXPECT_EQ(run(say("drape_failed") + "kill -KILL $$").kind, Outcome::Kind::Failed);
}

TEST_F(AttemptTest, EndsWhatTakesTooLong) {
  attempt.wall_s = 1;
  const Outcome outcome = run("exec sleep 600");
  EXPECT_EQ(outcome.kind, Outcome::Kind::Failed);
  EXPECT_EQ(outcome.error->code, "timed_out");
}

TEST_F(AttemptTest, EndsWhatUsesTooMuchOfTheProcessor) {
  attempt.limits.cpu_s = 1;
  const Outcome outcome = run("while :; do :; done");
  EXPECT_EQ(outcome.kind, Outcome::Kind::Failed);
  EXPECT_EQ(outcome.error->code, "timed_out");
}

TEST_F(AttemptTest, CancellingEndsAlsoWhatDoesNotListen) {
  cancel = true;
  EXPECT_EQ(run("exec sleep 600").kind, Outcome::Kind::Cancelled);
  EXPECT_EQ(run("trap '' TERM; while :; do sleep 1; done").kind, Outcome::Kind::Cancelled);
}

TEST_F(AttemptTest, GivenBackOnShutdownGoesBackToTheQueue) {
  give_back = true;
  EXPECT_EQ(run("exec sleep 600").kind, Outcome::Kind::Interrupted);
}

TEST_F(AttemptTest, TellsHowFarItIs) {
  run(R"(echo 'no JSON' >&3; echo '{"event":"progress","name":"drape","fraction":0.5}' >&3;)" + kDone);
  EXPECT_EQ(state->progress().stage, "drape");
  EXPECT_EQ(state->progress().progress, 0.5);
}

TEST_F(AttemptTest, FilesOutsideItsFolderAreRefused) {
  EXPECT_THROW(
      run(R"(echo '{"event":"artifact","name":"x","content_type":"a/b","file":"../../toile.db"}' >&3;)" + kDone),
      Error);
}

TEST_F(AttemptTest, KeepsFinishedStagesAndReadsThemBack) {
  run(R"(echo half > s; echo '{"event":"keep_stage","name":"key","file":"s"}' >&3;)" + kDone);
  const Outcome outcome = run(
      R"(echo '{"event":"find_stage","name":"key"}' >&3; read answer; echo "$answer" >&2; case "$answer" in *blobs*) )" +
      kDone + " esac");
  EXPECT_EQ(outcome.kind, Outcome::Kind::Succeeded) << outcome.error->message;
}

}  // namespace
}  // namespace toile::test
