// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/study/workers.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/errors.h"
#include "io/number_text.h"

namespace frond {
namespace {

using Clock = std::chrono::steady_clock;

// All of `size` bytes, or false at the end of the pipe.
bool ReadAll(int file, void* bytes, std::size_t size) {
  auto* at = static_cast<char*>(bytes);
  while (size > 0) {
    const ssize_t count = ::read(file, at, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool WriteAll(int file, const void* bytes, std::size_t size) {
  const auto* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t count = ::write(file, at, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    at += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

// A forked process that does jobs one after the other: an index comes down one pipe, the same index back up
// another when it is done.
struct Worker {
  pid_t pid = -1;
  int to = -1, from = -1;
  bool busy = false;
  std::size_t job = 0;
  Clock::time_point deadline;
};

[[noreturn]] void WorkerMain(int from, int to, pid_t parent, const WorkerCallbacks& callbacks) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // What ends the whole study must not look like a job's own crash: its process is told too, and takes this
  // one along.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
  if (::getppid() != parent) ::_exit(1);  // it died before the line above
  if (callbacks.on_start) callbacks.on_start();
  std::uint64_t index = 0;
  while (ReadAll(from, &index, sizeof(index))) {
    callbacks.run(index);
    if (!WriteAll(to, &index, sizeof(index))) break;
  }
  ::_exit(0);  // no destructors: they are the parent's
}

class Pool {
 public:
  Pool(int size, double time_limit, const WorkerCallbacks& callbacks)
      : workers_(static_cast<std::size_t>(std::max(size, 1))),
        time_limit_(time_limit),
        callbacks_(callbacks) {
    // A worker that died between two jobs must not end this process with SIGPIPE.
    struct sigaction ignore {};
    ignore.sa_handler = SIG_IGN;
    ::sigaction(SIGPIPE, &ignore, &before_);
  }

  ~Pool() {
    for (Worker& worker : workers_) Stop(&worker);
    ::sigaction(SIGPIPE, &before_, nullptr);
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void Run(std::span<const std::size_t> jobs) {
    std::size_t next = 0, done = 0;
    while (done < jobs.size()) {
      for (Worker& worker : workers_) {
        if (!worker.busy && next < jobs.size()) Give(jobs[next++], &worker);
      }
      done += Wait();
    }
  }

 private:
  void Start(Worker* worker) {
    int down[2], up[2];
    if (::pipe2(down, O_CLOEXEC) != 0) Fail("no pipe");
    if (::pipe2(up, O_CLOEXEC) != 0) Fail("no pipe");
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid < 0) Fail("no process");
    if (pid == 0) {
      ::close(down[1]);
      ::close(up[0]);
      for (const Worker& other : workers_) {  // a pipe has ended when nobody holds its other end
        if (other.pid > 0) {
          ::close(other.to);
          ::close(other.from);
        }
      }
      WorkerMain(down[0], up[1], parent, callbacks_);
    }
    ::close(down[0]);
    ::close(up[1]);
    *worker = {.pid = pid, .to = down[1], .from = up[0], .busy = false, .job = 0, .deadline = {}};
  }

  [[noreturn]] static void Fail(const std::string& what) {
    throw InputError("cannot start a worker: " + what + ": " + ::strerror(errno));
  }

  void Give(std::size_t job, Worker* worker) {
    const std::uint64_t index = job;
    if (worker->pid > 0 && !WriteAll(worker->to, &index, sizeof(index))) Stop(worker);  // died while idle
    if (worker->pid <= 0) {
      Start(worker);
      (void)WriteAll(worker->to, &index, sizeof(index));  // if it is dead already, Wait sees that
    }
    worker->busy = true;
    worker->job = job;
    // Longer limits than a month are none.
    const double seconds = std::min(time_limit_, 30.0 * 24 * 3600);
    worker->deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  // Kills and reaps; the exit status as waitpid gives it.
  static int Stop(Worker* worker) {
    if (worker->pid <= 0) return 0;
    ::close(worker->to);
    ::close(worker->from);
    ::kill(worker->pid, SIGKILL);
    int status = 0;
    while (::waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) {
    }
    *worker = {};
    return status;
  }

  // Waits until a job ends, one way or another; how many did.
  std::size_t Wait() {
    std::vector<pollfd> files;
    std::vector<Worker*> waiting;
    auto first = Clock::time_point::max();
    for (Worker& worker : workers_) {
      if (!worker.busy) continue;
      files.push_back({worker.from, POLLIN, 0});
      waiting.push_back(&worker);
      first = std::min(first, worker.deadline);
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(first - Clock::now()).count();
    ::poll(files.data(), files.size(), static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000)));
    std::size_t ended = 0;
    for (std::size_t k = 0; k < waiting.size(); ++k) {
      if (files[k].revents != 0) {
        Collect(waiting[k]);
        ++ended;
      } else if (Clock::now() >= waiting[k]->deadline) {
        const std::size_t job = waiting[k]->job;
        Stop(waiting[k]);
        callbacks_.lost(job, "timeout",
                        "no result within the time limit of " + FormatNumber(time_limit_) + " s");
        ++ended;
      }
    }
    return ended;
  }

  void Collect(Worker* worker) {
    std::uint64_t index = 0;
    const std::size_t job = worker->job;
    if (ReadAll(worker->from, &index, sizeof(index))) {
      worker->busy = false;
      callbacks_.finished(job);
      return;
    }
    int status = 0;  // it closed its pipe: dead, or about to be
    while (::waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) {
    }
    ::close(worker->to);
    ::close(worker->from);
    *worker = {};
    const std::string how = WIFSIGNALED(status) ? std::string("signal ") + std::to_string(WTERMSIG(status)) +
                                                      " (" + ::strsignal(WTERMSIG(status)) + ")"
                                                : "exit code " + std::to_string(WEXITSTATUS(status));
    callbacks_.lost(job, "crashed", "the process that ran it ended with " + how);
  }

  std::vector<Worker> workers_;
  double time_limit_;
  const WorkerCallbacks& callbacks_;
  struct sigaction before_ {};
};

}  // namespace

void RunInWorkers(std::span<const std::size_t> jobs, int workers, double time_limit,
                  const WorkerCallbacks& callbacks) {
  Pool(std::min<int>(workers, static_cast<int>(std::min<std::size_t>(jobs.size(), 4096))), time_limit,
       callbacks)
      .Run(jobs);
}

}  // namespace frond
