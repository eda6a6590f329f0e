// SPDX-License-Identifier: BSD-3-Clause
#include "solvers/quiet_ceres_log.h"

#include <glog/logging.h>

#include <algorithm>
#include <mutex>

namespace frond {
namespace {

std::mutex mutex;
int alive = 0;  // guarded by mutex
int level_before = 0;

}  // namespace

QuietCeresLog::QuietCeresLog() {
  const std::lock_guard lock(mutex);
  if (alive++ > 0) return;
  level_before = FLAGS_minloglevel;
  FLAGS_minloglevel = std::max<int>(level_before, google::GLOG_FATAL);
}

QuietCeresLog::~QuietCeresLog() {
  const std::lock_guard lock(mutex);
  if (--alive == 0) FLAGS_minloglevel = level_before;
}

}  // namespace frond
