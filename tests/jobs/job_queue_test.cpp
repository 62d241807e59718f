// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/job_queue.h"

#include <gmock/gmock.h>

#include "tests/jobs/store_fixture.h"

namespace toile::test {

using JobQueue = StoreTest;

TEST_F(JobQueue, JobsAreClaimedInTheOrderOfArrivalAndEndWithTheirArtifacts) {
  const std::string first = enqueue(), second = enqueue();
  const auto claimed = store->queue.claim("w");
  ASSERT_TRUE(claimed);
  EXPECT_EQ(claimed->id, first);
  EXPECT_EQ(claimed->attempt, 1);
  EXPECT_EQ(claimed->inputs.at("target_body"), target);
  EXPECT_EQ(state(first), JobState::Running);
  EXPECT_TRUE(store->queue.finish({first, 1}, success()));
  EXPECT_EQ(state(first), JobState::Succeeded);
  EXPECT_EQ(job(first).summary, R"({"ok":true})");
  const auto artifact = store->jobs.artifact(first, "result.json");
  ASSERT_TRUE(artifact);
  EXPECT_EQ(store->artifacts.read(artifact->sha256), bytes_of("result"));
  EXPECT_EQ(store->queue.claim("w")->id, second);
  EXPECT_FALSE(store->queue.claim("w"));
}

TEST_F(JobQueue, ALostLeaseGoesToAnotherWorkerAndTheLateOneCannotFinish) {
  const std::string id = enqueue();
  ASSERT_TRUE(store->queue.claim("slow"));
  now_ms += options.lease_ms + 1;
  EXPECT_EQ(store->queue.recover_expired(), 1);
  const auto again = store->queue.claim("fast");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->attempt, 2);
  EXPECT_FALSE(store->queue.finish({id, 1}, success("late")));
  EXPECT_EQ(beat(id, 1, 0.5), LeaseState::Lost);
  EXPECT_EQ(state(id), JobState::Running);
  EXPECT_TRUE(store->queue.finish({id, 2}, success("in time")));
  EXPECT_FALSE(store->queue.finish({id, 2}, success("twice")));
  EXPECT_EQ(store->artifacts.read(store->jobs.artifact(id, "result.json")->sha256), bytes_of("in time"));
}

TEST_F(JobQueue, AHeartbeatKeepsTheLeaseAndStoresProgressThatNeverFalls) {
  const std::string id = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  for (int count = 1; count <= 4; ++count) {
    now_ms += options.lease_ms / 2;
    EXPECT_EQ(beat(id, 1, count == 4 ? 0.1 : 0.2 * count), LeaseState::Held);
    EXPECT_EQ(store->queue.recover_expired(), 0);
  }
  EXPECT_EQ(job(id).stage, "drape");
  EXPECT_DOUBLE_EQ(job(id).progress, 0.2 * 3);
}

TEST_F(JobQueue, TwoCrashesFailAJobForGood) {
  const std::string id = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  EXPECT_TRUE(store->queue.finish({id, 1}, ended(Outcome::Kind::Crashed)));
  EXPECT_EQ(state(id), JobState::Queued);
  EXPECT_FALSE(store->queue.claim("w")) << "the second try waits";
  now_ms += options.first_backoff_ms;
  ASSERT_TRUE(store->queue.claim("w"));
  EXPECT_TRUE(store->queue.finish({id, 2}, ended(Outcome::Kind::Crashed)));
  EXPECT_EQ(state(id), JobState::Failed);
  EXPECT_EQ(job(id).error->code, "crashed");
  EXPECT_EQ(job(id).crashes, 2);
}

TEST_F(JobQueue, TransientFailuresWaitLongerEachTimeAndEndAtTheLastAttempt) {
  options.max_attempts = 8;
  reopen();
  const std::string id = enqueue();
  std::vector<std::int64_t> waits;
  for (int attempt = 1; attempt <= options.max_attempts; ++attempt) {
    const std::int64_t asked = now_ms;
    while (!store->queue.claim("w")) now_ms += 500;
    waits.push_back(now_ms - asked);
    ASSERT_TRUE(store->queue.finish({id, attempt}, ended(Outcome::Kind::Transient)));
  }
  EXPECT_THAT(waits, ::testing::ElementsAre(0, 1000, 2000, 4000, 8000, 16000, 32000, 60000));
  EXPECT_EQ(state(id), JobState::Failed);
}

