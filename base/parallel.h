// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace frond {

// Splits [0, count) into chunks of at most `chunk` consecutive indices and calls body(begin, end) for each,
// on up to `threads` threads (the calling one included). The chunks depend on `count` and `chunk` only, so a
// sum formed per chunk and added in chunk order has the same bits for any number of threads. The first
// exception thrown by a body (by chunk number) is thrown again after all threads have stopped.
void ParallelFor(std::size_t count, std::size_t chunk, int threads,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace frond
