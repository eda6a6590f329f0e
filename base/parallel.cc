// SPDX-License-Identifier: BSD-3-Clause
#include "base/parallel.h"

#include <algorithm>

namespace frond {

WorkerTeam::WorkerTeam(int threads) {
  for (int k = 1; k < threads; ++k) threads_.emplace_back([this] { Loop(); });
}

WorkerTeam::~WorkerTeam() {
  end_ = true;
  ++round_;
  round_.notify_all();
  threads_.clear();  // joins
}

void WorkerTeam::Loop() {
  // For ends only when every thread has finished its round, so that no round is missed.
  for (std::uint32_t seen = 0;; ++seen) {
    round_.wait(seen);
    if (end_) return;
    RunChunks();
    if (--busy_ == 0) busy_.notify_one();
  }
}

void WorkerTeam::RunChunks() {
  for (std::size_t c = next_++; c < chunks_; c = next_++) {
    try {
      (*body_)(c * chunk_, std::min(count_, (c + 1) * chunk_));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (c < error_chunk_) {
        error_chunk_ = c;
        error_ = std::current_exception();
      }
      next_ = chunks_;
    }
  }
}

void WorkerTeam::For(std::size_t count, std::size_t chunk,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  count_ = count;
  chunk_ = std::max<std::size_t>(chunk, 1);
  chunks_ = (count_ + chunk_ - 1) / chunk_;
  if (threads_.empty() || chunks_ == 1) {
    for (std::size_t c = 0; c < chunks_; ++c) body(c * chunk_, std::min(count_, (c + 1) * chunk_));
    return;
  }
  body_ = &body;
  error_ = nullptr;
  error_chunk_ = chunks_;
  next_ = 0;
  busy_ = static_cast<int>(threads_.size());
  ++round_;
  round_.notify_all();
  RunChunks();
  for (int busy = busy_; busy != 0; busy = busy_) busy_.wait(busy);
  if (error_) std::rethrow_exception(error_);
}

void ParallelFor(std::size_t count, std::size_t chunk, int threads,
                 const std::function<void(std::size_t, std::size_t)>& body) {
  chunk = std::max<std::size_t>(chunk, 1);
  const std::size_t chunks = std::max<std::size_t>(1, (count + chunk - 1) / chunk);
  WorkerTeam(static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)), chunks)))
      .For(count, chunk, body);
}

}  // namespace frond
