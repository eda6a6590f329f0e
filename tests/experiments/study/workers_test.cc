// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/io/temp_folder.h"

namespace frond {
namespace {

using Jobs = std::vector<std::size_t>;

struct Line {
  std::string what;
  std::size_t job;
  pid_t pid;
};

// A file that processes write lines into, each at once.
class Diary {
 public:
  Diary() { file_ = ::open((folder_ / "diary").c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600); }
  ~Diary() { ::close(file_); }

  void Write(const std::string& what, std::size_t job) const {
    const std::string line = what + " " + std::to_string(job) + " " + std::to_string(::getpid()) + "\n";
    EXPECT_EQ(::write(file_, line.data(), line.size()), static_cast<ssize_t>(line.size()));
  }

  std::vector<Line> Lines(const std::string& what) const {
    std::vector<Line> lines;
    std::istringstream text(FileText(folder_ / "diary"));
    for (Line line; text >> line.what >> line.job >> line.pid;) {
      if (line.what == what) lines.push_back(line);
    }
    return lines;
  }

  Jobs JobsOf(const std::string& what) const {
    Jobs jobs;
    for (const Line& line : Lines(what)) jobs.push_back(line.job);
    return jobs;
  }

 private:
  TempFolder folder_;
  int file_ = -1;
};

struct Losses {
  std::map<std::size_t, std::string> status, reason;
  int count = 0;
};

WorkerCallbacks CallbacksFor(const Diary& diary, Losses* losses, std::function<void(std::size_t)> job = {}) {
  return {.on_start = [&diary] { diary.Write("start", 0); },
          .run =
              [&diary, job = std::move(job)](std::size_t index) {
                diary.Write("run", index);
                if (job) job(index);
              },
          .finished = [&diary](std::size_t index) { diary.Write("finished", index); },
          .lost =
              [losses](std::size_t index, const std::string& status, const std::string& reason) {
                losses->status[index] = status;
                losses->reason[index] = reason;
                ++losses->count;
              }};
}

Jobs Sorted(Jobs jobs) {
  std::sort(jobs.begin(), jobs.end());
  return jobs;
}

bool HasChildren() { return ::waitpid(-1, nullptr, WNOHANG) >= 0; }

void Hang() {
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

TEST(Workers, WithoutJobs_DoNothing) {
  const Diary diary;
  Losses losses;
  for (const int workers : {0, 1, 4}) RunInWorkers({}, workers, 10, CallbacksFor(diary, &losses));
  EXPECT_EQ(losses.count, 0);
  EXPECT_TRUE(diary.Lines("start").empty());
}

TEST(Workers, One_DoesTheJobsInTheirOrder) {
  const Diary diary;
  Losses losses;
  const Jobs jobs = {7, 3, 12, 0, 5};
  RunInWorkers(jobs, 1, 10, CallbacksFor(diary, &losses));
  EXPECT_EQ(diary.JobsOf("run"), jobs);
  EXPECT_EQ(diary.JobsOf("finished"), jobs);
  EXPECT_EQ(losses.count, 0);
}

TEST(Workers, OfAnyNumber_DoEachJobOnceAndLeaveNoProcess) {
  Jobs jobs(40);
  std::iota(jobs.begin(), jobs.end(), 100U);
  for (const int workers : {1, 2, 3, 4, 100}) {
    const Diary diary;
    Losses losses;
    RunInWorkers(jobs, workers, 10, CallbacksFor(diary, &losses));
    EXPECT_EQ(Sorted(diary.JobsOf("run")), jobs);
    EXPECT_EQ(Sorted(diary.JobsOf("finished")), jobs);
    for (const Line& line : diary.Lines("finished")) EXPECT_EQ(line.pid, ::getpid());
    std::set<pid_t> processes;
    for (const Line& line : diary.Lines("run")) processes.insert(line.pid);
    EXPECT_EQ(processes.count(::getpid()), 0U);
    EXPECT_LE(processes.size(), static_cast<std::size_t>(std::min(workers, 40)));
    EXPECT_EQ(diary.Lines("start").size(), processes.size()) << "once in each";
    EXPECT_EQ(losses.count, 0);
    EXPECT_FALSE(HasChildren());
  }
}

TEST(Workers, WorkAtTheSameTime) {
  const Diary diary;
  Losses losses;
  const Jobs jobs = {0, 1, 2, 3};
  const auto begin = std::chrono::steady_clock::now();
  RunInWorkers(jobs, 4, 30, CallbacksFor(diary, &losses, [](std::size_t) {
                 std::this_thread::sleep_for(std::chrono::milliseconds(500));
               }));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(took.count(), 1.5) << "one after the other they sleep for 2 s";
  EXPECT_EQ(losses.count, 0);
}

TEST(Workers, KeepTheirStateBetweenJobs) {
  const Diary diary;
  Losses losses;
  int jobs_seen = 0;  // each process has its own, by the fork
  RunInWorkers(Jobs{0, 1, 2, 3}, 1, 10, CallbacksFor(diary, &losses, [&](std::size_t) {
                 diary.Write("seen", static_cast<std::size_t>(++jobs_seen));
               }));
  EXPECT_EQ(diary.JobsOf("seen"), (Jobs{1, 2, 3, 4}));
  EXPECT_EQ(jobs_seen, 0);
  for (const Line& line : diary.Lines("run")) EXPECT_EQ(line.pid, diary.Lines("run")[0].pid);
}

TEST(Workers, ThatDie_LoseTheirJobAloneAndSayHow) {
  Jobs jobs(20);
  std::iota(jobs.begin(), jobs.end(), 0U);
  for (const int workers : {1, 2, 4}) {
    const Diary diary;
    Losses losses;
    RunInWorkers(jobs, workers, 30, CallbacksFor(diary, &losses, [](std::size_t job) {
                   (void)::signal(SIGSEGV, SIG_DFL);  // sanitizers have a handler of their own
                   if (job == 0) ::raise(SIGSEGV);
                   if (job == 7) std::abort();
                   if (job == 8) ::raise(SIGKILL);
                   if (job == 13) ::_exit(3);
                   if (job == 19) ::_exit(0);
                 }));
    EXPECT_EQ(losses.count, 5);
    for (const std::size_t job : {0, 7, 8, 13, 19}) EXPECT_EQ(losses.status[job], "crashed") << job;
    const std::string ended = "the process that ran it ended with ";
    EXPECT_EQ(losses.reason[0], ended + "signal 11 (Segmentation fault)");
    EXPECT_EQ(losses.reason[7], ended + "signal 6 (Aborted)");
    EXPECT_EQ(losses.reason[8], ended + "signal 9 (Killed)");
    EXPECT_EQ(losses.reason[13], ended + "exit code 3");
    EXPECT_EQ(losses.reason[19], ended + "exit code 0");
    EXPECT_EQ(Sorted(diary.JobsOf("run")), jobs);
    EXPECT_EQ(diary.JobsOf("finished").size(), 15U);
    EXPECT_FALSE(HasChildren());
  }
}

TEST(Workers, BeyondTheTimeLimit_AreKilledAndReplaced) {
  const Jobs jobs = {0, 1, 2, 3, 4, 5};
  for (const int workers : {1, 2}) {
    const Diary diary;
    Losses losses;
    const auto begin = std::chrono::steady_clock::now();
    RunInWorkers(jobs, workers, 0.5, CallbacksFor(diary, &losses, [](std::size_t job) {
                   if (job == 0 || job == 3) Hang();
                 }));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_GE(took.count(), 0.5);
    EXPECT_LT(took.count(), 5);
    EXPECT_EQ(losses.count, 2);
    for (const std::size_t job : {0, 3}) {
      EXPECT_EQ(losses.status[job], "timeout");
      EXPECT_EQ(losses.reason[job], "no result within the time limit of 0.5 s");
    }
    EXPECT_EQ(Sorted(diary.JobsOf("finished")), (Jobs{1, 2, 4, 5}));
    EXPECT_FALSE(HasChildren());
  }
}

TEST(Workers, WithATimeLimitBeyondAllClocks_HaveNone) {
  const Diary diary;
  Losses losses;
  for (const double limit : {1e30, std::numeric_limits<double>::infinity()}) {
    RunInWorkers(Jobs{0, 1}, 2, limit, CallbacksFor(diary, &losses));
  }
  EXPECT_EQ(losses.count, 0);
  EXPECT_EQ(diary.JobsOf("finished").size(), 4U);
}

TEST(Workers, ThatDieWhileIdle_AreReplacedForTheNextJob) {
  const Diary diary;
  Losses losses;
  WorkerCallbacks callbacks = CallbacksFor(diary, &losses);
  pid_t first = -1;
  callbacks.finished = [&](std::size_t job) {
    if (job != 0) return;
    first = diary.Lines("run")[0].pid;
    ::kill(first, SIGKILL);
    while (::kill(first, 0) == 0 &&
           FileText("/proc/" + std::to_string(first) + "/stat").find(") Z") == std::string::npos) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  RunInWorkers(Jobs{0, 1, 2}, 1, 10, callbacks);
  EXPECT_EQ(diary.JobsOf("run"), (Jobs{0, 1, 2}));
  EXPECT_NE(diary.Lines("run")[1].pid, first);
  EXPECT_EQ(losses.count, 0) << "no job was lost";
}

TEST(Workers, EndWhereACallbackThrows) {
  const Diary diary;
  Losses losses;
  WorkerCallbacks callbacks = CallbacksFor(diary, &losses, [](std::size_t job) {
    if (job == 1) Hang();
  });
  callbacks.finished = [](std::size_t) { throw std::runtime_error("the disk is full"); };
  EXPECT_THROW(RunInWorkers(Jobs{0, 1, 2}, 2, 60, callbacks), std::runtime_error);
  EXPECT_FALSE(HasChildren());
}

}  // namespace
}  // namespace frond
