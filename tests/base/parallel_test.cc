// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace frond {
namespace {

TEST(ParallelFor, AnyCountChunkAndThreads_VisitsEachIndexOnce) {
  for (const std::size_t count : {1, 2, 7, 100, 1001}) {
    for (const std::size_t chunk : {0, 1, 3, 100, 5000}) {
      for (const int threads : {-1, 0, 1, 2, 5}) {
        std::vector<std::atomic<int>> visits(count);
        ParallelFor(count, chunk, threads, [&](std::size_t begin, std::size_t end) {
          ASSERT_LT(begin, end);
          ASSERT_LE(end - begin, std::max<std::size_t>(chunk, 1));
          for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(visits[i], 1) << i << " of " << count << ", chunk " << chunk << ", threads " << threads;
        }
      }
    }
  }
}

TEST(ParallelFor, NothingToDo_NeverCallsTheBody) {
  ParallelFor(0, 10, 4, [](std::size_t, std::size_t) { FAIL(); });
}

TEST(ParallelFor, ChunkSums_HaveTheSameBitsForAnyThreads) {
  constexpr std::size_t kCount = 10007, kChunk = 64;
  const auto sum = [&](int threads) {
    std::vector<double> partial((kCount + kChunk - 1) / kChunk);
    ParallelFor(kCount, kChunk, threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        partial[begin / kChunk] += std::sin(static_cast<double>(i)) * 1e3;
      }
    });
    double total = 0;
    for (const double p : partial) total += p;
    return total;
  };
  const double one = sum(1);
  for (const int threads : {2, 3, 8}) EXPECT_EQ(sum(threads), one);
}

TEST(ParallelFor, SeveralThreads_AreUsed) {
  std::mutex mutex;
  std::set<std::thread::id> ids;
  ParallelFor(2, 1, 2, [&](std::size_t, std::size_t) {
    const auto in_both = [&] {
      const std::lock_guard lock(mutex);
      ids.insert(std::this_thread::get_id());
      return ids.size() == 2;
    };
    // Each body waits for the other: one thread alone would not get past this.
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!in_both() && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  });
  EXPECT_EQ(ids.size(), 2U);
}

TEST(ParallelFor, OneThread_RunsInOrderOnTheCaller) {
  std::vector<std::size_t> begins;
  const auto caller = std::this_thread::get_id();
  ParallelFor(10, 3, 1, [&](std::size_t begin, std::size_t) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    begins.push_back(begin);
  });
  EXPECT_EQ(begins, (std::vector<std::size_t>{0, 3, 6, 9}));
}

TEST(ParallelFor, OneBodyThrows_ItsExceptionArrives) {
  for (const int threads : {1, 4}) {
    try {
      ParallelFor(100, 1, threads, [](std::size_t begin, std::size_t) {
        if (begin == 41) throw std::runtime_error("41");
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "41");
    }
  }
}

TEST(ParallelFor, AllBodiesThrow_TheFirstChunksExceptionArrives) {
  for (const int threads : {1, 2, 4}) {
    for (int repeat = 0; repeat < 50; ++repeat) {
      try {
        ParallelFor(64, 1, threads, [](std::size_t begin, std::size_t) {
          // Chunk 0 is taken first of all, yet throws last.
          if (begin == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
          throw std::runtime_error(std::to_string(begin));
        });
        FAIL() << "nothing was thrown";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "0");
      }
    }
  }
}

TEST(ParallelFor, AfterAThrow_NoBodyIsRunning) {
  std::atomic<int> running{0};
  EXPECT_THROW(ParallelFor(64, 1, 4,
                           [&](std::size_t begin, std::size_t) {
                             ++running;
                             std::this_thread::sleep_for(std::chrono::microseconds(200));
                             --running;
                             if (begin == 3) throw std::runtime_error("3");
                           }),
               std::runtime_error);
  EXPECT_EQ(running, 0);
}

TEST(WorkerTeam, UsedAgainAndAgain_DoesEveryRoundWhole) {
  for (const int threads : {1, 2, 4}) {
    WorkerTeam team(threads);
    for (std::size_t round = 1; round <= 5000; ++round) {
      const std::size_t count = round % 7;
      std::atomic<std::size_t> sum{0};
      team.For(count, 1, [&](std::size_t i, std::size_t) { sum += i + 1; });
      ASSERT_EQ(sum, count * (count + 1) / 2) << round;
    }
  }
}

TEST(WorkerTeam, AfterAnException_WorksOn) {
  WorkerTeam team(3);
  for (int round = 0; round < 200; ++round) {
    EXPECT_THROW(team.For(20, 1,
                          [](std::size_t i, std::size_t) {
                            if (i == 7) throw std::runtime_error("seven");
                          }),
                 std::runtime_error);
    std::atomic<int> calls{0};
    team.For(20, 1, [&](std::size_t, std::size_t) { ++calls; });
    ASSERT_EQ(calls, 20);
  }
}

}  // namespace
}  // namespace frond