TEST_F(JobQueue, AnInterruptedJobIsTakenUpAtOnce) {
  const std::string id = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  EXPECT_TRUE(store->queue.finish({id, 1}, ended(Outcome::Kind::Interrupted)));
  EXPECT_EQ(store->queue.claim("w")->id, id);
}

TEST_F(JobQueue, TheJobsOfADeadWorkerAreGivenBackWithoutWaitingForTheLease) {
  const std::string first = enqueue(), second = enqueue();
  ASSERT_TRUE(store->queue.claim("dead"));
  ASSERT_TRUE(store->queue.claim("alive"));
  EXPECT_EQ(store->queue.give_back_jobs_of("dead"), 1);
  EXPECT_EQ(state(first), JobState::Queued);
  EXPECT_EQ(state(second), JobState::Running);
}

TEST_F(JobQueue, InteractiveJobsComeFirstButBatchJobsAreNotStarved) {
  for (int i = 0; i < 4; ++i) enqueue(Priority::Batch);
  std::vector<int> batch_claims;
  for (int claim = 1; claim <= 4 * options.batch_share; ++claim) {
    enqueue();  // there is always an interactive job waiting
    enqueue();
    const auto claimed = store->queue.claim("w");
    ASSERT_TRUE(claimed);
    Transaction transaction(store->database);
    Statement row = transaction->query("SELECT priority FROM jobs WHERE id = ?", claimed->id);
    ASSERT_TRUE(row.step());
    if (row.integer(0) == 1) batch_claims.push_back(claim);
  }
  EXPECT_THAT(batch_claims, ::testing::ElementsAre(options.batch_share, 2 * options.batch_share,
                                                   3 * options.batch_share, 4 * options.batch_share));
}

TEST_F(JobQueue, AQueuedJobIsCancelledAtOnceARunningOneIsAsked) {
  const std::string running = enqueue(), queued = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  EXPECT_TRUE(store->queue.cancel("alice", queued));
  EXPECT_EQ(state(queued), JobState::Cancelled);
  EXPECT_TRUE(store->queue.cancel("alice", running));
  EXPECT_EQ(state(running), JobState::Running);
  EXPECT_EQ(look(running, 1), LeaseState::CancelRequested);
  EXPECT_TRUE(store->queue.finish({running, 1}, ended(Outcome::Kind::Cancelled)));
  EXPECT_EQ(state(running), JobState::Cancelled);
  EXPECT_FALSE(store->queue.cancel("alice", running));
}

TEST_F(JobQueue, ACancelledJobWhoseWorkerDiedIsNotTakenUpAgain) {
  const std::string id = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  EXPECT_TRUE(store->queue.cancel("alice", id));
  now_ms += options.lease_ms + 1;
  store->queue.recover_expired();
  EXPECT_EQ(state(id), JobState::Cancelled);
}

TEST_F(JobQueue, AnotherTenantCanNeitherSeeNorCancelNorUse) {
  const std::string id = enqueue();
  EXPECT_FALSE(store->jobs.find("bob", id));
  EXPECT_TRUE(store->jobs.list("bob", {}).empty());
  EXPECT_THROW(store->queue.cancel("bob", id), Error);
  NewJob stolen = new_job();
  stolen.tenant = "bob";
  EXPECT_THROW(enqueue(stolen), Error);
  EXPECT_EQ(state(id), JobState::Queued);
}

TEST_F(JobQueue, AnEqualJobIsAnsweredFromWhatIsKnown) {
  const std::string first = enqueue(new_job());
  ASSERT_TRUE(store->queue.claim("w"));
  ASSERT_TRUE(store->queue.finish({first, 1}, success()));
  const std::string second = enqueue(new_job());
  EXPECT_NE(first, second);
  EXPECT_EQ(state(second), JobState::Succeeded);
  EXPECT_EQ(job(second).summary, job(first).summary);
  EXPECT_EQ(store->jobs.artifact(second, "result.json")->sha256, store->jobs.artifact(first, "result.json")->sha256);
  EXPECT_EQ(state(enqueue(new_job(R"({"other":1})"))), JobState::Queued);
}

TEST_F(JobQueue, AFullQueueRefuses) {
  options.max_queued = 2;
  reopen();
  enqueue();
  enqueue();
  try {
    enqueue();
    FAIL() << "the third job was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::QueueFull);
  }
}

