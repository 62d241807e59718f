// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/store/removal.h"

#include <fstream>
#include <random>

#include "engine/core/content_hash.h"
#include "jobs/store/fault_point.h"
#include "jobs/store/request_memory.h"
#include "tests/jobs/store_fixture.h"

namespace toile::test {

namespace {

std::string random_text(std::mt19937_64& random, std::size_t length) {
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::string text;
  for (std::size_t i = 0; i < length; ++i) text += kLetters[random() % kLetters.size()];
  return text;
}

// Everything in the folder, files' names included.
std::string all_bytes(const std::filesystem::path& folder) {
  std::string all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    all += entry.path().string() + "\n";
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    all.append(std::istreambuf_iterator<char>(in), {});
  }
  return all;
}

}  // namespace

class Removal : public StoreTest {
 protected:
  void SetUp() override {
    StoreTest::SetUp();
    store->removal.wipe();  // the first one of every database
  }
  void enqueue_80_half_of_them_on(const std::string& scan, int round) {
    Transaction transaction(store->database);
    for (int i = 0; i < 80; ++i) {
      NewJob wanted = new_job("{\"i\":" + std::to_string(80 * round + i) + "}");
      if (i % 2 == 0) wanted.inputs["target_body"] = scan;
      store->queue.enqueue(transaction, wanted);
    }
    transaction.commit();
  }
  int rewritings_owed() {
    Reader reader(store->database);
    Statement row = reader->query("SELECT asked > done FROM rewriting");
    row.step();
    return static_cast<int>(row.integer(0));
  }
};

TEST_F(Removal, NothingOfADeletedBodyIsLeftInTheFolder) {
  std::mt19937_64 random(7);
  std::vector<std::string> known;  // strings of the body, of its results, and their hashes
  std::string bytes;
  for (int i = 0; i < 1000; ++i) {
    known.push_back(random_text(random, 24));
    bytes += known.back();
  }
  const std::string scan = add_input("alice", InputKind::Body, bytes);
  known.push_back(sha256_hex(bytes));
  for (int i = 0; i < 40; ++i) {
    NewJob wanted = new_job("{\"i\":" + std::to_string(i) + "}");
    wanted.inputs["target_body"] = scan;
    const std::string id = enqueue(wanted);
    ASSERT_EQ(store->queue.claim("w")->id, id);
    Outcome outcome = success(bytes.substr(static_cast<std::size_t>(i) * 100));
    known.push_back(outcome.artifacts[0].blob.sha256());
    known.push_back(random_text(random, 24));
    outcome.summary = "{\"said\":\"" + known.back() + bytes.substr(0, 3000) + "\"}";
    ASSERT_TRUE(store->queue.finish({id, 1}, outcome));
    store->stages.add(StageStore::tenant_key("alice", std::to_string(i)),
                      store->artifacts.prepare(bytes_of(bytes + "stage")), {scan});
    ASSERT_TRUE(store->queue.cancel("alice", enqueue()));  // rows of others in between: pages are shared and split
  }
  ASSERT_NE(all_bytes(folder).find(known.front()), std::string::npos) << "the search finds what is there";

  const RemovalCounts counts = store->removal.remove_input("alice", InputKind::Body, scan);
  EXPECT_EQ(counts.jobs, 40);
  EXPECT_EQ(counts.stages, 40);

  const std::string left = all_bytes(folder);
  for (const std::string& text : known) EXPECT_EQ(left.find(text), std::string::npos) << text;
  EXPECT_EQ(left.find(scan), std::string::npos) << "not even its id";
  EXPECT_EQ(store->database.integrity(), "ok");
  EXPECT_FALSE(store->inputs.find("alice", scan));
  EXPECT_TRUE(store->inputs.find("alice", target));
}

TEST_F(Removal, RowsThatMovedBetweenPagesLeaveNoCopies) {
  // Ids are random, so that rows come in between others: pages are split and shared out again. Without a rewriting
  // most runs find copies here.
  for (int round = 0; round < 20; ++round) {
    const std::string scan = add_input("alice", InputKind::Body, "scan " + std::to_string(round));
    enqueue_80_half_of_them_on(scan, round);
    store->removal.remove_input("alice", InputKind::Body, scan);
    const std::string left = all_bytes(folder);
    EXPECT_EQ(left.find(scan), std::string::npos);
    EXPECT_NE(left.find(target), std::string::npos) << "the search finds what is there";
  }
  EXPECT_EQ(store->database.integrity(), "ok");
}

