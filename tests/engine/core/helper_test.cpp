// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/helper.h"

#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

#include "engine/core/side_by_side.h"
#include "engine/core/work_off.h"

namespace toile {
namespace {

std::thread::id here() {
  return std::this_thread::get_id();
}

TEST(SpareThreads, AreTakenAsOftenAsThereAreAny) {
  SpareThreads threads(1);
  EXPECT_TRUE(threads.take());
  EXPECT_FALSE(threads.take());
  threads.give_back();
  threads.take_ahead();
  EXPECT_FALSE(threads.any_idle());
}

TEST(SpareThreads, AreLentToOneThreadForAWhile) {
  EXPECT_EQ(lent_threads(), nullptr);
  SpareThreads threads(1);
  {
    const LendThreads lend(&threads);
    EXPECT_EQ(lent_threads(), &threads);
    const LendThreads nothing(nullptr);
    EXPECT_EQ(lent_threads(), nullptr);
  }
  EXPECT_EQ(lent_threads(), nullptr);
}

TEST(SpareThreads, AreBusyWhileTwoWorkSideBySideAndIdleAgainWhenOneHasEnded) {
  SpareThreads threads(1);
  const LendThreads lend(&threads);
  bool busy = false, lent = false;
  side_by_side(
      true,
      [&] {
        lent = lent_threads() == &threads;
        busy = !threads.any_idle();
      },
      [&] {
        while (!threads.any_idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      });
  EXPECT_TRUE(lent);
  EXPECT_TRUE(busy);
  EXPECT_TRUE(threads.any_idle());
}

TEST(Helper, WorksOnAThreadOfItsOwnOnceCalledAndRestsWhenDismissed) {
  SpareThreads threads(1);
  const LendThreads lend(&threads);
  Helper helper;
  // The first part gives the helper time to begin the second.
  const auto second_thread = [&](std::chrono::milliseconds time) {
    std::atomic<bool> begun{false};
    std::thread::id first, second;
    helper.both(
        [&] {
          first = here();
          for (const auto start = std::chrono::steady_clock::now();
               !begun && std::chrono::steady_clock::now() - start < time;)
            std::this_thread::yield();
        },
        [&] {
          begun = true;
          second = here();
        });
    EXPECT_EQ(first, here());
    return second;
  };
  constexpr std::chrono::milliseconds kNone(0), kPlenty(20000);
  EXPECT_EQ(second_thread(kNone), here());
  helper.call();
  EXPECT_FALSE(threads.any_idle());
  const std::thread::id other = second_thread(kPlenty);
  EXPECT_NE(other, here());
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // it has gone to sleep by now
  EXPECT_EQ(second_thread(kPlenty), other);
  helper.dismiss();
  EXPECT_TRUE(threads.any_idle());
  EXPECT_EQ(second_thread(kNone), here());
}

TEST(Helper, DoesEveryPieceOnce) {
  SpareThreads threads(1);
  const LendThreads lend(&threads);
  Helper helper;
  helper.call();
  int first = 0, second = 0;
  for (int i = 0; i < 20000; ++i) helper.both([&] { first += i; }, [&] { second += first >= 0 ? 1 : 0; });
  EXPECT_EQ(first, 199990000);
  EXPECT_EQ(second, 20000);
}

TEST(Helper, StaysAwayWhereNothingIsLent) {
  Helper helper;
  helper.call();
  std::thread::id second;
  helper.both([] {}, [&] { second = here(); });
  EXPECT_EQ(second, here());
}

TEST(Helper, CountsItsProcessorTimeForTheCaller) {
  SpareThreads threads(1);
  const LendThreads lend(&threads);
  const double before = work_cpu_seconds();
  {
    Helper helper;
    helper.call();
    std::atomic<bool> begun{false};
    helper.both(
        [&] {
          while (!begun) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        },
        [&] {
          begun = true;
          const double start = work_cpu_seconds();
          while (work_cpu_seconds() - start < 0.02) continue;
        });
  }
  EXPECT_GE(work_cpu_seconds() - before, 0.02);
}

class WorkOff : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(AloneAndWithAnIdleThread, WorkOff, testing::Values(0, 1));

TEST_P(WorkOff, DoesEveryItemOnce) {
  SpareThreads threads(GetParam());
  const LendThreads lend(&threads);
  std::vector<int> done(1000, 0);
  work_off(done.size(), [&](std::size_t i) { done[i] += static_cast<int>(i) + 1; });
  for (std::size_t i = 0; i < done.size(); ++i) ASSERT_EQ(done[i], static_cast<int>(i) + 1);
}

TEST_P(WorkOff, ThrowsWhatTheFirstOfTheFailedItemsHasThrown) {
  SpareThreads threads(GetParam());
  const LendThreads lend(&threads);
  std::vector<int> done(50, 0);
  try {
    work_off(done.size(), [&](std::size_t i) {
      done[i] = 1;
      if (i % 20 == 7) throw i;
    });
    FAIL() << "nothing was thrown";
  } catch (const std::size_t item) {
    EXPECT_EQ(item, 7U);
  }
  EXPECT_EQ(std::count(done.begin(), done.end(), 1), 50);
}

}  // namespace
}  // namespace toile