TEST_F(JobQueue, TheNumberOfWaitingJobsIsRightWhateverHappensToThem) {
  const auto counted = [&](const char* sql) {
    Reader reader(store->database);
    Statement row = reader->query(sql);
    row.step();
    return row.integer(0);
  };
  const auto expect_right = [&](std::int64_t waiting) {
    EXPECT_EQ(counted("SELECT count(*) FROM jobs WHERE state = 'queued'"), waiting);
    EXPECT_EQ(counted("SELECT count FROM waiting"), waiting);
  };
  for (int n = 0; n < 4; ++n) enqueue();
  expect_right(4);
  const Job first = *store->queue.claim("w"), second = *store->queue.claim("w");
  expect_right(2);
  store->queue.finish({first.id, first.attempt}, success());
  store->queue.finish({second.id, second.attempt}, ended(Outcome::Kind::Interrupted));
  expect_right(3);
  store->queue.cancel("alice", second.id);
  expect_right(2);
  store->removal.remove_input("alice", InputKind::Body, target);
  expect_right(0);
}

TEST_F(JobQueue, FollowersWaitForTheirLeaderHoweverItEnds) {
  const std::string leader = enqueue();
  NewJob follower = new_job(R"({"follower":1})");
  follower.blocked_by = leader;
  const std::string id = enqueue(follower);
  ASSERT_EQ(store->queue.claim("w")->id, leader);
  EXPECT_FALSE(store->queue.claim("w"));
  EXPECT_TRUE(store->queue.finish({leader, 1}, ended(Outcome::Kind::Failed)));
  EXPECT_EQ(store->queue.claim("w")->id, id);
}

TEST_F(JobQueue, WorkIsAnnounced) {
  int announced = 0;
  store->queue.on_work([&] { ++announced; });
  const std::string id = enqueue();
  store->queue.announce_work();
  ASSERT_TRUE(store->queue.claim("w"));
  store->queue.finish({id, 1}, ended(Outcome::Kind::Interrupted));
  EXPECT_EQ(announced, 2);
}

TEST_F(JobQueue, TheEndOfAJobWithAWebhookLeavesAMessageOnce) {
  NewJob wanted = new_job();
  wanted.webhook = "http://127.0.0.1:1/hook";
  const std::string id = enqueue(wanted);
  EXPECT_FALSE(store->webhooks.take(1000));
  ASSERT_TRUE(store->queue.claim("w"));
  ASSERT_TRUE(store->queue.finish({id, 1}, success()));
  auto message = store->webhooks.take(1000);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->job, id);
  EXPECT_FALSE(store->webhooks.take(1000)) << "another sender must not take it";
  store->webhooks.failed(*message);
  now_ms += 5000;
  message = store->webhooks.take(1000);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->attempt, 1);
  store->webhooks.delivered(message->id);
  now_ms += 86'400'000;
  EXPECT_FALSE(store->webhooks.take(1000));
}

TEST_F(JobQueue, AWebhookThatNeverAnswersIsDroppedAfterTheLastWait) {
  NewJob wanted = new_job();
  wanted.webhook = "http://127.0.0.1:1/hook";
  const std::string id = enqueue(wanted);
  ASSERT_TRUE(store->queue.claim("w"));
  ASSERT_TRUE(store->queue.finish({id, 1}, success()));
  int tries = 0;
  for (; tries < 50; ++tries) {
    const auto message = store->webhooks.take(1000);
    if (!message) break;
    store->webhooks.failed(*message);
    now_ms += 86'400'001;
  }
  EXPECT_EQ(tries, 10);
}

TEST_F(JobQueue, ListsAreNewestFirstFilteredAndPaged) {
  NewJob labelled = new_job(R"({"x":1})");
  labelled.labels = {"spring"};
  const std::string first = enqueue(labelled);
  std::vector<std::string> others;
  for (int i = 0; i < 5; ++i) others.push_back(enqueue());
  JobFilter filter;
  filter.label = "spring";
  ASSERT_EQ(store->jobs.list("alice", filter).size(), 1U);
  EXPECT_EQ(store->jobs.list("alice", filter).front().id, first);
  filter = {};
  filter.limit = 4;
  const auto page = store->jobs.list("alice", filter);
  ASSERT_EQ(page.size(), 4U);
  EXPECT_EQ(page.front().id, others.back());
  filter.before = page.back().sequence;
  EXPECT_EQ(store->jobs.list("alice", filter).size(), 2U);
  filter = {};
  filter.state = JobState::Running;
  EXPECT_TRUE(store->jobs.list("alice", filter).empty());
}

}  // namespace toile::test
