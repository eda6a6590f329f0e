// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace frond {

struct WorkerCallbacks {
  std::function<void()> on_start;  // in each worker process, once; may be empty
  std::function<void(std::size_t)>
      run;  // in a worker: does job `index` and stores its result; does not throw
  std::function<void(std::size_t)> finished;  // in this process, after run returned
  // In this process: the worker of job `index` died ("crashed") or was killed at the limit ("timeout").
  std::function<void(std::size_t, const std::string& status, const std::string& reason)> lost;
};

// Runs jobs in `workers` forked processes, each its next job as soon as it is free, in order. A process that
// dies or takes longer than `time_limit` seconds for a job is replaced; it takes nothing with it but that
// job. Workers die with this process. Throws InputError where no process can be made.
void RunInWorkers(std::span<const std::size_t> jobs, int workers, double time_limit,
                  const WorkerCallbacks& callbacks);

}  // namespace frond