TEST_F(Removal, ARemovalWithoutRewritingIsMendedByTheSweep) {
  const std::string scan = add_input("alice", InputKind::Body, "a scan");
  fault_hook = [](const char* where) {
    if (std::string_view(where) == "rewrite") throw Error(ErrorCode::StorageFull, "database", "told by the test");
  };
  EXPECT_THROW(store->removal.remove_input("alice", InputKind::Body, scan), Error);
  fault_hook = nullptr;
  EXPECT_FALSE(store->inputs.find("alice", scan)) << "it is gone for its owner";
  EXPECT_EQ(rewritings_owed(), 1);
  reopen();
  store->removal.wipe();
  EXPECT_EQ(rewritings_owed(), 0);
  EXPECT_EQ(all_bytes(folder).find(scan), std::string::npos);
}

TEST_F(Removal, ContentSharedWithAnotherTenantStaysForThatTenant) {
  const std::string mine = add_input("alice", InputKind::Body, "shared bytes");
  const std::string theirs = add_input("bob", InputKind::Body, "shared bytes");
  EXPECT_NE(mine, theirs);
  store->removal.remove_input("alice", InputKind::Body, mine);
  EXPECT_EQ(store->artifacts.read(store->inputs.find("bob", theirs)->sha256), bytes_of("shared bytes"));
  EXPECT_THROW(store->removal.remove_input("alice", InputKind::Body, theirs), Error);
  store->removal.remove_input("bob", InputKind::Body, theirs);
  EXPECT_EQ(all_bytes(folder).find("shared bytes"), std::string::npos);
}

TEST_F(Removal, ARunningJobOnADeletedBodyLosesItsLease) {
  const std::string id = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  store->removal.remove_input("alice", InputKind::Body, target);
  EXPECT_EQ(look(id, 1), LeaseState::Lost);
  EXPECT_FALSE(store->queue.finish({id, 1}, success()));
  EXPECT_FALSE(store->jobs.find("alice", id));
}

TEST_F(Removal, OldJobsGoAndWithThemInputsNobodyNames) {
  const std::string old_job = enqueue();
  ASSERT_TRUE(store->queue.claim("w"));
  ASSERT_TRUE(store->queue.finish({old_job, 1}, success("old result")));
  {
    Transaction transaction(store->database);
    transaction->run("INSERT INTO input_labels(input_id, label) VALUES (?, 'catalogue')", body);
    transaction.commit();
  }
  now_ms += 1000;
  const std::int64_t line = now_ms;
  now_ms += 1000;
  const std::string waiting = enqueue(new_job(R"({"new":1})"));
  RemovalCounts counts = store->removal.remove_older_than(line);
  EXPECT_EQ(counts.jobs, 1);
  EXPECT_EQ(counts.inputs, 0) << "the waiting job uses them";
  EXPECT_FALSE(store->jobs.find("alice", old_job));
  store->removal.wipe();
  EXPECT_EQ(all_bytes(folder).find("old result"), std::string::npos);
  EXPECT_EQ(rewritings_owed(), 1);
  now_ms += 25 * 3600 * 1000;
  store->removal.wipe();
  EXPECT_EQ(rewritings_owed(), 0);
  EXPECT_EQ(all_bytes(folder).find(old_job), std::string::npos);

  ASSERT_TRUE(store->queue.cancel("alice", waiting));
  now_ms += 1000;
  counts = store->removal.remove_older_than(now_ms);
  EXPECT_EQ(counts.inputs, 2);
  EXPECT_TRUE(store->inputs.find("alice", body)) << "a label keeps it";
  EXPECT_FALSE(store->inputs.find("alice", garment));
}

TEST_F(Removal, StagesAreForgottenByAgeAndBySize) {
  for (int i = 0; i < 4; ++i) {
    store->stages.add(StageStore::tenant_key("alice", std::to_string(i)),
                      store->artifacts.prepare(bytes_of(std::string(100, static_cast<char>('a' + i)))), {body});
    now_ms += 1000;
  }
  EXPECT_EQ(store->stages.evict(now_ms - 3500, 1 << 20), 1);
  EXPECT_EQ(store->stages.evict(0, 250), 1);
  EXPECT_FALSE(store->stages.find(StageStore::tenant_key("alice", "1")));
  EXPECT_TRUE(store->stages.find(StageStore::tenant_key("alice", "3")));
  EXPECT_FALSE(store->stages.find(StageStore::tenant_key("bob", "3")));
}

TEST_F(Removal, RememberedRequestsAreForgottenInTime) {
  {
    Transaction transaction(store->database);
    remember_request(transaction, "alice", "key", {"hash", 202, "job_1"}, now_ms);
    transaction.commit();
  }
  EXPECT_EQ(recall_request(store->database, "alice", "key")->resource, "job_1");
  EXPECT_FALSE(recall_request(store->database, "bob", "key"));
  store->removal.forget_idempotency(now_ms + 1);
  EXPECT_FALSE(recall_request(store->database, "alice", "key"));
}

}  // namespace toile::test
