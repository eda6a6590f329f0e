// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace frond {

// Threads that wait for work between loops: for many short loops, such as the batches of a swarm, each of
// which would take as long to start its threads as to run. To be used by one thread at a time.
class WorkerTeam {
 public:
  // `threads` in all, the calling one included.
  explicit WorkerTeam(int threads);
  ~WorkerTeam();
  WorkerTeam(const WorkerTeam&) = delete;
  WorkerTeam& operator=(const WorkerTeam&) = delete;

  // Splits [0, count) into chunks of at most `chunk` consecutive indices and calls body(begin, end) for each,
  // on all threads. The chunks depend on `count` and `chunk` only, so a sum formed per chunk and added in
  // chunk order has the same bits for any number of threads. The first exception thrown by a body (by chunk
  // number) is thrown again after all threads have stopped.
  void For(std::size_t count, std::size_t chunk,
           const std::function<void(std::size_t begin, std::size_t end)>& body);

 private:
  void Loop();       // of a waiting thread
  void RunChunks();  // until none is left

  std::size_t count_ = 0, chunk_ = 1, chunks_ = 0;
  const std::function<void(std::size_t, std::size_t)>* body_ = nullptr;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::uint32_t> round_{0};  // of loops, and the end
  std::atomic<int> busy_{0};             // waiting threads that have not finished the round
  std::atomic<bool> end_{false};
  std::mutex mutex_;
  std::exception_ptr error_;
  std::size_t error_chunk_ = 0;
  std::vector<std::jthread> threads_;
};

// WorkerTeam::For by up to `threads` threads of its own.
void ParallelFor(std::size_t count, std::size_t chunk, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace frond
